//! Tables of named variables: the one place where a variable is declared.
//!
//! A [`Table`] names the quantities inside a plain data structure `D` and says how to reach each of
//! them. Model descriptions, getters and setters, connections, reference documentation and parameter
//! files all derive from it, so that no name, unit or bound is written twice.

pub mod declare;
pub mod options;
pub mod unit;

use crate::variables::options::Choice;
use crate::variables::unit::PhysicalUnit;

/// The part a variable plays for whoever connects the unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    /// Set once by the user, or during a run if tunable.
    Parameter,
    /// Comes from outside at every communication point.
    Input,
    /// Computed by the unit.
    Output,
    /// Time.
    Independent,
}

/// When a variable may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variability {
    /// Never after initialization.
    Fixed,
    /// Between communication steps, by the user.
    Tunable,
    /// At communication points only.
    Discrete,
    /// At any time.
    Continuous,
}

/// The admissible values of a real variable, in SI units: all finite ones from the smallest on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    smallest: f64,
}

impl Bounds {
    /// Any finite value.
    pub const ANY: Self = Self { smallest: f64::MIN };
    /// Zero or more.
    pub const NON_NEGATIVE: Self = Self { smallest: 0.0 };
    /// More than zero. Denormal numbers do not count: a host may have told the processor to take them for zero.
    pub const POSITIVE: Self = Self { smallest: f64::MIN_POSITIVE };

    /// Whether `value` is finite and not below the bound.
    #[inline]
    #[must_use]
    pub fn admit(&self, value: f64) -> bool {
        self.smallest <= value && value <= f64::MAX
    }

    /// The lower bound, if there is one.
    #[must_use]
    pub fn min(&self) -> Option<f64> {
        (*self != Self::ANY).then_some(if self.min_excluded() { 0.0 } else { self.smallest })
    }

    /// Whether the lower bound itself is excluded.
    #[must_use]
    pub fn min_excluded(&self) -> bool {
        *self == Self::POSITIVE
    }
}

impl std::fmt::Display for Bounds {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let open = if self.min_excluded() { "above" } else { "at least" };
        match self.min() {
            None => write!(f, "a finite number"),
            Some(min) => write!(f, "a finite number, {open} {min}"),
        }
    }
}

/// How the value of one variable is reached inside the data structure `D`.
pub struct Access<D, T: ?Sized> {
    get: fn(&D, usize) -> &T,
    get_mut: fn(&mut D, usize) -> &mut T,
    index: usize,
}

impl<D, T: ?Sized> Access<D, T> {
    /// Access by two functions to the element with this `index`, from 0 (the number of a joint or leg).
    pub const fn new(get: fn(&D, usize) -> &T, get_mut: fn(&mut D, usize) -> &mut T, index: usize) -> Self {
        Self { get, get_mut, index }
    }

    /// The value inside `data`.
    #[inline]
    pub fn get<'a>(&self, data: &'a D) -> &'a T {
        (self.get)(data, self.index)
    }

    /// The value inside `data`, to be changed.
    #[inline]
    pub fn get_mut<'a>(&self, data: &'a mut D) -> &'a mut T {
        (self.get_mut)(data, self.index)
    }
}

impl<D, T: ?Sized> Clone for Access<D, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D, T: ?Sized> Copy for Access<D, T> {}

/// Type of a variable, and how its value is reached.
pub enum Kind<D> {
    /// A real number in SI units.
    Real {
        /// The unit, with the one in which hosts should display it.
        unit: &'static PhysicalUnit,
        /// Admissible values.
        bounds: Bounds,
        /// The value.
        at: Access<D, f64>,
    },
    /// A truth value.
    Boolean {
        /// The value.
        at: Access<D, bool>,
    },
    /// One of a closed set of named alternatives.
    Enumeration {
        /// The value.
        at: Access<D, dyn Choice>,
    },
}

impl<D> Clone for Kind<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Kind<D> {}

