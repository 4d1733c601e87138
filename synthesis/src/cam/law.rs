//! Motion laws as pieces. All derivatives are exact.

use kempe::math::Spline;
use kempe::solve::solve_dense;
use std::f64::consts::{FRAC_PI_2, PI};

/// The named laws of a segment.
pub const LAWS: [&str; 7] = [
    "cycloidal",
    "harmonic",
    "modified_sine",
    "modified_trapezoid",
    "linear",
    "poly345",
    "poly4567",
];
/// Pieces of a spline that are shorter, relative to their segment, are left out.
const SHORTEST: f64 = 1e-12;

/// s = Σ powers[k] x^k + amplitude sin(frequency x + phase) for x = angle - start ≥ 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The angle of the cam where it begins, rad.
    pub start: f64,
    /// The angle where it ends.
    pub end: f64,
    /// Coefficients of the polynomial.
    pub powers: Vec<f64>,
    /// Amplitude, frequency and phase of the sine.
    pub wave: [f64; 3],
}

impl Piece {
    /// The derivative of an order at an angle, also beyond the ends.
    pub fn at(&self, angle: f64, order: usize) -> f64 {
        let x = angle - self.start;
        let powers = self.powers.iter().enumerate().skip(order).rev();
        let sum = powers.fold(0.0, |sum, (k, c)| sum * x + c * falling(k, order));
        let [amplitude, frequency, phase] = self.wave;
        if amplitude == 0.0 {
            return sum;
        }
        let turned = frequency * x + phase + order as f64 * FRAC_PI_2;
        sum + amplitude * frequency.powi(order as i32) * turned.sin()
    }

    /// Lift and three derivatives.
    pub fn rows(&self, angle: f64) -> [f64; 4] {
        std::array::from_fn(|order| self.at(angle, order))
    }

    /// A piece of the unit law, stretched to a segment.
    fn placed(&self, at: &Place, height: f64) -> Self {
        let mut powers: Vec<f64> = Vec::with_capacity(self.powers.len());
        powers.extend((0i32..).zip(&self.powers).map(|(k, c)| height * c / at.length.powi(k)));
        powers[0] += at.lift;
        let [amplitude, frequency, phase] = self.wave;
        Self {
            start: at.angle + at.length * self.start,
            end: at.angle + at.length * self.end,
            powers,
            wave: [height * amplitude, frequency / at.length, phase],
        }
    }
}

/// k!/(k - order)!
fn falling(k: usize, order: usize) -> f64 {
    (k + 1 - order..=k).map(|factor| factor as f64).product()
}

/// Where a segment is: its first angle and lift, its length and its change of the lift.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The angle where it begins, rad.
    pub angle: f64,
    /// Its angle, rad.
    pub length: f64,
    /// The lift where it begins.
    pub lift: f64,
    /// The change of the lift.
    pub height: f64,
}

/// The law of a segment. Ends have derivatives by the angle, the speed first.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// One of [`LAWS`].
    Named(String),
    /// The polynomial of least degree with these derivatives at its ends.
    Polynomial([Vec<f64>; 2]),
    /// The quintic spline through points of angle, from the beginning of the segment, and lift.
    Spline([Vec<f64>; 2], Vec<[f64; 2]>),
}

/// Why a law has no pieces.
pub enum Unlawful {
    /// There is no law with this name.
    Unknown,
    /// The points of a spline do not follow each other.
    Points,
    /// A spline has not two derivatives at each end.
    Ends,
}

impl Law {
    /// The pieces of a segment.
    pub fn pieces(&self, at: &Place) -> Result<Vec<Piece>, Unlawful> {
        match self {
            Self::Named(name) => {
                let found = unit_law(name).ok_or(Unlawful::Unknown)?;
                Ok(found.iter().map(|one| one.placed(at, at.height)).collect())
            }
            Self::Polynomial(ends) => Ok(vec![polynomial(ends, at)]),
            Self::Spline(ends, points) => spline(ends, points, at),
        }
    }
}

