//! One step of the generalized-α method at index 3: Φ(q) = 0 at its end, Newton's iteration for q and λ.
//!
//! With x the change of q the matrix, its balance of forces multiplied by β h², is
//!
//! ```text
//! [ (1 - α_m)/(1 - α_f) M + γ h D + β h² K   Φ_qᵀ ] [    x    ]     [ β h² r ]
//! [ Φ_q                                       0   ] [ β h² Δλ ] = - [   Φ    ]
//! ```
//!
//! so that its condition does not grow as h falls (Bottasso, Bauchau and Cardona, *Time-step-size-
//! independent conditioning and sensitivity to perturbations in the numerical solution of index three
//! differential algebraic equations*, SIAM J. Sci. Comput. 29 (2007) 397).
//!
//! What makes order 2 hold from the first step and for steps that change (Arnold, Brüls and Cardona,
//! *Error analysis of generalized-α Lie group time integration methods for constrained mechanical
//! systems*, Numer. Math. 129 (2015) 149): a belongs to t + Δ h, so a - v̇ is proportional to h; and the
//! velocities that step from constraint to constraint are off them by h² C_q v̈, normal to them. Both are
//! carried from step to step over h and h², the velocities themselves on the constraints.

use super::alpha_parameters::AlphaParameters;
use super::dae::{ConstraintLevel, Dae, DaeResidual, Iterate, NewtonCoefficients};
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::implicit_state::ImplicitState;
use super::right_hand_side::all_finite;

/// Most iterations with one matrix.
const MOST: usize = 10;
/// A matrix of an earlier step that lowers the error by less is renewed.
const SLOW: f64 = 0.2;
/// Steps that differ by less share a matrix: a difference of times is never twice the same.
const SAME: f64 = 1e-6;
/// Corrections below this part of the largest coordinate are rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Part of the tolerance that Newton's iteration may leave.
const PART: f64 = 1e-2;

/// State and memory of a run.
pub(super) struct AlphaStep {
    pub parameters: AlphaParameters,
    /// The beginning: q, v on the constraints, a = v̇.
    pub start: ImplicitState,
    /// The end: q, v of the method, a = v̇.
    pub end: ImplicitState,
    /// (a - v̇) / h, (v of the method - v) / h², and the rate of a, at the beginning.
    pub shift: Vec<f64>,
    pub normal: Vec<f64>,
    pub slope: Vec<f64>,
    /// The step that `slope` was found over.
    pub h_before: f64,
    a_start: Vec<f64>,
    a_end: Vec<f64>,
    x: Vec<f64>,
    dv: Vec<f64>,
    /// Estimated errors of q and v.
    error: [Vec<f64>; 2],
    rows: Vec<f64>,
    /// The step for which the matrix at hand was made.
    factored: Option<f64>,
    /// Whether the last failure was that of a factorisation.
    pub singular: bool,
}

impl AlphaStep {
    pub fn new(parameters: AlphaParameters, n: usize, m: usize, works: usize) -> Self {
        let row = || vec![0.0; n];
        Self {
            parameters,
            start: ImplicitState::new(n, m, works),
            end: ImplicitState::new(n, m, works),
            shift: row(),
            normal: row(),
            slope: row(),
            h_before: 0.0,
            a_start: row(),
            a_end: row(),
            x: vec![0.0; n + m],
            dv: row(),
            error: [row(), row()],
            rows: vec![0.0; m],
            factored: None,
            singular: false,
        }
    }

    fn coefficients(&self, h: f64) -> NewtonCoefficients {
        let AlphaParameters { beta, gamma, .. } = self.parameters;
        NewtonCoefficients {
            mass: self.parameters.acceleration_share(),
            damping: gamma * h,
            stiffness: beta * h * h,
            rate: 0.0,
        }
    }

