//! Models written in Rust equal those of files, with the same error messages.

use kempe::case::{self, Format};
use kempe::drivers::CoordinateDriver;
use kempe::forces::{SpringDamper, Torque, TorsionSpring};
use kempe::joints::{Distance, Revolute, Translational};
use kempe::model::body_tables;
use kempe::{assemble, dynamics, Case, Flow, Frame, ModelBuilder, Options, Start, Value};

const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");

fn four_bar() -> ModelBuilder {
    let mut m = ModelBuilder::new("Four-bar linkage with a rotational spring-damper");
    m.gravity(0, -9.81);
    m.parameter("L1", 10).parameter("L2", 26).parameter("L3", 18).parameter("G", 20);
    m.parameter("k", 1e6).parameter("c", 1e4);
    m.ground().point("A", 0, 0).point("D", "G", 0);
    m.bar("crank").mass(3).length("L1").ends("A", "B");
    m.bar("coupler").mass(5).length("L2").ends("B", "C");
    m.bar("rocker").mass(4).length("L3").ends("C", "D");
    m.add("A", Revolute::written().i("ground.A").j("crank.A"));
    m.add("B", Revolute::written().i("crank.B").j("coupler.B"));
    m.add("C", Revolute::written().i("coupler.C").j("rocker.C"));
    m.add("D", Revolute::written().i("ground.D").j("rocker.D"));
    let spring = TorsionSpring::written().i("ground").j("rocker");
    m.add("spring", spring.stiffness("k").damping("c").free_angle("270*deg"));
    m
}

fn start() -> Start {
    let guess = Start::new().guess("coupler.angle", "14*deg").guess("rocker.angle", "240*deg");
    guess.set("crank.angle", "70*deg")
}

#[test]
fn the_same_definition_as_the_file() {
    let (case, _) = case::read(FOUR_BAR, Format::Toml).unwrap();
    assert_eq!(*four_bar().definition(), case.definition);
    assert_eq!(start(), case.start);
    let written = Case { definition: four_bar().definition().clone(), ..case.clone() };
    let again = case::read(&case::write(&written, Format::Toml), Format::Toml).unwrap().0;
    assert_eq!(again, case);
}

#[test]
fn reactions_and_coordinates_by_name() {
    let model = four_bar().build().unwrap();
    let (state, _) = assemble(&model, &start().request(&model).unwrap()).unwrap();
    let options = Options { output_step: Some(0.1), ..Options::new(0.5) };
    let run = dynamics(&model, &state, &options, |_| Flow::Continue).unwrap();
    let rocker = run.coordinate(&model, "rocker.angle").unwrap();
    assert_eq!(rocker.len(), 6);
    assert_eq!(rocker[0], state.q[8]);
    assert_eq!(run.coordinate(&model, "rocker.vy").unwrap()[5], run.trajectory.v[5 * 9 + 7]);
    // Φ = point_j - point_i: the force on body i is +λ, that on body j -λ
    let lam = run.accelerations(&model).unwrap().lam;
    let on_i = run.reactions(&model, "C", "coupler", Frame::Global).unwrap();
    let on_j = run.reactions(&model, "C", "rocker", Frame::Global).unwrap();
    for (k, (i, j)) in on_i.iter().zip(&on_j).enumerate() {
        let own = &lam[8 * k + 4..8 * k + 6];
        for (force, sign) in [(i.force, 1.0), (j.force, -1.0)] {
            assert!((force.x - sign * own[0]).abs() < 1e-9 * 25e3);
            assert!((force.y - sign * own[1]).abs() < 1e-9 * 25e3);
        }
        assert!(i.torque.abs() < 1e-8 * 25e3);
    }
    assert!((on_i[0].force.x.hypot(on_i[0].force.y) - 24_932.0).abs() < 1.0);
}

#[test]
fn unknown_names_of_results() {
    let model = four_bar().build().unwrap();
    let (state, _) = assemble(&model, &start().request(&model).unwrap()).unwrap();
    let run = dynamics(&model, &state, &Options::new(0.0), |_| Flow::Continue).unwrap();
    for name in ["wheel.angle", "crank.phi", "crank", "ground.x"] {
        let none = run.coordinate(&model, name).unwrap_err().to_string();
        assert!(none.contains(&format!("'{name}'")), "{none}");
    }
    for (joint, on, word) in [("E", "crank", "'E'"), ("A", "rocker", "'rocker'"), ("A", "x", "'x'")]
    {
        let none = run.reactions(&model, joint, on, Frame::Joint).unwrap_err().to_string();
        assert!(none.contains(word), "{none}");
    }
}

#[test]
fn other_values_of_parameters() {
    let m = four_bar();
    let model = m.build_with(&[("L1", "5 + 6"), ("k", "2e6")]).unwrap();
    assert_eq!(model.parameters[..2], [11.0, 26.0]);
    assert_eq!(model.parameters[4], 2e6);
    let problems = m.build_with(&[("stiffness", 1.0)]).unwrap_err();
    assert!(problems.to_string().contains("no parameter 'stiffness'"), "{problems}");
}

#[test]
fn all_faults_at_once_as_of_a_file() {
    let mut m = four_bar();
    m.add("E", Revolute::written().i("crank.A"));
    m.add("crank", Torque::written().j("crank"));
    m.parameter("pi", 3);
    let found = m.build().unwrap_err().to_string();
    let same = Case { definition: m.definition().clone(), ..Case::default() };
    let read = case::read(&case::write(&same, Format::Json), Format::Json).unwrap_err();
    assert_eq!(found.lines().count(), read.len());
    for fault in read {
        assert!(found.contains(&fault.message), "{} is not in:\n{found}", fault.message);
    }
    for part in ["joints.E.j: missing; revolute needs it", "forces.crank.torque", "parameters.pi"] {
        assert!(found.contains(part), "{part} is not in:\n{found}");
    }
}

