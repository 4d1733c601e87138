//! Means over time by the trapezoidal rule, and Euclidean norms of rows.

use crate::math::Listed;
/// The mean over time of values at times; the last value if all times are equal.
///
/// # Panics
/// If there are no values, or if the numbers of values and times differ.
pub fn mean(t: &[f64], values: &[f64]) -> f64 {
    assert_eq!(t.len(), values.len(), "a value for each time");
    let last = t.len() - 1;
    let span = t[last] - t[0];
    let area: f64 = (1..=last).map(|k| (t[k] - t[k - 1]) * (values[k] + values[k - 1]) / 2.0).sum();
    if span == 0.0 {
        values[last]
    } else {
        area / span
    }
}

/// The root of the mean square over time.
///
/// # Panics
/// The conditions of [`mean`].
pub fn root_mean_square(t: &[f64], values: &[f64]) -> f64 {
    let squares: Vec<f64> = values.iter().map(|x| x * x).list();
    mean(t, &squares).sqrt()
}

/// The Euclidean norms of rows of the given width. Zero for rows of width zero.
pub fn row_norms(rows: &[f64], width: usize, count: usize) -> Vec<f64> {
    let norm = |row: &[f64]| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    (0..count).map(|k| norm(&rows[k * width..(k + 1) * width])).list()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_middle_as_mean() {
        let t = [0.0, 0.5, 2.0];
        assert!((mean(&t, &t.map(|t| 3.0 * t + 1.0)) - 4.0).abs() < 1e-15);
        assert!((root_mean_square(&t, &[-2.0; 3]) - 2.0).abs() < 1e-15);
        assert_eq!(mean(&[1.0, 1.0], &[2.0, 3.0]), 3.0);
    }

    #[test]
    fn rows_have_lengths() {
        assert_eq!(row_norms(&[3.0, 4.0, 0.0, -1.0], 2, 2), [5.0, 1.0]);
        assert_eq!(row_norms(&[], 0, 2), [0.0, 0.0]);
    }
}
