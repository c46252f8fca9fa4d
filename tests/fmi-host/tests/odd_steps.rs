//! Communication steps as hosts really send them.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use fmi_host::{Coupling, Track, steps};
use uam::Structure;

/// Length of the runs \[s\]; the payload is grasped at 1.6 s.
const DURATION: u32 = 4;

/// Largest difference between the ends of two runs.
fn apart(one: &Track, other: &Track) -> f64 {
    one.end().iter().zip(other.end()).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

/// Steps of 10 ms and of 1 ms, and minimum norm, for which the UAV moves most.
fn compare(bar: f64, odd: impl Fn(f64, u32) -> Vec<(f64, f64)>) {
    let coupling = Coupling::open(Structure::DEFAULT);
    for (size, count) in [(1e-2, 100 * DURATION), (1e-3, 1000 * DURATION)] {
        for resolution in [1.0, 3.0] {
            let parameters = [("ik.resolution", resolution)];
            let even = coupling.run(&parameters, steps(0.0, size, count)).unwrap();
            let odd = coupling.run(&parameters, odd(size, count)).unwrap();
            assert!(apart(&even, &odd) < bar, "{size} s, resolution {resolution}: {} apart", apart(&even, &odd));
            assert!(odd.largest_error() <= 5e-7, "{size} s, resolution {resolution}: {}", odd.largest_error());
        }
    }
}

/// A co-simulation master divides its interval and sends 0.0099999999999984546 for 10 ms.
#[test]
fn steps_that_are_a_little_too_short() {
    // Time that is missing at the end, times the speed of the UAV.
    compare(1e-10, |size, count| steps(0.0, size * (0.009_999_999_999_998_455 / 0.01), count).collect());
}

/// A host adds its steps up, so that times drift.
#[test]
fn sums_with_rounding() {
    compare(1e-11, |size, count| {
        let mut time = 0.0;
        let mut step = || {
            let from = time;
            time += size;
            (from, size)
        };
        (0..count).map(|_| step()).collect()
    });
}

/// A host takes differences of times for its steps: 0.10000000000000003 for 0.1.
#[test]
fn differences_with_rounding() {
    compare(1e-11, |size, count| {
        let point = |n: u32| f64::from(n) * size;
        (0..count).map(|n| (point(n), point(n + 1) - point(n))).collect()
    });
}

/// What rounding leaves of an interval becomes a step of 1e-13 s: here after every tenth step.
#[test]
fn steps_of_nearly_nothing() {
    compare(1e-11, |size, count| {
        let rest = 1e-13;
        let with_rest = |n: u32| {
            let from = f64::from(n) * size;
            let step = (from, size);
            if n % 10 == 9 { vec![step, (from + size, rest)] } else { vec![step] }
        };
        (0..count).flat_map(with_rest).collect()
    });
}

/// Nearly nothing does not disturb what is a mean over a step either.
#[test]
fn a_step_of_nearly_nothing_keeps_the_means() {
    let coupling = Coupling::open(Structure::DEFAULT);
    let even = coupling.run(&[("ik.resolution", 1.0)], steps(0.0, 1e-3, 500)).unwrap();
    let odd = coupling.run(&[("ik.resolution", 1.0)], steps(0.0, 1e-3, 500).chain([(0.5, 1e-13)])).unwrap();
    let (even, odd) = (even.moment.last().unwrap(), odd.moment.last().unwrap());
    assert!(even.abs() > 1e-3, "something is transmitted: {even} N m");
    assert!((even - odd).abs() < 1e-9, "{even} and {odd} N m");
}

/// A simulation may begin at any time; times in parameters count from there.
#[test]
fn a_later_start_changes_nothing() {
    let coupling = Coupling::open(Structure::DEFAULT);
    let early = coupling.run(&[], steps(0.0, 1e-2, 400)).unwrap();
    let late = coupling.run(&[], steps(100.0, 1e-2, 400)).unwrap();
    assert!(apart(&early, &late) < 1e-10, "{} apart", apart(&early, &late));
    assert!(late.largest_error() <= 5e-7);
}

/// Clocks of single precision, counted from 0 and long past the 16 s where one of their units is a microsecond, and of double
/// precision counted from 1970: steps are taken, and the end effector stays on the reference but for the rounding of the
/// times, at 0.01 m/s there.
#[test]
fn clocks_that_count_coarsely() {
    let coupling = Coupling::open(Structure::DEFAULT);
    let single = |n: u32| f64::from((f64::from(n) * 1e-2) as f32);
    let track = coupling.run(&[], (0..3000).map(|n| (single(n), single(n + 1) - single(n)))).unwrap();
    assert!(track.largest_error() <= 5e-7, "{:e}", track.largest_error());
    // A host that sends its step as it is meant, and the time as its clock shows it.
    let track = coupling.run(&[], (0..3000).map(|n| (single(n), 1e-2))).unwrap();
    assert!(track.largest_error() <= 5e-7, "{:e}", track.largest_error());
    let late = |n: u32| 1.7e9 + f64::from(n) * 1e-2;
    let track = coupling.run(&[], (0..400).map(|n| (late(n), late(n + 1) - late(n)))).unwrap();
    assert!(track.largest_error() <= 5e-7, "{:e}", track.largest_error());
}

/// A step that was left out is no rounding.
#[test]
fn a_step_that_is_left_out_is_refused() {
    let coupling = Coupling::open(Structure::DEFAULT);
    for late in [0.0, 20.0, 3e4] {
        let begin = |n: u32| late + f64::from(n) * 1e-2;
        let mut steps: Vec<_> = (0..50).map(|n| (begin(n), 1e-2)).collect();
        steps.remove(30);
        assert!(coupling.run(&[], steps).is_err(), "from {late} s");
    }
}
