//! Joints that are driven by torques, beside others whose rates are imposed (thesis 3.6).
//!
//! A driven joint i adds two states: its angle, and the angular momentum `K_i` about it of all that lies outboard,
//!
//! > `K_i`' = motor's torque + moments of weight and outer loads - velocity of the joint x momentum outboard
//!
//! which is continuous where imposed rates jump or a payload is taken over. Base velocity and rates of the driven
//! joints follow from momenta together. With c_i the column of `H_m`, M the joints' inertia on a base at rest, and
//! r the imposed rates:
//!
//! > h = `H_b v_b` + sum of c_j (r_j + `q_dot_j`),  `K_i` = c_i . `v_b` + sum of `M_ij` (r_j + `q_dot_j`)

mod advance;
mod butcher;
mod elimination;

use nalgebra::{SMatrix, SVector};

use super::integrated_state::IntegratedState;
use super::{Dynamics, Load, Node, Situation};
use crate::bytes::{Memory, Tape};
use crate::error::{Error, Result};
use crate::mechanics::momentum::{Twist, inertial_moments, outboard_drift, outboard_momentum};
use crate::mechanics::planar::{Vec2, cross};
use crate::parameters::{Actuation, Parameters};
use crate::pass;

/// A joint resists its torque if this share of the inertia outboard of it does not move with base and other joints.
const RESISTING: f64 = 1e-9;

/// Which joints are driven, and their part of the state.
#[derive(Debug, Clone, Copy)]
pub struct Driven<const N: usize> {
    joints: [bool; N],
    /// Angular momentum about each driven joint of all that lies outboard \[N m s\].
    momentum: SVector<f64, N>,
}

impl<const N: usize> Default for Driven<N> {
    fn default() -> Self {
        Self { joints: [false; N], momentum: SVector::zeros() }
    }
}

impl<const N: usize> Memory for Driven<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self { joints: _, momentum } = self;
        pass!(tape: momentum);
    }
}

/// Torques of the motors of driven joints during one step: `begin + slope * (time since its beginning)`.
#[derive(Debug, Clone, Copy)]
pub struct Torques<const N: usize> {
    /// At the beginning \[N m\].
    pub begin: SVector<f64, N>,
    /// Their slopes \[N m/s\].
    pub slope: SVector<f64, N>,
}

impl<const N: usize> Torques<N> {
    /// After the time `t` \[s\].
    fn after(&self, t: f64) -> SVector<f64, N> {
        self.begin + self.slope * t
    }

    /// Their impulse in the time `t` \[N m s\].
    fn impulse(&self, t: f64) -> SVector<f64, N> {
        (self.begin + self.slope * (0.5 * t)) * t
    }
}

impl<const N: usize> Driven<N> {
    /// The entries of the driven joints, 0 for all others.
    #[must_use]
    pub fn part(&self, of: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::from_fn(|i, _| if self.joints[i] { of[i] } else { 0.0 })
    }

    /// The entries of all coordinates whose rates are imposed, 0 for the driven joints.
    #[must_use]
    pub fn rest(&self, of: &SVector<f64, N>) -> SVector<f64, N> {
        of - self.part(of)
    }

    fn indices(&self) -> impl Iterator<Item = usize> {
        (0..N).filter(|&i| self.joints[i])
    }
}

impl<const N: usize> Dynamics<N> {
    /// The driven joints of `parameters`, at rest in `start`; none if all rates are imposed.
    ///
    /// # Errors
    /// If a driven joint has nothing to move that resists.
    #[inline(never)]
    pub fn driven(&self, parameters: &Parameters, start: &Situation<N>) -> Result<Option<Driven<N>>> {
        let is_driven = |i: usize| i < self.vehicle.links && parameters.joints[i].actuation == Actuation::Torque;
        let driven = Driven { joints: std::array::from_fn(is_driven), momentum: SVector::zeros() };
        let mut pivots = self.resistance(&start.node, &driven);
        elimination::solve(pivots.as_mut_slice(), &mut [0.0; N]);
        for i in driven.indices() {
            let pivot = pivots[(i, i)];
            // One that is not a number follows another that is 0.
            if pivot.is_nan() || pivot <= RESISTING * start.node.inertia(i, i) {
                return Err(Error::Inconsistent {
                    name: format!("joint[{}].actuation", i + 1),
                    expected: "rate, for what the joint moves has no inertia of its own against a torque".to_owned(),
                    found: "torque".to_owned(),
                });
            }
        }
        Ok(driven.joints.contains(&true).then_some(driven))
    }

