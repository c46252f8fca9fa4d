//! The names of the C interface.

/// Exports a [`Model`](crate::fmi::Model) as the FMI 2.0 co-simulation functions of a shared library.
/// To be used once in a library, for the names are global.
#[macro_export]
macro_rules! export_fmi2 {
    ($model:ty) => {
        const _: () = {
            use $crate::fmi::v2::c_types::*;
            use $crate::fmi::v2::calls;
            use $crate::fmi::v2::phase::Call;

            $crate::export_fmi2! { @functions $model;
                fmi2GetTypesPlatform() -> Text = calls::types_platform();
                fmi2GetVersion() -> Text = calls::version();

                fmi2Instantiate(name: Text, fmu_type: FmuType, guid: Text, resources: Text,
                    callbacks: *const CallbackFunctions, _visible: Boolean, logging_on: Boolean) -> Component
                    = calls::instantiate::<$model>(name, fmu_type, guid, resources, callbacks, logging_on);
                fmi2FreeInstance(c: Component) -> () = calls::free_instance::<$model>(c);
                fmi2SetDebugLogging(c: Component, on: Boolean, count: Size, categories: *const Text) -> Status
                    = calls::set_debug_logging::<$model>(c, on, count, categories);

                fmi2SetupExperiment(c: Component, _tolerance_defined: Boolean, _tolerance: Real, start: Real,
                    stop_defined: Boolean, stop: Real) -> Status
                    = calls::setup_experiment::<$model>(c, start, stop_defined, stop);
                fmi2EnterInitializationMode(c: Component) -> Status = calls::enter_initialization_mode::<$model>(c);
                fmi2ExitInitializationMode(c: Component) -> Status = calls::exit_initialization_mode::<$model>(c);
                fmi2Terminate(c: Component) -> Status = calls::terminate::<$model>(c);
                fmi2Reset(c: Component) -> Status = calls::reset::<$model>(c);

                fmi2GetReal(c: Component, vr: *const ValueReference, count: Size, values: *mut Real) -> Status
                    = calls::get::<$model, Real>(c, vr, count, values);
                fmi2GetInteger(c: Component, vr: *const ValueReference, count: Size, values: *mut Integer) -> Status
                    = calls::get::<$model, Integer>(c, vr, count, values);
                fmi2GetBoolean(c: Component, vr: *const ValueReference, count: Size, values: *mut Boolean) -> Status
                    = calls::get::<$model, Boolean>(c, vr, count, values);
                fmi2GetString(c: Component, vr: *const ValueReference, count: Size, _values: *mut Text) -> Status
                    = calls::text::<$model>(c, Call::GetString, vr, count);
                fmi2SetReal(c: Component, vr: *const ValueReference, count: Size, values: *const Real) -> Status
                    = calls::set::<$model, Real>(c, vr, count, values);
                fmi2SetInteger(c: Component, vr: *const ValueReference, count: Size, values: *const Integer) -> Status
                    = calls::set::<$model, Integer>(c, vr, count, values);
                fmi2SetBoolean(c: Component, vr: *const ValueReference, count: Size, values: *const Boolean) -> Status
                    = calls::set::<$model, Boolean>(c, vr, count, values);
                fmi2SetString(c: Component, vr: *const ValueReference, count: Size, _values: *const Text) -> Status
                    = calls::text::<$model>(c, Call::SetString, vr, count);

                fmi2DoStep(c: Component, from: Real, size: Real, _never_back: Boolean) -> Status
                    = calls::do_step::<$model>(c, from, size);
                fmi2CancelStep(c: Component) -> Status
                    = calls::not_offered::<$model>(c, Call::CancelStep, "canRunAsynchronuously", "false");
                fmi2GetStatus(c: Component, kind: StatusKind, value: *mut Status) -> Status
                    = calls::get_status::<$model>(c, kind, value);
                fmi2GetRealStatus(c: Component, kind: StatusKind, value: *mut Real) -> Status
                    = calls::get_real_status::<$model>(c, kind, value);
                fmi2GetIntegerStatus(c: Component, kind: StatusKind, _value: *mut Integer) -> Status
                    = calls::get_integer_status::<$model>(c, kind);
                fmi2GetBooleanStatus(c: Component, kind: StatusKind, value: *mut Boolean) -> Status
                    = calls::get_boolean_status::<$model>(c, kind, value);
                fmi2GetStringStatus(c: Component, kind: StatusKind, value: *mut Text) -> Status
                    = calls::get_string_status::<$model>(c, kind, value);

                fmi2SetRealInputDerivatives(c: Component, vr: *const ValueReference, count: Size,
                    orders: *const Integer, values: *const Real) -> Status
                    = calls::set_real_input_derivatives::<$model>(c, vr, count, orders, values);
                fmi2GetRealOutputDerivatives(c: Component, vr: *const ValueReference, count: Size,
                    orders: *const Integer, values: *mut Real) -> Status
                    = calls::get_real_output_derivatives::<$model>(c, vr, count, orders, values);
                fmi2GetDirectionalDerivative(c: Component, _unknowns: *const ValueReference, _unknown_count: Size,
                    _knowns: *const ValueReference, _known_count: Size, _seed: *const Real, _values: *mut Real) -> Status
                    = calls::not_offered::<$model>(
                        c, Call::GetDirectionalDerivative, "providesDirectionalDerivative", "false");

                fmi2GetFMUstate(c: Component, state: *mut FmuState) -> Status = calls::get_fmu_state::<$model>(c, state);
                fmi2SetFMUstate(c: Component, state: FmuState) -> Status = calls::set_fmu_state::<$model>(c, state);
                fmi2FreeFMUstate(c: Component, state: *mut FmuState) -> Status
                    = calls::free_fmu_state::<$model>(c, state);
                fmi2SerializedFMUstateSize(c: Component, state: FmuState, size: *mut Size) -> Status
                    = calls::serialized_fmu_state_size::<$model>(c, state, size);
                fmi2SerializeFMUstate(c: Component, state: FmuState, bytes: *mut Byte, size: Size) -> Status
                    = calls::serialize_fmu_state::<$model>(c, state, bytes, size);
                fmi2DeSerializeFMUstate(c: Component, bytes: *const Byte, size: Size, state: *mut FmuState) -> Status
                    = calls::deserialize_fmu_state::<$model>(c, bytes, size, state);

                // Of model exchange. Some hosts look up every function of the standard before they use any.
                fmi2EnterEventMode(c: Component) -> Status
                    = calls::model_exchange::<$model>(c, Call::EnterEventMode);
                fmi2NewDiscreteStates(c: Component, _info: *mut EventInfo) -> Status
                    = calls::model_exchange::<$model>(c, Call::NewDiscreteStates);
                fmi2EnterContinuousTimeMode(c: Component) -> Status
                    = calls::model_exchange::<$model>(c, Call::EnterContinuousTimeMode);
                fmi2CompletedIntegratorStep(c: Component, _never_back: Boolean, _event: *mut Boolean,
                    _terminate: *mut Boolean) -> Status
                    = calls::model_exchange::<$model>(c, Call::CompletedIntegratorStep);
                fmi2SetTime(c: Component, _time: Real) -> Status
                    = calls::model_exchange::<$model>(c, Call::SetTime);
                fmi2SetContinuousStates(c: Component, _x: *const Real, _count: Size) -> Status
                    = calls::model_exchange::<$model>(c, Call::SetContinuousStates);
                fmi2GetDerivatives(c: Component, _derivatives: *mut Real, _count: Size) -> Status
                    = calls::model_exchange::<$model>(c, Call::GetDerivatives);
                fmi2GetEventIndicators(c: Component, _indicators: *mut Real, _count: Size) -> Status
                    = calls::model_exchange::<$model>(c, Call::GetEventIndicators);
                fmi2GetContinuousStates(c: Component, _x: *mut Real, _count: Size) -> Status
                    = calls::model_exchange::<$model>(c, Call::GetContinuousStates);
                fmi2GetNominalsOfContinuousStates(c: Component, _nominals: *mut Real, _count: Size) -> Status
                    = calls::model_exchange::<$model>(c, Call::GetNominalsOfContinuousStates);
            }
        };
    };

    (@functions $model:ty; $($name:ident($($argument:ident: $type:ty),*) -> $result:ty = $call:expr;)+) => {
        $(
            #[unsafe(no_mangle)]
            #[allow(non_snake_case, unused_unsafe)]
            unsafe extern "C" fn $name($($argument: $type),*) -> $result {
                // SAFETY: what the standard asks of hosts is what the function asks of its caller.
                unsafe { $call }
            }
        )+
    };
}
