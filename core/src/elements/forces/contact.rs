//! Contact of a point or circle of body i with a curve of body j.
//!
//! The gap is the distance of Pᵢ from the nearest point C(u) of the curve, minus the radius. The distance is positive
//! on the `side` of the curve. For a compliant contact with the depth δ = -gap, N = max(0, k δⁿ (1 + c δ̇)) (n = 1.5:
//! Hertz; the factor with c: Hunt and Crossley). N acts at C(u), on body j along -ν and on body i along ν, where ν is
//! the normal towards the side. The friction force on body i at C(u) is -μ N tanh(v/v₀) along growing u, with the
//! tangential velocity v of body i relative to body j.
//!
//! With a coefficient of restitution e, there is no depth. If the gap closes at the rate ġ, it opens at the rate -e ġ
//! after an impact of the whole mechanism, or the bodies rest on each other, held by the equation gap(q) = 0.
//!
//! An open curve ends with corners. The material of the body is on the other side of the curve.

use crate::elements::foot::Near;
use crate::elements::hertz::{self, Depth, Hertz, Normal, SWITCHES};
use crate::elements::{
    contact, element, At, Attachment, Behaviour, BodyId, Clearance, Constraint, Equation, Force,
    Joint, Mark, Measured, Nature, Part, PointOn, ResultQuantity, Rim, SceneSymbol, Side,
    Situation, SymbolEnd, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Local, Pose, Real, Vec2, Wrench};

element! {
    /// Contact of a point or circle of body i with a curve of body j. The gap is the distance of
    /// the point from the curve, positive on its `side`, minus `radius`. The depth is -gap. At a
    /// positive depth, the force stiffness × depth^exponent × (1 + damping × d depth/dt), if
    /// positive, pushes the bodies apart. It acts at the nearest point of the curve along the
    /// normal. The friction force at this point is friction × normal force × tanh(v/velocity),
    /// opposite to the tangential velocity v. With `restitution`, there is no friction: the bodies
    /// separate with -restitution times the rate of their approach, or rest on each other.
    Contact, "contact" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Curve of body j, as `body.curve`.
        curve: rim,
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
        /// Coefficient of friction; a value above 0 requires `velocity`.
        friction: number = 0.0,
        /// Tangential velocity at which the friction has 76 % of its full value.
        velocity: optional_number [m/s],
        /// Rate after an impact over the rate before it, from 0 to 1; in place of `stiffness`.
        restitution: optional_number,
        /// With `restitution`: rate below which the bodies rest on each other.
        rest_speed: number [m/s] = 1e-9,
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

/// The nearest point of the curve, for the poses of the bodies.
fn near<S: Real>(
    (on, rim, side): (&PointOn<S>, &Rim<S>, Side),
    i: &Pose<S>,
    j: &Pose<S>,
) -> Near<S> {
    rim.near(j.rotation.inverse(i.point(on.s) - j.r), side)
}

/// The state of the contact at the nearest point of the curve, in the global frame.
struct TouchPoint<S> {
    gap: S,
    gap_rate: S,
    /// The velocity along growing u.
    sliding: S,
    /// ν, away from body j, and the direction of growing u.
    away: Vec2<S>,
    along: Vec2<S>,
    /// The vectors from the origins of bodies i and j to the point of contact.
    arms: [Vec2<S>; 2],
}

impl<S: Real> TouchPoint<S> {
    fn new(e: &Contact<S>, at: &Situation<'_, S>) -> Self {
        let (i, j) = (at.i(), at.j());
        let Near { distance, away, place } = near((&e.i, &e.curve, e.side), &i.pose, &j.pose);
        let turned = S::constant(match e.side {
            Side::Right => 1.0,
            Side::Left => -1.0,
        });
        let away = j.pose.global(away);
        let along = away.perp().scale(turned);
        let on_j = j.pose.global(place);
        let on_i = j.pose.r + on_j - i.pose.r;
        let velocity = |arm: Vec2<S>, k: usize| {
            let twist = at.body(k).twist;
            twist.velocity + arm.perp().scale(twist.omega)
        };
        let apart = velocity(on_i, 0) - velocity(on_j, 1);
        Self {
            gap: distance - e.radius,
            gap_rate: away.dot(apart),
            sliding: along.dot(apart),
            away,
            along,
            arms: [on_i, on_j],
        }
    }

    fn depth(&self) -> Depth<S> {
        Depth { value: -self.gap, rate: -self.gap_rate }
    }

    /// The wrenches on bodies i and j of a force on i at the point of contact.
    fn wrenches(&self, force: Vec2<S>) -> [Wrench<S>; 2] {
        // adding zero removes negative zeros, which occur in lanes without contact
        let at = |arm, force| Wrench::at(arm, force) + Wrench::zero();
        [at(self.arms[0], force), at(self.arms[1], -force)]
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
        e.curve.is_closed_form()
    }

    fn measure<S: Real>(e: &Contact<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = near((&e.i, &e.curve, e.side), at.i(), at.j()).distance - e.radius;
    }

    fn arms<S: Real>(e: &Contact<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(TouchPoint::new(e, at).arms)
    }

    fn action<S: Real>(e: &Contact<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        if is_free(e, at) {
            return;
        }
        let touch = TouchPoint::new(e, at);
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
            law.switches(TouchPoint::new(e, at).depth(), out);
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
            ResultQuantity { name: "friction", unit: "N", negative: None },
        ]
    }

    /// N, and the friction force on body j along growing u.
    fn results<S: Real>(e: &Contact<S>, at: &Situation<'_, S>, out: &mut [S]) {
        out.fill(S::zero());
        let touch = TouchPoint::new(e, at);
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
        let near = near((&e.i, &e.curve, e.side), &at.i().pose, &at.j().pose);
        near.distance - e.radius
    }

    fn clearances(e: &Contact) -> Vec<Clearance<'_>> {
        vec![Clearance::Curve { i: &e.i, curve: &e.curve, side: e.side, radius: e.radius }]
    }

    fn holding(e: &Contact<Tape>, _: f64, _: f64) -> Option<Constraint<Tape>> {
        let (i, curve, radius) = (e.i.clone(), e.curve.clone(), e.radius.clone());
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
        match e.velocity {
            _ if e.radius < 0.0 => return refuse("radius", "must not be negative"),
            _ if e.friction < 0.0 => return refuse("friction", "must not be negative"),
            _ if e.friction > 0.0 && e.restitution.is_some() => {
                return refuse("friction", "not together with restitution; remove one of them");
            }
            None if e.friction > 0.0 => {
                return refuse("velocity", "missing; friction needs a velocity, such as 0.01");
            }
            Some(velocity) if velocity <= 0.0 => return refuse("velocity", "must be positive"),
            _ => {}
        }
        if curve.fault().is_none() {
            if let Some(message) = contact::cusp(curve) {
                return Some(("curve", message));
            }
        }
        hertz::fault(e.stiffness, [e.exponent, 1.5], e.damping, [e.restitution, Some(e.rest_speed)])
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
        phi[0] = near((&e.i, &e.curve, e.side), at.i(), at.j()).distance - e.radius;
    }

    fn attachment<S: Real>(e: &Resting<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, Local::zero()][body], axis: S::zero() }
    }

    fn contact<S: Real>(e: &Resting<S>, at: &At<'_, S>) -> Option<Local<S>> {
        Some(near((&e.i, &e.curve, e.side), at.i(), at.j()).place)
    }
}
