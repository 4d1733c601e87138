//! Contact of a point or circle of body i with a curve of body j.
//!
//! The gap is the distance of Pᵢ from the nearest point C(u) of the curve, minus the radius. The distance is positive
//! on the `side` of the curve. `elements/pressing.rs` contains the forces. A smooth curve of body i may touch in place of
//! the point, see `elements/curve_pair.rs`.
//!
//! With a coefficient of restitution e, there is no depth. If the gap closes at the rate ġ, it opens at the rate -e ġ
//! after an impact of the whole mechanism, or the bodies rest on each other, held by the equation gap(q) = 0.
//!
//! An open curve ends with corners. The material of the body is on the other side of the curve.

use crate::elements::hertz::Compliance;
use crate::elements::pressing::{Amount, Presses, Pressing};
use crate::elements::touch::CurveTouch;
use crate::elements::{
    contact, element, At, Attachment, BodyId, Clearance, Equation, Group, Joint, Mark, NormalLaw,
    SceneSymbol, SymbolEnd,
};
use crate::math::{Local, Real};
use std::borrow::Cow;

element! {
    /// Contact of a point or circle of body i with a curve of body j. The gap is the distance of
    /// the point from the curve, positive on its `side`, minus `radius`. The depth is -gap. At a
    /// positive depth, the force stiffness × depth^exponent × (1 + damping × d depth/dt), if
    /// positive, pushes the bodies apart. It acts at the nearest point of the curve along the
    /// normal. The friction force is friction × normal force, opposite to the tangential velocity v. Where
    /// v is zero, the contact may stick, up to static × normal force. With `velocity`, the friction
    /// force is friction × normal force × tanh(v/velocity), and never sticks. With `restitution`, the
    /// bodies separate with -restitution times the rate of their approach, or rest on each other.
    Contact, "contact" {
        /// Point of body i, as `body.point`.
        i: point_or_curves,
        /// Curve of body j, as `body.curve`.
        curve: rim_or_curves,
        /// Radius of the circle around the point; 0 for the point itself.
        radius: number [m] = 0.0,
        /// Side of the curve on which the point lies, seen in the direction of growing u.
        side: side = "right",
        /// Force in N at a depth of 1 m, as a number without a unit; in N/m for an exponent of 1.
        stiffness: optional_number [any],
        /// Exponent of the depth; 1.5 for a sphere on a plane (Hertz).
        exponent: number = 1.5,
        /// Damping factor: the force is multiplied by 1 + damping × rate of the depth.
        damping: number [s/m] = 0.0,
        /// Law of the force: that of `stiffness`, `exponent` and `damping`; for cylinders that of Hertz with `young`,
        /// `poisson`, `width` and `damping`; or `stiffness` and `exponent` with the damping of Lankarani and Nikravesh, or
        /// of Flores, which follows from `restitution` and from the state `impact_speed`, the speed of each impact.
        law: normal_law = "hunt_crossley",
        /// Modulus of elasticity of both cylinders.
        young: optional_number [Pa],
        /// Poisson's ratio of both cylinders.
        poisson: optional_number,
        /// Width of the cylinders.
        width: optional_number [m],
        /// Coefficient of friction while the contact slides.
        friction: number = 0.0,
        /// Coefficient of friction up to which the contact sticks; friction if absent.
        r#static: optional_number,
        /// Tangential velocity at which the friction has 76 % of its full value. Without it, the
        /// contact may stick.
        velocity: optional_number [m/s],
        /// Rate after an impact over the rate before it, from 0 to 1; in place of `stiffness`, or with it as the number
        /// from which `law` computes the damping.
        restitution: optional_number,
        /// With `restitution`: rate below which the bodies rest on each other.
        rest_speed: number [m/s] = 1e-9,
        /// Worn volume for each newton and each metre of sliding (Archard); for compliant contacts. The
        /// states sliding_distance and wear_volume then begin at 0.
        wear: number [m^2/N] = 0.0,
        /// Two curves that touch, of body i and of body j, in place of `i`, `curve` and `side`.
        curves: two_texts,
        /// The sides of the two curves on which the other one lies; right if absent.
        sides: two_texts,
    }
}

