//! The scalar itself, and the record that its expressions belong to.

use super::arena::{Arena, Id, Node, Pair, Rate, Symbol, NAN, ONE, ZERO};
use super::derivative::{By, Derivation};
use super::function::Function;
use super::name::{Axis, Kind, Name};
use super::style::Form;
use crate::math::Real;
use std::cell::{Cell, RefCell};
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

thread_local! {
    /// The arenas of the records under way; a nested record hides the outer one.
    static ARENAS: RefCell<Vec<(u32, Arena)>> = const { RefCell::new(Vec::new()) };
    static RECORDS: Cell<u32> = const { Cell::new(0) };
}

/// An expression: an index into the arena of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Symbolic {
    record: u32,
    node: Id,
}

/// Calls `body` with an arena of its own. Records may be nested; the inner one cannot see the
/// expressions of the outer one.
pub fn record<T>(body: impl FnOnce(&Record) -> T) -> T {
    /// Frees the arena, also where `body` panics.
    struct Freed;
    impl Drop for Freed {
        fn drop(&mut self) {
            ARENAS.with_borrow_mut(|arenas| arenas.pop());
        }
    }
    let number = RECORDS.get().wrapping_add(1).max(1);
    RECORDS.set(number);
    ARENAS.with_borrow_mut(|arenas| arenas.push((number, Arena::new())));
    let _freed = Freed;
    body(&Record { number, here: PhantomData })
}

/// Runs `f` on the current arena; NaN where there is none.
fn with(f: impl FnOnce(&mut Arena, &dyn Fn(Symbolic) -> Id) -> Id) -> Symbolic {
    ARENAS.with_borrow_mut(|arenas| match arenas.last_mut() {
        None => Symbolic { record: 0, node: NAN },
        Some((number, arena)) => {
            let record = *number;
            let own = |x: Symbolic| if x.record == record { x.node } else { NAN };
            Symbolic { record, node: f(arena, &own) }
        }
    })
}

/// The value of a constant expression.
fn constant(x: Symbolic) -> Option<f64> {
    ARENAS.with_borrow(|arenas| match arenas.last() {
        Some((number, arena)) if *number == x.record => arena.constant(x.node),
        _ => Some(f64::NAN),
    })
}

/// A record under way. It stays on its thread.
#[derive(Debug)]
pub struct Record {
    number: u32,
    here: PhantomData<*const ()>,
}

/// Equations Φ = 0 with their derivatives.
#[derive(Clone, Debug)]
pub struct Differentiated {
    /// Φ.
    pub residual: Vec<Symbolic>,
    /// ∂Φ/∂q, a row for each equation.
    pub jacobian: Vec<Vec<Symbolic>>,
    /// γ = -d²Φ/dt² at q̈ = 0.
    pub gamma: Vec<Symbolic>,
}

impl Record {
    fn with<T>(&self, none: T, f: impl FnOnce(&mut Arena) -> T) -> T {
        ARENAS.with_borrow_mut(|arenas| match arenas.last_mut() {
            Some((number, arena)) if *number == self.number => f(arena),
            _ => none, // this record is hidden by a nested one
        })
    }

    fn own(&self, x: Symbolic) -> Id {
        if x.record == self.number {
            x.node
        } else {
            NAN
        }
    }

    fn of(&self, node: Id) -> Symbolic {
        Symbolic { record: self.number, node }
    }

    /// A constant with a name.
    pub fn symbol(&self, name: Name) -> Symbolic {
        self.changing(name, Symbolic::zero())
    }

    /// A quantity with a name and its rate.
    pub fn changing(&self, name: Name, rate: Symbolic) -> Symbolic {
        let rate = Rate::Is(self.own(rate));
        self.of(self.with(NAN, |arena| arena.symbol(Symbol { name, rate, definition: None })))
    }

    /// Time.
    pub fn time(&self) -> Symbolic {
        self.changing(Name::time(), Symbolic::one())
    }

    /// Two constants are the components of a vector fixed in a body. The vector in the global frame
    /// is written with the name `turned`, for the three forms.
    pub fn vector(&self, x: Symbolic, y: Symbolic, turned: [String; 3], owner: Option<usize>) {
        let (x, y) = (self.own(x), self.own(y));
        self.with((), |arena| {
            let first = format!("{}.", turned[0]);
            let taken = arena.symbols.iter().any(|symbol| symbol.name.text.starts_with(&first));
            let [text, unicode, latex] = turned;
            let turned = [if taken { text + "_" } else { text }, unicode, latex];
            arena.pairs.push(Pair { x, y, turned, owner, angles: Vec::new() });
        });
    }

