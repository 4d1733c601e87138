//! Four-bars whose coupler point passes points: a search in pieces.
//!
//! | task | starts |
//! |---|---|
//! | up to five points with crank angles | none: all four-bars, or samples of them, follow by dyads |
//! | up to five points | random crank angles |
//! | six to nine points | four-bars through five of the points at random crank angles |
//! | more points | four-bars of an atlas whose curves resemble the drawn one |
//! | more points with crank angles | four-bars through some of them |
//! | fixed pivots | random four-bars |
//!
//! The results depend on the number of starts only, and not on the pieces in which they are tried.

mod atlas;
mod starts;
mod timed;

use crate::conditions::Refused;
use crate::fit::Posed;
use crate::plane::{abs, turn};
use crate::wanted::{cognates, distinct, Traced, Wanted, EXACT, SAME_BARS, STEPS};
use atlas::{Drawn, Likeness};
use kempe::math::{Complex, Random};
use starts::{between, moved, passing, scattered, some, through};
use timed::timed;

/// Two points that differ by less, relative to the size of the task, are the same.
const SAME: f64 = 1e-9;
/// Most points that can be exact.
const MOST: usize = 9;
/// Samples of cranks, and of couplers for each of them; of both for random crank angles, and for parts of the points.
const SAMPLES: [usize; 2] = [60, 24];
const FEW: [usize; 2] = [6, 6];
const OF_PART: [usize; 2] = [60, 2];
/// Starts of each kind.
const TIMES: usize = 120;
const PARTS: usize = 24;
const FIVES: usize = 160;
const ALIKE: usize = 60;
const RANDOM: usize = 640;
/// So many times more starts are tried until a four-bar is exact.
const ROUNDS: usize = 12;
/// Steps for a few of the points, and how much worse than the best one a start may be that goes on.
const COARSE: usize = 60;
const WORSE: f64 = 4.0;
/// Approximations that are kept, and the share of their size within which two of them are the same.
const KEPT: usize = 24;
const NEAR: f64 = 0.03;
/// Error, as a share of the task, below which a four-bar seems to be exact.
const CLOSE: f64 = 2e-3;
/// Factor of the lengths that keeps linkages small.
const RIDGE: f64 = 2e-3;

/// Where the search begins.
#[derive(Clone, Debug)]
enum Begin {
    Dyads,
    Times,
    Fives(Vec<Posed>),
    Alike(Vec<Likeness>),
    Parts,
    Random,
}

/// A search for four-bars whose coupler point passes points.
pub struct PathSearch {
    /// The task.
    pub wanted: Wanted,
    random: Random,
    seed: u64,
    begin: Begin,
    /// Starts that are tried, those that the task usually needs, and those that may be tried.
    tried: usize,
    usual: usize,
    most: usize,
    /// Whether more are tried until a four-bar is exact.
    insists: bool,
    /// A few of the points, with the least sum of squares that a start has reached for them.
    part: Option<(Wanted, Vec<usize>)>,
    least: f64,
    /// What is found by dyads, and by least squares with its sum.
    traced: Vec<Traced>,
    fitted: Vec<(f64, Posed)>,
}

impl PathSearch {
    /// A search with a number of starts, or with as many as its kind needs.
    pub fn new(wanted: Wanted, starts: Option<usize>, seed: u64) -> Result<Self, Refused> {
        let n = wanted.places.len();
        if n < 2 {
            let message =
                format!("points: {n} point{}; at least two", if n == 1 { "" } else { "s" });
            return Err(Refused::new(message, "add a point"));
        }
        check(&wanted)?;
        let (free, given) = (wanted.pivots == [None, None], !wanted.cranks.is_empty());
        let (begin, most) = match (free, given) {
            (true, true) if n <= 4 + usize::from(wanted.offset) => (Begin::Dyads, 1),
            (true, true) => (Begin::Parts, PARTS),
            (true, false) if n <= 5 => (Begin::Times, TIMES),
            (true, false) if n <= MOST => (Begin::Fives(Vec::new()), FIVES),
            (true, false) => (Begin::Alike(Vec::new()), ALIKE),
            _ => (Begin::Random, RANDOM),
        };
        let part = (!wanted.is_exact() && n > MOST).then(|| {
            let of = |k: usize| (k * (n - 1) + MOST / 2) / MOST;
            let chosen: Vec<usize> = (0..=MOST).map(of).collect();
            (wanted.part(&chosen), chosen)
        });
        let (traced, fitted) = (Vec::new(), Vec::new());
        let (random, least) = (Random::new(seed), f64::INFINITY);
        let mut search = Self {
            wanted,
            random,
            seed,
            begin,
            tried: 0,
            usual: most,
            most,
            insists: false,
            part,
            least,
            traced,
            fitted,
        };
        search.limit(starts);
        Ok(search)
    }

