//! Euclidean norms of rows.

use crate::math::Listed;

/// The Euclidean norms of rows of the given width. Zero for rows of width zero.
pub fn row_norms(rows: &[f64], width: usize, count: usize) -> Vec<f64> {
    let norm = |row: &[f64]| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    (0..count).map(|k| norm(&rows[k * width..(k + 1) * width])).list()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_lengths() {
        assert_eq!(row_norms(&[3.0, 4.0, 0.0, -1.0], 2, 2), [5.0, 1.0]);
        assert_eq!(row_norms(&[], 0, 2), [0.0, 0.0]);
    }
}
