//! Coupling: a linear relation of position quantities.
//!
//! Φ = Σ factorₖ quantityₖ - value = 0. With the multiplier λ, the effort -λ factorₖ acts on body j of quantity k,
//! and the opposite effort on its body i. All positions are allowed.

use crate::elements::{element, At, Attachment, BodyId, Equation, Joint, SceneSymbol};
use crate::math::{Local, Real};

element! {
    /// Coupling: a linear relation of position quantities, Φ = Σ factor × quantity - value. The
    /// effort -λ × factor acts on body j of each quantity, and the opposite effort acts on its body
    /// i.
    Coupling, "coupling" {
        /// Factors of position quantities, such as `{ "A.angle" = 2, "S.displacement" = -1 }`.
        terms: terms,
        /// Value of the sum; may use `t` and positions.
        value: law [m|rad] = 0.0,
        /// Unit of the sum, `m` or `rad`; the unit of the first quantity if absent.
        unit: optional_unit,
    }
}

/// The bodies of all quantities, each once, in the order of the terms.
fn bodies<S>(e: &Coupling<S>) -> Vec<BodyId> {
    let mut all = Vec::new();
    for body in e.terms.iter().flat_map(|(of, _)| of.bodies()) {
        if !all.contains(&body) {
            all.push(body);
        }
    }
    all
}

impl Joint for Coupling {
    fn bodies<S>(e: &Coupling<S>) -> Vec<BodyId> {
        bodies(e)
    }

    fn equations<S>(e: &Coupling<S>) -> Vec<Equation> {
        let first = e.terms.first().map(|(of, _)| of.kind());
        vec![Equation { name: "sum", kind: e.unit.or(first).unwrap_or_default() }]
    }

    fn residual<S: Real>(e: &Coupling<S>, at: &At<'_, S>, phi: &mut [S]) {
        let places = bodies(e);
        let pose = |body: BodyId| {
            let place = places.iter().position(|known| *known == body).unwrap_or(0);
            &at.bodies[place]
        };
        phi[0] = -e.value;
        for (of, factor) in &e.terms {
            let [i, j] = of.bodies();
            phi[0] += *factor * of.value(pose(i), pose(j));
        }
    }

    fn symbols(_: &Coupling) -> Vec<SceneSymbol> {
        Vec::new()
    }

    fn attachment<S: Real>(_: &Coupling<S>, _: usize) -> Attachment<S> {
        Attachment { s: Local::zero(), axis: S::zero() }
    }
}
