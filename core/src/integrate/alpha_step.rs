//! One step of the generalized-α method at index 3. Newton's iteration solves for q and λ with Φ(q) = 0 at the end.
//!
//! Let x be the change of q. With the balance of forces multiplied by β h², the equations of the iteration are
//!
//! ```text
//! [ (1 - α_m)/(1 - α_f) M + γ h D + β h² K   Φ_qᵀ ] [    x    ]     [ β h² r ]
//! [ Φ_q                                       0   ] [ β h² Δλ ] = - [   Φ    ]
//! ```
//!
//! The condition number of this matrix does not grow as h decreases (Bottasso, Bauchau and Cardona,
//! *Time-step-size-independent conditioning and sensitivity to perturbations in the numerical solution of index three
//! differential algebraic equations*, SIAM J. Sci. Comput. 29 (2007) 397).
//!
//! The method has order 2 from the first step on, also for variable steps (Arnold, Brüls and Cardona, *Error analysis
//! of generalized-α Lie group time integration methods for constrained mechanical systems*, Numer. Math. 129 (2015)
//! 149). This requires two deviations to be carried from step to step. First, a approximates the acceleration at t +
//! Δ h, so that a - v̇ is proportional to h. Second, the velocities of the method deviate from the constraints by h²
//! C_q v̈, normal to them. The deviations are stored divided by h and by h². The reported velocities satisfy the
//! constraints.
//!
//! First-order states z are integrated as v is, with parameters that give the same damping
//! ([`AlphaParameters::of_states`]). Their variable w corresponds to a. Their changes are further unknowns after x.

use super::alpha_parameters::AlphaParameters;
use super::dae::{
    ConstraintLevel, Dae, DaeLengths, DaeResidual, DaeState, Iterate, NewtonCoefficients,
};
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::failure::Cause;
use super::implicit_state::{serves, ImplicitState};
use super::right_hand_side::all_finite;
use crate::math::ShortArray;

/// Largest number of iterations with one matrix.
const MOST: usize = 10;
/// Largest number of matrices in one step.
const MATRICES: usize = 3;
/// A matrix of an earlier step is replaced if one iteration does not reduce the error below this fraction.
const SLOW: f64 = 0.2;
/// Relative size of corrections that are rounding errors, compared with the largest coordinate.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Largest error that Newton's iteration may leave, as a fraction of the tolerance.
pub(super) const PART: f64 = 1e-2;

/// The quantities of v or of z that are carried from step to step: (a - v̇) / h, the rate of v̇ at the beginning of a
/// step, and the variable a, which replaces v̇ in the method, at both ends.
pub(super) struct Carried {
    pub shift: Vec<f64>,
    pub slope: Vec<f64>,
    start: Vec<f64>,
    end: Vec<f64>,
}

impl Carried {
    fn new(n: usize) -> Self {
        let row = || vec![0.0; n];
        Self { shift: row(), slope: row(), start: row(), end: row() }
    }

    /// Predicts the derivative at the end of the step and a at both ends by extrapolation. Returns the weighted mean
    /// of a that changes component i over the step, (1 - γ) a₀ + γ a₁.
    fn predict(&mut self, p: &AlphaParameters, h: f64, i: usize, rate: f64, end: &mut f64) -> f64 {
        self.start[i] = rate + h * self.shift[i];
        *end = rate + h * self.slope[i];
        self.end[i] = ((1.0 - p.alpha_f) * *end + p.alpha_f * rate - p.alpha_m * self.start[i])
            / (1.0 - p.alpha_m);
        (1.0 - p.gamma) * self.start[i] + p.gamma * self.end[i]
    }

    /// Stores the slope and the shift for the next step, from the derivatives at both ends of this one.
    fn move_on(&mut self, h: f64, old: &[f64], new: &[f64]) {
        for i in 0..self.slope.len() {
            self.slope[i] = (new[i] - old[i]) / h;
            self.shift[i] = (self.end[i] - new[i]) / h;
        }
    }
}

