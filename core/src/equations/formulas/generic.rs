//! The equations of an element type, with the names of its fields.

use super::names::{curve, function, internal, point, BodyName, Coordinates};
use super::scalars::{scalars, Scalar};
use super::{print, residual, Formulas};
use crate::elements::{
    Acted, Bearing, BodyId, Constraint, Coordinate, CoordinateOf, Curve, CurveOn, Default, Field,
    Followed, Group, JointId, PointOn, QuantityKind, Source,
};
use crate::expression::Tape;
use crate::math::{each, Listed, Local, Pose, ShortArray};
use crate::symbolic::{record, upright, Form, Name, NameKind, Record, Symbolic};

/// The equations of a type of joint or driver. None if the type does not exist. Bodies are named i, j, …, a point is
/// s′ in its body, and a driven coordinate is the angle.
pub fn of_type(group: Group, kind: &str, form: Form) -> Option<Formulas> {
    let element = Constraint::read(group, kind, &mut SampleNames { bodies: 0 })??;
    Some(of_element(&element, form))
}

/// The equations of an element, with the names of its fields instead of their values.
pub fn of_element<T>(element: &Constraint<T>, form: Form) -> Formulas {
    record(|record| {
        let t = record.time();
        let mut fields = symbols(record, element).into_iter();
        let mut element = element.map(&mut |_| fields.next().unwrap_or(t));
        let bodies: Vec<(BodyId, Coordinates)> = element
            .bodies()
            .into_iter()
            .enumerate()
            .filter(|(_, body)| !body.is_ground())
            .map(|(k, body)| (body, Coordinates::new(record, &BodyName::letter(k), k)))
            .list();
        let pose = |body: BodyId| match bodies.iter().find(|(id, _)| *id == body) {
            Some((_, coordinates)) => coordinates.pose(),
            None => Pose::identity(),
        };
        let own = internal(record, element.own());
        if let Some(on) = element.curve_mut() {
            on.curve = curve(record, None, own[0]);
        }
        let phi = residual(&element, pose, &own, t);
        let columns: Vec<&Coordinates> = bodies.iter().map(|(_, body)| body).list();
        print(record, &phi, (&columns, &own), form)
    })
}

/// A symbol for each scalar of an element.
fn symbols<T>(record: &Record, element: &Constraint<T>) -> Vec<Symbolic> {
    let mut all = Vec::new();
    for (owner, field) in scalars(element).into_iter().enumerate() {
        match field {
            Scalar::Point(field) => {
                let s = point(record, &field, None, owner, [false; 2]);
                all.extend([s.x, s.y]);
            }
            Scalar::Pair(field) => all.extend(each([0, 1], |k| side(record, &field, k))),
            Scalar::Number(field) => all.push(record.symbol(Name::field(&field))),
            Scalar::Law(field) => all.push(function(record, &field)),
            Scalar::Numbers(field, count) => {
                let name = |k| Name::field(&format!("{field}_{k}"));
                (1..=count).map(|k| record.symbol(name(k))).append_to(&mut all);
            }
            Scalar::Curve(count) => (0..count).map(|_| record.time()).append_to(&mut all),
            Scalar::Laws(field, count) => {
                (1..=count).map(|k| function(record, &format!("{field}_{k}"))).append_to(&mut all);
            }
        }
    }
    all
}

/// One of two numbers, which belong to bodies i and j.
fn side(record: &Record, field: &str, k: usize) -> Symbolic {
    let body = BodyName::letter(k);
    let name = Name::new(
        &format!("{field}_{}", body.text),
        &format!("{field}{}", body.unicode),
        &format!("{}_{{{}}}", upright(field), body.latex),
        NameKind::Field,
    );
    record.symbol(Name { owner: Some(k), ..name })
}

/// Source of an element between different bodies in which all numbers are zero.
struct SampleNames {
    bodies: usize,
}

impl SampleNames {
    fn next_body(&mut self) -> BodyId {
        self.bodies += 1;
        BodyId(self.bodies)
    }
}

impl Source for SampleNames {
    fn given(&mut self, field: &Field) -> bool {
        // friction takes equations away from a joint that may slip
        field.name != "friction"
    }
    fn body(&mut self, _: &Field) -> Option<BodyId> {
        Some(self.next_body())
    }
    fn point(&mut self, _: &Field) -> Option<PointOn<Tape>> {
        let s = Local { x: Tape::from(0.0), y: Tape::from(0.0) };
        Some(PointOn { body: self.next_body(), s })
    }
    fn curve(&mut self, _: &Field) -> Option<CurveOn<Tape>> {
        let zero = || Local { x: Tape::from(0.0), y: Tape::from(0.0) };
        let curve = Curve::Line { from: zero(), to: zero() };
        Some(CurveOn { body: self.next_body(), curve })
    }
    fn coordinate(&mut self, _: &Field) -> Option<Followed<Tape>> {
        let of = CoordinateOf { body: self.next_body(), coordinate: Coordinate::Angle };
        Some(of.into())
    }
    fn acted(&mut self, field: &Field) -> Option<Acted<Tape>> {
        let Followed::Coordinate(of) = self.coordinate(field)? else { return None };
        Some(of.into())
    }
    fn terms(&mut self, field: &Field) -> Option<Vec<(Followed<Tape>, Tape)>> {
        let mut term = || Some((self.coordinate(field)?, Tape::from(1.0)));
        Some(vec![term()?, term()?])
    }
    fn units(&mut self, _: &Field) -> Option<Vec<QuantityKind>> {
        Some(vec![QuantityKind::Length])
    }
    fn joint(&mut self, _: &Field) -> Option<JointId> {
        Some(JointId(0))
    }
    fn bearing(&mut self, _: &Field) -> Option<Bearing<Tape>> {
        None // forces have no equations
    }
    fn number(&mut self, _: &Field) -> Option<Tape> {
        Some(Tape::from(0.0))
    }
    fn law(&mut self, _: &Field) -> Option<Tape> {
        Some(Tape::from(0.0))
    }
    fn pair(&mut self, _: &Field) -> Option<[Tape; 2]> {
        Some([0.0, 0.0].each(Tape::from))
    }
    fn triple(&mut self, _: &Field) -> Option<[Tape; 3]> {
        Some([0.0, 0.0, 0.0].each(Tape::from))
    }
    fn law_pair(&mut self, field: &Field) -> Option<[Tape; 2]> {
        self.pair(field)
    }
    fn laws(&mut self, field: &Field) -> Option<Vec<Tape>> {
        self.law(field).map(|law| vec![law])
    }
    fn condition(&mut self, _: &Field) -> Option<String> {
        Some("t > 0".to_string())
    }
    fn flag(&mut self, field: &Field) -> Option<bool> {
        Some(field.default == Some(Default::Flag(true)))
    }
    fn word(&mut self, _: &Field, _: &[&str]) -> Option<usize> {
        Some(0)
    }
}
