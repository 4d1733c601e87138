//! Whole turns: which of the angles that differ by 2π a body has after assembly.
//!
//! A guess or `set` fixes the turn of its body. Of the others those are chosen for which each
//! torsional spring, in the order of the file, is relaxed as far as whole turns can.

use super::wishes::{nearest_turn, Wishes};
use crate::model::{columns, Model};
use std::f64::consts::PI;

/// Shifts free angles of `q` by whole turns; gives a warning for each spring still beyond half a turn.
pub fn relax(model: &Model, wishes: &Wishes, q: &mut [f64]) -> Vec<String> {
    let mut fixed = wishes.turn.clone();
    fixed[0] = true;
    let mut warnings = Vec::new();
    for item in &model.forces {
        let Some(free_angle) = item.element.free_angle() else { continue };
        let [i, j] = item.element.ends();
        let angle = |q: &[f64], b| columns(b).last().map_or(0.0, |c| q[c]);
        let stretch = angle(q, j) - angle(q, i) - free_angle;
        let shift = nearest_turn(stretch, 0.0) - stretch;
        let (body, shift) = if fixed[j.0] { (i, -shift) } else { (j, shift) };
        if !fixed[body.0] {
            if let Some(column) = columns(body).last() {
                q[column] += shift;
            }
        }
        fixed[i.0] = true;
        fixed[j.0] = true;
        let stretch = angle(q, j) - angle(q, i) - free_angle;
        if stretch.abs() > PI * (1.0 + 1e-9) {
            warnings.push(format!(
                "spring {} starts {:.4} rad from its free angle, more than half a turn; \
                 the guess or set of its bodies fixes the turn",
                item.name, stretch
            ));
        }
    }
    warnings
}
