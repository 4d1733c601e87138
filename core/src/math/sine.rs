//! Sine and cosine of an angle, computed together.
//!
//! The angle is reduced to |r| ≤ π/4 by subtracting k π/2 in three parts (Cody and Waite, *Software Manual for the
//! Elementary Functions*, 1980). The polynomials are those of FDLIBM (Sun, 1993), without the final corrections that
//! improve its error from 1.5 ulp to 1. There is no branch on the quadrant. Angles outside ±[`LARGEST`], including
//! inf and NaN, are passed to the C library.

use super::array::each;
use super::lanes::Lanes;
use super::real::Real;
use std::f64::consts::FRAC_2_PI;
use wide::{f64x4, CmpGt};

/// Largest angle that is reduced here. k then has at most 17 bits, so that its products with the first two parts are
/// exact.
const LARGEST: f64 = 1e5;
/// π/2 in three parts, each of 33 bits except the last.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    2.022_266_248_795_950_6e-21,
];
/// 1.5 × 2⁵². Adding and subtracting it rounds to an integer; adding it only leaves the integer in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// Coefficients of z⁵ … 1 in (sin r - r) / (r z) and in (cos r - 1 + z/2) / z², z = r².
const SERIES: [[f64; 2]; 6] = [
    [f64::from_bits(0x3DE5_D93A_5ACF_D57C), f64::from_bits(0xBDA8_FAE9_BE88_38D4)],
    [f64::from_bits(0xBE5A_E5E6_8A2B_9CEB), f64::from_bits(0x3E21_EE9E_BDB4_B1C4)],
    [f64::from_bits(0x3EC7_1DE3_57B1_FE7D), f64::from_bits(0xBE92_7E4F_809C_52AD)],
    [f64::from_bits(0xBF2A_01A0_19C1_61D5), f64::from_bits(0x3EFA_01A0_19CB_1590)],
    [f64::from_bits(0x3F81_1111_1110_F8A6), f64::from_bits(0xBF56_C16C_16C1_5177)],
    [f64::from_bits(0xBFC5_5555_5555_5549), f64::from_bits(0x3FA5_5555_5555_554C)],
];
/// (sin x, cos x), x in rad.
#[inline(always)]
pub(super) fn sin_cos(x: f64) -> (f64, f64) {
    if x.abs() <= LARGEST {
        within(x)
    } else {
        x.sin_cos()
    }
}

/// (sin x, cos x) in each lane.
#[inline(always)]
pub(super) fn sin_cos_of_lanes(x: Lanes) -> (Lanes, Lanes) {
    if x.are_within(LARGEST) {
        let (r, shifted) = reduce(x);
        let (s, c) = kernel(r);
        turn_lanes(s.0, c.0, shifted.0)
    } else {
        (x.each(|x| sin_cos(x).0), x.each(|x| sin_cos(x).1))
    }
}

#[inline(always)]
fn within(x: f64) -> (f64, f64) {
    let (r, shifted) = reduce(x);
    let (s, c) = kernel(r);
    turn(s, c, shifted.to_bits())
}

/// r, and a number whose last two bits are the last two bits of k.
#[inline(always)]
fn reduce<S: Real>(x: S) -> (S, S) {
    let shifted = S::constant(ROUND).plus_product(x, S::constant(FRAC_2_PI));
    let k = shifted - S::constant(ROUND);
    let [first, second, third] = each(HALF_PI, S::constant);
    let r = x.minus_product(k, first).minus_product(k, second).minus_product(k, third);
    (r, shifted)
}

/// Sine and cosine of r + k π/2 from those of r.
#[inline(always)]
fn turn(s: f64, c: f64, quadrant: u64) -> (f64, f64) {
    // odd quadrants exchange sine and cosine; the sign of sine changes in 2 and 3, that of cosine in 1 and 2
    let odd = 0u64.wrapping_sub(quadrant & 1);
    let swap = (s.to_bits() ^ c.to_bits()) & odd;
    let (turned, leading) = ((quadrant & 2) << 62, (quadrant.wrapping_add(1) & 2) << 62);
    (f64::from_bits(s.to_bits() ^ swap ^ turned), f64::from_bits(c.to_bits() ^ swap ^ leading))
}

