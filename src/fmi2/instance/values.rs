//! Values as hosts hand them over, and as variables hold them.
//!
//! Real numbers reach Boolean and enumeration variables too, because some hosts use nothing else:
//! 0 and 1 are false and true, an alternative is its number from 1.

use crate::fmi2::c_types::{Boolean, Integer, Real};
use crate::fmi2::error::Error;
use crate::fmi2::state::Call;
use crate::variables::{Kind, Variable};

/// A type in which hosts get and set variables.
pub trait Scalar: Copy {
    /// The function that gets.
    const GET: Call;
    /// The function that sets.
    const SET: Call;

    /// The value of a variable.
    ///
    /// # Errors
    /// If the variable cannot be read as this type.
    fn read<D>(variable: &Variable<D>, data: &mut D) -> Result<Self, Error>;

    /// What this value means for a variable. Changes nothing.
    ///
    /// # Errors
    /// If the variable cannot be set by this type or not to this value.
    fn admit<D>(self, variable: &Variable<D>, data: &mut D) -> Result<Admitted, Error>;
}

/// A value that a variable can take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Admitted {
    /// Inside the bounds of a real variable.
    Real(f64),
    /// For a Boolean variable.
    Boolean(bool),
    /// Number of an alternative of an enumeration.
    Alternative(i32),
}

impl Admitted {
    /// Gives the variable that admitted this value the value.
    pub fn assign<D>(self, variable: &Variable<D>, data: &mut D) {
        match (variable.kind, self) {
            (Kind::Real { at, .. }, Self::Real(value)) => *at(data, variable.index) = value,
            (Kind::Boolean { at }, Self::Boolean(value)) => *at(data, variable.index) = value,
            (Kind::Enumeration { at }, Self::Alternative(number)) => {
                at(data, variable.index).choose(number);
            }
            _ => {}
        }
    }
}

impl Scalar for Real {
    const GET: Call = Call::GetReal;
    const SET: Call = Call::SetReal;

    fn read<D>(variable: &Variable<D>, data: &mut D) -> Result<Self, Error> {
        Ok(match variable.kind {
            Kind::Real { at, .. } => *at(data, variable.index),
            Kind::Boolean { at } => f64::from(u8::from(*at(data, variable.index))),
            Kind::Enumeration { at } => f64::from(at(data, variable.index).number()),
        })
    }

    fn admit<D>(self, variable: &Variable<D>, data: &mut D) -> Result<Admitted, Error> {
        match variable.kind {
            Kind::Real { bounds, .. } if bounds.admit(self) => Ok(Admitted::Real(self)),
            Kind::Real { bounds, .. } => {
                Err(Error::OutOfBounds { name: variable.name.clone(), expected: bounds, found: self })
            }
            Kind::Boolean { .. } if self == 0.0 || self == 1.0 => Ok(Admitted::Boolean(self == 1.0)),
            Kind::Boolean { .. } => Err(Error::NotBoolean { name: variable.name.clone(), found: self }),
            Kind::Enumeration { .. } => alternative(self, variable, data),
        }
    }
}

impl Scalar for Integer {
    const GET: Call = Call::GetInteger;
    const SET: Call = Call::SetInteger;

    fn read<D>(variable: &Variable<D>, data: &mut D) -> Result<Self, Error> {
        match variable.kind {
            Kind::Enumeration { at } => Ok(at(data, variable.index).number()),
            _ => Err(mismatch(variable, "Integer or Enumeration")),
        }
    }

    fn admit<D>(self, variable: &Variable<D>, data: &mut D) -> Result<Admitted, Error> {
        match variable.kind {
            Kind::Enumeration { .. } => alternative(f64::from(self), variable, data),
            _ => Err(mismatch(variable, "Integer or Enumeration")),
        }
    }
}

impl Scalar for Boolean {
    const GET: Call = Call::GetBoolean;
    const SET: Call = Call::SetBoolean;

    fn read<D>(variable: &Variable<D>, data: &mut D) -> Result<Self, Error> {
        match variable.kind {
            Kind::Boolean { at } => Ok((*at(data, variable.index)).into()),
            _ => Err(mismatch(variable, "Boolean")),
        }
    }

    fn admit<D>(self, variable: &Variable<D>, _data: &mut D) -> Result<Admitted, Error> {
        match variable.kind {
            Kind::Boolean { .. } => Ok(Admitted::Boolean(self.holds())),
            _ => Err(mismatch(variable, "Boolean")),
        }
    }
}

/// The alternative with this number, if `found` is one of an enumeration variable.
fn alternative<D>(found: f64, variable: &Variable<D>, data: &mut D) -> Result<Admitted, Error> {
    let Kind::Enumeration { at } = variable.kind else {
        return Err(mismatch(variable, "Enumeration"));
    };
    let items = at(data, variable.index).items();
    let mut numbers = (1_i32..).take(items.len());
    numbers.find(|number| f64::from(*number) == found).map(Admitted::Alternative).ok_or_else(|| Error::NotAnItem {
        name: variable.name.clone(),
        items,
        found,
    })
}

/// The error for a variable that cannot be reached by the `requested` type.
pub fn mismatch<D>(variable: &Variable<D>, requested: &'static str) -> Error {
    let found = match variable.kind {
        Kind::Real { .. } => "Real",
        Kind::Boolean { .. } => "Boolean",
        Kind::Enumeration { .. } => "Enumeration",
    };
    Error::Type { name: variable.name.clone(), found, requested }
}
