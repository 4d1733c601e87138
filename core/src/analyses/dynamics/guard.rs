//! The guard at the end of a run: a result that does not satisfy its own equations is an error.
//!
//! It looks at [some](ExaminedRows) reported states of each phase: at the energy balance, the joints, the gaps of rigid
//! contacts, and the Newton–Euler balances of the reported forces. The limits are options of the run. Drift without
//! projection, the energy that damped methods lose and the error of constant steps belong to the method that was chosen:
//! they become [doubts](Run::doubts) of the result.

use super::accelerations::{accelerations, Accelerations};
use super::energies::energies;
use super::examined_rows::{each, ExaminedRows};
use super::failure::{equation, Failure, Reason};
use super::methods::Scheme;
use super::model_cache::ModelCache;
use super::modes::{gap_unit, rigid_contacts};
use super::options::Options;
use super::run_results::Run;
use super::stabilizations::Stabilization;
use super::start_check::rounding;
use super::trajectory::States;
use super::ENERGIES;
use crate::analyses::balances::{EnergyBalance, ReactionBalance};
use crate::equations::constraints;
use crate::equations::energy;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::newton_euler::{self, Balances};
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{row_scales, size, Model, WORKS};
use serde::{Deserialize, Serialize};

/// Opening of a joint without projection, relative to the size or in rad, beyond which the result has a doubt.
const DRIFT: f64 = 1e-4;
/// Opening of a joint in a run that passed a singular position, beside which a gap e moves bodies by √e, or with
/// redundant joints, whose lengths need not agree better.
const BESIDE: f64 = 1e-8;
/// Part of the largest regularity below which a state is beside a singular position.
const NEAR: f64 = 0.3;
/// Part of the kinetic energy per size below which the errors of forces are rounding errors, although no force acts.
const ROUNDED: f64 = 1e-6;
/// Part of the energy of a usual motion below which energies are rounding errors.
const LEAST: f64 = 1e-9;

/// The largest value so far, with its time and name.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Worst {
    value: f64,
    t: f64,
    name: String,
}

impl Worst {
    /// Takes a value if it is larger. A value that is not a number is not compared: reading it is an error.
    fn see(&mut self, value: f64, t: f64, name: impl FnOnce() -> String) {
        if value > self.value {
            *self = Self { value, t, name: name() };
        }
    }
}

/// The balances of a run so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Guard {
    limits: LargestBalances,
    energy: EnergyBalance,
    change: Worst,
    reactions: ReactionBalance,
    /// A force whose errors matter, N.
    least_force: f64,
    /// The examined states, each with its time and regularity.
    examined: Vec<(f64, f64, Balances)>,
    /// The balance without the efforts that equations of second order imply, with the coordinates that they keep.
    left_out: Worst,
    /// The largest regularity.
    regularity: f64,
    joints: Worst,
    contacts: Worst,
    /// An energy whose errors matter, J.
    least_energy: f64,
}

/// The limits of a run.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct LargestBalances {
    force: f64,
    joint: Option<f64>,
    /// The least limit of a joint without an option, relative to the size or in rad.
    closed: f64,
    penetration: f64,
    energy: f64,
    /// Whether joints may drift.
    drifts: bool,
    /// Whether an energy balance beyond the limit is an error of the chosen method.
    loses: bool,
}

impl LargestBalances {
    fn of(options: &Options) -> Self {
        let control = options.method.control();
        let rtol = if control.step.is_some() { 0.0 } else { control.rtol };
        let (drifts, closed) = match options.stabilization {
            Stabilization::Projection(projection) => (false, projection.tolerance.max(1e-9)),
            _ => (true, DRIFT),
        };
        let damped = matches!(options.method, Scheme::GeneralizedAlpha(_));
        Self {
            force: options.force_limit,
            joint: options.joint_limit,
            closed,
            penetration: options.penetration_limit.unwrap_or((1e2 * rtol).max(1e-6)),
            energy: options.energy_limit.unwrap_or((1e4 * rtol).max(1e-3)),
            drifts,
            loses: drifts || damped || control.step.is_some(),
        }
    }
}