    /// Φ with its parts named, ∂Φ/∂q and γ.
    pub fn differentiate(&self, residual: &[Symbolic], unknowns: &[Symbolic]) -> Differentiated {
        let roots: Vec<Id> = residual.iter().map(|x| self.own(*x)).collect();
        let unknowns: Vec<Id> = unknowns.iter().map(|x| self.own(*x)).collect();
        let empty = (Vec::new(), Vec::new(), Vec::new());
        let (residual, jacobian, gamma) = self.with(empty, |arena| {
            let named = arena.name_parts(&roots);
            let mut by_time = Derivation::new(By::Time);
            let mut by: Vec<Derivation> =
                unknowns.iter().map(|q| Derivation::new(By::Symbol(*q))).collect();
            let (mut rows, mut gamma) = (Vec::new(), Vec::new());
            for phi in &named {
                let row = by.iter_mut().map(|by| by.of(arena, *phi)).collect::<Vec<_>>();
                rows.push(row.into_iter().map(|entry| arena.simplest(entry)).collect::<Vec<_>>());
                let rate = by_time.of(arena, *phi);
                let second = by_time.of(arena, rate);
                let opposite = arena.sum(vec![(second, -1.0)]);
                gamma.push(arena.simplest(opposite));
            }
            let residual = named.into_iter().map(|phi| arena.simplest(phi)).collect::<Vec<_>>();
            (residual, rows, gamma)
        });
        let out = |ids: Vec<Id>| ids.into_iter().map(|id| self.of(id)).collect();
        Differentiated {
            residual: out(residual),
            jacobian: jacobian.into_iter().map(out).collect(),
            gamma: out(gamma),
        }
    }

    /// The text of an expression.
    pub fn write(&self, x: Symbolic, form: Form) -> String {
        let id = self.own(x);
        self.with(String::new(), |arena| arena.write(id, form))
    }

    /// Names and texts of the parts that expressions are written with, turned
    /// vectors first, rates last.
    pub fn definitions(&self, of: &[Symbolic], form: Form) -> Vec<(String, String)> {
        let roots: Vec<Id> = of.iter().map(|x| self.own(*x)).collect();
        self.with(Vec::new(), |arena| {
            let mut order = Vec::new();
            roots.iter().for_each(|root| arena.needed(*root, &mut order));
            order.sort_by_cached_key(|id| arena.definition_key(*id));
            order.into_iter().map(|id| (arena.write(id, form), arena.meaning(id, form))).collect()
        })
    }

    /// The names that occur in expressions and in the parts that they are written with.
    pub fn names(&self, of: &[Symbolic]) -> Vec<String> {
        let roots: Vec<Id> = of.iter().map(|x| self.own(*x)).collect();
        self.with(Vec::new(), |arena| {
            let mut names = Vec::new();
            roots.iter().for_each(|root| arena.collect_names(*root, &mut names));
            names
        })
    }
}

impl Arena {
    /// The shorter of an expression as it is and with its terms collected.
    fn simplest(&mut self, id: Id) -> Id {
        let collected = self.collected(id);
        let [now, then] = [id, collected].map(|id| self.write(id, Form::Expression).len());
        if then < now {
            collected
        } else {
            id
        }
    }

