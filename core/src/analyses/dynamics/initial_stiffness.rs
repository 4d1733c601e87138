//! What the model says of its stiffness before the first step.
//!
//! At the start stand side by side the rate |λ| of the fastest motion of the linearised equations and the
//! pace of what moves,
//!
//! ```text
//! w = max ( |ω|, |ṙ| / L, √(|ω̇|), √(|r̈| / L) )        of all bodies, L the size of the mechanism
//! ```
//!
//! Where |λ| is damped and far above w, accuracy allows steps that stability forbids. Then the fast
//! motion is either under way, and DOP853 follows it at least cost until it has died out, which it tells by
//! its steps; or it has died out before the start, and Radau begins. It is under way where its part in the
//! velocities, |v⃛| / |λ|² after the third derivative of q along the motion, is above the tolerance.

use super::methods::Auto;
use super::stiffness_detection::{Fastest, StiffnessDetector, LIMIT, TO_GO};
use crate::integrate::Atol;
use crate::model::{size, Model};

/// |λ| / w from which a model is taken for stiff: six times what separates stability from accuracy, and
/// five for the lower order of Radau.
const FAR: f64 = 30.0;
/// Part of 1/|λ| over which the accelerations are differenced.
const PROBE: f64 = 1e-3;

/// The judgement at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InitialStiffness {
    /// None where the equations are singular.
    fastest: Option<Fastest>,
    /// w, 1/s.
    pace: f64,
    /// Steps of DOP853 at the limit of stability to the end; not positive backward in time, when what is
    /// damped grows.
    steps: f64,
    /// Whether the fast motion is under way.
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
        let Some(fastest) = detector.fastest(t, y) else {
            return Self { fastest: None, pace: 0.0, steps: 0.0, under_way: false };
        };
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

    /// The fastest motion, if it makes the model stiff.
    pub fn stiff(&self) -> Option<Fastest> {
        let far = |fastest: &Fastest| fastest.damped && fastest.rate > FAR * self.pace;
        self.fastest.filter(|fastest| far(fastest) && self.steps > TO_GO)
    }

    /// Whether Radau is to begin.
    pub fn implicit(&self) -> bool {
        self.stiff().is_some() && !self.under_way
    }

    /// Why Radau begins, in words.
    pub fn why_implicit(&self) -> String {
        format!(
            "stiff: radau from the start, since a damped motion with a rate of {:.2e} 1/s would hold dop853 to \
             {:.0} steps, while what moves has a rate of {:.1e} 1/s",
            self.fastest.map_or(0.0, |fastest| fastest.rate),
            self.steps.ceil(),
            self.pace
        )
    }

    /// Why DOP853 begins, in words.
    pub fn why_explicit(&self) -> String {
        let Some(Fastest { rate, damped }) = self.fastest else {
            return "not stiff: done before its steps were worth a look".to_string();
        };
        format!(
            "not stiff: at the start the fastest motion is {} and has a rate of {rate:.2e} 1/s, what moves {:.1e} 1/s",
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
        let roots = [a[2].abs(), a[0].hypot(a[1]) / size].map(f64::sqrt);
        rates.into_iter().chain(roots).fold(most, f64::max)
    })
}

/// Whether a motion of this rate has a part in the velocities that the tolerance sees.
fn excited(auto: &Auto, jerk: &[f64], v: &[f64], rate: f64) -> bool {
    let n = v.len();
    let atol = |k: usize| match &auto.control.atol {
        Atol::Scalar(atol) => *atol,
        Atol::Each(each) => each.get(n + k).copied().unwrap_or(0.0),
    };
    let parts = jerk.iter().map(|jerk| jerk.abs() / (rate * rate));
    parts.zip(v).enumerate().any(|(k, (part, v))| part > atol(k) + auto.control.rtol * v.abs())
}
