//! Closed trains of wheels: the phases at which they mesh.
//!
//! The equations of a closed train depend on each other, Σ y_k Φ_q,k = 0, so that it closes only if Σ y_k Φ_k = 0. The
//! phases x_k of the wheels are changed for this: Σ y_k (Φ_k - x_k) = 0. Without teeth, x_k is any number. With teeth,
//! it is a whole number n_k of pitches. Column operations with integers, as in Euclid's algorithm, bring the equations
//! for n to triangular form (Hermite), which shows whether there is a solution.

use super::attempt::{close_from, given, internal, Closed, MOST_TRIES};
use super::failure::{length, Failure};
use super::placements::Placements;
use super::request::Request;
use super::target::trimmed;
use super::targets::Targets;
use crate::analyses::closing::Closing;
use crate::analyses::dependence;
use crate::analyses::freedoms::NEARLY;
use crate::analyses::meshing::{meshes, Mesh};
use crate::elements::BodyId;
use crate::math::{Listed, Ordered};
use crate::model::{listed, Model};

/// Entries below this fraction of the largest one count as zero.
const ZERO: f64 = 1e-7;
/// Largest deviation of a number of pitches from a whole number.
const WHOLE: f64 = 1e-5;

/// Largest number of passes in which the numbers of pitches are made small.
const PASSES: usize = 100;

/// A dependence Σ a_k x_k = c between phases. Entries belong to the meshes.
#[derive(Clone)]
struct PhaseRelation {
    a: Vec<f64>,
    c: f64,
}

/// Teeth that do not meet.
struct Misfit {
    /// Their relation.
    relation: PhaseRelation,
    /// The wheels that take part: places in the list of meshes.
    wheels: Vec<usize>,
    /// The smallest phase of the last of them that closes the train, m.
    phase: f64,
    /// The smallest sum Σ a_k n_k p_k other than zero.
    unit: f64,
}

/// Closes a mechanism with other phases of its wheels. None if the wheels are not the reason that it stays open.
pub(super) fn close(
    closing: &Closing<'_>,
    request: &Request,
    asked: &Targets,
) -> Option<Result<Closed, Box<Failure>>> {
    let (model, t, stop) = (closing.model(), closing.time(), closing.stop());
    let meshes = meshes(model);
    let rows: Vec<usize> = meshes.iter().map(|mesh| mesh.row).list();
    if meshes.is_empty() || model.layout.n_rows > dependence::MOST_DENSE {
        return None;
    }
    let internal = internal(model, request);
    let mut open = Closing::new(model, t, stop).without(&rows);
    let placed = Placements::new(model, asked).take(MOST_TRIES).map(|placement| placement.q);
    let mut starts = given(model, asked).into_iter().chain(placed).take_while(|_| !stop());
    let q = starts.find_map(|q| close_from(&mut open, &internal, q, Vec::new()).ok())?.q;
    let phi = open.phi(&q);
    let dependent = dependence::at(model, t, &q, NEARLY, stop);
    let relation = |one: &dependence::Dependent| {
        let mut a = vec![0.0; meshes.len()];
        for (row, y) in &one.factors {
            rows.iter().position(|own| own == row).into_iter().for_each(|k| a[k] = *y);
        }
        let c = a.iter().zip(&rows).map(|(a, row)| a * phi[*row]).sum();
        PhaseRelation { a, c }
    };
    let (free, whole) = resolved(&meshes, dependent.iter().map(relation).list());
    let counts = match pitches(&meshes, &whole, &phi) {
        Ok(counts) => counts,
        Err(misfit) => return Some(Err(Box::new(failure(model, &meshes, &misfit)))),
    };
    let shifts = meshes.iter().zip(&counts).filter(|(_, count)| **count != 0.0);
    let name = |mesh: &Mesh| model.constraints[mesh.constraint].name.clone();
    let shifts = shifts.filter_map(|(mesh, n)| Some((name(mesh), n * mesh.pitch?))).list();
    let shifted = model.with_phases(shifts);
    let free: Vec<usize> = free.into_iter().map(|k| rows[k]).list();
    let mut closing = Closing::new(&shifted, t, stop).without(&free);
    // Φ is taken modulo whole turns, but the wheels turn by this number of teeth
    let mut phi = phi;
    for (mesh, n) in meshes.iter().zip(&counts) {
        phi[mesh.row] -= n * mesh.pitch.unwrap_or(0.0);
    }
    free.iter().for_each(|row| phi[*row] = 0.0);
    let q = closing.without_openings(&q, &phi);
    close_from(&mut closing, &internal, q, Vec::new()).ok().map(Ok)
}

