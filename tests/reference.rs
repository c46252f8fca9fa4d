//! The wanted motion of the end effector, against closed forms and differences.

mod common;

use std::slice::from_ref;

use common::{REACH, assert_close, cases, derivative};
use proptest::prelude::*;
use uam::reference::{Circle, Leg, Profile, Reference, ReferenceInstant, ReferenceKind};

fn leg(profile: Profile) -> Leg {
    Leg { start: 1.0, duration: 3.0, ramp: 0.5, dx: 0.3, dy: -0.4, profile }
}

fn path(legs: &[Leg]) -> Reference {
    let mut all = [Leg::NONE; 4];
    all[..legs.len()].clone_from_slice(legs);
    Reference {
        kind: ReferenceKind::Path,
        legs: all,
        circle: Circle { diameter: 0.1, duration: 4.0, start_angle: 0.7 },
        instant: ReferenceInstant::StepStart,
        table: None,
    }
}

fn circle() -> Reference {
    Reference { kind: ReferenceKind::Circle, ..path(&[]) }
}

/// Position, velocity, acceleration in one list.
fn motion(reference: &Reference, t: f64) -> [f64; 6] {
    let at = reference.at(t);
    [at.displacement.x, at.displacement.y, at.velocity.x, at.velocity.y, at.acceleration.x, at.acceleration.y]
}

/// A trapezoid of height v = 1 / (3 s - 0.5 s) = 0.4/s: ways v t^2 / (2 ramp), v (t - ramp / 2) and the mirror
/// image of the first.
#[test]
fn trapezoidal_leg_in_closed_form() {
    let leg = leg(Profile::Trapezoidal);
    for (t, expected) in [
        (0.0, [0.0, 0.0, 0.0]),
        (1.0, [0.0, 0.0, 0.0]),
        (1.25, [0.4 * 0.0625, 0.2, 0.8]),
        (1.75, [0.4 * 0.5, 0.4, 0.0]),
        (2.5, [0.5, 0.4, 0.0]),
        (3.75, [1.0 - 0.4 * 0.0625, 0.2, -0.8]),
        (4.0, [1.0, 0.0, 0.0]),
        (1e6, [1.0, 0.0, 0.0]),
    ] {
        assert_close(&leg.progress(t), &expected, 1e-15, &format!("t = {t}"));
    }
}

/// Half of the ramp's time covers a quarter less 1/pi^2 ... of the trapezoid's way: with the acceleration
/// (1 - cos) / T the velocity is t/T - sin(2 pi t/T) / 2 pi, 1/2 in the middle, and the way there
/// T/8 - T/(2 pi^2).
#[test]
fn smooth_ramp_in_closed_form() {
    let [way, rate, acceleration] = leg(Profile::Smooth).progress(1.25);
    let pi = std::f64::consts::PI;
    assert_close(&[way, rate, acceleration], &[0.4 * 0.5 * (0.125 - 0.5 / (pi * pi)), 0.2, 1.6], 1e-15, "mid-ramp");
}

/// Both profiles reach the end with continuous velocity, and the smooth one has continuous acceleration, too.
#[test]
fn profiles_join_smoothly() {
    for profile in [Profile::Trapezoidal, Profile::Smooth] {
        let leg = leg(profile);
        for joint in [1.0, 1.5, 3.5, 4.0] {
            let (before, after) = (leg.progress(joint - 1e-9), leg.progress(joint + 1e-9));
            let continuous = if profile == Profile::Smooth { 3 } else { 2 };
            assert_close(&before[..continuous], &after[..continuous], 2e-8, &format!("{profile:?} at {joint}"));
        }
    }
}

/// Two ramps may fill the whole leg.
#[test]
fn a_leg_of_two_ramps_only() {
    for profile in [Profile::Trapezoidal, Profile::Smooth] {
        let leg = Leg { ramp: 1.5, ..leg(profile) };
        assert_close(&leg.progress(2.5)[..2], &[0.5, 2.0 / 3.0], 1e-14, "middle");
        assert_eq!(leg.progress(4.0), [1.0, 0.0, 0.0]);
        assert!(path(&[leg]).check().is_ok());
    }
}

#[test]
fn a_leg_without_ramps_moves_at_constant_velocity() {
    let leg = Leg { ramp: 0.0, ..leg(Profile::Trapezoidal) };
    assert_close(&leg.progress(2.0), &[1.0 / 3.0, 1.0 / 3.0, 0.0], 1e-15, "third");
    assert!(path(&[leg]).check().is_ok());
}

