//! Mechanisms from text, for the tests that include this file; not every test uses all of it.
#![allow(dead_code)]

pub mod methods;

use kempe::analyses::assemble::{assemble, targets, Failure, Report, Request, Target};
use kempe::analyses::dynamics::{dynamics, Options, Run, Scheme};
use kempe::analyses::State;
use kempe::case::{read, Format};
use kempe::equations::kinematics::Motions;
use kempe::integrate::{Flow, Rk45};
use kempe::model::{build, Model, Value};
use std::fmt::Display;
use std::time::Instant;

/// The flagship, as users get it.
pub const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");

/// A bar of 1 m that swings about its end.
pub const PENDULUM: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.rod]
type = "bar"
mass = 1
length = 1
ends = ["O", "P"]
[joints.pin]
type = "revolute"
i = "ground.O"
j = "rod.O"
"#;

/// Two bars, the upper driven along a law of time, the lower off its mass centre.
pub const DOUBLE_PENDULUM: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.upper]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.lower]
mass = 2
inertia = 0.3
center = [0.2, 0.1]
points = { B = [-0.4, 0.05] }
[joints.A]
type = "revolute"
i = "ground.O"
j = "upper.A"
[joints.B]
type = "revolute"
i = "upper.B"
j = "lower.B"
[drivers.motor]
type = "coordinate_driver"
coordinate = "upper.angle"
value = "0.3*sin(5*t) - pi/2"
"#;

/// A crank of 0.1 m, a rod of 0.3 m, and a piston on a line through the pivot of the crank.
pub const SLIDER_CRANK: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0], S = [0, 0] }
[bodies.crank]
type = "bar"
mass = 1
length = 0.1
ends = ["O", "A"]
[bodies.rod]
type = "bar"
mass = 0.5
length = 0.3
ends = ["A", "B"]
[bodies.piston]
mass = 0.4
inertia = 1e-4
points = { B = [0, 0] }
[joints.O]
type = "revolute"
i = "ground.O"
j = "crank.O"
[joints.A]
type = "revolute"
i = "crank.A"
j = "rod.A"
[joints.B]
type = "revolute"
i = "rod.B"
j = "piston.B"
[joints.S]
type = "translational"
i = "ground.S"
j = "piston.B"
"#;

/// Everything that is wrong with a case, one fault a line; empty if it builds.
pub fn faults(text: &str) -> String {
    let lines: Vec<String> = match read(&format!("kempe = 1\n{text}"), Format::Toml) {
        Err(found) => {
            found.iter().map(|d| format!("{}: {}", d.path.join("."), d.message)).collect()
        }
        Ok((case, _)) => match build(&case.definition, &[]) {
            Err(found) => found.iter().map(ToString::to_string).collect(),
            Ok(_) => Vec::new(),
        },
    };
    lines.join("\n")
}

/// The model of a case; `text` goes without its first line `kempe = 1`.
pub fn model(text: &str) -> Model {
    with(text, &[])
}

/// The same with other values of parameters.
pub fn with(text: &str, overrides: &[(&str, f64)]) -> Model {
    let text =
        if text.contains("kempe = 1") { text.to_string() } else { format!("kempe = 1\n{text}") };
    let (case, _) = read(&text, Format::Toml).unwrap_or_else(|d| panic!("{d:#?}"));
    let overrides: Vec<_> =
        overrides.iter().map(|(name, x)| (name.to_string(), Value::from(*x))).collect();
    build(&case.definition, &overrides).unwrap_or_else(|p| panic!("{p:#?}"))
}

/// Targets written as in a file, such as ("crank.angle", "70*deg").
pub fn asked(model: &Model, section: &str, written: &[(&str, &str)]) -> Vec<Target> {
    let written: Vec<_> =
        written.iter().map(|(key, text)| (key.to_string(), Value::from(*text))).collect();
    targets(model, section, &written).unwrap_or_else(|p| panic!("{p:#?}"))
}

/// A request for assembly.
pub fn request(model: &Model, set: &[(&str, &str)], guess: &[(&str, &str)]) -> Request {
    Request {
        set: asked(model, "set", set),
        guess: asked(model, "guess", guess),
        ..Request::default()
    }
}

/// Assembles, or panics with the error.
pub fn start(model: &Model, set: &[(&str, &str)], guess: &[(&str, &str)]) -> (State, Report) {
    assemble(model, &request(model, set, guess)).unwrap_or_else(|f| panic!("{f}"))
}

/// Fails to assemble.
pub fn refused(model: &Model, set: &[(&str, &str)]) -> Box<Failure> {
    assemble(model, &request(model, set, &[])).expect_err("must not assemble")
}

/// The flagship at its start.
pub fn four_bar() -> (Model, State) {
    let m = model(FOUR_BAR);
    let guess = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
    let (state, _) = start(&m, &[("crank.angle", "70*deg")], &guess);
    (m, state)
}

/// Gravity on Earth, for the text of a case.
pub const GRAVITY: &str = "gravity = [0, -9.81]\n";

/// A body whose point O a pin holds at the origin, with the fields of the body.
pub fn pinned(body: &str, fields: &str) -> String {
    format!(
        "[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.{body}]\n{fields}\n\
         [joints.pin]\ntype = 'revolute'\ni = 'ground.O'\nj = '{body}.O'\n"
    )
}

