//! The wanted motion of the end effector, relative to where it starts.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::mechanics::planar::{Rotation, Vec2, vec2};
use crate::memory;
use crate::options;

mod table;

pub use table::{MOST_KNOTS, PathTable, TableError};

/// Number of legs that a path can have.
pub const LEGS: usize = 4;

options! {
    #[doc = " What the end effector follows."]
    pub enum ReferenceKind {
        #[doc = " A path of straight legs, which add up where they overlap in time."]
        Path = "path",
        #[doc = " One counter-clockwise turn on a circle through the starting point."]
        Circle = "circle",
        #[doc = " Position, velocity and acceleration come as inputs."]
        External = "external",
        #[doc = " The path of a table inside the FMU."]
        Table = "table",
    }
}

options! {
    #[doc = " Which instant of a communication step the values of an external reference belong to."]
    pub enum ReferenceInstant {
        #[doc = " Its beginning, as FMI has it: what masters hand over that set inputs before a step."]
        StepStart = "step_start",
        #[doc = " Its end: what sequential masters hand over that have stepped the source of the reference before."]
        StepEnd = "step_end",
    }
}

options! {
    #[doc = " Velocity in the ramps of a leg."]
    pub enum Profile {
        #[doc = " Constant acceleration."]
        Trapezoidal = "trapezoidal",
        #[doc = " Continuous acceleration, a raised cosine."]
        Smooth = "smooth",
    }
}

/// A straight leg of a path: accelerates for `ramp`, cruises, brakes for `ramp`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// When it begins, from the start of the run \[s\].
    pub start: f64,
    /// How long it takes \[s\]; 0: no such leg.
    pub duration: f64,
    /// How long it accelerates, and brakes \[s\].
    pub ramp: f64,
    /// Way to the right \[m\].
    pub dx: f64,
    /// Way upwards \[m\].
    pub dy: f64,
    /// Velocity in the ramps.
    pub profile: Profile,
}

impl Leg {
    /// A leg that does not move.
    pub const NONE: Self = Self { start: 0.0, duration: 0.0, ramp: 0.0, dx: 0.0, dy: 0.0, profile: Profile::Smooth };

    /// Share of the way (0 to 1), its rate \[1/s\] and its second derivative \[1/s2\] at time `t` \[s\].
    #[must_use]
    pub fn progress(&self, t: f64) -> [f64; 3] {
        let elapsed = t - self.start;
        if elapsed <= 0.0 || self.duration == 0.0 {
            return [0.0; 3];
        }
        let left = self.duration - elapsed;
        if left <= 0.0 {
            return [1.0, 0.0, 0.0];
        }
        let cruise = 1.0 / (self.duration - self.ramp);
        let nearer = if elapsed < left { elapsed } else { left };
        if nearer >= self.ramp {
            return [cruise * (elapsed - 0.5 * self.ramp), cruise, 0.0];
        }
        let [way, rate, acceleration] = self.profile.ramp(nearer, self.ramp).map(|value| cruise * value);
        if elapsed < left { [way, rate, acceleration] } else { [1.0 - way, rate, -acceleration] }
    }

    /// Adds its motion at time `t` \[s\] to `target`.
    #[inline]
    fn add(&self, t: f64, target: &mut Target) {
        let (way, elapsed) = (vec2(self.dx, self.dy), t - self.start);
        if elapsed <= 0.0 || self.duration == 0.0 {
            return;
        }
        // Most of a run comes after most legs.
        if elapsed >= self.duration {
            target.displacement += way;
            return;
        }
        let [share, rate, acceleration] = self.progress(t);
        target.displacement += way * share;
        target.velocity += way * rate;
        target.acceleration += way * acceleration;
    }
}

impl Profile {
    /// Way \[s\], velocity and acceleration \[1/s\] of a ramp from rest to velocity 1, `t` into its `duration`.
    #[inline]
    fn ramp(self, t: f64, duration: f64) -> [f64; 3] {
        const FULL_CIRCLE: f64 = std::f64::consts::TAU;
        const PER_CIRCLE: f64 = 1.0 / FULL_CIRCLE;
        let steepness = 1.0 / duration;
        let share = t * steepness;
        match self {
            Self::Trapezoidal => [0.5 * t * share, share, steepness],
            Self::Smooth => {
                let [cos, sin] = Rotation::by(FULL_CIRCLE * share).cos_sin();
                [
                    0.5 * t * share - duration * (PER_CIRCLE * PER_CIRCLE) * (1.0 - cos),
                    share - sin * PER_CIRCLE,
                    (1.0 - cos) * steepness,
                ]
            }
        }
    }
}

/// One turn on a circle, at rest before and after; the angle's acceleration is a sine, so continuous.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Diameter \[m\].
    pub diameter: f64,
    /// How long the turn takes \[s\].
    pub duration: f64,
    /// Where on the circle the motion starts \[rad\]; 0: rightmost.
    pub start_angle: f64,
}