/// Solves each relation for a free phase where it has one. Returns these phases, and the relations between teeth.
fn resolved(
    meshes: &[Mesh],
    mut relations: Vec<PhaseRelation>,
) -> (Vec<usize>, Vec<PhaseRelation>) {
    let (mut free, mut whole) = (Vec::new(), Vec::<PhaseRelation>::new());
    let all = relations.iter().flat_map(|one| &one.a);
    let zero = ZERO * all.fold(0.0, |most: f64, a| most.max(a.abs()));
    // first the free phases, then the teeth
    for toothed in [false, true] {
        for k in (0..meshes.len()).rev().filter(|k| meshes[*k].pitch.is_some() == toothed) {
            let found = relations.iter().position(|one| one.a[k].abs() > zero);
            let Some(pivot) = found.map(|place| relations.remove(place)) else { continue };
            for other in relations.iter_mut().chain(&mut whole) {
                other.subtract(other.a[k] / pivot.a[k], &pivot);
                other.a[k] = 0.0;
            }
            match toothed {
                true => whole.push(pivot),
                false => free.push(k),
            }
        }
    }
    let noise = whole.iter_mut().flat_map(|one| &mut one.a).filter(|a| a.abs() <= zero);
    noise.for_each(|a| *a = 0.0);
    (free, whole)
}

impl PhaseRelation {
    fn subtract(&mut self, part: f64, other: &Self) {
        self.a.iter_mut().zip(&other.a).for_each(|(a, b)| *a -= part * b);
        self.c -= part * other.c;
    }

