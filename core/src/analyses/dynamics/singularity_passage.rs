//! Passing of singular positions, where Φ_q loses rank for an instant and branches of the motion may meet.
//!
//! A motion that passes with a velocity stays on the branch to which this velocity is tangent. The integration follows
//! this branch, since it is the smooth continuation of the motion before. The branch is undecided
//!
//! * if the mechanism is almost at rest, 2 T ≤ [`REST`] |M⁻¹Q| L: the loads then turn it back or aside within a
//!   fraction of its size in which the branches cannot be distinguished;
//! * if its velocity is not tangent to any branch: Φ_q a = γ has no solution.

use super::model_cache::ModelCache;
use super::options::{Options, Singularity};
use super::redundant_rows::workspace_at;
use super::singularity_forecast::SingularityForecast;
use crate::analyses::mobility;
use crate::equations::augmented::NearSingular;
use crate::equations::forces::Acting;
use crate::equations::{constraints, forces, mass, Gains, Powers, Workspace};
use crate::math::{each, ShortArray};
use crate::model::{size, Model};
use crate::solve::Breakdown;

/// Branches cannot be distinguished if the ratio of a pivot to its largest summand is below this value, which
/// corresponds to a distance of 1e-3 of the mechanism's size.
const INDISTINCT: f64 = 1e-6;
/// Fraction of the size of the mechanism. The mechanism counts as at rest within this distance of its turning point.
const REST: f64 = 1e-3;
/// Largest remaining fraction of γ. The error of a trial state leaves far less.
const REMAINDER: f64 = 0.05;
/// Rounding of γ = 0, relative to the accelerations and divided by [`REMAINDER`].
const ROUNDING: f64 = 1e-9;
/// Loads below this fraction of the joint forces count as balanced.
const BALANCED: f64 = 1e-9;

/// The singular positions near a step.
pub(super) struct SingularityPassage {
    /// Whether a stage of the current trial was near a singular position.
    pub near: bool,
    /// Time of a singular position that the last accepted step passed, the slope of σ there, and a row that depends
    /// on others there.
    pub passed: Option<(f64, f64, usize)>,
    /// Reason and time of the last undecided trial state.
    pub undecided: Option<(f64, Breakdown)>,
    singularity: Singularity,
    /// Whether singular positions are passed at all.
    passing: bool,
    approach: SingularityForecast,
    /// In [sharp](Self::is_sharp) runs, the logarithm of the determinant at the start, by which determinants are
    /// divided.
    unit: Option<f64>,
    /// Time, and least ratio of a pivot to its largest summand, at the start of the step.
    from: Option<(f64, f64)>,
    /// Least pivot of the undecided trial states since the last step.
    least: f64,
    residual: Vec<f64>,
    loads: Vec<f64>,
}

/// Whether a run with projection passes the singular position at this state.
pub(super) fn would_pass(model: &Model, t: f64, [q, v, z]: [&[f64]; 3]) -> bool {
    if !model.allow_redundancy && !mobility(model, t, q).redundant.is_empty() {
        return false;
    }
    let mut work = workspace_at((model, &ModelCache::default()), t, [q, v, z]);
    work.matrix.set_near_singular(NearSingular::Regularise);
    let solved = work.accelerate(model, t, [q, v, z], Gains::default());
    let mut passage = SingularityPassage::new(&Options::new(t), true);
    // a motion without drivers is tangent to its branch, whatever the errors of this state are
    let decided = !model.driven || !passage.misses_gamma(model, &work, t);
    solved.is_ok() && decided && !passage.rests(model, &work, t, v)
}

impl SingularityPassage {
    pub fn new(options: &Options, passing: bool) -> Self {
        Self {
            near: false,
            passed: None,
            undecided: None,
            singularity: options.singularity,
            passing,
            approach: SingularityForecast::default(),
            unit: None,
            from: None,
            least: f64::INFINITY,
            residual: Vec::new(),
            loads: Vec::new(),
        }
    }

