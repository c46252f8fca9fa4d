//! Physical units of the interface variables, with the units in which hosts should display them.

/// A coherent SI unit as a product of powers of base units.
#[derive(Debug, PartialEq)]
pub struct PhysicalUnit {
    /// Name as in model descriptions, for instance `N.m`.
    pub name: &'static str,
    /// Exponent of the kilogram.
    pub kg: i8,
    /// Exponent of the metre.
    pub m: i8,
    /// Exponent of the second.
    pub s: i8,
    /// Exponent of the radian.
    pub rad: i8,
    /// How people like to read it.
    pub display: Option<Display>,
}

/// A unit for display: value in this unit = `factor` * value in the SI unit.
#[derive(Debug, PartialEq)]
pub struct Display {
    /// Name, for instance `deg`.
    pub name: &'static str,
    /// Display units per SI unit.
    pub factor: f64,
}

const DEGREES_PER_RADIAN: f64 = 180.0 / std::f64::consts::PI;

const fn unit(name: &'static str, [kg, m, s, rad]: [i8; 4]) -> PhysicalUnit {
    PhysicalUnit { name, kg, m, s, rad, display: None }
}

const fn shown(mut unit: PhysicalUnit, name: &'static str, factor: f64) -> PhysicalUnit {
    unit.display = Some(Display { name, factor });
    unit
}

/// A pure number.
pub static ONE: PhysicalUnit = unit("1", [0, 0, 0, 0]);
/// Mass.
pub static KILOGRAM: PhysicalUnit = unit("kg", [1, 0, 0, 0]);
/// Frequency, and rate of decay.
pub static PER_SECOND: PhysicalUnit = unit("1/s", [0, 0, -1, 0]);
/// Length.
pub static METRE: PhysicalUnit = shown(unit("m", [0, 1, 0, 0]), "mm", 1000.0);
/// Time.
pub static SECOND: PhysicalUnit = shown(unit("s", [0, 0, 1, 0]), "ms", 1000.0);
/// Angle.
pub static RADIAN: PhysicalUnit = shown(unit("rad", [0, 0, 0, 1]), "deg", DEGREES_PER_RADIAN);
/// Velocity.
pub static METRE_PER_SECOND: PhysicalUnit = shown(unit("m/s", [0, 1, -1, 0]), "mm/s", 1000.0);
/// Acceleration.
pub static METRE_PER_SECOND2: PhysicalUnit = unit("m/s2", [0, 1, -2, 0]);
/// Angular velocity.
pub static RADIAN_PER_SECOND: PhysicalUnit = shown(unit("rad/s", [0, 0, -1, 1]), "deg/s", DEGREES_PER_RADIAN);
/// Angular acceleration.
pub static RADIAN_PER_SECOND2: PhysicalUnit = shown(unit("rad/s2", [0, 0, -2, 1]), "deg/s2", DEGREES_PER_RADIAN);
/// Force.
pub static NEWTON: PhysicalUnit = unit("N", [1, 1, -2, 0]);
/// Moment of a force.
pub static NEWTON_METRE: PhysicalUnit = unit("N.m", [1, 2, -2, 0]);
/// Moment of inertia.
pub static KILOGRAM_METRE2: PhysicalUnit = unit("kg.m2", [1, 2, 0, 0]);
/// Linear momentum.
pub static NEWTON_SECOND: PhysicalUnit = unit("N.s", [1, 1, -1, 0]);
/// Angular momentum.
pub static NEWTON_METRE_SECOND: PhysicalUnit = unit("N.m.s", [1, 2, -1, 0]);
/// Stiffness; altitude gain kp.
pub static NEWTON_PER_METRE: PhysicalUnit = unit("N/m", [1, 0, -2, 0]);
/// Altitude gain ki.
pub static NEWTON_PER_METRE_SECOND: PhysicalUnit = unit("N/(m.s)", [1, 0, -3, 0]);
/// Altitude gain kd.
pub static NEWTON_SECOND_PER_METRE: PhysicalUnit = unit("N.s/m", [1, 0, -1, 0]);
/// Roll gain kp.
pub static NEWTON_METRE_PER_RADIAN: PhysicalUnit = unit("N.m/rad", [1, 2, -2, -1]);
/// Roll gain ki.
pub static NEWTON_METRE_PER_RADIAN_SECOND: PhysicalUnit = unit("N.m/(rad.s)", [1, 2, -3, -1]);
/// Roll gain kd.
pub static NEWTON_METRE_SECOND_PER_RADIAN: PhysicalUnit = unit("N.m.s/rad", [1, 2, -1, -1]);
/// Gain of the gradient projection.
pub static RADIAN_PER_METRE2_SECOND: PhysicalUnit = unit("rad/(m2.s)", [0, -2, -1, 1]);
/// Weight of a joint rate beside the square of a moment.
pub static NEWTON2_METRE2_SECOND_PER_RADIAN: PhysicalUnit = unit("N2.m2.s/rad", [2, 4, -3, -1]);
