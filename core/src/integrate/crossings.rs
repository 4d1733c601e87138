//! Where functions of the state change sign within a step, several changes in one step included.
//!
//! The functions are sampled at [`PARTS`] + 1 times of the interpolant. A change of sign between two samples is closed
//! in by bisection and inverse quadratic interpolation (`events`). Where the samples approach zero and turn back, the
//! parabola through three of them shows whether zero lies beyond. An even number of changes within a
//! [`PARTS`]-th of a step can be missed; a shorter step finds them.

use super::events::{Bracket, Direction};
use super::step::Step;

/// Parts of a step between samples.
const PARTS: usize = 12;
/// Parabolas that are tried to find a zero between samples of one sign.
const PARABOLAS: usize = 4;

/// A change of sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The function.
    pub index: usize,
    /// Time just past the change.
    pub t: f64,
    /// Whether the function grows there.
    pub rising: bool,
}

/// The signs of functions over a step.
#[derive(Clone, Debug, Default)]
pub struct Scan {
    /// The first change of sign of each function that has one in a direction that counts; in order of time.
    pub crossings: Vec<Crossing>,
    /// The functions that are below zero at all samples after the beginning.
    pub negative: Vec<usize>,
}

/// Evaluates functions at a time and a state, into its last argument. NaN has no sign.
pub type Functions<'a> = &'a mut dyn FnMut(f64, &[f64], &mut [f64]);

/// Samples `count` functions over a step and locates their first changes of sign, to four spacings of numbers. A change
/// at the very beginning belongs to the step before.
pub fn scan(step: &Step<'_>, count: usize, functions: Functions<'_>, direction: Direction) -> Scan {
    let mut sampled = Sampled { step, functions, y: step.y.to_vec(), values: vec![0.0; count] };
    let times: Vec<f64> = (0..=PARTS).map(|k| sampled.time(k as f64 / PARTS as f64)).collect();
    let rows: Vec<Vec<f64>> = times.iter().map(|t| sampled.at(*t).to_vec()).collect();
    let mut scan = Scan::default();
    for index in 0..count {
        let points: Vec<Point> = times.iter().zip(&rows).map(|(t, row)| (*t, row[index])).collect();
        scan.crossings.extend(sampled.first(index, &points, direction));
        if points[1..].iter().all(|(_, value)| *value < 0.0) {
            scan.negative.push(index);
        }
    }
    let sign = (step.t - step.t_old).signum();
    scan.crossings.sort_by(|a, b| (sign * a.t).total_cmp(&(sign * b.t)));
    scan
}

/// A time and the value there.
type Point = (f64, f64);

struct Sampled<'a, 'b> {
    step: &'a Step<'a>,
    functions: Functions<'b>,
    y: Vec<f64>,
    values: Vec<f64>,
}

impl Sampled<'_, '_> {
    fn time(&self, part: f64) -> f64 {
        match part {
            1.0 => self.step.t,
            part => self.step.t_old + part * (self.step.t - self.step.t_old),
        }
    }

    /// The values of all functions at a time.
    fn at(&mut self, t: f64) -> &[f64] {
        if t == self.step.t {
            self.y.copy_from_slice(self.step.y);
        } else if t == self.step.t_old {
            self.y.copy_from_slice(self.step.y_old);
        } else {
            self.step.interpolate(t, &mut self.y);
        }
        (self.functions)(t, &self.y, &mut self.values);
        &self.values
    }

    /// The first change of sign of a function with the given samples.
    fn first(&mut self, index: usize, points: &[Point], direction: Direction) -> Option<Crossing> {
        for k in 1..points.len() {
            if let Some(found) = self.between(index, points[k - 1], points[k], direction) {
                return Some(found);
            }
            // the samples approach zero and turn back
            let Some(next) = points.get(k + 1) else { continue };
            if let Some([before, beyond, after]) =
                self.turn(index, [points[k - 1], points[k], *next])
            {
                let found = self.between(index, before, beyond, direction);
                if let Some(found) = found.or_else(|| self.between(index, beyond, after, direction))
                {
                    return Some(found);
                }
            }
        }
        None
    }

    /// The change of sign between two times.
    fn between(
        &mut self,
        index: usize,
        a: Point,
        b: Point,
        direction: Direction,
    ) -> Option<Crossing> {
        let rising = direction.counts(a.1, b.1)?;
        if b.1 == 0.0 {
            return Some(Crossing { index, t: b.0, rising });
        }
        let sign = b.1.signum();
        let bracket = Bracket { old: (a.0, sign * a.1), new: (b.0, sign * b.1) };
        let spacing = f64::EPSILON * a.0.abs().max(b.0.abs());
        let t = bracket.close(4.0 * spacing, |t| sign * self.at(t)[index]);
        Some(Crossing { index, t, rising })
    }

    /// A point on the other side of zero between three samples of one sign, between the points next to it.
    fn turn(&mut self, index: usize, mut points: [Point; 3]) -> Option<[Point; 3]> {
        let sign = points[1].1.signum();
        for _ in 0..PARABOLAS {
            let [a, b, c] = points.map(|(_, value)| sign * value);
            if !(b > 0.0 && b <= a && b <= c && (b < a || b < c)) {
                return None;
            }
            let t = vertex(points)?;
            let latest = (t, self.at(t)[index]);
            if sign * latest.1 <= 0.0 {
                let earlier = (t - points[1].0) * (points[2].0 - points[0].0) < 0.0;
                return Some(match earlier {
                    true => [points[0], latest, points[1]],
                    false => [points[1], latest, points[2]],
                });
            }
            points = around([points[0], points[1], points[2]], latest, sign);
        }
        None
    }
}

/// The time at which the parabola through three points is extreme, if it is near zero there.
fn vertex([a, b, c]: [Point; 3]) -> Option<f64> {
    let (left, right) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    let bend = (right - left) / (c.0 - a.0);
    let slope = left + bend * (b.0 - a.0); // at b
    let by = -0.5 * slope / bend;
    let value = b.1 + 0.5 * slope * by;
    let near = value * b.1 < 0.5 * b.1 * b.1;
    (near && by != 0.0 && by.is_finite()).then_some(b.0 + by)
}

/// The three points around the smallest value after one more was evaluated.
fn around([a, b, c]: [Point; 3], latest: Point, sign: f64) -> [Point; 3] {
    let earlier = (latest.0 - b.0) * (c.0 - a.0) < 0.0;
    match (sign * latest.1 < sign * b.1, earlier) {
        (true, true) => [a, latest, b],
        (true, false) => [b, latest, c],
        (false, true) => [latest, b, c],
        (false, false) => [a, b, latest],
    }
}
