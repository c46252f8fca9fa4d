//! Linear equations, and what they mean when they nearly depend on each other.

use thiserror::Error;

use super::{MAX_ROWS, MAX_VARIABLES, Vector, product};

/// Equations are satisfied if they are off by less than this share of what their terms could be.
pub(super) const MET: f64 = 3e-10;

/// Rows of which less than this share is left beside the others come after them: their error, squared, is nothing
/// beside that of the others.
pub(super) const WEAK: f64 = 1e-7;

/// Rows of which less than this share is left beside the others depend on them.
pub(super) const NOTHING: f64 = 1e-11;

/// The same where so little decides that steps run out.
pub(super) const LITTLE: f64 = 1e-7;

/// Weight of a level beside that before it.
const NEXT: f64 = 1e-20;

/// Rounds over all pairs of rows that make them orthogonal; two or three are enough.
const ROUNDS: usize = 6;

/// Too many equations or variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum TooMany {
    /// Of equations.
    #[error("a quadratic program has room for {MAX_ROWS} equations of a kind: this is one more")]
    Rows,
    /// Of coefficients in an equation.
    #[error("a quadratic program has room for {MAX_VARIABLES} variables: an equation has {0} coefficients")]
    Coefficients(usize),
}

/// Linear equations `coefficients` * x = `value`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rows {
    pub(super) count: usize,
    pub(super) coefficients: [Vector; MAX_ROWS],
    pub(super) values: [f64; MAX_ROWS],
}

impl Rows {
    /// These equations, coefficients and value of each. More than there is room for do not compile.
    #[must_use]
    pub fn of<const M: usize>(rows: [(Vector, f64); M]) -> Self {
        const { assert!(M <= MAX_ROWS, "more equations than there is room for") };
        let mut all = Self { count: M, ..Self::default() };
        for (i, (coefficients, value)) in rows.into_iter().enumerate() {
            (all.coefficients[i], all.values[i]) = (coefficients, value);
        }
        all
    }

    /// Adds the equation `coefficients` * x = `value`; coefficients that are not given are zero.
    ///
    /// # Errors
    /// If there is no room: nothing is added then.
    pub fn push(&mut self, coefficients: &[f64], value: f64) -> Result<(), TooMany> {
        if coefficients.len() > MAX_VARIABLES {
            return Err(TooMany::Coefficients(coefficients.len()));
        }
        let row = self.coefficients.get_mut(self.count).ok_or(TooMany::Rows)?;
        row[..coefficients.len()].copy_from_slice(coefficients);
        self.values[self.count] = value;
        self.count += 1;
        Ok(())
    }

    /// The equations one by one.
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = (&Vector, f64)> {
        self.coefficients[..self.count].iter().zip(self.values[..self.count].iter().copied())
    }

    /// Whether `x` satisfies them but for this `share` of the terms.
    pub(super) fn satisfied_by(&self, x: &Vector, share: f64) -> bool {
        self.iter().all(|(row, value)| satisfied(row, value, x, share))
    }

    /// Whether hardly something is left of a row beside the longer ones: by their Gram matrix, eliminated with pivots.
    #[inline]
    pub(super) fn nearly_depend(&self) -> bool {
        let mut gram = [[0.0; MAX_ROWS]; MAX_ROWS];
        for (i, (row, _)) in self.iter().enumerate() {
            for (j, (other, _)) in self.iter().enumerate().take(i + 1) {
                gram[i][j] = product(row, other);
                gram[j][i] = gram[i][j];
            }
        }
        let mut bar = 0.0;
        for k in 0..self.count {
            let longest = (k..self.count).fold(k, |best, j| if gram[j][j] > gram[best][best] { j } else { best });
            gram.swap(k, longest);
            gram.iter_mut().for_each(|row| row.swap(k, longest));
            let square = gram[k][k];
            if k == 0 {
                bar = WEAK * WEAK * square;
            }
            if square.is_nan() || square <= bar {
                return true;
            }
            for i in k + 1..self.count {
                let share = gram[i][k] / square;
                (k + 1..self.count).for_each(|j| gram[i][j] -= share * gram[k][j]);
            }
        }
        false
    }
}