#[test]
fn names_that_are_given_twice() {
    let mut m = four_bar();
    m.parameter("k", 1);
    m.bar("crank").mass(1).length(1).ends("P", "Q");
    m.add("C", Revolute::written().i("crank.A").j("rocker.C"));
    m.ground().point("A", 1, 1);
    let found: Vec<_> = m.build().unwrap_err().0.iter().map(ToString::to_string).collect();
    let twice = ["parameters.k", "bodies.crank", "bodies.ground.points.A", "joints.C"];
    for path in twice {
        let name = path.rsplit('.').next().unwrap();
        assert!(found.contains(&format!("{path}: '{name}' is given twice")), "{path}: {found:#?}");
    }
    assert_eq!(found.len(), twice.len(), "{found:#?}");
}

#[test]
fn faults_of_the_mechanics() {
    let mut m = four_bar();
    m.body("bob").mass("-k").inertia(1).center(0, f64::NAN);
    assert!(m.build().unwrap_err().to_string().contains("bodies.bob.center"));
    let mut m = four_bar();
    m.body("bob").mass("-k").inertia(1);
    m.add("E", Revolute::written().i("bob.A").j("cranc.A"));
    let found = m.build().unwrap_err().to_string();
    assert!(found.contains("joints.E.i") && found.contains("did you mean 'crank'"), "{found}");
    let request =
        Start::new().set("crank.phi", 1).guess("wheel.x", 2).request(&four_bar().build().unwrap());
    assert_eq!(request.unwrap_err().0.len(), 2);
}

#[test]
fn a_second_value_replaces_the_first() {
    let mut m = four_bar();
    m.add("torque", Torque::written().torque(1).j("crank").torque("k*t"));
    let torque = m.definition().forces.last().unwrap();
    assert_eq!(torque.get("torque"), Some(&Value::from("k*t")));
    assert_eq!(torque.fields.len(), 3, "{torque:?}");
}

/// Each body has a method for each field that it declares, and no other.
#[test]
fn every_field_of_bodies() {
    let circle = || [("circle", Value::List([0.0, 0.0, 1.0].map(Value::from).into()))];
    let mut m = ModelBuilder::new("all");
    let drawn = || Value::Table(circle().map(|(key, value)| (key.to_string(), value)).into());
    m.ground().point("O", 0, 0).curve("ring", circle()).outline(drawn());
    let bar = m.bar("bar").mass(1).length(1).ends("A", "B").curve("rim", circle()).outline(drawn());
    bar.through("A", 0, 0).through("B", 1, 0).point("C", 0, 1);
    let body = m.body("body").mass(1).inertia(1).center(0, 0).point("C", 0, 1);
    let body = body.curve("rim", circle()).outline(drawn());
    body.through("C", 0, 0).through("D", 1, 1);
    let all = m.beam("beam").ends("A", "B").length(1).young(1e9).density(1e3).poisson(0.3);
    let all = all.section(Value::Table(vec![("circle".to_string(), 0.01.into())]));
    let all = all.stiffness(1, 1, 1).mass_per_length(1).inertia_per_length(1).damping(0);
    let all = all.elements(2).shear(true).inextensible(false).point("P", "50 %");
    all.through(Value::List(vec![])).arc(Value::List(vec![]));
    m.point_mass("point_mass").mass(1).at(0.5, 2).outline(drawn());
    // a body has shapes, or mass, inertia and center
    m.body("of shapes").shape("disc", [("radius", 1.0.into()), ("mass", 1.0.into())]);
    // some fields of a beam exclude each other
    let beam = |m: &ModelBuilder| m.definition().bodies.iter().find(|b| b.name == "beam").is_some();
    assert!(m.build().is_err() && beam(&m));
    for table in body_tables() {
        let entry = m.definition().bodies.iter().find(|b| b.name == table.name).unwrap();
        let mut written: Vec<&str> = entry.fields.iter().map(|(key, _)| key.as_str()).collect();
        written.retain(|key| *key != "type");
        if table.name == "body" {
            written.push("shapes");
            assert!(m.definition().bodies.last().unwrap().get("shapes").is_some());
        }
        let mut declared: Vec<&str> = table.fields.iter().map(|field| field.name).collect();
        written.sort_unstable();
        declared.sort_unstable();
        assert_eq!(written, declared, "{}", table.name);
    }
}

#[test]
fn every_group_of_elements() {
    let mut m = four_bar();
    m.body("slider").mass(1).inertia(1).point("P", 0, 0).point("Q", 1, 0);
    m.add("rail", Translational::written().i("ground.A").j("slider.P").axes((0, 0)));
    m.add("rod", Distance::written().i("crank.B").j("slider.P").length(25.0));
    m.add("motor", CoordinateDriver::written().coordinate("slider.x").value("t"));
    m.add("strut", SpringDamper::written().i("ground.D").j("slider.Q").stiffness(1.0));
    m.build().unwrap();
    let of = |section: &[kempe::Entry]| section.iter().map(|e| e.name.clone()).collect::<Vec<_>>();
    assert_eq!(of(&m.definition().joints), ["A", "B", "C", "D", "rail", "rod"]);
    assert_eq!(of(&m.definition().drivers), ["motor"]);
    assert_eq!(of(&m.definition().forces), ["spring", "strut"]);
}