impl Guard {
    /// The guard of a run with these options. `energy` is that of a usual motion, J.
    pub fn new(energy: f64, options: &Options) -> Self {
        Self {
            least_energy: LEAST * energy,
            limits: LargestBalances::of(options),
            energy: EnergyBalance::new(),
            change: Worst::default(),
            reactions: ReactionBalance::default(),
            least_force: 0.0,
            examined: Vec::new(),
            left_out: Worst::default(),
            regularity: 0.0,
            joints: Worst::default(),
            contacts: Worst::default(),
        }
    }

    /// Allows for the energy that an action of the caller adds, J.
    pub fn allow(&mut self, energy: f64) {
        self.energy.allow(energy);
    }

    /// Looks at some reported states of the last phase of a run, if it did not fail.
    pub fn look(&mut self, (model, cache): (&Model, &ModelCache), run: &Run, succeeded: bool) {
        let Some(phase) = run.phases.len().checked_sub(1).filter(|_| succeeded) else { return };
        let works = &run.trajectory.works[WORKS * run.phases[phase]..];
        let rows = ExaminedRows::some(model, run.states_of(phase), works);
        let (states, mut watch) = (rows.states(), |_: f64| Flow::Continue);
        self.look_at_energies((model, cache), states, &rows.works);
        self.look_at_gaps(model, states, run);
        // reading accelerations that do not exist is an error
        if let Ok(found) = accelerations((model, cache), states, run.passing, &mut watch) {
            self.look_at_forces(model, states, &found);
        }
    }

    fn look_at_energies(
        &mut self,
        prepared: (&Model, &ModelCache),
        states: States<'_>,
        works: &[f64],
    ) {
        // reading an energy that is not finite is an error
        let Ok(found) = energies(prepared, states, works) else { return };
        for (row, t) in found.chunks_exact(ENERGIES).zip(states.t) {
            self.energy.add(row.try_into().expect("a row"));
            self.change.see(self.energy.change.abs(), *t, String::new);
        }
    }

    fn look_at_gaps(&mut self, model: &Model, states: States<'_>, run: &Run) {
        let (mut phi, scales) = (vec![0.0; model.layout.n_rows], row_scales(model));
        let exact = run.passed.is_empty() && !model.allow_redundancy;
        let beside = if exact { 0.0 } else { BESIDE };
        let size = size(model);
        let contacts: Vec<(usize, f64)> =
            rigid_contacts(model).map(|k| (k, gap_unit(model, size, k))).list();
        let mut motions = Motions::new(&model.layout);
        for (t, [q, v, z]) in each(model, states) {
            motions.place(&model.layout, q, v);
            constraints::residual(model, &motions, t, &mut phi);
            let closed = self.limits.closed.max(rounding(model, q)).max(beside);
            let most = self.limits.joint.unwrap_or(closed);
            for (row, gap) in phi.iter().enumerate() {
                let share = gap.abs() / (scales[row] * most);
                self.joints.see(share, t, || opened(model, row, *gap, scales[row] * most));
            }
            let acting = Acting { z, lam: None, t };
            for (k, unit) in &contacts {
                let depth = -forces::threshold(model, *k, &motions, acting) / unit;
                self.contacts.see(depth, t, || model.forces[*k].name.clone());
            }
        }
    }

    fn look_at_forces(&mut self, model: &Model, states: States<'_>, found: &Accelerations) {
        let Accelerations { a, lam, regularity } = found;
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let mut motions = Motions::new(&model.layout);
        for (k, (t, [q, v, z])) in each(model, states).enumerate() {
            motions.place(&model.layout, q, v);
            let acting = Acting { z, lam: Some(&lam[k * m..(k + 1) * m]), t };
            let at = newton_euler::balances(model, &motions, &a[k * n..(k + 1) * n], acting);
            self.reactions.add(&at);
            let rounded = ROUNDED * energy::stirred(model, &motions) / size(model);
            self.least_force = self.least_force.max(rounded);
            self.look_at_implied(model, &motions, &a[k * n..(k + 1) * n], acting);
            self.regularity = self.regularity.max(regularity[k]);
            self.examined.push((t, regularity[k], at));
        }
    }

