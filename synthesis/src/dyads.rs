//! Dyads: a ground pivot g and a point w of the moving plane whose distance is constant.
//!
//! With the pose z ↦ p + z e^{iθ} of the moving plane, |p + w e^{iθ} - g|² is the same at all poses. With the first pose
//! p = 0, θ = 0, each other pose gives
//!
//! |p|²/2 + Re(p̄ e^{iθ} w) - Re(p̄ g) - (cos θ - 1) u + sin θ v = 0,   u + i v = ḡ w.
//!
//! This is linear in X = (1, w, g, u, v), seven numbers. Four conditions leave a plane of homogeneous X; its two conics
//! u + i v = ḡ w meet in four points. So five poses have at most four dyads (Burmester 1888), and a fixed coordinate of a
//! pivot is one more linear condition. X₀ = 0 with w = 0 is a ground pivot at infinity: w moves along a line. X₀ = 0 with
//! g = 0 is a line of the moving plane that passes through g.

use kempe::math::{Complex, Field};
use kempe::solve::{eigenvalues, null_space, solve_dense};

/// The numbers (1, w, g, u, v) of a dyad up to a factor. The first one is zero for a slide.
pub type Dyad = [f64; 7];

/// Four conditions whose pivots fall below this share of the largest entry do not determine the dyads.
const DEPENDENT: f64 = 1e-10;
/// Roots whose imaginary part exceeds this share of their size are not real; Newton's method decides about the others.
const IMAGINARY: f64 = 1e-4;
/// A finite dyad has a first number above this share of the largest.
const FINITE: f64 = 1e-11;
/// Sines of three angles that turn the plane of solutions, so that no solution is at a special place.
const TURNS: [f64; 3] = [0.36, 0.73, -0.58];

/// A quadratic form of (x, y, 1).
type Conic = [[f64; 3]; 3];

/// All real dyads with four linear conditions; None if the conditions are dependent.
pub fn dyads(conditions: &[[f64; 7]; 4]) -> Option<Vec<Dyad>> {
    let mut rows = *conditions;
    for row in &mut rows {
        let size = row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        row.iter_mut().for_each(|x| *x /= size.max(f64::MIN_POSITIVE));
    }
    let flat: Vec<Complex> = rows.iter().flatten().map(|x| Complex::new(*x, 0.0)).collect();
    let space = null_space(&flat, 7, 3);
    if space.pivots[0] < DEPENDENT {
        return None;
    }
    let plane = turned(&space.vectors);
    let conics = [
        conic(&plane, [(0, 5, 1.0), (1, 3, -1.0), (2, 4, -1.0)]),
        conic(&plane, [(0, 6, 1.0), (2, 3, -1.0), (1, 4, 1.0)]),
    ];
    let mut found: Vec<Dyad> = Vec::new();
    for at in meets(&conics) {
        let dyad = refined(&rows, combined(&plane, &at));
        if found.iter().all(|other| apart(other, &dyad) > 1e-9) {
            found.push(dyad);
        }
    }
    Some(found)
}

/// An orthonormal basis of the space, turned by fixed angles.
fn turned(vectors: &[Vec<Complex>]) -> [Dyad; 3] {
    let mut plane = [[0.0; 7]; 3];
    for k in 0..3 {
        plane[k] = std::array::from_fn(|j| vectors[k][j].re);
        for before in 0..k {
            let along: f64 = (0..7).map(|j| plane[k][j] * plane[before][j]).sum();
            (0..7).for_each(|j| plane[k][j] -= along * plane[before][j]);
        }
        let size = plane[k].iter().map(|x| x * x).sum::<f64>().sqrt();
        plane[k].iter_mut().for_each(|x| *x /= size);
    }
    for (sine, (i, j)) in TURNS.iter().zip([(0, 1), (1, 2), (2, 0)]) {
        let cosine = (1.0 - sine * sine).sqrt();
        let (a, b) = (plane[i], plane[j]);
        plane[i] = std::array::from_fn(|k| cosine * a[k] - sine * b[k]);
        plane[j] = std::array::from_fn(|k| sine * a[k] + cosine * b[k]);
    }
    plane
}

