//! First derivatives of the inputs for one step, as far as they are given.

use super::Inputs;
use crate::mechanics::dynamics::Load;
use crate::memory;
use crate::parameters::MAX_COORDINATES;

/// How inputs change within one step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Slopes {
    /// Slopes of the rates, which replace the acceleration commands \[rad/s2, m/s2\].
    pub rate_command: [Option<f64>; MAX_COORDINATES],
    /// Slopes of the joints' torques \[N m/s\].
    pub joint_torque_command: [f64; MAX_COORDINATES],
    /// Slopes of loads and references per second, if any is given.
    pub load: Option<Load>,
}

memory!(Slopes { rate_command, joint_torque_command, load });

impl Inputs {
    /// Slope of the rate of a coordinate within the step \[rad/s2, m/s2\].
    #[must_use]
    pub fn rate_slope(&self, coordinate: usize) -> f64 {
        let given = self.slopes.as_ref().and_then(|slopes| slopes.rate_command[coordinate]);
        given.unwrap_or(self.acceleration_command[coordinate])
    }

    /// The place for the slope of a rate that replaces the acceleration command.
    pub fn given_rate_slope(&mut self, coordinate: usize) -> &mut Option<f64> {
        &mut self.slopes.get_or_insert_default().rate_command[coordinate]
    }

    /// Slope of the torque of a joint within the step \[N m/s\].
    #[must_use]
    pub fn torque_slope(&self, joint: usize) -> f64 {
        self.slopes.as_ref().map_or(0.0, |slopes| slopes.joint_torque_command[joint])
    }

    /// The place for the slope of a joint's torque.
    pub fn given_torque_slope(&mut self, joint: usize) -> &mut f64 {
        &mut self.slopes.get_or_insert_default().joint_torque_command[joint]
    }

    /// The place for the slopes of loads and references.
    pub fn given_load_slope(&mut self) -> &mut Load {
        self.slopes.get_or_insert_default().load.get_or_insert_default()
    }
}
