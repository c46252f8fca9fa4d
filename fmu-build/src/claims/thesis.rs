//! Statements of the thesis, with the interval of numbers that we call agreement (a check mark).

use super::{Claim, Deviation, Quantity};

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
        Self { deviation: Some(Deviation { of, why }), ..self }
    }
}

/// With `euler` only.
const EULER: [bool; 2] = [true, false];
/// With `exact` only.
#[expect(dead_code)]
const EXACT: [bool; 2] = [false, true];
/// With both discretizations.
const BOTH: [bool; 2] = [true, true];

const NEVER: [f64; 2] = [f64::INFINITY, f64::INFINITY];
const MM: f64 = 1e-3;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Following a path although the base moves (chapter 2), with the rates held over each millisecond; the thesis
/// interpolated them. "Kind" stands where the sense of a statement is what counts as agreement: the thesis
/// does not print all durations.
pub const BASE_MOTION: &[Claim] = &[
    claim("2.1a", Quantity::VelocityError, "about 1e-6 m/s", [0.0, 1e-5]),
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
    claim("2.3a", Quantity::FinalErrorX, "beyond 1 mm, growing", [1.0 * MM, f64::INFINITY])
        .but(BOTH, "it does grow linearly after the grasp, but to 0.15 mm"),
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
    claim("2.5a", Quantity::TrackingError, "always below 1 mm", [0.0, 1.0 * MM])
        .but(EULER, "how much a singular configuration costs depends on how close it is passed"),
    claim("2.5b", Quantity::MissedX, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("2.5b", Quantity::MissedY, "below 0.1 mm", [0.0, 0.1 * MM]),
    claim("2.5b", Quantity::MissedRoll, "below 0.002°", [0.0, 0.002 * DEGREE]),
    claim("2.5b", Quantity::Roll, "about 2° (kind)", [1.0 * DEGREE, 3.0 * DEGREE]),
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
