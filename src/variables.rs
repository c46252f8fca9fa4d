//! Tables of named variables: the one place where a variable is declared.
//!
//! A [`Table`] names the quantities inside a plain data structure `D` and says how to reach each of
//! them. Model descriptions, getters and setters, connections, reference documentation and parameter
//! files all derive from it, so that no name, unit or bound is written twice.

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

/// Type of a variable and the way to it inside the data structure `D`; the `usize` is the variable's
/// own [`Variable::index`] (the number of a joint or leg, from 0).
pub enum Kind<D> {
    /// A real number in SI units.
    Real {
        /// PhysicalUnit, with the unit in which hosts should display it.
        unit: &'static PhysicalUnit,
        /// Admissible values.
        bounds: Bounds,
        /// The way to the value.
        at: fn(&mut D, usize) -> &mut f64,
    },
    /// A truth value.
    Boolean {
        /// The way to the value.
        at: fn(&mut D, usize) -> &mut bool,
    },
    /// One of a closed set of named alternatives.
    Enumeration {
        /// The way to the value.
        at: fn(&mut D, usize) -> &mut dyn Choice,
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
    /// Of an output: always this number, 0 for one that changes at communication points only.
    Constant(f64),
    /// Of an output: what stands here, at the end of the finished step.
    At(fn(&mut D, usize) -> &mut f64),
    /// Of an input: for the coming step, a given one goes here.
    Given(fn(&mut D, usize, f64)),
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
    /// Number of the element that `kind` reaches, from 0.
    pub index: usize,
    /// For outputs: the parameters that decide the value at the end of initialization, in groups of beginnings
    /// of their names without indices (`link.mass` stands for every `link[i].mass`).
    pub initially_from: &'static [&'static [&'static str]],
    /// How it changes with time, if hosts may read that (outputs) or give it (inputs).
    pub derivative: Option<Derivative<D>>,
    /// Whether it is an output that is computed when the host asks for it.
    pub on_demand: bool,
}

impl<D> Variable<D> {
    /// The name without indices: `link.mass` for every `link[i].mass`.
    fn plain_name(&self) -> String {
        plain(&self.name)
    }

    /// The place of the value inside `data`, for real variables.
    pub fn real<'a>(&self, data: &'a mut D) -> Option<&'a mut f64> {
        match self.kind {
            Kind::Real { at, .. } => Some(at(data, self.index)),
            Kind::Boolean { .. } | Kind::Enumeration { .. } => None,
        }
    }

    /// Whether the initial value of this output depends on the parameter `name`.
    #[must_use]
    pub fn initially_depends_on(&self, name: &str) -> bool {
        let plain = plain(name);
        self.initially_from.iter().copied().flatten().any(|beginning| plain.starts_with(beginning))
    }
}

/// A name without its indices.
pub(crate) fn plain(name: &str) -> String {
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

    /// Says how variables, named without indices, change with time.
    pub fn differentiate(&mut self, derivatives: &[(&str, Derivative<D>)]) {
        for variable in &mut self.variables {
            let name = variable.plain_name();
            if let Some((_, derivative)) = derivatives.iter().find(|(candidate, _)| *candidate == name) {
                variable.derivative = Some(*derivative);
            }
        }
    }

    /// Says which outputs, named without indices, are computed when the host asks for one of them.
    pub fn postpone(&mut self, outputs: &[&str]) {
        for variable in &mut self.variables {
            variable.on_demand = outputs.contains(&variable.plain_name().as_str());
        }
    }

    /// For the position of every variable that is the derivative of another one: the position of that.
    pub fn integrals(&self, data: &mut D) -> Vec<(usize, usize)> {
        let mut place = |variable: &Variable<D>| variable.real(data).map(std::ptr::from_mut);
        let places: Vec<_> = self.variables.iter().map(&mut place).collect();
        let derivative = |(integral, variable): (usize, &Variable<D>)| match variable.derivative {
            Some(Derivative::At(at)) => {
                let wanted = Some(std::ptr::from_mut(at(data, variable.index)));
                places.iter().position(|place| *place == wanted).map(|position| (position, integral))
            }
            _ => None,
        };
        self.variables.iter().enumerate().filter_map(derivative).collect()
    }

    /// Declares parameters that are fixed once the simulation runs.
    pub fn fixed(&mut self) -> Group<'_, D> {
        self.group(Causality::Parameter, Variability::Fixed)
    }

    /// Declares parameters that may be changed during a simulation.
    pub fn tunable(&mut self) -> Group<'_, D> {
        self.group(Causality::Parameter, Variability::Tunable)
    }

    /// Declares continuous inputs.
    pub fn input(&mut self) -> Group<'_, D> {
        self.group(Causality::Input, Variability::Continuous)
    }

    /// Declares continuous outputs.
    pub fn output(&mut self) -> Group<'_, D> {
        self.group(Causality::Output, Variability::Continuous)
    }

    /// Declares variables of any causality and variability.
    pub fn group(&mut self, causality: Causality, variability: Variability) -> Group<'_, D> {
        Group { table: self, causality, variability, index: 0, initially_from: &[] }
    }
}

/// Declares, into a [`Table`], variables that share causality, variability and index.
pub struct Group<'a, D> {
    table: &'a mut Table<D>,
    causality: Causality,
    variability: Variability,
    index: usize,
    initially_from: &'static [&'static [&'static str]],
}

impl<D> Group<'_, D> {
    /// Sets the index (from 0) for the declarations that follow.
    #[must_use]
    pub fn at(mut self, index: usize) -> Self {
        self.index = index;
        self
    }

    /// Says which parameters decide the initial values of the outputs that follow; see
    /// [`Variable::initially_from`].
    #[must_use]
    pub fn initially_from(mut self, parameters: &'static [&'static [&'static str]]) -> Self {
        self.initially_from = parameters;
        self
    }

    /// Declares a real variable.
    pub fn real(
        &mut self,
        name: impl Into<String>,
        unit: &'static PhysicalUnit,
        bounds: Bounds,
        description: impl Into<String>,
        at: fn(&mut D, usize) -> &mut f64,
    ) -> &mut Self {
        self.declare(name.into(), description.into(), Kind::Real { unit, bounds, at })
    }

    /// Declares a Boolean variable.
    pub fn boolean(
        &mut self,
        name: impl Into<String>,
        description: impl Into<String>,
        at: fn(&mut D, usize) -> &mut bool,
    ) -> &mut Self {
        self.declare(name.into(), description.into(), Kind::Boolean { at })
    }

    /// Declares an enumeration variable.
    pub fn choice(
        &mut self,
        name: impl Into<String>,
        description: impl Into<String>,
        at: fn(&mut D, usize) -> &mut dyn Choice,
    ) -> &mut Self {
        self.declare(name.into(), description.into(), Kind::Enumeration { at })
    }

    fn declare(&mut self, name: String, description: String, kind: Kind<D>) -> &mut Self {
        self.table.variables.push(Variable {
            name,
            description,
            causality: self.causality,
            variability: self.variability,
            kind,
            index: self.index,
            initially_from: self.initially_from,
            derivative: None,
            on_demand: false,
        });
        self
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