#[test]
fn overlapping_legs_add_up() {
    let first = leg(Profile::Smooth);
    let second = Leg { start: 2.0, duration: 5.0, ramp: 0.7, dx: -0.1, dy: 0.2, profile: Profile::Trapezoidal };
    let both = path(&[first, second]);
    for t in [0.5, 1.2, 2.3, 3.9, 6.8, 9.0] {
        let (a, b) = (motion(&path(from_ref(&first)), t), motion(&path(from_ref(&second)), t));
        assert_close(&motion(&both, t), &std::array::from_fn::<_, 6, _>(|i| a[i] + b[i]), 1e-15, &format!("{t}"));
    }
    assert_close(&motion(&both, 9.0), &[0.2, -0.2, 0.0, 0.0, 0.0, 0.0], 1e-15, "end");
}

/// From rest at the start angle, counter-clockwise through all of the circle, back to rest at the start.
#[test]
fn circle_starts_at_rest_closes_and_stays_on_the_circle() {
    let circle = circle();
    let center = -0.05 * nalgebra::Vector2::new(0.7_f64.cos(), 0.7_f64.sin());
    assert_eq!(motion(&circle, 0.0), [0.0; 6]);
    assert_close(&motion(&circle, 4.0), &[0.0; 6], 1e-15, "end");
    assert_close(&motion(&circle, 100.0), &[0.0; 6], 1e-15, "afterwards");
    assert_close(circle.at(2.0).displacement.as_slice(), (2.0 * center).as_slice(), 1e-15, "half-way");
    assert!(circle.at(0.5).velocity.dot(&nalgebra::Vector2::new(-(0.7_f64.sin()), 0.7_f64.cos())) > 0.0);
    for i in 0..=400 {
        let from_center = circle.at(0.01 * f64::from(i)).displacement - center;
        assert_close(&[from_center.norm()], &[0.05], 1e-15, "radius");
    }
    for joint in [0.0, 2.0, 4.0] {
        assert_close(&motion(&circle, joint - 1e-9), &motion(&circle, joint + 1e-9), 1e-8, "continuous");
    }
}

#[test]
fn external_reference_is_no_motion_of_its_own() {
    let external = Reference { kind: ReferenceKind::External, ..path(&[leg(Profile::Smooth)]) };
    assert_eq!(motion(&external, 2.0), [0.0; 6]);
}

#[test]
fn check_names_the_leg_whose_ramps_do_not_fit() {
    let good = leg(Profile::Smooth);
    let long = Leg { ramp: 1.5001, ..good };
    let message = path(&[good, good, long]).check().unwrap_err().to_string();
    assert!(message.contains("reference.leg[3].ramp = 1.5001"), "{message}");
    let sudden = Leg { ramp: 0.0, ..good };
    let message = path(&[good, sudden]).check().unwrap_err().to_string();
    assert!(message.contains("reference.leg[2].ramp = 0"), "{message}");
    // A leg without duration is none, whatever its ramp.
    let none = Leg { duration: 0.0, ramp: 9.0, ..good };
    assert!(path(&[none, good]).check().is_ok());
    assert_eq!(motion(&path(&[none]), 2.0), [0.0; 6]);
}

proptest! {
    #![proptest_config(cases(256))]

    /// Velocity is the derivative of position, acceleration that of velocity, by differences away
    /// from the corners of the trapezoid.
    #[test]
    fn velocity_and_acceleration_are_derivatives(t in 0.0..6.0_f64, kind in 0..3) {
        let corner = [1.0, 1.5, 3.5, 4.0].iter().any(|corner| (t - corner).abs() < REACH);
        prop_assume!(!corner && (t - 2.0).abs() > REACH);
        let reference = match kind {
            0 => path(&[leg(Profile::Trapezoidal)]),
            1 => path(&[leg(Profile::Smooth)]),
            _ => circle(),
        };
        let now = reference.at(t);
        assert_close(now.velocity.as_slice(), derivative(|s| reference.at(t + s).displacement).as_slice(), 1e-10, "v");
        assert_close(now.acceleration.as_slice(), derivative(|s| reference.at(t + s).velocity).as_slice(), 1e-9, "a");
    }
}
