//! Saved FMU states in the hands of hosts.
//!
//! A host holds a state by an address, but nothing is ever read from there: all states that are alive stand
//! in a list. So whatever a host hands over that is no state, or none any more, is noticed and does no harm.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::c_types::FmuState;

/// A state of any unit.
type Shared = Arc<Mutex<dyn Any + Send>>;

struct Entry {
    /// Of the state, unique among all libraries of a process.
    address: usize,
    state: Shared,
    /// The instance with whose end the state ends.
    owner: usize,
}

/// Searched from the end: hosts mostly use the state that they got last.
static ALIVE: Mutex<Vec<Entry>> = Mutex::new(Vec::new());

/// Nothing is left half-changed under the lock, so a panic of another thread does no harm.
fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps a state until [`free`], or the end of its `owner`.
pub fn keep<T: Send + 'static>(state: T, owner: usize) -> FmuState {
    let state: Shared = Arc::new(Mutex::new(state));
    let handle: FmuState = Arc::as_ptr(&state).cast_mut().cast();
    lock(&ALIVE).push(Entry { address: handle.addr(), state, owner });
    handle
}

/// Calls `body` with the state behind a handle; `None` if there is none of this type.
pub fn with<T: 'static, R>(handle: FmuState, body: impl FnOnce(&mut T) -> R) -> Option<R> {
    let alive = lock(&ALIVE);
    let state = alive.get(position(&alive, handle)?).map(|entry| Arc::clone(&entry.state))?;
    drop(alive);
    let mut state = lock(&state);
    state.downcast_mut().map(body)
}

/// Ends the life of a state; `false` if there is none of this type.
pub fn free<T: 'static>(handle: FmuState) -> bool {
    let known = with::<T, _>(handle, |_| ()).is_some();
    let mut alive = lock(&ALIVE);
    match position(&alive, handle).filter(|_| known) {
        None => false,
        Some(position) => {
            alive.swap_remove(position);
            give_back(&mut alive);
            true
        }
    }
}

/// Ends the life of all states of an owner.
pub fn free_all(owner: usize) {
    let mut alive = lock(&ALIVE);
    alive.retain(|entry| entry.owner != owner);
    give_back(&mut alive);
}

fn position(alive: &[Entry], handle: FmuState) -> Option<usize> {
    alive.iter().rposition(|entry| entry.address == handle.addr())
}

/// A list that has become empty keeps memory, which would be lost when the host unloads the library.
fn give_back(alive: &mut Vec<Entry>) {
    if alive.is_empty() {
        *alive = Vec::new();
    }
}
