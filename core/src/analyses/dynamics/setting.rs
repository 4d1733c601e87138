//! The setting of a phase: changed parameters and released drivers.

use crate::model::{Model, Problem};

/// Parameters that differ from those of the model, and drivers that no longer act.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// Values of parameters by name.
    pub parameters: Vec<(String, f64)>,
    /// Names of drivers.
    pub released: Vec<String>,
}

impl Setting {
    /// Whether the model of a phase is the given one.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// The model with these parameters and without these drivers.
    ///
    /// # Errors
    /// Every number that cannot be right.
    pub fn model(&self, model: &Model) -> Result<Model, Vec<Problem>> {
        let changed = match self.parameters.is_empty() {
            true => model.clone(),
            false => model.with_values(&self.parameters)?,
        };
        Ok(if self.released.is_empty() { changed } else { changed.without(&self.released) })
    }
}
