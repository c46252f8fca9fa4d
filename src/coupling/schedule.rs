//! Communication points of a run.

/// Most steps that a run may have: what is recorded stays in memory.
pub const MOST_STEPS: f64 = 5e6;

/// A schedule that makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{name} must be {expected}, but is {found}")]
pub struct ScheduleError {
    /// Which number.
    pub name: &'static str,
    /// What is allowed.
    pub expected: String,
    /// The number.
    pub found: f64,
}

/// Times at which values are exchanged: t0 + n h, and the end, where a shorter step may be left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    start: f64,
    stop: f64,
    step: f64,
    whole_steps: u32,
    /// What is left after the whole steps; 0: nothing.
    rest: f64,
}

/// One communication step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Beginning \[s\].
    pub from: f64,
    /// Length \[s\].
    pub size: f64,
    /// End \[s\].
    pub to: f64,
}

impl Schedule {
    /// From `start` to `stop` in steps of `step` \[s\].
    ///
    /// # Errors
    /// If the times are not finite or in order, or there are too many steps.
    pub fn new(start: f64, stop: f64, step: f64) -> Result<Self, ScheduleError> {
        if !start.is_finite() {
            return Err(ScheduleError { name: "the start time", expected: "a finite number".into(), found: start });
        }
        let duration = stop - start;
        if !(duration.is_finite() && duration > 0.0) {
            let expected = format!("a finite number of seconds after the start at {start} s");
            return Err(ScheduleError { name: "the stop time", expected, found: stop });
        }
        let shortest = duration / MOST_STEPS;
        if !(step >= shortest && step <= duration) {
            let expected = format!(
                "a number of seconds from {shortest} to {duration} (the whole run, {MOST_STEPS} steps at most)"
            );
            return Err(ScheduleError { name: "the communication step", expected, found: step });
        }
        // A rest that comes from rounding is no step of its own.
        let whole = (duration / step + 1e-6).floor();
        let rest = duration - whole * step;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to MOST_STEPS")]
        let whole_steps = whole as u32;
        Ok(Self { start, stop, step, whole_steps, rest: if rest > 1e-6 * step { rest } else { 0.0 } })
    }

    /// Time of the start \[s\].
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Time of the end \[s\].
    #[must_use]
    pub fn stop(&self) -> f64 {
        self.stop
    }

    /// Length of a step \[s\].
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Number of steps.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.whole_steps as usize + usize::from(self.rest > 0.0)
    }

    /// All steps in order.
    pub fn intervals(&self) -> impl Iterator<Item = Interval> + use<> {
        let Self { start, stop, step, whole_steps, rest } = *self;
        let point = move |n: u32| start + f64::from(n) * step;
        let whole = (0..whole_steps).map(move |n| Interval { from: point(n), size: step, to: point(n + 1) });
        whole.chain((rest > 0.0).then(|| Interval { from: point(whole_steps), size: rest, to: stop }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_multiples_of_the_step() {
        let schedule = Schedule::new(1.0, 31.0, 1e-3).unwrap();
        let intervals: Vec<Interval> = schedule.intervals().collect();
        assert_eq!((intervals.len(), schedule.steps()), (30_000, 30_000));
        assert!(intervals.iter().all(|interval| interval.size == 1e-3));
        assert_eq!(intervals[12_345].from, 1.0 + 12_345.0 * 1e-3);
        assert_eq!(intervals[29_999].to, 31.0);
    }

    #[test]
    fn a_rest_gets_a_shorter_step() {
        let schedule = Schedule::new(0.0, 1.0, 0.3).unwrap();
        let intervals: Vec<Interval> = schedule.intervals().collect();
        assert_eq!(schedule.steps(), 4);
        assert!((intervals[3].size - 0.1).abs() < 1e-12);
        assert_eq!(intervals[3].to, 1.0);
    }

    #[test]
    fn says_what_is_allowed() {
        let refusal = |stop, step| Schedule::new(0.0, stop, step).unwrap_err().to_string();
        for step in [0.0, -1e-3, f64::NAN, f64::INFINITY, 1e-12, 31.0] {
            assert!(refusal(30.0, step).contains("from 0.000006 to 30"), "{}", refusal(30.0, step));
        }
        for stop in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refusal(stop, 1e-3).contains("stop time"), "{}", refusal(stop, 1e-3));
        }
    }
}
