//! A model made ready for many runs: what each would work out anew is worked out by the first.

use super::{simulate, Eyes, Failure, Options, Run};
use crate::analyses::State;
use crate::equations::Plan;
use crate::integrate::Flow;
use crate::math::Lanes;
use crate::model::Model;
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// A model and what its runs have in common: the plan of elimination, and the model over lanes once a run wants it.
///
/// Of a borrowed model or, as `Prepared<Arc<Model>>`, with the model in it. Threads may share it; the results of a
/// run do not depend on those before it.
///
/// ```no_run
/// # use kempe::{analyses::{dynamics, State}, integrate::Flow, model::Model};
/// # fn main() -> Result<(), Box<dynamics::Failure>> {
/// # let (model, starts): (Model, Vec<State>) = unimplemented!();
/// let prepared = dynamics::Prepared::new(&model);
/// for start in &starts {
///     let run = prepared.dynamics(start, &dynamics::Options::new(0.1), |_| Flow::Continue)?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Prepared<M> {
    model: M,
    common: Common,
}

/// What is worked out at first use.
#[derive(Debug, Default)]
pub(super) struct Common {
    plan: OnceLock<Arc<Plan>>,
    /// In a box: it is aligned as vector registers are, to more than allocators of other languages give.
    wide: OnceLock<Box<Model<Lanes>>>,
}

impl Common {
    /// The plan of elimination of the equations of motion.
    pub fn plan(&self, model: &Model) -> Arc<Plan> {
        Arc::clone(self.plan.get_or_init(|| Arc::new(Plan::of_motion(model))))
    }

    /// The model over lanes.
    pub fn wide(&self, model: &Model) -> &Model<Lanes> {
        self.wide.get_or_init(|| Box::new(model.lift()))
    }
}

impl<M: Deref<Target = Model>> Prepared<M> {
    /// Works out nothing yet.
    pub fn new(model: M) -> Self {
        Self { model, common: Common::default() }
    }

    /// The model.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Integrates the equations of motion from `start` to `options.t_end`, as [`dynamics`](super::dynamics) does.
    ///
    /// # Errors
    /// [`Failure`], with everything computed so far.
    pub fn dynamics(
        &self,
        start: &State,
        options: &Options,
        watch: impl FnMut(f64) -> Flow,
    ) -> Result<Run, Box<Failure>> {
        simulate((&self.model, &self.common), start, options, Eyes { watch, look: None })
    }
}
