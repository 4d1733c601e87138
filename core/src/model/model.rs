//! A model as numbers: immutable, over any scalar.

use super::blueprint::Blueprint;
use super::layout::{StateLayout, Touched};
use super::variable::Dependence;
use crate::elements::{BodyId, Constraint, Equation, ForceElement, Group, JointId, OwnState};
use crate::expression::{Tape, Values};
use crate::math::{Lift, Local, Real, Vec2};
use std::sync::Arc;

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body<S = f64> {
    /// Its name.
    pub name: String,
    /// The `type` in the file.
    pub kind: &'static str,
    /// Mass, kg; zero for ground.
    pub mass: S,
    /// Moment of inertia about the mass centre, kg·m².
    pub inertia: S,
    /// Mass centre in the body frame, m.
    pub center: Local<S>,
    /// Named points in the body frame, m.
    pub points: Vec<(String, Local<S>)>,
    /// Where it was drawn: x, y, angle; a guess for assembly.
    pub drawn: Option<[S; 3]>,
    /// Whether the angle is a coordinate; a point mass has none.
    pub turns: bool,
}

impl<S> Body<S> {
    /// The same body over another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Body<T> {
        let mut local = |s: &Local<S>| Local { x: f(&s.x), y: f(&s.y) };
        let center = local(&self.center);
        let points = self.points.iter().map(|(name, s)| (name.clone(), local(s))).collect();
        Body {
            name: self.name.clone(),
            kind: self.kind,
            mass: f(&self.mass),
            inertia: f(&self.inertia),
            center,
            points,
            drawn: self.drawn.as_ref().map(|[x, y, angle]| [f(x), f(y), f(angle)]),
            turns: self.turns,
        }
    }

    /// A named point.
    pub fn point(&self, name: &str) -> Option<&Local<S>> {
        self.points.iter().find(|(n, _)| n == name).map(|(_, s)| s)
    }
}

/// A joint or driver in a model.
#[derive(Clone, Debug)]
pub struct ConstraintItem<S = f64> {
    /// Its name.
    pub name: String,
    /// Joint or driver.
    pub group: Group,
    /// The bodies whose poses enter Φ: i and j first.
    pub bodies: Vec<BodyId>,
    /// The element; if there is a `law`, with its formulas at t = 0.
    pub element: Constraint<S>,
    /// The element over formulas, if one of them depends on time or state.
    pub law: Option<Box<Constraint<Tape>>>,
    /// Whether time or a driven motion does work through it.
    pub driven: bool,
    /// Equations, in the order of the rows.
    pub equations: Vec<Equation>,
}

/// A force in a model.
#[derive(Clone, Debug)]
pub struct ForceItem<S = f64> {
    /// Its name.
    pub name: String,
    /// The bodies on which it acts: i and j first.
    pub bodies: Vec<BodyId>,
    /// Its first-order states.
    pub states: &'static [OwnState],
    /// The joint whose reaction enters it.
    pub reaction: Option<JointId>,
    /// The element; if there is a `law`, with its formulas at t = 0.
    pub element: ForceElement<S>,
    /// The element over formulas, if one of them depends on time or state.
    pub law: Option<Box<ForceElement<Tape>>>,
}

/// A planar mechanism, ready to be evaluated. Immutable.
#[derive(Clone, Debug)]
pub struct Model<S = f64> {
    /// Where it came from; gives the same model over other parameters.
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
    /// Whether redundant constraints are accepted; their multipliers are then the smallest that
    /// balance the loads.
    pub allow_redundancy: bool,
}

/// Values for formulas at the reference state: t = 0, everything at rest in the origin.
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
        let mut touched = Vec::new();
        let mut constraints = Vec::new();
        for (name, group, formula) in &blueprint.constraints {
            let mut depends = Dependence::default();
            formula.map(&mut |tape| depends.add(tape));
            let (equations, bodies) = (formula.equations(), formula.bodies());
            touched.push(Touched {
                equations: equations.len(),
                bodies: bodies.iter().chain(&depends.bodies).copied().collect(),
                own: formula.own(),
                constant_columns: formula.constant_columns() && !depends.any(),
            });
            constraints.push(ConstraintItem {
                name: name.clone(),
                group: *group,
                bodies,
                element: formula.map(value),
                law: depends.any().then(|| Box::new(formula.clone())),
                driven: *group == Group::Drivers,
                equations,
            });
        }
        let forces = blueprint.forces.iter().map(|(name, states, formula)| {
            let mut depends = Dependence::default();
            formula.map(&mut |tape| depends.add(tape));
            ForceItem {
                name: name.clone(),
                bodies: formula.bodies(),
                reaction: formula.reaction(),
                states,
                element: formula.map(value),
                law: depends.any().then(|| Box::new(formula.clone())),
            }
        });
        let forces: Vec<ForceItem<S>> = forces.collect();
        let bodies: Vec<Body<S>> = blueprint.bodies.iter().map(|body| body.map(value)).collect();
        let gravity = Vec2::new(value(&blueprint.gravity[0]), value(&blueprint.gravity[1]));
        let unknowns = bodies[1..].iter().map(|body| if body.turns { 3 } else { 2 });
        let states = forces.iter().map(|item| item.states.len());
        let layout = StateLayout::new(unknowns, &touched, states);
        Self {
            blueprint: Arc::clone(blueprint),
            parameters: parameters.to_vec(),
            gravity,
            driven: constraints.iter().any(|item| item.driven),
            bodies,
            layout,
            constraints,
            forces,
            allow_redundancy: blueprint.allow_redundancy,
        }
    }

    /// The same model with redundant constraints accepted.
    pub fn allowing_redundancy(&self) -> Self {
        let blueprint = Blueprint { allow_redundancy: true, ..(*self.blueprint).clone() };
        Self::new(&Arc::new(blueprint), &self.parameters)
    }

    /// The same model over a scalar that contains this one.
    pub fn lift<T: Lift<S>>(&self) -> Model<T> {
        let parameters: Vec<T> = self.parameters.iter().map(|p| T::lift(*p)).collect();
        Model::new(&self.blueprint, &parameters)
    }
}

impl<S> Model<S> {
    /// A body by name.
    pub fn body(&self, name: &str) -> Option<BodyId> {
        self.bodies.iter().position(|b| b.name == name).map(BodyId)
    }
    /// A joint or driver by name.
    pub fn constraint(&self, name: &str) -> Option<usize> {
        self.constraints.iter().position(|c| c.name == name)
    }
    /// A force by name.
    pub fn force(&self, name: &str) -> Option<usize> {
        self.forces.iter().position(|f| f.name == name)
    }
}
