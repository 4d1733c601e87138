//! The linear conditions of poses on dyads, and their solutions or samples of these.

use super::dyads::{dyads, Dyad};
use super::plane::{abs, conjugate, scaled, turn};
use super::random::{direction, scattered};
use kempe::math::{Complex, Random};

/// A dyad is shorter than this share of the task: its pin and its pivot coincide.
const SHORTEST: f64 = 1e-9;
/// A dyad has a pivot at infinity if its first number is below this share of the largest.
const INFINITE: f64 = 1e-10;
/// Two columns are parallel below this share of the longer one, and an equation holds within this error.
const PARALLEL: f64 = 1e-11;
const HOLDS: f64 = 1e-9;

/// Why there is no linkage, and what helps.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The reason.
    pub message: String,
    /// The remedy.
    pub hint: String,
}

impl Refused {
    pub(crate) fn new(message: String, hint: impl Into<String>) -> Self {
        Self { message, hint: hint.into() }
    }
}

/// An end of a dyad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The pin of the moving plane.
    Pin,
    /// The pivot of ground.
    Pivot,
}

/// The frame in which the conditions of a task are written: z = (place - origin) / size.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The origin of the moving frame at the first pose.
    pub origin: Complex,
    /// The largest distance from it; 1 if there is none.
    pub size: f64,
}

impl Frame {
    /// The frame of some places.
    pub fn of(places: &[Complex]) -> Self {
        let size = places.iter().fold(0.0_f64, |most, at| most.max(abs(*at - places[0])));
        Self { origin: places[0], size: if size > 0.0 { size } else { 1.0 } }
    }

    /// A place in the frame.
    pub fn inward(&self, at: Complex) -> Complex {
        let moved = at - self.origin;
        Complex::new(moved.re / self.size, moved.im / self.size)
    }

    /// A place of the frame in the plane.
    pub fn outward(&self, at: Complex) -> Complex {
        self.origin + scaled(at, self.size)
    }
}

/// One condition for each pose after the first, on (1, w, g, u, v); `dyads` explains them.
pub fn conditions(places: &[Complex], angles: &[f64]) -> Vec<Dyad> {
    let frame = Frame::of(places);
    let rows = places.iter().zip(angles).skip(1).map(|(place, angle)| {
        let (p, by) = (frame.inward(*place), turn(angle - angles[0]));
        let along = conjugate(p) * by;
        let half = 0.5 * (p.re * p.re + p.im * p.im);
        [half, along.re, -along.im, -p.re, -p.im, 1.0 - by.re, by.im]
    });
    rows.collect()
}

