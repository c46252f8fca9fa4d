//! How tables are written down: one row a variable.

use super::{Causality, Derivative, Kind, Table, Variability, Variable};

/// Data that has a part of type `P`, itself included: rows name places within one part.
pub trait Part<P> {
    /// The part.
    fn part(&self) -> &P;

    /// The part, to be changed.
    fn part_mut(&mut self) -> &mut P;
}

impl<D> Part<D> for D {
    fn part(&self) -> &D {
        self
    }

    fn part_mut(&mut self) -> &mut D {
        self
    }
}

/// Declares variables of one [`Group`], whose values are places within one part of the data, a row each:
///
/// ```text
/// declare! { table.output().at(i), Data;
///     "joint[{n}].rate" [RADIAN_PER_SECOND] "Rate of joint {n}"
///         |d, i| d.outputs.rate[i], derivative_of("joint[{n}].position"), on_demand();
/// }
/// ```
///
/// In brackets stands the unit of measure, with a bound of the values if there is one (`[SECOND > 0]`, `[METRE >= 0]`),
/// or else `[bool]` or `[choice]`; after the place, attributes, which are the methods of [`Row`]. Names and descriptions
/// take up variables around them, as `format!` does.
macro_rules! declare {
    ($group:expr, $part:ty;
     $($name:literal $kind:tt $description:literal
       |$data:ident, $index:pat_param| $place:expr $(, $attribute:ident($($argument:tt)*))*;)+) => {{
        let mut group = $group;
        $(
            group.row(
                ::std::fmt::format(::core::format_args!($name)),
                ::std::fmt::format(::core::format_args!($description)),
                $crate::variables::declare::kind!(
                    $kind
                    $crate::variables::Access::new(
                        |data, $index| {
                            let $data: &$part = $crate::variables::declare::Part::part(data);
                            &$place
                        },
                        |data, $index| {
                            let $data: &mut $part = $crate::variables::declare::Part::part_mut(data);
                            &mut $place
                        },
                        group.index(),
                    )
                ),
            )$(.$attribute($($argument)*))*;
        )+
    }};
}

/// The type that stands in brackets in a row of [`declare`].
macro_rules! kind {
    ([bool] $access:expr) => {
        $crate::variables::Kind::Boolean { at: $access }
    };
    ([choice] $access:expr) => {
        $crate::variables::Kind::Enumeration { at: $access }
    };
    ([$unit:ident > 0] $access:expr) => {
        $crate::variables::declare::kind!($unit POSITIVE $access)
    };
    ([$unit:ident >= 0] $access:expr) => {
        $crate::variables::declare::kind!($unit NON_NEGATIVE $access)
    };
    ([$unit:ident] $access:expr) => {
        $crate::variables::declare::kind!($unit ANY $access)
    };
    ($unit:ident $bounds:ident $access:expr) => {
        $crate::variables::Kind::Real {
            unit: &$crate::variables::unit::$unit,
            bounds: $crate::variables::Bounds::$bounds,
            at: $access,
        }
    };
}

pub(crate) use {declare, kind};

impl<D> Table<D> {
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

    /// Declares inputs that change at communication points only.
    pub fn discrete_input(&mut self) -> Group<'_, D> {
        self.group(Causality::Input, Variability::Discrete)
    }

    /// Declares continuous outputs.
    pub fn output(&mut self) -> Group<'_, D> {
        self.group(Causality::Output, Variability::Continuous)
    }

    /// Declares outputs that change at communication points only.
    pub fn discrete_output(&mut self) -> Group<'_, D> {
        self.group(Causality::Output, Variability::Discrete)
    }

    /// Declares the independent variable.
    pub fn independent(&mut self) -> Group<'_, D> {
        self.group(Causality::Independent, Variability::Continuous)
    }

    fn group(&mut self, causality: Causality, variability: Variability) -> Group<'_, D> {
        Group { table: self, causality, variability, index: 0 }
    }
}

/// Declares, into a [`Table`], variables that share causality, variability and index.
pub struct Group<'a, D> {
    table: &'a mut Table<D>,
    causality: Causality,
    variability: Variability,
    index: usize,
}

impl<D> Group<'_, D> {
    /// Sets the index (from 0) that the rows hand to their places.
    #[must_use]
    pub fn at(mut self, index: usize) -> Self {
        self.index = index;
        self
    }

    /// The index that the rows hand to their places.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Declares a variable.
    pub fn row(&mut self, name: String, description: String, kind: Kind<D>) -> Row<'_, D> {
        let position = self.table.variables.len();
        self.table.variables.push(Variable {
            name,
            description,
            causality: self.causality,
            variability: self.variability,
            kind,
            initially_from: &[],
            derivative: None,
            derivative_of: None,
            on_demand: false,
        });
        Row { variables: &mut self.table.variables, position, index: self.index }
    }
}

/// The variable declared last, to be given attributes.
pub struct Row<'a, D> {
    variables: &'a mut [Variable<D>],
    position: usize,
    index: usize,
}

impl<D> Row<'_, D> {
    /// It is the derivative of the output with this name, which is declared before it.
    pub fn derivative_of(self, name: impl AsRef<str>) -> Self {
        let integral = self.variables.iter().position(|variable| variable.name == name.as_ref());
        debug_assert!(integral.is_some(), "{} is declared before its derivative", name.as_ref());
        if let Some(integral) = integral {
            self.variables[integral].derivative = Some(Derivative::Variable(self.position));
            self.variables[self.position].derivative_of = Some(integral);
        }
        self
    }

    /// The derivative of this output, which is no variable itself, is read so.
    pub fn derivative(self, read: fn(&D, usize) -> f64) -> Self {
        let index = self.index;
        self.set(|variable| variable.derivative = Some(Derivative::Read(read, index)))
    }

    /// A host may give the derivative of this input, which is taken so.
    pub fn given_derivative(self, take: fn(&mut D, usize, f64)) -> Self {
        let index = self.index;
        self.set(|variable| variable.derivative = Some(Derivative::Given(take, index)))
    }

    /// Says which parameters decide the initial value of this output; see [`Variable::initially_from`].
    pub fn from(self, parameters: &'static [&'static [&'static str]]) -> Self {
        self.set(|variable| variable.initially_from = parameters)
    }

    /// This output is computed when the host asks for it.
    pub fn on_demand(self) -> Self {
        self.set(|variable| variable.on_demand = true)
    }

    fn set(self, change: impl FnOnce(&mut Variable<D>)) -> Self {
        change(&mut self.variables[self.position]);
        self
    }
}
