//! Static condensation. A pair of rows R of A at only one group, such as a joint to ground, is eliminated with its
//! group before all other rows.
//!
//! A group of three unknowns with two rows has one degree of freedom, e = r₁ × r₂ (R e = 0). Let P be a particular
//! solution, R P = I, and g the right side of the rows. Then
//!
//! ```text
//! x = P g + e s,   (eᵀ W e) s = eᵀ (f - W P g - Σ Aₖᵀ λₖ),   λ = Pᵀ (f - W x - Σ Aₖᵀ λₖ)
//! ```
//!
//! where k numbers the other row blocks at the group. They depend on the group only through its [`InverseMass`] (eᵀ W
//! e)⁻¹ e eᵀ. For rows [±I b] (a pin), e = (∓b, 1) and P = [±I; 0]; otherwise P = [r₂ × e, e × r₁] / |e|².

use super::mass_block::{dot, InverseMass, PIVOT_TOLERANCE};
use super::structure::{index, RowBlock};
use crate::math::{each, indexed, Listed, Real};

/// A pair of rows that is eliminated with its group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condensation {
    /// Index among the row blocks.
    pub block: u32,
    /// The group.
    pub group: u32,
    /// The first unknown of the group.
    pub at: u32,
    /// The first of the two rows.
    pub row: u32,
    /// The first of their rows of three entries.
    pub(super) entry: u32,
    /// ±1 for rows [±I b], otherwise 0.
    pub sign: f64,
    /// Numbers of other row blocks at the group: pairs [±I b] at a pin, and all others.
    pub(super) pins: u32,
    pub(super) others: u32,
}

/// W = [d 0 b₀; 0 d b₁; b₀ b₁ c] of a condensed group, and the particular solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CondensedGroup<S = f64> {
    /// d.
    pub mass: S,
    /// b.
    pub moment: [S; 2],
    /// c.
    pub inertia: S,
    /// The columns of P. Unused for rows [±I b].
    particular: [[S; 3]; 2],
}

impl<S: Real> CondensedGroup<S> {
    /// A group with the given W.
    #[inline]
    pub fn new(mass: S, moment: [S; 2], inertia: S) -> Self {
        Self { mass, moment, inertia, particular: [[S::zero(); 3]; 2] }
    }

    /// e and eᵀ W e for the rows of a pin.
    #[inline(always)]
    pub fn about_pin(&self, sign: f64, b: [S; 2]) -> ([S; 3], S) {
        let sign = S::constant(-sign);
        let e = [sign * b[0], sign * b[1], S::one()];
        (e, self.along(&e))
    }

    /// eᵀ W e.
    #[inline(always)]
    fn along(&self, e: &[S; 3]) -> S {
        dot(e, &self.times(e))
    }

    /// Computes e, P and (eᵀ W e)⁻¹ from the rows. For rows [±I b] it computes only e, since the owner provides the
    /// rest.
    #[inline(always)]
    pub(super) fn reduce(
        &mut self,
        sign: f64,
        [first, second]: &[[S; 3]; 2],
        mass: &mut InverseMass<S>,
    ) {
        if sign != 0.0 {
            let sign = S::constant(-sign);
            mass.direction = [sign * first[2], sign * second[2], S::one()];
            return;
        }
        let e = cross(first, second);
        let inverse = S::one() / dot(&e, &e);
        self.particular = each([cross(second, &e), cross(&e, first)], |p| each(p, |p| p * inverse));
        // |e|² = |r₁|² |r₂|² sin²: the group has no usable inverse if the rows are nearly parallel
        let least = S::constant(PIVOT_TOLERANCE) * dot(first, first) * dot(second, second);
        let none = S::constant(f64::INFINITY);
        mass.along = S::select(dot(&e, &e) - least, S::one() / self.along(&e), none);
        mass.direction = e;
    }

    /// Computes x with λ = 0 in all other rows, from f of the group and g of the rows. Stores Pᵀ f in place of g.
    #[inline(always)]
    pub(super) fn begin(&self, sign: f64, mass: &InverseMass<S>, f: &mut [S; 3], g: &mut [S; 2]) {
        let e = &mass.direction;
        if sign != 0.0 {
            let sign = S::constant(sign);
            let p = each(*g, |g| sign * g);
            let mut left = f[2];
            for i in 0..2 {
                left = left.minus_product(self.moment[i], p[i]);
                left = left.plus_product(e[i], f[i].minus_product(self.mass, p[i]));
            }
            let s = left * mass.along;
            *g = [sign * f[0], sign * f[1]];
            *f = [p[0].plus_product(e[0], s), p[1].plus_product(e[1], s), s];
            return;
        }
        let [p, q] = &self.particular;
        let at: [S; 3] = indexed(|i| (p[i] * g[0]).plus_product(q[i], g[1]));
        let inertial = self.times(&at);
        let s = mass.along * dot(e, &indexed(|i| f[i] - inertial[i]));
        *g = [dot(p, f), dot(q, f)];
        *f = indexed(|i| at[i].plus_product(e[i], s));
    }

