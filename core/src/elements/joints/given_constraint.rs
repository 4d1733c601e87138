//! Constraint by formulas: each residual is a formula of positions and time.
//!
//! Φₖ = residualₖ(q, t) = 0. Its derivatives follow from the formulas. The reaction on a body is -Φ_qᵀ λ in its
//! columns, about the origin of its frame. All positions at which the formulas have a value are allowed.

use crate::elements::{element, At, Attachment, BodyId, Equation, Joint, QuantityKind};
use crate::math::{Listed, Local, Real};

element! {
    /// Constraint by formulas: Φ = residual, with one formula of positions and `t` for each
    /// equation. The force and torque on a body are the entries of -Φ_qᵀ λ for its coordinates,
    /// about the origin of its frame.
    GivenConstraint, "constraint" {
        /// Formulas that must be zero; may use `t` and positions.
        residual: laws [any],
        /// Unit of each formula, `m` or `rad`.
        units: units,
    }
}

const NAMES: [&str; 6] = ["r1", "r2", "r3", "r4", "r5", "r6"];

impl Joint for GivenConstraint {
    /// There are no bodies here: they follow from the formulas.
    fn bodies<S>(_: &GivenConstraint<S>) -> Vec<BodyId> {
        Vec::new()
    }

    fn equations<S>(e: &GivenConstraint<S>) -> Vec<Equation> {
        let kinds = e.units.iter().copied().chain(std::iter::repeat(QuantityKind::Length));
        let names = NAMES.iter().take(e.residual.len());
        names.zip(kinds).map(|(name, kind)| Equation { name, kind }).list()
    }

    fn residual<S: Real>(e: &GivenConstraint<S>, _: &At<'_, S>, phi: &mut [S]) {
        phi.copy_from_slice(&e.residual[..phi.len()]);
    }

    fn attachment<S: Real>(_: &GivenConstraint<S>, _: usize) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }

    fn fault(e: &GivenConstraint) -> Option<(&'static str, String)> {
        let (formulas, units) = (e.residual.len(), e.units.len());
        if formulas > NAMES.len() {
            let message = format!("{formulas} formulas; at most {} in one constraint", NAMES.len());
            return Some(("residual", message));
        }
        let message = format!("{units} units for {formulas} formulas; give one for each formula");
        (units != formulas).then_some(("units", message))
    }
}
