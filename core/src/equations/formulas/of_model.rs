//! The equations of a joint or driver of a model, with the names and numbers of the model.

use super::names::{curve, internal, point, BodyName, Coordinates};
use super::scalars::{scalars, Scalar};
use super::{print, residual, Formulas};
use crate::elements::{BodyId, Constraint, Coordinate};
use crate::equations::laws::Laws;
use crate::expression::Tape;
use crate::math::{each, Listed, Pose, Real};
use crate::model::{Dependence, Model};
use crate::symbolic::{record, Form, Name, Record, Symbolic};

/// The equations of constraint `k`. Numbers and laws are inserted as in the model. A point has the name that
/// `written` returns for its field, such as `crank.B`.
///
/// A law may depend on the coordinates of other bodies. These bodies have columns as well.
pub fn of_constraint(
    model: &Model,
    k: usize,
    written: &dyn Fn(&str) -> Option<String>,
    form: Form,
) -> Formulas {
    record(|record| {
        let element = &model.blueprint.constraints[k].2;
        let t = record.time();
        let names = model.blueprint.parameters.iter();
        let parameters: Vec<Symbolic> = names.map(|p| record.symbol(Name::field(p))).list();
        let bodies: Vec<(BodyId, Coordinates)> = touched(element)
            .into_iter()
            .map(|id| {
                let name = BodyName::given(&model.bodies[id.0].name);
                (id, Coordinates::new(record, &name, id.0))
            })
            .list();
        let find = |id: BodyId| bodies.iter().find(|(known, _)| *known == id);
        let coordinate = |body: BodyId, c: Coordinate| {
            find(body).map_or(Symbolic::zero(), |(_, coordinates)| coordinates.of(c))
        };
        let seen = internals(element);
        let own = internal(record, element.own() + seen.len());
        let mut places = vec![t; seen.last().map_or(0, |last| last + 1)];
        let symbols = own[element.own()..].iter();
        seen.iter().zip(symbols).for_each(|(place, symbol)| places[*place] = *symbol);
        let values = Laws {
            parameters: &parameters,
            t,
            coordinate,
            own: [&places, &[]],
            z: &[],
            pieces: &[],
            function: None,
        };
        let mut points = points(record, model, element, written).into_iter();
        let mut over = element.map(&mut |tape| match points.next().flatten() {
            Some(component) => component,
            None => tape.evaluate(&values),
        });
        let pose = |body: BodyId| {
            find(body).map_or(Pose::identity(), |(_, coordinates)| coordinates.pose())
        };
        if let Some(on) = over.curve_mut() {
            on.curve = curve(record, written("curve").as_deref(), own[0]);
        }
        let phi = residual(&over, pose, &own[..element.own()], t);
        let columns: Vec<&Coordinates> = bodies.iter().map(|(_, body)| body).list();
        print(record, &phi, (&columns, &own), form)
    })
}

/// The internal coordinates of other joints on which a constraint depends, ascending.
fn internals(element: &Constraint<Tape>) -> Vec<usize> {
    let mut depends = Dependence::default();
    element.visit(&mut |tape| depends.add(tape));
    depends.internals.sort_unstable();
    depends.internals.dedup();
    depends.internals
}

/// The moving bodies on which a constraint and its laws depend, each once.
fn touched(element: &Constraint<Tape>) -> Vec<BodyId> {
    let mut depends = Dependence::default();
    element.visit(&mut |tape| depends.add(tape));
    let all = element.bodies().into_iter().chain(depends.bodies);
    let mut once = Vec::new();
    for body in all {
        if !body.is_ground() && !once.contains(&body) {
            once.push(body);
        }
    }
    once
}

/// The components of the points of an element, in the order in which its scalars are visited. None for each scalar
/// that is not a component of a point.
fn points(
    record: &Record,
    model: &Model,
    element: &Constraint<Tape>,
    written: &dyn Fn(&str) -> Option<String>,
) -> Vec<Option<Symbolic>> {
    let coordinate = |_: BodyId, _: Coordinate| 0.0;
    let parameters = &model.parameters;
    let reference =
        Laws { parameters, t: 0.0, coordinate, own: [&[]; 2], z: &[], pieces: &[], function: None };
    let mut values = Vec::new();
    element.visit(&mut |tape| values.push(tape.evaluate(&reference)));
    let mut all = Vec::new();
    for scalar in scalars(element) {
        match scalar {
            Scalar::Point(field) => {
                let label = written(&field).unwrap_or_else(|| field.clone());
                let body = label.rsplit_once('.').and_then(|(body, _)| model.body(body));
                let zero = each([0, 1], |k| values[all.len() + k] == 0.0);
                let s = point(record, &field, Some(&label), body.map_or(0, |body| body.0), zero);
                all.extend([Some(s.x), Some(s.y)]);
            }
            Scalar::Pair(_) => all.extend([None, None]),
            Scalar::Number(_) | Scalar::Law(_) => all.push(None),
            Scalar::Curve(count) | Scalar::Laws(_, count) | Scalar::Numbers(_, count) => {
                all.extend((0..count).map(|_| None))
            }
        }
    }
    all
}
