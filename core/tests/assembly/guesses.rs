//! Guesses are starting values: the nearest assembly is found, also from guesses that cannot be met.

use crate::mechanisms::{column, four_bar_of, model, request, start, Random};
use kempe::analyses::assemble::{assemble, Report, Request};
use kempe::analyses::configurations::configurations;
use kempe::analyses::State;
use kempe::model::{size, Model};
use std::f64::consts::{PI, TAU};

/// A four-bar with a dyad on its coupler (Stephenson III), `r` times as large as usual.
fn six_bar(r: f64) -> Model {
    let bar = |name: &str, length: f64, ends: &str| {
        format!("[bodies.{name}]\ntype = 'bar'\nmass = 1\nlength = {}\nends = {ends}\n", r * length)
    };
    let pins = [
        ("A", "ground.A", "a.A"),
        ("B", "a.B", "b.B"),
        ("C", "b.C", "c.C"),
        ("D", "ground.D", "c.D"),
        ("E", "b.E", "e.E"),
        ("F", "e.F", "f.F"),
        ("G", "ground.G", "f.G"),
    ];
    let pins = pins
        .map(|(name, i, j)| format!("{name} = {{ type = 'revolute', i = '{i}', j = '{j}' }}\n"));
    model(&format!(
        "[bodies.ground]\npoints = {{ A = [0, 0], D = [{}, 0], G = [{}, {r}] }}\n{}\
         [bodies.b]\nmass = 1\ninertia = 1\npoints = {{ B = [0, 0], C = [{}, 0], E = [{}, {}] }}\n{}{}{}[joints]\n{}",
        4.0 * r,
        7.0 * r,
        bar("a", 1.0, "['A', 'B']"),
        3.0 * r,
        2.0 * r,
        1.5 * r,
        bar("c", 2.5, "['C', 'D']"),
        bar("e", 3.0, "['E', 'F']"),
        bar("f", 2.5, "['F', 'G']"),
        pins.concat(),
    ))
}

fn whole(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Random angles, in degrees, for some of the bodies; at least for one.
fn guesses<'n>(random: &mut Random, names: &[&'n str], turns: f64) -> Vec<(&'n str, f64)> {
    loop {
        let all = names.iter().map(|name| (*name, 180.0 * turns * random.next(), random.next()));
        let some: Vec<_> = all.filter(|(.., part)| *part < 0.0).map(|(n, v, _)| (n, v)).collect();
        if !some.is_empty() {
            return some;
        }
    }
}

fn assembled(m: &Model, set: &[(&str, &str)], guesses: &[(&str, f64)]) -> (State, Report) {
    let hints: Vec<(String, String)> =
        guesses.iter().map(|(b, v)| (format!("{b}.angle"), format!("{v} deg"))).collect();
    let hints: Vec<(&str, &str)> = hints.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    let found = assemble(m, &request(m, set, &hints));
    found.unwrap_or_else(|failure| panic!("{guesses:?}: {failure}"))
}

/// The distance of angles from their guesses.
fn distance(m: &Model, q: &[f64], guesses: &[(&str, f64)]) -> f64 {
    let off = guesses.iter().map(|(b, v)| whole(q[column(m, b, 2)] - v.to_radians()).powi(2));
    off.sum::<f64>().sqrt()
}

/// Every angle is within half a turn of its guess, or of a neighbour.
#[track_caller]
fn turns_are_near(m: &Model, q: &[f64], guesses: &[(&str, f64)]) {
    let angle = |body: &str| if body == "ground" { 0.0 } else { q[column(m, body, 2)] };
    for body in &m.bodies[1..] {
        let name = body.name.as_str();
        if let Some((_, guess)) = guesses.iter().find(|(b, _)| *b == name) {
            let off = angle(name) - guess.to_radians();
            assert!(off.abs() <= PI + 1e-9, "{name} {off} {guesses:?}");
            continue;
        }
        let near = m.constraints.iter().any(|item| {
            let names: Vec<&str> =
                item.bodies.iter().map(|b| m.bodies[b.0].name.as_str()).collect();
            let others = names.iter().filter(|other| **other != name);
            names.contains(&name)
                && others.into_iter().any(|b| (angle(b) - angle(name)).abs() <= PI + 1e-9)
        });
        assert!(near, "{name} {} {guesses:?}", angle(name));
    }
}

