//! Interpolant of a step for y = (q, v, z, w) with q′ = v, further states z and quadratures w. It takes one
//! evaluation.
//!
//! q and its first and second derivatives are known at both ends of a step and at the beginning of the step before.
//! They determine a Hermite polynomial of degree 8. It is as accurate as the step in q, but not in v. Therefore the
//! second derivative is evaluated once more inside the step, at the state of this polynomial. The polynomial of
//! degree 9 with this second derivative, and its derivative for v, form a Hermite–Birkhoff interpolation of order 9
//! in q and 8 in v. (Enright, Jackson, Nørsett and Thomsen, *Interpolants for Runge–Kutta formulas*, ACM Trans. Math.
//! Software 12 (1986) 193, construct interpolants in this way from both ends.) z and w are treated like v, with ∫ z
//! dt and ∫ w dt in place of q. The stages give these integrals to the order of the step.
//!
//! Let θ = (t - t_old) / h. After the terms of the beginning are subtracted, the remainder is θ³ times a polynomial
//! in Newton's form,
//!
//! ```text
//! s₀ + s₁ x + s₂ x² + x³ (u₀ + u₁ z + u₂ z² + g z³) ,   x = θ - 1 ,   z = θ + r ,   r = h_before / h
//! ```
//!
//! An error e at the node before is amplified to about e / r⁵. The data of the step before are therefore not used if
//! this step is much longer.

use super::component_polynomials::{store, Four, Polynomials, HIGHEST as DEGREE};
use super::interpolant::Interpolant;
use super::ode::Structure;
use super::stages;
use crate::math::{each, indexed, Lanes, Real, ShortArray};

/// Place of the additional second derivative, as a fraction of the step. For equal steps the error of v is smallest
/// between 0.55 and 0.6. DOP853 has a stage near this place already, so that its widest gap is unchanged.
pub(super) const INSIDE: f64 = 0.6;
/// Range of h_before / h in which the beginning of the step before is used.
const BEFORE: std::ops::RangeInclusive<f64> = 0.5..=2.5;

/// Both ends of an accepted step.
#[derive(Clone, Copy)]
pub(super) struct Ends<'a> {
    pub h: f64,
    pub y_old: &'a [f64],
    pub y: &'a [f64],
    pub dy_old: &'a [f64],
    pub dy: &'a [f64],
}

impl<'a> Ends<'a> {
    /// The data of `n` components: states and derivatives at the beginning and at the end.
    #[inline]
    pub fn new(
        h: f64,
        y: [&'a [stages::Block]; 2],
        dy: [&'a [stages::Block]; 2],
        n: usize,
    ) -> Self {
        let [y_old, y] = y.each(|y| &y.as_flattened()[..n]);
        let [dy_old, dy] = dy.each(|dy| &dy.as_flattened()[..n]);
        Self { h, y_old, y, dy_old, dy }
    }
}

/// Four polynomials under construction.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// (v, z, w) and its derivative at the beginning.
    begin: [Lanes; 2],
    /// Coefficients of θ³ … θ⁹, over h².
    c: [Lanes; DEGREE - 2],
    /// The second derivative at [`INSIDE`], without the term of the last coefficient.
    inside: Lanes,
}

/// The interpolant, with the data of the step before.
pub(super) struct HermiteBirkhoff {
    /// Number of components of q.
    positions: usize,
    /// Number of components of (v, z), on which derivatives depend.
    rates_needed: usize,
    /// Length of the step before; 0 if it is not used.
    h_before: f64,
    /// (v, z, w) and its derivative at the beginning of the step before.
    rates: Vec<f64>,
    slopes: Vec<f64>,
    /// The integrals of (v, z, w) over the step before, and over this one.
    gained: Vec<f64>,
    gain: Vec<f64>,
    blocks: Vec<Block>,
    /// The completed polynomials: first those of q, then those of (v, z, w).
    polynomials: Vec<Four>,
}

impl HermiteBirkhoff {
    /// An interpolant for y = (q, v, z, w).
    pub fn new(structure: Structure) -> Self {
        let positions = structure.positions;
        let m = structure.total() - positions;
        let zero = Lanes::zero();
        let none = Block { begin: [zero; 2], c: [zero; DEGREE - 2], inside: zero };
        Self {
            positions,
            rates_needed: positions + structure.states,
            h_before: 0.0,
            rates: vec![0.0; m],
            slopes: vec![0.0; m],
            gained: vec![0.0; m],
            gain: vec![0.0; m],
            blocks: vec![none; m.div_ceil(Lanes::WIDTH)],
            polynomials: vec![
                [zero; DEGREE + 1];
                positions.div_ceil(Lanes::WIDTH) + m.div_ceil(Lanes::WIDTH)
            ],
        }
    }

    /// Discards the step before, because the equations or the state have changed.
    #[inline]
    pub fn forget(&mut self) {
        self.h_before = 0.0;
    }

