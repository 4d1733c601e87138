//! The margins of the held pieces during a step, with their bounds.

use super::Switching;
use crate::analyses::step_part::StepPart;
use crate::expression::{Boundaries, Tape};
use crate::integrate::{Bounds, Path, Step, Watch};
use crate::math::Real;
use crate::model::{Model, SwitchOwner, Variable};

/// The form of the function of a switch.
pub(super) enum SwitchForm {
    /// A formula in this law.
    Law(Tape),
    /// The opposite of a distance of a force, by its index.
    Clearance(usize, usize),
    /// An internal coordinate, by its column.
    Column(usize),
    /// A function of the state without bounds.
    Unknown,
}

impl SwitchForm {
    pub fn of(model: &Model, switch: usize) -> Self {
        let mut found = None;
        let mut look = |tape: &Tape| {
            if tape.switch_range().contains(&switch) {
                found = Some(tape.clone());
            }
        };
        let of_element = match model.switches[switch].owner {
            SwitchOwner::Constraint(k) => {
                let item = &model.constraints[k];
                if let Some(law) = &item.law {
                    law.map(&mut look);
                }
                match item.curve_switch == Some(switch) {
                    true => Self::Column(model.layout.constraints[k].own.first),
                    false => Self::Unknown,
                }
            }
            SwitchOwner::Force(k) => {
                let item = &model.forces[k];
                if let Some(law) = &item.law {
                    law.map(&mut look);
                }
                // a contact has two switches: its onset, and the sign of its force
                match switch.checked_sub(item.first_switch) {
                    Some(own) if own % 2 == 0 => Self::Clearance(k, own / 2),
                    _ => Self::Unknown,
                }
            }
        };
        let of_host = |tape: &Tape| {
            tape.variables().any(|k| matches!(Variable::at(k), Variable::Function(_)))
        };
        match found {
            Some(tape) if of_host(&tape) => Self::Unknown,
            Some(tape) => Self::Law(tape),
            None => of_element,
        }
    }
}

/// The margins of the held pieces.
pub(super) struct Margins<'s> {
    pub switching: &'s mut Switching,
    pub model: &'s Model,
    pub on_state: &'s [usize],
    pub pieces: Vec<f64>,
}

impl Watch for Margins<'_> {
    fn values(&mut self, t: f64, y: &[f64], out: &mut [f64]) {
        self.switching.evaluate(self.model, t, y);
        for (out, k) in out.iter_mut().zip(self.on_state) {
            let boundaries = &self.model.switches[*k].boundaries;
            *out = boundaries.margin(self.switching.sigma[*k], self.pieces[*k]);
        }
    }

    fn bounds(&mut self, index: usize, path: &Path<'_>, span: [f64; 2]) -> Option<Bounds> {
        let switch = self.on_state[index];
        let part = StepPart::new(self.model, path, span, &self.pieces);
        let sigma = match &self.switching.forms[index] {
            SwitchForm::Law(tape) => part.switch(tape, switch),
            SwitchForm::Clearance(force, place) => -part.clearance(*force, Some(*place))?,
            SwitchForm::Column(column) => part.column(*column, false),
            SwitchForm::Unknown => return None,
        };
        margin(&self.model.switches[switch].boundaries, sigma, self.pieces[switch])
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
    /// The functions of all switches at a time of a step.
    pub(super) fn evaluate_at(&mut self, model: &Model, step: &Step<'_>, t: f64) {
        let mut y = step.y.to_vec();
        if t != step.t {
            step.interpolate(t, &mut y);
        }
        self.evaluate(model, t, &y);
    }
}
