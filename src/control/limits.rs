//! How fast a coordinate may be in the coming interval: it must be able to stop in time.

use crate::control::qp::{MAX_VARIABLES, Vector};
use crate::parameters::{Counterweight, Joint};

/// Limits of one coordinate \[rad, m; s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest rate.
    pub rate: f64,
    /// Largest change of the rate per time.
    pub acceleration: f64,
    /// Smallest position.
    pub lower: f64,
    /// Largest position.
    pub upper: f64,
}

impl From<&Joint> for Limits {
    fn from(joint: &Joint) -> Self {
        Self { rate: joint.rate_limit, acceleration: joint.acceleration_limit, lower: joint.lower, upper: joint.upper }
    }
}

impl From<&Counterweight> for Limits {
    fn from(counterweight: &Counterweight) -> Self {
        Self {
            rate: counterweight.rate_limit,
            acceleration: counterweight.acceleration_limit,
            lower: -counterweight.stroke,
            upper: counterweight.stroke,
        }
    }
}

/// A coordinate that is past a stop by no more than this counts as being at it: rounding leaves as much \[rad, m\].
const AT_STOP: f64 = 1e-9;

impl Limits {
    /// Smallest and largest rate for an interval that starts at `position` with a jump from `previous_rate`, which was
    /// held for the time `previous_duration` \[s\], if rates may be held for the time `hold` \[s\], but no longer.
    ///
    /// At any rate in between, the coordinate can stop at its stops, by intervals of any lengths up to `hold`, each
    /// slower than the one before by no more than the acceleration limit allows in the length of that one. A coordinate past
    /// a stop must come back, as fast as the limits allow. Where not all limits can hold, since they have been changed,
    /// or since the start is too near to a stop, that of the acceleration does.
    #[must_use]
    pub fn window(&self, position: f64, previous_rate: f64, [previous_duration, hold]: [f64; 2]) -> [f64; 2] {
        let change = self.acceleration * previous_duration;
        let [downwards, upwards] =
            [position - self.lower, self.upper - position].map(|distance| self.fastest(distance, hold));
        // Coming back, it must not pass the other stop.
        [(-downwards).min(upwards.max(0.0)), upwards.max(-downwards.max(0.0))]
            .map(|rate| rate.min(previous_rate + change).max(previous_rate - change))
    }

    /// Whether `position` is past a stop.
    fn is_past(&self, position: f64) -> bool {
        position < self.lower - AT_STOP || position > self.upper + AT_STOP
    }

    /// The largest rate towards a stop at this `distance`; the distance is negative past the stop, and the rate leads back.
    fn fastest(&self, distance: f64, hold: f64) -> f64 {
        if distance < -AT_STOP {
            -self.rate
        } else if distance < 0.0 {
            (distance / hold).max(-self.rate)
        } else if self.is_far(distance, self.rate, hold) {
            self.rate
        } else {
            self.stopping_rate(distance, hold).min(self.rate)
        }
    }

    /// Whether braking from `rate` surely takes less than `distance`: rate^2 / 2 a and one interval.
    fn is_far(&self, distance: f64, rate: f64, hold: f64) -> bool {
        2.0 * self.acceleration * distance >= rate * (rate + 2.0 * self.acceleration * hold)
    }

    /// Whether a coordinate at `position` may hold this `rate` for the time `hold` \[s\] and can still stop at its stops.
    #[must_use]
    pub fn can_hold(&self, position: f64, rate: f64, hold: f64) -> bool {
        let distance = if rate < 0.0 { position - self.lower } else { self.upper - position };
        rate == 0.0 || self.is_far(distance, rate.abs(), hold) || rate.abs() <= self.stopping_rate(distance, hold)
    }

