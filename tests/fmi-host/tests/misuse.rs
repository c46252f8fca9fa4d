//! What hosts and users do wrong: `fmi2Error` and a message that names the thing; everybody else goes on.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::fs;

use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::Common;
use fmi::traits::FmiImport;
use fmi_host::{Messages, Slave, Unit};
use uam::Structure;

const STEP: f64 = 1e-2;

/// A plant at its first communication point with a rate.
fn running<'a>(plant: &'a Unit, name: &str) -> Slave<'a> {
    let mut slave = plant.instantiate(name);
    slave.initialize(0.0, None);
    slave.set("joint[1].rate_command", 0.5);
    slave
}

/// Ten steps on; all outputs.
fn go_on(slave: &mut Slave<'_>) -> Vec<(String, u64)> {
    for n in 0..10 {
        slave.step(f64::from(n) * STEP, STEP).unwrap();
    }
    slave.outputs()
}

/// Something is refused, before or after initialization, with all these words in the message; then the
/// instance behaves as if nothing had happened, and so does another.
fn refused(running_already: bool, words: &[&str], mistake: impl FnOnce(&mut Slave<'_>) -> bool) {
    let messages = Messages::listen();
    let plant = Unit::plant(Structure::DEFAULT);
    let expected = go_on(&mut running(&plant, "undisturbed"));

    let mut bystander = running(&plant, "bystander");
    let mut victim = if running_already { running(&plant, "victim") } else { plant.instantiate("victim") };
    assert!(mistake(&mut victim), "{words:?}: not refused");
    let said = messages.errors_of("victim");
    assert!(words.iter().all(|word| said.contains(word)), "{words:?} is not in: {said}");
    if !running_already {
        victim.initialize(0.0, None);
        victim.set("joint[1].rate_command", 0.5);
    }
    assert_eq!(go_on(&mut victim), expected, "{words:?}: the instance goes on");
    assert_eq!(go_on(&mut bystander), expected, "{words:?}: others are unharmed");
}

#[test]
fn values_out_of_bounds() {
    refused(false, &["uav.mass", "above 0", "-1"], |plant| plant.try_set("uav.mass", -1.0).is_err());
    refused(false, &["uav.inertia", "0"], |plant| plant.try_set("uav.inertia", 0.0).is_err());
    refused(false, &["link[2].length", "inf"], |plant| plant.try_set("link[2].length", f64::INFINITY).is_err());
    let rate = "joint[2].rate_command";
    refused(true, &[rate, "NaN"], |plant| plant.try_set(rate, f64::NAN).is_err());
    refused(true, &[rate, "-inf"], |plant| plant.try_set(rate, f64::NEG_INFINITY).is_err());
}

#[test]
fn unknown_enumeration_values_are_answered_with_the_known_ones() {
    for number in [0.0, 4.0, -1.0] {
        refused(false, &["autopilot.mode", "1 (pid)", "2 (ideal)", "3 (external)", &number.to_string()], |plant| {
            plant.try_set("autopilot.mode", number).is_err()
        });
    }
}

#[test]
fn one_wrong_value_among_many_changes_none() {
    refused(true, &["joint[3].rate_command", "NaN"], |plant| {
        let unit = Unit::plant(Structure::DEFAULT);
        let rates = [1, 2, 3].map(|n| unit.reference(&format!("joint[{n}].rate_command")));
        plant.instance.set_real(&rates, &[1.0, 2.0, f64::NAN]).is_err()
    });
}

#[test]
fn what_cannot_be_set() {
    refused(true, &["uav.mass", "fixed"], |plant| plant.try_set("uav.mass", 5.0).is_err());
    refused(true, &["base.x", "output"], |plant| plant.try_set("base.x", 1.0).is_err());
    refused(false, &["time"], |plant| plant.try_set("time", 1.0).is_err());
    refused(true, &["123456"], |plant| plant.instance.set_real(&[123_456], &[0.0]).is_err());
    refused(true, &["123456"], |plant| plant.instance.get_real(&[123_456], &mut [0.0]).is_err());
    refused(true, &["gravity", "Real", "Boolean"], |plant| {
        let gravity = Unit::plant(Structure::DEFAULT).reference("gravity");
        plant.instance.get_boolean(&[gravity], &mut [0]).is_err()
    });
}

/// FMI 2.0, 4.2.4: the state machine of co-simulation.
#[test]
fn calls_out_of_order() {
    refused(false, &["fmi2DoStep", "instantiated"], |plant| plant.step(0.0, STEP).is_err());
    refused(false, &["fmi2ExitInitializationMode", "instantiated"], |plant| {
        plant.instance.exit_initialization_mode().is_err()
    });
    refused(false, &["fmi2Terminate", "instantiated"], |plant| plant.instance.terminate().is_err());
    refused(true, &["fmi2EnterInitializationMode", "initialized"], |plant| {
        plant.instance.enter_initialization_mode().is_err()
    });
    refused(true, &["fmi2SetupExperiment", "initialized"], |plant| {
        plant.instance.setup_experiment(None, 0.0, None).is_err()
    });
}

#[test]
fn a_step_in_initialization_mode() {
    let messages = Messages::listen();
    let plant = Unit::plant(Structure::DEFAULT);
    let mut slave = plant.instantiate("early");
    slave.instance.setup_experiment(None, 0.0, None).unwrap();
    slave.instance.enter_initialization_mode().unwrap();
    assert!(slave.step(0.0, STEP).is_err());
    let said = messages.errors_of("early");
    assert!(said.contains("fmi2DoStep") && said.contains("initialization mode"), "{said}");
    slave.instance.exit_initialization_mode().unwrap();
    slave.step(0.0, STEP).unwrap();
}

#[test]
fn steps_that_make_no_sense() {
    refused(true, &["communicationStepSize", "-0.01"], |plant| plant.step(0.0, -STEP).is_err());
    refused(true, &["communicationStepSize", "NaN"], |plant| plant.step(0.0, f64::NAN).is_err());
    refused(true, &["communicationStepSize", "inf"], |plant| plant.step(0.0, f64::INFINITY).is_err());
    refused(true, &["currentCommunicationPoint", "NaN"], |plant| plant.step(f64::NAN, STEP).is_err());
    refused(true, &["currentCommunicationPoint", "0.5"], |plant| plant.step(0.5, STEP).is_err());
}

#[test]
fn times_that_make_no_sense() {
    refused(false, &["startTime", "NaN"], |plant| plant.instance.setup_experiment(None, f64::NAN, None).is_err());
    refused(false, &["stopTime", "-1"], |plant| plant.instance.setup_experiment(None, 0.0, Some(-1.0)).is_err());
}

/// Parameters that are right one by one but do not go together are refused where they meet.
#[test]
fn the_controller_names_what_it_cannot_work_with() {
    let messages = Messages::listen();
    let controller = Unit::controller(Structure::DEFAULT);
    let mut slave = controller.instantiate("controller");
    assert!(slave.try_set("ik.resolution", 99.0).is_err());
    let said = messages.errors_of("controller");
    let words = ["ik.resolution", "1 (minimum_norm)", "3 (extended_jacobian)", "99"];
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
    assert!(slave.try_set("sample_time", 0.0).is_err());
    assert!(messages.errors_of("controller").contains("sample_time"));
    slave.initialize(0.0, None);
    slave.step(0.0, STEP).unwrap();
}

/// The GUID of the model description is that of the library, or there is no instance.
#[test]
fn a_wrong_guid() {
    let messages = Messages::listen();
    for unit in [Unit::plant(Structure::DEFAULT), Unit::controller(Structure::DEFAULT)] {
        let import = unit.import();
        let identifier = &import.model_description().co_simulation.as_ref().unwrap().model_identifier;
        let library = import.shared_lib_path(identifier).unwrap();
        let copy = tempfile::tempdir().unwrap();
        fs::create_dir_all(copy.path().join(library.parent().unwrap())).unwrap();
        fs::copy(import.archive_path().join(&library), copy.path().join(&library)).unwrap();
        let description = fs::read_to_string(import.archive_path().join("modelDescription.xml")).unwrap();
        let (right, wrong) = (&import.model_description().guid, "{01234567-89ab-4cde-8f01-23456789abcd}");
        let impostor = Fmi2Import::new(copy, &description.replace(right.as_str(), wrong)).unwrap();

        assert!(impostor.instantiate_cs("impostor", false, false).is_err());
        let said = messages.errors_of("impostor");
        assert!(said.contains("GUID") && said.contains(wrong) && said.contains(right.as_str()), "{said}");
        unit.instantiate("honest").initialize(0.0, None);
    }
}
