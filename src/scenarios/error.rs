//! What can be wrong with a scenario file.

use std::fmt::Write;

/// A scenario that does not exist, or a file that does not hold one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// No scenario of the catalogue has this name.
    #[error("there is no scenario `{id}`{}", proposals(near))]
    NoScenario {
        /// The name asked for.
        id: String,
        /// Names to propose.
        near: Vec<String>,
    },
    /// Something in one line of a file.
    #[error("line {line}: {problem}")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// What is wrong there.
        problem: Problem,
    },
    /// Something in a change of a scenario.
    #[error(transparent)]
    Change(Problem),
    /// A key that every file needs, unless it is based on a scenario that has it.
    #[error("`{key}` is missing: {expected}")]
    Missing {
        /// The key.
        key: &'static str,
        /// What it must be.
        expected: &'static str,
    },
    /// Parameters that do not go together, of which the file sets none.
    #[error(transparent)]
    Parameters(#[from] crate::Error),
    /// A file of the catalogue.
    #[error("src/scenarios/thesis/{file}.toml")]
    Catalogue {
        /// Name of the file.
        file: &'static str,
        /// What is wrong with it.
        source: Box<Error>,
    },
}

/// What is wrong with a line of a scenario file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Problem {
    /// The text is not TOML.
    #[error("{message}, in `{text}`")]
    Syntax {
        /// What is wrong.
        message: String,
        /// The line.
        text: String,
    },
    /// Brackets, which TOML has for lists, in a name without quotes.
    #[error("names with brackets need quotes: `{corrected}`")]
    Unquoted {
        /// The line with quotes.
        corrected: String,
    },
    /// A variable that is no parameter.
    #[error("`{name}` is {role} of {unit}, not a parameter: {advice}")]
    NoParameter {
        /// The name.
        name: String,
        /// What it is.
        role: &'static str,
        /// The unit that has it.
        unit: &'static str,
        /// What to do instead.
        advice: String,
    },
    /// A key that means nothing.
    #[error("unknown key `{key}`{}", proposals(near))]
    UnknownKey {
        /// The key, tables included.
        key: String,
        /// Keys to propose.
        near: Vec<String>,
    },
    /// A parameter that vehicles of this structure do not have.
    #[error("a vehicle with {structure} has no parameter `{name}`{}", proposals(near))]
    UnknownParameter {
        /// The name.
        name: String,
        /// The structure in words.
        structure: String,
        /// Names to propose.
        near: Vec<String>,
    },
    /// A key that stands in the file twice.
    #[error("`{key}` stands in line {first} already")]
    Repeated {
        /// The key.
        key: String,
        /// Where it stands, too.
        first: usize,
    },
    /// A value of the wrong type, or a word or number that is not allowed.
    #[error("`{key}` must be {expected}, but is {found}")]
    Value {
        /// The key.
        key: String,
        /// What is allowed.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A parameter that does not go together with the others.
    #[error(transparent)]
    Parameter(crate::Error),
    /// Rows, waypoints or a file that are no path.
    #[error("`{key}`: {reason}")]
    Path {
        /// The key.
        key: String,
        /// What is wrong.
        reason: String,
    },
    /// The scenario that this one is based on does not exist.
    #[error("`based_on` must be the name of a scenario of the catalogue, but there is no `{id}`{}", proposals(near))]
    NoScenario {
        /// The name asked for.
        id: String,
        /// Names to propose.
        near: Vec<String>,
    },
}

/// The most similar candidates, or none if none is similar.
pub(super) fn near<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    const SIMILAR: f64 = 0.8;
    let mut rated: Vec<(f64, &str)> =
        candidates.into_iter().map(|candidate| (strsim::jaro_winkler(candidate, word), candidate)).collect();
    rated.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    rated.into_iter().take_while(|(rate, _)| *rate > SIMILAR).take(MOST).map(|(_, name)| name.to_owned()).collect()
}

/// Most names that are proposed where some are similar.
const MOST: usize = 3;

fn proposals(near: &[String]) -> String {
    let mut text = String::new();
    let (begin, end, mark) =
        if near.len() > MOST { ("; there are ", " and ", "") } else { ("; did you mean ", " or ", "?") };
    for (i, name) in near.iter().enumerate() {
        let before = match i {
            0 => begin,
            i if i + 1 == near.len() => end,
            _ => ", ",
        };
        // Writing to a text cannot fail.
        let _ = write!(text, "{before}`{name}`");
    }
    if !near.is_empty() {
        text.push_str(mark);
    }
    text
}
