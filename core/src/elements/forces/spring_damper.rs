//! Translational spring-damper (Haug 6.2.10): a force along the line between two points.
//!
//! With d = Pⱼ - Pᵢ, l = |d| and u = d/l, the force on j is -(k (l - l₀) + c l̇ + p) u with l̇ = uᵀ ḋ, and the
//! opposite force acts on i. V = ½ k (l - l₀)² + p (l - l₀).
//!
//! The stiffness part is computed as -k d + (k l₀ - p) u, so that it is exactly -k d for l₀ = p = 0, without a
//! division. Where the points coincide, l = 0 and the line has no direction. The term (k l₀ - p) u, which jumps
//! there, is taken as zero, its mean over all directions. The damping force is -c ḋ, its limit on both sides of a
//! passage. All states are allowed, and the force is always finite.
//!
//! An element that only pulls is slack for l < l₀, and an element that only pushes is slack for l > l₀. A slack
//! element has no force and no energy. Elsewhere, damping cannot reverse the sum k (l - l₀) + c l̇ + p: where it
//! would, the force is zero, and the damper dissipates the power of the spring. Both changes are switches. So is a
//! third one: the spring begins where k (l - l₀) + p has the only sense. With a preload against this sense, that is
//! beyond l₀, and V is the energy stored from there on, (k (l - l₀) + p)²/(2 k).

use crate::elements::line::Line;
use crate::elements::{
    element, measure, At, BodyId, Clearance, Force, Mark, Measured, Nature, Only, Part,
    SceneSymbol, Situation, Wrenches,
};
use crate::math::{Listed, Local, Real, Vec2};

element! {
    /// Translational spring-damper between two points (Haug 6.2.10). With their distance l, the
    /// force on body j along the line from i to j is -(stiffness (l - free_length) + damping
    /// dl/dt + preload). The opposite force acts on body i. Where the points meet, the line has no
    /// direction: the stiffness force is then zero, and the damping force is -damping times the
    /// relative velocity. With `only`, the force is zero where the element is slack, at l <
    /// free_length for tension and at l > free_length for compression. Elsewhere the force never
    /// has the opposite sense.
    SpringDamper, "spring_damper" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Force per length.
        stiffness: law [N/m] = 0.0,
        /// Force per velocity.
        damping: law [N*s/m] = 0.0,
        /// Distance of the points at which the spring is relaxed.
        free_length: law [m] = 0.0,
        /// Force of the relaxed spring; a positive value pulls the points together.
        preload: law [N] = 0.0,
        /// The only sense of the force: `tension` pulls, `compression` pushes.
        only: optional_only,
    }
}

/// The indices of the switches of an element with `only`.
const TAUT: usize = 0;
const ACTS: usize = 1;
const STORES: usize = 2;

/// The forces along the line, > 0 if they pull.
struct Pull<S> {
    /// The elongation, or the shortening of an element that only pushes.
    beyond: S,
    /// The part of stiffness and preload.
    elastic: S,
    /// The part of damping.
    damping: S,
    /// The sum, > 0 in the only sense.
    sum: S,
    /// The preload, > 0 in the only sense.
    preload: S,
    /// Positive where the spring acts: the part of stiffness and preload in the only sense, or 1 where the preload
    /// has this sense.
    stores: S,
}

fn pull<S: Real>(
    e: &SpringDamper<S>,
    only: Only,
    at: &Situation<'_, S>,
    line: &Line<S>,
) -> Pull<S> {
    let stretch = line.length - e.free_length;
    let elastic = e.stiffness * stretch + e.preload;
    let damping = e.damping * line.u.dot(apart(e, at));
    let sum = elastic + damping;
    let [beyond, preload, inner, sum] = match only {
        Only::Tension => [stretch, e.preload, elastic, sum],
        Only::Compression => [-stretch, -e.preload, -elastic, -sum],
    };
    let stores = S::select(-preload, inner, S::one());
    Pull { beyond, elastic, damping, sum, preload, stores }
}

/// ḋ.
#[inline]
fn apart<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>) -> Vec2<S> {
    at.j().point_velocity(e.j.s) - at.i().point_velocity(e.i.s)
}