    /// Whether the step before can be used for a step of length `h`.
    #[inline]
    pub fn serves(&self, h: f64) -> bool {
        BEFORE.contains(&(self.h_before / h))
    }

    /// Computes the integrals of (v, z, w) over a step. The integral of v is the change of q. The integral of x = z
    /// or w follows from the stages in the first rows of `k` and their double-quadrature `weights`: ∫ x dt = h x_old
    /// + h² Σ weightᵢ kᵢ.
    pub fn measure(&mut self, ends: Ends<'_>, weights: &[f64], k: &[stages::Block]) {
        let Ends { h, y_old, y, .. } = ends;
        let (n, p) = (y.len(), self.positions);
        for (gain, (y, y_old)) in self.gain.iter_mut().zip(y[..p].iter().zip(y_old)) {
            *gain = y - y_old;
        }
        let (each, rows) = (Lanes::constant(h), k.chunks_exact(stages::width(n)));
        for first in (2 * p..n).step_by(Lanes::WIDTH) {
            let terms = weights.iter().zip(rows.clone().map(<[stages::Block]>::as_flattened));
            let sum = terms.fold(Lanes::zero(), |sum, (weight, k)| {
                sum.plus_product(Lanes::constant(*weight), lanes(&k[first..]))
            });
            let gain = each * lanes(&y_old[first..]).plus_product(each, sum);
            self.gain[first - p..].iter_mut().zip(gain.to_array()).for_each(|(to, x)| *to = x);
        }
    }

    /// Stores the data of this step for the next one.
    #[inline]
    pub fn remember(&mut self, ends: Ends<'_>) {
        self.h_before = ends.h;
        self.rates.copy_from_slice(&ends.y_old[self.positions..]);
        self.slopes.copy_from_slice(&ends.dy_old[self.positions..]);
        std::mem::swap(&mut self.gained, &mut self.gain);
    }

    /// Computes (q, v, z) at [`INSIDE`] with the polynomial of degree 8. w is not computed.
    pub fn predict(&mut self, ends: Ends<'_>, out: &mut [f64]) {
        let Ends { h, y_old, y, dy_old, dy } = ends;
        let (p, r) = (self.positions, self.h_before / h);
        let nodes = Nodes::new(r);
        let [half, behind, per_h, per_square] =
            each([0.5, -0.5 * r, 1.0 / h, 1.0 / (h * h)], Lanes::constant);
        let [ahead, bend, all, square] =
            each([INSIDE * h, 0.5 * INSIDE * h, h, h * h], Lanes::constant);
        for (b, block) in self.blocks.iter_mut().enumerate().rev() {
            let of = |x: &[f64]| lanes(&x[b * Lanes::WIDTH..]);
            let (v, a) = (of(&y_old[p..]), of(&dy_old[p..]));
            let steep = v * per_h;
            // values at the end minus the terms of the beginning, divided by h²
            let end = [
                (of(&self.gain) * per_square - steep).minus_product(half, a),
                (of(&y[p..]) - v) * per_h - a,
                of(&dy[p..]) - a,
            ];
            let before = [
                (nodes.r * steep.plus_product(behind, a))
                    .minus_product(of(&self.gained), per_square),
                (nodes.r * a).plus_product(of(&self.rates) - v, per_h),
                of(&self.slopes) - a,
            ];
            let c = nodes.through(end, before);
            let [position, rate, slope] = at_inside(&c);
            block.begin = [v, a];
            block.c[..6].copy_from_slice(&c);
            block.inside = a + slope;
            // descending blocks, and rates last, since the last block of q overlaps the first rates
            if b * Lanes::WIDTH < p {
                let q = of(y_old).plus_product(ahead, v.plus_product(bend, a));
                store(q.plus_product(square, position), &mut out[b * Lanes::WIDTH..]);
            }
            if b * Lanes::WIDTH < self.rates_needed {
                let v = v.plus_product(ahead, a).plus_product(all, rate);
                store(v, &mut out[p + b * Lanes::WIDTH..]);
            }
        }
    }

    /// Completes the polynomials with the derivative `inside` at the predicted state.
    pub fn complete(&mut self, ends: Ends<'_>, inside: &[f64]) {
        let (p, h) = (self.positions, Lanes::constant(ends.h));
        let last = last_term(self.h_before / ends.h);
        let per_slope = Lanes::constant(1.0 / at_inside(&last)[2]);
        let last = each(last, Lanes::constant);
        let half = Lanes::constant(0.5) * h;
        let (of_q, of_rates) = self.polynomials.split_at_mut(p.div_ceil(Lanes::WIDTH));
        for (b, (block, rates)) in self.blocks.iter_mut().zip(of_rates).enumerate() {
            let first = b * Lanes::WIDTH;
            let ([rate, slope], c) = (block.begin, &mut block.c);
            let g = (lanes(&inside[p + first..]) - block.inside) * per_slope;
            c[6] = Lanes::zero();
            for (c, last) in c.iter_mut().zip(last) {
                *c = c.plus_product(g, last);
            }
            (rates[0], rates[1], rates[DEGREE]) = (rate, slope, Lanes::zero());
            for (k, (to, c)) in (3..).map(f64::from).zip(rates[2..].iter_mut().zip(&*c)) {
                *to = Lanes::constant(k) * *c;
            }
            if let Some(q) = of_q.get_mut(b) {
                (q[0], q[1], q[2]) = (lanes(&ends.y_old[first..]), rate, half * slope);
                q[3..].iter_mut().zip(&*c).for_each(|(to, c)| *to = h * *c);
            }
        }
    }

