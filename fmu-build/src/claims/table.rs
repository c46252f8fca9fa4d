//! The table "what the thesis says beside what came out", for the terminal and for reports.

use std::fmt;

use super::{Quantity, find};
use crate::record::Recording;

/// A measured number in words, and whether it agrees with the thesis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// The number with its unit.
    pub text: String,
    /// Agreement, where the thesis says something.
    pub agrees: Option<bool>,
}

/// One quantity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// What it is.
    pub quantity: &'static str,
    /// The statement of the thesis, if it makes one.
    pub thesis: Option<&'static str>,
    /// One measurement per column.
    pub cells: Vec<Cell>,
}

/// One scenario.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Section {
    /// What was run.
    pub title: String,
    /// All quantities.
    pub rows: Vec<Row>,
}

/// Scenarios below each other; variants, for instance discretizations, beside each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Names of the variants.
    pub columns: Vec<String>,
    /// Scenarios.
    pub sections: Vec<Section>,
}

impl Table {
    /// A table without rows.
    #[must_use]
    pub fn new(columns: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), sections: Vec::new() }
    }

    /// Adds quantities from one recording per column, beside what the thesis says of this scenario.
    pub fn add(&mut self, scenario: Option<&str>, title: &str, quantities: &[Quantity], recordings: &[&Recording]) {
        let row = |&quantity: &Quantity| {
            let claim = scenario.and_then(|scenario| find(scenario, quantity));
            let cell = |recording: &&Recording| {
                let value = quantity.measure(recording);
                let agrees = claim.map(|claim| claim.agrees.contains(&value));
                Cell { text: quantity.show(value).to_string(), agrees }
            };
            Row {
                quantity: quantity.label(),
                thesis: claim.map(|claim| claim.thesis),
                cells: recordings.iter().map(cell).collect(),
            }
        };
        self.sections.push(Section { title: title.to_owned(), rows: quantities.iter().map(row).collect() });
    }

    /// How many numbers stand beside a statement of the thesis, and how many of them agree.
    #[must_use]
    pub fn agreement(&self) -> (usize, usize) {
        let rows = self.sections.iter().flat_map(|section| &section.rows);
        let verdicts: Vec<bool> = rows.flat_map(|row| &row.cells).filter_map(|cell| cell.agrees).collect();
        (verdicts.len(), verdicts.iter().filter(|&&agrees| agrees).count())
    }
}

impl Cell {
    /// A check mark or cross where the thesis says something.
    #[must_use]
    pub fn mark(&self) -> &'static str {
        match self.agrees {
            Some(true) => "✓",
            Some(false) => "✗",
            None => "",
        }
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = comfy_table::Table::new();
        table.load_style(comfy_table::presets::UTF8_FULL_CONDENSED);
        let thesis = |text: &str| (self.agreement().0 > 0).then(|| text.to_owned());
        let header = [String::new()].into_iter().chain(thesis("thesis")).chain(self.columns.iter().cloned());
        table.set_header(header);
        for section in &self.sections {
            table.add_row([&section.title]);
            for row in &section.rows {
                let cells = row.cells.iter().map(|cell| format!("{} {}", cell.text, cell.mark()).trim_end().to_owned());
                let head = [format!("  {}", row.quantity)].into_iter().chain(thesis(row.thesis.unwrap_or_default()));
                table.add_row(head.chain(cells));
            }
        }
        write!(f, "{table}")
    }
}
