//! Panics end here: none unwinds into the host, none prints to the host's console.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};

use super::environment::Host;

/// Keeps panics from printing. That is for shared libraries, which have a Rust runtime of their own and run
/// nothing outside of [`caught`]; unit tests tell by panics what fails.
pub fn silence() {
    if !cfg!(test) {
        // Takes no memory, as it captures nothing: what a library allocates for good is lost when the host unloads it.
        panic::set_hook(Box::new(|_| {}));
    }
}

/// Calls `action`, in the environment that is in force once the host's has been left.
///
/// # Errors
/// If it panics: the message. What `action` was changing is then in an unknown state; it is for the
/// caller not to use it any more.
pub fn caught<R>(_left: &Host, action: impl FnOnce() -> R) -> Result<R, String> {
    panic::catch_unwind(AssertUnwindSafe(action)).map_err(|payload| message(payload.as_ref()))
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied().or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("panic without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn caught<R>(action: impl FnOnce() -> R) -> Result<R, String> {
        super::caught(&Host::leave(), action)
    }

    #[test]
    fn messages_of_both_kinds_are_kept() {
        assert_eq!(caught(|| panic!("plain")), Err::<(), _>("plain".to_owned()));
        assert_eq!(caught(|| panic!("{} of two", 1)), Err::<(), _>("1 of two".to_owned()));
        assert_eq!(caught(|| panic::panic_any(7)), Err::<(), _>("panic without a message".to_owned()));
        assert_eq!(caught(|| 7), Ok(7));
    }
}
