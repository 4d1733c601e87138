//! Places on an axis at which a function is not C², numbered in ascending order.

/// Places on an axis, which may repeat periodically. Place n is the lower end of interval n.
#[derive(Clone, Debug, PartialEq)]
pub struct Knots {
    places: Vec<f64>,
    period: Option<f64>,
}

impl Knots {
    /// At least one place, in ascending order. With a period, the places are those of the first period.
    pub fn new(places: Vec<f64>, period: Option<f64>) -> Self {
        debug_assert!(!places.is_empty(), "knots without a place");
        Self { places, period }
    }

    /// Place `n`, a whole number. Without a period, it is infinite before the first and beyond the last place.
    pub(super) fn at(&self, n: f64) -> f64 {
        let count = self.places.len() as f64;
        match self.period {
            Some(period) => {
                let (turn, k) = self.in_period(n);
                self.places[k] + turn * period
            }
            None if n < 0.0 => f64::NEG_INFINITY,
            None if n >= count => f64::INFINITY,
            None => self.places[n as usize],
        }
    }

    /// The number of whole periods before place `n`, and the number of the place in its period.
    pub(super) fn in_period(&self, n: f64) -> (f64, usize) {
        let count = self.places.len() as f64;
        let turn = (n / count).floor();
        (turn, ((n - turn * count) as usize).min(self.places.len() - 1))
    }

    /// The places of one period in ascending order.
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// The number of the last place that is not above x; -1 if there is none. If the places are periodic and x is not
    /// finite, the result is x.
    pub(super) fn last(&self, x: f64) -> f64 {
        let Some(period) = self.period else {
            return self.places.partition_point(|place| *place <= x) as f64 - 1.0;
        };
        if !x.is_finite() {
            return x;
        }
        let turn = ((x - self.places[0]) / period).floor();
        let within = self.places.partition_point(|place| place + turn * period <= x) as f64 - 1.0;
        let n = turn * self.places.len() as f64 + within;
        // corrects the rounding error of the turn
        if self.at(n + 1.0) <= x {
            n + 1.0
        } else {
            n
        }
    }

    /// The number of the place nearest to x.
    pub(super) fn nearest(&self, x: f64) -> f64 {
        let n = self.last(x);
        if self.at(n + 1.0) - x < x - self.at(n) {
            n + 1.0
        } else {
            n
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Knots;

    #[test]
    fn places_are_counted_in_every_period() {
        let knots = Knots::new(vec![0.25, 0.5, 1.0], Some(2.0));
        let all: Vec<f64> = (-3..6).map(|n| knots.at(f64::from(n))).collect();
        assert_eq!(all, [-1.75, -1.5, -1.0, 0.25, 0.5, 1.0, 2.25, 2.5, 3.0]);
        for n in -3..6 {
            let (place, n) = (knots.at(f64::from(n)), f64::from(n));
            assert_eq!([knots.last(place), knots.last(place - 1e-9)], [n, n - 1.0]);
            assert_eq!([knots.nearest(place + 0.01), knots.nearest(place - 0.01)], [n, n]);
        }
    }

    #[test]
    fn open_ends_have_infinite_places() {
        let knots = Knots::new(vec![-1.0, 2.0], None);
        assert_eq!(
            [-2.0, -1.0, 1.9, 2.0, f64::INFINITY].map(|x| knots.last(x)),
            [-1.0, 0.0, 0.0, 1.0, 1.0]
        );
        assert_eq!([-1.0, 0.0, 2.0].map(|n| knots.at(n)), [f64::NEG_INFINITY, -1.0, f64::INFINITY]);
        assert_eq!([-9.0, 0.4, 0.6, 9.0].map(|x| knots.nearest(x)), [0.0, 0.0, 1.0, 1.0]);
    }
}
