//! Light bodies: which bodies get mass while the equations are solved, or borrow it.

mod times;

use crate::mechanisms::{linkage, model, slider_crank, start, GRAVITY};
use kempe::equations::augmented::NearSingular;
use kempe::equations::{Compiled, Gains, Workspace};
use kempe::model::Model;

/// Bars of these masses that hang on each other, the first on ground.
fn chain(masses: &[&str]) -> Model {
    let mut text = GRAVITY.to_string() + "[bodies.ground]\npoints = { Q = [0, 0] }\n";
    let (mut joints, mut last) = (String::new(), "ground".to_string());
    for (k, mass) in masses.iter().enumerate() {
        text += &format!(
            "[bodies.b{k}]\ntype = \"bar\"\nmass = {mass}\nlength = 1\nends = [\"P\", \"Q\"]\n"
        );
        joints +=
            &format!("[joints.j{k}]\ntype = \"revolute\"\ni = \"{last}.Q\"\nj = \"b{k}.P\"\n");
        last = format!("b{k}");
    }
    model(&(text + &joints))
}

/// The light bodies.
fn light(masses: &[&str]) -> Vec<usize> {
    let compiled = Compiled::new(&chain(masses));
    let found = compiled.light.ratios.iter().enumerate().filter(|(_, ratios)| **ratios != [1.0; 2]);
    found.map(|(k, _)| k).collect()
}

#[test]
fn bodies_between_heavier_ones_are_light() {
    assert_eq!(light(&["1", "1e-4", "1"]), [1]);
    assert_eq!(light(&["1", "1e-4", "1e-4", "1"]), [1, 2], "two in a row");
    assert_eq!(light(&["1e-4", "1"]), [0], "between ground and a heavy body");
    assert_eq!(light(&["1", "1e-4"]), [] as [usize; 0], "it hangs on a heavy body");
    assert_eq!(light(&["1", "1e-4", "1e-8"]), [] as [usize; 0], "each hangs on a heavier one");
    assert_eq!(light(&["1", "1e-2", "1"]), [] as [usize; 0], "hardly light");
    assert_eq!(light(&["1", "0"]), [1], "without mass");
    assert_eq!(light(&["1", "5e-4", "5e-4", "5e-4", "1"]), [1, 2, 3], "a rope");
}

#[test]
fn the_examples_with_light_bodies() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let compiled = Compiled::new(&model(&std::fs::read_to_string(&path).unwrap()));
            if compiled.light.ratios.iter().any(|ratios| *ratios != [1.0; 2]) {
                found.push(path.file_stem().unwrap().to_string_lossy().into_owned());
            }
        }
    }
    found.sort();
    let beams = ["bistable_switch", "compliant_gripper", "cross_spring_pivot", "leaf_spring_guide"];
    let links = ["pump_jack", "rack_steering"];
    let all = [&beams[..], &links].concat();
    assert_eq!(found, all, "each has a light link, or light nodes of a beam, between heavy bodies");
}

/// A mechanism whose equations are solved with damped rows and additions.
fn allowed(text: &str) -> String {
    "redundancy = 'allow'\n".to_string() + GRAVITY + text
}

/// With condensed bodies and with free ones, which have other loans and additions: in motions that violate the velocity equations,
/// and at impacts.
#[test]
fn both_ways_give_the_same_accelerations_and_jumps() {
    for (text, hints) in mechanisms() {
        for mass in ["1e-3", "1e-9", "0"] {
            let text = text.replace("LIGHT", mass);
            let [lent, added] = [GRAVITY.to_string() + &text, allowed(&text)].map(|t| model(&t));
            let (mut state, _) = start(&lent, &[], hints);
            state.v.iter_mut().enumerate().for_each(|(k, v)| *v = (k as f64).sin());
            let gains = Gains { alpha: 3.0, beta: 5.0 };
            let rates: Vec<f64> = (0..lent.layout.n_rows).map(|k| (k as f64).cos()).collect();
            let [one, other] = [&lent, &added].map(|m| {
                let mut workspace = Workspace::new(m);
                let at = [&state.q[..], &state.v, &state.z];
                workspace.accelerate(m, 0.0, at, gains).expect("accelerations");
                let smooth = [workspace.a(), workspace.lam()].concat();
                let jump = workspace.jump(m, 0.0, &state.q, &rates).expect("a jump").concat();
                [smooth, jump]
            });
            for (one, other) in one.iter().zip(&other) {
                let largest = other.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                let apart = one.iter().zip(other).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-11 * largest, "{mass} kg: {apart} of {largest}");
            }
        }
    }
}

