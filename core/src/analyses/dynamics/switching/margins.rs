//! The margins of the held pieces during a step, with their bounds.

use super::forms::SwitchForm;
use super::{Switching, AGAIN};
use crate::analyses::step_part::{self, StepPart};
use crate::expression::Boundaries;
use crate::integrate::{scan, Bounds, Direction, Scan, Step, StepPath, TooFast, Watch};
use crate::math::Real;
use crate::model::Model;

/// The margins of the held pieces.
struct Margins<'s> {
    switching: &'s mut Switching,
    model: &'s Model,
    on_state: &'s [usize],
    pieces: Vec<f64>,
}

impl Watch for Margins<'_> {
    fn values(&mut self, t: f64, y: &[f64], some: &[usize], out: &mut [f64]) {
        self.switching.evaluate(self.model, t, y);
        for index in some {
            let k = self.on_state[*index];
            let boundaries = &self.model.switches[k].boundaries;
            out[*index] = boundaries.margin(self.switching.sigma[k], self.pieces[k]);
        }
    }

    fn bounds(&mut self, index: usize, path: &StepPath<'_>, span: [f64; 2]) -> Option<Bounds> {
        let switch = self.on_state[index];
        let part = StepPart::new(self.model, path, span, &self.pieces);
        let sigma = match &self.switching.forms[index] {
            SwitchForm::Law(tape) => part.switch(tape, switch),
            SwitchForm::Clearance(force, place) => -part.apart(*force, Some(*place))?,
            // it is 1 where the bodies are apart, so that only a contact that is held has to be bounded
            SwitchForm::Pushes(..)
                if self.pieces[switch - 1] < 0.0 && self.pieces[switch] > 0.0 =>
            {
                Bounds::one()
            }
            SwitchForm::Pushes(force, place) => part.pushes(*force, *place)?,
            SwitchForm::Column(column) => part.column(*column, false),
            SwitchForm::Unknown => return None,
        };
        margin(&self.model.switches[switch].boundaries, sigma, self.pieces[switch])
    }

    fn converges(&self, index: usize) -> bool {
        matches!(self.switching.forms[index], SwitchForm::Clearance(..))
    }
}

/// Bounds of the margin of a piece.
fn margin(boundaries: &Boundaries, sigma: Bounds, piece: f64) -> Option<Bounds> {
    if piece.is_nan() {
        return None;
    }
    let [low, high] = boundaries.of(piece);
    let (above, below) = (sigma - Bounds::constant(low), Bounds::constant(high) - sigma);
    Some(match (low.is_finite(), high.is_finite()) {
        (true, true) => above.min(below),
        (true, false) => above,
        (false, _) => below,
    })
}

impl Switching {
    /// The first crossings of the margins of the held pieces. With a more accurate interpolant the crossing may be
    /// slightly earlier than the due time, so it is approached in a few repetitions.
    pub(super) fn scan(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        spacing: f64,
    ) -> Result<Scan, TooFast> {
        let on_state = std::mem::take(&mut self.on_state);
        let due = self.due.take();
        let (sign, length) = (self.sign, (step.t - step.t_old).abs());
        let until = |index: usize| {
            let due = due.as_ref()?;
            let is_due = due.changes.iter().any(|(switch, _)| *switch == on_state[index]);
            let earlier = if due.tries >= AGAIN { length } else { 1e3 * spacing };
            is_due.then_some(due.t - sign * earlier)
        };
        let (count, pieces) = (on_state.len(), self.pieces.clone());
        let mut margins = Margins { switching: self, model, on_state: &on_state, pieces };
        let parts = step_part::parts(model, step);
        let scanned =
            scan(&StepPath::new(step), (count, parts), &mut margins, Direction::Falling, &until);
        let scanned = scanned.map_err(|TooFast(index)| TooFast(on_state[index]));
        (self.on_state, self.due) = (on_state, due);
        scanned
    }

    /// The functions of all switches at a time of a step.
    pub(super) fn evaluate_at(&mut self, model: &Model, step: &Step<'_>, t: f64) {
        let mut y = step.y.to_vec();
        if t != step.t {
            step.interpolate(t, &mut y);
        }
        self.evaluate(model, t, &y);
    }
}
