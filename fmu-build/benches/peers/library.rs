//! Peers as shared libraries.

use std::path::PathBuf;

use libloading::Library;

/// A compiled peer, if the folder that the environment variable `PEERS` names has it.
pub fn open(name: &str) -> Option<Library> {
    let path = PathBuf::from(std::env::var_os("PEERS")?).join(format!("libpeer_{name}.so"));
    // SAFETY: these libraries are compiled from the sources beside this file; their initializers do no harm.
    let library = unsafe { Library::new(&path) };
    if let Err(error) = &library {
        println!("skipped: {name} ({error})");
    }
    library.ok()
}

/// A function of a peer.
///
/// # Safety
/// `F` is the type of the function of this name.
pub unsafe fn function<F: Copy>(library: &Library, name: &str) -> F {
    // SAFETY: by the contract of this function.
    let symbol = unsafe { library.get::<F>(name) };
    *symbol.unwrap_or_else(|error| panic!("{name}: {error}"))
}
