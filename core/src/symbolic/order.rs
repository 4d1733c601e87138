//! The order in which terms and factors are written.

use super::algebra::List;
use super::arena::{Arena, Id, Node};

impl Arena {
    /// The terms of a sum: those of one body side by side, bodies with a positive first term first,
    /// simple terms before long ones, what belongs to no body last.
    pub fn ordered_terms(&mut self, sum: Id) -> List {
        let mut groups: Vec<(Option<usize>, List)> = Vec::new();
        for term in self.terms(sum) {
            let owner = self.owner(term.0);
            match groups.iter_mut().find(|(known, _)| *known == owner) {
                Some((_, terms)) => terms.push(term),
                None => groups.push((owner, vec![term])),
            }
        }
        for (_, terms) in &mut groups {
            terms.sort_by_key(|(id, c)| self.term_key(*id, *c));
        }
        groups.sort_by_key(|(owner, terms)| (terms[0].1 < 0.0, owner.unwrap_or(usize::MAX)));
        // no sum begins with a minus sign if one of its terms is positive
        let mut all: List = groups.into_iter().flat_map(|(_, terms)| terms).collect();
        if let Some(at) = all.iter().position(|(_, c)| *c > 0.0) {
            all[..=at].rotate_right(1);
        }
        all
    }

    /// Constants last, then by the number of factors, positive terms first.
    fn term_key(&mut self, id: Id, c: f64) -> (bool, usize, bool, u8, Id) {
        let (_, factors) = self.factors(id);
        let rank = factors.iter().map(|(base, _)| self.rank(*base)).max().unwrap_or(0);
        (factors.is_empty(), factors.len(), c < 0.0, rank, id)
    }

    /// Factors: scalars first, brackets last.
    pub fn ordered_factors(&self, mut factors: List) -> List {
        factors.sort_by_key(|(base, _)| (self.rank(*base), self.owner(*base), *base));
        factors
    }

    fn rank(&self, id: Id) -> u8 {
        match self.node(id) {
            Node::Number(_) => 0,
            Node::Symbol(k) => 1 + self.symbols[*k].name.kind as u8,
            Node::Call(..) => 8,
            Node::Turned { .. } => 9,
            Node::Product(_) => 10,
            Node::Sum(_) => 11,
            Node::Select(_) => 12,
        }
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
