use proptest::prelude::*;

use super::*;
use crate::fmi::v2::c_types::Boolean;
use crate::fmi::v2::toy::{Size, Toy, vr};

type Result = std::result::Result<(), Error>;

fn new() -> Instance<Toy> {
    Instance::new(Identity::of(Size::Small))
}

fn running() -> Instance<Toy> {
    let mut toy = new();
    toy.enter_initialization().unwrap();
    toy.exit_initialization().unwrap();
    toy
}

fn real(toy: &mut Instance<Toy>, reference: u32) -> f64 {
    let mut value = [f64::NAN];
    toy.get(&[reference], &mut value).unwrap();
    value[0]
}

fn set(toy: &mut Instance<Toy>, reference: u32, value: f64) -> Result {
    toy.set(&[reference], &[value])
}

/// Everything that a host can see.
fn all(toy: &mut Instance<Toy>) -> Vec<f64> {
    (0..vr::COUNT).map(|reference| real(toy, reference)).collect()
}

fn message(result: Result) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn integrates() {
    let mut toy = running();
    set(&mut toy, vr::RATE, 2.0).unwrap();
    toy.do_step(0.0, 0.5).unwrap();
    toy.do_step(0.5, 0.25).unwrap();
    assert_eq!(real(&mut toy, vr::POSITION), 2.5);
    assert_eq!(real(&mut toy, vr::TIME), 0.75);
}

#[test]
fn setting_an_input_changes_no_output_before_the_next_step() {
    let mut toy = running();
    let before = real(&mut toy, vr::SPEED);
    set(&mut toy, vr::RATE, 2.0).unwrap();
    assert_eq!(real(&mut toy, vr::SPEED), before);
}

/// Of each communication point, whenever the host asks, and also in a saved state.
#[test]
fn outputs_on_demand_are_those_of_the_finished_step() {
    let mut toy = running();
    assert_eq!(real(&mut toy, vr::SQUARE), 1.0);
    set(&mut toy, vr::RATE, 2.0).unwrap();
    toy.do_step(0.0, 0.5).unwrap();
    set(&mut toy, vr::RATE, 4.0).unwrap();
    let saved = toy.save().unwrap();
    let bytes = toy.write_saved(&saved).unwrap();
    assert_eq!(real(&mut toy, vr::SQUARE), 4.0);
    toy.do_step(0.5, 0.25).unwrap();
    toy.do_step(0.75, 0.25).unwrap();
    assert_eq!(real(&mut toy, vr::SQUARE), 16.0);
    for saved in [saved, toy.read_saved(&bytes).unwrap()] {
        toy.restore(&saved).unwrap();
        assert_eq!(real(&mut toy, vr::SQUARE), 4.0);
    }
}

/// The rest can still be read; nothing that is not finite is handed out.
#[test]
fn outputs_without_a_value_are_an_error_once_and_the_simulation_is_over() {
    let mut toy = running();
    set(&mut toy, vr::RATE, 1e200).unwrap();
    toy.do_step(0.0, 1.0).unwrap();
    assert_eq!(real(&mut toy, vr::POSITION), 1e200);
    let found = message(toy.get(&[vr::SQUARE], &mut [0.0]));
    assert_eq!(found, format!("the outputs at t = 1 s: the square of {} is too large", 1e200));
    assert_eq!(toy.phase(), Phase::Failed);
    assert_eq!(real(&mut toy, vr::SQUARE), 1.0);
    assert!(toy.do_step(1.0, 1.0).is_err());
}

#[test]
fn outputs_follow_parameters_and_inputs_before_the_simulation() {
    let mut toy = new();
    assert_eq!(real(&mut toy, vr::POSITION), 1.0);
    set(&mut toy, vr::GAIN, 3.0).unwrap();
    assert_eq!(real(&mut toy, vr::POSITION), 3.0);
    toy.setup_experiment(5.0, None).unwrap();
    toy.enter_initialization().unwrap();
    toy.set(&[vr::HOLD], &[Boolean::TRUE]).unwrap();
    assert_eq!(real(&mut toy, vr::HELD), 1.0);
    set(&mut toy, vr::GAIN, 4.0).unwrap();
    toy.exit_initialization().unwrap();
    assert_eq!(real(&mut toy, vr::POSITION), 4.0);
    assert_eq!(real(&mut toy, vr::TIME), 5.0);
}

#[test]
fn inconsistent_parameters_block_outputs_only_and_can_be_corrected() {
    let mut toy = new();
    set(&mut toy, vr::GAIN, 7.0).unwrap();
    set(&mut toy, vr::LIMIT, 6.0).unwrap();
    assert_eq!(real(&mut toy, vr::GAIN), 7.0);
    assert_eq!(
        message(toy.get(&[vr::POSITION], &mut [0.0])),
        "the simulation cannot begin: gain = 7 is above limit = 6"
    );
    toy.enter_initialization().unwrap();
    assert_eq!(message(toy.exit_initialization()), "the simulation cannot begin: gain = 7 is above limit = 6");
    assert_eq!(toy.phase(), Phase::Initialization);
    assert_eq!(toy.now.data.position, 0.0, "nothing half-written");
    set(&mut toy, vr::LIMIT, 8.0).unwrap();
    toy.exit_initialization().unwrap();
    assert_eq!(real(&mut toy, vr::POSITION), 7.0);
}

