//! Numbers that sum up a run.

use uam::Structure;
use uam::control::Status;
use uam::parameters::Balance;
use uam::variables::options::Choice;

use super::LOST;
use super::reading::{Reading, Shown};
use crate::host::record::{NotRecorded, Recording};

/// A number that sums up a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Largest way of the UAV to the right.
    FarthestRight,
    /// Largest way of the UAV to the left.
    FarthestLeft,
    /// Largest way of the UAV along x, either way.
    WayX,
    /// Way of the UAV to the right at the end.
    FinalX,
    /// Velocity of the UAV along x in the last second, either way.
    DriftSpeed,
    /// Deepest sinking of the UAV.
    Sinking,
    /// Largest way of the UAV along y, either way.
    WayY,
    /// Largest roll, either way.
    Roll,
    /// Largest torque of the rotors, either way.
    Torque,
    /// Largest deviation of the thrust from the weight at the start, as a share of it.
    Thrust,
    /// Largest moment of all that the UAV carries on it, either way.
    Moment,
    /// The same in the first quarter of the run.
    EarlyMoment,
    /// The same in the last tenth of the run.
    LateMoment,
    /// Largest distance between end effector and reference at the communication points.
    TrackingError,
    /// The same along x only, either way.
    ErrorX,
    /// The same in the first third of the run.
    EarlyErrorX,
    /// The same at the end.
    FinalErrorX,
    /// The largest along y only, either way.
    ErrorY,
    /// The same without the UAV's own way along y.
    ErrorYWithoutBase,
    /// Largest difference between the mean velocities of end effector and reference over a step.
    VelocityError,
    /// Largest angle between where a joint ends and where it began.
    JointsReturn,
    /// Angle of the third joint at the end.
    ThirdJoint,
    /// Largest rate commanded to a joint.
    Rate,
    /// Largest way of the counterweight to the right before it is leftmost.
    CounterweightRight,
    /// Position of the counterweight at its leftmost.
    CounterweightLeft,
    /// Largest jump of the balance element's acceleration from one communication point to the next.
    ElementJump,
    /// How often the balance element's acceleration changes its sign.
    ElementSwings,
    /// Velocity of the common centre of mass along x in the last second, either way.
    MassDriftSpeed,
    /// Vertical force between payload and end effector at the end.
    FinalLoad,
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
    /// When limits or a singular configuration make the path give way for the first time.
    GivesWayAt,
    /// When [`Quantity::TrackingError`] exceeds [`LOST`] for the first time.
    LostAt,
}

impl Quantity {
    /// Every quantity, in the order of tables.
    pub const ALL: [Self; 36] = [
        Self::FarthestRight,
        Self::FarthestLeft,
        Self::WayX,
        Self::FinalX,
        Self::DriftSpeed,
        Self::Sinking,
        Self::WayY,
        Self::Roll,
        Self::Torque,
        Self::Thrust,
        Self::Moment,
        Self::EarlyMoment,
        Self::LateMoment,
        Self::TrackingError,
        Self::ErrorX,
        Self::EarlyErrorX,
        Self::FinalErrorX,
        Self::ErrorY,
        Self::ErrorYWithoutBase,
        Self::VelocityError,
        Self::JointsReturn,
        Self::ThirdJoint,
        Self::Rate,
        Self::CounterweightRight,
        Self::CounterweightLeft,
        Self::ElementJump,
        Self::ElementSwings,
        Self::MassDriftSpeed,
        Self::FinalLoad,
        Self::MissedX,
        Self::MissedY,
        Self::MissedRoll,
        Self::MissedYShare,
        Self::MissedRollShare,
        Self::GivesWayAt,
        Self::LostAt,
    ];

