//! One instance of a model, as the standard sees it, in safe Rust.

use std::cell::OnceCell;
use std::fmt::Display;

use super::error::Error;
use super::phase::{Call, Phase};
use crate::fmi::identity::Identity;
use crate::fmi::model::{CommunicationStep, Model};
use crate::variables::{Bounds, Causality, Kind, Table, Variable};

mod access;
mod derivatives;
mod saved;
mod values;

pub use saved::Saved;
pub use values::Scalar;

/// Largest gap between the end of a step and the beginning of the next: a microsecond, because hosts
/// that count time in whole units of their own round. A step is never left out by that.
const GAP: f64 = 1e-6;
/// Late times carry the rounding of many additions: this is added to [`GAP`] per second of time.
const GAP_PER_SECOND: f64 = 1e-12;
/// Hosts that count time in single precision round the beginning and the end of a step: by this share of the time, as
/// long as that is no large part of the step.
const SINGLE_PRECISION: f64 = 2.0 * f32::EPSILON as f64;
/// See [`SINGLE_PRECISION`]: a larger gap is a step left out.
const GAP_PER_STEP: f64 = 0.1;

/// A unit between instantiation and release. Value references are positions in the model's table.
///
/// Every method that returns an error leaves the instance as it was, except a failed
/// [`Instance::do_step`].
pub struct Instance<M: Model> {
    unit: Identity<M>,
    table: Table<M::Data>,
    now: Snapshot<M>,
    /// The beginning of states as bytes, once there were any.
    title: OnceCell<String>,
}

/// All that influences the future of an instance; a saved FMU state is a copy of this.
struct Snapshot<M: Model> {
    phase: Phase,
    data: M::Data,
    /// Before the simulation: present only while it agrees with the parameters and inputs in `data`,
    /// and the outputs in `data` are then right.
    model: Option<M>,
    start_time: f64,
    stop_time: Option<f64>,
    /// The present communication point.
    time: f64,
    /// Whether also the outputs on demand in `data` are those of the present communication point.
    observed: bool,
    /// Whether parameters have been set that the model has not been told of.
    retuned: bool,
}

impl<M: Model> Clone for Snapshot<M> {
    // One copy of it in the library: it is long, and needed in many places.
    #[inline(never)]
    fn clone(&self) -> Self {
        let Self { phase, data, model, start_time, stop_time, time, observed, retuned } = self;
        Self {
            phase: *phase,
            data: data.clone(),
            model: model.clone(),
            start_time: *start_time,
            stop_time: *stop_time,
            time: *time,
            observed: *observed,
            retuned: *retuned,
        }
    }
}

impl<M: Model> Snapshot<M> {
    fn new(start: M::Data) -> Self {
        Self {
            phase: Phase::Instantiated,
            data: start,
            model: None,
            start_time: 0.0,
            stop_time: None,
            time: 0.0,
            observed: true,
            retuned: false,
        }
    }

    fn fail(&mut self) {
        self.phase = Phase::Failed;
        // Nothing more is computed.
        self.observed = true;
    }

    /// Makes the outputs on demand agree with the present communication point, if they do not yet.
    ///
    /// # Errors
    /// If they cannot be computed; the instance has failed then.
    #[inline]
    fn observe(&mut self) -> Result<(), Error> {
        if self.observed { Ok(()) } else { self.observe_now() }
    }

    #[inline(never)]
    fn observe_now(&mut self) -> Result<(), Error> {
        self.observed = true;
        let outcome = self.model.as_ref().map_or(Ok(()), |model| model.observe(&mut self.data));
        outcome.map_err(|error| {
            self.fail();
            Error::Outputs { time: self.time, reason: error.to_string() }
        })
    }
}

impl<M: Model> Instance<M> {
    /// A new instance with start values.
    #[must_use]
    pub fn new(unit: Identity<M>) -> Self {
        let (table, now) = (unit.table(), Snapshot::new(unit.start.clone()));
        let mut instance = Self { unit, table, now, title: OnceCell::new() };
        instance.go_to(0.0);
        instance
    }

    /// Where the instance stands.
    #[must_use]
    pub fn phase(&self) -> Phase {
        self.now.phase
    }

