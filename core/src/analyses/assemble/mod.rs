//! Assembly: a consistent state from set coordinates, guesses, drawn positions and drivers.
//!
//! 1. The bodies are placed along the joints ([`place`]).
//! 2. Newton–Raphson solves Φ = 0 with the rows of drivers and of `set` ([`Closing`]).
//! 3. Angles are changed by whole turns to relax springs.
//! 4. The velocities become the consistent velocities nearest to the requested ones.
//!
//! A consistent position is not changed.

mod angle_winding;
mod attempt;
mod by_equation;
mod contact_placement;
mod contradiction;
mod culprits;
mod dyad;
mod dyad_placement;
mod equation_placement;
mod failure;
mod guided;
mod holding;
mod legs;
mod named;
mod open_placement;
mod openings;
mod outcome;
mod placement;
mod placements;
mod placer;
mod rates;
mod report;
mod report_json;
mod request;
mod rod_placement;
mod slider_placement;
mod slopes;
mod slot_placement;
mod target;
mod targets;
mod trains;
mod unset;
mod velocities;
mod wheel_placement;
mod worklist;

pub use super::closing::Closing;
pub(super) use angle_winding::wind;
pub use failure::{Failure, Fault};
pub use holding::holding;
pub use named::position;
pub use open_placement::open_placement;
pub use placement::{Dyad, DyadGap, Placement};
pub(super) use placements::{following, following_before};
pub use placer::place;
pub use report::{DyadMode, Report};
pub use request::{doubts, targets, Request};
pub use slopes::{determined, determines, implicit, rate_slopes, set_slopes, slopes, StartSlopes};
pub(super) use target::trimmed;
pub use target::{CoordinateTarget, QuantityTarget, Target};
pub use targets::Targets;
pub use unset::{Choice, Unset, ValueSource};

use super::closing::Halt;
use super::curves;
use super::meshing::{meshed, MESHED};
use super::required;
use super::second_order;
use super::second_order::mobility_until;
use super::State;
use crate::elements::QuantityKind;
use crate::math::Listed;
use crate::model::{row_scales, ConstraintItem, Model};
use attempt::{close_from, given, internal, Closed, MOST_TRIES};
use placements::Placements;
use std::ops::Range;
use target::{of_bodies, of_quantities};

/// Part by which the gap of one placement must be smaller than that of another.
const SAME_GAP: f64 = 1e-2;

/// Assembles a mechanism.
///
/// # Errors
/// [`Failure`] if the mechanism cannot close, if rates contradict the constraints, or if constraints are redundant
/// and redundancy is not allowed.
pub fn assemble(model: &Model, request: &Request) -> Result<(State, Report), Box<Failure>> {
    assemble_until(model, request, &|| false)
}

/// Like [`assemble`], but ends soon after `stop` returns true.
///
/// # Errors
/// The errors of [`assemble`], and [`Fault::Stopped`].
pub fn assemble_until(
    model: &Model,
    request: &Request,
    stop: Halt<'_>,
) -> Result<(State, Report), Box<Failure>> {
    let outcome = complete(model, request, stop);
    let outcome = outcome.map(|closed| closed.described(model, request, stop));
    match stop() {
        true => Err(Box::new(failure::stopped())),
        false => outcome,
    }
}

/// The state of [`assemble_until`] without the report. Sweeps need no report, and its computation takes time.
///
/// # Errors
/// The errors of [`assemble_until`].
pub fn state_until(
    model: &Model,
    request: &Request,
    stop: Halt<'_>,
) -> Result<State, Box<Failure>> {
    let outcome = complete(model, request, stop);
    match stop() {
        true => Err(Box::new(failure::stopped())),
        false => outcome.map(|closed| closed.state),
    }
}

/// A closed mechanism.
struct Complete {
    state: State,
    /// The report without unset quantities and assembly modes.
    report: Report,
    asked: Targets,
    /// The model with drivers for the positions that are set.
    extended: Model,
    /// The mechanism with rigid beams, if it has beams, and its closure.
    rigid: Option<(Model, Box<Complete>)>,
}

impl Complete {
    /// The state with the complete report.
    fn described(self, model: &Model, request: &Request, stop: Halt<'_>) -> (State, Report) {
        let Self { state, mut report, asked, extended, rigid } = self;
        if let Some((rigid, start)) = rigid {
            let (_, mut of_start) = start.described(&rigid, request, stop);
            of_start.degrees_of_freedom = report.degrees_of_freedom;
            return (state, of_start);
        }
        let State { q, v, .. } = &state;
        report.unset = unset::unset([model, &extended], request, &asked, [q, v], stop);
        describe(model, &asked, q, &mut report);
        (state, report)
    }
}

