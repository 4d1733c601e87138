//! The mechanism without the contacts with restitution that are apart: they take no part in impacts and rest, so that
//! these cost as much as the contacts that touch.

use super::super::passages::Struck;
use super::companions;
use super::mode_events::PARADOX;
use super::place::{is_contact, with_modes};
use super::sliding_contacts::Uniqueness;
use crate::elements::Mode;
use crate::math::Listed;
use crate::model::{ForceMode, Model};

/// The modes of the next phase, and what happened.
#[derive(Clone, Debug, Default)]
pub struct Settled {
    /// The mode of each force that has modes.
    pub modes: Vec<ForceMode>,
    /// Contacts that hit, with the impulses of all multipliers.
    pub hits: Vec<usize>,
    /// The impulses of the joints and contacts, shape (n_multipliers).
    pub impulses: Vec<f64>,
    /// The impacts in order.
    pub impacts: Vec<Vec<Struck>>,
    /// Whether contacts with friction, or all closed contacts, acted together.
    pub couples: bool,
    /// Whether a sequence of impacts without end has been replaced by its limit.
    pub collapsed: bool,
    /// Other changes: the force, and the place of its event.
    pub changed: Vec<(usize, usize)>,
    /// Contacts whose sliding an impact without collision ended.
    pub jammed: Vec<usize>,
    /// Whether the motion that follows is the only one.
    pub uniqueness: Uniqueness,
}

impl Settled {
    /// The contacts with impulses, and the places of their events.
    pub fn struck(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let hits = self.hits.iter().map(|k| (*k, 0));
        hits.chain(self.jammed.iter().map(|k| (*k, PARADOX)))
    }
}

/// The model with the forces that take part, and the index of each of them in the whole model, in order.
pub(super) struct TakingPart {
    pub model: Model,
    forces: Vec<usize>,
}

impl TakingPart {
    /// All forces but the rigid contacts that do not touch, and their friction. `touching` is in order.
    pub fn of(model: &Model, touching: &[usize]) -> Self {
        let takes_part = |k: &usize| {
            let contact = companions::contact_of(model, *k).unwrap_or(*k);
            !is_contact(model, contact) || touching.binary_search(&contact).is_ok()
        };
        let forces = (0..model.forces.len()).filter(takes_part).list();
        Self { model: model.with_forces(&forces), forces }
    }

    /// The places of forces of the whole model among those that take part.
    pub fn places(&self, forces: &[usize]) -> Vec<usize> {
        forces.iter().filter_map(|k| self.forces.binary_search(k).ok()).list()
    }

    /// The modes of the forces that take part.
    pub fn modes(&self, whole: &[ForceMode]) -> Vec<ForceMode> {
        let place = |k: usize| self.forces.binary_search(&k).ok();
        let own = |of: &ForceMode| Some(ForceMode { force: place(of.force)?, ..led(of, &place) });
        whole.iter().filter_map(own).list()
    }

    /// What happened, in terms of the whole model.
    pub fn whole(&self, model: &Model, own: Settled) -> Settled {
        let force = |k: usize| self.forces[k];
        let mut modes = with_modes(model).map(|k| ForceMode::new(k, Mode::Free)).list();
        let mut others = modes.iter_mut();
        for of in &own.modes {
            let at = others.find(|at| at.force == force(of.force)).expect("it has modes");
            *at = ForceMode { force: at.force, ..led(of, &|k| Some(force(k))) };
        }
        let mut impulses = own.impulses;
        if !impulses.is_empty() {
            let of_part = std::mem::take(&mut impulses);
            impulses.extend(&of_part[..model.layout.n_rows]);
            impulses.resize(model.n_multipliers(), 0.0);
            for (item, k) in self.model.forces.iter().zip(&self.forces) {
                if let (Some(from), Some(to)) = (item.held_row, model.forces[*k].held_row) {
                    impulses[to] = of_part[from];
                }
            }
        }
        let mut impacts = own.impacts;
        for of in impacts.iter_mut().flatten() {
            of.force = force(of.force);
            of.restitution = of.restitution.map(force);
        }
        let hits = own.hits.into_iter().map(force).list();
        let jammed = own.jammed.into_iter().map(force).list();
        let uniqueness = match own.uniqueness {
            Uniqueness::Several(contact) => Uniqueness::Several(force(contact)),
            other => other,
        };
        let changed = own.changed.into_iter().map(|(k, of)| (force(k), of)).list();
        Settled { modes, hits, impulses, impacts, changed, jammed, uniqueness, ..own }
    }
}

/// A mode in which the leader that friction follows has another index; the friction is idle if there is none.
fn led(of: &ForceMode, index: &dyn Fn(usize) -> Option<usize>) -> ForceMode {
    let Mode::Follows { leader, sense } = of.mode else { return *of };
    let mode = index(leader).map_or(Mode::Idle, |leader| Mode::Follows { leader, sense });
    ForceMode { mode, ..*of }
}
