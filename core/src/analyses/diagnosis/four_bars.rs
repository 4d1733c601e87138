//! Closed loops of four pins, and whether their links turn fully (Grashof 1883).

use crate::elements::{Fixes, Group};
use crate::math::{indexed, Listed, Local, ShortArray};
use crate::model::Model;
use std::fmt;

/// Sums of lengths that differ by less than this relative amount count as equal.
const EQUAL: f64 = 1e-9;
/// Largest number of loops that are listed.
const MOST: usize = 100;

/// A closed loop of four bodies and four pins.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// The bodies in order around the loop. Ground is first if it takes part.
    pub bodies: [String; 4],
    /// The pins: between the first and second body, and so on.
    pub pins: [String; 4],
    /// The distance between the two pins of each body, m.
    pub lengths: [f64; 4],
    /// The kind of the loop.
    pub class: Grashof,
}

/// Kinds of four-bar loops, with the index of the shortest link among the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grashof {
    /// The shortest link is adjacent to ground and turns fully.
    CrankRocker(usize),
    /// Ground is the shortest link; both adjacent links turn fully.
    DoubleCrank(usize),
    /// The link opposite to ground is the shortest. It turns fully; the links adjacent to ground do not.
    DoubleRocker(usize),
    /// The shortest link turns fully. Ground does not take part.
    Grashof(usize),
    /// No link turns fully relative to another link.
    TripleRocker,
    /// The shortest and the longest link are together as long as the other two: all links can lie in line.
    ChangePoint,
}

impl Grashof {
    /// The indices of the links that turn fully relative to their neighbours. None if this depends on the branch.
    pub fn turning(self) -> Option<impl Iterator<Item = usize>> {
        let places = match self {
            Self::ChangePoint => return None,
            Self::TripleRocker => vec![],
            Self::DoubleCrank(_) => vec![1, 3],
            Self::CrankRocker(k) | Self::DoubleRocker(k) | Self::Grashof(k) => vec![k],
        };
        Some(places.into_iter())
    }
}

impl fmt::Display for Grashof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::CrankRocker(_) => "crank-rocker",
            Self::DoubleCrank(_) => "double crank",
            Self::DoubleRocker(_) => "double rocker",
            Self::Grashof(_) => "Grashof",
            Self::TripleRocker => "triple rocker",
            Self::ChangePoint => "change point",
        })
    }
}

/// A pin between two bodies.
struct Pin {
    name: String,
    bodies: [usize; 2],
    at: [Local; 2],
}

/// The four-bar loops of a model, each listed once.
pub(super) fn four_bars(model: &Model) -> Vec<FourBar> {
    let pins = pins(model);
    let mut of_body = vec![Vec::new(); model.bodies.len()];
    for (k, pin) in pins.iter().enumerate() {
        pin.bodies.iter().for_each(|body| of_body[*body].push(k));
    }
    let other = |k: usize, body: usize| pins[k].bodies[usize::from(pins[k].bodies[0] == body)];
    let mut found = Vec::new();
    for a in 0..model.bodies.len() {
        for (first, &ab) in of_body[a].iter().enumerate() {
            for &da in &of_body[a][first + 1..] {
                let (b, d) = (other(ab, a), other(da, a));
                if b <= a || d <= a || b == d {
                    continue;
                }
                for &bc in of_body[b].iter().filter(|k| **k != ab) {
                    let c = other(bc, b);
                    if c <= a || c == d {
                        continue;
                    }
                    for &cd in of_body[c].iter().filter(|k| **k != bc && other(**k, c) == d) {
                        if found.len() < MOST {
                            found.extend(four_bar(model, &pins, [a, b, c, d], [ab, bc, cd, da]));
                        }
                    }
                }
            }
        }
    }
    found
}

