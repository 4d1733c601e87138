//! An atlas of coupler curves: four-bars of a coarse grid whose curves resemble a drawn one.
//!
//! All curves have points at equal distances along them, so that the speed of the crank does not matter. For points z and
//! w as complex numbers, z with the mean 0 and the length 1, the best similarity w ↦ T + S w has S = ⟨w, z⟩/|w - w̄|², and
//! leaves 1 - |⟨w, z⟩|²/|w - w̄|². Curves of the mirrored four-bar are those of w̄, and a window of a curve may be passed in
//! both directions. Of the points of the coupler on the grid, the best one is kept for each four-bar.

use crate::fit::Posed;
use crate::plane::{abs, closed, conjugate, scaled, unit};
use kempe::math::Complex;

/// Crank angles of a turn, and points of a curve at equal distances.
const ANGLES: usize = 64;
const PLACES: usize = 90;
/// Points of a window, their distances, and the distances of windows.
const OPEN: usize = 10;
const STRIDES: [usize; 7] = [1, 2, 3, 4, 6, 8, 10];
const CLOSED: usize = 15;
/// Powers of √2 of crank, coupler and rocker, with the ground 1.
const CRANKS: std::ops::Range<i32> = -5..4;
const OTHERS: std::ops::Range<i32> = -3..5;
/// The points of the coupler in lengths of the coupler, from A, along and across it.
const ALONG: [f64; 5] = [-0.75, 0.0, 0.5, 1.0, 1.75];
const ACROSS: [f64; 5] = [-1.2, -0.5, 0.0, 0.5, 1.2];
/// Fewest crank angles of a crank that does not turn fully.
const FEWEST: usize = 12;

/// Crank, coupler and rocker of a four-bar with ground 1, and the point in the frame of the coupler.
type Bars = ([f64; 3], Complex);

/// A window of the curve of a four-bar that resembles the drawn curve.
#[derive(Clone, Debug)]
pub(super) struct Likeness {
    /// 1 where it is the same.
    pub(super) likeness: f64,
    bars: Bars,
    /// The first place of the window, and the distance of its points along the curve.
    first: usize,
    stride: usize,
    reversed: bool,
    mirrored: bool,
}

/// A curve that is drawn, in the frame of its task.
pub(super) struct Drawn {
    /// Points at equal distances along the curve, with the mean 0 and the length 1.
    even: Vec<Complex>,
    centre: Complex,
    size: f64,
    /// Where the given points are along the curve, from 0 to 1.
    along: Vec<f64>,
    closed: bool,
}

/// A curve as a line through points, with the distance of each of them from its begin.
struct Course {
    points: Vec<Complex>,
    far: Vec<f64>,
}

impl Course {
    /// The course through some points, at last through the first one again if it is closed.
    fn new(mut points: Vec<Complex>, closed: bool) -> Self {
        if closed {
            points.push(points[0]);
        }
        let mut far = vec![0.0];
        for two in points.windows(2) {
            far.push(far[far.len() - 1] + abs(two[1] - two[0]));
        }
        Self { points, far }
    }

    fn length(&self) -> f64 {
        self.far[self.far.len() - 1]
    }

    /// The number of the point before a distance, and the share of the way to the next one.
    fn before(&self, far: f64) -> (usize, f64) {
        let k = self.far.partition_point(|at| *at <= far).clamp(1, self.far.len() - 1) - 1;
        let step = self.far[k + 1] - self.far[k];
        (k, if step > 0.0 { ((far - self.far[k]) / step).clamp(0.0, 1.0) } else { 0.0 })
    }

    fn at(&self, far: f64) -> Complex {
        let (k, share) = self.before(far);
        self.points[k] + scaled(self.points[k + 1] - self.points[k], share)
    }

    /// Points at equal distances; the last one is not the first one of a closed course.
    fn even(&self, n: usize, closed: bool) -> Vec<Complex> {
        let step = self.length() / (n - usize::from(!closed)) as f64;
        (0..n).map(|k| self.at(step * k as f64)).collect()
    }
}

impl Drawn {
    /// A curve through points, which is closed if its ends are as near as its points.
    pub(super) fn new(places: &[Complex]) -> Self {
        let steps = places.windows(2).map(|two| abs(two[1] - two[0]));
        let gap = abs(places[0] - places[places.len() - 1]);
        let closed = gap < 1.5 * steps.fold(0.0, f64::max);
        let course = Course::new(places.to_vec(), closed);
        let even = course.even(if closed { CLOSED } else { OPEN }, closed);
        let count = even.len() as f64;
        let centre =
            scaled(even.iter().fold(Complex::new(0.0, 0.0), |sum, at| sum + *at), 1.0 / count);
        let size = even.iter().map(|at| square(*at - centre)).sum::<f64>().sqrt();
        let even = even.iter().map(|at| scaled(*at - centre, 1.0 / size)).collect();
        let along = course.far.iter().take(places.len()).map(|far| far / course.length()).collect();
        Self { even, centre, size, along, closed }
    }

