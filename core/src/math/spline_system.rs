//! The condition of minimum bending for the derivatives of a spline at its knots. The system is symmetric positive
//! definite and block tridiagonal, and cyclic for a periodic spline. The unknowns of a knot are y′ and y″. A cubic spline
//! needs y′ only; its y″ here is zero and independent of all others, so that one system serves both.

use super::array::{each, indexed};
use super::real::Real;

/// The interval between two knots.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<S> {
    /// Difference of x.
    pub width: S,
    /// Difference of y.
    pub rise: S,
}

type Block<S> = [[S; M]; M];

/// The unknowns of a knot.
const M: usize = 2;

/// The contribution of one interval to the conditions at its two ends.
pub(super) struct Share<S> {
    first: Block<S>,
    /// Rows of the first end, columns of the last.
    across: Block<S>,
    last: Block<S>,
    right: [[S; M]; 2],
}

impl<S: Real> Stretch<S> {
    /// The contribution for y′, from the minimum of ∫ y″² dx.
    pub fn cubic(&self) -> Share<S> {
        let c = |x: f64| S::constant(x) / self.width;
        let right = c(6.0) * self.rise / self.width;
        let with = |slope: S, bend: f64| [[slope, S::zero()], [S::zero(), S::constant(bend)]];
        let right = [[right, S::zero()]; 2];
        Share {
            first: with(c(4.0), 1.0),
            across: with(c(2.0), 0.0),
            last: with(c(4.0), 1.0),
            right,
        }
    }

    /// The contribution for (y′, y″), from the minimum of ∫ y‴² dx.
    pub fn quintic(&self) -> Share<S> {
        let (h, c) = (self.width, S::constant);
        let (h1, h2, h3) = (c(1.0) / h, c(1.0) / (h * h), c(1.0) / (h * h * h));
        let [slope, bend] = [c(360.0) * self.rise * h2 * h2, c(60.0) * self.rise * h3];
        Share {
            first: [[c(192.0) * h3, c(36.0) * h2], [c(36.0) * h2, c(9.0) * h1]],
            across: [[c(168.0) * h3, c(-24.0) * h2], [c(24.0) * h2, c(-3.0) * h1]],
            last: [[c(192.0) * h3, c(-36.0) * h2], [c(-36.0) * h2, c(9.0) * h1]],
            right: [[slope, bend], [slope, -bend]],
        }
    }
}

/// The derivatives at all knots. The last knot of a periodic spline repeats the first.
pub(super) fn solve<S: Real>(
    stretches: &[Stretch<S>],
    periodic: bool,
    share: fn(&Stretch<S>) -> Share<S>,
) -> Vec<[S; M]> {
    let mut solution = conditions(stretches, periodic, share).solve();
    if periodic {
        solution.push(solution[0]);
    }
    solution
}

/// The derivatives at all knots of a quintic spline; those at its ends are given.
pub(super) fn clamped(stretches: &[Stretch<f64>], ends: [[f64; M]; 2]) -> Vec<[f64; M]> {
    let mut found = conditions(stretches, false, Stretch::quintic);
    found.clamp(ends);
    found.solve()
}

/// The conditions at all knots.
fn conditions<S: Real>(
    stretches: &[Stretch<S>],
    periodic: bool,
    share: fn(&Stretch<S>) -> Share<S>,
) -> Conditions<S> {
    let n = stretches.len() + usize::from(!periodic);
    let none = [[S::zero(); M]; M];
    let mut conditions = Conditions {
        diagonal: vec![none; n],
        next: vec![none; n],
        corner: vec![none; n],
        right: vec![[S::zero(); M]; n],
    };
    for (k, stretch) in stretches.iter().enumerate() {
        let share = share(stretch);
        let last = (k + 1) % n;
        add(&mut conditions.diagonal[k], &share.first);
        add(&mut conditions.diagonal[last], &share.last);
        match last {
            0 => conditions.corner[0] = transposed(&share.across),
            _ => conditions.next[k] = share.across,
        }
        for m in 0..M {
            conditions.right[k][m] += share.right[0][m];
            conditions.right[last][m] += share.right[1][m];
        }
    }
    conditions
}

