//! Panels beside each other, below one legend.

use maud::{Markup, PreEscaped, html};

use super::chart::Panel;
use super::{Error, Paint};

/// The panels, with the names of the curves above them; one name alone is left out.
///
/// # Errors
/// If a panel cannot be drawn.
pub fn panels(names: &[(Paint, &str)], panels: &[Panel]) -> Result<Markup, Error> {
    let (class, width) = match panels.len() {
        1 => ("panels one", 1120),
        2 | 4 => ("panels two", 550),
        _ => ("panels three", 362),
    };
    let drawings = panels.iter().map(|panel| panel.svg(width)).collect::<Result<Vec<_>, _>>()?;
    Ok(html! {
        @if names.len() > 1 {
            div.legend { @for (paint, name) in names { span style={ "--paint:" (paint.css()) } { (name) } } }
        }
        div class=(class) { @for drawing in drawings { (PreEscaped(drawing)) } }
    })
}