    /// Checks the accelerations that were just computed. Returns whether the motion decides its branch, or continues
    /// anyway. If not, stores the breakdown in [`undecided`](Self::undecided). The state may be a trial state, and
    /// the breakdown is an error only if no shorter step avoids it.
    #[inline(always)]
    pub fn watch(&mut self, model: &Model, work: &Workspace, t: f64, v: &[f64]) -> bool {
        if !(work.matrix.regularised() || self.approach.in_reach()) {
            return true;
        }
        let checked = self.check(model, work, t, v);
        self.undecided = checked.err().map(|breakdown| (t, breakdown)).or(self.undecided);
        checked.is_ok()
    }

    /// Checks the accelerations near a singular position.
    #[cold]
    fn check(
        &mut self,
        model: &Model,
        work: &Workspace,
        t: f64,
        v: &[f64],
    ) -> Result<(), Breakdown> {
        let regularised = work.matrix.regularised();
        self.near |= regularised || self.approach.is_behind(t);
        let Some((row, ratio)) = work.matrix.cancellation() else { return Ok(()) };
        self.approach.pass((t, self.measure(work, ratio)));
        if !regularised || self.singularity == Singularity::Pass || ratio > INDISTINCT {
            return Ok(());
        }
        if self.misses_gamma(model, work, t) {
            self.least = self.least.min(ratio);
            // a motion without drivers is tangent to its branch
            return Err(match model.driven {
                true => Breakdown::Row(row),
                false => Breakdown::Beside { row, left: self.least },
            });
        }
        if self.rests(model, work, t, v) {
            return Err(Breakdown::AtRest(row));
        }
        Ok(())
    }

    /// Begins the forecast at the start of a run, which may be [sharp](Self::is_sharp).
    pub fn begin(&mut self, t: f64, work: &Workspace, sharp: bool) {
        self.unit = sharp.then(|| work.matrix.log_determinant());
        self.from = work.matrix.cancellation().map(|(_, ratio)| (t, ratio));
        self.approach.begin(self.from.map(|(t, ratio)| (t, self.measure(work, ratio))));
    }

    /// The number that vanishes at singular positions. The least pivot may be one that is small everywhere, if masses
    /// differ much; the determinant is not.
    fn measure(&self, work: &Workspace, ratio: f64) -> f64 {
        self.unit.map_or(ratio, |unit| (work.matrix.log_determinant() - unit).exp())
    }

    /// Whether the run is sharp: the constraints determine its motion, and its tolerance is tighter than rates near
    /// singular positions are known.
    #[inline(always)]
    pub fn is_sharp(&self) -> bool {
        self.unit.is_some()
    }

    /// Whether a sharp run is within a few steps of a singular position.
    #[inline(always)]
    pub fn is_close(&self) -> bool {
        self.is_sharp() && self.approach.is_close()
    }

    /// The singular position ahead, if a step as long as the last trial can reach it.
    pub fn foresee(&mut self, t: f64, work: &Workspace) -> Option<f64> {
        self.near = false;
        if !self.passing {
            return None;
        }
        let (_, ratio) = work.matrix.cancellation()?;
        self.approach.foresee((t, self.measure(work, ratio)))
    }

    /// Whether the trial of the last forecast is near a singular position.
    pub fn in_reach(&self) -> bool {
        self.approach.in_reach()
    }

    /// Accepts the trial of the last forecast. The workspace belongs to the end of the trial.
    pub fn accept(&mut self, t: f64, work: &Workspace) {
        if self.passing {
            let end = work.matrix.cancellation();
            let measured = end.map(|(_, ratio)| (t, self.measure(work, ratio)));
            self.accept_at(t, end, measured);
        }
    }

    fn accept_at(&mut self, t: f64, end: Option<(usize, f64)>, measured: Option<(f64, f64)>) {
        self.least = f64::INFINITY;
        let from = self.from;
        self.from = end.map(|(_, ratio)| (t, ratio)).or(from);
        if let (Some(at), Some((row, _))) = (self.approach.accept(measured), end) {
            self.passed = Some((at, slope(at, [from, self.from]), row));
        }
    }

