//! Plant and prediction agree to 1e-9 in poses, positions and place of the end effector (1e-8 in velocities), where the
//! prediction leaves nothing out: base model full, all parameters the same.

use uam::autopilot::AutopilotMode;
use uam::parameters::BaseModel;

use super::{Check, Now};
use crate::case::Case;

/// Places \[m, rad\].
const NEAR: f64 = 1e-9;

/// Velocities of the base \[m/s, rad/s\].
const SLOW: f64 = 1e-8;

pub struct Prediction;

impl Prediction {
    pub fn of(case: &Case) -> Option<Self> {
        let p = &case.parameters;
        let whole = p.ik.base_model == BaseModel::Full || p.autopilot.mode == AutopilotMode::Ideal;
        whole.then_some(Self)
    }
}

impl Check for Prediction {
    fn name(&self) -> &'static str {
        "prediction"
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let pairs = now.seen.predicted().iter().zip(now.seen.observed());
        for (i, (predicted, observed)) in pairs.enumerate() {
            let near = if (3..6).contains(&i) { SLOW } else { NEAR };
            if (predicted - observed).abs() > near {
                let off = (predicted - observed).abs();
                return Err(format!("value {i} of base, coordinates and end effector is off by {off:.2e}"));
            }
        }
        Ok(())
    }
}