/// Sine and cosine of r + k π/2 in registers. The last bits of `shifted` contain the quadrant.
#[inline(always)]
fn turn_lanes(s: f64x4, c: f64x4, shifted: f64x4) -> (Lanes, Lanes) {
    // a set bit, combined with the bits of 1, gives a number greater than 1
    let has = |bit: u64| {
        let alone = shifted & f64x4::splat(f64::from_bits(bit));
        (alone | f64x4::ONE).cmp_gt(f64x4::ONE)
    };
    let (odd, turned) = (has(1), has(2));
    let sign = |changed: f64x4| changed & f64x4::splat(-0.0);
    (Lanes(odd.blend(c, s) ^ sign(turned)), Lanes(odd.blend(s, c) ^ sign(odd ^ turned)))
}

/// Sine and cosine of |r| ≤ π/4.
#[inline(always)]
fn kernel<S: Real>(r: S) -> (S, S) {
    let z = r * r;
    let w = z * z;
    // pairs of terms are independent of each other, which shortens the chain of dependent operations
    let series = |k: usize| {
        let [a, b, c, d, e, f] = each(SERIES, |both| S::constant(both[k]));
        let higher = d.plus_product(z, c).plus_product(w, b.plus_product(z, a));
        f.plus_product(z, e).plus_product(w, higher)
    };
    let half = S::one().minus_product(S::constant(0.5), z);
    (r.plus_product(r, z * series(0)), half.plus_product(w, series(1)))
}

#[cfg(test)]
mod tests {
    use super::{sin_cos, sin_cos_of_lanes, LARGEST};
    use crate::math::Lanes;
    use std::f64::consts::FRAC_PI_2;

    /// Spacing of numbers at x.
    fn ulp(x: f64) -> f64 {
        f64::from_bits(x.abs().to_bits() + 1) - x.abs()
    }

    /// 1.5 ulp here and half of one there.
    fn check(x: f64) {
        let (s, c) = sin_cos(x);
        assert!((s - x.sin()).abs() <= 2.0 * ulp(x.sin()), "sin {x}: {s} {}", x.sin());
        assert!((c - x.cos()).abs() <= 2.0 * ulp(x.cos()), "cos {x}: {c} {}", x.cos());
    }

    #[test]
    fn they_agree_with_the_library() {
        for k in -300_000..300_000 {
            check(f64::from(k) * 0.003_7 + 1e-3);
            check(f64::from(k) * 0.329);
        }
    }

    #[test]
    fn near_multiples_of_a_quarter_turn_nothing_is_lost() {
        for k in -63_000..63_000 {
            let x = f64::from(k) * FRAC_PI_2;
            [x, x + ulp(x), x - ulp(x), x * (1.0 + 1e-9)].into_iter().for_each(check);
        }
    }

    #[test]
    fn lanes_have_the_bits_of_one_angle() {
        let same = |angles: [f64; 4]| {
            let (s, c) = sin_cos_of_lanes(Lanes::new(angles));
            let found = s.to_array().into_iter().zip(c.to_array());
            for (x, (s, c)) in angles.into_iter().zip(found) {
                let bits = |(s, c): (f64, f64)| [s.to_bits(), c.to_bits()];
                assert!(bits((s, c)) == bits(sin_cos(x)) || x.is_nan() && s.is_nan(), "{x}");
            }
        };
        for k in -20_000..20_000 {
            let x = 0.0037 * f64::from(k);
            same([x, x + FRAC_PI_2, x - 17.0 * FRAC_PI_2, 1000.0 * x]);
            same([x, f64::from(k) * FRAC_PI_2, -0.0, 0.0]);
        }
        same([0.3, LARGEST, -2.0 * LARGEST, 1e22]);
        same([0.3, f64::NAN, 2.0, -1e-300]);
    }

    #[test]
    fn small_and_large_angles() {
        for x in [0.0, -0.0, 5e-324, 1e-300, -1e-9, LARGEST, -LARGEST, 1e5 + 1e-3, -1e22] {
            check(x);
        }
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan(), "{x}");
        }
    }
}
