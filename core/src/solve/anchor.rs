//! Anchors: a pair of rows [±I b] of A that touches one group alone, such as a pin to ground.
//!
//! Together with the first two unknowns p of its group such a block is eliminated before everything else, in
//! closed form and without a division that the state changes: with the third unknown φ, and s = ±b,
//!
//! ```text
//! ±p + b φ = g,   so   [p; φ] = [±g; 0] + [-s; 1] φ,
//! (d₂ - 2 sᵀ b₀₁ + d sᵀ s) φ = [-s; 1]ᵀ (f - W [±g; 0] - Aᵀ λ)
//! ```
//!
//! with W = [d I, b₀₁; b₀₁ᵀ, d₂]. A body that is pinned to ground turns about the pin, and that is all that the
//! other rows see of it: a group with the [`Weight`] 1/d₀ = 1/d₁ = 0, 1/d₂ the inverse of the inertia about the pin,
//! and s as its shift. Its λ follows last, from the first two rows.

use super::block::{part, part_mut};
use super::pattern::{Pattern, RowBlock};
use super::plan::index;
use super::saddle::Saddle;
use super::steps::next;
use crate::math::Real;

/// An anchored group in W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor<S = f64> {
    /// d.
    pub mass: S,
    /// 1/(d₂ - 2 sᵀ b₀₁ + d sᵀ s).
    pub inverse: S,
    /// b₀₁ - d s.
    pub moment: [S; 2],
    /// s.
    pub shift: [S; 2],
}

impl<S: Real> Anchor<S> {
    /// With d = d₂ = 1, b₀₁ = 0 and s = 0.
    pub(super) fn unit() -> Self {
        let none = [S::zero(); 2];
        Self { mass: S::one(), inverse: S::one(), moment: none, shift: none }
    }

    /// From f of its group and g of its rows to p = ±g and φ for λ = 0; f of the first two rows goes where g was.
    #[inline(always)]
    pub fn hold(&self, sign: S, f: &mut [S; 3], g: &mut [S; 2]) {
        let p = g.map(|g| sign * g);
        let mut turning = f[2];
        for i in 0..2 {
            turning = turning.minus_product(self.shift[i], f[i]);
            turning = turning.minus_product(self.moment[i], p[i]);
        }
        *g = [f[0], f[1]];
        *f = [p[0], p[1], turning * self.inverse];
    }
}

/// Where an anchor stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchored {
    /// Its place among the row blocks.
    pub block: u32,
    /// The group that it holds.
    pub group: u32,
    /// The first of its rows.
    pub row: u32,
    /// Its first row of three entries.
    pub(super) entry: u32,
    /// Numbers of other row blocks that touch the group: with a unit block there, and without.
    pub(super) units: u32,
    pub(super) dense: u32,
    /// Of the unit block.
    pub sign: f64,
}

/// What other row blocks put on the groups of anchors, anchor by anchor.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    pub units: Vec<Unit>,
    pub dense: Vec<Dense>,
}

/// A pair of rows with a unit block at the group of an anchor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    /// Of the unit block.
    sign: f64,
    /// The first of the rows.
    row: u32,
}

/// Another row block at the group of an anchor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dense {
    /// The first of its rows.
    row: u32,
    /// Its first row of three entries in this group.
    entry: u32,
    size: u32,
}

