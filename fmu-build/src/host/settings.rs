//! The parameters of a run as the named values that a unit takes.

use uam::fmi::Model;
use uam::variables::declare::Part;
use uam::variables::{Causality, Kind};
use uam::{Parameters, Structure};

use crate::host::fmu::Value;
use crate::package::design::Design;
use crate::package::interface::{Interface, Variable};

/// Every parameter of the unit `M` with its value in `parameters`, in the order of the unit's table.
#[must_use]
pub fn named_values<M>(structure: Structure, parameters: &Parameters) -> Vec<(String, Value)>
where
    M: Model<Structure = Structure>,
    M::Data: Part<Parameters>,
{
    let mut data = M::start(structure);
    data.part_mut().clone_from(parameters);
    M::table(structure)
        .variables()
        .iter()
        .filter(|variable| variable.causality == Causality::Parameter)
        .map(|variable| {
            let value = match variable.kind {
                Kind::Real { at, .. } => Value::Real(*at.get(&data)),
                Kind::Boolean { at } => Value::Boolean(*at.get(&data)),
                Kind::Enumeration { at } => Value::Integer(at.get(&data).number()),
            };
            (variable.name.clone(), value)
        })
        .collect()
}

/// The parameters of the unit `M` that differ from its start values, with the values of `parameters`.
#[must_use]
pub fn changes<M>(structure: Structure, parameters: &Parameters) -> Vec<Variable>
where
    M: Model<Structure = Structure>,
    M::Data: Part<Parameters>,
{
    let known = Design::from(structure);
    let own = Design { parameters: parameters.clone(), ..known.clone() };
    let [known, own] = [known, own].map(|design| Interface::of::<M>(&design).variables);
    own.into_iter()
        .zip(known)
        .filter(|(own, known)| own.causality == Causality::Parameter && !own.value.starts_like(&known.value))
        .map(|(own, _)| own)
        .collect()
}

#[cfg(test)]
mod tests {
    use uam::parameters::Resolution;
    use uam::scenarios;
    use uam::units::{controller::ControllerUnit, plant::PlantUnit};

    use super::*;

    #[test]
    fn values_are_those_of_the_parameters_not_the_start_values() {
        let structure = Structure::DEFAULT;
        let mut parameters = scenarios::default_parameters(structure);
        parameters.uav.mass = 7.5;
        parameters.ik.resolution = Resolution::MinimumNorm;
        let value = |values: &[(String, Value)], wanted: &str| {
            values.iter().find(|(name, _)| name == wanted).map(|(_, value)| *value)
        };
        let controller = named_values::<ControllerUnit>(structure, &parameters);
        let plant = named_values::<PlantUnit>(structure, &parameters);
        assert_eq!(value(&controller, "uav.mass"), Some(Value::Real(7.5)));
        assert_eq!(value(&plant, "uav.mass"), Some(Value::Real(7.5)));
        assert_eq!(value(&controller, "ik.resolution"), Some(Value::Integer(1)));
        assert_eq!(value(&plant, "ik.resolution"), None);
        assert_eq!(value(&plant, "base.x"), None);
    }
}
