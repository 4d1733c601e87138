//! A pin of body j in a bush of body i: a revolute joint with clearance c = R - r.
//!
//! The gap is c - |d| with d from the centre of the bush to that of the pin. The pin touches the bush at the place in the
//! direction of d, with the forces of `elements/pressing.rs`.
//!
//! It is the contact of a circle of body i with the radius -R and a circle of body j with the radius -r and with its
//! body at the right. A circle with a negative radius touches with its farthest point in place of its nearest one; all
//! equations of two circles hold. The growing u then runs clockwise about the pin.

use crate::elements::hertz::Compliance;
use crate::elements::pressing::{Amount, Presses, Pressing};
use crate::elements::{
    element, At, BodyId, Clearance, Curve, CurveOn, Group, Mark, NormalLaw, Required, Rim,
    SceneSymbol, Side, SymbolEnd,
};
use std::borrow::Cow;

element! {
    /// A pin around the point of j in a bush around the point of i. The pin moves within the bush and touches it
    /// where the distance of the points is `clearance`. It presses, rubs and hits as a `contact`. With
    /// `restitution`, bush and pin are rigid; with `stiffness`, the depth is the distance of the points minus
    /// `clearance`.
    ClearanceJoint, "clearance" {
        /// Centre of the bush, as `body.point`.
        i: point,
        /// Centre of the pin, as `body.point`.
        j: point,
        /// Radius of the bush.
        radius: number [m],
        /// Radius of the bush minus radius of the pin.
        clearance: number [m],
        /// Force in N at a depth of 1 m, as a number without a unit; in N/m for an exponent of 1.
        stiffness: optional_number [any],
        /// Exponent of the depth.
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
        /// Coefficient of friction while the pin slides.
        friction: number = 0.0,
        /// Coefficient of friction up to which the pin sticks; friction if absent.
        r#static: optional_number,
        /// Tangential velocity at which the friction has 76 % of its full value. Without it, the pin
        /// may stick.
        velocity: optional_number [m/s],
        /// Rate after an impact over the rate before it, from 0 to 1; in place of `stiffness`, or with it as the number
        /// from which `law` computes the damping.
        restitution: optional_number,
        /// With `restitution`: rate below which the pin rests on the bush.
        rest_speed: number [m/s] = 1e-9,
        /// Worn volume for each newton and each metre of sliding (Archard); for compliant contacts. The
        /// states sliding_distance and wear_volume then begin at 0.
        wear: number [m^2/N] = 0.0,
    }
}

impl Presses for ClearanceJoint {
    const GROUP: Group = Group::Joints;

    fn pressing<S: Amount>(e: &ClearanceJoint<S>) -> Pressing<'_, S> {
        let (center, radius) = (e.j.s.clone(), e.clearance.clone() - e.radius.clone());
        let curve = CurveOn { body: e.j.body, curve: Curve::Circle { center, radius } };
        Pressing {
            i: &e.i,
            curve: Cow::Owned(Rim::new(curve)),
            radius: -e.radius.clone(),
            side: Side::Left,
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

    fn pair<S>(e: &ClearanceJoint<S>) -> [BodyId; 2] {
        [e.i.body, e.j.body]
    }

    fn has_formulas<S>(_: &ClearanceJoint<S>) -> bool {
        true
    }

    fn is_compliant<S>(e: &ClearanceJoint<S>) -> bool {
        e.restitution.is_none() || e.law.keeps_speed()
    }

    fn law<S>(e: &ClearanceJoint<S>) -> NormalLaw {
        e.law
    }

    fn clearance(e: &ClearanceJoint) -> Clearance<'_> {
        Clearance::Length { i: &e.i, j: &e.j, length: e.clearance, sign: -1.0 }
    }

    fn play(e: &ClearanceJoint) -> Option<(&'static str, f64)> {
        Some(("clearance", e.clearance))
    }

    fn requires(e: &ClearanceJoint, at: &At<'_, f64>) -> Option<Required<f64>> {
        let apart = (at.j().point(e.j.s) - at.i().point(e.i.s)).norm();
        Some(Required {
            what: "depth of the centre of the pin within the bush",
            is: e.radius - apart,
            must: None,
            remedy: "set the positions of the bodies so that the pin lies in its bush; a state of the model with a revolute joint \
                     in its place is such a start, as from_state",
        })
    }

    fn symbols(e: &ClearanceJoint) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i), SymbolEnd::point(&e.j));
        vec![SceneSymbol::new(Mark::Pin, i, j)]
    }

    fn fault(e: &ClearanceJoint) -> Option<(&'static str, String)> {
        let ClearanceJoint { radius, clearance, .. } = *e;
        let must = |field, value: f64, must: &str| Some((field, format!("{value} m; must {must}")));
        match clearance {
            _ if radius <= 0.0 => must("radius", radius, "be > 0"),
            c if c <= 0.0 => must("clearance", c, "be > 0; without clearance, use revolute"),
            c if c >= radius => {
                let below = format!("be below radius, {radius} m, so that the pin has a radius");
                must("clearance", c, &below)
            }
            _ => None,
        }
    }
}
