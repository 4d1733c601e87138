//! Derivatives of accelerations and multipliers with respect to parameters (direct differentiation; Haug 6.3.18
//! differentiated).
//!
//! With r(a, λ; q, v, z, p) = M a + Φ_qᵀ λ - Q and s = Φ_q a - γ, the derivatives a′ and λ′ satisfy
//! K (a′, λ′) = -(r′, s′), where r′ and s′ are the derivatives at constant a and λ, and K is the matrix of the
//! equations of motion. r and s are evaluated over dual numbers; K and its factors belong to the motion.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::powers::Powers;
use super::{constraints, mass, reactions, reactive, Compiled, Workspace};
use crate::math::{Dual, Listed, Real, ShortArray};
use crate::model::Model;
use crate::solve::Breakdown;

/// A number with its derivatives with respect to [`ABREAST`] variables.
pub type Slope = Dual<ABREAST>;

/// Number of variables whose derivatives are computed at once. Value and derivatives fill a register.
pub const ABREAST: usize = 3;

/// Numbers without derivatives.
pub fn constants(x: &[f64]) -> Vec<Slope> {
    x.iter().map(|x| Slope::constant(*x)).list()
}

/// Numbers of which those from place `first` on, at most [`ABREAST`], are the variables.
pub fn variables_from(first: usize, x: &[f64]) -> Vec<Slope> {
    let mut numbers = constants(x);
    for (place, number) in numbers[first..].iter_mut().take(ABREAST).enumerate() {
        number.slope[place] = 1.0;
    }
    numbers
}

/// Largest number of corrections of a solution. Forces that depend on reactions need some.
const MOST: usize = 60;
/// Part of the solution below which a correction ends the iteration.
const SETTLED: f64 = 1e-14;
/// Part of the solution below which the last correction must be.
const ACCURATE: f64 = 1e-9;

/// The equations of motion over numbers with derivatives, and memory for their evaluation.
#[derive(Debug)]
pub struct Sensitivity {
    /// The model, whose numbers have derivatives.
    pub model: Model<Slope>,
    /// Motion of every body at the last state, ground first.
    pub motions: Motions<Slope>,
    /// a, shape (n_q).
    pub a: Vec<Slope>,
    /// λ, shape (n_rows).
    pub lam: Vec<Slope>,
    /// Powers of forces and drivers.
    pub powers: Powers<Slope>,
    compiled: Compiled<Slope>,
    /// Φ_q at the last state.
    pub(super) jacobian: Vec<Slope>,
    /// Φ, Φ_q v + Φ_t and γ at the last state.
    terms: [Vec<Slope>; 3],
    applied: Vec<Slope>,
    /// (r, s), shape (n_q + n_rows).
    residual: Vec<Slope>,
    /// Whether forces, and forces or loads of joints depend on multipliers.
    depends: [bool; 2],
}

impl Sensitivity {
    /// Memory for a model.
    pub fn new(model: Model<Slope>) -> Self {
        let (n, m, zero) = (model.layout.n_q, model.layout.n_rows, Slope::constant(0.0));
        let depends = reactive::depends(&model);
        Self {
            motions: Motions::new(&model.layout),
            a: vec![zero; n],
            lam: vec![zero; m],
            powers: Powers::zero(),
            compiled: Compiled::new(&model),
            jacobian: vec![zero; model.layout.n_entries],
            terms: [(); 3].each(|()| vec![zero; m]),
            applied: vec![zero; n],
            residual: vec![zero; n + m],
            depends: [depends, depends || reactions::loaded(&model).next().is_some()],
            model,
        }
    }

    /// Sets positions, rates and the pieces of switches without solving the equations of motion; a and λ are unknown.
    pub fn place(&mut self, q: &[Slope], v: &[Slope], pieces: &[f64]) {
        self.motions.place(&self.model.layout, q, v);
        self.motions.pieces.clear();
        self.motions.pieces.extend_from_slice(pieces);
        self.a.fill(Slope::constant(f64::NAN));
        self.lam.fill(Slope::constant(f64::NAN));
    }

    /// Computes a, λ and the powers with their derivatives. `workspace` contains the solution at the values of this
    /// state.
    ///
    /// # Errors
    /// [`Breakdown`] of a correction; [`Breakdown::Reaction`] if forces depend on reactions so strongly that the
    /// derivatives are not found.
    pub fn respond(
        &mut self,
        (base, workspace): (&Model, &mut Workspace),
        t: Slope,
        state: [&[Slope]; 3],
    ) -> Result<(), Breakdown> {
        self.motions.place(&self.model.layout, state[0], state[1]);
        self.motions.pieces.clone_from(&workspace.motions.pieces);
        self.linearize(t);
        self.a.iter_mut().zip(workspace.a()).for_each(|(a, x)| *a = Slope::constant(*x));
        self.lam.iter_mut().zip(workspace.lam()).for_each(|(lam, x)| *lam = Slope::constant(*x));
        let (mut last, mut x) = (f64::INFINITY, Vec::new());
        for turn in 0.. {
            self.put_residual(t, state[2], self.depends[1]);
            let (mut change, mut size) = (0.0_f64, 0.0_f64);
            for k in 0..ABREAST {
                x.clear();
                x.extend(self.residual.iter().map(|r| -r.slope[k]));
                workspace.solve(base, &mut x)?;
                for (to, dx) in self.a.iter_mut().chain(&mut self.lam).zip(&x) {
                    to.slope[k] += dx;
                    (change, size) = (change.max(dx.abs()), size.max(to.slope[k].abs()));
                }
            }
            let relative = if change == 0.0 { 0.0 } else { change / size };
            if !self.depends[1] || relative <= SETTLED {
                return Ok(());
            }
            if turn > 2 && relative >= 0.5 * last || turn == MOST {
                break;
            }
            last = relative;
        }
        match last.is_finite() && last > ACCURATE {
            true => Err(Breakdown::Reaction(0)),
            false => Ok(()),
        }
    }

