//! A belt that slips or whose strands are elastic.
//!
//! With the equation Φ of the belt, the strands have the forces F₁ and F₂ with λ = F₁ - F₂; the force on the coordinates
//! is -Φ_qᵀ λ. Without load, both have the preload F₀.
//!
//! * A belt that slips keeps F₁ + F₂ = 2 F₀. On a wheel with the angle of wrap β, it slips where the greater force is
//!   exp(μ β) times the smaller one (Euler 1762, Eytelwein 1808), so that |λ| is at most 2 F₀ tanh(μ β/2). The wheel
//!   with the smaller β decides. While the belt does not slip, an equation holds Φ. The mass of the belt is neglected.
//! * Elastic strands of stiffness k have F₁ = F₀ + k Φ and F₂ = F₀ - k Φ as long as these are not negative; a slack
//!   strand has none. A loose belt has a negative F₀, -k times its slack.
//!
//! Both strands also pull the wheels towards each other, with (F₁ + F₂) cos γ, where γ is the angle between a strand and
//! the line of centres: sin γ = (rᵢ + σ rⱼ)/d. The centres are held at the distance d, so that this force does no work.
//!
//! The element is written as the joint. `coordinate` is -Φ.

use crate::elements::declare::{Element, Table};
use crate::elements::{
    acted, Acted, At, Attachment, Behaviour, BodyId, Constraint, Followed, Force, Group, Kind,
    Mode, Nature, Part, Required, ResultQuantity, SceneSymbol, Situation, Source, Strands,
    Wrenches,
};
use crate::expression::Tape;
use crate::math::{Listed, Real, ShortArray, Vec2, Wrench};
use std::f64::consts::PI;

/// A belt that slips or whose strands are elastic.
#[derive(Clone, Debug)]
pub struct LooseBelt<S = f64> {
    /// The belt, which has [strands](Constraint::strands).
    pub joint: Box<Constraint<S>>,
    /// The opposite of its equation.
    pub coordinate: Acted<S>,
    /// Whether its strands are elastic.
    pub is_elastic: bool,
}

impl Element for LooseBelt {
    type Over<S> = LooseBelt<S>;
    const NAME: &'static str = "loose belt";

    /// It has no fields, because no file contains it.
    fn table() -> Table {
        Table { name: Self::NAME, doc: String::new(), fields: Vec::new() }
    }

    fn read(_: &mut dyn Source) -> Option<LooseBelt<Tape>> {
        None
    }

    fn map<S, T>(e: &LooseBelt<S>, f: &mut dyn FnMut(&S) -> T) -> LooseBelt<T> {
        let joint = Box::new(e.joint.map(f));
        let coordinate = acted::map(&e.coordinate, f);
        LooseBelt { joint, coordinate, is_elastic: e.is_elastic }
    }

    fn scalars<S>(e: &LooseBelt<S>) -> Vec<usize> {
        let mut count = 0;
        acted::map(&e.coordinate, &mut |_: &S| count += 1);
        e.joint.scalars().into_iter().chain([count]).list()
    }
}

/// The forces of the two strands.
struct StrandForces<S> {
    /// F₁, F₂.
    strands: [S; 2],
    /// Rate at which the belt slips, m/s: that of Φ.
    sliding: S,
    /// Unit vector from centre i to centre j.
    along: Vec2<S>,
    /// cos γ.
    cosine: S,
}

impl<S: Real> LooseBelt<S> {
    fn strands(&self) -> Strands<S> {
        let nan = S::constant(f64::NAN);
        self.joint.strands().unwrap_or(Strands {
            preload: None,
            slack: None,
            stiffness: None,
            friction: None,
            radii: [nan; 2],
            offset: nan,
            crossed: false,
        })
    }

    /// The places of the centres on bodies i and j, from the origins of the bodies.
    fn centres(&self, at: &Situation<'_, S>) -> [Vec2<S>; 2] {
        [0, 1].each(|body| {
            let Attachment { s, .. } = self.joint.attachment(body);
            at.body(body).pose.global(s)
        })
    }

