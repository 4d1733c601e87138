//! Projection of several states in parallel, one in each lane.
//!
//! Each lane performs the iteration of [`Projector`](super::Projector) with the factor of a nearby state, and ends at
//! the same iterate, so that the results are identical to the last bit. A lane that needs a factor of its own state
//! fails.

use super::projection::{Projection, CLOSED, MARGIN, MOST, SLOW};
use crate::equations::{Residuals, Workspace};
use crate::math::{indexed, Lanes, Listed, Real, ShortArray};
use crate::model::{column_scales, row_scales, Model};

const WIDTH: usize = Lanes::WIDTH;

/// A Boolean for each lane.
type Mask = [bool; WIDTH];

/// A number for each lane.
type Numbers = [f64; WIDTH];

/// Memory for projections of models of one structure.
#[derive(Clone, Debug)]
pub struct LaneProjector {
    tolerance: f64,
    /// 1 / scale of each coordinate and of each row.
    per_column: Vec<Lanes>,
    per_row: Vec<Lanes>,
    residuals: Residuals<Lanes>,
    /// Right side, then (Δ, μ).
    correction: Vec<Lanes>,
}

/// The progress of the iteration in each lane.
struct Course {
    /// Lanes that do not satisfy the tolerance yet.
    open: Mask,
    failed: Mask,
    changed: Mask,
    /// Factor by which the last step reduced the residual.
    lowering: Numbers,
}

impl LaneProjector {
    /// Memory for the models of the lanes and the model over lanes.
    pub fn new(models: [&Model; WIDTH], wide: &Model<Lanes>, options: Projection) -> Self {
        let side_by_side = |scales: [Vec<f64>; WIDTH]| -> Vec<Lanes> {
            let number = |k: usize| Lanes::new(indexed(|lane| 1.0 / scales[lane][k]));
            (0..scales[0].len()).map(number).list()
        };
        Self {
            tolerance: options.tolerance,
            per_column: side_by_side(models.each(column_scales)),
            per_row: side_by_side(models.each(row_scales)),
            residuals: Residuals::new(wide),
            correction: vec![Lanes::zero(); wide.layout.n_q + wide.layout.n_rows],
        }
    }

    /// Projects (q, v) of the `lanes` in place, with the factor in the workspace. Returns for each lane whether the
    /// state changed, or None if the projection failed.
    pub fn project(
        &mut self,
        (model, workspace): (&Model<Lanes>, &mut Workspace<Lanes>),
        t: Lanes,
        (q, v): (&mut [Lanes], &mut [Lanes]),
        lanes: Mask,
    ) -> [Option<bool>; WIDTH] {
        let none = [false; WIDTH];
        let mut course = Course { open: none, failed: none, changed: none, lowering: [1.0; WIDTH] };
        for level in 0..2 {
            course.open = indexed(|lane| lanes[lane] && !course.failed[lane]);
            self.meet(level, (model, workspace), t, (q, v), &mut course);
        }
        indexed(|lane| (!course.failed[lane]).then_some(course.changed[lane]))
    }

    /// Reduces the residuals of one level, positions or velocities, to their targets.
    fn meet(
        &mut self,
        level: usize,
        (model, workspace): (&Model<Lanes>, &mut Workspace<Lanes>),
        t: Lanes,
        (q, v): (&mut [Lanes], &mut [Lanes]),
        course: &mut Course,
    ) {
        let (mut last, mut targets) = ([f64::INFINITY; WIDTH], [0.0; WIDTH]);
        for iteration in 0..MOST {
            workspace.motions.place(&model.layout, q, v);
            let of = (model, &*workspace.compiled);
            self.residuals.look(of, &workspace.motions, t, &[]);
            let gaps = largest(&self.residuals.rows[level], &self.per_row);
            if iteration == 0 {
                targets = self.targets(level, q, v, gaps);
            }
            let open = course.open;
            for lane in (0..WIDTH).filter(|lane| open[*lane]) {
                let gap = gaps[lane];
                if iteration > 0 {
                    course.lowering[lane] = gap / last[lane];
                }
                if gap <= targets[lane] {
                    course.open[lane] = false;
                    course.changed[lane] |= iteration > 0;
                } else if gap > SLOW * last[lane] || gap.is_nan() {
                    (course.open[lane], course.failed[lane]) = (false, true);
                }
            }
            if course.open == [false; WIDTH] {
                return;
            }
            self.correct(level, workspace, if level == 0 { &mut *q } else { &mut *v }, course.open);
            let open = course.open;
            for lane in (0..WIDTH).filter(|lane| open[*lane] && level == 1) {
                if MARGIN * course.lowering[lane] * gaps[lane] <= targets[lane] {
                    (course.open[lane], course.changed[lane]) = (false, true);
                }
            }
            if course.open == [false; WIDTH] {
                return;
            }
            last = gaps;
        }
        (0..WIDTH).for_each(|lane| course.failed[lane] |= course.open[lane]);
    }

    /// The targets of the residuals.
    fn targets(&self, level: usize, q: &[Lanes], v: &[Lanes], gaps: Numbers) -> Numbers {
        let at = largest(if level == 0 { q } else { v }, &self.per_column);
        indexed(|lane| {
            if level == 0 {
                let target = self.tolerance;
                let rounding = match gaps[lane] <= target {
                    true => 0.0,
                    false => 8.0 * f64::EPSILON * at[lane],
                };
                target.max(rounding).min(CLOSED.max(self.tolerance))
            } else {
                (self.tolerance * at[lane].max(gaps[lane])).max(f64::MIN_POSITIVE)
            }
        })
    }

    /// One iteration with the current factor, in the open lanes.
    fn correct(&mut self, level: usize, workspace: &Workspace<Lanes>, x: &mut [Lanes], open: Mask) {
        let (upper, lower) = self.correction.split_at_mut(x.len());
        upper.fill(Lanes::zero());
        let rows = &self.residuals.rows[level];
        lower.iter_mut().zip(rows).for_each(|(right, r)| *right = -*r);
        workspace.matrix.solve(&mut self.correction);
        let open = Lanes::new(open.each(|open| if open { 1.0 } else { 0.0 }));
        for (x, dx) in x.iter_mut().zip(&self.correction) {
            *x = Lanes::select(open, *x + *dx, *x);
        }
    }
}

/// The largest scaled magnitude in each lane. NaN if a number is not finite.
fn largest(x: &[Lanes], per_scale: &[Lanes]) -> Numbers {
    let (mut most, mut not_finite) = (Lanes::zero(), Lanes::zero());
    for (x, per_scale) in x.iter().zip(per_scale) {
        let scaled = (*x * *per_scale).abs();
        most = most.max(scaled);
        // 0 x is zero for finite x and NaN otherwise
        not_finite = not_finite.plus_product(Lanes::zero(), scaled);
    }
    (most + not_finite).to_array()
}
