//! What can be said of a simulation before it runs: a verdict, what looks wrong, and the numbers behind it.

use std::path::Path;

use anyhow::{Result, bail};
use clap::Args;
use fmu_build::study::check::{Finding, Inherited, check, facts, mistakes};

use crate::terminal::say;

/// Which simulation to look at.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Name of the simulation as in `list`, or a TOML file
    #[arg(value_name = "NAME|FILE")]
    pub scenario: String,
}

pub fn execute(name_or_file: &str) -> Result<()> {
    let scenario = super::scenario(name_or_file)?;
    let mut report = check(&scenario)?;
    let stated = Stated::by(name_or_file);
    report.findings.retain(|finding| stated.leaves(finding));
    let (id, number) = (&scenario.id, report.findings.len());
    let verdict = match number {
        0 => "nothing looks wrong".to_owned(),
        1 => "one thing looks wrong".to_owned(),
        _ => format!("{number} things look wrong"),
    };
    say(format_args!("{id}: {verdict}.\n"))?;
    for (i, finding) in report.findings.iter().enumerate() {
        let mistakes::Sentence { what, change } = mistakes::sentence(finding, &scenario, &report);
        say(format_args!("{}. {what}\n   Change: {change}\n", i + 1))?;
    }
    if report.findings.iter().any(|finding| matches!(finding, Finding::Degrees(_))) {
        say("What follows takes these angles for degrees.\n")?;
    }
    facts::sentences(&scenario, &report).iter().try_for_each(say)?;
    if number > 0 {
        bail!("{verdict} in {name_or_file}");
    }
    Ok(())
}

/// Of what the thesis' pick-up has, too, what somebody has asked for.
struct Stated {
    payload: bool,
    path: bool,
}

impl Stated {
    /// All in the catalogue; in a file, what has a line of its own.
    fn by(name_or_file: &str) -> Self {
        let is_file = Path::new(name_or_file).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        let text = std::fs::read_to_string(name_or_file).unwrap_or_default();
        let mentions = |word: &str| {
            let mut lines = text.lines().map(|line| line.split('#').next().unwrap_or_default());
            !is_file || lines.any(|line| line.contains(word))
        };
        // As a name, in quotes or not, or as a table with keys below.
        Self {
            payload: mentions("payload.mass") || mentions("parameters.payload"),
            path: mentions("reference.") || mentions("parameters.reference"),
        }
    }

    /// Whether a finding stays one.
    fn leaves(&self, finding: &Finding) -> bool {
        match finding {
            Finding::Inherited(Inherited::Payload { .. }) => !self.payload,
            Finding::Inherited(Inherited::Path) => !self.path,
            _ => true,
        }
    }
}
