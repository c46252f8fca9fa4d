//! The command line.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use fmu_build::compile::cross::TARGETS;
use fmu_build::study::claims::DISCRETIZATIONS;
use uam::Structure;
use uam::parameters::{Balance, Discretization, MAX_LINKS};
use uam::variables::options::Choice;

use crate::commands::check::CheckArguments;
use crate::commands::init::InitArguments;

const EXAMPLES: &str = "\
Examples:
  uam                                 build, run the pick-up of thesis 4.3, write out/report.html
  uam build --links 2                 FMUs of a vehicle with two links
  uam build --scenario mine.toml      FMUs that start with the numbers of your own vehicle
  uam thesis                          every statement of the thesis beside what comes out
  uam reach                           how far the arm reaches with a counterweight
  uam budget                          which communication step for which error
  uam vary 3.7 pace=1,1.2,1.5         the same motion, faster
  uam list                            the simulations that `simulate` knows
  uam simulate 4.3a                   one simulation, with its own report
  uam simulate 4.3b --step 0.01 --stop 10 --discretization euler
  uam init mine.toml --links 2        a vehicle of your own, level and without payload
  uam check mine.toml                 what in it looks like a mistake
  uam show 4.3b > mine.toml           a file to start your own simulation from
  uam simulate mine.toml              your own simulation
  uam export 4.2a                     parameter sets for other hosts

Without installing it: `cargo run --release --` stands for `uam` in the folder of the sources.";

/// Two FMI 2.0 co-simulation units of an aerial manipulator: builds them, couples them, shows what happens
///
/// Without a command: builds uam_controller.fmu, uam_plant.fmu and uam.ssp, loads the two FMUs through
/// their C interface, couples them on the payload pick-up of thesis section 4.3, prints what the thesis
/// says beside what came out, and writes pick-up.csv and report.html.
#[derive(Debug, Parser)]
#[command(name = "uam", version, after_help = EXAMPLES)]
pub struct Arguments {
    /// What to do instead
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Folder for all files that are written; created if it is missing
    #[arg(long, global = true, value_name = "FOLDER", default_value = "out")]
    pub out: PathBuf,
    /// Print results only: no progress, no times, no list of what was written
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

/// What the program can do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build the two FMUs and the SSP, and nothing else
    ///
    /// The structure of the vehicle decides which variables the FMUs have. All numbers (masses, lengths,
    /// gains, path) are parameters of the FMUs and can be set by every host; --scenario gives them other start values.
    Build(BuildArguments),
    /// Run one simulation and write its csv and its report
    ///
    /// Couples FMUs of the simulation's structure with a fixed-step master, and writes <SCENARIO>.csv with every
    /// communication point, <SCENARIO>.json with units, parameters and scenario, and <SCENARIO>.html with figures. The FMUs are built for this run; those in the folder stay as
    /// they are.
    Simulate(SimulateArguments),
    /// Run every simulation of the thesis and print what it says beside what comes out
    ///
    /// Each runs with both discretizations. Nothing is written.
    Thesis(PrintArguments),
    /// Run a simulation with some numbers changed, and print what depends on them
    ///
    /// One column for the simulation as it is, and one for each value. Several names take their values together: the
    /// first value of each, then the second; a single value stays. Nothing is written.
    Vary(VaryArguments),
    /// Find out how far the arm reaches, with the counterweight locked and moving
    ///
    /// Enlarges the motions of thesis 3.8 and, with payload, 4.4 by a centimetre at a time until limits or a singular
    /// configuration make the path give way (`ik.status`), and then narrows this down to a millimetre. Writes
    /// reach.html, which shows the moment on the UAV over the way.
    Reach(ReachArguments),
    /// Find out which communication step leaves which error
    ///
    /// Runs the pick-up with steps from 0.1 ms to 50 ms, both discretizations and holds, three orders in which a
    /// master may step the units, and autopilots that are continuous or sampled. Prints the largest errors of the end
    /// effector and of the predicted base with the observed orders, and writes budget.html with figures.
    Budget(PrintArguments),
    /// Write a scenario file for a vehicle of your own
    ///
    /// Every value has its unit in a comment. The vehicle has no payload, starts level, and runs with `simulate` at once.
    Init(InitArguments),
    /// Say of a simulation, before it runs, what looks like a mistake
    ///
    /// A verdict, then each mistake with the parameter to change and its value, then the numbers behind it: balance at
    /// the start, distance from singular, stability of the hover, what the path asks for. The exit code is 0 if
    /// nothing looks wrong, else 1.
    Check(CheckArguments),
    /// List the simulations that `simulate` knows, one per line
    List,
    /// Print a simulation as a TOML file, to be changed and given to `simulate`
    ///
    /// The file holds the structure of the vehicle, duration, step, and the parameters that differ from the start
    /// values of the FMUs, under the names that they have there. A file may say `based_on = "4.3b"` and then hold
    /// nothing but what is different from that simulation: `id` and the parameters to change.
    Show(ShowArguments),
    /// Write a simulation as parameter sets that every host can give to the FMUs
    ///
    /// Writes <ID>.toml, which scripts can read (see examples/scenario.py), and <ID>.controller.ssv and
    /// <ID>.plant.ssv, parameter sets by the SSP standard. They hold the parameters that differ from the start
    /// values in the FMUs of the simulation's structure.
    Export(ExportArguments),
    /// Print a script that lets a shell complete commands and options
    ///
    /// For instance, once: uam completions bash > ~/.local/share/bash-completion/completions/uam
    Completions(CompletionsArguments),
    /// Write the model descriptions that are under version control anew
    ///
    /// To be called after variables have changed: modelDescription/uam_controller.xml and uam_plant.xml
    /// belong to the FMUs of the default vehicle, and a test compares them.
    #[command(hide = true)]
    Describe,
}

