//! A state at which modes are determined.

use super::super::failure::{Failure, Reason};
use super::super::model_cache::ModelCache;
use super::super::redundant_rows::workspace_at;
use super::phases::{TriedPhase, TriedPhases};
pub use crate::analyses::rigid::{is_rigid as is_contact, unit};
use crate::elements::Mode;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::measured::lag;
use crate::equations::{constraints, energy, leading};
use crate::equations::{Gains, Workspace};
use crate::math::Listed;
use crate::math::{Jet, Lift, Real, ShortArray};
use crate::model::{column_scales, row_scales, size, DriverSet, ForceMode, Model};
use std::rc::Rc;

/// Rates of friction below this value count as zero, relative to the rates of the mechanism; accelerations likewise.
pub const STILL: f64 = 1e-9;

/// Forces below this fraction of the forces of a state are noise.
pub const NOISE: f64 = 1e-13;

/// Limit of friction below which it does not lead, relative to the largest one.
const WEAK: f64 = 1e-2;

/// Largest gap of a contact that touches: relative to the size of the mechanism, or in rad.
const TOUCHING: f64 = 1e-10;

/// Rate of a gap, as a fraction of the mechanism's size per second or in rad/s, below which the next flight is so low
/// that rounding errors of the gap matter.
const SLOW: f64 = 2e-7;

/// Uncertainty of a gap in floating-point spacings.
const ROUNDING: f64 = 64.0;

/// A state y = (q, v, z, works) at a time.
pub struct StateAt<'y> {
    pub t: f64,
    pub y: &'y mut [f64],
    /// The size of the mechanism.
    size: f64,
    /// The largest coordinate in units of its scale, at least 1.
    far: f64,
    phases: Rc<TriedPhases>,
}

impl<'y> StateAt<'y> {
    /// A state of a model.
    pub fn new<S: Real>(model: &Model<S>, t: f64, y: &'y mut [f64]) -> Self {
        let q = model.layout.split(y)[0];
        let scaled = q.iter().zip(column_scales(model)).map(|(q, scale)| q.abs() / scale);
        let far = scaled.fold(1.0, f64::max);
        Self { t, y, size: size(model), far, phases: Rc::default() }
    }

