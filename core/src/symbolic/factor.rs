//! The expansion of products of sums, and the extraction of common factors.

use super::algebra::List;
use super::arena::{Arena, Id, Node, ONE};
use super::name::NameKind;
use super::style::Form;
use crate::math::{each, Listed};

/// Largest number of terms up to which products of sums are expanded.
const MOST_TERMS: usize = 200;

impl Arena {
    /// The shorter of an expression and its form with collected terms.
    pub fn simplest(&mut self, id: Id) -> Id {
        let collected = self.collected(id);
        let [now, then] = each([id, collected], |id| self.write(id, Form::Expression).len());
        if then < now {
            collected
        } else {
            id
        }
    }

    /// The expression with like terms merged across brackets and common factors extracted.
    fn collected(&mut self, id: Id) -> Id {
        let (c, factors) = self.factors(id);
        let mut made = self.number(c);
        for (base, e) in factors {
            let base = match self.is_sum(base) {
                true => {
                    let expanded = self.expanded(base);
                    let terms = self.sum(expanded);
                    self.factored(terms)
                }
                false => base,
            };
            let power = self.power(base, e);
            made = self.multiply(made, power);
        }
        made
    }

    /// The terms of a sum, with the products of sums expanded.
    fn expanded(&mut self, sum: Id) -> List {
        let mut all = List::new();
        for (term, c) in self.terms(sum) {
            let products = self.distributed(term);
            products.into_iter().map(|(id, k)| (id, c * k)).append_to(&mut all);
        }
        all
    }

    /// A product as a sum of products.
    fn distributed(&mut self, product: Id) -> List {
        let (c, factors) = self.factors(product);
        let mut terms = vec![(ONE, c)];
        for (base, e) in factors {
            let whole = e == e.round() && (1.0..=3.0).contains(&e);
            if !(whole && self.is_sum(base)) {
                let power = self.power(base, e);
                terms = self.times(&terms, &[(power, 1.0)]);
                continue;
            }
            let inner = self.expanded(base);
            for _ in 0..e as usize {
                if terms.len() * inner.len() > MOST_TERMS {
                    return vec![(product, 1.0)];
                }
                terms = self.times(&terms, &inner);
            }
        }
        terms
    }

    fn times(&mut self, left: &[(Id, f64)], right: &[(Id, f64)]) -> List {
        let mut all = List::new();
        for (a, c) in left {
            for (b, d) in right {
                all.push((self.multiply(*a, *b), c * d));
            }
        }
        all
    }

    /// A sum with common factors extracted: scalars before components of vectors, and the most frequent factors
    /// first.
    fn factored(&mut self, sum: Id) -> Id {
        if !self.is_sum(sum) {
            return sum;
        }
        let terms = self.terms(sum);
        let products: Vec<List> = terms.iter().map(|(term, _)| self.factors(*term).1).list();
        let Some(common) = self.most_common(&products) else { return sum };
        let (mut inside, mut others) = (List::new(), List::new());
        for ((term, c), factors) in terms.into_iter().zip(&products) {
            if factors.contains(&common) {
                let rest = factors.iter().filter(|f| **f != common).copied().list();
                inside.push((self.product(c, rest), 1.0));
            } else {
                others.push((term, c));
            }
        }
        let inside = self.sum(inside);
        let inside = self.factored(inside);
        let others = self.sum(others);
        let others = self.factored(others);
        let power = self.power(common.0, common.1);
        let product = self.multiply(power, inside);
        self.sum(vec![(product, 1.0), (others, 1.0)])
    }

    /// The factor to extract from a sum of products.
    fn most_common(&self, products: &[List]) -> Option<(Id, f64)> {
        let mut best: Option<((Id, f64), (bool, usize))> = None;
        for factor in products.iter().flatten() {
            let count = products.iter().filter(|factors| factors.contains(factor)).count();
            let rank = (self.is_scalar(*factor), count);
            if count > 1 && best.is_none_or(|(_, known)| rank > known) {
                best = Some((*factor, rank));
            }
        }
        best.map(|(factor, _)| factor)
    }

    fn is_scalar(&self, (base, e): (Id, f64)) -> bool {
        let kind = self.symbol_of(base).map(|symbol| symbol.name.kind);
        e < 0.0
            || matches!(kind, Some(NameKind::Rate | NameKind::Field | NameKind::Time))
            || matches!(self.node(base), Node::Select(_))
    }
}
