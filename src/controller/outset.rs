//! What a plan starts from, and what its methods share.

use nalgebra::SVector;

use super::limits::Allowed;
use super::prediction::Prediction;
use super::resolution::Resolver;
use super::response::Response;
use crate::bytes::{Memory, Tape};
use crate::dynamics::{Dynamics, Motion, Node, State};
use crate::parameters::Hold;
use crate::planar::Turn;
use crate::qp::{Place, Places};

/// The laws, the method and the present.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outset<const N: usize> {
    pub dynamics: Dynamics<N>,
    pub resolver: Resolver,
    pub hold: Hold,
    /// The prediction.
    pub now: Prediction<N>,
    /// Rates and accelerations sent.
    pub motion: Motion<N>,
    /// Rates of the three plans before, the last one first.
    pub before: [SVector<f64, N>; 3],
    /// Which rates are at their limits.
    pub places: Places,
}

impl<const N: usize> Outset<N> {
    /// What the limits allow in an interval of length `horizon` that begins now.
    pub fn allowed(&self, horizon: f64) -> Allowed {
        self.resolver.allowed(&self.dynamics.vehicle, &self.now.situation, &self.motion.rate, horizon)
    }

    /// How the system answers to the rates that the resolution may use, where the arm is at `node` and turned by
    /// `turn`, with the momentum of `state`.
    pub fn response(&self, node: &Node<N>, turn: Turn, state: &State<N>) -> Response<N> {
        let vehicle = &self.dynamics.vehicle;
        let response = Response::new(&self.dynamics, node, turn, state.momentum_in(turn));
        let held = vehicle.balancer.is_some() && !self.resolver.moves_balancer(vehicle);
        if held { response.holding(N - 1) } else { response }
    }
}

impl<const N: usize> Memory for Outset<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self { dynamics, resolver: _, hold: _, now, motion, before, places } = self;
        dynamics.pass_gains(tape);
        now.pass(tape);
        motion.pass(tape);
        before.pass(tape);
        places.iter_mut().for_each(|place| tape.one_of(place, &Place::ALL));
    }
}