/// No ratio of masses looks like a singular position, where an evaluation would take several eliminations.
#[test]
fn one_elimination_solves_the_equations_at_every_ratio_of_masses() {
    for (text, hints) in mechanisms() {
        for mass in ["0.1", "1e-2", "5e-3", "2e-3", "1e-3", "5e-4", "1e-4", "1e-6", "1e-9", "0"] {
            let m = model(&(GRAVITY.to_string() + &text.replace("LIGHT", mass)));
            let (state, _) = start(&m, &[], hints);
            let mut workspace = Workspace::new(&m);
            workspace.matrix.set_near_singular(NearSingular::Regularise);
            workspace.place(&m, [&state.q, &state.v, &state.z]);
            assert!(
                workspace.respond_directly(&m, 0.0, Gains::default()),
                "{mass} kg: {text} {:?} {:?}",
                workspace.matrix.cancellation(),
                workspace.compiled.light
            );
        }
    }
}

/// Three light links between two pendulums have a freedom whose only inertia is their own. In the six-bar linkage all but
/// the crank are light, and a spring loads the last of them.
#[test]
fn chains_of_light_links_at_every_ratio_of_masses() {
    let six_bar = SIX_BAR.replace("mass = 1\nlength = 3", "mass = LIGHT\nlength = 3")
        + "[forces.load]\ntype = 'torsion_spring'\ni = 'ground'\nj = 'output'\nstiffness = 5\n";
    let places = [("left.angle", "-1.2"), ("right.angle", "-1.7"), ("first.angle", "-0.6")];
    let mechanisms = [
        (SLACK.to_string(), &places[..], &[("third.angle", "-0.5")][..]),
        (six_bar, &[("crank.angle", "1")], &[("rocker.angle", "2"), ("output.angle", "1.5")]),
    ];
    for (text, set, guess) in &mechanisms {
        for exponent in 2..=12 {
            let text = text.replace("LIGHT", &format!("1e-{exponent}"));
            let [lent, added] = [GRAVITY.to_string() + &text, allowed(&text)].map(|t| model(&t));
            let (mut state, _) = start(&lent, set, guess);
            state.v.iter_mut().enumerate().for_each(|(k, v)| *v = (k as f64).sin());
            let [one, other] = [&lent, &added].map(|m| {
                let mut workspace = Workspace::new(m);
                let at = [&state.q[..], &state.v, &state.z];
                workspace.accelerate(m, 0.0, at, Gains::default()).expect("accelerations");
                workspace.a().to_vec()
            });
            let largest = other.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let apart = one.iter().zip(&other).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(apart < 2e-13 * largest, "1e-{exponent} kg: {apart} of {largest}");
        }
    }
}

