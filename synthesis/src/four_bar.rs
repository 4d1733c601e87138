//! A four-bar of a task with names for its points, at the first position.

use super::defects::{Linkage, Output};
use super::plane::{abs, turn};
use super::ranked::Ranked;
use kempe::math::Complex;
use std::f64::consts::TAU;

/// A four-bar at the first position of its task.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    /// O, A, B, D and P: pivot and pin of the crank, pin and pivot of the rocker, and the origin of the moving frame.
    pub pins: [Complex; 5],
    /// The angle of the moving frame, rad.
    pub frame: f64,
}

impl FourBar {
    /// Outputs of its motion.
    pub const OUTPUTS: f64 = 180.0;

    /// The four-bar of a candidate, with the place and the angle of its moving frame at the first position.
    pub fn of(linkage: &Linkage, ranked: &Ranked, (p, frame): (Complex, f64)) -> Self {
        let (o, a, b) = (linkage.o, linkage.a[0], linkage.b[0]);
        let d = match linkage.output {
            Output::Rocker(d) => d,
            Output::Slide(_) => b,
        };
        let pins = if ranked.reversed { [d, b, a, o, p] } else { [o, a, b, d, p] };
        Self { pins, frame }
    }

    /// A, B and P in the moving frame.
    pub fn corners(&self) -> [Complex; 3] {
        let [_, a, b, _, p] = self.pins;
        let back = turn(-self.frame);
        [(a - p) * back, (b - p) * back, Complex::new(0.0, 0.0)]
    }

    /// The largest distance of two points.
    pub fn size(&self) -> f64 {
        let far = |x: &Complex| self.pins.iter().map(|y| abs(*y - *x)).fold(0.0, f64::max);
        self.pins.iter().map(far).fold(0.0, f64::max)
    }

    /// The angle of the crank at the start, its speed, and the end of the motion, s. A crank that turns fully makes one
    /// turn in 1 s, any other one moves through the positions of the task.
    pub fn drive(&self, ranked: &Ranked) -> (f64, f64, f64) {
        let angles = &ranked.crank_angles;
        let (first, last) = (angles[0], angles[angles.len() - 1]);
        let rate = if last >= first { TAU } else { -TAU };
        let end = if ranked.judged.turns { 1.0 } else { ((last - first).abs() / TAU).max(1e-3) };
        (first, rate, end)
    }
}
