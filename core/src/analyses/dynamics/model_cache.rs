//! Data derived from a model that its runs share; each is computed at first use.

use crate::equations::Plan;
use crate::math::Lanes;
use crate::model::Model;
use std::sync::{Arc, OnceLock};

/// The symbolic factorisation and the model over lanes.
#[derive(Debug, Default)]
pub(super) struct ModelCache {
    plan: OnceLock<Arc<Plan>>,
    /// That for redundant constraints.
    redundant: OnceLock<Arc<Plan>>,
    /// In a box: it has the alignment of vector registers, which allocators of other languages do not provide.
    wide: OnceLock<Box<Model<Lanes>>>,
}

impl ModelCache {
    /// The plan of elimination of the equations of motion, with or without redundant constraints.
    pub fn plan(&self, model: &Model, redundant: bool) -> Arc<Plan> {
        Arc::clone(match redundant {
            true => self.redundant.get_or_init(|| Arc::new(Plan::free(model))),
            false => self.plan.get_or_init(|| Arc::new(Plan::without_redundancy(model))),
        })
    }

    /// The model over lanes.
    pub fn wide(&self, model: &Model) -> &Model<Lanes> {
        self.wide.get_or_init(|| Box::new(model.lift()))
    }
}
