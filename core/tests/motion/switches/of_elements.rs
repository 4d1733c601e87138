//! Switches of forces themselves, without a law: the elements are those of `tests/elements`.

use super::{methods, options, run};
use crate::mechanisms::{self, close, column};
use kempe::analyses::dynamics::Scheme;
use kempe::analyses::State;
use kempe::model::Model;

/// A wheel between the ends of a play, with a speed.
fn wheel_with_play(preload: f64, speed: f64) -> (Model, State) {
    let text = format!(
        "[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.wheel]\nmass = 1\ninertia = 2\n\
         points = {{ O = [0, 0] }}\n[joints.pin]\ntype = 'revolute'\ni = 'ground.O'\nj = 'wheel.O'\n\
         [forces.play]\ntype = 'gap_spring'\ni = 'ground'\nj = 'wheel'\nstiffness = 50\ngap = 0.3\n\
         preload = {preload}\n"
    );
    let state = State { t: 0.0, q: vec![0.0; 3], v: vec![0.0, 0.0, speed], z: Vec::new() };
    (mechanisms::model(&text), state)
}

/// With d = θ - gap, J d″ = -(k d + p), d′ = ω at contact: k d + p = R cos(w τ - δ) with tan δ = k ω / (w p). Contact
/// lasts 2 δ/w, and the wheel leaves with -ω.
#[test]
fn a_spring_with_play_swings_with_its_period() {
    for (preload, speed) in [(0.0, 1.5), (4.0, 1.5), (4.0, 0.2)] {
        let (stiffness, inertia, gap) = (50.0_f64, 2.0, 0.3);
        let w = (stiffness / inertia).sqrt();
        let delta = f64::atan2(stiffness * speed / w, preload);
        let period = 2.0 * (2.0 * gap / speed + 2.0 * delta / w);
        let (model, state) = wheel_with_play(preload, speed);
        // without generalized-α at its rough tolerance
        for method in methods(1e-9, 1e-3).into_iter().filter(|m| m.control().rtol < 1e-4) {
            let what = format!("preload {preload}, speed {speed}, {method:?}");
            let second_order = matches!(method, Scheme::GeneralizedAlpha(_));
            let found = run(&what, &model, &state, &options(method, 3.0 * period));
            let last = |table: &[f64]| table[table.len() - 1];
            let [angle, omega] = [last(&found.trajectory.q), last(&found.trajectory.v)];
            // of order 2: (w h)²/12 of the phase w t = 30 for a step of 1e-3
            let tolerance = if second_order { 1e-4 } else { 3e-6 };
            close(&what, angle, 0.0, tolerance);
            close(&what, omega, speed, tolerance);
            // twelve contacts begin and end
            let contact = |t: f64| (t - gap / speed).rem_euclid(0.5 * period);
            let times = found.trajectory.t.iter().map(|t| contact(*t));
            let begins = times.filter(|t| *t < 1e-6 || 0.5 * period - *t < 1e-6).count();
            assert!(second_order || begins >= 6, "{what}: {begins}");
        }
    }
}

/// A bar falls from the horizontal: with θ the angle below it, the pin carries 5/2 m g sin θ along the bar and m g cos θ/4
/// across. Where that exceeds the limit, a wheel beside the bar is driven.
#[test]
fn a_switch_on_a_reaction_is_located() {
    let text = "gravity = [0, -9.81]\n[bodies.ground]\npoints = { O = [0, 0], W = [3, 0] }\n\
                [bodies.rod]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['O', 'P']\n\
                [bodies.wheel]\nmass = 1\ninertia = 2\npoints = { O = [0, 0] }\n\
                [joints.pin]\ntype = 'revolute'\ni = 'ground.O'\nj = 'rod.O'\n\
                [joints.axle]\ntype = 'revolute'\ni = 'ground.W'\nj = 'wheel.O'\n\
                [forces.drive]\ntype = 'overload'\njoint = 'pin'\ni = 'ground'\nj = 'wheel'\n\
                torque = 6\nlimit = 15\n";
    let model = mechanisms::model(text);
    let (state, _) = mechanisms::start(&model, &[("rod.angle", "0"), ("wheel.angle", "0")], &[]);
    let load = 15.0 / 9.81_f64;
    let angle = ((load * load - 1.0 / 16.0) / (6.25 - 1.0 / 16.0)).sqrt().asin();
    let (rod, wheel) = (column(&model, "rod", 2), column(&model, "wheel", 2));
    for method in methods(1e-9, 2e-3) {
        let what = format!("{method:?}");
        let second_order = matches!(method, Scheme::GeneralizedAlpha(_));
        let rough = method.control().rtol > 1e-4;
        let found = run(&what, &model, &state, &options(method, 0.5));
        let trajectory = &found.trajectory;
        let n = model.layout.n_q;
        let omega = trajectory.v[trajectory.v.len() - n + wheel];
        let switched = 0.5 - omega / 3.0;
        let row = trajectory.t.iter().position(|t| (t - switched).abs() < 1e-9);
        let row = row.unwrap_or_else(|| panic!("{what}: no step ends at {switched}"));
        close(
            &what,
            trajectory.q[row * n + rod],
            -angle,
            if rough {
                1e-2
            } else if second_order {
                1e-4
            } else {
                1e-6
            },
        );
    }
}
