//! Derivatives through the C interface.

use super::*;

fn give(toy: &host::Component, reference: u32, order: c_int, value: f64) -> c_int {
    // SAFETY: all lists have one element.
    unsafe { fmi2SetRealInputDerivatives(toy.handle, &raw const reference, 1, &raw const order, &raw const value) }
}

fn read(toy: &host::Component, reference: u32, order: c_int) -> (c_int, f64) {
    let mut value = f64::NAN;
    // SAFETY: all lists have one element.
    let status =
        unsafe { fmi2GetRealOutputDerivatives(toy.handle, &raw const reference, 1, &raw const order, &raw mut value) };
    (status, value)
}

#[test]
fn an_input_derivative_holds_for_one_step() {
    let host = Host::new();
    let toy = host.running();
    assert_eq!(give(&toy, vr::RATE, 1, 2.0), OK);
    assert_eq!(toy.step(0.0, 0.0), OK, "no step");
    assert_eq!(toy.step(0.0, 1.0), OK);
    assert_eq!(toy.real(vr::POSITION), 2.0);
    assert_eq!(read(&toy, vr::POSITION, 1), (OK, 1.0));
    assert_eq!(read(&toy, vr::SPEED, 1), (OK, 0.0));
    assert_eq!(toy.step(1.0, 1.0), OK);
    assert_eq!(toy.real(vr::POSITION), 2.0);
    assert_eq!(host.messages(), []);
}

#[test]
fn derivatives_that_are_not_there_are_refused_by_name() {
    let host = Host::new();
    let toy = host.running();
    for (reference, order, part) in [
        (vr::RATE, 2, "rate has no derivative of order 2 as an input"),
        (vr::RATE, 0, "rate has no derivative of order 0"),
        (vr::RATE, -1, "rate has no derivative of order -1"),
        (vr::HOLD, 1, "hold has no derivative of order 1 as an input"),
        (vr::LEAK, 1, "leak has no derivative"),
        (vr::POSITION, 1, "position has no derivative of order 1 as an input"),
        (vr::COUNT, 1, "no variable has the value reference 12"),
    ] {
        assert_eq!(give(&toy, reference, order, 1.0), ERROR);
        assert!(host.last().text.contains(part), "{}", host.last().text);
    }
    for value in [f64::NAN, f64::INFINITY] {
        assert_eq!(give(&toy, vr::RATE, 1, value), ERROR);
        assert!(host.last().text.contains("the derivative of rate must be a finite number"), "{}", host.last().text);
    }
    for (reference, order) in [(vr::POSITION, 2), (vr::POSITION, 0), (vr::RATE, 1), (vr::HELD, 1), (vr::TIME, 1)] {
        assert_eq!(read(&toy, reference, order).0, ERROR);
        assert!(host.last().text.contains("has no derivative of order"), "{}", host.last().text);
    }
    // SAFETY: lists that are null or too long are not read.
    unsafe {
        assert_eq!(fmi2SetRealInputDerivatives(toy.handle, &vr::RATE, 1, null(), &1.0), ERROR);
        assert_eq!(fmi2SetRealInputDerivatives(toy.handle, &vr::RATE, 99, &1, &1.0), ERROR);
        assert_eq!(fmi2GetRealOutputDerivatives(toy.handle, &vr::POSITION, 1, &1, null_mut()), ERROR);
        assert_eq!(fmi2SetRealInputDerivatives(toy.handle, null(), 0, null(), null()), OK);
        assert_eq!(fmi2GetRealOutputDerivatives(toy.handle, null(), 0, null(), null_mut()), OK);
    }
    assert_eq!(toy.step(0.0, 1.0), OK);
    assert_eq!(toy.real(vr::POSITION), 1.0, "nothing was given");
}
