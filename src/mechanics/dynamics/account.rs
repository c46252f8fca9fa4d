//! Integrals that not everybody wants, beside those that the laws of motion integrate anyway.

use nalgebra::SVector;

use super::runge_kutta::Internal;
use super::{Dynamics, Loads, Node};

/// What to add up during a step, and where.
pub enum Account<'a, const N: usize> {
    /// What changes the momenta outboard.
    Outboard(&'a mut Outboard<N>),
    /// What changes the angular momentum of what the UAV carries.
    Carried(&'a mut Carried<N>),
}

impl<const N: usize> Account<'_, N> {
    /// The place for the next internal step; so far the arm has come to `node`.
    #[inline]
    pub(super) fn next(&mut self, dynamics: &Dynamics<N>, node: &Node<N>, loads: &Loads) -> &mut Internal<N> {
        match self {
            Self::Outboard(outboard) => outboard.next(dynamics, node, loads),
            Self::Carried(carried) => &mut carried.step,
        }
    }

    /// That internal step has been made, and the arm has come to `node`.
    #[inline]
    pub(super) fn made(&mut self, dynamics: &Dynamics<N>, node: &Node<N>, loads: &Loads) {
        if let Self::Carried(carried) = self
            && !dynamics.neglects_nothing()
        {
            carried.add(dynamics, node, loads);
        }
    }
}

/// For each coordinate, the impulse of what changes the momentum of what it moves, its motor excepted: moments about the
/// joint, or forces along the slide, of weight, outer loads and its own motion \[N m s, N s\].
///
/// What the last internal step gave is worked out when somebody asks for the sum, which few hosts do after every step:
/// it takes a fifth of the time of a step.
#[derive(Debug, Clone)]
pub struct Outboard<const N: usize> {
    /// Without the last internal step.
    sum: SVector<f64, N>,
    last: Internal<N>,
    /// Whether the last internal step is still to be added.
    pending: bool,
}

impl<const N: usize> Outboard<N> {
    /// Nothing so far; `node`: any arm.
    #[must_use]
    pub fn none(node: &Node<N>) -> Self {
        Self { sum: SVector::zeros(), last: Internal::none(node), pending: false }
    }

    /// Begins anew, with the impulse `sum`.
    pub fn restart(&mut self, sum: SVector<f64, N>) {
        (self.sum, self.pending) = (sum, false);
    }

    /// Adds an impulse.
    pub fn add(&mut self, impulse: &SVector<f64, N>) {
        self.sum += impulse;
    }

    #[inline]
    fn next(&mut self, dynamics: &Dynamics<N>, node: &Node<N>, loads: &Loads) -> &mut Internal<N> {
        if self.pending {
            self.sum = self.total(dynamics, node, loads);
        }
        self.pending = true;
        &mut self.last
    }

    /// The impulse up to the end of the step under these `loads`, with the arm at `node`.
    #[must_use]
    #[inline(never)]
    pub fn total(&self, dynamics: &Dynamics<N>, node: &Node<N>, loads: &Loads) -> SVector<f64, N> {
        let (mut sum, step) = (self.sum, &self.last);
        if self.pending {
            dynamics.by_simpson(step, node, loads, |node, carrier, load, weight| {
                sum += dynamics.outboard_load(node, carrier, step.held, load) * weight;
            });
        }
        sum
    }
}

/// The impulse of the moments of weight and outer loads on what the UAV carries, about the UAV's centre of mass, less
/// its velocity x momentum, as the moment model has it.
#[derive(Debug, Clone, Copy)]
pub struct Carried<const N: usize> {
    /// The impulse \[N m s\].
    pub sum: f64,
    step: Internal<N>,
}

impl<const N: usize> Carried<N> {
    /// Nothing so far; `node`: any arm.
    #[must_use]
    pub fn none(node: &Node<N>) -> Self {
        Self { sum: 0.0, step: Internal::none(node) }
    }

    #[inline(never)]
    fn add(&mut self, dynamics: &Dynamics<N>, node: &Node<N>, loads: &Loads) {
        let Self { sum, step } = self;
        dynamics.by_simpson(step, node, loads, |node, carrier, load, weight| {
            *sum += dynamics.carried_load(node, carrier, load) * weight;
        });
    }
}
