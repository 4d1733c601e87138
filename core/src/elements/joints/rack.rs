//! Rack and pinion: wheel j rolls on the pitch line of body i. Other joints of the mechanism hold its centre at the
//! distance of its radius.
//!
//! With u the direction of the line and d = Pⱼ - Pᵢ: Φ = uᵀ d + r (φⱼ - φᵢ) - offset = 0. r > 0: the wheel is on the
//! left of u; r < 0: on its right. λ is the tangential force at the pitch line. The mechanism must hold the centre at
//! the distance r from the line, so that the force acts at the pitch point. With backlash, the element is a force,
//! `forces/play.rs`.

use crate::elements::wheels::{directions, radius_fault, BACKLASH, TANGENTIAL};
use crate::elements::{
    element, measure, At, Attachment, Backlash, BodyId, Equation, Fixes, Joint, Mark, Measured,
    Required, ResultQuantity, SceneSymbol, SymbolEnd,
};
use crate::math::Real;

element! {
    /// Rack and pinion: wheel j rolls on a line of body i. Φ = u·d + radius (angle_j - angle_i) -
    /// offset, where u is the direction of the line and d = point_j - point_i. The joints of the
    /// mechanism hold the centre at the distance radius to the left of the line. λ is the
    /// tangential force of the teeth. It acts at the pitch point: +λ along u on body i, and -λ on
    /// body j. With `backlash`, Φ is between -backlash/2 and backlash/2, and there is a force only at
    /// these limits.
    Rack, "rack" {
        /// Point of body i on the pitch line, as `body.point`.
        i: point,
        /// Centre of the pinion, as `body.point`.
        j: point,
        /// Radius of the pitch circle; > 0 for a pinion on the left of the line, < 0 on its right.
        radius: number [m],
        /// Angle of the line in the frame of body i.
        axis: number [rad] = 0.0,
        /// Constant that is subtracted in Φ.
        offset: number [m] = 0.0,
        /// Total play of the teeth along the pitch line.
        backlash: optional_number [m],
        /// With `backlash`: rate after a hit of the flanks over the rate before it, from 0 to 1.
        restitution: number = 0.0,
    }
}

impl Joint for Rack {
    const MEASURED: &'static [Measured] = &[Measured::DISPLACEMENT];
    const RESULTS: &'static [ResultQuantity] = &[TANGENTIAL];
    const LOOSE: &'static [&'static str] = &[BACKLASH];

    fn bodies<S>(e: &Rack<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &Rack<S>) -> Vec<Equation> {
        vec![Equation::length("tangential")]
    }

    fn residual<S: Real>(e: &Rack<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (u, _) = directions(e.axis, at.i());
        let turned = at.j().angle - at.i().angle;
        phi[0] = u.dot(measure::apart(at, &e.i, &e.j)) + e.radius * turned - e.offset;
    }

    fn backlash<S: Clone>(e: &Rack<S>) -> Option<Backlash<S>> {
        let restitution = Some(e.restitution.clone());
        e.backlash.clone().map(|size| Backlash { field: BACKLASH, size, half: 0.5, restitution })
    }

    fn requires<S: Real>(e: &Rack<S>, at: &At<'_, S>) -> Vec<Required<S>> {
        let (_, n) = directions(e.axis, at.i());
        vec![Required {
            what: "distance of the centre from the pitch line, to its left,",
            is: n.dot(measure::apart(at, &e.i, &e.j)),
            must: Some(e.radius),
            remedy: "hold line and centre by guides and pins at that distance; radius < 0 is a pinion on the right",
        }]
    }

    fn measure<S: Real>(e: &Rack<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::along(at, e.axis, &e.i, &e.j);
    }

    fn symbols(e: &Rack) -> Vec<SceneSymbol> {
        let (i, j) = (SymbolEnd::point(&e.i).along(e.axis), SymbolEnd::point(&e.j));
        let line = SceneSymbol::new(Mark::ToothedLine, i.clone(), j.clone());
        let pinion = SceneSymbol::new(Mark::ToothedWheel, i, j);
        vec![pinion.to_scale([0.0, e.radius.abs()]), line.to_scale([0.0, e.radius])]
    }

    fn results<S: Real>(_: &Rack<S>, _: &At<'_, S>, lam: &[S], out: &mut [S]) {
        out[0] = lam[0];
    }

    fn attachment<S: Real>(e: &Rack<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axis },
            _ => Attachment { s: e.j.s, axis: S::zero() },
        }
    }

    fn fixes<S: Clone>(_: &Rack<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Turn]
    }

    fn fault(e: &Rack) -> Option<(&'static str, String)> {
        let bare = e.backlash.unwrap_or(0.0) == 0.0 && e.restitution != 0.0;
        let of_hits = bare.then(|| ("restitution", "needs backlash; remove it".to_string()));
        radius_fault("radius", e.radius, true).or(of_hits)
    }
}
