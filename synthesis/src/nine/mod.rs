//! All four-bars whose coupler point passes nine points, by continuation.
//!
//! The equations of nine general points have 8652 solutions: 1442 four-bars, each with two cognates and each with its
//! sides in either order (Wampler, Morgan & Sommese 1992). Those of one set of complex points are stored. While these
//! points move straight to the given ones, each four-bar follows them, and the ends are all solutions. Real ones are
//! four-bars. `synthesis/examples/nine_points.rs` makes the stored set again.

mod exact;
mod follow;
mod system;

use crate::defects::{Linkage, Output};
use crate::plane::{abs, angle, conjugate, scaled, unit};
use crate::wanted::{cognates, Traced, Wanted};
pub use follow::{followed, settled, Care};
use kempe::math::{Complex, Field};
use system::N;
pub use system::{Posture, Shifts};

/// Four-bars of a general set of nine points, without cognates.
pub const PATHS: usize = 1442;
/// How a four-bar follows the points at first, and again if it was lost.
const QUICK: Care = Care { tolerance: 1e-2, exact: false, most: 2000 };
const CAREFUL: Care = Care { tolerance: 1e-4, exact: true, most: 20_000 };
/// More of them are lost only at special points, whose solutions are at infinity or not unique.
const MANY: usize = PATHS / 10;
/// Two solutions are the same, and a solution is real, within this share of their size.
const SAME: f64 = 1e-8;

/// Numbers of followed four-bars.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Followed {
    /// Those that start.
    pub paths: usize,
    /// Different ends.
    pub found: usize,
    /// Those that were lost at first, and followed again; none at special points.
    pub again: usize,
    /// Ends that are real four-bars.
    pub real: usize,
}

/// A search for all four-bars through nine points.
pub struct NinePoints {
    places: Vec<Complex>,
    size: f64,
    base: Shifts,
    target: Shifts,
    starts: Vec<Posture>,
    ends: Vec<Option<Posture>>,
    /// The places of those that are followed again; known as soon as all were followed once.
    again: Option<Vec<usize>>,
    tried: usize,
}

impl NinePoints {
    /// A search for nine places from a stored start: 4-byte numbers of `Shifts` and of the bars of each `Posture`. None if
    /// there are not nine places or the start is not usable.
    pub fn new(places: &[Complex], stored: &[u8]) -> Option<Self> {
        let numbers = stored.chunks_exact(4).map(|bytes| match bytes {
            [a, b, c, d] => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
            _ => f64::NAN,
        });
        let numbers: Vec<f64> = numbers.collect();
        let rows: Vec<[Complex; N]> = numbers
            .chunks_exact(2 * N)
            .map(|row| std::array::from_fn(|k| Complex::new(row[2 * k], row[2 * k + 1])))
            .collect();
        if rows.len() != PATHS + 2 || places.len() != N + 1 {
            return None;
        }
        let base = Shifts { at: rows[0], mirrored: rows[1] };
        let size = Wanted { places: places.to_vec(), ..Wanted::default() }.size();
        let at: [Complex; N] =
            std::array::from_fn(|k| scaled(places[k + 1] - places[0], 1.0 / size));
        let target = Shifts { at, mirrored: at.map(conjugate) };
        // the start is turned towards the places
        let ways = [(&base.at, &target.at), (&base.mirrored, &target.mirrored)];
        let ways = ways.map(|(from, to)| {
            unit((0..N).fold(Complex::zero(), |sum, k| sum + to[k] * conjugate(from[k])))
        });
        let turned = |of: &[Complex; N]| std::array::from_fn(|k| of[k] * ways[k % 2]);
        let start = |row: &[Complex; N]| {
            let found = settled(Posture::new(*row, &base), &base)?;
            Some(Posture { bars: turned(&found.bars), turns: found.turns })
        };
        let starts = rows[2..].iter().map(start).collect::<Option<Vec<_>>>()?;
        let base = Shifts {
            at: base.at.map(|z| z * ways[0]),
            mirrored: base.mirrored.map(|z| z * ways[1]),
        };
        let places = places.to_vec();
        let ends = vec![None; PATHS];
        Some(Self { places, size, base, target, starts, ends, again: None, tried: 0 })
    }