    /// A state with the same coordinates.
    pub fn with<'o>(&self, y: &'o mut [f64]) -> StateAt<'o> {
        StateAt { y, phases: Rc::clone(&self.phases), ..*self }
    }

    /// The state with the phases that other states of the model have tried.
    pub fn sharing(self, phases: &Rc<TriedPhases>) -> Self {
        Self { phases: Rc::clone(phases), ..self }
    }

    /// A model in modes.
    pub fn phase(&self, model: &Model, modes: &[ForceMode]) -> Rc<TriedPhase> {
        self.phases.of(model, modes)
    }

    /// The size of the mechanism for a gap that is a length, 1 rad for one that is an angle.
    pub fn unit(&self, model: &Model, force: usize) -> f64 {
        unit(model, self.size, force)
    }

    /// q, v and z.
    pub fn state<S: Real>(&self, model: &Model<S>) -> [&[f64]; 3] {
        let [q, v, z, _] = model.layout.split(self.y);
        [q, v, z]
    }

    /// The accelerations and multipliers of a phase.
    ///
    /// # Errors
    /// [`Failure`] where the equations have no solution.
    pub fn solved(&self, phase: &Model) -> Result<Workspace, Box<Failure>> {
        let (t, state) = (self.t, self.state(phase));
        let tried = self.phases.with_model(phase);
        let (own, alone) = (tried.as_ref().map(|tried| &tried.cache), ModelCache::default());
        let mut workspace = workspace_at((phase, own.unwrap_or(&alone)), t, state);
        let solved = workspace.accelerate(phase, t, state, Gains::default());
        solved.map_err(|breakdown| Failure::at_state(phase, t, state[0], breakdown))?;
        Ok(workspace)
    }

    /// A rate in 1/s that is large compared with rounding errors of rates: the largest one of the state, or that which
    /// the accelerations produce within the size of the mechanism or 1 rad.
    pub fn rate_scale(&self, phase: &Model) -> f64 {
        self.fastest(phase).max(self.largest_acceleration(phase).sqrt())
    }

    /// The largest acceleration of a phase, 1/s²; zero where its equations have no solution.
    pub fn largest_acceleration(&self, phase: &Model) -> f64 {
        self.solved(phase).map_or(0.0, |solved| scaled(phase, solved.a()))
    }

    /// The largest rate of the state, 1/s.
    pub fn fastest(&self, model: &Model) -> f64 {
        scaled(model, self.state(model)[1])
    }

    /// The functions whose zeros may change the modes of forces: gaps or speeds.
    pub fn thresholds(&self, model: &Model, forces: &[usize]) -> Vec<f64> {
        let [q, v, z] = self.state(model);
        let motions = Motions::at(&model.layout, q, v);
        let acting = Acting { z, lam: None, t: self.t };
        forces.iter().map(|k| forces::threshold(model, *k, &motions, acting)).list()
    }

    /// The friction whose limit is small beside the largest one.
    pub fn weak(&self, model: &Model, friction: &[usize]) -> Vec<usize> {
        if friction.len() < 2 {
            return Vec::new();
        }
        let ([q, v, z], solved) = (self.state(model), self.solved(model).ok());
        let motions = Motions::at(&model.layout, q, v);
        let acting = Acting { z, lam: solved.as_ref().map(Workspace::lam), t: self.t };
        let limit = |k: &usize| leading::limit(model, *k, &motions, acting, 0.0);
        let limits = friction.iter().map(limit).list();
        // friction in one direction may have no part in the force that is needed
        let both = |(k, own): (&usize, &f64)| match model.forces[*k].element.only_pushes() {
            true => 0.0,
            false => *own,
        };
        let most = WEAK * largest(&friction.iter().zip(&limits).map(both).list());
        friction.iter().zip(limits).filter(|(_, own)| *own < most).map(|(k, _)| *k).list()
    }

    /// The sides at which contacts touch.
    pub fn sides(&self, model: &Model, forces: &[usize]) -> Vec<f64> {
        let [q, v, z] = self.state(model);
        let motions = Motions::at(&model.layout, q, v);
        let acting = Acting { z, lam: None, t: self.t };
        forces.iter().map(|k| forces::side(model, *k, &motions, acting)).list()
    }

    /// The rates of the gaps of contacts.
    pub fn gap_rates(&self, model: &Model, contacts: &[usize]) -> Vec<f64> {
        let still = vec![0.0; model.layout.n_q];
        self.gap_jets(model, contacts, &still).iter().map(|gap| gap.rate).list()
    }

    /// The rate of the gap of a contact of a lifted model.
    pub fn gap_rate(&self, lifted: &Model<Jet>, contact: usize) -> f64 {
        self.jets(lifted, &[contact], &vec![0.0; lifted.layout.n_q])[0].rate
    }

    /// The gaps of contacts with their first and second time derivatives, or the speeds of friction with their first
    /// time derivative, for accelerations `a`.
    pub fn gap_jets(&self, model: &Model, contacts: &[usize], a: &[f64]) -> Vec<Jet> {
        if contacts.is_empty() {
            return Vec::new();
        }
        let mut jets = self.jets(&model.lift(), contacts, a);
        let limits = contacts.iter().zip(&mut jets);
        for (k, jet) in limits.filter(|(k, _)| model.forces[**k].element.driver().is_some()) {
            let [q, v, _] = self.state(model);
            let lag = lag(model, *k, &Motions::at(&model.layout, q, v), a, self.t);
            *jet = Jet::new(lag.rate, lag.second, 0.0);
        }
        jets
    }

    fn jets(&self, lifted: &Model<Jet>, contacts: &[usize], a: &[f64]) -> Vec<Jet> {
        let [q, v, z] = self.state(lifted);
        let moving = q.iter().zip(v).zip(a);
        let q: Vec<Jet> = moving.map(|((q, v), a)| Jet::new(*q, *v, *a)).list();
        let of = |x: &[f64]| -> Vec<Jet> { x.iter().map(|x| Jet::lift(*x)).list() };
        let rates: Vec<Jet> = v.iter().zip(a).map(|(v, a)| Jet::new(*v, *a, 0.0)).list();
        let motions = Motions::at(&lifted.layout, &q, &rates);
        let z = of(z);
        let acting = Acting { z: &z, lam: None, t: Jet::new(self.t, 1.0, 0.0) };
        contacts.iter().map(|k| forces::threshold_of_state(lifted, *k, &motions, acting)).list()
    }

    /// A force that is large compared with rounding errors of the forces of a phase: the largest of the kinetic energy
    /// per size, the multipliers, the reserves of the forces that hold, and the force that gravity or the accelerations
    /// need. If all of them are zero, the force on the heaviest body for one size per s².
    pub fn force_scale(&self, phase: &Model, solved: Option<&Workspace>) -> f64 {
        let ([q, v, z], size) = (self.state(phase), self.size);
        let motions = Motions::at(&phase.layout, q, v);
        let heaviest = phase.bodies.iter().fold(0.0, |most: f64, body| most.max(body.mass));
        let mut most =
            (heaviest * phase.gravity.norm()).max(energy::kinetic(phase, &motions) / size);
        if let Some(solved) = solved {
            let acting = Acting { z, lam: Some(solved.lam()), t: self.t };
            let holds = |k: &usize| matches!(phase.forces[*k].mode, Mode::Holds(_));
            let held = (0..phase.forces.len()).filter(holds);
            let reserves = held.map(|k| forces::reserve(phase, k, &motions, acting)).list();
            let moved = Motions::at(&phase.layout, q, solved.a());
            let inertial = energy::largest_inertia(phase, &moved, size);
            most = [largest(&reserves), inertial, largest(solved.lam())]
                .into_iter()
                .fold(most, f64::max);
        }
        if most > 0.0 {
            most
        } else {
            heaviest * size
        }
    }

    /// The rounding error of a gap.
    pub fn rounding(&self, model: &Model, force: usize) -> f64 {
        ROUNDING * f64::EPSILON * self.unit(model, force) * self.far
    }

    /// Whether the gap of a contact is closed.
    pub fn is_closed(&self, gap: f64, model: &Model, force: usize) -> bool {
        gap <= TOUCHING * self.unit(model, force)
    }

    /// Sets the speed with which a compliant contact begins, where its element [keeps](ForceElement::keeps_speed) it: the
    /// rate with which the gap closes.
    pub fn keep_speed(&mut self, model: &Model, force: usize) {
        let [rate] = self.gap_rates(model, &[force])[..] else { return };
        let state = model.layout.states[force].end - 1;
        let [_, _, z, _] = model.layout.split_mut(self.y);
        z[state] = (-rate).max(0.0);
    }

    /// The same for all contacts that are closed at the start of a run, unless their speeds are given.
    ///
    /// # Errors
    /// [`Failure`] with [`Reason::Start`] for a speed below zero, at which nothing begins to touch.
    pub fn keep_speeds_of_closed(&mut self, model: &Model) -> Result<(), Box<Failure>> {
        let keeps = |force: &usize| model.forces[*force].element.keeps_speed();
        for force in (0..model.forces.len()).filter(keeps) {
            let given = self.state(model)[2][model.layout.states[force].end - 1];
            if given < 0.0 {
                let (t, name) = (self.t, model.forces[force].name.clone());
                let message = format!(
                    "impact_speed of {name} is {given} m/s; it is the speed with which the contact began, which is not \
                     negative"
                );
                let hint =
                    "leave it out if the contact begins later, or give the speed of the approach";
                return Err(Reason::Start { t, name, message, hint }.into());
            }
            if given == 0.0 && self.thresholds(model, &[force])[0] <= 0.0 {
                self.keep_speed(model, force);
            }
        }
        Ok(())
    }

    /// The gap, in both directions, at which a contact no longer rests that other equations keep closed.
    pub fn play(&self, model: &Model, force: usize) -> f64 {
        let gap = self.thresholds(model, &[force])[0];
        2.0 * TOUCHING * self.unit(model, force) + (-gap).max(0.0)
    }

    /// A rate of a gap below which the next flight is so low that rounding errors of the gap matter.
    pub fn slow(&self, model: &Model, force: usize) -> f64 {
        SLOW * self.unit(model, force)
    }
}

