//! Stop: a position quantity s(q) does not pass a lower or an upper limit.
//!
//! For a compliant stop with the depth δ beyond a limit, N = max(0, k δⁿ (1 + c δ̇)). The effort on the quantity is N
//! at the lower limit and -N at the upper limit, and the force on the coordinates of each body is the effort times
//! ∂s/∂q. Onset, release and the sign of 1 + c δ̇ are switches, so that steps end there.
//!
//! With a coefficient of restitution e, there is no depth. If the quantity reaches a limit with the rate ṡ, it leaves
//! the limit with the rate -e ṡ after an impact of the whole mechanism, or it rests at the limit, held by one
//! equation.
//!
//! The gap is the smaller of s - lower and upper - s. It is positive between the limits.

use crate::elements::hertz::{self, ContactDamping, Depth, Elastic, Hertz, SWITCHES};
use crate::elements::{
    element, holding, Acted, At, Behaviour, BodyId, Clearance, Constraint, Followed, Force, Mark,
    Measured, Nature, Part, QuantityKind, ResultQuantity, SceneSymbol, Situation, SymbolEnd,
    Wrenches,
};
use crate::expression::Tape;
use crate::math::{Listed, Local, Real};
use std::f64::consts::{FRAC_PI_2, PI};

element! {
    /// Stop: a position quantity has a lower limit, an upper limit or both. Beyond a limit, the
    /// effort N = max(0, stiffness × depth^exponent × (1 + damping × d depth/dt)) pushes the
    /// quantity back. With `restitution`, the quantity instead leaves the limit with -restitution
    /// times the rate of its arrival, or rests at the limit. The effort acts on both bodies of the
    /// quantity in opposite directions. If the quantity has a single body, the opposite effort acts
    /// on ground. Give one limit or both, and either `stiffness` or `restitution`.
    Stop, "stop" {
        /// The quantity, such as `crank.angle`, `crank.B.x` or `slide.displacement`.
        coordinate: acted,
        /// Lower limit of the quantity.
        lower: optional_number [m|rad],
        /// Upper limit of the quantity.
        upper: optional_number [m|rad],
        /// Force or torque at a depth of 1 m or 1 rad: K of K*depth^exponent, in N/m^exponent or N*m/rad^exponent.
        /// It is written without a unit. For an exponent of 1, it is the stiffness in N/m or N*m/rad.
        stiffness: optional_number [any],
        /// Exponent of the depth.
        exponent: number = 1.0,
        /// Damping factor: the force is multiplied by 1 + damping × rate of the depth.
        damping: number [s/m|s/rad] = 0.0,
        /// Rate after an impact over the rate before it, from 0 to 1; in place of `stiffness`.
        restitution: optional_number,
        /// With `restitution`: rate below which the quantity rests at the limit.
        rest_speed: number [m/s|rad/s] = 1e-9,
    }
}

/// The signs of the effort on the coordinate at the lower and at the upper limit.
const SIGNS: [f64; 2] = [1.0, -1.0];

/// s and ṡ.
fn coordinate<S: Real>(of: &Acted<S>, at: &Situation<'_, S>) -> [S; 2] {
    [of.of.value(&at.i().pose, &at.j().pose), at.rate(of)]
}

/// The limits that exist, each with its index in [`SIGNS`] and its value.
fn limits<S: Real>(e: &Stop<S>) -> impl Iterator<Item = (usize, S)> {
    [e.lower, e.upper].into_iter().enumerate().filter_map(|(k, limit)| Some((k, limit?)))
}

/// The depth beyond a limit.
fn depth<S: Real>([s, rate]: [S; 2], (k, limit): (usize, S)) -> Depth<S> {
    let sign = S::constant(SIGNS[k]);
    Depth { value: sign * (limit - s), rate: -(sign * rate) }
}

/// The distance to the nearest limit.
fn gap<S: Real>(e: &Stop<S>, s: S) -> S {
    let apart = |of: (usize, S)| -depth([s, S::zero()], of).value;
    limits(e).map(apart).reduce(S::min).unwrap_or(S::constant(f64::INFINITY))
}

/// The law of a compliant stop.
fn law<S: Real>(e: &Stop<S>) -> Option<Hertz<S>> {
    let (exponent, damping) = (e.exponent, e.damping);
    let damping = ContactDamping::Constant(damping);
    e.stiffness.map(|stiffness| Hertz { elastic: Elastic::Power(stiffness, exponent), damping })
}

/// The efforts of stiffness and damping.
fn efforts<S: Real>(e: &Stop<S>, at: &Situation<'_, S>) -> [S; 2] {
    let Some(law) = law(e) else {
        let held = if at.mode.holds() { -at.multiplier } else { S::zero() };
        return [held, S::zero()];
    };
    let s = coordinate(&e.coordinate, at);
    let mut sum = [S::zero(); 2];
    for (place, limit) in limits(e).enumerate() {
        if let Some(n) = law.normal(at, SWITCHES * place, depth(s, limit)) {
            let sign = S::constant(SIGNS[limit.0]);
            sum = [sum[0] + sign * n.elastic, sum[1] + sign * n.damping];
        }
    }
    sum
}

