//! Random four-bars with springs against an independent potential of one variable.

use super::rest;
use crate::mechanisms::{column, linkage, model, start, Random, GRAVITY};
use std::f64::consts::{PI, TAU};

/// A crank-rocker with masses and two springs.
struct FourBar {
    /// Ground, crank, coupler, rocker.
    lengths: [f64; 4],
    masses: [f64; 3],
    /// Stiffness, free angle of a spring at the crank; stiffness, free length of one to the coupler's joint.
    springs: [f64; 4],
}

impl FourBar {
    fn random(random: &mut Random) -> Self {
        let mut any = |least: f64, most: f64| least + (most - least) * 0.5 * (1.0 + random.next());
        let ground = any(2.0, 3.0);
        let lengths = [ground, any(0.4, 0.6), ground * any(0.85, 1.15), any(1.0, 1.4)];
        Self {
            lengths,
            masses: [any(0.5, 3.0), any(0.5, 3.0), any(0.5, 3.0)],
            springs: [any(2.0, 20.0), any(-PI, PI), any(5.0, 60.0), any(0.2, 1.5)],
        }
    }

    fn text(&self) -> String {
        let [k, free, s, l] = self.springs;
        let text = linkage(self.lengths, self.masses).replace("D = [", "S = [0.5, 1.6], D = [");
        format!(
            "{GRAVITY}{text}\
             [forces.turn]\ntype = 'torsion_spring'\ni = 'ground'\nj = 'crank'\nstiffness = {k}\nfree_angle = {free}\n\
             [forces.pull]\ntype = 'spring_damper'\ni = 'ground.S'\nj = 'coupler.C'\nstiffness = {s}\nfree_length = {l}\n"
        )
    }

    /// The potential at a crank angle, with C to the left of the way from B to D.
    fn potential(&self, x: f64) -> f64 {
        let Self { lengths: [g, a, b, c], masses: [m1, m2, m3], springs: [k, free, s, l] } = self;
        let (by, bx) = (a * x.sin(), a * x.cos());
        let (dx, dy) = (g - bx, -by);
        let d = dx.hypot(dy);
        let along = (d * d + b * b - c * c) / (2.0 * d);
        let aside = (b * b - along * along).sqrt();
        let (cx, cy) = (bx + (along * dx - aside * dy) / d, by + (along * dy + aside * dx) / d);
        let weight = 9.81 * (m1 * by / 2.0 + m2 * (by + cy) / 2.0 + m3 * cy / 2.0);
        let stretch = (cx - 0.5).hypot(cy - 1.6) - l;
        weight + 0.5 * k * (x - free) * (x - free) + 0.5 * s * stretch * stretch
    }

    /// Its derivative by a difference of sixth order, with an error near 1e-11.
    fn slope(&self, x: f64) -> f64 {
        let h = 4e-3;
        let pair = |n: f64| self.potential(x + n * h) - self.potential(x - n * h);
        (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
    }

    /// The zero of the slope near x, by bisection.
    fn minimum(&self, x: f64) -> f64 {
        let (mut low, mut high) = (x - 1e-3, x + 1e-3);
        assert!(self.slope(low) < 0.0 && self.slope(high) > 0.0, "no minimum near {x}");
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.slope(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

#[test]
fn fifty_four_bars_rest_in_minima() {
    let mut random = Random::new(11);
    for case in 0..50 {
        let four_bar = FourBar::random(&mut random);
        let m = model(&four_bar.text());
        let at = format!("{}", PI * random.next());
        let (mut state, _) =
            start(&m, &[("crank.angle", &at)], &[("coupler.angle", "0.6"), ("rocker.angle", "2")]);
        // the other way of closing the loop is another mechanism
        let angle = column(&m, "crank", 2);
        let c = |q: &[f64]| {
            let rocker = column(&m, "rocker", 2);
            let d = [four_bar.lengths[0], 0.0];
            let (b, x) = (four_bar.lengths[1], q[angle]);
            let (bx, by) = (b * x.cos(), b * x.sin());
            let (cx, cy) = (
                d[0] + four_bar.lengths[3] * q[rocker].cos(),
                four_bar.lengths[3] * q[rocker].sin(),
            );
            (d[0] - bx) * (cy - by) - (d[1] - by) * (cx - bx)
        };
        if c(&state.q) < 0.0 {
            let guess = [("coupler.angle", "0.9"), ("rocker.angle", "1.4")];
            state = start(&m, &[("crank.angle", &at)], &guess).0;
        }
        assert!(c(&state.q) > 0.0, "{case}");
        // the spring of the crank counts turns
        let turns = (state.q[angle] / TAU).round() * 0.0;
        let found = rest(&m, &state);
        let x = found.state.q[angle] + turns;
        let exact = four_bar.minimum(x);
        assert!((x - exact).abs() < 1e-10, "{case}: {x} {exact}");
        assert!(found.stable && found.residual < 1e-12, "{case}: {:?}", found.eigenvalues);
        assert!(
            four_bar.potential(x) <= four_bar.potential(state.q[angle]) + 1e-9,
            "{case}: higher"
        );
    }
}
