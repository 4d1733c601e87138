//! From linkages of a task to candidates, best first.

use super::defects::{crank_angles, judged, shortest, Judged, Linkage, Output, KINDS};
use super::plane::abs;
use kempe::math::Complex;
use std::f64::consts::FRAC_PI_4;

/// Two places that differ by less, relative to the size of the task, are the same.
const SAME: f64 = 1e-9;
/// Candidates of a task with free choices that are kept.
const KEPT: usize = 100;
/// Types of Grashof's linkages, by the shortest of crank, coupler, rocker and ground.
pub const TYPES: [&str; 4] = ["crank-rocker", "double-rocker", "rocker-crank", "double-crank"];

/// What `grashof` requires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grashof {
    /// Nothing.
    Any,
    /// Grashof's condition.
    Holds,
    /// One of `TYPES`.
    Is(usize),
}

/// Limits of all candidates, besides the task.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Whether candidates with defects are kept.
    pub tell: bool,
    /// Least transmission angle over the full turn, rad.
    pub transmission_angle: Option<f64>,
    /// Grashof's condition.
    pub grashof: Grashof,
    /// The least and largest x, then y, of the ground pivots, m.
    pub within: Option<[[f64; 2]; 2]>,
    /// 1 or -1 if the crank must turn counter-clockwise or clockwise, otherwise 0.
    pub way: i32,
}

impl Default for Limits {
    fn default() -> Self {
        Self { tell: false, transmission_angle: None, grashof: Grashof::Any, within: None, way: 0 }
    }
}

/// A linkage that is kept.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// Its number in the given list.
    pub index: usize,
    /// Whether its rocker is the crank.
    pub reversed: bool,
    /// Its properties.
    pub judged: Judged,
    /// What is wrong, each with its place.
    pub defects: Vec<String>,
    /// The angles of the crank at the positions, rad.
    pub crank_angles: Vec<f64>,
}

/// Candidates, best first, and how many linkages each defect or limit excludes.
pub type Ranking = (Vec<Ranked>, Vec<(String, usize)>);

/// A linkage with its properties and with what is wrong.
struct Seen {
    index: usize,
    reversed: bool,
    linkage: Linkage,
    judged: Judged,
    error: f64,
    wrong: Vec<(&'static str, Option<usize>)>,
}

impl Linkage {
    /// The linkage whose crank is the rocker; None for a slider-crank.
    pub fn reversed(&self) -> Option<Self> {
        let Output::Rocker(d) = self.output else { return None };
        let output = Output::Rocker(self.o);
        Some(Self { o: d, a: self.b.clone(), b: self.a.clone(), output })
    }

    /// Whether all its links and its ground have a length.
    fn is_shapely(&self) -> bool {
        let mut sides = vec![abs(self.a[0] - self.o), abs(self.b[0] - self.a[0])];
        if let Output::Rocker(d) = self.output {
            sides.extend([abs(d - self.b[0]), abs(d - self.o)]);
        }
        let most = sides.iter().fold(0.0_f64, |most, x| most.max(*x));
        sides.iter().all(|x| x.is_finite() && *x > SAME * most)
    }
}

/// All linkages without defects if these are all solutions, otherwise the best of them. With `either`, the rocker may be
/// the crank, and the better of both is taken. Exact linkages come first, then those whose crank turns fully with a
/// transmission angle of 45° or the largest one, then small ones.
pub fn ranked(
    linkages: &[(Linkage, f64)],
    limits: &Limits,
    either: bool,
    complete: bool,
) -> Ranking {
    let shapely = linkages.iter().enumerate().filter(|(_, (one, _))| one.is_shapely());
    let mut all: Vec<Seen> =
        shapely.map(|(k, (one, error))| seen(k, one, *error, limits, either)).collect();
    let mut excluded: Vec<(String, usize)> = Vec::new();
    for kind in KINDS.iter().chain(&["transmission angle", "grashof", "pivots"]) {
        let has = |one: &&Seen| one.wrong.iter().any(|(name, _)| name == kind);
        let count = all.iter().filter(has).count();
        if count > 0 && !limits.tell {
            excluded.push(((*kind).to_string(), count));
        }
    }
    all.retain(|one| limits.tell || one.wrong.is_empty());
    let mut keyed: Vec<([f64; 5], Seen)> = all.into_iter().map(|one| (key(&one), one)).collect();
    keyed.sort_by(|(one, _), (other, _)| {
        one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal)
    });
    let most = if complete { usize::MAX } else { KEPT };
    let kept = keyed.into_iter().take(most).map(|(_, one)| finished(one));
    (kept.collect(), excluded)
}

