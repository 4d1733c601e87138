//! The diagonal blocks of S = A W⁻¹ Aᵀ + μ I and the right side y = A W⁻¹ f - g, before anything is eliminated:
//! sums over the groups that a row block touches.
//!
//! Row blocks are independent of each other here. Those of [`Pattern::armed`] may be given by their arms, in
//! the course of what makes these; the others are read from the entries.

use super::arm::Arm;
use super::block::{add, part, part_mut, subtract_transposed, Open, Twin};
use super::pattern::Pattern;
use super::places::Armed;
use super::saddle::Saddle;
use super::steps::{last, next, Start, Touch};
use super::weight::Weight;
use crate::math::Real;

/// A diagonal block of two rows, of which the lower triangle is summed up, and its right side.
#[derive(Clone, Copy, Debug)]
pub struct Begun<S> {
    s: [[S; 2]; 2],
    /// What anchored groups would add to its diagonal.
    held: S,
    /// y.
    pub right: [S; 2],
}

impl<S: Real> Begun<S> {
    /// -g; groups are to be added.
    #[inline(always)]
    pub fn new(g: [S; 2]) -> Self {
        Self { s: [[S::zero(); 2]; 2], held: S::zero(), right: g.map(|g| -g) }
    }

    /// Adds a group where the rows are [±I b], with its weight and its part of Dw⁻¹ Lw⁻¹ f; returns what is to be
    /// stored in [`Saddle::arms`].
    #[inline(always)]
    pub fn add(&mut self, sign: f64, b: [S; 2], weight: &Weight<S>, x: &[S; 3]) -> Arm<S> {
        let arm = Arm::new(&bent(b, sign, weight), &weight.inverse);
        arm.add_square(&mut self.s);
        self.held += weight.held;
        arm.add_times(sign, x, &mut self.right);
        arm
    }
}

impl<S: Real> Saddle<S> {
    /// Stores the diagonal block of a row block of [`Pattern::armed`], whose first row is `row`.
    #[inline(always)]
    pub fn begin(&mut self, armed: &Armed, row: u32, begun: &Begun<S>) {
        self.put(row, armed.diagonal, begun.s, [begun.held; 2]);
    }

    #[inline(always)]
    fn put<const N: usize>(&mut self, row: u32, diagonal: u32, s: [[S; N]; N], held: [S; N]) {
        let mut open = Open { magnitude: std::array::from_fn(|i| s[i][i] + held[i]), s };
        if let Some(damping) = self.damping.get(row as usize..row as usize + N) {
            for (i, mu) in damping.iter().enumerate() {
                open.s[i][i] += *mu;
                open.magnitude[i] += *mu;
            }
        }
        open.store(&mut self.factors, diagonal);
    }

    /// b′ of all arms and the rows of U from the entries; with `ALL` of those too that are begun otherwise.
    #[inline(always)]
    pub(super) fn transform<const ALL: bool>(&mut self, pattern: &Pattern) {
        assert_eq!(self.entries.len(), pattern.n_entries, "a matrix of this pattern");
        let places = &pattern.places;
        for (owner, u) in places.general.iter().zip(&mut self.u) {
            let Weight { inverse, shift, .. } = &self.weights[owner.group as usize];
            let mut row = self.entries[owner.row as usize];
            if owner.coupled {
                row[2] = row[2] - shift[0] * row[0] - shift[1] * row[1];
            }
            u.plain = row;
            u.scaled = [row[0] * inverse[0], row[1] * inverse[1], row[2] * inverse[2]];
        }
        if ALL {
            (0..places.arms.len()).for_each(|k| self.take_arm(pattern, k));
        } else {
            places.mixed.iter().for_each(|k| self.take_arm(pattern, *k as usize));
        }
    }

    fn take_arm(&mut self, pattern: &Pattern, k: usize) {
        let owner = &pattern.places.arms[k];
        let rows: &[[S; 3]; 2] = part(&self.entries, owner.row);
        let weight = &self.weights[owner.group as usize];
        let b = bent(rows.map(|row| row[2]), owner.sign.into(), weight);
        self.arms[k] = Arm::new(&b, &weight.inverse);
    }

    /// The entries of the row blocks that were begun with their arms, from these.
    pub fn restore_entries(&mut self, pattern: &Pattern) {
        for (owner, arm) in pattern.places.arms.iter().zip(&self.arms) {
            let sign = -f64::from(owner.sign);
            let b = bent(arm.plain, sign, &self.weights[owner.group as usize]);
            let row = owner.row as usize;
            (self.entries[row][2], self.entries[row + 1][2]) = (b[0], b[1]);
        }
        self.restore_anchors(pattern);
    }

