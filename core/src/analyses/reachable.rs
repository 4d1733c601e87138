//! The region that a point reaches while two drivers or position quantities vary within ranges.
//!
//! The motion is followed along the first quantity, and from each of its values along the second one, by the
//! continuation of `kinematics`. It ends at a limit inside a range, which is located exactly. If there is one, the
//! region is also followed along the second quantity first. Triangles between neighbouring positions cover the region,
//! and their union gives its boundary and area. The error of both falls with the square of the number of values.

use super::assemble::position;
use super::kinematics::{driving, kinematics, DrivenQuantity, Reason};
use super::options::{count, intervals, kind, name, options};
use super::record::{
    Analysis, Fact, NamedNumber, Observer, Outcome, Record, RunResult, StartState, Subject,
    Unfinished,
};
use super::State;
use crate::elements::{BodyId, Group};
use crate::equations::kinematics::Motions;
use crate::integrate::Flow;
use crate::math::{Local, ShortArray, Vec2};
use crate::model::{Definition, Model, Problem, Value};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;
use serde_json::json;
use std::sync::Arc;

/// Default of the number of values of each quantity.
const VALUES: usize = 61;
/// Largest number of values of each quantity; a region has the square of this number of positions.
const MOST_VALUES: usize = 2_000;
/// Part of a step by which rounding errors may change it.
const ROUNDING: f64 = 1e-6;

kind! {
    /// Two drivers or position quantities, such as `crank.angle`.
    pair_of_quantities: Vec<String>, Quantities, |reader, key| {
        let what = "two drivers or position quantities, such as [\"arm.angle\", \"hand.angle\"]";
        reader.names(key, what, |model, name, _| {
            let drivers = model.constraints.iter().filter(|item| item.group == Group::Drivers);
            match drivers.into_iter().any(|item| item.name == *name) {
                true => Ok(()),
                false => position(model, name).map(|_| ()),
            }
        })
    }
}

options! {
    /// The region that a point reaches while two drivers or position quantities vary within ranges.
    Options, "reachable", "Reachable" (
        /// Point of a body, such as `hand.P`.
        of: name,
        /// Two drivers, or position quantities such as `arm.angle`.
        over: pair_of_quantities,
        /// First and last value of each of them, in SI units and rad.
        ranges: intervals
    ) {
        /// Number of values of each quantity, including both ends.
        n: count = VALUES,
        /// State at which the analysis starts: "start", or the name of an earlier analysis to use
        /// its final state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
    }
    conflict |options, model| {
        let two = |len: usize| format!("{len} entries; must be two");
        let (over, ranges) = (&options.over, &options.ranges);
        match place(model, &options.of) {
            None => Some(("of", format!("{}: there is no such point of a body", options.of))),
            _ if over.len() != 2 => Some(("over", two(over.len()))),
            _ if over[0] == over[1] => Some(("over", "the same quantity twice; name two different ones".to_string())),
            _ if ranges.len() != 2 => Some(("ranges", two(ranges.len()))),
            _ if ranges.iter().any(|[first, last]| first >= last) => {
                Some(("ranges", "the first value must be below the last one".to_string()))
            }
            _ if !(2..=MOST_VALUES).contains(&options.n) => {
                let n = options.n;
                Some(("n", format!("{n}; must be a whole number from 2 to {MOST_VALUES}")))
            }
            _ => None,
        }
    };
}

/// A point of a body.
fn place(model: &Model, of: &str) -> Option<(BodyId, Local)> {
    let (body, point) = of.rsplit_once('.')?;
    let body = model.body(body)?;
    Some((body, *model.bodies[body.0].point(point)?))
}

impl Analysis for Options {
    const NUMBERS: &'static [NamedNumber] =
        &[NamedNumber::finding("area", "m^2"), NamedNumber::finding("complete", "")];

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        let mut region = Region {
            options: self,
            subject,
            start,
            acting: subject.acting(start),
            limits: Vec::new(),
        };
        let mut all = vec![(region.rows([0, 1], observer.look)?, self.step(1))];
        if !region.limits.is_empty() {
            // along the second quantity, parts beyond the limits of the first one may be reached
            all.push((region.rows([1, 0], observer.look)?, self.step(0)));
        }
        let (boundary, area) = united(&all);
        let at = all
            .iter()
            .flat_map(|(rows, _)| rows)
            .flatten()
            .flat_map(|(_, at)| [at.x, at.y])
            .collect::<Vec<_>>();
        let edges = boundary.iter().flat_map(|(part, at)| [*part as f64, at.x, at.y]);
        let edges: Vec<f64> = edges.collect();
        let findings = json!({
            "of": self.of, "over": self.over, "area": area,
            "complete": region.limits.is_empty(), "limit": region.limits.first(),
        });
        let area = Fact::new(format!("area that {} reaches", self.of), area).unit("m^2");
        let limit = region.limits.first().map(|limit| Fact::new("limit", limit.clone()));
        Ok(Record::new(findings, start.clone())
            .facts([area].into_iter().chain(limit))
            .positions([start.examined()])
            .with("points", [at.len() / 2, 2], at)
            .with("boundary", [edges.len() / 3, 3], edges))
    }
}

