//! What the `fmi` crate reads of the units, against what they answer.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::collections::HashSet;

use fmi::fmi2::instance::Common;
use fmi::fmi2::schema::{Causality, ScalarVariableElement};
use fmi::traits::FmiImport;
use fmi_host::Unit;
use uam::Structure;

fn both() -> [Unit; 2] {
    [Unit::controller(Structure::DEFAULT), Unit::plant(Structure::DEFAULT)]
}

#[test]
fn versions_and_identity() {
    for (unit, name) in both().iter().zip(["uam_controller", "uam_plant"]) {
        let description = unit.import().model_description();
        assert_eq!((description.fmi_version.as_str(), description.model_name.as_str()), ("2.0", name));
        assert!(description.model_exchange.is_none());
        assert_eq!(description.co_simulation.as_ref().unwrap().model_identifier, name);
        let slave = unit.instantiate("asked");
        assert_eq!((slave.instance.get_version(), slave.instance.get_types_platform()), ("2.0", "default"));
    }
}

/// The pick-up of thesis 4.3 takes 30 s at 1 ms.
#[test]
fn the_default_experiment_is_the_pick_up() {
    for unit in both() {
        let experiment = unit.import().model_description().default_experiment.as_ref().unwrap();
        assert_eq!((experiment.start_time(), experiment.stop_time(), experiment.step_size()), (0.0, 30.0, Some(1e-3)));
    }
}

/// Some importers mix up variables that share a value reference, even if their types differ.
#[test]
fn value_references_and_names_are_unique() {
    for unit in both() {
        let variables: Vec<_> = unit.import().model_description().get_model_variables().collect();
        let references: HashSet<u32> = variables.iter().map(|variable| variable.value_reference).collect();
        let names: HashSet<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
        assert_eq!((references.len(), names.len()), (variables.len(), variables.len()));
    }
}

#[test]
fn instances_begin_with_the_start_values_of_the_description() {
    for unit in both() {
        let mut slave = unit.instantiate("new");
        let mut compared = 0;
        for variable in unit.import().model_description().get_model_variables() {
            if let ScalarVariableElement::Real(real) = &variable.elem
                && let Some(start) = real.start
            {
                assert_eq!(slave.get(&variable.name).to_bits(), start.to_bits(), "{}", variable.name);
                compared += 1;
            }
        }
        assert!(compared > 30, "{compared} start values");
    }
}

/// FMI 2.0, 2.2.8: every output is listed in `Outputs`, and in `InitialUnknowns` as it is calculated.
#[test]
fn the_structure_lists_every_output() {
    for unit in both() {
        let description = unit.import().model_description();
        let outputs: Vec<u32> = (1..)
            .zip(description.get_model_variables())
            .filter(|(_, variable)| variable.causality == Causality::Output)
            .map(|(index, _)| index)
            .collect();
        let structure = &description.model_structure;
        let listed = |unknowns: &[fmi::fmi2::schema::Fmi2VariableDependency]| {
            unknowns.iter().map(|unknown| unknown.index).collect::<Vec<_>>()
        };
        assert_eq!(listed(&structure.outputs.unknowns), outputs);
        assert_eq!(listed(&structure.initial_unknowns.unknowns), outputs);
        assert!(structure.outputs.unknowns.iter().all(|unknown| unknown.dependencies.is_empty()));
    }
}

/// What is promised is there, and what is not there is refused with the name of the flag.
#[test]
fn capabilities_are_what_is_declared() {
    let messages = fmi_host::Messages::listen();
    for unit in both() {
        let flags = unit.import().model_description().co_simulation.as_ref().unwrap();
        assert_eq!(flags.can_handle_variable_communication_step_size, Some(true));
        assert_ne!(flags.can_be_instantiated_only_once_per_process, Some(true));
        assert_ne!(flags.needs_execution_tool, Some(true));

        let mut slave = unit.instantiate("able");
        slave.initialize(0.0, None);
        let state = slave.instance.get_fmu_state();
        assert_eq!(state.is_ok(), flags.can_get_and_set_fmu_state == Some(true));
        if state.is_err() {
            assert!(messages.errors_of("able").contains("canGetAndSetFMUstate"));
        }
        if flags.provides_directional_derivative != Some(true) {
            assert!(slave.instance.get_directional_derivative(&[0], &[0], &[1.0], &mut [0.0]).is_err());
            assert!(messages.errors_of("able").contains("providesDirectionalDerivative"));
        }
    }
}