    /// The payload has just been let go in `situation`, with its own momentum.
    pub fn release_driven(&self, situation: &Situation<N>, driven: &mut Driven<N>) {
        let Situation { node, state, .. } = situation;
        let all = outboard_momentum(&self.vehicle, &node.posture, state.held, situation.base(), &node.rate);
        driven.momentum = driven.part(&all);
    }

    /// How the momenta about the driven joints answer to their rates while the base gives way \[kg m2\]; 1 for
    /// all other coordinates.
    #[inline(never)]
    fn resistance(&self, node: &Node<N>, driven: &Driven<N>) -> SMatrix<f64, N, N> {
        let mut matrix = SMatrix::identity();
        for i in driven.indices() {
            let reaction = self.base_motion(node, Twist::ZERO, node.matrix.columns[i]);
            for j in driven.indices() {
                matrix[(i, j)] = node.inertia(i, j) + node.matrix.columns[j].dot(reaction);
            }
        }
        matrix
    }

    /// Rates of the driven joints from the part of `K_i` that neither imposed rates nor base explain: `share` is
    /// `K_i` less what imposed rates give on a base at rest, `base` the motion of the base without the rates in
    /// question. The same holds for accelerations and moments.
    #[inline(never)]
    fn driven_part(&self, node: &Node<N>, driven: &Driven<N>, share: &SVector<f64, N>, base: Twist) -> SVector<f64, N> {
        let missing = SVector::from_fn(|i, _| share[i] - node.matrix.columns[i].dot(base));
        let mut rates = driven.part(&missing);
        elimination::solve(self.resistance(node, driven).as_mut_slice(), rates.as_mut_slice());
        rates
    }

    /// Lets the driven joints of an arm that moves at imposed rates only move, too, such that the system has the
    /// momentum `h`, axes of the UAV frame, and `momentum` about the driven joints.
    #[inline(never)]
    fn move_driven(&self, node: &mut Node<N>, driven: &Driven<N>, h: Twist, momentum: &SVector<f64, N>) {
        let base = self.base_motion(node, h, node.arm);
        let links = 0..self.vehicle.links;
        let explained = |i: usize| links.clone().map(|j| node.inertia(i, j) * node.rate[j]).sum::<f64>();
        let explained = SVector::from_fn(|i, _| if driven.joints[i] { explained(i) } else { 0.0 });
        let rate = self.driven_part(node, driven, &(momentum - explained), base);
        node.move_at(&(node.rate + rate));
    }

    /// How fast the payload gives way to a unit impulse upwards \[1/kg\].
    #[inline(never)]
    fn payload_mobility(&self, node: &Node<N>, driven: &Driven<N>, up: Vec2) -> f64 {
        let place = node.posture.payload;
        let h = Twist { linear: up, angular: cross(place, up) };
        let momentum = SVector::from_fn(|i, _| cross(place - node.posture.joint[i], up));
        let mut node = *node;
        node.move_at(&SVector::zeros());
        self.move_driven(&mut node, driven, h, &momentum);
        node.velocity_at(&self.vehicle, place, self.base_motion(&node, h, node.arm)).dot(&up)
    }

    /// Accelerations of all coordinates \[rad/s2, m/s2\] at the end of a step of length `size` that ended in
    /// `situation`, from those that are imposed.
    #[must_use]
    #[inline(never)]
    pub fn slope_at_end(
        &self,
        situation: &Situation<N>,
        driven: &Driven<N>,
        imposed: &SVector<f64, N>,
        torques: &Torques<N>,
        size: f64,
        load: &Load,
    ) -> SVector<f64, N> {
        let Situation { state, node, .. } = situation;
        let (vehicle, posture, roll_rate) = (&self.vehicle, &node.posture, state.velocity.z);
        let (integrated, context) = (situation.integrated_state(self.base), Self::context(&situation.state));
        let mut rate = IntegratedState::ZERO;
        self.law_at(&mut rate, &integrated, node, situation.base(), load, &context);
        let base = self.base_acceleration(situation, self.loads_at_end(situation, &rate), imposed);

        let drift = outboard_drift(vehicle, posture, state.held, situation.base(), &node.rate);
        let kept = inertial_moments(vehicle, posture, state.held, roll_rate, &node.rate, imposed);
        let loads = self.outboard_load(node, &self.carrier(&integrated, &rate), state.held, load) + torques.after(size);
        imposed + self.driven_part(node, driven, &(loads - drift - kept), base)
    }
}

impl<const N: usize> Node<N> {
    /// Angular momentum about joint `i` per rate of joint `j`, on a base at rest \[kg m2\].
    fn inertia(&self, i: usize, j: usize) -> f64 {
        let (inner, outer) = (i.min(j), i.max(j));
        self.matrix.columns[outer].angular - self.posture.joint[inner].dot(&self.matrix.outboard_first(outer))
    }
}
