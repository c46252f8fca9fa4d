//! Numbers with a unit of measure, as people write them: `30 deg`, `5 cm`, `0.2 kN/m`, `25 g.cm2`.

use std::f64::consts::PI;

use crate::variables::unit::PhysicalUnit;

/// Exponents of kilogram, metre, second and radian.
type Dimension = [i32; 4];

/// A unit: its dimension, and how many coherent SI units it is, as a quotient, so that `5 cm` is the same number as `0.05`.
#[derive(Clone, Copy)]
struct Unit {
    dimension: Dimension,
    numerator: f64,
    denominator: f64,
}

const fn unit(dimension: Dimension, numerator: f64, denominator: f64) -> Unit {
    Unit { dimension, numerator, denominator }
}

const KNOWN: [(&str, Unit); 24] = [
    ("1", unit([0; 4], 1.0, 1.0)),
    ("%", unit([0; 4], 1.0, 100.0)),
    ("kg", unit([1, 0, 0, 0], 1.0, 1.0)),
    ("g", unit([1, 0, 0, 0], 1.0, 1e3)),
    ("m", unit([0, 1, 0, 0], 1.0, 1.0)),
    ("km", unit([0, 1, 0, 0], 1e3, 1.0)),
    ("cm", unit([0, 1, 0, 0], 1.0, 1e2)),
    ("mm", unit([0, 1, 0, 0], 1.0, 1e3)),
    ("um", unit([0, 1, 0, 0], 1.0, 1e6)),
    ("s", unit([0, 0, 1, 0], 1.0, 1.0)),
    ("ms", unit([0, 0, 1, 0], 1.0, 1e3)),
    ("us", unit([0, 0, 1, 0], 1.0, 1e6)),
    ("min", unit([0, 0, 1, 0], 60.0, 1.0)),
    ("Hz", unit([0, 0, -1, 0], 1.0, 1.0)),
    ("rad", unit([0, 0, 0, 1], 1.0, 1.0)),
    ("mrad", unit([0, 0, 0, 1], 1.0, 1e3)),
    ("deg", unit([0, 0, 0, 1], PI, 180.0)),
    ("°", unit([0, 0, 0, 1], PI, 180.0)),
    ("rev", unit([0, 0, 0, 1], 2.0 * PI, 1.0)),
    ("rpm", unit([0, 0, -1, 1], 2.0 * PI, 60.0)),
    ("N", unit([1, 1, -2, 0], 1.0, 1.0)),
    ("mN", unit([1, 1, -2, 0], 1.0, 1e3)),
    ("kN", unit([1, 1, -2, 0], 1e3, 1.0)),
    ("Nm", unit([1, 2, -2, 0], 1.0, 1.0)),
];

/// The number in SI units that a text such as `30 deg` stands for, if its unit is of the dimension of `wanted`.
pub(super) fn read(text: &str, wanted: &PhysicalUnit) -> Option<f64> {
    let text = text.trim();
    let digits = text.find(|c: char| !c.is_ascii_digit() && !"+-._".contains(c) && !is_exponent(text, c))?;
    let number: f64 = text[..digits].trim().replace('_', "").parse().ok()?;
    let unit = product(text[digits..].trim())?;
    let dimension = [wanted.kg, wanted.m, wanted.s, wanted.rad].map(i32::from);
    (unit.dimension == dimension).then_some(number * unit.numerator / unit.denominator)
}

/// Whether `c` is the letter of a power of ten, as in `1e-3 m`, and not the beginning of a unit.
fn is_exponent(text: &str, c: char) -> bool {
    let after = text.split_once(c).map_or("", |(_, after)| after);
    "eE".contains(c) && after.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c))
}

/// A product of powers, divided by another one: `N.m/(rad.s)`, `kg m^2`, `deg/s2`. What follows a stroke is divided by.
fn product(text: &str) -> Option<Unit> {
    let (above, below) = match text.split_once('/') {
        None => (text, None),
        Some((above, below)) => {
            let inner = below.strip_prefix('(').and_then(|below| below.strip_suffix(')'));
            // `a/b.c` may be meant either way.
            let below = inner.or((!below.contains(['.', ' ', '*', '/'])).then_some(below))?;
            (above, Some(below))
        }
    };
    let mut found = unit([0; 4], 1.0, 1.0);
    for (factors, sign) in [(Some(above), 1), (below, -1)] {
        for factor in factors.into_iter().flat_map(|factors| factors.split(['.', ' ', '*', '·'])) {
            found = times(found, power(factor)?, sign);
        }
    }
    Some(found)
}

