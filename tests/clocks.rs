//! Hosts' clocks are not even: what that may cost, and what never changes with it.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::coupling::Coupling;
use common::random::Random;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Hold, Resolution};
use uam::{Parameters, Structure};

/// Lengths of steps one after the other.
type Steps = Box<dyn FnMut(usize) -> f64>;

/// A name, its steps, the even step that it is compared with \[s\], and how near the path it keeps \[m\].
type Uneven = (&'static str, fn() -> Steps, f64, f64);

/// What a run shows: largest error of the end effector from the second step on \[m\], largest roll \[rad\] and rate \[rad/s\].
#[derive(Debug)]
struct Seen {
    error: f64,
    roll: f64,
    rate: f64,
}

fn pick_up(change: impl Fn(&mut Parameters)) -> Parameters {
    let mut parameters = default_parameters(Structure::DEFAULT);
    change(&mut parameters);
    parameters
}

fn undamped(parameters: &mut Parameters) {
    parameters.ik.moment_damping = 0.0;
}

/// Reaching out, the grasp at 1.6 s, and the first of the way back.
fn run(parameters: &Parameters, mut steps: Steps) -> Seen {
    let mut coupling = Coupling::new(Structure::DEFAULT, parameters);
    let mut seen = Seen { error: 0.0, roll: 0.0, rate: 0.0 };
    for n in 0.. {
        coupling.step(steps(n));
        // The first plan is made before any step is known.
        if n > 0 {
            seen.error = seen.error.max(coupling.error());
        }
        seen.roll = seen.roll.max(coupling.plant.outputs.pose.z.abs());
        seen.rate = coupling.commands.rate_command.iter().fold(seen.rate, |most, rate| most.max(rate.abs()));
        if coupling.plant.time > 3.0 {
            break;
        }
    }
    seen
}

fn even(step: f64) -> Steps {
    Box::new(move |_| step)
}

fn random(mut step: impl FnMut(&mut Random) -> f64 + 'static) -> Steps {
    let mut random = Random(20_261_130);
    Box::new(move |_| step(&mut random))
}

/// As a clock shows them that counts in units of `unit`, or in single precision.
fn rounded(step: f64, round: impl Fn(f64) -> f64 + 'static) -> Steps {
    Box::new(move |n| round((n + 1) as f64 * step) - round(n as f64 * step))
}

/// Half of the steps a nanosecond shorter, a jitter of one percent, single precision, times rounded to a microsecond, times
/// counted from 1970: roll and rates are at most 1.2 times those of even steps, the end effector is within
/// (1 m/s2 x jitter x step^2) + (speed of the reference, 0.16 m/s, x rounding of the times) of the reference.
#[test]
fn rounding_and_jitter_of_steps_change_nothing_that_counts() {
    for step in [1e-3, 1e-2] {
        let usual = run(&pick_up(undamped), even(step));
        let since_1970 = 1.7e9;
        let clocks: [(&str, Steps, f64); 5] = [
            ("1 ns shorter", random(move |random| if random.coin() { step } else { step - 1e-9 }), 1e-9),
            ("jitter of 1 %", random(move |random| step * random.between(0.99, 1.01)), 0.01 * step * step),
            ("single precision", rounded(step, |t| f64::from(t as f32)), 0.16 * 1.2e-7 * 3.0 + 1e-9),
            ("microseconds", rounded(step, |t| (t * 1e6).round() * 1e-6), 0.16e-6),
            ("since 1970", rounded(step, move |t| (since_1970 + t) - since_1970), 0.16 * 2.4e-7),
        ];
        for (clock, steps, near) in clocks {
            let seen = run(&pick_up(undamped), steps);
            assert!(
                seen.roll <= 1.2 * usual.roll && seen.rate <= 1.2 * usual.rate,
                "{clock}, {step}: {seen:?}, {usual:?}"
            );
            assert!(seen.error <= near + 1e-10, "{clock}, {step}: {:e} m, {near:e}", seen.error);
        }
    }
}

/// Steps that are not even at all, with both holds: 1e-6 m where they are about a millisecond, 1e-4 m where some take 20,
/// and the UAV rolls by at most 0.03 degrees more than with even steps.
#[test]
fn uneven_steps_are_followed() {
    let clocks: [Uneven; 5] = [
        ("1 and 2 ms", || Box::new(|n| [1e-3, 2e-3][n % 2]), 2e-3, 1e-6),
        ("0.5 to 1.5 ms", || random(|random| random.between(5e-4, 1.5e-3)), 1e-3, 1e-6),
        ("10 and 20 ms", || Box::new(|n| [1e-2, 2e-2][n % 2]), 2e-2, 1e-4),
        ("0.1 to 20 ms", || random(|random| random.between(1e-4, 2e-2)), 2e-2, 1e-4),
        ("0.1 or 20 ms", || random(|random| if random.coin() { 1e-4 } else { 2e-2 }), 2e-2, 1e-4),
    ];
    for hold in [Hold::ZeroOrder, Hold::FirstOrder] {
        for (clock, steps, longest, near) in clocks {
            let parameters = pick_up(|p| {
                undamped(p);
                p.ik.hold = hold;
            });
            let (seen, usual) = (run(&parameters, steps()), run(&parameters, even(longest)));
            assert!(seen.error <= near, "{clock}, {hold:?}: {:e} m", seen.error);
            assert!(seen.roll <= usual.roll + 0.03_f64.to_radians(), "{clock}, {hold:?}: {seen:?}, {usual:?}");
        }
    }
}

/// Limits hold to rounding for every sequence of steps none of which is longer than the sample time: rate, change of the rate
/// by the acceleration times the time since it changed last, and both stops. The path leads beyond what they allow.
#[test]
fn limits_hold_on_every_clock() {
    for sample_time in [1e-3, 5e-3, 2e-2] {
        let mut random = Random(7);
        let parameters = pick_up(|p| {
            p.ik.resolution = Resolution::LeastSquares;
            p.ik.sample_time = sample_time;
            p.payload.grasp_time = 1e9;
            for (i, joint) in p.joints.iter_mut().enumerate() {
                (joint.rate_limit, joint.acceleration_limit) = (2.0, 15.0);
                (joint.lower, joint.upper) = (joint.start - 0.2 - 0.1 * i as f64, joint.start + 0.25);
            }
        });
        let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
        let (mut before, mut since, mut at_stop) = (coupling.commands.rate_command, 0.0, false);
        while coupling.plant.time < 3.0 {
            let size = sample_time * if random.coin() { random.between(0.02, 1.0) } else { 1.0 };
            coupling.step(size);
            since += size;
            for (i, joint) in parameters.joints.iter().enumerate().take(3) {
                let (rate, position) = (coupling.commands.rate_command[i], coupling.plant.outputs.position[i]);
                let change = (rate - before[i]).abs();
                assert!(rate.abs() <= 2.0 * (1.0 + 1e-12), "{rate}");
                assert!(change <= 15.0 * since * (1.0 + 1e-12), "{change} in {since} s at {}", coupling.plant.time);
                let past = (joint.lower - position).max(position - joint.upper);
                assert!(past <= 1e-12, "joint {i} is {past:e} rad past its stop at {} s", coupling.plant.time);
                at_stop |= past > -1e-3;
            }
            if coupling.commands.rate_command != before {
                (before, since) = (coupling.commands.rate_command, 0.0);
            }
        }
        assert!(at_stop, "no joint came to its stop");
    }
}

/// Steps of nearly no time trigger nothing: rates stay, and the next plan is made for the usual interval.
#[test]
fn a_step_of_no_time_triggers_nothing() {
    let mut coupling = Coupling::new(Structure::DEFAULT, &pick_up(|_| {}));
    for _ in 0..50 {
        coupling.step(1e-2);
        let rates = coupling.commands.rate_command;
        coupling.step(1e-13);
        assert_eq!(coupling.commands.rate_command, rates);
    }
    assert!(coupling.error() < 1e-9, "{:e}", coupling.error());
}

/// With steps of a tenth of the sample time, rates change once per sample time: also after one step that was longer, which is
/// forgotten after ten times its length, 0.2 s.
#[test]
fn the_sample_time_is_kept() {
    let mut coupling = Coupling::new(Structure::DEFAULT, &pick_up(|p| p.ik.sample_time = 5e-3));
    let mut changes = [0; 3];
    for n in 0..1200 {
        let before = coupling.commands.rate_command;
        coupling.step(if n == 100 { 2e-2 } else { 5e-4 });
        changes[[0, 1, 2][(n / 100).min(11) / 4 % 3]] += u32::from(coupling.commands.rate_command != before);
    }
    let [with_long, after, later] = changes;
    assert!(with_long > 200, "right after the long step, in every step: {changes:?}");
    assert!(after < 200 && (39..42).contains(&later), "0.2 s are 40 sample times: {changes:?}");
}