/// A platform on two crossed bars.
const SCISSOR: &str = "[bodies.ground]\npoints = { A = [0, 0] }\n\
    [bodies.left]\nmass = LIGHT\ninertia = LIGHT\npoints = { A = [-1, 0], M = [0, 0], C = [1, 0] }\n\
    [bodies.right]\nmass = LIGHT\ninertia = LIGHT\npoints = { B = [-1, 0], M = [0, 0], D = [1, 0] }\n\
    [bodies.foot]\nmass = 1\ninertia = 1\npoints = { B = [0, 0] }\n\
    [bodies.platform]\nmass = 50\ninertia = 20\npoints = { C = [0, 0], D = [0, 0] }\n\
    [joints]\nA = { type = 'revolute', i = 'ground.A', j = 'left.A' }\n\
    M = { type = 'revolute', i = 'left.M', j = 'right.M' }\n\
    B = { type = 'revolute', i = 'right.B', j = 'foot.B' }\n\
    S = { type = 'translational', i = 'ground.A', j = 'foot.B', axes = [0, 0] }\n\
    D = { type = 'revolute', i = 'right.D', j = 'platform.D' }\n\
    T = { type = 'pin_in_slot', i = 'platform.C', j = 'left.C' }\n";

/// A massless block that slides on a lever.
const QUICK_RETURN: &str = "[bodies.ground]\npoints = { O = [0, 0], D = [-2, 0] }\n\
    [bodies.crank]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['O', 'P']\n\
    [bodies.lever]\ntype = 'bar'\nmass = 2\nlength = 4\nends = ['D', 'E']\n\
    [bodies.block]\nmass = LIGHT\ninertia = LIGHT\npoints = { P = [0, 0] }\n\
    [joints]\nO = { type = 'revolute', i = 'ground.O', j = 'crank.O' }\n\
    D = { type = 'revolute', i = 'ground.D', j = 'lever.D' }\n\
    P = { type = 'revolute', i = 'crank.P', j = 'block.P' }\n\
    S = { type = 'translational', i = 'lever.D', j = 'block.P', axes = [0, 0] }\n";

/// A wheel with inertia and hardly any mass drives a heavy piston.
const FLYWHEEL: &str = "[bodies.ground]\npoints = { O = [0, 0] }\n\
    [bodies.wheel]\nmass = LIGHT\ninertia = 0.4\npoints = { O = [0, 0], A = [0.1, 0] }\n\
    [bodies.rod]\ntype = 'bar'\nmass = LIGHT\nlength = 0.3\nends = ['A', 'B']\n\
    [bodies.piston]\nmass = 2\ninertia = 0\npoints = { B = [0, 0] }\n\
    [joints]\nO = { type = 'revolute', i = 'ground.O', j = 'wheel.O' }\n\
    A = { type = 'revolute', i = 'wheel.A', j = 'rod.A' }\n\
    B = { type = 'revolute', i = 'rod.B', j = 'piston.B' }\n\
    S = { type = 'translational', i = 'ground.O', j = 'piston.B', axes = [0, 0] }\n";

/// A four-bar linkage whose coupler drives a second dyad; crank and output have mass.
const SIX_BAR: &str = "[bodies.ground]\npoints = { A = [0, 0], D = [4, 0], G = [7, 0] }\n\
    [bodies.crank]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'B']\n\
    [bodies.coupler]\nmass = LIGHT\ninertia = LIGHT\npoints = { B = [0, 0], C = [3.5, 0], E = [2, 1] }\n\
    [bodies.rocker]\ntype = 'bar'\nmass = LIGHT\nlength = 2.5\nends = ['D', 'C']\n\
    [bodies.link]\ntype = 'bar'\nmass = LIGHT\nlength = 4\nends = ['E', 'F']\n\
    [bodies.output]\ntype = 'bar'\nmass = 1\nlength = 3\nends = ['G', 'F']\n\
    [joints]\nA = { type = 'revolute', i = 'ground.A', j = 'crank.A' }\n\
    B = { type = 'revolute', i = 'crank.B', j = 'coupler.B' }\n\
    C = { type = 'revolute', i = 'coupler.C', j = 'rocker.C' }\n\
    D = { type = 'revolute', i = 'ground.D', j = 'rocker.D' }\n\
    E = { type = 'revolute', i = 'coupler.E', j = 'link.E' }\n\
    F = { type = 'revolute', i = 'link.F', j = 'output.F' }\n\
    G = { type = 'revolute', i = 'ground.G', j = 'output.G' }\n";

