//! The elastic force between two parallel cylinders of one width that touch along a line.
//!
//! Each cylinder carries the pressure of Hertz on a strip of the half-width a, a² = 4 P R/(π E*), with the load P per width
//! and 1/R = 1/R₁ + 1/R₂. Its centre approaches the strip by P (1 - ν²)/(π E) (2 ln(4 Rₖ/a) - 1) (Johnson, *Contact
//! Mechanics*, 1985, section 5.6). The sum over two cylinders of one material, 1/E* = 2 (1 - ν²)/E, is the depth
//!
//! ```text
//! δ = f (ln(4 ΔR/f) - 1)      f = N/(π E* L)      ΔR = R₁ + R₂
//! ```
//!
//! For a pin in a bush, R₂ < 0 and ΔR = c is the clearance. With δ = 4 ΔR y and f = 4 ΔR exp(-w), this is y = (w - 1)
//! exp(-w). The force grows with the depth for w > 2. At w = 2, y = exp(-2), its slope is infinite, and a strip as narrow as
//! the theory assumes is long exceeded.

use crate::math::{each, Real};

/// The largest y.
const DEEPEST: f64 = 0.135_335_283_236_612_7; // exp(-2)
/// A y in place of one at which there is no force.
const PLACEHOLDER: f64 = 0.05;
/// Most steps of Newton's method. Near the largest y, each one halves the distance.
const STEPS: usize = 60;
/// w of a light load.
const LIGHT: f64 = 14.0;

/// Two cylinders.
#[derive(Clone, Copy)]
pub struct Cylinders<S> {
    /// π E* L, N/m.
    pub stiffness: S,
    /// ΔR, m.
    pub apart: S,
}

impl<S: Real> Cylinders<S> {
    /// Cylinders of one material, of a modulus of elasticity, a ratio of Poisson and a width.
    pub fn new([young, poisson, width]: [S; 3], apart: S) -> Self {
        let reduced = young / (S::constant(2.0) * (S::one() - poisson * poisson));
        Self { stiffness: S::constant(std::f64::consts::PI) * reduced * width, apart }
    }

    /// N at a depth, as an odd function. NaN beyond the largest depth.
    pub fn force(&self, depth: S) -> S {
        let part = (-self.logarithm(depth)).exp();
        let size = S::constant(4.0) * self.stiffness * self.apart * part;
        let negative = S::select(-depth, -size, S::zero());
        S::select(depth, size, negative)
    }

    /// The work of N up to a depth > 0, J.
    pub fn potential(&self, depth: S) -> S {
        let w = self.logarithm(depth);
        let size = S::constant(4.0) * self.apart * (-w).exp();
        let part = S::constant(0.5) * w - S::constant(0.75);
        self.stiffness * size * size * part
    }

    /// k and n of a force k δⁿ that is the same at a light load, with the same slope.
    pub fn power(&self) -> [S; 2] {
        let n = S::constant((LIGHT - 1.0) / (LIGHT - 2.0));
        let size = S::constant(4.0) * self.apart;
        let depth = size * S::constant((LIGHT - 1.0) * (-LIGHT).exp());
        let force = self.stiffness * size * S::constant((-LIGHT).exp());
        [force / (n * depth.ln()).exp(), n]
    }

    /// w. Two steps of Newton's method over the scalar yield the derivatives, exact to third order.
    fn logarithm(&self, depth: S) -> S {
        let found = (depth.abs() / (S::constant(4.0) * self.apart)).in_lanes();
        let depths = depth.in_lanes();
        let places = [0, 1, 2, 3];
        let valid = each(places, |k| f64::from(found[k] > 0.0 && found[k] < DEEPEST));
        let start = each(places, |k| match (valid[k], depths[k] > 0.0) {
            (1.0, _) => root(found[k]),
            (_, true) if found[k] >= DEEPEST => f64::NAN,
            _ => root(PLACEHOLDER),
        });
        let y = depth.abs() / (S::constant(4.0) * self.apart);
        let y = S::select(S::of_lanes(valid), y, S::constant(PLACEHOLDER));
        let mut w = S::of_lanes(start);
        for _ in 0..2 {
            let past = w - S::one();
            w += (past.ln() - w - y.ln()) * past / (w - S::constant(2.0));
        }
        w
    }
}

/// The root w > 2 of ln(w - 1) - w = ln y. From the right of the root, Newton's method approaches it monotonically.
fn root(y: f64) -> f64 {
    let log = y.ln();
    let mut w = 2.0 - log;
    for _ in 0..STEPS {
        let step = ((w - 1.0).ln() - w - log) * (w - 1.0) / (w - 2.0);
        w += step;
        if step.abs() <= 4.0 * f64::EPSILON * w {
            break;
        }
    }
    w
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_depth_follows_from_the_force() {
        for apart in [1e-5, 1.0, 1e3] {
            let law = Cylinders { stiffness: 3.0e9, apart };
            for part in [1e-12_f64, 1e-6, 1e-3, 0.1, 0.135] {
                let f = 4.0 * apart * part;
                let depth = f * ((4.0 * apart / f).ln() - 1.0);
                let force = law.force(depth);
                assert!((force / (3.0e9 * f) - 1.0).abs() < 1e-9, "{apart} {part} {force}");
                assert_eq!(law.force(-depth), -force);
            }
            assert!(law.force(0.6 * apart).is_nan());
            assert_eq!(law.force(0.0), 0.0);
        }
    }
}
