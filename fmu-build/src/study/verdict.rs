//! What became of a run, in sentences: what its user wants to know before any number.

mod doubts;

use std::fmt;

use uam::control::Status;
use uam::parameters::PathAxes;
use uam::variables::options::Choice;

use crate::host::record::NotRecorded;
use crate::host::run::Run;
use crate::study::claims::{Quantity, peak};

/// How far the end effector may be from its reference while it counts as following it \[m\].
pub const FOLLOWS: f64 = 1e-3;

/// What became of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verdict {
    /// Whether the run reached its end with the end effector within [`FOLLOWS`] of its reference throughout.
    pub followed: bool,
    /// Whether the path was followed, or from when on not and why.
    pub sentence: String,
    /// What looks wrong besides, a sentence each.
    pub doubts: Vec<String>,
}

impl Verdict {
    /// Judges a run by what was recorded.
    ///
    /// # Errors
    /// If the recording lacks what [`Names::standard`](crate::host::record::Names::standard) names.
    pub fn of(run: &Run) -> Result<Self, NotRecorded> {
        let errors = path_errors(run)?;
        let missed = Missed::of(run, &errors)?;
        let mut sentence = match &missed {
            None => followed(run, &errors)?,
            Some(missed) => missed.to_string(),
        };
        if let Some(complaint) = run.complaint() {
            sentence = format!("The run stopped {complaint}. Until then: {sentence}");
        }
        Ok(Self { followed: missed.is_none() && run.stopped.is_none(), sentence, doubts: doubts::of(run)? })
    }

    /// All of it, a sentence each.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        std::iter::once(&self.sentence).chain(&self.doubts).cloned().collect()
    }

    /// What speaks against the run, in a few words.
    #[must_use]
    pub fn summary(&self) -> String {
        let path = if self.followed { "the path was followed" } else { "the path was not followed" };
        match self.doubts.len() {
            0 => path.to_owned(),
            1 => format!("{path}, and something looks wrong"),
            number => format!("{path}, and {number} things look wrong"),
        }
    }

    /// Whether the path was followed and nothing looks wrong.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.followed && self.doubts.is_empty()
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence)?;
        self.doubts.iter().try_for_each(|doubt| write!(f, "\n- {doubt}"))
    }
}

/// Distance between end effector and reference along the axes that the controller follows \[m\].
fn path_errors(run: &Run) -> Result<Vec<f64>, NotRecorded> {
    match run.scenario.parameters.ik.path_axes {
        PathAxes::Both => run.recording.tracking_error(),
        PathAxes::Horizontal => {
            let errors = run.recording.difference("end_effector.x", "reference.x")?;
            Ok(errors.into_iter().map(f64::abs).collect())
        }
    }
}

fn followed(run: &Run, errors: &[f64]) -> Result<String, NotRecorded> {
    let measured = |quantity: Quantity| Ok(quantity.show(quantity.measure(&run.recording)?));
    Ok(format!(
        "The path was followed: the end effector stays within {} of its reference for {} s; the UAV rolls by {} at most, \
         and is never farther than {} along x and {} along y from where it began.",
        distance(peak(errors.iter().copied())),
        number(run.simulated()),
        measured(Quantity::Roll)?,
        measured(Quantity::WayX)?,
        measured(Quantity::WayY)?,
    ))
}

/// How a path was not followed.
struct Missed {
    /// When the end effector leaves its reference, and when it is back for good \[s\].
    from: f64,
    until: Option<f64>,
    /// Largest error, and that at the end \[m\].
    largest: f64,
    last: f64,
    reason: &'static str,
}

