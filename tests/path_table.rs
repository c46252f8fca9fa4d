//! Paths as tables: closed forms, what is continuous, what is refused, and the way through a start file.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use std::sync::Arc;

use common::{assert_close, cases, derivative};
use proptest::prelude::*;
use uam::Structure;
use uam::fmi::v2::Instance;
use uam::fmi::{Identity, Model, start_file};
use uam::parameters::defaults::default_parameters;
use uam::reference::{MOST_KNOTS, PathTable, ReferenceKind};
use uam::units::controller::ControllerUnit;

/// Position, velocity, acceleration in one list.
fn motion(table: &PathTable, t: f64) -> [f64; 6] {
    let at = table.at(t);
    [at.displacement.x, at.displacement.y, at.velocity.x, at.velocity.y, at.acceleration.x, at.acceleration.y]
}

/// Value and two derivatives of a polynomial, its coefficients from order 0 on.
fn polynomial(coefficients: &[f64], t: f64) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (n, c) in (0_i32..).zip(coefficients) {
        let k = f64::from(n);
        sums[0] += c * t.powi(n);
        sums[1] += if n > 0 { c * k * t.powi(n - 1) } else { 0.0 };
        sums[2] += if n > 1 { c * k * (k - 1.0) * t.powi(n - 2) } else { 0.0 };
    }
    sums
}

/// What a table of these polynomials along x and y is to give at time `t`.
fn expected([x, y]: [&[f64]; 2], start: f64, t: f64) -> [f64; 6] {
    let ([x0, vx, ax], [y0, vy, ay]) = (polynomial(x, t), polynomial(y, t));
    [x0 - polynomial(x, start)[0], y0 - polynomial(y, start)[0], vx, vy, ax, ay]
}

/// Knots that are not evenly spaced.
const TIMES: [f64; 7] = [0.5, 0.75, 1.5, 1.6, 2.5, 3.0, 4.5];

fn sampled([x, y]: [&[f64]; 2], velocities: bool) -> PathTable {
    let row = |t: f64| {
        let ([x, vx, _], [y, vy, _]) = (polynomial(x, t), polynomial(y, t));
        if velocities { vec![t, x, y, vx, vy] } else { vec![t, x, y] }
    };
    PathTable::new(&TIMES.map(row)).unwrap()
}

#[test]
fn a_cubic_polynomial_with_its_velocities_is_itself() {
    let cubic: [&[f64]; 2] = [&[0.1, 0.2, -0.15, 0.03], &[0.3, -0.1, 0.05, -0.01]];
    let table = sampled(cubic, true);
    for i in 1..400 {
        let t = 0.5 + 0.01 * f64::from(i);
        assert_close(&motion(&table, t), &expected(cubic, 0.5, t), 1e-12, &format!("t = {t}"));
    }
}

/// Accelerations inside are those of polynomials of order 5; the first and the last interval end with those of order 3.
#[test]
fn a_polynomial_of_order_5_with_its_velocities_is_itself_between_inner_knots() {
    let quintic: [&[f64]; 2] = [&[0.1, 0.2, -0.15, 0.03, 0.02, -0.004], &[0.3, -0.1, 0.05, -0.01, 0.003, 0.001]];
    let table = sampled(quintic, true);
    for i in 1..225 {
        let t = 0.75 + 0.01 * f64::from(i);
        assert_close(&motion(&table, t), &expected(quintic, 0.5, t), 1e-12, &format!("t = {t}"));
    }
}

/// The cubic polynomial that is at rest at both ends is the clamped spline through any of its points: with s from 0 to 1,
/// 3 s^2 - 2 s^3.
#[test]
fn without_velocities_a_cubic_polynomial_at_rest_at_both_ends_is_itself() {
    let way = |t: f64| {
        let s = (t - 0.5) / 4.0;
        [s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / 4.0, (6.0 - 12.0 * s) / 16.0]
    };
    let table = PathTable::new(&TIMES.map(|t| [t, 7.0 + 0.2 * way(t)[0], -0.1 * way(t)[0]])).unwrap();
    for i in 1..400 {
        let t = 0.5 + 0.01 * f64::from(i);
        let [s, v, a] = way(t);
        let expected = [0.2 * s, -0.1 * s, 0.2 * v, -0.1 * v, 0.2 * a, -0.1 * a];
        assert_close(&motion(&table, t), &expected, 1e-12, &format!("t = {t}"));
    }
}

