//! Damping of the arm's free motion by a small moment on the UAV.
//!
//! An arm that must not exert a moment on its pivot is a pendulum: whatever sets it in motion beside the path, it goes
//! on swinging, and only the hold of the rates damps that, differently for each length of step. So the methods that
//! cancel the moment may ask for one instead,
//!
//! > moment on the UAV = c (l - s),    s' = (l - s) / T,
//!
//! where l is the angular momentum that the rates give to what the UAV carries, c is `ik.moment_damping` and T is
//! `ik.moment_washout`. The slow part s of l is not damped: without it every lasting motion of the arm would push the UAV
//! away. Over an interval of length h at constant rates, l tends to s as e^(-c h) would have it, which is stable for
//! every c and h; by the end of the interval s has come nearer to l, too, so that the damping fades where h is long
//! beside T.
//!
//! Where limits, or a configuration in which the moment contradicts the path, keep the moment from what is wanted, the
//! motion is no pendulum's any more: it would swing from limit to limit, slowly, with the washout taking most of the
//! damping away. There all of l is damped (s tends to 0), ten times as much, and for a second or so afterwards.

use crate::bytes::{Memory, Tape};
use crate::error::{Error, Result};
use crate::parameters::InverseKinematics;
use crate::pass;

/// Where limits keep the moment from what is wanted, this many times c is added to it.
const EXTRA: f64 = 9.0;

/// How long that lasts after limits have bound, as time constant \[s\].
const CALMING: f64 = 1.0;

/// Less of it is nothing.
const NO_EXTRA: f64 = 1e-3;

/// The damping of one controller.
#[derive(Debug, Clone, Copy)]
pub(super) struct MomentDamping {
    /// c \[1/s\].
    damping: f64,
    /// T \[s\].
    washout: f64,
    /// l, under the rates of the present plan \[N m s\].
    pub momentum: f64,
    /// s \[N m s\].
    slow: f64,
    /// How many times c is added to it, after limits have kept the moment from what was wanted.
    extra: f64,
    factors: Factors,
}

/// What the damping of an interval takes of exponentials, kept for the next interval of the same length.
#[derive(Debug, Clone, Copy)]
struct Factors {
    /// Length of the interval \[s\].
    size: f64,
    /// Share of l - s that is left at its end.
    left: f64,
    /// Share of l - s by which s approaches l in it.
    approach: f64,
}

impl MomentDamping {
    /// As the settings say; nothing has moved yet.
    pub fn new(settings: &InverseKinematics) -> Self {
        let factors = Factors { size: f64::NAN, left: 1.0, approach: 0.0 };
        let mut damping = Self { damping: 0.0, washout: 1.0, momentum: 0.0, slow: 0.0, extra: 0.0, factors };
        damping.tune(settings);
        damping
    }

    /// Takes over the settings, which may change during a run.
    pub fn tune(&mut self, settings: &InverseKinematics) {
        (self.damping, self.washout) = (settings.moment_damping, settings.moment_washout);
        self.factors.size = f64::NAN;
    }

    /// Prepares for an interval of length `size` \[s\].
    pub fn prepare(&mut self, size: f64) {
        if self.factors.size != size && self.damping > 0.0 {
            self.factors = self.factors_of(size);
        }
    }

    fn factors_of(&self, size: f64) -> Factors {
        let fading = libm::exp(-size / self.washout);
        let gain = libm::expm1(self.damping * (1.0 + self.extra) * size) * fading;
        Factors { size, left: 1.0 / (1.0 + gain), approach: 1.0 - fading }
    }

    /// What is to become, by the end of the interval prepared for, of an angular momentum in the rates that without
    /// damping would be `momentum` \[N m s\].
    pub fn damped(&self, momentum: f64) -> f64 {
        if self.damping > 0.0 { self.slow + (momentum - self.slow) * self.factors.left } else { momentum }
    }

    /// How carefully the moment is to be met, 0 to 1: limits, or the path, have lately kept it from what was wanted.
    pub fn caution(&self) -> f64 {
        self.extra / EXTRA
    }

    /// The rates of the present plan have been held for `size` \[s\]; `met`: the moment was what was wanted.
    pub fn advance(&mut self, size: f64, met: bool) {
        if self.damping == 0.0 {
            return;
        }
        self.prepare(size);
        let lasting = if met { self.momentum } else { 0.0 };
        self.slow += (lasting - self.slow) * self.factors.approach;
        if met {
            if self.extra > 0.0 {
                self.extra = if self.extra > NO_EXTRA { self.extra * (1.0 - (size / CALMING).min(1.0)) } else { 0.0 };
                self.factors.size = f64::NAN;
            }
        } else {
            self.extra = EXTRA;
            self.factors.size = f64::NAN;
        }
    }

    /// Whether a controller can have damped like this.
    ///
    /// # Errors
    /// Names the quantity that is not finite.
    pub fn check_memory(&self) -> Result<()> {
        let momenta = [("angular momentum in the rates", self.momentum), ("its slow part", self.slow)];
        match momenta.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((quantity, value)) => Err(Error::Impossible { quantity, value }),
            None => Ok(()),
        }
    }
}

impl Memory for MomentDamping {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // The settings are parameters, and the factors follow from them.
        let Self { damping: _, washout: _, momentum, slow, extra, factors } = self;
        pass!(tape: momentum, slow, extra);
        factors.size = f64::NAN;
    }
}
