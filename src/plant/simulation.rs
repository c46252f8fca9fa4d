//! The plant: laws of motion, payload and the observation of forces, for `N` coordinates.

use nalgebra::SVector;

use super::means::Means;
use super::{Inputs, Outputs, Rates, Simulation};
use crate::autopilot::AutopilotMode;
use crate::bytes::{Memory, Tape};
use crate::dynamics::{Driven, Dynamics, Load, Loads, Motion, Situation, Torques, Trace};
use crate::error::Result;
use crate::parameters::{BaseModel, Parameters, Structure};
use crate::planar::{Vec2, vec2};

/// An aerial manipulator with `N` coordinates, simulated.
#[derive(Debug, Clone)]
pub struct Plant<const N: usize> {
    dynamics: Dynamics<N>,
    situation: Situation<N>,
    means: Means<N>,
    /// Joints driven by torques, if there are any.
    driven: Option<Driven<N>>,
    /// Of the finished step.
    trace: Trace<N>,
}

impl<const N: usize> Plant<N> {
    /// At the start, at rest, without payload.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn new(structure: Structure, parameters: &Parameters) -> Result<Self> {
        let dynamics = Dynamics::new(structure, parameters, BaseModel::Full)?;
        let situation = dynamics.start(parameters);
        let driven = dynamics.driven(parameters, &situation)?;
        Ok(Self { dynamics, situation, means: Means::at_rest(), driven, trace: Trace::at_rest() })
    }

    fn write_state(&self, outputs: &mut Outputs) {
        let Situation { state, turn, node } = &self.situation;
        let tip = node.posture.end_effector;
        let tip_velocity = node.velocity_at(&self.dynamics.vehicle, tip, self.situation.base());
        outputs.pose = state.pose;
        outputs.velocity = state.velocity;
        outputs.position[..N].copy_from_slice(state.position.as_slice());
        outputs.rate[..N].copy_from_slice(state.rate.as_slice());
        outputs.end_effector = self.situation.place(tip);
        outputs.end_effector_velocity = turn.apply(tip_velocity);
        outputs.momentum = state.momentum;
        outputs.center_of_mass = self.situation.place(node.matrix.first / node.matrix.mass);
        outputs.attached = state.held;
    }
}

impl<const N: usize> Simulation for Plant<N> {
    fn initial_outputs(&self, outputs: &mut Outputs) {
        *outputs = Outputs::default();
        self.write_state(outputs);
        // What holds everything at rest.
        let (vehicle, node) = (&self.dynamics.vehicle, &self.situation.node);
        let weight = vec2(0.0, -node.matrix.mass * vehicle.gravity);
        let moment = -node.matrix.first.x * vehicle.gravity;
        let control = match self.dynamics.autopilot.mode {
            AutopilotMode::Ideal => vec2(-weight.y, -moment),
            AutopilotMode::Pid => vec2(-weight.y, 0.0),
            AutopilotMode::External => Vec2::zeros(),
        };
        (outputs.thrust, outputs.torque) = (control.x, control.y);
        outputs.transmitted_force = vec2(0.0, -vehicle.carried_mass() * vehicle.gravity);
        outputs.transmitted_moment = moment;
        for (effort, outboard) in outputs.effort.iter_mut().zip(&node.matrix.outboard_first) {
            *effort = outboard.x * vehicle.gravity;
        }
    }

    fn step(
        &mut self,
        parameters: &Parameters,
        inputs: &Inputs,
        t: f64,
        size: f64,
        outputs: &mut Outputs,
    ) -> Result<()> {
        self.dynamics.tune(&parameters.autopilot);
        match (self.situation.state.held, inputs.grasp) {
            (false, true) => self.dynamics.grasp(&mut self.situation),
            (true, false) => {
                self.means.release(&self.dynamics.vehicle, &self.situation);
                self.dynamics.release(&mut self.situation);
                if let Some(driven) = &mut self.driven {
                    self.dynamics.release_driven(&self.situation, driven);
                }
            }
            _ => {}
        }
        let mut motion = Motion {
            rate: SVector::from_fn(|i, _| inputs.rate_command[i]),
            slope: SVector::from_fn(|i, _| inputs.rate_slope(i)),
        };
        let loads =
            Loads { begin: load(inputs), slope: inputs.slopes.as_ref().and_then(|slopes| slopes.load.as_ref()) };
        let account = self.means.account();
        let (dynamics, situation, mut room) = (&self.dynamics, &mut self.situation, Load::NONE);
        let impulse = if let Some(driven) = &mut self.driven {
            let torques = Torques {
                begin: SVector::from_fn(|i, _| inputs.joint_torque_command[i]),
                slope: SVector::from_fn(|i, _| inputs.torque_slope(i)),
            };
            (motion.rate, motion.slope) = (driven.rest(&motion.rate), driven.rest(&motion.slope));
            let impulse = dynamics.advance_driven(situation, driven, &motion, &torques, &loads, t, size, account)?;
            let load = loads.present(size, &mut room);
            motion.slope = dynamics.slope_at_end(situation, driven, &motion.slope, &torques, size, load);
            impulse
        } else {
            dynamics.advance(situation, &motion, &loads, t, size, account)?
        };
        self.situation.state.check(t + size)?;

        self.write_state(outputs);
        let now = self.dynamics.at_end(&self.situation, &motion.slope, loads.present(size, &mut room));
        outputs.acceleration = now.acceleration;
        outputs.support_force = now.support;
        if !self.dynamics.on_carriage() {
            (outputs.thrust, outputs.torque) = (now.control.x, now.control.y);
        }
        self.trace = Trace {
            slope: motion.slope,
            acceleration: now.acceleration,
            control: self.dynamics.control_rate(&self.situation, &now.acceleration, &loads, size),
        };
        self.means.add(impulse, size);
        self.means.write(&self.dynamics, &self.situation, loads.present(0.5 * size, &mut room), outputs);
        outputs.check(t + size)
    }

    fn rates(&self) -> Rates {
        let now = self.dynamics.rates_at_end(&self.situation, &self.trace);
        let mut rates = Rates {
            end_effector_velocity: now.tip_velocity,
            thrust: self.trace.control.x,
            torque: self.trace.control.y,
            momentum: now.momentum,
            center_of_mass: self.situation.state.momentum.xy() / self.situation.node.matrix.mass,
            support_force: now.support,
            ..Rates::default()
        };
        rates.coordinates[..N].copy_from_slice(self.trace.slope.as_slice());
        rates
    }

    fn check_memory(&self) -> Result<()> {
        self.situation.state.check_memory()
    }

    fn clone_box(&self) -> Box<dyn Simulation> {
        Box::new(self.clone())
    }
}

impl<const N: usize> Memory for Plant<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self { dynamics: _, situation, means, driven, trace } = self;
        situation.pass(tape);
        means.pass(tape);
        if let Some(driven) = driven {
            driven.pass(tape);
        }
        trace.pass(tape);
    }
}

fn load(inputs: &Inputs) -> Load {
    Load {
        base_force: inputs.base_force,
        base_torque: inputs.base_torque,
        tip_force: inputs.end_effector_force,
        tip_torque: inputs.end_effector_torque,
        altitude: inputs.altitude_reference,
        roll: inputs.roll_reference,
        thrust_feedforward: inputs.thrust_feedforward,
        thrust: inputs.thrust_command,
        torque: inputs.torque_command,
    }
}
