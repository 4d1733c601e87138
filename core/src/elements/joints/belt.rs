//! Belt or chain: two wheels are joined by a belt that does not slip.
//!
//! θ is the direction from the centre of wheel i to the centre of wheel j. Relative to the line of centres, all
//! points of the belt have the same speed: Φ = rᵢ (φᵢ - θ) + σ rⱼ (φⱼ - θ) - offset = 0, with σ = -1 for an open belt
//! and σ = 1 for a crossed belt. θ has a branch cut, so that Φ is taken modulo 2π (rᵢ + σ rⱼ), nearest 0; if this
//! modulus is 0, θ cancels. λ is the difference of the forces of the two strands. The mechanism must hold the
//! distance of the centres at any value > 0.
//!
//! A belt with a preload that slips or whose strands are elastic is a force, `forces/loose_belt.rs`. A loose belt
//! without elasticity transmits a force only at the ends of its slack, `forces/play.rs`.

use crate::elements::wheels::{centres, nearest, radius_fault, rolled, whole_turn, TANGENTIAL};
use crate::elements::{
    element, measure, At, Attachment, Backlash, BodyId, Equation, Fixes, Joint, Mark, Required,
    ResultQuantity, SceneSymbol, Strands,
};
use crate::math::Real;

element! {
    /// Belt: a belt or chain connects two wheels without slip. Φ = r_i (angle_i - θ) + σ r_j
    /// (angle_j - θ) - offset, reduced modulo 2π (r_i + σ r_j) to the value nearest 0. θ is the
    /// direction from centre i to centre j. σ is -1 for an open belt and 1 for a crossed belt. The
    /// joints of the mechanism hold the distance of the centres. λ is the difference of the forces
    /// of the two strands. Wheel j carries the torque -σ λ r_j about its centre and the force λ
    /// (r_i + σ r_j)/distance normal to the line of centres. With `preload` and `friction`, the belt slips
    /// where |λ| reaches 2 preload tanh(friction β/2), with the smaller angle of wrap β. With
    /// `stiffness`, the strands are springs with the forces preload ± stiffness Φ, as long as they are
    /// taut. With `slack`, there is a force only beyond Φ = ±slack.
    Belt, "belt" {
        /// Centre of wheel i, as `body.point`.
        i: point,
        /// Centre of wheel j, as `body.point`.
        j: point,
        /// Radii of the wheels.
        radii: pair [m],
        /// Whether the strands cross, so that the wheels turn in opposite senses.
        crossed: flag = false,
        /// Constant that is subtracted in Φ.
        offset: number [m] = 0.0,
        /// Force of each strand without load.
        preload: optional_number [N],
        /// With `preload`: coefficient of friction between belt and wheels.
        friction: optional_number,
        /// Stiffness of each strand.
        stiffness: optional_number [N/m],
        /// Length by which each strand of a loose belt is too long.
        slack: optional_number [m],
    }
}

/// Fraction of the sum of the radii below which their difference counts as zero, so that θ cancels.
const EQUAL: f64 = 1e-5;

/// The field with the play of a loose belt.
const SLACK: &str = "slack";