    /// Reported reactions do not contain the efforts of implied constraints.
    fn look_at_implied(
        &mut self,
        model: &Model,
        motions: &Motions,
        a: &[f64],
        acting: Acting<'_, f64>,
    ) {
        let implied = model.constraints.len() - model.blueprint.implied..model.constraints.len();
        if implied.is_empty() {
            return;
        }
        let rows = model.layout.constraints[implied.start].rows.start;
        let mut lam = acting.lam.unwrap_or_default().to_vec();
        lam[rows..].fill(0.0);
        let reported =
            newton_euler::balances(model, motions, a, Acting { lam: Some(&lam), ..acting });
        let names = || model.names_of(implied.clone().collect::<Vec<_>>().iter()).join(", ");
        self.left_out.see(self.reactions.largest(&reported), acting.t, names);
    }

    /// The verdict on a run that ended. `name` gives the body or joint of a row of the balances.
    ///
    /// # Errors
    /// [`Reason::Integration`] with the balance that exceeds its limit, its time and a remedy. Otherwise the doubts.
    fn verdict(&self, name: &dyn Fn(usize) -> String, run: &Run) -> Result<Vec<String>, Reason> {
        let mut doubts = Vec::new();
        let mut beyond = |t: f64, message: String, hint, doubtful: bool| match doubtful {
            true => {
                doubts.push(message);
                Ok(())
            }
            false => Err(Reason::Integration { t, message, hint }),
        };
        let LargestBalances { force, penetration, energy, drifts, loses, .. } = self.limits;
        let forces = self.worst_forces(name);
        if forces.value > force {
            let Worst { value, t, name } = forces;
            let message = format!(
                "the forces on {name} do not balance at t = {t:.6} s: the Newton-Euler residual is {value:.1e} of the \
                 largest force, more than force_limit = {force:.1e}"
            );
            beyond(t, message, UNBALANCED, false)?;
        }
        if self.left_out.value > force {
            let Worst { value, t, name } = &self.left_out;
            let message = format!(
                "the reactions leave out the load along {name}, {value:.1e} of the largest force at t = {t:.6} s: \
                 joints that keep {name} only to second order would need infinite forces for it. To include it, add a \
                 coupling that keeps {name}, with redundancy = \"allow\""
            );
            beyond(*t, message, "", true)?;
        }
        if self.joints.value > 1.0 {
            let Worst { t, name, .. } = &self.joints;
            let message = format!("the joints are open at t = {t:.6} s: {name}");
            beyond(*t, message, OPEN, drifts)?;
        }
        if self.contacts.value > penetration {
            let Worst { value, t, name } = &self.contacts;
            let message = format!(
                "{name} penetrates at t = {t:.6} s: {value:.1e} of the size of the mechanism, more than \
                 penetration_limit = {penetration:.1e}"
            );
            beyond(*t, message, PENETRATES, drifts)?;
        }
        let Worst { value, t, .. } = self.change;
        let scale = self.energy.scale().max(run.largest_energy).max(self.least_energy);
        let share = value / scale;
        if share > energy {
            let message = format!(
                "the energy balance is not met at t = {t:.6} s: energy changes by {share:.1e} of the largest energy, \
                 {scale:.3e} J, more than energy_limit = {energy:.1e}"
            );
            beyond(t, message, ENERGY, loses)?;
        }
        Ok(doubts)
    }

    /// The verdict on a part of a run. The states that were examined are then forgotten, so that a run of any length
    /// needs no more memory.
    ///
    /// # Errors
    /// The errors of [`verdict`](Self::verdict).
    pub fn judge_part(&mut self, model: &Model, run: &Run) -> Result<Vec<String>, Reason> {
        let verdict = self.verdict(&|k| owner(model, k), run);
        self.examined.clear();
        verdict
    }

