//! The runs of the thesis, in its order, and what the units hold.

use std::sync::LazyLock;

use super::error::near;
use super::{Error, Scenario, reader};

/// Name and text of the files; a file may be based on those before it.
macro_rules! files {
    ($($thesis:literal)+; $($own:literal)+) => {
        &[
            $(($thesis, include_str!(concat!("thesis/", $thesis, ".toml"))),)+
            $(($own, include_str!(concat!($own, ".toml"))),)+
        ]
    };
}

const FILES: &[(&str, &str)] = files!(
    "2.1a" "2.1b" "2.2a" "2.2b" "2.3a" "2.3b" "2.4a" "2.4b" "2.5a" "2.5b"
    "3.1a-minimum-norm" "3.1a" "3.1a-doubled-gain" "3.1b"
    "3.2a" "3.2b" "3.2c" "3.2d" "3.2e" "3.3" "3.4-1" "3.4-2" "3.4-3"
    "3.5a" "3.5b"
    "3.6a" "3.6a-segment" "3.6b" "3.6b-segment" "3.6c" "3.6c-segment"
    "3.7-extended-jacobian" "3.7" "3.8a" "3.8b"
    "4.2a" "4.2b" "4.3a" "4.3b" "4.3c-minimum-norm" "4.3c-extended-jacobian"
    "4.4a" "4.4b";
    "pick-up"
);

/// All named scenarios, in the order of the thesis, and then our own.
///
/// # Errors
/// If a file of the catalogue is wrong.
pub fn catalogue() -> Result<Vec<Scenario>, Error> {
    static READ: LazyLock<Result<Vec<Scenario>, Error>> = LazyLock::new(read_all);
    READ.clone()
}

fn read_all() -> Result<Vec<Scenario>, Error> {
    let mut scenarios = Vec::with_capacity(FILES.len());
    for &(file, text) in FILES {
        let scenario = reader::read(text, &scenarios, &reader::no_files)
            .map_err(|source| Error::Catalogue { file, source: Box::new(source) })?;
        scenarios.push(scenario);
    }
    Ok(scenarios)
}

/// The scenarios of the thesis, in its order.
///
/// # Errors
/// If a file of the catalogue is wrong.
pub fn of_the_thesis() -> Result<Vec<Scenario>, Error> {
    let mut scenarios = catalogue()?;
    scenarios.retain(|scenario| scenario.id != super::PICK_UP);
    Ok(scenarios)
}

/// The scenario of this name.
///
/// # Errors
/// If there is none; proposes similar names.
pub fn find(id: &str) -> Result<Scenario, Error> {
    let mut scenarios = catalogue()?;
    match scenarios.iter().position(|scenario| scenario.id == id) {
        Some(index) => Ok(scenarios.swap_remove(index)),
        None => Err(Error::NoScenario {
            id: id.to_owned(),
            near: near(id, scenarios.iter().map(|scenario| scenario.id.as_str())),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_after_their_scenarios() {
        let scenarios = catalogue().unwrap();
        assert!(FILES.iter().map(|(file, _)| *file).eq(scenarios.iter().map(|scenario| scenario.id.as_str())));
    }
}
