//! What the tests share: a model of the vehicle that knows none of the library's formulas, and runs.
#![allow(dead_code, unused_imports)] // every test takes what it needs
#![allow(clippy::unwrap_used)]

pub mod coupling;
pub mod model;
pub mod random;
pub mod run;

use std::ops::{Add, Mul};

use proptest::test_runner::{Config, RngSeed};

/// The same `cases` random cases on every machine and in every run.
pub fn cases(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(20_260_101), failure_persistence: None, ..Config::default() }
}

/// The derivative of `f` at 0 by seven points; exact to about 1e-12 for motions of a few rad/s.
pub fn derivative<T>(f: impl Fn(f64) -> T) -> T
where
    T: Add<Output = T> + Mul<f64, Output = T>,
{
    let pair = |i: f64, weight: f64| (f(i * REACH / 3.0) + f(-i * REACH / 3.0) * -1.0) * (weight / (20.0 * REACH));
    pair(1.0, 45.0) + pair(2.0, -9.0) + pair(3.0, 1.0)
}

/// How far [`derivative`] looks to both sides.
pub const REACH: f64 = 6e-3;

/// Simpson's rule for values at an odd number of instants `spacing` apart.
pub fn simpson<T>(values: &[T], spacing: f64) -> T
where
    T: Add<Output = T> + Mul<f64, Output = T> + Copy,
{
    assert!(values.len() % 2 == 1 && values.len() > 2);
    let last = values.len() - 1;
    let weight = |i: usize| if i == 0 || i == last { 1.0 } else { [2.0, 4.0][i % 2] };
    let sum = (1..=last).fold(values[0] * weight(0), |sum, i| sum + values[i] * weight(i));
    sum * (spacing / 3.0)
}

/// Asserts that two lists of numbers agree within `tolerance`, absolute or relative to the larger number.
#[track_caller]
pub fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (i, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!(
            approx::relative_eq!(*a, *b, epsilon = tolerance, max_relative = tolerance),
            "{what}[{i}]: found {a}, expected {b}, difference {:e}",
            (a - b).abs()
        );
    }
}
