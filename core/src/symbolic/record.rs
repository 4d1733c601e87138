//! The record that expressions belong to.

use super::arena::{Arena, Id, Pair, Rate, Symbol, NAN, ONE, ZERO};
use super::derivative::{By, Derivation};
use super::name::Name;
use super::style::Form;
use crate::expression::{self, Tape};
use crate::math::{Listed, Ordered};
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::marker::PhantomData;

thread_local! {
    /// The arenas of the current records; a nested record hides the outer one.
    static ARENAS: RefCell<Vec<(u32, Arena)>> = const { RefCell::new(Vec::new()) };
    static RECORDS: Cell<u32> = const { Cell::new(0) };
}

/// An expression: an index into the arena of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Symbolic {
    record: u32,
    node: Id,
}

/// Calls `body` with its own arena. Records may be nested, but an inner record cannot use the expressions of an outer
/// record.
pub fn record<T>(body: impl FnOnce(&Record) -> T) -> T {
    /// Frees the arena, even if `body` panics.
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

/// Runs `f` on the current arena. The result is NaN if there is no arena.
pub(super) fn with(f: impl FnOnce(&mut Arena, &dyn Fn(Symbolic) -> Id) -> Id) -> Symbolic {
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
pub(super) fn constant(x: Symbolic) -> Option<f64> {
    ARENAS.with_borrow(|arenas| match arenas.last() {
        Some((number, arena)) if *number == x.record => arena.constant(x.node),
        _ => Some(f64::NAN),
    })
}

/// A current record, which belongs to its thread.
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
        self.changing(name, self.of(ZERO))
    }

    /// A quantity with a name and its rate.
    pub fn changing(&self, name: Name, rate: Symbolic) -> Symbolic {
        let rate = Rate::Is(self.own(rate));
        self.of(self.with(NAN, |arena| arena.symbol(Symbol { name, rate, definition: None })))
    }

    /// A named function of `variable` with the derivative `slope`.
    pub fn along(&self, name: Name, variable: Symbolic, slope: Symbolic) -> Symbolic {
        let rate = Rate::Along(self.own(variable), self.own(slope));
        self.of(self.with(NAN, |arena| arena.symbol(Symbol { name, rate, definition: None })))
    }

    /// Time.
    pub fn time(&self) -> Symbolic {
        self.changing(Name::time(), self.of(ONE))
    }

    /// Declares two constants as the components of a vector fixed in a body. In the global frame, the vector is
    /// written with the name `turned`, given in the three forms.
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
        let roots: Vec<Id> = residual.iter().map(|x| self.own(*x)).list();
        let unknowns: Vec<Id> = unknowns.iter().map(|x| self.own(*x)).list();
        let empty = (Vec::new(), Vec::new(), Vec::new());
        let (residual, jacobian, gamma) = self.with(empty, |arena| {
            let named = arena.name_parts(&roots);
            let mut by_time = Derivation::new(By::Time);
            let mut by: Vec<Derivation> =
                unknowns.iter().map(|q| Derivation::new(By::Symbol(*q))).list();
            let (mut rows, mut gamma) = (Vec::new(), Vec::new());
            for phi in &named {
                let row = by.iter_mut().map(|by| by.of(arena, *phi)).list();
                rows.push(row.into_iter().map(|entry| arena.simplest(entry)).list());
                let rate = by_time.of(arena, *phi);
                let second = by_time.of(arena, rate);
                let opposite = arena.sum(vec![(second, -1.0)]);
                gamma.push(arena.simplest(opposite));
            }
            let residual = named.into_iter().map(|phi| arena.simplest(phi)).list();
            (residual, rows, gamma)
        });
        let out = |ids: Vec<Id>| ids.into_iter().map(|id| self.of(id)).list();
        Differentiated {
            residual: out(residual),
            jacobian: jacobian.into_iter().map(out).list(),
            gamma: out(gamma),
        }
    }

    /// The derivative of an expression with respect to a symbol.
    pub fn derivative(&self, x: Symbolic, symbol: Symbolic) -> Symbolic {
        self.derived(x, By::Symbol(self.own(symbol)))
    }

    /// The time derivative of an expression.
    pub fn rate(&self, x: Symbolic) -> Symbolic {
        self.derived(x, By::Time)
    }

    fn derived(&self, x: Symbolic, by: By) -> Symbolic {
        let x = self.own(x);
        self.of(self.with(NAN, |arena| Derivation::new(by).of(arena, x)))
    }

    /// The text of an expression.
    pub fn write(&self, x: Symbolic, form: Form) -> String {
        let id = self.own(x);
        self.with(String::new(), |arena| arena.write(id, form))
    }

    /// An expression as a tape; `symbols` maps names to symbols of the tape.
    pub fn tape(&self, x: Symbolic, symbols: &[(Symbolic, expression::Symbol)]) -> Tape {
        let known: HashMap<Id, expression::Symbol> =
            symbols.iter().map(|(x, symbol)| (self.own(*x), *symbol)).collect();
        let (root, none) = (self.own(x), Tape::from(f64::NAN));
        self.with(none, |arena| arena.tape(root, &|id| known.get(&id).copied()))
    }

    /// Names and definitions of the named parts of expressions, turned vectors first, rates last.
    pub fn definitions(&self, of: &[Symbolic], form: Form) -> Vec<(String, String)> {
        let roots: Vec<Id> = of.iter().map(|x| self.own(*x)).list();
        self.with(Vec::new(), |arena| {
            let mut order = Vec::new();
            roots.iter().for_each(|root| arena.needed(*root, &mut order));
            order.order_by_key(|id| arena.definition_key(*id));
            order.into_iter().map(|id| (arena.write(id, form), arena.meaning(id, form))).list()
        })
    }

    /// The names that occur in expressions and in the definitions of their named parts.
    pub fn names(&self, of: &[Symbolic]) -> Vec<String> {
        let roots: Vec<Id> = of.iter().map(|x| self.own(*x)).list();
        self.with(Vec::new(), |arena| {
            let mut names = Vec::new();
            roots.iter().for_each(|root| arena.collect_names(*root, &mut names));
            names
        })
    }
}
