//! Every call in every state.

use super::*;

const CALLS: [Call; 40] = [
    Call::SetDebugLogging,
    Call::SetupExperiment,
    Call::EnterInitializationMode,
    Call::ExitInitializationMode,
    Call::Terminate,
    Call::Reset,
    Call::GetReal,
    Call::GetInteger,
    Call::GetBoolean,
    Call::GetString,
    Call::SetReal,
    Call::SetInteger,
    Call::SetBoolean,
    Call::SetString,
    Call::DoStep,
    Call::CancelStep,
    Call::GetStatus,
    Call::GetRealStatus,
    Call::GetIntegerStatus,
    Call::GetBooleanStatus,
    Call::GetStringStatus,
    Call::SetRealInputDerivatives,
    Call::GetRealOutputDerivatives,
    Call::GetDirectionalDerivative,
    Call::GetFMUstate,
    Call::SetFMUstate,
    Call::FreeFMUstate,
    Call::SerializedFMUstateSize,
    Call::SerializeFMUstate,
    Call::DeSerializeFMUstate,
    Call::EnterEventMode,
    Call::NewDiscreteStates,
    Call::EnterContinuousTimeMode,
    Call::CompletedIntegratorStep,
    Call::SetTime,
    Call::SetContinuousStates,
    Call::GetDerivatives,
    Call::GetEventIndicators,
    Call::GetContinuousStates,
    Call::GetNominalsOfContinuousStates,
];

/// Calls with arguments that are right if the call is; `state`: one of the same unit.
fn call(call: Call, c: *mut c_void, state: *mut c_void) -> c_int {
    let (mut real, mut number, mut truth, mut text, mut none) = (0.0, 1, 1, null(), null_mut());
    let (mut size, mut bytes) = (0, [0; 1000]);
    let (real, number, truth) = (&raw mut real, &raw mut number, &raw mut truth);
    // SAFETY: the handle is good, and every list has one element or none.
    unsafe {
        match call {
            Call::SetDebugLogging => fmi2SetDebugLogging(c, 1, 0, null()),
            Call::SetupExperiment => fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0),
            Call::EnterInitializationMode => fmi2EnterInitializationMode(c),
            Call::ExitInitializationMode => fmi2ExitInitializationMode(c),
            Call::Terminate => fmi2Terminate(c),
            Call::Reset => fmi2Reset(c),
            Call::GetReal => fmi2GetReal(c, &vr::POSITION, 1, real),
            Call::GetInteger => fmi2GetInteger(c, &vr::DIRECTION, 1, number),
            Call::GetBoolean => fmi2GetBoolean(c, &vr::HELD, 1, truth),
            Call::GetString => fmi2GetString(c, null(), 0, &raw mut text),
            Call::SetReal => fmi2SetReal(c, &vr::RATE, 1, real),
            Call::SetInteger => fmi2SetInteger(c, &vr::FAULT, 1, number),
            Call::SetBoolean => fmi2SetBoolean(c, &vr::HOLD, 1, truth),
            Call::SetString => fmi2SetString(c, null(), 0, null()),
            Call::DoStep => fmi2DoStep(c, 0.0, 0.1, 1),
            Call::CancelStep => fmi2CancelStep(c),
            Call::GetStatus => fmi2GetStatus(c, 0, number),
            Call::GetRealStatus => fmi2GetRealStatus(c, 2, real),
            Call::GetIntegerStatus => fmi2GetIntegerStatus(c, 0, number),
            Call::GetBooleanStatus => fmi2GetBooleanStatus(c, 3, truth),
            Call::GetStringStatus => fmi2GetStringStatus(c, 1, &raw mut text),
            Call::SetRealInputDerivatives => fmi2SetRealInputDerivatives(c, &vr::RATE, 1, number, real),
            Call::GetRealOutputDerivatives => fmi2GetRealOutputDerivatives(c, &vr::POSITION, 1, number, real),
            Call::GetDirectionalDerivative => {
                fmi2GetDirectionalDerivative(c, &vr::POSITION, 1, &vr::RATE, 1, real, real)
            }
            Call::GetFMUstate => fmi2GetFMUstate(c, &raw mut none),
            Call::SetFMUstate => fmi2SetFMUstate(c, state),
            Call::FreeFMUstate => fmi2FreeFMUstate(c, &raw mut none),
            Call::SerializedFMUstateSize => fmi2SerializedFMUstateSize(c, state, &raw mut size),
            Call::SerializeFMUstate => fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), bytes.len()),
            Call::DeSerializeFMUstate => {
                assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), bytes.len()), OK);
                fmi2DeSerializeFMUstate(c, bytes.as_ptr(), bytes.len(), &raw mut none)
            }
            Call::EnterEventMode => fmi2EnterEventMode(c),
            Call::NewDiscreteStates => fmi2NewDiscreteStates(c, null_mut()),
            Call::EnterContinuousTimeMode => fmi2EnterContinuousTimeMode(c),
            Call::CompletedIntegratorStep => fmi2CompletedIntegratorStep(c, 1, truth, truth),
            Call::SetTime => fmi2SetTime(c, 0.0),
            Call::SetContinuousStates => fmi2SetContinuousStates(c, real, 1),
            Call::GetDerivatives => fmi2GetDerivatives(c, real, 1),
            Call::GetEventIndicators => fmi2GetEventIndicators(c, real, 1),
            Call::GetContinuousStates => fmi2GetContinuousStates(c, real, 1),
            Call::GetNominalsOfContinuousStates => fmi2GetNominalsOfContinuousStates(c, real, 1),
        }
    }
}