    /// The rate from `position` that leads towards `target` without overshooting, where `previous_rate` was held for the
    /// time `previous_duration` \[s\] and the next one may be held for `hold` \[s\]: as fast as the limits allow, and at the
    /// end exponentially with the time constant `time` \[s\].
    #[must_use]
    pub fn approach(
        &self,
        target: f64,
        position: f64,
        previous_rate: f64,
        [previous_duration, hold]: [f64; 2],
        time: f64,
    ) -> f64 {
        let distance = target.min(self.upper).max(self.lower) - position;
        let [least, most] = self.window(position, previous_rate, [previous_duration, hold]);
        let speed = self.stopping_rate(distance.abs(), hold).min(distance.abs() / time.max(hold));
        (speed * distance.signum()).min(most).max(least)
    }

    /// The largest rate r for an interval of length T after which slowing down by a T in each interval covers
    /// no more than the rest of `distance`: with n intervals of slowing down,
    /// r T + (r - a T) T + ... + (r - n a T) T = `distance`.
    fn stopping_rate(&self, distance: f64, size: f64) -> f64 {
        let (distance, change) = (distance.max(0.0), self.acceleration * size);
        let intervals = (0.5 * ((1.0 + 8.0 * distance / (change * size)).sqrt() - 1.0)).floor();
        if intervals < MANY {
            distance / (size * (intervals + 1.0)) + 0.5 * change * intervals
        } else {
            // From here on one interval more or less is nothing.
            (2.0 * self.acceleration * distance).sqrt() * (1.0 - 1.0 / MANY)
        }
    }
}

/// What the limits allow in one interval.
#[derive(Debug, Clone, Copy)]
pub struct Allowed {
    /// Smallest rates \[rad/s, m/s\].
    pub least: Vector,
    /// Largest rates \[rad/s, m/s\]; that of what balances the arm is the same as the smallest.
    pub most: Vector,
    /// Whether a coordinate is past its stop, and on its way back.
    pub returning: bool,
}

impl Allowed {
    /// For coordinates with these `limits`, from `position` and after the rates `previous_rate`; no motion of others. The
    /// `times` are those of [`Limits::window`].
    #[must_use]
    pub fn new(limits: &[Limits], position: &[f64], previous_rate: &[f64], times: [f64; 2]) -> Self {
        let mut allowed = Self { least: [0.0; MAX_VARIABLES], most: [0.0; MAX_VARIABLES], returning: false };
        for (i, (limits, (position, previous_rate))) in
            limits.iter().zip(position.iter().zip(previous_rate)).enumerate()
        {
            [allowed.least[i], allowed.most[i]] = limits.window(*position, *previous_rate, times);
            allowed.returning |= limits.is_past(*position);
        }
        allowed
    }

    /// Coordinate `i` moves at `rate`.
    pub fn fix(&mut self, i: usize, rate: f64) {
        (self.least[i], self.most[i]) = (rate, rate);
    }

    /// Whether each of `rates` is allowed.
    #[must_use]
    pub fn admit(&self, rates: &[f64]) -> bool {
        rates.iter().zip(self.least.iter().zip(&self.most)).all(|(rate, (least, most))| least <= rate && rate <= most)
    }
}

