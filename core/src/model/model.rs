//! A model as numbers: immutable, over any scalar.

use super::beam_names::BEAM;
use super::blueprint::Blueprint;
use super::functions::Functions;
use super::items::{Body, ConstraintItem, ForceItem};
use super::layout::{StateLayout, Touched};
use super::modes;
use super::switch::{Switch, SwitchOwner};
use super::variable::Dependence;
use crate::elements::{BodyId, Constraint, Group, Mode};
use crate::expression::{Tape, Values};
use crate::math::{Lift, Listed, Real, Vec2};
use std::sync::Arc;

/// A planar mechanism, ready to be evaluated. Immutable.
#[derive(Clone, Debug)]
pub struct Model<S = f64> {
    /// The linked definition, from which models with other parameters are made.
    pub blueprint: Arc<Blueprint>,
    /// Values of the parameters.
    pub parameters: Vec<S>,
    /// Acceleration of free fall, m/s².
    pub gravity: Vec2<S>,
    /// Bodies; index 0 is ground.
    pub bodies: Vec<Body<S>>,
    /// Joints and drivers, in the order of their rows.
    pub constraints: Vec<ConstraintItem<S>>,
    /// Forces.
    pub forces: Vec<ForceItem<S>>,
    /// Index ranges.
    pub layout: StateLayout,
    /// Whether a joint or driver is driven.
    pub driven: bool,
    /// Switches of laws, forces and curves: first of the laws of constraints, then of the forces (switches of a
    /// force's laws before its own), then of the curves of joints.
    pub switches: Vec<Switch>,
    /// Whether redundant constraints are accepted. The multipliers that balance the loads are then those with the
    /// least norm.
    pub allow_redundancy: bool,
}

/// Values for formulas at the reference state: t = 0, with everything at rest at the origin.
struct Reference<'a, S>(&'a [S]);

impl<S: Real> Values<S> for Reference<'_, S> {
    fn parameter(&self, k: usize) -> S {
        self.0[k]
    }
    fn time(&self) -> S {
        S::zero()
    }
    fn variable(&self, _: usize) -> S {
        S::zero()
    }
}

impl<S: Real> Model<S> {
    /// The model of a blueprint with the given parameter values.
    pub fn new(blueprint: &Arc<Blueprint>, parameters: &[S]) -> Self {
        let reference = Reference(parameters);
        let value = &mut |tape: &Tape| tape.evaluate(&reference);
        let (mut touched, mut switches, mut constraints) = (Vec::new(), Vec::new(), Vec::new());
        for (name, group, formula) in blueprint.constraints.iter() {
            let mut depends = Dependence::default();
            formula.visit(&mut |tape| depends.add(tape));
            let (equations, mut bodies) = (formula.equations(), formula.bodies());
            if bodies.is_empty() {
                bodies.clone_from(&depends.bodies);
                bodies.sort_unstable();
                bodies.dedup();
            }
            touched.push(Touched {
                equations: equations.len(),
                bodies: bodies.iter().chain(&depends.bodies).copied().list(),
                own: (formula.own(), formula.curve().map(|on| on.curve.kind()).unwrap_or_default()),
                internals: depends.internals.clone(),
                constant_columns: formula.constant_columns() && !depends.any(),
            });
            constraints.push(ConstraintItem {
                name: name.clone(),
                group: *group,
                bodies,
                element: with_phase(name, formula.map(value), blueprint),
                law: depends.any().then(|| {
                    let owner = SwitchOwner::Constraint(constraints.len());
                    Box::new(formula.map(&mut |tape| Switch::number(tape, owner, &mut switches)))
                }),
                measures_from_ground: !depends.bodies.is_empty(),
                driven: *group == Group::Drivers || depends.time,
                equations,
                companion: None,
                curve_switch: None,
            });
        }
        let mut forces = forces(blueprint, value, &mut constraints, &mut switches);
        curve_switches(&mut constraints, &mut switches);
        let bodies: Vec<_> = blueprint.bodies.iter().map(|b| b.map(value).weighed()).list();
        let unknowns = bodies[1..].iter().map(|body| if body.turns { 3 } else { 2 });
        let states = forces.iter().map(|item| {
            let sampled = blueprint.functions.iter().flat_map(Functions::sampled).enumerate();
            let own = sampled.filter(|(_, (_, law, _))| law.element == item.name);
            (item.states.len(), own.map(|(at, _)| at).list())
        });
        let layout = StateLayout::new(unknowns, &touched, states);
        modes::set(&mut forces, &constraints, &layout, &blueprint.modes);
        Self {
            blueprint: Arc::clone(blueprint),
            parameters: parameters.to_vec(),
            gravity: Vec2::new(value(&blueprint.gravity[0]), value(&blueprint.gravity[1])),
            driven: constraints.iter().any(|item| item.driven),
            bodies,
            layout,
            constraints,
            forces,
            switches,
            allow_redundancy: blueprint.allow_redundancy,
        }
    }

