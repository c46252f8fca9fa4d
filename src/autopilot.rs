//! Hover control of altitude and roll (thesis 1.2.3).

use crate::memory;
use crate::options;

options! {
    #[doc = " How the hover is controlled."]
    pub enum AutopilotMode {
        #[doc = " PID laws for altitude and roll."]
        Pid = "pid",
        #[doc = " Perfect control of altitude and roll: the base slides along x only."]
        Ideal = "ideal",
        #[doc = " Thrust and torque are inputs of the plant; the controller predicts the pid laws."]
        External = "external",
    }
}

/// Gains of a PID law, SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Proportional gain.
    pub kp: f64,
    /// Integral gain.
    pub ki: f64,
    /// Derivative gain.
    pub kd: f64,
}

memory!(Gains { kp, ki, kd });

impl Gains {
    /// Upper estimate of the fastest rate at which the law answers with this mass or inertia in its loop \[1/s\].
    #[must_use]
    pub fn rate_on(&self, inertia: f64) -> f64 {
        (self.kd / inertia).max((self.kp / inertia).sqrt()).max(libm::cbrt(self.ki / inertia))
    }
}

/// Settings of the hover control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Autopilot {
    /// Kind of control.
    pub mode: AutopilotMode,
    /// Gains of the altitude control: N/m, N/(m s), N s/m.
    pub altitude: Gains,
    /// Gains of the roll control: N m/rad, N m/(rad s), N m s/rad.
    pub roll: Gains,
    /// Sample time \[s\]; 0: evaluated continuously, inside the integrator.
    pub sample_time: f64,
}
