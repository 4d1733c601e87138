//! The best point between bounds and within limits: sequential quadratic programming with the curvature of Broyden,
//! Fletcher, Goldfarb and Shanno, damped as Powell (1978) proposes, and Han's line search (1977). The caller computes the
//! points, so that it can stop after each.

use super::quadratic::{add, dot, step, times};

/// Most points of a search, and rounds with a new scale.
const MOST: usize = 300;
const ROUNDS: usize = 4;
/// Part of the objective by which a further step must lower it.
const GAIN: f64 = 1e-15;
/// Part of the objective that a round must gain for another one.
const WORTH: f64 = 1e-9;
/// Part of the size of a limit by which it may be exceeded.
const TOLERANCE: f64 = 1e-6;
/// Part of the expected decrease that a step must reach, and rounding errors of the objective.
const ENOUGH: f64 = 1e-4;
const ROUNDED: f64 = 1e-14;
/// The shortest step, as a part of the computed one; the part that is kept where a point has no value.
const SHORTEST: f64 = 1e-7;
const AWAY: f64 = 0.25;
/// Part of the curvature that a step must show.
const DAMPED: f64 = 0.2;

/// What is known of a point.
#[derive(Clone, Debug)]
pub struct Known {
    /// The objective, which is made small, and its derivatives.
    pub value: f64,
    /// By each unknown.
    pub slope: Vec<f64>,
    /// The room in each limit as a part of its size, at least 0 where it holds.
    pub room: Vec<f64>,
    /// Its derivatives, (limits, unknowns).
    pub room_slopes: Vec<Vec<f64>>,
}

impl Known {
    /// The largest excess of a limit; 0 if all hold.
    pub fn excess(&self) -> f64 {
        self.room.iter().fold(0.0, |most, room| most.max(-room))
    }

    /// Whether all limits hold.
    pub fn holds(&self) -> bool {
        self.excess() <= TOLERANCE
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        let all = |row: &[f64]| row.iter().all(|x| x.is_finite());
        let rows = self.room_slopes.iter().all(|row| all(row));
        rows && all(&self.room) && all(&self.slope) && self.value.is_finite()
    }

    fn is_better(&self, other: &Self) -> bool {
        match self.holds() && other.holds() {
            true => self.value < other.value,
            false => self.excess() < other.excess(),
        }
    }
}

/// How a search ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No step gains anything.
    Best,
    /// Steps hardly gain anything, as at a corner of the objective.
    Corner,
    /// The first point has no value.
    NoValue,
    /// There were enough points.
    Enough,
}

/// A planned step, the multipliers of all limits and bounds, and the curvature times the step.
#[derive(Clone, Debug)]
struct Plan {
    step: Vec<f64>,
    curved: Vec<f64>,
    gain: f64,
}

/// A search in the unit cube.
#[derive(Clone, Debug)]
pub struct Descent {
    at: Vec<f64>,
    now: Option<(Vec<f64>, Known)>,
    best: Option<(Vec<f64>, Known)>,
    plan: Option<Plan>,
    share: f64,
    inverse: Vec<f64>,
    size: f64,
    penalties: Vec<f64>,
    factors: Vec<f64>,
    fresh: bool,
    rounds: usize,
    before: f64,
    points: usize,
}

impl Descent {
    /// A search from a point of the unit cube.
    pub fn new(start: Vec<f64>) -> Self {
        Self {
            at: start,
            now: None,
            best: None,
            plan: None,
            share: 1.0,
            inverse: Vec::new(),
            size: 1.0,
            penalties: Vec::new(),
            factors: Vec::new(),
            fresh: true,
            rounds: 0,
            before: f64::INFINITY,
            points: 0,
        }
    }

    /// The point that is computed next.
    pub fn point(&self) -> &[f64] {
        &self.at
    }

    /// The best point until now.
    pub fn best(&self) -> Option<&(Vec<f64>, Known)> {
        self.now.as_ref().filter(|(_, now)| now.holds()).or(self.best.as_ref())
    }

    /// Goes on with what is known of [`point`](Self::point), None if it has no value, until the search ends.
    pub fn take(&mut self, found: Option<Known>) -> Option<Ending> {
        self.points += 1;
        if let Some(found) = &found {
            if self.best.as_ref().is_none_or(|(_, best)| found.is_better(best)) {
                self.best = Some((self.at.clone(), found.clone()));
            }
        }
        let Some((_, now)) = &self.now else {
            let Some(first) = found else { return Some(Ending::NoValue) };
            self.penalties = vec![0.0; first.room.len()];
            self.size = first.value.abs();
            if self.size == 0.0 {
                let steepest = first.slope.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                self.size = if steepest > 0.0 { steepest } else { 1.0 };
            }
            self.now = Some((self.at.clone(), first));
            return self.round();
        };
        let plan = self.plan.as_ref()?;
        let merits = [now, found.as_ref().unwrap_or(now)].map(|of| self.merit(of));
        let allowed = ROUNDED * merits[0].abs() - ENOUGH * self.share * plan.gain;
        if found.is_some() && merits[1] - merits[0] <= allowed {
            let next = found?;
            let idle = (merits[0] - merits[1]).abs() <= ROUNDED * merits[0].abs();
            self.learn(&next);
            self.now = Some((self.at.clone(), next));
            if idle {
                return self.rest(Ending::Best);
            }
            self.fresh = false;
            return self.advance();
        }
        // the least of the parabola through both merits
        let bent = merits[1] - merits[0] + self.share * plan.gain;
        let least = 0.5 * self.share * plan.gain / bent;
        self.share *= if found.is_some() { least.clamp(0.1, 0.5) } else { AWAY };
        match self.share < SHORTEST {
            true => self.rest(Ending::Corner),
            false => self.trial(),
        }
    }

