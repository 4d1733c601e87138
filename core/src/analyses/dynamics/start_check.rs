//! The check of a state from which a run or a phase starts: its joints must be closed.
//!
//! A start is accepted if |Φ| ≤ [`CLOSED`] and |Φ_q v - ν| ≤ [`CLOSED`] times the pace, with lengths divided by the
//! size of the mechanism. The pace is the fastest rate of the state, and at least 1/s. Any other state is refused. It
//! is not corrected, because the run would then start at a different state.

use super::constraint_violation::{ADRIFT, APART};
use super::failure::{Failure, Reason};
use super::massless;
use super::model_cache::ModelCache;
use super::options::Options;
use super::redundant_rows::workspace_at;
use super::shared_reaction;
use super::stabilizations::Stabilization;
use crate::analyses::required::{self, Unmet};
use crate::elements::Group;
use crate::equations::augmented::NearSingular;
use crate::equations::kinematics::Motions;
use crate::equations::{constraints, Gains};
use crate::math::Listed;
use crate::model::{column_scales, row_scales, Model};

/// Largest opening of a joint: lengths relative to the size of the mechanism, angles in rad.
const CLOSED: f64 = 1e-9;
/// Multiple of the rounding error of Φ that is accepted for large coordinates, as in projection.
const ROUNDING: f64 = 8e3 * f64::EPSILON;
/// Largest opening that counts as rounding.
const ROUNDED: f64 = 1e-8;
/// Largest rate of opening near a singular position. There, a deviation e leaves residuals of order e² in Φ and of
/// order e in Φ_q v - ν.
const NEAR: f64 = 1e-6;

/// The limits of a start.
#[derive(Clone, Copy, Debug)]
pub(super) struct StartCheck {
    closed: f64,
    rounded: f64,
    /// Largest rate of opening; None if velocities are projected.
    rate: Option<f64>,
    near: f64,
    hint: &'static str,
}

/// Rows of Φ, or of its rate, with the largest allowed magnitude of each row.
struct ConstraintRows<'a> {
    rows: &'a [f64],
    most: Vec<f64>,
    /// The text after the unit of a row: empty, or per second.
    per: &'static str,
}

impl StartCheck {
    /// The check of the start of a run.
    pub fn of_run(options: &Options) -> Self {
        let tolerance = match options.stabilization {
            Stabilization::Projection(projection) => projection.tolerance,
            _ => 0.0,
        };
        let closed = CLOSED.max(tolerance);
        Self {
            closed,
            rounded: ROUNDED,
            rate: Some(closed),
            near: NEAR,
            hint: "kp.assemble(model, from_state=state) assembles the mechanism anew, as near to this state as it \
                   can be",
        }
    }

    /// The check of a state that a run reached. It meets the constraints up to the errors of integration.
    pub fn of_continuation(options: &Options) -> Self {
        let most = match options.stabilization {
            Stabilization::None => ADRIFT,
            _ => APART,
        };
        Self {
            closed: most,
            rounded: most,
            rate: Some(most),
            near: most,
            hint: "a phase or a restart must begin where its joints are closed",
        }
    }

    /// The check after an event that changes the state or the mechanism. The state has the errors of the run.
    pub fn of_change(options: &Options) -> Self {
        let base = match options.stabilization {
            Stabilization::Projection(_) => Self::of_run(options),
            _ => Self::of_continuation(options),
        };
        let hint = "after an event, positions and velocities must meet the constraints; kp.assemble(model, \
                    from_state=state) finds the nearest state that does";
        Self { hint, ..base }
    }

    /// The same check without a limit for the velocities.
    pub fn of_positions(self) -> Self {
        Self { rate: None, ..self }
    }

    /// Checks a state.
    ///
    /// # Errors
    /// [`Failure`] with [`Reason::Start`], which names the joint with the largest opening, or with
    /// [`Reason::Singular`], which names a massless body whose motion is not determined.
    pub fn check(&self, model: &Model, t: f64, state: [&[f64]; 3]) -> Result<(), Box<Failure>> {
        let [q, v, _] = state;
        let m = model.layout.n_rows;
        let (mut phi, mut rate, mut gamma) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
        let motions = Motions::at(&model.layout, q, v);
        constraints::velocity_terms(model, &motions, t, &mut phi, &mut rate, &mut gamma);
        let rows = row_scales(model);
        let level = |found, most: f64, per| {
            let most = rows.iter().map(|scale| most * scale).list();
            ConstraintRows { rows: found, most, per }
        };
        let closed = rounding(model, q).clamp(self.closed, self.closed.max(self.rounded));
        level(&phi, closed, "").check(model, t, self.hint)?;
        if let Some(Unmet { name, message, hint, .. }) = required::missed(model, t, q) {
            return Err(Reason::Start { t, name, message, hint }.into());
        }
        massless::check(model, t, q)?;
        shared_reaction::check(model, t, q)?;
        let Some(limit) = self.rate else { return Ok(()) };
        let pace = largest(model, v).max(1.0);
        let checked = level(&rate, limit * pace, "/s").check(model, t, self.hint);
        if checked.is_err() && is_near_singular(model, t, state) {
            return level(&rate, limit.max(self.near) * pace, "/s").check(model, t, self.hint);
        }
        checked
    }
}

impl ConstraintRows<'_> {
    fn check(&self, model: &Model, t: f64, hint: &'static str) -> Result<(), Box<Failure>> {
        // NaN counts as open
        let over = self.rows.iter().zip(&self.most).map(|(gap, most)| gap.abs() / most);
        let over = over.map(|over| if over.is_nan() { f64::INFINITY } else { over });
        let widest = over.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((row, _)) = widest.filter(|(_, over)| *over > 1.0) else { return Ok(()) };
        let item = &model.constraints[model.layout.owner(row).0];
        let kind = item.equations[model.layout.owner(row).1].kind;
        let own = model.layout.constraints[model.layout.owner(row).0].rows.clone();
        let (gap, unit) = (item.opening(kind, &self.rows[own]), kind.unit());
        let (what, per) = (if item.group == Group::Drivers { "driver" } else { "joint" }, self.per);
        let (verb, most) = (if per.is_empty() { "is open by" } else { "opens at" }, self.most[row]);
        let message = format!(
            "the state does not meet the constraints at t = {t:.6} s: {what} {} {verb} {gap:.3e} {unit}{per}; at \
             most {most:.1e} {unit}{per} is accepted",
            item.name
        );
        Err(Reason::Start { t, name: item.name.clone(), message, hint }.into())
    }
}

/// The rounding error of Φ at a position, relative to the size or in rad.
pub(super) fn rounding(model: &Model, q: &[f64]) -> f64 {
    ROUNDING * largest(model, q)
}

/// The largest coordinate or rate, with lengths divided by the size of the mechanism.
fn largest(model: &Model, x: &[f64]) -> f64 {
    let scaled = x.iter().zip(column_scales(model)).map(|(x, scale)| x.abs() / scale);
    scaled.fold(0.0, f64::max)
}

fn is_near_singular(model: &Model, t: f64, state: [&[f64]; 3]) -> bool {
    let mut workspace = workspace_at((model, &ModelCache::default()), t, state);
    workspace.matrix.set_near_singular(NearSingular::Regularise);
    let solved = workspace.accelerate(model, t, state, Gains::default());
    solved.is_ok() && workspace.matrix.regularised()
}