    /// The model with redundant constraints accepted.
    pub fn allowing_redundancy(&self) -> Self {
        let blueprint = Blueprint { allow_redundancy: true, ..(*self.blueprint).clone() };
        Self::new(&Arc::new(blueprint), &self.parameters)
    }

    /// Converts the model to a scalar that contains the present scalar.
    pub fn lift<T: Lift<S>>(&self) -> Model<T> {
        let parameters: Vec<T> = self.parameters.iter().map(|p| T::lift(*p)).list();
        Model::new(&self.blueprint, &parameters)
    }
}

/// A constraint with its change of phase.
fn with_phase<S: Real>(
    name: &str,
    mut element: Constraint<S>,
    blueprint: &Blueprint,
) -> Constraint<S> {
    for (_, phase) in blueprint.phases.iter().filter(|(of, _)| of == name) {
        element.phase_mut().into_iter().for_each(|x| *x += S::constant(*phase));
    }
    element
}

impl<S> Model<S> {
    /// The name of the element to which a switch belongs.
    pub fn owner_name(&self, owner: SwitchOwner) -> &str {
        match owner {
            SwitchOwner::Constraint(k) => &self.constraints[k].name,
            SwitchOwner::Force(k) => &self.forces[k].name,
        }
    }
}

/// Adds the switches of curves to the list.
fn curve_switches<S: Real>(constraints: &mut [ConstraintItem<S>], switches: &mut Vec<Switch>) {
    for (k, item) in constraints.iter_mut().enumerate() {
        let breaks = item.element.curve().and_then(|on| on.curve.breaks());
        item.curve_switch = breaks.map(|breaks| {
            switches.push(Switch::of_curve(SwitchOwner::Constraint(k), breaks));
            switches.len() - 1
        });
    }
}

/// The forces of a blueprint. Adds their switches to the list, and their indices to the joints whose friction they are.
fn forces<S: Real>(
    blueprint: &Blueprint,
    value: &mut dyn FnMut(&Tape) -> S,
    constraints: &mut [ConstraintItem<S>],
    switches: &mut Vec<Switch>,
) -> Vec<ForceItem<S>> {
    let items = blueprint.forces.iter().enumerate().map(|(k, (name, states, formula))| {
        let mut depends = Dependence::default();
        formula.visit(&mut |tape| depends.add(tape));
        let owner = SwitchOwner::Force(k);
        let law = depends
            .any()
            .then(|| Box::new(formula.map(&mut |tape| Switch::number(tape, owner, switches))));
        let (element, first_switch) = (formula.map(value), switches.len());
        (0..element.switch_count()).map(|_| Switch::of_element(owner)).append_to(switches);
        ForceItem {
            name: name.clone(),
            bodies: formula.bodies(),
            reaction: formula.reaction(),
            states,
            element,
            law,
            first_switch,
            mode: Mode::Open,
            held_row: None,
            further: 0..0,
            partner: None,
            is_companion: false,
            load_row: None,
        }
    });
    let mut all: Vec<ForceItem<S>> = items.list();
    let first = all.len() - blueprint.companions.len();
    for (k, of) in blueprint.companions.iter().enumerate().map(|(k, of)| (first + k, *of)) {
        all[k].is_companion = true;
        let Some(of) = of else {
            let own = constraints.iter_mut().filter(|item| item.name == all[k].name);
            own.for_each(|item| item.companion = Some(k));
            continue;
        };
        (all[of].partner, all[k].partner) = (Some(k), Some(of));
        // both read the same switches
        all[k].first_switch = all[of].first_switch;
    }
    let first = first - blueprint.further.len();
    for (k, of) in blueprint.further.iter().enumerate().map(|(k, of)| (first + k, *of)) {
        let start = if all[of].further.is_empty() { k } else { all[of].further.start };
        all[of].further = start..k + 1;
    }
    all
}

