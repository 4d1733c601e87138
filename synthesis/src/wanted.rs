//! The task of a coupler: places of its point with angles of its frame or of the crank, and four-bars near it.

use super::defects::{Linkage, Output};
use super::fit::{Posed, Targets};
use super::plane::{abs, angle, closed, conjugate, cross, scaled, turn, unit};
use kempe::math::{Complex, Field};

/// A four-bar is exact if its largest error is below this share of the task.
pub(crate) const EXACT: f64 = 1e-10;
/// Steps of the method, and the factors of the closure for approximations.
pub(crate) const STEPS: usize = 200;
pub(crate) const CLOSING: [f64; 2] = [10.0, 1e3];
/// Two exact four-bars are the same within this share of their size.
pub(crate) const SAME_BARS: f64 = 1e-6;

/// Positions of the coupler.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Of the coupler point, m.
    pub places: Vec<Complex>,
    /// Angles of the moving frame, rad; empty if they are free.
    pub frames: Vec<f64>,
    /// Angles of the crank, rad; empty if they are free.
    pub cranks: Vec<f64>,
    /// Whether the crank angles have a free origin.
    pub offset: bool,
    /// The ground pivots of crank and rocker, if they are fixed.
    pub pivots: [Option<Complex>; 2],
}

/// A four-bar with the places of its coupler point.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The four-bar.
    pub linkage: Linkage,
    /// Its coupler point at each position, m.
    pub points: Vec<Complex>,
    /// The angle of the moving frame at the first position, rad.
    pub frame: f64,
    /// The largest error, m and rad.
    pub error: f64,
}

impl Wanted {
    fn centre(&self) -> Complex {
        let sum = self.places.iter().fold(Complex::new(0.0, 0.0), |sum, at| sum + *at);
        scaled(sum, 1.0 / self.places.len() as f64)
    }

