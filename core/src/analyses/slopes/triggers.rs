//! The functions whose zeros determine when a motion changes: conditions, modes of forces, and switches.

use crate::analyses::dynamics::{planned, watched_mode, Effect, HeldPieces, ModeFunction, Options};
use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::equations::sensitivity::Slope;
use crate::equations::switches;
use crate::math::{Listed, Real};
use crate::model::Model;

/// A function whose zero determines a time.
#[derive(Clone)]
pub(super) enum Trigger {
    /// The function of a condition.
    Condition(Measure),
    /// The function of a force with modes.
    Mode(ModeFunction),
    /// The function of a switch, up to a constant.
    Switch(usize),
}

impl Trigger {
    /// The triggers of the events that ended a phase of a model.
    ///
    /// # Errors
    /// The reason why their times have no derivatives.
    pub fn of_events(
        (base, phase): (&Model, &Model),
        options: &Options,
        fired: &[usize],
    ) -> Result<Vec<Self>, String> {
        let events = planned(base, options);
        let of = |index: &usize| {
            let event = events.get(*index).ok_or("an event is not known")?;
            if let Effect::Mode { force, place } = event.effect {
                let (function, _) = watched_mode(phase, force, place);
                return match function.is_held() {
                    true => Err(format!("{} is in a joint that drivers hold", event.name)),
                    false => Ok(Self::Mode(function)),
                };
            }
            let read = Measure::of_condition(base, &event.condition);
            let read = read.map_err(|_| format!("the condition of {} is not read", event.name))?;
            Ok(Self::Condition(read.in_phase(phase)))
        };
        fired.iter().map(of).collect()
    }

    /// The triggers of switches that change.
    pub fn of_switches(held: &HeldPieces) -> Vec<Self> {
        held.causes.iter().map(|k| Self::Switch(*k)).list()
    }

    /// Whether the function needs accelerations or multipliers.
    pub fn needs_solution(&self, model: &Model) -> bool {
        match self {
            Self::Condition(measure) => measure.needs_solution(model),
            Self::Mode(_) | Self::Switch(_) => true,
        }
    }

    pub fn value(&self, model: &Model<Slope>, seen: &Seen<'_, Slope>) -> Slope {
        match self {
            Self::Condition(measure) => measure.value_at(model, seen),
            Self::Mode(function) => function.while_moving(model, seen),
            Self::Switch(k) => {
                let mut sigma = vec![Slope::constant(f64::NAN); model.switches.len()];
                switches::functions(model, seen.motions, seen.acting(), &mut sigma);
                sigma[*k]
            }
        }
    }
}
