//! The derivatives of eigenvalues of the linear equations at a state at rest.
//!
//! With an eigenvalue s, the motion x = (q, v, a, λ) solves the linear rows
//!
//! ```text
//! Φ_q q = 0     (Φ_q v)′ = 0     (Φ_q a - γ)′ = 0     (M a + Φ_qᵀ λ - Q)′ = 0     v_u = s q_u     a_u = s v_u
//! ```
//!
//! where ′ is the derivative along x, and u are the independent coordinates. The left vector consists of one
//! multiplier for each row: μ, ν, κ, w, α and β. It makes the sum G of all rows times their multipliers stationary in
//! x, so that ds = -∂G/∂p / ∂G/∂s: the change of x does not count. ∂G/∂p contains second derivatives of the equations
//! along x and along the change of the state with p.

use crate::analyses::linearization::{LeastNorm, StatePoint, Variation};
use crate::equations::kinematics::Motions;
use crate::equations::mass;
use crate::equations::second::{of_forces, Direction};
use crate::equations::sensitivity::{constants, Sensitivity, Slope};
use crate::math::{Complex, Field, Jet, Listed, Real, ShortArray};
use crate::model::{column_scales, Model};
use std::sync::Arc;

/// A complex vector.
pub(super) type Vector = Vec<Complex>;

/// The linear equations at a state.
pub(super) struct ModeEquations<'a> {
    pub model: &'a Model,
    pub t: f64,
    /// q, v and a.
    pub at: [Vec<f64>; 3],
    /// N by columns, and the independent coordinates.
    basis: Vec<Vec<f64>>,
    columns: Vec<usize>,
    factors: LeastNorm<'a>,
    motions: Motions,
    /// The derivatives of M a + Φ_qᵀ λ - Q by each coordinate and each rate, and those of Φ_q a - γ by each coordinate.
    by: [Vec<Vec<f64>>; 2],
    bent: Vec<Vec<f64>>,
}

/// A motion with an eigenvalue.
pub(super) struct RightMode {
    q: Vector,
    v: Vector,
    a: Vector,
    lam: Vector,
}

/// The multipliers of the rows.
pub(super) struct LeftMode {
    mu: Vector,
    nu: Vector,
    kappa: Vector,
    w: Vector,
    alpha: Vector,
    beta: Vector,
}

impl<'a> ModeEquations<'a> {
    /// The equations at a state at rest. None if Φ_q loses rank there.
    pub fn new(
        model: &'a Model,
        t: f64,
        (at, lam): ([Vec<f64>; 3], &[f64]),
        (basis, columns): (Vec<Vec<f64>>, Vec<usize>),
    ) -> Option<Self> {
        let [q, v, a] = &at;
        let factors = LeastNorm::new(model, t, q, model.allow_redundancy).ok()?;
        let motions = Motions::at(&model.layout, q, v);
        let variation = Variation::new(model, t, StatePoint { q, v, z: &[], a, lam }, false);
        let (mut by, mut bent) = ([Vec::new(), Vec::new()], Vec::new());
        let mut unit = vec![0.0; q.len()];
        for column in 0..q.len() {
            unit[column] = 1.0;
            let of_q = variation.along(StatePoint { q: &unit, ..StatePoint::default() });
            let of_v = variation.along(StatePoint { v: &unit, ..StatePoint::default() });
            by[0].push(of_q.forces);
            by[1].push(of_v.forces);
            bent.push(of_q.accelerations);
            unit[column] = 0.0;
        }
        Some(Self { model, t, at, basis, columns, factors, motions, by, bent })
    }

    /// The motion of all coordinates with given independent ones.
    pub fn right(&self, s: Complex, xi: &[Complex]) -> RightMode {
        let q = combined(&self.basis, xi);
        let v = scaled(s, &q);
        let bent = combined(&self.bent, &q);
        let mut a = real(&bent, |bent| {
            let mut x = self.factors.least(&bent.iter().map(|x| -x).list());
            for (motion, own) in self.basis.iter().zip(&self.columns) {
                let part = x[*own];
                x.iter_mut().zip(motion).for_each(|(x, n)| *x -= part * n);
            }
            x
        });
        a.iter_mut().zip(scaled(s, &v)).for_each(|(a, more)| *a += more);
        let parts = [self.mass(&a), combined(&self.by[0], &q), combined(&self.by[1], &v)];
        let lam = self.balancing(sum(&parts));
        RightMode { q, v, a, lam }
    }

