//! Definitions of the named parts that occur in written expressions.

use super::arena::{Arena, Id, Node, Pair, Rate};
use super::function::Function;
use super::name::{Axis, NameKind};
use super::style::Form;
use crate::math::{each, ShortArray};

impl Arena {
    /// Appends the named parts of an expression to `order`, each after the parts in its definition.
    pub fn needed(&self, id: Id, order: &mut Vec<Id>) {
        if order.contains(&id) {
            return;
        }
        let definition = self.symbol_of(id).and_then(|symbol| symbol.definition);
        for part in definition.into_iter().chain(self.parts(id)) {
            self.needed(part, order);
        }
        if definition.is_some() || matches!(self.node(id), Node::Turned { .. }) {
            order.push(id);
        }
    }

    /// The sort key of a definition. Parts that contain no other part come first, and the components of a vector are
    /// adjacent.
    pub fn definition_key(&mut self, id: Id) -> (usize, bool, String) {
        let rate = self.symbol_of(id).is_some_and(|symbol| {
            symbol.name.kind == NameKind::Part && matches!(symbol.rate, Rate::Inline)
        });
        (self.depth(id), rate, self.write(id, Form::Expression))
    }

    /// The nesting depth of named parts in an expression.
    fn depth(&self, id: Id) -> usize {
        let definition = self.symbol_of(id).and_then(|symbol| symbol.definition);
        let named = definition.is_some() || matches!(self.node(id), Node::Turned { .. });
        let inner = definition.into_iter().chain(self.parts(id)).map(|part| self.depth(part));
        inner.max().unwrap_or(0) + usize::from(named)
    }

    /// The meaning of the name of a part.
    pub fn meaning(&mut self, id: Id, form: Form) -> String {
        if let Node::Turned { pair, angle, axis } = *self.node(id) {
            let Pair { x, y, .. } = self.pairs[pair];
            let [cos, sin] = each([Function::Cos, Function::Sin], |function| {
                self.add(Node::Call(function, vec![angle]))
            });
            let (first, sign, second) = match axis {
                Axis::X => ([x, cos], form.minus(), [y, sin]),
                Axis::Y => ([x, sin], "+", [y, cos]),
            };
            let [first, second] = [first, second].each(|[component, turn]| {
                let product = self.product(1.0, vec![(component, 1.0), (turn, 1.0)]);
                self.write(product, form)
            });
            return format!("{first} {sign} {second}");
        }
        match self.symbol_of(id).and_then(|symbol| symbol.definition) {
            Some(definition) => self.write(definition, form),
            None => self.write(id, form),
        }
    }

    pub fn collect_names(&self, id: Id, names: &mut Vec<String>) {
        if let Node::Turned { pair, .. } = self.node(id) {
            let Pair { x, y, .. } = self.pairs[*pair];
            [x, y].into_iter().for_each(|id| self.collect_names(id, names));
        }
        if let Some(symbol) = self.symbol_of(id) {
            match symbol.definition {
                Some(definition) => self.collect_names(definition, names),
                None if !names.contains(&symbol.name.text) => names.push(symbol.name.text.clone()),
                None => {}
            }
        }
        self.parts(id).into_iter().for_each(|part| self.collect_names(part, names));
    }
}