    /// What it is, for tables.
    #[must_use]
    pub fn label(self) -> &'static str {
        self.reading().0
    }

    fn reading(self) -> (&'static str, Reading) {
        match self {
            Self::FarthestRight => ("UAV farthest right", Reading::Millimetres),
            Self::FarthestLeft => ("UAV farthest left", Reading::Millimetres),
            Self::WayX => ("UAV moves along x by", Reading::Millimetres),
            Self::FinalX => ("UAV at the end, to the right", Reading::Millimetres),
            Self::DriftSpeed => ("UAV drifts in the end with", Reading::MillimetresPerSecond),
            Self::Sinking => ("UAV sinks by", Reading::Millimetres),
            Self::WayY => ("UAV moves along y by", Reading::Millimetres),
            Self::Roll => ("largest roll", Reading::Degrees),
            Self::Torque => ("largest torque U2", Reading::NewtonMetres),
            Self::Thrust => ("thrust differs from the weight by", Reading::Percent),
            Self::Moment => ("largest moment of the arm on the UAV", Reading::NewtonMetres),
            Self::EarlyMoment => ("largest moment of the arm on the UAV in the first quarter", Reading::NewtonMetres),
            Self::LateMoment => ("largest moment of the arm on the UAV in the last tenth", Reading::NewtonMetres),
            Self::TrackingError => ("largest end-effector error", Reading::Metres),
            Self::ErrorX => ("largest end-effector error in x", Reading::Metres),
            Self::EarlyErrorX => ("largest end-effector error in x in the first third", Reading::Metres),
            Self::FinalErrorX => ("end-effector error in x at the end", Reading::Metres),
            Self::ErrorY => ("largest end-effector error in y", Reading::Metres),
            Self::ErrorYWithoutBase => ("largest end-effector error in y without the UAV's way in y", Reading::Metres),
            Self::VelocityError => ("largest error of the mean velocity over a step", Reading::MetresPerSecond),
            Self::JointsReturn => ("joints end beside where they began by", Reading::Degrees),
            Self::ThirdJoint => ("joint 3 at the end", Reading::Radians),
            Self::Rate => ("largest joint rate", Reading::RadiansPerSecond),
            Self::CounterweightRight => ("counterweight first to the right by", Reading::Millimetres),
            Self::CounterweightLeft => ("counterweight leftmost at", Reading::Millimetres),
            Self::ElementJump => ("acceleration of the balance element jumps by", Reading::RadiansPerSecond2),
            Self::ElementSwings => ("acceleration of the balance element turns round", Reading::Times),
            Self::MassDriftSpeed => ("common centre of mass drifts in the end with", Reading::MillimetresPerSecond),
            Self::FinalLoad => ("vertical force on the payload at the end", Reading::Newtons),
            Self::MissedX => ("prediction misses the UAV's x by", Reading::Metres),
            Self::MissedY => ("prediction misses the UAV's y by", Reading::Metres),
            Self::MissedRoll => ("prediction misses the roll by", Reading::Degrees),
            Self::MissedYShare => ("prediction misses the UAV's y by, of its way in y", Reading::Percent),
            Self::MissedRollShare => ("prediction misses the roll by, of the largest", Reading::Percent),
            Self::GivesWayAt => ("path gives way to limits at", Reading::Seconds),
            Self::LostAt => ("arm leaves its workspace at", Reading::Seconds),
        }
    }

    /// Whether vehicles of this structure have what it is about.
    #[must_use]
    pub fn is_of(self, structure: Structure) -> bool {
        match self {
            Self::ThirdJoint => structure.links >= 3,
            Self::CounterweightRight | Self::CounterweightLeft => structure.balance == Balance::Counterweight,
            Self::ElementJump | Self::ElementSwings => structure.balance == Balance::Element,
            _ => true,
        }
    }

    /// The number in SI units. Not a number if the run is too short for it; infinite if what is asked for never
    /// happens.
    ///
    /// # Errors
    /// If the recording lacks a column that it takes.
    pub fn measure(self, recording: &Recording) -> Result<f64, NotRecorded> {
        let largest = |name: &str, sign: f64| Ok(peak(recording.column(name)?.iter().map(|value| sign * value)));
        let size = |name: &str| Ok(peak(recording.column(name)?.iter().map(|value| value.abs())));
        let last = |name: &str| Ok(recording.column(name)?.last().copied().unwrap_or(f64::NAN));
        let apart =
            |found: &str, wanted: &str| Ok(peak(recording.difference(found, wanted)?.into_iter().map(f64::abs)));
        match self {
            Self::FarthestRight => largest("base.x", 1.0),
            Self::FarthestLeft => largest("base.x", -1.0),
            Self::WayX => size("base.x"),
            Self::FinalX => last("base.x"),
            Self::DriftSpeed => drift_speed(recording, "base.x"),
            Self::Sinking => largest("base.y", -1.0),
            Self::WayY => size("base.y"),
            Self::Roll => size("base.roll"),
            Self::Torque => size("autopilot.torque"),
            Self::Thrust => {
                let thrust = recording.column("autopilot.thrust")?;
                let weight = thrust.first().copied().unwrap_or(f64::NAN);
                Ok(peak(thrust.iter().map(|thrust| (thrust / weight - 1.0).abs())))
            }
            Self::Moment => size("transmitted.moment"),
            Self::EarlyMoment => peak_between(recording, "transmitted.moment", [0.0, 0.25]),
            Self::LateMoment => peak_between(recording, "transmitted.moment", [0.9, 1.0]),
            Self::TrackingError => recording.tracking_error().map(peak),
            Self::ErrorX => apart("end_effector.x", "reference.x"),
            Self::EarlyErrorX => {
                let errors = recording.difference("end_effector.x", "reference.x")?.into_iter();
                Ok(peak(errors.take(recording.len() / 3).map(f64::abs)))
            }
            Self::FinalErrorX => Ok(f64::abs(last("end_effector.x")? - last("reference.x")?)),
            Self::ErrorY => apart("end_effector.y", "reference.y"),
            Self::ErrorYWithoutBase => {
                let errors = recording.difference("end_effector.y", "reference.y")?.into_iter();
                Ok(peak(errors.zip(recording.column("base.y")?).map(|(error, base)| (error - base).abs())))
            }
            Self::VelocityError => velocity_error(recording),
            Self::JointsReturn => Ok(peak(joints(recording, "position")?.into_iter().map(|angles| match angles {
                [first, .., last] => (last - first).abs(),
                _ => f64::NAN,
            }))),
            Self::ThirdJoint => last("joint[3].position"),
            Self::Rate => Ok(peak(joints(recording, "rate_command")?.into_iter().flatten().map(|rate| rate.abs()))),
            Self::CounterweightRight => {
                let position = recording.column("counterweight.position")?;
                let leftmost =
                    (0..position.len()).min_by(|&a, &b| position[a].total_cmp(&position[b])).unwrap_or_default();
                Ok(peak(position.iter().take(leftmost + 1).copied()))
            }
            Self::CounterweightLeft => largest("counterweight.position", -1.0).map(|left: f64| -left),
            Self::ElementJump => {
                let acceleration = recording.column("balance_element.acceleration_command")?;
                Ok(peak(acceleration.windows(2).map(|pair| (pair[1] - pair[0]).abs())))
            }
            Self::ElementSwings => recording.column("balance_element.acceleration_command").map(swings),
            Self::MassDriftSpeed => drift_speed(recording, "center_of_mass.x"),
            Self::FinalLoad => last("payload.force_y").map(f64::abs),
            Self::MissedX => apart("base.x", "predicted.base.x"),
            Self::MissedY => apart("base.y", "predicted.base.y"),
            Self::MissedRoll => apart("base.roll", "predicted.base.roll"),
            Self::MissedYShare => Ok(Self::MissedY.measure(recording)? / size("base.y")?),
            Self::MissedRollShare => Ok(Self::MissedRoll.measure(recording)? / size("base.roll")?),
            Self::GivesWayAt => {
                let given_up = |status: &f64| GIVEN_UP.iter().any(|given_up| *status == f64::from(given_up.number()));
                Ok(first_time(recording, recording.column("ik.status")?.iter().position(given_up)))
            }
            Self::LostAt => {
                let lost = |error: &f64| *error > LOST || error.is_nan();
                Ok(first_time(recording, recording.tracking_error()?.iter().position(lost)))
            }
        }
    }

    /// How many times as large a number is as another one of this quantity; none if both are nothing but rounding.
    ///
    /// One that is nothing but rounding compares as if it were as large as that may be.
    #[must_use]
    pub fn ratio(self, value: f64, other: f64) -> Option<f64> {
        let rounding = self.reading().1.rounding();
        if value.abs() <= rounding && other.abs() <= rounding {
            return None;
        }
        let [value, other] = [value, other].map(|value| if value.abs() < rounding { rounding } else { value });
        Some(value / other)
    }

    /// The number as people read it.
    #[must_use]
    pub fn show(self, value: f64) -> Shown {
        Shown { reading: self.reading().1, value }
    }
}