    /// Makes the matrix at the beginning of a step, for [`filter`](Self::filter).
    pub fn factor_at_start<Y: Dae>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        t: f64,
        h: f64,
    ) -> bool {
        system.linearize(t, self.start.point());
        self.factored = None;
        system.factor(self.coefficients(h))
    }

    /// The state at t + h into `end`; whether Newton's iteration converged.
    pub fn advance<Y: Dae>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &mut ErrorWeights,
    ) -> bool {
        self.predict(h);
        let at_hand = self.factored.is_some_and(|made_for| (made_for - h).abs() <= SAME * h.abs());
        if at_hand && self.newton(system, (t, h), scale, SLOW) {
            return true;
        }
        self.predict(h);
        system.linearize(t + h, self.end.point());
        let factored = system.factor(self.coefficients(h));
        self.factored = factored.then_some(h);
        self.singular = !factored;
        let converged = factored && self.newton(system, (t, h), scale, 0.9);
        if !converged {
            self.factored = None;
        }
        converged
    }

    /// First guess: v̇ goes on changing as before.
    fn predict(&mut self, h: f64) {
        let AlphaParameters { alpha_m, alpha_f, beta, gamma } = self.parameters;
        let Self { start, end, shift, normal, slope, a_start, a_end, .. } = self;
        for i in 0..start.q.len() {
            let a = start.a[i];
            a_start[i] = a + h * shift[i];
            end.a[i] = a + h * slope[i];
            a_end[i] =
                ((1.0 - alpha_f) * end.a[i] + alpha_f * a - alpha_m * a_start[i]) / (1.0 - alpha_m);
            let v = start.v[i] + h * h * normal[i];
            end.q[i] = start.q[i] + h * (v + h * ((0.5 - beta) * a_start[i] + beta * a_end[i]));
            end.v[i] = v + h * ((1.0 - gamma) * a_start[i] + gamma * a_end[i]);
        }
        end.lam.copy_from_slice(&start.lam);
    }

    fn newton<Y: Dae>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &mut ErrorWeights,
        slow: f64,
    ) -> bool {
        let mut last = f64::INFINITY;
        let enough = PART.max(self.rounding(h, scale));
        for iteration in 0..MOST {
            let norm = self.correct(system, t + h, h, scale);
            let rate = norm / last;
            if !norm.is_finite() || (norm > enough && rate > slow.min(1.0)) {
                return false;
            }
            let left = match iteration {
                0 => 10.0 * norm,
                _ if rate < 0.5 => norm * rate / (1.0 - rate),
                _ => norm,
            };
            if left <= enough {
                return true;
            }
            last = norm;
        }
        false
    }

    /// One correction of `end`; its norm.
    fn correct<Y: Dae>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        t: f64,
        h: f64,
        scale: &mut ErrorWeights,
    ) -> f64 {
        let AlphaParameters { beta, gamma, .. } = self.parameters;
        system.counts.iterations += 1;
        self.evaluate(system, t);
        let n = self.dv.len();
        let square = beta * h * h;
        let Self { x, rows, end, dv, a_end, parameters, .. } = self;
        x[..n].iter_mut().for_each(|x| *x *= -square);
        x[n..].iter_mut().zip(rows.iter()).for_each(|(x, phi)| *x = -phi);
        system.system.solve(x);
        let to_rate = parameters.acceleration_share() / square;
        for i in 0..n {
            dv[i] = gamma / (beta * h) * x[i];
            end.q[i] += x[i];
            end.v[i] += dv[i];
            end.a[i] += to_rate * x[i];
            a_end[i] += x[i] / square;
        }
        end.lam.iter_mut().zip(&x[n..]).for_each(|(lam, x)| *lam += x / square);
        scale.set(&self.start, &self.end);
        scale.norm(&self.x[..n], &self.dv)
    }

    /// Residuals at `end`: forces into the first part of x, Φ into `rows`.
    fn evaluate<Y: Dae>(&mut self, system: &mut CountedDae<'_, Y>, t: f64) {
        let n = self.dv.len();
        let ImplicitState { q, v, a, lam, powers } = &mut self.end;
        let out = DaeResidual { forces: &mut self.x[..n], rows: &mut self.rows, powers };
        system.residual(t, Iterate { q, v, a, lam }, ConstraintLevel::Position, out);
    }

    /// The estimated error of the step over its tolerance: C_q h² (a₁ - a₀) for q and C_v h³ v⃛ for v,
    /// v⃛ from the last three accelerations; both without their part normal to the constraints, which the
    /// constraints themselves prevent. Stiff motions are not filtered out: what rings in a enters q.
    pub fn error<Y: Dae>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        h: f64,
        scale: &ErrorWeights,
    ) -> f64 {
        let n = self.dv.len();
        let (c_q, c_v) = (self.parameters.position_error(), self.parameters.velocity_error());
        let span = 0.5 * (h + self.h_before);
        for i in 0..n {
            let change = self.change(i);
            self.error[0][i] = c_q * h * h * change;
            self.error[1][i] = c_v * h * h * h * (change / h - self.slope[i]) / span;
        }
        for x in &mut self.error {
            self.dv.copy_from_slice(x);
            system.system.normal(&mut self.dv);
            x.iter_mut().zip(&self.dv).for_each(|(x, normal)| *x -= normal);
        }
        scale.norm(&self.error[0], &self.error[1])
    }

    /// v̇₁ - v̇₀ of one component. (Of a it would be less smooth where the step changes.)
    fn change(&self, i: usize) -> f64 {
        self.end.a[i] - self.start.a[i]
    }

    /// The norm of corrections that are rounding alone: of q relative to its largest component, since
    /// the constraints are sums of all of them; of v that over h.
    fn rounding(&self, h: f64, scale: &mut ErrorWeights) -> f64 {
        let AlphaParameters { beta, gamma, .. } = self.parameters;
        scale.set(&self.start, &self.end);
        let q = ROUNDING * self.start.q.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
        let v = gamma / (beta * h.abs()) * q;
        let (by_q, by_v) = scale.weights.split_at(self.dv.len());
        let sum = |x: f64, weights: &[f64]| -> f64 {
            weights.iter().filter(|w| **w > 0.0).map(|w| (x / w) * (x / w)).sum()
        };
        ((sum(q, by_q) + sum(v, by_v)) / scale.weights.len() as f64).sqrt()
    }

    /// x ← the solution of [S Φ_qᵀ; Φ_q 0] with M x (1 - α_m)/(1 - α_f) on the right.
    pub fn filter<Y: Dae>(&mut self, system: &mut CountedDae<'_, Y>, x: &mut [f64]) {
        let n = x.len();
        let share = self.parameters.acceleration_share();
        self.dv.fill(0.0);
        system.system.times(x, &self.dv, &mut self.x);
        self.x[..n].iter_mut().for_each(|x| *x *= share);
        system.system.solve(&mut self.x);
        x.copy_from_slice(&self.x[..n]);
    }

    /// Puts the end onto the constraints; the normal part of its velocities is kept for the next step.
    pub fn project<Y: Dae>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
    ) -> Result<bool, Y::Stop> {
        let ImplicitState { q, v, .. } = &mut self.end;
        self.normal.copy_from_slice(v);
        let changed = system.system.project(t + h, q, v)?;
        for (normal, v) in self.normal.iter_mut().zip(v.iter()) {
            *normal = (*normal - v) / (h * h);
        }
        self.evaluate(system, t + h); // for the powers
        Ok(changed)
    }

    /// Whether the end is finite.
    pub fn finite(&self) -> bool {
        let ImplicitState { q, v, a, lam, powers } = &self.end;
        [q, v, a, lam, powers].into_iter().all(|x| all_finite(x))
    }

    /// The end becomes the beginning of the next step.
    pub fn move_on(&mut self, h: f64) {
        for i in 0..self.dv.len() {
            self.slope[i] = self.change(i) / h;
            self.shift[i] = (self.a_end[i] - self.end.a[i]) / h;
        }
        self.h_before = h;
        self.start.copy_from(&self.end);
    }
}