    /// The four-bars of the grid, the one whose curve resembles the drawn one most first.
    pub(super) fn similar(&self) -> Vec<Likeness> {
        let length = |power: i32| {
            let whole = f64::from(1_u32 << (power + 6).div_euclid(2)) / 8.0;
            if power.rem_euclid(2) == 0 {
                whole
            } else {
                whole * std::f64::consts::SQRT_2
            }
        };
        let mut found: Vec<Likeness> = Vec::new();
        for a in CRANKS {
            for b in OTHERS {
                for c in OTHERS {
                    if let Some(one) = self.best_of([a, b, c].map(length)) {
                        let k = found.partition_point(|other| other.likeness >= one.likeness);
                        found.insert(k, one);
                    }
                }
            }
        }
        found
    }

    /// The most similar window of the curves of a four-bar.
    fn best_of(&self, bars: [f64; 3]) -> Option<Likeness> {
        let (cranks, turns) = cranks(bars);
        if cranks.len() < FEWEST || (self.closed && !turns) {
            return None;
        }
        let directions = directions(bars, &cranks);
        let mut best: Option<Likeness> = None;
        for x in ALONG {
            for y in ACROSS {
                let bars = (bars, scaled(Complex::new(x, y), bars[1]));
                let course = Course::new(curve(bars, &directions), turns);
                let places = course.even(PLACES, turns);
                self.windows(bars, &places, turns, &mut best);
            }
        }
        best
    }

    /// Keep the most similar window of a curve.
    fn windows(&self, bars: Bars, places: &[Complex], turns: bool, best: &mut Option<Likeness>) {
        let m = self.even.len();
        let strides = if self.closed { &[PLACES / CLOSED][..] } else { &STRIDES };
        for stride in strides.iter().copied() {
            let last = if turns { PLACES } else { PLACES.saturating_sub(stride * (m - 1)) };
            let step = if self.closed { 2 } else { stride + 1 };
            for first in (0..last).step_by(step) {
                let of = |k: usize| places[(first + stride * k) % PLACES];
                let (mut sum, mut squares) = (Complex::new(0.0, 0.0), 0.0);
                for k in 0..m {
                    sum += of(k);
                    squares += square(of(k));
                }
                let spread = squares - square(sum) / m as f64;
                for reversed in [false, true] {
                    let [plain, mirrored] = self.products(of, reversed);
                    for (inner, mirrored) in [(plain, false), (mirrored, true)] {
                        let likeness = square(inner) / spread;
                        if best.as_ref().is_none_or(|best| likeness > best.likeness) {
                            *best = Some(Likeness {
                                likeness,
                                bars,
                                first,
                                stride,
                                reversed,
                                mirrored,
                            });
                        }
                    }
                }
            }
        }
    }

    /// ⟨w, z⟩ for the points w of a window and for their mirror images.
    fn products(&self, of: impl Fn(usize) -> Complex, reversed: bool) -> [Complex; 2] {
        let m = self.even.len();
        let (mut direct, mut mirrored) = (Complex::new(0.0, 0.0), Complex::new(0.0, 0.0));
        for k in 0..m {
            let (w, z) = (of(if reversed { m - 1 - k } else { k }), self.even[k]);
            let (rr, ii, ri, ir) = (w.re * z.re, w.im * z.im, w.re * z.im, w.im * z.re);
            direct += Complex::new(rr + ii, ri - ir);
            mirrored += Complex::new(rr - ii, ri + ir);
        }
        [direct, mirrored]
    }

    /// A four-bar of the grid, moved onto the drawn curve, with a position for each of its points.
    pub(super) fn start(&self, of: &Likeness) -> Posed {
        let (bars, point) = of.bars;
        let (cranks, turns) = cranks(bars);
        let course = Course::new(curve(of.bars, &directions(bars, &cranks)), turns);
        let places = course.even(PLACES, turns);
        let m = self.even.len();
        let window = |k: usize| places[(of.first + of.stride * k) % PLACES];
        let middle = (0..m).fold(Complex::new(0.0, 0.0), |sum, k| sum + window(k));
        let middle = scaled(middle, 1.0 / m as f64);
        let spread: f64 = (0..m).map(|k| square(window(k) - middle)).sum();
        let mirror = |z: Complex| if of.mirrored { conjugate(z) } else { z };
        let inner = self.products(window, of.reversed)[usize::from(of.mirrored)];
        let by = scaled(inner, self.size / spread);
        let shift = self.centre - by * mirror(middle);
        let ratio = abs(by);
        let turned = |z: Complex| unit(by) * mirror(z);
        // the whole window, or the whole curve
        let step = course.length() / (PLACES - usize::from(!turns)) as f64;
        let span = step * (of.stride * (m - usize::from(!self.closed))) as f64;
        let at = self.along.iter().map(|along| {
            // a closed curve begins at its last point if it is passed the other way
            let begin = if of.reversed && self.closed { of.stride * (m - 1) } else { 0 };
            let along = match (of.reversed, self.closed) {
                (true, false) => span * (1.0 - along),
                (true, true) => step * begin as f64 + span * (1.0 - along),
                _ => span * along,
            };
            let far = (step * of.first as f64 + along).rem_euclid(course.length() * 1.000_000_1);
            let (k, share) = course.before(far);
            let (u, next) = (cranks[k], cranks[(k + 1) % cranks.len()]);
            let u = unit(u + scaled(next - u, share));
            let v = directions(bars, &[u])[0].1;
            [turned(u), turned(v)]
        });
        let at = at.collect();
        let o = shift;
        let d = shift + by;
        let p = scaled(mirror(point), ratio);
        let [a, b, c] = bars.map(|x| x * ratio);
        let lengths = [o.re, o.im, a, b, p.re, p.im, d.re, d.im, c];
        Posed { lengths, turned: [Complex::new(1.0, 0.0); 2], at }
    }
}

