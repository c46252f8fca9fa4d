//! Statements of the thesis, with the interval of numbers that we call agreement (a check mark).

use super::{Claim, Deviation, Quantity};
use crate::study::variation::Changes;

const fn claim(scenario: &'static str, quantity: Quantity, thesis: &'static str, interval: [f64; 2]) -> Claim {
    Claim { scenario, quantity, compared_with: None, thesis, interval, deviation: None }
}

/// About the ratio to the same quantity of another scenario.
const fn ratio(
    scenario: &'static str,
    quantity: Quantity,
    other: &'static str,
    thesis: &'static str,
    interval: [f64; 2],
) -> Claim {
    Claim { compared_with: Some(other), ..claim(scenario, quantity, thesis, interval) }
}

impl Claim {
    /// The statement does not hold with the discretizations `of`.
    const fn but(self, of: [bool; 2], why: &'static str) -> Self {
        self.unless(of, why, &[])
    }

    /// Nor does this, but with these changes of the scenario it does.
    const fn unless(self, of: [bool; 2], why: &'static str, holds_with: Changes<'static>) -> Self {
        Self { deviation: Some(Deviation { of, why, holds_with }), ..self }
    }
}

/// With `euler` only.
const EULER: [bool; 2] = [true, false];
/// With `exact` only.
const EXACT: [bool; 2] = [false, true];
/// With both discretizations.
const BOTH: [bool; 2] = [true, true];

/// A number of this order of magnitude: within a factor of five.
const fn order(size: f64) -> [f64; 2] {
    [0.2 * size, 5.0 * size]
}

/// An error or disturbance of this order of magnitude, or a smaller one.
const fn below(size: f64) -> [f64; 2] {
    [0.0, 5.0 * size]
}

