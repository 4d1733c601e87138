//! Holders: drivers added to the model, each of which keeps a position quantity at its value at the start.

use super::failure::Reason;
use crate::analyses::assemble::position;
use crate::analyses::second_order::mobility;
use crate::analyses::State;
use crate::elements::Followed;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::expression::Tape;
use crate::math::Listed;
use crate::model::{Model, Problem};
use std::sync::Arc;

/// The model with holders that keep the position quantities `hold` at their values at `start`. The holders are its
/// last constraints.
pub(super) fn holding(model: &Model, start: &State, hold: &[String]) -> Result<Model, Reason> {
    let found: Vec<_> = hold.iter().map(|name| position(model, name)).list();
    let faults: Vec<Problem> = found.iter().filter_map(|one| one.clone().err()).list();
    if !faults.is_empty() {
        return Err(Reason::Option(faults.into_iter().map(at_hold).list()));
    }
    let followed: Vec<Followed<Tape>> = found.into_iter().flatten().list();
    let with = |values: &[f64]| {
        let all = hold.iter().zip(&followed).zip(values);
        let held: Vec<_> =
            all.map(|((name, of), x)| (format!("hold {name}"), of.clone(), Tape::from(*x))).list();
        Model::new(&Arc::new(model.blueprint.holding(&held)), &model.parameters)
    };
    let open = with(&vec![0.0; hold.len()]);
    let mut values = vec![0.0; open.layout.n_rows];
    let motions = Motions::at_rest(&open.layout, &start.q);
    constraints::residual(&open, &motions, start.t, &mut values);
    let held = with(&values[model.layout.n_rows..]);
    if hold.is_empty() || model.allow_redundancy {
        return Ok(held);
    }
    let depends = mobility(&held, start.t, &start.q);
    let group = depends.redundant.iter().chain(&depends.singular).next();
    let of_hold = |k: &&usize| **k >= model.constraints.len();
    match group.and_then(|group| group.iter().rev().find(of_hold)) {
        None => Ok(held),
        Some(k) => {
            let name = &hold[k - model.constraints.len()];
            let message = format!("joints, drivers or others of the list hold {name} already");
            Err(Reason::Option(vec![at_hold(Problem::at(&[name.as_str()], message))]))
        }
    }
}

fn at_hold(problem: Problem) -> Problem {
    Problem { path: vec!["hold".to_string()], ..problem }
}