/// Statuses of rates that do not follow the path in full, since nothing does that is allowed.
const GIVEN_UP: [Status; 3] = [Status::PathDamped, Status::RateLimited, Status::PathLimited];

/// All quantities of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numbers([f64; Quantity::ALL.len()]);

impl Numbers {
    /// Measures all quantities that vehicles of this structure have.
    ///
    /// # Errors
    /// If the recording lacks a column that one of them takes.
    pub fn of(recording: &Recording, structure: Structure) -> Result<Self, NotRecorded> {
        let mut numbers = [f64::NAN; Quantity::ALL.len()];
        for (number, quantity) in
            numbers.iter_mut().zip(Quantity::ALL).filter(|(_, quantity)| quantity.is_of(structure))
        {
            *number = quantity.measure(recording)?;
        }
        Ok(Self(numbers))
    }

    /// The number of this quantity, as [`Quantity::measure`] gives it; not a number if the vehicle has nothing of it.
    #[must_use]
    pub fn get(&self, quantity: Quantity) -> f64 {
        let position = Quantity::ALL.iter().position(|other| *other == quantity);
        position.map_or(f64::NAN, |position| self.0[position])
    }
}

/// The columns of all joints with the same last part of their names.
fn joints<'a>(recording: &'a Recording, suffix: &str) -> Result<Vec<&'a [f64]>, NotRecorded> {
    let is_of_joint = |name: &&str| name.starts_with("joint[") && name.ends_with(&format!("].{suffix}"));
    let columns = recording.names().filter(is_of_joint).map(|name| recording.column(name));
    // Every arm has a joint.
    let first = recording.column(&format!("joint[1].{suffix}"));
    first.and_then(|_| columns.collect())
}