    /// Whether no singular position is near or in reach, and the run is not sharp.
    pub fn is_clear(&self) -> bool {
        !self.near && !self.in_reach() && !self.is_sharp()
    }

    /// Ends a trial if no singular position is in reach, given the loss of digits at its end; otherwise returns
    /// false.
    pub fn clears(&mut self, t: f64, ratio: f64) -> bool {
        let clear = !self.passing || self.approach.is_clear((t, ratio));
        if self.passing && clear {
            self.approach.foresee((t, ratio));
        }
        clear
    }

    /// Accepts a trial without a singular position in reach, given the loss of digits at its end.
    pub fn accept_clear(&mut self, t: f64, ratio: f64) {
        if self.passing {
            self.accept_at(t, Some((0, ratio)), Some((t, ratio)));
        }
    }

    /// Whether the mechanism is almost at rest under loads that would move it. The accelerations of a trial state are
    /// noisy here. The loads therefore measure rest, and accelerations are used only for the balance of loads.
    fn rests(&mut self, model: &Model, work: &Workspace, t: f64, v: &[f64]) -> bool {
        self.loads.resize(v.len(), 0.0);
        let acting = Acting { z: &work.z, lam: None, t };
        let powers = &mut Powers::zero();
        forces::generalized(model, &work.compiled, &work.motions, acting, &mut self.loads, powers);
        let (mut twice, mut pull, mut applied, mut mass_all) = (0.0, 0.0, 0.0, 0.0);
        let bodies = model.bodies.iter().zip(work.motions.iter()).zip(&model.layout.bodies).skip(1);
        for ((body, motion), columns) in bodies {
            let [v, a, load] = each([v, work.a(), &self.loads], |x| columns.of(x));
            let block = mass::block(body, motion);
            let square = |x: [f64; 3]| -> f64 {
                let m = block.times(x);
                x.iter().zip(m).map(|(x, m)| x * m).sum()
            };
            twice += square(v);
            pull += square(a);
            if body.mass > 0.0 {
                applied += (load[0] * load[0] + load[1] * load[1]) / body.mass;
            }
            if block.inertia > 0.0 {
                applied += load[2] * load[2] / block.inertia;
            }
            mass_all += body.mass;
        }
        let [pull, applied, root] = each([pull, applied, mass_all], f64::sqrt);
        // drivers that prescribe the whole motion also carry loads that do not move it
        let prescribed = model.layout.n_rows - work.matrix.omitted().len() >= model.layout.n_q;
        let moving = if prescribed { applied.min(pull) } else { applied };
        pull > BALANCED * applied && twice <= REST * moving * size(model) * root
    }

    /// Whether Φ_q a = γ is violated.
    fn misses_gamma(&mut self, model: &Model, work: &Workspace, t: f64) -> bool {
        self.residual.resize(model.layout.n_rows, 0.0);
        let [mut phi, mut rate, mut gamma] = [(); 3].each(|()| vec![0.0; model.layout.n_rows]);
        constraints::velocity_terms(model, &work.motions, t, &mut phi, &mut rate, &mut gamma);
        constraints::times_all(model, work.matrix.jacobian(), work.a(), &mut self.residual);
        let lengths = work.a().iter().zip(model.layout.lengths()).filter(|(_, length)| *length);
        let fastest = lengths.fold(0.0, |m: f64, (a, _)| m.max(a.abs()));
        let largest = gamma.iter().fold(ROUNDING * fastest, |m: f64, g| m.max(g.abs()));
        let missed =
            self.residual.iter().zip(&gamma).fold(0.0, |m: f64, (r, g)| m.max((r - g).abs()));
        missed > REMAINDER * largest
    }
}

/// Slope of the square root of the pivot from the time at which it vanishes, averaged over the samples.
fn slope(t: f64, samples: [Option<(f64, f64)>; 2]) -> f64 {
    let of = |(at, pivot): (f64, f64)| pivot.sqrt() / (at - t).abs().max(f64::MIN_POSITIVE);
    let known = samples.into_iter().flatten();
    known.clone().map(of).sum::<f64>() / known.count() as f64
}
