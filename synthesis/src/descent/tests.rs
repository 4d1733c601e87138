//! Known optima, whatever the units; bounds, walls and contradictions.

use super::*;

/// An objective and its limits over unknowns in some units, by differences of high order.
struct Task<'a> {
    least: &'a [f64],
    largest: &'a [f64],
    of: &'a dyn Fn(&[f64]) -> Option<Vec<f64>>,
}

impl Task<'_> {
    fn at(&self, shares: &[f64]) -> Vec<f64> {
        let ends = self.least.iter().zip(self.largest).zip(shares);
        ends.map(|((low, high), share)| low + share * (high - low)).collect()
    }

    fn known(&self, shares: &[f64]) -> Option<Known> {
        let values = (self.of)(&self.at(shares))?;
        let by = |k: usize| {
            let beside = |step: f64| {
                let mut moved = self.at(shares);
                moved[k] += step * (self.largest[k] - self.least[k]);
                (self.of)(&moved)
            };
            let all = [1e-3, -1e-3, 2e-3, -2e-3].map(beside);
            let [a, b, c, d] = all.map(|one| one.unwrap_or_else(|| values.clone()));
            let rate = |j: usize| (8.0 * (a[j] - b[j]) - (c[j] - d[j])) / 12e-3;
            (0..values.len()).map(rate).collect::<Vec<f64>>()
        };
        let columns: Vec<Vec<f64>> = (0..shares.len()).map(by).collect();
        let row = |j: usize| columns.iter().map(|column| column[j]).collect::<Vec<f64>>();
        Some(Known {
            value: values[0],
            slope: row(0),
            room: values[1..].to_vec(),
            room_slopes: (1..values.len()).map(row).collect(),
        })
    }

    fn solved(&self, start: &[f64]) -> (Vec<f64>, f64, Ending, usize) {
        let ends = self.least.iter().zip(self.largest).zip(start);
        let shares = ends.map(|((low, high), x)| (x - low) / (high - low)).collect();
        let mut search = Descent::new(shares);
        let mut points = 0;
        let end = loop {
            points += 1;
            let found = self.known(search.point());
            if let Some(end) = search.take(found) {
                break end;
            }
        };
        let (at, known) = search.best().expect("a point").clone();
        (self.at(&at), known.value, end, points)
    }
}

fn near(found: &[f64], wanted: &[f64], within: f64) {
    let apart = found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < within, "{found:?} is not {wanted:?}");
}

/// Rosen and Suzuki's problem, number 43 of Hock and Schittkowski (1981), times a factor.
fn rosen_suzuki(x: &[f64], times: f64) -> Vec<f64> {
    let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
    let f = squares[0] + squares[1] + 2.0 * squares[2] + squares[3];
    let sum = squares.iter().sum::<f64>();
    vec![
        times * (f - 5.0 * x[0] - 5.0 * x[1] - 21.0 * x[2] + 7.0 * x[3]),
        8.0 - sum - x[0] + x[1] - x[2] + x[3],
        10.0 - sum - squares[1] - squares[3] + x[0] + x[3],
        5.0 - 2.0 * squares[0] - squares[1] - squares[2] - 2.0 * x[0] + x[1] + x[3],
    ]
}

#[test]
fn known_optima_are_found_whatever_the_unit_of_the_objective() {
    for times in [1e-9, 1.0, 1e9] {
        let of = |x: &[f64]| Some(rosen_suzuki(x, times));
        let task = Task { least: &[-3.0; 4], largest: &[4.0; 4], of: &of };
        let (x, value, end, points) = task.solved(&[0.0; 4]);
        near(&x, &[0.0, 1.0, 2.0, -1.0], 1e-7);
        assert!((value / times + 44.0).abs() < 1e-7, "{value}");
        assert!(end == Ending::Best && points < 60, "{end:?} after {points}");
    }
}

#[test]
fn a_curved_valley_ends_at_its_bottom_or_at_a_bound() {
    let valley =
        |x: &[f64]| Some(vec![100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2)]);
    let task = Task { least: &[-2.0, -1.0], largest: &[3.0, 4.0], of: &valley };
    let (x, ..) = task.solved(&[-1.2, 1.0]);
    near(&x, &[1.0, 1.0], 1e-6);
    let bounded = Task { least: &[-2.0, -1.0], largest: &[0.5, 4.0], of: &valley };
    let (x, ..) = bounded.solved(&[-1.2, 1.0]);
    near(&x, &[0.5, 0.25], 1e-8);
    assert_eq!(x[0], 0.5);
}

#[test]
fn places_without_a_value_are_walls() {
    let of = |x: &[f64]| (x[0] > 0.2).then(|| vec![(x[0] - 0.3).powi(2) + x[1] * x[1]]);
    let task = Task { least: &[-50.0, -50.0], largest: &[50.0, 50.0], of: &of };
    let (x, ..) = task.solved(&[40.0, 30.0]);
    near(&x, &[0.3, 0.0], 1e-6);
    let (mut search, none) = (Descent::new(vec![0.5]), None);
    assert_eq!(search.take(none), Some(Ending::NoValue));
}

#[test]
fn limits_that_contradict_are_missed_as_little_as_possible() {
    let of = |x: &[f64]| Some(vec![x[1], x[0] - 1.0, -1.0 - x[0]]);
    let task = Task { least: &[-4.0, -4.0], largest: &[4.0, 4.0], of: &of };
    let (x, ..) = task.solved(&[3.0, 2.0]);
    assert!(x[0].abs() < 0.1, "{x:?}");
}
