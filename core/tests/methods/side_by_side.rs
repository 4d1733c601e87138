//! Runs side by side have the bits of runs alone, for every example and method.

use crate::mechanisms::{self, count};
use kempe::analyses::assemble::{assemble, targets, Request};
use kempe::analyses::dynamics::{
    dynamics, side_by_side, Auto, Options, Prepared, Run, Scheme, Stabilization, Trials, Variant,
};
use kempe::analyses::State;
use kempe::case::{read, Format};
use kempe::equations::Gains;
use kempe::integrate::{Dop853, Flow, Rk45};
use kempe::model::{build, Model};
use std::sync::Arc;

/// A model and its start.
type Made = (Model, State);

/// The variants of an example: one parameter after the other is larger by a part of 1e-3.
fn variants(text: &str) -> Vec<Made> {
    let (case, _) = read(text, Format::Toml).expect("an example");
    let base = build(&case.definition, &[]).expect("an example");
    let at_start = |model: Model| -> Option<Made> {
        let set = targets(&model, "set", &case.start.set).ok()?;
        let guess = targets(&model, "guess", &case.start.guess).ok()?;
        let request = Request { set, guess, ..Request::default() };
        let (state, _) = assemble(&model, &request).ok()?;
        Some((model, state))
    };
    let original = || base.with_values(&[]).expect("the same");
    let names = base.blueprint.parameters.iter().zip(&base.parameters);
    let mut all: Vec<Made> = names
        .filter_map(|(name, x)| base.with_values(&[(name.clone(), 1.001 * x)]).ok())
        .filter_map(at_start)
        .take(4)
        .collect();
    all.extend((all.len()..6).filter_map(|_| at_start(original())));
    all
}

/// Methods that may run side by side, to a time.
fn ways(t_end: f64) -> Vec<Options> {
    let base = Options { dense_output: false, ..Options::new(t_end) };
    let gains = Gains { alpha: 10.0, beta: 200.0 };
    vec![
        Options { method: Scheme::Auto(Auto::default()), ..base.clone() },
        Options { method: Scheme::Dop853(Dop853::new(1e-5, 1e-8)), ..base.clone() },
        Options { method: Scheme::Rk45(Rk45::new(1e-6, 1e-9)), ..base.clone() },
        Options {
            method: Scheme::Rk45(Rk45::new(1e-6, 1e-9)),
            stabilization: Stabilization::Baumgarte(gains),
            ..base.clone()
        },
        Options { dense_output: true, ..base.clone() },
        Options { method: Scheme::Rk45(Rk45::new(1e-6, 1e-9)), dense_output: true, ..base },
    ]
}

fn same(beside: &Run, alone: &Run) {
    assert_eq!(beside.trajectory, alone.trajectory);
    assert_eq!(beside.dense, alone.dense);
    assert_eq!(beside.choice, alone.choice);
    assert_eq!(beside.passed, alone.passed);
    assert_eq!(beside.settings, alone.settings);
    assert_eq!((beside.reached, beside.passing), (alone.reached, alone.passing));
    let counts = |run: &Run| {
        let found = &run.statistics;
        (found.steps, found.rejected, found.evaluations, found.factorisations)
    };
    assert_eq!(counts(beside), counts(alone));
}