/// Closes a mechanism. Beams are closed as rigid bodies first, and their nodes keep these positions and rates.
fn complete(model: &Model, request: &Request, stop: Halt<'_>) -> Result<Complete, Box<Failure>> {
    match model.rigid().filter(|_| request.state.is_none()) {
        Some(rigid) => {
            let start =
                elastic(&rigid, request, stop).map_err(|failure| failure::of_rigid(*failure))?;
            let state = Some(start.state.clone());
            let closed =
                elastic(model, &Request { state, guess: Vec::new(), ..request.clone() }, stop)?;
            Ok(Complete { rigid: Some((rigid, Box::new(start))), ..closed })
        }
        None => elastic(model, request, stop),
    }
}

fn elastic(model: &Model, request: &Request, stop: Halt<'_>) -> Result<Complete, Box<Failure>> {
    let given = meshed_as_given(model, request);
    let model = given.as_ref().unwrap_or(model);
    let asked = asked(model, request, &request.guess);
    let extended = holding(model, request);
    let mut closing = Closing::new(&extended, request.t, stop);
    let closed = close(model, request, &asked, &mut closing);
    let Closed { mut q, iterations, mut warnings } = closed
        .or_else(|failure| trains::close(&closing, request, &asked).unwrap_or(Err(failure)))?;
    let found = meshed(model, request.t, &q);
    let (model, extended) = match &found {
        Some(meshed) => (meshed, holding(meshed, request)),
        None => (model, extended),
    };
    if request.state.is_none() {
        let closing = Closing::new(&extended, request.t, stop);
        warnings.extend(angle_winding::choose(model, &closing, request, &asked, &mut q));
    }
    warnings.extend(report::degrees(model, &request.doubts));
    let mut report = Report { iterations, warnings, ..Report::default() };
    if let Some(unmet) = required::missed(model, request.t, &q) {
        return Err(Box::new(failure::unmet(unmet)));
    }
    if let Some(failure) = failure::undefined(model, request.t, &q) {
        return Err(Box::new(failure));
    }
    if let Some(message) = curves::beyond(model, &q) {
        return Err(Box::new(failure::off_the_curve(message)));
    }
    let exact = second_order::corrected([model, &extended], request.t, &q, stop);
    let exact = exact.map(|(exact, acting)| {
        q = exact;
        acting
    });
    let mobility = mobility_until(model, request.t, &q, stop);
    if !mobility.redundant.is_empty() && !model.allow_redundancy {
        // drivers that agree on the position may have different rates or accelerations
        let named = rates::contradiction(model, request, &q, stop).or_else(|| {
            let extended = rates::holding_rates(model, request, &q);
            let redundant = &mobility.redundant_equations;
            contradiction::of_accelerations([model, &extended], request, &q, redundant)
        });
        return Err(Box::new(
            named.unwrap_or_else(|| failure::redundant(model, request.t, &q, &mobility)),
        ));
    }
    if let Some(unmet) = required::loose(model, request.t, &q) {
        return Err(Box::new(failure::unmet(unmet)));
    }
    report.degrees_of_freedom = mobility.degrees_of_freedom;
    report.warnings.extend(report::singular(model, &mobility.singular));
    report.warnings.extend(report::second_order(model, &mobility));
    let (model, extended) = match &exact {
        Some(acting) => (acting, holding(acting, request)),
        None => (model, extended),
    };
    let v = rates::consistent(model, request, &q, stop)?;
    let state = State { t: request.t, q, v, z: states(model, request) };
    Ok(Complete { state, report, asked, extended, rigid: None })
}

/// The model with the phases of a given state in which all joints but those of meshed wheels are closed.
fn meshed_as_given(model: &Model, request: &Request) -> Option<Model> {
    let State { t, q, .. } = request.state.as_ref()?;
    let meshed = meshed(model, *t, q)?;
    let phi = Closing::new(&meshed, *t, &|| false).phi(q);
    let scales = row_scales(&meshed);
    let is_open = |item: &ConstraintItem, rows: Range<usize>| {
        !item.driven && rows.into_iter().any(|row| phi[row].abs() > MESHED * scales[row])
    };
    let mut all = meshed.constraints.iter().zip(&meshed.layout.constraints);
    (!all.any(|(item, slots)| is_open(item, slots.rows.clone()))).then_some(meshed)
}

/// The first-order states: the set value if there is one, otherwise the guess, the given state, or zero.
fn states(model: &Model, request: &Request) -> Vec<f64> {
    let n_z = model.layout.n_z;
    let given = request.state.as_ref().map(|state| state.z.clone()).filter(|z| z.len() == n_z);
    let mut z = given.unwrap_or_else(|| vec![0.0; n_z]);
    for target in request.guess.iter().chain(&request.set) {
        if let Target::State { place, value } = target {
            z[*place] = *value;
        }
    }
    z
}

