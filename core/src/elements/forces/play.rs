//! A joint with play, such as a gear with backlash b: its only equation Φ is between -b/2 and b/2.
//!
//! Between these limits there is no force. At a limit, the flanks touch: after an impact of the whole mechanism they
//! separate with the restitution times the rate of their approach, or they rest on each other, held by one equation.
//! The tangential force λ has the sign that it has in the joint: the force on the coordinates is -Φ_qᵀ λ.
//!
//! The element is written as the joint. `coordinate` is s = -Φ, so that an effort along s is λ.

use crate::elements::declare::{Element, Table};
use crate::elements::wheels::TANGENTIAL;
use crate::elements::{
    acted, holding, Acted, At, Backlash, Behaviour, BodyId, Clearance, Constraint, Followed, Force,
    Group, Kind, Measured, Nature, Part, ResultQuantity, SceneSymbol, Situation, Source, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Listed, Real, ShortArray};

/// A joint with play.
#[derive(Clone, Debug)]
pub struct Play<S = f64> {
    /// The joint, which has one equation and [backlash](Constraint::backlash).
    pub joint: Box<Constraint<S>>,
    /// The opposite of its equation.
    pub coordinate: Acted<S>,
}

/// Rate below which the flanks rest on each other, m/s.
const REST_SPEED: f64 = 1e-9;

impl Element for Play {
    type Over<S> = Play<S>;
    const NAME: &'static str = "joint with play";

    /// It has no fields, because no file contains it.
    fn table() -> Table {
        Table { name: Self::NAME, doc: String::new(), fields: Vec::new() }
    }

    fn read(_: &mut dyn Source) -> Option<Play<Tape>> {
        None
    }

    fn map<S, T>(e: &Play<S>, f: &mut dyn FnMut(&S) -> T) -> Play<T> {
        let joint = Box::new(e.joint.map(f));
        Play { joint, coordinate: acted::map(&e.coordinate, f) }
    }

    fn scalars<S>(e: &Play<S>) -> Vec<usize> {
        let mut count = 0;
        acted::map(&e.coordinate, &mut |_: &S| count += 1);
        e.joint.scalars().into_iter().chain([count]).list()
    }
}

impl<S: Real> Play<S> {
    fn backlash(&self) -> Backlash<S> {
        let none =
            Backlash { field: "", size: S::constant(f64::NAN), half: 0.5, restitution: None };
        self.joint.backlash().unwrap_or(none)
    }

    fn half(&self) -> S {
        let Backlash { size, half, .. } = self.backlash();
        S::constant(half) * size
    }

    /// The force along s.
    fn effort(&self, at: &Situation<'_, S>) -> S {
        if at.mode.holds() {
            -at.multiplier
        } else {
            S::zero()
        }
    }
}

impl Force for Play {
    const PARTS: &'static [Part] = &[Part { name: "teeth", nature: Nature::Conservative }];
    const GROUP: Group = Group::Joints;
    const MEASURED: &'static [Measured] = &Measured::OF_PLAY;
    const FOLLOWS: bool = true;
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &Play<S>) -> Vec<BodyId> {
        e.coordinate.of.bodies().into()
    }

    fn joint<S>(e: &Play<S>) -> Option<&Constraint<S>> {
        Some(&e.joint)
    }

    fn play(e: &Play) -> Option<(&'static str, f64)> {
        Some((e.backlash().field, 2.0 * e.half()))
    }

    fn measure<S: Real>(e: &Play<S>, at: &At<'_, S>, out: &mut [S]) {
        let play = e.coordinate.of.value(at.i(), at.j());
        out.copy_from_slice(&[e.half() - play.abs(), play]);
    }

    fn action<S: Real>(e: &Play<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let effort = e.effort(at);
        for (body, wrench) in e.coordinate.wrenches(effort).into_iter().enumerate() {
            out.put(0, body, wrench);
        }
    }

    fn result_quantities<S>(_: &Play<S>) -> &'static [ResultQuantity] {
        const { &[TANGENTIAL] }
    }

    fn results<S: Real>(e: &Play<S>, at: &Situation<'_, S>, out: &mut [S]) {
        out[0] = e.effort(at);
    }

    fn behaviour<S: Real>(e: &Play<S>) -> Option<Behaviour<S>> {
        let restitution = e.backlash().restitution.unwrap_or_else(S::zero);
        let rest_speed = S::constant(REST_SPEED);
        Some(Behaviour::Impacts { restitution, rest_speed })
    }

    fn threshold<S: Real>(e: &Play<S>, at: &Situation<'_, S>) -> S {
        e.half() - e.coordinate.of.value(&at.i().pose, &at.j().pose).abs()
    }

    fn side<S: Real>(e: &Play<S>, at: &Situation<'_, S>) -> f64 {
        let s = e.coordinate.of.value(&at.i().pose, &at.j().pose);
        1.0_f64.copysign(s.in_lanes()[0])
    }

    fn clearances(e: &Play) -> Vec<Clearance<'_>> {
        let limit = |sign: f64| Clearance::Limit { limit: -sign * e.half(), sign };
        [1.0, -1.0].each(limit).into()
    }

    fn followed<S>(e: &Play<S>) -> Option<&Followed<S>> {
        Some(&e.coordinate.of)
    }

    fn holding(e: &Play<Tape>, side: f64, value: f64) -> Option<Constraint<Tape>> {
        let Backlash { size, half, .. } = e.joint.backlash()?;
        let limit = match side {
            0.0 => Tape::from(value),
            side => size.times(half * side),
        };
        Some(holding(e.coordinate.of.clone(), limit))
    }

    fn symbols(e: &Play) -> Vec<SceneSymbol> {
        e.joint.symbols()
    }

    fn fault(e: &Play) -> Option<(&'static str, String)> {
        let Backlash { field, size, restitution, .. } = e.backlash();
        let restitution = restitution.unwrap_or(0.0);
        let of_joint = e.joint.fault();
        if of_joint.is_none() && size <= 0.0 {
            let message = format!("{size} m; must be > 0; without play, remove the field");
            return Some((field, message));
        }
        let possible = (0.0..=1.0).contains(&restitution);
        let of_hits =
            || (!possible).then(|| ("restitution", format!("{restitution}; must be from 0 to 1")));
        of_joint.or_else(of_hits)
    }
}