    /// End after a number of starts, or after as many as the kind of the task needs; false if more were tried.
    pub fn limit(&mut self, starts: Option<usize>) -> bool {
        let alone = matches!(self.begin, Begin::Dyads);
        self.most = starts.filter(|_| !alone).unwrap_or(self.usual);
        self.insists = starts.is_none() && self.wanted.is_exact() && !alone;
        starts.is_none_or(|starts| alone || self.tried <= starts)
    }

    /// The number of starts that were tried.
    pub fn tried(&self) -> usize {
        self.tried
    }

    /// The number of starts after which the search ends, as far as it is known.
    pub fn most(&self) -> usize {
        let more = self.insists && self.tried >= self.most && !self.is_met();
        self.most * if more { ROUNDS } else { 1 }
    }

    /// Whether the search is finished.
    pub fn ended(&self) -> bool {
        self.tried >= self.most()
    }

    /// Whether all four-bars are found for certain.
    pub fn complete(&self) -> bool {
        matches!(self.begin, Begin::Dyads) && self.wanted.places.len() == 5
    }

    fn is_met(&self) -> bool {
        !self.traced.is_empty() || self.fitted.iter().any(|(sum, _)| *sum < EXACT * EXACT)
    }

    /// Try some more starts.
    pub fn advance(&mut self, starts: usize) -> Result<(), Refused> {
        for _ in 0..starts {
            if self.ended() {
                break;
            }
            self.step()?;
            self.tried += 1;
        }
        Ok(())
    }

    fn step(&mut self) -> Result<(), Refused> {
        let k = self.tried;
        let Wanted { places, cranks, offset, .. } = &self.wanted;
        match &mut self.begin {
            Begin::Dyads => self.traced = timed(places, cranks, *offset, self.seed, SAMPLES)?,
            Begin::Times => {
                let cranks = passing(&mut self.random, places.len());
                self.traced.extend(timed(places, &cranks, true, k as u64, FEW)?);
            }
            Begin::Fives(_) => self.five(),
            Begin::Alike(found) => {
                let relative = self.wanted.relative(places);
                let drawn = Drawn::new(&relative);
                if found.is_empty() {
                    *found = drawn.similar();
                }
                match found.get(k).map(|one| drawn.start(one)) {
                    Some(start) => self.tried_from(start),
                    None => self.most = k + 1,
                }
            }
            Begin::Parts => self.through_some(),
            Begin::Random => {
                let start = scattered(&self.wanted, &mut self.random);
                self.tried_from(start);
            }
        }
        Ok(())
    }

    /// Fit one start: all points, or first a few of them.
    fn tried_from(&mut self, start: Posed) {
        let similar = matches!(self.begin, Begin::Alike(_));
        let Some((part, chosen)) = &self.part else {
            return self.keep(self.wanted.fitted(start));
        };
        let few = Posed { at: chosen.iter().map(|k| start.at[*k]).collect(), ..start };
        let few = moved(&few, &self.wanted, part);
        let (few, sum) = match similar {
            true => part.on_branch(few, COARSE, RIDGE),
            false => part.near(few, &[1.0], COARSE),
        };
        self.least = self.least.min(sum);
        if sum.is_nan() || sum > WORSE * self.least {
            return;
        }
        let start = self.wanted.spread(part, &few, &between(&few, chosen));
        if !similar {
            return self.keep(self.wanted.fitted(start));
        }
        // a small linkage near the start, and the best one near this
        let (small, _) = self.wanted.on_branch(start, STEPS, RIDGE);
        self.keep(self.wanted.on_branch(small.clone(), 0, 0.0));
        let (found, sum) = self.wanted.on_branch(small, STEPS, 0.0);
        // where a four-bar seems to be exact, both closures lead to it faster
        let is_near = sum < CLOSE * CLOSE * self.wanted.places.len() as f64;
        self.keep(if is_near { self.wanted.fitted(found) } else { (found, sum) });
    }

    /// Keep a four-bar with its sum of squares.
    fn keep(&mut self, (found, sum): (Posed, f64)) {
        // a crank with angles from the x axis does not point the other way
        let Wanted { cranks, offset, .. } = &self.wanted;
        let is_other_way = !cranks.is_empty() && !offset && found.lengths[2] <= 0.0;
        if !sum.is_finite() || is_other_way {
            return;
        }
        let k = self.fitted.partition_point(|(other, _)| *other <= sum);
        if !self.wanted.is_exact() {
            let size = found.lengths.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let is_near = |(_, other): &(f64, Posed)| {
                let mut pairs = found.lengths.iter().zip(&other.lengths);
                pairs.all(|(x, y)| (x - y).abs() < NEAR * size)
            };
            if self.fitted[..k].iter().any(is_near) {
                return;
            }
            let worse = self.fitted.split_off(k);
            self.fitted.extend(worse.into_iter().filter(|one| !is_near(one)));
        }
        self.fitted.insert(k, (sum, found));
        if !self.wanted.is_exact() {
            self.fitted.truncate(KEPT);
        }
    }