/// The targets: drivers and `set` are hard; drawn poses, guesses and a given state are soft.
fn asked(model: &Model, request: &Request, guess: &[Target]) -> Targets {
    let mut asked = Targets::of(model, request.t);
    if let Some(state) = &request.state {
        asked.approach(model, &state.q);
        asked.turn[1..].fill(true);
    }
    for target in of_bodies(guess) {
        asked.soft[target.body.0][target.coordinate.column()] = Some(target.value);
        asked.turn[target.body.0] |= target.coordinate.column() == 2;
    }
    for target in of_bodies(&request.set) {
        asked.hard[target.body.0][target.coordinate.column()] = Some(target.value);
        asked.turn[target.body.0] |= target.coordinate.column() == 2;
    }
    for target in of_quantities(&request.set).chain(of_quantities(guess)) {
        let turned = target.of.kind() == QuantityKind::Angle;
        target.of.bodies().iter().for_each(|body| asked.turn[body.0] |= turned);
    }
    for (hard, turn) in asked.hard.iter().zip(&mut asked.turn) {
        *turn |= hard[2].is_some();
    }
    asked
}

/// The first position, in the order of preference, from which the mechanism closes.
fn close(
    model: &Model,
    request: &Request,
    asked: &Targets,
    closing: &mut Closing<'_>,
) -> Result<Closed, Box<Failure>> {
    let internal = internal(model, request);
    if request.from_guess {
        let q = given(model, asked).unwrap_or_else(|| open_placement(model, asked));
        let outcome = close_from(closing, &internal, q, Vec::new());
        return outcome.map_err(|q| Box::new(unclosed(request, closing, &[q], &[])));
    }
    let unguessed = self::asked(model, request, &[]);
    if let Some(found) = guided::close(model, request, [asked, &unguessed], &internal, closing) {
        return Ok(found);
    }
    if let Some(found) =
        given(model, asked).and_then(|q| close_from(closing, &internal, q, Vec::new()).ok())
    {
        return Ok(found);
    }
    let mut missed = Vec::new();
    let without = (unguessed != *asked).then_some(&unguessed);
    for targets in without.into_iter().chain([asked]) {
        match close_placed(model, targets, &internal, closing) {
            Ok(found) => return Ok(found),
            Err(nearest) => missed.extend(nearest),
        }
    }
    // a guess may cause a gap of its own
    if matches!(&missed[..], [free, guessed] if guessed.left < (1.0 - SAME_GAP) * free.left) {
        missed.reverse();
    }
    let gaps = missed.iter().flat_map(|missed| missed.placement.gaps.clone()).list();
    let starts = missed.into_iter().flat_map(|missed| [missed.q, missed.placement.q]).list();
    Err(Box::new(unclosed(request, closing, &starts, &gaps)))
}

/// A placement from which the mechanism does not close.
struct Missed {
    placement: Placement,
    /// The position that Newton's method reached, and the scaled gap that is left there.
    q: Vec<f64>,
    left: f64,
}

/// The position from the first placement from which the mechanism closes; otherwise the placement with the fewest gaps.
fn close_placed(
    model: &Model,
    targets: &Targets,
    internal: &[(usize, f64)],
    closing: &mut Closing<'_>,
) -> Result<Closed, Option<Box<Missed>>> {
    let mut best: Option<Box<Missed>> = None;
    for placement in Placements::new(closing.model(), targets).take(MOST_TRIES) {
        let warnings = report::folded(model, &placement.dyads);
        let q = match close_from(closing, internal, placement.q.clone(), warnings) {
            Ok(found) => return Ok(found),
            Err(q) => q,
        };
        if best.as_ref().is_none_or(|best| placement.gaps.len() < best.placement.gaps.len()) {
            best = Some(Box::new(Missed { left: closing.left(&q), q, placement }));
        }
        if closing.stopped() {
            break;
        }
    }
    Err(best)
}

/// The reason that the mechanism does not close. `starts` are positions with small gaps, and the placements from which
/// they were reached.
fn unclosed(
    request: &Request,
    closing: &Closing<'_>,
    starts: &[Vec<f64>],
    gaps: &[DyadGap],
) -> Failure {
    let (model, q) = (closing.model(), &starts[0]);
    let undefined = failure::undefined(model, request.t, q);
    undefined
        .or_else(|| contradiction::of_positions(model, request, q, closing.stop()))
        .or_else(|| contradiction::of_joints(model, request.t, starts, closing.stop()))
        .unwrap_or_else(|| failure::open(model, request, closing, starts, gaps))
}

/// Writes the assembly mode into the report.
fn describe(model: &Model, asked: &Targets, q: &[f64], report: &mut Report) {
    let mut taken = asked.clone();
    taken.approach(model, q);
    let placement = place(model, &taken, &[]);
    report.modes = report::modes(model, &placement.dyads, q);
    let combinations = u32::try_from(report.modes.len()).ok().and_then(|n| 2_usize.checked_pow(n));
    report.alternatives = combinations.map(|all| all - 1);
}
