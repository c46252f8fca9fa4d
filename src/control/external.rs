//! An external reference between the instants at which the host gives values of it.
//!
//! By the rule of FMI the inputs of a communication step are values of its beginning, so that the plan made at its end
//! needs them foreseen by that step and by the planned interval. That is exact for a constant acceleration, if
//! velocity and acceleration are given. What a host never gives, it leaves at 0: then it is taken from differences of
//! what it gives.

use super::Inputs;
use crate::mechanics::planar::Vec2;
use crate::memory;
use crate::reference::Target;

/// Differences are derivatives of a smooth motion where they change by at most this share of themselves from one to the
/// next. Otherwise they tell of a jump, or of a host that gives new values in some steps only.
const SMOOTH: f64 = 0.5;

/// The wanted motion as the host gives it.
#[derive(Debug, Clone, Copy)]
pub(super) struct External {
    /// The last value with its derivatives.
    latest: Target,
    /// When it was valid, from the start \[s\].
    time: f64,
    /// Velocity and acceleration have been given.
    given: [bool; 2],
    /// The change of what is differentiated since the value before, per time; and how long that took \[s\].
    slope: Vec2,
    interval: f64,
}

memory!(External { latest, time, given, slope, interval });

impl External {
    /// At rest at `origin` \[m\]: the host's values count from the first step on.
    pub fn at_rest(origin: Vec2) -> Self {
        Self {
            latest: Target { displacement: origin, ..Target::AT_REST },
            time: 0.0,
            given: [false; 2],
            slope: Vec2::zeros(),
            interval: 0.0,
        }
    }

    /// Takes over the `inputs`, which are values of the instant `t` \[s\].
    pub fn take(&mut self, inputs: &Inputs, t: f64) {
        let before = self.latest;
        let [velocity, acceleration] = &mut self.given;
        *acceleration |= inputs.acceleration != Vec2::zeros();
        *velocity |= *acceleration || inputs.velocity != Vec2::zeros();
        self.latest =
            Target { displacement: inputs.position, velocity: inputs.velocity, acceleration: inputs.acceleration };
        let elapsed = t - self.time;
        self.time = t;
        match self.given {
            [_, true] => {}
            [true, false] => {
                if let Some([rate, _]) = self.derivatives(inputs.velocity - before.velocity, elapsed) {
                    self.latest.acceleration = rate;
                }
            }
            [false, false] => {
                if let Some([rate, change]) = self.derivatives(inputs.position - before.displacement, elapsed) {
                    (self.latest.velocity, self.latest.acceleration) = (rate, change);
                }
            }
        }
    }

    /// First and second derivative, by a parabola through the last three values, of what has changed by `difference` in
    /// the time `elapsed` \[s\]; none where that is not smooth.
    fn derivatives(&mut self, difference: Vec2, elapsed: f64) -> Option<[Vec2; 2]> {
        if elapsed <= 0.0 {
            return None;
        }
        let (before, interval) = (self.slope, self.interval);
        (self.slope, self.interval) = (difference / elapsed, elapsed);
        let change = self.slope - before;
        if interval <= 0.0 || change.norm() > SMOOTH * self.slope.norm().max(before.norm()) {
            return None;
        }
        let second = change * (2.0 / (elapsed + interval));
        Some([self.slope + second * (0.5 * elapsed), second])
    }

    /// The wanted motion at time `t` \[s\].
    pub fn at(&self, t: f64) -> Target {
        self.latest.after(t - self.time)
    }

    /// Its acceleration, from the last value on \[m/s2\].
    pub fn acceleration(&self) -> Vec2 {
        self.latest.acceleration
    }
}