/// In which order equations count.
#[derive(Debug, Clone, Copy)]
pub(super) struct Levels {
    /// For each row, the number of rows up to the end of its level: levels come one after the other.
    pub ends: [usize; MAX_ROWS],
    /// Weights of the rows: a level is nothing beside those before it.
    pub weights: [f64; MAX_ROWS],
    /// How much larger than each row those are that it is the rest of: its numbers are that much less certain.
    pub blur: [f64; MAX_ROWS],
}

impl Levels {
    /// All at once.
    pub const ONE: Self = Self { ends: [MAX_ROWS; MAX_ROWS], weights: [1.0; MAX_ROWS], blur: [1.0; MAX_ROWS] };

    /// The same equations, rotated among each other until their rows are orthogonal: |E x - e| stays what it is. The
    /// long rows come first, each level is scaled to length 1, and rows of which this share is left are left out. The method is
    /// that of one-sided Jacobi rotations (M. R. Hestenes, J. SIAM 6 (1958) 51-90).
    #[cold]
    pub fn orthogonal(rows: &Rows, nothing: f64) -> (Rows, Self) {
        let mut rows = *rows;
        let mut origins = rows.coefficients.map(|row| product(&row, &row));
        for _ in 0..ROUNDS {
            for a in 0..rows.count {
                for b in a + 1..rows.count {
                    rows.rotate(a, b, &mut origins);
                }
            }
        }
        let (mut rotated, mut levels) = (Rows::default(), Self::ONE);
        let (mut begin, mut unit, mut weight) = (0, 0.0, 1.0);
        for k in 0..rows.count {
            let squares = rows.coefficients.map(|row| product(&row, &row));
            let longest = (0..rows.count).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
            let length = squares[longest].sqrt();
            let row = std::mem::take(&mut rows.coefficients[longest]);
            let blur = origins[longest].sqrt() / length;
            if blur.is_nan() || blur * nothing >= 1.0 {
                continue;
            }
            if k == 0 || length <= WEAK * unit {
                (begin, unit) = (rotated.count, length);
                weight *= if k == 0 { 1.0 } else { NEXT };
            }
            let Rows { count, coefficients, values } = &mut rotated;
            coefficients[*count] = row.map(|coefficient| coefficient / unit);
            values[*count] = rows.values[longest] / unit;
            levels.blur[*count] = blur.max(nothing / NOTHING);
            levels.weights[*count] = weight;
            *count += 1;
            levels.ends[begin..*count].fill(*count);
        }
        (rotated, levels)
    }
}

impl Rows {
    /// Rotates the rows `a` and `b` until they are orthogonal.
    fn rotate(&mut self, a: usize, b: usize, origins: &mut [f64; MAX_ROWS]) {
        let (first, second) = (self.coefficients[a], self.coefficients[b]);
        let (p, q, mixed) = (product(&first, &first), product(&second, &second), product(&first, &second));
        if mixed.abs() <= f64::EPSILON * (p * q).sqrt() {
            return;
        }
        let zeta = (q - p) / (2.0 * mixed);
        let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
        let cosine = (1.0 + tangent * tangent).sqrt().recip();
        let sine = cosine * tangent;
        let rotated = |x: f64, y: f64| (cosine * x - sine * y, sine * x + cosine * y);
        for i in 0..MAX_VARIABLES {
            (self.coefficients[a][i], self.coefficients[b][i]) = rotated(first[i], second[i]);
        }
        (self.values[a], self.values[b]) = rotated(self.values[a], self.values[b]);
        let (c, s) = (cosine * cosine, sine * sine);
        (origins[a], origins[b]) = (c * origins[a] + s * origins[b], s * origins[a] + c * origins[b]);
    }
}

/// Whether `row` * x = `value` but for this `share` of the terms.
#[inline]
pub(super) fn satisfied(row: &Vector, value: f64, x: &Vector, share: f64) -> bool {
    let terms = product(&row.map(f64::abs), &x.map(f64::abs)) + value.abs();
    (product(row, x) - value).abs() <= share * terms + f64::MIN_POSITIVE
}
