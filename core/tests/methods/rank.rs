//! Rank, independent rows and left null vectors of matrices whose rank is known.

use kempe::solve::{normalize_rows, rank, RANK_TOLERANCE};

fn random(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// m × n of rank r: (m × r) (r × n).
fn of_rank(r: usize, m: usize, n: usize, seed: u64) -> Vec<f64> {
    let (a, b) = (random(seed, m * r), random(seed + 1, r * n));
    let entry = |i: usize, j: usize| (0..r).map(|k| a[i * r + k] * b[k * n + j]).sum();
    (0..m * n).map(|e| entry(e / n, e % n)).collect()
}

/// Checks what must hold of any result, and returns the largest |yᵀ A|.
fn check(matrix: &[f64], n: usize, expected: usize) -> kempe::solve::Rank {
    let m = matrix.len() / n;
    let found = rank(matrix, n, RANK_TOLERANCE);
    assert_eq!(found.rank, expected);
    assert_eq!((found.independent.len(), found.left_null.len()), (expected, m - expected));
    let mut all = [found.independent.clone(), found.dependent.clone()].concat();
    all.sort_unstable();
    assert!(all.into_iter().eq(0..m));
    for (k, y) in found.left_null.iter().enumerate() {
        for j in 0..n {
            let product: f64 = (0..m).map(|i| y[i] * matrix[i * n + j]).sum();
            assert!(product.abs() < 1e-12, "vector {k}, column {j}: {product:e}");
        }
        for (l, z) in found.left_null.iter().enumerate() {
            let product: f64 = y.iter().zip(z).map(|(y, z)| y * z).sum();
            assert!((product - f64::from(u8::from(k == l))).abs() < 1e-14);
        }
        assert!(y[found.dependent[k]].abs() > 0.0);
        assert!(found.dependent[k + 1..].iter().all(|&later| y[later] == 0.0));
    }
    found
}

#[test]
fn random_matrices_of_every_rank() {
    for (m, n) in [(1, 1), (5, 8), (8, 5), (12, 12), (30, 17)] {
        for r in 0..=m.min(n) {
            let found = check(&of_rank(r, m, n, (100 * m + 10 * n + r) as u64), n, r);
            assert!(found.gap() > 1e9, "{m} x {n} of rank {r}: gap {:e}", found.gap());
        }
    }
}

#[test]
fn of_equal_rows_the_later_is_dependent() {
    // scaled rows 0, 1 and their repetition, once with opposite sign
    let a = [3.0, 4.0, 0.0, 0.0, 0.0, 2.0, -0.3, -0.4, 0.0, 0.0, 0.0, 5.0];
    let mut a = a.to_vec();
    assert_eq!(normalize_rows(&mut a, 3), [5.0, 2.0, 0.5, 5.0]);
    let found = check(&a, 3, 2);
    assert_eq!(
        (found.independent.as_slice(), found.dependent.as_slice()),
        (&[0, 1][..], &[2, 3][..])
    );
    let half = 0.5_f64.sqrt();
    for (y, exact) in found.left_null.iter().zip([[half, 0.0, half, 0.0], [0.0, -half, 0.0, half]])
    {
        for (y, exact) in y.iter().zip(exact) {
            assert!((y - exact).abs() < 1e-15, "{y} {exact}");
        }
    }
}

#[test]
fn a_left_null_vector_names_all_rows_that_take_part() {
    // row 4 = row 0 + row 2 - row 3; row 1 is independent
    let rows =
        [[1.0, 2.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.0], [0.0, 1.0, 0.0, 3.0], [2.0, 0.0, 0.0, 1.0]];
    let mut a = rows.concat();
    a.extend((0..4).map(|j| rows[0][j] + rows[2][j] - rows[3][j]));
    let found = check(&a, 4, 4);
    let y = &found.left_null[0];
    assert!(y[1].abs() < 1e-15);
    assert!([0, 2, 3, 4].iter().all(|&i| (y[i].abs() - 0.5).abs() < 1e-15), "{y:?}");
}

#[test]
fn the_gap_tells_doubtful_from_certain() {
    let nearly = [1.0, 0.0, 1.0, 1e-8];
    let found = rank(&nearly, 2, RANK_TOLERANCE);
    assert_eq!(found.rank, 2);
    assert!((found.kept[1] - 1e-8).abs() < 1e-15 && found.dropped == 0.0);
    let found = rank(&nearly, 2, 1e-7);
    assert_eq!((found.rank, found.dependent.as_slice()), (1, &[1][..]));
    assert!((found.gap() / 1e8 - 1.0).abs() < 1e-6);
}

#[test]
fn degenerate_shapes() {
    assert_eq!(rank(&[], 3, RANK_TOLERANCE).rank, 0);
    assert_eq!(rank(&[], 0, RANK_TOLERANCE).rank, 0);
    let zero = check(&[0.0; 6], 3, 0);
    assert_eq!(zero.dependent, [0, 1]);
    let mut a = [0.0, 0.0, 1e-200, 0.0];
    assert_eq!(normalize_rows(&mut a, 2), [0.0, 1e-200]);
    assert_eq!(check(&a, 2, 1).independent, [1]);
    let tall = check(&of_rank(2, 6, 2, 1), 2, 2);
    assert_eq!(tall.dependent.len(), 4);
}
