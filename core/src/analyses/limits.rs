//! Limits of motion: how far a driven value can increase and decrease from a position, or whether it turns fully.
//!
//! The motion is followed in both directions by the continuation of `kinematics`. It ends at a dead point, which is
//! located exactly, at a stop or contact with restitution, or at the end of a curve. An angle turns fully if it meets
//! no limit before the mechanism returns to its start, after one or several turns. A length is unlimited if it exceeds
//! [`FARTHEST`] times the size of the mechanism.

use super::kinematics::{
    driven, driven_value, same, without_driver, written, Continuation, Failure, Limit, Reason,
    ALIKE,
};
use super::options::{name, options};
use super::record::{
    Analysis, Fact, NamedNumber, NumberList, Observer, Outcome, Record, RunResult, StartState,
    Subject,
};
use super::{second_order, State};
use crate::elements::{Group, QuantityKind};
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{size, Model, Problem};
use serde_json::json;
use std::f64::consts::TAU;

/// Number of turns after which an angle without a limit counts as unlimited, even if the mechanism never returns to
/// its start.
pub const MOST_TURNS: usize = 24;
/// Length, in sizes of the mechanism, beyond which a length counts as unlimited.
pub const FARTHEST: f64 = 100.0;

options! {
    /// Limits of a driver or position quantity in both directions. A limit is a dead point, a stop or
    /// contact with restitution, or the end of a curve. An angle without limits makes full turns.
    Options, "limits", "Limits" () {
        /// Driver, or position quantity such as `crank.angle`. If absent, the only driver.
        over: Option<driven_value> = None,
        /// State at which the analysis starts: "start", or the name of an earlier analysis to use
        /// its final state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
    }
}

impl Analysis for Options {
    const NUMBERS: &'static [NamedNumber] = &[
        NamedNumber::new("lower", "over", |of, _| NumberList::one(ends_of(of)[0])),
        NamedNumber::new("upper", "over", |of, _| NumberList::one(ends_of(of)[1])),
        NamedNumber::new("span", "over", |of, _| {
            let [lower, upper] = ends_of(of);
            NumberList::one(upper - lower)
        }),
        NamedNumber::finding("start", "over"),
        NamedNumber::finding("turns", ""),
        NamedNumber::new("turns_fully", "", |of, _| {
            let is_angle = of.findings["unit"] == QuantityKind::Angle.unit();
            let is_free = ends_of(of).iter().all(|end| end.is_infinite());
            NumberList::one(f64::from(is_angle && is_free))
        }),
    ];

    fn ends(&self, model: &Model, begin: Option<f64>) -> Result<Option<f64>, Vec<Problem>> {
        let driven = model.constraints.iter().any(|item| item.group == Group::Drivers);
        match self.over.is_some() || driven {
            true => Ok(begin),
            false => Err(vec![without_driver("the model has no driver that acts")]),
        }
    }

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        let over = match &self.over {
            Some(over) => over.clone(),
            None => subject.only_driver(start)?,
        };
        let driven = subject.driven_by(start, &over, false)?;
        let at = State { t: driven.variable.start, ..start.state.clone() };
        let own = second_order::acting(&driven.model, at.t, &at.q);
        let found = limits(own.as_ref().unwrap_or(&driven.model), &at, observer.look);
        let found = found.map_err(|failure| Outcome::from(failure.reason))?;
        let value = |bound: &Option<Bound>| bound.as_ref().map(|bound| bound.value);
        let findings = json!({
            "over": over, "start": driven.variable.start, "unit": found.kind.unit(),
            "lower": value(&found.lower), "upper": value(&found.upper),
            "reasons": found.reasons, "turns": found.turns,
        });
        let (facts, ends) = (facts(&over, &driven.variable.unit, &found), ends(&at, &found));
        let (values, positions): (Vec<f64>, Vec<Vec<f64>>) = found.path.into_iter().unzip();
        let (count, n_q) = (values.len(), driven.model.layout.n_q);
        let record = Record::new(findings, start.clone()).with("values", [count, 1], values).with(
            "positions",
            [count, n_q],
            positions.concat(),
        );
        Ok(Record { driven: Some(driven), ..record.facts(facts).positions(ends) })
    }
}

/// The least and the largest value of a record; infinite without a limit.
fn ends_of(record: &Record) -> [f64; 2] {
    let end = |name: &str, none: f64| record.findings[name].as_f64().unwrap_or(none);
    [end("lower", f64::NEG_INFINITY), end("upper", f64::INFINITY)]
}

/// Both limits with their reasons, or the description of a motion without limits.
fn facts(over: &str, unit: &str, found: &Limits) -> Vec<Fact> {
    let bounds = [("lower", &found.lower), ("upper", &found.upper)];
    let limits = bounds.iter().filter_map(|(name, bound)| Some((name, bound.as_ref()?)));
    let limits = limits.flat_map(|(name, Bound { value, reason, .. })| {
        let limit = Fact::new(format!("{name} limit of {over}"), *value).unit(unit);
        [limit, Fact::new("its reason", reason.clone())]
    });
    let of_bound = |reason: &String| {
        bounds.iter().any(|(_, bound)| bound.as_ref().is_some_and(|it| it.reason == *reason))
    };
    let others = found.reasons.iter().filter(|reason| !of_bound(reason));
    limits.chain(others.map(|reason| Fact::new("motion", reason.clone()))).list()
}

