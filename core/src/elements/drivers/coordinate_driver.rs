//! Coordinate driver (Haug 3.5.1, 3.5.2): a position quantity follows a law.
//!
//! Φ = c - value(t). c is a coordinate x, y or φ of a body, measured from ground, or a position quantity of a point
//! or of an element: the angle of a revolute joint, the displacement of a slide. The effort -λ acts between the two
//! bodies of the quantity. The law may use t and the positions of other bodies. If c is the place u of a joint on its
//! curve, the row of u in the equations of motion is λ + Φ_uᵀ λ_joint = 0: the reaction of the joint then has a part
//! along the curve, which does the work of the driver.
//!
//! The limit of its effort belongs to a force, `forces/drive_limit.rs`, which acts in runs of forward dynamics.

use crate::elements::{
    element, At, Attachment, BodyId, Equation, Fixes, Followed, Joint, QuantityKind, SceneSymbol,
};
use crate::math::Real;

element! {
    /// Coordinate driver: a position quantity is a given function of time, Φ = coordinate - value
    /// (Haug 3.5.1, 3.5.2). The driving force or torque is -λ on body j of the quantity and +λ on
    /// body i. The coordinates of a body are measured from ground. With `limit`, the effort in a run of
    /// `dynamics` has at most this magnitude: where more is needed, the drive gives the limit and falls
    /// behind or is pushed ahead, and it follows its law again, with the lag that it has then, as soon
    /// as the rates are equal and the limit suffices.
    CoordinateDriver, "coordinate_driver" {
        /// Driven quantity: `body.x`, `body.y`, `body.angle`, `body.point.x`, `joint.angle`, `joint.displacement`, the place `joint.u` on a curve, and so on.
        coordinate: coordinate,
        /// Value of the quantity, m or rad; may use `t` and the positions of other bodies.
        value: law [m|rad],
        /// Largest effort, N or N·m; may use `t` and the state. Without it, the effort has no limit. Negative values count as 0.
        limit: optional_law [N|N*m],
        /// Condition on any quantities. Once it has become true, the driver no longer acts.
        release: optional_condition,
    }
}

impl Joint for CoordinateDriver {
    fn bodies<S>(e: &CoordinateDriver<S>) -> Vec<BodyId> {
        e.coordinate.bodies().into()
    }

    fn drives<S>(e: &CoordinateDriver<S>) -> Option<&Followed<S>> {
        Some(&e.coordinate)
    }

    fn value<S>(e: &CoordinateDriver<S>) -> Option<&S> {
        Some(&e.value)
    }

    fn limit<S>(e: &CoordinateDriver<S>) -> Option<&S> {
        e.limit.as_ref()
    }

    fn lift_limit<S>(e: &mut CoordinateDriver<S>) {
        e.limit = None;
    }

    fn release<S>(e: &CoordinateDriver<S>) -> Option<&str> {
        e.release.as_deref()
    }

    fn equations<S>(e: &CoordinateDriver<S>) -> Vec<Equation> {
        vec![Equation { name: e.coordinate.label(), kind: e.coordinate.kind() }]
    }

    fn residual<S: Real>(e: &CoordinateDriver<S>, at: &At<'_, S>, phi: &mut [S]) {
        phi[0] = e.coordinate.value(at.i(), at.j()) - e.value;
    }

    fn symbols(e: &CoordinateDriver) -> Vec<SceneSymbol> {
        vec![SceneSymbol::drive(&e.coordinate)]
    }

    fn attachment<S: Real>(e: &CoordinateDriver<S>, body: usize) -> Attachment<S> {
        e.coordinate.attachment(body)
    }

    fn fixes<S: Clone>(e: &CoordinateDriver<S>) -> Vec<Fixes<S>> {
        match &e.coordinate {
            Followed::Coordinate(of) => vec![Fixes::Coordinate(*of, e.value.clone())],
            of if of.is_place() => Vec::new(),
            Followed::Quantity(of) if of.kind == QuantityKind::Angle => vec![Fixes::Turn],
            Followed::Quantity(_) => Vec::new(),
        }
    }
}