#[test]
fn fixed_parameters_cannot_be_set_during_the_simulation_but_tunable_ones_can() {
    let mut toy = running();
    set(&mut toy, vr::LEAK, 0.5).unwrap();
    assert_eq!(
        message(set(&mut toy, vr::GAIN, 2.0)),
        "gain is a fixed parameter and cannot be set after initialization"
    );
    toy.do_step(0.0, 1.0).unwrap();
    assert_eq!(real(&mut toy, vr::POSITION), 0.5);
}

#[test]
fn refusals_name_the_variable_what_is_expected_and_what_was_found() {
    let mut toy = new();
    let reals = [
        (vr::GAIN, -1.0, "gain must be a finite number, above 0, but is -1"),
        (vr::RATE, f64::NAN, "rate must be a finite number, but is NaN"),
        (vr::RATE, f64::INFINITY, "rate must be a finite number, but is inf"),
        (vr::HOLD, 0.5, "hold must be 0 (false) or 1 (true), but is 0.5"),
        (vr::DIRECTION, 3.0, "direction must be 1 (up) or 2 (down), but is 3"),
        (vr::DIRECTION, 1.5, "direction must be 1 (up) or 2 (down), but is 1.5"),
        (vr::DIRECTION, f64::NAN, "direction must be 1 (up) or 2 (down), but is NaN"),
        (vr::FAULT, 0.0, "fault must be 1 (none), 2 (error) or 3 (panic), but is 0"),
        (vr::POSITION, 1.0, "position is an output and cannot be set"),
        (vr::TIME, 1.0, "time is the independent variable and cannot be set"),
        (vr::COUNT, 1.0, "no variable has the value reference 12; there are 0 to 11"),
    ];
    for (reference, value, expected) in reals {
        assert_eq!(message(set(&mut toy, reference, value)), expected);
    }
    assert_eq!(message(toy.set(&[vr::GAIN], &[1])), "gain is of type Real, not Integer or Enumeration");
    assert_eq!(message(toy.set(&[vr::HOLD], &[1])), "hold is of type Boolean, not Integer or Enumeration");
    assert_eq!(message(toy.set(&[vr::DIRECTION], &[0])), "direction must be 1 (up) or 2 (down), but is 0");
    assert_eq!(message(toy.set(&[vr::DIRECTION], &[Boolean::TRUE])), "direction is of type Enumeration, not Boolean");
    assert_eq!(message(toy.get(&[vr::GAIN], &mut [0])), "gain is of type Real, not Integer or Enumeration");
    assert_eq!(message(toy.get(&[vr::GAIN], &mut [Boolean::TRUE])), "gain is of type Real, not Boolean");
    assert_eq!(message(toy.no_text(Call::GetString, &[vr::GAIN])), "gain is of type Real, not String");
    toy.no_text(Call::GetString, &[]).unwrap();
    assert_eq!(all(&mut toy), all(&mut new()));
}

#[test]
fn booleans_and_enumerations_are_reached_by_their_own_type_and_by_real() {
    let mut toy = new();
    toy.set(&[vr::DIRECTION], &[2]).unwrap();
    toy.set(&[vr::HOLD], &[Boolean(-7)]).unwrap();
    let (mut number, mut truth) = ([0], [Boolean::FALSE]);
    toy.get(&[vr::DIRECTION], &mut number).unwrap();
    toy.get(&[vr::HOLD], &mut truth).unwrap();
    assert_eq!((number, truth), ([2], [Boolean::TRUE]));
    assert_eq!((real(&mut toy, vr::DIRECTION), real(&mut toy, vr::HOLD)), (2.0, 1.0));
    toy.set(&[vr::DIRECTION, vr::HOLD], &[1.0, 0.0]).unwrap();
    assert_eq!((real(&mut toy, vr::DIRECTION), real(&mut toy, vr::HOLD)), (1.0, 0.0));
}

#[test]
fn a_set_changes_all_or_nothing() {
    let mut toy = running();
    let before = all(&mut toy);
    let references = [vr::RATE, vr::LEAK, vr::HOLD, vr::GAIN];
    assert!(toy.set(&references, &[1.0, 2.0, 1.0, 3.0]).is_err());
    assert_eq!(all(&mut toy), before);
}

#[test]
fn steps_must_follow_each_other() {
    let mut toy = running();
    toy.do_step(0.0, 0.1).unwrap();
    assert_eq!(
        message(toy.do_step(0.2, 0.1)),
        "currentCommunicationPoint must be 0.1, where the last step ended, but is 0.2"
    );
    assert!(toy.do_step(0.0, 0.1).is_err(), "back");
    assert!(toy.do_step(f64::NAN, 0.1).is_err());
    for size in [-0.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let expected = format!("communicationStepSize must be a finite number, at least 0, but is {size}");
        assert_eq!(message(toy.do_step(0.1, size)), expected);
    }
    assert_eq!((toy.phase(), toy.time()), (Phase::Running, 0.1));
    toy.do_step(0.1 + 1e-9, 0.0).unwrap();
    assert_eq!(toy.time(), 0.1, "no step, no change");
    toy.do_step(0.100_000_000_01, 0.009_999_999_999_998_455).unwrap();
    assert_eq!(toy.time(), 0.100_000_000_01 + 0.009_999_999_999_998_455);
    toy.do_step(toy.time(), 1e-13).unwrap();
}

