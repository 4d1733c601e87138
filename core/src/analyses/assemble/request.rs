//! The request for an assembly.

use super::named::{named, NamedTargets};
use super::target::Target;
use crate::analyses::State;
use crate::equations::at;
use crate::expression::Tape;
use crate::math::Listed;
use crate::model::{Doubt, Model, Problem, Reach, Scope, Value};

/// The request for an assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// Targets that are held exactly.
    pub set: Vec<Target>,
    /// Targets that are approached.
    pub guess: Vec<Target>,
    /// A whole state as guess.
    pub state: Option<State>,
    /// Time, s.
    pub t: f64,
    /// Whether Newton's method starts from the guess with open loops instead of a placement that closes them. This is
    /// the classical iteration, for teaching.
    pub from_guess: bool,
    /// Values of `set` and `guess` that look like degrees.
    pub doubts: Vec<Doubt>,
}

impl Request {
    /// A value of `set` as written, such as "crank.angle = 70°".
    pub(super) fn written(&self, model: &Model, quantity: &str) -> String {
        let mut all = self.set.iter().filter(|target| target.name(model) == quantity);
        all.next().map_or(quantity.to_string(), |target| target.written(model))
    }
}

/// Reads targets such as ("crank.angle", "70*deg"); `section` is `set` or `guess`.
///
/// # Errors
/// Every faulty target, with its path in a file.
pub fn targets(
    model: &Model,
    section: &str,
    written: &[(String, Value)],
) -> Result<Vec<Target>, Vec<Problem>> {
    formulas(model, section, written).map(|all| all.into_iter().map(|(target, _)| target).list())
}

/// [`targets`] with the formulas of their values.
pub(super) fn formulas(
    model: &Model,
    section: &str,
    written: &[(String, Value)],
) -> Result<Vec<(Target, Tape)>, Vec<Problem>> {
    let mut problems = Vec::new();
    let mut found = Vec::new();
    let names = NamedTargets::of(model);
    let b = &model.blueprint;
    let scope = Scope::of_parameters(&b.parameters, &b.inferred, &b.tables);
    for (key, value) in written {
        let path = ["start".to_string(), section.to_string(), key.clone()];
        let Some(named) = named(&names, key, &path, &mut problems) else { continue };
        if section == "set" && named.follows() {
            let message = format!("{key} follows the bodies and cannot be set");
            problems.push(Problem::at(&path, message).hint("give it as a guess").at_key());
            continue;
        }
        let tape = scope.formula(value, &path, &named.unit, Reach::Parameters, &mut problems);
        let Some(tape) = tape else { continue };
        let value = tape.evaluate(&at(&model.parameters, &[], &[], 0.0));
        if value.is_finite() {
            found.push((named.with(value), tape));
        } else {
            problems.push(Problem::at(&path, format!("becomes {value}; must be finite")));
        }
    }
    if problems.is_empty() {
        Ok(found)
    } else {
        Err(problems)
    }
}

/// The angles of `set` or `guess` that look like degrees, as written.
pub fn doubts(model: &Model, written: &[(String, Value)]) -> Vec<Doubt> {
    let doubted: Vec<Doubt> = written
        .iter()
        .filter_map(|(key, value)| Doubt::of(value, std::slice::from_ref(key), "rad"))
        .list();
    if doubted.is_empty() {
        return doubted;
    }
    let names = NamedTargets::of(model);
    let angle = |doubt: &Doubt| {
        let found = named(&names, &doubt.place, &[], &mut Vec::new());
        found.is_some_and(|named| named.is_angle())
    };
    doubted.into_iter().filter(angle).list()
}
