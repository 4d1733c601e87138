//! The model over lanes, which solves several states at once.
//!
//! There is no such model in WebAssembly: lanes would run without vector registers, and pages would load a quarter
//! more code. A [`Wide`] has no value there, so the compiler removes the code that uses it.

use crate::math::Lanes;
use crate::model::Model;
#[cfg(target_arch = "wasm32")]
use std::{convert::Infallible, marker::PhantomData};

/// Number of states from which a model over lanes is faster.
#[cfg(not(target_arch = "wasm32"))]
const MANY: usize = 4 * Lanes::WIDTH;

/// A model over lanes.
#[cfg(not(target_arch = "wasm32"))]
#[derive(Clone, Copy)]
pub(super) struct Wide<'a>(&'a Model<Lanes>);

#[cfg(target_arch = "wasm32")]
#[derive(Clone, Copy)]
pub(super) struct Wide<'a>(PhantomData<&'a ()>, Infallible);

#[cfg(not(target_arch = "wasm32"))]
impl<'a> Wide<'a> {
    /// The model.
    pub fn model(self) -> &'a Model<Lanes> {
        self.0
    }
}

#[cfg(target_arch = "wasm32")]
impl<'a> Wide<'a> {
    #[inline(always)]
    pub fn model(self) -> &'a Model<Lanes> {
        match self.1 {}
    }
}

/// A model over lanes that is created at its first use.
#[derive(Debug, Default)]
pub(super) struct WideCell {
    /// The model is in a box because it needs the alignment of vector registers, which allocators of other languages
    /// do not provide.
    #[cfg(not(target_arch = "wasm32"))]
    made: std::sync::OnceLock<Box<Model<Lanes>>>,
}

impl WideCell {
    /// The model over lanes, if it solves this number of states faster.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn of(&self, model: &Model, states: usize) -> Option<Wide<'_>> {
        (states >= MANY).then(|| Wide(self.made.get_or_init(|| Box::new(model.lift()))))
    }

    #[cfg(target_arch = "wasm32")]
    #[inline(always)]
    pub fn of(&self, _model: &Model, _states: usize) -> Option<Wide<'_>> {
        None
    }
}
