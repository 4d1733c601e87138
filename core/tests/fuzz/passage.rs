//! The way of one input through the core, and the requirements on each stage.

use kempe::analyses::assemble::assemble;
use kempe::analyses::dynamics::{dynamics, read as read_options, Run};
use kempe::case::{read, write, Case, Format};
use kempe::equations::constraints;
use kempe::equations::kinematics::Motions;
use kempe::integrate::Flow;
use kempe::model::{build, row_scales, Model};
use kempe::State;

/// The last stage that an input reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    Refused,
    Read,
    Built,
    Assembled,
    Stopped,
    Run,
}

/// Largest number of steps of a run.
const STEPS: usize = 300;
/// Largest residual of an assembled joint, relative to the size of the mechanism.
const CLOSED: f64 = 1e-8;

/// Takes a text through all stages.
///
/// # Panics
/// If a requirement is violated.
pub fn passage(text: &str) -> Reached {
    let case = match read(text, Format::Toml) {
        Ok((case, _)) => case,
        Err(faults) => {
            assert!(!faults.is_empty(), "refused without a fault");
            faults.iter().for_each(|fault| described(&fault.to_string()));
            return Reached::Refused;
        }
    };
    unchanged(&case);
    let model = match build(&case.definition, &[]) {
        Ok(model) => model,
        Err(problems) => {
            assert!(!problems.is_empty(), "not built without a problem");
            problems.iter().for_each(|problem| described(&problem.to_string()));
            return Reached::Read;
        }
    };
    let request = match case.start.request(&model) {
        Ok(request) => request,
        Err(problems) => {
            described(&problems.to_string());
            return Reached::Built;
        }
    };
    match assemble(&model, &request) {
        Ok((start, _)) => {
            closed(&model, &start);
            run(&case, &model, &start)
        }
        Err(failure) => {
            described(&failure.to_string());
            Reached::Built
        }
    }
}

/// What is written is read back, in both formats, and written again as the same text.
fn unchanged(case: &Case) {
    for format in [Format::Toml, Format::Json] {
        let written = write(case, format);
        let again = read(&written, format).map(|(case, _)| case);
        assert_eq!(again.as_ref(), Ok(case), "{format:?} is read back differently:\n{written}");
        assert_eq!(write(case, format), written);
    }
}

fn described(message: &str) {
    assert!(!message.trim().is_empty(), "an error without a message");
    assert!(message.lines().count() < 1000, "a message of {} lines", message.lines().count());
}

fn finite(name: &str, table: &[f64]) {
    assert!(table.iter().all(|x| x.is_finite()), "{name} is not finite");
}

/// An assembled state is finite and its joints are closed.
fn closed(model: &Model, state: &State) {
    finite("q", &state.q);
    finite("v", &state.v);
    let mut phi = vec![0.0; model.layout.n_rows];
    constraints::residual(model, &Motions::at_rest(&model.layout, &state.q), state.t, &mut phi);
    let largest = phi.iter().zip(row_scales(model)).map(|(phi, scale)| phi.abs() / scale);
    let largest = largest.fold(0.0, f64::max);
    assert!(largest <= CLOSED, "assembled with a residual of {largest:e}");
}

fn run(case: &Case, model: &Model, start: &State) -> Reached {
    let mut reached = Reached::Assembled;
    for entry in &case.analyses {
        let path = ["analyses".to_string(), entry.name.clone()];
        let Ok(mut options) = read_options(model, &entry.fields, &path) else { return reached };
        options.max_steps = Some(options.max_steps.map_or(STEPS, |most| most.min(STEPS)));
        let mut steps = 0;
        let watch = |_| {
            steps += 1;
            if steps > 2 * STEPS {
                Flow::Stop
            } else {
                Flow::Continue
            }
        };
        match dynamics(model, start, &options, watch) {
            Ok(run) => {
                sound(model, &run);
                reached = Reached::Run;
            }
            Err(failure) => {
                described(&failure.reason.to_string());
                sound(model, &failure.run);
                return Reached::Stopped;
            }
        }
    }
    reached
}

/// All states of a run are finite, and what follows from them is finite or an error.
fn sound(model: &Model, run: &Run) {
    let trajectory = &run.trajectory;
    for (name, table) in [("t", &trajectory.t), ("q", &trajectory.q), ("v", &trajectory.v)] {
        finite(name, table);
    }
    if let Ok(found) = run.accelerations(model) {
        finite("a", &found.a);
        finite("lam", &found.lam);
    }
    if let Ok(energies) = run.energies(model) {
        finite("energies", &energies);
    }
}