/// The anchors among `blocks`, of which `rows` are the first rows, and what loads each of them.
///
/// # Panics
/// If a row block to be an anchor is none, or shares its group with another.
pub(super) fn anchors(
    groups: usize,
    blocks: &[RowBlock],
    rows: &[usize],
    anchored: &[usize],
) -> (Vec<Anchored>, Loads) {
    let mut at: Vec<Option<usize>> = vec![None; groups];
    for (k, &block) in anchored.iter().enumerate() {
        let RowBlock { size, touches, signs } = &blocks[block];
        assert!(*size == 2 && touches.len() == 1 && signs.len() == 1, "one pair of rows [±I b]");
        assert!(at[touches[0].0].replace(k).is_none(), "one anchor for a group");
    }
    let mut loads = vec![Loads::default(); anchored.len()];
    for (k, block) in blocks.iter().enumerate() {
        for (i, &(group, first)) in block.touches.iter().enumerate() {
            let Some(anchor) = at[group].filter(|anchor| anchored[*anchor] != k) else { continue };
            let (row, Loads { units, dense }) = (index(rows[k]), &mut loads[anchor]);
            match block.signs.get(i) {
                Some(&sign) => units.push(Unit { sign, row }),
                None => {
                    dense.push(Dense { row, entry: index(first / 3), size: index(block.size) });
                }
            }
        }
    }
    let anchor = |(loads, &block): (&Loads, &usize)| Anchored {
        block: index(block),
        group: index(blocks[block].touches[0].0),
        row: index(rows[block]),
        entry: index(blocks[block].touches[0].1 / 3),
        units: index(loads.units.len()),
        dense: index(loads.dense.len()),
        sign: blocks[block].signs[0],
    };
    let all = Loads {
        units: loads.iter().flat_map(|loads| &loads.units).copied().collect(),
        dense: loads.iter().flat_map(|loads| &loads.dense).copied().collect(),
    };
    (loads.iter().zip(anchored).map(anchor).collect(), all)
}

impl<S: Real> Saddle<S> {
    /// [`Anchor::hold`] of all.
    #[inline(always)]
    pub(super) fn anchor(&self, pattern: &Pattern, x: &mut [S]) {
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        for (place, anchor) in pattern.anchors.iter().zip(&self.anchors) {
            let sign = S::constant(place.sign);
            anchor.hold(sign, part_mut(f, 3 * place.group), part_mut(g, place.row));
        }
    }

    /// λ of anchors, once all others and φ are known; then p of the origin.
    #[inline(always)]
    pub(super) fn release(&self, pattern: &Pattern, x: &mut [S]) {
        // most mechanisms have no rows but pins at their anchors, and then nothing need be known of others
        match pattern.loads.dense.is_empty() {
            true => self.release_from::<false>(pattern, x),
            false => self.release_from::<true>(pattern, x),
        }
    }

    #[inline(always)]
    fn release_from<const DENSE: bool>(&self, pattern: &Pattern, x: &mut [S]) {
        let (f, g) = x.split_at_mut(pattern.n_unknowns());
        let (mut units, mut dense) = (&pattern.loads.units[..], &pattern.loads.dense[..]);
        for (place, anchor) in pattern.anchors.iter().zip(&self.anchors) {
            let own = part_mut::<S, 3>(f, 3 * place.group);
            let mut left = *part::<S, 2>(g, place.row);
            for i in 0..2 {
                let without = left[i].minus_product(anchor.mass, own[i]);
                left[i] = without.minus_product(anchor.moment[i], own[2]);
            }
            for unit in next(&mut units, place.units) {
                let (sign, lambda) = (S::constant(unit.sign), part::<S, 2>(g, unit.row));
                (0..2).for_each(|i| left[i] = left[i].minus_product(sign, lambda[i]));
            }
            if DENSE {
                let dense = next(&mut dense, place.dense);
                dense.iter().for_each(|load| self.subtract(load, g, &mut left));
            }
            *part_mut(g, place.row) = left.map(|left| S::constant(place.sign) * left);
            (0..2).for_each(|i| own[i] = own[i].minus_product(anchor.shift[i], own[2]));
        }
    }

    fn subtract(&self, load: &Dense, g: &[S], left: &mut [S; 2]) {
        let lambda = &g[load.row as usize..][..load.size as usize];
        for (entries, lambda) in self.entries[load.entry as usize..].iter().zip(lambda) {
            left.iter_mut()
                .zip(entries)
                .for_each(|(left, a)| *left = left.minus_product(*a, *lambda));
        }
    }

    /// The entries of anchors, from the shifts of their groups.
    pub(super) fn restore_anchors(&mut self, pattern: &Pattern) {
        for (place, anchor) in pattern.anchors.iter().zip(&self.anchors) {
            let entry = place.entry as usize;
            for (row, shift) in self.entries[entry..entry + 2].iter_mut().zip(anchor.shift) {
                row[2] = S::constant(place.sign) * shift;
            }
        }
    }
}