/// So many intervals of braking are as good as a continuum.
const MANY: f64 = 1e6;

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Where a coordinate comes to rest that slows down as much as it may after an interval at `rate`.
    fn rest(limits: &Limits, mut position: f64, mut rate: f64, size: f64) -> f64 {
        while rate != 0.0 {
            position += rate * size;
            rate -= rate.abs().min(limits.acceleration * size) * rate.signum();
        }
        position
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn whoever_stays_within_the_windows_stays_within_the_stops(
            rate in 0.1..10.0_f64, braking in 0.5..500.0_f64, hold in 1e-3..0.1_f64,
            start in 0.0..1.0_f64, choices in prop::collection::vec((0.0..1.0_f64, 0.0..1.5_f64), 200),
        ) {
            let limits = Limits { rate, acceleration: braking * rate, lower: -0.3, upper: 0.5 };
            let (mut position, mut previous_rate, mut previous_duration) = (-0.3 + 0.8 * start, 0.0_f64, hold);
            for (choice, share) in choices {
                let [least, most] = limits.window(position, previous_rate, [previous_duration, hold]);
                prop_assert!(least <= most);
                // Often at the ends.
                let next = least + (most - least) * (2.0 * choice - 0.5).clamp(0.0, 1.0);
                prop_assert!(next.abs() <= rate * (1.0 + 1e-12));
                prop_assert!((next - previous_rate).abs() <= limits.acceleration * previous_duration * (1.0 + 1e-12));
                let rest = rest(&limits, position, next, hold);
                prop_assert!((-0.3 - 1e-9..=0.5 + 1e-9).contains(&rest), "{rest}");
                prop_assert!(next.abs() < 1e-9 || limits.can_hold(position, next * (1.0 - 1e-9), hold));
                // Often as long as may be, else of any length.
                let size = hold * share.clamp(1e-6, 1.0);
                position += next * size;
                (previous_rate, previous_duration) = (next, size);
                prop_assert!((-0.3 - 1e-12..=0.5 + 1e-12).contains(&position), "{position}");
            }
        }

        #[test]
        fn the_windows_are_no_narrower_than_need_be(
            acceleration in 0.5..100.0_f64, size in 1e-3..0.1_f64, distance in 1e-3..1.0_f64,
        ) {
            let limits = Limits { rate: 1e9, acceleration, lower: -1e9, upper: 0.0 };
            let largest = limits.stopping_rate(distance, size);
            prop_assert!(rest(&limits, -distance, largest, size) <= 1e-12);
            prop_assert!(rest(&limits, -distance, largest * (1.0 + 1e-6), size) > 0.0);
            // Without intervals, the way of braking is v^2 / 2 a.
            let speed = limits.stopping_rate(distance, 1e-7);
            prop_assert!((speed * speed / (2.0 * acceleration) - distance).abs() < 1e-3 * distance);
        }

        #[test]
        fn an_approach_ends_at_the_target_without_overshooting(
            acceleration in 0.5..100.0_f64, size in 1e-3..0.1_f64, target in -1.2..1.2_f64, time in 0.0..0.1_f64,
        ) {
            let limits = Limits { rate: 2.0, acceleration, lower: -1.0, upper: 1.0 };
            let (mut position, mut previous_rate) = (0.0_f64, 0.0);
            let end = target.clamp(-1.0, 1.0);
            for _ in 0..20_000 {
                previous_rate = limits.approach(target, position, previous_rate, [size, size], time);
                position += previous_rate * size;
                prop_assert!(position.abs() <= end.abs() + 1e-12);
            }
            prop_assert!((position - end).abs() < 1e-9, "{position}");
        }
    }

    #[test]
    fn past_a_stop_one_must_come_back_as_fast_as_may_be() {
        let limits = Limits { rate: 1.0, acceleration: 10.0, lower: -1.0, upper: 1.0 };
        assert_eq!(limits.window(1.5, 0.0, [0.1, 0.1]), [-1.0, -1.0]);
        assert_eq!(limits.window(-1.5, 0.0, [0.01, 0.01]), [0.1, 0.1]);
        // Moving outwards still, it slows down as fast as it may.
        assert_eq!(limits.window(1.5, 0.5, [0.01, 0.01]), [0.4, 0.4]);
        // A coordinate that is past a stop by rounding is at it.
        let [least, most] = limits.window(1.0 + f64::EPSILON, 0.0, [0.1, 0.1]);
        assert!(least == -1.0 && -1e-14 < most && most < 0.0);
    }

    /// With stops close together, a coordinate that comes back from past one does not pass the other.
    #[test]
    fn coming_back_ends_before_the_other_stop() {
        let limits = Limits { rate: 10.0, acceleration: 1e3, lower: 0.0, upper: 0.0 };
        assert_eq!(limits.window(0.25, 0.0, [0.1, 0.125]), [-2.0, -2.0]);
    }

    #[test]
    fn no_number_is_too_large() {
        let limits = Limits { rate: 1e300, acceleration: 1e-300, lower: -1e300, upper: 1e300 };
        let [least, most] = limits.window(0.0, 0.0, [1e-9, 1e-9]);
        assert!(least <= 0.0 && most >= 0.0 && most.is_finite());
    }
}