    /// The multipliers of all rows with given ones of the independent coordinates.
    pub fn left(&self, s: Complex, zeta: &[Complex]) -> LeftMode {
        let w = combined(&self.basis, zeta);
        let b = self.mass(&w);
        let beta = self.reduced(&b);
        let by_v = products(&self.by[1], &w);
        let s_beta = scaled(s, &beta);
        let alpha = sum(&[s_beta.clone(), self.reduced(&by_v)]);
        let kappa = self.balancing(sum(&[b, self.extended(&beta)]));
        let rest = sum(&[alpha.clone(), negative(&s_beta)]);
        let nu = self.balancing(sum(&[by_v, self.extended(&rest)]));
        let by_q = sum(&[products(&self.by[0], &w), products(&self.bent, &kappa)]);
        let mu = self.balancing(sum(&[by_q, self.extended(&negative(&scaled(s, &alpha)))]));
        LeftMode { mu, nu, kappa, w, alpha, beta }
    }

    /// ∂G/∂s, and the sum of the magnitudes of its terms.
    pub fn by_s(&self, s: Complex, left: &LeftMode, xi: &[Complex]) -> (Complex, f64) {
        let mut found = (Complex::zero(), 0.0);
        for ((alpha, beta), xi) in left.alpha.iter().zip(&left.beta).zip(xi) {
            for term in [*alpha * *xi, s * *beta * *xi] {
                found = (found.0 - term, found.1 + term.magnitude());
            }
        }
        found
    }

    /// M x.
    fn mass(&self, x: &[Complex]) -> Vector {
        real(x, |x| {
            let mut y = vec![0.0; x.len()];
            mass::add_times(self.model, &self.motions, x, &mut y);
            y
        })
    }

    /// The multipliers λ with f + Φ_qᵀ λ = 0.
    fn balancing(&self, f: Vector) -> Vector {
        real(&negative(&f), |f| self.factors.multipliers(f))
    }

    /// -Nᵀ f.
    fn reduced(&self, f: &[Complex]) -> Vector {
        negative(&products(&self.basis, f))
    }

    /// Components of independent coordinates among those of all coordinates.
    fn extended(&self, alpha: &[Complex]) -> Vector {
        let mut x = vec![Complex::zero(); self.at[0].len()];
        self.columns.iter().zip(alpha).for_each(|(column, part)| x[*column] = *part);
        x
    }
}

/// The change of the equations with the variables of a block.
pub(super) struct Moved {
    pub over: Sensitivity,
    pub state: [Vec<Slope>; 2],
    /// For each variable: the model and the state along it, for a change of the size given.
    along: Vec<(Model<Jet>, [Vec<f64>; 3], f64)>,
}

impl Moved {
    /// The change of a state with the variables, whose magnitudes are `sizes`. `over` has the solution at the state.
    pub fn new(over: Sensitivity, state: [Vec<Slope>; 2], sizes: &[f64]) -> Self {
        let of = |(k, size): (usize, &f64)| {
            let rates = |x: &[Slope]| x.iter().map(|x| size * x.slope[k]).list();
            let numbers = &over.model.parameters;
            let jet = |p: &Slope| Jet::new(p.value, size * p.slope[k], 0.0);
            let numbers: Vec<Jet> = numbers.iter().map(jet).list();
            let model = Model::new(&Arc::clone(&over.model.blueprint), &numbers);
            (model, [rates(&state[0]), rates(&state[1]), rates(&over.a)], *size)
        };
        let along = sizes.iter().enumerate().map(of).list();
        Self { over, state, along }
    }

    /// Number of variables.
    pub fn count(&self) -> usize {
        self.along.len()
    }

    /// ∂G/∂p for each variable.
    pub fn change(
        &self,
        equations: &ModeEquations<'_>,
        right: &RightMode,
        left: &LeftMode,
    ) -> Vector {
        let mut found = vec![Complex::zero(); self.along.len()];
        let scales = column_scales(equations.model);
        let sizes = right.q.iter().zip(&scales).map(|(q, scale)| q.magnitude() / scale);
        let size = sizes.fold(0.0, f64::max);
        for (x, unit) in [(0, Complex::one()), (1, Complex::new(0.0, 1.0))] {
            let x = [&right.q, &right.v, &right.a, &right.lam].each(|of| part(of, x));
            let forces = self.forces(equations, [&x[0], &x[1], &x[2]], size);
            for (l, more) in [(0, unit), (1, unit * Complex::new(0.0, 1.0))] {
                let l = [&left.mu, &left.nu, &left.kappa, &left.w].each(|of| part(of, l));
                let rows = self.constraints(equations.t, &x, &l);
                for (k, found) in found.iter_mut().enumerate() {
                    let change = rows.slope[k] + dot(&forces[k], &l[3]);
                    *found += Complex::from_real(change) * more;
                }
            }
        }
        found
    }

