//! With which power of the step an error grows.

/// Errors below this are rounding \[m\].
const FLOOR: f64 = 2e-11;
/// Errors above this have left the range in which powers mean anything \[m\].
const CEILING: f64 = 5e-3;

/// The exponent p of error = c step^p that fits best, in the sense of least squares of the logarithms, if there are
/// three points at least that are neither rounding nor out of all proportion.
#[must_use]
pub fn observed_order(points: &[(f64, f64)]) -> Option<f64> {
    let fitted: Vec<(f64, f64)> = points
        .iter()
        .filter(|(_, error)| (FLOOR..CEILING).contains(error))
        .map(|(step, error)| (step.ln(), error.ln()))
        .collect();
    if fitted.len() < 3 {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "a few points")]
    let count = fitted.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| fitted.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(&|point| point.0), mean(&|point| point.1));
    let covariance = mean(&|point| (point.0 - x) * (point.1 - y));
    Some(covariance / mean(&|point| (point.0 - x) * (point.0 - x)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_is_found_again() {
        let points: Vec<(f64, f64)> = [1e-3, 2e-3, 5e-3].map(|step: f64| (step, 3.0 * step.powi(3))).to_vec();
        assert!((observed_order(&points).unwrap() - 3.0).abs() < 1e-12);
    }

    #[test]
    fn rounding_and_nonsense_do_not_count() {
        let points = [(1e-4, 1e-15), (1e-3, 1e-9), (1e-2, 1e-5), (2e-2, 0.5), (5e-2, f64::NAN)];
        assert_eq!(observed_order(&points), None);
    }
}