    /// Time up to which the simulation went well \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.now.time
    }

    /// The variables; positions are value references.
    #[must_use]
    pub fn variables(&self) -> &[Variable<M::Data>] {
        self.table.variables()
    }

    /// Checks that a call is allowed now.
    ///
    /// # Errors
    /// If it is not.
    pub fn permit(&self, call: Call) -> Result<(), Error> {
        let phase = self.now.phase;
        if call.allowed_in(phase) { Ok(()) } else { Err(Error::OutOfOrder { call, phase }) }
    }

    /// Gives the simulation up: after this only what [`Phase::Failed`] allows is possible.
    pub fn fail(&mut self) {
        self.now.fail();
    }

    /// Sets start and, if there is one, stop time. May be left out (start at 0) or repeated.
    ///
    /// # Errors
    /// If a time is not finite or they are in the wrong order.
    pub fn setup_experiment(&mut self, start_time: f64, stop_time: Option<f64>) -> Result<(), Error> {
        self.permit(Call::SetupExperiment)?;
        if !start_time.is_finite() {
            return Err(argument("startTime", "a finite number", start_time));
        }
        if let Some(stop_time) = stop_time.filter(|stop| !stop.is_finite() || *stop < start_time) {
            return Err(argument("stopTime", format!("finite and not before startTime = {start_time}"), stop_time));
        }
        self.now.model = None;
        self.now.start_time = start_time;
        self.now.stop_time = stop_time;
        self.go_to(start_time);
        Ok(())
    }

    /// Begins initialization.
    ///
    /// # Errors
    /// If the state does not allow it.
    pub fn enter_initialization(&mut self) -> Result<(), Error> {
        self.permit(Call::EnterInitializationMode)?;
        self.now.phase = Phase::Initialization;
        Ok(())
    }

    /// Ends initialization: outputs are right, the simulation can begin.
    ///
    /// # Errors
    /// If the parameters do not go together; they can be corrected, and the call repeated.
    pub fn exit_initialization(&mut self) -> Result<(), Error> {
        self.permit(Call::ExitInitializationMode)?;
        self.initialize()?;
        self.now.phase = Phase::Running;
        Ok(())
    }

    /// Makes model and outputs agree with the parameters and inputs, if they do not yet.
    fn initialize(&mut self) -> Result<(), Error> {
        if self.now.model.is_some() {
            return Ok(());
        }
        // A copy, so that a failure leaves nothing half-written.
        let mut data = self.now.data.clone();
        let model = M::initialize(self.unit.structure, &mut data, self.now.start_time)
            .map_err(|error| Error::Initialization(error.to_string()))?;
        self.now.data = data;
        self.now.model = Some(model);
        self.go_to(self.now.start_time);
        Ok(())
    }

    /// Advances from the communication point `from` by `size`, exactly to `from + size`. A size of 0
    /// changes nothing.
    ///
    /// The last step may end after the stop time, for hosts whose steps do not divide the interval, but
    /// none begins after it.
    ///
    /// # Errors
    /// If `from` is not where the last step ended, within a microsecond and rounding; if a number
    /// makes no sense; or if the model fails, and then the instance has failed.
    pub fn do_step(&mut self, from: f64, size: f64) -> Result<(), Error> {
        self.permit(Call::DoStep)?;
        let step = self.checked_step(from, size)?;
        if size == 0.0 {
            return Ok(());
        }
        let Snapshot { model, data, retuned, .. } = &mut self.now;
        let Some(model) = model else { return Err(self.failed(step, &"the model is missing")) };
        if std::mem::take(retuned) {
            model.tune(data);
        }
        if let Err(error) = model.step(data, step) {
            return Err(self.failed(step, &error));
        }
        self.go_to(step.to());
        self.now.observed = false;
        Ok(())
    }

    #[cold]
    fn failed(&mut self, CommunicationStep { from, size, .. }: CommunicationStep, reason: &dyn Display) -> Error {
        self.fail();
        Error::Step { from, size, reason: reason.to_string() }
    }

    fn checked_step(&self, from: f64, size: f64) -> Result<CommunicationStep, Error> {
        let Snapshot { start_time, stop_time, time, .. } = self.now;
        let step = CommunicationStep { start_time, from, size };
        let gap = gap_at(time, size);
        // No comparison holds for what is no number.
        let possible = (from - time).abs() <= gap
            && stop_time.is_none_or(|stop_time| from <= stop_time + gap)
            && Bounds::NON_NEGATIVE.admit(size)
            && step.to() < f64::INFINITY;
        if possible { Ok(step) } else { Err(self.no_step(from, size)) }
    }

    /// Why that is no step from here.
    #[cold]
    #[inline(never)]
    fn no_step(&self, from: f64, size: f64) -> Error {
        let Snapshot { stop_time, time, .. } = self.now;
        let gap = gap_at(time, size);
        if !from.is_finite() {
            return argument("currentCommunicationPoint", "a finite number", from);
        }
        if !Bounds::NON_NEGATIVE.admit(size) {
            return argument("communicationStepSize", "a finite number, at least 0", size);
        }
        if (from - time).abs() > gap {
            return Error::Gap { expected: time, found: from };
        }
        if let Some(stop_time) = stop_time.filter(|stop| from > stop + gap) {
            return argument("currentCommunicationPoint", format!("at most stopTime = {stop_time}"), from);
        }
        argument("communicationStepSize", "smaller", size)
    }

    /// Ends the simulation; harmless if it has ended already.
    ///
    /// # Errors
    /// If it has not begun.
    pub fn terminate(&mut self) -> Result<(), Error> {
        self.permit(Call::Terminate)?;
        self.now.phase = Phase::Terminated;
        Ok(())
    }

    /// Makes the instance as new, in any state.
    pub fn reset(&mut self) {
        self.now = Snapshot::new(self.unit.start.clone());
        self.go_to(0.0);
    }

    /// Moves to a communication point, and with it the independent variable, which is the first one.
    #[inline]
    fn go_to(&mut self, time: f64) {
        self.now.time = time;
        if let [Variable { causality: Causality::Independent, kind: Kind::Real { at, .. }, .. }, ..] =
            self.table.variables()
        {
            *at.get_mut(&mut self.now.data) = time;
        }
    }
}

/// Largest gap between the end of a step at `time` and the beginning of the next one, of length `size` \[s\].
#[inline]
fn gap_at(time: f64, size: f64) -> f64 {
    let time = time.abs();
    GAP + GAP_PER_SECOND * time + (SINGLE_PRECISION * time).min(GAP_PER_STEP * size.max(0.0))
}

fn argument(argument: &'static str, expected: impl Into<String>, found: f64) -> Error {
    Error::Argument { argument, expected: expected.into(), found: found.to_string() }
}

#[cfg(test)]
mod tests;