    /// The objective with a price for each excess, as parts of the size of the objective.
    fn merit(&self, of: &Known) -> f64 {
        let mut merit = of.value / self.size;
        for (room, by) in of.room.iter().zip(&self.penalties) {
            merit += by * (-room).max(0.0);
        }
        merit
    }

    /// Ends a round, and the search if it gained nothing.
    fn rest(&mut self, ending: Ending) -> Option<Ending> {
        match self.fresh {
            true => Some(ending),
            false => self.round().map(|_| ending),
        }
    }

    /// Begins a round, whose curvature is that of the scales of the unknowns: the objective and the limits change by
    /// their size at most over each.
    fn round(&mut self) -> Option<Ending> {
        let (_, now) = self.now.as_ref()?;
        let n = now.slope.len();
        let gained = self.before - now.value;
        if self.rounds == ROUNDS || (self.rounds > 0 && gained.abs() <= WORTH * now.value.abs()) {
            return Some(Ending::Best);
        }
        self.rounds += 1;
        (self.before, self.fresh) = (now.value, true);
        self.inverse = vec![0.0; n * n];
        for k in 0..n {
            let mut steepest = (now.slope[k] / self.size).abs().max(1.0);
            now.room_slopes.iter().for_each(|row| steepest = steepest.max(row[k].abs()));
            self.inverse[k * n + k] = steepest.powi(-2);
        }
        self.advance()
    }

    /// Plans the step from the present point.
    fn advance(&mut self) -> Option<Ending> {
        let (at, now) = self.now.as_ref()?;
        let n = at.len();
        let mut slope = vec![0.0; n];
        add(&mut slope, 1.0 / self.size, &now.slope);
        let (mut rows, mut room) = (now.room_slopes.clone(), now.room.clone());
        for k in 0..n {
            for (sign, left) in [(1.0, at[k]), (-1.0, 1.0 - at[k])] {
                let mut row = vec![0.0; n];
                row[k] = sign;
                rows.push(row);
                room.push(left);
            }
        }
        let (step, factors) = step(&self.inverse, &slope, &rows, &room);
        let mut curved = vec![0.0; n];
        add(&mut curved, -1.0, &slope);
        for (row, factor) in rows.iter().zip(&factors) {
            add(&mut curved, *factor, row);
        }
        let mut gain = -dot(&slope, &step);
        for (k, penalty) in self.penalties.iter_mut().enumerate() {
            *penalty = factors[k].max(0.5 * (*penalty + factors[k]));
            gain += *penalty * (-room[k]).max(0.0);
        }
        self.factors = factors;
        self.plan = Some(Plan { step, curved, gain });
        let scale = (now.value / self.size).abs();
        if gain <= GAIN * scale || !gain.is_finite() {
            return self.rest(Ending::Best);
        }
        self.share = 1.0;
        self.trial()
    }

    /// The next point to compute.
    fn trial(&mut self) -> Option<Ending> {
        if self.points >= MOST {
            return Some(Ending::Enough);
        }
        let ((at, _), plan) = (self.now.as_ref()?, self.plan.as_ref()?);
        let mut next = at.clone();
        add(&mut next, self.share, &plan.step);
        next.iter_mut().for_each(|x| *x = snapped(*x));
        self.at = next;
        None
    }

    /// Takes up the curvature of the Lagrangian along the last step.
    fn learn(&mut self, next: &Known) {
        let (Some((at, now)), Some(plan)) = (&self.now, &self.plan) else { return };
        let n = at.len();
        let mut by = self.at.clone();
        add(&mut by, -1.0, at);
        let mut change = vec![0.0; n];
        for (of, sign) in [(next, 1.0), (now, -1.0)] {
            add(&mut change, sign / self.size, &of.slope);
            for (row, factor) in of.room_slopes.iter().zip(&self.factors) {
                add(&mut change, -sign * factor, row);
            }
        }
        let own = self.share * dot(&by, &plan.curved);
        let shown = dot(&by, &change);
        if own <= 0.0 || own.is_nan() {
            return;
        }
        if shown < DAMPED * own {
            let share = (1.0 - DAMPED) * own / (own - shown);
            change.iter_mut().for_each(|y| *y *= share);
            add(&mut change, (1.0 - share) * self.share, &plan.curved);
        }
        let rate = 1.0 / dot(&by, &change);
        let turned = times(&self.inverse, &change);
        let both = rate * (1.0 + rate * dot(&change, &turned));
        for i in 0..n {
            for j in 0..n {
                self.inverse[i * n + j] +=
                    both * by[i] * by[j] - rate * (turned[i] * by[j] + by[i] * turned[j]);
            }
        }
    }
}

/// A coordinate within the unit cube, on its face if only rounding errors separate it from there.
fn snapped(x: f64) -> f64 {
    let near = |face: f64| (x - face).abs() < 1e-9;
    match x {
        _ if x < 0.0 || near(0.0) => 0.0,
        _ if x > 1.0 || near(1.0) => 1.0,
        _ => x,
    }
}

#[cfg(test)]
mod tests;
