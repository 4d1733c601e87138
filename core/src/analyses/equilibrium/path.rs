//! A path of equilibria over a parameter, by its length: pseudo-arclength continuation (Keller, in *Applications of
//! Bifurcation Theory*, 1977), which passes folds.

use super::failure::Reason;
use super::holding;
use super::options::Options;
use super::parameter;
use super::result::Equilibrium;
use super::spot::{Course, Direction, Spot, Step};
use super::turning;
use crate::analyses::State;
use crate::integrate::Flow;
use crate::model::{column_scales, Model};

/// First and longest step; the range of the parameter is one unit, and the root mean square of the coordinates in rad and
/// sizes of the mechanism.
const FIRST: f64 = 0.01;
const LONGEST: f64 = 0.04;
/// Shortest step.
const SHORTEST: f64 = 1e-9;
/// Least cosine between neighbouring tangents.
const ALONG: f64 = 0.97;
/// Iterations of a step, and those after which the next step is not longer.
const ITERATIONS: usize = 12;
const EASY: usize = 4;
/// Correction at which a point is found, in the same unit as steps.
const FOUND: f64 = 1e-13;
/// Correction at which rounding may decide.
const ROUNDING: f64 = 1e-9;
/// Largest number of points.
const POINTS: usize = 5000;

/// The end of a path.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// It reached the last value of the range.
    Last,
    /// It turned and came back to the first value.
    First,
    /// It could not be followed further.
    Lost(Reason),
    /// It has very many points.
    Long,
    /// The observer stopped it.
    Stopped,
}

/// A path of equilibria.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The values of the parameter; a path may turn back.
    pub values: Vec<f64>,
    /// The equilibrium at each value.
    pub points: Vec<Equilibrium>,
    /// Values and equilibria at folds, where the path turns back; they are among the points too.
    pub folds: Vec<(f64, Equilibrium)>,
    /// Values and equilibria where the stability changes without a fold: other paths cross there. They are among the
    /// points too.
    pub branches: Vec<(f64, Equilibrium)>,
    /// The end.
    pub end: End,
}

/// The path of equilibria over `options.over`, from the one at the first value of `options.range` that `start` leads to.
///
/// `watch` is called with the value after each step.
///
/// # Errors
/// [`Reason`]: there is no equilibrium at the first value.
pub fn path(
    model: &Model,
    start: &State,
    options: &Options,
    mut watch: impl FnMut(f64) -> Flow,
) -> Result<Path, Reason> {
    let (Some(over), Some(range)) = (&options.over, options.range) else {
        return Err(Reason::Option(Vec::new()));
    };
    let held = holding::holding(model, start, &options.hold)?;
    let first = parameter::at(&held, over, range[0])?;
    let begin = super::from(&first, start, options, &mut |_| watch(range[0]))?;
    let n = start.q.len() as f64;
    let weights = column_scales(&first).iter().map(|s| 1.0 / (s * s * n)).collect();
    let (holders, t, unit) = (options.hold.len(), start.t, (range[1] - range[0]).abs());
    let course = Course { model: &held, holders, t, over, unit, weights };
    let spot = course.spot(range[0], &begin.state.q, &begin.state.z)?;
    let onward =
        Direction { q: vec![0.0; start.q.len()], p: (range[1] - range[0]).signum() * unit };
    let Some(tangent) = course.tangent(&spot, &onward) else {
        return Err(Reason::singular(&first, t, &begin.state.q));
    };
    let mut path = Path {
        values: vec![range[0]],
        points: vec![begin],
        folds: Vec::new(),
        branches: Vec::new(),
        end: End::Long,
    };
    path.end =
        follow(&course, Step { spot, tangent, iterations: 0 }, range, &mut path, &mut watch)?;
    Ok(path)
}

fn follow(
    course: &Course<'_>,
    mut at: Step,
    range: [f64; 2],
    path: &mut Path,
    watch: &mut dyn FnMut(f64) -> Flow,
) -> Result<End, Reason> {
    let mut ds = FIRST;
    while path.values.len() < POINTS {
        if watch(at.spot.value) == Flow::Stop {
            return Ok(End::Stopped);
        }
        let next = match advance(course, &at, ds) {
            Ok(next) => next,
            Err(reason) if ds < SHORTEST => return Ok(End::Lost(reason)),
            Err(_) => {
                ds *= 0.5;
                continue;
            }
        };
        turning::between(course, &at, &next, ds, range, path)?;
        if let Some((end, last)) = turning::outside(course, &at, &next, ds, range) {
            path.add(course, &last.spot)?;
            return Ok(end);
        }
        path.add(course, &next.spot)?;
        if next.iterations <= EASY {
            ds = (1.4 * ds).min(LONGEST);
        }
        at = next;
    }
    Ok(End::Long)
}

impl Path {
    /// Adds a point.
    pub(super) fn add(&mut self, course: &Course<'_>, spot: &Spot) -> Result<Equilibrium, Reason> {
        let found = course.equilibrium(spot)?;
        self.values.push(spot.value);
        self.points.push(found.clone());
        Ok(found)
    }
}

/// The point of the path at the distance `ds` along the tangent.
pub(super) fn advance(course: &Course<'_>, from: &Step, ds: f64) -> Result<Step, Reason> {
    let Step { spot: Spot { place, value, .. }, tangent, .. } = from;
    let ahead: Vec<f64> = place.q.iter().zip(&tangent.q).map(|(q, dq)| q + ds * dq).collect();
    let goal = value + ds * tangent.p;
    let mut spot = course.spot(goal, &ahead, &place.z)?;
    let lost = || Reason::Lost { relative: f64::NAN, coordinate: course.over.to_string() };
    let mut last = f64::INFINITY;
    for iterations in 1..=ITERATIONS {
        let q: Vec<f64> = spot.place.q.iter().zip(&ahead).map(|(q, goal)| q - goal).collect();
        let beside = course.along(&Direction { q, p: spot.value - goal }, tangent);
        let step = course.correction(&spot, tangent, beside).ok_or_else(lost)?;
        let size = course.along(&step, &step).sqrt();
        let done = size <= FOUND || (size <= ROUNDING && size >= 0.3 * last);
        if done {
            let after = course.tangent(&spot, tangent).ok_or_else(lost)?;
            return match course.along(&after, tangent) >= ALONG {
                true => Ok(Step { spot, tangent: after, iterations }),
                false => Err(lost()),
            };
        }
        if size > 0.5 * last || size > ds {
            return Err(lost());
        }
        let q: Vec<f64> = spot.place.q.iter().zip(&step.q).map(|(q, dq)| q + dq).collect();
        spot = course.spot(spot.value + step.p, &q, &spot.place.z)?;
        last = size;
    }
    Err(lost())
}
