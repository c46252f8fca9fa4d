//! What a unit shows to the world, as plain data: the one source of every file that describes it.

use uam::fmi::v2::Capabilities;
use uam::fmi::{Model, Naming, start_file};
use uam::variables::declare::Part;
use uam::variables::options::Item;
use uam::variables::unit::PhysicalUnit;
use uam::variables::{self, Bounds, Causality, Kind, Variability};
use uam::{Parameters, Structure};

use crate::package::design::{Design, Experiment};

/// A unit of a given structure.
#[derive(Debug, Clone)]
pub struct Interface {
    /// Model identifier, for instance `uam_plant`.
    pub identifier: &'static str,
    /// One sentence on what the unit does.
    pub description: &'static str,
    /// The structure in words.
    pub structure: String,
    /// How the variables are called.
    pub naming: Naming,
    /// What importers propose to simulate.
    pub experiment: Experiment,
    /// What the library must find in the resources; nothing if it knows the unit by itself.
    pub start_file: Option<String>,
    /// Identity: the host hands it back when it instantiates the unit.
    pub guid: String,
    /// What the unit can do.
    pub capabilities: Capabilities,
    /// All variables; the position is the value reference.
    pub variables: Vec<Variable>,
}

/// One variable of a unit.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Public name.
    pub name: String,
    /// One sentence for the user.
    pub description: String,
    /// The part it plays.
    pub causality: Causality,
    /// When it may change.
    pub variability: Variability,
    /// Type and start value.
    pub value: Value,
    /// For outputs: positions of the parameters that decide the initial value, ascending.
    pub initially_from: Vec<usize>,
    /// Position of the variable whose derivative with respect to time this one is.
    pub derivative_of: Option<usize>,
}

/// Type of a variable with the value it starts from.
#[derive(Debug, Clone, Copy)]
pub enum Value {
    /// A real number.
    Real {
        /// PhysicalUnit, with the unit for display.
        unit: &'static PhysicalUnit,
        /// Admissible values.
        bounds: Bounds,
        /// Start value.
        start: f64,
    },
    /// A truth value.
    Boolean {
        /// Start value.
        start: bool,
    },
    /// One of several named alternatives.
    Enumeration {
        /// The alternatives.
        options: Enumeration,
        /// Number of the start value, from 1.
        start: i32,
    },
}

/// A closed set of named alternatives.
#[derive(Debug, Clone, Copy)]
pub struct Enumeration {
    /// Name of the type.
    pub name: &'static str,
    /// What it decides.
    pub description: &'static str,
    /// The alternatives, numbered from 1.
    pub items: &'static [Item],
}

impl Interface {
    /// The interface of `M` in this design.
    #[must_use]
    pub fn of<M>(design: &Design) -> Self
    where
        M: Model<Structure = Structure>,
        M::Data: Part<Parameters>,
    {
        let unit = design.unit::<M>();
        let table = M::table(unit.structure);
        let is_parameter = |variable: &variables::Variable<M::Data>| variable.causality == Causality::Parameter;
        let variables = table
            .variables()
            .iter()
            .map(|variable| Variable {
                name: unit.naming.of(&variable.name),
                description: variable.description.clone(),
                causality: variable.causality,
                variability: variable.variability,
                value: Value::read(variable, &unit.start),
                initially_from: (0..)
                    .zip(table.variables())
                    .filter(|(_, other)| is_parameter(other) && variable.initially_depends_on(&other.name))
                    .map(|(position, _)| position)
                    .collect(),
                derivative_of: variable.derivative_of,
            })
            .collect();
        Self {
            identifier: M::IDENTIFIER,
            description: M::DESCRIPTION,
            structure: unit.structure.to_string(),
            naming: unit.naming,
            experiment: design.experiment,
            start_file: start_file::write(&unit),
            guid: unit.guid().to_string(),
            capabilities: Capabilities::of(&table),
            variables,
        }
    }

    /// Name of the unit's FMU.
    #[must_use]
    pub fn file_name(&self) -> String {
        format!("{}.fmu", self.identifier)
    }

    /// The variables of one causality with their positions.
    pub fn with(&self, causality: Causality) -> impl Iterator<Item = (usize, &Variable)> {
        self.variables.iter().enumerate().filter(move |(_, variable)| variable.causality == causality)
    }

    /// The outputs that are inputs of `other`, by name and type.
    pub fn outputs_for<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = &'a Variable> {
        self.in_common(Causality::Output, other, Causality::Input)
    }

    /// The variables of one causality that are variables of another causality in `other`, by name and type.
    pub fn in_common<'a>(
        &'a self,
        causality: Causality,
        other: &'a Self,
        there: Causality,
    ) -> impl Iterator<Item = &'a Variable> {
        let matches = |one: &Variable, other: &Variable| one.name == other.name && one.value.has_type_of(&other.value);
        let found = move |one: &&Variable| other.with(there).any(|(_, other)| matches(one, other));
        self.with(causality).map(|(_, variable)| variable).filter(found)
    }

    /// The units in use, each once, in order of first use.
    #[must_use]
    pub fn units(&self) -> Vec<&'static PhysicalUnit> {
        units_of(&self.variables)
    }

    /// The enumerations in use, each once, in order of first use.
    #[must_use]
    pub fn enumerations(&self) -> Vec<Enumeration> {
        let mut found: Vec<Enumeration> = Vec::new();
        for variable in &self.variables {
            if let Value::Enumeration { options, .. } = variable.value
                && !found.iter().any(|other| other.name == options.name)
            {
                found.push(options);
            }
        }
        found
    }
}

impl Variable {
    /// Whether the value comes from outside, and so has a start value that hosts may read and change.
    #[must_use]
    pub fn is_set_from_outside(&self) -> bool {
        matches!(self.causality, Causality::Parameter | Causality::Input)
    }
}

impl Value {
    fn read<D>(variable: &variables::Variable<D>, data: &D) -> Self {
        match variable.kind {
            Kind::Real { unit, bounds, at } => Self::Real { unit, bounds, start: *at.get(data) },
            Kind::Boolean { at } => Self::Boolean { start: *at.get(data) },
            Kind::Enumeration { at } => {
                let choice = at.get(data);
                Self::Enumeration {
                    options: Enumeration {
                        name: choice.type_name(),
                        description: choice.type_description(),
                        items: choice.items(),
                    },
                    start: choice.number(),
                }
            }
        }
    }

    /// Whether the start values are the same; both are of the same type.
    #[must_use]
    pub fn starts_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Real { start, .. }, Self::Real { start: other, .. }) => start == other,
            (Self::Boolean { start }, Self::Boolean { start: other }) => start == other,
            (Self::Enumeration { start, .. }, Self::Enumeration { start: other, .. }) => start == other,
            _ => false,
        }
    }

    /// Whether values of `self` and `other` can be exchanged without conversion.
    #[must_use]
    pub fn has_type_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Real { unit, .. }, Self::Real { unit: other, .. }) => unit == other,
            (Self::Boolean { .. }, Self::Boolean { .. }) => true,
            (Self::Enumeration { options, .. }, Self::Enumeration { options: other, .. }) => options.name == other.name,
            _ => false,
        }
    }
}

/// The units of these variables, each once, in order of first use.
pub fn units_of<'a>(variables: impl IntoIterator<Item = &'a Variable>) -> Vec<&'static PhysicalUnit> {
    let mut found: Vec<&'static PhysicalUnit> = Vec::new();
    for variable in variables {
        if let Value::Real { unit, .. } = variable.value
            && !found.iter().any(|other| other.name == unit.name)
        {
            found.push(unit);
        }
    }
    found
}