/// The better of a linkage and its reverse.
fn seen(index: usize, one: &Linkage, error: f64, limits: &Limits, either: bool) -> Seen {
    let own = judged(one, limits.way);
    let back = if either { one.reversed() } else { None };
    let back = back.map(|other| (judged(&other, limits.way), other));
    let (judged, linkage, reversed) = match back.filter(|(other, _)| worth(other) > worth(&own)) {
        Some((other, linkage)) => (other, linkage, true),
        None => (own, one.clone(), false),
    };
    let wrong = wrong(&linkage, &judged, limits);
    Seen { index, reversed, linkage, judged, error, wrong }
}

/// Fewer defects first, then a crank that turns fully, then the transmission angle.
fn worth(of: &Judged) -> f64 {
    let turns = f64::from(u8::from(of.turns));
    -10.0 * of.count() as f64 + turns + 0.1 * of.least + 0.01 * of.here
}

/// The defects with their positions, and the limits that a linkage is beyond.
fn wrong(of: &Linkage, judged: &Judged, limits: &Limits) -> Vec<(&'static str, Option<usize>)> {
    let places = KINDS.iter().zip(judged.places).filter(|(_, place)| place.is_some());
    let mut found: Vec<_> = places.map(|(kind, place)| (*kind, place)).collect();
    if limits.transmission_angle.is_some_and(|least| judged.least < least) {
        found.push(("transmission angle", None));
    }
    let fits = match limits.grashof {
        Grashof::Any => true,
        Grashof::Holds => judged.grashof,
        Grashof::Is(kind) => judged.grashof && shortest(&judged.lengths) == kind,
    };
    if !fits {
        found.push(("grashof", None));
    }
    let pivots: &[Complex] = match of.output {
        Output::Rocker(d) => &[of.o, d],
        Output::Slide(_) => &[of.o, of.b[0]],
    };
    let outside = |[x, y]: [[f64; 2]; 2], at: &Complex| {
        at.re < x[0] || at.re > x[1] || at.im < y[0] || at.im > y[1]
    };
    if limits.within.is_some_and(|area| pivots.iter().any(|at| outside(area, at))) {
        found.push(("pivots", None));
    }
    found
}

/// Linkages are sorted by these numbers, the first one first.
fn key(of: &Seen) -> [f64; 5] {
    let size = of.judged.lengths.iter().fold(0.0_f64, |most, x| most.max(*x));
    let exact = if of.error < SAME * size { 0.0 } else { of.error };
    let rounded = |x: f64| -(x.min(FRAC_PI_4) * 100.0).round_ties_even();
    [of.judged.count() as f64, exact, rounded(of.judged.least), rounded(of.judged.here), size]
}

fn finished(of: Seen) -> Ranked {
    let told = |(kind, place): &(&str, Option<usize>)| match place {
        Some(k) => format!("{kind}: at position {}", k + 1),
        None => format!("{kind}: beyond the limit"),
    };
    let crank_angles = crank_angles(&of.linkage, &of.judged);
    let defects = of.wrong.iter().map(told).collect();
    Ranked { index: of.index, reversed: of.reversed, judged: of.judged, defects, crank_angles }
}