    /// The completed interpolant.
    #[inline]
    pub fn interpolant(&self) -> Interpolant<'_> {
        let (q, rates) = self.polynomials.split_at(self.positions.div_ceil(Lanes::WIDTH));
        Interpolant::polynomials(Polynomials { q, rates, positions: self.positions })
    }
}

/// The first four numbers, padded with zeros.
#[inline(always)]
fn lanes(x: &[f64]) -> Lanes {
    match x.first_chunk() {
        Some(block) => Lanes::new(*block),
        None => Lanes::new(indexed(|k| x.get(k).copied().unwrap_or(0.0))),
    }
}

/// The factors 1 / x³, 3 / x, 6 / x and 12 / x² for a node x.
#[derive(Clone, Copy)]
struct Cube([Lanes; 4]);

impl Cube {
    #[inline(always)]
    fn new(x: f64) -> Self {
        let over = 1.0 / x;
        let square = over * over;
        Self(each([square * over, 3.0 * over, 6.0 * over, 12.0 * square], Lanes::constant))
    }

    /// Value, first and second derivative of a function divided by the cube of its argument.
    #[inline(always)]
    fn under(&self, [f, df, ddf]: [Lanes; 3]) -> [Lanes; 3] {
        let [cube, three, six, twelve] = self.0;
        let second = ddf.minus_product(six, df).plus_product(twelve, f);
        [f * cube, df.minus_product(three, f) * cube, second * cube]
    }
}

/// The nodes at which a polynomial is known: 1 and -r.
#[derive(Clone, Copy)]
struct Nodes {
    end: Cube,
    before: Cube,
    /// The difference of the two nodes.
    between: Cube,
    x: Lanes,
    r: Lanes,
}

impl Nodes {
    #[inline(always)]
    fn new(r: f64) -> Self {
        let [end, before, between] = each([1.0, -r, -r - 1.0], Cube::new);
        Self { end, before, between, x: Lanes::constant(-r - 1.0), r: Lanes::constant(r) }
    }

    /// Coefficients of θ³ … θ⁸ of the polynomial with the given values and derivatives at the nodes.
    #[inline(always)]
    fn through(&self, end: [Lanes; 3], before: [Lanes; 3]) -> [Lanes; 6] {
        let half = Lanes::constant(0.5);
        let [s0, s1, twice] = self.end.under(end);
        let [f, df, ddf] = self.before.under(before);
        let s2 = half * twice;
        let left = [
            (f - s0).minus_product(self.x, s1.plus_product(self.x, s2)),
            (df - s1).minus_product(self.x, twice),
            ddf - twice,
        ];
        let [u0, u1, u2] = self.between.under(left);
        let mut c = [Lanes::zero(); 6];
        c[0] = half * u2;
        // multiply by (θ - node) and add the next coefficient of Newton's form
        let (r, one) = (-self.r, Lanes::one());
        let next = [(r, u1), (r, u0), (one, s2), (one, s1), (one, s0)];
        for (degree, (node, number)) in (1..).zip(next) {
            for k in (1..=degree).rev() {
                c[k] = c[k - 1].minus_product(node, c[k]);
            }
            c[0] = number.minus_product(node, c[0]);
        }
        c
    }
}

/// Coefficients of θ³ … θ⁹ of θ³ (θ - 1)³ (θ + r)³.
fn last_term(r: f64) -> [f64; 7] {
    // (θ² + b θ - r)³
    let b = r - 1.0;
    let (square, cube) = (b * b, b * b * b);
    [
        -r * r * r,
        3.0 * b * r * r,
        3.0 * r * (r - square),
        cube - 6.0 * b * r,
        3.0 * (square - r),
        3.0 * b,
        1.0,
    ]
}

/// Value, first and second derivative at [`INSIDE`] of a polynomial with the coefficients `c` of θ³, θ⁴, ….
#[inline(always)]
fn at_inside<R: Real>(c: &[R]) -> [R; 3] {
    let (theta, mut power) = (INSIDE, 1.0);
    let mut sums = [R::zero(); 3];
    for (k, c) in (3..).map(f64::from).zip(c) {
        // power is θ^(k - 3)
        let weights = [theta * theta * theta, k * theta * theta, k * (k - 1.0) * theta];
        for (sum, weight) in sums.iter_mut().zip(weights) {
            *sum = sum.plus_product(R::constant(weight * power), *c);
        }
        power *= theta;
    }
    sums
}
