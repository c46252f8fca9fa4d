//! Integrals that not everybody wants, beside those that the laws of motion integrate anyway.

use std::ops::{Add, Mul};

use nalgebra::SVector;

use super::law::{Flow, Node, Scene};
use super::runge_kutta::Internal;
use super::{Dynamics, Load};

/// What to add up during a step, and where.
pub enum Account<'a, const N: usize> {
    /// Nothing more.
    None,
    /// For each coordinate, of what changes the momentum of what it moves, its motor excepted: moments about
    /// the joint, or forces along the slide, of weight, outer loads and its own motion \[N m s, N s\].
    Outboard(&'a mut SVector<f64, N>),
    /// Of the moments of weight and outer loads on what the UAV carries, about the UAV's centre of mass, less
    /// its velocity x momentum, as the moment model has it \[N m s\].
    Carried(&'a mut f64),
}

impl<const N: usize> Dynamics<N> {
    /// Adds what the internal `step` of length `size` from `flow` and `node` gave.
    pub(super) fn enter(
        &self,
        account: &mut Account<'_, N>,
        flow: &Flow,
        node: &Node<N>,
        step: &Internal<N>,
        size: f64,
        scene: &Scene<'_, N>,
    ) {
        match account {
            Account::Outboard(sum) => {
                **sum +=
                    simpson(flow, node, step, size, scene, |y, node, load| self.outboard_load(y, node, load, scene));
            }
            Account::Carried(sum) if !self.carried_load_is_a_balance() => {
                **sum += simpson(flow, node, step, size, scene, |y, node, load| {
                    let v = self.base_velocity(y, self.arm_turn(y), node);
                    self.carried_load(y, node, v, load, scene)
                });
            }
            Account::None | Account::Carried(_) => {}
        }
    }
}

/// The integral of `load` over an internal step by Simpson's rule, of the order of the step itself; the state in
/// the middle comes from Hermite's cubic.
fn simpson<const N: usize, L: Add<Output = L> + Mul<f64, Output = L>>(
    flow: &Flow,
    node: &Node<N>,
    step: &Internal<N>,
    size: f64,
    scene: &Scene<'_, N>,
    load: impl Fn(&Flow, &Node<N>, &Load) -> L,
) -> L {
    let mut room = None;
    let [begin, middle, end] = scene.loads.at([scene.elapsed, size], &mut room);
    let [k_1, k_4] = &step.slopes;
    let halfway = (flow + step.flow) * 0.5 + (k_1 - k_4) * (0.125 * size);
    (load(flow, node, begin) + load(&halfway, &step.middle, middle) * 4.0 + load(&step.flow, &step.node, end))
        * (size / 6.0)
}
