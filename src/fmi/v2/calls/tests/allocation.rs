//! What hosts call again and again needs no memory from the heap.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use super::*;

/// Counts the allocations of each thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: everything is left to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: promised by the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: promised by the caller.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn steps_getters_and_setters_do_not_allocate() {
    let host = Host::new();
    let toy = host.running();
    let (mut number, mut truth) = (1, 0);
    let before = ALLOCATIONS.get();
    for n in 0..100 {
        toy.set_real(&[vr::RATE, vr::HOLD, vr::LEAK], &[1.0, 0.0, 0.1]);
        toy.step(f64::from(n), 1.0);
        toy.real(vr::POSITION);
        // SAFETY: all lists have one element.
        unsafe {
            fmi2SetInteger(toy.handle, &vr::FAULT, 1, &raw const number);
            fmi2GetInteger(toy.handle, &vr::DIRECTION, 1, &raw mut number);
            fmi2SetBoolean(toy.handle, &vr::HOLD, 1, &raw const truth);
            fmi2GetBoolean(toy.handle, &vr::HELD, 1, &raw mut truth);
        }
    }
    assert_eq!(ALLOCATIONS.get(), before);
    assert_eq!(host.messages(), []);
}