impl Missed {
    fn of(run: &Run, errors: &[f64]) -> Result<Option<Self>, NotRecorded> {
        // What is no number is no path followed either.
        let is_off = |error: &f64| !matches!(error.partial_cmp(&FOLLOWS), Some(std::cmp::Ordering::Less));
        let (Some(first), Some(last)) = (errors.iter().position(is_off), errors.iter().rposition(is_off)) else {
            return Ok(None);
        };
        let statuses = run.recording.column("ik.status")?;
        // The status of a row is about the interval after it: only those before the first error have brought it about.
        let before = statuses.get(first.saturating_sub(TRACED)..first).unwrap_or_default();
        let missed = statuses.get(first..last).unwrap_or_default();
        let foreseen = before.iter().any(|status| !status_of(*status).keeps_path());
        let reason = if foreseen { most_frequent(before.iter().chain(missed)) } else { None };
        let times = run.recording.times();
        Ok(Some(Self {
            from: times[first],
            until: times.get(last + 1).copied(),
            largest: peak(errors.iter().copied()),
            last: errors.last().copied().unwrap_or(f64::NAN),
            reason: reason.map_or(UNFORESEEN, why),
        }))
    }
}

/// How many intervals before an error of [`FOLLOWS`] its reason is looked for: errors add up.
const TRACED: usize = 1000;

impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, until, largest, last, reason } = *self;
        match until {
            None => write!(f, "The path was NOT followed from {} s on: {reason}. ", number(from))?,
            Some(until) => {
                write!(f, "The path was NOT followed between {} and {} s: {reason}. ", number(from), number(until))?;
            }
        }
        write!(
            f,
            "The end effector is off its reference by {} at most, and by {} at the end.",
            distance(largest),
            distance(last)
        )
    }
}

const UNFORESEEN: &str =
    "the controller foresaw nothing of it, so the plant is not what it predicts (ik.status says ok)";

/// Why the controller gave up the path.
fn why(status: Status) -> &'static str {
    match status {
        Status::Ok | Status::TaskDamped | Status::TaskLimited => UNFORESEEN,
        Status::PathDamped => {
            "the arm is close to a singular configuration, stretched or folded, and the reference may be out of its reach \
             (ik.status says path_damped)"
        }
        Status::RateLimited => "rates are at their limits (ik.status says rate_limited)",
        Status::PathLimited => "limits of the joints allow nothing nearer to it (ik.status says path_limited)",
        Status::CatchingUp => {
            "an error or a jump of the reference is made good at a bounded speed (ik.status says catching_up)"
        }
        Status::Inexact => {
            "the interval between two plans is too long for the motion in it, or the discretization is euler, which \
             corrects no error (ik.status says inexact)"
        }
    }
}

/// The status that gave up the path most often. What made good was a consequence, unless there is nothing else.
fn most_frequent<'a>(statuses: impl Iterator<Item = &'a f64>) -> Option<Status> {
    let mut counts: Vec<(Status, usize)> = Vec::new();
    for status in statuses.map(|number| status_of(*number)).filter(|status| !status.keeps_path()) {
        match counts.iter_mut().find(|(known, _)| *known == status) {
            Some((_, count)) => *count += 1,
            None => counts.push((status, 1)),
        }
    }
    counts.into_iter().max_by_key(|(status, count)| (*status != Status::CatchingUp, *count)).map(|(status, _)| status)
}

/// The status with the number that was recorded.
fn status_of(number: f64) -> Status {
    let mut status = Status::Ok;
    let known = (1..).zip(status.items()).map(|(number, _)| number).find(|known| f64::from(*known) == number);
    if let Some(known) = known {
        status.choose(known);
    }
    status
}

/// A length, with no more digits than say something.
fn distance(metres: f64) -> String {
    match metres {
        _ if metres < 1e-9 => "1e-9 m".to_owned(),
        _ if metres < 1e-4 => format!("{metres:.1e} m"),
        _ if metres < 1.0 => format!("{} mm", number(1e3 * metres)),
        _ => format!("{} m", number(metres)),
    }
}

/// Three digits or so.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 1.0 => format!("{value:.3}"),
        size if size < 10.0 => format!("{value:.2}"),
        size if size < 1e4 => format!("{value:.1}"),
        _ => format!("{value:.1e}"),
    }
}

#[cfg(test)]
mod tests;