const SLACK: &str = "[bodies.ground]\npoints = { O = [0, 0], E = [3, 0] }\n\
    [bodies.left]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['O', 'P']\n\
    [bodies.right]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['E', 'P']\n\
    [bodies.first]\ntype = 'bar'\nmass = LIGHT\nlength = 1.3\nends = ['P', 'Q']\n\
    [bodies.second]\ntype = 'bar'\nmass = LIGHT\nlength = 1.3\nends = ['P', 'Q']\n\
    [bodies.third]\ntype = 'bar'\nmass = LIGHT\nlength = 1.3\nends = ['P', 'Q']\n\
    [joints]\nO = { type = 'revolute', i = 'ground.O', j = 'left.O' }\n\
    E = { type = 'revolute', i = 'ground.E', j = 'right.E' }\n\
    a = { type = 'revolute', i = 'left.P', j = 'first.P' }\n\
    b = { type = 'revolute', i = 'first.Q', j = 'second.P' }\n\
    c = { type = 'revolute', i = 'second.Q', j = 'third.P' }\n\
    d = { type = 'revolute', i = 'third.Q', j = 'right.P' }\n";

/// Mechanisms, and places near which they are assembled.
type Hints = &'static [(&'static str, &'static str)];
fn mechanisms() -> [(String, Hints); 8] {
    let slider = |piston| slider_crank([0.1, 0.3, 0.0, 0.0], ["1", "LIGHT"], piston);
    let four_bar = |rocker| linkage([4.0, 1.0, 3.5, 2.5], ["1", "LIGHT", rocker]);
    let on_crank: Hints = &[("crank.angle", "1"), ("piston.x", "0.35")];
    let angles: Hints = &[("crank.angle", "1"), ("rocker.angle", "2")];
    [
        (slider("mass = 2\ninertia = 1"), on_crank),
        (four_bar("2"), angles),
        (SCISSOR.into(), &[("left.angle", "0.6"), ("right.angle", "2.5"), ("platform.angle", "0")]),
        (QUICK_RETURN.into(), &[("crank.angle", "0.7")]),
        (FLYWHEEL.into(), &[("wheel.angle", "1"), ("piston.x", "0.35")]),
        (four_bar("LIGHT"), angles), // only the crank has mass
        (slider("mass = LIGHT\ninertia = LIGHT"), on_crank),
        (SIX_BAR.into(), &[("crank.angle", "1"), ("rocker.angle", "2"), ("output.angle", "1.5")]),
    ]
}

/// A crank that drives light couplers and rockers.
fn dyads(n: usize, mass: &str) -> String {
    let mut pivots = String::from("A = [0, 0]");
    let mut bodies =
        String::from("[bodies.crank]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'B']\n");
    let mut joints =
        String::from("[joints]\nA = { type = 'revolute', i = 'ground.A', j = 'crank.A' }\n");
    for k in 0..n {
        pivots += &format!(", D{k} = [{}, {}]", 4.0 + 0.05 * k as f64, 0.02 * k as f64);
        for (name, length, ends) in [("coupler", 3.5, "['B', 'C']"), ("rocker", 2.5, "['D', 'C']")]
        {
            bodies += &format!(
                "[bodies.{name}{k}]\ntype = 'bar'\nmass = {mass}\nlength = {length}\nends = {ends}\n"
            );
        }
        for (name, i, j) in [
            ("B", "crank.B".to_string(), format!("coupler{k}.B")),
            ("C", format!("coupler{k}.C"), format!("rocker{k}.C")),
            ("D", format!("ground.D{k}"), format!("rocker{k}.D")),
        ] {
            joints += &format!("{name}{k} = {{ type = 'revolute', i = '{i}', j = '{j}' }}\n");
        }
    }
    format!("{GRAVITY}[bodies.ground]\npoints = {{ {pivots} }}\n{bodies}{joints}")
}
