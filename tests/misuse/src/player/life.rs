//! From instantiation to the end.

use std::ptr;

use super::{Player, Stage};
use crate::functions::OK;
use crate::hostile::{integer, length, one_in, pointer, real, text};
use crate::{host, reference};

// SAFETY, for all calls: every pointer is null, misaligned or good for ROOM elements, and every length is at
// most ROOM or more than any memory has, which a unit must notice without reading.
impl Player<'_> {
    /// Mostly as it should be; else no instance may come out unless every argument is admissible.
    pub fn instantiate(&mut self) -> Result<(), String> {
        let callbacks = host::callbacks();
        let right = !one_in(&mut self.rng, 8);
        let rng = &mut self.rng;
        let name = if right { c"unit".as_ptr() } else { text(rng) };
        let kind = if right { 1 } else { rng.i32(-1..3) };
        let guid = if right || !one_in(rng, 4) { self.unit.guid.as_ptr() } else { text(rng) };
        let resources = if right { c"file:///nowhere".as_ptr() } else { text(rng) };
        let silent = !right && rng.bool();
        let callbacks = if silent { ptr::null() } else { &raw const callbacks };
        let logging = integer(rng);
        let before = host::messages();
        // SAFETY: all texts end with a zero.
        self.component =
            unsafe { self.unit.functions.instantiate(name, kind, guid, resources, callbacks, integer(rng), logging) };
        self.tally.calls += 1;
        self.told = !silent;
        let acceptable = !name.is_null() && kind == 1 && guid == self.unit.guid.as_ptr();
        if self.component.is_null() {
            self.tally.refused += 1;
            self.listen(before);
            if acceptable {
                return Err(format!("no instance: {}", host::said()));
            }
            return self.require(silent || host::messages() > before, "fmi2Instantiate: null without a message");
        }
        self.require(acceptable, "fmi2Instantiate: an instance in spite of wrong arguments")
    }

    pub fn set_debug_logging(&mut self) -> Result<(), String> {
        self.call("fmi2SetDebugLogging", |p, c| {
            p.told = false;
            let count = p.rng.usize(0..4);
            p.texts[..count].fill_with(|| text(&mut p.rng));
            let (on, count) = (integer(&mut p.rng), length(&mut p.rng, count));
            let list = pointer(&mut p.rng, p.texts.as_ptr());
            unsafe { p.unit.functions.set_debug_logging(c, on, count, list) }
        })
        .map(drop)
    }

    pub fn setup_experiment(&mut self) -> Result<(), String> {
        let name = "fmi2SetupExperiment";
        let start = if self.rng.bool() { 0.0 } else { real(&mut self.rng) };
        let done = self.call(name, |p, c| {
            let (defined, tolerance) = (integer(&mut p.rng), real(&mut p.rng));
            let (has_stop, stop) = (p.rng.i32(0..2), 10.0 * real(&mut p.rng));
            unsafe { p.unit.functions.setup_experiment(c, defined, tolerance, start, has_stop, stop) }
        })?;
        if done {
            self.require_stage(name, &[Stage::Instantiated])?;
            (self.start, self.time) = (start, start);
        }
        Ok(())
    }

    pub fn enter_initialization(&mut self) -> Result<(), String> {
        let name = "fmi2EnterInitializationMode";
        if self.call(name, |p, c| unsafe { p.unit.functions.enter_initialization(c) })? {
            self.require_stage(name, &[Stage::Instantiated])?;
            self.stage = Stage::Initialization;
        }
        Ok(())
    }

    pub fn exit_initialization(&mut self) -> Result<(), String> {
        let name = "fmi2ExitInitializationMode";
        if self.call(name, |p, c| unsafe { p.unit.functions.exit_initialization(c) })? {
            self.require_stage(name, &[Stage::Initialization])?;
            (self.stage, self.time) = (Stage::Running, self.start);
            self.look("after initialization")?;
        }
        Ok(())
    }

    pub fn terminate(&mut self) -> Result<(), String> {
        let name = "fmi2Terminate";
        if self.call(name, |p, c| unsafe { p.unit.functions.terminate(c) })? {
            self.require_stage(name, &[Stage::Running, Stage::Terminated, Stage::Failed])?;
            self.stage = Stage::Terminated;
        }
        Ok(())
    }

    pub fn reset(&mut self) -> Result<(), String> {
        if self.call("fmi2Reset", |p, c| unsafe { p.unit.functions.reset(c) })? {
            (self.stage, self.start, self.time) = (Stage::Instantiated, 0.0, 0.0);
        }
        Ok(())
    }

    /// Whatever happened: after a reset the instance is as new. Then it goes, some states with it.
    pub fn end(&mut self, expected: &[u64]) -> Result<(), String> {
        if self.component.is_null() {
            return Ok(());
        }
        unsafe {
            let status = self.unit.functions.reset(self.component);
            self.require(status == OK, "fmi2Reset: refused at the end")?;
            let found = reference::run(self.unit, self.component)?;
            self.require(found == expected, "after fmi2Reset the instance is not as new")?;
            self.unit.functions.free_instance(self.component);
        }
        Ok(())
    }
}
