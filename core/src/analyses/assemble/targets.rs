//! Targets for coordinates before assembly: `set` (held exactly) and `guess` (approached).

use crate::elements::{BodyId, Constraint, Coordinate, CoordinateOf, Fixes};
use crate::math::ShortArray;
use crate::model::{ConstraintItem, Dependence, Model};

/// Target values, by body (ground first) and coordinate x, y, angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Targets {
    /// Time of the assembly, s.
    pub t: f64,
    /// Targets held exactly: by `set` or by a driver.
    pub hard: Vec<[Option<f64>; 3]>,
    /// Targets approached: from `guess`, a given state, or the drawn position of the body.
    pub soft: Vec<[Option<f64>; 3]>,
    /// Whether the soft angle determines the whole turn.
    pub turn: Vec<bool>,
    /// Whether all solutions of equations become numbered choices if no soft target decides. Otherwise hard targets
    /// also decide, and wheels mesh at the angle nearest to zero.
    pub every_solution: bool,
}

impl Targets {
    /// The targets without a request: drivers at time `t` are hard, drawn poses are soft.
    pub fn of(model: &Model, t: f64) -> Self {
        let n = model.bodies.len();
        let none = || vec![[None; 3]; n];
        let turn = vec![false; n];
        let mut targets = Self { t, hard: none(), soft: none(), turn, every_solution: false };
        for (k, body) in model.bodies.iter().enumerate() {
            if let Some(drawn) = body.drawn {
                targets.soft[k] = drawn.each(Some);
            }
            if !body.turns {
                targets.hard[k][2] = Some(0.0);
            }
        }
        for item in &model.constraints {
            if let Some((body, coordinate, value)) = driven(model, item, t) {
                targets.hard[body.0][coordinate.column()] = Some(value);
            }
        }
        targets
    }

    /// Sets soft targets to the positions `q`, shape (n_q).
    pub fn approach(&mut self, model: &Model, q: &[f64]) {
        for (soft, columns) in self.soft.iter_mut().zip(&model.layout.bodies).skip(1) {
            *soft = columns.of(q).each(Some);
        }
    }

    /// The target of a coordinate; the hard target if there is one, otherwise the soft target.
    pub fn value(&self, body: usize, column: usize) -> Option<f64> {
        self.hard[body][column].or(self.soft[body][column])
    }

    /// The targets of all three coordinates of a body. None if one is missing.
    pub fn pose(&self, body: usize) -> Option<[f64; 3]> {
        Some([self.value(body, 0)?, self.value(body, 1)?, self.value(body, 2)?])
    }

    /// The angle, shifted by whole turns, that is nearest to the soft angle, or to zero.
    pub fn nearest_turn(&self, body: usize, angle: f64) -> f64 {
        nearest_turn(angle, self.soft[body][2].unwrap_or(0.0))
    }
}

/// `angle` shifted by whole turns to the value nearest to `to`.
pub fn nearest_turn(angle: f64, to: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * ((angle - to) / turn).round()
}

/// The value that a coordinate driver prescribes at `t`, if it depends only on time.
fn driven(model: &Model, item: &ConstraintItem, t: f64) -> Option<(BodyId, Coordinate, f64)> {
    at_time(model, item, t)?.fixes().into_iter().find_map(|fixed| match fixed {
        Fixes::Coordinate(CoordinateOf { body, coordinate }, value) if value.is_finite() => {
            Some((body, coordinate, value))
        }
        _ => None,
    })
}

/// A constraint with the values of its laws at `t`. None if the laws depend on positions.
pub(super) fn at_time(model: &Model, item: &ConstraintItem, t: f64) -> Option<Constraint> {
    let Some(law) = &item.law else { return Some(item.element.clone()) };
    let mut depends = Dependence::default();
    law.visit(&mut |tape| depends.add(tape));
    let values = crate::equations::at(&model.parameters, &[], &[], t);
    depends.bodies.is_empty().then(|| law.map(&mut |tape| tape.evaluate(&values)))
}