/// The time of a row; infinite if there is none.
fn first_time(recording: &Recording, row: Option<usize>) -> f64 {
    row.map_or(f64::INFINITY, |row| recording.times()[row])
}

/// Largest size of a column between two shares of the run's time.
fn peak_between(recording: &Recording, name: &str, shares: [f64; 2]) -> Result<f64, NotRecorded> {
    let values = recording.column(name)?;
    let [Some(first), Some(last)] = [recording.times().first(), recording.times().last()] else { return Ok(f64::NAN) };
    let [from, to] = shares.map(|share| recording.row_at(first + share * (last - first)).unwrap_or_default());
    Ok(peak(values.get(from..=to).unwrap_or_default().iter().map(|value| value.abs())))
}

/// What is smaller than this share of the largest value is rounding: its sign says nothing.
const VISIBLE: f64 = 1e-9;

/// How often numbers change their sign.
fn swings(values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let seen: Vec<f64> = values.iter().copied().filter(|value| value.abs() > VISIBLE * largest).collect();
    seen.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).map(|_| 1.0).sum()
}

/// Mean velocity of what is at `name` along x in the last second, or not a number if the run is shorter.
fn drift_speed(recording: &Recording, name: &str) -> Result<f64, NotRecorded> {
    let (times, x) = (recording.times(), recording.column(name)?);
    let (Some(end), Some(last)) = (times.last(), x.last()) else { return Ok(f64::NAN) };
    Ok(match recording.row_at(end - 1.0) {
        Some(row) if row < x.len() => ((last - x[row]) / (end - times[row])).abs(),
        _ => f64::NAN,
    })
}

/// How fast the distance between end effector and reference changes at most.
fn velocity_error(recording: &Recording) -> Result<f64, NotRecorded> {
    let along = |axis: &str| recording.difference(&format!("end_effector.{axis}"), &format!("reference.{axis}"));
    let (times, x, y) = (recording.times(), along("x")?, along("y")?);
    Ok(peak((1..x.len()).map(|k| (x[k] - x[k - 1]).hypot(y[k] - y[k - 1]) / (times[k] - times[k - 1]))))
}

/// The largest of the numbers; not a number if there are none or one of them is not.
pub fn peak(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .reduce(|peak, value| if peak >= value || peak.is_nan() { peak } else { value })
        .unwrap_or(f64::NAN)
}