/// Between (0, 0), (1, 1), (2, 0), (3, 1) the spline at rest at both ends has, by hand, 4 v1 + v2 = 0 and v1 + 4 v2 = 0: it
/// rests at each of them.
#[test]
fn a_zigzag_rests_at_its_corners() {
    let table = PathTable::new(&[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0], [3.0, 1.0, 0.0]]).unwrap();
    for (t, x, v, a) in [(0.5, 0.5, 1.5, 0.0), (1.0, 1.0, 0.0, -6.0), (1.5, 0.5, -1.5, 0.0), (2.0, 0.0, 0.0, 6.0)] {
        assert_close(&motion(&table, t), &[x, 0.0, v, 0.0, a, 0.0], 1e-14, &format!("t = {t}"));
    }
}

/// Two knots at rest: 10 s^3 - 15 s^4 + 6 s^5, whose acceleration is continuous with the rest around.
#[test]
fn ends_at_rest_by_their_velocities_have_no_acceleration() {
    let table = PathTable::new(&[[1.0, 0.0, 0.0, 0.0, 0.0], [3.0, 1.0, 0.0, 0.0, 0.0]]).unwrap();
    assert_close(&motion(&table, 2.0), &[0.5, 0.0, 15.0 / 16.0, 0.0, 0.0, 0.0], 1e-15, "middle");
    for t in [1.0, 3.0] {
        assert_close(&motion(&table, t - 1e-9), &motion(&table, t + 1e-9), 2e-8, "ends");
    }
}

#[test]
fn before_and_after_it_is_at_rest() {
    let table = PathTable::new(&[[1.0, 0.3, 0.4], [2.0, 0.9, 0.1], [4.0, 0.5, 0.5]]).unwrap();
    for t in [f64::NEG_INFINITY, -1.0, 0.0, 1.0] {
        assert_eq!(motion(&table, t), [0.0; 6], "{t}");
    }
    for t in [4.0, 4.5, 1e9, f64::INFINITY] {
        assert_eq!(motion(&table, t), [0.5 - 0.3, 0.5 - 0.4, 0.0, 0.0, 0.0, 0.0], "{t}");
    }
    assert_eq!(table.end(), 4.0);
}

#[test]
fn what_is_no_path_is_refused_with_its_row() {
    let refusal = |rows: &[Vec<f64>]| PathTable::new(rows).unwrap_err().to_string();
    let row = |t: f64| vec![t, 0.0, 1.0];
    assert_eq!(refusal(&[]), "a path needs at least 2 rows, but has 0");
    assert_eq!(refusal(&[row(0.0)]), "a path needs at least 2 rows, but has 1");
    let many: Vec<Vec<f64>> = (0..=MOST_KNOTS).map(|i| row(i as f64)).collect();
    assert_eq!(refusal(&many), "a path has at most 100000 rows, not 100001");
    assert!(PathTable::new(&many[1..]).is_ok());
    for (second, third, expected) in [
        (row(1.0), row(1.0), "row 3: time must be after 1.0, that of the row before, but is 1.0"),
        (row(1.0), row(0.5), "row 3: time must be after 1.0, that of the row before, but is 0.5"),
        (row(f64::NAN), row(2.0), "row 2: time must be a finite number, but is NaN"),
        (row(1.0), vec![2.0, f64::INFINITY, 0.0], "row 3: x must be a finite number, but is inf"),
        (row(1.0), vec![2.0, 0.0], "row 3: what it holds must be time, x, y or time, x, y, vx, vy, in all rows alike"),
        (vec![1.0, 0.0, 0.0, 0.0, 0.0], row(2.0), "row 2: what it holds must be time, x, y or time, x, y, vx, vy"),
        (row(1e-300), vec![2e-300, 1e300, 0.0], "row 1: the motion there must be of finite velocity"),
    ] {
        let found = refusal(&[row(0.0), second, third]);
        assert!(found.starts_with(expected), "{found}");
    }
    let early = refusal(&[row(-1.0), row(1.0)]);
    assert_eq!(early, "row 1: time must be 0 or later, but is -1.0");
}

