//! The setting of a phase: changed parameters, released drivers, and the modes of forces.

use super::options::Options;
use crate::equations::energy;
use crate::equations::kinematics::Motions;
use crate::model::{ForceMode, Model, Problem};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Parameters that differ from the parameters of the model, drivers that are released, and the modes of forces that
/// have modes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// Values of parameters by name.
    pub parameters: Vec<(String, f64)>,
    /// Names of drivers.
    pub released: Vec<String>,
    /// Modes of forces.
    pub modes: Vec<ForceMode>,
}

impl Setting {
    /// The setting at the start of a run. The modes of forces are determined later.
    pub(super) fn of(options: &Options) -> Self {
        let (parameters, released) = (options.parameters.clone(), options.release.clone());
        Self { parameters, released, modes: Vec::new() }
    }

    /// Gives a parameter another value.
    pub(super) fn put(&mut self, name: String, value: f64) {
        match self.parameters.iter_mut().find(|(known, _)| *known == name) {
            Some((_, old)) => *old = value,
            None => self.parameters.push((name, value)),
        }
    }

    /// Whether parameters and released drivers equal those of another setting.
    pub(super) fn differs_in_modes_only(&self, other: &Self) -> bool {
        self.parameters == other.parameters && self.released == other.released
    }

    /// Whether the phase uses the given model unchanged.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// The model with these parameters, without these drivers, and with forces in these modes.
    ///
    /// # Errors
    /// All parameters and numbers with impossible values.
    pub fn model(&self, model: &Model) -> Result<Model, Vec<Problem>> {
        let open = self.open(model)?;
        Ok(if self.modes.is_empty() { open.into_owned() } else { open.in_modes(&self.modes) })
    }

    /// The model with these parameters and without these drivers. The modes of forces are not set.
    ///
    /// # Errors
    /// The errors of [`model`](Self::model).
    pub fn open<'m>(&self, model: &'m Model) -> Result<Cow<'m, Model>, Vec<Problem>> {
        let changed = match self.parameters.is_empty() {
            true => Cow::Borrowed(model),
            false => Cow::Owned(model.with_values(&self.parameters)?),
        };
        Ok(match self.released.is_empty() {
            true => changed,
            false => Cow::Owned(changed.without(&self.released)),
        })
    }

    /// The kinetic and potential energy of a state y = (q, v, z, works), J.
    ///
    /// # Errors
    /// The errors of [`model`](Self::model).
    pub(super) fn energy(&self, model: &Model, t: f64, y: &[f64]) -> Result<f64, Vec<Problem>> {
        let own = self.open(model)?;
        let [q, v, z, _] = own.layout.split(y);
        let motions = Motions::at(&own.layout, q, v);
        Ok(energy::kinetic(&own, &motions) + energy::potential(&own, &motions, z, t))
    }
}
