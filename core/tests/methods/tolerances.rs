//! Absolute tolerances: by kind, and scaled with the size of the mechanism.

use crate::mechanisms::{four_bar, model, run, start, worst, FOUR_BAR};
use kempe::analyses::dynamics::{read, Auto, Options, Run, Scheme};
use kempe::case;
use kempe::case::Format;
use kempe::integrate::{Atol, Dop853, GeneralizedAlpha, Radau, Rk45, StepControl};
use kempe::model::Model;

/// A double pendulum with a damped spring, all lengths times `scale`: masses and times stay, so that gravity has the
/// factor `scale`, and torsional stiffness and damping its square.
fn pendulum(scale: f64) -> String {
    format!(
        r#"
gravity = [0, "-9.81*s"]
[parameters]
s = {scale:e}
[bodies.ground]
points = {{ O = [0, 0], W = ["1.5*s", "0.5*s"] }}
[bodies.upper]
type = "bar"
mass = 1
length = "s"
ends = ["A", "B"]
[bodies.lower]
type = "bar"
mass = 2
length = "0.7*s"
ends = ["B", "C"]
[joints.A]
type = "revolute"
i = "ground.O"
j = "upper.A"
[joints.B]
type = "revolute"
i = "upper.B"
j = "lower.B"
[forces.spring]
type = "spring_damper"
i = "ground.W"
j = "lower.C"
stiffness = 30
damping = 0.2
free_length = "0.4*s"
[forces.torsion]
type = "torsion_spring"
i = "upper"
j = "lower"
stiffness = "2*s^2"
damping = "0.05*s^2"
"#
    )
}

/// The run of a method at a scale, with lengths divided by it.
fn scaled(scale: f64, method: Scheme) -> (Run, Vec<f64>) {
    let m = model(&pendulum(scale));
    let set = [("upper.angle", "-0.4"), ("lower.angle", "0.9"), ("upper.omega", "3")];
    let (state, _) = start(&m, &set, &[]);
    let run = run(&m, &state, &Options { method, ..Options::new(3.0) });
    let last = run.trajectory.q.rchunks(6).next().expect("a state").to_vec();
    let last = last.into_iter().enumerate();
    let last = last.map(|(k, x)| if k % 3 == 2 { x } else { x / scale }).collect();
    (run, last)
}

fn defaults() -> Vec<Scheme> {
    let control = StepControl::with(StepControl::USUAL);
    vec![
        Scheme::Auto(Auto::default()),
        Scheme::Rk45(Rk45 { control: control.clone() }),
        Scheme::Dop853(Dop853 { control: control.clone() }),
        Scheme::Radau(Radau { control }),
        Scheme::GeneralizedAlpha(GeneralizedAlpha {
            control: StepControl::with(StepControl::LOW_ORDER),
            ..GeneralizedAlpha::new(kempe::integrate::AlphaParameters::chung_hulbert(0.8), 1.0, 1.0)
        }),
    ]
}

/// A power of two scales every number exactly, so that explicit methods have the same steps and the same digits.
/// Pivots of implicit ones differ, so that these agree within their tolerance.
#[test]
fn a_mechanism_has_the_same_digits_at_every_scale() {
    for method in defaults() {
        let name = format!("{method:?}");
        let exact = !name.contains("Radau") && !name.contains("Alpha");
        let (one, there) = scaled(1.0, method.clone());
        for scale in [2_f64.powi(-20), 2_f64.powi(-30), 2_f64.powi(20), 1e-6] {
            let (small, here) = scaled(scale, method.clone());
            let [steps, others] = [&one, &small].map(|run| run.statistics.steps);
            let off = worst(&there, &here);
            if exact && scale != 1e-6 {
                assert_eq!(steps, others, "{name} {scale:e}");
                assert!(off < 1e-12, "{name} {scale:e}: {off:.1e}");
            }
            let allowed = if exact { 1e-10 } else { 1e-3 };
            assert!(off < allowed, "{name} {scale:e}: {off:.1e}");
            assert!(steps.abs_diff(others) <= steps / 10, "{name} {scale:e}: {steps} {others}");
        }
    }
}

