//! Results as a page in Markdown that is readable on a terminal, too.

use std::process::Command;

use comfy_table::{Table, presets::ASCII_MARKDOWN};

use crate::measure::{Measured, Spread};

/// What was printed so far.
pub struct Page(String);

impl Page {
    /// Begins with the machine.
    pub fn new(rounds: usize) -> Self {
        let mut page = Self(String::new());
        page.say(&format!("{}; medians of {rounds} rounds, least and most in brackets.\n", machine()));
        page
    }

    pub fn text(&self) -> &str {
        &self.0
    }

    /// A table of times and of their ratios to the first.
    pub fn add(&mut self, title: &str, rows: &[Measured]) {
        let cells = |row: &Measured| {
            let error = row.error.map_or_else(String::new, |error| format!("{error:.0e}"));
            [row.name.clone(), time(row.time.median), ratio(row.ratio, "×"), error]
        };
        self.table([title, "time", "by the first", "error"], rows.iter().map(cells));
    }

    /// A table of speeds.
    pub fn add_times_real_time(&mut self, title: &str, rows: &[(String, Spread)]) {
        self.table([title, "real time"], rows.iter().map(|(name, times)| [name.clone(), ratio(*times, "×")]));
    }

    fn table<const N: usize>(&mut self, head: [&str; N], rows: impl Iterator<Item = [String; N]>) {
        let mut table = Table::new();
        table.load_style(ASCII_MARKDOWN);
        table.set_header(head);
        table.add_rows(rows);
        self.say(&format!("{table}\n"));
    }

    fn say(&mut self, text: &str) {
        println!("{text}");
        self.0.push_str(text);
        self.0.push('\n');
    }
}

fn ratio(Spread { median, least, most }: Spread, unit: &str) -> String {
    let digits = usize::from(median < 99.5) + usize::from(median < 9.95);
    format!("{median:.digits$} {unit} ({least:.digits$} to {most:.digits$})")
}

fn time(seconds: f64) -> String {
    if seconds < 1e-6 { format!("{:.0} ns", 1e9 * seconds) } else { format!("{:.2} µs", 1e6 * seconds) }
}

/// Processor and programs.
fn machine() -> String {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = information
        .lines()
        .find_map(|line| line.strip_prefix("model name"))
        .map_or("", |rest| rest.trim_start_matches([' ', '\t', ':']));
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let rust = Command::new("rustc").arg("--version").output().map_or_else(
        |_| String::new(),
        |output| String::from_utf8_lossy(&output.stdout).split_whitespace().take(2).collect::<Vec<_>>().join(" "),
    );
    let peers = std::env::var("PEERS_VERSIONS").unwrap_or_default();
    let parts = [processor.to_owned(), format!("{cores} cores"), std::env::consts::OS.to_owned(), rust, peers];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}
