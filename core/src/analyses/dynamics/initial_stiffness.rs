//! Stiffness of a model at its initial state, before the first step.
//!
//! Two rates are compared: the rate |λ| of the fastest motion of the linearised equations, and the pace of the
//! actual motion,
//!
//! ```text
//! w = max ( |ω|, |ṙ| / L, √(|ω̇|), √(|r̈| / L) )        of all bodies, L the size of the mechanism
//! ```
//!
//! If the fastest motion is damped and |λ| is far above w, accuracy allows longer steps than stability. There are two
//! cases. If the fast motion has decayed before the start, Radau begins. If it has not, DOP853 begins, because it
//! follows the fast motion at the least cost until its steps show that the motion has decayed. The part of the fast
//! motion in the velocities is estimated as |q⃛| / |λ|². The fast motion has not decayed if this part is above the
//! tolerance.

use super::methods::Auto;
use super::stiffness_detection::{Fastest, StiffnessDetector, LIMIT, TO_GO};
use crate::integrate::Atol;
use crate::math::each;
use crate::model::{size, Model};

/// Ratio |λ| / w from which a model counts as stiff: a factor of six between the step at the stability limit and the
/// step that accuracy allows, times five for the lower order of Radau.
const FAR: f64 = 30.0;
/// Time step of the difference quotient of accelerations, as a fraction of 1/|λ|.
const PROBE: f64 = 1e-3;

/// Stiffness at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InitialStiffness {
    /// None where the equations are singular.
    fastest: Option<Fastest>,
    /// w, 1/s.
    pace: f64,
    /// Number of steps that DOP853 needs to the end at the limit of stability. Not positive backward in time, where
    /// damped motions grow.
    steps: f64,
    /// Whether the fast motion has not decayed.
    under_way: bool,
}

impl InitialStiffness {
    pub fn new(
        model: &Model,
        detector: &mut StiffnessDetector<'_>,
        auto: &Auto,
        (t, t_end): (f64, f64),
        y: &[f64],
    ) -> Self {
        let Some(fastest) = detector.fastest(t, y) else { return Self::unknown() };
        let v = model.layout.split(y)[1];
        let probe = PROBE / fastest.rate;
        let rates = detector.rates(t, y, probe);
        let pace = rates.as_ref().map_or(f64::INFINITY, |[a, _]| pace(model, v, a));
        let left = |jerk: &[f64]| excited(auto, jerk, v, fastest.rate);
        Self {
            fastest: Some(fastest),
            pace,
            steps: (t_end - t) * fastest.rate / LIMIT,
            under_way: rates.as_ref().is_none_or(|[_, jerk]| left(jerk)),
        }
    }

    /// The stiffness of a start that is not examined, or where the equations are singular.
    pub fn unknown() -> Self {
        Self { fastest: None, pace: 0.0, steps: 0.0, under_way: false }
    }

    /// The fastest motion if it makes the model stiff.
    pub fn stiff(&self) -> Option<Fastest> {
        let far = |fastest: &Fastest| fastest.damped && fastest.rate > FAR * self.pace;
        self.fastest.filter(|fastest| far(fastest) && self.steps > TO_GO)
    }

    /// Whether the run begins with Radau.
    pub fn implicit(&self) -> bool {
        self.stiff().is_some() && !self.under_way
    }

    /// Explains why the run begins with Radau.
    pub fn why_implicit(&self) -> String {
        format!(
            "stiff from the start: a damped motion with a rate of {:.2e} 1/s would need {:.0} steps of dop853, but \
            the bodies move with a rate of {:.1e} 1/s",
            self.fastest.map_or(0.0, |fastest| fastest.rate),
            self.steps.ceil(),
            self.pace
        )
    }

    /// Explains why the run begins with DOP853.
    pub fn why_explicit(&self) -> String {
        let Some(Fastest { rate, damped }) = self.fastest else {
            return "not stiff: the run ended before the first check".to_string();
        };
        format!(
            "not stiff: at the start the fastest motion is {} and has a rate of {rate:.2e} 1/s; the bodies move with a \
            rate of {:.1e} 1/s",
            if damped { "damped" } else { "undamped" },
            self.pace
        )
    }
}

/// w, 1/s.
fn pace(model: &Model, v: &[f64], a: &[f64]) -> f64 {
    let size = size(model);
    let bodies = model.layout.bodies.iter().map(|columns| (columns.of(v), columns.of(a)));
    bodies.fold(0.0, |most: f64, (v, a): ([f64; 3], [f64; 3])| {
        let rates = [v[2].abs(), v[0].hypot(v[1]) / size];
        let roots = each([a[2].abs(), a[0].hypot(a[1]) / size], f64::sqrt);
        rates.into_iter().chain(roots).fold(most, f64::max)
    })
}

/// Whether the part of a motion with this rate in the velocities exceeds the tolerance.
fn excited(auto: &Auto, jerk: &[f64], v: &[f64], rate: f64) -> bool {
    let n = v.len();
    let atol = |k: usize| match &auto.control.atol {
        Atol::Scalar(atol) | Atol::Scaled(atol) => *atol,
        Atol::Each(each) => each.get(n + k).copied().unwrap_or(0.0),
    };
    let parts = jerk.iter().map(|jerk| jerk.abs() / (rate * rate));
    parts.zip(v).enumerate().any(|(k, (part, v))| part > atol(k) + auto.control.rtol * v.abs())
}
