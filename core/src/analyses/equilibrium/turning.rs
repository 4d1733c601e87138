//! Special points between two points of a path: folds, crossings of other paths, and the ends of the range.

use super::failure::Reason;
use super::points::{EquilibriumPath, PathEnd};
use super::spot::{ParameterPath, PathStep};
use super::stride::advance;

/// Path length to which a point is located.
const LOCATED: f64 = 1e-15;
/// Largest number of trials.
const TRIALS: usize = 80;
/// Path length to which a crossing of other paths is located.
const CROSSED: f64 = 1e-9;

/// Adds the fold, or the crossing of another path, between two points.
pub(super) fn between(
    course: &ParameterPath<'_>,
    from: &PathStep,
    to: &PathStep,
    ds: f64,
    range: [f64; 2],
    path: &mut EquilibriumPath,
) -> Result<(), Reason> {
    let inside = |value: f64| (value - range[0]) * (value - range[1]) <= 0.0;
    if from.tangent.p * to.tangent.p < 0.0 {
        let fold = zero(course, from, to, ds, |step| step.tangent.p);
        if let Some(fold) = fold.filter(|fold| inside(fold.spot.value)) {
            let found = path.add(course, &fold.spot)?;
            path.folds.push(found);
        }
        return Ok(());
    }
    let negative = from.spot.negative();
    if to.spot.negative() != negative {
        let (mut low, mut high, mut best) = (0.0, ds, None);
        while high - low > CROSSED {
            let middle = 0.5 * (low + high);
            let Ok(step) = advance(course, from, middle) else { break };
            if step.spot.negative() == negative {
                low = middle;
            } else {
                high = middle;
            }
            best = Some(step);
        }
        if let Some(step) = best.filter(|step| inside(step.spot.value)) {
            let found = path.add(course, &step.spot)?;
            path.branches.push(found);
        }
    }
    Ok(())
}

/// The end of the path and its last point, if the path leaves the range before `to`.
pub(super) fn outside(
    course: &ParameterPath<'_>,
    from: &PathStep,
    to: &PathStep,
    ds: f64,
    range: [f64; 2],
) -> Option<(PathEnd, PathStep)> {
    let way = (range[1] - range[0]).signum();
    for (end, bound, beyond) in [(PathEnd::Last, range[1], way), (PathEnd::First, range[0], -way)] {
        if beyond * (to.spot.value - bound) >= 0.0 && beyond * (from.spot.value - bound) < 0.0 {
            let mut last = zero(course, from, to, ds, |step| step.spot.value - bound)?;
            last.spot.value = bound;
            return Some((end, last));
        }
    }
    None
}

/// The point between two where a function of points is zero: regula falsi, and bisection in every third trial.
fn zero(
    course: &ParameterPath<'_>,
    from: &PathStep,
    to: &PathStep,
    ds: f64,
    of: impl Fn(&PathStep) -> f64,
) -> Option<PathStep> {
    let (mut low, mut high) = (0.0, ds);
    let mut ends = [of(from), of(to)];
    let mut best: Option<PathStep> = None;
    for trial in 0..TRIALS {
        let share = if trial % 3 == 2 { 0.5 } else { ends[0] / (ends[0] - ends[1]) };
        let middle = low + share.clamp(1e-6, 1.0 - 1e-6) * (high - low);
        let Ok(step) = advance(course, from, middle) else { break };
        let found = of(&step);
        let better = best.as_ref().is_none_or(|best| found.abs() <= of(best).abs());
        if found * ends[0] > 0.0 {
            (low, ends[0]) = (middle, found);
        } else {
            (high, ends[1]) = (middle, found);
        }
        if better {
            best = Some(step);
        }
        if high - low < LOCATED || found == 0.0 {
            break;
        }
    }
    best
}