/// A straight line in ten equal pieces, at 0.1 m/s: the ramps take a quarter of the 10 s that the way takes alone, 12.5 s in
/// all; from end to end it cruises at that speed.
#[test]
fn waypoints_are_passed_at_the_speed() {
    let waypoints: Vec<[f64; 2]> = (0..=10).map(|i| [0.06 * f64::from(i), 0.08 * f64::from(i)]).collect();
    let table = PathTable::through(&waypoints, 0.1).unwrap();
    assert_close(&[table.end()], &[12.5], 1e-14, "duration");
    assert_close(&motion(&table, 6.25)[..4], &[0.3, 0.4, 0.06, 0.08], 1e-12, "middle");
    for i in 0..1250 {
        let speed = table.at(0.01 * f64::from(i)).velocity.norm();
        assert!(speed < 0.1 * 1.01, "{i}: {speed}");
    }
    assert_close(&motion(&table, 1e-9), &[0.0; 6], 1e-7, "at rest at the start");
}

/// There and back there is nothing but rest to rest: twice the time that the way takes alone, the speed 15/16 of it.
#[test]
fn two_waypoints_are_one_ramp_up_and_one_down() {
    let table = PathTable::through(&[[0.0, 0.0], [0.2, 0.0]], 0.1).unwrap();
    assert_eq!(table.end(), 4.0);
    assert_close(&motion(&table, 2.0), &[0.1, 0.0, 0.1 * 15.0 / 16.0, 0.0, 0.0, 0.0], 1e-14, "middle");
}

#[test]
fn what_are_no_waypoints_is_refused() {
    let refusal = |waypoints: &[[f64; 2]], speed| PathTable::through(waypoints, speed).unwrap_err().to_string();
    let line = [[0.0, 0.0], [1.0, 0.0]];
    assert!(refusal(&line[..1], 1.0).starts_with("a path needs at least 2 rows"));
    assert!(
        refusal(&[line[0], line[1], line[1]], 1.0).starts_with("row 3: the waypoint must be of finite numbers, and")
    );
    assert!(refusal(&[line[0], [f64::NAN, 0.0]], 1.0).starts_with("row 2: the waypoint must be of finite numbers"));
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
        assert!(refusal(&line, speed).starts_with("the speed must be a number of m/s above 0"), "{speed}");
    }
}

#[test]
fn whoever_follows_a_table_that_is_not_there_learns_what_to_do() {
    let mut parameters = default_parameters(Structure::DEFAULT);
    parameters.reference.kind = ReferenceKind::Table;
    let refused = parameters.check(Structure::DEFAULT).unwrap_err().to_string();
    assert!(refused.contains("reference.kind = table") && refused.contains("build --scenario"), "{refused}");
    let table = PathTable::new(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.1]]).unwrap();
    parameters.reference.table = Some(Arc::new(table));
    assert!(parameters.check(Structure::DEFAULT).is_ok());
    assert_eq!(parameters.reference.end(), 1.0);
}

fn unit(table: PathTable) -> Identity<ControllerUnit> {
    let mut unit = Identity::<ControllerUnit>::of(Structure::DEFAULT);
    unit.start.parameters.reference.table = Some(Arc::new(table));
    unit.start.parameters.reference.kind = ReferenceKind::Table;
    unit
}

/// The unit that a library finds in a folder with this start file.
fn found(unit: &Identity<ControllerUnit>, text: &str) -> Result<Identity<ControllerUnit>, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(start_file::NAME), text).unwrap();
    let location = format!("file://{}", folder.path().display());
    Identity::find(&unit.guid().to_string(), Some(&location)).map_err(|error| error.to_string())
}

#[test]
fn a_changed_path_is_refused() {
    let unit = unit(PathTable::new(&[[0.0, 0.25, 0.5], [1.0, 0.5, 0.5]]).unwrap());
    let text = start_file::write(&unit).unwrap();
    let row = "\"path[2]\" = [0x3ff0000000000000, 0x3fe0000000000000, 0x3fe0000000000000]";
    assert!(text.contains(row), "{text}");
    assert!(found(&unit, &text).is_ok());
    for (new, expected) in [
        (row.replace("0x3ff", "0x3fe"), "the GUID must be {"),
        (String::new(), "start.toml, path: a path needs at least 2 rows, but has 1"),
        (row.replace("0x3ff0", "0x0000"), "row 2: time must be after 0.0"),
        (row.replace("path[2]", "path[3]"), "the next row must be path[2], but is path[3]"),
        (row.replace("0x3ff", "3ff"), "path[2] must be [bits of numbers, ...], but is [3ff"),
    ] {
        let refused = found(&unit, &text.replace(row, &new)).map(|_| ()).unwrap_err();
        assert!(refused.contains(expected), "{new}: {refused}");
    }
    // The path alone makes another unit, also where another kind is followed.
    let mut circle = unit.clone();
    circle.start.parameters.reference.kind = ReferenceKind::Path;
    let mut none = circle.clone();
    none.start.parameters.reference.table = None;
    assert_ne!(circle.guid(), none.guid());
    assert_ne!(circle.guid(), unit.guid());
    assert!(found(&circle, &start_file::write(&circle).unwrap()).is_ok());
}

