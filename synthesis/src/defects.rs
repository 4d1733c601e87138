//! Defects of four-bars and slider-cranks at the positions of a task.
//!
//! A linkage closes in two ways: B lies on the left or on the right of the line from A to D. As the crank turns, the two
//! closures meet where B lies on this line, at a dead point. A linkage that obeys Grashof's condition, s + l < p + q, has
//! two circuits that never join: the two angles at the ends of the link opposite the shortest one keep their signs. Any
//! other linkage has one circuit. The closures of a slider-crank meet where the coupler is normal to the slide; its crank
//! turns fully if its pin stays within the length of the coupler from the line of the slide.

use super::plane::{abs, angle, conjugate, cross};
use kempe::math::Complex;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The defects that exclude a candidate, in the order in which a candidate lists them.
pub const KINDS: [&str; 4] = ["circuit", "branch", "dead point", "order"];
/// Sine of the transmission angle at a dead point, and relative margin of Grashof's condition.
const DEAD: f64 = 1e-6;
const MARGIN: f64 = 1e-9;
/// Positions out of order, if the crank must turn the other way.
const OTHER_WAY: usize = 1000;

/// What guides the pin B of the coupler.
#[derive(Clone, Copy, Debug)]
pub enum Output {
    /// A rocker with this ground pivot.
    Rocker(Complex),
    /// A slide in this direction.
    Slide(Complex),
}

/// A linkage at the positions of a task.
#[derive(Clone, Debug)]
pub struct Linkage {
    /// The ground pivot of the crank.
    pub o: Complex,
    /// The moving pin of the crank at each position.
    pub a: Vec<Complex>,
    /// The other pin of the coupler at each position.
    pub b: Vec<Complex>,
    /// What guides this pin.
    pub output: Output,
}

/// Properties of a linkage at the positions of a task.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// Crank, coupler, rocker and ground; of a slider-crank infinity and the offset in place of the last two.
    pub lengths: [f64; 4],
    /// For each of `KINDS`, the first position with this defect, from 0.
    pub places: [Option<usize>; 4],
    /// Whether the crank makes full turns.
    pub turns: bool,
    /// Whether s + l ≤ p + q; of a slider-crank, whether the crank makes full turns.
    pub grashof: bool,
    /// The least transmission angle over the full turn; 0 if there is a dead point.
    pub least: f64,
    /// The least transmission angle at the positions.
    pub here: f64,
    /// Whether the crank turns counter-clockwise through the positions.
    pub forward: bool,
}

impl Judged {
    /// The index of the shortest of the lengths.
    pub fn shortest(&self) -> usize {
        shortest(&self.lengths)
    }

    /// The number of defects.
    pub fn count(&self) -> usize {
        self.places.iter().flatten().count()
    }
}

/// The range of a crank: whether it turns fully, whether it is limited below and above, and the direction from which its
/// angles are counted.
struct Range {
    turns: bool,
    low: bool,
    high: bool,
    zero: f64,
}

/// The defects of a linkage. `way` is 1 if the crank must turn counter-clockwise, -1 for clockwise, 0 for either.
pub fn judged(of: &Linkage, way: i32) -> Judged {
    match of.output {
        Output::Rocker(d) => of_four_bar(of, d, way),
        Output::Slide(along) => of_slider(of, along, way),
    }
}

fn of_four_bar(of: &Linkage, d: Complex, way: i32) -> Judged {
    let (o, a, b) = (of.o, &of.a, &of.b);
    let lengths = [abs(a[0] - o), abs(b[0] - a[0]), abs(b[0] - d), abs(d - o)];
    let [crank, coupler, rocker, ground] = lengths;
    let mut ordered = lengths;
    ordered.sort_by(f64::total_cmp);
    let room = ordered[1] + ordered[2] - ordered[0] - ordered[3];
    let margin = MARGIN * ordered[3];
    let double = room > margin;
    // signs at B, O and D: of the triangle of the joint and its two neighbours
    let pairs = || a.iter().zip(b);
    let sine: Vec<f64> =
        pairs().map(|(a, b)| cross(*a - *b, d - *b) / (coupler * rocker)).collect();
    let at_o: Vec<f64> = a.iter().map(|a| cross(*a - o, d - o)).collect();
    let at_d: Vec<f64> = b.iter().map(|b| cross(*b - d, o - d)).collect();
    let circuit = match shortest(&lengths) {
        2 => &at_o,
        1 => &at_d,
        _ => &sine,
    };
    let low = (crank - ground).abs() < (coupler - rocker).abs() - margin;
    let high = crank + ground > coupler + rocker + margin;
    let range = Range { turns: !low && !high && double, low, high, zero: angle(d - o) };
    // a linkage at the margin of Grashof's condition passes a dead point where it folds
    let folds = !double && room > -margin;
    let dead = |k: usize| sine[k].abs() < DEAD || (folds && at_o[k] * at_o[0] < 0.0);
    let least = if range.turns { over_turn(&lengths) } else { 0.0 };
    let split = |k: usize| double && (circuit[k] > 0.0) != (circuit[0] > 0.0);
    finished(of, way, &range, (&sine, lengths, room >= -margin, least), (split, dead))
}

