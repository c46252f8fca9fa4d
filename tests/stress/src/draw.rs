//! Random choices from one seed; no function of the platform's mathematics takes part, so that a case is the same
//! everywhere.

pub mod clock;
pub mod limits;
pub mod method;
pub mod path;
pub mod start;
pub mod vehicle;

use fastrand::Rng;

/// A sequence of random choices.
pub struct Draw(Rng);

impl Draw {
    /// That of a seed.
    pub fn new(seed: u64) -> Self {
        Self(Rng::with_seed(seed))
    }

    /// A number between two others, each as likely.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    /// A number at most this large, of either sign.
    pub fn about_zero(&mut self, size: f64) -> f64 {
        self.between(-size, size)
    }

    /// A number between two positive ones, each order of magnitude as likely.
    pub fn scale(&mut self, mut low: f64, mut high: f64) -> f64 {
        for _ in 0..10 {
            let middle = (low * high).sqrt();
            if self.0.bool() {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.between(low, high)
    }

    /// Whether it happens, in so many of a hundred cases.
    pub fn percent(&mut self, share: u32) -> bool {
        self.0.u32(0..100) < share
    }

    /// One of the first `count` numbers.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.usize(0..count)
    }

    /// One of them.
    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.0.usize(0..choices.len())]
    }

    /// One of them, each as likely as its weight says.
    pub fn weighed<T: Copy>(&mut self, choices: &[(u32, T)]) -> T {
        let mut place = self.0.u32(0..choices.iter().map(|(weight, _)| weight).sum());
        for (weight, choice) in choices {
            if place < *weight {
                return *choice;
            }
            place -= weight;
        }
        unreachable!("the place is below the sum")
    }
}