/// Within a process, states pass from one instance to another without being bytes.
#[test]
fn a_state_in_memory_goes_to_units_with_the_same_path_alone() {
    let instance = |way: f64| Instance::new(unit(PathTable::new(&[[0.0, 0.0, 0.0], [1.0, way, 0.0]]).unwrap()));
    let [mut one, mut same, mut other] = [0.01, 0.01, 0.02].map(instance);
    let saved = one.save().unwrap();
    assert!(one.restore(&saved).is_ok() && same.restore(&saved).is_ok() && same.write_saved(&saved).is_ok());
    for refused in [other.restore(&saved).unwrap_err(), other.write_saved(&saved).unwrap_err()] {
        assert_eq!(refused.to_string(), "FMUstate belongs to an instance with another path");
    }
}

/// The longest path fits into a start file.
#[test]
fn the_longest_path_comes_back() {
    let rows: Vec<[f64; 5]> = (0..MOST_KNOTS).map(|i| [i as f64 * 1e-3, 0.1, 0.2, 1e-3, -1e-3]).collect();
    let unit = unit(PathTable::new(&rows).unwrap());
    let back = found(&unit, &start_file::write(&unit).unwrap()).unwrap();
    assert!(ControllerUnit::has_same_rows(&back.start, &unit.start));
}

/// Rows of 2 to 12 knots, of intervals from a tenth of a second to two, within a square of 2 m.
fn rows() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let row = (0.1..2.0, prop::array::uniform4(-1.0..1.0));
    (prop::collection::vec(row, 2..12), any::<bool>()).prop_map(|(rows, velocities)| {
        let mut time = -0.1;
        let row = |(interval, numbers): (f64, [f64; 4])| {
            time += interval;
            let count = if velocities { 4 } else { 2 };
            [time].into_iter().chain(numbers.into_iter().take(count)).collect()
        };
        rows.into_iter().map(row).collect()
    })
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn a_path_passes_its_knots_smoothly(rows in rows()) {
        let table = PathTable::new(&rows).unwrap();
        let first = &rows[0];
        for (i, row) in rows.iter().enumerate() {
            let [before, at, after] = [-1e-10, 0.0, 1e-10].map(|d| motion(&table, row[0] + d));
            assert_close(&at[..2], &[row[1] - first[1], row[2] - first[2]], 1e-13, "place");
            let inner = i > 0 && i + 1 < rows.len();
            let continuous = if inner { 6 } else { 2 };
            // Third derivatives here are below 1e5.
            assert_close(&before[..continuous], &after[..continuous], 3e-5, &format!("at {}", row[0]));
            if let (true, [.., vx, vy]) = (inner && row.len() == 5, &row[..]) {
                assert_close(&at[2..4], &[*vx, *vy], 1e-12, "velocity");
            }
        }
    }

    /// Away from the knots, where third derivatives jump.
    #[test]
    fn velocity_and_acceleration_are_derivatives(rows in rows(), share in 0.2..0.8, i in 0_usize..11) {
        let table = PathTable::new(&rows).unwrap();
        let i = i % (rows.len() - 1);
        let t = rows[i][0] + share * (rows[i + 1][0] - rows[i][0]);
        let now = table.at(t);
        assert_close(now.velocity.as_slice(), derivative(|s| table.at(t + s).displacement).as_slice(), 1e-9, "v");
        assert_close(now.acceleration.as_slice(), derivative(|s| table.at(t + s).velocity).as_slice(), 1e-9, "a");
    }

    #[test]
    fn rows_come_back_bit_by_bit(rows in rows(), tiny in prop::num::f64::SUBNORMAL) {
        let mut rows = rows;
        rows[1][1] = tiny;
        rows[0][2] = -0.0;
        let unit = unit(PathTable::new(&rows).unwrap());
        let back = found(&unit, &start_file::write(&unit).unwrap()).unwrap();
        let bits = |rows: Vec<Vec<f64>>| rows.concat().into_iter().map(f64::to_bits).collect::<Vec<_>>();
        prop_assert_eq!(bits(ControllerUnit::rows(&back.start)), bits(rows));
        prop_assert_eq!(back.guid(), unit.guid());
    }
}
