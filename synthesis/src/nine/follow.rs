//! A four-bar that follows its points while they move straight to others.
//!
//! Solutions of equations with general complex points stay apart from each other along the way, so that those of one set
//! of points lead to those of any other. A step is by the method of Runge and Kutta, and two of Newton's steps correct it.

use super::system::{Posture, Shifts, Want, N};
use kempe::math::{Complex, Field};

/// The first step, and the least one, as shares of the way.
const FIRST: f64 = 0.05;
const LEAST: f64 = 1e-10;
/// A correction that is as small as rounding makes it on an ill-conditioned way.
const ROUNDED: f64 = 1e-9;
/// Newton's steps at the end, and the part of a four-bar that the last of them may change.
const STEPS: usize = 8;
const SETTLED: f64 = 1e-12;

/// How carefully a way is followed.
#[derive(Clone, Copy, Debug)]
pub struct Care {
    /// Largest error of a step before its correction.
    pub tolerance: f64,
    /// Whether corrections are from values with twice as many digits.
    pub exact: bool,
    /// Most steps.
    pub most: usize,
}

/// A trial of a step: the four-bar, the error before the correction, and whether the correction converges.
type Trial = (Posture, f64, bool);

/// The four-bar at the end of the way; None if it is lost.
pub fn followed(start: &Posture, from: &Shifts, to: &Shifts, care: Care) -> Option<Posture> {
    let (mut at, mut now, mut step) = (*start, 0.0_f64, FIRST);
    for _ in 0..care.most {
        let next = if now + step > 1.0 - LEAST { 1.0 } else { now + step };
        let (error, good) = match stepped(&at, [from, to], [now, next], care) {
            Some((there, error, good)) => {
                if good {
                    (at, now) = (there, next);
                }
                (error, good)
            }
            None => (f64::INFINITY, false),
        };
        if now == 1.0 {
            return settled(at, to);
        }
        // the error of a step is proportional to its fifth power
        let ratio = (0.5 * care.tolerance / error).powf(0.2);
        step *= if good { ratio.clamp(0.5, 2.0) } else { ratio.clamp(0.1, 0.5) };
        if step < LEAST {
            return None;
        }
    }
    None
}

fn stepped(at: &Posture, way: [&Shifts; 2], ends: [f64; 2], care: Care) -> Option<Trial> {
    let [from, to] = way;
    let (rate, step) = (from.to(to), ends[1] - ends[0]);
    let want = Want::Rate(&rate);
    let [middle, end] = [ends[0] + 0.5 * step, ends[1]].map(|share| from.towards(to, share));
    let first = at.step(&from.towards(to, ends[0]), want)?;
    let second = at.moved(&first, 0.5 * step).step(&middle, want)?;
    let third = at.moved(&second, 0.5 * step).step(&middle, want)?;
    let last = at.moved(&third, step).step(&end, want)?;
    let mean = |of: fn(&Posture) -> &[Complex; N]| {
        let [first, second, third, last] = [&first, &second, &third, &last].map(of);
        std::array::from_fn(|k| {
            let inner = second[k] + third[k];
            (first[k] + inner + inner + last[k]) * Complex::from_real(1.0 / 6.0)
        })
    };
    let mean = Posture { bars: mean(|of| &of.bars), turns: mean(|of| &of.turns) };
    let guess = at.moved(&mean, step);
    let want = if care.exact { Want::Exact } else { Want::Value };
    let correction = guess.step(&end, want)?;
    let error = guess.part(&correction);
    let near = guess.moved(&correction, 1.0);
    if error > care.tolerance {
        return Some((near, error, false));
    }
    let correction = near.step(&end, want)?;
    let good = near.part(&correction) < ROUNDED.max(0.1 * error);
    Some((near.moved(&correction, 1.0), error, good))
}

/// A four-bar with all its digits; None if Newton's method does not converge.
pub fn settled(mut at: Posture, points: &Shifts) -> Option<Posture> {
    for _ in 0..STEPS {
        let step = at.step(points, Want::Exact)?;
        let part = at.part(&step);
        at = at.moved(&step, 1.0);
        if part < SETTLED {
            return Some(at);
        }
    }
    None
}
