//! Named results of a run: coordinates and rates of bodies, reactions of joints.

use super::dynamics::{Failure, Run};
use crate::elements::Coordinate;
use crate::equations::actions::reaction;
use crate::equations::forces::Acting;
use crate::equations::kinematics::Motions;
use crate::equations::reactions::Frame;
use crate::math::{each, Listed, Wrench};
use crate::model::Model;
use std::fmt;

/// The reason that a result is not available.
#[derive(Clone, Debug, PartialEq)]
pub enum NoResult {
    /// The model has no item with this name, or the body does not belong to the joint.
    Unknown(String),
    /// Accelerations and multipliers cannot be computed at a reported state.
    Unsolved(Box<Failure>),
}

impl fmt::Display for NoResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(message) => write!(f, "{message}"),
            Self::Unsolved(failure) => write!(f, "{failure}"),
        }
    }
}

impl std::error::Error for NoResult {}

impl Run {
    /// A coordinate or rate at the reported times, such as `rocker.angle` or `crank.omega`: m, rad, m/s
    /// or rad/s.
    ///
    /// # Errors
    /// [`NoResult::Unknown`] if the model has no such moving body, or the body has no such coordinate.
    pub fn coordinate(&self, model: &Model, name: &str) -> Result<Vec<f64>, NoResult> {
        let (body, coordinate) = name
            .rsplit_once('.')
            .and_then(|(body, coordinate)| {
                let body = model.body(body).filter(|body| !body.is_ground())?;
                Some((body, Coordinate::named(coordinate)?))
            })
            .ok_or_else(|| {
                let form = "a moving body and one of x, y, angle, vx, vy, omega";
                NoResult::Unknown(format!("'{name}' does not name {form}, such as crank.angle"))
            })?;
        let table = if coordinate.is_rate() { &self.trajectory.v } else { &self.trajectory.q };
        let rows = table.chunks_exact(model.layout.n_q.max(1));
        let columns = model.layout.bodies[body.0];
        Ok(rows.map(|row| columns.of(row)[coordinate.column()]).list())
    }

    /// Force, and torque about the joint point, of a joint or driver on a body at the reported times.
    ///
    /// The multipliers are the multipliers of the equations without stabilization.
    ///
    /// # Errors
    /// [`NoResult`] if a name is unknown, or if multipliers cannot be computed.
    pub fn reactions(
        &self,
        model: &Model,
        joint: &str,
        on: &str,
        frame: Frame,
    ) -> Result<Vec<Wrench>, NoResult> {
        let k = model
            .constraint(joint)
            .ok_or_else(|| NoResult::Unknown(format!("there is no joint or driver '{joint}'")))?;
        let apart = || NoResult::Unknown(format!("'{on}' is not a body of '{joint}'"));
        let body = model.body(on).ok_or_else(apart)?;
        let lam = self.accelerations(model).map_err(NoResult::Unsolved)?.lam;
        let (n, n_z, n_lam) = (model.layout.n_q, model.layout.n_z, model.n_multipliers());
        let mut motions = Motions::new(&model.layout);
        let at = |(state, &t): (usize, &f64)| {
            let coordinates = state * n..(state + 1) * n;
            let [q, v] =
                each([&self.trajectory.q, &self.trajectory.v], |x| &x[coordinates.clone()]);
            motions.place(&model.layout, q, v);
            let z = &self.trajectory.z[state * n_z..(state + 1) * n_z];
            let lam = Some(&lam[state * n_lam..(state + 1) * n_lam]);
            reaction(model, k, body, frame, &motions, Acting { z, lam, t }).ok_or_else(apart)
        };
        self.trajectory.t.iter().enumerate().map(at).collect()
    }
}
