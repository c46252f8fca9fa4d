//! Floating-point environments that a host may have: units must answer as ever in them, and leave them as they are.

use std::sync::OnceLock;

use clap::ValueEnum;

/// An environment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Environment {
    /// As programs begin.
    Usual,
    /// Rounds up.
    Up,
    /// Rounds down.
    Down,
    /// Rounds towards zero.
    Zero,
    /// Takes tiny numbers for zero.
    Flush,
    /// Traps all exceptions: the process ends at the first one.
    Trap,
    /// Rounds towards zero, takes tiny numbers for zero and traps all exceptions.
    Hostile,
}

/// The one of this process; none: whatever there is.
static CHOSEN: OnceLock<Environment> = OnceLock::new();

/// Chooses the environment of all calls to come.
pub fn choose(environment: Environment) {
    if environment != Environment::Usual {
        let _ = CHOSEN.set(environment);
    }
}

/// Makes a call of a unit in the chosen environment.
///
/// # Panics
/// If the environment is another one afterwards.
#[inline]
pub fn call<R>(name: &str, call: impl FnOnce() -> R) -> R {
    let Some(chosen) = CHOSEN.get() else { return call() };
    let usual = processor::read();
    // Not all processors can do everything: what counts is what they then have.
    processor::write(processor::word(*chosen));
    let before = processor::read();
    let result = call();
    let after = processor::read();
    processor::write(usual);
    assert_eq!(before, after, "{name} leaves another floating-point environment");
    result
}

/// Does what a callback of the host does, in the usual environment, if the host's own one is in force.
///
/// # Panics
/// If it is not.
pub fn callback(action: impl FnOnce()) {
    let Some(chosen) = CHOSEN.get() else { return action() };
    let found = processor::read();
    processor::write(processor::word(Environment::Usual));
    processor::write(processor::word(*chosen));
    let expected = processor::read();
    processor::write(processor::word(Environment::Usual));
    assert_eq!(found, expected, "the logger is called in another floating-point environment");
    action();
    processor::write(found);
}

#[cfg(target_arch = "x86_64")]
mod processor {
    use std::arch::asm;

    use super::Environment;

    /// MXCSR, without flags (Intel, Software Developer's Manual, volume 1, 10.2.3).
    pub fn word(environment: Environment) -> u32 {
        match environment {
            Environment::Usual => 0x1f80,
            Environment::Up => 0x5f80,
            Environment::Down => 0x3f80,
            Environment::Zero => 0x7f80,
            Environment::Flush => 0x9fc0,
            Environment::Trap => 0x0000,
            Environment::Hostile => 0xe040,
        }
    }

    pub fn read() -> u32 {
        let mut word = 0;
        // SAFETY: writes the word that it is given.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack)) };
        word
    }

    pub fn write(word: u32) {
        // SAFETY: reads the word that it is given; nothing is computed here before the usual one is back.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) };
    }
}

#[cfg(target_arch = "aarch64")]
mod processor {
    use std::arch::asm;

    use super::Environment;

    /// FPCR (Arm, Architecture Reference Manual, C5.2.8) and FPSR, without flags.
    pub fn word(environment: Environment) -> [u64; 2] {
        const TRAPS: u64 = 0x9f00;
        let control = match environment {
            Environment::Usual => 0,
            Environment::Up => 1 << 22,
            Environment::Down => 2 << 22,
            Environment::Zero => 3 << 22,
            Environment::Flush => 3 << 24,
            Environment::Trap => TRAPS,
            Environment::Hostile => TRAPS | 0xf << 22,
        };
        [control, 0]
    }

    pub fn read() -> [u64; 2] {
        let (control, flags);
        // SAFETY: changes nothing.
        unsafe { asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) flags, options(nostack)) };
        [control, flags]
    }

    pub fn write([control, flags]: [u64; 2]) {
        // SAFETY: nothing is computed here before the usual one is back.
        unsafe { asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) flags, options(nostack)) };
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod processor {
    pub fn word(_: super::Environment) {}
    pub fn read() {}
    pub fn write((): ()) {}
}
