//! What is asked of the coordinates before assembly: `set` (held exactly) and `guess` (approached).

use crate::elements::{BodyId, Constraint, Coordinate};
use crate::model::{Dependence, Model};

/// Values asked for, by body (ground first) and coordinate x, y, angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Wishes {
    /// Held exactly: by `set` or by a driver.
    pub hard: Vec<[Option<f64>; 3]>,
    /// Approached: by `guess`, a given state, or where the body was drawn.
    pub soft: Vec<[Option<f64>; 3]>,
    /// Whether the soft angle says which whole turn is meant.
    pub turn: Vec<bool>,
}

impl Wishes {
    /// Drivers at time `t` are hard, drawn poses are soft.
    pub fn of(model: &Model, t: f64) -> Self {
        let n = model.bodies.len();
        let mut wishes =
            Self { hard: vec![[None; 3]; n], soft: vec![[None; 3]; n], turn: vec![false; n] };
        for (k, body) in model.bodies.iter().enumerate() {
            if let Some(drawn) = body.drawn {
                wishes.soft[k] = drawn.map(Some);
            }
        }
        for item in &model.constraints {
            if let Some((body, coordinate, value)) = driven(model, item, t) {
                wishes.hard[body.0][coordinate.column()] = Some(value);
            }
        }
        wishes
    }

    /// The value asked for a coordinate, hard before soft.
    pub fn value(&self, body: usize, column: usize) -> Option<f64> {
        self.hard[body][column].or(self.soft[body][column])
    }

    /// All three values of a body, if all are asked for.
    pub fn pose(&self, body: usize) -> Option<[f64; 3]> {
        Some([self.value(body, 0)?, self.value(body, 1)?, self.value(body, 2)?])
    }

    /// The angle nearest to the soft one (or to zero) that differs by whole turns.
    pub fn nearest_turn(&self, body: usize, angle: f64) -> f64 {
        nearest_turn(angle, self.soft[body][2].unwrap_or(0.0))
    }
}

/// `angle` plus whole turns, as near to `to` as can be.
pub fn nearest_turn(angle: f64, to: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * ((angle - to) / turn).round()
}

/// The value a coordinate driver prescribes at `t`, if that depends on time alone.
fn driven(
    model: &Model,
    item: &crate::model::ConstraintItem,
    t: f64,
) -> Option<(BodyId, Coordinate, f64)> {
    let element = match &item.law {
        None => item.element.clone(),
        Some(law) => {
            let mut depends = Dependence::default();
            law.map(&mut |tape| depends.add(tape));
            if !depends.bodies.is_empty() {
                return None;
            }
            let motions = [];
            let values = crate::equations::at(&model.parameters, &motions, t);
            law.map(&mut |tape| tape.evaluate(&values))
        }
    };
    match element {
        Constraint::CoordinateDriver(e) if e.value.is_finite() => {
            Some((e.coordinate.body, e.coordinate.coordinate, e.value))
        }
        _ => None,
    }
}
