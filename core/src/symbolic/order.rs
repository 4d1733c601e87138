//! The order in which terms and factors are written.

use super::algebra::List;
use super::arena::{Arena, Id, Node};
use super::name::{Axis, NameKind};
use crate::math::{Listed, Ordered};

impl Arena {
    /// The terms of a sum in written order. Terms of one body are adjacent, and bodies with a positive first term
    /// come first. No sum begins with a minus sign if one of its terms is positive.
    pub fn ordered_terms(&self, sum: Id) -> List {
        let mut all = self.natural_order(sum);
        if let Some(at) = all.iter().position(|(_, c)| *c > 0.0) {
            all[..=at].rotate_right(1);
        }
        all
    }

    /// Whether the first term of a sum is negative in its natural order.
    pub fn begins_negative(&self, sum: Id) -> bool {
        let mut terms = self.terms(sum);
        terms.order_by_key(|(id, _)| (self.group(*id), self.term_key(*id, 1.0)));
        terms.first().is_some_and(|(_, c)| *c < 0.0)
    }

    fn natural_order(&self, sum: Id) -> List {
        let mut groups: Vec<(usize, List)> = Vec::new();
        for term in self.terms(sum) {
            let group = self.group(term.0);
            match groups.iter_mut().find(|(known, _)| *known == group) {
                Some((_, terms)) => terms.push(term),
                None => groups.push((group, vec![term])),
            }
        }
        for (_, terms) in &mut groups {
            terms.order_by_key(|(id, c)| self.term_key(*id, *c));
        }
        groups.order_by_key(|(group, terms)| (terms[0].1 < 0.0, *group));
        groups.into_iter().flat_map(|(_, terms)| terms).list()
    }

    /// The group of a term: named parts first, then body by body, terms without a body last.
    fn group(&self, id: Id) -> usize {
        let part = |id: Id| {
            self.symbol_of(id).is_some_and(|symbol| matches!(symbol.name.kind, NameKind::Part))
        };
        match self.owner(id) {
            Some(owner) => owner + 1,
            None if part(id) => 0,
            None => usize::MAX,
        }
    }

    /// The sort key of a term in its group: constants last, then by the number of factors, by component, positive
    /// terms first.
    fn term_key(&self, id: Id, c: f64) -> (bool, usize, u8, bool, u8, Id) {
        let factors = match self.node(id) {
            Node::Product(_) => self.ordered_factors(self.plain_factors(id)),
            Node::Number(_) => Vec::new(),
            _ => vec![(id, 1.0)],
        };
        let axis = factors.iter().find_map(|(base, _)| self.component(*base));
        let axis = axis.map_or(2, |axis| axis as u8);
        let rank = |base: &Id| match self.symbol_of(*base).map(|symbol| symbol.name.kind) {
            Some(NameKind::Field) => u8::MAX,
            _ => self.rank(*base),
        };
        let rank = factors.iter().map(|(base, _)| rank(base)).max().unwrap_or(0);
        (factors.is_empty(), factors.len(), axis, c < 0.0, rank, id)
    }

    /// The component of a vector that a name denotes, if any.
    fn component(&self, id: Id) -> Option<Axis> {
        match self.node(id) {
            Node::Symbol(k) => self.symbols[*k].name.axis,
            Node::Turned { axis, .. } => Some(*axis),
            _ => None,
        }
    }

    /// The factors in written order: scalars first, brackets last.
    pub fn ordered_factors(&self, mut factors: List) -> List {
        factors.order_by_key(|(base, _)| (self.rank(*base), self.owner(*base), *base));
        factors
    }

    fn rank(&self, id: Id) -> u8 {
        match self.node(id) {
            _ if self.is_constant(id) => 0,
            Node::Number(_) => 0,
            Node::Symbol(k) => 1 + self.symbols[*k].name.kind as u8,
            Node::Call(..) | Node::Table { .. } => 8,
            Node::Turned { .. } => 9,
            Node::Product(_) => 10,
            Node::Sum(_) => 11,
            Node::Select(_) => 12,
        }
    }

    /// Whether there is no name in an expression.
    fn is_constant(&self, id: Id) -> bool {
        !matches!(self.node(id), Node::Symbol(_) | Node::Turned { .. })
            && self.parts(id).into_iter().all(|part| self.is_constant(part))
    }

    /// The first body that an expression belongs to.
    fn owner(&self, id: Id) -> Option<usize> {
        match self.node(id) {
            Node::Symbol(k) => self.symbols[*k].name.owner,
            Node::Turned { pair, .. } => self.pairs[*pair].owner,
            _ => self.parts(id).into_iter().filter_map(|part| self.owner(part)).min(),
        }
    }
}