/// The condition that an end lies on a line with this normal and distance.
pub fn line(end: End, normal: Complex, distance: f64) -> Dyad {
    let mut row = [-distance, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let column = if end == End::Pin { 1 } else { 3 };
    (row[column], row[column + 1]) = (normal.re, normal.im);
    row
}

/// What is free, and how it is sampled.
#[derive(Clone, Debug)]
pub struct Choices {
    /// Number of samples.
    pub samples: usize,
    /// Seed of the samples.
    pub seed: u64,
    /// The ends that are chosen.
    pub ends: Vec<End>,
    /// A fixed pivot in the frame of the task.
    pub pivot: Option<Complex>,
    /// The name of a pose in messages.
    pub what: String,
}

impl Choices {
    /// Samples of both ends for poses.
    pub fn new(samples: usize, seed: u64, pivot: Option<Complex>) -> Self {
        Self { samples, seed, ends: vec![End::Pin, End::Pivot], pivot, what: "pose".into() }
    }
}

/// All dyads if the conditions determine them, otherwise samples; and whether these are all. The first `poses` of the
/// conditions are those of poses.
pub fn all_dyads(
    rows: &[Dyad],
    poses: usize,
    choices: &Choices,
) -> Result<(Vec<Dyad>, bool), Refused> {
    let Choices { samples, seed, pivot, what, .. } = choices;
    let counted = format!("{} {what}s", poses + 1);
    if let Some(at) = *pivot {
        let poses_only = &rows[..poses];
        if poses >= 2 {
            let found: Vec<Dyad> = with_end(poses_only, End::Pivot, at, None).into_iter().collect();
            if poses > 2 && found.is_empty() {
                let hint = format!("leave out a {what}, or let the pivot be free");
                let message = format!("{counted} and a fixed pivot contradict each other");
                return Err(Refused::new(message, hint));
            }
            return Ok((found, true));
        }
        let near = scattered(&mut Random::new(*seed), *samples);
        let found =
            near.iter().filter_map(|near| with_end(poses_only, End::Pivot, at, Some(*near)));
        return Ok((found.collect(), false));
    }
    if rows.len() < 4 {
        return Ok((sampled(rows, choices), false));
    }
    match rows.first_chunk::<4>().filter(|_| rows.len() == 4).and_then(dyads) {
        Some(found) => Ok((found, true)),
        None => {
            let told = dependent(&rows[..poses], what);
            let message = format!("the conditions of the {counted} depend on each other: {told}");
            Err(Refused::new(message, format!("leave out a {what}, or change its angle")))
        }
    }
}

/// Dyads with free choices: pins or pivots on random lines if one choice is free, otherwise at random places.
fn sampled(rows: &[Dyad], choices: &Choices) -> Vec<Dyad> {
    let mut random = Random::new(choices.seed);
    let places = scattered(&mut random, choices.samples);
    let ends = &choices.ends;
    if rows.len() <= 2 {
        let near = scattered(&mut random, choices.samples);
        let of = |k: usize| {
            let own = places.iter().skip(k).step_by(ends.len()).zip(&near);
            own.filter_map(move |(at, near)| with_end(rows, ends[k], *at, Some(*near)))
        };
        return (0..ends.len()).flat_map(of).collect();
    }
    let mut all = Vec::new();
    for (k, at) in places.iter().enumerate() {
        let (normal, far) = direction(*at);
        let signed = if (k / 2) % 2 == 0 { far } else { -far };
        let mut four = rows.to_vec();
        four.push(line(ends[k % ends.len()], normal, signed));
        all.extend(four.first_chunk::<4>().and_then(dyads).unwrap_or_default());
    }
    all
}

/// The dyad with one given end; the other end is as near as possible to a place. None if there is none.
pub fn with_end(rows: &[Dyad], end: End, at: Complex, near: Option<Complex>) -> Option<Dyad> {
    let (x, y) = (at.re, at.im);
    let (own, other, sign) = match end {
        End::Pin => (1, 3, 1.0),
        End::Pivot => (3, 1, -1.0),
    };
    let start = near.unwrap_or(Complex::new(0.0, 0.0));
    let columns: Vec<[f64; 2]> = rows
        .iter()
        .map(|r| [r[other] + x * r[5] + sign * y * r[6], r[other + 1] + y * r[5] - sign * x * r[6]])
        .collect();
    let left: Vec<f64> = rows
        .iter()
        .zip(&columns)
        .map(|(r, c)| -(r[0] + x * r[own] + y * r[own + 1]) - c[0] * start.re - c[1] * start.im)
        .collect();
    let step = least(&columns, &left);
    let wrong = columns.iter().zip(&left).map(|(c, l)| (c[0] * step[0] + c[1] * step[1] - l).abs());
    let found = start + Complex::new(step[0], step[1]);
    let (w, g) = if end == End::Pin { (at, found) } else { (found, at) };
    let holds = wrong.fold(0.0, f64::max) < HOLDS;
    (holds && abs(w - g) > SHORTEST * (1.0 + abs(w))).then(|| {
        let uv = conjugate(g) * w;
        [1.0, w.re, w.im, g.re, g.im, uv.re, uv.im]
    })
}

/// The shortest of the vectors that solve equations in two unknowns with the least error.
fn least(columns: &[[f64; 2]], right: &[f64]) -> [f64; 2] {
    let sum = |f: &dyn Fn(usize) -> f64| (0..right.len()).map(f).sum::<f64>();
    let long = |c: usize| sum(&|k| columns[k][c] * columns[k][c]).sqrt();
    let (i, j) = if long(0) >= long(1) { (0, 1) } else { (1, 0) };
    let size = long(i);
    if size == 0.0 {
        return [0.0, 0.0];
    }
    // the larger column first, then the part of the other one that is normal to it
    let q = |k: usize| columns[k][i] / size;
    let along = sum(&|k| q(k) * columns[k][j]);
    let normal = |k: usize| columns[k][j] - q(k) * along;
    let rest = sum(&|k| normal(k) * normal(k)).sqrt();
    let first = sum(&|k| q(k) * right[k]);
    let mut found = [0.0; 2];
    if rest > PARALLEL * size {
        found[j] = sum(&|k| normal(k) * right[k]) / (rest * rest);
        found[i] = (first - along * found[j]) / size;
    } else {
        let square = size * size + along * along;
        (found[i], found[j]) = (size * first / square, along * first / square);
    }
    found
}

/// Which pose follows from the others: its condition is a sum of multiples of theirs.
fn dependent(rows: &[Dyad], what: &str) -> String {
    let follows = |k: usize| {
        let mut basis: Vec<Dyad> = Vec::new();
        let dot = |x: &Dyad, y: &Dyad| (0..7).map(|j| x[j] * y[j]).sum::<f64>();
        let mut order: Vec<usize> = (0..rows.len()).filter(|j| *j != k).collect();
        order.push(k);
        let mut rest = 0.0;
        for at in order {
            let (mut row, size) = (rows[at], dot(&rows[at], &rows[at]).sqrt());
            for _ in 0..2 {
                for one in &basis {
                    let along = dot(&row, one);
                    (0..7).for_each(|j| row[j] -= along * one[j]);
                }
            }
            rest = dot(&row, &row).sqrt() / size.max(f64::MIN_POSITIVE);
            if rest > 1e-9 {
                let unit = dot(&row, &row).sqrt();
                basis.push(row.map(|x| x / unit));
            }
        }
        rest <= 1e-9
    };
    match (0..rows.len()).rev().find(|k| follows(*k)) {
        Some(k) => format!("{what} {} adds none to the others", k + 2),
        None => format!("a limit follows from the {what}s"),
    }
}

/// Pin and pivot of a dyad, both in the frame of the task; None if one of them is at infinity or both coincide.
pub fn ends(dyad: &Dyad) -> Option<(Complex, Complex)> {
    let most = dyad.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if dyad[0].abs() <= INFINITE * most {
        return None;
    }
    let at = |k: usize| Complex::new(dyad[k] / dyad[0], dyad[k + 1] / dyad[0]);
    let (w, g) = (at(1), at(3));
    (abs(w - g) >= SHORTEST * (1.0 + abs(w))).then_some((w, g))
}
