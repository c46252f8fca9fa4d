//! Chapters in Markdown with formulas in TeX, as HTML with MathML: readable without anything from elsewhere.

use maud::{Markup, PreEscaped};
use pulldown_cmark::{CowStr, Event, Options, Parser, html};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser as TexParser, Storage, push_mathml};

/// A chapter of a page.
#[derive(Debug)]
pub struct Chapter {
    /// Heading.
    pub title: String,
    /// What stands below it.
    pub content: Markup,
}

/// The chapters of a text, each of which begins with a line `## TITLE`.
#[must_use]
pub fn chapters(text: &str) -> Vec<Chapter> {
    let parts = text.split("\n## ").flat_map(|part| part.trim_start_matches("## ").split_once('\n'));
    parts.map(|(title, text)| Chapter { title: title.trim().to_owned(), content: render(text) }).collect()
}

/// Markdown as HTML.
fn render(text: &str) -> Markup {
    let events = Parser::new_ext(text, Options::ENABLE_TABLES | Options::ENABLE_MATH).map(|event| match event {
        Event::InlineMath(tex) => Event::InlineHtml(formula(&tex, DisplayMode::Inline)),
        Event::DisplayMath(tex) => Event::Html(formula(&tex, DisplayMode::Block)),
        other => other,
    });
    let mut page = String::new();
    html::push_html(&mut page, events);
    PreEscaped(page)
}

/// TeX as MathML; what cannot be understood stands there as an error in red.
fn formula(tex: &str, display_mode: DisplayMode) -> CowStr<'static> {
    let storage = Storage::new();
    let mut formula = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    // Text can be written to without end.
    let _ = push_mathml(&mut formula, TexParser::new(tex, &storage), config);
    formula.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_have_formulas_and_tables() {
        let found = chapters("## One thing\nThe `mass` $m$.\n\n| a |\n|---|\n| 1 |\n\n## Other\n$$E = m c^2$$\n");
        let titles: Vec<_> = found.iter().map(|chapter| chapter.title.as_str()).collect();
        assert_eq!(titles, ["One thing", "Other"]);
        let [one, other] = &found[..] else { panic!("{titles:?}") };
        let one = &one.content.0;
        assert!(one.contains("<code>mass</code>") && one.contains("<table>") && one.contains("<mi>m</mi>"), "{one}");
        assert!(other.content.0.contains("display=\"block\""), "{}", other.content.0);
    }

    #[test]
    fn an_error_in_a_formula_is_seen() {
        assert!(formula(r"\frac{1", DisplayMode::Inline).contains("merror"));
    }
}
