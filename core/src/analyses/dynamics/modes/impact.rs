//! One impact: its contacts, its impulses and the velocities after it.

use super::super::passages::Struck;
use super::place::StateAt;
use crate::elements::Mode;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, ShortArray};
use crate::model::Model;

/// The restitution of each contact.
pub type Restitutions<'r> = &'r dyn Fn(usize) -> f64;

/// An impact at some contacts.
pub struct Impact {
    pub contacts: Vec<usize>,
    /// The model with these contacts held, and the impulses of its rows.
    pub closed: Model,
    pub found: Vec<f64>,
    /// The velocities after the impact, and the energy that it takes.
    pub after: Vec<f64>,
    pub loss: f64,
    /// The contact whose restitution all have; None if each has its own.
    pub common: Option<usize>,
}

impl Impact {
    /// Its contacts, without restitution if it is plastic.
    pub fn struck(&self, plastic: bool) -> Vec<Struck> {
        let of = |force: &usize| {
            let restitution = (!plastic).then(|| self.common.unwrap_or(*force));
            let side = match self.closed.forces[*force].mode {
                Mode::Holds(side) => side,
                _ => 0.0,
            };
            Struck { force: *force, side, restitution }
        };
        self.contacts.iter().map(of).list()
    }

    /// The impulse with which each of its contacts pushes.
    pub fn pushes(&self) -> Vec<f64> {
        let push = |k: &usize| match (self.closed.forces[*k].mode, self.closed.forces[*k].held_row)
        {
            (Mode::Holds(side), Some(row)) => side.signum() * self.found[row],
            _ => 0.0,
        };
        self.contacts.iter().map(push).list()
    }

    /// Changes the velocities and works of a state, and adds the impulses to a sum.
    pub fn apply(&self, model: &Model, place: &mut StateAt<'_>, impulses: &mut [f64]) {
        let base = model.layout.n_rows;
        for (sum, own) in impulses.iter_mut().zip(&self.found[..base]) {
            *sum += own;
        }
        let rubs = self.contacts.iter().filter_map(|k| model.forces[*k].partner);
        for k in self.contacts.iter().copied().chain(rubs) {
            let closed = &self.closed.forces[k];
            let holds = matches!(closed.mode, Mode::Holds(_));
            let rows = (model.forces[k].held_row, closed.held_row.filter(|_| holds));
            if let (Some(to), Some(from)) = rows {
                impulses[to] += self.found[from];
            }
        }
        let driven = driver_work(model, place.t, place.state(model)[0], &self.found);
        let [_, v, _, works] = model.layout.split_mut(place.y);
        v.copy_from_slice(&self.after);
        works[0] += self.loss + driven;
        works[1] += driven;
    }
}

/// Work of the impulses of drivers. The rates of their rows are -Φ_t before and after.
pub(super) fn driver_work(model: &Model, t: f64, q: &[f64], impulses: &[f64]) -> f64 {
    if !model.driven {
        return 0.0;
    }
    let at_rest = Motions::at_rest(&model.layout, q);
    let [mut phi, mut by_time, mut gamma] = [0, 1, 2].each(|_| vec![0.0; model.layout.n_rows]);
    constraints::velocity_terms(model, &at_rest, t, &mut phi, &mut by_time, &mut gamma);
    by_time.iter().zip(impulses).map(|(by_time, impulse)| by_time * impulse).sum()
}
