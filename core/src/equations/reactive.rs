//! Forces that depend on reactions, such as friction in a joint.
//!
//! With such forces Q depends on λ, and the equations of motion are no longer linear:
//!
//! ```text
//! [ M   Φ_qᵀ ] [ q̈ ]   [ Q(λ) ]
//! [ Φ_q  0   ] [ λ ] = [ γ    ]
//! ```
//!
//! Each of these forces has one effort along one direction dₖ, so that Q(λ) = Q₀ + Σ dₖ eₖ(λ) with the efforts eₖ. The
//! equations are solved once without these forces, and once for each direction, with the same factors: λ = λ₀ + S e.
//! Newton's method then solves e = e(λ₀ + S e) with the matrix I - ∂e/∂λ S, which has one row for each effort.
//!
//! There may be several solutions or none. The solution of the motion is the one that follows continuously from the
//! solution without these forces, as a factor f on the forces grows from 0 to 1. The determinant of I - f ∂e/∂λ S is 1 at
//! f = 0. If it becomes zero before f = 1, the forces exceed the reactions that balance them: a friction paradox
//! (Painlevé 1895). Newton's method begins at λ₀ with f = 1. Only if it fails, f grows in steps.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::load_changes::{largest, LoadRows};
use super::powers::Powers;
use super::reactions;
use crate::elements::{ForceElement, Mode, Situation};
use crate::math::{Listed, Real, Wrench};
use crate::model::Model;
use std::borrow::Cow;

/// Largest number of iterations for one factor of the forces.
const MOST: usize = 12;
/// Accepted change of the multipliers of a load, relative to the load.
const ACCEPTED: f64 = 1e-12;
/// Accepted change of the multipliers, relative to the largest multiplier of the mechanism, if the change no longer
/// decreases.
const ROUNDING: f64 = 1e-10;
/// Size, relative to the largest force, of a load that is a rounding error. Its direction, and with it the friction,
/// is arbitrary.
pub const NOISE: f64 = 1e-13;
/// The first and the smallest step of the factor of the forces.
const FIRST: f64 = 0.25;
const LEAST: f64 = 1e-5;

/// Whether forces depend on reactions, or on the multiplier of friction that they follow. If so, the motion depends on
/// the loads of joints.
pub fn depends<S: Real>(model: &Model<S>) -> bool {
    (0..model.forces.len()).any(|k| takes_part(model, k))
}

/// Whether a force depends on multipliers, or another one follows it.
fn takes_part<S>(model: &Model<S>, k: usize) -> bool {
    let follows = |mode: Mode| matches!(mode, Mode::Follows { leader, .. } if leader == k);
    let item = &model.forces[k];
    let led = matches!(item.mode, Mode::Follows { .. });
    let loaded = item.reaction.is_some() || item.load_row.is_some();
    loaded || led || model.forces.iter().any(|other| follows(other.mode))
}

