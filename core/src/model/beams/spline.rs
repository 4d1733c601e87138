//! A curved centre line through given points: a natural cubic spline over the accumulated chord length, and its arc
//! length.

use super::super::problem::Problem;
use crate::math::{Interpolation, Listed, ShortArray, Spline};

/// Gauss points and weights of a panel of the arc length, on [0, 1] (degree 9).
const RULE: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];
/// Panels between two points.
const PANELS: usize = 32;

/// A curve with a table of its arc length.
#[derive(Clone, Debug)]
pub struct Curved {
    x: Spline,
    y: Spline,
    /// Parameter and arc length at the borders of the panels.
    table: Vec<[f64; 2]>,
}

impl Curved {
    /// The curve through at least three points. None if two successive points are equal.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let mut knots = vec![0.0];
        for pair in points.windows(2) {
            let chord = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
            if !(chord > 0.0 && chord.is_finite()) {
                return None;
            }
            knots.push(knots[knots.len() - 1] + chord);
        }
        let of = |k: usize| {
            let values: Vec<f64> = points.iter().map(|point| point[k]).list();
            Spline::new(Interpolation::Cubic, false, &knots, &values)
        };
        let mut curved = Self { x: of(0), y: of(1), table: vec![[0.0, 0.0]] };
        let mut s = 0.0;
        for pair in knots.windows(2) {
            for panel in 0..PANELS {
                let step = (pair[1] - pair[0]) / PANELS as f64;
                let from = pair[0] + step * panel as f64;
                s += curved.arc(from, step);
                curved.table.push([from + step, s]);
            }
        }
        Some(curved)
    }

    /// Value and derivative of x and y.
    fn at(&self, u: f64) -> [[f64; 2]; 2] {
        [&self.x, &self.y].each(|spline| spline.derivatives::<f64, 2>(u, |number| number))
    }

    fn speed(&self, u: f64) -> f64 {
        let [x, y] = self.at(u);
        x[1].hypot(y[1])
    }

    /// The arc length of a panel.
    fn arc(&self, from: f64, step: f64) -> f64 {
        RULE.iter().map(|(at, weight)| weight * step * self.speed(from + at * step)).sum()
    }

    /// Arc length.
    pub fn length(&self) -> f64 {
        self.table.last().map_or(0.0, |[_, s]| *s)
    }

    /// The parameter at an arc length, by Newton's method.
    fn parameter(&self, s: f64) -> f64 {
        let k = self.table.partition_point(|[_, at]| *at <= s).clamp(1, self.table.len() - 1);
        let ([u0, s0], [u1, s1]) = (self.table[k - 1], self.table[k]);
        let mut u = u0 + (u1 - u0) * (s - s0) / (s1 - s0);
        for _ in 0..4 {
            u -= (s0 + self.arc(u0, u - u0) - s) / self.speed(u);
        }
        u
    }

    /// Position and direction of the tangent at an arc length.
    fn global(&self, s: f64) -> [f64; 3] {
        let [x, y] = self.at(self.parameter(s));
        [x[0], y[0], y[1].atan2(x[1])]
    }

    /// The pose of the first end.
    pub fn first(&self) -> [f64; 3] {
        self.global(0.0)
    }

    /// Positions and continuous angles at growing arc lengths, in the frame of the first end.
    pub fn places(&self, lengths: &[f64]) -> Vec<[f64; 3]> {
        let [x0, y0, angle0] = self.first();
        let (sin, cos) = angle0.sin_cos();
        let mut before = 0.0;
        let at = |s: &f64| {
            let [x, y, angle] = self.global(*s);
            let (dx, dy) = (x - x0, y - y0);
            let turn = std::f64::consts::TAU;
            let turned = angle - angle0;
            let turned = turned - turn * ((turned - before) / turn).round();
            before = turned;
            [cos * dx + sin * dy, cos * dy - sin * dx, turned]
        };
        lengths.iter().map(at).list()
    }
}

/// Reports a centre line through points that crosses itself.
pub fn crossing(line: &[[f64; 2]]) -> Option<[f64; 2]> {
    let side = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| {
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    };
    for (k, first) in line.windows(2).enumerate() {
        for second in line.windows(2).skip(k + 2) {
            let one = side(first[0], first[1], second[0]) * side(first[0], first[1], second[1]);
            let other = side(second[0], second[1], first[0]) * side(second[0], second[1], first[1]);
            if one < 0.0 && other < 0.0 {
                return Some(second[0]);
            }
        }
    }
    None
}

/// The problem of a centre line that crosses itself.
pub fn crosses(path: &[String], [x, y]: [f64; 2]) -> Problem {
    let message = format!("the centre line crosses itself near ({x:.6}, {y:.6})");
    Problem::at(path, message)
        .hint("divide it into two beams, whose ends meet at a joint or a weld")
}
