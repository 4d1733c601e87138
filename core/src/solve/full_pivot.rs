//! Systems of linear equations of any shape and rank, by elimination with full pivoting.

/// The solution of a system that may be singular.
#[derive(Clone, Debug, PartialEq)]
pub struct AnyRank {
    /// The columns that no equation determines. They are zero in each solution.
    pub free: Vec<usize>,
    /// Those of them that occur in an equation, so that other columns depend on them.
    pub coupled: Vec<usize>,
    /// For each right side: whether the equations agree.
    pub consistent: Vec<bool>,
}

/// Solves A X = B for several right sides. `a` is row-major with `columns` columns and is overwritten. Each of `right`
/// has one number for each row, and one for each column afterwards. A pivot below `tolerance` of the largest of its
/// scaled matrix is zero.
pub fn solve_any_rank(
    a: &mut [f64],
    columns: usize,
    right: &mut [Vec<f64>],
    tolerance: f64,
) -> AnyRank {
    let rows = a.len() / columns.max(1);
    let scales = scale(a, columns, right);
    let mut order: Vec<usize> = (0..columns).collect();
    let sizes: Vec<f64> = right.iter().map(|b| largest(b.iter().copied())).collect();
    let mut rank = 0;
    while rank < rows.min(columns) {
        let mut best = (rank, rank, 0.0_f64);
        for row in rank..rows {
            for (column, at) in order.iter().enumerate().skip(rank) {
                let x = a[row * columns + at].abs();
                if x > best.2 {
                    best = (row, column, x);
                }
            }
        }
        if best.2 <= tolerance {
            break;
        }
        let (row, column, _) = best;
        (0..columns).for_each(|k| a.swap(row * columns + k, rank * columns + k));
        right.iter_mut().for_each(|b| b.swap(row, rank));
        order.swap(column, rank);
        eliminate(a, columns, (rank, &order[rank..]), right);
        rank += 1;
    }
    let agree = |(b, size): (&Vec<f64>, &f64)| {
        largest(b[rank..].iter().copied()) <= tolerance.sqrt() * size
    };
    let consistent = right.iter().zip(&sizes).map(agree).collect();
    for b in right {
        let mut x = vec![0.0; columns];
        for k in (0..rank).rev() {
            let known = order[k + 1..rank].iter();
            let sum: f64 = known.map(|at| a[k * columns + at] * x[*at]).sum();
            x[order[k]] = (b[k] - sum) / a[k * columns + order[k]];
        }
        x.iter_mut().zip(&scales).for_each(|(x, scale)| *x /= scale);
        *b = x;
    }
    let free = order[rank..].to_vec();
    let occurs = |at: &&usize| (0..rank).any(|row| a[row * columns + **at].abs() > tolerance);
    AnyRank { coupled: free.iter().filter(occurs).copied().collect(), free, consistent }
}

/// Divides each row and then each column by its largest magnitude. Returns the scales of the columns.
fn scale(a: &mut [f64], columns: usize, right: &mut [Vec<f64>]) -> Vec<f64> {
    let rows = a.len() / columns.max(1);
    for row in 0..rows {
        let own = &mut a[row * columns..(row + 1) * columns];
        let scale = largest(own.iter().copied());
        if scale > 0.0 {
            own.iter_mut().for_each(|x| *x /= scale);
            right.iter_mut().for_each(|b| b[row] /= scale);
        }
    }
    let mut scales = vec![1.0; columns];
    for (column, kept) in scales.iter_mut().enumerate() {
        let scale = largest((0..rows).map(|row| a[row * columns + column]));
        if scale > 0.0 {
            (0..rows).for_each(|row| a[row * columns + column] /= scale);
            *kept = scale;
        }
    }
    scales
}

/// Eliminates the first of some columns from the rows below its pivot.
fn eliminate(
    a: &mut [f64],
    columns: usize,
    (pivot, left): (usize, &[usize]),
    right: &mut [Vec<f64>],
) {
    for below in pivot + 1..a.len() / columns {
        let factor = a[below * columns + left[0]] / a[pivot * columns + left[0]];
        if factor != 0.0 {
            for at in left {
                a[below * columns + at] -= factor * a[pivot * columns + at];
            }
            right.iter_mut().for_each(|b| b[below] -= factor * b[pivot]);
        }
    }
}

fn largest(x: impl Iterator<Item = f64>) -> f64 {
    x.fold(0.0_f64, |most, x| most.max(x.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_regular_system_has_its_solution() {
        let mut a = [0.0, 2.0e9, 3.0, 1.0];
        let mut right = vec![vec![4.0e9, 5.0], vec![0.0, 6.0]];
        let found = solve_any_rank(&mut a, 2, &mut right, 1e-12);
        assert_eq!(right, [[1.0, 2.0], [2.0, 0.0]]);
        assert_eq!(found, AnyRank { free: vec![], coupled: vec![], consistent: vec![true, true] });
    }

    #[test]
    fn dependent_rows_agree_or_not_and_columns_may_be_free() {
        let mut a = [1.0, 1.0, 0.0, 2.0, 2.0, 0.0];
        let mut right = vec![vec![1.0, 2.0], vec![1.0, 3.0]];
        let found = solve_any_rank(&mut a, 3, &mut right, 1e-12);
        assert_eq!(found.consistent, [true, false]);
        assert_eq!((found.free.len(), found.coupled.len()), (2, 1));
        assert_eq!(right[0][0] + right[0][1], 1.0);
    }
}
