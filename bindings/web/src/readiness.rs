//! Obstacles to each analysis of a state or motion: the checks with which the core begins it, at the start of the
//! case.

use crate::fault::problem;
use crate::loaded::Loaded;
use kempe::analyses::dynamics::{Prepared, Reason as NoMotion};
use kempe::analyses::equilibrium::{self, Reason as NoRest};
use kempe::analyses::kinematics::{kinematics, recorded, Reason as NotDriven};
use kempe::analyses::linearization::{self, Failure as NotLinear};
use kempe::model::{Definition, Entry};
use kempe::{assemble, Flow, Model, Options, Problem, State};
use serde_json::{json, Value};
use std::sync::Arc;

/// The obstacle to each analysis, or null. If the mechanism does not close, no other analysis can begin.
pub fn readiness(loaded: &Loaded) -> Value {
    let (model, definition) = (&loaded.model, &loaded.case.definition);
    let state = match start(loaded) {
        Ok(state) => state,
        Err(found) => return json!([stated("assembly", Some(found))]),
    };
    let found = Obstacles { definition, model, state: &state };
    let driven = found.of_kinematics();
    json!([
        stated("assembly", None),
        stated("dynamics", found.of_dynamics()),
        stated("kinematics", driven.clone()),
        stated("inverse_dynamics", driven.or_else(|| found.of_reactions())),
        stated("equilibrium", found.of_equilibrium()),
        stated("modes", found.of_modes()),
    ])
}

fn stated(analysis: &str, found: Option<Problem>) -> Value {
    json!({ "analysis": analysis, "problem": found.as_ref().map(problem) })
}

/// The start of the case.
fn start(loaded: &Loaded) -> Result<State, Problem> {
    let first = |found: Vec<Problem>| found.into_iter().next();
    let request = match loaded.case.start.request(&loaded.model) {
        Ok(request) => request,
        Err(found) => return Err(first(found.0).expect("a fault")),
    };
    let found = assemble(&loaded.model, &request);
    found.map(|(state, _)| state).map_err(|failure| {
        let own = failure.places.first().cloned();
        let path = own.unwrap_or_else(|| place(&loaded.case.definition, &failure.name));
        problem_at(&path, &failure.message, &failure.hint)
    })
}

fn problem_at(path: &[String], message: &str, hint: &str) -> Problem {
    let hint = Some(hint.to_string()).filter(|hint| !hint.is_empty());
    Problem::at(path, message).maybe_hint(hint)
}

/// The path of an element in a file. For a coordinate such as `crank.angle`, the path of its body.
fn place(definition: &Definition, name: &str) -> Vec<String> {
    let name = name.split('.').next().unwrap_or_default();
    let Definition { bodies, joints, drivers, forces, .. } = definition;
    let sections =
        [("bodies", bodies), ("joints", joints), ("drivers", drivers), ("forces", forces)];
    let has = |(_, entries): &(&str, &Vec<Entry>)| entries.iter().any(|entry| entry.name == name);
    let section = sections.into_iter().find(has);
    section.map_or(Vec::new(), |(section, _)| vec![section.to_string(), name.to_string()])
}

struct Obstacles<'a> {
    definition: &'a Definition,
    model: &'a Arc<Model>,
    state: &'a State,
}

impl Obstacles<'_> {
    fn at(&self, name: &str, message: String, hint: &str) -> Option<Problem> {
        Some(problem_at(&place(self.definition, name), &message, hint))
    }

    fn of_dynamics(&self) -> Option<Problem> {
        let options = Options::new(self.state.t + 1.0);
        let run =
            Prepared::new(Arc::clone(self.model)).dynamics(self.state, &options, |_| Flow::Stop);
        self.of_motion(run.err()?.reason)
    }

    fn of_motion(&self, reason: NoMotion) -> Option<Problem> {
        match reason {
            NoMotion::Singular { name, message, .. } => self.at(&name, message, ""),
            NoMotion::Start { name, message, hint, .. }
            | NoMotion::Redundant { name, message, hint, .. }
            | NoMotion::Law { name, message, hint, .. } => self.at(&name, message, hint),
            NoMotion::Integration { message, hint, .. } => self.at("", message, hint),
            NoMotion::Option { message, .. } => self.at("", message, ""),
        }
    }

    fn of_kinematics(&self) -> Option<Problem> {
        let motion = kinematics(self.model, self.state, &[self.state.t], |_| Flow::Continue);
        let reason = motion.err()?.reason;
        let message = reason.to_string();
        match &reason {
            NotDriven::Free { .. } => Some(Problem::at(&["drivers"], message)),
            NotDriven::Open { name, .. }
            | NotDriven::Beyond { name, .. }
            | NotDriven::Singular { name, .. } => self.at(name, message, ""),
            NotDriven::Limit(limit) => self.at(&limit.driver, message, ""),
        }
    }

    /// The problem that reactions of the motion at the start are not unique.
    fn of_reactions(&self) -> Option<Problem> {
        let motion =
            kinematics(self.model, self.state, &[self.state.t], |_| Flow::Continue).ok()?;
        let trajectory = recorded(self.model, self.state, &motion, false).trajectory;
        let found = Prepared::new(Arc::clone(self.model));
        let found = found.accelerations(trajectory.states(), false, |_| Flow::Continue);
        match found.err()?.reason {
            NoMotion::Redundant { name, message, hint, .. } => self.at(&name, message, hint),
            NoMotion::Singular { name, message, .. } => self.at(&name, message, ""),
            other => self.at("", other.to_string(), ""),
        }
    }

    /// The obstacle to the search for an equilibrium.
    fn of_equilibrium(&self) -> Option<Problem> {
        let reason = equilibrium::begins(self.model, self.state).err()?;
        let message = reason.to_string();
        match &reason {
            NoRest::Singular { name, .. } | NoRest::State { name } => self.at(name, message, ""),
            _ => self.at("", message, ""),
        }
    }

    /// The obstacle to the linearized equations, whose eigenvalues give the modes.
    fn of_modes(&self) -> Option<Problem> {
        let failure = linearization::begins(self.model, self.state).err()?;
        let message = failure.to_string();
        match failure {
            NotLinear::Singular { name, .. } | NotLinear::Open { name, .. } => {
                self.at(&name, message, "")
            }
            NotLinear::NoInertia { coordinate, .. } => self.at(&coordinate, message, ""),
            NotLinear::Motion(failure) => self.of_motion(failure.reason),
            _ => self.at("", message, ""),
        }
    }
}