/// The sum of products of two numbers of X as a quadratic form on the plane.
fn conic(plane: &[Dyad; 3], terms: [(usize, usize, f64); 3]) -> Conic {
    let mut form = [[0.0; 3]; 3];
    for (i, j, factor) in terms {
        for a in 0..3 {
            for b in 0..3 {
                let product = plane[a][i] * plane[b][j] + plane[b][i] * plane[a][j];
                form[a][b] += 0.5 * factor * product;
            }
        }
    }
    form
}

fn combined(plane: &[Dyad; 3], at: &[f64; 2]) -> Dyad {
    std::array::from_fn(|k| at[0] * plane[0][k] + at[1] * plane[1][k] + plane[2][k])
}

/// The real points (x, y) that two conics share: the resultant in y has degree four.
fn meets(conics: &[Conic; 2]) -> Vec<[f64; 2]> {
    // a x² + b(y) x + c(y)
    let a = |k: usize| conics[k][0][0];
    let b = |k: usize| [2.0 * conics[k][0][2], 2.0 * conics[k][0][1]];
    let c = |k: usize| [conics[k][2][2], 2.0 * conics[k][1][2], conics[k][1][1]];
    let less = |x: Vec<f64>, y: Vec<f64>| -> Vec<f64> {
        let at = |of: &[f64], k: usize| of.get(k).copied().unwrap_or(0.0);
        (0..x.len().max(y.len())).map(|k| at(&x, k) - at(&y, k)).collect()
    };
    let p = less(product(&[a(0)], &c(1)), product(&[a(1)], &c(0)));
    let q = less(product(&[a(0)], &b(1)), product(&[a(1)], &b(0)));
    let r = less(product(&b(0), &c(1)), product(&b(1), &c(0)));
    let mut found: Vec<[f64; 2]> = Vec::new();
    for y in roots(&less(product(&p, &p), product(&q, &r))) {
        if y.im.abs() > IMAGINARY * (1.0 + y.magnitude()) {
            continue;
        }
        let at = polished(conics, [-value(&p, y.re) / value(&q, y.re), y.re]);
        found.extend(at);
    }
    found
}

fn product(x: &[f64], y: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; x.len() + y.len() - 1];
    for (i, a) in x.iter().enumerate() {
        y.iter().enumerate().for_each(|(j, b)| all[i + j] += a * b);
    }
    all
}

