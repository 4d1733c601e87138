//! Contact of a point or circle of body i with a curve of body j.
//!
//! The gap is the distance of Pᵢ from the nearest point C(u) of the curve, minus the radius. The distance is positive
//! on the `side` of the curve. For a compliant contact with the depth δ = -gap, N = max(0, k δⁿ (1 + c δ̇)) (n = 1.5:
//! Hertz; the factor with c: Hunt and Crossley). N acts at C(u), on body j along -ν and on body i along ν, where ν is
//! the normal towards the side. With v₀, the friction force on body i at C(u) is -μ N tanh(v/v₀) along growing u, with the
//! tangential velocity v of body i relative to body j. Without v₀, the friction slides and sticks; it is an element of its
//! own, the companion of the contact.
//!
//! With a coefficient of restitution e, there is no depth. If the gap closes at the rate ġ, it opens at the rate -e ġ
//! after an impact of the whole mechanism, or the bodies rest on each other, held by the equation gap(q) = 0.
//!
//! An open curve ends with corners. The material of the body is on the other side of the curve.

use crate::elements::hertz::{self, Hertz, Normal, SWITCHES};
use crate::elements::touch::{CurveTouch, TouchPoint};
use crate::elements::{
    contact, element, At, Attachment, Behaviour, BodyId, Clearance, Constraint, ContactFriction,
    Equation, Force, ForceElement, Joint, Mark, Measured, Nature, Part, ResultQuantity,
    SceneSymbol, Situation, SymbolEnd, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Local, Real, Vec2};

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
        /// Coefficient of friction while the contact slides.
        friction: number = 0.0,
        /// Coefficient of friction up to which the contact sticks; friction if absent.
        r#static: optional_number,
        /// Tangential velocity at which the friction has 76 % of its full value. Without it, the
        /// contact may stick.
        velocity: optional_number [m/s],
        /// Rate after an impact over the rate before it, from 0 to 1; in place of `stiffness`.
        restitution: optional_number,
        /// With `restitution`: rate below which the bodies rest on each other.
        rest_speed: number [m/s] = 1e-9,
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

impl<S: Real> Contact<S> {
    fn touch(&self) -> CurveTouch<'_, S> {
        let Self { ref i, ref curve, radius, side, .. } = *self;
        CurveTouch { i, curve, radius, side }
    }

    /// The state at the place of action.
    fn point(&self, at: &Situation<'_, S>) -> TouchPoint<S> {
        match self.sticks() {
            true => self.touch().at_pitch(at),
            false => self.touch().at_foot(at),
        }
    }
}

impl<S> Contact<S> {
    /// Whether it may have friction that sticks.
    fn sticks(&self) -> bool {
        self.velocity.is_none() && self.curve.is_closed_form()
    }
}

/// The law of a compliant contact.
fn law<S: Real>(e: &Contact<S>) -> Option<Hertz<S>> {
    let (exponent, damping) = (e.exponent, e.damping);
    e.stiffness.map(|stiffness| Hertz { stiffness, exponent, damping })
}

/// The normal force; None if it is zero.
fn normal<S: Real>(
    e: &Contact<S>,
    at: &Situation<'_, S>,
    touch: &TouchPoint<S>,
) -> Option<Normal<S>> {
    match law(e) {
        Some(law) => law.normal(at, 0, touch.depth()),
        None if at.mode.holds() => Some(Normal { elastic: -at.multiplier, damping: S::zero() }),
        None => None,
    }
}

/// The friction force on body j along growing u.
fn friction<S: Real>(e: &Contact<S>, touch: &TouchPoint<S>, normal: S) -> Option<S> {
    let part = (touch.sliding / e.velocity?).tanh();
    Some(e.friction * normal * part)
}

/// Whether there is certainly no force, because the bodies were apart at the beginning of the step, or no equation
/// holds them.
fn is_free<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> bool {
    match e.stiffness {
        Some(_) => at.held.pieces.get(at.held.first).is_some_and(|piece| *piece < 0.0),
        None => !at.mode.holds(),
    }
}

