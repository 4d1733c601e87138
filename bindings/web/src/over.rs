//! A motion over a driven value that replaces time, as in `kp.kinematics(over=…)`.

use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::analyses::kinematics::{over as driven_over, Over};
use kempe::{build, Model, State};
use std::sync::Arc;

/// The variable that replaces time: a quantity and its unit.
pub struct Variable {
    pub name: String,
    pub unit: String,
}

/// The model in which t is the value of `over`, a driver or a position quantity, and the start at this t.
pub fn driven_by(
    loaded: &Loaded,
    over: &str,
    start: &State,
) -> Result<(Arc<Model>, State, Variable), Fault> {
    let found = driven_over(&loaded.case.definition, &loaded.model, start, over);
    let Over { definition, quantity, unit, value } = found.map_err(Fault::of_problem)?;
    let model = build(&definition, &loaded.values()).map_err(|found| Fault::of_problems(&found))?;
    let start = State { t: value, ..start.clone() };
    Ok((Arc::new(model), start, Variable { name: quantity, unit }))
}
