//! An equilibrium path over a parameter by pseudo-arclength continuation (Keller, in *Applications of Bifurcation
//! Theory*, 1977), which passes folds.

use super::failure::Reason;
use super::holding;
use super::options::Options;
use super::parameter;
use super::points::{EquilibriumPath, PathEnd};
use super::spot::{ParameterPath, PathDirection, PathStep};
use super::stride::{advance, around};
use super::turning;
use crate::analyses::State;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{column_scales, Model};

/// First and longest step. The parameter is measured in units of its range, the coordinates by their root mean square
/// in rad and in sizes of the mechanism.
const FIRST: f64 = 0.01;
const LONGEST: f64 = 0.04;
/// Shortest step.
const SHORTEST: f64 = 1e-9;
/// Step across a kink, which is nearer than the shortest step.
const KINK: f64 = 1e-6;
/// Largest number of iterations after which the next step is lengthened.
const EASY: usize = 4;
/// Largest number of points.
const POINTS: usize = 5000;

/// Follows the equilibrium path over `options.over`. It begins at the first value of `options.range` with the
/// equilibrium that is reached from `start`.
///
/// `watch` is called with the value of the parameter at each step.
///
/// # Errors
/// [`Reason`]: there is no equilibrium at the first value.
pub fn path(
    model: &Model,
    start: &State,
    options: &Options,
    mut watch: impl FnMut(f64) -> Flow,
) -> Result<EquilibriumPath, Reason> {
    let (Some(over), Some(range)) = (&options.over, options.range) else {
        return Err(Reason::Option(Vec::new()));
    };
    let held = holding::holding(model, start, &options.hold)?;
    let first = parameter::at(&held, over, range[0])?;
    let begin = super::from(&first, start, options, &mut |_| watch(range[0]))?;
    let n = start.q.len() as f64;
    let weights = column_scales(&first).iter().map(|s| 1.0 / (s * s * n)).list();
    let (holders, t, unit) = (options.hold.len(), start.t, (range[1] - range[0]).abs());
    let course = ParameterPath { model: &held, holders, t, over, unit, weights };
    let spot = course.spot(range[0], &begin.state.q, &begin.state.z)?;
    let onward =
        PathDirection { q: vec![0.0; start.q.len()], p: (range[1] - range[0]).signum() * unit };
    let Some(tangent) = course.tangent(&spot, &onward) else {
        return Err(Reason::singular(&first, t, &begin.state.q));
    };
    let mut path = EquilibriumPath {
        values: vec![range[0]],
        points: vec![begin],
        folds: Vec::new(),
        branches: Vec::new(),
        end: PathEnd::Long,
    };
    path.end =
        follow(&course, PathStep { spot, tangent, iterations: 0 }, range, &mut path, &mut watch)?;
    Ok(path)
}

fn follow(
    course: &ParameterPath<'_>,
    mut at: PathStep,
    range: [f64; 2],
    path: &mut EquilibriumPath,
    watch: &mut dyn FnMut(f64) -> Flow,
) -> Result<PathEnd, Reason> {
    let mut ds = FIRST;
    while path.values.len() < POINTS {
        if watch(at.spot.value) == Flow::Stop {
            return Ok(PathEnd::Stopped);
        }
        let next = match advance(course, &at, ds) {
            Ok(next) => next,
            Err(reason) if ds < SHORTEST => {
                ds = KINK;
                let inside = |next: &PathStep| {
                    (next.spot.value - range[0]) * (next.spot.value - range[1]) < 0.0
                };
                match around(course, &at, ds).filter(inside) {
                    Some(next) => next,
                    None => return Ok(PathEnd::Lost(reason)),
                }
            }
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
    Ok(PathEnd::Long)
}
