//! Choices by the sign of an expression.

use super::arena::{Arena, Id, Node, ONE, ZERO};
use super::function::Function::{Abs, Floor, Max, Min, Sign, Step};

impl Arena {
    /// `positive` where `condition` > 0, otherwise `otherwise`.
    pub fn select(&mut self, condition: Id, positive: Id, otherwise: Id) -> Id {
        if let Some(x) = self.constant(condition) {
            return if x > 0.0 { positive } else { otherwise };
        }
        if positive == otherwise {
            return positive;
        }
        if let Node::Select([inner, negative, zero]) = *self.node(otherwise) {
            let opposite = self.sum(vec![(condition, -1.0)]);
            if inner == opposite {
                return self.by_sign(condition, [positive, negative, zero]);
            }
        }
        self.add(Node::Select([condition, positive, otherwise]))
    }

    /// Three values for d > 0, d < 0 and d = 0.
    fn by_sign(&mut self, d: Id, [positive, negative, zero]: [Id; 3]) -> Id {
        // where d is zero, so is floor(d)
        let floor = self.call(Floor, &[d]);
        let zero = match self.terms(zero).contains(&(floor, 1.0)) {
            true => self.sum(vec![(zero, 1.0), (floor, -1.0)]),
            false => zero,
        };
        if zero == negative {
            return self.select(d, positive, negative);
        }
        let opposite = self.sum(vec![(d, -1.0)]);
        if zero == positive {
            return self.select(opposite, negative, positive);
        }
        let difference = self.sum(vec![(positive, 1.0), (negative, -1.0)]);
        let mean = self.sum(vec![(positive, 0.5), (negative, 0.5)]);
        if difference == d && mean == zero {
            return self.larger(positive, negative);
        }
        let minus_one = self.number(-1.0);
        match [positive, negative, zero] {
            [ONE, n, ZERO] if n == minus_one => self.call(Sign, &[d]),
            [ONE, ZERO, ONE] => self.call(Step, &[d]),
            _ => {
                let inner = self.add(Node::Select([opposite, negative, zero]));
                self.add(Node::Select([d, positive, inner]))
            }
        }
    }

    /// The larger of two expressions, written as an absolute value or a minimum if possible.
    fn larger(&mut self, a: Id, b: Id) -> Id {
        let opposite = self.sum(vec![(a, -1.0)]);
        if opposite == b {
            return self.call(Abs, &[a]);
        }
        let negative = |arena: &Self, id| arena.terms(id).iter().all(|(_, c)| *c < 0.0);
        if negative(self, a) && negative(self, b) {
            let other = self.sum(vec![(b, -1.0)]);
            let smaller = self.call(Min, &[opposite, other]);
            return self.sum(vec![(smaller, -1.0)]);
        }
        self.call(Max, &[a, b])
    }
}
