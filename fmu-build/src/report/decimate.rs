//! Fewer points for the same picture.

/// A point of a curve: time and value.
type Point = (f64, f64);

/// At most four points for each of the `buckets` intervals of time: where a curve enters and leaves, its
/// lowest and its highest point, so that no peak is lost. What is not finite is left out.
#[must_use]
pub fn envelope(times: &[f64], values: impl Iterator<Item = f64>, buckets: usize) -> Vec<Point> {
    reduce(times, values, buckets, |bucket| {
        let extremes = [bucket.iter().min_by(by_value), bucket.iter().max_by(by_value)];
        let mut kept: Vec<Point> =
            [bucket.first(), bucket.last()].into_iter().chain(extremes).flatten().copied().collect();
        kept.sort_by(|a, b| a.0.total_cmp(&b.0));
        kept.dedup();
        kept
    })
}

/// The highest point of each of the `buckets` intervals of time. What is not finite is left out.
#[must_use]
pub fn peaks(times: &[f64], values: impl Iterator<Item = f64>, buckets: usize) -> Vec<Point> {
    reduce(times, values, buckets, |bucket| bucket.iter().max_by(by_value).copied().into_iter().collect())
}

fn by_value(a: &&Point, b: &&Point) -> std::cmp::Ordering {
    a.1.total_cmp(&b.1)
}

fn reduce(
    times: &[f64],
    values: impl Iterator<Item = f64>,
    buckets: usize,
    keep: impl Fn(&[Point]) -> Vec<Point>,
) -> Vec<Point> {
    let finite = |(time, value): &Point| time.is_finite() && value.is_finite();
    let points: Vec<Point> = times.iter().copied().zip(values).filter(finite).collect();
    let size = points.len().div_ceil(buckets.max(1));
    if size <= 4 { points } else { points.chunks(size).flat_map(keep).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_peak_is_lost() {
        let times: Vec<f64> = (0..30_001).map(|i| f64::from(i) * 1e-3).collect();
        let values = times.iter().map(|&t| if t == 12.345 { 7.0 } else { t.sin() });
        let points = envelope(&times, values, 300);
        assert!(points.len() <= 1200);
        assert!(points.contains(&(12.345, 7.0)));
        assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, 30.0));
        assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
        let points = peaks(&times, times.iter().map(|&t| t % 0.1), 300);
        assert_eq!(points.len(), 298);
        assert!(points.iter().all(|(_, value)| *value > 0.09));
    }

    #[test]
    fn few_points_stay_as_they_are() {
        assert_eq!(envelope(&[0.0, 1.0, 2.0], [1.0, f64::NAN, 3.0].into_iter(), 500), [(0.0, 1.0), (2.0, 3.0)]);
        assert!(envelope(&[], std::iter::empty(), 500).is_empty());
    }
}