element! {
    /// Equation of a contact at rest: gap = 0. The force on body j is -λ ∂gap/∂q.
    Resting, "contact (at rest)" {
        /// Point of body i.
        i: point,
        /// Curve of body j.
        curve: rim,
        /// Radius of the circle around the point.
        radius: number [m],
        /// Side of the curve.
        side: side,
    }
}

impl Presses for Contact {
    const GROUP: Group = Group::Forces;

    fn pressing<S: Amount>(e: &Contact<S>) -> Pressing<'_, S> {
        Pressing {
            i: &e.i,
            curve: Cow::Borrowed(&e.curve),
            radius: e.radius.clone(),
            side: e.side,
            compliance: Compliance {
                law: e.law,
                stiffness: e.stiffness.clone(),
                exponent: e.exponent.clone(),
                damping: e.damping.clone(),
                young: e.young.clone(),
                poisson: e.poisson.clone(),
                width: e.width.clone(),
                restitution: e.restitution.clone(),
            },
            friction: e.friction.clone(),
            r#static: e.r#static.clone(),
            velocity: e.velocity.clone(),
            restitution: e.restitution.clone().filter(|_| !e.law.keeps_speed()),
            rest_speed: e.rest_speed.clone(),
            wear: e.wear.clone(),
        }
    }

    fn pair<S>(e: &Contact<S>) -> [BodyId; 2] {
        [e.i.body, e.curve.on.body]
    }

    fn has_formulas<S>(e: &Contact<S>) -> bool {
        e.curve.has_formulas()
    }

    fn is_compliant<S>(e: &Contact<S>) -> bool {
        e.restitution.is_none() || e.law.keeps_speed()
    }

    fn law<S>(e: &Contact<S>) -> NormalLaw {
        e.law
    }

    fn clearance(e: &Contact) -> Clearance<'_> {
        Clearance::Curve { i: &e.i, curve: &e.curve, side: e.side, radius: e.radius }
    }

    fn symbols(e: &Contact) -> Vec<SceneSymbol> {
        if e.curve.mate.is_some() {
            return Vec::new(); // its curves are drawn
        }
        let (i, j) = (SymbolEnd::point(&e.i), SymbolEnd::body(e.curve.on.body));
        vec![match e.radius > 0.0 {
            true => SceneSymbol::new(Mark::Round, i, j).to_scale([e.radius, 0.0]),
            false => SceneSymbol::new(Mark::Touch, i, j),
        }]
    }

    fn fault(e: &Contact) -> Option<(&'static str, String)> {
        if e.radius < 0.0 {
            return Some(("radius", "must not be negative".to_string()));
        }
        if e.curve.mate.is_some() {
            return e.curve.fault_of_pair(e.side).map(|message| ("curves", message));
        }
        let curve = &e.curve.on.curve;
        let searched = curve.fault().is_none() && !e.curve.is_closed_form();
        let cusp = searched.then(|| contact::cusp(curve)).flatten();
        cusp.map(|message| ("curve", message))
    }
}

impl<S: Real> Resting<S> {
    fn touch(&self) -> CurveTouch<'_, S> {
        let Self { ref i, ref curve, radius, side } = *self;
        CurveTouch { i, curve, radius, side }
    }
}

impl Joint for Resting {
    fn bodies<S>(e: &Resting<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.on.body]
    }

    fn equations<S>(_: &Resting<S>) -> Vec<Equation> {
        vec![Equation::length("gap")]
    }

    fn residual<S: Real>(e: &Resting<S>, at: &At<'_, S>, phi: &mut [S]) {
        phi[0] = e.touch().gap(at.i(), at.j());
    }

    fn attachment<S: Real>(e: &Resting<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, Local::zero()][body], axis: S::zero() }
    }

    fn contact<S: Real>(e: &Resting<S>, at: &At<'_, S>) -> Option<Local<S>> {
        Some(e.touch().near(at.i(), at.j()).place)
    }
}
