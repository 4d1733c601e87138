//! Data derived from a model and shared by its runs. Each item is computed at its first use.

use super::wide::{Wide, WideCell};
use crate::equations::Plan;
use crate::model::Model;
use std::sync::{Arc, OnceLock};

/// The symbolic factorisation and the model over lanes.
#[derive(Debug, Default)]
pub(super) struct ModelCache {
    plan: OnceLock<Arc<Plan>>,
    /// The symbolic factorisation for redundant constraints.
    redundant: OnceLock<Arc<Plan>>,
    wide: WideCell,
}

impl ModelCache {
    /// The elimination plan of the equations of motion, with or without redundant constraints.
    pub fn plan(&self, model: &Model, redundant: bool) -> Arc<Plan> {
        Arc::clone(match redundant {
            true => self.redundant.get_or_init(|| Arc::new(Plan::free(model))),
            false => self.plan.get_or_init(|| Arc::new(Plan::without_redundancy(model))),
        })
    }

    /// The model over lanes, if it solves this number of states faster.
    #[inline]
    pub fn wide(&self, model: &Model, states: usize) -> Option<Wide<'_>> {
        self.wide.of(model, states)
    }
}
