//! Values as hosts hand them over, and as variables hold them.
//!
//! Real numbers reach Boolean and enumeration variables too, because some hosts use nothing else:
//! 0 and 1 are false and true, an alternative is its number from 1.

use crate::fmi::v2::c_types::{Boolean, Integer, Real};
use crate::fmi::v2::error::Error;
use crate::fmi::v2::phase::Call;
use crate::variables::options::{Choice, Item};
use crate::variables::{Kind, Variable};

/// A type in which hosts get and set variables.
///
/// What is refused is asked for its reason afterwards: this way the many calls that are in order make no room
/// for an error.
pub trait Scalar: Copy {
    /// The function that gets.
    const GET: Call;
    /// The function that sets.
    const SET: Call;
    /// The types of variables that it gets and sets.
    const TYPES: &'static str;

    /// The value of a variable; `None` if the variable cannot be read as this type.
    fn read<D>(variable: &Variable<D>, data: &D) -> Option<Self>;

    /// Whether a variable can take this value.
    fn fits<D>(self, variable: &Variable<D>, data: &D) -> bool;

    /// Gives a variable that this value fits the value.
    fn assign<D>(self, variable: &Variable<D>, data: &mut D);

    /// Why it does not fit.
    fn refusal<D>(self, variable: &Variable<D>, data: &D) -> Error;
}

impl Scalar for Real {
    const GET: Call = Call::GetReal;
    const SET: Call = Call::SetReal;
    const TYPES: &'static str = "Real";

    #[inline]
    fn read<D>(variable: &Variable<D>, data: &D) -> Option<Self> {
        Some(match variable.kind {
            // Which zero comes out of `max` and `min` is left to each processor: hosts see the one without a sign.
            Kind::Real { at, .. } => *at.get(data) + 0.0,
            Kind::Boolean { at } => f64::from(u8::from(*at.get(data))),
            Kind::Enumeration { at } => f64::from(at.get(data).number()),
        })
    }

    #[inline]
    fn fits<D>(self, variable: &Variable<D>, data: &D) -> bool {
        match variable.kind {
            Kind::Real { bounds, .. } => bounds.admit(self),
            Kind::Boolean { .. } => self == 0.0 || self == 1.0,
            Kind::Enumeration { at } => alternative(self, at.get(data).items()).is_some(),
        }
    }

    #[inline]
    fn assign<D>(self, variable: &Variable<D>, data: &mut D) {
        match variable.kind {
            Kind::Real { at, .. } => *at.get_mut(data) = self,
            Kind::Boolean { at } => *at.get_mut(data) = self == 1.0,
            Kind::Enumeration { at } => choose(at.get_mut(data), self),
        }
    }

    #[cold]
    fn refusal<D>(self, variable: &Variable<D>, data: &D) -> Error {
        let name = variable.name.clone();
        match variable.kind {
            Kind::Real { bounds, .. } => Error::OutOfBounds { name, expected: bounds, found: self },
            Kind::Boolean { .. } => Error::NotBoolean { name, found: self },
            Kind::Enumeration { at } => Error::NotAnItem { name, items: at.get(data).items(), found: self },
        }
    }
}

impl Scalar for Integer {
    const GET: Call = Call::GetInteger;
    const SET: Call = Call::SetInteger;
    const TYPES: &'static str = "Integer or Enumeration";

    fn read<D>(variable: &Variable<D>, data: &D) -> Option<Self> {
        match variable.kind {
            Kind::Enumeration { at } => Some(at.get(data).number()),
            _ => None,
        }
    }

    fn fits<D>(self, variable: &Variable<D>, data: &D) -> bool {
        matches!(variable.kind, Kind::Enumeration { .. }) && f64::from(self).fits(variable, data)
    }

    fn assign<D>(self, variable: &Variable<D>, data: &mut D) {
        f64::from(self).assign(variable, data);
    }

    #[cold]
    fn refusal<D>(self, variable: &Variable<D>, data: &D) -> Error {
        match variable.kind {
            Kind::Enumeration { .. } => f64::from(self).refusal(variable, data),
            _ => mismatch(variable, Self::TYPES),
        }
    }
}

impl Scalar for Boolean {
    const GET: Call = Call::GetBoolean;
    const SET: Call = Call::SetBoolean;
    const TYPES: &'static str = "Boolean";

    fn read<D>(variable: &Variable<D>, data: &D) -> Option<Self> {
        match variable.kind {
            Kind::Boolean { at } => Some((*at.get(data)).into()),
            _ => None,
        }
    }

    fn fits<D>(self, variable: &Variable<D>, _data: &D) -> bool {
        matches!(variable.kind, Kind::Boolean { .. })
    }

    fn assign<D>(self, variable: &Variable<D>, data: &mut D) {
        if let Kind::Boolean { at } = variable.kind {
            *at.get_mut(data) = self.holds();
        }
    }

    #[cold]
    fn refusal<D>(self, variable: &Variable<D>, _data: &D) -> Error {
        mismatch(variable, Self::TYPES)
    }
}

/// The alternative with this number, from 1.
fn alternative(number: f64, items: &[Item]) -> Option<i32> {
    (1_i32..).take(items.len()).find(|candidate| f64::from(*candidate) == number)
}

fn choose(choice: &mut dyn Choice, number: f64) {
    if let Some(number) = alternative(number, choice.items()) {
        choice.choose(number);
    }
}

/// The error for a variable that cannot be reached by the `requested` type.
#[cold]
pub fn mismatch<D>(variable: &Variable<D>, requested: &'static str) -> Error {
    let found = match variable.kind {
        Kind::Real { .. } => "Real",
        Kind::Boolean { .. } => "Boolean",
        Kind::Enumeration { .. } => "Enumeration",
    };
    Error::Type { name: variable.name.clone(), found, requested }
}