/// Accelerations of the laws that are joined sines: the factor of the law, and for each piece its end, and the constant,
/// the amplitude, the frequency and the phase at its beginning (Norton, Cam Design and Manufacturing Handbook, chapters
/// 2 and 3).
fn joined(name: &str) -> Option<(f64, &'static [[f64; 5]])> {
    const FAST: f64 = 4.0 * PI;
    Some(match name {
        "cycloidal" => (2.0 * PI, &[[1.0, 0.0, 1.0, 2.0 * PI, 0.0]]),
        "harmonic" => (PI * PI / 2.0, &[[1.0, 0.0, 1.0, PI, FRAC_PI_2]]),
        "modified_sine" => (
            4.0 * PI * PI / (4.0 + PI),
            &[
                [0.125, 0.0, 1.0, FAST, 0.0],
                [0.875, 0.0, 1.0, FAST / 3.0, FRAC_PI_2],
                [1.0, 0.0, 1.0, FAST, -FRAC_PI_2],
            ],
        ),
        "modified_trapezoid" => (
            8.0 * PI / (2.0 + PI),
            &[
                [0.125, 0.0, 1.0, FAST, 0.0],
                [0.375, 1.0, 0.0, 1.0, 0.0],
                [0.625, 0.0, 1.0, FAST, FRAC_PI_2],
                [0.875, -1.0, 0.0, 1.0, 0.0],
                [1.0, 0.0, 1.0, FAST, -FRAC_PI_2],
            ],
        ),
        _ => return None,
    })
}

/// The pieces of a named law, which rises from 0 at 0 to 1 at 1.
fn unit_law(name: &str) -> Option<Vec<Piece>> {
    let powers: &[f64] = match name {
        "linear" => &[0.0, 1.0],
        "poly345" => &[0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
        "poly4567" => &[0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0],
        _ => {
            let (factor, given) = joined(name)?;
            let [mut start, mut place, mut speed] = [0.0; 3];
            let mut made = Vec::new();
            for &[end, constant, amplitude, frequency, phase] in given {
                let size = -amplitude * factor / (frequency * frequency);
                let powers = vec![
                    place - size * phase.sin(),
                    speed - size * frequency * phase.cos(),
                    constant * factor / 2.0,
                ];
                let piece = Piece { start, end, powers, wave: [size, frequency, phase] };
                [start, place, speed] = [end, piece.at(end, 0), piece.at(end, 1)];
                made.push(piece);
            }
            return Some(made);
        }
    };
    Some(vec![Piece { start: 0.0, end: 1.0, powers: powers.to_vec(), wave: [0.0, 1.0, 0.0] }])
}

/// The polynomial of least degree with given derivatives at both ends.
fn polynomial(ends: &[Vec<f64>; 2], at: &Place) -> Piece {
    let count = ends[0].len() + ends[1].len() + 2;
    let (mut rows, mut powers) = (Vec::new(), Vec::new());
    for (x, lift, end) in [(0.0, 0.0, &ends[0]), (1.0, at.height, &ends[1])] {
        for (order, known) in std::iter::once(&lift).chain(end).enumerate() {
            let entry = |k: usize| match k.cmp(&order) {
                std::cmp::Ordering::Less => 0.0,
                std::cmp::Ordering::Equal => falling(k, order),
                std::cmp::Ordering::Greater => falling(k, order) * x,
            };
            rows.extend((0..count).map(entry));
            powers.push(known * at.length.powi(order as i32));
        }
    }
    solve_dense(&mut rows, &mut powers);
    Piece { start: 0.0, end: 1.0, powers, wave: [0.0, 1.0, 0.0] }.placed(at, 1.0)
}

/// The quintic spline through points.
fn spline(ends: &[Vec<f64>; 2], points: &[[f64; 2]], at: &Place) -> Result<Vec<Piece>, Unlawful> {
    let inner = points.iter().map(|[angle, lift]| [angle / at.length, lift - at.lift]);
    let places = std::iter::once([0.0, 0.0]).chain(inner).chain([[1.0, at.height]]);
    let (x, y): (Vec<f64>, Vec<f64>) = places.map(|[x, y]| (x, y)).unzip();
    if !x.windows(2).all(|pair| pair[1] - pair[0] > super::programme::SAME) {
        return Err(Unlawful::Points);
    }
    let scaled = |end: &Vec<f64>| match end[..] {
        [speed, bend] => Ok([speed * at.length, bend * at.length * at.length]),
        _ => Err(Unlawful::Ends),
    };
    let found = Spline::clamped(&x, &y, [scaled(&ends[0])?, scaled(&ends[1])?]);
    let pieces = x.windows(2).zip(&found).filter(|(of, _)| of[1] - of[0] > SHORTEST);
    let placed = |(of, powers): (&[f64], &[f64; 6])| {
        let unit =
            Piece { start: of[0], end: of[1], powers: powers.to_vec(), wave: [0.0, 1.0, 0.0] };
        unit.placed(at, 1.0)
    };
    Ok(pieces.map(placed).collect())
}