/// The forces of stiffness and of damping on body j.
fn both_senses<S: Real>(
    e: &SpringDamper<S>,
    at: &Situation<'_, S>,
    line: &Line<S>,
) -> [Vec2<S>; 2] {
    let (apart, u) = (apart(e, at), line.u);
    let rate = u.dot(apart);
    let along = |u: S, apart: S| S::select(line.squared, u * rate, apart);
    let damped = Vec2::new(along(u.x, apart.x), along(u.y, apart.y));
    let elastic = (line.d - u.scale(e.free_length)).scale(e.stiffness) + u.scale(e.preload);
    [-elastic, -damped.scale(e.damping)]
}

/// The force of an element that only pulls or pushes.
#[inline]
fn one_sense<S: Real>(
    e: &SpringDamper<S>,
    only: Only,
    at: &Situation<'_, S>,
    line: &Line<S>,
) -> [Vec2<S>; 2] {
    let Pull { beyond, elastic, damping, sum, stores, .. } = pull(e, only, at, line);
    let taut = |force: S| at.choose(TAUT, beyond, force, S::zero());
    let spring = at.choose(STORES, stores, elastic, S::zero());
    let rest = at.choose(ACTS, sum, damping + (elastic - spring), -spring);
    [-line.u.scale(taut(spring)), -line.u.scale(taut(rest))]
}

impl Force for SpringDamper {
    const MEASURED: &'static [Measured] = &[Measured::LENGTH];
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
    ];

    #[inline]
    fn bodies<S>(e: &SpringDamper<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    #[inline]
    fn measure<S: Real>(e: &SpringDamper<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::length(at, &e.i, &e.j);
    }

    fn symbols(e: &SpringDamper) -> Vec<SceneSymbol> {
        let elastic = e.stiffness != 0.0 || e.preload != 0.0;
        [(elastic, Mark::Spring), (e.damping != 0.0, Mark::Dashpot)]
            .into_iter()
            .filter(|(acts, _)| *acts)
            .map(|(_, mark)| SceneSymbol::between_points(mark, &e.i, &e.j))
            .list()
    }

    fn action<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let line = Line::new(at, &e.i, &e.j);
        let forces = match e.only {
            None => both_senses(e, at, &line),
            Some(only) => one_sense(e, only, at, &line),
        };
        for (part, force) in forces.into_iter().enumerate() {
            let [on_i, on_j] = line.wrenches(force);
            out.put(part, 0, on_i);
            out.put(part, 1, on_j);
        }
    }

    #[inline]
    fn switch_count<S: Real>(e: &SpringDamper<S>) -> usize {
        match e.only {
            None => 0,
            Some(_) => 3,
        }
    }

    #[inline]
    fn switches<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>, out: &mut [S]) {
        if let Some(only) = e.only {
            let Pull { beyond, sum, stores, .. } = pull(e, only, at, &Line::new(at, &e.i, &e.j));
            (out[TAUT], out[ACTS], out[STORES]) = (beyond, sum, stores);
        }
    }

    fn clearances(e: &SpringDamper) -> Vec<Clearance<'_>> {
        let sign = e.only.map(|only| match only {
            Only::Tension => -1.0,
            Only::Compression => 1.0,
        });
        let line = |sign| Clearance::Length { i: &e.i, j: &e.j, length: e.free_length, sign };
        sign.map(line).into_iter().list()
    }

    #[inline]
    fn points<S: Real>(e: &SpringDamper<S>) -> Option<[Local<S>; 2]> {
        Some([e.i.s, e.j.s])
    }

    fn potential<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>) -> S {
        let line = Line::new(at, &e.i, &e.j);
        let stretch = line.length - e.free_length;
        let half = S::constant(0.5);
        let energy = half * e.stiffness * stretch * stretch + e.preload * stretch;
        let Some(only) = e.only else { return energy };
        let Pull { beyond, elastic, preload, stores, .. } = pull(e, only, at, &line);
        let stiffness = S::select(e.stiffness, e.stiffness, S::one());
        let beyond_play =
            at.choose(STORES, stores, half * elastic * elastic / stiffness, S::zero());
        let stored = S::select(-preload, beyond_play, energy);
        at.choose(TAUT, beyond, stored, S::zero())
    }
}
