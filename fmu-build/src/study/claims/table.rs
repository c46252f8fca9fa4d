//! The table "what the thesis says beside what came out", for the terminal and for reports.

use std::fmt;

use comfy_table::ContentArrangement;

use super::{Claim, Deviation, Quantity};
use crate::formats::markdown;

/// Characters per line.
const WIDTH: u16 = 120;

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
    pub quantity: String,
    /// The statement of the thesis, if it makes one.
    pub thesis: Option<&'static str>,
    /// One measurement per column.
    pub cells: Vec<Cell>,
    /// Why it does not agree, where that is known.
    pub remark: Option<String>,
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

impl Row {
    /// A quantity of which the thesis says nothing, with numbers as they are shown.
    pub fn plain(quantity: Quantity, numbers: impl IntoIterator<Item = String>) -> Self {
        let cell = |text| Cell { text, agrees: None };
        Self {
            quantity: quantity.label().to_owned(),
            thesis: None,
            cells: numbers.into_iter().map(cell).collect(),
            remark: None,
        }
    }

    /// Numbers beside a claim about them; ratios if the claim compares, and none where there is nothing to compare.
    pub fn of(claim: &Claim, values: impl IntoIterator<Item = Option<f64>>) -> Self {
        let show = |value: f64| match claim.compared_with {
            None => format!("{:#}", claim.quantity.show(value)),
            Some(_) if value.is_nan() => "–".to_owned(),
            // Against something that is nothing but rounding.
            Some(_) if value > 1e3 => "> 1000 times".to_owned(),
            Some(_) if value.abs() < 0.01 => format!("{value:.0e} times"),
            Some(_) => format!("{value:.2} times"),
        };
        let cell = |value: Option<f64>| match value {
            Some(value) => Cell { text: show(value), agrees: Some(claim.agrees(value)) },
            None => Cell { text: format!("both {:#}", claim.quantity.show(0.0)), agrees: None },
        };
        let label = claim.quantity.label();
        Self {
            quantity: claim.compared_with.map_or(label.to_owned(), |other| format!("{label}, against {other}")),
            thesis: Some(claim.thesis),
            cells: values.into_iter().map(cell).collect(),
            remark: claim.deviation.map(|deviation| remark(claim.scenario, &deviation)),
        }
    }
}

/// Why a statement does not hold, and what to run to see it hold.
fn remark(scenario: &str, deviation: &Deviation) -> String {
    let changes = deviation.holds_with.iter().map(|(name, value)| format!(" {name}={value}")).collect::<String>();
    let run = if changes.is_empty() { changes } else { format!("; it holds with `vary {scenario}{changes}`") };
    format!("{}{run}", deviation.why)
}

impl Table {
    /// A table without rows.
    #[must_use]
    pub fn new(columns: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), sections: Vec::new() }
    }

    /// Adds a scenario.
    pub fn add(&mut self, title: impl Into<String>, rows: Vec<Row>) {
        self.sections.push(Section { title: title.into(), rows });
    }

    /// How many numbers stand beside a statement of the thesis, and how many of them agree.
    #[must_use]
    pub fn agreement(&self) -> (usize, usize) {
        let verdicts: Vec<bool> = self.rows().flat_map(|row| &row.cells).filter_map(|cell| cell.agrees).collect();
        (verdicts.len(), verdicts.iter().filter(|&&agrees| agrees).count())
    }

    /// The same for each column.
    #[must_use]
    pub fn agreement_by_column(&self) -> Vec<(usize, usize)> {
        let of_column = |column: usize| {
            let cells = self.rows().filter_map(|row| row.cells.get(column)?.agrees);
            cells.fold((0, 0), |(all, agreeing), agrees| (all + 1, agreeing + usize::from(agrees)))
        };
        (0..self.columns.len()).map(of_column).collect()
    }

    /// Why numbers do not agree, by the first word of the scenario's title.
    pub fn remarks(&self) -> impl Iterator<Item = String> {
        self.sections.iter().flat_map(|section| {
            let scenario = section.title.split(' ').next().unwrap_or_default();
            let remark = |row: &Row| row.remark.as_ref().map(|why| format!("{scenario}, {}: {why}", row.quantity));
            section.rows.iter().filter_map(remark).collect::<Vec<_>>()
        })
    }

    /// The table for a page that is written in Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let head: Vec<&str> =
            ["simulation", "quantity", "thesis"].into_iter().chain(self.columns.iter().map(String::as_str)).collect();
        let mut rows = Vec::new();
        for section in &self.sections {
            let name = section.title.split(' ').next().unwrap_or_default();
            for (i, Row { quantity, thesis, cells, .. }) in section.rows.iter().enumerate() {
                let name = if i == 0 { format!("**{name}**") } else { String::new() };
                let cells = cells.iter().map(|cell| format!("{} {}", cell.text, cell.mark()).trim_end().to_owned());
                let head = [name, quantity.clone(), thesis.unwrap_or_default().to_owned()];
                rows.push(head.into_iter().chain(cells).collect());
            }
        }
        markdown::table(&head, &rows)
    }

    /// The table for a page that is written in Markdown, with the reasons below it why numbers do not agree.
    #[must_use]
    pub fn markdown_with_remarks(&self) -> String {
        let (statements, agreeing) = self.agreement();
        let text = self.markdown()
            + &format!("\n{agreeing} of {statements} numbers agree with the thesis. Where one does not:\n\n");
        self.remarks().fold(text, |text, remark| text + "- " + &remark + "\n")
    }

    fn rows(&self) -> impl Iterator<Item = &Row> {
        self.sections.iter().flat_map(|section| &section.rows)
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
        // Titles and statements go on in the next line.
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
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