impl Force for Contact {
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
        Part { name: "friction", nature: Nature::Dissipative },
    ];
    const TOUCHES_OR_RUBS: bool = true;
    const MEASURED: &'static [Measured] = &[Measured::GAP];

    fn bodies<S>(e: &Contact<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.on.body]
    }

    fn has_formulas<S>(e: &Contact<S>) -> bool {
        e.curve.has_formulas()
    }

    fn measure<S: Real>(e: &Contact<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = e.touch().gap(at.i(), at.j());
    }

    fn arms<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(e.point(at).arms)
    }

    fn action<S: Real>(e: &Contact<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        if is_free(e, at) {
            return;
        }
        let touch = e.point(at);
        let Some(normal) = normal(e, at, &touch) else { return };
        let mut put = |part: usize, force: Vec2<S>| {
            for (body, wrench) in touch.wrenches(force).into_iter().enumerate() {
                out.put(part, body, wrench);
            }
        };
        put(0, touch.away.scale(normal.elastic));
        put(1, touch.away.scale(normal.damping));
        if let Some(friction) = friction(e, &touch, normal.sum()) {
            put(2, -touch.along.scale(friction));
        }
    }

    fn switch_count<S>(e: &Contact<S>) -> usize {
        if e.stiffness.is_some() {
            SWITCHES
        } else {
            0
        }
    }

    fn switches<S: Real>(e: &Contact<S>, at: &Situation<'_, S>, out: &mut [S]) {
        if let Some(law) = law(e) {
            law.switches(e.point(at).depth(), out);
        }
    }

    fn potential<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> S {
        match law(e) {
            Some(law) if !is_free(e, at) => law.potential(at, 0, -Self::threshold(e, at)),
            _ => S::zero(),
        }
    }

    fn result_quantities<S>(_: &Contact<S>) -> &'static [ResultQuantity] {
        &[
            ResultQuantity { name: "force", unit: "N", negative: None },
            ResultQuantity { name: "tangential", unit: "N", negative: None },
            ResultQuantity { name: "sliding", unit: "m/s", negative: None },
            ResultQuantity { name: "sticking", unit: "", negative: None },
        ]
    }

    /// N, the friction force on body j along growing u, and the sliding velocity. Friction that sticks replaces the
    /// last three.
    fn results<S: Real>(e: &Contact<S>, at: &Situation<'_, S>, out: &mut [S]) {
        out.fill(S::zero());
        let touch = e.point(at);
        out[2] = touch.sliding;
        if let Some(normal) = normal(e, at, &touch).map(Normal::sum) {
            out[0] = normal;
            out[1] = friction(e, &touch, normal).unwrap_or(S::zero());
        }
    }

    fn behaviour<S: Real>(e: &Contact<S>) -> Option<Behaviour<S>> {
        let (rest_speed, exponent, damping) = (e.rest_speed, e.exponent, e.damping);
        let compliant = |stiffness| Behaviour::Compliant { stiffness, exponent, damping };
        let impacts = |restitution| Behaviour::Impacts { restitution, rest_speed };
        e.restitution.map(impacts).or(e.stiffness.map(compliant))
    }

    fn threshold<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> S {
        e.touch().gap(&at.i().pose, &at.j().pose)
    }

    fn companion(e: &Contact<Tape>) -> Option<ForceElement<Tape>> {
        let most = e.r#static.as_ref().unwrap_or(&e.friction);
        if !e.sticks() || most.constant() == Some(0.0) {
            return None;
        }
        let (i, curve, radius, side) = (e.i.clone(), e.curve.clone(), e.radius.clone(), e.side);
        let (exponent, damping) = (e.exponent.clone(), e.damping.clone());
        let (stiffness, kinetic) = (e.stiffness.clone(), e.friction.clone());
        let r#static = e.r#static.clone().unwrap_or_else(|| kinetic.clone());
        Some(ForceElement::ContactFriction(ContactFriction {
            i,
            curve,
            radius,
            side,
            stiffness,
            exponent,
            damping,
            kinetic,
            r#static,
        }))
    }

    fn clearances(e: &Contact) -> Vec<Clearance<'_>> {
        vec![Clearance::Curve { i: &e.i, curve: &e.curve, side: e.side, radius: e.radius }]
    }

    fn side<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> f64 {
        e.touch().side(at)
    }

    fn margin<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> Option<S> {
        e.touch().margin(at)
    }

    fn holding(e: &Contact<Tape>, side: f64, _: f64) -> Option<Constraint<Tape>> {
        let (i, curve, radius) = (e.i.clone(), e.curve.supporting(side), e.radius.clone());
        Some(Constraint::Resting(Resting { i, curve, radius, side: e.side }))
    }

    fn symbols(e: &Contact) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i), SymbolEnd::body(e.curve.on.body));
        vec![match e.radius > 0.0 {
            true => SceneSymbol::new(Mark::Round, i, j).to_scale([e.radius, 0.0]),
            false => SceneSymbol::new(Mark::Touch, i, j),
        }]
    }

    fn fault(e: &Contact) -> Option<(&'static str, String)> {
        let refuse = |field, message: &str| Some((field, message.to_string()));
        let curve = &e.curve.on.curve;
        let most = e.r#static.unwrap_or(e.friction);
        match e.velocity {
            _ if e.radius < 0.0 => return refuse("radius", "must not be negative"),
            _ if e.friction < 0.0 => return refuse("friction", "must not be negative"),
            _ if most < e.friction => return refuse("static", "must not be below friction"),
            None if most > 0.0 && !e.curve.is_closed_form() => {
                let message = "friction that sticks acts on lines and circles; on another curve give velocity, such as \
                               0.01, and stiffness";
                return refuse("friction", message);
            }
            Some(velocity) if velocity <= 0.0 => return refuse("velocity", "must be positive"),
            Some(_) if e.restitution.is_some() => {
                return refuse("velocity", "not together with restitution; remove it");
            }
            Some(_) if e.r#static.is_some() => {
                return refuse("static", "belongs to friction that sticks; remove velocity");
            }
            _ => {}
        }
        if curve.fault().is_none() && !e.curve.is_closed_form() {
            if let Some(message) = contact::cusp(curve) {
                return Some(("curve", message));
            }
        }
        hertz::fault(e.stiffness, [e.exponent, 1.5], e.damping, [e.restitution, Some(e.rest_speed)])
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
