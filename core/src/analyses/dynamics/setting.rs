//! The setting of a phase: changed parameters, released drivers, and the modes of forces.

use super::options::Options;
use crate::model::{ForceMode, Model, Problem};

/// Parameters that differ from those of the model, drivers that no longer act, and the modes of forces that have any.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// Values of parameters by name.
    pub parameters: Vec<(String, f64)>,
    /// Names of drivers.
    pub released: Vec<String>,
    /// Modes of forces.
    pub modes: Vec<ForceMode>,
}

impl Setting {
    /// The setting at the start of a run; the modes of forces are not decided yet.
    pub(super) fn of(options: &Options) -> Self {
        let (parameters, released) = (options.parameters.clone(), options.release.clone());
        Self { parameters, released, modes: Vec::new() }
    }

    /// Whether the model of a phase is the given one.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// The model with these parameters, without these drivers, and with forces in these modes.
    ///
    /// # Errors
    /// All parameters and numbers with an impossible value.
    pub fn model(&self, model: &Model) -> Result<Model, Vec<Problem>> {
        let open = self.open(model)?;
        Ok(if self.modes.is_empty() { open } else { open.in_modes(&self.modes) })
    }

    /// The model with these parameters and without these drivers. The modes of forces follow from the state.
    ///
    /// # Errors
    /// As [`model`](Self::model).
    pub fn open(&self, model: &Model) -> Result<Model, Vec<Problem>> {
        let changed = match self.parameters.is_empty() {
            true => model.clone(),
            false => model.with_values(&self.parameters)?,
        };
        Ok(if self.released.is_empty() { changed } else { changed.without(&self.released) })
    }
}
