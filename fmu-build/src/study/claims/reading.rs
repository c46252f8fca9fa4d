//! How people read numbers: the unit, as many digits as say something, and what is nothing but rounding.

use std::fmt;

/// How a number is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    Millimetres,
    Metres,
    MillimetresPerSecond,
    MetresPerSecond,
    Degrees,
    Radians,
    RadiansPerSecond,
    RadiansPerSecond2,
    Times,
    Newtons,
    NewtonMetres,
    Percent,
    /// A time, infinite if it never comes.
    Seconds,
}

impl Reading {
    /// The unit, and how many of it make the unit of SI.
    fn unit(self) -> (&'static str, f64) {
        match self {
            Self::Millimetres => ("mm", 1e3),
            Self::MillimetresPerSecond => ("mm/s", 1e3),
            Self::Degrees => ("°", 1f64.to_degrees()),
            Self::Times => ("times", 1.0),
            Self::Percent => ("%", 100.0),
            _ => (self.si(), 1.0),
        }
    }

    /// The unit of SI.
    fn si(self) -> &'static str {
        match self {
            Self::Millimetres | Self::Metres => "m",
            Self::MillimetresPerSecond | Self::MetresPerSecond => "m/s",
            Self::Degrees | Self::Radians => "rad",
            Self::RadiansPerSecond => "rad/s",
            Self::RadiansPerSecond2 => "rad/s2",
            Self::Newtons => "N",
            Self::NewtonMetres => "N m",
            Self::Seconds => "s",
            Self::Times | Self::Percent => "",
        }
    }

    /// Numbers smaller than this are nothing but rounding, in SI units; 0 where nothing is lost by it.
    pub(super) fn rounding(self) -> f64 {
        match self.si() {
            "m" | "m/s" => 1e-9,
            "rad" => 1e-10,
            "N m" => 1e-8,
            _ => 0.0,
        }
    }
}

/// A measured number with the way in which it is read.
///
/// The alternate form says of what is nothing but rounding no more than that: it differs from machine to machine.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    pub(super) reading: Reading,
    /// In SI units.
    pub(super) value: f64,
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { reading, value } = *self;
        let (unit, per_si) = reading.unit();
        match reading {
            _ if value.is_nan() => write!(f, "–"),
            _ if f.alternate() && value.abs() < reading.rounding() => {
                write!(f, "< {:e} {}", reading.rounding(), reading.si())
            }
            Reading::Metres | Reading::MetresPerSecond => write!(f, "{value:.1e} {unit}"),
            Reading::Times => write!(f, "{value} {unit}"),
            Reading::Seconds if value.is_infinite() => write!(f, "never"),
            Reading::Seconds => write!(f, "{value:.1} {unit}"),
            _ => readable(f, per_si * value, unit),
        }
    }
}

/// Three digits or so, without noise: what is a thousandth of the unit or less is written with a power of ten.
fn readable(f: &mut fmt::Formatter<'_>, value: f64, unit: &str) -> fmt::Result {
    match value.abs() {
        0.0 => write!(f, "0 {unit}"),
        size if size < 1e-3 => write!(f, "{value:.0e} {unit}"),
        size if size < 1.0 => write!(f, "{value:.3} {unit}"),
        size if size < 10.0 => write!(f, "{value:.2} {unit}"),
        size if size < 1e4 => write!(f, "{value:.1} {unit}"),
        _ => write!(f, "{value:.1e} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        let shown = |reading, value| Shown { reading, value }.to_string();
        assert_eq!(shown(Reading::Millimetres, 0.112_34), "112.3 mm");
        assert_eq!(shown(Reading::Millimetres, 0.005_04), "5.04 mm");
        assert_eq!(shown(Reading::Metres, 1.23e-4), "1.2e-4 m");
        assert_eq!(shown(Reading::Seconds, f64::INFINITY), "never");
        assert_eq!(shown(Reading::Degrees, f64::NAN), "–");
        assert_eq!(shown(Reading::Degrees, 1e-9), "6e-8 °");
        assert_eq!(shown(Reading::Percent, 0.0454), "4.54 %");
    }

    #[test]
    fn rounding_is_called_so_whatever_its_sign() {
        let shown = |reading, value| format!("{:#}", Shown { reading, value });
        for sign in [1.0, -1.0] {
            assert_eq!(shown(Reading::Metres, sign * 1e-12), "< 1e-9 m");
            assert_eq!(shown(Reading::MillimetresPerSecond, sign * 1e-12), "< 1e-9 m/s");
            assert_eq!(shown(Reading::Degrees, sign * 5e-17), "< 1e-10 rad");
            assert_eq!(shown(Reading::NewtonMetres, sign * 7e-10), "< 1e-8 N m");
        }
        assert_eq!(shown(Reading::Millimetres, -0.125), "-125.0 mm");
        assert_eq!(shown(Reading::Newtons, 1e-12), "1e-12 N");
    }
}
