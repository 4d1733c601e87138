//! Changes of the modes of contacts and friction that do not end.

use super::failure::{Failure, Reason};
use super::setting::Setting;
use crate::model::{ForceMode, Model};
use serde::{Deserialize, Serialize};

/// Counts changes of mode that occur at one time.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Stall {
    t: f64,
    count: usize,
    /// The forces that ceased to hold at this time. If several reach their limits together, none may hold again
    /// because another one has just ceased.
    pub ceased: Vec<usize>,
}

impl Stall {
    /// Largest number of changes at one time: a constant, and the addition for each force with modes.
    const MOST: [usize; 2] = [200, 20];
    /// Times count as equal within this number of floating-point spacings.
    const SPACINGS: f64 = 64.0;

    /// Counts a change at `t`.
    ///
    /// # Errors
    /// Too many changes at one time.
    pub fn look(&mut self, model: &Model, t: f64, setting: &Setting) -> Result<(), Box<Failure>> {
        let one_time = (t - self.t).abs() <= Self::SPACINGS * f64::EPSILON * t.abs();
        (self.t, self.count) = (t, if one_time { self.count + 1 } else { 0 });
        if !one_time {
            self.ceased.clear();
        }
        let [most, each] = Self::MOST;
        if self.count <= most + each * setting.modes.len() {
            return Ok(());
        }
        let mut names: Vec<&str> = Vec::new();
        for of in &setting.modes {
            let name = model.forces[of.force].name.as_str();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let message = format!(
            "contacts or friction change their modes without end at t = {t:.6} s, among them {}",
            names.join(", ")
        );
        let hint =
            "give a stop or contact a stiffness in place of restitution, or friction a velocity";
        Err(Reason::Integration { t, message, hint }.into())
    }

    /// Notes the forces that have ceased to hold.
    pub fn note(&mut self, before: &[ForceMode], after: &[ForceMode]) {
        let ceased = |(old, new): &(&ForceMode, &ForceMode)| old.mode.holds() && !new.mode.holds();
        let all = before.iter().zip(after).filter(ceased).map(|(old, _)| old.force);
        self.ceased.extend(all);
    }
}
