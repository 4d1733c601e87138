//! Assembly of the Schur complement S = A W⁻¹ Aᵀ + μ I and of its right side y = A W⁻¹ f - g. The diagonal blocks
//! before elimination are sums over the groups that a row block touches.
//!
//! The row blocks are independent of each other here. The owner may add the row blocks of [`Pattern::pin_rows`] one
//! by one while it computes their numbers. The others are read from the entries.

#![allow(clippy::needless_range_loop)] // as in block.rs

use super::block::{
    add, add_times, part, part_mut, subtract_transposed, DiagonalBlock, TransformedRow,
};
use super::mass_block::{dot, InverseMass};
use super::pattern::Pattern;
use super::pin_block::PinBlock;
use super::records::{last, next, PinEnd, PinRows, Start, Touch};
use super::saddle::Saddle;
use super::storage::Source;
use crate::math::{each, indexed, Real};

/// The diagonal block of S of two rows, and their right side. Only the lower triangle is summed.
#[derive(Clone, Copy, Debug)]
pub struct PinSum<S> {
    s: [[S; 2]; 2],
    /// The term that the condensed groups would add to the diagonal without condensation.
    held: S,
    /// y.
    pub right: [S; 2],
}

impl<S: Real> PinSum<S> {
    /// The sum without any group: y = -g.
    #[inline(always)]
    pub fn new(g: [S; 2]) -> Self {
        Self { s: [[S::zero(); 2]; 2], held: S::zero(), right: each(g, |g| -g) }
    }
}

impl<S: Real> Saddle<S> {
    /// Writes b of rows [±I b] into the entries.
    #[inline(always)]
    pub fn put_pin_entries(&mut self, end: &PinEnd, b: [S; 2]) {
        let entry = end.entry as usize;
        (self.entries[entry][2], self.entries[entry + 1][2]) = (b[0], b[1]);
    }

    /// Adds rows [±I b] at one group to a sum and stores them. `x` contains W⁻¹ f of all groups.
    #[inline(always)]
    pub fn add_pin(&mut self, end: &PinEnd, b: [S; 2], x: &[S], sum: &mut PinSum<S>) {
        self.put_pin_entries(end, b);
        self.add_pin_block(end, b, sum);
        add_pin_times(end.sign, &b, part(x, end.at), &mut sum.right);
    }

    #[inline(always)]
    fn add_pin_block(&mut self, end: &PinEnd, b: [S; 2], sum: &mut PinSum<S>) {
        let mass = &self.masses[end.group as usize];
        let pin = PinBlock::new(end.sign, &b, mass);
        pin.add_square(&mut sum.s);
        sum.held += mass.held;
        self.pins[end.pin as usize] = pin;
    }

    /// Stores the diagonal block of rows after all their groups are added.
    #[inline(always)]
    pub fn put_pin_rows(&mut self, rows: &PinRows, sum: &PinSum<S>) {
        self.put(rows.row, rows.diagonal, sum.s, [sum.held; 2]);
    }

    #[inline(always)]
    fn put<const N: usize>(&mut self, row: u32, diagonal: u32, s: [[S; N]; N], held: [S; N]) {
        let mut block = DiagonalBlock { magnitude: indexed(|i| s[i][i] + held[i]), s };
        if let Some(damping) = self.damping.get(row as usize..row as usize + N) {
            for i in 0..N {
                block.s[i][i] += damping[i];
                block.magnitude[i] += damping[i];
            }
        }
        block.store(&mut self.factors, diagonal);
    }

    /// Computes the diagonal blocks of [`Pattern::pin_rows`] from the entries.
    pub(super) fn put_all_pin_rows(&mut self, pattern: &Pattern) {
        for rows in &pattern.pin_rows {
            let mut sum = PinSum::new([S::zero(); 2]);
            for end in rows.ends() {
                self.add_pin_block(end, self.third_column(end), &mut sum);
            }
            self.put_pin_rows(rows, &sum);
        }
    }

    /// b of rows [±I b].
    #[inline(always)]
    fn third_column(&self, end: &PinEnd) -> [S; 2] {
        each(*part::<[S; 3], 2>(&self.entries, end.entry), |row| row[2])
    }

    /// Computes the right sides y of [`Pattern::pin_rows`] from the entries into `g`.
    pub(super) fn put_right_sides_of_pins(&self, pattern: &Pattern, x: &[S], g: &mut [S]) {
        for rows in &pattern.pin_rows {
            let g = part_mut::<S, 2>(g, rows.row);
            let mut y = each(*g, |g| -g);
            for end in rows.ends() {
                add_pin_times(end.sign, &self.third_column(end), part(x, end.at), &mut y);
            }
            *g = y;
        }
    }

