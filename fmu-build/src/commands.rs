//! What the commands do.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use anyhow::{Context, Result, anyhow};
use fmu_build::host::coupling::{self, Pair};
use fmu_build::host::run::Run;
use fmu_build::study::Summary;
use fmu_build::study::claims::DISCRETIZATIONS;
use fmu_build::{BuildOptions, Built, Design, workspace};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use uam::Structure;
use uam::reference::PathTable;
use uam::scenarios::{self, Extent, Scenario};

use crate::cli::{Arguments, Command, OUT};
use crate::terminal::{is_quiet, say, wrote};

mod budget;
mod build;
pub mod check;
mod completions;
mod export;
pub mod init;
mod pick_up;
mod reach;
mod simulate;
mod thesis;
mod vary;

/// Does what the command line asks for.
pub fn execute(arguments: &Arguments) -> Result<()> {
    match &arguments.command {
        None => pick_up::execute(arguments.out.as_deref().unwrap_or(Path::new(OUT))),
        Some(Command::Build(arguments)) => build::execute(arguments, &arguments.to.out),
        Some(Command::Simulate(simulation)) => simulate::execute(simulation, &simulation.to.out),
        Some(Command::Thesis(arguments)) => thesis::execute(arguments),
        Some(Command::Vary(arguments)) => vary::execute(arguments),
        Some(Command::Reach(arguments)) => reach::execute(arguments, &arguments.to.out),
        Some(Command::Budget(arguments)) => budget::execute(&arguments.print, &arguments.to.out),
        Some(Command::Init(arguments)) => init::execute(arguments),
        Some(Command::Check(arguments)) => check::execute(&arguments.scenario),
        Some(Command::List) => scenarios::catalogue()?
            .iter()
            .try_for_each(|scenario| say(format_args!("{:<24} {}", scenario.id, scenario.title))),
        Some(Command::Show(show)) => {
            let extent = if show.all { Extent::Everything } else { Extent::Changes };
            say(scenario(&show.scenario)?.write(extent).trim_end())
        }
        Some(Command::Export(export)) => export::execute(&export.scenario, &export.to.out),
        Some(Command::Completions(arguments)) => completions::execute(arguments.shell),
        Some(Command::Describe) => wrote(&fmu_build::write_descriptions(&workspace::root()?.join("modelDescription"))?),
    }
}

/// The scenario of a file, or of a name.
fn scenario(name_or_file: &str) -> Result<Scenario> {
    let is_file = Path::new(name_or_file).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    if !is_file {
        return scenarios::find(name_or_file)
            .map_err(|error| anyhow!("{error} (`list` shows all scenarios; a file of your own ends in .toml)"));
    }
    let text = std::fs::read_to_string(name_or_file).with_context(|| format!("cannot read {name_or_file}"))?;
    // The names of other files in it count from where it lies itself.
    let beside = |name: &str| {
        let path = Path::new(name_or_file).with_file_name("").join(name);
        std::fs::read_to_string(&path).map_err(|reason| format!("cannot read {}: {reason}", path.display()))
    };
    Scenario::read_with(&text, &beside).with_context(|| name_or_file.to_owned())
}

/// A display of progress, for those who want to see it.
fn shown(bar: ProgressBar) -> ProgressBar {
    if is_quiet() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    bar
}

/// Builds FMUs and says on the terminal how far it is.
fn build_files(options: &BuildOptions) -> Result<Built> {
    let spinner = shown(ProgressBar::new_spinner());
    spinner.enable_steady_tick(std::time::Duration::from_millis(120));
    let built = fmu_build::build(options, &|line| spinner.set_message(line.to_owned()));
    spinner.finish_and_clear();
    built.with_context(|| format!("cannot build the FMUs for {}", options.design.structure))
}

/// Says which runs stopped early, and why.
fn complain(summaries: &[Summary]) -> Result<()> {
    for Summary { scenario, outcomes } in summaries {
        for complaint in outcomes.iter().filter_map(|outcome| outcome.complaint.as_ref()) {
            say(format_args!("{}: {complaint}", scenario.id))?;
        }
    }
    Ok(())
}

/// How fast runs were.
fn speed(runs: &[&Run]) -> String {
    let simulated: f64 = runs.iter().map(|run| run.simulated()).sum();
    let elapsed: f64 = runs.iter().map(|run| run.elapsed.as_secs_f64()).sum();
    format!("{simulated:.0} s simulated in {elapsed:.2} s: {:.0} times faster than real time.", simulated / elapsed)
}

/// The FMUs of several structures, with the start values of the library, and the tables of paths, which cannot be set.
struct Pairs(Vec<(Structure, Option<Arc<PathTable>>, Pair)>);

impl Pairs {
    /// Builds those for each structure and table of these scenarios once, and loads them.
    ///
    /// They are in a folder of their own, which is gone afterwards: what is in the user's folder may be other FMUs,
    /// of a vehicle of their own for instance.
    fn build<'a>(scenarios: impl IntoIterator<Item = &'a Scenario>) -> Result<Self> {
        let mut pairs = Self(Vec::new());
        for scenario in scenarios {
            if pairs.of(scenario).is_err() {
                let folder = tempfile::tempdir().context("cannot make a temporary folder")?;
                let table = &scenario.parameters.reference.table;
                let mut design = Design::from(scenario.structure);
                design.parameters.reference.table.clone_from(table);
                let built = build_files(&BuildOptions::new(design, folder.path()))?;
                pairs.0.push((scenario.structure, table.clone(), Pair::open(&built.controller, &built.plant)?));
            }
        }
        Ok(pairs)
    }

    /// The pair for the structure and the table of a scenario.
    fn of(&self, scenario: &Scenario) -> Result<&Pair, coupling::Error> {
        let structure = scenario.structure;
        let fits = |table: &Option<_>| *table == scenario.parameters.reference.table;
        let built = self.0.iter().find(|(built, table, _)| *built == structure && fits(table));
        built.map(|(_, _, pair)| pair).ok_or(coupling::Error::NotBuilt { structure })
    }
}

/// Counts communication points on the terminal, from all threads. Drawing costs more than a step: only now
/// and then.
struct Progress {
    bar: ProgressBar,
    points: AtomicU64,
}

impl Progress {
    const STRIDE: u64 = 500;

    fn new(points: u64, what: &'static str) -> Result<Self> {
        let style = ProgressStyle::with_template("{msg} [{bar:40}] {percent:>3} % in {elapsed}")?.progress_chars("=> ");
        let bar = shown(ProgressBar::new(points).with_style(style).with_message(what));
        Ok(Self { bar, points: AtomicU64::new(0) })
    }

    /// Of all points of scenarios that run with each discretization.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "only for the progress bar")]
    fn of(scenarios: &[Scenario], what: &'static str) -> Result<Self> {
        let points: f64 = scenarios.iter().map(|scenario| scenario.duration / scenario.step).sum();
        Self::new(points as u64 * DISCRETIZATIONS.len() as u64, what)
    }

    fn point(&self) {
        if (self.points.fetch_add(1, Ordering::Relaxed) + 1).is_multiple_of(Self::STRIDE) {
            self.bar.inc(Self::STRIDE);
        }
    }

    fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
