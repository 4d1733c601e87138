//! Conjugate gradients for K = [M Φ_qᵀ; Φ_q -μ] with the factors of P = [M + E Φ_qᵀ; Φ_q -μ] as preconditioner (Gould,
//! Hribar and Nocedal, *On the solution of equality constrained quadratic programming problems arising in optimization*,
//! SIAM J. Sci. Comput. 23 (2001) 1376; Dollar, Gould, Schilders and Wathen, SIAM J. Matrix Anal. Appl. 28 (2006) 170).
//!
//! The remainder b - K x of x = P⁻¹ b is E x. A part of a remainder in the range of Φ_qᵀ moves nothing: it belongs to the
//! multipliers, which take it before each step. So r is measured by z = P⁻¹ r, as zᵀ (M + E) z. In exact arithmetic the solution is found in as many steps as the mechanism has degrees of
//! freedom. In a mechanism whose heavy bodies determine its light ones, each step gains two digits; a light freedom of
//! its own costs one step, whatever its mass. If it has no mass at all, its direction p has pᵀ M p = 0.

use super::augmented::Augmented;
use super::kinematics::Motions;
use super::mass::MassBlock;
use super::{constraints, mass, Compiled};
use crate::math::Real;
use crate::model::{Columns, Model};

/// Remainder at which the steps end, relative to the terms of an equation.
const SETTLED: f64 = 1e-15;
/// pᵀ M p relative to pᵀ (M + E) p of a direction without mass: rounding errors leave about 1e-28.
const MASSLESS: f64 = 1e-22;
/// A direction is light where its added mass exceeds its own so many times.
const LIGHT: f64 = 10.0;
/// Most steps for each coordinate of E, and some more.
const STEPS: usize = 2;
const MORE: usize = 10;

/// The additions E, block by block.
pub(super) type Additions<S> = Vec<(Columns, MassBlock<S>)>;

/// Vectors of the iteration, kept from one solution to the next.
#[derive(Clone, Debug)]
pub(super) struct Vectors<S> {
    r: Vec<S>,
    s: Vec<S>,
    p: Vec<S>,
    z: Vec<S>,
    ez: Vec<S>,
    open: Vec<S>,
}

impl<S> Default for Vectors<S> {
    fn default() -> Self {
        let [r, s, p, z, ez, open] = [(); 6].map(|()| Vec::new());
        Self { r, s, p, z, ez, open }
    }
}

impl<S: Real> Vectors<S> {
    /// Zeros for `n` coordinates, and `all` with the rows.
    fn clear(&mut self, n: usize, all: usize) {
        for (vector, length) in [
            (&mut self.r, n),
            (&mut self.s, n),
            (&mut self.ez, n),
            (&mut self.p, all),
            (&mut self.z, all),
            (&mut self.open, all),
        ] {
            vector.clear();
            vector.resize(length, S::zero());
        }
    }
}

/// Puts the additions at a state into `blocks`.
pub(super) fn put_blocks<S: Real>(
    model: &Model<S>,
    compiled: &Compiled<S>,
    motions: &Motions<S>,
    blocks: &mut Additions<S>,
) {
    blocks.clear();
    for (k, added) in compiled.added.iter().enumerate().filter(|(_, added)| added.any()) {
        let center = model.bodies[k + 1].center;
        let [mass, inertia] = [added.mass, added.inertia].map(S::constant);
        let coupling = motions[k + 1].pose.global(center).perp().scale(mass);
        let inertia = inertia + mass * center.dot(center);
        blocks.push((model.layout.bodies[k + 1], MassBlock { mass, coupling, inertia }));
    }
    let own = S::constant(compiled.own_mass);
    let coupling = crate::math::Vec2::zero();
    let block = MassBlock { mass: own, coupling, inertia: own };
    blocks.extend(model.layout.owners[compiled.added.len()..].iter().map(|c| (*c, block)));
}

/// The additions at a state.
pub(super) struct Gradients<'a, S> {
    pub model: &'a Model<S>,
    pub motions: &'a Motions<S>,
    pub matrix: &'a Augmented<S>,
    /// Whether rows are damped.
    pub damped: bool,
    /// M, body by body.
    pub masses: &'a [MassBlock<S>],
    pub blocks: &'a [(Columns, MassBlock<S>)],
    pub undetermined: Option<usize>,
}

