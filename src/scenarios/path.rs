//! The path of a scenario as a table: rows in the file, a csv file beside it, or waypoints and a speed.

use toml::de::DeValue;

use super::reader::{Entry, number};
use super::{Error, Problem};
use crate::reference::{PathTable, TableError};
use crate::variables::unit::{METRE, METRE_PER_SECOND, PhysicalUnit, SECOND};

pub(super) const PATH: (&str, &str) = (
    "path",
    "rows [time, x, y] or [time, x, y, vx, vy], or the name of a csv file in quotes, or a table of waypoints and speed",
);
pub(super) const WAYPOINTS: (&str, &str) = ("path.waypoints", "a list of points [x, y] in m");
pub(super) const SPEED: (&str, &str) = ("path.speed", "a number of m/s above 0, for the waypoints");

/// Columns of a csv file.
const HEADER: &str = "time,x,y,vx,vy";
/// Those that it must have.
const LEAST: &str = "time,x,y";

/// Gives the text of the file with this name, or says why not.
pub type Files<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// The path that stands in a file under [`PATH`], or under [`WAYPOINTS`] and [`SPEED`].
pub(super) fn read(
    path: Option<&Entry<'_>>,
    [waypoints, speed]: [Option<&Entry<'_>>; 2],
    files: Files<'_>,
) -> Result<Option<PathTable>, Error> {
    let refused = |entry: &Entry<'_>, reason: TableError| {
        entry.refused(Problem::Path { key: entry.key.clone(), reason: reason.to_string() })
    };
    if let Some(entry) = path {
        let rows = match entry.value {
            DeValue::String(file) => {
                let text = files(file).and_then(|text| csv(&text));
                let named = |reason| Problem::Path { key: format!("{} = {file:?}", entry.key), reason };
                text.map_err(|reason| entry.refused(named(reason)))?
            }
            value => rows(value, &[&SECOND, &METRE, &METRE, &METRE_PER_SECOND, &METRE_PER_SECOND])
                .map_err(|found| entry.with_found(PATH.1, found))?,
        };
        return PathTable::new(&rows).map(Some).map_err(|reason| refused(entry, reason));
    }
    let (Some(waypoints), Some(speed)) = (waypoints, speed) else {
        let missing = |(key, expected): (&'static str, &'static str)| Err(Error::Missing { key, expected });
        return match (waypoints, speed) {
            (Some(_), _) => missing(SPEED),
            (None, Some(_)) => missing(WAYPOINTS),
            (None, None) => Ok(None),
        };
    };
    let points = rows(waypoints.value, &[&METRE, &METRE]).map_err(|found| waypoints.with_found(WAYPOINTS.1, found))?;
    let pair = |(n, point): (usize, &Vec<f64>)| {
        let found = || format!("{} numbers in point {}", point.len(), n + 1);
        <[f64; 2]>::try_from(point.as_slice()).map_err(|_| waypoints.with_found(WAYPOINTS.1, found()))
    };
    let points = points.iter().enumerate().map(pair).collect::<Result<Vec<[f64; 2]>, Error>>()?;
    let metres_per_second = number(speed.value, &METRE_PER_SECOND).ok_or_else(|| speed.wrong(SPEED.1))?;
    PathTable::through(&points, metres_per_second)
        .map(Some)
        .map_err(|reason| refused(if matches!(reason, TableError::Speed { .. }) { speed } else { waypoints }, reason))
}

/// Lists of numbers, of these units in their order; what else is found instead.
fn rows(value: &DeValue<'_>, units: &[&PhysicalUnit]) -> Result<Vec<Vec<f64>>, String> {
    let DeValue::Array(rows) = value else { return Err(super::reader::found(value)) };
    let row = |(n, row): (usize, &DeValue<'_>)| {
        let DeValue::Array(numbers) = row else {
            return Err(format!("{} in row {}", super::reader::found(row), n + 1));
        };
        let units = units.iter().copied().chain(std::iter::repeat(&METRE));
        let read = |(value, unit): (&DeValue<'_>, &PhysicalUnit)| {
            number(value, unit).ok_or_else(|| format!("{} in row {}", super::reader::found(value), n + 1))
        };
        numbers.iter().map(|value| value.get_ref()).zip(units).map(read).collect()
    };
    rows.iter().map(|row| row.get_ref()).enumerate().map(row).collect()
}

/// The rows of a csv file with [`HEADER`].
fn csv(text: &str) -> Result<Vec<Vec<f64>>, String> {
    let mut lines = (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty());
    let header = lines.next().map_or("", |(_, line)| line.trim_start_matches('\u{feff}'));
    let columns: Vec<&str> = header.split(',').map(str::trim).collect();
    if ![LEAST, HEADER].contains(&columns.join(",").as_str()) {
        return Err(format!("the first line must be {LEAST} or {HEADER}, but is {header:?}"));
    }
    let row = |(line, text): (usize, &str)| {
        let row: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        let expected = || format!("line {line} must be {} numbers between commas, but is {text:?}", columns.len());
        row.filter(|row| row.len() == columns.len()).ok_or_else(expected)
    };
    lines.map(row).collect()
}