fn square(z: Complex) -> f64 {
    z.re * z.re + z.im * z.im
}

/// Directions of the crank at which a four-bar closes, and whether these are all.
fn cranks([a, b, c]: [f64; 3]) -> (Vec<Complex>, bool) {
    // by half angles from a right angle, with the same digits on every machine
    let mut step = Complex::new(0.0, 1.0);
    for _ in 0..ANGLES.ilog2() - 2 {
        step = unit(step + Complex::new(1.0, 0.0));
    }
    let mut at = Complex::new(1.0, 0.0);
    let mut all = Vec::new();
    for _ in 0..ANGLES {
        let far = abs(Complex::new(1.0, 0.0) - scaled(at, a));
        all.push((far > (b - c).abs() && far < b + c).then_some(at));
        at = unit(at * step);
    }
    let Some(gap) = all.iter().position(Option::is_none) else {
        return (all.into_iter().flatten().collect(), true);
    };
    // from the end of a gap to the next one
    let begin = (gap..gap + ANGLES).find(|k| all[k % ANGLES].is_some()).unwrap_or(gap);
    ((begin..begin + ANGLES).map_while(|k| all[k % ANGLES]).collect(), false)
}

/// Directions of crank and coupler on one closure.
fn directions([a, b, c]: [f64; 3], cranks: &[Complex]) -> Vec<(Complex, Complex)> {
    let of = |u: &Complex| {
        let far = Complex::new(1.0, 0.0) - scaled(*u, a);
        (scaled(*u, a), closed(far, [b, c], 1.0))
    };
    cranks.iter().map(of).collect()
}

fn curve((_, point): Bars, directions: &[(Complex, Complex)]) -> Vec<Complex> {
    directions.iter().map(|(pin, along)| *pin + point * *along).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of the path of a four-bar of another size, place and direction.
    fn places(n: usize, part: usize) -> Vec<Complex> {
        let (cranks, turns) = cranks([0.45, 1.2, 1.05]);
        assert!(turns);
        let bars = ([0.45, 1.2, 1.05], Complex::new(0.7, 0.6));
        let all = curve(bars, &directions(bars.0, &cranks[..part]));
        let moved = |z: &Complex| *z * Complex::new(-3.0, 2.0) + Complex::new(5.0, 1.0);
        let course = Course::new(all.iter().map(moved).collect(), part == ANGLES);
        course.even(n, part == ANGLES)
    }

    #[test]
    fn the_atlas_has_curves_like_those_between_its_grid() {
        for part in [ANGLES, 40] {
            let points = places(36, part);
            for turned in [points.clone(), points.iter().rev().copied().collect()] {
                let drawn = Drawn::new(&turned);
                assert_eq!(drawn.closed, part == ANGLES);
                let found = drawn.similar();
                assert!(found.len() > 50 && found[0].likeness > 0.99, "{}", found[0].likeness);
                assert!(found.windows(2).all(|two| two[0].likeness >= two[1].likeness));
                // the start is moved onto the curve: its points are where the likeness says
                let start = drawn.start(&found[0]);
                let at = start.at.iter().enumerate();
                let off =
                    at.map(|(k, at)| square(start.pin(k) + start.point() * at[1] - turned[k]));
                let spread = turned.iter().map(|z| square(*z - drawn.centre)).sum::<f64>();
                let left = off.sum::<f64>() / spread;
                assert!(left < 3.0 * (1.0 - found[0].likeness) + 1e-3, "{left}");
            }
        }
    }

    #[test]
    fn mirrored_curves_are_as_alike() {
        let points = places(36, ANGLES);
        let mirrored: Vec<Complex> = points.iter().map(|z| conjugate(*z)).collect();
        let best = |points: &[Complex]| Drawn::new(points).similar()[0].likeness;
        assert!((best(&points) - best(&mirrored)).abs() < 1e-9);
    }
}
