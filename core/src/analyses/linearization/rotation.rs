//! A frame that rotates with the mechanism. All bodies rotate about one point of ground with the constant rate Ω.
//!
//! In this frame the mechanism is at rest, and small motions δu have constant coefficients. With J, which turns the
//! positions of bodies by +90° and has zeros for angles, the changes of the inertial coordinates are
//!
//! ```text
//! δq = N δu,   δv = N δu̇ + Ω J N δu,   δa = N δü + 2 Ω J N δu̇ - Ω² J ᵀJ N δu
//! ```

use super::failure::Failure;
use crate::analyses::State;
use crate::math::Listed;
use crate::model::{size, Model};

/// Largest deviation from a uniform rotation, relative to Ω and Ω² times the size of the mechanism.
const UNIFORM: f64 = 1e-6;

/// A uniform rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RotatingFrame {
    /// Ω, rad/s.
    rate: f64,
}

impl RotatingFrame {
    /// The rotation of a mechanism at a state with the accelerations `a`.
    ///
    /// # Errors
    /// [`Failure::Rotation`] if the mechanism does not rotate uniformly, or if there is gravity.
    pub fn of(model: &Model, state: &State, a: &[f64]) -> Result<Self, Failure> {
        let fails = |message: String| Failure::Rotation { t: state.t, message };
        if model.gravity.norm() > 0.0 {
            let message = "gravity changes its direction in a frame that rotates".to_string();
            return Err(fails(message));
        }
        let columns = &model.layout.bodies[1..];
        let rates = columns.iter().filter(|of| of.count == 3).map(|of| state.v[of.first + 2]);
        let rate = rates.fold(0.0, |most: f64, x| if x.abs() > most.abs() { x } else { most });
        if rate == 0.0 {
            return Err(fails("no body rotates".to_string()));
        }
        let centre = |of: &crate::model::Columns| {
            let [x, y] = [0, 1].map(|k| state.q[of.first + k]);
            let [vx, vy] = [0, 1].map(|k| state.v[of.first + k]);
            [x - vy / rate, y + vx / rate]
        };
        let about = centre(&columns[0]);
        let unit = UNIFORM * size(model);
        for (of, body) in columns.iter().zip(&model.bodies[1..]) {
            let own = centre(of);
            let from = [0, 1].map(|k| state.q[of.first + k] - about[k]);
            let moves = (0..2).any(|k| (own[k] - about[k]).abs() > unit);
            let turns =
                of.count == 3 && (state.v[of.first + 2] - rate).abs() > UNIFORM * rate.abs();
            let bends = (0..2).any(|k| (a[of.first + k] / rate / rate + from[k]).abs() > unit);
            let twists = of.count == 3 && a[of.first + 2].abs() > UNIFORM * rate * rate;
            if moves || turns || bends || twists {
                let how = if moves || turns { "moves" } else { "accelerates" };
                return Err(fails(format!("{} {how} in it", body.name)));
            }
        }
        Ok(Self { rate })
    }

    /// Ω J x.
    pub fn turned(self, model: &Model, x: &[f64]) -> Vec<f64> {
        let mut turned = vec![0.0; x.len()];
        for of in &model.layout.bodies[1..] {
            (turned[of.first], turned[of.first + 1]) =
                (-self.rate * x[of.first + 1], self.rate * x[of.first]);
        }
        turned
    }

    /// The part of δü that belongs to the frame: Ω² JᵀJ x for a change x of the position, and -2 Ω J x for one of the
    /// velocity.
    pub fn of_frame(self, model: &Model, position: &[f64], velocity: &[f64]) -> Vec<f64> {
        let twice = self.turned(model, &self.turned(model, position));
        let once = self.turned(model, velocity);
        twice.iter().zip(once).map(|(position, velocity)| -position - 2.0 * velocity).list()
    }
}
