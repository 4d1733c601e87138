//! Expressions as text.

use super::algebra::List;
use super::arena::{Arena, Id, Node};
use super::function::Function;
use super::name::{Axis, Name};
use super::number::{digits, fraction};
use super::style::Form;
use crate::math::{Listed, ShortArray};

/// The precedence of the outermost operation of a text.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Power,
    Primary,
}

impl Arena {
    /// The text of an expression.
    pub fn write(&mut self, id: Id, form: Form) -> String {
        self.piece(id, form).0
    }

    fn at_least(&mut self, id: Id, least: Binding, form: Form) -> String {
        let (text, binding) = self.piece(id, form);
        if binding < least {
            form.brackets(&text)
        } else {
            text
        }
    }

    fn piece(&mut self, id: Id, form: Form) -> (String, Binding) {
        match self.node(id).clone() {
            Node::Number(x) if x.get().is_nan() => ("nan".to_string(), Binding::Primary),
            Node::Number(_) => self.signed_product(id, form),
            Node::Symbol(k) => (form.name(&self.symbols[k].name).to_string(), Binding::Primary),
            Node::Turned { pair, angle, axis } => {
                let name = self.turned_name(pair, angle, axis);
                (form.name(&name).to_string(), Binding::Primary)
            }
            Node::Sum(terms) if terms.len() > 1 => (self.sum_text(id, form), Binding::Sum),
            Node::Sum(_) | Node::Product(_) => self.signed_product(id, form),
            Node::Call(Function::Power, parts) => {
                let base = self.at_least(parts[0], Binding::Primary, form);
                let exponent = match form {
                    Form::Latex => self.write(parts[1], form),
                    _ => self.at_least(parts[1], Binding::Primary, form),
                };
                (form.power(&base, &exponent), Binding::Power)
            }
            Node::Call(function, parts) => {
                let parts: Vec<String> = parts.iter().map(|p| self.write(*p, form)).list();
                (form.call(function, &parts), Binding::Primary)
            }
            Node::Select(parts) => (self.select_text(parts, form), Binding::Primary),
            Node::Table { table, order, x } => {
                let x = self.write(x, form);
                (form.table(&self.tables[table], order, &x), Binding::Primary)
            }
        }
    }

    fn select_text(&mut self, [condition, a, b]: [Id; 3], form: Form) -> String {
        let (more, less): (List, List) =
            self.terms(condition).into_iter().partition(|(_, c)| *c > 0.0);
        let less = less.into_iter().map(|(id, c)| (id, -c)).list();
        let sides = [self.sum(more), self.sum(less)];
        let [left, right] = sides.each(|side| self.write(side, form));
        let [a, b] = [a, b].each(|value| self.write(value, form));
        match form {
            Form::Latex => format!(
                "\\begin{{cases}} {a} & {left} > {right} \\\\ {b} & \\text{{else}} \\end{{cases}}"
            ),
            _ => format!("if({left} > {right}, {a}, {b})"),
        }
    }

    fn sum_text(&mut self, id: Id, form: Form) -> String {
        let mut text = String::new();
        for (k, (term, c)) in self.ordered_terms(id).into_iter().enumerate() {
            let (own, mut factors) = self.factors(term);
            let mut c = c * own;
            // a bracket begins with a positive term, and its sign is adapted
            for (base, e) in &mut factors {
                if k > 0 && *e == 1.0 && self.is_sum(*base) && self.begins_negative(*base) {
                    *base = self.sum(vec![(*base, -1.0)]);
                    c = -c;
                }
            }
            match (k, c < 0.0) {
                (0, true) => text.push_str(form.minus()),
                (0, false) => {}
                (_, true) => text += &format!(" {} ", form.minus()),
                (_, false) => text.push_str(" + "),
            }
            text += &self.product_text(c.abs(), factors, form).0;
        }
        text
    }

    /// A product with its sign. A minus sign is moved into a bracket that has a negative term.
    fn signed_product(&mut self, id: Id, form: Form) -> (String, Binding) {
        let (mut c, mut factors) = self.factors(id);
        if c < 0.0 {
            let mixed = factors.iter().position(|(base, e)| {
                *e == 1.0 && self.is_sum(*base) && self.terms(*base).iter().any(|(_, c)| *c < 0.0)
            });
            if let Some(k) = mixed {
                factors[k].0 = self.sum(vec![(factors[k].0, -1.0)]);
                c = -c;
            }
        }
        let (text, binding) = self.product_text(c.abs(), factors, form);
        match c < 0.0 {
            true => (format!("{}{text}", form.minus()), Binding::Sum),
            false => (text, binding),
        }
    }

    /// c·Π baseₖ^eₖ with c ≥ 0, as a quotient if an exponent is negative.
    fn product_text(&mut self, c: f64, factors: List, form: Form) -> (String, Binding) {
        let factors = self.ordered_factors(factors);
        let (above, below): (List, List) = factors.into_iter().partition(|(_, e)| *e > 0.0);
        let (top, bottom) = fraction(c, !below.is_empty(), form.pi(), form.times());
        let mut above = self.power_texts(&above, form);
        let below = self.power_texts(&below, form);
        if top != "1" || above.is_empty() {
            above.insert(0, (top, Binding::Primary));
        }
        let mut under = below;
        if bottom != "1" {
            under.insert(0, (bottom, Binding::Primary));
        }
        if under.is_empty() {
            return joined(above, form);
        }
        let latex = form == Form::Latex;
        let enclosed = |(text, binding): (String, Binding), least: Binding| {
            if binding < least && !latex {
                form.brackets(&text)
            } else {
                text
            }
        };
        let top = enclosed(joined(above, form), Binding::Product);
        let bottom = enclosed(joined(under, form), Binding::Power);
        (form.quotient(&top, &bottom), if latex { Binding::Power } else { Binding::Product })
    }

    /// Each base with the magnitude of its exponent.
    fn power_texts(&mut self, factors: &[(Id, f64)], form: Form) -> Vec<(String, Binding)> {
        let mut texts = Vec::new();
        for (base, e) in factors {
            let e = e.abs();
            if e == 0.5 {
                let inside = self.write(*base, form);
                texts.push((form.root(&inside), Binding::Primary));
            } else if e == 1.0 {
                texts.push(self.piece(*base, form));
            } else {
                let base = self.at_least(*base, Binding::Primary, form);
                texts.push((form.power(&base, &digits(e)), Binding::Power));
            }
        }
        texts
    }

    /// The name of a component of a turned vector.
    pub fn turned_name(&self, pair: usize, angle: Id, axis: Axis) -> Name {
        let pair = &self.pairs[pair];
        let at = pair.angles.iter().position(|known| *known == angle).unwrap_or(0);
        let number = if at == 0 { String::new() } else { (at + 1).to_string() };
        let [text, unicode, latex] = &pair.turned;
        let axis_text = axis.text();
        let mut name = Name::new(
            &format!("{text}{number}.{axis_text}"),
            &format!("{unicode}{number}.{axis_text}"),
            &format!("a_{{{latex}{number},{axis_text}}}"),
            super::name::NameKind::Part,
        );
        name.axis = Some(axis);
        name
    }
}

/// Factors one after another. A sum is put in brackets if there are several factors.
fn joined(mut texts: Vec<(String, Binding)>, form: Form) -> (String, Binding) {
    if texts.len() == 1 {
        return texts.remove(0);
    }
    let enclosed = texts.into_iter().map(|(text, binding)| match binding < Binding::Product {
        true => form.brackets(&text),
        false => text,
    });
    (enclosed.list().join(form.times()), Binding::Product)
}
