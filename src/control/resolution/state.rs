//! What the resolution methods remember from one plan to the next.
//!
//! It is part of the saved state of the controller. A method reads it while a plan is made, as often as the plan is
//! iterated, and changes it once, when the plan is decided: so it does not depend on the number of iterations. A method
//! that has to remember something adds a field here, passes it, and says in [`MethodState::accept`] how it goes on.

use crate::bytes::{Memory, Tape};
use crate::control::qp::{self, Place, Places};

/// The memory of the methods; each uses its own part.
#[derive(Debug, Clone, Copy)]
pub(in crate::control) struct MethodState {
    /// `least_squares`: which rates were at their limits, the first guess for the next quadratic program.
    pub places: Places,
}

impl MethodState {
    /// Before the first plan.
    pub const START: Self = Self { places: qp::FREE };

    /// The plan for the coming interval is decided: its rates have these `places`.
    pub fn accept(&mut self, places: Places) {
        self.places = places;
    }
}

impl Memory for MethodState {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        let Self { places } = self;
        places.iter_mut().for_each(|place| tape.one_of(place, &Place::ALL));
    }
}