    /// The residuals of implicit methods, r with shape (n_q) and Φ_q v + Φ_t with shape (n_rows), and the powers at any a
    /// and λ. Loads of joints count if forces depend on reactions.
    pub fn balance(
        &mut self,
        t: Slope,
        [q, v, z]: [&[Slope]; 3],
        [a, lam]: [&[Slope]; 2],
    ) -> [&[Slope]; 2] {
        self.motions.place(&self.model.layout, q, v);
        self.linearize(t);
        self.a.copy_from_slice(a);
        self.lam.copy_from_slice(lam);
        self.put_residual(t, z, self.depends[0]);
        self.add_powers_of_drivers(v);
        [&self.residual[..a.len()], &self.terms[1]]
    }

    /// Computes Φ_q, Φ, Φ_q v + Φ_t and γ at the state of the motions.
    fn linearize(&mut self, t: Slope) {
        let Self { model, motions, jacobian, terms, .. } = self;
        let terms = terms.each_mut().map(|terms| &mut terms[..]);
        constraints::terms_and_jacobian(model, motions, t, terms, jacobian);
    }

    /// Computes (r, s) and the powers for the present a and λ, on which the forces depend if `depends`.
    fn put_residual(&mut self, t: Slope, z: &[Slope], depends: bool) {
        let Self { model, motions, a, lam, powers, compiled, jacobian, applied, .. } = self;
        let known = depends.then_some(&lam[..]);
        let acting = Acting { z, lam: known, t };
        forces::generalized(model, compiled, motions, acting, applied, powers);
        if depends {
            reactions::add_loads(model, motions, t, lam, applied);
        }
        let (r, s) = self.residual.split_at_mut(a.len());
        r.iter_mut().zip(&*applied).for_each(|(r, q)| *r = -*q);
        mass::add_times(model, motions, a, r);
        constraints::add_transposed(model, jacobian, lam, r);
        constraints::times_all(model, jacobian, a, s);
        let [.., gamma] = &self.terms;
        s.iter_mut().zip(gamma).for_each(|(s, gamma)| *s -= *gamma);
    }

    /// Adds the powers of drivers, -λᵀ Φ_q q̇ over their rows, after [`respond`](Self::respond).
    pub fn add_powers_of_drivers(&mut self, v: &[Slope]) {
        let Self { model, lam, powers, jacobian, .. } = self;
        for (k, _) in model.constraints.iter().enumerate().filter(|(_, item)| item.driven) {
            let range = model.layout.constraints[k].rows.clone();
            let mut rows = vec![Slope::constant(0.0); range.len()];
            constraints::times(model, k, jacobian, v, &mut rows);
            for (rate, lam) in rows.iter().zip(&lam[range]) {
                powers.drivers -= *rate * *lam;
            }
        }
    }

    /// Φ with derivatives at positions, shape (n_rows).
    pub fn open(&mut self, t: Slope, q: &[Slope]) -> Vec<Slope> {
        let motions = Motions::at_rest(&self.model.layout, q);
        let mut phi = vec![Slope::constant(0.0); self.model.layout.n_rows];
        constraints::residual(&self.model, &motions, t, &mut phi);
        phi
    }

    /// Φ_q v + Φ_t with derivatives, shape (n_rows).
    pub fn opening(&self, t: Slope, q: &[Slope], v: &[Slope]) -> Vec<Slope> {
        let [_, rate, _] = self.terms(t, q, v);
        rate
    }

    /// Φ, Φ_q v + Φ_t and γ with derivatives.
    pub(super) fn terms(&self, t: Slope, q: &[Slope], v: &[Slope]) -> [Vec<Slope>; 3] {
        let motions = Motions::at(&self.model.layout, q, v);
        constraints::terms_at(&self.model, &motions, t)
    }

    /// M x + Φ_qᵀ y with derivatives at a state, shape (n_q).
    pub fn balance_of(
        &mut self,
        (t, q, v): (Slope, &[Slope], &[Slope]),
        x: &[Slope],
        y: &[Slope],
    ) -> Vec<Slope> {
        self.motions.place(&self.model.layout, q, v);
        self.linearize(t);
        let mut out = vec![Slope::constant(0.0); x.len()];
        mass::add_times(&self.model, &self.motions, x, &mut out);
        constraints::add_transposed(&self.model, &self.jacobian, y, &mut out);
        out
    }

    /// Φ_qᵀ λ - Q and Φ with derivatives, at rest, shape (n_q + n_rows). Q has the loads of joints. Friction, which
    /// depends on reactions, is zero.
    pub fn statics(&mut self, t: Slope, q: &[Slope], lam: &[Slope]) -> Vec<Slope> {
        let rest = vec![Slope::constant(0.0); q.len()];
        let mut out = self.balance_of((t, q, &rest), &rest, lam);
        let Self { model, motions, powers, compiled, applied, .. } = self;
        let acting = Acting { z: &[], lam: None, t };
        forces::generalized(model, compiled, motions, acting, applied, powers);
        reactions::add_loads(model, motions, t, lam, applied);
        out.iter_mut().zip(&*applied).for_each(|(out, q)| *out -= *q);
        out.extend(self.open(t, q));
        out
    }
}