const NEVER: [f64; 2] = [f64::INFINITY, f64::INFINITY];
const MM: f64 = 1e-3;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Following a path although the base moves (chapter 2), with the rates held over each millisecond; the thesis
/// interpolated them. "Kind" stands where the sense of a statement is what counts as agreement: the thesis
/// does not print all durations.
pub const BASE_MOTION: &[Claim] = &[
    claim("2.1a", Quantity::VelocityError, "about 1e-6 m/s", below(1e-6)).unless(
        EULER,
        "rates are held over a step here, and interpolated in the thesis: half a step's acceleration",
        &[("step", "1e-4"), ("sample_time", "1e-4")],
    ),
    claim("2.1a", Quantity::TrackingError, "hundredths of a mm", [0.0, 0.1 * MM]),
    claim("2.1b", Quantity::ErrorX, "beyond 70 mm (kind)", [60.0 * MM, 90.0 * MM]),
    claim("2.1b", Quantity::ErrorY, "about 0.1 mm", [0.05 * MM, 0.2 * MM]),
    claim("2.1b", Quantity::FarthestLeft, "drifts left", [10.0 * MM, 200.0 * MM]),
    claim("2.2a", Quantity::ErrorX, "order of 0.1 mm", [0.03 * MM, 0.3 * MM]),
    claim("2.2a", Quantity::ErrorY, "order of 0.1 mm", [0.03 * MM, 0.3 * MM]),
    claim("2.2a", Quantity::Thrust, "at most 5 %", [0.0, 0.05]),
    claim("2.2b", Quantity::Sinking, "6.5 mm (misprinted 65)", [6.0 * MM, 7.0 * MM]),
    claim("2.2b", Quantity::ErrorY, "the sinking", [6.0 * MM, 7.0 * MM]),
    claim("2.2b", Quantity::ErrorX, "relatively small", [0.0, 1.0 * MM]),
    claim("2.3a", Quantity::ErrorY, "at most 0.3 mm", [0.0, 0.3 * MM]),
    claim("2.3a", Quantity::FinalErrorX, "beyond 1 mm, growing", [1.0 * MM, f64::INFINITY]).unless(
        BOTH,
        "it does grow linearly after the grasp, but to 0.15 mm, and to 1.3 mm if the path takes 3 s as in 2.3b",
        &[("pace", "3.33")],
    ),
    ratio("2.3a", Quantity::ErrorY, "2.2b", "ten times less", [0.0, 0.15]),
    ratio("2.3b", Quantity::Roll, "2.3a", "more (kind)", [1.2, 100.0]),
    ratio("2.3b", Quantity::FarthestRight, "2.3a", "less (kind)", [0.0, 0.9]),
    claim("2.3b", Quantity::MissedX, "tenths of a mm", [0.0, 0.5 * MM]),
    claim("2.3b", Quantity::MissedYShare, "below 5 %", [0.0, 0.05]),
    claim("2.3b", Quantity::MissedRollShare, "up to 10 %", [0.0, 0.15]),
    claim("2.4a", Quantity::TrackingError, "beyond 5 mm, then 50 mm (kind)", [5.0 * MM, 100.0 * MM]),
    ratio("2.4b", Quantity::ErrorY, "2.4a", "improves", [0.0, 0.2]),
    claim("2.4b", Quantity::ErrorX, "no smaller (kind)", [2.0 * MM, 100.0 * MM]),
    claim("2.4b", Quantity::ErrorY, "smaller (kind)", [0.0, 2.0 * MM]),
    claim("2.5a", Quantity::TrackingError, "always below 1 mm", [0.0, 1.0 * MM]).unless(
        EULER,
        "how much a singular configuration costs depends on the step with which it is passed",
        &[("step", "4e-4"), ("sample_time", "4e-4")],
    ),
    claim("2.5b", Quantity::MissedX, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("2.5b", Quantity::MissedY, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("2.5b", Quantity::MissedRoll, "below 0.002°", [0.0, 0.002 * DEGREE]),
    claim("2.5b", Quantity::Roll, "about 2° (kind)", [1.0 * DEGREE, 3.0 * DEGREE]),
];

/// Keeping the arm from disturbing the UAV (chapter 3). The thesis shows the paths of 3.1 and the durations from
/// 3.6 on in figures only; ours are in the scenarios.
pub const REDUNDANCY: &[Claim] = &[
    ratio("3.1a", Quantity::EarlyMoment, "3.1a-minimum-norm", "lower at first", [0.0, 0.9]),
    ratio("3.1a", Quantity::Moment, "3.1a-minimum-norm", "higher later", [1.1, 100.0]),
    claim("3.1a", Quantity::ThirdJoint, "near +1.4 rad (kind)", [0.7, 2.1]),
    ratio("3.1a-doubled-gain", Quantity::EarlyMoment, "3.1a", "lower at first", [0.0, 0.9]),
    ratio("3.1a-doubled-gain", Quantity::Moment, "3.1a", "higher later", [1.1, 100.0])
        .but(BOTH, "on our path, which is not that of the thesis, the arm turns over earlier and the peak is lower"),
    claim("3.1b", Quantity::ErrorX, "then drifts away", [20.0 * MM, f64::INFINITY]),
    claim("3.1b", Quantity::EarlyErrorX, "just below 10 mm at first (kind)", [5.0 * MM, 12.0 * MM]),
    claim("3.1b", Quantity::DriftSpeed, "about 60 mm/s (kind)", [40.0 * MM, 80.0 * MM]),
    claim("3.1b", Quantity::WayY, "below 0.1 mm", [0.0, 0.1 * MM]).unless(
        BOTH,
        "grows with the accelerations of the path, which the thesis does not print",
        &[("pace", "0.7")],
    ),
    claim("3.2a", Quantity::TrackingError, "about 1e-5 m", below(1e-5)),
    claim("3.2a", Quantity::Moment, "about 1e-3 N m", below(1e-3)),
    claim("3.2b", Quantity::TrackingError, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("3.2b", Quantity::WayX, "below 0.1 mm", [0.0, 0.1 * MM]).unless(
        BOTH,
        "0.103 mm with either discretization and any step: it grows with the accelerations of the path",
        &[("pace", "0.9"), ("duration", "12")],
    ),
    claim("3.2b", Quantity::WayY, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("3.2b", Quantity::Roll, "about 1e-4°", order(1e-4 * DEGREE)),
    ratio("3.2c", Quantity::Moment, "3.2b", "ten times", order(10.0)),
    ratio("3.2c", Quantity::WayX, "3.2b", "ten times", order(10.0)),
    ratio("3.2c", Quantity::WayY, "3.2b", "ten times", order(10.0)).but(
        BOTH,
        "grows with the accelerations of the path: 3 times that of 3.2b as it is, with sides of 1.5 s instead of 3 s",
    ),
    claim("3.2c", Quantity::TrackingError, "below 0.5 mm", [0.0, 0.5 * MM]),
    claim("3.2d", Quantity::Moment, "0.2 N m after a peak", [0.1, 2.0]),
    claim("3.2d", Quantity::Sinking, "6 mm (misprinted 6 cm)", [5.5 * MM, 7.0 * MM]),
    ratio("3.2d", Quantity::Rate, "3.2b", "rises, oscillating", [1.2, 1000.0]),
    ratio("3.2e", Quantity::Moment, "3.2d", "the same", [0.7, 1.4]),
    ratio("3.2e", Quantity::TrackingError, "3.2d", "smaller", [0.0, 0.8]),
    claim("3.2e", Quantity::FinalErrorX, "grows linearly", [0.01 * MM, 5.0 * MM]).but(EXACT, "no error is left"),
    ratio("3.3", Quantity::TrackingError, "3.2c", "the same", [0.8, 1.2]),
    ratio("3.3", Quantity::Moment, "3.2c", "ten times smaller", [0.0, 0.15]),
    ratio("3.3", Quantity::Roll, "3.2c", "ten times smaller", [0.0, 0.15]),
    ratio("3.3", Quantity::WayX, "3.2c", "not as much smaller", [0.5, 10.0]),
    claim("3.4-1", Quantity::ErrorX, "good results (kind)", [0.0, 0.1 * MM]),
    claim("3.4-1", Quantity::ElementSwings, "no oscillations", [0.0, 10.0]),
    claim("3.4-1", Quantity::ElementJump, "jumps at the grasp", [10.0, 40.0]),
    ratio("3.4-2", Quantity::ElementSwings, "3.4-1", "oscillates", [5.0, f64::INFINITY]),
    ratio("3.4-2", Quantity::ErrorX, "3.4-1", "the same order", order(1.0)),
    claim("3.4-3", Quantity::ErrorX, "grows from the grasp on", [0.01 * MM, 5.0 * MM])
        .but(EXACT, "no error is left: each plan starts from where the grasp has brought the system"),
    claim("3.4-3", Quantity::MassDriftSpeed, "centre of mass drifts", [0.01 * MM, f64::INFINITY]).but(
        BOTH,
        "the payload is taken over with the momentum of the whole system kept, so that the centre of mass stays; the \
         mass that jumps in (3.22) is what drifts in the thesis",
    ),
    claim("3.5a", Quantity::ErrorX, "acceptable", [0.0, 1.0 * MM]),
    claim("3.5a", Quantity::ErrorY, "above 10 mm (kind)", [10.0 * MM, 50.0 * MM]).unless(
        BOTH,
        "grows with the accelerations of the path, 7 mm at three times its pace; but where it is above 10 mm, the \
             UAV moves along x by more than 1 mm",
        &[("pace", "5.5")],
    ),
    ratio("3.5a", Quantity::ErrorY, "3.5b", "far larger", [5.0, 1000.0]),
    claim("3.5a", Quantity::ErrorYWithoutBase, "the UAV's", [0.0, 0.2 * MM]),
    claim("3.5a", Quantity::WayX, "below 1 mm", [0.0, 1.0 * MM]),
    ratio("3.5b", Quantity::TrackingError, "3.2c", "the same", [0.8, 1.2]),
    claim("3.6a", Quantity::TrackingError, "about 0.1 mm", below(0.1 * MM)),
    claim("3.6a", Quantity::JointsReturn, "below 2°", [0.0, 2.0 * DEGREE]),
    claim("3.6a", Quantity::Moment, "about 1e-4 N m", below(1e-4)),
    claim("3.6a", Quantity::Roll, "about 1e-4 rad", below(1e-4)),
    claim("3.6a", Quantity::WayX, "1 to 2 mm", [0.5 * MM, 2.5 * MM]),
    claim("3.6a-segment", Quantity::TrackingError, "about 0.1 mm", below(0.1 * MM)),
    claim("3.6a-segment", Quantity::JointsReturn, "below 2°", [0.0, 2.0 * DEGREE]),
    claim("3.6a-segment", Quantity::Moment, "about 1e-4 N m", below(1e-4)),
    claim("3.6a-segment", Quantity::Roll, "about 1e-4 rad", below(1e-4)),
    claim("3.6a-segment", Quantity::WayX, "1 to 2 mm", [0.5 * MM, 2.5 * MM]),
    // The first joint has no motor.
    claim("3.6b", Quantity::TrackingError, "below 0.2 mm", [0.0, 0.2 * MM]),
    claim("3.6b-segment", Quantity::TrackingError, "below 0.2 mm", [0.0, 0.2 * MM]),
    claim("3.6c", Quantity::TrackingError, "about 0.1 mm", below(0.1 * MM)),
    ratio("3.6c", Quantity::Moment, "3.6a", "ten times", order(10.0))
        .but(EULER, "as small as with the arm in the middle: (3.26) covers any mount"),
    claim("3.6c", Quantity::WayX, "no larger (1 to 2 mm)", [0.0, 2.5 * MM]),
    claim("3.6c", Quantity::Roll, "no larger (1e-4 rad)", below(1e-4)),
    claim("3.6c-segment", Quantity::TrackingError, "about 0.1 mm", below(0.1 * MM)),
    ratio("3.6c-segment", Quantity::Moment, "3.6a-segment", "ten times", order(10.0))
        .but(EULER, "as small as with the arm in the middle: (3.26) covers any mount"),
    claim("3.6c-segment", Quantity::WayX, "no larger (1 to 2 mm)", [0.0, 2.5 * MM]),
    claim("3.6c-segment", Quantity::Roll, "no larger (1e-4 rad)", below(1e-4)),
    ratio("3.7", Quantity::EarlyMoment, "3.7-extended-jacobian", "the same at first", [0.9, 1.1]),
    claim("3.7", Quantity::Rate, "2 rad/s", [1.99, 2.0 + 1e-9]),
    ratio("3.7", Quantity::Moment, "3.7-extended-jacobian", "rises where the limit binds", [2.0, f64::INFINITY]),
    claim("3.7", Quantity::LateMoment, "falls again", [0.0, 5e-3]),
    ratio("3.7", Quantity::WayX, "3.7-extended-jacobian", "no larger", [0.0, 1.1]),
    claim("3.7", Quantity::TrackingError, "below 0.11 mm", [0.0, 0.11 * MM]).unless(
        EULER,
        "0.13 mm, as with the extended Jacobian: proportional to the step",
        &[("step", "7e-4"), ("sample_time", "7e-4")],
    ),
    claim("3.8a", Quantity::LostAt, "reaches 130 mm", NEVER),
    claim("3.8a", Quantity::WayX, "below 0.5 mm", [0.0, 0.5 * MM]).unless(
        BOTH,
        "0.8 to 0.9 mm if the motion takes 4 s as the text says, 0.3 mm if it takes 4 s each way",
        &[("pace", "0.5"), ("duration", "10")],
    ),
    claim("3.8a", Quantity::Roll, "about 1e-4° (kind)", below(1e-4 * DEGREE)),
    claim("3.8a", Quantity::Moment, "about 0.1 N m (kind)", below(0.1)),
    claim("3.8b", Quantity::LostAt, "reaches 240 mm", NEVER),
    claim("3.8b", Quantity::TrackingError, "somewhat above 1 mm", below(1.0 * MM)),
    claim("3.8b", Quantity::Roll, "about 0.1°", order(0.1 * DEGREE)),
    claim("3.8b", Quantity::WayX, "above 7 mm", [7.0 * MM, 50.0 * MM]),
    claim("3.8b", Quantity::WayY, "above 15 mm", [15.0 * MM, 75.0 * MM]),
    claim("3.8b", Quantity::CounterweightRight, "a little right first", [1.0 * MM, 60.0 * MM]),
    claim("3.8b", Quantity::CounterweightLeft, "to -125 mm", [-125.0 * MM - 1e-9, -124.9 * MM]),
    claim("3.8b", Quantity::JointsReturn, "ends elsewhere", [20.0 * DEGREE, 360.0 * DEGREE]),
];

/// Picking up the payload with two links (4.2).
pub const TWO_LINKS: &[Claim] = &[
    claim("4.2a", Quantity::TrackingError, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("4.2a", Quantity::FarthestRight, "50 mm", [45.0 * MM, 55.0 * MM]),
    claim("4.2a", Quantity::FinalX, "comes back, not quite", [1.0 * MM, 20.0 * MM]),
    claim("4.2a", Quantity::Sinking, "100 mm", [90.0 * MM, 110.0 * MM]),
    claim("4.2a", Quantity::FinalLoad, "the weight (4.9 N)", [4.8, 5.0]),
    claim("4.2b", Quantity::Sinking, "below 40 mm", [0.0, 40.0 * MM]),
];

/// Picking up the payload with three links (4.3). Sinking is stated for two links (4.2); the text says
/// that it is the same. No end-effector error is stated for three links.
pub const PICK_UP: &[Claim] = &[
    claim("4.3a", Quantity::FarthestRight, "about 110 mm", [105.0 * MM, 115.0 * MM]),
    claim("4.3a", Quantity::FinalX, "20 mm", [15.0 * MM, 25.0 * MM]),
    claim("4.3a", Quantity::Sinking, "about 100 mm (4.2)", [90.0 * MM, 110.0 * MM]),
    claim("4.3a", Quantity::Torque, "up to 0.7 N m", [0.6, 0.8]),
    claim("4.3b", Quantity::FinalX, "about 5 mm", [4.0 * MM, 6.0 * MM]),
    claim("4.3b", Quantity::Roll, "practically none", [0.0, 0.1 * DEGREE]),
    claim("4.3b", Quantity::Torque, "negligible", [0.0, 0.07]),
    claim("4.3c-minimum-norm", Quantity::LostAt, "13 s", [11.5, 14.0]),
    claim("4.3c-extended-jacobian", Quantity::FinalX, "about 5 mm", [4.0 * MM, 6.0 * MM]),
    claim("4.3c-extended-jacobian", Quantity::Roll, "practically none", [0.0, 0.1 * DEGREE]),
    claim("4.3c-extended-jacobian", Quantity::LostAt, "never", NEVER),
];

/// Picking up the payload with a counterweight (4.4).
pub const REACH: &[Claim] = &[
    claim("4.4a", Quantity::LostAt, "reaches 110 mm", NEVER),
    claim("4.4a", Quantity::WayX, "below 10 mm", [0.0, 10.0 * MM]),
    claim("4.4a", Quantity::Roll, "about 0.01°", order(0.01 * DEGREE)),
    claim("4.4a", Quantity::Moment, "about 0.1 N m", below(0.1)),
    claim("4.4b", Quantity::LostAt, "reaches 125 mm", NEVER),
    claim("4.4b", Quantity::WayX, "about 30 mm", [20.0 * MM, 40.0 * MM]),
    claim("4.4b", Quantity::Roll, "about 0.1°", order(0.1 * DEGREE)),
    claim("4.4b", Quantity::Moment, "about 0.1 N m", below(0.1)),
    claim("4.4b", Quantity::CounterweightLeft, "to -125 mm", [-125.0 * MM - 1e-9, -124.9 * MM]),
];