    /// The unit of relative places: the largest distance from the first place.
    pub(crate) fn size(&self) -> f64 {
        let far = self.places.iter().map(|at| abs(*at - self.places[0]));
        far.fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Places relative to the task.
    pub(crate) fn relative(&self, at: &[Complex]) -> Vec<Complex> {
        let (centre, size) = (self.centre(), self.size());
        at.iter().map(|at| scaled(*at - centre, 1.0 / size)).collect()
    }

    /// Whether a four-bar can be exact: equations do not outnumber unknowns.
    pub(crate) fn is_exact(&self) -> bool {
        let (n, fixed) = (self.places.len(), 2 * self.pivots.iter().flatten().count());
        match (self.frames.is_empty(), self.cranks.is_empty()) {
            (false, _) => 2 * (n - 1) + fixed <= 8,
            (_, false) => 2 * n + fixed <= 9 + usize::from(self.offset),
            _ => n + fixed <= 9,
        }
    }

    /// Some of the positions.
    pub(crate) fn part(&self, chosen: &[usize]) -> Self {
        let of = |all: &[f64]| chosen.iter().filter_map(|k| all.get(*k).copied()).collect();
        let places = chosen.iter().map(|k| self.places[*k]).collect();
        Self { places, frames: of(&self.frames), cranks: of(&self.cranks), ..self.clone() }
    }

    fn targets(&self) -> Targets {
        let mut free = [true; 11];
        for (pivot, k) in self.pivots.iter().zip([0, 6]) {
            (free[k], free[k + 1]) = (pivot.is_none(), pivot.is_none());
        }
        (free[9], free[10]) = (!self.frames.is_empty(), !self.cranks.is_empty() && self.offset);
        let units = |all: &[f64]| all.iter().map(|angle| turn(*angle)).collect();
        let places = self.relative(&self.places);
        let (frames, cranks) = (units(&self.frames), units(&self.cranks));
        Targets { places, frames, cranks, free, ridge: 0.0, side: 0.0 }
    }

    /// A four-bar near a start with its sum of squares. An approximation closes better and better.
    pub(crate) fn fitted(&self, start: Posed) -> (Posed, f64) {
        let closing = if self.is_exact() { &[1.0] } else { &CLOSING[..] };
        self.near(start, closing, STEPS)
    }

    /// The same for other factors of the closure, and numbers of steps.
    pub(crate) fn near(&self, mut start: Posed, closing: &[f64], steps: usize) -> (Posed, f64) {
        self.place(&mut start);
        let targets = self.targets();
        let begin = (start, f64::INFINITY);
        closing.iter().fold(begin, |(at, _), factor| targets.fitted(at, *factor, steps))
    }

    /// The same on the closure of the first position, with a factor of the lengths for each position.
    pub(crate) fn on_branch(&self, mut start: Posed, steps: usize, ridge: f64) -> (Posed, f64) {
        self.place(&mut start);
        let side = cross(start.pivots()[1] - start.pin(0), start.at[0][1]);
        let ridge = ridge * (self.places.len() as f64).sqrt();
        Targets { ridge, side, ..self.targets() }.fitted(start, CLOSING[1], steps)
    }

    /// Put the pivots of a start where they are fixed.
    fn place(&self, start: &mut Posed) {
        for (pivot, k) in self.pivots.iter().zip([0, 6]) {
            if let Some(at) = pivot {
                let at = self.relative(&[*at])[0];
                (start.lengths[k], start.lengths[k + 1]) = (at.re, at.im);
            }
        }
    }

    /// A four-bar as a start.
    pub(crate) fn start_of(&self, of: &Traced) -> Posed {
        let [o, _, _, d] = corners(&of.linkage);
        let pivots = self.relative(&[o, d]);
        let [a, b, p] = [&of.linkage.a, &of.linkage.b, &of.points].map(|at| self.relative(at));
        let (o, d) = (pivots[0], pivots[1]);
        let pairs = a.iter().zip(&b);
        let at: Vec<_> = pairs.map(|(a, b)| [unit(*a - o), unit(*b - *a)]).collect();
        let point = (p[0] - a[0]) * conjugate(at[0][1]);
        let lengths = [
            o.re,
            o.im,
            abs(a[0] - o),
            abs(b[0] - a[0]),
            point.re,
            point.im,
            d.re,
            d.im,
            abs(b[0] - d),
        ];
        Posed { lengths, turned: self.turned(&at, of.frame), at }
    }

    /// What is added to the angles of crank and coupler to get the given ones.
    fn turned(&self, at: &[[Complex; 2]], frame: f64) -> [Complex; 2] {
        let one = Complex::new(1.0, 0.0);
        let own = at.iter().zip(&self.cranks).map(|(at, given)| turn(*given) * conjugate(at[0]));
        let crank =
            if self.offset { own.fold(Complex::new(0.0, 0.0), |sum, z| sum + z) } else { one };
        let crank = if self.cranks.is_empty() { one } else { unit(crank) };
        let frames = if self.frames.is_empty() { one } else { turn(frame) * conjugate(at[0][1]) };
        [crank, frames]
    }

    /// The start of a part of this task, with its crank in these directions at all positions.
    pub(crate) fn spread(&self, part: &Self, start: &Posed, cranks: &[Complex]) -> Posed {
        let ratio = part.size() / self.size();
        let shift = scaled(part.centre() - self.centre(), 1.0 / self.size());
        let mut found = start.clone();
        found.lengths.iter_mut().for_each(|x| *x *= ratio);
        for k in [0, 6] {
            found.lengths[k] += shift.re;
            found.lengths[k + 1] += shift.im;
        }
        found.at = cranks.iter().map(|crank| [*crank, *crank]).collect();
        for (k, place) in self.relative(&self.places).into_iter().enumerate() {
            found.at[k][1] = unit((place - found.pin(k)) * conjugate(found.point()));
        }
        found
    }

    /// A four-bar of some unknowns, closed exactly at its crank angles.
    pub(crate) fn traced(&self, of: &Posed) -> Traced {
        let (centre, size) = (self.centre(), self.size());
        let [o, d] = of.pivots();
        let [_, _, _, bar, .., c] = of.lengths;
        let (mut a, mut b, mut points) = (Vec::new(), Vec::new(), Vec::new());
        let (mut error, mut first) = (0.0_f64, 0.0);
        for (k, place) in self.relative(&self.places).into_iter().enumerate() {
            let pin = of.pin(k);
            let along = closed(d - pin, [bar, c], cross(d - pin, of.at[k][1]));
            let (other, point) = (pin + scaled(along, bar), pin + of.point() * along);
            let apart = abs(point - place).max((abs(other - d) - c.abs()).abs()) * size;
            let frame = along * of.turned[1];
            let crank = of.at[k][0] * of.turned[0];
            let off = |given: &[f64], own: Complex| {
                given.get(k).map_or(0.0, |given| angle(conjugate(turn(*given)) * own).abs())
            };
            error = error.max(apart).max(off(&self.frames, frame)).max(off(&self.cranks, crank));
            first = if k == 0 { angle(frame) } else { first };
            a.push(centre + scaled(pin, size));
            b.push(centre + scaled(other, size));
            points.push(centre + scaled(point, size));
        }
        let outward = |at: Complex| centre + scaled(at, size);
        let linkage = Linkage { o: outward(o), a, b, output: Output::Rocker(outward(d)) };
        Traced { linkage, points, frame: first, error }
    }

    /// The best of four-bars near some starts, each once.
    pub fn best(&self, starts: &[Traced]) -> Vec<Traced> {
        let fitted = starts.iter().map(|one| self.fitted(self.start_of(one)).0);
        distinct(fitted.map(|one| self.traced(&one)), SAME_BARS)
    }
}

/// Each four-bar once, those with the least error first. Two of them are the same if they differ by less than a share of
/// their size. Those that are not finite are left out.
pub(crate) fn distinct(all: impl IntoIterator<Item = Traced>, near: f64) -> Vec<Traced> {
    let mut kept: Vec<Traced> = Vec::new();
    for one in all {
        let [o, a, b, d] = corners(&one.linkage);
        let centre = scaled(o + a + b + d, 0.25);
        let size = [o, a, b, d].iter().map(|z| abs(*z - centre)).fold(0.0, f64::max);
        let is_same = |other: &Traced| {
            let of = corners(&other.linkage);
            let are = |own: [Complex; 4]| (0..4).all(|k| abs(own[k] - of[k]) < near * size);
            are([o, a, b, d]) || are([d, b, a, o])
        };
        if one.error.is_finite() && !kept.iter().any(is_same) {
            kept.insert(kept.partition_point(|other| other.error <= one.error), one);
        }
    }
    kept
}

/// O, A, B and D at the first position.
fn corners(of: &Linkage) -> [Complex; 4] {
    let (Output::Rocker(end) | Output::Slide(end)) = of.output;
    [of.o, of.a[0], of.b[0], end]
}

/// Both cognates of a four-bar (Roberts 1875): their points trace the same curve.
pub(crate) fn cognates(of: &Traced) -> Vec<Traced> {
    let [o, _, _, d] = corners(&of.linkage);
    let (a, b) = (&of.linkage.a, &of.linkage.b);
    let share = (of.points[0] - a[0]) * (b[0] - a[0]).reciprocal();
    let third = o + share * (d - o);
    let rest = Complex::new(1.0, 0.0) - share;
    let pairs = || a.iter().zip(b);
    let at_o = Linkage {
        o: third,
        a: b.iter().map(|b| third + share * (*b - d)).collect(),
        b: pairs().map(|(a, b)| o + share * (*b - *a)).collect(),
        output: Output::Rocker(o),
    };
    let at_d = Linkage {
        o: third,
        a: a.iter().map(|a| third + rest * (*a - o)).collect(),
        b: pairs().map(|(a, b)| d - rest * (*b - *a)).collect(),
        output: Output::Rocker(d),
    };
    let traced = |linkage: Linkage| {
        let frame = angle(linkage.b[0] - linkage.a[0]);
        Traced { linkage, frame, ..of.clone() }
    };
    vec![traced(at_o), traced(at_d)]
}
