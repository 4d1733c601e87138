//! Four-bars whose coupler point passes points at given crank angles, by dyads: first of the crank, then of the rocker.
//!
//! Seen from the crank, the ground is a moving plane with the poses (P e^{-iβ}, -β), and |P - A| is constant. The dyads
//! of this plane give O and A, hence the angles of the coupler, and its other dyads give B and D.

use crate::conditions::{all_dyads, conditions, ends, line, Choices, End, Frame, Refused};
use crate::defects::{Linkage, Output};
use crate::plane::{abs, angle, turn};
use crate::wanted::Traced;
use kempe::math::Complex;

/// Four-bars through `places` at the angles `cranks`; only differences of the angles count if they are `free`. `counts`
/// are samples of cranks, and of couplers for each of them.
pub(super) fn timed(
    places: &[Complex],
    cranks: &[f64],
    free: bool,
    seed: u64,
    counts: [usize; 2],
) -> Result<Vec<Traced>, Refused> {
    let back: Vec<f64> = cranks.iter().map(|angle| -angle).collect();
    let seen: Vec<Complex> = places.iter().zip(&back).map(|(at, by)| *at * turn(*by)).collect();
    let frame = Frame::of(&seen);
    let mut rows = conditions(&seen, &back);
    let n = rows.len();
    let kinds = [End::Pin, End::Pivot];
    if !free {
        rows.push(line(End::Pivot, Complex::new(0.0, 1.0), -frame.origin.im / frame.size));
    }
    let choices = |samples, seed, kinds: &[End]| Choices {
        ends: kinds.to_vec(),
        what: "point".into(),
        ..Choices::new(samples, seed, None)
    };
    let first = choices(counts[0], seed, if free { &kinds } else { &kinds[..1] });
    let (found, _) = all_dyads(&rows, n, &first)?;
    let mut all = Vec::new();
    let arms = found.iter().filter_map(ends);
    for (k, (pin, arm)) in arms.map(|(w, g)| (frame.outward(w), frame.outward(g))).enumerate() {
        if !free && arm.re < 0.0 {
            continue; // the crank would point the other way
        }
        let o = places[0] - pin * turn(cranks[0]);
        let a: Vec<Complex> = cranks.iter().map(|angle| o + arm * turn(*angle)).collect();
        let frames: Vec<f64> = places.iter().zip(&a).map(|(p, a)| angle(*p - *a)).collect();
        let second = choices(counts[1], seed + k as u64, &kinds);
        let couplers = conditions(places, &frames);
        // a coupler that does not turn has no dyads
        let Ok((found, _)) = all_dyads(&couplers, n, &second) else { continue };
        let own = Frame::of(places);
        for (w, g) in found.iter().filter_map(ends) {
            let (pin, d) = (own.outward(w), own.outward(g));
            if abs(pin - a[0]) > 1e-6 * abs(a[0] - o) {
                all.push(traced(places, &frames, (o, a.clone()), (pin, d)));
            }
        }
    }
    Ok(all)
}

/// The four-bar of a crank and a dyad of its coupler.
fn traced(
    places: &[Complex],
    frames: &[f64],
    (o, a): (Complex, Vec<Complex>),
    (pin, d): (Complex, Complex),
) -> Traced {
    let at = places.iter().zip(frames);
    let b: Vec<_> =
        at.map(|(at, angle)| *at + (pin - places[0]) * turn(angle - frames[0])).collect();
    let length = abs(pin - d);
    let error = b.iter().map(|b| (abs(*b - d) - length).abs()).fold(0.0, f64::max);
    let frame = angle(b[0] - a[0]);
    let linkage = Linkage { o, a, b, output: Output::Rocker(d) };
    Traced { linkage, points: places.to_vec(), frame, error }
}
