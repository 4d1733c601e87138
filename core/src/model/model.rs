//! A model as numbers: immutable, over any scalar.

use super::blueprint::Blueprint;
use super::layout::{Layout, Touched};
use crate::elements::{BodyId, Constraint, Equation, ForceElement, Group};
use crate::expression::{Symbol, Tape, Values};
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
    /// The element; where `law` is given its laws stand at their value for t = 0.
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
    /// The element; where `law` is given its laws stand at their value for t = 0.
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
    pub layout: Layout,
    /// Whether a joint or driver is driven.
    pub driven: bool,
    /// Whether redundant constraints are accepted; their multipliers are then the smallest that
    /// carry the loads.
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

/// The body and coordinate that a variable of a formula stands for: six to a body.
pub fn variable(k: usize) -> (BodyId, crate::elements::Coordinate) {
    (BodyId(k / 6), crate::elements::Coordinate::ALL[k % 6])
}

/// Time and state dependence of the formulas of an element.
#[derive(Clone, Debug, Default)]
pub struct Dependence {
    /// On t.
    pub time: bool,
    /// On coordinates or rates of these bodies.
    pub bodies: Vec<BodyId>,
}

impl Dependence {
    /// Collects what a formula depends on.
    pub fn add(&mut self, tape: &Tape) {
        for symbol in tape.symbols() {
            match symbol {
                Symbol::Parameter(_) => {}
                Symbol::Time => self.time = true,
                Symbol::Variable(k) => self.bodies.push(variable(*k).0),
            }
        }
    }
    /// Whether anything varies.
    pub fn any(&self) -> bool {
        self.time || !self.bodies.is_empty()
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
            let equations = formula.equations();
            let bodies = formula.ends().into_iter().chain(depends.bodies.iter().copied());
            touched.push(Touched {
                equations: equations.len(),
                bodies: bodies.collect(),
                pins: formula.pins() && equations.len() == 2 && !depends.any(),
            });
            constraints.push(ConstraintItem {
                name: name.clone(),
                group: *group,
                element: formula.map(value),
                law: depends.any().then(|| Box::new(formula.clone())),
                driven: *group == Group::Drivers,
                equations,
            });
        }
        let forces = blueprint.forces.iter().map(|(name, formula)| {
            let mut depends = Dependence::default();
            formula.map(&mut |tape| depends.add(tape));
            let law = depends.any().then(|| Box::new(formula.clone()));
            ForceItem { name: name.clone(), element: formula.map(value), law }
        });
        let forces = forces.collect();
        let bodies: Vec<Body<S>> = blueprint.bodies.iter().map(|body| body.map(value)).collect();
        let gravity = Vec2::new(value(&blueprint.gravity[0]), value(&blueprint.gravity[1]));
        let layout = Layout::new(blueprint.bodies.len() - 1, touched.into_iter());
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
