//! Identities that replace two terms of a sum by one: of sine and cosine, and of turned vectors.

use super::algebra::List;
use super::arena::{Arena, Id, Node};
use super::function::Function::{self, Cos, Sin};
use super::name::Axis;
use crate::math::Listed;

impl Arena {
    /// The terms with two of them replaced by one term; `None` if no identity applies.
    pub fn reduce(&mut self, terms: &[(Id, f64)]) -> Option<List> {
        for k in 1..terms.len() {
            for l in 0..k {
                let joined =
                    self.join(terms[k], terms[l]).or_else(|| self.join(terms[l], terms[k]));
                if let Some(joined) = joined {
                    let others = terms.iter().enumerate().filter(|(at, _)| *at != k && *at != l);
                    let mut left: List = others.map(|(_, term)| *term).list();
                    left.extend(self.terms(joined));
                    return Some(left);
                }
            }
        }
        None
    }

    /// c₁·first + c₂·second as one product, if an identity applies.
    fn join(&mut self, (first, c1): (Id, f64), (second, c2): (Id, f64)) -> Option<Id> {
        if c1.abs() != c2.abs() {
            return None;
        }
        let (a, b) = (self.factors(first).1, self.factors(second).1);
        let common = shared(&a, &b);
        let (a, b) = (without(&a, &common), without(&b, &common));
        let replacement = self.identity(&a, &b, c1 == c2, c1)?;
        let (c, factors) = self.factors(replacement);
        let mut all = common;
        all.extend(factors);
        Some(self.product(c1 * c, all))
    }

    /// a + b, or a - b where `same` is false, as one expression; it will be multiplied by `c`.
    fn identity(&mut self, a: &[(Id, f64)], b: &[(Id, f64)], same: bool, c: f64) -> Option<Id> {
        match (a, b) {
            // cos² + sin²
            ([(x, 2.0)], [(y, 2.0)]) if same => {
                let ((f, alpha), (g, beta)) = (self.trigonometric(*x)?, self.trigonometric(*y)?);
                (f == Cos && g == Sin && alpha == beta).then(|| self.number(1.0))
            }
            // 1 - sin², 1 - cos²
            ([], [(y, 2.0)]) if !same => {
                let (g, beta) = self.trigonometric(*y)?;
                let other = self.call(if g == Sin { Cos } else { Sin }, &[beta]);
                Some(self.power(other, 2.0))
            }
            ([(p, 1.0), (q, 1.0)], [(r, 1.0), (s, 1.0)]) => {
                let orders =
                    [[*p, *q, *r, *s], [*q, *p, *r, *s], [*p, *q, *s, *r], [*q, *p, *s, *r]];
                orders.into_iter().find_map(|order| {
                    self.angle_sum(order, same, c).or_else(|| self.turned(order, same))
                })
            }
            _ => None,
        }
    }

    /// cos α cos β ∓ sin α sin β, sin α cos β ± cos α sin β; -sin(α - β) as sin(β - α).
    fn angle_sum(&mut self, [p, q, r, s]: [Id; 4], same: bool, c: f64) -> Option<Id> {
        let ((f, alpha), (g, beta)) = (self.trigonometric(p)?, self.trigonometric(q)?);
        let ((h, gamma), (k, delta)) = (self.trigonometric(r)?, self.trigonometric(s)?);
        if alpha != gamma || beta != delta || alpha == beta {
            return None;
        }
        let (function, plus) = match (f, g, h, k) {
            (Cos, Cos, Sin, Sin) => (Cos, !same),
            (Sin, Cos, Cos, Sin) => (Sin, same),
            _ => return None,
        };
        let side = if c < 0.0 && function == Sin && !plus { -1.0 } else { 1.0 };
        let angle = self.sum(vec![(alpha, side), (beta, if plus { side } else { -side })]);
        let called = self.call(function, &[angle]);
        Some(self.sum(vec![(called, side)]))
    }

    /// x cos α - y sin α, x sin α + y cos α with a pair of constants (x, y).
    fn turned(&mut self, [p, x, r, y]: [Id; 4], same: bool) -> Option<Id> {
        let ((f, alpha), (g, beta)) = (self.trigonometric(p)?, self.trigonometric(r)?);
        let pair = self.pairs.iter().position(|pair| (pair.x, pair.y) == (x, y))?;
        let axis = match (f, g, same) {
            (Cos, Sin, false) if alpha == beta => Axis::X,
            (Sin, Cos, true) if alpha == beta => Axis::Y,
            _ => return None,
        };
        if !self.pairs[pair].angles.contains(&alpha) {
            self.pairs[pair].angles.push(alpha);
        }
        Some(self.add(Node::Turned { pair, angle: alpha, axis }))
    }

    /// Sine or cosine, and its angle.
    fn trigonometric(&self, id: Id) -> Option<(Function, Id)> {
        match self.node(id) {
            Node::Call(function @ (Sin | Cos), arguments) => Some((*function, arguments[0])),
            _ => None,
        }
    }
}

/// The factors that two products have in common.
fn shared(a: &[(Id, f64)], b: &[(Id, f64)]) -> List {
    let exponent = |id| b.iter().find(|(other, _)| *other == id).map(|(_, e)| *e);
    let common = |(id, e): &(Id, f64)| {
        let other = exponent(*id)?;
        (e.signum() == other.signum())
            .then(|| (*id, if e.abs() < other.abs() { *e } else { other }))
    };
    a.iter().filter_map(common).list()
}

/// A product without some of its factors.
fn without(a: &[(Id, f64)], common: &[(Id, f64)]) -> List {
    let taken = |id| common.iter().find(|(other, _)| *other == id).map_or(0.0, |(_, e)| *e);
    a.iter().map(|(id, e)| (*id, e - taken(*id))).filter(|(_, e)| *e != 0.0).list()
}