    /// Computes λ of the rows from Pᵀ f (in `g`), x and Σ Aₖᵀ λₖ.
    #[inline(always)]
    pub(super) fn finish(&self, sign: f64, x: &[S; 3], others: &[S; 3], g: &mut [S; 2]) {
        if sign != 0.0 {
            for i in 0..2 {
                let inertial = others[i].plus_product(self.mass, x[i]);
                let all = inertial.plus_product(self.moment[i], x[2]);
                g[i] = g[i].minus_product(S::constant(sign), all);
            }
            return;
        }
        let inertial = self.times(x);
        let all = indexed(|i| inertial[i] + others[i]);
        (0..2).for_each(|i| g[i] -= dot(&self.particular[i], &all));
    }

    /// W x.
    #[inline(always)]
    fn times(&self, x: &[S; 3]) -> [S; 3] {
        let ([b0, b1], d) = (self.moment, self.mass);
        [
            (d * x[0]).plus_product(b0, x[2]),
            (d * x[1]).plus_product(b1, x[2]),
            dot(&[b0, b1, self.inertia], x),
        ]
    }
}

#[inline(always)]
fn cross<S: Real>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    each([[1, 2], [2, 0], [0, 1]], |[i, j]| (a[i] * b[j]).minus_product(a[j], b[i]))
}

/// Other row blocks at condensed groups, ordered by group.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    pub pins: Vec<PinLoad>,
    pub others: Vec<Load>,
}

/// A pair of rows [±I b] at a pin. Only the sign of its entries is needed.
#[derive(Clone, Copy, Debug)]
pub(super) struct PinLoad {
    pub sign: f64,
    /// The first of the rows.
    pub row: u32,
}

/// Another row block at a condensed group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load {
    /// The first of the rows.
    pub row: u32,
    /// The first of its rows of three entries at this group.
    pub entry: u32,
    pub size: u32,
}

/// The condensations of the row blocks `condensed`, and the loads of each. `rows` contains the first row of each of
/// the `blocks`.
///
/// # Panics
/// If such a row block is not a pair of rows at one group, or shares its group with another such row block.
pub(super) fn condensations(
    starts: &[usize],
    blocks: &[RowBlock],
    rows: &[usize],
    condensed: &[usize],
) -> (Vec<Condensation>, Loads) {
    let mut at: Vec<Option<usize>> = vec![None; starts.len()];
    for (k, &block) in condensed.iter().enumerate() {
        let RowBlock { size, touches, .. } = &blocks[block];
        assert!(*size == 2 && touches.len() == 1, "two rows at one group");
        assert!(at[touches[0].0].replace(k).is_none(), "one pair of rows for a group");
    }
    let sign = |block: usize| blocks[block].signs.first().copied().unwrap_or(0.0);
    let mut loads = vec![Loads::default(); condensed.len()];
    for (k, block) in blocks.iter().enumerate() {
        for (i, &(group, first)) in block.touches.iter().enumerate() {
            let Some(own) = at[group].filter(|own| condensed[*own] != k) else { continue };
            let (row, Loads { pins, others }) = (index(rows[k]), &mut loads[own]);
            match block.signs.get(i).filter(|_| sign(condensed[own]) != 0.0) {
                Some(&sign) => pins.push(PinLoad { sign, row }),
                None => {
                    let (entry, size) = (index(first / 3), index(block.size));
                    others.push(Load { row, entry, size });
                }
            }
        }
    }
    let record = |(loads, &block): (&Loads, &usize)| {
        let (group, first) = blocks[block].touches[0];
        Condensation {
            block: index(block),
            group: index(group),
            at: index(starts[group]),
            row: index(rows[block]),
            entry: index(first / 3),
            sign: sign(block),
            pins: index(loads.pins.len()),
            others: index(loads.others.len()),
        }
    };
    let all = Loads {
        pins: loads.iter().flat_map(|loads| &loads.pins).copied().list(),
        others: loads.iter().flat_map(|loads| &loads.others).copied().list(),
    };
    (loads.iter().zip(condensed).map(record).list(), all)
}