/// The positions at the limits.
fn ends(at: &State, found: &Limits) -> Vec<(Fact, State)> {
    let ends = [("lower limit", &found.lower), ("upper limit", &found.upper)];
    let end = |(name, bound): (&str, &Option<Bound>)| {
        let Bound { value, q, .. } = bound.as_ref()?;
        let state = State { t: *value, q: q.clone(), v: vec![0.0; q.len()], z: at.z.clone() };
        Some((Fact::new(name, json!(null)), state))
    };
    ends.into_iter().filter_map(end).list()
}

/// The limits of a driven value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limits {
    /// The end of the motion downwards; None without a limit.
    pub lower: Option<Bound>,
    /// The end of the motion upwards; None without a limit.
    pub upper: Option<Bound>,
    /// A length or an angle.
    pub kind: QuantityKind,
    /// Descriptions of the lower and the upper end, or of the motion without ends.
    pub reasons: Vec<String>,
    /// Number of turns after which the mechanism returns to its start, if it turns fully.
    pub turns: Option<usize>,
    /// Values along the motion, ascending, with the positions of shape (n_q); both ends are included.
    pub path: Vec<(f64, Vec<f64>)>,
}

/// An end of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The driven value, m or rad.
    pub value: f64,
    /// The position, shape (n_q).
    pub q: Vec<f64>,
    /// The reason.
    pub reason: String,
}

/// The end of a motion in one direction.
enum DirectionEnd {
    At(Bound),
    /// The mechanism returns to its start after this number of turns.
    Returned(usize),
    Never,
    Stopped,
}

/// The limits of the value that replaces t in a model. The `t` of the start is this value there.
///
/// `watch` is called with the value after each step and may stop the computation. The result is then invalid.
///
/// # Errors
/// [`Failure`]: drivers leave a freedom, the start does not meet the constraints or is singular, or the motion cannot
/// be followed although no limit was found.
pub fn limits(
    model: &Model,
    start: &State,
    mut watch: impl FnMut(f64) -> Flow,
) -> Result<Limits, Box<Failure>> {
    let (driven, kind) = driven(model);
    let kind = kind.unwrap_or_default();
    let mut found = Limits { kind, ..Limits::default() };
    let mut walk = Walk { model, start, kind, watch: &mut watch };
    let (down, mut path) = walk.towards(-1.0)?;
    path.reverse();
    let described = |end: &DirectionEnd| {
        match end {
        DirectionEnd::At(bound) => bound.reason.clone(),
        DirectionEnd::Returned(1) => format!("{driven} turns fully: the mechanism is the same after 360°"),
        DirectionEnd::Returned(n) => format!(
            "{driven} turns fully: it meets no dead point, and the mechanism is the same after {n} turns, {}°",
            360 * n
        ),
        DirectionEnd::Never if kind == QuantityKind::Angle => {
            format!("{driven} turns fully: it meets no dead point in {MOST_TURNS} turns")
        }
        DirectionEnd::Never => format!("{driven} has no limit within {}", written(reach(model), Some(kind))),
        DirectionEnd::Stopped => String::new(),
    }
    };
    found.reasons.push(described(&down));
    match down {
        DirectionEnd::Returned(turns) => {
            found.turns = Some(turns);
            found.path = path;
            found.path.push((start.t, start.q.clone()));
            return Ok(found);
        }
        DirectionEnd::Stopped => return Ok(found),
        DirectionEnd::At(bound) => found.lower = Some(bound),
        DirectionEnd::Never => {}
    }
    let (up, further) = walk.towards(1.0)?;
    found.reasons.push(described(&up));
    path.push((start.t, start.q.clone()));
    path.extend(further);
    found.path = path;
    if let DirectionEnd::At(bound) = up {
        found.upper = Some(bound);
    }
    found.reasons.dedup();
    Ok(found)
}

/// The largest length that is tried, m.
fn reach(model: &Model) -> f64 {
    FARTHEST * size(model)
}

/// The motion from a start in both directions.
struct Walk<'a, W> {
    model: &'a Model,
    start: &'a State,
    kind: QuantityKind,
    watch: &'a mut W,
}

type Path = Vec<(f64, Vec<f64>)>;

impl<W: FnMut(f64) -> Flow> Walk<'_, W> {
    /// The end in a direction, and the positions on the way there, without the start.
    fn towards(&mut self, way: f64) -> Result<(DirectionEnd, Path), Box<Failure>> {
        let mut motion = Continuation::begin(self.model, self.start)?;
        let mut path = Path::new();
        let (turns, length) = match self.kind {
            QuantityKind::Angle => (MOST_TURNS, TAU),
            _ => (1, reach(self.model)),
        };
        for turn in 1..=turns {
            let goal = self.start.t + way * length * turn as f64;
            while motion.point().t != goal {
                if let Err(reason) = motion.step(goal) {
                    let Reason::Limit(limit) = reason else { return Err(reason.into()) };
                    let bound = bound(*limit);
                    path.push((bound.value, bound.q.clone()));
                    return Ok((DirectionEnd::At(bound), path));
                }
                path.push((motion.point().t, motion.point().q.clone()));
                if (self.watch)(motion.point().t) == Flow::Stop {
                    return Ok((DirectionEnd::Stopped, path));
                }
            }
            let turned = self.kind == QuantityKind::Angle;
            if turned && same(self.model, &self.start.q, &motion.point().q, ALIKE) {
                return Ok((DirectionEnd::Returned(turn), path));
            }
        }
        Ok((DirectionEnd::Never, path))
    }
}

fn bound(limit: Limit) -> Bound {
    Bound { value: limit.t, reason: limit.to_string(), q: limit.q }
}