/// State and work memory of an integration.
pub(super) struct AlphaStep {
    pub parameters: AlphaParameters,
    /// The parameters for first-order states.
    pub of_states: AlphaParameters,
    /// The beginning of the step: q, and v on the constraints. Its field `a` stores v̇.
    pub start: ImplicitState,
    /// The end of the step: q, and v of the method. Its field `a` stores v̇.
    pub end: ImplicitState,
    /// The carried quantities of v and of z.
    pub carried: [Carried; 2],
    /// (v of the method - v) / h² at the beginning.
    pub normal: Vec<f64>,
    /// Length of the step from which the slopes were computed.
    pub h_before: f64,
    x: Vec<f64>,
    dv: Vec<f64>,
    /// Estimated errors of q, v and z.
    error: [Vec<f64>; 3],
    rows: Vec<f64>,
    /// Length of the step for which the current matrix was factorised.
    factored: Option<f64>,
    /// Whether the last step failed because the matrix was singular.
    pub singular: bool,
}

impl AlphaStep {
    pub fn new(parameters: AlphaParameters, lengths: DaeLengths) -> Self {
        let DaeLengths { coordinates: n, multipliers, states, .. } = lengths;
        Self {
            parameters,
            of_states: parameters.of_states(),
            start: ImplicitState::new(lengths),
            end: ImplicitState::new(lengths),
            carried: [n, states].each(Carried::new),
            normal: vec![0.0; n],
            h_before: 0.0,
            x: vec![0.0; lengths.unknowns()],
            dv: vec![0.0; n],
            error: [n, n, states].each(|len| vec![0.0; len]),
            rows: vec![0.0; multipliers],
            factored: None,
            singular: false,
        }
    }

    /// Discards the data of earlier steps after a change of the state.
    pub fn forget(&mut self) {
        self.factored = None;
        self.carried = self.carried.each_ref().each(|carried| Carried::new(carried.slope.len()));
        self.normal.fill(0.0);
        self.h_before = 0.0;
    }

    /// ∂z/∂ż at the end of a step.
    fn state_share(&self, h: f64) -> f64 {
        h * self.of_states.gamma / self.of_states.acceleration_share()
    }

    fn coefficients(&self, h: f64) -> NewtonCoefficients {
        let AlphaParameters { beta, gamma, .. } = self.parameters;
        let state = self.state_share(h);
        NewtonCoefficients {
            mass: self.parameters.acceleration_share(),
            damping: gamma * h,
            stiffness: beta * h * h,
            rate: 0.0,
            state_force: beta * h * h,
            state_velocity: state * gamma / (beta * h),
            state_position: state,
            state_rate: state,
        }
    }

