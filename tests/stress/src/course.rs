//! A run in a few numbers, by which others are judged.

use uam::parameters::PathAxes;

use crate::case::Case;
use crate::checks::Now;

/// How long before the end rates count as those of the end \[s\].
const LATE: f64 = 0.2;

/// What a run came to.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    /// Largest rate of a joint shortly before the end \[rad/s\].
    pub last_rate: f64,
    /// Largest rate of a joint \[rad/s\].
    pub rate: f64,
    /// Largest roll \[rad\].
    pub roll: f64,
    /// Largest distance of the predicted end effector from the reference at a communication point \[m\].
    pub miss: f64,
    /// Whether the status always said that the path is kept.
    pub kept: bool,
    /// Whether narrow limits or a way to be made good were still in the way shortly before the end.
    pub on_the_way: bool,
    /// Whether limits or the path kept the second task from what was wanted shortly before the end.
    pub contradicted: bool,
}

impl Default for Course {
    fn default() -> Self {
        Self { last_rate: 0.0, rate: 0.0, roll: 0.0, miss: 0.0, kept: true, on_the_way: false, contradicted: false }
    }
}

impl Course {
    /// Looks at a communication point of a run that takes `duration` \[s\].
    pub fn see(&mut self, case: &Case, duration: f64, now: &Now<'_>) {
        let seen = now.seen;
        let rate = seen.rates()[..case.structure.links].iter().fold(0.0_f64, |largest, rate| largest.max(rate.abs()));
        let [x, y] = seen.miss();
        let y = if case.parameters.ik.path_axes == PathAxes::Both { y } else { 0.0 };
        self.rate = self.rate.max(rate);
        // A prediction that leaves things out may believe that a UAV hovers which has turned over.
        self.roll = self.roll.max(seen.pose()[2].abs()).max(seen.observed()[2].abs());
        // The first plan is made before any step is known.
        if now.time > now.size {
            self.miss = self.miss.max((x * x + y * y).sqrt());
        }
        self.kept &= seen.keeps_path();
        if now.time > duration - LATE {
            self.last_rate = self.last_rate.max(rate);
            let limited = ["rate_limited", "path_limited", "catching_up"].contains(&seen.status());
            self.on_the_way |= limited && case.limits.are_narrow();
            self.contradicted |= ["task_damped", "task_limited"].contains(&seen.status());
        }
    }
}
