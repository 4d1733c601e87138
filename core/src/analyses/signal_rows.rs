//! Signals at states in rows, with accelerations and multipliers where they are known.

use super::dynamics::States;
use super::signals::{Seen, Signal};
use crate::equations::kinematics::Motions;
use crate::math::{Lanes, Listed, Real, ShortArray};
use crate::model::Model;

/// States in rows. The works up to the states have rows of three or are absent. Accelerations and multipliers have
/// rows.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub states: States<'a>,
    pub works: &'a [f64],
    pub solved: Option<[&'a [f64]; 2]>,
}

/// Passes the time and the values of all signals at each state to the caller. Without accelerations and multipliers,
/// signals that need them are NaN.
///
/// # Panics
/// If the rows do not fit the model or each other.
pub(super) fn each(
    model: &Model,
    rows: Rows<'_>,
    signals: &[Signal],
    mut give: impl FnMut(f64, &[f64]),
) {
    let (layout, Rows { states, works, solved }) = (&model.layout, rows);
    let count = states.t.len();
    let absent = [layout.n_q, model.n_multipliers()].each(|n| vec![f64::NAN; n]);
    let mut motions = Motions::new(layout);
    let mut values = vec![0.0; signals.len()];
    for (k, &t) in states.t.iter().enumerate() {
        let at = |table: &[f64]| {
            let width = table.len() / count;
            k * width..(k + 1) * width
        };
        let state = [states.q, states.v, states.z].each(|table| &table[at(table)]);
        motions.place(layout, state[0], state[1]);
        let solved = match solved {
            Some(tables) => tables.each(|table| &table[at(table)]),
            None => absent.each_ref().each(Vec::as_slice),
        };
        let works = &works[at(works)];
        let seen = Seen { t, state, works, motions: &motions, solved, so_far: None };
        for (to, signal) in values.iter_mut().zip(signals) {
            *to = signal.value(model, &seen);
        }
        give(t, &values);
    }
}

/// Passes the time and the values of all signals at each state to the caller. Evaluates four states at once over the
/// lifted model.
///
/// # Panics
/// If the rows do not fit the model or each other.
pub(super) fn each_over_lanes(
    (model, wide): (&Model, &Model<Lanes>),
    rows: Rows<'_>,
    signals: &[Signal],
    mut give: impl FnMut(f64, &[f64]),
) {
    let Rows { states, works, solved } = rows;
    let (fours, count) = (states.t.chunks_exact(Lanes::WIDTH), states.t.len().max(1));
    let left = fours.remainder();
    let tables = [states.q, states.v, states.z, works];
    let mut lanes = tables.each(|table| vec![Lanes::zero(); table.len() / count]);
    let absent = [wide.layout.n_q, wide.n_multipliers()];
    let widths = solved.map_or(absent, |tables| tables.each(|table| table.len() / count));
    let mut of_solved = widths.each(|n| vec![Lanes::constant(f64::NAN); n]);
    let mut motions = Motions::new(&wide.layout);
    let mut values = vec![0.0; signals.len()];
    for (k, t) in fours.enumerate() {
        let given = solved.iter().flatten().zip(&mut of_solved);
        for (table, lanes) in tables.iter().zip(&mut lanes).chain(given) {
            let four = Lanes::WIDTH * lanes.len();
            Lanes::from_rows(&table[k * four..(k + 1) * four], lanes);
        }
        let [q, v, z, works] = lanes.each_ref().each(Vec::as_slice);
        motions.place(&wide.layout, q, v);
        let solved = of_solved.each_ref().each(Vec::as_slice);
        let (at, state) = (Lanes::new([t[0], t[1], t[2], t[3]]), [q, v, z]);
        let seen = Seen { t: at, state, works, motions: &motions, solved, so_far: None };
        let found: Vec<_> = signals.iter().map(|one| one.value(wide, &seen).to_array()).list();
        for (lane, t) in t.iter().enumerate() {
            values.iter_mut().zip(&found).for_each(|(to, of)| *to = of[lane]);
            give(*t, &values);
        }
    }
    let last = |table| rest(table, (count, states.t.len() - left.len()));
    let [q, v, z, works] = tables.each(last);
    let states = States { t: left, q, v, z };
    each(model, Rows { states, works, solved: solved.map(|two| two.each(last)) }, signals, give);
}

/// The rows of a table from row `from` on; the table has `count` rows.
fn rest(table: &[f64], (count, from): (usize, usize)) -> &[f64] {
    &table[table.len() / count * from..]
}
