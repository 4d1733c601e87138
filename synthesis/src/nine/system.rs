//! The equations of a four-bar whose coupler point passes nine points.
//!
//! The first point is the origin, and the others are at δ. At the first point, the pins are at x and y, and the vectors
//! from their ground pivots to them are u and v. The coupler turns by 1 + g, so that the pin x moves by w = x g + δ, and
//! its distance from the pivot stays the same: (u + w)(û + ŵ) = u û, or u ŵ + û w + w ŵ = 0. The other side is the same
//! with y and v.
//!
//! A number and its mirror image, such as x and x̂, are unknowns of their own: they are conjugate only for real four-bars.
//! The turn and its mirror image have the product 1. Two equations for each of eight points determine eight unknowns of
//! the four-bar and eight turns (Wampler, Morgan & Sommese 1992). A turn occurs in the equations of its own point only, so
//! that it is eliminated first. With g in place of the turn, large four-bars with small turns lose no digits.

use super::exact::Exact;
use kempe::math::{Complex, Field};

/// Points after the first one, and unknowns of a four-bar.
pub(super) const N: usize = 8;

/// The points after the first one, which is the origin, with their mirror images.
#[derive(Clone, Copy, Debug)]
pub struct Shifts {
    /// δ.
    pub at: [Complex; N],
    /// δ̂.
    pub mirrored: [Complex; N],
}

/// A four-bar with the turns of its coupler.
#[derive(Clone, Copy, Debug)]
pub struct Posture {
    /// x, x̂, u, û, y, ŷ, v and v̂.
    pub bars: [Complex; N],
    /// g of each point.
    pub turns: [Complex; N],
}

/// What a step is for.
#[derive(Clone, Copy)]
pub(super) enum Want<'a> {
    /// To solve the equations by Newton's method.
    Value,
    /// The same from values with twice as many digits.
    Exact,
    /// To follow the points, which move at a rate.
    Rate(&'a Shifts),
}

/// One side of a four-bar: x, x̂, u and û.
type Side = [Complex; 4];

/// An equation: its value, and its slopes by the unknowns of its side, by δ and δ̂, and by g.
struct Closure {
    value: Complex,
    by_side: Side,
    by_point: [Complex; 2],
    by_turn: Complex,
}

impl Closure {
    fn new([x, m, u, n]: Side, [at, mirrored]: [Complex; 2], [g, h, slope]: [Complex; 3]) -> Self {
        let (w, v) = (x * g + at, m * h + mirrored);
        let (p, q) = (n + v, u + w);
        Self {
            value: u * v + p * w,
            by_side: [p * g, q * h, v, w],
            by_point: [p, q],
            by_turn: p * x + q * m * slope,
        }
    }
}

/// The value of an equation with twice as many digits.
fn exactly([x, m, u, n]: Side, [at, mirrored]: [Complex; 2], [g, h, _]: [Complex; 3]) -> Complex {
    let of = Exact::from;
    let open = of(g) + of(h) + of(g) * of(h);
    let h = of(h) + of(-(open.rounded() * (Complex::one() + g).reciprocal()));
    let (w, v) = (of(x) * of(g) + of(at), of(m) * h + of(mirrored));
    (of(u) * v + (of(n) + v) * w).rounded()
}

/// g, ĝ and the slope of ĝ.
fn both(g: Complex) -> [Complex; 3] {
    let back = (Complex::one() + g).reciprocal();
    [g, -(g * back), -(back * back)]
}

impl Shifts {
    fn each(&self, of: impl Fn(Complex, Complex) -> Complex, to: &Self) -> Self {
        Self {
            at: std::array::from_fn(|k| of(self.at[k], to.at[k])),
            mirrored: std::array::from_fn(|k| of(self.mirrored[k], to.mirrored[k])),
        }
    }

    /// The points after a share of the way to others.
    pub(super) fn towards(&self, to: &Self, share: f64) -> Self {
        self.each(|from, to| from + (to - from) * Complex::from_real(share), to)
    }

    /// The way to other points.
    pub(super) fn to(&self, to: &Self) -> Self {
        self.each(|from, to| to - from, to)
    }
}

impl Posture {
    /// A four-bar with the turns that both of its sides need.
    pub fn new(bars: [Complex; N], points: &Shifts) -> Self {
        let turn = |k: usize| {
            // A g + B ĝ + C = 0 for both sides, as g ĝ = -g - ĝ
            let [one, two] = [0, 4].map(|side| {
                let [x, m, u, n] = std::array::from_fn(|j| bars[side + j]);
                let (at, mirrored) = (points.at[k], points.mirrored[k]);
                let rest = u * mirrored + n * at + at * mirrored;
                [x * (n + mirrored - m), m * (u + at - x), rest]
            });
            let minor = |i: usize, j: usize| one[i] * two[j] - one[j] * two[i];
            minor(1, 2) * minor(0, 1).reciprocal()
        };
        Self { bars, turns: std::array::from_fn(turn) }
    }