    /// Unit vector from centre i to centre j, and sin γ.
    fn line(&self, at: &Situation<'_, S>) -> (Vec2<S>, S) {
        let [from_i, from_j] = self.centres(at);
        let d = at.j().pose.r + from_j - (at.i().pose.r + from_i);
        let (Strands { radii: [r_i, r_j], crossed, .. }, distance) = (self.strands(), d.norm());
        let r_j = if crossed { r_j } else { -r_j };
        (d.scale(S::one() / distance), (r_i + r_j) / distance)
    }

    /// The rate of Φ.
    fn sliding(&self, at: &Situation<'_, S>) -> S {
        -at.rate(&self.coordinate)
    }

    /// The largest |λ| of a belt that slips.
    fn most(&self, sine: S) -> S {
        let (Strands { preload, friction, crossed, .. }, zero) = (self.strands(), S::zero());
        let cosine = (S::one() - sine * sine).sqrt();
        let twice = S::constant(2.0) * sine.atan2(cosine);
        // strands that cross make both angles of wrap greater, others make one of them smaller
        let wrap = S::constant(PI) + if crossed { twice } else { -twice.abs() };
        let half = S::constant(0.5) * friction.unwrap_or(zero) * wrap;
        S::constant(2.0) * preload.unwrap_or(zero) * half.tanh()
    }

    /// Preload and stiffness of elastic strands, and Φ.
    fn springs(&self, at: &Situation<'_, S>) -> Option<[S; 3]> {
        let Strands { preload, slack, stiffness, .. } = self.strands();
        let (stiffness, value) = (stiffness?, self.coordinate.of.value(&at.i().pose, &at.j().pose));
        let loose = -slack.unwrap_or_else(S::zero) * stiffness;
        Some([preload.unwrap_or(loose), stiffness, -value])
    }

    /// The force of each elastic strand, positive while it is taut, as if it could push.
    fn stretched(&self, at: &Situation<'_, S>) -> Option<[S; 2]> {
        let [preload, stiffness, phi] = self.springs(at)?;
        Some([preload + stiffness * phi, preload - stiffness * phi])
    }

    fn pull(&self, at: &Situation<'_, S>) -> StrandForces<S> {
        let (zero, half) = (S::zero(), S::constant(0.5));
        let (along, sine) = self.line(at);
        let sliding = self.sliding(at);
        let taut = |k: usize, force: S| at.choose(k, force, force, zero);
        let strands = match self.stretched(at) {
            Some([first, second]) => [taut(0, first), taut(1, second)],
            None => {
                let (preload, lam) =
                    (self.strands().preload.unwrap_or(zero), -self.effort_of(at, sliding, sine));
                [preload + half * lam, preload - half * lam]
            }
        };
        StrandForces { strands, sliding, along, cosine: (S::one() - sine * sine).sqrt() }
    }

    /// The effort along Φ of a belt that slips: -λ.
    fn effort_of(&self, at: &Situation<'_, S>, sliding: S, sine: S) -> S {
        let (one, zero) = (S::one(), S::zero());
        let sense = match at.mode {
            mode if mode.holds() => return -at.multiplier,
            Mode::Slides(sign) => S::constant(sign),
            _ => S::select(sliding, one, S::select(-sliding, -one, zero)),
        };
        -(sense * self.most(sine))
    }

    /// Puts the force with which the strands differ, as an effort along Φ.
    fn put(&self, part: usize, effort: S, out: &mut impl Wrenches<S>) {
        for (body, wrench) in self.coordinate.wrenches(-effort).into_iter().enumerate() {
            out.put(part, body, wrench);
        }
    }
}

/// The indices of the parts.
const STRANDS: usize = 0;
const FRICTION: usize = 1;

