//! The standard's state machine for co-simulation: which call is allowed when.

use std::fmt;

/// Where an instance stands between instantiation and release.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// New, or reset.
    Instantiated,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
    Initialization,
    /// At a communication point.
    Running,
    /// The simulation is over.
    Terminated,
    /// A step failed; its results mean nothing.
    Failed,
}

impl Phase {
    /// All states, in the order of the columns of the table in [`Call::allowed_in`].
    pub const ALL: [Self; 5] =
        [Self::Instantiated, Self::Initialization, Self::Running, Self::Terminated, Self::Failed];

    /// Whether the simulation has not begun: outputs follow from parameters and inputs.
    #[must_use]
    pub fn precedes_simulation(self) -> bool {
        matches!(self, Self::Instantiated | Self::Initialization)
    }
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Instantiated => "instantiated",
            Self::Initialization => "initialization mode",
            Self::Running => "initialized",
            Self::Terminated => "terminated",
            Self::Failed => "failed",
        })
    }
}

/// A function of the C interface that works on an instance; displayed by its name in C.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the C function of the same name")]
pub enum Call {
    SetDebugLogging,
    SetupExperiment,
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    GetReal,
    GetInteger,
    GetBoolean,
    GetString,
    SetReal,
    SetInteger,
    SetBoolean,
    SetString,
    DoStep,
    CancelStep,
    GetStatus,
    GetRealStatus,
    GetIntegerStatus,
    GetBooleanStatus,
    GetStringStatus,
    SetRealInputDerivatives,
    GetRealOutputDerivatives,
    GetDirectionalDerivative,
    GetFMUstate,
    SetFMUstate,
    FreeFMUstate,
    SerializedFMUstateSize,
    SerializeFMUstate,
    DeSerializeFMUstate,
    EnterEventMode,
    NewDiscreteStates,
    EnterContinuousTimeMode,
    CompletedIntegratorStep,
    SetTime,
    SetContinuousStates,
    GetDerivatives,
    GetEventIndicators,
    GetContinuousStates,
    GetNominalsOfContinuousStates,
}

const X: bool = true;
const O: bool = false;

impl Call {
    /// Whether the call is allowed in `state`.
    ///
    /// More than the standard allows: reading at any time, and `fmi2Terminate` of what has already
    /// ended, because hosts do it and it does no harm.
    #[must_use]
    #[rustfmt::skip]
    pub fn allowed_in(self, phase: Phase) -> bool {
        use Call::*;

        let [instantiated, initialization, running, terminated, failed] = match self {
            SetDebugLogging | Reset                            => [X, X, X, X, X],
            SetupExperiment | EnterInitializationMode          => [X, O, O, O, O],
            ExitInitializationMode                             => [O, X, O, O, O],
            GetReal | GetInteger | GetBoolean | GetString      => [X, X, X, X, X],
            SetReal | SetInteger | SetBoolean | SetString      => [X, X, X, O, O],
            DoStep                                             => [O, O, X, O, O],
            CancelStep
                | EnterEventMode | NewDiscreteStates
                | EnterContinuousTimeMode
                | CompletedIntegratorStep | SetTime
                | SetContinuousStates | GetDerivatives
                | GetEventIndicators | GetContinuousStates
                | GetNominalsOfContinuousStates                => [O, O, O, O, O],
            Terminate                                          => [O, O, X, X, X],
            GetStatus | GetRealStatus | GetIntegerStatus
                | GetBooleanStatus | GetStringStatus           => [O, O, X, X, X],
            SetRealInputDerivatives                            => [X, X, X, O, O],
            GetRealOutputDerivatives                           => [O, O, X, X, X],
            GetDirectionalDerivative                           => [O, X, X, X, X],
            GetFMUstate | SetFMUstate | FreeFMUstate
                | SerializedFMUstateSize | SerializeFMUstate
                | DeSerializeFMUstate                          => [X, X, X, X, X],
        };
        match phase {
            Phase::Instantiated => instantiated,
            Phase::Initialization => initialization,
            Phase::Running => running,
            Phase::Terminated => terminated,
            Phase::Failed => failed,
        }
    }
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "fmi2{self:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_displayed_by_their_names_in_c() {
        assert_eq!(Call::DoStep.to_string(), "fmi2DoStep");
        assert_eq!(Call::DeSerializeFMUstate.to_string(), "fmi2DeSerializeFMUstate");
    }

    #[test]
    fn reset_leads_out_of_every_state() {
        for phase in Phase::ALL {
            assert!(Call::Reset.allowed_in(phase), "{phase}");
        }
    }

    #[test]
    fn a_failed_simulation_can_be_looked_at_and_ended_but_not_continued() {
        assert!(Call::GetReal.allowed_in(Phase::Failed));
        assert!(Call::Terminate.allowed_in(Phase::Failed));
        assert!(!Call::SetReal.allowed_in(Phase::Failed));
        assert!(!Call::DoStep.allowed_in(Phase::Failed));
    }
}