/// Blocks of a symmetric matrix by rows: the diagonal, the next block to the right, and the last column.
struct Conditions<S> {
    diagonal: Vec<Block<S>>,
    next: Vec<Block<S>>,
    corner: Vec<Block<S>>,
    right: Vec<[S; M]>,
}

impl<S: Real> Conditions<S> {
    fn solve(mut self) -> Vec<[S; M]> {
        let last = self.diagonal.len() - 1;
        for k in 0..last {
            let inverse = inverse(&self.diagonal[k]);
            if k + 1 == last {
                add(&mut self.corner[k], &self.next[k]);
            } else {
                // eliminate row k from row k + 1 and from the last column
                let factor = times(&transposed(&self.next[k]), &inverse);
                subtract(&mut self.diagonal[k + 1], &times(&factor, &self.next[k]));
                let fill = times(&factor, &self.corner[k]);
                subtract(&mut self.corner[k + 1], &fill);
                let right = apply(&factor, &self.right[k]);
                (0..M).for_each(|m| self.right[k + 1][m] -= right[m]);
            }
            let factor = times(&transposed(&self.corner[k]), &inverse);
            subtract(&mut self.diagonal[last], &times(&factor, &self.corner[k]));
            let right = apply(&factor, &self.right[k]);
            (0..M).for_each(|m| self.right[last][m] -= right[m]);
        }
        let mut x = vec![[S::zero(); M]; last + 1];
        x[last] = apply(&inverse(&self.diagonal[last]), &self.right[last]);
        for k in (0..last).rev() {
            let mut right = self.right[k];
            let mut less = |block: &Block<S>, y: [S; M]| {
                let share = apply(block, &y);
                (0..M).for_each(|m| right[m] -= share[m]);
            };
            less(&self.corner[k], x[last]);
            if k + 1 < last {
                less(&self.next[k], x[k + 1]);
            }
            x[k] = apply(&inverse(&self.diagonal[k]), &right);
        }
        x
    }
}

impl Conditions<f64> {
    /// Gives the unknowns of the first and the last knot.
    fn clamp(&mut self, [first, end]: [[f64; M]; 2]) {
        let last = self.diagonal.len() - 1;
        let [above, below] =
            [0, last - 1].map(|k| std::mem::replace(&mut self.next[k], [[0.0; M]; M]));
        for (row, share) in
            [(1, apply(&transposed(&above), &first)), (last - 1, apply(&below, &end))]
        {
            (0..M).for_each(|m| self.right[row][m] -= share[m]);
        }
        for (k, given) in [(0, first), (last, end)] {
            self.diagonal[k] = [[1.0, 0.0], [0.0, 1.0]];
            self.right[k] = given;
        }
    }
}

fn add<S: Real>(a: &mut Block<S>, b: &Block<S>) {
    for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *a += *b;
    }
}

fn subtract<S: Real>(a: &mut Block<S>, b: &Block<S>) {
    for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *a -= *b;
    }
}

fn transposed<S: Real>(a: &Block<S>) -> Block<S> {
    indexed(|row| indexed(|column| a[column][row]))
}

fn apply<S: Real>(a: &Block<S>, x: &[S; M]) -> [S; M] {
    each(*a, |row| dot(row, x))
}

fn times<S: Real>(a: &Block<S>, b: &Block<S>) -> Block<S> {
    let b = transposed(b);
    indexed(|row| indexed(|column| dot(a[row], &b[column])))
}

fn dot<S: Real>(a: [S; M], b: &[S; M]) -> S {
    let mut sum = S::zero();
    for k in 0..M {
        sum += a[k] * b[k];
    }
    sum
}

/// The inverse of a symmetric positive definite block, by elimination without pivoting.
fn inverse<S: Real>(a: &Block<S>) -> Block<S> {
    let mut a = *a;
    let mut b: Block<S> = [[S::zero(); M]; M];
    (0..M).for_each(|k| b[k][k] = S::one());
    for pivot in 0..M {
        let scale = S::one() / a[pivot][pivot];
        for row in 0..M {
            if row == pivot {
                continue;
            }
            let factor = a[row][pivot] * scale;
            for column in 0..M {
                let (from_a, from_b) = (a[pivot][column], b[pivot][column]);
                a[row][column] -= factor * from_a;
                b[row][column] -= factor * from_b;
            }
        }
    }
    indexed(|row| each(b[row], |x| x / a[row][row]))
}
