//! One internal step where joints are driven: an explicit Runge-Kutta method of order 6 (J. C. Butcher, J. Austral.
//! Math. Soc. 4 (1964) 179-194).
//!
//! Swinging links have nothing that damps them, so that errors add up; and every stage moves the arm, so that it
//! pays to need few of them. At a millisecond this order leaves nothing but rounding.

use nalgebra::SVector;

use super::{Driven, Torques};
use crate::mechanics::dynamics::Dynamics;
use crate::mechanics::dynamics::integrated_state::IntegratedState;
use crate::mechanics::dynamics::law::{Node, StepContext};
use crate::mechanics::kinematics::Displacement;
use crate::mechanics::momentum::Twist;

/// What the laws of motion integrate, or its rates.
#[derive(Debug, Clone, Copy)]
pub(super) struct DrivenState<const N: usize> {
    pub integrated: IntegratedState,
    /// Way of the driven joints since the beginning of the step \[rad\].
    pub way: SVector<f64, N>,
    /// Of what changes the momenta about the coordinates, besides their motors, since then \[N m s, N s\].
    pub outboard: SVector<f64, N>,
}

const STAGES: usize = 7;

/// Instants of the stages, in steps.
const NODES: [f64; STAGES] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0, 0.5, 0.5, 1.0];

/// Shares of the earlier stages in each stage.
const STAGE: [[f64; STAGES - 1]; STAGES] = [
    [0.0; 6],
    [1.0 / 3.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 2.0 / 3.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 12.0, 1.0 / 3.0, -1.0 / 12.0, 0.0, 0.0, 0.0],
    [-1.0 / 16.0, 9.0 / 8.0, -3.0 / 16.0, -3.0 / 8.0, 0.0, 0.0],
    [0.0, 9.0 / 8.0, -3.0 / 8.0, -3.0 / 4.0, 0.5, 0.0],
    [9.0 / 44.0, -9.0 / 11.0, 63.0 / 44.0, 18.0 / 11.0, 0.0, -16.0 / 11.0],
];

/// Shares of the stages in the step.
const STEP: [f64; STAGES] = [11.0 / 120.0, 0.0, 27.0 / 40.0, 27.0 / 40.0, -4.0 / 15.0, -4.0 / 15.0, 11.0 / 120.0];

impl<const N: usize> DrivenState<N> {
    /// At the beginning of a step.
    pub fn new(integrated: IntegratedState) -> Self {
        Self { integrated, way: SVector::zeros(), outboard: SVector::zeros() }
    }

    /// After a step of length `size` at the `rates` with these `shares`.
    fn after(mut self, rates: &[Self], shares: &[f64], size: f64) -> Self {
        for (rate, share) in rates.iter().zip(shares).filter(|(_, share)| **share != 0.0) {
            let time = share * size;
            self.integrated = self.integrated + rate.integrated * time;
            self.way += rate.way * time;
            self.outboard += rate.outboard * time;
        }
        self
    }
}

impl<const N: usize> Dynamics<N> {
    /// One step of length `size` from `driven_state`, where the arm is at `node`.
    pub(super) fn driven_step(
        &self,
        driven_state: &DrivenState<N>,
        node: &Node<N>,
        size: f64,
        context: &StepContext<'_, N>,
        (driven, torques): (&Driven<N>, &Torques<N>),
    ) -> (DrivenState<N>, Node<N>) {
        let arm = |at: &DrivenState<N>, t: f64| {
            let way = context.motion.way(t) + (at.way - driven_state.way);
            let mut there = *node;
            let way = Displacement::small(&self.vehicle, &way);
            there.follow(&self.vehicle, node, &way, context.held, &context.motion.rate_after(t));
            let momentum = driven.momentum + at.outboard + torques.impulse(context.elapsed + t);
            self.move_driven(&mut there, driven, self.momentum_in_uav(&at.integrated), &momentum);
            there
        };
        let mut room = None;
        let mut rates = [DrivenState::new(IntegratedState::ZERO); STAGES];
        for stage in 0..STAGES {
            let t = NODES[stage] * size;
            let at = driven_state.after(&rates[..stage], &STAGE[stage], size);
            let there = if stage == 0 { *node } else { arm(&at, t) };
            let load = context.loads.present(context.elapsed + t, &mut room);
            let mut integrated = IntegratedState::ZERO;
            self.law(&mut integrated, &at.integrated, &there, load, context);
            let outboard = self.outboard_load(&there, &self.carrier(&at.integrated, &integrated), context.held, load);
            rates[stage] = DrivenState { integrated, way: driven.part(&there.rate), outboard };
        }
        let mut end = driven_state.after(&rates, &STEP, size);
        end.integrated.align_rotation(&driven_state.integrated);
        let node = arm(&end, size);
        (end, node)
    }

    /// Momentum of the whole system in the axes of the UAV frame.
    pub(super) fn momentum_in_uav(&self, y: &IntegratedState) -> Twist {
        Twist { linear: self.arm_rotation(y).undo(y.momentum.xy()), angular: y.momentum.z }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::dynamics::{Loads, Motion};
    use crate::mechanics::planar::Vec2;
    use crate::parameters::defaults::default_parameters;
    use crate::parameters::{Actuation, BaseModel, Structure};

    /// The error after a fixed time falls by 2^6 when the steps are halved, on the real equations.
    #[test]
    fn halving_the_step_divides_the_error_by_sixty_four() {
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.mount.x = 0.05;
        for joint in [0, 2] {
            parameters.joints[joint].actuation = Actuation::Torque;
        }
        let dynamics = Dynamics::<3>::new(Structure::DEFAULT, &parameters, BaseModel::Full).unwrap();
        let start = dynamics.start(&parameters);
        let driven = dynamics.driven(&parameters, &start).unwrap().unwrap();
        let motion = Motion { rate: [0.0, -2.0, 0.0].into(), slope: [0.0, 3.0, 0.0].into() };
        let torques = Torques { begin: [0.1, 0.0, -0.05].into(), slope: [-0.4, 0.0, 0.3].into() };
        let loads = Loads::CALM;
        let end_in = |steps: u32| {
            let size = 0.3 / f64::from(steps);
            let (mut driven_state, mut node) = (DrivenState::new(start.integrated_state(BaseModel::Full)), start.node);
            node.move_at(&motion.rate);
            dynamics.move_driven(&mut node, &driven, Twist::ZERO, &SVector::zeros());
            for n in 0..steps {
                let elapsed = size * f64::from(n);
                let motion = motion.after(elapsed);
                let context =
                    StepContext { loads: &loads, elapsed, held: false, contact: false, sampled: Vec2::zeros(), motion };
                (driven_state, node) = dynamics.driven_step(&driven_state, &node, size, &context, (&driven, &torques));
            }
            (driven_state.integrated, driven_state.way)
        };
        let exact = end_in(600);
        let error = |steps| {
            let (integrated, way) = end_in(steps);
            integrated.distance(&exact.0).max((way - exact.1).amax())
        };
        let ratio = error(15) / error(30);
        assert!((50.0..80.0).contains(&ratio), "{ratio}");
    }
}
