//! The quantities that a request for an assembly does not set, and the values chosen for them.
//!
//! The freedoms that remain after drivers and `set` are the null space of Φ_q with their rows. Each freedom is named
//! by one coordinate, such that these coordinates together determine the motion. Coordinates that were guessed and
//! met come first, then angles, then positions, in the order of the bodies, unless another coordinate moves ten times
//! as far. Rates are named in the same way, but rates of coordinates that were set also come first.

use super::rates::holding_rates;
use super::request::Request;
use super::target::{of_bodies, of_motion, of_quantities, of_rates, CoordinateTarget, Target};
use super::targets::Targets;
use crate::analyses::closing::Halt;
use crate::analyses::freedoms::freedoms;
use crate::analyses::second_order::mobility_until;
use crate::elements::Coordinate;
use crate::math::{Listed, Ordered};
use crate::model::{column_scales, size, Model};
use crate::solve::{rank, RANK_TOLERANCE};

/// Largest number of coordinates of a model for which freedoms are named. The cost is cubic.
const MOST_NAMED: usize = 120;
/// Largest difference between a value and its guess, relative to the size of the mechanism, for which they count as
/// equal.
const EQUAL: f64 = 1e-9;

/// The source of the value of a coordinate or rate that was not set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueSource {
    /// The guess of the quantity.
    Guess,
    /// The value nearest to its guess that the joints allow. Contains the guess, in m, rad or per s.
    NearGuess(f64),
    /// Quantities other than coordinates were guessed.
    Guesses,
    /// The drawn position of the body.
    Drawing,
    /// Nothing was given.
    Nothing,
    /// A rate: the mechanism is at rest.
    Rest,
    /// A rate: the motion with the least kinetic energy, relative to the guessed rates.
    LeastEnergy,
}

/// A coordinate or rate that was not set, with the value that was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Such as `crank.angle` or `crank.omega`.
    pub name: String,
    /// m, rad or per s.
    pub value: f64,
    /// SI unit.
    pub unit: &'static str,
    /// The source of the value.
    pub source: ValueSource,
}

/// The coordinates and rates that were not set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unset {
    /// Number of free coordinates, and of free rates.
    pub count: [usize; 2],
    /// A coordinate for each freedom; empty if the model is too large.
    pub coordinates: Vec<Choice>,
    /// A rate for each freedom of the velocities; empty if the model is too large.
    pub rates: Vec<Choice>,
}

/// A candidate: its column, and the index of its body with the coordinate.
type Candidate = (usize, usize, Coordinate);

/// The coordinates and rates that a request did not set, with their values in the result. `extended` is the model
/// with the positions that are set. Empty if a state was given.
pub(super) fn unset(
    [model, extended]: [&Model; 2],
    request: &Request,
    asked: &Targets,
    [q, v]: [&[f64]; 2],
    stop: Halt<'_>,
) -> Unset {
    if request.state.is_some() || stop() {
        return Unset::default();
    }
    let held = holding_rates(model, request, q);
    if q.len() > MOST_NAMED {
        let left = |m: &Model| mobility_until(m, request.t, q, stop).degrees_of_freedom;
        return Unset { count: [left(extended), left(&held)], ..Unset::default() };
    }
    let all = |model: &Model| freedoms(model, request.t, q, |_| true).unwrap_or_default();
    let moving = all(extended);
    // a freedom of first order only, at a singular position, is not a freedom
    let regular = moving.len() == q.len().saturating_sub(extended.layout.n_rows);
    let passing = match regular {
        true => 0,
        false => mobility_until(extended, request.t, q, stop).singular_equations.len(),
    };
    let column = |of: &CoordinateTarget| (of.body.0, of.coordinate.column());
    let guesses = met_first(model, of_bodies(&request.guess).cloned().list(), q);
    let mut coordinates = named(model, &moving, guesses.iter().map(column));
    coordinates.truncate(moving.len().saturating_sub(passing));
    let guessed = |target: &Target| match target {
        Target::Coordinate(target) => Some(target.clone()),
        _ => None,
    };
    let guesses = met_first(model, of_rates(&request.guess).filter_map(guessed).list(), v);
    // otherwise the rates of the coordinates that were set or are named
    let known = coordinates.iter().map(|(_, body, coordinate)| (*body, coordinate.column()));
    let first = guesses.iter().chain(of_bodies(&request.set)).map(column).chain(known);
    // without `set`, the velocities have the same freedoms
    let free_rates = match of_motion(&request.set).next() {
        None => moving,
        Some(_) => all(&held),
    };
    let rates = named(model, &free_rates, first);
    let still = v.iter().all(|v| *v == 0.0);
    let position = |at| choice(model, at, q, source(model, request, asked, at, q));
    let rate = |(column, body, coordinate): Candidate| {
        let rate = Coordinate::ALL[coordinate.column() + 3];
        let of = guesses.iter().find(|of| of.body.0 == body && of.coordinate == rate);
        let source = match of {
            Some(of) => near(model, coordinate, of.value, v[column]),
            None if still => ValueSource::Rest,
            None => ValueSource::LeastEnergy,
        };
        choice(model, (column, body, rate), v, source)
    };
    Unset {
        count: [coordinates.len(), rates.len()],
        coordinates: coordinates.into_iter().map(position).list(),
        rates: rates.into_iter().map(rate).list(),
    }
}

