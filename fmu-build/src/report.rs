//! A page that shows what happened in one or more runs: one HTML file, nothing to be fetched.

use std::path::Path;

use maud::{Markup, html};

mod arm;
pub mod budget;
mod chart;
mod decimate;
pub mod figures;
mod panels;
pub mod pick_up;
mod pose;
pub mod reach;
pub mod single;
mod style;

pub use figures::{Figure, Topic};
pub use style::Paint;

use crate::files::{self, Written};
use crate::formats::html::document;
use crate::host::record::NotRecorded;
use crate::host::run::Run;
use crate::package::metadata::GENERATION_TOOL;
use crate::study::claims::Table;
use crate::study::particulars;

/// A report that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// There is nothing to show.
    #[error("a report needs at least one run")]
    Empty,
    /// A simulation that belongs to the report was not run.
    #[error("the report needs a run of {scenario}")]
    Missing {
        /// Name of the simulation.
        scenario: &'static str,
    },
    /// What a figure shows, or a number sums up.
    #[error(transparent)]
    NotRecorded(#[from] NotRecorded),
    /// The drawing library gave up.
    #[error("a figure cannot be drawn: {0}")]
    Drawing(String),
}

/// A run with the name and the colour that it has in all figures.
#[derive(Debug, Clone, Copy)]
pub struct Series<'a> {
    /// Name in legends.
    pub label: &'a str,
    /// Colour.
    pub paint: Paint,
    /// What came out.
    pub run: &'a Run,
}

/// A page.
#[derive(Debug)]
pub struct Report {
    /// Heading.
    pub title: String,
    /// What was run.
    pub introduction: Markup,
    /// Measured quantities, beside the thesis where it says something.
    pub table: Table,
    /// Figures in their order.
    pub figures: Vec<Figure>,
    /// What stands at the end.
    pub appendix: Markup,
}

impl Report {
    /// The page as text.
    #[must_use]
    pub fn html(&self) -> String {
        page(
            &self.title,
            &html! {
                (self.introduction)
                @for (i, figure) in self.figures.iter().enumerate() {
                    section { figure { h2 { (figure.title) } (figure.body) figcaption { (figure.caption) } } }
                    // The picture of what happens comes first.
                    @if i == 0 { section { h2 { "What came out" } (table(&self.table)) } }
                }
                (self.appendix)
            },
        )
    }

    /// Writes the page.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> crate::Result<Written> {
        files::write(path, self.html().as_bytes())
    }
}

/// A page with a heading.
fn page(title: &str, content: &Markup) -> String {
    document(title, style::SHEET, &html! { main { h1 { (title) } (content) } })
}

/// What became of a run: it stands first.
fn verdict(sentences: &[String]) -> Markup {
    let (sentence, doubts) = sentences.split_first().map_or((None, sentences), |(first, rest)| (Some(first), rest));
    html! {
        @if let Some(sentence) = sentence { p { strong { (sentence) } } }
        @if !doubts.is_empty() { ul { @for doubt in doubts { li { (doubt) } } } }
    }
}

/// Which program made a page, and when.
fn made_by() -> Markup {
    html! { p { "Made by " (GENERATION_TOOL) " on " (particulars::today()) "." } }
}

fn table(table: &Table) -> Markup {
    let thesis = table.agreement().0 > 0;
    html! {
        div.wide {
            table {
                thead {
                    tr {
                        th { }
                        @if thesis { th { "the thesis says" } }
                        @for column in &table.columns { th { (column) } }
                    }
                }
                @for section in &table.sections {
                    tbody {
                        tr { th colspan=(table.columns.len() + 1 + usize::from(thesis)) { (section.title) } }
                        @for row in &section.rows {
                            tr {
                                td { (row.quantity) }
                                @if thesis { td { (row.thesis.unwrap_or_default()) } }
                                @for cell in &row.cells {
                                    td.yes[cell.agrees == Some(true)].no[cell.agrees == Some(false)] {
                                        (cell.text) " " i { (cell.mark()) }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