/// One number is in metres and radians, at every scale: a micrometre is resolved to nothing by 1e-6.
#[test]
fn a_number_has_the_same_meaning_at_every_scale() {
    let steps = |scale: f64| {
        let control = StepControl { atol: Atol::Scalar(1e-6), ..StepControl::new(1e-6, 0.0) };
        scaled(scale, Scheme::Rk45(Rk45 { control })).0.statistics.steps
    };
    let (one, micro) = (steps(1.0), steps(1e-6));
    assert!(2 * micro < 3 * one, "{micro} of {one}");
    assert_ne!(one, micro);
}

/// The method of an analysis as written.
fn method(m: &Model, written: &str) -> Result<Scheme, String> {
    let text =
        format!("kempe = 1\n[analyses.a]\ntype = 'dynamics'\nt_end = 1\nmethod = {written}\n");
    let (case, _) = case::read(&text, Format::Toml)
        .map_err(|found| found.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))?;
    read(m, &case.analyses[0].fields, &[])
        .map(|options| options.method)
        .map_err(|found| found.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

fn atol(m: &Model, written: &str) -> Atol {
    method(m, written).unwrap_or_else(|faults| panic!("{faults}")).control().atol.clone()
}

#[test]
fn a_table_has_a_number_for_each_kind() {
    let (m, _) = four_bar(); // of size 20 m
    let given = "{ type = 'rk45', atol = { length = 1e-7, angle = '2e-9', z = 3e-5 } }";
    let expected = [1e-7, 1e-7, 2e-9].repeat(6);
    assert_eq!(atol(&m, given), Atol::Each(expected));
    let Atol::Each(part) = atol(&m, "{ type = 'auto', atol = { angle = 1e-5 } }") else {
        panic!("one each")
    };
    assert!(worst(&part, &[20e-11, 20e-11, 1e-5].repeat(6)) < 1e-20);
    assert_eq!(atol(&m, "{ type = 'radau', atol = 1e-8 }"), Atol::Scalar(1e-8));
    assert_eq!(atol(&m, "{ type = 'radau' }"), Atol::Scaled(1e-9));
    assert_eq!(atol(&m, "{ type = 'generalized_alpha' }"), Atol::Scaled(1e-7));
    assert_eq!(atol(&m, "{ type = 'dop853' }"), Atol::Scaled(1e-9));
    let length = atol(&m, "{ type = 'rk45', atol = { length = '1 um' } }");
    let Atol::Each(length) = length else { panic!("one each") };
    assert!((length[0] - 1e-6).abs() < 1e-20 && length[2] == 1e-9);
    // a motor with an inductance has a current
    let motor = "[forces.motor]\ntype = 'motor'\ni = 'ground'\nj = 'crank'\nvoltage = 12\n\
                 resistance = 1\ninductance = 0.1\ntorque_constant = 2\n";
    let driven = model(&FOUR_BAR.replacen("[start]", &format!("{motor}\n[start]"), 1));
    let Atol::Each(all) = atol(&driven, given) else { panic!("one each") };
    assert_eq!((all.len(), all[18]), (19, 3e-5));
}

#[test]
fn faulty_tables_are_refused_by_name() {
    let (m, _) = four_bar();
    for (written, expected) in [
        ("{ type = 'rk45', atol = { lenght = 1e-9 } }", "did you mean 'length'"),
        ("{ type = 'rk45', atol = { length = -1e-9 } }", "must be >= 0"),
        ("{ type = 'rk45', atol = { angle = '1 m' } }", "rad"),
        ("{ type = 'rk45', atol = [1e-9, 1e-9] }", "a number, or a table"),
        ("{ type = 'rk45', atol = true }", "a number, or a table"),
    ] {
        let faults = method(&m, written).expect_err(written);
        assert!(faults.contains(expected) && faults.contains("atol"), "{written}: {faults}");
    }
}