impl Options {
    /// The difference of neighbouring values of a quantity.
    fn step(&self, k: usize) -> f64 {
        let [first, last] = self.ranges[k];
        (last - first) / (self.n - 1) as f64
    }
}

/// Positions of the point along the second quantity, each with its value there.
type Row = Vec<(f64, Vec2)>;

/// A region that is to be found.
struct Region<'a> {
    options: &'a Options,
    subject: &'a Subject<'a>,
    start: &'a StartState,
    /// The definition without the drivers that were released before.
    acting: Definition,
    /// The limits that ended the motion within the ranges.
    limits: Vec<String>,
}

impl Region<'_> {
    /// The positions for each value of one quantity, ascending; `order` is this quantity and the other one.
    fn rows(
        &mut self,
        order: [usize; 2],
        look: &mut dyn FnMut(f64) -> Flow,
    ) -> Result<Vec<Row>, Box<Unfinished>> {
        let [first, second] = order.each(|k| self.quantity(k));
        let (first, second) = (first?, second?);
        if first.quantity == second.quantity {
            let message = format!("{} twice, by its name and by its driver", first.quantity);
            return Err(vec![Problem::at(&["over"], message)].into());
        }
        let [a, b] = [&first, &second].each(|of| self.value(&of.quantity));
        let [range, across] = order.each(|k| self.options.ranges[k]);
        // along the first quantity, with the second one at its start, or at the nearest end of its range
        let moved = self.driven([(&first, number(a)), (&second, time())])?;
        let middle = b.clamp(across[0], across[1]);
        let begin = self.reach(&moved, &self.at(b), middle)?;
        let along = self.driven([(&first, time()), (&second, number(middle))])?;
        let begin = self.reach(&along, &State { t: a, ..begin }, a.clamp(range[0], range[1]))?;
        let mut rows = Vec::new();
        for (state, is_limit) in self.both_ways(&along, &begin, range)? {
            let a = state.t;
            if is_limit {
                // the second quantity does not move from here
                rows.push(vec![(middle, self.point(&along, &state))]);
                continue;
            }
            let model = self.driven([(&first, number(a)), (&second, time())])?;
            let states = self.both_ways(&model, &State { t: middle, ..state }, across)?;
            rows.push(states.iter().map(|(at, _)| (at.t, self.point(&model, at))).collect());
            if look(a) == Flow::Stop {
                self.limits.push("the analysis was stopped".to_string());
                break;
            }
        }
        Ok(rows)
    }

    fn quantity(&self, k: usize) -> Result<DrivenQuantity, Outcome> {
        let model = self.subject.released(self.start);
        let found = DrivenQuantity::named(&self.acting, &model, &self.options.over[k]);
        found.map_err(|problem| vec![problem].into())
    }

    /// The value of a quantity at the start.
    fn value(&self, quantity: &str) -> f64 {
        super::readings::of_state(self.subject.model(), &self.start.state, &[quantity])[0]
    }

    /// The start at a value that replaces the time.
    fn at(&self, t: f64) -> State {
        State { t, ..self.start.state.clone() }
    }

    /// The mechanism in which laws give the values of both quantities.
    fn driven(&self, laws: [(&DrivenQuantity, Value); 2]) -> Result<Arc<Model>, Outcome> {
        let Self { subject, start, acting, .. } = self;
        let model = subject.released(start);
        let driven = driving(acting, &model, start.state.t, &laws);
        let driven = driven.map_err(|one| Outcome::from(vec![one]))?;
        Ok(subject.rebuilt(&driven)?)
    }

    /// The state of a mechanism at another value.
    fn reach(&self, model: &Model, from: &State, value: f64) -> Result<State, Outcome> {
        let motion = kinematics(model, from, &[value], |_| Flow::Continue)
            .map_err(|failure| Outcome::from(failure.reason))?;
        let point = motion.points.last().expect("the start is a point");
        Ok(State { t: value, q: point.q.clone(), v: point.v.clone(), z: from.z.clone() })
    }

    /// The states at the values of a range on both sides of a state, ascending. A limit within the range ends them and
    /// is marked.
    fn both_ways(
        &mut self,
        model: &Model,
        from: &State,
        [first, last]: [f64; 2],
    ) -> Result<Vec<(State, bool)>, Outcome> {
        let n = self.options.n;
        let value = |k: usize| first + (last - first) * (k as f64 / (n - 1) as f64);
        let values: Vec<f64> = (0..n).map(value).collect();
        let (below, above): (Vec<f64>, Vec<f64>) = values.iter().partition(|x| **x < from.t);
        let below: Vec<f64> = below.into_iter().rev().collect();
        let mut states = self.one_way(model, from, &below)?;
        states.reverse();
        states.extend(self.one_way(model, from, &above)?);
        Ok(states)
    }

    fn one_way(
        &mut self,
        model: &Model,
        from: &State,
        values: &[f64],
    ) -> Result<Vec<(State, bool)>, Outcome> {
        let state = |t: f64, q: &[f64]| State {
            t,
            q: q.to_vec(),
            v: vec![0.0; q.len()],
            z: from.z.clone(),
        };
        let (motion, reason) = match kinematics(model, from, values, |_| Flow::Continue) {
            Ok(motion) => (motion, None),
            Err(failure) => (failure.motion, Some(failure.reason)),
        };
        let mut states: Vec<_> =
            motion.at_outputs().map(|point| (state(point.t, &point.q), false)).collect();
        match reason {
            None => {}
            Some(Reason::Limit(limit)) => {
                states.push((state(limit.t, &limit.q), true));
                self.limits.push(limit.to_string());
            }
            Some(other) => return Err(other.into()),
        }
        Ok(states)
    }

    fn point(&self, model: &Model, state: &State) -> Vec2 {
        let (body, point) = place(model, &self.options.of).expect("its point was checked");
        Motions::at_rest(&model.layout, &state.q)[body.0].pose.point(point)
    }
}