/// Whether the unit offers what the call is for.
fn offered(call: Call) -> bool {
    !matches!(call, Call::GetIntegerStatus | Call::GetDirectionalDerivative)
        && Phase::ALL.into_iter().any(|phase| call.allowed_in(phase))
}

#[test]
fn every_call_is_answered_in_every_state_as_the_table_says() {
    let host = Host::new();
    for phase in Phase::ALL {
        for what in CALLS {
            let (toy, other) = (host.at(phase), host.instantiate());
            let mut saved = null_mut();
            // SAFETY: the handle is good.
            assert_eq!(unsafe { fmi2GetFMUstate(other.handle, &raw mut saved) }, OK);
            let status = call(what, toy.handle, saved);
            let expected = if what.allowed_in(phase) && offered(what) { OK } else { ERROR };
            assert_eq!(status, expected, "{what} while {phase}: {:?}", host.messages());

            if expected == ERROR {
                let text = host.last().text;
                assert!(text.starts_with(&format!("{what}: ")), "{text}");
                if offered(what) {
                    assert!(text.contains(&format!("\"{phase}\"")), "{text}");
                }
                assert_eq!(toy.reset(), OK);
                toy.initialize();
                assert_eq!(toy.step(0.0, 0.1), OK, "still usable after {what} while {phase}");
            }
        }
    }
}

#[test]
fn parameters_may_be_set_before_or_after_setup_and_setup_may_be_left_out() {
    let host = Host::new();
    for order in ["set, setup", "setup, set", "set"] {
        let toy = host.instantiate();
        for call in order.split(", ") {
            let status = match call {
                "set" => toy.set_real(&[vr::GAIN, vr::RATE], &[5.0, 0.0]),
                // SAFETY: the handle is good.
                _ => unsafe { fmi2SetupExperiment(toy.handle, 1, 1e-6, 0.0, 1, 10.0) },
            };
            assert_eq!(status, OK);
        }
        // SAFETY: the handle is good.
        unsafe {
            assert_eq!(fmi2EnterInitializationMode(toy.handle), OK);
            assert_eq!(toy.real(vr::POSITION), 5.0, "{order}");
            assert_eq!(fmi2ExitInitializationMode(toy.handle), OK);
        }
        assert_eq!(toy.real(vr::POSITION), 5.0, "{order}");
    }
}