const BUILD_EXAMPLES: &str = "\
Examples:
  uam build                              the vehicle of thesis 4.3, for this machine
  uam build --links 2 --counterweight    variables of two links and a counterweight
  uam build --scenario 4.4b --out there  what thesis 4.4 does, in any host that sets nothing
  uam build --platforms linux64,win64,darwin64 --sources FOLDER

What other platforms need beside Rust and the sources of this project:
  linux64        cargo-zigbuild and Zig: pip install cargo-zigbuild ziglang
  win64          mingw-w64, and: rustup target add x86_64-pc-windows-gnu
  darwin64       as linux64, and: rustup target add x86_64-apple-darwin aarch64-apple-darwin
  aarch64-linux  as linux64, and: rustup target add aarch64-unknown-linux-gnu";

/// Which vehicle.
#[derive(Debug, Args)]
#[command(after_long_help = BUILD_EXAMPLES)]
pub struct BuildArguments {
    /// Revolute links of the arm, 1 to 6
    #[arg(long, value_name = "NUMBER", value_parser = links, allow_hyphen_values = true)]
    #[arg(default_value_t = Structure::DEFAULT.links)]
    pub links: usize,
    /// A counterweight that slides along the UAV balances the arm
    #[arg(long, conflicts_with = "balance_element")]
    pub counterweight: bool,
    /// A driven body that turns about the UAV's centre of mass balances the arm
    #[arg(long)]
    pub balance_element: bool,
    /// Vehicle, gains, method and path of a simulation as start values, by its name in `list` or as a TOML file
    ///
    /// The FMUs then run this simulation in any host that sets nothing. `show` prints a file to start from.
    #[arg(long, value_name = "NAME|FILE", visible_alias = "parameters")]
    #[arg(conflicts_with_all = ["links", "counterweight", "balance_element"])]
    pub scenario: Option<String>,
    /// Names like joint_1_rate_command instead of joint[1].rate_command, for hosts that make buses of the latter
    #[arg(long)]
    pub flat: bool,
    /// Say in terminalsAndIcons.xml which variables belong together, for hosts that connect them by one line
    ///
    /// FMI Library 3.0.4, and with it PyFMI, complains of such a file in units of FMI 2.0, and goes on without it.
    #[arg(long)]
    pub terminals: bool,
    /// Platforms that the FMUs are for, separated by commas [default: this machine]
    ///
    /// linux64 runs with the C library of 2012 and later; darwin64 holds both processors. Binaries for aarch64-linux
    /// go into FMUs of their own, in a folder of this name, for many importers look for them where those for x86-64
    /// are. What a platform needs beside Rust is said if it is missing.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = platforms())]
    pub platforms: Vec<String>,
    /// All platforms for which this machine has the tools
    #[arg(long, conflicts_with = "platforms")]
    pub all_platforms: bool,
    /// A folder of this project's sources to compile the libraries from
    ///
    /// The program holds the libraries for its own platform. Those for other platforms are compiled, by cargo, from the
    /// sources around the current folder if none are named. If they are named, all are compiled from them.
    #[arg(long, value_name = "FOLDER")]
    pub sources: Option<PathBuf>,
}

impl BuildArguments {
    /// The structure asked for.
    ///
    /// # Errors
    /// If there is no such structure.
    pub fn structure(&self) -> uam::Result<Structure> {
        let balance = match (self.counterweight, self.balance_element) {
            (true, _) => Balance::Counterweight,
            (false, true) => Balance::Element,
            (false, false) => Balance::None,
        };
        Structure::new(self.links, balance)
    }
}

/// Which simulation, and how.
#[derive(Debug, Args)]
pub struct SimulateArguments {
    /// Name of the simulation as in `list`, for instance 4.3b, or a TOML file as `show` prints it
    pub scenario: String,
    /// Communication step in seconds [default: the simulation's own]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// When to stop, in seconds [default: the simulation's own]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub stop: Option<f64>,
    /// How the controller predicts the coming interval [default: the simulation's own]
    ///
    /// euler: the step of the thesis, with errors of 0.1 to 0.5 mm at 1 ms. exact: integrated through the
    /// interval, with errors near rounding.
    #[arg(long, value_name = "NAME", value_parser = discretizations())]
    pub discretization: Option<Discretization>,
    /// End with an error unless the path was followed and nothing looks wrong
    ///
    /// What is wrong stands in the first lines of the output and of the report: for instance a path that the arm cannot follow,
    /// or a UAV that rolls over, falls or drifts away.
    #[arg(long)]
    pub strict: bool,
    /// Write every output of both units to the csv, not only those in the report
    #[arg(long)]
    pub all_outputs: bool,
}

