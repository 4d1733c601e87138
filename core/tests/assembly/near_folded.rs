//! Limits of motion of linkages that nearly fold onto a line, against closed forms.

use crate::mechanisms::{four_bar_of, motor, request, Random};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::limits::limits;
use kempe::integrate::Flow;
use std::f64::consts::{PI, TAU};

/// The angle in 0 … π at which a crank brings its pin to the distance `reach` from the other fixed pin. None if it
/// never does.
fn angle_at(reach: f64, ground: f64, crank: f64) -> Option<f64> {
    let (d, far) = (ground - crank, ground + crank);
    let square = (reach - d) * (reach + d) / (4.0 * ground * crank);
    let rest = (far - reach) * (far + reach) / (4.0 * ground * crank);
    (square > 0.0 && rest > 0.0).then(|| 2.0 * square.sqrt().atan2(rest.sqrt()))
}

/// The first and last angle of a crank from a position on its side 0 … π. None if it turns fully.
fn range([g, a, b, c]: [f64; 4]) -> Option<[f64; 2]> {
    match [b + c, (b - c).abs()].map(|reach| angle_at(reach, g, a)) {
        [None, None] => None,
        [Some(out), None] => Some([-out, out]),
        [None, Some(folded)] => Some([folded, TAU - folded]),
        [Some(out), Some(folded)] => Some([folded, out]),
    }
}

/// The angles of coupler and rocker at a crank angle, on one side of the line between the pins that carry them.
fn posed([g, a, b, c]: [f64; 4], angle: f64, side: f64) -> [f64; 2] {
    let (x, y) = (g - a * angle.cos(), -a * angle.sin());
    let d = x.hypot(y);
    let coupler = y.atan2(x) + side * ((d * d + b * b - c * c) / (2.0 * d * b)).acos();
    let (cx, cy) = (a * angle.cos() + b * coupler.cos(), a * angle.sin() + b * coupler.sin());
    [coupler, cy.atan2(cx - g)]
}

/// The fault of the limits of a crank, if there is one.
fn fault(links: [f64; 4], angle: f64, side: f64) -> Option<String> {
    let m = four_bar_of(links, &motor("crank.angle", "t"));
    let [coupler, rocker] = posed(links, angle, side).map(|angle| angle.to_string());
    let hints = [("coupler.angle", coupler.as_str()), ("rocker.angle", rocker.as_str())];
    let request = Request { t: angle, ..request(&m, &[], &hints) };
    let state = match assemble(&m, &request) {
        Ok((state, _)) => state,
        Err(failure) => return Some(failure.to_string()),
    };
    let found = match limits(&m, &state, |_| Flow::Continue) {
        Ok(found) => found,
        Err(failure) => return Some(failure.reason.to_string()),
    };
    let bounds = found.lower.zip(found.upper).map(|(a, b)| [a, b]);
    match (range(links), bounds) {
        (None, None) => (found.turns != Some(1)).then(|| format!("{:?}", found.reasons)),
        (Some(exact), Some(bounds)) => bounds.iter().zip(exact).find_map(|(bound, exact)| {
            let wrong = (bound.value - exact).abs() > 1e-9;
            let unnamed = !bound.reason.contains("coupler and rocker in line");
            (wrong || unnamed).then(|| format!("{} for {exact}: {}", bound.value, bound.reason))
        }),
        (exact, _) => Some(format!("{exact:?}: {:?}", found.reasons)),
    }
}

/// The faults of many linkages of sizes between 1e-3 and 1e3, whose lengths come from their closed form.
fn faults(count: usize, seed: u64, links: impl Fn(&mut Random) -> [f64; 4]) -> Vec<String> {
    let mut random = Random::new(seed);
    let mut found = Vec::new();
    for k in 0..count {
        let links = links(&mut random);
        let [low, high] =
            range(links).map_or([0.0, PI], |[low, high]| [low.max(0.0), high.min(PI)]);
        let angle = low + (high - low) * (0.5 + 0.4 * random.next());
        let (side, size) = (random.next().signum(), 10.0_f64.powf(3.0 * random.next()));
        let fault = fault(links.map(|length| size * length), angle, side);
        found.extend(fault.map(|fault| format!("{k} {links:?} {size} {angle} {side}: {fault}")));
    }
    found
}

/// A number between 1e-1 and `least`, of either sign.
fn small(random: &mut Random, least: f64) -> f64 {
    let share = 0.5 + 0.5 * random.next();
    random.next().signum() * 0.1 * (10.0 * least).powf(share)
}

fn near_rhombus(random: &mut Random) -> [f64; 4] {
    std::array::from_fn(|_| 1.0 + small(random, 1e-9))
}

fn near_parallelogram(random: &mut Random) -> [f64; 4] {
    let crank = 0.55 + 0.45 * random.next();
    let [a, b] = [0, 1].map(|_| 1.0 + small(random, 1e-9));
    [1.0, crank, a, b * crank]
}

/// Near a folded position, two branches nearly cross.
#[test]
fn the_limits_of_near_rhombuses_and_near_parallelograms() {
    assert_eq!(faults(150, 5, near_rhombus), [""; 0]);
    assert_eq!(faults(150, 6, near_parallelogram), [""; 0]);
}

#[test]
#[ignore = "5000 linkages: cargo test --release -p kempe --test assembly near_folded -- --ignored"]
fn the_limits_of_many_linkages() {
    assert_eq!(faults(2500, 7, near_rhombus), [""; 0]);
    assert_eq!(faults(2500, 8, near_parallelogram), [""; 0]);
}

/// Where branches cross, each continues in its direction.
#[test]
fn parallelograms_and_kites_turn_fully() {
    let mut random = Random::new(9);
    for k in 0..60 {
        let [short, long] = [0, 1].map(|_| 1.0 + 0.9 * random.next());
        let (short, long) = (f64::min(short, long), f64::max(short, long));
        let angle = 1.5 + 1.2 * random.next();
        let (links, coupler, rocker) = match k % 2 {
            0 => ([long, short, long, short], 0.0, angle),
            _ => {
                let links = [short, short, long, long];
                let [coupler, rocker] = posed(links, angle, random.next().signum());
                (links, coupler, rocker)
            }
        };
        let m = four_bar_of(links, &motor("crank.angle", "t"));
        let [coupler, rocker] = [coupler, rocker].map(|angle| angle.to_string());
        let hints = [("coupler.angle", coupler.as_str()), ("rocker.angle", rocker.as_str())];
        let (state, _) = assemble(&m, &Request { t: angle, ..request(&m, &[], &hints) }).unwrap();
        let found = limits(&m, &state, |_| Flow::Continue);
        let found = found.unwrap_or_else(|failure| panic!("{links:?}: {}", failure.reason));
        assert!(found.lower.is_none() && found.upper.is_none(), "{links:?} {:?}", found.reasons);
    }
}
