//! Floating-point environments in which hosts may call.

/// How the host's processor rounds while it calls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Environment {
    /// To nearest: as every program starts.
    Usual,
    /// To minus infinity.
    Down,
    /// To plus infinity.
    Up,
    /// Towards zero.
    Truncating,
}

impl Environment {
    /// Those that can be set on this processor.
    pub const ALL: &[Self] = if cfg!(target_arch = "x86_64") {
        &[Self::Usual, Self::Down, Self::Up, Self::Truncating]
    } else {
        &[Self::Usual]
    };

    /// Does `calls` in this environment, which ends with them.
    ///
    /// `calls` do nothing with numbers of their own: the compiler takes for granted that results are rounded to nearest.
    #[inline]
    pub fn of<R>(self, calls: impl FnOnce() -> R) -> R {
        if self == Self::Usual { calls() } else { self.elsewhere(calls) }
    }

    #[cfg(target_arch = "x86_64")]
    #[inline(never)]
    fn elsewhere<R>(self, calls: impl FnOnce() -> R) -> R {
        use std::arch::asm;
        /// Both bits of the rounding in the control word of SSE.
        const ROUNDING: u32 = 0x6000;
        let mut before = 0_u32;
        // SAFETY: the word is read into a place of its length.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut before, options(nostack, preserves_flags)) };
        let within = (before & !ROUNDING) | ((self as u32) << 13);
        // SAFETY: only the rounding changes, and only until the calls have returned.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const within, options(nostack, preserves_flags)) };
        let result = calls();
        // SAFETY: this is what was there before.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const before, options(nostack, preserves_flags)) };
        result
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn elsewhere<R>(self, calls: impl FnOnce() -> R) -> R {
        calls()
    }
}