/// Pairs of bodies that turn about the same point: joined by a pin, or each pinned to other bodies at this point.
fn pins(model: &Model) -> Vec<Pin> {
    let mut found = Vec::new();
    for hinge in hinges(model) {
        for (k, (a, at, one)) in hinge.iter().enumerate() {
            for (b, there, other) in &hinge[k + 1..] {
                let both = |joint: &&usize| {
                    let bodies = &model.constraints[**joint].bodies;
                    [a, b].iter().all(|body| bodies.iter().any(|of| of.0 == **body))
                };
                let name = |joint: &usize| model.constraints[*joint].name.clone();
                let name = match one.iter().find(both) {
                    Some(joint) => name(joint),
                    None => format!("{}+{}", name(&one[0]), name(&other[0])),
                };
                found.push(Pin { name, bodies: [*a, *b], at: [*at, *there] });
            }
        }
    }
    found
}

/// A point about which bodies turn: the bodies, the point on each of them, and its pins there.
type Hinge = Vec<(usize, Local, Vec<usize>)>;

/// The joints that only fix two points. Joints at the same point of a body are combined.
fn hinges(model: &Model) -> Vec<Hinge> {
    let mut hinges: Vec<Hinge> = Vec::new();
    for (k, item) in model.constraints.iter().enumerate() {
        let fixes = item.element.fixes();
        let turns = fixes.contains(&Fixes::Points) && !fixes.contains(&Fixes::Direction);
        if !turns || item.bodies.len() != 2 || item.group != Group::Joints {
            continue;
        }
        let own =
            [0, 1].each(|side| (item.bodies[side].0, item.element.attachment(side).s, vec![k]));
        let touches = |hinge: &Hinge| {
            own.iter().any(|(body, at, _)| hinge.iter().any(|(b, s, _)| b == body && s == at))
        };
        let touched: Vec<usize> = (0..hinges.len()).filter(|place| touches(&hinges[*place])).list();
        let place = touched.first().copied().unwrap_or(hinges.len());
        let mut merged: Hinge = Vec::new();
        for k in touched.into_iter().rev() {
            merged.splice(0..0, hinges.remove(k));
        }
        for (body, at, joints) in own {
            match merged.iter_mut().find(|(b, s, _)| *b == body && *s == at) {
                Some((.., known)) => known.extend(joints),
                None => merged.push((body, at, joints)),
            }
        }
        hinges.insert(place, merged);
    }
    hinges
}

/// The loop of four bodies. None if two pins of a body coincide.
fn four_bar(model: &Model, pins: &[Pin], bodies: [usize; 4], loop_: [usize; 4]) -> Option<FourBar> {
    let place = |k: usize, body: usize| pins[k].at[usize::from(pins[k].bodies[1] == body)];
    let lengths: [f64; 4] = indexed(|k| {
        let (one, two) = (loop_[(k + 3) % 4], loop_[k]);
        (place(one, bodies[k]) - place(two, bodies[k])).norm()
    });
    let class = class(&lengths, bodies[0] == 0);
    lengths.iter().all(|length| *length > 0.0).then(|| FourBar {
        bodies: bodies.each(|body| model.bodies[body].name.clone()),
        pins: loop_.each(|k| pins[k].name.clone()),
        lengths,
        class,
    })
}

/// Grashof's rule. The first link is ground if `grounded`.
fn class(lengths: &[f64; 4], grounded: bool) -> Grashof {
    let place = (0..4).min_by(|a, b| lengths[*a].total_cmp(&lengths[*b])).unwrap_or(0);
    let mut sorted = *lengths;
    sorted.sort_by(f64::total_cmp);
    let [s, p, q, l] = sorted;
    let excess = s + l - p - q;
    match place {
        _ if excess.abs() <= EQUAL * l => Grashof::ChangePoint,
        _ if excess > 0.0 => Grashof::TripleRocker,
        _ if !grounded => Grashof::Grashof(place),
        0 => Grashof::DoubleCrank(0),
        2 => Grashof::DoubleRocker(2),
        place => Grashof::CrankRocker(place),
    }
}
