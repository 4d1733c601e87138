//! Failures of contacts and friction that no motion agrees with.

use super::failure::{positions, Failure, Reason};
use super::options::Jam;
use crate::analyses::rigid::is_rigid;
use crate::model::Model;

/// The advice that is left out where it is followed.
const USE_IMPACT: &str = ", or use jam = \"impact\"";

/// The friction paradox of a joint, at these positions.
fn jammed(t: f64, joint: &str, positions: &str) -> String {
    format!(
        "friction paradox (Painlevé) in joint {joint} at t = {t:.6} s: no reaction agrees with the friction that it \
         causes, so that the mechanism jams ({positions}); reduce the coefficient of friction, or give the friction a \
         constant load"
    )
}

/// The contact that rests by a row.
fn contact_at(model: &Model, row: usize) -> Option<usize> {
    let rests = |k: &usize| model.forces[*k].held_row == Some(row) && is_rigid(model, *k);
    (0..model.forces.len()).find(rests)
}

impl Failure {
    /// Failure of forces that no reaction of a row agrees with.
    pub(super) fn reaction(model: &Model, t: f64, q: &[f64], row: usize) -> Box<Self> {
        if let Some(contact) = contact_at(model, row) {
            return Self::paradox(model, t, contact);
        }
        let name = model.constraints[model.layout.owner(row).0].name.clone();
        let message = jammed(t, &name, &positions(model, q));
        Reason::Singular { t, name, message }.into()
    }

    /// Failure of a contact whose sliding has no solution.
    pub(super) fn paradox(model: &Model, t: f64, contact: usize) -> Box<Self> {
        let name = model.forces[contact].name.clone();
        let message = format!(
            "friction paradox (Painlevé) in contact {name} at t = {t:.6} s: no normal force agrees with the friction that it \
             causes, so that the contact jams; reduce its friction or give it a stiffness in place of restitution{USE_IMPACT}"
        );
        Reason::Singular { t, name, message }.into()
    }

    /// The failure without advice that a run with these options follows.
    pub(super) fn advised(mut self: Box<Self>, jam: Jam) -> Box<Self> {
        match &mut self.reason {
            Reason::Singular { message, .. } if jam == Jam::Impact => {
                *message = message.replace(USE_IMPACT, "");
            }
            _ => {}
        }
        self
    }

    /// Failure of a stop, contact or friction whose mode contradicts its motion, although others were tried.
    pub(super) fn contradiction(model: &Model, t: f64, force: usize) -> Box<Self> {
        let name = model.forces[force].name.clone();
        let message = format!(
            "at t = {t:.6} s no combination was found in which all closed contacts press or separate and all friction \
             sticks or slides by its law: {name} contradicts it; reduce the friction, or give a stiffness in place of \
             restitution"
        );
        Reason::Singular { t, name, message }.into()
    }

    /// Failure of a contact beyond the end of its curve.
    pub(super) fn off_the_curve(t: f64, message: &str) -> Box<Self> {
        let message = format!("{message} at t = {t:.6} s");
        let hint = "extend the range of the curve, or end the run before";
        Reason::Integration { t, message, hint }.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_that_is_followed_is_left_out() {
        let message = |jam: Jam| {
            let message = format!("reduce its friction{USE_IMPACT}");
            let failure =
                Box::<Failure>::from(Reason::Singular { t: 0.0, name: String::new(), message });
            match failure.advised(jam).reason {
                Reason::Singular { message, .. } => message,
                _ => String::new(),
            }
        };
        assert_eq!(message(Jam::Impact), "reduce its friction");
        assert!(message(Jam::Refuse).ends_with("or use jam = \"impact\""));
    }
}
