//! Signals at states in rows, with accelerations and multipliers where they are known.

use super::dynamics::States;
use super::signals::{Seen, Signal};
use crate::equations::kinematics::Motions;
use crate::model::Model;

/// States with the works up to them, rows of three or none, and with rows of accelerations and multipliers.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub states: States<'a>,
    pub works: &'a [f64],
    pub solved: Option<[&'a [f64]; 2]>,
}

/// Gives the time and the values of all signals at each state. What needs accelerations or multipliers is not a number
/// without them.
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
    let absent = [layout.n_q, model.n_multipliers()].map(|n| vec![f64::NAN; n]);
    let mut motions = Motions::new(layout);
    let mut values = vec![0.0; signals.len()];
    for (k, &t) in states.t.iter().enumerate() {
        let at = |table: &[f64]| {
            let width = table.len() / count;
            k * width..(k + 1) * width
        };
        let state = [states.q, states.v, states.z].map(|table| &table[at(table)]);
        motions.place(layout, state[0], state[1]);
        let solved = match solved {
            Some(tables) => tables.map(|table| &table[at(table)]),
            None => absent.each_ref().map(Vec::as_slice),
        };
        let works = &works[at(works)];
        let seen = Seen { t, state, works, motions: &motions, solved, so_far: None };
        for (to, signal) in values.iter_mut().zip(signals) {
            *to = signal.value(model, &seen);
        }
        give(t, &values);
    }
}