/// Position, velocity and acceleration of the wanted motion, from its starting point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Displacement from the starting point \[m\].
    pub displacement: Vec2,
    /// Velocity \[m/s\].
    pub velocity: Vec2,
    /// Acceleration \[m/s2\].
    pub acceleration: Vec2,
}

impl Target {
    /// At the starting point.
    pub const AT_REST: Self =
        Self { displacement: vec2(0.0, 0.0), velocity: vec2(0.0, 0.0), acceleration: vec2(0.0, 0.0) };

    /// The motion a time `t` \[s\] later, or earlier, at constant acceleration.
    #[must_use]
    pub fn after(&self, t: f64) -> Self {
        let Self { displacement, velocity: v, acceleration: a } = *self;
        Self { displacement: displacement + (v + a * (0.5 * t)) * t, velocity: v + a * t, acceleration: a }
    }
}

memory!(Target { displacement, velocity, acceleration });

/// The wanted motion of the end effector.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Which of the motions.
    pub kind: ReferenceKind,
    /// Legs of the path.
    pub legs: [Leg; LEGS],
    /// The circle.
    pub circle: Circle,
    /// When the values of an external reference are valid.
    pub instant: ReferenceInstant,
    /// The path of [`ReferenceKind::Table`], if there is one. Nothing changes it during a run, so copies share it.
    pub table: Option<Arc<PathTable>>,
}

impl Reference {
    /// Checks that every leg has time for its ramps, and that there is a table if it is followed.
    ///
    /// # Errors
    /// Names the leg whose two ramps are longer than the leg, or says how a table comes into a unit.
    pub fn check(&self) -> Result<()> {
        if self.kind == ReferenceKind::Table && self.table.is_none() {
            return Err(Error::Inconsistent {
                name: "reference.kind".to_owned(),
                expected: "this unit has no table; give a scenario file a `path`, and build FMUs with it: \
                           `build --scenario FILE`"
                    .to_owned(),
                found: "table".to_owned(),
            });
        }
        for (j, leg) in self.legs.iter().enumerate().filter(|(_, leg)| leg.duration > 0.0) {
            if 2.0 * leg.ramp > leg.duration || (leg.ramp == 0.0 && leg.profile == Profile::Smooth) {
                return Err(Error::Inconsistent {
                    name: format!("reference.leg[{}].ramp", j + 1),
                    expected: format!(
                        "two ramps must fit into reference.leg[{}].duration = {:?}, and a smooth one takes time",
                        j + 1,
                        leg.duration
                    ),
                    found: leg.ramp.to_string(),
                });
            }
        }
        Ok(())
    }

    /// When the motion comes to its end, from the start \[s\]; never for [`ReferenceKind::External`].
    #[must_use]
    pub fn end(&self) -> f64 {
        let moves = |leg: &&Leg| leg.duration > 0.0 && (leg.dx != 0.0 || leg.dy != 0.0);
        match self.kind {
            ReferenceKind::Path => {
                self.legs.iter().filter(moves).map(|leg| leg.start + leg.duration).fold(0.0, f64::max)
            }
            ReferenceKind::Circle => self.circle.duration,
            ReferenceKind::External => f64::INFINITY,
            ReferenceKind::Table => self.table.as_ref().map_or(0.0, |table| table.end()),
        }
    }

    /// The wanted motion at time `t` \[s\] from the start; at rest for [`ReferenceKind::External`].
    #[must_use]
    pub fn at(&self, t: f64) -> Target {
        let mut target = Target::AT_REST;
        self.write(Vec2::zeros(), t, &mut target);
        target
    }

    /// The wanted motion at time `t` \[s\], which starts at `origin` \[m\], written to `target`.
    pub fn write(&self, origin: Vec2, t: f64, target: &mut Target) {
        *target = Target { displacement: origin, ..Target::AT_REST };
        match self.kind {
            ReferenceKind::Path => {
                self.legs.iter().for_each(|leg| leg.add(t, target));
            }
            ReferenceKind::Circle => {
                use std::f64::consts::TAU;
                let whole = Leg { duration: self.circle.duration, ramp: 0.5 * self.circle.duration, ..Leg::NONE };
                let [angle, rate, acceleration] = whole.progress(t).map(|share| TAU * share);
                let radius = 0.5 * self.circle.diameter;
                let [cos_0, sin_0] = Rotation::by(self.circle.start_angle).cos_sin();
                let [cos, sin] = Rotation::by(self.circle.start_angle + angle).cos_sin();
                target.displacement += radius * vec2(cos - cos_0, sin - sin_0);
                target.velocity = radius * rate * vec2(-sin, cos);
                target.acceleration = radius * (acceleration * vec2(-sin, cos) - rate * rate * vec2(cos, sin));
            }
            ReferenceKind::External => {}
            ReferenceKind::Table => self.write_table(t, target),
        }
    }

    /// Apart from the other kinds, whose code it would make longer.
    #[inline(never)]
    fn write_table(&self, t: f64, target: &mut Target) {
        let motion = self.table.as_ref().map_or(Target::AT_REST, |table| table.at(t));
        *target = Target { displacement: target.displacement + motion.displacement, ..motion };
    }
}
