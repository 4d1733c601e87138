//! The constraints by which a body with one freedom left may be placed.

use crate::elements::Fixes;
use crate::model::{size, ConstraintItem, Dependence, Model};

/// The constraints that may place each body, and the size of the mechanism.
pub(super) struct ByEquation<'a> {
    pub model: &'a Model,
    pub size: f64,
    pub of: Vec<Vec<usize>>,
    /// The bodies that an equation joins to each body.
    linked: Vec<Vec<usize>>,
}

impl<'a> ByEquation<'a> {
    pub fn new(model: &'a Model) -> Self {
        let mut of = vec![Vec::new(); model.bodies.len()];
        let mut linked = of.clone();
        for (k, item) in model.constraints.iter().enumerate() {
            let fixes = item.element.fixes();
            let has = |wanted: fn(&Fixes<f64>) -> bool| fixes.iter().any(wanted);
            let otherwise = has(|f| matches!(f, Fixes::Points | Fixes::Coordinate(..)))
                || has(|f| *f == Fixes::Line) && has(|f| *f == Fixes::Direction);
            let placed = item.element.own() == 0 || has(|f| *f == Fixes::Contact);
            if !otherwise && is_of_its_bodies(item) && placed {
                item.bodies.iter().filter(|b| !b.is_ground()).for_each(|b| of[b.0].push(k));
                for (a, b) in
                    item.bodies.iter().flat_map(|a| item.bodies.iter().map(move |b| (a, b)))
                {
                    linked[a.0].extend((a != b && !b.is_ground()).then_some(b.0));
                }
            }
        }
        Self { model, size: size(model), of, linked }
    }

    /// The bodies that an equation joins to body `b`.
    pub fn linked(&self, b: usize) -> &[usize] {
        &self.linked[b]
    }
}

/// Whether the laws of a constraint depend only on time and the positions of its own bodies.
fn is_of_its_bodies(item: &ConstraintItem) -> bool {
    let mut depends = Dependence::default();
    if let Some(law) = &item.law {
        law.visit(&mut |tape| depends.add(tape));
    }
    depends.internals.is_empty() && depends.bodies.iter().all(|body| item.bodies.contains(body))
}
