//! Small quadratic programs against the conditions of optimality and against answers known in advance.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use case::{Case, any_guess, case, nasty};
use common::cases;
use common::random::Random;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use uam::control::qp::{FREE, MAX_ROWS, MAX_VARIABLES, Outcome, Place, Problem, Rows, TooMany, Vector, solve};

#[allow(dead_code)] // others take the rest
#[path = "qp/case.rs"]
mod case;

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn the_guess_does_not_matter(seed: u64) {
        let mut random = Random(seed);
        let case = nasty(&mut random);
        let cold = solve(&case.problem, &FREE);
        for guess in [cold.places, any_guess(&mut random), any_guess(&mut random)] {
            let warm = solve(&case.problem, &guess);
            prop_assert_eq!(warm.outcome, cold.outcome);
            for (warm, cold) in warm.x.iter().zip(&cold.x) {
                prop_assert!((warm - cold).abs() <= 1e-7 * (1.0 + cold.abs()), "{warm} {cold}");
            }
        }
    }

    #[test]
    fn the_conditions_of_optimality_hold(seed: u64) {
        let mut random = Random(seed);
        let case = feasible(&mut random);
        let found = solve(&case.problem, &FREE);
        let x = case.x(&found);
        prop_assert_eq!(found.outcome, Outcome::Solved);
        case.assert_within(&x);
        prop_assert!(case.equality_error(&x) <= 1e-11);
        check_slopes(&case, &x);
    }

    #[test]
    fn hostile_numbers_do_no_harm(seed: u64) {
        const HOSTILE: [f64; 8] =
            [0.0, -0.0, 1e308, -1e308, 5e-324, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let mut random = Random(seed);
        let mut problem = nasty(&mut random).problem;
        let mut row: Vector = std::array::from_fn(|_| random.about_zero(1.0));
        row[random.between(0.0, 7.999) as usize] = HOSTILE[random.between(0.0, 7.999) as usize];
        let rows = if random.coin() { &mut problem.objective } else { &mut problem.equalities };
        *rows = Rows::default();
        rows.push(&row, if random.coin() { 1.0 } else { HOSTILE[random.between(0.0, 7.999) as usize] }).unwrap();
        let found = solve(&problem, &any_guess(&mut random));
        for i in 0..problem.variables {
            let x = found.x[i];
            prop_assert!(x.is_finite() && x >= problem.lower[i] && x <= problem.upper[i], "{x}");
        }
    }
}

/// Random numbers of moderate size with equalities that some point inside the bounds meets; ridge as small as in use.
fn feasible(random: &mut Random) -> Case {
    let n = random.between(2.0, 8.999) as usize;
    let matrix = |random: &mut Random, rows| DMatrix::from_fn(rows, n, |_, _| random.about_zero(1.0));
    let inside = DVector::from_fn(n, |_, _| random.about_zero(1.0));
    let lower: Vec<f64> = inside.iter().map(|x| x - random.between(0.0, 1.0)).collect();
    let upper: Vec<f64> = inside.iter().map(|x| x + random.between(0.0, 1.0)).collect();
    let rows = random.between(0.0, n.min(3) as f64) as usize;
    let equalities = matrix(random, rows);
    let right = &equalities * &inside;
    let rows = random.between(0.0, 3.0) as usize;
    let objective = matrix(random, rows);
    let aim = DVector::from_fn(rows, |_, _| random.about_zero(2.0));
    let penalty = vec![if random.coin() { 0.0 } else { random.between(0.01, 0.5) }; n];
    let ridge = 10.0_f64.powf(random.between(-12.0, -2.0));
    case(&lower, &upper, &penalty, ridge, (equalities, right), (objective, aim))
}

/// With the multipliers of the equalities that fit the variables in motion best: their slope is zero, and those
/// at rest would have to go uphill.
fn check_slopes(case: &Case, x: &DVector<f64>) {
    let gradient =
        2.0 * (case.objective.0.transpose() * (&case.objective.0 * x - &case.objective.1) + case.problem.ridge * x);
    let (lower, upper, penalty) = (&case.problem.lower, &case.problem.upper, &case.problem.penalty);
    let kinked = |i: usize| penalty[i] > 0.0 && x[i] == 0.0;
    let moving: Vec<usize> = (0..case.n()).filter(|&i| x[i] > lower[i] && x[i] < upper[i] && !kinked(i)).collect();
    let rows = case.equalities.0.nrows();
    if moving.len() < rows {
        return; // the multipliers are not unique
    }
    let part = DMatrix::from_fn(moving.len(), rows, |k, row| case.equalities.0[(row, moving[k])]);
    let slope = DVector::from_fn(moving.len(), |k, _| gradient[moving[k]] + penalty[moving[k]] * x[moving[k]].signum());
    let multipliers = if rows == 0 || moving.is_empty() {
        DVector::zeros(rows)
    } else {
        let svd = part.clone().svd(true, true);
        if svd.singular_values.min() < 1e-3 {
            return;
        }
        svd.solve(&slope, 0.0).unwrap()
    };
    let left = &gradient - case.equalities.0.transpose() * &multipliers;
    let tolerance = 1e-9 * (1.0 + gradient.amax() + multipliers.amax());
    for i in 0..case.n() {
        let upwards = left[i] + if x[i] < 0.0 { -penalty[i] } else { penalty[i] };
        let downwards = left[i] - if x[i] > 0.0 { -penalty[i] } else { penalty[i] };
        assert!(x[i] == upper[i] || upwards >= -tolerance, "x{i} = {} should rise: {upwards}", x[i]);
        assert!(x[i] == lower[i] || downwards <= tolerance, "x{i} = {} should fall: {downwards}", x[i]);
    }
}

