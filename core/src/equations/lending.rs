//! The choice of the bodies that lend inertia to light bodies, once for each model. `equations/loans.rs` contains the
//! equations.
//!
//! A body lends at most half of its inertia, in equal shares to its light neighbours. A light body that has borrowed
//! enough may lend in turn. A condensed body needs inertia for its one degree of freedom only: a piston needs a point
//! mass, and a link connected to ground needs a point mass that is not at its pin. Ground lends mass at a pin, so
//! that no such link lacks mass.
//!
//! If no body can lend enough, as to the links of a massless dyad, inertia is added to the body that needs it at the
//! fewest coordinates, and lending continues. `equations/take_back.rs` removes the effect of the additions.

use super::added_mass::{self, number, Added};
use super::grounded::Hold;
use super::inertia::{self, Inertia};
use super::loans::{Addition, End, Loan};
use crate::elements::Fixes;
use crate::math::{Local, Real};
use crate::model::{Body, Model, Weighed};
use std::ops::Range;

/// The fraction of its inertia that a body lends.
const LENT: f64 = 0.5;
/// Factor on an added moment of inertia, so that the body can lend.
const AMPLE: f64 = 150.0;

/// The inertia of the bodies in the matrix, and its differences from their own inertia.
#[derive(Clone, Debug)]
pub(super) struct Lent<S> {
    pub loans: Vec<Loan>,
    /// The additions, including those to the internal coordinates of elements.
    pub additions: Vec<Addition>,
    /// Inertia of all bodies with loans and additions, ground first.
    pub bodies: Vec<Weighed<S>>,
    /// Inertia of the moving bodies with loans and additions.
    pub inertias: Vec<Inertia<S>>,
}

/// Chooses the loans to the light bodies of a model. `holds` contains the joint with which each body is condensed.
pub(super) fn lend<S: Real>(model: &Model<S>, added: &[Added], holds: &[Option<Hold>]) -> Lent<S> {
    let mut market = Market::new(model, added, holds);
    while market.round() || market.add() {}
    let Market { loans, mut additions, bodies, mut moved, .. } = market;
    for Loan { borrower, lender, .. } in &loans {
        moved[borrower.body] = true;
        lender.iter().for_each(|lender| moved[lender.body] = true);
    }
    let weight = added_mass::own_mass(&model.bodies);
    let own = model.layout.constraints.iter().flat_map(|slots| slots.own.range());
    additions.extend(own.map(|column| Addition { column, weight }));
    let inertias = inertia::inertias(model, &bodies, &moved);
    Lent { loans, additions, bodies, inertias }
}

/// A joint at which one of two moving bodies can lend to the other.
struct Link<S> {
    constraint: usize,
    rows: Range<usize>,
    ends: [End; 2],
    /// The joint point in the frame of each body; None for an angle.
    points: Option<[Local<S>; 2]>,
}

/// The freedom that a condensed joint leaves to its body.
enum Held<S> {
    /// No joint is condensed, or the freedom may have any direction.
    Free,
    /// The body rotates about this point, in its frame. The loan is that of ground.
    Pin(Local<S>, Loan),
    /// The body translates only.
    Slide,
}

struct Market<'a, S> {
    model: &'a Model<S>,
    added: &'a [Added],
    links: Vec<Link<S>>,
    held: Vec<Held<S>>,
    /// The bodies, with the inertia that they have borrowed and lent.
    bodies: Vec<Weighed<S>>,
    /// Whether a body has enough inertia and may lend.
    sound: Vec<bool>,
    /// The inertia that the bodies at the two ends of each link may lend there.
    shares: Vec<[f64; 2]>,
    loans: Vec<Loan>,
    additions: Vec<Addition>,
    /// Whether an addition has moved the mass centre of a body.
    moved: Vec<bool>,
}

impl<'a, S: Real> Market<'a, S> {
    fn new(model: &'a Model<S>, added: &'a [Added], holds: &[Option<Hold>]) -> Self {
        let n = model.bodies.len();
        let links = if added.iter().any(Added::any) { links(model) } else { Vec::new() };
        let held = holds.iter().enumerate();
        let mut market = Self {
            model,
            added,
            held: held.map(|(body, hold)| held_by(model, body, hold.as_ref())).collect(),
            bodies: model.bodies.iter().map(weighed).collect(),
            sound: vec![false; n],
            shares: vec![[0.0; 2]; links.len()],
            links,
            loans: Vec::new(),
            additions: Vec::new(),
            moved: vec![false; n],
        };
        for (body, added) in added.iter().enumerate().take(n) {
            if body == 0 || !added.any() || market.is_enough(body, &market.bodies[body]) {
                market.accept(body);
            }
        }
        market
    }

