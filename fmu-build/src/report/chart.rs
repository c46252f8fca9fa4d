//! Curves over time, or over another quantity, as SVG.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::decimate::{envelope, peaks};
use super::style::{GRID, INK, MARK, Paint};

/// The drawing library rounds to whole pixels; so draw large, and let the page scale down.
const FINE: u32 = 8;
const HEIGHT: u32 = 230;
/// More points than this per curve cannot be seen.
const BUCKETS: usize = 300;
/// What a logarithmic axis shows for 0 and anything smaller.
const TINY: f64 = 1e-16;

/// How values are spread over an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By powers of ten.
    Logarithmic,
}

/// A horizontal axis.
#[derive(Debug, Clone, Copy)]
pub struct Across {
    /// Label, with unit.
    pub axis: &'static str,
    /// How values are spread.
    pub scale: Scale,
}

/// Time as the horizontal axis.
pub const TIME: Across = Across { axis: "time [s]", scale: Scale::Linear };

/// A curve.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Colour and width.
    pub paint: Paint,
    /// Time \[s\], or what else is on the horizontal axis, and value in the unit of the vertical axis.
    pub points: Vec<(f64, f64)>,
}

/// Curves over the same axes.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Horizontal axis.
    pub across: Across,
    /// Label of the vertical axis, with unit.
    pub axis: String,
    /// Vertical axis.
    pub scale: Scale,
    /// The curves; later ones are drawn over earlier ones.
    pub curves: Vec<Curve>,
    /// Instants to mark, with a word on each.
    pub marks: Vec<(f64, &'static str)>,
}

impl Curve {
    /// A curve with no more points than can be seen; what is not finite is left out.
    #[must_use]
    pub fn new(paint: Paint, times: &[f64], values: impl Iterator<Item = f64>) -> Self {
        Self { paint, points: envelope(times, values, BUCKETS) }
    }

    /// A curve of the largest values: what matters of an error.
    #[must_use]
    pub fn of_peaks(paint: Paint, times: &[f64], values: impl Iterator<Item = f64>) -> Self {
        Self { paint, points: peaks(times, values, BUCKETS) }
    }
}

impl Panel {
    /// Draws the panel as an `svg` element, `width` pixels wide on the page.
    ///
    /// # Errors
    /// If the drawing library gives up.
    pub fn svg(&self, width: u32) -> Result<String, super::Error> {
        let mut svg = String::new();
        self.draw(&mut svg, width).map_err(|error| super::Error::Drawing(error.to_string()))?;
        // The page decides about the size.
        let fixed = format!("width=\"{}\" height=\"{}\" ", width * FINE, HEIGHT * FINE);
        Ok(svg.replacen(&fixed, "class=\"chart\" ", 1))
    }

    fn draw(&self, svg: &mut String, width: u32) -> Result<(), Box<dyn std::error::Error + '_>> {
        let curves: Vec<(Paint, Vec<(f64, f64)>)> = self
            .curves
            .iter()
            .map(|curve| {
                (
                    curve.paint,
                    curve.points.iter().map(|&(t, v)| (self.across.scale.place(t), self.scale.place(v))).collect(),
                )
            })
            .collect();
        let points = || curves.iter().flat_map(|(_, points)| points.iter().copied());
        let (from, to) = range(points().map(|(t, _)| t)).unwrap_or((0.0, 1.0));
        let (low, high) = padded(range(points().map(|(_, v)| v)).unwrap_or((0.0, 1.0)), self.scale);
        let label = |value: &f64| tick(*value, high - low, self.scale);
        let font = |size: u32| ("sans-serif", size * FINE).into_font().color(&INK);
        let px = |size: u32| size * FINE;

