//! Paths in scenario files: rows, csv files, waypoints; what is refused, and that nothing is lost on the way to a file.

#![allow(clippy::unwrap_used)] // in helpers, too

use uam::reference::{PathTable, ReferenceKind};
use uam::scenarios::{Extent, Scenario};

const HEAD: &str = "id = 'mine'\nbased_on = '4.3b'\n";
const ROWS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.02, -0.05], [2.5, 0.0, -0.03]];
const CSV: &str = "time,x,y\n0,0,0\n1,0.02,-0.05\n\n2.5,0.0,-0.03\n";

fn files(name: &str) -> Result<String, String> {
    match name {
        "path.csv" => Ok(CSV.to_owned()),
        "velocities.csv" => Ok("time, x, y, vx, vy\r\n0,0,0,0,0\r\n1,0.1,0,0,0\r\n".to_owned()),
        "header.csv" => Ok("t,x,y\n0,0,0\n".to_owned()),
        "line.csv" => Ok("time,x,y\n0,0,0\n1,0.1\n".to_owned()),
        "time.csv" => Ok("time,x,y\n0,0,0\n0,0.1,0\n".to_owned()),
        name => Err(format!("cannot read {name}")),
    }
}

fn read(text: &str) -> Result<Scenario, String> {
    Scenario::read_with(&format!("{HEAD}{text}"), &files).map_err(|error| error.to_string())
}

/// What is followed by a file.
fn table(text: &str) -> PathTable {
    let reference = read(text).unwrap().parameters.reference;
    assert_eq!(reference.kind, ReferenceKind::Table);
    reference.table.unwrap().as_ref().clone()
}

#[test]
fn rows_a_csv_file_and_numbers_with_units_mean_the_same() {
    let expected = PathTable::new(&ROWS).unwrap();
    for text in [
        "path = [[0, 0, 0], [1, 0.02, -0.05], [2.5, 0.0, -0.03]]",
        "path = [\n[0, 0, 0],\n[1, '2 cm', '-5 cm'], # here\n['2500 ms', 0.0, -0.03],\n]",
        "path = 'path.csv'",
    ] {
        assert_eq!(table(text), expected, "{text}");
    }
    assert_eq!(
        table("path = 'velocities.csv'"),
        table("path = [[0.0, 0.0, 0.0, 0.0, 0.0], [1.0, 0.1, 0.0, '0 mm/s', 0.0]]")
    );
}

#[test]
fn waypoints_need_a_speed() {
    let expected = PathTable::through(&[[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]], 0.05).unwrap();
    assert_eq!(table("[path]\nwaypoints = [[0, 0], [0.1, 0], [0.1, '10 cm']]\nspeed = 0.05"), expected);
    assert_eq!(table("path.waypoints = [[0, 0], [0.1, 0], [0.1, 0.1]]\npath.speed = '5 cm/s'"), expected);
}

#[test]
fn the_file_may_say_that_something_else_is_followed() {
    let scenario = read("path = 'path.csv'\nparameters.reference.kind = 'circle'").unwrap();
    assert_eq!(scenario.parameters.reference.kind, ReferenceKind::Circle);
    assert!(scenario.parameters.reference.table.is_some());
}

#[test]
fn what_is_no_path_is_refused_with_its_line() {
    for (text, expected) in [
        ("path = 3", "line 3: `path` must be rows [time, x, y] or [time, x, y, vx, vy], or the name of a csv file"),
        ("path = [[0, 0, 0], 1]", "line 3: `path` must be rows [time, x, y] or"),
        ("path = [[0, 0, 0], [1, 0, 'a']]", "but is \"a\" in row 2"),
        ("path = [[0, 0, 0]]", "line 3: `path`: a path needs at least 2 rows, but has 1"),
        ("path = []", "line 3: `path`: a path needs at least 2 rows, but has 0"),
        ("path = [[0, 0, 0], [1, 0]]", "line 3: `path`: row 2: what it holds must be time, x, y or"),
        ("path = [[0, 0, 0], [0, 0, 1]]", "line 3: `path`: row 2: time must be after 0.0, that of the row before"),
        ("path = 'none.csv'", "line 3: `path = \"none.csv\"`: cannot read none.csv"),
        ("path = 'header.csv'", "the first line must be time,x,y or time,x,y,vx,vy, but is \"t,x,y\""),
        ("path = 'line.csv'", "line 3 must be 3 numbers between commas, but is \"1,0.1\""),
        ("path = 'time.csv'", "line 3: `path`: row 2: time must be after 0.0"),
        ("[path]", "line 3: `path` must be rows"),
        ("[path]\nwaypoints = [[0, 0], [1, 1]]", "`path.speed` is missing: a number of m/s"),
        ("[path]\nspeed = 1", "`path.waypoints` is missing: a list of points"),
        ("[path]\nspeed = -1\nwaypoints = [[0, 0], [1, 1]]", "line 4: `path.speed`: the speed must be a number of m/s"),
        ("[path]\nspeed = 1\nwaypoints = [[0, 0, 0], [1, 1, 0]]", "line 5: `path.waypoints` must be a list of points"),
        ("[path]\nspeed = 1\nwaypoints = [[0, 0], [0, 0]]", "line 5: `path.waypoints`: row 2: the waypoint must be"),
        ("[path]\nspeed = 1\npoints = [[0, 0]]", "line 5: unknown key `path.points`"),
        ("parameters.reference.kind = 'table'", "line 3: reference.kind = table does not go together"),
    ] {
        let found = read(text).unwrap_err();
        assert!(found.contains(expected), "{text}: {found}");
    }
    // Without somebody who reads files, there are none.
    let refused = Scenario::read(&format!("{HEAD}path = 'path.csv'")).unwrap_err().to_string();
    assert!(refused.contains("only the text of the scenario is read here"), "{refused}");
}

#[test]
fn a_path_survives_being_written_and_read() {
    let velocities = "path = [[0.1, 1e-300, -0.0, 0.1, 0.2], [1e5, 0.1, 0.3333333333333333, 1e-7, 0]]";
    for text in [
        "path = 'path.csv'",
        velocities,
        "[path]\nwaypoints = [[0, 0], [0.1, 0], [0.1, 0.1]]\nspeed = 0.07",
        "path = 'path.csv'\nparameters.reference.kind = 'circle'",
        "path = 'path.csv'\nparameters.reference.kind = 'path'",
    ] {
        let scenario = read(text).unwrap();
        for extent in [Extent::Changes, Extent::Everything] {
            assert_eq!(Scenario::read(&scenario.write(extent)).unwrap(), scenario, "{text}");
        }
        let changed = scenario.with([("payload.mass", "0.1")]).unwrap();
        assert_eq!(changed.parameters.reference, scenario.parameters.reference, "{text}");
    }
}
