//! Makes the library call its own functions even where a host loads both units with global symbols.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    match std::env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("linux") => println!("cargo:rustc-cdylib-link-arg=-Wl,-Bsymbolic"),
        // The name by which a library knows itself would otherwise be its path on the building machine.
        Ok("macos") => println!("cargo:rustc-cdylib-link-arg=-Wl,-install_name,@rpath/uam_controller.dylib"),
        _ => {}
    }
}
