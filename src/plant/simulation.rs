//! The plant: laws of motion, payload and the observation of forces, for `N` coordinates.

use nalgebra::SVector;

use super::means::{Interval, PreviousStep};
use super::{Inputs, OutputDerivatives, Outputs, Simulation};
use crate::bytes::{Memory, Tape};
use crate::error::Result;
use crate::mechanics::dynamics::{Driven, Dynamics, Instant, Loads, Motion, Situation, Torques};
use crate::memory;
use crate::parameters::{BaseModel, Parameters, Structure};
use crate::pass;

/// An aerial manipulator with `N` coordinates, simulated.
#[derive(Debug, Clone)]
pub struct Plant<const N: usize> {
    dynamics: Dynamics<N>,
    situation: Situation<N>,
    /// For the means.
    interval: Interval<N>,
    /// Joints driven by torques, if there are any.
    driven: Option<Driven<N>>,
    finished: Option<Finished<N>>,
}

/// What of a finished step decides what can be observed at its end, beside the state.
#[derive(Debug, Clone, Copy)]
struct Finished<const N: usize> {
    /// Accelerations of the coordinates at the end \[rad/s2, m/s2\].
    slope: SVector<f64, N>,
    /// What acted.
    previous_step: PreviousStep,
}

memory!(Finished<N> { slope, previous_step });

impl<const N: usize> Default for Finished<N> {
    fn default() -> Self {
        Self { slope: SVector::zeros(), previous_step: PreviousStep::NONE }
    }
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
        let interval = Interval::at_rest(&dynamics, &situation);
        Ok(Self { dynamics, situation, interval, driven, finished: None })
    }

    /// What can be said of the end of a step.
    fn at_end(&self, finished: &Finished<N>) -> Instant {
        let mut room = None;
        let load = finished.previous_step.loads().present(finished.previous_step.size, &mut room);
        self.dynamics.at_end(&self.situation, &finished.slope, load)
    }
}

/// What acted during the finished step, if there is one.
fn previous_step<const N: usize>(finished: &Option<Finished<N>>) -> &PreviousStep {
    finished.as_ref().map_or(&PreviousStep::NONE, |finished| &finished.previous_step)
}

impl<const N: usize> Simulation for Plant<N> {
    fn write_state(&self, outputs: &mut Outputs) {
        let state = &self.situation.state;
        outputs.pose = state.pose;
        outputs.velocity = state.velocity;
        outputs.position[..N].copy_from_slice(state.position.as_slice());
        outputs.rate[..N].copy_from_slice(state.rate.as_slice());
        outputs.momentum = state.momentum;
        outputs.attached = state.held;
    }

    fn tune(&mut self, parameters: &Parameters) {
        self.dynamics.tune(&parameters.autopilot);
    }

    fn step(&mut self, inputs: &Inputs, t: f64, size: f64, outputs: &mut Outputs) -> Result<()> {
        self.interval.begin(&self.dynamics, &self.situation, previous_step(&self.finished), size);
        match (self.situation.state.held, inputs.grasp) {
            (false, true) => self.dynamics.grasp(&mut self.situation),
            (true, false) => {
                self.interval.release(&self.dynamics.vehicle, &self.situation);
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
        let change = inputs.slopes.as_ref().and_then(|slopes| slopes.load.as_ref());
        let loads = Loads { begin: &inputs.load, slope: change };
        let account = self.interval.account();
        let (dynamics, situation) = (&self.dynamics, &mut self.situation);
        let impulse = if let Some(driven) = &mut self.driven {
            let torques = Torques {
                begin: SVector::from_fn(|i, _| inputs.joint_torque_command[i]),
                slope: SVector::from_fn(|i, _| inputs.torque_slope(i)),
            };
            (motion.rate, motion.slope) = (driven.rest(&motion.rate), driven.rest(&motion.slope));
            let impulse = dynamics.advance_driven(situation, driven, &motion, &torques, &loads, t, size, account)?;
            let mut room = None;
            let load = loads.present(size, &mut room);
            motion.slope = dynamics.slope_at_end(situation, driven, &motion.slope, &torques, size, load);
            impulse
        } else {
            dynamics.advance(situation, &motion, &loads, t, size, account)?
        };
        self.situation.state.check(t + size)?;
        self.interval.add(impulse, size);
        let previous_step = PreviousStep { begin: inputs.load, change: change.copied(), size };
        self.finished = Some(Finished { slope: motion.slope, previous_step });
        self.write_state(outputs);
        Ok(())
    }

    fn observe(&self, time: f64, outputs: &mut Outputs) -> Result<()> {
        let Situation { rotation, node, .. } = &self.situation;
        let tip = node.posture.end_effector;
        outputs.end_effector = self.situation.place(tip);
        outputs.end_effector_velocity = self.dynamics.velocity_at(node, *rotation, tip, self.situation.base());
        outputs.center_of_mass = self.situation.place(node.matrix.first / node.matrix.mass);
        self.interval.means(&self.dynamics, &self.situation, previous_step(&self.finished)).write(outputs);
        if let Some(finished) = &self.finished {
            let now = self.at_end(finished);
            outputs.acceleration = now.acceleration;
            outputs.support_force = now.support;
            if !self.dynamics.on_carriage() {
                (outputs.thrust, outputs.torque) = (now.control.x, now.control.y);
            }
        }
        outputs.check(time)
    }

    fn output_derivatives(&self) -> OutputDerivatives {
        let Some(finished) = &self.finished else { return OutputDerivatives::default() };
        let (Instant { acceleration, .. }, previous_step) = (self.at_end(finished), &finished.previous_step);
        let control =
            self.dynamics.control_rate(&self.situation, &acceleration, &previous_step.loads(), previous_step.size);
        let now = self.dynamics.rates_at_end(&self.situation, &finished.slope, &acceleration);
        let mut derivatives = OutputDerivatives {
            end_effector_velocity: now.tip_velocity,
            thrust: control.x,
            torque: control.y,
            momentum: now.momentum,
            center_of_mass: self.situation.state.momentum.xy() / self.situation.node.matrix.mass,
            support_force: now.support,
            ..OutputDerivatives::default()
        };
        derivatives.coordinates[..N].copy_from_slice(finished.slope.as_slice());
        derivatives
    }

    fn check_memory(&self) -> Result<()> {
        self.dynamics.check_gains()?;
        self.situation.state.check_memory()
    }

    fn clone_box(&self) -> Box<dyn Simulation> {
        Box::new(self.clone())
    }
}

impl<const N: usize> Memory for Plant<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self { dynamics, situation, interval, driven, finished } = self;
        dynamics.pass_gains(tape);
        pass!(tape: situation);
        interval.pass(dynamics, situation, previous_step(finished), tape);
        tape.settled(driven);
        pass!(tape: finished);
    }
}
