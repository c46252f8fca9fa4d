//! From tasks to rates, against textbook decompositions.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::random::Random;
use common::{assert_close, cases};
use nalgebra::{DMatrix, DVector, Dyn, SMatrix, SVD, SVector};
use proptest::prelude::*;
use uam::control::{PATH_THRESHOLD, Problem, PseudoInverse, Task};
use uam::mechanics::planar::vec2;
use uam::parameters::PathAxes;

/// Length of the stretched arm.
const REACH: f64 = 0.5;

fn problem<const N: usize>(random: &mut Random) -> Problem<N> {
    Problem {
        path: SMatrix::from_fn(|_, _| random.about_zero(0.3)),
        velocity: random.vector(0.3),
        interval: 1e-3,
        caution: 0.0,
        moment: Task { row: SVector::from_fn(|_, _| random.about_zero(0.3)), value: random.about_zero(0.1) },
    }
}

fn svd<const N: usize>(problem: &Problem<N>) -> SVD<f64, Dyn, Dyn> {
    DMatrix::from_fn(2, N, |row, column| problem.path[(row, column)]).svd(true, true)
}

/// Path and moment in one matrix.
fn extended<const N: usize>(Problem { path, velocity, moment, .. }: &Problem<N>) -> (DMatrix<f64>, DVector<f64>) {
    let row = |row: usize, i: usize| if row < 2 { path[(row, i)] } else { moment.row[i] };
    (DMatrix::from_fn(3, N, row), DVector::from_vec(vec![velocity.x, velocity.y, moment.value]))
}

fn resolve<const N: usize>(problem: &Problem<N>, without_moment: bool) -> PseudoInverse<N> {
    problem.resolve(PathAxes::Both, without_moment, REACH)
}

/// Away from singularities: the pseudo-inverse (N = 2..7).
fn check_minimum_norm<const N: usize>(random: &mut Random) {
    let problem = problem::<N>(random);
    let svd = svd(&problem);
    let smallest = svd.singular_values.min();
    let found = resolve(&problem, false);
    assert_close(&[found.min_singular_value], &[smallest], 1e-13, "smallest singular value");
    assert_eq!(found.path_damped, smallest < PATH_THRESHOLD * REACH);
    if smallest > PATH_THRESHOLD * REACH {
        let expected =
            svd.pseudo_inverse(0.0).unwrap() * DVector::from_vec(vec![problem.velocity.x, problem.velocity.y]);
        assert_close(found.rate.as_slice(), expected.as_slice(), 1e-9, "rate");
        assert!(!found.task_damped);
    }
}

/// Path and task exactly; for N = 3 the solution of the extended Jacobian, for more its pseudo-inverse.
fn check_extended<const N: usize>(random: &mut Random) {
    let problem = problem::<N>(random);
    let (matrix, right) = extended(&problem);
    let smallest = matrix.singular_values().min();
    let found = resolve(&problem, true);
    if smallest > PATH_THRESHOLD * REACH {
        assert!(!found.path_damped && !found.task_damped);
        let expected = if N == 3 {
            matrix.clone().lu().solve(&right).unwrap()
        } else {
            matrix.clone().svd(true, true).pseudo_inverse(0.0).unwrap() * &right
        };
        assert_close(found.rate.as_slice(), expected.as_slice(), 1e-9, "rate");
    }
}

/// Everything that can degenerate: no rank at all, parallel or equal columns, the task inside the path's rows.
fn check_bounded<const N: usize>(random: &mut Random) {
    let mut problem = problem::<N>(random);
    let scale = 10_f64.powf(random.between(-200.0, 0.0));
    match (random.unit() * 6.0) as u32 {
        0 => problem.path.fill(0.0),
        1 => problem.path.row_mut(0).fill(0.0),
        2 => problem.path = problem.path.map(|_| 0.2),
        3 => problem.path.set_row(1, &(problem.path.row(0) * -2.0)),
        4 => problem.path *= scale,
        _ => {
            let second = problem.path.row(0) * (1.0 + scale);
            problem.path.set_row(1, &second);
        }
    }
    match (random.unit() * 4.0) as u32 {
        0 => problem.moment.row.fill(0.0),
        1 => problem.moment.row = problem.path.row(0).transpose(),
        2 => problem.moment.row *= scale,
        _ => {}
    }
    for with_task in [false, true] {
        let found = resolve(&problem, with_task);
        assert!(found.rate.iter().all(|rate| rate.is_finite()), "{found:?}");
        assert!(found.min_singular_value.is_finite() && found.min_singular_value >= 0.0);
    }
    // However near to singular the arm is, the second task moves nothing along the path.
    let [with, without] = [true, false].map(|task| resolve(&problem, task));
    let moved = (problem.path * (with.rate - without.rate)).norm();
    let rounding = 1e-12 * problem.path.norm() * (with.rate.norm() + without.rate.norm());
    assert!(moved <= rounding, "{moved:e}, {with:?}, {without:?}");
    // The worst gain of damped least squares, 1 / (2 x lambda) at full damping, somewhat more on the way there.
    let found = resolve(&problem, false);
    let bound = problem.velocity.norm() / (PATH_THRESHOLD * REACH);
    assert!(found.rate.norm() <= 1.01 * bound, "{} of {bound}", found.rate.norm());
}