    /// Parts with a name in an expression, each after those in its own definition.
    fn needed(&self, id: Id, order: &mut Vec<Id>) {
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

    /// Parts that are made of no other part first, and the components of a vector side by side.
    fn definition_key(&mut self, id: Id) -> (usize, bool, String) {
        let rate = self.symbol_of(id).is_some_and(|symbol| {
            symbol.name.kind == Kind::Part && matches!(symbol.rate, Rate::Inline)
        });
        (self.depth(id), rate, self.write(id, Form::Expression))
    }

    /// How many named parts stand on each other in an expression.
    fn depth(&self, id: Id) -> usize {
        let definition = self.symbol_of(id).and_then(|symbol| symbol.definition);
        let named = definition.is_some() || matches!(self.node(id), Node::Turned { .. });
        let inner = definition.into_iter().chain(self.parts(id)).map(|part| self.depth(part));
        inner.max().unwrap_or(0) + usize::from(named)
    }

    /// What the name of a part stands for.
    fn meaning(&mut self, id: Id, form: Form) -> String {
        if let Node::Turned { pair, angle, axis } = *self.node(id) {
            let Pair { x, y, .. } = self.pairs[pair];
            let [cos, sin] = [Function::Cos, Function::Sin]
                .map(|function| self.add(Node::Call(function, vec![angle])));
            let (first, second, sign) = match axis {
                Axis::X => (x, y, form.minus()),
                Axis::Y => (y, x, "+"),
            };
            let terms = match axis {
                Axis::X => [(first, cos), (second, sin)],
                Axis::Y => [(second, sin), (first, cos)],
            };
            let [a, b] = terms.map(|(component, turn)| {
                let product = self.product(1.0, vec![(component, 1.0), (turn, 1.0)]);
                self.write(product, form)
            });
            return format!("{a} {sign} {b}");
        }
        match self.symbol_of(id).and_then(|symbol| symbol.definition) {
            Some(definition) => self.write(definition, form),
            None => self.write(id, form),
        }
    }

    fn collect_names(&self, id: Id, names: &mut Vec<String>) {
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

fn call(function: Function, x: Symbolic) -> Symbolic {
    with(|arena, own| arena.call(function, &[own(x)]))
}

impl Add for Symbolic {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        with(|arena, own| arena.sum(vec![(own(self), 1.0), (own(o), 1.0)]))
    }
}
impl Sub for Symbolic {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        with(|arena, own| arena.sum(vec![(own(self), 1.0), (own(o), -1.0)]))
    }
}
impl Mul for Symbolic {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        with(|arena, own| arena.multiply(own(self), own(o)))
    }
}
impl Div for Symbolic {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        with(|arena, own| {
            let inverse = arena.power(own(o), -1.0);
            arena.multiply(own(self), inverse)
        })
    }
}
impl Neg for Symbolic {
    type Output = Self;
    fn neg(self) -> Self {
        with(|arena, own| arena.sum(vec![(own(self), -1.0)]))
    }
}
impl AddAssign for Symbolic {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl SubAssign for Symbolic {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl Real for Symbolic {
    fn constant(x: f64) -> Self {
        with(|arena, _| match x {
            0.0 => ZERO,
            1.0 => ONE,
            _ => arena.number(x),
        })
    }
    fn sin_cos(self) -> (Self, Self) {
        (call(Function::Sin, self), call(Function::Cos, self))
    }
    fn tan(self) -> Self {
        call(Function::Tan, self)
    }
    fn sqrt(self) -> Self {
        self.powc(0.5)
    }
    fn exp(self) -> Self {
        call(Function::Exp, self)
    }
    fn ln(self) -> Self {
        call(Function::Ln, self)
    }
    fn asin(self) -> Self {
        call(Function::Asin, self)
    }
    fn acos(self) -> Self {
        call(Function::Acos, self)
    }
    fn atan(self) -> Self {
        call(Function::Atan, self)
    }
    fn atan2(self, x: Self) -> Self {
        with(|arena, own| arena.call(Function::Atan2, &[own(self), own(x)]))
    }
    fn sinh(self) -> Self {
        call(Function::Sinh, self)
    }
    fn cosh(self) -> Self {
        call(Function::Cosh, self)
    }
    fn tanh(self) -> Self {
        call(Function::Tanh, self)
    }
    fn powc(self, exponent: f64) -> Self {
        with(|arena, own| arena.power(own(self), exponent))
    }
    fn pow(self, exponent: Self) -> Self {
        match constant(exponent) {
            Some(exponent) => self.powc(exponent),
            None => with(|arena, own| arena.call(Function::Power, &[own(self), own(exponent)])),
        }
    }
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        with(|arena, own| arena.select(own(condition), own(positive), own(otherwise)))
    }
    fn floor(self) -> Self {
        call(Function::Floor, self)
    }
    /// That of a constant; 1 for all other expressions.
    fn least_magnitude(self) -> f64 {
        constant(self).map_or(1.0, f64::abs)
    }
    /// That of a constant; 1 for all other expressions.
    fn largest_magnitude(self) -> f64 {
        self.least_magnitude()
    }
    /// Whether a constant is finite; true for all other expressions.
    fn is_finite(self) -> bool {
        constant(self).is_none_or(f64::is_finite)
    }
}
