//! A mechanism at a state with its accelerations and reactions, for comparison with closed forms.

use crate::mechanisms::{column, model, start};
use kempe::analyses::State;
use kempe::equations::kinematics::Motions;
use kempe::equations::reactions::{reaction, Frame};
use kempe::equations::Workspace;
use kempe::math::{Vec2, Wrench};
use kempe::model::Model;

pub const G: f64 = 9.81;

/// A model at a state with its accelerations and multipliers.
pub struct Solved {
    pub model: Model,
    pub state: State,
    a: Vec<f64>,
    lam: Vec<f64>,
}

impl Solved {
    fn at(model: Model, state: State) -> Self {
        let mut workspace = Workspace::new(&model);
        let given = [state.q.as_slice(), &state.v, &state.z];
        workspace.react(&model, state.t, given).unwrap();
        let (a, lam) = (workspace.a().to_vec(), workspace.lam().to_vec());
        Self { model, state, a, lam }
    }

    pub fn new(text: &str, set: &[(&str, &str)], guess: &[(&str, &str)]) -> Self {
        let model = model(text);
        let (state, _) = start(&model, set, guess);
        Self::at(model, state)
    }

    /// Position, velocity and acceleration of a coordinate of a body.
    pub fn of(&self, body: &str, coordinate: usize) -> [f64; 3] {
        let k = column(&self.model, body, coordinate);
        [self.state.q[k], self.state.v[k], self.a[k]]
    }

    /// The reaction of a joint on a body, about its point.
    pub fn on(&self, joint: &str, body: &str) -> Wrench {
        let k = self.model.constraint(joint).unwrap();
        let motions = Motions::at(&self.model.layout, &self.state.q, &self.state.v);
        let lam = &self.lam[self.model.layout.constraints[k].rows.clone()];
        let on = self.model.body(body).unwrap();
        let t = self.state.t;
        reaction(&self.model, k, on, Frame::Global, &motions, t, lam).unwrap()
    }

    /// The multiplier of a row of a joint.
    pub fn lam(&self, joint: &str, row: usize) -> f64 {
        let k = self.model.constraint(joint).unwrap();
        self.lam[self.model.layout.constraints[k].rows.start + row]
    }
}

/// Asserts equality to 1e-10, relative to the larger of 1 and the expected number.
#[track_caller]
pub fn same(what: &str, is: f64, expected: f64) {
    let error = (is - expected).abs() / expected.abs().max(1.0);
    assert!(error <= 1e-10, "{what}: {is} is not {expected}: {error:.2e}");
}

#[track_caller]
pub fn same_vector(what: &str, is: Vec2, expected: Vec2) {
    same(&format!("{what}.x"), is.x, expected.x);
    same(&format!("{what}.y"), is.y, expected.y);
}

/// A vector of length 1.
pub fn direction(angle: f64) -> Vec2 {
    Vec2::new(angle.cos(), angle.sin())
}