    /// Factorises the matrix at the beginning of a step, for [`filter`](Self::filter).
    pub fn factor_at_start<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        t: f64,
        h: f64,
    ) -> bool {
        system.linearize(t, self.start.iterate());
        self.factored = None;
        system.factor(self.coefficients(h))
    }

    /// Computes the state at t + h into `end`. Returns whether Newton's iteration converged.
    pub fn advance<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &mut ErrorWeights,
    ) -> bool {
        self.predict(h);
        let reusable = serves(self.factored, h);
        if reusable && self.newton(system, (t, h), scale, SLOW) {
            return true;
        }
        self.predict(h);
        system.linearize(t + h, self.end.iterate());
        for _ in 0..MATRICES {
            let factored = system.factor(self.coefficients(h));
            self.factored = factored.then_some(h);
            self.singular = !factored;
            if factored && self.newton(system, (t, h), scale, 0.9) {
                return true;
            }
            let ImplicitState { q, v, a, lam, .. } = &self.end;
            if !factored || ![q, v, a, lam].into_iter().all(|x| all_finite(x)) {
                break;
            }
            // forces may have a kink between the prediction and the end
            system.linearize(t + h, self.end.iterate());
        }
        self.factored = None;
        false
    }

    /// Predicts the end of the step by extrapolation of v̇ and ż.
    fn predict(&mut self, h: f64) {
        let (p, p_z) = (self.parameters, self.of_states);
        let Self { start, end, normal, carried: [of_v, of_z], .. } = self;
        for (i, normal) in normal.iter().enumerate() {
            let mean = of_v.predict(&p, h, i, start.a[i], &mut end.a[i]);
            let v = start.v[i] + h * h * normal;
            let bend = (0.5 - p.beta) * of_v.start[i] + p.beta * of_v.end[i];
            end.q[i] = start.q[i] + h * (v + h * bend);
            end.v[i] = v + h * mean;
        }
        for i in 0..start.z.len() {
            end.z[i] = start.z[i] + h * of_z.predict(&p_z, h, i, start.dz[i], &mut end.dz[i]);
        }
        end.lam.copy_from_slice(&start.lam);
    }

    fn newton<Y: Dae + ?Sized>(
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

    /// Corrects `end` by one iteration. Returns the norm of the correction.
    fn correct<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        t: f64,
        h: f64,
        scale: &mut ErrorWeights,
    ) -> f64 {
        let AlphaParameters { beta, gamma, .. } = self.parameters;
        system.counts.iterations += 1;
        self.evaluate(system, t);
        let (n, square, share) = (self.dv.len(), beta * h * h, self.state_share(h));
        let Self { x, rows, end, dv, carried: [of_v, of_z], parameters, of_states, .. } = self;
        let both = n + end.z.len();
        x[..n].iter_mut().for_each(|x| *x *= -square);
        x[n..both].iter_mut().for_each(|x| *x *= -share);
        x[both..].iter_mut().zip(rows.iter()).for_each(|(x, phi)| *x = -phi);
        system.system.solve(x);
        let to_rate = parameters.acceleration_share() / square;
        for i in 0..n {
            dv[i] = gamma / (beta * h) * x[i];
            end.q[i] += x[i];
            end.v[i] += dv[i];
            end.a[i] += to_rate * x[i];
            of_v.end[i] += x[i] / square;
        }
        for (i, x) in x[n..both].iter().enumerate() {
            end.z[i] += x;
            end.dz[i] += x / share;
            of_z.end[i] += x / (h * of_states.gamma);
        }
        end.lam.iter_mut().zip(&x[both..]).for_each(|(lam, x)| *lam += x / square);
        scale.set(&self.start, &self.end);
        scale.norm(&self.x[..n], &self.dv, &self.x[n..both])
    }

    /// Computes the residuals at `end`: those of the forces and states into the first parts of x, and Φ into `rows`.
    pub fn evaluate<Y: Dae + ?Sized>(&mut self, system: &mut CountedDae<'_, Y>, t: f64) {
        let (forces, rest) = self.x.split_at_mut(self.dv.len());
        let states = &mut rest[..self.end.z.len()];
        let ImplicitState { q, v, a, lam, z, dz, powers } = &mut self.end;
        let out = DaeResidual { forces, states, rows: &mut self.rows, powers };
        system.residual(t, Iterate { q, v, a, lam, z, dz }, ConstraintLevel::Position, out);
    }

    /// The estimated error of the step relative to its tolerance: C_q h² (a₁ - a₀) for q and C_v h³ v⃛ for v, with v⃛
    /// from the last three accelerations. The parts normal to the constraints are removed, because the constraints
    /// prevent such errors. The error of z is estimated in the same way as that of v. Stiff motions are not filtered
    /// out, because oscillations of a enter q.
    pub fn error<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        h: f64,
        scale: &ErrorWeights,
    ) -> f64 {
        let (c_q, c_v) = (self.parameters.position_error(), self.parameters.velocity_error());
        let c_z = self.of_states.velocity_error();
        let span = 0.5 * (h + self.h_before);
        let Self { start, end, carried: [of_v, of_z], error: [of_q, error_v, error_z], .. } = self;
        // the jerk is a difference of v̇; the variable a of the method is less smooth where the step changes
        let jerk = |change: f64, slope: f64| h * h * h * (change / h - slope) / span;
        for i in 0..self.dv.len() {
            let change = end.a[i] - start.a[i];
            of_q[i] = c_q * h * h * change;
            error_v[i] = c_v * jerk(change, of_v.slope[i]);
        }
        for (i, error) in error_z.iter_mut().enumerate() {
            *error = c_z * jerk(end.dz[i] - start.dz[i], of_z.slope[i]);
        }
        // if the constraints determine the whole motion, only the unprojected error shows that a step is too long
        let whole = scale.norm(of_q, &[], &[]);
        for x in [of_q, error_v] {
            self.dv.copy_from_slice(x);
            system.system.normal(&mut self.dv);
            x.iter_mut().zip(&self.dv).for_each(|(x, normal)| *x -= normal);
        }
        let [dq, dv, dz] = &self.error;
        let along = scale.norm(dq, dv, dz);
        if whole > scale.far() {
            along.max(whole)
        } else {
            along
        }
    }

    /// The norm of corrections that contain only rounding errors. The correction of q is compared with the largest
    /// component of q, since every constraint is a sum over several components. The correction of v is that of q
    /// multiplied by γ / (β h).
    pub fn rounding(&self, h: f64, scale: &mut ErrorWeights) -> f64 {
        let AlphaParameters { beta, gamma, .. } = self.parameters;
        scale.set(&self.start, &self.end);
        let q = ROUNDING * self.start.q.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
        let v = gamma / (beta * h.abs()) * q;
        let n = self.dv.len();
        let by_z = self.end.z.iter().map(|z| ROUNDING * z.abs());
        let sizes = std::iter::repeat_n(q, n).chain(std::iter::repeat_n(v, n)).chain(by_z);
        let parts = sizes.zip(&scale.weights).filter(|(_, w)| **w > 0.0);
        let sum: f64 = parts.map(|(x, w)| (x / w) * (x / w)).sum();
        (sum / scale.weights.len() as f64).sqrt()
    }

    /// Solves for (x, y) with the right side (M x (1 - α_m)/(1 - α_f), y, 0), in place. The result contains the rates
    /// without those of stiff motions; Φ_q x = 0.
    pub fn filter<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        x: &mut [f64],
        y: &mut [f64],
    ) {
        let n = x.len();
        let share = self.parameters.acceleration_share();
        self.dv.fill(0.0);
        system.system.times(x, y, &self.dv, &mut self.x);
        self.x[..n].iter_mut().for_each(|x| *x *= share);
        system.system.solve(&mut self.x);
        x.copy_from_slice(&self.x[..n]);
        y.copy_from_slice(&self.x[n..n + y.len()]);
    }

    /// Projects the end onto the constraints. Keeps the normal part of its velocities for the next step, which may
    /// have another length: a deviation that belongs to h would grow in longer steps.
    pub fn project<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
    ) -> Result<bool, Cause<Y::Stop>> {
        let ImplicitState { q, v, z, .. } = &mut self.end;
        self.normal.copy_from_slice(v);
        let state = DaeState { q, v, z };
        let changed = system.project(t + h, state, true)?;
        for (normal, v) in self.normal.iter_mut().zip(&self.end.v) {
            *normal = (*normal - v) / (h * h);
        }
        Ok(changed)
    }

    /// Whether all numbers at the end are finite.
    pub fn finite(&self) -> bool {
        let ImplicitState { q, v, a, lam, z, dz, powers } = &self.end;
        [q, v, a, lam, z, dz, powers].into_iter().all(|x| all_finite(x))
    }

    /// Makes the end the beginning of the next step.
    pub fn move_on(&mut self, h: f64) {
        let Self { start, end, carried: [of_v, of_z], .. } = self;
        of_v.move_on(h, &start.a, &end.a);
        of_z.move_on(h, &start.dz, &end.dz);
        self.h_before = h;
        self.start.copy_from(&self.end);
    }
}