/// Whether there are drivers in a set, and all of them stand still at a position: their laws do not change there.
pub fn drivers_rest(model: &Model, drivers: DriverSet, t: f64, q: &[f64]) -> bool {
    if drivers.is_empty() {
        return false;
    }
    let at_rest = Motions::at_rest(&model.layout, q);
    let [mut phi, mut by_time, mut gamma] = [0, 1, 2].each(|_| vec![0.0; model.layout.n_rows]);
    constraints::velocity_terms(model, &at_rest, t, &mut phi, &mut by_time, &mut gamma);
    let scales = row_scales(model);
    let still = |row: usize| by_time[row].abs() <= STILL * scales[row];
    let own = model.layout.constraints.iter().enumerate().filter(|(k, _)| drivers.contains(*k));
    own.flat_map(|(_, slots)| slots.rows.clone()).all(still)
}

/// The forces with modes.
pub fn with_modes(model: &Model) -> impl Iterator<Item = usize> + '_ {
    (0..model.forces.len()).filter(|k| has_mode(model, *k))
}

/// The mode of a force in a list.
pub fn mode_of(modes: &[ForceMode], force: usize) -> Mode {
    modes.iter().find(|of| of.force == force).map_or(Mode::Open, |of| of.mode)
}

/// Whether a force has modes.
pub fn has_mode(model: &Model, force: usize) -> bool {
    model.forces[force].element.behaviour().is_some_and(|of| of.has_modes())
}

/// The largest magnitude of rates or accelerations, relative to the size of the mechanism or 1 rad.
pub fn scaled(model: &Model, rates: &[f64]) -> f64 {
    let own = rates.iter().zip(column_scales(model)).map(|(rate, scale)| rate.abs() / scale);
    own.fold(0.0, f64::max)
}

/// The largest magnitude.
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}
