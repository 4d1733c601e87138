//! The mechanism with other values of some parameters, without some of its drivers, or with forces in given modes.

use super::blueprint::Blueprint;
use super::items::{ConstraintItem, ForceItem, ForceMode};
use super::model::Model;
use super::problem::Problem;
use super::{checks, parameters};
use crate::elements::{Group, Mode};
use crate::expression::Expression;
use crate::math::Listed;
use std::borrow::Cow;
use std::sync::Arc;

impl Model {
    /// The model with other values of some parameters. Formulas of these parameters are evaluated again.
    ///
    /// # Errors
    /// All numbers with impossible values.
    pub fn with_values(&self, changes: &[(String, f64)]) -> Result<Self, Vec<Problem>> {
        let (mut problems, mut blueprint) = (Vec::new(), Blueprint::clone(&self.blueprint));
        for (name, x) in changes {
            let known = blueprint.formulas.iter_mut().find(|(known, _)| known == name);
            if let (Some((_, formula)), Ok(number)) = (known, Expression::number(*x)) {
                *formula = number;
            }
        }
        let formulas = std::mem::take(&mut blueprint.formulas);
        let found = parameters::evaluate(formulas, &blueprint.tables, &mut problems);
        blueprint.formulas = found.formulas;
        let model = Self::new(&Arc::new(blueprint), &found.values);
        if problems.is_empty() {
            checks::numbers(&model, &mut problems);
        }
        match problems.is_empty() {
            true => Ok(model),
            false => Err(problems),
        }
    }

    /// The mechanism in which beams are rigid. It has the same coordinates. None without beams.
    pub fn rigid(&self) -> Option<Self> {
        Some(Self::new(&Arc::new(self.blueprint.rigid()?), &self.parameters))
    }

    /// The model without the drivers of these names. Other names are ignored.
    pub fn without(&self, drivers: &[String]) -> Self {
        let mut blueprint = Blueprint::clone(&self.blueprint);
        Arc::make_mut(&mut blueprint.constraints).retain(|(name, ..)| !drivers.contains(name));
        let is_limit = |item: &&ForceItem| item.element.driver().is_some();
        if self.forces.iter().filter(is_limit).any(|item| drivers.contains(&item.name)) {
            let own = Arc::make_mut(&mut blueprint.forces).iter_mut();
            let own =
                own.filter(|(name, _, force)| force.driver().is_some() && drivers.contains(name));
            own.for_each(|(.., limit)| limit.take_over(false));
        }
        Self::new(&Arc::new(blueprint), &self.parameters)
    }

    /// The model of runs of forward dynamics: the limits of drivers act in place of these drivers.
    pub fn limited(&self) -> Cow<'_, Self> {
        let is_limited = |item: &ConstraintItem| {
            item.companion.is_some_and(|k| self.forces[k].element.driver().is_some())
        };
        if !self.constraints.iter().any(is_limited) {
            return Cow::Borrowed(self);
        }
        let mut blueprint = Blueprint::clone(&self.blueprint);
        let forces = Arc::make_mut(&mut blueprint.forces);
        for item in self.constraints.iter().filter(|item| is_limited(item)) {
            item.companion.into_iter().for_each(|k| forces[k].2.take_over(true));
        }
        let kept = self.constraints.iter().map(|item| !is_limited(item)).list();
        let mut kept = kept.into_iter();
        Arc::make_mut(&mut blueprint.constraints).retain(|_| kept.next() != Some(false));
        Cow::Owned(Self::new(&Arc::new(blueprint), &self.parameters))
    }
}

impl Model {
    /// The model with the formulas of parameters of another one, which give the same values.
    pub fn with_formulas_of(self, other: &Self) -> Self {
        let formulas = other.blueprint.formulas.clone();
        let blueprint = Blueprint { formulas, ..Blueprint::clone(&self.blueprint) };
        Self { blueprint: Arc::new(blueprint), ..self }
    }

    /// The model in which the phases of meshed wheels are changed, by the names of the joints, m.
    pub fn with_phases(&self, changes: Vec<(String, f64)>) -> Self {
        let mut blueprint = Blueprint::clone(&self.blueprint);
        blueprint.phases.extend(changes);
        Self::new(&Arc::new(blueprint), &self.parameters)
    }

    /// The model with only these forces, in order, all as forces of their own. The friction of a contact needs the
    /// contact.
    pub fn with_forces(&self, kept: &[usize]) -> Self {
        let all = &self.blueprint;
        let first = all.forces.len() - all.companions.len();
        let contact = |of: usize| kept.binary_search(&of).expect("friction has its contact");
        let companions = kept.iter().filter(|k| **k >= first);
        let companions = companions.map(|k| all.companions[*k - first].map(contact)).list();
        let blueprint = Blueprint {
            forces: Arc::new(kept.iter().map(|k| all.forces[*k].clone()).list()),
            further: Arc::default(),
            companions: Arc::new(companions),
            ..(**all).clone()
        };
        Self::new(&Arc::new(blueprint), &self.parameters)
    }

    /// The model with forces in these modes. Limits of drivers act in place of the drivers.
    pub fn in_modes(&self, modes: &[ForceMode]) -> Self {
        if let (false, Cow::Owned(limited)) = (modes.is_empty(), self.limited()) {
            return limited.in_modes(modes);
        }
        let mut blueprint = Blueprint { modes: modes.to_vec(), ..(*self.blueprint).clone() };
        for ForceMode { force, mode, value, .. } in modes {
            let (name, _, element) = &self.blueprint.forces[*force];
            let Mode::Holds(side) = mode else { continue };
            let equation = element.holding(*side, *value);
            let equation = equation.expect("a force that holds has an equation");
            let first = self.blueprint.forces.len() - self.blueprint.companions.len();
            let how = match element.driver() {
                Some(_) => "following",
                None if *force < first => "at rest",
                None => "sticking",
            };
            let held = (format!("{name} ({how})"), Group::Forces, equation);
            Arc::make_mut(&mut blueprint.constraints).push(held);
        }
        Self::new(&Arc::new(blueprint), &self.parameters)
    }
}

impl Model {
    /// The model with only the modes set, for reports. The multipliers of forces that hold follow the rows of the
    /// model.
    pub fn marked(&self, modes: &[ForceMode]) -> Self {
        let blueprint = Blueprint { modes: modes.to_vec(), ..(*self.blueprint).clone() };
        Self::new(&Arc::new(blueprint), &self.parameters)
    }
}

impl<S> Model<S> {
    /// The number of multipliers: the rows of the model, followed by the multipliers of forces with modes.
    pub fn n_multipliers(&self) -> usize {
        let after = self.forces.iter().filter_map(|item| item.held_row);
        after.map(|row| row + 1).max().unwrap_or(0).max(self.layout.n_rows)
    }
}