    /// Lends to the bodies that then have enough inertia. Returns whether there were any.
    fn round(&mut self) -> bool {
        let waiting = (0..self.sound.len()).filter(|body| !self.sound[*body]);
        let offers = waiting.map(|body| (body, self.offers(body)));
        let accepted: Vec<_> = offers
            .filter(|(body, loans)| self.is_enough(*body, &self.with(*body, loans)))
            .collect();
        accepted.iter().for_each(|(body, loans)| self.borrow(*body, loans));
        accepted.iter().for_each(|(body, _)| self.accept(*body));
        !accepted.is_empty()
    }

    /// Adds inertia to the body that needs it at the fewest coordinates, in addition to its loans. Returns whether
    /// there was one.
    fn add(&mut self) -> bool {
        let waiting = (0..self.sound.len()).filter(|body| !self.sound[*body]);
        let needs = waiting.map(|body| {
            let loans = self.offers(body);
            let needed = self.needed(body, &self.with(body, &loans));
            (body, loans, needed)
        });
        let columns = |needed: &[bool; 2]| 2 * usize::from(needed[0]) + usize::from(needed[1]);
        let Some((body, loans, needed)) = needs.min_by_key(|(.., needed)| columns(needed)) else {
            return false;
        };
        self.borrow(body, &loans);
        let (Added { mass, inertia }, first) =
            (self.added[body], self.model.layout.bodies[body].first);
        let mut add = |column, weight| self.additions.push(Addition { column, weight });
        let own = &mut self.bodies[body];
        if needed[0] {
            *own = with_point(*own, mass, Local::zero());
            self.moved[body] = true;
            (first..first + 2).for_each(|column| add(column, mass));
        }
        if needed[1] {
            own.inertia += S::constant(AMPLE * inertia);
            add(first + 2, AMPLE * inertia);
        }
        self.accept(body);
        true
    }

    fn borrow(&mut self, body: usize, loans: &[(usize, Loan)]) {
        self.bodies[body] = self.with(body, loans);
        for (k, loan) in loans {
            if let Some(lender) = &loan.lender {
                let less = self.changed(self.bodies[lender.body], *k, lender.body, -loan.weight);
                self.bodies[lender.body] = less;
            }
            self.loans.push(loan.clone());
        }
    }

    /// The loans that a body can receive now, with the indices of their links.
    fn offers(&self, body: usize) -> Vec<(usize, Loan)> {
        let of_link = |(k, link): (usize, &Link<S>)| {
            let place = link.ends.iter().position(|end| end.body == body)?;
            let (borrower, lender) = (link.ends[place], link.ends[1 - place]);
            let weight = self.shares[k][1 - place];
            let (constraint, rows) = (link.constraint, link.rows.clone());
            (self.sound[lender.body] && weight > 0.0)
                .then_some((k, Loan { constraint, rows, weight, borrower, lender: Some(lender) }))
        };
        self.links.iter().enumerate().filter_map(of_link).collect()
    }

    fn with(&self, body: usize, loans: &[(usize, Loan)]) -> Weighed<S> {
        let own = self.bodies[body];
        loans.iter().fold(own, |own, (k, loan)| self.changed(own, *k, body, loan.weight))
    }

    /// A body with additional inertia at a link.
    fn changed(&self, own: Weighed<S>, link: usize, body: usize, weight: f64) -> Weighed<S> {
        let Link { ends, points, .. } = &self.links[link];
        match points {
            Some(points) => with_point(own, weight, points[usize::from(ends[1].body == body)]),
            None => Weighed { inertia: own.inertia + S::constant(weight), ..own },
        }
    }

    /// Whether a body has enough inertia.
    fn is_enough(&self, body: usize, own: &Weighed<S>) -> bool {
        self.needed(body, own) == [false; 2]
    }

    /// Whether a body needs mass, and whether it needs a moment of inertia.
    fn needed(&self, body: usize, own: &Weighed<S>) -> [bool; 2] {
        let Added { mass, inertia } = self.added[body];
        let short = |own: S, added: f64| !(number(own) > 0.0 && number(own) >= added);
        match &self.held[body] {
            Held::Slide => [short(own.mass, mass), false],
            Held::Pin(pin, _) => [false, short(about(own, *pin), inertia)],
            Held::Free => {
                let turns = self.model.bodies[body].turns;
                [short(own.mass, mass), turns && short(own.inertia, inertia)]
            }
        }
    }

    /// Marks a body as one that may lend, and divides its shares.
    fn accept(&mut self, body: usize) {
        self.sound[body] = true;
        self.borrow_at_pin(body);
        let place = |link: &Link<S>| link.ends.iter().position(|end| end.body == body);
        let claims = self.links.iter().enumerate().filter_map(|(k, link)| {
            let place = place(link)?;
            self.added[link.ends[1 - place].body].any().then_some((k, place))
        });
        let claims: Vec<(usize, usize)> = claims.collect();
        for (k, place) in &claims {
            let point = self.links[*k].points.map(|points| points[*place]);
            self.shares[*k][*place] = LENT * self.capacity(body, point) / claims.len() as f64;
        }
    }

