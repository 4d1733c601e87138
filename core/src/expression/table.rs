//! Tables: functions of one number that pass through given points.

use super::knots::Knots;
use super::points::{Checked, Outside, Points, TableError, SI};
use super::unit::{Dimension, Unit};
use crate::math::{Interpolation, Listed, Ordered, Real, ShortArray, Spline};
use std::sync::Arc;

/// Fraction of the range by which x may exceed the ends and still count as the end. An angle of 360° in rad is not
/// exactly the end of a table up to 360°, and joints are closed to a tolerance only.
const ROUNDING: f64 = 1e-9;

/// A place where a table is not C².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kink {
    /// The place, SI.
    pub x: f64,
    /// The lowest order of a derivative that jumps there: 1 or 2.
    pub order: usize,
}

/// A function through given points, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    name: String,
    spline: Spline,
    interpolation: Interpolation,
    outside: Outside,
    x_unit: (String, Unit),
    units: [Option<Dimension>; 2],
    /// First and last x, with y and slope there.
    ends: [[f64; 3]; 2],
    /// The places of the kinks.
    knots: Option<Arc<Knots>>,
}

impl Table {
    /// The function of this name through the points.
    ///
    /// # Errors
    /// Unknown units, lists of different lengths, too few points, numbers that are not finite, x that do not increase,
    /// different ends of a periodic table.
    pub fn new(name: &str, points: &Points) -> Result<Self, TableError> {
        let Checked { x, y, units } = points.check(ROUNDING)?;
        let spline = Spline::new(points.interpolation, points.periodic, &x, &y);
        let end = |x: f64| {
            let [y, slope] = spline.derivatives(x, |c| c);
            [x, y, slope]
        };
        let ends = [end(x[0]), end(x[x.len() - 1])];
        let finite = |x: f64| spline.derivatives::<f64, 6>(x, |c| c).iter().all(|d| d.is_finite());
        if let Some(entry) = x.iter().position(|x| !finite(*x)) {
            return Err(TableError::steep(entry));
        }
        let mut table = Self {
            name: name.to_string(),
            spline,
            interpolation: points.interpolation,
            outside: points.outside,
            x_unit: (points.x_unit.unwrap_or_default().to_string(), units[0].unwrap_or(SI)),
            units: units.each(|unit| unit.map(|unit| unit.dimension)),
            ends,
            knots: None,
        };
        let places: Vec<f64> = table.kinks().iter().map(|kink| kink.x).list();
        if !places.is_empty() {
            table.knots = Some(Arc::new(Knots::new(places, table.period())));
        }
        Ok(table)
    }

    /// The function that is 1 everywhere.
    pub fn one(name: &str) -> Self {
        let end = |x: f64| [x, 1.0, 0.0];
        Self {
            name: name.to_string(),
            spline: Spline::new(Interpolation::Linear, false, &[0.0, 1.0], &[1.0, 1.0]),
            interpolation: Interpolation::Linear,
            outside: Outside::Hold,
            x_unit: (String::new(), SI),
            units: [None, None],
            ends: [end(0.0), end(1.0)],
            knots: None,
        }
    }