/// Guesses; guesses that were met come first.
fn met_first(
    model: &Model,
    mut guesses: Vec<CoordinateTarget>,
    values: &[f64],
) -> Vec<CoordinateTarget> {
    guesses.order_by_key(|of| {
        let place = model.layout.bodies[of.body.0].first + of.coordinate.column();
        near(model, of.coordinate, of.value, values[place]) != ValueSource::Guess
    });
    guesses
}

/// A coordinate for each freedom: first coordinates in `first`, then angles, then positions.
fn named(
    model: &Model,
    freedoms: &[Vec<f64>],
    first: impl Iterator<Item = (usize, usize)>,
) -> Vec<Candidate> {
    let count = freedoms.len();
    if count == 0 {
        return Vec::new();
    }
    let bodies = 1..model.bodies.len();
    let of = |body: usize, column: usize| {
        let columns = &model.layout.bodies[body];
        let present = column < columns.count;
        present.then(|| (columns.first + column, body, Coordinate::ALL[column]))
    };
    let guessed = first.filter_map(|(body, column)| of(body, column));
    let angles = bodies.clone().filter_map(|body| of(body, 2));
    let places = bodies.flat_map(|body| [of(body, 0), of(body, 1)]).flatten();
    let candidates: Vec<Candidate> = guessed.chain(angles).chain(places).list();
    let scales = column_scales(model);
    let rows: Vec<f64> = candidates
        .iter()
        .flat_map(|(column, ..)| freedoms.iter().map(|w| w[*column] / scales[*column]))
        .list();
    let found = rank(&rows, count, RANK_TOLERANCE);
    found.independent.into_iter().map(|k| candidates[k]).list()
}

/// The source of the value of a coordinate.
fn source(
    model: &Model,
    request: &Request,
    asked: &Targets,
    (column, body, coordinate): Candidate,
    q: &[f64],
) -> ValueSource {
    let mut guesses = of_bodies(&request.guess);
    let guess = guesses.find(|of| of.body.0 == body && of.coordinate == coordinate);
    match (guess, asked.soft[body][coordinate.column()]) {
        (Some(guess), _) => near(model, coordinate, guess.value, q[column]),
        (None, Some(_)) => ValueSource::Drawing,
        (None, None) if of_quantities(&request.guess).next().is_some() => ValueSource::Guesses,
        (None, None) => ValueSource::Nothing,
    }
}

/// Compares a value with its guess.
fn near(model: &Model, coordinate: Coordinate, guess: f64, value: f64) -> ValueSource {
    match (value - guess).abs() <= EQUAL * coordinate.kind().scale(size(model)).max(value.abs()) {
        true => ValueSource::Guess,
        false => ValueSource::NearGuess(guess),
    }
}

fn choice(
    model: &Model,
    (column, body, coordinate): Candidate,
    values: &[f64],
    source: ValueSource,
) -> Choice {
    Choice {
        name: format!("{}.{}", model.bodies[body].name, coordinate.name()),
        value: values[column],
        unit: coordinate.unit(),
        source,
    }
}