fn value(polynomial: &[f64], x: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// The roots of a polynomial, ascending coefficients: eigenvalues of its companion matrix.
fn roots(polynomial: &[f64]) -> Vec<Complex> {
    let n = polynomial.len() - 1;
    let mut companion = vec![0.0; n * n];
    for k in 0..n {
        companion[k * n + n - 1] = -polynomial[k] / polynomial[n];
        if k > 0 {
            companion[k * n + k - 1] = 1.0;
        }
    }
    eigenvalues(&companion, n)
}

/// Newton's method on both conics; None if it does not converge to a common point.
fn polished(conics: &[Conic; 2], mut at: [f64; 2]) -> Option<[f64; 2]> {
    for _ in 0..60 {
        let x = [at[0], at[1], 1.0];
        let line = |k: usize| -> [f64; 3] {
            std::array::from_fn(|i| (0..3).map(|j| conics[k][i][j] * x[j]).sum())
        };
        let (l, m) = (line(0), line(1));
        let mut step = [l, m].map(|l| -(0..3).map(|k| l[k] * x[k]).sum::<f64>() * 0.5);
        if !solve_dense(&mut [l[0], l[1], m[0], m[1]], &mut step) {
            break;
        }
        (at[0], at[1]) = (at[0] + step[0], at[1] + step[1]);
        if step[0].abs() + step[1].abs() < 1e-15 * (1.0 + at[0].abs() + at[1].abs()) {
            break;
        }
    }
    let x = [at[0], at[1], 1.0];
    let size = x.iter().map(|x| x * x).sum::<f64>();
    let left = conics.iter().map(|form| {
        (0..3).map(|i| (0..3).map(|j| form[i][j] * x[i] * x[j]).sum::<f64>()).sum::<f64>().abs()
    });
    (left.fold(0.0, f64::max) < 1e-12 * size).then_some(at)
}

/// A finite dyad after Newton's method on the conditions in w and g; the others as they are.
fn refined(rows: &[[f64; 7]; 4], dyad: Dyad) -> Dyad {
    let most = dyad.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if dyad[0].abs() < FINITE * most {
        return dyad.map(|x| x / most);
    }
    let mut x: [f64; 4] = std::array::from_fn(|k| dyad[k + 1] / dyad[0]);
    let numbers = |x: &[f64; 4]| {
        let [a, b, c, d] = *x;
        [1.0, a, b, c, d, a * c + b * d, c * b - d * a]
    };
    for _ in 0..4 {
        let [a, b, c, d] = x;
        let full = numbers(&x);
        let (mut slopes, mut step) = ([0.0; 16], [0.0; 4]);
        for (k, row) in rows.iter().enumerate() {
            step[k] = -(0..7).map(|j| row[j] * full[j]).sum::<f64>();
            slopes[4 * k..4 * k + 4].copy_from_slice(&[
                row[1] + c * row[5] - d * row[6],
                row[2] + d * row[5] + c * row[6],
                row[3] + a * row[5] + b * row[6],
                row[4] + b * row[5] - a * row[6],
            ]);
        }
        let size = x.iter().fold(1e-3, |most: f64, x| most.max(x.abs()));
        if !solve_dense(&mut slopes, &mut step) || step.iter().any(|s| s.abs() > 1e-4 * size) {
            break; // a double solution is as accurate as it can be
        }
        (0..4).for_each(|k| x[k] += step[k]);
    }
    numbers(&x)
}

/// Distance of two dyads relative to their sizes.
fn apart(one: &Dyad, other: &Dyad) -> f64 {
    let unit = |of: &Dyad| {
        let size = of.iter().map(|x| x * x).sum::<f64>().sqrt();
        of.map(|x| x / size)
    };
    let (one, other) = (unit(one), unit(other));
    let sum = |sign: f64| (0..7).map(|k| (one[k] - sign * other[k]).abs()).sum::<f64>();
    sum(1.0).min(sum(-1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_poses_of_a_circle_and_a_fixed_pivot_give_its_dyad() {
        // poses of a bar that turns about (1, 0) by 0.3, 0.8, 1.1 rad, and again as a fourth condition g₁ = 1
        let pose = |turn: f64, at: [f64; 2]| {
            let (sine, cosine) = turn.sin_cos();
            let p = [1.0 - cosine + at[0], -sine + at[1]];
            let half = 0.5 * (p[0] * p[0] + p[1] * p[1]);
            let along = [p[0] * cosine + p[1] * sine, p[1] * cosine - p[0] * sine];
            [half, along[0], along[1], -p[0], -p[1], 1.0 - cosine, sine]
        };
        let fixed = [-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let rows = [pose(0.3, [0.1, 0.0]), pose(0.8, [0.2, 0.1]), pose(1.1, [0.0, 0.3]), fixed];
        for [one, a, b, c, d, u, v] in dyads(&rows).expect("independent") {
            assert!((c - one).abs() < 1e-12 && (u * one - a * c - b * d).abs() < 1e-12);
            assert!((v * one - c * b + d * a).abs() < 1e-12);
        }
        let same = [rows[0], rows[1], rows[1], fixed];
        assert!(dyads(&same).is_none());
    }
}