    /// Whether the search is finished.
    pub fn ended(&self) -> bool {
        self.again.as_ref().is_some_and(|again| self.tried == PATHS + again.len())
    }

    /// The numbers of four-bars that were followed, and of all that will be as far as it is known.
    pub fn tried(&self) -> (usize, usize) {
        (self.tried, PATHS + self.again.as_ref().map_or(0, Vec::len))
    }

    /// Follow some more of the four-bars.
    pub fn advance(&mut self, paths: usize) {
        for _ in 0..paths {
            if self.ended() {
                break;
            }
            let end = |start: &Posture, care| {
                let end = followed(start, &self.base, &self.target, care);
                end.filter(Posture::has_two_sides)
            };
            if self.tried < PATHS {
                let k = self.tried;
                self.ends[k] = end(&self.starts[k], QUICK);
            } else if let Some(again) = &self.again {
                let k = again[self.tried - PATHS];
                let all = self.starts[k].cognates(&self.base);
                self.ends[k] = all.iter().find_map(|start| end(start, CAREFUL));
            }
            self.tried += 1;
            if self.tried == PATHS {
                let lost = (0..PATHS).filter(|k| !self.is_alone(*k, PATHS));
                self.again = Some(lost.collect()).filter(|lost: &Vec<_>| lost.len() < MANY);
                self.again.get_or_insert_default();
            }
        }
    }

    /// Whether a four-bar has an end that no other one of the first ones has.
    fn is_alone(&self, k: usize, first: usize) -> bool {
        let own = self.ends[k].as_ref().map(Posture::pivots);
        let is_same = |other: &Posture| {
            let of = other.pivots();
            own.is_some_and(|own| {
                (0..2).all(|j| (own[j] - of[j]).magnitude() < SAME * (1.0 + own[j].magnitude()))
            })
        };
        let mut others = self.ends[..first].iter().enumerate().filter(|(j, _)| *j != k);
        own.is_some() && !others.any(|(_, end)| end.as_ref().is_some_and(is_same))
    }

    /// The four-bars that are found so far, with their cognates, and how many were followed.
    pub fn found(&self) -> (Vec<Traced>, Followed) {
        let first = (0..PATHS).filter(|k| self.is_alone(*k, *k));
        let alone: Vec<&Posture> = first.filter_map(|k| self.ends[k].as_ref()).collect();
        let real: Vec<Traced> = alone.iter().filter_map(|end| self.traced(end)).collect();
        let again = self.again.as_ref().map_or(0, Vec::len);
        let count = Followed { paths: PATHS, found: alone.len(), again, real: real.len() };
        let others: Vec<Traced> = real.iter().flat_map(cognates).collect();
        (real.into_iter().chain(others).filter(|one| one.error.is_finite()).collect(), count)
    }

    /// A solution as a four-bar; None if it is not real.
    fn traced(&self, of: &Posture) -> Option<Traced> {
        let is_pair = |k: usize| {
            let (at, mirrored) = (of.bars[k], of.bars[k + 1]);
            abs(conjugate(at) - mirrored) < SAME * (1.0 + abs(at))
        };
        let turns = of.turns.map(|g| Complex::one() + g);
        if !(0..N).step_by(2).all(is_pair) || turns.iter().any(|t| (abs(*t) - 1.0).abs() > SAME) {
            return None;
        }
        let [x, _, u, _, y, _, v, _] = of.bars.map(|z| scaled(z, self.size));
        let turns = || [Complex::one()].into_iter().chain(turns.map(unit));
        let pins = |pin: Complex| -> Vec<Complex> {
            self.places.iter().zip(turns()).map(|(at, turn)| *at + pin * turn).collect()
        };
        let (o, d) = (self.places[0] + x - u, self.places[0] + y - v);
        let (a, b) = (pins(x), pins(y));
        let off = |pins: &[Complex], pivot: Complex, arm: Complex| {
            pins.iter().map(|pin| (abs(*pin - pivot) - abs(arm)).abs()).fold(0.0, f64::max)
        };
        let error = off(&a, o, u).max(off(&b, d, v));
        let frame = angle(b[0] - a[0]);
        let linkage = Linkage { o, a, b, output: Output::Rocker(d) };
        Some(Traced { linkage, points: self.places.clone(), frame, error })
    }
}

#[cfg(test)]
mod tests;