impl<S: Real> Gradients<'_, S> {
    /// Turns x = P⁻¹ f into K⁻¹ f. Remainders below rounding of `terms` are left.
    pub fn take_back(&mut self, x: &mut [S], terms: &[S], vectors: &mut Vectors<S>) {
        let n = self.model.layout.n_q;
        vectors.clear(n, x.len());
        let Vectors { r, s, p, z, ez, open } = vectors;
        self.put_additions(&x[..n], r);
        if self.is_settled(r, terms) {
            return;
        }
        let mut last = S::zero();
        let light: usize = self.blocks.iter().map(|(columns, _)| columns.count).sum();
        for _ in 0..STEPS * light + MORE {
            z[..n].copy_from_slice(r);
            z[n..].fill(S::zero());
            self.matrix.solve(z);
            let mut own = self.energy(z);
            self.put_additions(&z[..n], ez);
            if !self.damped && above(dot(ez, z), own * S::constant(LIGHT)) {
                self.purify(z, open);
                own = self.energy(z);
                self.put_additions(&z[..n], ez);
            }
            let square = own + dot(ez, z);
            if self.is_settled(ez, terms) {
                x.iter_mut().zip(&*z).for_each(|(x, z)| *x += *z);
                return;
            }
            if !self.damped {
                self.absorb(x, z, (r, ez));
            }
            let beta = S::select(last, square / last, S::zero());
            p.iter_mut().zip(&*z).for_each(|(p, z)| *p = *z + beta * *p);
            s.iter_mut().zip(&*r).for_each(|(s, r)| *s = *r + beta * *s);
            // the additions of p, then the change of r
            let change = &mut *ez;
            self.put_additions(&p[..n], change);
            let Some(alpha) = self.step(p, square, change) else { return };
            x.iter_mut().zip(&*p).for_each(|(x, p)| *x += alpha * *p);
            self.put_product(&p[..n], s, change);
            r.iter_mut().zip(&*change).for_each(|(r, change)| *r -= alpha * *change);
            last = square;
        }
    }

    /// Takes what violates the constraints from z. A long step follows along a direction of hardly any mass, and rounding
    /// errors of massless coordinates, which the constraints determine, must not be taken for such a direction.
    fn purify(&self, z: &mut [S], open: &mut [S]) {
        let n = self.model.layout.n_q;
        open[..n].fill(S::zero());
        constraints::times_all(self.model, self.matrix.jacobian(), &z[..n], &mut open[n..]);
        open[n..].iter_mut().for_each(|open| *open = -*open);
        self.matrix.solve(open);
        z.iter_mut().zip(&*open).for_each(|(z, open)| *z += *open);
    }

    /// Adds the multipliers of z = P⁻¹ r to x. What is left of r is (M + E) z.
    fn absorb(&self, x: &mut [S], z: &mut [S], (r, ez): (&mut [S], &[S])) {
        let n = self.model.layout.n_q;
        x[n..].iter_mut().zip(&z[n..]).for_each(|(x, z)| *x += *z);
        z[n..].fill(S::zero());
        r.copy_from_slice(ez);
        mass::add_blocks(self.model, self.masses, &z[..n], r);
    }

    /// The length of a step along p, whose additions are `ep`, with the square |z|² of the remainder; None if p has no
    /// mass in any lane.
    fn step(&mut self, p: &[S], square: S, ep: &[S]) -> Option<S> {
        let own = self.energy(p);
        let all = own + dot(ep, p);
        let moves = own - S::constant(MASSLESS) * all;
        let lost = S::select(square, S::select(moves, S::zero(), S::one()), S::zero());
        if above(lost, S::zero()) {
            self.undetermined = Some(self.direction(p));
        }
        let alpha = S::select(moves, square / own, S::zero());
        above(alpha, S::zero()).then_some(alpha)
    }

    /// Turns `out`, the additions of p, into the upper part of K p, with s that of P p. Without damping p has no
    /// multipliers, and nothing is cancelled.
    fn put_product(&self, p: &[S], s: &[S], out: &mut [S]) {
        if self.damped {
            out.iter_mut().zip(s).for_each(|(out, s)| *out = *s - *out);
            return;
        }
        out.fill(S::zero());
        mass::add_blocks(self.model, self.masses, p, out);
    }

    /// pᵀ K p of a direction that meets the constraints up to their damping; never a difference.
    fn energy(&self, p: &[S]) -> S {
        let n = self.model.layout.n_q;
        let (a, lam) = p.split_at(n);
        let own = mass::twice_energy(self.model, self.motions, a);
        if !self.damped {
            return own;
        }
        let mut rows = vec![S::zero(); lam.len()];
        constraints::times_all(self.model, self.matrix.jacobian(), a, &mut rows);
        own + dot(&rows, lam)
    }

    /// E a into `out`.
    fn put_additions(&self, a: &[S], out: &mut [S]) {
        out.fill(S::zero());
        for (columns, block) in self.blocks {
            columns.add(block.times(columns.of(a)), out);
        }
    }

    fn is_settled(&self, ez: &[S], terms: &[S]) -> bool {
        let open = |k: usize| above(ez[k].abs(), terms[k] * S::constant(SETTLED));
        !self.blocks.iter().flat_map(|(columns, _)| columns.range()).any(open)
    }

    /// The coordinate that has the largest part in a direction.
    fn direction(&self, p: &[S]) -> usize {
        let energy = |(columns, block): &(Columns, MassBlock<S>)| {
            let own = columns.of(p);
            let parts = own.iter().zip(block.times(own)).map(|(x, y)| (*x * y).largest_magnitude());
            let parts: Vec<f64> = parts.take(columns.count).collect();
            let worst = (0..parts.len()).max_by(|a, b| parts[*a].total_cmp(&parts[*b]));
            (parts.iter().sum::<f64>(), columns.first + worst.unwrap_or(0))
        };
        let most = self.blocks.iter().map(energy).max_by(|a, b| a.0.total_cmp(&b.0));
        most.map_or(0, |(_, column)| column)
    }
}

/// Whether a > b in any lane.
fn above<S: Real>(a: S, b: S) -> bool {
    S::select(a - b, S::one(), S::zero()).largest_magnitude() > 0.0
}

/// aᵀ b over the coordinates of `a`.
fn dot<S: Real>(a: &[S], b: &[S]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (a, b)| sum.plus_product(*a, *b))
}