impl Force for LooseBelt {
    const PARTS: &'static [Part] = &[
        Part { name: "strands", nature: Nature::Conservative },
        Part { name: "friction", nature: Nature::Dissipative },
    ];
    const GROUP: Group = Group::Joints;
    const FOLLOWS: bool = true;
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &LooseBelt<S>) -> Vec<BodyId> {
        e.coordinate.of.bodies().into()
    }

    fn joint<S>(e: &LooseBelt<S>) -> Option<&Constraint<S>> {
        Some(&e.joint)
    }

    fn effort<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        (e.effort_of(at, e.sliding(at), e.line(at).1), Wrench::zero())
    }

    fn put_effort<S: Real>(
        e: &LooseBelt<S>,
        _: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        e.put(FRICTION, effort, &mut out);
    }

    fn requires(e: &LooseBelt, at: &At<'_, f64>) -> Option<Required<f64>> {
        let Strands { radii: [r_i, r_j], crossed, .. } = e.strands();
        let [p_i, p_j] = [0, 1].each(|k| at.bodies[k].point(e.joint.attachment(k).s));
        let (what, beside) = match crossed {
            true => ("distance of the centres less the sum of the radii", r_i + r_j),
            false => {
                ("distance of the centres less the difference of the radii", (r_i - r_j).abs())
            }
        };
        Some(Required {
            what,
            is: (p_j - p_i).norm() - beside,
            must: None,
            remedy: "move the centres apart, so that neither wheel lies within the other",
        })
    }

    fn arms<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(e.centres(at))
    }

    fn action<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let StrandForces { strands: [first, second], along, cosine, .. } = e.pull(at);
        let part = if e.is_elastic { STRANDS } else { FRICTION };
        e.put(part, second - first, &mut out);
        let together = along.scale((first + second) * cosine);
        let [from_i, from_j] = e.centres(at);
        out.put(STRANDS, 0, Wrench::at(from_i, together));
        out.put(STRANDS, 1, Wrench::at(from_j, -together));
    }

    fn switch_count<S: Real>(e: &LooseBelt<S>) -> usize {
        if e.is_elastic {
            2
        } else {
            0
        }
    }

    fn switches<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>, out: &mut [S]) {
        if let Some(forces) = e.stretched(at) {
            out.copy_from_slice(&forces);
        }
    }

    fn result_quantities<S>(_: &LooseBelt<S>) -> &'static [ResultQuantity] {
        const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
            ResultQuantity { name, unit, negative: None }
        }
        const {
            &[
                of("tangential", "N"),
                of("tight", "N"),
                of("loose", "N"),
                of("sliding", "m/s"),
                of("sticking", ""),
            ]
        }
    }

    /// λ, the greater and the smaller force of the strands, the rate of the slip, and 1 while the belt does not slip.
    fn results<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let StrandForces { strands: [first, second], sliding, .. } = e.pull(at);
        let sticks = S::constant(f64::from(u8::from(e.is_elastic || at.mode.holds())));
        let sliding = if e.is_elastic { S::zero() } else { sliding };
        let (tight, loose) = (first.max(second), -(-first).max(-second));
        out.copy_from_slice(&[first - second, tight, loose, sliding, sticks]);
    }

    fn behaviour<S: Real>(e: &LooseBelt<S>) -> Option<Behaviour<S>> {
        (!e.is_elastic).then_some(Behaviour::Sticks)
    }

    fn threshold<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>) -> S {
        e.sliding(at)
    }

    fn limit<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        (e.most(e.line(at).1), Wrench::zero())
    }

    fn followed<S>(e: &LooseBelt<S>) -> Option<&Followed<S>> {
        Some(&e.coordinate.of)
    }

    fn holding(e: &LooseBelt<Tape>, _: f64, value: f64) -> Option<Constraint<Tape>> {
        let mut joint = e.joint.clone();
        let offset = joint.phase_mut()?;
        *offset = offset.clone().plus(value);
        Some(*joint)
    }

    fn potential<S: Real>(e: &LooseBelt<S>, at: &Situation<'_, S>) -> S {
        let (Some([first, second]), Some([_, stiffness, _])) = (e.stretched(at), e.springs(at))
        else {
            return S::zero();
        };
        let of = |k: usize, force: S| at.choose(k, force, force * force, S::zero());
        S::constant(0.5) * (of(0, first) + of(1, second)) / stiffness
    }

    fn symbols(e: &LooseBelt) -> Vec<SceneSymbol> {
        e.joint.symbols()
    }

    fn fault(e: &LooseBelt) -> Option<(&'static str, String)> {
        e.joint.fault()
    }
}