#[test]
fn a_mechanism_with_a_freedom_closes_from_every_guess() {
    let mut random = Random::new(31);
    let mut far = 0;
    for _ in 0..60 {
        let m = six_bar(10.0_f64.powf(3.0 * random.next()));
        let guesses = guesses(&mut random, &["a", "b", "c", "e", "f"], 3.0);
        let (state, report) = assembled(&m, &[], &guesses);
        turns_are_near(&m, &state.q, &guesses);
        far += usize::from(
            report.warnings.iter().any(|w| w.contains("does not close near the guess")),
        );
    }
    assert!((5..55).contains(&far), "{far}");
}

/// The nearest assembly is known from all configurations at many angles of the crank.
#[test]
fn a_guess_that_cannot_be_met_is_approached() {
    let m = six_bar(1.0);
    let at = |degrees: i32| {
        let angle = format!("{degrees} deg");
        let all = configurations(&m, &request(&m, &[("a.angle", &angle)], &[]), 100, &|| false);
        all.map_or(Vec::new(), |all| all.states).into_iter().map(|(state, _)| state.q)
    };
    let all: Vec<Vec<f64>> = (0..120).flat_map(|k| at(3 * k)).collect();
    for guess in [-175.0_f64, -120.0, -60.0, -20.0, 10.0, 30.0, 100.0, 170.0] {
        for name in ["b", "c", "f"] {
            let (state, report) = assembled(&m, &[], &[(name, guess)]);
            let of = |q: &[f64]| distance(&m, q, &[(name, guess)]);
            let least = all.iter().map(|q| of(q)).fold(f64::INFINITY, f64::min);
            let off = of(&state.q);
            assert!(off < least + 0.02, "{name} {guess}: {off} {least} {:?}", report.warnings);
        }
    }
}

#[test]
fn the_nearest_of_all_assemblies_is_chosen() {
    let mut random = Random::new(32);
    let mut checked = 0;
    for _ in 0..40 {
        let m = six_bar(10.0_f64.powf(3.0 * random.next()));
        let set = [("a.angle", format!("{} deg", 180.0 * random.next()))];
        let set: Vec<(&str, &str)> = set.iter().map(|(k, v)| (*k, v.as_str())).collect();
        let guesses = guesses(&mut random, &["b", "c", "e", "f"], 1.0);
        let all = configurations(&m, &request(&m, &set, &[]), 100, &|| false);
        let Ok(all) = all else { continue };
        let (state, _) = assembled(&m, &set, &guesses);
        let least = all.states.iter().map(|(s, _)| distance(&m, &s.q, &guesses));
        let least = least.fold(f64::INFINITY, f64::min);
        let off = distance(&m, &state.q, &guesses);
        assert!(off <= least + 1e-6, "{set:?} {guesses:?}: {off} {least}");
        turns_are_near(&m, &state.q, &guesses);
        checked += 1;
    }
    assert!(checked >= 30, "{checked}");
}

/// A double pendulum with bars of 0.5 `r` and 0.4 `r` whose end may be held by a pin or by drivers.
fn double_pendulum(r: f64, [x, y]: [f64; 2], held: usize) -> Model {
    let bar = |name: &str, length: f64, ends: &str| {
        format!("[bodies.{name}]\ntype = 'bar'\nmass = 1\nlength = {length}\nends = {ends}\n")
    };
    let driver = |c: &str, v: f64| {
        format!("[drivers.d{c}]\ntype = 'coordinate_driver'\ncoordinate = 'b.Q.{c}'\nvalue = {v}\n")
    };
    let held = match held {
        0 => String::new(),
        1 => "Q = { type = 'revolute', i = 'ground.T', j = 'b.Q' }\n".to_string(),
        _ => driver("x", x) + &driver("y", y),
    };
    model(&format!(
        "[bodies.ground]\npoints = {{ O = [0, 0], T = [{x}, {y}] }}\n{}{}[joints]\n\
         O = {{ type = 'revolute', i = 'ground.O', j = 'a.O' }}\nP = {{ type = 'revolute', i = 'a.P', j = 'b.P' }}\n{held}",
        bar("a", 0.5 * r, "['O', 'P']"),
        bar("b", 0.4 * r, "['P', 'Q']"),
    ))
}