/// A slider-crank mechanism: the lengths of crank and rod, the height of a point of the line and the angle of the line; the
/// masses of crank and rod, and the fields of the piston.
pub fn slider_crank(
    [crank, rod, height, angle]: [f64; 4],
    [first, second]: [&str; 2],
    piston: &str,
) -> String {
    format!(
        "[bodies.ground]\npoints = {{ O = [0, 0], S = [0, {height}] }}\n\
         [bodies.crank]\ntype = 'bar'\nmass = {first}\nlength = {crank}\nends = ['O', 'A']\n\
         [bodies.rod]\ntype = 'bar'\nmass = {second}\nlength = {rod}\nends = ['A', 'B']\n\
         [bodies.piston]\n{piston}\npoints = {{ B = [0, 0] }}\n\
         [joints]\nO = {{ type = 'revolute', i = 'ground.O', j = 'crank.O' }}\n\
         A = {{ type = 'revolute', i = 'crank.A', j = 'rod.A' }}\n\
         B = {{ type = 'revolute', i = 'rod.B', j = 'piston.B' }}\n\
         S = {{ type = 'translational', i = 'ground.S', j = 'piston.B', axes = [{angle}, 0] }}\n"
    )
}

/// A four-bar linkage of bars: the lengths of ground, crank, coupler and rocker, and the masses of the bars.
pub fn linkage(
    [ground, crank, coupler, rocker]: [impl Display; 4],
    [first, second, third]: [impl Display; 3],
) -> String {
    format!(
        "[bodies.ground]\npoints = {{ A = [0, 0], D = [{ground}, 0] }}\n\
         [bodies.crank]\ntype = 'bar'\nmass = {first}\nlength = {crank}\nends = ['A', 'B']\n\
         [bodies.coupler]\ntype = 'bar'\nmass = {second}\nlength = {coupler}\nends = ['B', 'C']\n\
         [bodies.rocker]\ntype = 'bar'\nmass = {third}\nlength = {rocker}\nends = ['D', 'C']\n\
         [joints]\nA = {{ type = 'revolute', i = 'ground.A', j = 'crank.A' }}\n\
         B = {{ type = 'revolute', i = 'crank.B', j = 'coupler.B' }}\n\
         C = {{ type = 'revolute', i = 'coupler.C', j = 'rocker.C' }}\n\
         D = {{ type = 'revolute', i = 'ground.D', j = 'rocker.D' }}\n"
    )
}

/// The same with bars of 1 kg, and further tables.
pub fn four_bar_of(lengths: [impl Display; 4], more: &str) -> Model {
    model(&format!("{}{more}\n", linkage(lengths, [1; 3])))
}

/// A driver of a coordinate by a law.
pub fn motor(coordinate: &str, law: &str) -> String {
    format!(
        "[drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = '{coordinate}'\nvalue = '{law}'\n"
    )
}

/// Options with the given tolerances.
pub fn tolerances(t_end: f64, rtol: f64, atol: f64) -> Options {
    let scheme = Scheme::Rk45(Rk45::new(rtol, atol));
    Options { method: scheme, dense_output: false, ..Options::classical(t_end) }
}

/// Runs to the end, or panics with the error.
pub fn run(model: &Model, state: &State, options: &Options) -> Run {
    dynamics(model, state, options, |_| Flow::Continue).unwrap_or_else(|f| panic!("{}", f.reason))
}

/// Output every `h`.
pub fn every(h: f64, options: Options) -> Options {
    Options { output_step: Some(h), ..options }
}

/// Column of the coordinate `x`, `y` or `angle` of a body in q.
pub fn column(model: &Model, body: &str, coordinate: usize) -> usize {
    model.layout.bodies[model.body(body).expect("a body").0].first + coordinate
}

/// Φ at a state.
pub fn residual(model: &Model, state: &State) -> Vec<f64> {
    let mut phi = vec![0.0; model.layout.n_rows];
    let motions = Motions::at_rest(&model.layout, &state.q);
    kempe::equations::constraints::residual(model, &motions, state.t, &mut phi);
    phi
}

/// Φ_q q̇ + Φ_t at a state.
pub fn rate(model: &Model, state: &State) -> Vec<f64> {
    let m = model.layout.n_rows;
    let motions = Motions::at(&model.layout, &state.q, &state.v);
    let (mut phi, mut rate, mut gamma) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
    kempe::equations::constraints::velocity_terms(
        model, &motions, state.t, &mut phi, &mut rate, &mut gamma,
    );
    rate
}

/// Largest difference of two equally long slices.
#[track_caller]
pub fn worst(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |worst, (a, b)| {
        assert!(a.is_finite() && b.is_finite(), "{a} {b}");
        f64::max(worst, (a - b).abs())
    })
}

/// Largest magnitude.
pub fn largest(a: &[f64]) -> f64 {
    worst(a, &vec![0.0; a.len()])
}

/// Asserts |a - b| <= tolerance, with a name in the message.
#[track_caller]
pub fn close(what: &str, a: f64, b: f64, tolerance: f64) {
    let error = (a - b).abs();
    assert!(
        error <= tolerance,
        "{what}: {a} is not {b}: off by {error:.3e}, allowed {tolerance:.1e}"
    );
}

/// Time of this thread on a processor, s; where it is not known, time since `begin`.
pub fn clock(begin: Instant) -> f64 {
    let known = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = known.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begin.elapsed().as_secs_f64(), |ns| 1e-9 * ns)
}

/// The size of a sample: `part`, or `all` with `KEMPE_FULL=1` in the environment.
pub fn count(part: u64, all: u64) -> u64 {
    match std::env::var("KEMPE_FULL").as_deref() {
        Ok("1") => all,
        _ => part,
    }
}

/// Numbers without pattern in [-1, 1], reproducible.
pub struct Random(u64);

impl Random {
    /// From a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }
    /// The next.
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    /// Many.
    pub fn many(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}
