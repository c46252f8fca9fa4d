//! Colours of curves and drawings, and the style sheet of the page.

use plotters::style::RGBColor;

/// Text and axes.
pub const INK: RGBColor = RGBColor(0x33, 0x3a, 0x45);
/// Lines behind curves.
pub const GRID: RGBColor = RGBColor(0xe3, 0xe7, 0xec);
/// Marked instants.
pub const MARK: RGBColor = RGBColor(0x7a, 0x86, 0x94);

/// Colour and width of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Paint {
    /// Red, green, blue.
    pub rgb: (u8, u8, u8),
    /// Width in halves of a pixel.
    pub width: u32,
}

/// What the report is about: drawn on top.
pub const MAIN: Paint = Paint { rgb: (0x00, 0x72, 0xb2), width: 3 };
/// What it is compared with: broader, to be seen below the main curve where both agree. The two colours
/// stay apart for colour-blind eyes.
pub const OTHER: Paint = Paint { rgb: (0xe6, 0x6a, 0x00), width: 5 };

impl Paint {
    /// The same colour, paler.
    #[must_use]
    pub const fn pale(self) -> Self {
        const fn towards_white(component: u8) -> u8 {
            255 - (255 - component) / 5 * 2
        }
        let (red, green, blue) = self.rgb;
        Self { rgb: (towards_white(red), towards_white(green), towards_white(blue)), width: self.width }
    }

    /// For the drawing library.
    #[must_use]
    pub fn color(&self) -> RGBColor {
        let (red, green, blue) = self.rgb;
        RGBColor(red, green, blue)
    }

    /// For the page.
    #[must_use]
    pub fn css(&self) -> String {
        let (red, green, blue) = self.rgb;
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}

/// The style sheet.
pub const SHEET: &str = include_str!("style.css");