#[test]
fn the_last_step_may_end_after_the_stop_time_but_none_begins_there() {
    let mut toy = new();
    toy.setup_experiment(1.0, Some(2.0)).unwrap();
    toy.enter_initialization().unwrap();
    toy.exit_initialization().unwrap();
    toy.do_step(1.0, 0.75).unwrap();
    toy.do_step(1.75, 0.75).unwrap();
    assert_eq!(message(toy.do_step(2.5, 0.75)), "currentCommunicationPoint must be at most stopTime = 2, but is 2.5");
}

#[test]
fn experiments_may_be_repeated_but_must_make_sense() {
    let mut toy = new();
    toy.setup_experiment(3.0, Some(3.0)).unwrap();
    toy.setup_experiment(4.0, None).unwrap();
    assert_eq!(message(toy.setup_experiment(f64::NAN, None)), "startTime must be a finite number, but is NaN");
    assert_eq!(
        message(toy.setup_experiment(1.0, Some(0.5))),
        "stopTime must be finite and not before startTime = 1, but is 0.5"
    );
    assert_eq!(real(&mut toy, vr::TIME), 4.0);
}

#[test]
fn an_instance_with_a_failed_step_can_only_be_looked_at_ended_or_reset() {
    let mut toy = running();
    toy.set(&[vr::FAULT], &[2]).unwrap();
    assert_eq!(message(toy.do_step(0.0, 0.5)), "the step from t = 0 s by 0.5 s failed: told to fail");
    assert_eq!((toy.phase(), toy.time()), (Phase::Failed, 0.0));
    assert_eq!(message(toy.do_step(0.0, 0.5)), "not allowed in the state \"failed\"; allowed in: initialized");
    assert!(set(&mut toy, vr::RATE, 1.0).is_err());
    assert_eq!(real(&mut toy, vr::FAULT), 2.0);
    toy.terminate().unwrap();
    toy.terminate().unwrap();
    toy.reset();
    assert_eq!(all(&mut toy), all(&mut new()));
}

/// One call of a host.
#[derive(Debug, Clone)]
enum Action {
    Setup(f64),
    Enter,
    Exit,
    Set(u32, f64),
    Get(u32),
    Step(f64),
    Terminate,
}

fn action() -> impl Strategy<Value = Action> {
    prop_oneof![
        (-1.0..1.0).prop_map(Action::Setup),
        Just(Action::Enter),
        Just(Action::Exit),
        (0..vr::COUNT + 1, prop_oneof![-1.0..4.0, (0..4).prop_map(f64::from), Just(f64::NAN)])
            .prop_filter("panics are for the C layer", |(reference, value)| (*reference, *value) != (vr::FAULT, 3.0))
            .prop_map(|(reference, value)| Action::Set(reference, value)),
        (0..vr::COUNT + 1).prop_map(Action::Get),
        (0.0..0.1).prop_map(Action::Step),
        Just(Action::Terminate),
    ]
}

fn act(toy: &mut Instance<Toy>, action: &Action) -> std::result::Result<Option<f64>, Error> {
    let mut value = [0.0];
    match *action {
        Action::Setup(start) => toy.setup_experiment(start, None)?,
        Action::Enter => toy.enter_initialization()?,
        Action::Exit => toy.exit_initialization()?,
        Action::Set(reference, value) => set(toy, reference, value)?,
        Action::Get(reference) => {
            toy.get(&[reference], &mut value)?;
            return Ok(Some(value[0]));
        }
        Action::Step(size) => toy.do_step(toy.time(), size)?,
        Action::Terminate => toy.terminate()?,
    }
    Ok(None)
}

proptest! {
    #[test]
    fn a_reset_instance_is_as_new(before in prop::collection::vec(action(), 0..30),
                                  after in prop::collection::vec(action(), 0..30)) {
        let (mut used, mut new) = (new(), new());
        for action in &before {
            let _ = act(&mut used, action);
        }
        used.reset();
        for action in &after {
            prop_assert_eq!(format!("{:?}", act(&mut used, action)), format!("{:?}", act(&mut new, action)));
        }
    }

    #[test]
    fn a_refused_call_changes_nothing(actions in prop::collection::vec(action(), 0..60)) {
        let (mut toy, mut faultless) = (new(), new());
        for action in &actions {
            let result = act(&mut toy, action);
            let failed_step = matches!(result, Err(Error::Step { .. }));
            if result.is_ok() || failed_step {
                let _ = act(&mut faultless, action);
            }
            prop_assert_eq!(toy.phase(), faultless.phase());
            prop_assert_eq!(format!("{:?}", toy.now.data), format!("{:?}", faultless.now.data));
        }
    }
}
