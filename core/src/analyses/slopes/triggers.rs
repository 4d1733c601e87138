//! The functions whose zeros determine when a motion changes: conditions, modes of forces, and switches.

use crate::analyses::dynamics::{
    planned, watched_mode, Effect, HeldPieces, ModeFunction, Options, Passage, Struck,
};
use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::equations::sensitivity::Slope;
use crate::equations::switches;
use crate::math::{Listed, Real};
use crate::model::Model;

/// Part of a derivative by which two derivatives of one time may differ.
const TOGETHER: f64 = 1e-9;
/// Part of the largest effect of a variable on a time below which an effect counts as a rounding error.
const ROUNDED: f64 = 1e-12;

/// The place of the event of a hit among the events of a contact.
const HIT: usize = 0;

/// A function whose zero determines a time.
#[derive(Clone)]
pub(super) struct Trigger {
    /// What changes there, for messages.
    pub name: String,
    function: Function,
}

#[derive(Clone)]
enum Function {
    /// The function of a condition.
    Condition(Measure),
    /// The function of a force with modes.
    Mode(ModeFunction),
    /// The function of a switch, up to a constant.
    Switch(usize),
}

impl Trigger {
    /// The triggers of the events that ended a phase of a model. A contact that hits at the same time as another one has
    /// its own trigger, although the event of the other one ended the phase.
    ///
    /// # Errors
    /// The reason why their times have no derivatives.
    pub fn of_passage(
        (base, phase): (&Model, &Model),
        options: &Options,
        passage: &Passage,
    ) -> Result<Vec<Self>, String> {
        let (events, mut fired) = (planned(base, options), passage.fired.clone());
        let was_open = |one: &&Struck| !phase.forces[one.force].mode.holds();
        for one in passage.impacts.iter().flatten().filter(was_open) {
            let hit = Effect::Mode { force: one.force, place: HIT };
            let own = events.iter().position(|event| event.effect == hit);
            fired.extend(own.filter(|own| !fired.contains(own)));
        }
        let of = |index: &usize| {
            let event = events.get(*index).ok_or("an event is not known")?;
            let name = event.name.clone();
            if let Effect::Mode { force, place } = event.effect {
                let (function, _) = watched_mode(phase, force, place);
                return match function.is_held() {
                    true => Err(format!("{name} is in a joint that drivers hold")),
                    false => Ok(Self { name, function: Function::Mode(function) }),
                };
            }
            let read = Measure::of_condition(base, &event.condition);
            let read = read.map_err(|_| format!("the condition of {name} is not read"))?;
            Ok(Self { name, function: Function::Condition(read.in_phase(phase)) })
        };
        fired.iter().map(of).collect()
    }

    /// The triggers of switches that change.
    pub fn of_switches(model: &Model, held: &HeldPieces) -> Vec<Self> {
        let of = |k: &usize| {
            let name = format!("the switch of {}", model.owner_name(model.switches[*k].owner));
            Self { name, function: Function::Switch(*k) }
        };
        held.causes.iter().map(of).list()
    }

    /// Whether a switch changes.
    pub fn is_switch(&self) -> bool {
        matches!(self.function, Function::Switch(_))
    }

    /// Whether the function needs accelerations or multipliers.
    pub fn needs_solution(&self, model: &Model) -> bool {
        match &self.function {
            Function::Condition(measure) => measure.needs_solution(model),
            Function::Mode(_) | Function::Switch(_) => true,
        }
    }

    pub fn value(&self, model: &Model<Slope>, seen: &Seen<'_, Slope>) -> Slope {
        match &self.function {
            Function::Condition(measure) => measure.value_at(model, seen),
            Function::Mode(function) => function.while_moving(model, seen),
            Function::Switch(k) => {
                let mut sigma = vec![Slope::constant(f64::NAN); model.switches.len()];
                switches::functions(model, seen.motions, seen.acting(), &mut sigma);
                sigma[*k]
            }
        }
    }
}

/// The derivatives of a time at which one thing or more change, by variables with some magnitudes.
///
/// # Errors
/// The changes do not stay together.
pub(super) fn agreed(
    t: f64,
    times: &[(&str, Vec<f64>)],
    sizes: &[f64],
) -> Result<Vec<f64>, String> {
    let (name, late) = &times[0];
    let effects = |of: &[f64]| {
        of.iter().zip(sizes).fold(0.0_f64, |most, (x, size)| most.max((x * size).abs()))
    };
    for (other, own) in &times[1..] {
        let floor = ROUNDED * effects(late).max(effects(own));
        let differ = |((a, b), size): ((&f64, &f64), &f64)| {
            let most = (TOGETHER * a.abs().max(b.abs())).max(floor / size);
            (a - b).abs() > most || (a - b).is_nan()
        };
        if late.iter().zip(own).zip(sizes).any(differ) {
            return Err(format!(
                "{name} and {other} happen together at t = {t:.6} s, and their order may change"
            ));
        }
    }
    Ok(late.clone())
}