#[test]
fn the_equalities_give_way_first_and_least() {
    // x + y = 5 within x <= 1, y <= 2, where the objective would like to have x = -10.
    let row = |row: &[f64]| DMatrix::from_row_slice(1, row.len(), row);
    let case = case(
        &[-3.0, -3.0],
        &[1.0, 2.0],
        &[0.0, 0.0],
        1e-6,
        (row(&[1.0, 1.0]), DVector::from_element(1, 5.0)),
        (row(&[1.0, 0.0]), DVector::from_element(1, -10.0)),
    );
    let found = solve(&case.problem, &FREE);
    assert_eq!((found.x[0], found.x[1], found.outcome), (1.0, 2.0, Outcome::Missed));
}

#[test]
fn what_does_not_matter_is_smallest() {
    // One equation, four variables, nothing else: the pseudo-inverse.
    let row = [1.0, -2.0, 0.5, 3.0];
    let mut problem = Problem::new(4, 1e-12);
    problem.equalities.push(&row, 2.0).unwrap();
    let found = solve(&problem, &FREE);
    let size: f64 = row.iter().map(|a| a * a).sum();
    for (x, a) in found.x.iter().zip(row) {
        assert!((x - 2.0 * a / size).abs() < 1e-15);
    }
    // Likewise as objective, where the ridge takes its share of 1e-12.
    problem.equalities = Rows::default();
    problem.objective.push(&row, 2.0).unwrap();
    let found = solve(&problem, &FREE);
    for (x, a) in found.x.iter().zip(row) {
        assert!((x - 2.0 * a / size).abs() < 1e-12);
    }
}

#[test]
fn a_penalty_keeps_small_variables_at_zero() {
    // (x - 1)^2 + 3 |x| is smallest at 0, (x - 4)^2 + 3 |x| at 2.5.
    for (aim, expected) in [(1.0, 0.0), (4.0, 2.5), (-4.0, -2.5)] {
        let mut problem = Problem::new(2, 1e-15);
        problem.objective.push(&[1.0, 0.0], aim).unwrap();
        problem.penalty[0] = 3.0;
        let found = solve(&problem, &FREE);
        assert!((found.x[0] - expected).abs() < 1e-12 && found.x[1] == 0.0, "{:?}", found.x);
        assert_eq!(found.places[0] == Place::Zero, expected == 0.0);
    }
}

#[test]
fn more_than_there_is_room_for_is_refused() {
    let mut rows = Rows::default();
    assert_eq!(rows.push(&[1.0; MAX_VARIABLES + 1], 1.0), Err(TooMany::Coefficients(MAX_VARIABLES + 1)));
    for _ in 0..MAX_ROWS {
        rows.push(&[1.0; MAX_VARIABLES], 1.0).unwrap();
    }
    assert_eq!(rows.push(&[1.0], 1.0), Err(TooMany::Rows));
    // Nothing of what was refused has been taken.
    let mut problem = Problem::new(1, 1e-9);
    problem.equalities = rows;
    assert_eq!(solve(&problem, &FREE).outcome, Outcome::Solved);
}

#[test]
fn scales_do_not_matter() {
    // Powers of two leave every digit as it is.
    let scale = |power: i32| 2.0_f64.powi(power);
    for seed in 0..2000 {
        let mut case = nasty(&mut Random(seed));
        let plain = solve(&case.problem, &FREE);
        for (rows, right, variables) in [(40, -90, 30), (-100, 60, -20), (0, 0, 200)] {
            let mut problem = Problem::new(case.n(), case.problem.ridge * scale(2 * right));
            let all = [
                (&mut problem.equalities, &mut case.equalities, rows),
                (&mut problem.objective, &mut case.objective, right),
            ];
            for (scaled, (matrix, value), power) in all {
                for (row, value) in matrix.row_iter().zip(value.iter()) {
                    let row: Vec<f64> = row.iter().map(|a| a * scale(power)).collect();
                    scaled.push(&row, value * scale(power + variables)).unwrap();
                }
            }
            for i in 0..case.n() {
                problem.penalty[i] = case.problem.penalty[i] * scale(2 * right + variables);
                problem.lower[i] = case.problem.lower[i] * scale(variables);
                problem.upper[i] = case.problem.upper[i] * scale(variables);
            }
            let scaled = solve(&problem, &FREE);
            assert_eq!((scaled.outcome, scaled.places), (plain.outcome, plain.places), "seed {seed}");
            for (scaled, plain) in scaled.x.iter().zip(plain.x) {
                assert!((scaled - plain * scale(variables)).abs() <= 1e-12 * scale(variables), "seed {seed}");
            }
        }
    }
}

#[test]
fn the_equalities_hold_where_penalties_drive_far_away() {
    // Without the penalties' kinks, the free variables would run away to 1e10.
    let mut problem = Problem::new(4, 1e-10);
    let row = [-0.75, 1.6, -1.1, 0.16];
    problem.equalities.push(&row, 0.7).unwrap();
    problem.penalty[..3].copy_from_slice(&[1.8, 1.1, 0.5]);
    (problem.lower[0], problem.upper[0]) = (1.0, 1.2);
    for guess in [FREE, [Place::Below; MAX_VARIABLES], [Place::Lower; MAX_VARIABLES]] {
        let found = solve(&problem, &guess);
        let left: f64 = row.iter().zip(found.x).map(|(a, x)| a * x).sum();
        assert!((left - 0.7).abs() < 1e-14, "{guess:?}: {left}");
        assert_eq!(found.x[..3], [1.0, 0.0, 0.0]);
    }
}