/// A known unit with its exponent, which stands behind it: `m2`, `m^2`.
fn power(text: &str) -> Option<(Unit, i32)> {
    let known = |name: &str| KNOWN.iter().find(|(known, _)| *known == name).map(|(_, unit)| *unit);
    if let Some(unit) = known(text) {
        return Some((unit, 1));
    }
    let name = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let exponent = text[name.len()..].parse().ok().filter(|exponent| *exponent <= MOST)?;
    Some((known(name.strip_suffix('^').unwrap_or(name))?, exponent))
}

/// The highest power of a unit that means anything here.
const MOST: i32 = 9;

fn times(mut product: Unit, (factor, exponent): (Unit, i32), sign: i32) -> Unit {
    for (sum, dimension) in product.dimension.iter_mut().zip(factor.dimension) {
        *sum += sign * exponent * dimension;
    }
    for _ in 0..exponent {
        let [above, below] =
            if sign > 0 { [factor.numerator, factor.denominator] } else { [factor.denominator, factor.numerator] };
        product.numerator *= above;
        product.denominator *= below;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variables::unit::*;

    /// The same numbers as written without a unit.
    #[test]
    fn units_of_people_are_those_of_si() {
        let cases: [(&str, &PhysicalUnit, f64); 14] = [
            ("5 cm", &METRE, 0.05),
            ("-12cm", &METRE, -0.12),
            ("1e-3 m", &METRE, 1e-3),
            ("180 deg", &RADIAN, PI),
            ("-45°", &RADIAN, -PI / 4.0),
            ("10 ms", &SECOND, 0.01),
            ("90 deg/s", &RADIAN_PER_SECOND, PI / 2.0),
            ("60 rpm", &RADIAN_PER_SECOND, 2.0 * PI),
            ("0.2 kN/m", &NEWTON_PER_METRE, 200.0),
            ("3 N m s/rad", &NEWTON_METRE_SECOND_PER_RADIAN, 3.0),
            ("2 N.m/(rad.s)", &NEWTON_METRE_PER_RADIAN_SECOND, 2.0),
            ("50 kg cm^2", &KILOGRAM_METRE2, 50.0 / 1e4),
            ("250 g", &KILOGRAM, 0.25),
            ("2 1", &ONE, 2.0),
        ];
        for (text, unit, expected) in cases {
            let found = read(text, unit).unwrap();
            // What is a multiple of pi is rounded twice.
            let rounding = if unit.rad == 0 { 0.0 } else { f64::EPSILON * expected.abs() };
            assert!((found - expected).abs() <= rounding, "{text}: {found}");
        }
    }

    /// Every unit of a variable can be written as it stands in the model descriptions, and is refused for all of another dimension.
    #[test]
    fn every_unit_of_the_interface_is_read() {
        let all = [
            &ONE,
            &KILOGRAM,
            &PER_SECOND,
            &METRE,
            &SECOND,
            &RADIAN,
            &METRE_PER_SECOND,
            &METRE_PER_SECOND2,
            &RADIAN_PER_SECOND,
            &RADIAN_PER_SECOND2,
            &NEWTON,
            &NEWTON_METRE,
            &KILOGRAM_METRE2,
            &NEWTON_SECOND,
            &NEWTON_METRE_SECOND,
            &NEWTON_PER_METRE,
            &NEWTON_PER_METRE_SECOND,
            &NEWTON_SECOND_PER_METRE,
            &NEWTON_METRE_PER_RADIAN,
            &NEWTON_METRE_PER_RADIAN_SECOND,
            &NEWTON_METRE_SECOND_PER_RADIAN,
            &RADIAN_PER_METRE2_SECOND,
            &NEWTON2_METRE2_SECOND_PER_RADIAN,
        ];
        for unit in all {
            for other in all {
                let same = [unit.kg, unit.m, unit.s, unit.rad] == [other.kg, other.m, other.s, other.rad];
                assert_eq!(
                    read(&format!("2.5 {}", unit.name), other),
                    same.then_some(2.5),
                    "{} {}",
                    unit.name,
                    other.name
                );
            }
            if let Some(display) = &unit.display {
                let shown = read(&format!("{} {}", display.factor, display.name), unit);
                assert!(shown.is_some_and(|one| (one - 1.0).abs() < 1e-15), "{}", display.name);
            }
        }
    }

    #[test]
    fn what_is_no_quantity_is_none() {
        for text in
            ["", "5", "deg", "5 furlong", "5 deg deg", "1 m/s/s", "1 N.m/rad.s", "nan m", "inf m", "5 m99", "1e m"]
        {
            assert_eq!(read(text, &RADIAN).or(read(text, &METRE)), None, "{text}");
        }
    }
}
