//! Random vehicles and inputs from one seed.

use nalgebra::Vector2;
use proptest::prelude::*;
use uam::autopilot::{AutopilotMode, Gains};
use uam::mechanics::dynamics::Load;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Balance, Link};
use uam::plant::Inputs;
use uam::{Parameters, Structure};

/// A sequence of pseudo-random numbers (splitmix64).
#[derive(Debug, Clone)]
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn about_zero(&mut self, size: f64) -> f64 {
        self.between(-size, size)
    }

    pub fn coin(&mut self) -> bool {
        self.unit() < 0.5
    }

    pub fn vector(&mut self, size: f64) -> Vector2<f64> {
        Vector2::new(self.about_zero(size), self.about_zero(size))
    }

    pub fn balance(&mut self) -> Balance {
        Balance::ALL[(self.between(0.0, 3.0) as usize).min(2)]
    }

    pub fn structure(&mut self) -> Structure {
        Structure::new((self.between(1.0, 7.0) as usize).min(6), self.balance()).unwrap()
    }

    /// A vehicle of the size of the thesis' with nothing symmetric about it; no support.
    pub fn parameters(&mut self, structure: Structure) -> Parameters {
        let mut p = default_parameters(structure);
        p.uav.mass = self.between(2.0, 6.0);
        p.uav.inertia = self.between(0.2, 0.6);
        (p.mount.x, p.mount.y) = (self.about_zero(0.1), self.about_zero(0.1));
        for link in &mut p.links {
            let length = self.between(0.05, 0.3);
            let com = self.between(-0.1, 1.1) * length;
            *link = Link { mass: self.between(0.1, 1.5), length, com, inertia: self.between(1e-4, 1e-2) };
        }
        for joint in &mut p.joints {
            joint.start = self.about_zero(3.0);
        }
        p.counterweight.mass = self.between(0.5, 2.5);
        p.counterweight.inertia = self.between(1e-4, 1e-2);
        p.counterweight.height = self.about_zero(0.1);
        p.counterweight.start = self.about_zero(0.2);
        p.balance_element.mass = self.between(0.5, 2.5);
        p.balance_element.inertia = self.between(1e-4, 1e-2);
        p.balance_element.com = self.about_zero(0.2);
        p.balance_element.start = self.about_zero(3.0);
        p.payload.mass = self.between(0.1, 1.0);
        p.payload.com = self.between(0.0, 0.3);
        p.support.stiffness = 0.0;
        p.autopilot.mode = AutopilotMode::Pid;
        p.autopilot.altitude =
            Gains { kp: self.between(10.0, 40.0), ki: self.between(1.0, 10.0), kd: self.between(5.0, 20.0) };
        p.autopilot.roll =
            Gains { kp: self.between(10.0, 40.0), ki: self.between(1.0, 30.0), kd: self.between(1.0, 4.0) };
        p
    }

    /// Rates and loads of every kind; thrust and torque of an external autopilot near hover.
    pub fn inputs(&mut self, structure: Structure) -> Inputs {
        let mut inputs = Inputs {
            load: Load {
                base_force: self.vector(3.0),
                base_torque: self.about_zero(0.5),
                tip_force: self.vector(2.0),
                tip_torque: self.about_zero(0.2),
                altitude: self.about_zero(0.1),
                roll: self.about_zero(0.05),
                thrust_feedforward: self.about_zero(5.0),
                thrust: self.between(40.0, 90.0),
                torque: self.about_zero(1.0),
            },
            ..Inputs::default()
        };
        self.new_rates(structure, &mut inputs);
        inputs
    }

    /// Other rates; a counterweight's fit its travel.
    pub fn new_rates(&mut self, structure: Structure, inputs: &mut Inputs) {
        for rate in &mut inputs.rate_command[..structure.coordinates()] {
            *rate = self.about_zero(2.0);
        }
        if structure.balance == Balance::Counterweight {
            inputs.rate_command[structure.links] *= 0.15;
        }
    }

    /// Slopes of the rates.
    pub fn new_slopes(&mut self, structure: Structure, inputs: &mut Inputs) {
        for slope in &mut inputs.acceleration_command[..structure.coordinates()] {
            *slope = self.about_zero(10.0);
        }
    }
}

/// A mode of the autopilot in which the base is free.
pub fn free_mode() -> impl Strategy<Value = AutopilotMode> {
    prop_oneof![Just(AutopilotMode::Pid), Just(AutopilotMode::External)]
}

/// Any mode of the autopilot.
pub fn any_mode() -> impl Strategy<Value = AutopilotMode> {
    prop_oneof![free_mode(), Just(AutopilotMode::Ideal)]
}
