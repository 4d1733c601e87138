//! The report of an assembly as JSON.

use super::report::Report;
use super::unset::{Choice, ValueSource};
use crate::math::Listed;
use serde_json::{json, Value};

impl Report {
    /// The report as JSON, for other languages.
    pub fn as_json(&self) -> Value {
        let iterations = self.iterations.iter().map(
            |r| json!({ "residual": r.residual_norm, "step": r.step_norm, "damping": r.damping }),
        );
        let modes = self.modes.iter().map(|m| {
            let side = match (m.slides, m.left) {
                (false, true) => "left",
                (false, false) => "right",
                (true, true) => "ahead",
                (true, false) => "behind",
            };
            json!({
                "bodies": m.bodies, "joint": m.joint, "anchors": m.anchors, "side": side,
                "folded": m.folded
            })
        });
        json!({
            "iterations": iterations.list(),
            "degrees_of_freedom": self.degrees_of_freedom,
            "modes": modes.list(),
            "warnings": self.warnings,
            "unset": {
                "count": self.unset.count,
                "coordinates": self.unset.coordinates.iter().map(choice).list(),
                "rates": self.unset.rates.iter().map(choice).list(),
            },
        })
    }
}

/// A coordinate or rate that was not set.
fn choice(of: &Choice) -> Value {
    let (source, guess) = match of.source {
        ValueSource::Guess => ("guess", None),
        ValueSource::NearGuess(guess) => ("near guess", Some(guess)),
        ValueSource::Guesses => ("guesses", None),
        ValueSource::Drawing => ("drawing", None),
        ValueSource::Nothing => ("nothing", None),
        ValueSource::Rest => ("rest", None),
        ValueSource::LeastEnergy => ("least energy", None),
    };
    json!({ "name": of.name, "value": of.value, "unit": of.unit, "source": source, "guess": guess })
}