/// The rows of the multipliers on which forces or loads of joints depend, ascending.
pub fn rows<S: Real>(model: &Model<S>) -> Vec<usize> {
    let of_loads =
        reactions::loaded(model).flat_map(|joint| model.layout.constraints[joint].rows.clone());
    let mut rows: Vec<usize> = of_loads.list();
    (0..model.forces.len()).flat_map(|k| rows_of(model, k)).append_to(&mut rows);
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// The rows of the multipliers on which force `k` depends. A friction force that follows another one also depends on the
/// multiplier and on the limit of the other force.
pub fn rows_of<S>(model: &Model<S>, k: usize) -> Vec<usize> {
    let item = &model.forces[k];
    let mut all: Vec<usize> = reactions::rows_seen(model, k).list();
    if let Mode::Follows { leader, .. } = item.mode {
        reactions::rows_seen(model, leader).append_to(&mut all);
        all.extend(model.forces[leader].held_row);
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// A force in a situation without its reaction, and the reaction as a function of the multipliers.
struct LoadedBearing<'m, S: Clone> {
    model: &'m Model<S>,
    force: usize,
    element: Cow<'m, ForceElement<S>>,
    at: Situation<'m, S>,
    /// The effort without the reaction, which the equations without these forces contain already.
    base: S,
    /// The first row of the joint, and the reaction for a unit multiplier of each of its rows. There are none if the
    /// load is given.
    first: usize,
    units: Vec<Wrench<S>>,
}

/// An effort with its derivatives with respect to a reaction.
type Sloped<S> = (S, Wrench<S>);

impl<'m, S: Real> LoadedBearing<'m, S> {
    fn new(model: &'m Model<S>, k: usize, motions: &'m Motions<S>, acting: Acting<'m, S>) -> Self {
        let item = &model.forces[k];
        let element = forces::at_state(model, item, motions, acting);
        let at = forces::situation(model, k, motions, acting);
        Self {
            model,
            force: k,
            base: element.effort(&at).0,
            element,
            at,
            first: reactions::rows_seen(model, k).start,
            units: reactions::units_seen(model, k, motions, acting.t),
        }
    }

    /// Adds an effort to Q, and its power to `powers`.
    fn add(&self, effort: S, q: &mut [S], powers: &mut Powers<S>) {
        let Self { model, element, at, .. } = self;
        element.put_effort(at, effort, &mut |part: usize, body: usize, w: Wrench<S>| {
            powers.add(element.parts()[part].nature, || w.power(at.body(body).twist));
            model.layout.bodies[at.bodies[body].0].add([w.force.x, w.force.y, w.torque], q);
        });
    }

    /// The value of `of` with the reaction for these multipliers. Passes its derivatives with respect to multipliers,
    /// times `factor`, to `slope`.
    fn value(
        &self,
        of: impl Fn(&ForceElement<S>, &Situation<'_, S>) -> Sloped<S>,
        lam: &[S],
        factor: S,
        slope: &mut impl FnMut(usize, S),
    ) -> S {
        let mut reaction = Wrench::zero();
        for (unit, lam) in self.units.iter().zip(&lam[self.first..]) {
            let own = Wrench { force: unit.force.scale(*lam), torque: unit.torque * *lam };
            reaction = reaction + own;
        }
        let (value, by) = of(&self.element, &Situation { reaction, ..self.at });
        for (row, unit) in self.units.iter().enumerate() {
            let of_row = by.force.dot(unit.force) + by.torque * unit.torque;
            slope(self.first + row, factor * of_row);
        }
        value
    }
}

/// The law of an effort. Bearings are given by their indices.
enum Effort {
    Slides(usize),
    /// Friction at rest that takes the same part of its limit as the friction that holds with the multiplier of `row`.
    Follows {
        own: usize,
        leader: usize,
        row: usize,
        sense: f64,
    },
    /// The load of a joint, in proportion to the magnitude of the multiplier of this row.
    Load(usize),
}

/// A force or the load of a joint, which depends on multipliers.
struct Source<S> {
    effort: Effort,
    /// (q̈, λ) for an effort of 1, in the layout of the matrix.
    response: Vec<S>,
}

/// All forces and loads that depend on multipliers, at a state.
pub(super) struct Sources<'m, S: Clone> {
    bearings: Vec<LoadedBearing<'m, S>>,
    all: Vec<Source<S>>,
    loads: LoadRows,
}

impl<'m, S: Real> Sources<'m, S> {
    /// `respond` solves the equations for given generalized forces, shape (n_q), without other terms.
    ///
    /// # Errors
    /// Those of `respond`.
    pub fn new<E>(
        model: &'m Model<S>,
        motions: &'m Motions<S>,
        acting: Acting<'m, S>,
        mut respond: impl FnMut(&[S]) -> Result<Vec<S>, E>,
    ) -> Result<Self, E> {
        let own = (0..model.forces.len()).filter(|k| takes_part(model, *k));
        let bearings: Vec<_> = own.map(|k| LoadedBearing::new(model, k, motions, acting)).list();
        let place = |k: usize| bearings.iter().position(|of| of.force == k);
        let (mut all, mut loads) = (Vec::new(), LoadRows::default());
        bearings.iter().for_each(|of| loads.add(of.first, &of.units));
        let mut direction = vec![S::zero(); model.layout.n_q];
        for (own, bearing) in bearings.iter().enumerate() {
            let effort = match model.forces[bearing.force].mode {
                Mode::Holds(_) | Mode::Idle | Mode::Carries(_) => continue,
                Mode::Follows { leader, sense } => {
                    let row = model.forces[leader].held_row;
                    let (leader, row) = place(leader).zip(row).expect("it takes part and holds");
                    loads.add_rows(row..row + 1);
                    Effort::Follows { own, leader, row, sense }
                }
                _ => Effort::Slides(own),
            };
            direction.fill(S::zero());
            bearing.add(S::one(), &mut direction, &mut Powers::zero());
            all.push(Source { effort, response: respond(&direction)? });
        }
        for joint in reactions::loaded(model) {
            direction.fill(S::zero());
            let rows = model.layout.constraints[joint].rows.clone();
            loads.add_rows(rows.start..rows.start + 1);
            let unit = vec![S::one(); rows.len()];
            reactions::add_load(model, joint, motions, acting.t, &unit, &mut direction);
            all.push(Source { effort: Effort::Load(rows.start), response: respond(&direction)? });
        }
        Ok(Self { bearings, all, loads })
    }

    /// The effort of a source. Passes its derivatives with respect to multipliers to `slope`; those of limits of
    /// friction at rest only if `limits` is true.
    fn effort(
        &self,
        effort: &Effort,
        lam: &[S],
        limits: bool,
        mut slope: impl FnMut(usize, S),
    ) -> S {
        let one = S::one();
        match *effort {
            Effort::Slides(own) => {
                let own = &self.bearings[own];
                own.value(ForceElement::effort, lam, one, &mut slope) - own.base
            }
            Effort::Load(row) => {
                slope(row, S::select(lam[row], one, -one));
                lam[row].abs()
            }
            Effort::Follows { own, leader, row, sense } => {
                let [own, leader] = [&self.bearings[own], &self.bearings[leader]];
                let under = |own: S| {
                    move |e: &ForceElement<S>, at: &Situation<'_, S>| e.limit_against(at, own)
                };
                let most = leader.value(under(lam[row]), lam, one, &mut |_, _| {});
                let per_limit = S::select(most, -S::constant(sense) / most, S::zero());
                let part = per_limit * lam[row];
                let scale = if limits { one } else { S::zero() };
                let mut of_limit = |row, by: S| slope(row, scale * by);
                let limit = own.value(under(-part * most), lam, part, &mut of_limit);
                let per_most = S::select(most, -part * limit / most, S::zero());
                leader.value(under(lam[row]), lam, per_most, &mut of_limit);
                slope(row, per_limit * limit);
                part * limit
            }
        }
    }

    /// Adds all efforts to a solution without them, and the powers of forces to `powers`. `first` is the index at which
    /// the multipliers begin, `rows` are the rows on which efforts depend, and `force` is a large force of the state.
    ///
    /// # Errors
    /// If no solution follows from the one without these forces, the row of `rows` whose multiplier has grown most.
    pub fn add(
        &self,
        (rows, first, force): (&[usize], usize, f64),
        solution: &mut [S],
        powers: &mut Powers<S>,
    ) -> Result<(), usize> {
        let mut efforts = vec![S::zero(); self.all.len()];
        let path = Path { sources: self, rows, free: &solution[first..], first, force };
        let found = path.solve(&mut efforts);
        for (Source { effort, response }, e) in self.all.iter().zip(&efforts) {
            solution.iter_mut().zip(response).for_each(|(x, one)| *x = x.plus_product(*e, *one));
            if let Effort::Slides(own) | Effort::Follows { own, .. } = effort {
                let bearing = &self.bearings[*own];
                bearing.add(*e, &mut vec![S::zero(); bearing.model.layout.n_q], powers);
            }
        }
        let grown = |row: &usize| largest(std::iter::once(solution[first + row]));
        let most = || rows.iter().copied().max_by(|a, b| grown(a).total_cmp(&grown(b)));
        found.then_some(()).ok_or_else(|| most().unwrap_or_default())
    }
}

/// The solutions for all factors of the forces.
struct Path<'a, S: Clone> {
    sources: &'a Sources<'a, S>,
    rows: &'a [usize],
    /// The multipliers without the forces.
    free: &'a [S],
    first: usize,
    /// A force that is large compared with rounding errors of the loads.
    force: f64,
}

impl<S: Real> Path<'_, S> {
    fn solve(&self, efforts: &mut Vec<S>) -> bool {
        // without a finite start, the solution is not finite either
        if self.newton(efforts, S::one(), true) || !self.free.iter().all(|x| x.is_finite()) {
            return true;
        }
        efforts.fill(S::zero());
        let follows = |of: &Source<S>| matches!(of.effort, Effort::Follows { .. });
        if self.sources.all.iter().any(follows) {
            // the reaction without the friction that follows may be far too large
            self.newton(efforts, S::one(), false);
            if self.newton(efforts, S::one(), true) {
                return true;
            }
        }
        efforts.fill(S::zero());
        let (mut factor, mut step) = (0.0, FIRST);
        while factor < 1.0 {
            let next = f64::min(factor + step, 1.0);
            let mut trial = efforts.clone();
            if self.newton(&mut trial, S::constant(next), true) {
                *efforts = trial;
                (factor, step) = (next, 2.0 * step);
            } else if step < LEAST {
                return false;
            } else {
                step *= 0.25;
            }
        }
        true
    }

    /// Adds the multipliers for these efforts to `lam`.
    fn add_multipliers(&self, efforts: &[S], lam: &mut [S]) {
        for (Source { response, .. }, e) in self.sources.all.iter().zip(efforts) {
            let of_effort = &response[self.first..];
            lam.iter_mut().zip(of_effort).for_each(|(lam, one)| *lam = lam.plus_product(*e, *one));
        }
    }

    /// Newton's method from `efforts`. Returns whether it converged with positive determinants.
    fn newton(&self, efforts: &mut [S], factor: S, limits: bool) -> bool {
        let all = &self.sources.all;
        let (mut last, mut before) = (f64::INFINITY, 1.0_f64);
        let mut columns = vec![vec![S::zero(); all.len()]; all.len()];
        let (mut lam, mut change) = (self.free.to_vec(), self.free.to_vec());
        for _ in 0..MOST {
            lam.copy_from_slice(self.free);
            self.add_multipliers(efforts, &mut lam);
            let mut gap = Vec::with_capacity(all.len());
            for (k, source) in all.iter().enumerate() {
                columns.iter_mut().for_each(|column| column[k] = S::zero());
                columns[k][k] = S::one();
                let effort = self.sources.effort(&source.effort, &lam, limits, |row, slope| {
                    for (column, other) in columns.iter_mut().zip(all) {
                        column[k] -= factor * slope * other.response[self.first + row];
                    }
                });
                gap.push(factor * effort - efforts[k]);
            }
            change.fill(S::zero());
            self.add_multipliers(&gap, &mut change);
            let of_rows = |x: &[S]| largest(self.rows.iter().map(|row| x[*row]));
            let (size, left, most) =
                (of_rows(&lam), of_rows(&change), largest(lam.iter().copied()));
            let noise = NOISE * self.force.max(most);
            if size <= noise {
                return true;
            }
            let Some(step) = eliminate(&mut columns, gap) else { return false };
            efforts.iter_mut().zip(step).for_each(|(effort, step)| *effort += step);
            let rounding = noise.max(ROUNDING * most);
            let part = self.sources.loads.largest_part(&lam, &change, noise);
            // the next change, because Newton's method squares the error
            let next = part * (part / before.min(1.0)).powi(2);
            if part.min(next) <= ACCEPTED || (left >= last && left <= rounding) {
                return true;
            }
            (last, before) = (left, part);
        }
        false
    }
}

/// Solves A x = b, where A is given by its columns. None if the determinant of A is not positive.
/// Rows are not exchanged. If A is far from the unit matrix, the factor of the forces takes smaller steps.
fn eliminate<S: Real>(columns: &mut [Vec<S>], mut b: Vec<S>) -> Option<Vec<S>> {
    let n = b.len();
    let mut determinant = S::one();
    for k in 0..n {
        let pivot = columns[k][k];
        determinant = determinant * S::select(pivot, S::one(), -S::one());
        for row in (0..n).filter(|row| *row != k) {
            let factor = columns[k][row] / pivot;
            for column in columns.iter_mut().skip(k + 1) {
                let above = column[k];
                column[row] -= factor * above;
            }
            let above = b[k];
            b[row] -= factor * above;
        }
    }
    let positive = determinant.in_lanes().iter().all(|sign| *sign > 0.0);
    let x: Vec<S> = b.iter().enumerate().map(|(k, b)| *b / columns[k][k]).list();
    (positive && x.iter().all(|x| x.is_finite())).then_some(x)
}
