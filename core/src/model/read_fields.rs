//! The values of the fields of an element, by their kinds.

use super::beam_names::NODE;
use super::definition::Value;
use super::scope::Reach;
use super::unit_check::ANY_UNIT;
use crate::elements::{
    types_that_rub, Acted, Bearing, BodyId, CurveOn, Default, Field, Followed, Group, JointId,
    PointOn, QuantityKind, Side, Source,
};
use crate::expression::Tape;
use crate::math::{Listed, Local, ShortArray};
use std::sync::Arc;

use super::link::{did_you_mean, Linker};
use crate::expression::suggest::frame_meant;

impl Source for Linker<'_> {
    fn given(&mut self, field: &Field) -> bool {
        self.entry.get(field.name).is_some()
    }

    fn body(&mut self, field: &Field) -> Option<BodyId> {
        let name = match (self.entry.get(field.name), field.default) {
            (None, Some(Default::Body(name))) => name,
            _ => self.text(field)?,
        };
        self.find(field, name)
    }

    fn point(&mut self, field: &Field) -> Option<PointOn<Tape>> {
        if let Some(of) = &self.pairing {
            return Some(of.point.clone());
        }
        let text = self.text(field)?;
        let (body, name) = self.split(field, text, "body.point")?;
        let owner = &self.bodies[body.0];
        if let Some(s) = owner.point(name) {
            return Some(PointOn { body, s: s.clone() });
        }
        // a place of a beam is a node
        if let Some(k) = self.scope.body(text).filter(|k| self.bodies[*k].kind == NODE) {
            let s = Local { x: Tape::from(0.0), y: Tape::from(0.0) };
            return Some(PointOn { body: BodyId(k), s });
        }
        if owner.lacks_points() {
            return None; // its own fault is reported
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = owner.points.iter().map(|(n, _)| n.as_str()).list();
            did_you_mean(name, &names, &format!("points of {}", owner.name))
        });
        let message = format!("body '{}' has no point '{name}'", owner.name);
        self.report(field, message, hint.flatten())
    }

    fn curve(&mut self, field: &Field) -> Option<CurveOn<Tape>> {
        if let Some(of) = &self.pairing {
            return Some(of.curve.clone());
        }
        let text = self.text(field)?;
        self.curve_named(field, text)
    }

    fn mate(&mut self) -> Option<(CurveOn<Tape>, Side)> {
        self.pairing.as_ref().and_then(|of| of.mate.clone())
    }

    fn coordinate(&mut self, field: &Field) -> Option<Followed<Tape>> {
        let text = self.text(field)?;
        let found = self.position(field, text)?;
        if found.is_place() && self.group == Group::Forces {
            let message = format!("no force acts along '{text}', which is a place on a curve");
            let hint = "give a coordinate of the body that moves on the curve";
            return self.report(field, message, Some(hint.to_string()));
        }
        Some(found)
    }

    fn acted(&mut self, field: &Field) -> Option<Acted<Tape>> {
        match self.coordinate(field)? {
            Followed::Coordinate(of) => Some(of.into()),
            Followed::Quantity(of) => {
                let gradient = self.quantities.gradient(&of.name)?;
                Some(Acted { of: Followed::Quantity(of), gradient })
            }
        }
    }

    fn joint(&mut self, field: &Field) -> Option<JointId> {
        let name = self.text(field)?;
        // a faulty constraint before this one shifts its index from the written position
        let is_named = |k: &usize| self.constraints.get(*k).is_some_and(|(own, ..)| own == name);
        let written = self.scope.constraint(name).filter(is_named);
        if let Some(k) = written.or_else(|| (0..self.constraints.len()).find(is_named)) {
            return Some(JointId(k));
        }
        let hint = self.suggests().then(|| {
            let names: Vec<&str> = self.constraints.iter().map(|(own, ..)| own.as_str()).list();
            did_you_mean(name, &names, "joints")
        });
        self.report(field, format!("unknown joint '{name}'"), hint.flatten())
    }

    fn bearing(&mut self, field: &Field) -> Option<Bearing<Tape>> {
        let joint = self.joint(field)?;
        let (name, _, element) = &self.constraints[joint.0];
        if !element.rubs() {
            let kind = element.kind();
            let message = format!("'{name}' is of type '{kind}', in which there is no friction");
            let hint = format!("the types with friction are: {}", types_that_rub().join(", "));
            return self.report(field, message, Some(hint));
        }
        let quantity = element.measured().first()?.names[0];
        let found = self.quantities.followed(&format!("{name}.{quantity}"));
        let Some(Followed::Quantity(of)) = found else {
            return self.report(field, format!("the bodies of '{name}' do not move"), None);
        };
        let holds_angle =
            element.equations().iter().any(|equation| equation.kind == QuantityKind::Angle);
        Some(Bearing { joint, holds_angle, ends: of.ends.clone(), coordinate: Arc::from(of) })
    }

    fn number(&mut self, field: &Field) -> Option<Tape> {
        if let Some(of) = self.pairing.clone().filter(|_| field.name == "radius") {
            let written = self.formula(field, Reach::Parameters);
            return of.radius.or(written.map(|radius| radius.plus(of.rounding)));
        }
        self.formula(field, Reach::Parameters)
    }

    fn law(&mut self, field: &Field) -> Option<Tape> {
        self.formula(field, self.reach(field))
    }

    fn pair(&mut self, field: &Field) -> Option<[Tape; 2]> {
        self.two(field, Reach::Parameters)
    }

    fn triple(&mut self, field: &Field) -> Option<[Tape; 3]> {
        let items = match (self.entry.get(field.name), field.default) {
            (Some(Value::List(items)), _) if items.len() == 3 => items,
            (Some(Value::List(items)), _) => {
                let message = format!("must hold three numbers, not {}", items.len());
                return self.report(field, message, None);
            }
            (Some(other), _) => {
                let message = format!("must be a list of three numbers, not {}", other.noun());
                return self.report(field, message, None);
            }
            (None, Some(Default::Triple(x))) => return Some(x.each(Tape::from)),
            (None, _) => return self.missing(field),
        };
        let units: Vec<&str> = field.unit.split(',').list();
        let mut read = |k: usize| {
            let path: Vec<String> = self.path(field).into_iter().chain([k.to_string()]).list();
            self.read(&items[k], &path, units.get(k).unwrap_or(&ANY_UNIT), Reach::Parameters)
        };
        let (x, y, z) = (read(0), read(1), read(2));
        Some([x?, y?, z?])
    }

    fn law_pair(&mut self, field: &Field) -> Option<[Tape; 2]> {
        self.two(field, self.reach(field))
    }

    fn laws(&mut self, field: &Field) -> Option<Vec<Tape>> {
        let items = match self.entry.get(field.name) {
            Some(Value::List(items)) => items,
            Some(other) => {
                let message = format!("must be a list of formulas, not {}", other.noun());
                return self.report(field, message, None);
            }
            None => return self.missing(field),
        };
        let (path, reach) = (self.path(field), self.reach(field));
        let read = |(k, item): (usize, &Value)| {
            let path: Vec<String> = path.iter().cloned().chain([k.to_string()]).list();
            self.read(item, &path, &field.unit, reach)
        };
        // every formula is read, so that all errors are reported at once
        let all: Vec<Option<Tape>> = items.iter().enumerate().map(read).list();
        all.into_iter().collect()
    }

    fn terms(&mut self, field: &Field) -> Option<Vec<(Followed<Tape>, Tape)>> {
        let items = match self.entry.get(field.name) {
            Some(Value::Table(items)) => items,
            Some(other) => {
                let message = format!("must be a table of quantities, not {}", other.noun());
                return self.report(field, message, None);
            }
            None => return self.missing(field),
        };
        let mut all = Vec::new();
        for (name, factor) in items {
            let path: Vec<String> = self.path(field).into_iter().chain([name.clone()]).list();
            let of = self.position(field, name);
            let factor = self.read(factor, &path, ANY_UNIT, Reach::Parameters);
            all.push(of.zip(factor));
        }
        all.into_iter().collect()
    }

    fn units(&mut self, field: &Field) -> Option<Vec<QuantityKind>> {
        let items = match self.entry.get(field.name) {
            Some(Value::List(items)) => items,
            Some(other) => {
                let message = format!("must be a list of units, not {}", other.noun());
                return self.report(field, message, None);
            }
            None => return self.missing(field),
        };
        let known = |item: &Value| match item {
            Value::Text(unit) => QuantityKind::of_equation(unit),
            _ => None,
        };
        match items.iter().map(known).collect::<Option<Vec<_>>>() {
            Some(kinds) => Some(kinds),
            None => self.report(field, "each must be \"m\" or \"rad\"".to_string(), None),
        }
    }

    fn condition(&mut self, field: &Field) -> Option<String> {
        self.text(field).map(str::to_string)
    }

    fn flag(&mut self, field: &Field) -> Option<bool> {
        match (self.entry.get(field.name), field.default) {
            (Some(Value::Flag(flag)), _) => Some(*flag),
            (Some(other), _) => {
                let message = format!("must be true or false, not {}", other.noun());
                self.report(field, message, None)
            }
            (None, Some(Default::Flag(flag))) => Some(flag),
            (None, _) => self.missing(field),
        }
    }

    fn word(&mut self, field: &Field, words: &[&str]) -> Option<usize> {
        if let (Some(of), "side") = (&self.pairing, field.name) {
            return Some(of.side as usize);
        }
        let word = match (self.entry.get(field.name), field.default) {
            (None, Some(Default::Body(word))) => word,
            _ => self.text(field)?,
        };
        let found = words.iter().position(|known| *known == word);
        found.or_else(|| {
            let hint = frame_meant(word, words).or_else(|| did_you_mean(word, words, "words"));
            self.report(field, format!("unknown word '{word}'"), hint)
        })
    }
}
