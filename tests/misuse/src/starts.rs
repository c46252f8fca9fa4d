//! Start files that somebody made up: in the resources of a unit, with the GUID that the library finds for them.

use std::ffi::{CStr, CString};
use std::fmt::Write;
use std::fs;
use std::path::Path;

use fastrand::Rng;
use tempfile::TempDir;
use uam::Structure;

use crate::guest::{Fate, Guest};
use crate::host;
use crate::hostile::{damage, one_in, real};
use crate::unit::{Unit, Variable};

/// How the library names the GUID that goes with a file.
const EXPECTED: &str = "the GUID must be ";

/// A GUID of nothing.
const NONE: &CStr = c"{00000000-0000-0000-0000-000000000000}";

/// Where start files are written, and for what.
pub struct Desk {
    resources: TempDir,
    /// The first line of the files of every structure, and the variables.
    structures: Vec<(String, Vec<Variable>)>,
}

impl Desk {
    /// For the structures of this unit.
    ///
    /// # Errors
    /// If there is no place for files.
    pub fn new(unit: &Unit) -> Result<Self, String> {
        let line = |structure| format!("structure = \"{structure}\"\n");
        Ok(Self {
            resources: tempfile::tempdir().map_err(|error| error.to_string())?,
            structures: Structure::all()
                .map(|structure| (line(structure), Variable::of(&unit.name, structure)))
                .collect(),
        })
    }
}

/// Writes a start file, and asks for an instance with what it says.
///
/// # Errors
/// What the unit did that it must not do.
pub fn play(unit: &Unit, desk: &Desk, seed: u64) -> Result<Fate, String> {
    let mut rng = Rng::with_seed(seed);
    let resources = desk.resources.path();
    let file = file(&desk.structures, &mut rng);
    fs::write(resources.join("start.toml"), &file).map_err(|error| error.to_string())?;
    let location = location(resources)?;

    let refused = Guest::come(unit, &[], NONE, &location);
    let answer = host::said();
    if refused.is_some() || host::panicked() || !answer.contains("fmi2Instantiate") {
        return Err(format!("a GUID of nothing is answered with: {answer}"));
    }
    let mut fate = Fate { tried: 1, ..Fate::default() };
    // Otherwise the file is refused.
    if answer.contains("for the start values in the resources") {
        let guid = answer.split(EXPECTED).nth(1).and_then(|rest| rest.split_whitespace().next()).unwrap_or_default();
        let guid = CString::new(guid).map_err(|error| error.to_string())?;
        // A damaged file may be of another structure than was meant.
        let found = desk.structures.iter().find(|(line, _)| file.starts_with(line.as_bytes()));
        let variables = found.map_or(&[] as &[_], |(_, variables)| variables);
        let guest = Guest::come(unit, variables, &guid, &location).ok_or_else(host::said)?;
        fate.accepted = 1;
        guest.finite("at the start")?;
        if guest.initialize()? {
            guest.step(0.0, 1e-2)?;
            guest.step(1e-2, 1e-3)?;
        }
        fate.points = guest.points.get();
    }
    Ok(fate)
}

fn location(resources: &Path) -> Result<CString, String> {
    CString::new(format!("file://{}", resources.display())).map_err(|error| error.to_string())
}

/// Mostly lines that can be understood, with values that may not go together.
fn file(structures: &[(String, Vec<Variable>)], rng: &mut Rng) -> Vec<u8> {
    let (structure, variables) = &structures[rng.usize(0..structures.len())];
    let mut text = format!("{structure}naming = \"structured\"\n");
    for _ in 0..rng.u32(1..5) {
        let variable = &variables[rng.usize(0..variables.len())];
        let value = match rng.u32(0..4) {
            _ if variable.real => {
                let value = if rng.bool() { rng.f64() } else { real(rng) };
                format!("{:#018x} # {value:?}", value.to_bits())
            }
            0 => rng.bool().to_string(),
            1 => "\"euler\"".to_owned(),
            2 => "\"ideal\"".to_owned(),
            _ => "\"least_squares\"".to_owned(),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\"{}\" = {value}", variable.name);
    }
    let mut bytes = text.into_bytes();
    if one_in(rng, 3) {
        damage(rng, &mut bytes);
    }
    bytes
}