/// Its angles in both positions.
fn both(r: f64, [x, y]: [f64; 2]) -> [[f64; 2]; 2] {
    let d = x.hypot(y);
    let turn = ((d * d + 0.09 * r * r) / (d * r)).acos();
    [1.0, -1.0].map(|side| {
        let a = y.atan2(x) + side * turn;
        [a, (y - 0.5 * r * a.sin()).atan2(x - 0.5 * r * a.cos())]
    })
}

/// Whether the end is held by `set`, a pin or drivers, and whether angles or a point are guessed.
#[test]
fn the_nearer_of_two_positions_of_a_double_pendulum() {
    let mut random = Random::new(33);
    for k in 0..60 {
        let r = 10.0_f64.powf(3.0 * random.next());
        let [x, y] = [0.5, 0.3].map(|c| r * (c + 0.1 * random.next()));
        let (m, exact) = (double_pendulum(r, [x, y], k % 3), both(r, [x, y]));
        let values = [format!("{x} m"), format!("{y} m")];
        let set = [("b.Q.x", values[0].as_str()), ("b.Q.y", values[1].as_str())];
        let set = if k % 3 == 0 { &set[..] } else { &[] };
        let angles = |q: &[f64]| ["a", "b"].map(|body| q[column(&m, body, 2)]);
        let at = if k % 2 == 0 {
            let guesses = guesses(&mut random, &["a", "b"], 2.0);
            let (state, _) = assembled(&m, set, &guesses);
            let least = exact.map(|exact| {
                let mut q = state.q.clone();
                (0..2).for_each(|b| q[column(&m, ["a", "b"][b], 2)] = exact[b]);
                distance(&m, &q, &guesses)
            });
            let off = distance(&m, &state.q, &guesses);
            assert!(off <= least[0].min(least[1]) + 1e-6, "{k} {guesses:?}");
            turns_are_near(&m, &state.q, &guesses);
            angles(&state.q)
        } else {
            let guess = [0, 1].map(|_| 0.6 * r * random.next());
            let place = guess.map(|v| format!("{v} m"));
            let hints = [("a.P.x", place[0].as_str()), ("a.P.y", place[1].as_str())];
            let [a, b] = angles(&start(&m, set, &hints).0.q);
            let off = |a: f64| {
                (0.5 * r * a.cos() - guess[0]).hypot(0.5 * r * a.sin() - guess[1]) / size(&m)
            };
            let least = exact.map(|[a, _]| off(a)).into_iter().fold(9.0, f64::min);
            assert!(off(a) <= least + 1e-6, "{k} {guess:?}");
            assert!((b - a).abs() <= PI + 1e-9, "{k} {a} {b}");
            [a, b]
        };
        let known = |one: &[f64; 2]| (0..2).all(|b| whole(one[b] - at[b]).abs() < 1e-9);
        assert!(exact.iter().any(known), "{k} {at:?} {exact:?}");
    }
}

/// The remark names the guess, and a wrong length is not blamed on it.
#[test]
fn a_guess_that_does_not_close_is_named() {
    let (_, report) = assembled(&six_bar(1.0), &[], &[("c", -60.0), ("e", 100.0)]);
    let named = |w: &String| {
        w.starts_with("the mechanism does not close near the guess c.angle = -60°, e.angle = 100°")
    };
    assert!(report.warnings.iter().any(named), "{:?}", report.warnings);
    let m = four_bar_of([4.0, 1.0, 1.5, 1.0], "");
    let message = |hints: &[(&str, &str)]| {
        assemble(&m, &Request { ..request(&m, &[], hints) }).unwrap_err().to_string()
    };
    assert_eq!(message(&[("rocker.angle", "200 deg")]), message(&[]));
}
