//! Panics end here: none unwinds into the host, none prints to the host's console.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Once, OnceLock};

/// What is called when something panics.
type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync>;

thread_local! {
    /// Whether this thread is inside [`caught`].
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Keeps panics inside [`caught`] from printing. Others are reported as before, so that a program
/// which links this library as Rust code loses nothing.
pub fn silence() {
    static ONCE: Once = Once::new();
    // Neither this one nor the closure below is in memory of its own, as long as the hook is that of Rust
    // itself: what a library allocates for good is lost when the host unloads it.
    static OTHER: OnceLock<Hook> = OnceLock::new();
    ONCE.call_once(|| {
        OTHER.get_or_init(panic::take_hook);
        panic::set_hook(Box::new(|panic| {
            if let (false, Some(other)) = (INSIDE.get(), OTHER.get()) {
                other(panic);
            }
        }));
    });
}

/// Calls `action`.
///
/// # Errors
/// If it panics: the message. What `action` was changing is then in an unknown state; it is for the
/// caller not to use it any more.
pub fn caught<R>(action: impl FnOnce() -> R) -> Result<R, String> {
    let result = INSIDE.with(|inside| {
        let before = inside.replace(true);
        let result = panic::catch_unwind(AssertUnwindSafe(action));
        inside.set(before);
        result
    });
    result.map_err(|payload| message(payload.as_ref()))
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied().or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("panic without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_both_kinds_are_kept() {
        silence();
        assert_eq!(caught(|| panic!("plain")), Err::<(), _>("plain".to_owned()));
        assert_eq!(caught(|| panic!("{} of two", 1)), Err::<(), _>("1 of two".to_owned()));
        assert_eq!(caught(|| panic::panic_any(7)), Err::<(), _>("panic without a message".to_owned()));
        assert_eq!(caught(|| 7), Ok(7));
    }
}