/// A stop at a limit; the axis points away from the range.
fn symbol(of: &Followed, (k, limit): (usize, f64)) -> Option<SceneSymbol> {
    let SceneSymbol { mark, i, j, .. } = SceneSymbol::drive(of);
    if mark == Mark::DriveTurn {
        return Some(SceneSymbol::new(Mark::TurnStop, i.along(limit), j));
    }
    let axis = match of.label() {
        "x" | "displacement" => i.axis,
        "y" => FRAC_PI_2,
        _ => return None,
    };
    let from = i.point.unwrap_or(Local::zero());
    let at = Local::new(from.x + limit * axis.cos(), from.y + limit * axis.sin());
    let outward = if SIGNS[k] > 0.0 { axis + PI } else { axis };
    let i = SymbolEnd { point: Some(at), ..i }.along(outward);
    Some(SceneSymbol::new(Mark::ShiftStop, i, j))
}

impl Force for Stop {
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
    ];
    const MEASURED: &'static [Measured] = &[Measured::GAP];
    const FOLLOWS: bool = true;
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &Stop<S>) -> Vec<BodyId> {
        e.coordinate.of.bodies().into()
    }

    fn measured<S>(e: &Stop<S>) -> &'static [Measured] {
        match e.coordinate.of.kind() {
            QuantityKind::Angle => const { &[Measured::angle(Measured::GAP.names)] },
            _ => Self::MEASURED,
        }
    }

    fn measure<S: Real>(e: &Stop<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = gap(e, e.coordinate.of.value(at.i(), at.j()));
    }

    fn action<S: Real>(e: &Stop<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        for (part, effort) in efforts(e, at).into_iter().enumerate() {
            for (body, wrench) in e.coordinate.wrenches(effort).into_iter().enumerate() {
                out.put(part, body, wrench);
            }
        }
    }

    fn switch_count<S: Real>(e: &Stop<S>) -> usize {
        let limits = usize::from(e.lower.is_some()) + usize::from(e.upper.is_some());
        if e.stiffness.is_some() {
            SWITCHES * limits
        } else {
            0
        }
    }

    fn switches<S: Real>(e: &Stop<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let Some(law) = law(e) else { return };
        let s = coordinate(&e.coordinate, at);
        for (out, limit) in out.chunks_exact_mut(SWITCHES).zip(limits(e)) {
            law.switches(at, depth(s, limit), out);
        }
    }

    fn potential<S: Real>(e: &Stop<S>, at: &Situation<'_, S>) -> S {
        let Some(law) = law(e) else { return S::zero() };
        let s = coordinate(&e.coordinate, at);
        let of = |(k, limit)| law.potential(at, SWITCHES * k, depth(s, limit).value);
        limits(e).enumerate().map(|(k, limit)| of((k, limit))).fold(S::zero(), |sum, x| sum + x)
    }

    fn result_quantities<S>(e: &Stop<S>) -> &'static [ResultQuantity] {
        match e.coordinate.of.kind() {
            QuantityKind::Angle => {
                &[ResultQuantity { name: "torque", unit: "N*m", negative: None }]
            }
            _ => &[ResultQuantity { name: "force", unit: "N", negative: None }],
        }
    }

    fn results<S: Real>(e: &Stop<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let [elastic, damping] = efforts(e, at);
        out[0] = elastic + damping;
    }

    fn behaviour<S: Real>(e: &Stop<S>) -> Option<Behaviour<S>> {
        let (rest_speed, exponent, damping) = (e.rest_speed, e.exponent, Some(e.damping));
        let compliant = |stiffness| Behaviour::Compliant { stiffness, exponent, damping };
        let impacts = |restitution| Behaviour::Impacts { restitution, rest_speed };
        e.restitution.map(impacts).or(e.stiffness.map(compliant))
    }

    fn threshold<S: Real>(e: &Stop<S>, at: &Situation<'_, S>) -> S {
        gap(e, e.coordinate.of.value(&at.i().pose, &at.j().pose))
    }

    fn side<S: Real>(e: &Stop<S>, at: &Situation<'_, S>) -> f64 {
        let s = e.coordinate.of.value(&at.i().pose, &at.j().pose);
        let apart = |limit: &(usize, S)| -depth([s, S::zero()], *limit).value.in_lanes()[0];
        let nearest = limits(e).min_by(|a, b| apart(a).total_cmp(&apart(b)));
        nearest.map_or(-1.0, |(k, _)| -SIGNS[k])
    }

    fn clearances(e: &Stop) -> Vec<Clearance<'_>> {
        limits(e).map(|(k, limit)| Clearance::Limit { limit, sign: SIGNS[k] }).list()
    }

    fn followed<S>(e: &Stop<S>) -> Option<&Followed<S>> {
        Some(&e.coordinate.of)
    }

    fn holding(e: &Stop<Tape>, side: f64, value: f64) -> Option<Constraint<Tape>> {
        let limit = match side {
            0.0 => Tape::from(value),
            side if side < 0.0 => e.lower.clone()?,
            _ => e.upper.clone()?,
        };
        Some(holding(e.coordinate.of.clone(), limit))
    }

    fn symbols(e: &Stop) -> Vec<SceneSymbol> {
        limits(e).filter_map(|limit| symbol(&e.coordinate.of, limit)).list()
    }

    fn fault(e: &Stop) -> Option<(&'static str, String)> {
        match (e.lower, e.upper) {
            (None, None) => Some(("lower", "missing; give lower, upper or both".to_string())),
            (Some(a), Some(b)) if a >= b => {
                Some(("upper", format!("{b}; must be larger than lower, {a}")))
            }
            _ => hertz::fault(
                e.stiffness,
                [e.exponent, 1.0],
                e.damping,
                [e.restitution, Some(e.rest_speed)],
            ),
        }
    }
}
