//! Friction at rest against friction that slides.

use super::forces::{at_state, situation, Acting};
use super::kinematics::Motions;
use crate::elements::{Mode, Situation};
use crate::model::Model;

/// The largest effort of friction `k` at rest relative to its effort while it slides slowly; 1 without load.
pub fn static_ratio(model: &Model, k: usize, motions: &Motions, acting: Acting<'_, f64>) -> f64 {
    let element = at_state(model, &model.forces[k], motions, acting);
    let at = Situation { mode: Mode::Slides(1.0), ..situation(model, k, motions, acting) };
    let mut slides = [0.0; 3];
    element.results(&at, &mut slides);
    let ratio = element.limit(&at).0 / slides[0].abs();
    if ratio.is_finite() {
        ratio
    } else {
        1.0
    }
}