    /// The largest residual of the forces, relative to the largest forces of the run. Beside a singular position,
    /// forces have errors in inverse proportion to the square of the distance, and so of the regularity.
    fn worst_forces(&self, name: &dyn Fn(usize) -> String) -> Worst {
        let mut worst = Worst::default();
        for (t, regularity, at) in &self.examined {
            let part = regularity / self.regularity;
            let regular = if part < NEAR { 0.1 * part * part } else { 1.0 };
            for (k, share) in self.reactions.shares(at, self.least_force).into_iter().enumerate() {
                worst.see(share * regular, *t, || name(k));
            }
        }
        worst
    }
}

const UNBALANCED: &str =
    "this is a fault of the computation: please report the model; until then try another method, \
                          or larger masses in place of very small ones";
const OPEN: &str =
    "use smaller tolerances or steps, or a larger joint_limit if this opening is acceptable";
const PENETRATES: &str =
    "use max_step, so that no step passes the contact, or smaller tolerances, or a larger \
                          penetration_limit if this depth is acceptable";
const ENERGY: &str =
    "use smaller tolerances, or max_step if a force acts for a short time only, or a larger \
                      energy_limit if this change is acceptable";

/// A row of Φ that is open.
fn opened(model: &Model, row: usize, gap: f64, most: f64) -> String {
    let (name, unit) = equation(model, row);
    format!("constraint {name} by {:.1e} {unit}, more than {most:.1e} {unit}", gap.abs())
}

/// The body, or the joint with an internal coordinate, of a row of the balances.
fn owner(model: &Model, k: usize) -> String {
    let bodies = model.bodies.len() - 1;
    if k < bodies {
        return model.bodies[k + 1].name.clone();
    }
    let first: usize = model.layout.bodies.iter().map(|body| body.count).sum();
    let column = first + k - bodies;
    let own = model.layout.constraints.iter().position(|of| of.own.range().contains(&column));
    let name = own.map_or("a joint", |own| &model.constraints[own].name);
    format!("the place of {name} on its curve")
}

/// Ends a run: an error if it exceeds a limit, otherwise its doubts become part of it. A run that the caller stopped is
/// not judged.
///
/// # Errors
/// [`Failure`] with the run, which then has not reached its end.
pub(super) fn end(guard: &Guard, model: &Model, mut run: Run) -> Result<Run, Box<Failure>> {
    if !run.reached && run.stopped_by.is_none() {
        return Ok(run);
    }
    match guard.verdict(&|k| owner(model, k), &run) {
        Ok(doubts) => {
            run.doubts.extend(doubts);
            Ok(run)
        }
        Err(reason) => {
            (run.reached, run.stopped_by) = (false, None);
            Err(Box::new(Failure { reason, run }))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::newton_euler::{BodyBalance, CoordinateBalance};

    /// The verdict on one state in which an internal coordinate has this residual.
    fn verdict(effort: f64) -> Result<Vec<String>, Reason> {
        let mut guard = Guard::new(1.0, &Options::new(1.0));
        let body = BodyBalance { largest_force: 2.0, lever: 1.0, ..BodyBalance::default() };
        let own = CoordinateBalance { effort, largest_effort: 2.0, lever: 1.0 };
        let at = Balances { bodies: vec![body], coordinates: vec![own] };
        guard.reactions.add(&at);
        guard.examined.push((0.5, 1.0, at));
        guard.regularity = 1.0;
        guard.verdict(&|row| format!("row {row}"), &Run::default())
    }

    #[test]
    fn an_internal_coordinate_out_of_balance_is_an_error() {
        assert_eq!(verdict(1e-8), Ok(Vec::new()));
        let Err(Reason::Integration { t, message, .. }) = verdict(3e-8) else { panic!("accepted") };
        assert_eq!(t, 0.5);
        assert!(message.contains("the forces on row 1 do not balance"), "{message}");
    }
}
