//! Several states or designs at once: one formula evaluated for several numbers in parallel.

use super::array::each;
use super::real::{ByValues, Lift, Real};
use super::sine;
use crate::math::Listed;
use wide::f64x4;

/// [`Lanes::WIDTH`] independent values of one quantity, one for each state or design.
///
/// The width is that of the vector registers of current processors. Each lane has exactly the bits of the computation
/// with `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes(pub(super) f64x4);

impl Lanes {
    /// Number of lanes.
    pub const WIDTH: usize = 4;

    /// One number for each lane.
    #[inline(always)]
    pub fn new(lanes: [f64; Self::WIDTH]) -> Self {
        Self(f64x4::new(lanes))
    }
    /// The numbers, lane by lane.
    #[inline(always)]
    pub fn to_array(self) -> [f64; Self::WIDTH] {
        self.0.to_array()
    }
    /// Writes several quantities as rows, one row for each lane. `out` has [`WIDTH`](Self::WIDTH) rows of the length
    /// of `x`.
    ///
    /// # Panics
    /// If `out` has another length.
    pub fn rows(x: &[Self], out: &mut [f64]) {
        let width = x.len();
        assert_eq!(out.len(), Self::WIDTH * width, "a row for each lane");
        let nothing = Self::nothing();
        let (a, rest) = out.split_at_mut(width);
        let (b, rest) = rest.split_at_mut(width);
        let (c, d) = rest.split_at_mut(width);
        let blocks = x.chunks_exact(Self::WIDTH);
        let whole = blocks.remainder().is_empty();
        for (k, x) in blocks.enumerate() {
            let rows = Self::transposed([x[0], x[1], x[2], x[3]], nothing);
            let at = Self::WIDTH * k..Self::WIDTH * (k + 1);
            a[at.clone()].copy_from_slice(&rows[0].to_array());
            b[at.clone()].copy_from_slice(&rows[1].to_array());
            c[at.clone()].copy_from_slice(&rows[2].to_array());
            d[at].copy_from_slice(&rows[3].to_array());
        }
        if whole {
            return;
        }
        // the last block overlaps the one before
        if let Some(x) = x.last_chunk() {
            for (out, row) in [a, b, c, d].into_iter().zip(Self::transposed(*x, nothing)) {
                out[width - Self::WIDTH..].copy_from_slice(&row.to_array());
            }
        } else {
            for (k, x) in x.iter().enumerate() {
                [a[k], b[k], c[k], d[k]] = x.to_array();
            }
        }
    }
    /// The inverse of [`rows`](Self::rows): quantities from rows, one row for each lane.
    ///
    /// # Panics
    /// If `rows` does not consist of [`WIDTH`](Self::WIDTH) rows of the length of `out`.
    pub fn from_rows(rows: &[f64], out: &mut [Self]) {
        let width = out.len();
        assert_eq!(rows.len(), Self::WIDTH * width, "a row for each lane");
        let nothing = Self::nothing();
        let (a, rest) = rows.split_at(width);
        let (b, rest) = rest.split_at(width);
        let (c, d) = rest.split_at(width);
        for (k, out) in out.chunks_exact_mut(Self::WIDTH).enumerate() {
            let row = |x: &[f64]| {
                let x = &x[Self::WIDTH * k..Self::WIDTH * (k + 1)];
                Self::new([x[0], x[1], x[2], x[3]])
            };
            out.copy_from_slice(&Self::transposed([row(a), row(b), row(c), row(d)], nothing));
        }
        for k in width - width % Self::WIDTH..width {
            out[k] = Self::new([a[k], b[k], c[k], d[k]]);
        }
    }
    /// Transposes 4 × 4 numbers in registers, by pairs. Compilers turn a combination of two vectors into a shuffle.
    /// Otherwise they move the numbers one by one, and a vector that was stored in parts cannot be loaded soon after.
    /// Adding [`nothing`](Self::nothing), a zero that the compiler cannot see, prevents this.
    #[inline(always)]
    fn transposed(rows: [Self; Self::WIDTH], nothing: Self) -> [Self; Self::WIDTH] {
        let [p, q, r, s] = each(rows, Self::to_array);
        let halves = [
            [p[0], p[1], r[0], r[1]],
            [q[0], q[1], s[0], s[1]],
            [p[2], p[3], r[2], r[3]],
            [q[2], q[3], s[2], s[3]],
        ];
        let [a, b, c, d] = each(halves, |half| (Self::new(half) + nothing).to_array());
        let columns = [
            [a[0], b[0], a[2], b[2]],
            [a[1], b[1], a[3], b[3]],
            [c[0], d[0], c[2], d[2]],
            [c[1], d[1], c[3], d[3]],
        ];
        each(columns, Self::new)
    }
    /// -0. Adding it changes no number, not even -0. Its value is hidden from the compiler.
    #[inline(always)]
    fn nothing() -> Self {
        std::hint::black_box(Self::constant(-0.0))
    }
    /// Applies a function without a vector version to each lane.
    #[inline(always)]
    pub(super) fn each(self, f: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.to_array();
        Self::new([f(a), f(b), f(c), f(d)])
    }
    /// Whether all lanes are within ±`most`; false if one is NaN.
    #[inline(always)]
    pub(super) fn are_within(self, most: f64) -> bool {
        wide::CmpLe::cmp_le(self.0.abs(), f64x4::splat(most)).all()
    }
    /// Whether each lane is 0 or -0.
    #[inline(always)]
    pub(crate) fn are_zero(self) -> bool {
        wide::CmpEq::cmp_eq(self.0, f64x4::ZERO).all()
    }
    #[inline]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.to_array(), other.to_array());
        Self::new([f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])])
    }
}