/// Runs all variants both ways, to different times.
fn compare(made: &[Made], way: &Options) -> Trials {
    let options: Vec<Options> = (0..made.len())
        .map(|k| {
            let t_end = way.t_end * (1.0 + 0.3 * k as f64);
            Options { t_end, output_step: Some(2.0 * t_end), ..way.clone() }
        })
        .collect();
    let prepared: Vec<_> =
        made.iter().map(|(model, _)| Prepared::new(Arc::new(model.clone()))).collect();
    let all = made.iter().zip(&prepared).zip(&options);
    let all: Vec<Variant<'_>> = all
        .map(|(((_, start), prepared), options)| Variant { prepared, start, options })
        .filter(Variant::serves)
        .collect();
    let mut outcomes = Vec::new();
    let trials =
        side_by_side(&all, &|| Flow::Continue, &mut |place, run| outcomes.push((place, run)));
    assert_eq!(outcomes.len(), all.len());
    for (place, outcome) in outcomes {
        let variant = &all[place];
        let alone =
            dynamics(variant.prepared.model(), variant.start, variant.options, |_| Flow::Continue);
        match (outcome, alone) {
            (Ok(beside), Ok(alone)) => same(&beside, &alone),
            (Err(beside), Err(alone)) => {
                assert_eq!(beside.reason.to_string(), alone.reason.to_string());
                assert_eq!(beside.run.trajectory, alone.run.trajectory);
            }
            (beside, alone) => panic!("{:?} {:?}", beside.is_ok(), alone.is_ok()),
        }
    }
    trials
}

/// One method after the other, and all of them in the full sample.
#[test]
fn every_example_runs_as_alone() {
    let folder = std::fs::read_dir("../examples").expect("the examples");
    let mut files: Vec<_> = folder.map(|file| file.expect("a file").path()).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    let ways = ways(0.1 * count(2, 4) as f64);
    let (mut all, mut beside) = (0, 0);
    for (k, file) in files.iter().enumerate() {
        let made = variants(&std::fs::read_to_string(file).expect("a text"));
        for way in ways.iter().cycle().skip(k).take(count(1, 4) as usize) {
            all += 1;
            let trials = compare(&made, way);
            println!("{}: {trials:?}", file.display());
            beside += usize::from(trials.beside > trials.alone);
        }
    }
    assert!(2 * beside > all, "most examples run side by side: {beside} of {all}");
}

#[test]
fn ordinary_steps_are_taken_side_by_side() {
    let made = variants(mechanisms::FOUR_BAR);
    for way in ways(0.4) {
        let trials = compare(&made, &way);
        assert!(trials.beside > 9 * trials.alone, "{trials:?}");
    }
}

#[test]
fn variants_of_another_structure_and_runs_that_end_early_do_not_disturb_others() {
    // a rod with its mass centre in its frame, one beside it, and one that a light body follows
    let text = "kempe = 1\ngravity = [0, -9.81]\nparameters = { cx = 0, cy = 0, m = 1 }\n\
        [bodies.ground]\npoints = { O = [0, 0] }\n\
        [bodies.rod]\nmass = 1\ninertia = 0.1\ncenter = [\"cx\", \"cy\"]\npoints = { O = [0, 0], E = [1, 0] }\n\
        [bodies.end]\nmass = \"m\"\ninertia = \"m\"\ncenter = [0.1, 0]\npoints = { E = [0, 0] }\n\
        [joints.O]\ntype = \"revolute\"\ni = \"ground.O\"\nj = \"rod.O\"\n\
        [joints.E]\ntype = \"revolute\"\ni = \"rod.E\"\nj = \"end.E\"\n";
    let base = mechanisms::model(text);
    let numbers = [
        [0.0, 0.0, 1.0],
        [0.2, 0.1, 1.0],
        [0.2, 0.1, 1e-9],
        [0.3, 0.0, 0.5],
        [0.1, 0.0, 2.0],
        [0.0, 0.0, 3.0],
    ];
    let made = numbers.map(|numbers| {
        let names = ["cx", "cy", "m"].map(str::to_string);
        let values: Vec<_> = names.into_iter().zip(numbers).collect();
        let model = base.with_values(&values).expect("a pendulum");
        let set = [("rod.angle", "0.3"), ("end.angle", "1")];
        let (state, _) = mechanisms::start(&model, &set, &[]);
        (model, state)
    });
    for way in ways(0.4) {
        compare(&made, &way);
        // too few steps are allowed
        let mut few = way.clone();
        few.method.control_mut().max_steps = Some(3);
        compare(&made, &few);
    }
}