    /// A step of the unknowns; None if it is not unique.
    pub(super) fn step(&self, points: &Shifts, want: Want<'_>) -> Option<Self> {
        let mut rows = [[Complex::zero(); N + 1]; N];
        // of the equation that determines the turn
        let mut own = [([Complex::zero(); N + 1], Complex::zero()); N];
        let sides: [Side; 2] = [0, 4].map(|side| std::array::from_fn(|j| self.bars[side + j]));
        for k in 0..N {
            let at = [points.at[k], points.mirrored[k]];
            let turn = both(self.turns[k]);
            let two = sides.map(|side| Closure::new(side, at, turn));
            let right = |j: usize| match want {
                Want::Value => -two[j].value,
                Want::Exact => -exactly(sides[j], at, turn),
                Want::Rate(rate) => {
                    let [by, other] = two[j].by_point;
                    -(by * rate.at[k] + other * rate.mirrored[k])
                }
            };
            let (right, by) = ([right(0), right(1)], [two[0].by_turn, two[1].by_turn]);
            for j in 0..4 {
                rows[k][j] = by[1] * two[0].by_side[j];
                rows[k][4 + j] = -(by[0] * two[1].by_side[j]);
            }
            rows[k][N] = by[1] * right[0] - by[0] * right[1];
            let steeper = usize::from(by[1].magnitude() > by[0].magnitude());
            own[k].0[4 * steeper..4 * steeper + 4].copy_from_slice(&two[steeper].by_side);
            (own[k].0[N], own[k].1) = (right[steeper], by[steeper]);
        }
        let bars = solved(&mut rows)?;
        let turns = own.map(|(row, by)| {
            let right = (0..N).fold(row[N], |sum, j| sum - row[j] * bars[j]);
            right * by.reciprocal()
        });
        turns.iter().all(|z| z.magnitude().is_finite()).then_some(Self { bars, turns })
    }

    /// The unknowns after a multiple of a step.
    pub(super) fn moved(&self, step: &Self, share: f64) -> Self {
        let share = Complex::from_real(share);
        let moved =
            |of: &[Complex; N], by: &[Complex; N]| std::array::from_fn(|k| of[k] + by[k] * share);
        Self { bars: moved(&self.bars, &step.bars), turns: moved(&self.turns, &step.turns) }
    }

    /// The largest part of a step, relative to the unknowns. The size of the task is 1, and a turn of a large four-bar
    /// counts by what it moves.
    pub(super) fn part(&self, step: &Self) -> f64 {
        let long = self.bars.iter().map(|z| z.magnitude()).fold(1.0, f64::max);
        let most = |of: &[Complex; N], by: &[Complex; N], least: f64| {
            let part = |k: usize| by[k].magnitude() / (least + of[k].magnitude());
            (0..N).map(part).fold(0.0, f64::max)
        };
        most(&self.bars, &step.bars, 1.0).max(most(&self.turns, &step.turns, 1.0 / long))
    }

    /// The four-bars with the same coupler curve (Roberts 1875), this one first.
    pub(super) fn cognates(&self, points: &Shifts) -> [Self; 3] {
        let [x, m, u, n, y, p, v, q] = self.bars;
        // of the numbers, then of their mirror images: both other four-bars as x, u, y and v
        let others = [[x, u, y, v], [m, n, p, q]].map(|[x, u, y, v]| {
            let by = (y - x).reciprocal();
            let (share, rest) = (-(x * by), y * by);
            [[-u, -x, -(u * rest), share * v], [-v, -y, -(v * share), rest * u]]
        });
        let of = |which: usize| {
            let [one, mirrored] = others.map(|both| both[which]);
            Self::new(std::array::from_fn(|k| [one, mirrored][k % 2][k / 2]), points)
        };
        [*self, of(0), of(1)]
    }

    /// Whether its sides differ. The same side twice solves the equations with any turns, and is not a four-bar.
    pub(super) fn has_two_sides(&self) -> bool {
        let off = |k: usize| (self.bars[k] - self.bars[4 + k]).magnitude();
        let differ = (0..4).any(|k| off(k) > 1e-8 * (1.0 + self.bars[k].magnitude()));
        differ && self.pivots().iter().all(|z| z.magnitude().is_finite())
    }

    /// The sums of the three ground pivots of a four-bar and its cognates, and of their mirror images. They are the same
    /// for cognates, and if the sides change places.
    pub fn pivots(&self) -> [Complex; 2] {
        let [x, m, u, n, y, p, v, q] = self.bars;
        [[x, u, y, v], [m, n, p, q]]
            .map(|[x, u, y, v]| x - u + y - v + (v * x - u * y) * (y - x).reciprocal())
    }
}

/// Solves equations with their right sides as the last column; None if a pivot is zero or not finite.
fn solved(rows: &mut [[Complex; N + 1]; N]) -> Option<[Complex; N]> {
    for row in rows.iter_mut() {
        let most = row[..N].iter().map(|z| z.magnitude()).fold(0.0, f64::max);
        row.iter_mut().for_each(|z| *z = *z * Complex::from_real(1.0 / most));
    }
    for k in 0..N {
        let size = |i: &usize| rows[*i][k].magnitude();
        let best = (k..N).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        rows.swap(k, best);
        let pivot = rows[k][k];
        if pivot.magnitude() == 0.0 || !pivot.magnitude().is_finite() {
            return None;
        }
        let (own, inverse) = (rows[k], pivot.reciprocal());
        for row in &mut rows[k + 1..] {
            let factor = row[k] * inverse;
            (k + 1..=N).for_each(|j| row[j] -= factor * own[j]);
        }
    }
    let mut x = [Complex::zero(); N];
    for k in (0..N).rev() {
        let sum = (k + 1..N).fold(rows[k][N], |sum, j| sum - rows[k][j] * x[j]);
        x[k] = sum * rows[k][k].reciprocal();
    }
    Some(x)
}
