//! Paths of equilibria over a parameter, with folds in closed form.

use crate::mechanisms::{close, column, model, start, Random};
use kempe::analyses::equilibrium::{path, EquilibriumPath, Options, PathEnd};
use kempe::analyses::State;
use kempe::integrate::Flow;
use kempe::model::Model;

/// Half of a von Mises truss: an apex on a vertical slide, and a spring of stiffness k from the support at the distance b.
fn truss(b: f64, height: f64, k: f64) -> String {
    format!(
        "[parameters]\nload = 0\n[bodies.ground]\npoints = {{ A = [0, 0], B = [{}, 0], S = [{b}, 0] }}\n\
         [bodies.apex]\ntype = 'point_mass'\nmass = 1\nat = [{b}, {height}]\n\
         [joints.slide]\ntype = 'pin_in_slot'\ni = 'ground.S'\nj = 'apex.P'\naxis = '90*deg'\n\
         [forces.left]\ntype = 'spring_damper'\ni = 'ground.A'\nj = 'apex.P'\nstiffness = {k}\nfree_length = '{l}'\n\
         [forces.right]\ntype = 'spring_damper'\ni = 'ground.B'\nj = 'apex.P'\nstiffness = {k}\nfree_length = '{l}'\n\
         [forces.load]\ntype = 'force'\nj = 'apex.P'\nforce = [0, '-load']\n",
        2.0 * b,
        l = b.hypot(height),
    )
}

fn over(name: &str, range: [f64; 2]) -> Options {
    Options { over: Some(name.to_string()), range: Some(range), ..Options::new() }
}

fn follow(model: &Model, start: &State, options: &Options) -> EquilibriumPath {
    path(model, start, options, |_| Flow::Continue).unwrap_or_else(|reason| panic!("{reason}"))
}

/// With the angle a of the bars, P = 2 k sin a (l0 - b / cos a); the folds are at cos³ a = b / l0.
#[test]
fn a_von_mises_truss_snaps_through() {
    let mut random = Random::new(3);
    for _ in 0..5 {
        let (b, k) = (1.0 + 0.5 * random.next(), 100.0 * (2.0 + random.next()));
        let height = b * (0.5 + 0.3 * random.next());
        let m = model(&truss(b, height, k));
        let (state, _) = start(&m, &[], &[]);
        let l0 = b.hypot(height);
        let angle = (b / l0).cbrt().acos();
        let load = |a: f64| 2.0 * k * a.sin() * (l0 - b / a.cos());
        let top = load(angle);
        let back = follow(&m, &state, &over("load", [0.0, 1.5 * top]));
        assert_eq!((back.end, back.folds.len()), (PathEnd::First, 1));
        close("the flat truss", *back.values.last().expect("an end"), 0.0, 0.0);
        close("the flat truss", back.points.last().expect("an end").state.q[1], 0.0, 1e-12);
        let found = follow(&m, &state, &over("load", [-1.5 * top, 1.5 * top]));
        assert_eq!(found.end, PathEnd::Last);
        assert_eq!(found.folds.len(), 2, "{:?}", found.values);
        let y = column(&m, "apex", 1);
        for (k, sign) in found.folds.iter().zip([1.0, -1.0]) {
            let (value, at) = (found.values[*k], &found.points[*k]);
            close("load", value, sign * top, 1e-10 * top);
            close("angle", at.state.q[y].atan2(b), sign * angle, 1e-9);
        }
        for (value, at) in found.values.iter().zip(&found.points) {
            let a = at.state.q[y].atan2(b);
            close("load on the path", *value, load(a), 1e-10 * top);
            // the stiffness of the apex, dP/d(-y)
            let exact = 2.0 * k * (1.0 - l0 * a.cos().powi(3) / b);
            close("stiffness", at.eigenvalues[0], exact, 1e-8 * k);
        }
        let last = found.values.last().copied().unwrap_or(0.0);
        assert_eq!(last, 1.5 * top);
    }
}

/// Without its load, all forces of a chain of springs are rounding errors. With the load, the spring of each joint balances
/// the moment of the load about this joint.
#[test]
fn a_path_begins_without_loads() {
    let mut random = Random::new(12);
    for _ in 0..20 {
        let n = 2 + (3.5 * (1.0 + random.next())) as usize;
        let [length, k, mass] = [0; 3].map(|_| 10.0_f64.powf(3.0 * random.next()));
        let free: Vec<f64> = (0..n).map(|_| 0.5 * random.next()).collect();
        let mut text =
            "[parameters]\nload = 0\n[bodies.ground]\npoints = { B = [0, 0] }\n".to_string();
        let (mut guess, mut angle) = (Vec::new(), 0.0);
        for (i, free) in free.iter().enumerate() {
            let before = if i == 0 { "ground".to_string() } else { format!("b{}", i - 1) };
            text += &format!(
                "[bodies.b{i}]\ntype = 'bar'\nmass = {mass}\nlength = {length}\nends = ['A', 'B']\n\
                 [joints.j{i}]\ntype = 'revolute'\ni = '{before}.B'\nj = 'b{i}.A'\n\
                 [forces.s{i}]\ntype = 'torsion_spring'\ni = '{before}'\nj = 'b{i}'\nstiffness = {k}\nfree_angle = {free}\n"
            );
            angle += free;
            guess.push((format!("b{i}.angle"), format!("{}", angle + 1e-3 * random.next())));
        }
        text +=
            &format!("[forces.load]\ntype = 'force'\nj = 'b{}.B'\nforce = [0, '-load']\n", n - 1);
        let m = model(&text);
        let guess: Vec<(&str, &str)> =
            guess.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        let (state, _) = start(&m, &[], &guess);
        let most = 0.2 * k / (length * n as f64);
        let found = follow(&m, &state, &over("load", [0.0, most]));
        assert_eq!(found.end, PathEnd::Last, "{length} {k} {mass}");
        for (load, at) in found.values.iter().zip(&found.points) {
            let angles: Vec<f64> =
                (0..n).map(|i| at.state.q[column(&m, &format!("b{i}"), 2)]).collect();
            for i in 0..n {
                let arm: f64 = angles[i..].iter().map(|a| length * a.cos()).sum();
                let before = if i == 0 { 0.0 } else { angles[i - 1] };
                close("moment", k * (angles[i] - before - free[i]), -load * arm, 1e-10 * k);
            }
        }
    }
}