macro_rules! for_sizes {
    ($check:ident, $random:expr, $($n:literal)+) => {{ $($check::<$n>($random);)+ }};
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn without_a_task_it_is_the_pseudo_inverse(seed: u64) {
        for_sizes!(check_minimum_norm, &mut Random(seed), 2 3 4 5 6 7);
    }

    #[test]
    fn with_a_task_it_is_the_extended_jacobian(seed: u64) {
        for_sizes!(check_extended, &mut Random(seed), 3 4 5 6 7);
    }

    #[test]
    fn rates_stay_bounded_at_singularities(seed: u64) {
        for_sizes!(check_bounded, &mut Random(seed), 1 2 3 4 5 6 7);
    }
}

/// A stretched arm of two links along y moves along x only: v_x is met by minimum norm, v_y is given up.
#[test]
fn the_stretched_arm_gives_up_what_it_cannot_do() {
    let path = SMatrix::<f64, 2, 2>::from_columns(&[vec2(0.26, 0.0), vec2(0.13, 0.0)]);
    let moment = Task { row: SVector::zeros(), value: 0.0 };
    let found = Problem { path, velocity: vec2(0.1, 0.1), interval: 1e-3, caution: 0.0, moment }.resolve(
        PathAxes::Both,
        false,
        0.26,
    );
    let factor = 0.1 / (0.26_f64.powi(2) + 0.13_f64.powi(2));
    assert_close(found.rate.as_slice(), &[0.26 * factor, 0.13 * factor], 1e-14, "rate");
    assert!(found.path_damped && found.min_singular_value == 0.0);
}

/// A way beyond the reach of a nearly stretched arm, asked for again in each interval: with the rate of
/// one interval the bend must not swing to the other side. The arm of two equal links, bent by the angle b, is
/// stretched as long as 2 l cos(b/2); its weak direction is the radial one.
#[test]
fn a_nearly_stretched_arm_is_drawn_out_without_swinging() {
    let l = 0.25_f64;
    for interval in [1e-3, 1e-2, 2e-2] {
        let mut bend = 0.05_f64;
        for step in 0..10_000 {
            let (sin, cos) = bend.sin_cos();
            // Joint 1 at the origin, link 1 along y.
            let tip = vec2(l * sin, l + l * cos);
            let path = SMatrix::<f64, 2, 2>::from_columns(&[vec2(-tip.y, tip.x), vec2(-l * cos, l * sin)]);
            let velocity = tip.normalize() * 0.2;
            let moment = Task { row: SVector::zeros(), value: 0.0 };
            let found =
                Problem { path, velocity, interval, caution: 0.0, moment }.resolve(PathAxes::Both, false, 2.0 * l);
            // In these axes the second rate unbends the arm if it is positive.
            let next = bend - found.rate[1] * interval;
            assert!(next.abs() < bend.abs() + 1e-12, "bend {bend} to {next} in step {step} of {interval} s");
            assert!(next >= -1e-12, "swings to {next} in step {step} of {interval} s");
            bend = next;
        }
        assert!(bend < 1e-2, "{bend}");
    }
}

/// A task that asks for what the path already fixes is damped away, and the path is followed all the same.
#[test]
fn a_task_that_contradicts_the_path_gives_way() {
    let path = SMatrix::<f64, 2, 3>::from_columns(&[vec2(0.3, 0.1), vec2(0.1, 0.2), vec2(-0.1, 0.2)]);
    let moment = Task { row: path.row(0).transpose(), value: 1.0 };
    let found = resolve(&Problem { path, velocity: vec2(0.1, -0.1), interval: 1e-3, caution: 0.0, moment }, true);
    assert!(found.task_damped && !found.path_damped);
    assert_close((path * found.rate).as_slice(), &[0.1, -0.1], 1e-8, "velocity");
}

/// Along one axis the path is one row, far from a singular configuration as long as anything moves along it.
#[test]
fn a_path_along_one_axis_leaves_the_other_alone() {
    let path = SMatrix::<f64, 2, 3>::from_columns(&[vec2(0.3, 0.0), vec2(0.1, 0.0), vec2(-0.1, 0.0)]);
    let moment = Task { row: SVector::from([0.1, 0.2, 0.3]), value: 1.0 };
    let problem = Problem { path, velocity: vec2(0.1, 0.0), interval: 1e-3, caution: 0.0, moment };
    let found = problem.resolve(PathAxes::Horizontal, true, REACH);
    let rows = SMatrix::<f64, 2, 3>::from_rows(&[path.row(0).into_owned(), moment.row.transpose()]);
    let expected = rows.pseudo_inverse(0.0).unwrap() * vec2(0.1, 1.0);
    assert_close(found.rate.as_slice(), expected.as_slice(), 1e-13, "rate");
    assert_close(&[found.min_singular_value], &[path.row(0).norm()], 1e-15, "smallest singular value");
    assert!(!found.path_damped && !found.task_damped);

    let found = Problem { path: path * 0.01, ..problem }.resolve(PathAxes::Horizontal, true, REACH);
    assert!(found.path_damped && found.rate.iter().all(|rate| rate.is_finite()));
}