    /// Computes the other row blocks: rows of U and pin blocks from the entries, then the diagonal blocks.
    #[inline(always)]
    pub(super) fn put_other_rows(&mut self, pattern: &Pattern) {
        for (Source { entry, group }, u) in pattern.storage.rows.iter().zip(&mut self.u) {
            let InverseMass { translation: [d0, d1], along, direction, .. } =
                &self.masses[*group as usize];
            let row = &self.entries[*entry as usize];
            let last = dot(row, direction);
            u.plain = [row[0], row[1], last];
            u.scaled = [row[0] * *d0, row[1] * *d1, last * *along];
        }
        for end in &pattern.storage.mixed {
            let mass = &self.masses[end.group as usize];
            self.pins[end.pin as usize] = PinBlock::new(end.sign, &self.third_column(end), mass);
        }
        let mut touches = &pattern.program.touches[..];
        for start in &pattern.program.starts {
            let own = next(&mut touches, start.touches);
            match start.size {
                1 => self.put_rows::<1>(start, own),
                2 => self.put_rows::<2>(start, own),
                _ => self.put_rows::<3>(start, own),
            }
        }
    }

    fn put_rows<const N: usize>(&mut self, start: &Start, touches: &[Touch]) {
        let (mut s, mut held) = ([[S::zero(); N]; N], [S::zero(); N]);
        for Touch { first, group, sign, .. } in touches {
            let of_group = self.masses[*group as usize].held;
            if N == 2 && *sign != 0.0 {
                self.pins[*first as usize].add_square(&mut s);
                held.iter_mut().for_each(|held| *held += of_group);
            } else {
                let u = part::<_, N>(&self.u, *first);
                add(&mut s, u, u);
                for (held, TransformedRow { plain: [x, y, _], .. }) in held.iter_mut().zip(u) {
                    *held += of_group * (*x * *x + *y * *y);
                }
            }
        }
        self.put(start.row, start.diagonal, s, held);
    }

    /// Computes the right sides y of the other row blocks into `g`.
    #[inline(always)]
    pub(super) fn put_other_right_sides(&self, pattern: &Pattern, x: &[S], g: &mut [S]) {
        let mut touches = &pattern.program.touches[..];
        for start in &pattern.program.starts {
            let own = next(&mut touches, start.touches);
            match start.size {
                1 => self.put_right_side::<1>(start, own, x, g),
                2 => self.put_right_side::<2>(start, own, x, g),
                _ => self.put_right_side::<3>(start, own, x, g),
            }
        }
    }

    fn put_right_side<const N: usize>(
        &self,
        start: &Start,
        touches: &[Touch],
        x: &[S],
        g: &mut [S],
    ) {
        let g = part_mut::<S, N>(g, start.row);
        let mut y = each(*g, |g| -g);
        for Touch { entry, at, .. } in touches {
            add_times(part(&self.entries, *entry), part(x, *at), &mut y);
        }
        *g = y;
    }

    /// x -= W⁻¹ Aᵀ λ over [`Pattern::pin_rows`], with λ in `g`.
    #[inline(always)]
    pub fn subtract_pin_rows(&self, pattern: &Pattern, x: &mut [S], g: &[S]) {
        for rows in pattern.pin_rows.iter().rev() {
            let lambda = part::<S, 2>(g, rows.row);
            for end in rows.ends() {
                let e = &self.masses[end.group as usize].direction;
                let pin = &self.pins[end.pin as usize];
                pin.subtract_transposed(end.sign, e, lambda, part_mut(x, end.at));
            }
        }
    }

    /// x -= W⁻¹ Aᵀ λ over the other row blocks, with λ in `g`.
    #[inline(always)]
    pub(super) fn subtract_other_rows(&self, pattern: &Pattern, x: &mut [S], g: &[S]) {
        let mut touches = &pattern.program.touches[..];
        for start in pattern.program.starts.iter().rev() {
            let own = last(&mut touches, start.touches);
            match start.size {
                1 => self.subtract_rows::<1>(start, own, x, g),
                2 => self.subtract_rows::<2>(start, own, x, g),
                _ => self.subtract_rows::<3>(start, own, x, g),
            }
        }
    }

    fn subtract_rows<const N: usize>(
        &self,
        start: &Start,
        touches: &[Touch],
        x: &mut [S],
        g: &[S],
    ) {
        let lambda = part::<S, N>(g, start.row);
        for Touch { first, group, at, sign, .. } in touches {
            let e = &self.masses[*group as usize].direction;
            let x = part_mut::<S, 3>(x, *at);
            if N == 2 && *sign != 0.0 {
                let pin = &self.pins[*first as usize];
                pin.subtract_transposed((*sign).into(), e, lambda, x);
            } else {
                subtract_transposed(part::<_, N>(&self.u, *first), e, lambda, x);
            }
        }
    }
}

/// y += [±I b] x.
#[inline(always)]
fn add_pin_times<S: Real>(sign: f64, b: &[S; 2], x: &[S; 3], y: &mut [S; 2]) {
    for i in 0..2 {
        y[i] = y[i].plus_product(S::constant(sign), x[i]).plus_product(b[i], x[2]);
    }
}
