//! Where the status says that the path is kept (`ok`, `task_*`), the prediction at the end of the planned interval is on
//! the reference to 1e-6 m; where the interval took longer or shorter than planned, beyond that only as far as
//! `ik.late_miss` says afterwards.

use uam::parameters::PathAxes;

use super::{Check, Now};
use crate::case::Case;
use crate::draw::clock::Clock;

/// On the reference \[m\].
const NEAR: f64 = 1e-6;

pub struct Truth<'a> {
    case: &'a Case,
    /// The status at the last plan, if that is said to keep the path.
    kept: Option<&'static str>,
    /// How far the reference has moved since then beyond what was foreseen \[m\].
    unforeseen: f64,
    looked: bool,
}

impl<'a> Truth<'a> {
    pub fn of(case: &'a Case) -> Self {
        Self { case, kept: None, unforeseen: 0.0, looked: false }
    }

    /// Whether other laws hold since the plan of the interval that ends now: what was planned is not what happens.
    fn has_other_laws(&self, now: &Now<'_>, per_plan: usize) -> bool {
        let interval = now.count - per_plan..now.count;
        self.case.change.as_ref().is_some_and(|change| change.of_laws && interval.contains(&change.step))
    }

    /// Whether the interval that ends now took as long as it was planned for, and the payload did not come within.
    fn is_as_planned(&self, now: &Now<'_>, per_plan: usize) -> bool {
        let steps = &self.case.steps;
        let length = per_plan as f64 * steps.step;
        let grasp = self.case.parameters.payload.grasp_time;
        let grasped = per_plan > 1 && now.time - length < grasp && grasp < now.time;
        steps.clock == Clock::Even && (now.count > per_plan || steps.sample_time == length) && !grasped
    }
}

impl Check for Truth<'_> {
    fn name(&self) -> &'static str {
        "truth"
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let Some(per_plan) = self.case.steps.per_plan else { return Ok(()) };
        // Near a stop it is planned more often.
        if per_plan > 1 && self.case.has_stops() {
            return Ok(());
        }
        self.unforeseen += now.unforeseen;
        if !now.count.is_multiple_of(per_plan) {
            return Ok(());
        }
        let unforeseen = std::mem::take(&mut self.unforeseen);
        let status = now.seen.status();
        let before = std::mem::replace(&mut self.kept, now.seen.keeps_path().then_some(status));
        let Some(status) = before else { return Ok(()) };
        if self.has_other_laws(now, per_plan) {
            return Ok(());
        }
        let late = match now.seen.late_miss() {
            _ if self.is_as_planned(now, per_plan) => 0.0,
            Some(late) => late.abs(),
            None => return Ok(()),
        };
        self.looked = true;
        let [x, y] = now.seen.miss();
        let miss = match self.case.parameters.ik.path_axes {
            PathAxes::Both => (x * x + y * y).sqrt(),
            PathAxes::Horizontal => x.abs(),
        };
        if miss > NEAR + late + unforeseen {
            return Err(format!("{status}, but the planned end misses by {miss:.2e} m"));
        }
        Ok(())
    }

    fn looked(&self) -> bool {
        self.looked
    }
}
