//! Models in modes, which are tried at one state and at states beside it.

use super::super::model_cache::ModelCache;
use crate::model::{Blueprint, DriverSet, ForceMode, Model};
use std::cell::RefCell;
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

/// Number of phases that are kept. More are rarely tried at one state, and the next states try the same ones.
const KEPT: usize = 64;

/// A model in modes, with the data that its states share.
pub struct TriedPhase {
    model: Model,
    pub cache: ModelCache,
    holders: RefCell<Option<(Vec<f64>, DriverSet)>>,
}

impl TriedPhase {
    /// The drivers that hold a coordinate at a position. They are found once while a mechanism stays there.
    pub fn holders(&self, q: &[f64], find: impl FnOnce() -> DriverSet) -> DriverSet {
        let mut last = self.holders.borrow_mut();
        if let Some((_, found)) = last.as_ref().filter(|(at, _)| at == q) {
            return *found;
        }
        let found = find();
        *last = Some((q.to_vec(), found));
        found
    }
}

impl Deref for TriedPhase {
    type Target = Model;

    fn deref(&self) -> &Model {
        &self.model
    }
}

/// The phases so far, each with the model from which it was made.
#[derive(Default)]
pub struct TriedPhases(RefCell<Vec<(Arc<Blueprint>, Rc<TriedPhase>)>>);

impl TriedPhases {
    /// A model in modes. Rounding errors of modes do not change their equations.
    pub fn of(&self, model: &Model, modes: &[ForceMode]) -> Rc<TriedPhase> {
        let key = |of: &ForceMode| (of.force, of.mode, of.value.to_bits());
        let mut all = self.0.borrow_mut();
        let is_it = |(from, phase): &&(Arc<Blueprint>, Rc<TriedPhase>)| {
            let own = &phase.blueprint.modes;
            Arc::ptr_eq(from, &model.blueprint) && own.iter().map(key).eq(modes.iter().map(key))
        };
        if let Some((_, phase)) = all.iter().find(is_it) {
            return Rc::clone(phase);
        }
        if all.len() == KEPT {
            all.clear();
        }
        let phase = Rc::new(TriedPhase {
            model: model.in_modes(modes),
            cache: ModelCache::default(),
            holders: RefCell::default(),
        });
        all.push((Arc::clone(&model.blueprint), Rc::clone(&phase)));
        phase
    }

    /// The phase whose model this is.
    pub fn with_model(&self, model: &Model) -> Option<Rc<TriedPhase>> {
        let all = self.0.borrow();
        let found = all.iter().find(|(_, phase)| std::ptr::eq(&phase.model, model));
        found.map(|(_, phase)| Rc::clone(phase))
    }
}
