//! The time of an evaluation with light bodies.

use super::{chain, dyads, mechanisms, SLACK};
use crate::mechanisms::{model, start, GRAVITY};
use kempe::equations::{Gains, Workspace};
use kempe::model::Model;

/// The time of an evaluation with light bodies, and with heavy ones in their place.
#[test]
#[ignore = "a measurement: cargo test --release -p kempe --test motion light_bodies -- --ignored --nocapture"]
fn the_time_of_light_bodies() {
    let names = [
        "slider-crank",
        "four-bar",
        "scissor",
        "quick return",
        "flywheel",
        "coupler and rocker",
        "piston and rod",
        "six-bar",
    ];
    for (name, (text, hints)) in names.into_iter().zip(mechanisms()) {
        let [heavy, light, massless] = ["1", "1e-9", "0"]
            .map(|mass| time(&model(&(GRAVITY.to_string() + &text.replace("LIGHT", mass))), hints));
        println!(
            "{name}: {heavy:.2} us; 1e-9 kg {:.2}, 0 kg {:.2}",
            light / heavy,
            massless / heavy
        );
    }
    let [heavy, light] = ["1", "1e-9"].map(|mass| {
        let names: Vec<String> = (0..10).map(|k| format!("rocker{k}.angle")).collect();
        let rockers = names.iter().map(|name| (&name[..], "2"));
        let hints: Vec<(&str, &str)> =
            std::iter::once(("crank.angle", "1")).chain(rockers).collect();
        time(&model(&dyads(10, mass)), &hints)
    });
    println!("ten dyads on one crank: {heavy:.2} us; 1e-9 kg {:.2}", light / heavy);
    let hints = [("left.angle", "-1.2"), ("right.angle", "-1.7"), ("first.angle", "-0.6")];
    let hints: Vec<(&str, &str)> = hints.into_iter().chain([("third.angle", "-0.5")]).collect();
    let of =
        |mass: &str| time(&model(&(GRAVITY.to_string() + &SLACK.replace("LIGHT", mass))), &hints);
    own_freedoms("three links with their own freedom", of);
    for n in [3, 10] {
        let names: Vec<String> = (0..=n).map(|k| format!("b{k}.angle")).collect();
        let angles = ["-1.2", "-0.9", "-1.6"];
        let hints = names.iter().enumerate().map(|(k, name)| (&name[..], angles[k % 3]));
        let hints: Vec<(&str, &str)> = hints.collect();
        let of = |mass: &str| {
            let masses: Vec<&str> = std::iter::repeat_n(mass, n).chain(["1"]).collect();
            time(&chain(&masses), &hints)
        };
        own_freedoms(&format!("a weight on {n} links"), of);
    }
    for (name, n, every) in [("single links", 10, 2), ("dyads", 30, 3)] {
        let names: Vec<String> = (0..n).map(|k| format!("b{k}.angle")).collect();
        let angles = ["0.3", "-0.6", "1.1"]; // no two neighbours in a line
        let hints = names.iter().enumerate().map(|(k, name)| (&name[..], angles[k % 3]));
        let hints: Vec<(&str, &str)> = hints.collect();
        let [heavy, light] = ["1", "1e-9"].map(|mass| {
            let own = |k| if k % every == 0 { "1" } else { mass };
            let masses: Vec<&str> = (0..n).map(own).chain(["1"]).collect();
            time(&chain(&masses), &hints)
        });
        println!("chain with {name}: {heavy:.2} us; 1e-9 kg {:.2}", light / heavy);
    }
}

/// Prints the times of an evaluation with light links that have freedoms of their own.
fn own_freedoms(name: &str, time: impl Fn(&str) -> f64) {
    let heavy = time("1");
    let ratios = ["1e-4", "1e-6", "1e-9", "1e-12"].map(|mass| (mass, time(mass) / heavy));
    let ratios = ratios.map(|(mass, ratio)| format!("{mass} kg {ratio:.2}")).join(", ");
    println!("{name}: {heavy:.2} us; {ratios}");
}

/// The least time of an evaluation, us.
fn time(m: &Model, hints: &[(&str, &str)]) -> f64 {
    let (mut state, _) = start(m, &[], hints);
    // the equations are solved for any velocities
    state.v.iter_mut().enumerate().for_each(|(k, v)| *v = 0.1 * (k as f64 + 1.0));
    let mut workspace = Workspace::new(m);
    let measure = |_| {
        let began = std::time::Instant::now();
        for _ in 0..100 {
            let at = [&state.q[..], &state.v, &state.z];
            workspace.accelerate(m, 0.0, at, Gains::default()).expect("accelerations");
        }
        began.elapsed().as_secs_f64() * 1e4
    };
    (0..1000).map(measure).fold(f64::INFINITY, f64::min)
}