/// The first derivative of a real variable with respect to time.
pub enum Derivative<D> {
    /// Of an output: the variable at this position of the table.
    Variable(usize),
    /// Of an output: what this function reads, at the end of the finished step, given the variable's index.
    Read(fn(&D, usize) -> f64, usize),
    /// Of an input: for the coming step, this function takes a given one, after the variable's index.
    Given(fn(&mut D, usize, f64), usize),
}

impl<D> Clone for Derivative<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Derivative<D> {}

/// One named variable of a data structure `D`.
pub struct Variable<D> {
    /// Structured public name, for instance `joint[2].rate_command`; indices in names count from 1.
    pub name: String,
    /// One sentence for the user.
    pub description: String,
    /// The part it plays.
    pub causality: Causality,
    /// When it may change.
    pub variability: Variability,
    /// Type and access.
    pub kind: Kind<D>,
    /// For outputs: the parameters that decide the value at the end of initialization, in groups of beginnings
    /// of their names without indices (`link.mass` stands for every `link[i].mass`).
    pub initially_from: &'static [&'static [&'static str]],
    /// How it changes with time, if hosts may read that (outputs) or give it (inputs).
    pub derivative: Option<Derivative<D>>,
    /// Position of the variable whose derivative with respect to time this one is.
    pub derivative_of: Option<usize>,
    /// Whether it is an output that is computed when the host asks for it.
    pub on_demand: bool,
}

impl<D> Variable<D> {
    /// The value inside `data` of a real variable.
    pub fn real(&self, data: &D) -> Option<f64> {
        match self.kind {
            Kind::Real { at, .. } => Some(*at.get(data)),
            Kind::Boolean { .. } | Kind::Enumeration { .. } => None,
        }
    }

    /// Whether the initial value of this output depends on the parameter `name`.
    #[must_use]
    pub fn initially_depends_on(&self, name: &str) -> bool {
        let plain = without_indices(name);
        self.initially_from.iter().copied().flatten().any(|beginning| plain.starts_with(beginning))
    }
}

fn without_indices(name: &str) -> String {
    name.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect()
}

/// An ordered list of variables of a data structure `D`.
pub struct Table<D> {
    variables: Vec<Variable<D>>,
}

impl<D> Default for Table<D> {
    fn default() -> Self {
        Self { variables: Vec::new() }
    }
}

impl<D> Table<D> {
    /// All variables in order of declaration.
    #[must_use]
    pub fn variables(&self) -> &[Variable<D>] {
        &self.variables
    }

    /// The variable with this public name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&Variable<D>> {
        self.variables.iter().find(|variable| variable.name == name)
    }

    /// Gives variables other names.
    pub fn rename(&mut self, name: impl Fn(&str) -> String) {
        for variable in &mut self.variables {
            variable.name = name(&variable.name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_admit_finite_numbers_from_their_ends_on() {
        let least = f64::MIN_POSITIVE;
        for bounds in [Bounds::ANY, Bounds::NON_NEGATIVE, Bounds::POSITIVE] {
            assert!([least, f64::MAX].into_iter().all(|value| bounds.admit(value)), "{bounds}");
            let beyond = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
            assert!(!beyond.into_iter().any(|value| bounds.admit(value)), "{bounds}");
        }
        let admitted = |value| [Bounds::ANY, Bounds::NON_NEGATIVE, Bounds::POSITIVE].map(|bounds| bounds.admit(value));
        assert_eq!([f64::MIN, -least].map(admitted), [[true, false, false]; 2]);
        assert_eq!([-0.0, 0.0, f64::from_bits(1)].map(admitted), [[true, true, false]; 3]);
    }

    #[test]
    fn bounds_are_described_by_the_ends_that_they_have() {
        let described = |bounds: Bounds| (bounds.min(), bounds.min_excluded(), bounds.to_string());
        assert_eq!(described(Bounds::ANY), (None, false, "a finite number".to_owned()));
        let (closed, open) = ("a finite number, at least 0".to_owned(), "a finite number, above 0".to_owned());
        assert_eq!(described(Bounds::NON_NEGATIVE), (Some(0.0), false, closed));
        assert_eq!(described(Bounds::POSITIVE), (Some(0.0), true, open));
    }
}
