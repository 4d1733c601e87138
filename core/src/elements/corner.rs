//! Corners and gaps of a curve: places of its formulas at which C or C′ jumps.
//!
//! The breaks of a formula are known to rounding. The values on both sides are taken a short way off and extended to the
//! break, so that neither rounding nor curvature counts as a jump.

use super::plane_curve::Curve;
use crate::math::Local;

/// The way off a break, relative to the length of u.
const OFF: f64 = 1e-8;
/// Least jumps of C and of C′ that count, relative to the largest values.
const LEAST: [f64; 2] = [1e-9, 1e-6];

/// Where a curve jumps.
pub(super) struct Jump {
    /// The break.
    pub u: f64,
    /// The derivative that jumps, 0 or 1.
    pub order: usize,
    /// The distance of both sides, m.
    pub by: f64,
}

/// The first jump of a curve with the largest |C| and |C′| `largest`.
pub(super) fn jump(curve: &Curve, largest: [f64; 2]) -> Option<Jump> {
    let breaks = curve.breaks()?;
    let [low, high] = curve.range();
    let off = OFF * (high - low);
    let inside = |u: &f64| curve.periodic() || *u - off > low && *u + off < high;
    breaks.places().iter().copied().filter(inside).find_map(|u| {
        let [before, after] = [off, -off].map(|by| extended(curve, u - by, by));
        let by = [0, 1].map(|n| (after[n].x - before[n].x).hypot(after[n].y - before[n].y));
        let order = (0..2).find(|n| by[*n] > LEAST[*n] * largest[*n])?;
        Some(Jump { u, order, by: by[order] })
    })
}

/// C and C′ at u + by from the derivatives at u.
fn extended(curve: &Curve, u: f64, by: f64) -> [Local; 2] {
    let terms = curve.derivatives(u);
    let along = |x: fn(&Local) -> f64| {
        let [c0, c1, c2, c3] = terms.each_ref().map(x);
        [c0 + by * (c1 + 0.5 * by * c2), c1 + by * (c2 + 0.5 * by * c3)]
    };
    let [x, y] = [along(|c| c.x), along(|c| c.y)];
    [0, 1].map(|n| Local::new(x[n], y[n]))
}