/// How to print what came out.
#[derive(Debug, Args)]
pub struct PrintArguments {
    /// Print the table in Markdown, as it stands in the documents of this project
    #[arg(long)]
    pub markdown: bool,
}

/// Which simulation, and what to change.
#[derive(Debug, Args)]
pub struct VaryArguments {
    /// Name of the simulation as in `list`, or a TOML file as `show` prints it
    pub scenario: String,
    /// A name and its values, for instance autopilot.roll.kd=3,6,9
    ///
    /// A parameter (`[*]` instead of `[1]`: that of every link, joint or leg), `duration`, `step`, `pace` (all times of path and
    /// grasp are divided by it) or `size` (all ways of the path are multiplied by it).
    #[arg(value_name = "NAME=VALUES", required = true, value_parser = change)]
    pub changes: Vec<Change>,
    /// Print every quantity, not only those about which the thesis says something
    #[arg(long)]
    pub all: bool,
    /// How to print what came out
    #[command(flatten)]
    pub print: PrintArguments,
}

/// What to change in the motions.
#[derive(Debug, Args)]
pub struct ReachArguments {
    /// A name and its value, as in `vary`, for instance joint[*].acceleration_limit=20
    #[arg(value_name = "NAME=VALUE", value_parser = change)]
    pub changes: Vec<Change>,
    /// How to print what came out
    #[command(flatten)]
    pub print: PrintArguments,
}

/// A name and the values that it takes one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The name.
    pub name: String,
    /// The values, at least one.
    pub values: Vec<String>,
}

impl Change {
    /// The name with its only value.
    ///
    /// # Errors
    /// If there are several.
    pub fn single(&self) -> anyhow::Result<(&str, &str)> {
        let [value] = &self.values[..] else {
            anyhow::bail!("{} must have one value, but has {}", self.name, self.values.len())
        };
        Ok((&self.name, value))
    }
}

/// Which simulation to print, and how much of it.
#[derive(Debug, Args)]
pub struct ShowArguments {
    /// Name of the simulation as in `list`, or a TOML file
    pub scenario: String,
    /// All parameters, not only those that differ from the start values of the FMUs
    #[arg(long)]
    pub all: bool,
}

/// Which simulation to write.
#[derive(Debug, Args)]
pub struct ExportArguments {
    /// Name of the simulation as in `list`, or a TOML file
    pub scenario: String,
}

/// Which shell.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell
    pub shell: Shell,
}

fn change(text: &str) -> Result<Change, String> {
    let (name, values) =
        text.split_once('=').ok_or("a name and its values are needed, for instance step=0.001,0.01")?;
    Ok(Change {
        name: name.trim().to_owned(),
        values: values.split(',').map(|value| value.trim().to_owned()).collect(),
    })
}

/// The number of links that a text stands for.
///
/// # Errors
/// If no arm has as many.
pub fn links(text: &str) -> Result<usize, String> {
    let number: usize = text.parse().map_err(|_| format!("an arm has 1 to {MAX_LINKS} links"))?;
    Structure::new(number, Balance::None).map(|structure| structure.links).map_err(|error| error.to_string())
}

fn seconds(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "a number of seconds is needed, for instance 0.001".to_owned())
}

fn platforms() -> PossibleValuesParser {
    PossibleValuesParser::new(TARGETS.iter().map(|target| target.platform.folder))
}

fn discretizations() -> impl TypedValueParser<Value = Discretization> {
    PossibleValuesParser::new(DISCRETIZATIONS.map(|choice| choice.name())).try_map(|name| {
        DISCRETIZATIONS.into_iter().find(|choice| choice.name() == name).ok_or("there is no such discretization")
    })
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    fn refusal(line: &str) -> String {
        Arguments::try_parse_from(line.split(' ')).unwrap_err().to_string()
    }

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn refusals_say_what_is_allowed() {
        for number in ["0", "7", "-1", "two", "2.5"] {
            assert!(refusal(&format!("uam build --links {number}")).contains("1 to 6"));
        }
        assert!(refusal("uam build --counterweight --balance-element").contains("cannot be used with"));
        assert!(refusal("uam simulate 4.3a --discretization rk4").contains("euler, exact"));
        assert!(refusal("uam simulate 4.3a --step soon").contains("for instance 0.001"));
    }

    #[test]
    fn numbers_that_make_no_sense_reach_the_schedule() {
        for (text, expected) in [("-0.001", -0.001), ("0", 0.0), ("inf", f64::INFINITY)] {
            let line = format!("uam simulate 4.3a --step {text}");
            let Some(Command::Simulate(arguments)) = Arguments::try_parse_from(line.split(' ')).unwrap().command else {
                panic!("not simulate");
            };
            assert_eq!(arguments.step, Some(expected));
        }
    }
}