    /// The largest point mass that may be taken from a body at a point, or the largest moment of inertia at an angle.
    fn capacity(&self, body: usize, point: Option<Local<S>>) -> f64 {
        let own = &self.bodies[body];
        let (mass, inertia) = (number(own.mass), number(own.inertia));
        let Some(point) = point else {
            return match &self.held[body] {
                Held::Pin(pin, _) => number(about(own, *pin)),
                _ => inertia,
            };
        };
        let arm = |from: Local<S>| number((point - from).dot(point - from));
        match &self.held[body] {
            Held::Pin(pin, _) if arm(*pin) > 0.0 => mass.min(number(about(own, *pin)) / arm(*pin)),
            Held::Free if self.model.bodies[body].turns && arm(own.center) > 0.0 && mass > 0.0 => {
                mass * inertia / (inertia + mass * arm(own.center))
            }
            _ => mass,
        }
    }

    /// Adds a loan of ground to a light body at its pin, up to the mass that its inertia about the pin has at its
    /// farthest point.
    fn borrow_at_pin(&mut self, body: usize) {
        let (Held::Pin(pin, loan), true) = (&self.held[body], self.added[body].any()) else {
            return;
        };
        let own = self.bodies[body];
        let arms = self.links.iter().filter_map(|link| {
            let place = link.ends.iter().position(|end| end.body == body)?;
            let arm = link.points.as_ref()?[place] - *pin;
            Some(number(arm.dot(arm)))
        });
        let farthest = arms.fold(0.0, f64::max);
        let unit = if farthest > 0.0 { farthest } else { 1.0 };
        let weight = number(about(&own, *pin)) / unit - number(own.mass);
        if weight > 0.0 {
            self.bodies[body] = with_point(own, weight, *pin);
            self.loans.push(Loan { weight, ..loan.clone() });
        }
    }
}

/// The own inertia of a body.
fn weighed<S: Real>(body: &Body<S>) -> Weighed<S> {
    let Body { mass, center, inertia, .. } = *body;
    Weighed { mass, center, inertia }
}

/// The moment of inertia about a point.
fn about<S: Real>(own: &Weighed<S>, point: Local<S>) -> S {
    let arm = own.center - point;
    own.inertia + own.mass * arm.dot(arm)
}

/// The inertia with an additional point mass.
fn with_point<S: Real>(own: Weighed<S>, weight: f64, point: Local<S>) -> Weighed<S> {
    let (weight, arm) = (S::constant(weight), point - own.center);
    let mass = own.mass + weight;
    let part = weight / mass;
    let inertia = own.inertia + own.mass * part * arm.dot(arm);
    Weighed { mass, center: own.center + arm.scale(part), inertia }
}

/// The joints with constant fields at which one of two moving bodies can lend to the other.
fn links<S: Real>(model: &Model<S>) -> Vec<Link<S>> {
    let mut links = Vec::new();
    for (constraint, item) in model.constraints.iter().enumerate() {
        let slots = &model.layout.constraints[constraint];
        let [i, j] = slots.blocks.as_slice() else { continue };
        let (Some(first), Some(second), None) = (i.body, j.body, &item.law) else { continue };
        let (start, count) = (slots.rows.start, slots.rows.len());
        let link = |own: Range<usize>, points| {
            let end = |block: &crate::model::Block, body| End {
                body,
                columns: block.columns,
                entry: block.first / 3 + own.start,
            };
            let ends = [end(i, first.0), end(j, second.0)];
            Link { constraint, rows: start + own.start..start + own.end, ends, points }
        };
        let turn = [first, second].iter().all(|body| model.bodies[body.0].turns);
        for fixes in item.element.fixes() {
            match fixes {
                Fixes::Points => {
                    let points = [0, 1].map(|place| item.element.attachment(place).s);
                    links.push(link(0..2, Some(points)));
                }
                // the last equation, as in `Fixes::Turn`
                Fixes::Direction if turn => links.push(link(count - 1..count, None)),
                _ => {}
            }
        }
    }
    links
}

/// The freedom that a hold leaves to a body.
fn held_by<S: Real>(model: &Model<S>, body: usize, hold: Option<&Hold>) -> Held<S> {
    let Some(Hold { constraint, pin }) = hold else { return Held::Free };
    let (item, slots) = (&model.constraints[*constraint], &model.layout.constraints[*constraint]);
    if *pin {
        let place = usize::from(item.bodies[1].0 == body);
        let block = &slots.blocks[0];
        let borrower = End { body, columns: block.columns, entry: block.first / 3 };
        let (constraint, rows) = (*constraint, slots.rows.clone());
        let loan = Loan { constraint, rows, weight: 0.0, borrower, lender: None };
        return Held::Pin(item.element.attachment(place).s, loan);
    }
    let slides = item.element.fixes().iter().any(|fixes| matches!(fixes, Fixes::Direction));
    if slides {
        Held::Slide
    } else {
        Held::Free
    }
}
