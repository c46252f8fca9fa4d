//! The wanted motion at the instants of a run, each worked out once.

use super::Inputs;
use super::external::External;
use crate::bytes::{Memory, Tape};
use crate::mechanics::planar::Vec2;
use crate::pass;
use crate::reference::{Reference, ReferenceInstant, ReferenceKind, Target};

/// The wanted motion at one instant, mostly at the end of the planned interval, where the next one begins.
#[derive(Debug, Clone)]
pub(super) struct Foreseen {
    reference: Reference,
    /// Where the end effector starts \[m\].
    pub origin: Vec2,
    external: External,
    /// The instant, from the start \[s\]; not a number: none yet, or the reference is external.
    time: f64,
    target: Target,
}

impl Foreseen {
    /// Nothing yet of the `reference` for an end effector that starts at `origin`.
    pub fn new(reference: Reference, origin: Vec2) -> Self {
        Self { reference, origin, external: External::at_rest(origin), time: f64::NAN, target: Target::AT_REST }
    }

    /// Takes over the `inputs` of the communication step of length `size` from time `t` \[s\].
    pub fn take(&mut self, inputs: &Inputs, t: f64, size: f64) {
        if self.reference.kind == ReferenceKind::External {
            self.external.take(
                inputs,
                match self.reference.instant {
                    ReferenceInstant::StepStart => t,
                    ReferenceInstant::StepEnd => t + size,
                },
            );
        }
    }

    /// The wanted motion at time `t` \[s\], its displacement from the origin of the inertial frame.
    #[inline]
    pub fn at(&mut self, t: f64) -> &Target {
        if self.time != t {
            self.work_out(t);
        }
        &self.target
    }

    fn work_out(&mut self, t: f64) {
        let Self { reference, origin, external, time, target } = self;
        if reference.kind == ReferenceKind::External {
            *target = external.at(t);
        } else {
            *time = t;
            // In place: a copy would have to wait until what is copied has left the processor's store buffer.
            reference.write(*origin, *time, target);
        }
    }

    /// The wanted acceleration at time `t`, the present one \[m/s2\].
    pub fn acceleration(&self, t: f64) -> Vec2 {
        if self.reference.kind == ReferenceKind::External {
            self.external.acceleration()
        } else {
            self.reference.at(t).acceleration
        }
    }
}

impl Memory for Foreseen {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // All but what the host gives follows from the parameters.
        let Self { reference: _, origin: _, external, time, target: _ } = self;
        pass!(tape: external);
        *time = f64::NAN;
    }
}