impl<S: Real> Model<S> {
    /// The places of the states in z that change with time. Sampled laws and speeds of impact change at instants only.
    pub fn changing_states(&self) -> Vec<usize> {
        let own = self.forces.iter().zip(&self.layout.states);
        let speeds = own.filter(|(item, _)| item.element.keeps_speed()).map(|(_, own)| own.end - 1);
        let speeds: Vec<usize> = speeds.list();
        let still = |at: &usize| self.layout.held.contains(at) || speeds.contains(at);
        (0..self.layout.n_z).filter(|at| !still(at)).list()
    }
}

impl<S> Model<S> {
    /// A body by name. The first end of a beam, such as `rod.A`, is a name of its first node.
    pub fn body(&self, name: &str) -> Option<BodyId> {
        let known = self.bodies.iter().position(|b| b.name == name);
        let first = || {
            let (beam, place) = name.split_once('.')?;
            let is_first = |b: &Body<S>| {
                b.kind == BEAM
                    && b.name == beam
                    && b.points.first().is_some_and(|(p, _)| p == place)
            };
            self.bodies.iter().position(is_first)
        };
        known.or_else(first).map(BodyId)
    }
    /// A joint or driver by name.
    pub fn constraint(&self, name: &str) -> Option<usize> {
        self.constraints.iter().position(|c| c.name == name)
    }
    /// The names of joints and drivers with these indices.
    pub fn names_of<'a>(&self, places: impl IntoIterator<Item = &'a usize>) -> Vec<&str> {
        places.into_iter().map(|k| self.constraints[*k].name.as_str()).list()
    }
    /// The name of an equation, such as `C.x`, or the name of its joint if the joint has only one equation.
    pub fn equation_name(&self, row: usize) -> String {
        let (k, equation) = self.layout.owner(row);
        let item = &self.constraints[k];
        match item.equations.len() {
            1 => item.name.clone(),
            _ => format!("{}.{}", item.name, item.equations[equation].name),
        }
    }
    /// The forces that a case contains, without their further parts and companions.
    pub fn listed_forces(&self) -> &[ForceItem<S>] {
        let made = self.blueprint.further.len() + self.blueprint.companions.len();
        &self.forces[..self.forces.len() - made]
    }
    /// Force `k` and its further parts.
    pub fn parts(&self, k: usize) -> impl Iterator<Item = usize> {
        std::iter::once(k).chain(self.forces[k].further.clone())
    }
    /// Force `k` and its companion, without further parts.
    pub fn with_companion(&self, k: usize) -> impl Iterator<Item = usize> {
        let item = &self.forces[k];
        std::iter::once(k).chain(item.partner.filter(|_| !item.is_companion))
    }
    /// Force `k`, its further parts and all their companions.
    pub fn whole(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        self.parts(k).flat_map(|k| self.with_companion(k))
    }
    /// A force by name.
    pub fn force(&self, name: &str) -> Option<usize> {
        self.forces.iter().position(|f| f.name == name)
    }
}