fn time() -> Value {
    Value::Text("t".to_string())
}

fn number(x: f64) -> Value {
    Value::Number(x)
}

/// The boundary of the region that sets of rows cover, each with the step along its rows, as points with the number of their contour, and its area. The
/// inner sides of holes are contours too.
fn united(all: &[(Vec<Row>, f64)]) -> (Vec<(usize, Vec2)>, f64) {
    let pairs = all.iter().flat_map(|(rows, step)| rows.windows(2).map(move |pair| (pair, *step)));
    let strips = pairs.flat_map(|(pair, step)| strip(&pair[0], &pair[1], step));
    let triangles: Vec<Vec<[f64; 2]>> = strips
        .map(|corners| {
            let [p, q, r] = corners;
            let ccw = (q - p).cross(r - p) >= 0.0;
            let ordered = if ccw { [p, q, r] } else { [p, r, q] };
            ordered.each(|at| [at.x, at.y]).to_vec()
        })
        .collect();
    let regions = triangles.simplify_shape(FillRule::NonZero);
    let contours: Vec<Vec<Vec2>> = regions
        .into_iter()
        .flatten()
        .map(|contour| contour.into_iter().map(|[x, y]| Vec2::new(x, y)).collect())
        .collect();
    let area: f64 = contours.iter().map(|contour| signed_area(contour)).sum();
    let numbered = contours.into_iter().enumerate();
    let points = numbered.flat_map(|(k, contour)| contour.into_iter().map(move |at| (k, at)));
    (points.collect(), area.abs())
}

/// Twice the sum of the triangles of a contour with the origin, halved: positive for one sense, negative for the other,
/// which is that of holes.
fn signed_area(contour: &[Vec2]) -> f64 {
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).map(|(p, q)| p.cross(*q)).sum::<f64>() / 2.0
}

/// Triangles between two rows. Their values differ at most by the `step` along the rows. Where a limit ends one row
/// earlier than the other one, the rows in the other direction cover the rest.
fn strip(lower: &Row, upper: &Row, step: f64) -> Vec<[Vec2; 3]> {
    let most = step * (1.0 + ROUNDING);
    let (mut i, mut j) = (0, 0);
    let mut triangles = Vec::with_capacity(lower.len() + upper.len());
    while i + 1 < lower.len() || j + 1 < upper.len() {
        let along_lower = match (lower.get(i + 1), upper.get(j + 1)) {
            (Some((a, _)), Some((b, _))) => a <= b,
            (next, _) => next.is_some(),
        };
        let (p, q) = (lower[i], upper[j]);
        let next = if along_lower {
            i += 1;
            lower[i]
        } else {
            j += 1;
            upper[j]
        };
        let near = (p.0 - q.0).abs() <= most && (next.0 - p.0.min(q.0)) <= most;
        if near {
            triangles.push([p.1, next.1, q.1]);
        }
    }
    triangles
}