        let area = SVGBackend::with_string(svg, (px(width), px(HEIGHT))).into_drawing_area();
        let mut chart = ChartBuilder::on(&area)
            .margin_top(px(20))
            .margin_right(px(10))
            .x_label_area_size(px(42))
            .y_label_area_size(px(60))
            .build_cartesian_2d(from..to, low..high)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID.stroke_width(FINE))
            .axis_style(INK.stroke_width(FINE))
            .set_all_tick_mark_size(px(4))
            .x_labels(7)
            .y_labels(5)
            .x_desc(self.across.axis)
            .y_desc(&self.axis)
            .label_style(font(14))
            .axis_desc_style(font(15))
            .x_label_formatter(&|value| tick(*value, to - from, self.across.scale))
            .y_label_formatter(&label)
            .draw()?;
        for &(time, word) in self.marks.iter().filter(|(time, _)| (from..=to).contains(time)) {
            let dash = px(3);
            chart.draw_series(DashedLineSeries::new(
                [(time, low), (time, high)],
                dash,
                dash,
                MARK.stroke_width(FINE),
            ))?;
            let style = ("sans-serif", px(14)).into_font().color(&MARK).pos(Pos::new(HPos::Center, VPos::Bottom));
            chart.draw_series([Text::new(word, (time, high), style)])?;
        }
        for (paint, points) in curves {
            chart.draw_series(LineSeries::new(points, paint.color().stroke_width(paint.width * FINE / 2)))?;
        }
        area.present()?;
        drop(chart);
        Ok(())
    }
}

impl Scale {
    /// Where a value is on the axis.
    fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic => value.abs().max(TINY).log10(),
        }
    }
}

/// Smallest and largest value.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |range, value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((low.min(value), high.max(value))),
    })
}

/// The range with some room around it, and never empty.
fn padded((low, high): (f64, f64), scale: Scale) -> (f64, f64) {
    match scale {
        Scale::Logarithmic => (low.floor(), (high + 0.2).ceil()),
        Scale::Linear => {
            let size = (high - low).max(1e-9 * low.abs().max(high.abs())).max(1e-12);
            (low - 0.06 * size, high + 0.06 * size)
        }
    }
}

/// Text of a tick with as many digits as the span of the axis needs.
fn tick(value: f64, span: f64, scale: Scale) -> String {
    match scale {
        Scale::Logarithmic if (value - value.round()).abs() > 1e-6 => String::new(),
        Scale::Logarithmic => format!("1e{value:.0}"),
        Scale::Linear if value.abs() < 1e-9 * span => "0".to_owned(),
        Scale::Linear if !(1e-3..1e5).contains(&span) => format!("{value:.1e}"),
        Scale::Linear => {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 4")]
            let digits = (-(span / 8.0).log10()).ceil().max(0.0) as usize;
            let text = format!("{value:.digits$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_the_digits_they_need() {
        assert_eq!(tick(20.0, 120.0, Scale::Linear), "20");
        assert_eq!(tick(0.05, 0.2, Scale::Linear), "0.05");
        assert_eq!(tick(76.0, 6.0, Scale::Linear), "76");
        assert_eq!(tick(-1.5, 3.0, Scale::Linear), "-1.5");
        assert_eq!(tick(1e-17, 3.0, Scale::Linear), "0");
        assert_eq!(tick(2e-5, 1e-4, Scale::Linear), "2.0e-5");
        assert_eq!(tick(-12.0, 6.0, Scale::Logarithmic), "1e-12");
        assert_eq!(tick(-12.5, 6.0, Scale::Logarithmic), "");
    }

    #[test]
    fn draws_whatever_comes() {
        let paint = super::super::style::MAIN;
        for values in [vec![], vec![0.0], vec![0.0; 5], vec![f64::NAN, 1.0], vec![1e300, -1e300], vec![5.0, 5.0]] {
            let times: Vec<f64> = (0..values.len()).map(|i| i as f64).collect();
            for scale in [Scale::Linear, Scale::Logarithmic] {
                let curves = vec![Curve::new(paint, &times, values.iter().copied())];
                let panel = Panel { across: TIME, axis: "a [m]".into(), scale, curves, marks: vec![(0.5, "grasp")] };
                let svg = panel.svg(500).unwrap();
                assert!(svg.starts_with("<svg class=\"chart\" viewBox"), "{}", &svg[..200]);
                assert!(svg.trim_end().ends_with("</svg>"));
            }
        }
    }
}