fn of_slider(of: &Linkage, along: Complex, way: i32) -> Judged {
    let (o, a, b) = (of.o, &of.a, &of.b);
    let (crank, coupler) = (abs(a[0] - o), abs(b[0] - a[0]));
    let offset = cross(along, o - b[0]);
    let margin = MARGIN * (coupler + crank + offset.abs());
    let (high, low) = (offset + crank > coupler + margin, crank - offset > coupler + margin);
    let turns = offset.abs() + crank < coupler - margin;
    let ahead = |z: Complex| (conjugate(along) * z).re;
    let sine: Vec<f64> = a.iter().zip(b).map(|(a, b)| ahead(*b - *a) / coupler).collect();
    // a crank that is limited on both sides keeps its side of the normal of the slide
    let side: Vec<f64> = a.iter().map(|a| ahead(*a - o)).collect();
    let split = |k: usize| match (turns, low && high) {
        (true, _) => (sine[k] > 0.0) != (sine[0] > 0.0),
        (_, true) => (side[k] > 0.0) != (side[0] > 0.0),
        _ => false,
    };
    // angles from the normal on which both limits are symmetric
    let range = Range { turns, low, high, zero: angle(along) - FRAC_PI_2 };
    let far = ((offset.abs() + crank) / coupler).clamp(0.0, 1.0);
    let least = if turns { FRAC_PI_2 - far.asin() } else { 0.0 };
    let lengths = [crank, coupler, f64::INFINITY, offset.abs()];
    finished(of, way, &range, (&sine, lengths, turns, least), (split, |k| sine[k].abs() < DEAD))
}

/// The judgement from the sines of the transmission angle at all positions, with what is known already.
fn finished(
    of: &Linkage,
    way: i32,
    range: &Range,
    (sine, lengths, grashof, least): (&[f64], [f64; 4], bool, f64),
    (split, dead): (impl Fn(usize) -> bool, impl Fn(usize) -> bool),
) -> Judged {
    let first = |flag: &dyn Fn(usize) -> bool| (0..sine.len()).find(|k| flag(*k));
    let circuit = first(&split);
    let crossed = first(&|k| (sine[k] > 0.0) != (sine[0] > 0.0));
    let branch = crossed.filter(|_| circuit.is_none());
    let cranks: Vec<f64> = of.a.iter().map(|a| angle(*a - of.o)).collect();
    let (late, forward) = order(&cranks, range, way);
    let late = late.filter(|_| circuit.is_none() && branch.is_none());
    let places = [circuit, branch, first(&dead), late];
    let here = sine.iter().map(|s| s.abs().min(1.0).asin()).fold(f64::INFINITY, f64::min);
    Judged { lengths, places, turns: range.turns, grashof, least, here, forward }
}

/// The index of the shortest length.
pub(crate) fn shortest(lengths: &[f64; 4]) -> usize {
    (1..4).fold(0, |best, k| if lengths[k] < lengths[best] { k } else { best })
}

/// The least transmission angle of a crank that turns fully: A is nearest or farthest to D.
fn over_turn(&[crank, coupler, rocker, ground]: &[f64; 4]) -> f64 {
    let at = |far: f64| {
        let cosine = (coupler * coupler + rocker * rocker - far * far) / (2.0 * coupler * rocker);
        FRAC_PI_2 - cosine.abs().min(1.0).asin()
    };
    FRAC_PI_2.min(at((crank - ground).abs())).min(at(crank + ground))
}

/// The first position out of order, and whether the crank turns counter-clockwise.
fn order(cranks: &[f64], range: &Range, way: i32) -> (Option<usize>, bool) {
    if cranks.len() < 2 {
        return (None, way >= 0);
    }
    // a crank between limits: angles from the middle of its range
    let at_o = (cranks[0] - range.zero).sin();
    let middle = range.zero
        + match (range.low, range.high) {
            (true, true) => FRAC_PI_2.copysign(at_o),
            (true, false) => PI,
            _ => 0.0,
        };
    let inside: Vec<f64> = cranks.iter().map(|at| (at - middle + PI).rem_euclid(TAU)).collect();
    let cyclic: Vec<f64> = cranks.windows(2).map(|two| (two[1] - two[0]).rem_euclid(TAU)).collect();
    let of = |sign: f64| {
        let mut sum = 0.0;
        let late: Vec<bool> = (0..cyclic.len())
            .map(|k| {
                sum += if sign > 0.0 { cyclic[k] } else { TAU - cyclic[k] };
                let straight = sign * (inside[k + 1] - inside[k]) <= 0.0;
                if range.turns {
                    sum >= TAU
                } else {
                    straight
                }
            })
            .collect();
        let other = if f64::from(way) == -sign { OTHER_WAY } else { 0 };
        let count = late.iter().filter(|late| **late).count() + other;
        (late.iter().position(|late| *late).map(|k| k + 1), count)
    };
    let ((ahead, wrong), (back, wrong_back)) = (of(1.0), of(-1.0));
    let span: f64 = cyclic.iter().sum();
    let tie = !range.turns || span <= PI * cranks.len() as f64 - PI;
    let forward = wrong < wrong_back || (wrong == wrong_back && tie);
    (if forward { ahead } else { back }, forward)
}

/// The angles of the crank at the positions, which grow or fall from each position to the next.
pub(crate) fn crank_angles(of: &Linkage, judged: &Judged) -> Vec<f64> {
    let mut angles: Vec<f64> = of.a.iter().map(|a| angle(*a - of.o)).collect();
    for k in 1..angles.len() {
        let step = angles[k] - angles[k - 1];
        angles[k] = angles[k - 1]
            + match (judged.turns, judged.forward) {
                (true, true) => step.rem_euclid(TAU),
                (true, false) => -(-step).rem_euclid(TAU),
                // the nearest of all angles that differ by full turns
                _ => step - TAU * (step / TAU).round(),
            };
    }
    angles
}
