//! The wanted motion at the instants of a run, each worked out once.

use super::Inputs;
use crate::planar::Vec2;
use crate::reference::{Reference, ReferenceKind, Target};

/// The wanted motion at one instant, mostly at the end of the planned interval, where the next one begins.
#[derive(Debug, Clone)]
pub(super) struct Foreseen {
    reference: Reference,
    /// Where the end effector starts \[m\].
    pub origin: Vec2,
    /// The instant, from the start \[s\]; not a number: none yet, or the reference is external.
    time: f64,
    target: Target,
}

impl Foreseen {
    /// Nothing yet of the `reference` for an end effector that starts at `origin`.
    pub fn new(reference: Reference, origin: Vec2) -> Self {
        Self { reference, origin, time: f64::NAN, target: Target::AT_REST }
    }

    /// The wanted motion `ahead` \[s\] after time `t`, its displacement from the origin of the inertial frame; of an external
    /// reference, as the `inputs` say at time `t`.
    #[inline]
    pub fn at(&mut self, t: f64, ahead: f64, inputs: &Inputs) -> &Target {
        if self.time != t + ahead {
            self.work_out(t, ahead, inputs);
        }
        &self.target
    }

    #[inline(never)]
    fn work_out(&mut self, t: f64, ahead: f64, inputs: &Inputs) {
        let Self { reference, origin, time, target } = self;
        if reference.kind == ReferenceKind::External {
            let (v, a) = (inputs.velocity, inputs.acceleration);
            *target = Target {
                displacement: inputs.position + (v + a * (0.5 * ahead)) * ahead,
                velocity: v + a * ahead,
                acceleration: a,
            };
        } else {
            *time = t + ahead;
            // In place: a copy would have to wait until what is copied has left the processor's store buffer.
            reference.write(*origin, *time, target);
        }
    }

    /// The wanted acceleration at time `t`, the present one \[m/s2\].
    pub fn acceleration(&self, t: f64, inputs: &Inputs) -> Vec2 {
        match self.reference.kind {
            ReferenceKind::External => inputs.acceleration,
            ReferenceKind::Path | ReferenceKind::Circle => self.reference.at(t).acceleration,
        }
    }
}
