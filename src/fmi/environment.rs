//! The floating-point environment: every call computes in the same one, and hosts find theirs as it was.
//!
//! How a processor rounds, which exceptions it traps and whether it takes tiny numbers for zero are settings of the
//! thread that calls. Compiled code relies on the usual ones: to the nearest number, no traps, tiny numbers as they
//! are. Hosts may have others, and read exceptions by flags that arithmetic raises.

use std::cell::Cell;

use processor::{OWN, Word};

/// The host's environment while a unit computes in its own; given back when this is dropped.
///
/// Whatever computes or calls the host asks for a reference to it, so that nothing does so in a wrong environment.
#[derive(Debug)]
pub struct Host(Cell<Word>);

// Writing what is there already is not free, and a write that changes something, if only a flag, takes a processor up to
// fifty nanoseconds: most hosts have the usual environment, and the flags that a unit raises are raised already.
impl Host {
    /// Goes over from the host's environment to that of the units.
    #[inline]
    #[must_use]
    pub fn leave() -> Self {
        let theirs = processor::read();
        if !processor::computes_alike(theirs) {
            processor::write(OWN);
        }
        Self(Cell::new(theirs))
    }

    /// Calls `action`, which is code of the host, in the host's environment; what that changes there is kept.
    pub fn visit<R>(&self, action: impl FnOnce() -> R) -> R {
        processor::write(self.0.get());
        let result = action();
        self.0.set(processor::read());
        processor::write(OWN);
        result
    }
}

impl Drop for Host {
    #[inline]
    fn drop(&mut self) {
        let theirs = self.0.get();
        if processor::read() != theirs {
            processor::write(theirs);
        }
    }
}

/// Numbers of Rust are computed by the SSE units only; the control word of the x87 unit, which a host may have changed
/// as well, is neither used nor touched.
#[cfg(target_arch = "x86_64")]
pub(super) mod processor {
    use std::arch::asm;

    /// MXCSR: flags of exceptions, masks of exceptions, rounding, and what becomes of tiny numbers.
    pub type Word = u32;

    /// All exceptions masked, rounding to nearest, tiny numbers as they are; no flag is raised.
    pub const OWN: Word = 0x1f80;
    const FLAGS: Word = 0x003f;

    pub const fn computes_alike(word: Word) -> bool {
        word & !FLAGS == OWN
    }

    #[inline]
    pub fn read() -> Word {
        let mut word = 0;
        // SAFETY: writes the word that it is given.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack, preserves_flags)) };
        word
    }

    #[inline]
    pub fn write(word: Word) {
        // SAFETY: reads the word that it is given. What compiled code relies on is put in force by this, or given up for
        // the host's code, which is not compiled from here.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) };
    }
}

#[cfg(target_arch = "aarch64")]
pub(super) mod processor {
    use std::arch::asm;

    /// FPCR: traps, rounding and what becomes of tiny numbers; FPSR: flags of exceptions.
    pub type Word = [u64; 2];

    /// No traps, rounding to nearest, tiny numbers and the bits of what is no number as they are; no flag is raised.
    pub const OWN: Word = [0, 0];

    pub const fn computes_alike([control, _]: Word) -> bool {
        control == OWN[0]
    }

    #[inline]
    pub fn read() -> Word {
        let (control, flags);
        // SAFETY: changes nothing.
        unsafe { asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) flags, options(nostack)) };
        [control, flags]
    }

    #[inline]
    pub fn write([control, flags]: Word) {
        // SAFETY: what compiled code relies on is put in force by this, or given up for the host's code, which is not
        // compiled from here.
        unsafe { asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) flags, options(nostack)) };
    }
}

/// WebAssembly has nothing to set.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(super) mod processor {
    pub type Word = ();

    pub const OWN: Word = ();

    pub const fn computes_alike((): Word) -> bool {
        true
    }

    pub fn read() -> Word {}

    pub fn write((): Word) {}
}