super::operators::operators! {#[inline(always)] Lanes: |a, b|
    + Self(a.0 + b.0),
    - Self(a.0 - b.0),
    * Self(a.0 * b.0),
    / Self(a.0 / b.0),
    // changes only the sign; 0 - x would turn -0 into 0
    negative Self(a.0 ^ f64x4::splat(-0.0)),
}

super::base::is_base!(Lanes);

impl Real for Lanes {
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self(f64x4::splat(x))
    }
    super::real::functions!(|self, f| self.each(f); exp ln asin acos atan sinh cosh tanh floor);
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sine::sin_cos_of_lanes(self)
    }
    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        Self(a.0.mul_add(b.0, self.0))
    }
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        Self(a.0.mul_neg_add(b.0, self.0))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        self.zip(x, f64::atan2)
    }
    #[inline]
    fn powc(self, exponent: f64) -> Self {
        self.each(|x| Real::powc(x, exponent))
    }
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        self.zip(exponent, f64::powf)
    }
    #[inline(always)]
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        Self(wide::CmpGt::cmp_gt(condition.0, f64x4::ZERO).blend(positive.0, otherwise.0))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        match cfg!(target_feature = "sse2") {
            true => Self(self.0.fast_max(other.0)), // here, too, NaN is not greater
            false => Self(wide::CmpGt::cmp_gt(self.0, other.0).blend(self.0, other.0)),
        }
    }
    #[inline(always)]
    fn least_magnitude(self) -> f64 {
        let [a, b, c, d] = self.0.abs().to_array();
        a.min(b).min(c.min(d))
    }
    #[inline]
    fn of_lanes(values: [f64; 4]) -> Self {
        Self::new(values)
    }
    #[inline]
    fn in_lanes(self) -> [f64; 4] {
        self.to_array()
    }
    fn of_values(f: &dyn ByValues, x: &[Self]) -> Self {
        Self::new(std::array::from_fn(|lane| f.value(&x.iter().map(|x| x.to_array()[lane]).list())))
    }
    #[inline(always)]
    fn largest_magnitude(self) -> f64 {
        let [a, b, c, d] = self.0.abs().to_array();
        // a number that is not less is kept, NaN included
        let larger = |a: f64, b: f64| if a < b || b.is_nan() { b } else { a };
        larger(larger(a, b), larger(c, d))
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.largest_magnitude().is_finite()
    }
}

impl Lift<f64> for Lanes {
    #[inline]
    fn lift(x: f64) -> Self {
        Self::constant(x)
    }
}

#[cfg(test)]
mod tests {
    use super::Lanes;
    use crate::math::{Largest, Real};

    #[test]
    fn products_are_fused_alike_in_every_lane() {
        for k in 1..10_000 {
            let [x, a, b] = [0.1, 0.7, 1.3].map(|part| (part * f64::from(k)).sin());
            let [of_x, of_a, of_b] = [x, a, b].map(|x| Lanes::new([x, -x, 2.0 * x, 1.0]));
            let (plus, minus) = (of_x.plus_product(of_a, of_b), of_x.minus_product(of_a, of_b));
            for (lane, [x, a, b]) in
                [[x, a, b], [-x, -a, -b], [2.0 * x, 2.0 * a, 2.0 * b]].into_iter().enumerate()
            {
                assert_eq!(plus.to_array()[lane], x.plus_product(a, b));
                assert_eq!(minus.to_array()[lane], x.minus_product(a, b));
            }
        }
    }

    #[test]
    fn rows_are_the_lanes_and_lanes_the_rows() {
        for width in 0..10 {
            let number = |lane: usize, k: usize| (10 * lane + k) as f64;
            let lanes = |k| Lanes::new(std::array::from_fn(|lane| number(lane, k)));
            let x: Vec<Lanes> = (0..width).map(lanes).collect();
            let mut rows = vec![f64::NAN; Lanes::WIDTH * width];
            Lanes::rows(&x, &mut rows);
            let expected = (0..Lanes::WIDTH).flat_map(|l| (0..width).map(move |k| number(l, k)));
            assert_eq!(rows, expected.collect::<Vec<_>>(), "width {width}");
            let mut back = vec![Lanes::constant(f64::NAN); width];
            Lanes::from_rows(&rows, &mut back);
            assert_eq!(back, x, "width {width}");
        }
    }

    #[test]
    fn the_largest_is_found_in_any_lane_and_nan_is_not_forgotten() {
        let largest = |numbers: &[f64]| {
            let (mut alone, mut lanes) = (Largest::new(), Largest::new());
            for (k, x) in numbers.iter().enumerate() {
                let mut side_by_side = [0.25; Lanes::WIDTH];
                side_by_side[k % Lanes::WIDTH] = *x;
                alone.add(*x);
                lanes.add(Lanes::new(side_by_side));
            }
            let (alone, lanes) = (alone.get(), lanes.get());
            assert!(alone == lanes || alone.is_nan() && lanes.is_nan(), "{alone} {lanes}");
            alone
        };
        assert_eq!(largest(&[0.5, -3.0, 2.0, 1.0, -0.0]), 3.0);
        assert_eq!(largest(&[1.0, f64::NEG_INFINITY, 2.0]), f64::INFINITY);
        assert_eq!(largest(&[1.5e308, -1.7e308, 1.5e308]), 1.7e308); // the sum is not finite
        for k in 0..6 {
            let mut numbers = [1.0, 2.0, f64::INFINITY, 3.0, -1.0, 0.5];
            numbers[k] = f64::NAN;
            assert!(largest(&numbers).is_nan(), "at {k}");
        }
    }
}
