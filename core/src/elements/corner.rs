//! Corners and gaps of a curve: points at which its formulas make C or C′ jump.
//!
//! The breaks of a formula are known up to rounding errors. The values on both sides are evaluated at a short
//! distance and extrapolated to the break, so that neither rounding errors nor curvature count as a jump.

use super::plane_curve::Curve;
use crate::math::{each, Local, ShortArray};

/// The distance from a break, relative to the length of the range of u.
const OFF: f64 = 1e-8;
/// Smallest jumps of C and of C′ that are detected, relative to the largest values.
const LEAST: [f64; 2] = [1e-9, 1e-6];

/// A jump of a curve.
pub(super) struct Jump {
    /// The break.
    pub u: f64,
    /// The order of the derivative that jumps, 0 or 1.
    pub order: usize,
    /// The magnitude of the jump, m.
    pub by: f64,
}

/// The first jump of a curve. `largest` contains the largest |C| and |C′|.
pub(super) fn jump(curve: &Curve, largest: [f64; 2]) -> Option<Jump> {
    let breaks = curve.breaks()?;
    let [low, high] = curve.range();
    let off = OFF * (high - low);
    let inside = |u: &f64| curve.periodic() || *u - off > low && *u + off < high;
    breaks.places().iter().copied().filter(inside).find_map(|u| {
        let [before, after] = each([off, -off], |by| extended(curve, u - by, by));
        let by = each([0, 1], |n| (after[n].x - before[n].x).hypot(after[n].y - before[n].y));
        let order = (0..2).find(|n| by[*n] > LEAST[*n] * largest[*n])?;
        Some(Jump { u, order, by: by[order] })
    })
}

/// C and C′ at u + by from the derivatives at u.
fn extended(curve: &Curve, u: f64, by: f64) -> [Local; 2] {
    let terms = curve.derivatives(u);
    let along = |x: fn(&Local) -> f64| {
        let [c0, c1, c2, c3] = terms.each_ref().each(x);
        [c0 + by * (c1 + 0.5 * by * c2), c1 + by * (c2 + 0.5 * by * c3)]
    };
    let [x, y] = [along(|c| c.x), along(|c| c.y)];
    each([0, 1], |n| Local::new(x[n], y[n]))
}