impl Joint for Belt {
    const RESULTS: &'static [ResultQuantity] = &[TANGENTIAL];
    const LOOSE: &'static [&'static str] = &["preload", "stiffness", SLACK];

    fn bodies<S>(e: &Belt<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Belt<S>) -> Vec<Equation> {
        vec![Equation::length("tangential")]
    }

    fn residual<S: Real>(e: &Belt<S>, at: &At<'_, S>, phi: &mut [S]) {
        let ([r_i, r_j], d) = (e.radii, measure::apart(at, &e.i, &e.j));
        phi[0] = match e.crossed {
            true => nearest(rolled(d, e.radii, 1.0, at) - e.offset, r_i + r_j),
            false => {
                let x = rolled(d, e.radii, -1.0, at) - e.offset;
                S::select(differ(e.radii), nearest(x, r_i - r_j), x)
            }
        };
    }

    fn modulus(e: &Belt) -> Option<f64> {
        let [r_i, r_j] = e.radii;
        match e.crossed {
            true => Some(whole_turn(r_i + r_j)),
            false => (differ(e.radii) > 0.0).then(|| whole_turn(r_i - r_j)),
        }
    }

    fn backlash<S: Clone>(e: &Belt<S>) -> Option<Backlash<S>> {
        let size = e.slack.clone().filter(|_| e.stiffness.is_none())?;
        Some(Backlash { field: SLACK, size, half: 1.0, restitution: None })
    }

    fn strands<S: Clone>(e: &Belt<S>) -> Option<Strands<S>> {
        let Belt { preload, slack, stiffness, friction, radii, offset, crossed, .. } = e.clone();
        Some(Strands { preload, slack, stiffness, friction, radii, offset, crossed })
    }

    fn phase_mut<S>(e: &mut Belt<S>) -> Option<&mut S> {
        Some(&mut e.offset)
    }

    fn requires<S: Real>(e: &Belt<S>, at: &At<'_, S>) -> Vec<Required<S>> {
        centres(measure::apart(at, &e.i, &e.j), None)
    }

    fn symbols(e: &Belt) -> Vec<SceneSymbol> {
        let mut all = SceneSymbol::wheels([Mark::Circle; 2], e.radii, [&e.i, &e.j]);
        let mark = if e.crossed { Mark::CrossedStrands } else { Mark::OpenStrands };
        all.push(SceneSymbol::between_points(mark, &e.i, &e.j).to_scale(e.radii));
        all
    }

    fn results<S: Real>(_: &Belt<S>, _: &At<'_, S>, lam: &[S], out: &mut [S]) {
        out[0] = lam[0];
    }

    fn attachment<S: Real>(e: &Belt<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, e.j.s][body], axis: S::zero() }
    }

    fn fixes<S: Clone>(_: &Belt<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Turn]
    }

    fn fault(e: &Belt) -> Option<(&'static str, String)> {
        let of_radii = e.radii.iter().find_map(|radius| radius_fault("radii", *radius, false));
        of_radii
            .or_else(|| fault_of_strands(e).map(|(field, must)| (field, must.to_string())))
            .or_else(|| fault_of_slack(e))
    }
}

/// The fault of a slack that covers all angles of the wheels.
fn fault_of_slack(e: &Belt) -> Option<(&'static str, String)> {
    let most = 0.5 * <Belt as Joint>::modulus(e)?.abs();
    let message = || {
        format!("must be less than {most} m, half a turn of the line of centres; otherwise give stiffness")
    };
    (e.stiffness.is_none() && e.slack? >= most).then(|| (SLACK, message()))
}

/// The fault of a field of the strands.
fn fault_of_strands(e: &Belt) -> Option<(&'static str, &'static str)> {
    let positive = [("preload", e.preload), ("stiffness", e.stiffness), (SLACK, e.slack)];
    if let Some((field, _)) = positive.into_iter().find(|(_, x)| x.is_some_and(|x| x <= 0.0)) {
        return Some((field, "must be > 0; otherwise remove it"));
    }
    match (e.preload, e.friction, e.stiffness, e.slack) {
        (_, Some(friction), ..) if friction < 0.0 => Some(("friction", "must not be negative")),
        (_, Some(_), Some(_), _) => Some(("friction", "not together with stiffness; remove one")),
        (None, Some(_), ..) => Some(("friction", "needs preload")),
        (Some(_), .., Some(_)) => Some((SLACK, "not together with preload; remove one")),
        (Some(_), None, None, _) => Some(("preload", "needs friction or stiffness")),
        _ => None,
    }
}

/// Positive if the radii differ, so that θ does not cancel.
fn differ<S: Real>([r_i, r_j]: [S; 2]) -> S {
    (r_i - r_j).abs() - S::constant(EQUAL) * (r_i + r_j)
}
