//! What can be wrong with the parameters of a run, or happen during one.

/// Result of the library's fallible functions.
pub type Result<T> = std::result::Result<T, Error>;

/// An error that says what was expected, what was found, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A structure that is not built.
    #[error("an arm has 1 to {largest} links, not {links}")]
    Structure {
        /// What was asked for.
        links: usize,
        /// What there is.
        largest: usize,
    },
    /// A parameter outside its own bounds.
    #[error("{name} must be {expected}, but is {found}")]
    OutOfBounds {
        /// Public name of the parameter.
        name: String,
        /// The bounds in words.
        expected: String,
        /// The value.
        found: f64,
    },
    /// Parameters that do not go together.
    #[error("{name} = {found} does not go together with the other parameters: {expected}")]
    Inconsistent {
        /// Public name of the parameter to look at.
        name: String,
        /// What is required of it.
        expected: String,
        /// The value, as text.
        found: String,
    },
    /// A simulation that cannot begin, and could with another value of one parameter.
    #[error("{name} = {found} makes a simulation impossible: {reason}; with {name} = {start} it could begin")]
    Unsuited {
        /// Public name of the parameter.
        name: String,
        /// Its value, as text.
        found: String,
        /// The value with which a simulation could begin.
        start: String,
        /// What goes wrong.
        reason: Box<Error>,
    },
    /// A step that would take for ever.
    #[error("a step of {size:e} s is too long, at most {most:.1e} s: {cause}")]
    StepTooLong {
        /// The step \[s\].
        size: f64,
        /// The longest one \[s\].
        most: f64,
        /// What is so fast that it takes short internal steps, by the names of its parameters.
        cause: String,
    },
    /// The state of a simulation is no longer finite.
    #[error("the state is no longer finite after t = {time} s: {quantity} = {value}")]
    NotFinite {
        /// First quantity that is not finite.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Time since the start \[s\].
        time: f64,
    },
    /// Bytes that do not hold what was written.
    #[error("the bytes do not hold the memory of a simulation: {0}")]
    Bytes(&'static str),
    /// A memory that no simulation has.
    #[error("no simulation is in this state: {quantity} = {value}")]
    Impossible {
        /// What is wrong.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
}

impl Error {
    /// The parameter to look at, if it is one.
    #[must_use]
    pub fn parameter(&self) -> Option<&str> {
        match self {
            Self::OutOfBounds { name, .. } | Self::Inconsistent { name, .. } | Self::Unsuited { name, .. } => {
                Some(name)
            }
            _ => None,
        }
    }
}
