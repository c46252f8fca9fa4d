//! Numbers that sum up a run, and how people read them.

use std::fmt;

use super::LOST;
use crate::record::Recording;

/// A number that sums up a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Largest way of the UAV to the right.
    FarthestRight,
    /// Largest way of the UAV to the left.
    FarthestLeft,
    /// Way of the UAV to the right at the end.
    FinalX,
    /// Deepest sinking of the UAV.
    Sinking,
    /// Largest roll, either way.
    Roll,
    /// Largest torque of the rotors, either way.
    Torque,
    /// Largest moment of the arm on the UAV, either way.
    Moment,
    /// Largest distance between end effector and reference at the communication points.
    TrackingError,
    /// The same along x only, either way.
    ErrorX,
    /// The same at the end.
    FinalErrorX,
    /// The largest along y only, either way.
    ErrorY,
    /// Largest deviation of the thrust from the weight at the start, as a share of it.
    Thrust,
    /// Largest distance along x between the UAV and where the controller predicts it.
    MissedX,
    /// Largest distance along y between the UAV and where the controller predicts it.
    MissedY,
    /// Largest difference between the roll and what the controller predicts.
    MissedRoll,
    /// [`Quantity::MissedY`] as a share of the UAV's largest way along y.
    MissedYShare,
    /// [`Quantity::MissedRoll`] as a share of the largest roll.
    MissedRollShare,
    /// When [`Quantity::TrackingError`] exceeds [`LOST`] for the first time.
    LostAt,
}

impl Quantity {
    /// Every quantity, in the order of tables.
    pub const ALL: [Self; 18] = [
        Self::FarthestRight,
        Self::FarthestLeft,
        Self::FinalX,
        Self::Sinking,
        Self::Roll,
        Self::Torque,
        Self::Moment,
        Self::TrackingError,
        Self::ErrorX,
        Self::FinalErrorX,
        Self::ErrorY,
        Self::Thrust,
        Self::MissedX,
        Self::MissedY,
        Self::MissedRoll,
        Self::MissedYShare,
        Self::MissedRollShare,
        Self::LostAt,
    ];

    /// What it is, for tables.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::FarthestRight => "UAV farthest right",
            Self::FarthestLeft => "UAV farthest left",
            Self::FinalX => "UAV at the end, to the right",
            Self::Sinking => "UAV sinks by",
            Self::Roll => "largest roll",
            Self::Torque => "largest torque U2",
            Self::Moment => "largest moment of the arm on the UAV",
            Self::TrackingError => "largest end-effector error",
            Self::ErrorX => "largest end-effector error in x",
            Self::FinalErrorX => "end-effector error in x at the end",
            Self::ErrorY => "largest end-effector error in y",
            Self::Thrust => "thrust differs from the weight by",
            Self::MissedX => "prediction misses the UAV's x by",
            Self::MissedY => "prediction misses the UAV's y by",
            Self::MissedRoll => "prediction misses the roll by",
            Self::MissedYShare => "prediction misses the UAV's y by, of its way in y",
            Self::MissedRollShare => "prediction misses the roll by, of the largest",
            Self::LostAt => "arm leaves its workspace at",
        }
    }

    /// The number in SI units. Not a number if the recording lacks the columns; infinite if what is asked
    /// for never happens.
    #[must_use]
    pub fn measure(self, recording: &Recording) -> f64 {
        let largest = |name: &str, sign: f64| peak(recording.column(name).iter().map(|value| sign * value));
        let size = |name: &str| peak(recording.column(name).iter().map(|value| value.abs()));
        let apart = |found: &str, wanted: &str| {
            let pairs = recording.column(found).iter().zip(recording.column(wanted));
            peak(pairs.map(|(found, wanted)| (found - wanted).abs()))
        };
        match self {
            Self::FarthestRight => largest("base.x", 1.0),
            Self::FarthestLeft => largest("base.x", -1.0),
            Self::FinalX => recording.column("base.x").last().copied().unwrap_or(f64::NAN),
            Self::Sinking => largest("base.y", -1.0),
            Self::Roll => size("base.roll"),
            Self::Torque => size("autopilot.torque"),
            Self::Moment => size("transmitted.moment"),
            Self::TrackingError => peak(recording.tracking_error().into_iter()),
            Self::ErrorX => apart("end_effector.x", "reference.x"),
            Self::FinalErrorX => {
                let last = |name: &str| recording.column(name).last().copied().unwrap_or(f64::NAN);
                (last("end_effector.x") - last("reference.x")).abs()
            }
            Self::ErrorY => apart("end_effector.y", "reference.y"),
            Self::Thrust => {
                let thrust = recording.column("autopilot.thrust");
                let weight = thrust.first().copied().unwrap_or(f64::NAN);
                peak(thrust.iter().map(|thrust| (thrust / weight - 1.0).abs()))
            }
            Self::MissedX => apart("base.x", "predicted.base.x"),
            Self::MissedY => apart("base.y", "predicted.base.y"),
            Self::MissedRoll => apart("base.roll", "predicted.base.roll"),
            Self::MissedYShare => Self::MissedY.measure(recording) / size("base.y"),
            Self::MissedRollShare => Self::MissedRoll.measure(recording) / size("base.roll"),
            Self::LostAt => {
                let lost = recording.tracking_error().iter().position(|&error| error > LOST || error.is_nan());
                lost.map_or(f64::INFINITY, |row| recording.times()[row])
            }
        }
    }

    /// The number as people read it.
    #[must_use]
    pub fn show(self, value: f64) -> Shown {
        Shown { quantity: self, value }
    }
}

/// A measured number with the unit in which it is read.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    quantity: Quantity,
    value: f64,
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.value;
        match self.quantity {
            _ if value.is_nan() => write!(f, "–"),
            Quantity::FarthestRight | Quantity::FarthestLeft | Quantity::FinalX | Quantity::Sinking => {
                readable(f, 1e3 * value, "mm")
            }
            Quantity::Roll | Quantity::MissedRoll => readable(f, value.to_degrees(), "°"),
            Quantity::Torque | Quantity::Moment => readable(f, value, "N m"),
            Quantity::Thrust | Quantity::MissedYShare | Quantity::MissedRollShare => readable(f, 100.0 * value, "%"),
            Quantity::TrackingError
            | Quantity::FinalErrorX
            | Quantity::ErrorX
            | Quantity::ErrorY
            | Quantity::MissedX
            | Quantity::MissedY => {
                write!(f, "{value:.1e} m")
            }
            Quantity::LostAt if value.is_infinite() => write!(f, "never"),
            Quantity::LostAt => write!(f, "{value:.1} s"),
        }
    }
}

/// Three digits or so, without noise: what is a thousandth of the unit or less is written with a power of ten.
fn readable(f: &mut fmt::Formatter<'_>, value: f64, unit: &str) -> fmt::Result {
    match value.abs() {
        0.0 => write!(f, "0 {unit}"),
        size if size < 1e-3 => write!(f, "{value:.0e} {unit}"),
        size if size < 1.0 => write!(f, "{value:.3} {unit}"),
        size if size < 10.0 => write!(f, "{value:.2} {unit}"),
        size if size < 1e4 => write!(f, "{value:.1} {unit}"),
        _ => write!(f, "{value:.1e} {unit}"),
    }
}

/// The largest of the numbers; not a number if there are none or one of them is not.
pub(super) fn peak(values: impl Iterator<Item = f64>) -> f64 {
    values.reduce(|peak, value| if peak >= value || peak.is_nan() { peak } else { value }).unwrap_or(f64::NAN)
}
