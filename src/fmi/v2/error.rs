//! Why a call of the host is refused.

use std::fmt;

use super::phase::{Call, Phase};
use crate::fmi::identity::UnknownGuid;
use crate::variables::Bounds;
use crate::variables::options::Item;

/// A refusal that says what was expected, what was found, and of which variable or argument.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A call that the state machine does not allow now.
    #[error("not allowed in the state \"{phase}\"; allowed in: {}", States(*.call))]
    OutOfOrder {
        /// What was called.
        call: Call,
        /// The state of the instance.
        phase: Phase,
    },
    /// An optional ability of the standard that the unit does not declare.
    #[error("not available: the model description declares {flag} = \"{value}\"")]
    NotOffered {
        /// The capability flag.
        flag: &'static str,
        /// What the model description says of it.
        value: &'static str,
    },
    /// A function of model exchange.
    #[error("not available: this unit is for co-simulation, not for model exchange")]
    ModelExchange,
    /// A value reference that no variable has.
    #[error("no variable has the value reference {reference}; there are 0 to {}", .count.saturating_sub(1))]
    UnknownReference {
        /// What was asked for.
        reference: u32,
        /// Number of variables.
        count: usize,
    },
    /// A name that no variable has.
    #[error("there is no variable `{0}`")]
    UnknownName(String),
    /// A variable that cannot be read or written as this type.
    #[error("{name} is of type {found}, not {requested}")]
    Type {
        /// Name of the variable.
        name: String,
        /// Its type.
        found: &'static str,
        /// The type in the name of the function that was called.
        requested: &'static str,
    },
    /// A variable that the host may only read.
    #[error("{name} is {role} and cannot be set")]
    ReadOnly {
        /// Name of the variable.
        name: String,
        /// What it is.
        role: &'static str,
    },
    /// A fixed parameter that is set too late.
    #[error("{name} is a fixed parameter and cannot be set after initialization")]
    Fixed {
        /// Name of the parameter.
        name: String,
    },
    /// A number outside its bounds.
    #[error("{name} must be {expected}, but is {found}")]
    OutOfBounds {
        /// Name of the variable.
        name: String,
        /// What is admissible.
        expected: Bounds,
        /// What was given.
        found: f64,
    },
    /// A number that stands for no truth value.
    #[error("{name} must be 0 (false) or 1 (true), but is {found}")]
    NotBoolean {
        /// Name of the variable.
        name: String,
        /// What was given.
        found: f64,
    },
    /// A number that stands for no alternative of an enumeration.
    #[error("{name} must be {}, but is {found}", Items(.items))]
    NotAnItem {
        /// Name of the variable.
        name: String,
        /// The alternatives, numbered from 1.
        items: &'static [Item],
        /// What was given.
        found: f64,
    },
    /// A number that is not what the function asks for.
    #[error("{argument} must be {expected}, but is {found}")]
    Argument {
        /// The argument as the standard calls it.
        argument: &'static str,
        /// What would be right.
        expected: String,
        /// What was given.
        found: String,
    },
    /// A pointer that is null or not aligned.
    #[error("{argument} does not point to anything usable")]
    Pointer {
        /// The argument as the standard calls it.
        argument: &'static str,
    },
    /// A step that does not begin where the last one ended.
    #[error("currentCommunicationPoint must be {expected}, where the last step ended, but is {found}")]
    Gap {
        /// The instance's own time \[s\].
        expected: f64,
        /// What was given \[s\].
        found: f64,
    },
    /// Initial parameters that the model does not accept.
    #[error("the simulation cannot begin: {0}")]
    Initialization(String),
    /// A step that the model could not do.
    #[error("the step from t = {from} s by {size} s failed: {reason}")]
    Step {
        /// Time at the beginning of the step \[s\].
        from: f64,
        /// Length of the step \[s\].
        size: f64,
        /// What the model says.
        reason: String,
    },
    /// Outputs that the model could not compute.
    #[error("the outputs at t = {time} s: {reason}")]
    Outputs {
        /// The communication point \[s\].
        time: f64,
        /// What the model says.
        reason: String,
    },
    /// A model description that belongs to another library.
    #[error(transparent)]
    Identity(#[from] Box<UnknownGuid>),
    /// A derivative that a variable does not have.
    #[error(
        "{name} has no derivative of order {order} as {role}: only continuous variables of type Real have, of order 1"
    )]
    NoDerivative {
        /// Name of the variable.
        name: String,
        /// What was asked for.
        order: i32,
        /// What it would have to be.
        role: &'static str,
    },
    /// A pointer that is not one of the states that this unit has given out, or no longer.
    #[error("FMUstate is no state of this unit, or has been freed, itself or with the instance that it was got from")]
    NoState,
    /// A state of an instance with other variables.
    #[error("FMUstate belongs to an instance with {found}, but this one has {expected}")]
    OtherStructure {
        /// The structure of the instance.
        expected: String,
        /// The structure of the state.
        found: String,
    },
    /// A state of an instance with other rows of numbers, which states do not hold.
    #[error("FMUstate belongs to an instance with another {rows}")]
    OtherRows {
        /// What they are called.
        rows: &'static str,
    },
    /// Bytes that are no state of this unit, structure and version.
    #[error("serializedState is {what}: it must begin with \"{expected}\", but begins with \"{found}\"")]
    ForeignBytes {
        /// What they are instead.
        what: String,
        /// What states of this structure begin with.
        expected: String,
        /// What was given.
        found: String,
    },
    /// Bytes with the wrong checksum.
    #[error("serializedState is incomplete or damaged: its {count} bytes do not agree with its length and checksum")]
    Damaged {
        /// Number of bytes.
        count: usize,
    },
    /// Bytes that are undamaged but describe no state, or a state that cannot be written.
    #[error("serializedState describes no state of this unit: {reason}")]
    Content {
        /// What is wrong.
        reason: String,
    },
    /// A defect of this library, caught before it could harm the host.
    #[error("internal error: {0}")]
    Panic(String),
}

/// The states in which a call is allowed, in words.
struct States(Call);

impl fmt::Display for States {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut allowed = Phase::ALL.into_iter().filter(|phase| self.0.allowed_in(*phase));
        match allowed.next() {
            None => write!(f, "none"),
            Some(first) => {
                write!(f, "{first}")?;
                allowed.try_for_each(|phase| write!(f, ", {phase}"))
            }
        }
    }
}

/// The alternatives of an enumeration with their numbers, in words.
struct Items<'a>(&'a [Item]);

impl fmt::Display for Items<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, item) in self.0.iter().enumerate() {
            let separator = match i {
                0 => "",
                _ if i + 1 == self.0.len() => " or ",
                _ => ", ",
            };
            write!(f, "{separator}{} ({})", i + 1, item.name)?;
        }
        Ok(())
    }
}