    /// The value at x, with exact derivatives if the scalar carries them. NaN where the table has no value.
    pub fn value<S: Real>(&self, x: S) -> S {
        if let Some(printed) = x.named_function(&self.name) {
            return printed;
        }
        let inside = self.spline.value(x, S::constant);
        if self.spline.periodic() {
            return inside;
        }
        self.with_ends(x, inside, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// The value on a piece between two kinks, which extends smoothly beyond them.
    pub(super) fn value_on<S: Real>(&self, piece: f64, x: S) -> S {
        let Some(knots) = &self.knots else { return self.value(x) };
        let [low, high] = [knots.at(piece), knots.at(piece + 1.0)];
        if let Some(period) = self.period() {
            let (turn, k) = knots.in_period(piece);
            return self.spline.extended(k, x - S::constant(turn * period), S::constant);
        }
        let inside = match self.interpolation {
            Interpolation::Linear | Interpolation::Monotone => {
                let points = self.spline.knots();
                let inner = &points[1..points.len() - 1];
                self.spline.extended(inner.partition_point(|x| *x <= low), x, S::constant)
            }
            Interpolation::Cubic | Interpolation::Quintic => self.spline.value(x, S::constant),
        };
        self.with_ends(x, inside, [low, high])
    }

    /// The value between `low` and `high`: `inside` within the range of the table, and its continuation outside.
    fn with_ends<S: Real>(&self, x: S, inside: S, [low, high]: [f64; 2]) -> S {
        let [first, last] = self.ends;
        let margin = match self.outside {
            Outside::Refuse => ROUNDING * (last[0] - first[0]),
            Outside::Hold | Outside::Linear => 0.0,
        };
        let beyond = |[end, y, slope]: [f64; 3]| match self.outside {
            Outside::Refuse => S::constant(f64::NAN),
            Outside::Hold => S::constant(y),
            Outside::Linear => S::constant(y) + S::constant(slope) * (x - S::constant(end)),
        };
        let (before, after) = (beyond(first), beyond(last));
        if high <= first[0] {
            return before;
        }
        if low >= last[0] {
            return after;
        }
        let mut value = inside;
        if high > last[0] {
            value = S::select(x - S::constant(last[0] + margin), after, value);
        }
        if low < first[0] {
            value = S::select(S::constant(first[0] - margin) - x, before, value);
        }
        value
    }

    /// The derivative of an order from 0 to 5 at x, SI.
    pub fn derivative(&self, order: usize, x: f64) -> f64 {
        let [first, last] = self.ends;
        let inside = self.spline.periodic() || (first[0]..=last[0]).contains(&x);
        match order {
            0 => self.value(x),
            _ if inside => self.spline.derivatives::<f64, 6>(x, |c| c)[order],
            1 if self.outside == Outside::Linear => {
                if x < first[0] {
                    first[2]
                } else {
                    last[2]
                }
            }
            _ => 0.0 * self.value(x),
        }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The curve between the points.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The dimension of x, if its unit is written.
    pub fn x_dimension(&self) -> Option<Dimension> {
        self.units[0]
    }

    /// The dimension of y, if its unit is written.
    pub fn y_dimension(&self) -> Option<Dimension> {
        self.units[1]
    }

    /// First and last place, SI.
    pub fn range(&self) -> [f64; 2] {
        [self.ends[0][0], self.ends[1][0]]
    }

    /// The period, if it repeats itself.
    pub fn period(&self) -> Option<f64> {
        let [first, last] = self.range();
        self.spline.periodic().then_some(last - first)
    }

    /// The reason why the table has no value at x: "table 'lift' is read at x = 370 deg, outside its range from 0 to
    /// 360 deg". None if it has a value.
    pub fn refusal(&self, x: f64) -> Option<String> {
        if !self.value(x).is_nan() {
            return None;
        }
        let (text, unit) = &self.x_unit;
        let written = |x: f64| format!("{}", rounded(x * unit.denominator / unit.numerator));
        let [first, last] = self.range().each(written);
        let (name, x) = (&self.name, written(x));
        Some(
            format!("table '{name}' is read at x = {x} {text}").trim_end().to_string()
                + format!(", outside its range from {first} to {last} {text}").trim_end(),
        )
    }

    /// Whether the slope jumps at a point between the ends.
    pub fn is_broken(&self) -> bool {
        let [first, last] = self.range();
        let inner = |x: f64| self.spline.periodic() || (first < x && x < last);
        self.kinks().iter().any(|kink| kink.order == 1 && inner(kink.x))
    }

    /// The places where the table is not C², in the first period if the table is periodic. A run steps to them
    /// exactly.
    pub fn kinks(&self) -> Vec<Kink> {
        let knots = self.spline.knots();
        let inner = &knots[1..knots.len() - 1];
        let order = match self.interpolation {
            Interpolation::Linear => Some(1),
            Interpolation::Monotone => Some(2),
            Interpolation::Cubic | Interpolation::Quintic => None,
        };
        let mut kinks = Vec::new();
        if let Some(order) = order {
            let seam = if self.spline.periodic() { &knots[..1] } else { &[] };
            seam.iter().chain(inner).map(|x| Kink { x: *x, order }).append_to(&mut kinks);
        }
        if !self.spline.periodic() {
            self.ends.iter().filter_map(|end| self.end_kink(*end)).append_to(&mut kinks);
        }
        kinks.order_by(|a, b| a.x.total_cmp(&b.x));
        kinks
    }

    /// The places of the kinks, if there are any.
    pub(super) fn knots(&self) -> Option<&Arc<Knots>> {
        self.knots.as_ref()
    }

    /// The kink between the curve and its continuation.
    fn end_kink(&self, [x, _, slope]: [f64; 3]) -> Option<Kink> {
        let [_, _, second] = self.spline.derivatives(x, |c| c);
        let order = match self.outside {
            Outside::Refuse => None,
            Outside::Hold if slope != 0.0 => Some(1),
            Outside::Hold | Outside::Linear => (second != 0.0).then_some(2),
        };
        order.map(|order| Kink { x, order })
    }
}

/// A number, rounded for a message.
fn rounded(x: f64) -> f64 {
    format!("{x:.9e}").parse().unwrap_or(x)
}
