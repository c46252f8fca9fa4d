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

#[cfg(test)]
mod tests {
    use std::hint::black_box;

    use super::*;

    /// A third lies between two numbers that can be written.
    #[test]
    fn quotients_are_rounded_as_said_and_afterwards_as_before() {
        let third = |of: f64| black_box(of) / black_box(3.0);
        let [below, above] = [1.0 / 3.0, f64::from_bits((1.0_f64 / 3.0).to_bits() + 1)];
        for environment in Environment::ALL {
            let (plus, minus) = environment.of(|| (third(1.0), third(-1.0)));
            let expected = match environment {
                Environment::Usual | Environment::Truncating => (below, -below),
                Environment::Down => (below, -above),
                Environment::Up => (above, -below),
            };
            assert_eq!((plus, minus), expected, "{environment:?}");
            assert_eq!((third(1.0), third(-1.0)), (below, -below), "after {environment:?}");
        }
    }
}
