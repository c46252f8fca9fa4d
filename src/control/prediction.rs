//! The predicted system, as far as the coming plan starts from it.

use crate::bytes::{Memory, Tape};
use crate::error::{Error, Result};
use crate::mechanics::dynamics::{Carried, Dynamics, Situation};
use crate::mechanics::planar::Vec2;
use crate::pass;

/// A predicted instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prediction<const N: usize> {
    /// The system.
    pub situation: Situation<N>,
    /// Angular momentum of what the UAV carries, about the UAV's centre of mass, by the moment model \[N m s\].
    ///
    /// It does not follow from the situation at the instant when the payload is taken over, at rest: rates
    /// are those of just before, masses those of just after.
    pub carried: f64,
    /// The integration to here, of which nothing is remembered: kept for its room, which costs a tenth of a step to clear.
    pub integration: Carried<N>,
}

impl<const N: usize> Memory for Prediction<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        let Self { situation, carried, integration: _ } = self;
        pass!(tape: situation, carried);
    }
}

impl<const N: usize> Prediction<N> {
    /// At rest.
    pub fn at_rest(situation: Situation<N>) -> Self {
        Self { carried: 0.0, integration: Carried::none(&situation.node), situation }
    }

    /// Its situation is the end of a step: the angular momentum follows from it.
    pub fn end_step(&mut self, dynamics: &Dynamics<N>) {
        let Situation { node, rotation, state } = &self.situation;
        self.carried = dynamics.carried_angular(node, *rotation, self.situation.base(), node.arm, state.momentum.z);
    }

    /// Whether a controller can be here.
    ///
    /// # Errors
    /// Names the first quantity that it cannot have.
    pub fn check_memory(&self) -> Result<()> {
        if !self.carried.is_finite() {
            return Err(Error::Impossible { quantity: "carried angular momentum", value: self.carried });
        }
        self.situation.state.check_memory()
    }

    /// Where the end effector is \[m\].
    pub fn end_effector(&self) -> Vec2 {
        self.situation.place(self.situation.node.posture.end_effector)
    }
}
