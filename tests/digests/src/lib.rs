//! Digests of runs: equal digests, equal bits.

use uam::fmi::hash::fnv1a;

/// Every so many communication points are part of a digest, beside the last one.
pub const EVERY: usize = 50;

/// What a run gave so far.
#[derive(Debug, Clone, Default)]
pub struct Digest(Vec<u8>);

impl Digest {
    /// Adds numbers in the order in which the units name them.
    pub fn add(&mut self, numbers: impl IntoIterator<Item = f64>) {
        self.0.extend(numbers.into_iter().flat_map(f64::to_le_bytes));
    }

    /// The line for a run of this name.
    #[must_use]
    pub fn line(&self, scenario: &str, discretization: &str) -> String {
        format!("{scenario} {discretization} {:016x}", fnv1a(&self.0))
    }
}
