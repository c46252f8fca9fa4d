//! Vectors and rotations in the plane, against the trigonometric functions.

mod common;

use common::cases;
use proptest::prelude::*;
use uam::mechanics::planar::{Rotation, cross, perp, vec2};

/// How far two turns differ in cosine and sine.
fn difference(a: Rotation, b: Rotation) -> f64 {
    (a.apply(vec2(1.0, 0.0)) - b.apply(vec2(1.0, 0.0))).amax()
}

/// sin(0.03) and cos(0.03) to 20 digits, from their series in exact fractions: a polynomial one term shorter would
/// be off by 4e-15 in the sine.
#[test]
fn a_small_turn_has_the_tabulated_sine_and_cosine() {
    let turned = Rotation::from_small_angle(0.03).apply(vec2(1.0, 0.0));
    assert!((turned.y - 0.029_995_500_202_495_66).abs() <= 7e-18);
    assert!((turned.x - 0.999_550_033_748_987_5).abs() <= 2.3e-16);
}

/// Relative to the angle, so that tiny turns are right, too.
#[test]
fn a_small_turn_equals_the_general_one_to_rounding_up_to_its_bound_and_beyond() {
    for i in -3000..=3000 {
        let angle = f64::from(i) / 1e5;
        let turned = Rotation::from_small_angle(angle).apply(vec2(1.0, 0.0));
        assert!((turned.y - angle.sin()).abs() <= 2.3e-16 * angle.abs(), "sin {angle}");
        assert!((turned.x - angle.cos()).abs() <= 2.3e-16, "cos {angle}");
    }
    for angle in [0.03, -0.03, 0.03_f64.next_up(), 0.5, -3.0, 100.0] {
        assert!(difference(Rotation::from_small_angle(angle), Rotation::by(angle)) <= 4e-16, "{angle}");
    }
}

/// Against the trigonometric functions, all over the circle and far away, where many turns
/// are to be taken off exactly.
#[test]
fn a_turn_has_the_cosine_and_sine_of_its_angle() {
    let part = std::f64::consts::TAU / 256.0;
    let parts = (-1000..=1000).map(|i| f64::from(i) * part);
    let far = (0..2000).map(|i| 25.1 * f64::from(i) - 1e-3);
    let borders = [0.0, -0.0, 1e-300, -1e-9, 4.999_999e4, 5e4, 1e5, -1e9, 1e300];
    for angle in parts.chain(far).chain(borders).flat_map(|angle| [angle, angle.next_up(), angle.next_down(), -angle]) {
        let turned = Rotation::by(angle).apply(vec2(1.0, 0.0));
        assert!((turned.x - angle.cos()).abs() <= 4e-16, "cos {angle}");
        assert!((turned.y - angle.sin()).abs() <= 4e-16, "sin {angle}");
    }
    for angle in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(Rotation::by(angle).apply(vec2(1.0, 0.0)).x.is_nan(), "{angle}");
    }
}

/// A host may have set its processor to round otherwise: a turn then comes out rounded otherwise, but it comes out.
#[cfg(target_arch = "x86_64")]
#[test]
fn a_turn_has_an_end_however_the_processor_rounds() {
    /// MXCSR: to nearest, down, up, towards zero.
    const ROUNDING: [u32; 4] = [0x1f80, 0x3f80, 0x5f80, 0x7f80];
    let set = |word: u32| {
        // SAFETY: the usual word is back before anything but the turns is computed.
        unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) }
    };
    for word in ROUNDING {
        let angles: Vec<f64> = (-700..=700).map(|i| f64::from(i) * 0.009).collect();
        set(word);
        let turns: Vec<_> = std::hint::black_box(&angles).iter().map(|angle| Rotation::by(*angle)).collect();
        set(ROUNDING[0]);
        for (angle, turn) in angles.iter().zip(turns) {
            let turned = turn.apply(vec2(1.0, 0.0));
            assert!((turned - vec2(angle.cos(), angle.sin())).amax() < 2e-15, "{angle}, {word:x}");
        }
    }
}

/// Counter-clockwise: x turns into y. Down turned by +90 degrees points right, up points left.
#[test]
fn turns_are_counter_clockwise() {
    let quarter = Rotation::by(std::f64::consts::FRAC_PI_2);
    assert!((quarter.apply(vec2(1.0, 0.0)) - vec2(0.0, 1.0)).amax() < 1e-15);
    assert!((quarter.down() - vec2(1.0, 0.0)).amax() < 1e-15);
    assert!((quarter.up() - vec2(-1.0, 0.0)).amax() < 1e-15);
    assert_eq!(Rotation::NONE.down(), vec2(0.0, -1.0));
    assert_eq!(Rotation::NONE.up(), vec2(0.0, 1.0));
    assert_eq!(cross(vec2(1.0, 0.0), vec2(0.0, 1.0)), 1.0);
    assert_eq!(perp(vec2(1.0, 2.0)), vec2(-2.0, 1.0));
}

proptest! {
    #![proptest_config(cases(256))]

    /// Angles add under composition, and undo undoes.
    #[test]
    fn turns_compose(a in -7.0..7.0, b in -7.0..7.0, x in -2.0..2.0, y in -2.0..2.0) {
        let v = vec2(x, y);
        prop_assert!(difference(Rotation::by(a).then(Rotation::by(b)), Rotation::by(a + b)) < 2e-15);
        prop_assert!((Rotation::by(a).undo(Rotation::by(a).apply(v)) - v).amax() < 2e-15);
        prop_assert!((Rotation::by(a).apply(v).norm() - v.norm()).abs() < 2e-15);
        // cross(v, perp v) is the squared length, for every turn of both.
        prop_assert!((cross(Rotation::by(a).apply(v), Rotation::by(a).apply(perp(v))) - v.norm_squared()).abs() < 1e-14);
    }
}