    /// The relation Σ a_k p_k n_k = c for whole numbers n_k of pitches, divided by a unit of which all a_k p_k are
    /// multiples. Returns the unit too.
    fn in_whole_numbers(&self, pitch: impl Fn(usize) -> f64) -> (Self, f64) {
        let entries = self.a.iter().enumerate().map(|(k, a)| a * pitch(k)).list();
        let zero = ZERO * entries.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let divisor = entries.iter().fold(0.0, |mut a: f64, b| {
            let mut b = b.abs();
            while b > zero {
                (a, b) = (b, (a - (a / b).round() * b).abs());
            }
            a
        });
        let whole = entries.iter().map(|x| (x / divisor).round()).list();
        // the mean over all entries has smaller errors
        let unit = dot(&entries, &whole) / dot(&whole, &whole);
        (Self { a: whole, c: self.c / unit }, unit)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Numbers of pitches, and what they add to each relation.
#[derive(Clone)]
struct PitchColumn {
    entries: Vec<f64>,
    n: Vec<f64>,
}

impl PitchColumn {
    fn subtract(&mut self, times: f64, other: &Self) {
        let entries = self.entries.iter_mut().zip(&other.entries);
        let n = self.n.iter_mut().zip(&other.n);
        entries.chain(n).for_each(|(own, other)| *own -= times * other);
    }

    /// Subtracts multiples of other columns until none makes the numbers of pitches smaller.
    fn shorten(&mut self, others: &[&Self]) {
        for _ in 0..PASSES {
            let mut shorter = false;
            for other in others {
                let times = dot(&self.n, &other.n) / dot(&other.n, &other.n);
                if times.abs() > 0.5 {
                    self.subtract(times.round(), other);
                    shorter = true;
                }
            }
            if !shorter {
                return;
            }
        }
    }
}

/// Whole numbers of pitches that satisfy the relations between teeth.
fn pitches(meshes: &[Mesh], relations: &[PhaseRelation], phi: &[f64]) -> Result<Vec<f64>, Misfit> {
    let pitch = |k: usize| meshes[k].pitch.unwrap_or(0.0);
    let given = relations;
    let (relations, units): (Vec<PhaseRelation>, Vec<f64>) =
        given.iter().map(|one| one.in_whole_numbers(pitch)).unzip();
    // the nearest tooth of each pair
    let nearest =
        |k: usize| meshes[k].pitch.map_or(0.0, |pitch| (phi[meshes[k].row] / pitch).round());
    let n = (0..meshes.len()).map(nearest).list();
    let mut found =
        PitchColumn { entries: relations.iter().map(|one| dot(&one.a, &n) - one.c).list(), n };
    let mut columns: Vec<PitchColumn> = (0..meshes.len())
        .map(|k| {
            let n = (0..meshes.len()).map(|j| f64::from(u8::from(j == k))).list();
            PitchColumn { entries: relations.iter().map(|one| one.a[k]).list(), n }
        })
        .list();
    for r in 0..relations.len() {
        let Some(mut pivot) = reduced(&mut columns, r) else { continue };
        // the other columns leave the sum of this relation as it is, so that they may make numbers smaller
        for _ in 0..2 {
            for k in 0..columns.len() {
                let mut column = columns[k].clone();
                let others = (0..columns.len()).filter(|j| *j != k).map(|j| &columns[j]).list();
                column.shorten(&others);
                columns[k] = column;
            }
        }
        let others = columns.iter().list();
        pivot.shorten(&others);
        found.subtract((found.entries[r] / pivot.entries[r]).round(), &pivot);
        found.shorten(&others);
        let rest = found.entries[r] / pivot.entries[r];
        if rest.abs() > WHOLE {
            let (relation, unit) = (given[r].clone(), pivot.entries[r] * units[r]);
            let wheels = (0..meshes.len()).filter(|k| relation.a[*k] != 0.0).list();
            let last = *wheels.last().expect("a pivot has an entry");
            let phase = -rest * unit / relation.a[last];
            return Err(Misfit { relation, wheels, phase, unit });
        }
    }
    Ok(found.n)
}

/// The only column with an entry in row `r` after Euclid's algorithm, removed from the others.
fn reduced(columns: &mut Vec<PitchColumn>, r: usize) -> Option<PitchColumn> {
    loop {
        let entry = |k: &usize| columns[*k].entries[r].abs();
        let mut with_entry = (0..columns.len()).filter(|k| entry(k) > 0.0).list();
        with_entry.order_by(|a, b| entry(a).total_cmp(&entry(b)));
        let (least, others) = with_entry.split_first()?;
        if others.is_empty() {
            return Some(columns.remove(*least));
        }
        let by = columns[*least].clone();
        for k in others {
            let times = (columns[*k].entries[r] / by.entries[r]).round();
            columns[*k].subtract(times, &by);
        }
    }
}

fn failure(model: &Model, meshes: &[Mesh], misfit: &Misfit) -> Failure {
    let items = misfit.wheels.iter().map(|k| &model.constraints[meshes[*k].constraint]);
    let names: Vec<&str> = items.map(|item| item.name.as_str()).list();
    let last = meshes[*misfit.wheels.last().expect("a wheel")];
    let item = &model.constraints[last.constraint];
    let offset = item.element.clone().phase_mut().map_or(0.0, |x| *x) + misfit.phase;
    let part = misfit.phase.abs() / last.pitch.unwrap_or(1.0);
    let (by, name) = (length(misfit.phase.abs()), &item.name);
    let offset = trimmed(offset, 12);
    let message = format!(
        "the teeth of {} do not meet: the phase of {name} is off by {by}, {} of a pitch",
        listed(&names),
        trimmed(part, 3)
    );
    let hint = format!(
        "{}change the numbers of teeth or what is set, or write offset = {offset} in {name}",
        planets(model, meshes, misfit)
    );
    Failure::open(name, misfit.phase.abs(), message, hint)
}

/// The angles between planets at which they mesh with the same wheels, as a text. Empty for other trains.
///
/// If the centre of a planet goes round by a whole turn, each of its equations changes by its modulus.
fn planets(model: &Model, meshes: &[Mesh], misfit: &Misfit) -> String {
    let Some(last) = misfit.wheels.last().map(|k| &model.constraints[meshes[*k].constraint]) else {
        return String::new();
    };
    let around = |body: &BodyId| {
        let with_body = misfit.wheels.iter().filter_map(|k| {
            let item = &model.constraints[meshes[*k].constraint];
            let modulus = item.element.modulus().filter(|_| item.bodies.contains(body))?;
            Some(misfit.relation.a[*k] * modulus)
        });
        let with_body = with_body.list();
        let places = (with_body.iter().sum::<f64>() / misfit.unit).abs().round();
        (places > 1.0 && with_body.len() > 1).then(|| (model.bodies[body.0].name.as_str(), places))
    };
    let Some((name, places)) = last.bodies.iter().find_map(around) else { return String::new() };
    let angle = trimmed(360.0 / places, 4);
    format!(
        "{name} meshes at every 360°/{places} = {angle}° around the centre, so that the number of equal planets \
         must divide {places}; "
    )
}