    /// The second derivatives of M a - Q along a motion of a size, and along each variable.
    fn forces(&self, of: &ModeEquations<'_>, x: Direction<'_>, size: f64) -> Vec<Vec<f64>> {
        let ModeEquations { t, at, .. } = of;
        let [q, v, a] = x.each(|x| x.iter().map(|x| x / size).list());
        let at: Direction<'_> = [&at[0], &at[1], &at[2]];
        let of = |(model, y, own): &(Model<Jet>, [Vec<f64>; 3], f64)| {
            let y: Direction<'_> = [&y[0], &y[1], &y[2]];
            let mut found = of_forces(model, (*t, at), [&q, &v, &a], y);
            found.iter_mut().for_each(|x| *x *= size / own);
            found
        };
        self.along.iter().map(of).list()
    }

    /// The rows of the constraints, and Φ_qᵀ λ, along a motion, times their multipliers.
    fn constraints(&self, t: f64, [q, v, a, lam]: &[Vec<f64>; 4], l: &[Vec<f64>; 4]) -> Slope {
        let Self { over, state: [at_q, at_v], .. } = self;
        let [mu, nu, kappa, w] = l;
        let bent = |u: &[Slope], x: &[f64]| over.curvature((t, at_q), u, x);
        let constant = constants(w);
        let mut total = Slope::zero();
        let mut add = |rows: Vec<Slope>, factors: &[f64], times: f64| {
            for (row, factor) in rows.iter().zip(factors) {
                total += *row * Slope::constant(times * factor);
            }
        };
        add(over.times(q), mu, 1.0);
        add(over.times(v), nu, 1.0);
        add(bent(at_v, q), nu, 1.0);
        add(over.times(a), kappa, 1.0);
        add(bent(&over.a, q), kappa, 1.0);
        add(bent(at_v, v), kappa, 2.0);
        add(over.times(w), lam, 1.0);
        let rows = bent(&constant, q);
        rows.iter().zip(&over.lam).for_each(|(row, lam)| total += *row * *lam);
        total
    }
}

/// Σ cₖ xₖ over columns xₖ.
fn combined(columns: &[Vec<f64>], c: &[Complex]) -> Vector {
    let mut x = vec![Complex::zero(); columns.first().map_or(0, Vec::len)];
    for (column, c) in columns.iter().zip(c) {
        x.iter_mut().zip(column).for_each(|(x, n)| *x += Complex::from_real(*n) * *c);
    }
    x
}

/// The products of columns with a vector.
fn products(columns: &[Vec<f64>], x: &[Complex]) -> Vector {
    let of = |column: &Vec<f64>| {
        let terms = column.iter().zip(x).map(|(n, x)| Complex::from_real(*n) * *x);
        terms.fold(Complex::zero(), |sum, term| sum + term)
    };
    columns.iter().map(of).list()
}

fn sum(parts: &[Vector]) -> Vector {
    let add = |k: usize| parts.iter().fold(Complex::zero(), |sum, part| sum + part[k]);
    (0..parts[0].len()).map(add).list()
}

fn scaled(s: Complex, x: &[Complex]) -> Vector {
    x.iter().map(|x| s * *x).list()
}

fn negative(x: &[Complex]) -> Vector {
    x.iter().map(|x| -*x).list()
}

/// The real or the imaginary part.
fn part(x: &[Complex], imaginary: usize) -> Vec<f64> {
    x.iter().map(|x| if imaginary == 1 { x.im } else { x.re }).list()
}

/// A real linear function of a complex vector.
fn real(x: &[Complex], f: impl Fn(&[f64]) -> Vec<f64>) -> Vector {
    let (re, im) = (f(&part(x, 0)), f(&part(x, 1)));
    re.iter().zip(&im).map(|(re, im)| Complex::new(*re, *im)).list()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
