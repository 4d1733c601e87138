//! Sums, products and powers in their normal form.

use super::arena::{Arena, Id, Node, NAN, ONE, ZERO};
use super::function::Function;
use super::number::Bits;
use crate::math::{Listed, Ordered};

/// Terms of a sum with their factors, or bases of a product with their exponents.
pub(super) type List = Vec<(Id, f64)>;

fn read(list: &[(Id, Bits)]) -> List {
    list.iter().map(|(id, x)| (*id, x.get())).list()
}

fn write(list: List) -> Vec<(Id, Bits)> {
    list.into_iter().map(|(id, x)| (id, Bits::of(x))).list()
}

/// Adds the numbers of equal entries and removes entries that cancel.
fn merge(mut list: List) -> List {
    list.order_by_key(|(id, _)| *id);
    let mut merged: Vec<(Id, f64, f64)> = Vec::with_capacity(list.len());
    for (id, x) in list {
        match merged.last_mut() {
            Some((last, sum, largest)) if *last == id => {
                *sum += x;
                *largest = largest.max(x.abs());
            }
            _ => merged.push((id, x, x.abs())),
        }
    }
    let kept = merged.into_iter().filter(|(_, x, largest)| x.abs() > 1e-15 * largest);
    kept.map(|(id, x, _)| (id, x)).list()
}

impl Arena {
    /// An expression as a sum.
    pub fn terms(&self, id: Id) -> List {
        match self.node(id) {
            Node::Sum(terms) => read(terms),
            Node::Number(x) if x.get() == 0.0 => Vec::new(),
            Node::Number(x) => vec![(ONE, x.get())],
            _ => vec![(id, 1.0)],
        }
    }

    /// Whether an expression is a sum of two terms or more.
    pub fn is_sum(&self, id: Id) -> bool {
        matches!(self.node(id), Node::Sum(terms) if terms.len() > 1)
    }

    /// Σ cₖ·termₖ.
    pub fn sum(&mut self, terms: List) -> Id {
        let mut flat = List::new();
        for (id, c) in terms {
            if id == NAN || c.is_nan() {
                return NAN;
            }
            self.terms(id).into_iter().map(|(id, k)| (id, k * c)).append_to(&mut flat);
        }
        let mut terms = merge(flat);
        while let Some(reduced) = self.reduce(&terms) {
            terms = merge(reduced);
        }
        match terms[..] {
            [] => ZERO,
            [(ONE, c)] => self.number(c),
            [(id, 1.0)] => id,
            _ => {
                let sum = self.add(Node::Sum(write(terms)));
                self.name_of(sum)
            }
        }
    }

    /// The name of an expression, if it has one; otherwise the expression itself.
    fn name_of(&self, id: Id) -> Id {
        self.named.get(&id).copied().unwrap_or(id)
    }

    /// An expression as a number times a product.
    pub fn factors(&mut self, id: Id) -> (f64, List) {
        match self.node(id).clone() {
            Node::Number(x) => (x.get(), Vec::new()),
            Node::Product(_) => (1.0, self.plain_factors(id)),
            Node::Sum(terms) if terms.len() == 1 => {
                let (term, c) = (terms[0].0, terms[0].1.get());
                (c, self.factors(term).1)
            }
            Node::Sum(terms) => {
                let (content, rest) = self.content(&read(&terms));
                (content, vec![(rest, 1.0)])
            }
            _ => (1.0, vec![(id, 1.0)]),
        }
    }

    /// The factors of a product.
    pub fn plain_factors(&self, id: Id) -> List {
        match self.node(id) {
            Node::Product(factors) => read(factors),
            _ => vec![(id, 1.0)],
        }
    }

    /// A sum as a number times a sum. The number contains the common magnitude of the factors, if there is one, and
    /// the sign.
    fn content(&mut self, terms: &[(Id, f64)]) -> (f64, Id) {
        let size = terms[0].1.abs();
        let common = terms.iter().all(|(_, c)| c.abs() == size);
        let size = if common { size } else { 1.0 };
        let scaled = |k: f64| Node::Sum(write(terms.iter().map(|(id, c)| (*id, c / k)).list()));
        let (plus, minus) = (self.add(scaled(size)), self.add(scaled(-size)));
        let negative = terms.iter().all(|(_, c)| *c < 0.0);
        if self.signs.contains(&minus) || negative && !self.signs.contains(&plus) {
            self.signs.insert(minus);
            return (-size, self.name_of(minus));
        }
        self.signs.insert(plus);
        (size, self.name_of(plus))
    }

    /// c·Π baseₖ^eₖ; bases are neither numbers nor products, exponents of equal bases are added.
    pub fn product(&mut self, c: f64, factors: List) -> Id {
        let factors = merge(factors);
        let product = match factors[..] {
            [] => return self.number(c),
            [(base, 1.0)] => base,
            _ => self.add(Node::Product(write(factors))),
        };
        if c == 0.0 {
            return ZERO;
        }
        self.sum(vec![(product, c)])
    }

    pub fn multiply(&mut self, a: Id, b: Id) -> Id {
        if a == NAN || b == NAN {
            return NAN;
        }
        // a number times a sum remains a sum
        for (number, other) in [(a, b), (b, a)] {
            if let Some(c) = self.constant(number) {
                return self.sum(vec![(other, c)]);
            }
        }
        let ((c, mut factors), (d, others)) = (self.factors(a), self.factors(b));
        factors.extend(others);
        self.product(c * d, factors)
    }

    /// xᵖ with a constant exponent.
    pub fn power(&mut self, x: Id, exponent: f64) -> Id {
        if exponent == 0.0 {
            return ONE;
        }
        if exponent == 1.0 {
            return x;
        }
        if let Some(c) = self.constant(x) {
            return self.number(c.powf(exponent));
        }
        let whole = exponent == exponent.round();
        let (c, factors) = self.factors(x);
        let single = matches!(factors[..], [(_, e)] if e == 1.0);
        if !whole && (c != 1.0 || !single) {
            return self.product(1.0, vec![(x, exponent)]);
        }
        let raised = factors.into_iter().map(|(base, e)| (base, e * exponent)).list();
        self.product(c.powf(exponent), raised)
    }

    /// A function; sine and tangent are odd, the cosine is even.
    pub fn call(&mut self, function: Function, arguments: &[Id]) -> Id {
        let numbers: Option<Vec<f64>> = arguments.iter().map(|id| self.constant(*id)).collect();
        if let Some(value) = numbers.and_then(|x| function.value(&x)) {
            return self.number(value);
        }
        if let (Function::Sin | Function::Cos | Function::Tan, [x]) = (function, arguments) {
            let sign = self.sign(*x);
            if sign < 0.0 {
                let opposite = self.sum(vec![(*x, -1.0)]);
                let called = self.add(Node::Call(function, vec![opposite]));
                let called = self.name_of(called);
                let k = if function == Function::Cos { 1.0 } else { -1.0 };
                return self.sum(vec![(called, k)]);
            }
        }
        let called = self.add(Node::Call(function, arguments.to_vec()));
        self.name_of(called)
    }

    /// -1 if the opposite expression is to be written.
    fn sign(&mut self, id: Id) -> f64 {
        if let Some(x) = self.constant(id) {
            return x.signum();
        }
        let (c, _) = self.factors(id);
        c.signum()
    }
}
