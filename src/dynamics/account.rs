//! Integrals that not everybody wants, beside those that the laws of motion integrate anyway.

use nalgebra::SVector;

use super::Dynamics;
use super::law::{Node, Scene};
use super::runge_kutta::Internal;

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
    /// Adds what the internal `step` of length `size` from `node` gave.
    ///
    /// By Simpson's rule from what the stages of the step saw, those in the middle taken together: of order 4 like
    /// the step itself.
    #[inline]
    pub(super) fn enter(
        &self,
        account: &mut Account<'_, N>,
        node: &Node<N>,
        step: &Internal<N>,
        size: f64,
        scene: &Scene<'_, N>,
    ) {
        let mut room = None;
        let loads = scene.loads.at([scene.elapsed, size], &mut room);
        let weights = [size / 6.0, size * (2.0 / 3.0), size / 6.0];
        let instants = [node, &step.middle, &step.end].into_iter().zip(&step.carrier).zip(loads).zip(weights);
        match account {
            Account::Outboard(sum) => {
                for (((node, carrier), load), weight) in instants {
                    **sum += self.outboard_load(node, carrier, scene.held, load) * weight;
                }
            }
            Account::Carried(sum) if !self.carried_load_is_a_balance() => {
                for (((node, carrier), load), weight) in instants {
                    **sum += self.carried_load(node, carrier, load) * weight;
                }
            }
            Account::None | Account::Carried(_) => {}
        }
    }
}