    /// The next of the four-bars through five of the points at random crank angles.
    fn five(&mut self) {
        let n = self.wanted.places.len();
        for _ in 0..RANDOM {
            let Begin::Fives(ready) = &mut self.begin else { return };
            if let Some(start) = ready.pop() {
                return self.tried_from(start);
            }
            let cranks = passing(&mut self.random, n);
            let all = Wanted { cranks, offset: true, ..self.wanted.clone() };
            let five = some(&mut self.random, n, 5);
            let mut found = through(&all, &five, [0, 0], 0);
            found.iter_mut().for_each(|one| one.turned[0] = Complex::new(1.0, 0.0));
            ready.extend(found);
        }
    }

    /// Four-bars through some of the points at their crank angles, fitted to all of them.
    fn through_some(&mut self) {
        let n = self.wanted.places.len();
        let of = some(&mut self.random, n, 4 + usize::from(self.wanted.offset));
        let seed = self.seed + self.tried as u64;
        for start in through(&self.wanted, &of, OF_PART, seed) {
            self.keep(self.wanted.fitted(start));
        }
        if self.fitted.is_empty() && self.tried + 1 == self.most {
            (self.begin, self.most) = (Begin::Random, self.most + RANDOM);
        }
    }

    /// The four-bars that are found so far, those with the least error first.
    pub fn found(&self) -> Vec<Traced> {
        let limit =
            if self.wanted.is_exact() && self.is_met() { EXACT * EXACT } else { f64::INFINITY };
        let kept = self.fitted.iter().filter(|(sum, _)| *sum < limit);
        let near = if self.wanted.is_exact() { SAME_BARS } else { NEAR };
        let mut found = distinct(kept.map(|(_, one)| self.wanted.traced(one)), near);
        if self.wanted.cranks.is_empty() && self.wanted.pivots == [None, None] {
            let both: Vec<_> = found.iter().flat_map(cognates).collect();
            found = distinct(found.into_iter().chain(both), near);
        }
        self.traced.iter().cloned().chain(found).collect()
    }

    /// The reason why there are none.
    pub fn none(&self) -> Refused {
        let n = self.wanted.places.len();
        let hint = "move or leave out a point, relax the angles or pivots, or try another seed";
        Refused::new(format!("points: no four-bar found for all {n} points"), hint)
    }
}

/// Refuse two points that are the same, except on a curve, which may cross itself, and two equal crank angles.
fn check(wanted: &Wanted) -> Result<(), Refused> {
    let twice = |all: &[Complex], size: f64| {
        let pairs = (1..all.len()).flat_map(|k| (0..k).map(move |j| (j, k)));
        pairs.into_iter().find(|(j, k)| abs(all[*k] - all[*j]) < SAME * size)
    };
    if let Some((j, k)) = twice(&wanted.places, wanted.size()).filter(|_| wanted.is_exact()) {
        let message = format!("points: points {} and {} are the same", j + 1, k + 1);
        return Err(Refused::new(message, "leave one of them out"));
    }
    let cranks: Vec<Complex> = wanted.cranks.iter().map(|angle| turn(*angle)).collect();
    if let Some((_, k)) = twice(&cranks, 1.0) {
        let message = format!("angles: angle {} occurs twice", k + 1);
        return Err(Refused::new(message, "a crank has one point at each angle"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Wanted {
        let at = |k: u32| {
            let way = f64::from(k) * 0.2;
            Complex::new(way.cos() + 0.2 * (2.0 * way).cos(), 0.6 * way.sin())
        };
        Wanted { places: (0..24).map(at).collect(), ..Wanted::default() }
    }

    fn errors(search: &PathSearch) -> Vec<f64> {
        search.found().iter().map(|one| one.error).collect()
    }

    #[test]
    fn pieces_give_what_one_search_gives() {
        let mut whole = PathSearch::new(curve(), Some(12), 0).expect("points");
        whole.advance(100).expect("a search");
        assert!(whole.ended() && whole.tried() == 12);
        let mut parts = PathSearch::new(curve(), None, 0).expect("points");
        while parts.tried() < 12 {
            parts.advance(1).expect("a search");
        }
        assert!(!parts.ended() && !errors(&whole).is_empty());
        assert_eq!(errors(&parts), errors(&whole));
        // another limit ends the search where it is, or needs a new one
        assert!(parts.limit(Some(12)) && parts.ended());
        assert!(!parts.limit(Some(5)));
    }

    #[test]
    fn equal_points_are_refused_unless_a_curve_crosses_itself() {
        let mut few = curve();
        few.places.truncate(4);
        few.places[3] = few.places[0];
        let refused = PathSearch::new(few, None, 0).map(|_| ()).expect_err("equal points");
        assert!(refused.message.contains("points 1 and 4"), "{}", refused.message);
        let mut many = curve();
        many.places[20] = many.places[3];
        assert!(PathSearch::new(many, None, 0).is_ok());
    }
}