    /// Begins row blocks from U and the arms.
    #[inline(always)]
    pub(super) fn begin_all(&mut self, pattern: &Pattern, starts: &[Start]) {
        let mut touches = &pattern.steps.touches[..];
        for start in starts {
            let own = next(&mut touches, start.touches).iter();
            match start.size {
                1 => self.begin_rows::<1>(start, own),
                2 => self.begin_rows::<2>(start, own),
                _ => self.begin_rows::<3>(start, own),
            }
        }
    }

    fn begin_rows<'a, const N: usize>(
        &mut self,
        start: &Start,
        touches: impl Iterator<Item = &'a Touch>,
    ) {
        let (mut s, mut held) = ([[S::zero(); N]; N], [S::zero(); N]);
        for Touch { first, group, sign } in touches {
            let of_group = self.weights[*group as usize].held;
            if N == 2 && *sign != 0.0 {
                self.arms[*first as usize].add_square(&mut s);
                held.iter_mut().for_each(|held| *held += of_group);
            } else {
                let u = part::<_, N>(&self.u, *first);
                add::<S, N, N, 3>(&mut s, u, u);
                for (held, Twin { plain: [x, y, _], .. }) in held.iter_mut().zip(u) {
                    *held += of_group * (*x * *x + *y * *y);
                }
            }
        }
        self.put(start.row, start.diagonal, s, held);
    }

    /// The right sides y of row blocks, into g.
    #[inline(always)]
    pub(super) fn right_sides(&self, pattern: &Pattern, starts: &[Start], x: &[S], g: &mut [S]) {
        let mut touches = &pattern.steps.touches[..];
        for start in starts {
            let own = next(&mut touches, start.touches).iter();
            match start.size {
                1 => self.right_side::<1>(start, own, x, g),
                2 => self.right_side::<2>(start, own, x, g),
                _ => self.right_side::<3>(start, own, x, g),
            }
        }
    }

    fn right_side<'a, const N: usize>(
        &self,
        start: &Start,
        touches: impl Iterator<Item = &'a Touch>,
        x: &[S],
        g: &mut [S],
    ) {
        let g = part_mut::<S, N>(g, start.row);
        let mut y = g.map(|g| -g);
        for Touch { first, group, sign } in touches {
            let x = part(x, 3 * *group);
            if N == 2 && *sign != 0.0 {
                self.arms[*first as usize].add_times((*sign).into(), x, &mut y);
            } else {
                Twin::add_times(part(&self.u, *first), x, &mut y);
            }
        }
        *g = y;
    }

    /// x -= Dw⁻¹ Uᵀ λ over row blocks, in the order of substitution.
    #[inline(always)]
    pub(super) fn spread_all(&self, pattern: &Pattern, starts: &[Start], x: &mut [S], g: &[S]) {
        let count = starts.iter().map(|start| start.touches as usize).sum();
        let mut touches = &pattern.steps.touches[..count];
        for start in starts.iter().rev() {
            let own = last(&mut touches, start.touches).iter().rev();
            match start.size {
                1 => self.spread_rows::<1>(start, own, x, g),
                2 => self.spread_rows::<2>(start, own, x, g),
                _ => self.spread_rows::<3>(start, own, x, g),
            }
        }
    }

    fn spread_rows<'a, const N: usize>(
        &self,
        start: &Start,
        touches: impl Iterator<Item = &'a Touch>,
        x: &mut [S],
        g: &[S],
    ) {
        let lambda = part::<S, N>(g, start.row);
        for Touch { first, group, sign } in touches {
            let x = part_mut::<S, 3>(x, 3 * *group);
            if N == 2 && *sign != 0.0 {
                self.arms[*first as usize].subtract_transposed((*sign).into(), lambda, x);
            } else {
                let u = part::<Twin<S>, N>(&self.u, *first).iter().map(|u| u.scaled);
                subtract_transposed(x, u, lambda);
            }
        }
    }

    /// The same with the arm of one group of a row block begun with its arms.
    #[inline(always)]
    pub fn spread(&self, arm: u32, group: u32, sign: f64, lambda: &[S; 2], x: &mut [S]) {
        self.arms[arm as usize].subtract_transposed(sign, lambda, part_mut(x, 3 * group));
    }
}

/// b′ = b ∓ shift.
#[inline(always)]
fn bent<S: Real>(b: [S; 2], sign: f64, weight: &Weight<S>) -> [S; 2] {
    let sign = S::constant(sign);
    [0, 1].map(|k| b[k].minus_product(sign, weight.shift[k]))
}
