//! Sine and cosine of three angles at once.

use std::f64::consts::FRAC_2_PI;

/// π/2 in three parts. The first two have 33 bits, so their products with a quadrant are exact.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    2.022_266_248_795_950_6e-21,
];
/// 1.5 × 2⁵². Adding and subtracting it rounds; adding it alone leaves the integer in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// Cosines and sines; within 1.5 ulp for |angle| below 1e5.
#[inline(always)]
pub fn cosines_and_sines(angle: [f64; 3]) -> ([f64; 4], [f64; 4]) {
    let x = [angle[0], angle[1], angle[2], 0.0];
    let mut sines = [0.0; 4];
    let mut cosines = [0.0; 4];
    for i in 0..4 {
        let shifted = x[i] * FRAC_2_PI + ROUND;
        let k = shifted - ROUND;
        let quadrant = shifted.to_bits();
        let r = ((x[i] - k * HALF_PI[0]) - k * HALF_PI[1]) - k * HALF_PI[2];
        let (s, c) = kernel(r);
        // odd quadrants exchange sine and cosine; sine changes its sign in 2 and 3, cosine in 1 and 2
        let odd = 0u64.wrapping_sub(quadrant & 1);
        let swap = (s.to_bits() ^ c.to_bits()) & odd;
        let sine_sign = (quadrant & 2) << 62;
        let cosine_sign = ((quadrant.wrapping_add(1)) & 2) << 62;
        sines[i] = f64::from_bits((s.to_bits() ^ swap) ^ sine_sign);
        cosines[i] = f64::from_bits((c.to_bits() ^ swap) ^ cosine_sign);
    }
    (cosines, sines)
}

/// Series of sine and cosine for |r| ≤ π/4.
#[inline(always)]
fn kernel(r: f64) -> (f64, f64) {
    const S: [f64; 7] = [
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
        -1.0 / 1_307_674_368_000.0,
    ];
    const C: [f64; 7] = [
        1.0 / 24.0,
        -1.0 / 720.0,
        1.0 / 40_320.0,
        -1.0 / 3_628_800.0,
        1.0 / 479_001_600.0,
        -1.0 / 87_178_291_200.0,
        1.0 / 20_922_789_888_000.0,
    ];
    let z = r * r;
    let w = z * z;
    let poly = |c: &[f64; 7]| {
        let (low, high) = ((c[0] + c[1] * z) + w * (c[2] + c[3] * z), (c[4] + c[5] * z) + w * c[6]);
        low + (w * w) * high
    };
    (r + r * (z * poly(&S)), (1.0 - 0.5 * z) + w * poly(&C))
}

#[cfg(test)]
mod tests {
    use super::cosines_and_sines;

    #[test]
    fn they_agree_with_the_library() {
        let mut worst = 0.0_f64;
        for k in -200_000..200_000 {
            let x = f64::from(k) * 0.003_7 + 1e-3;
            let (c, s) = cosines_and_sines([x, -x, 3.0 * x]);
            for (i, x) in [x, -x, 3.0 * x].into_iter().enumerate() {
                worst = worst.max((c[i] - x.cos()).abs()).max((s[i] - x.sin()).abs());
            }
        }
        assert!(worst < 2.3e-16, "{worst}");
    }
}
