//! Kinematics and inverse dynamics as analyses.

use super::failure::Reason;
use super::kinematics;
use super::motion::Motion;
use super::options::{InverseOptions, Options, MOST_OUTPUTS, POINTS};
use super::over::{over, Over};
use super::works::MotionRecorder;
use crate::analyses::dynamics::{system_clock, Prepared, Run, Setting, Statistics};
use crate::analyses::record::{
    missing, Analysis, Driven, ErrorClass, Observer, Outcome, Record, RunResult, StartState,
    Subject, Unfinished, Variable,
};
use crate::analyses::{second_order, State};
use crate::elements::Group;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{Model, Problem};
use crate::stabilize::Projection;
use std::sync::Arc;

/// Part of an output step that counts as a rounding error at the end of the motion.
const ROUNDING: f64 = 1e-12;

impl Analysis for Options {
    const MOTION: bool = true;

    fn ends(&self, _: &Model, begin: Option<f64>) -> Result<Option<f64>, Vec<Problem>> {
        self.time_problem(begin).map_or(Ok(self.t_end), |problem| Err(vec![problem]))
    }

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        PlannedMotion { options: self, subject, start, rests: false }.follow(observer)
    }
}

impl Analysis for InverseOptions {
    const MOTION: bool = true;

    fn ends(&self, model: &Model, begin: Option<f64>) -> Result<Option<f64>, Vec<Problem>> {
        Options::from(self.clone()).ends(model, begin)
    }

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        no_states(subject.model())?;
        let options = &Options::from(self.clone());
        let stop = observer.stop;
        let path = PlannedMotion { options, subject, start, rests: self.r#static };
        let record = path.follow(observer)?;
        with_responses(record, subject, start, stop)
    }
}

/// Refuses first-order states, which do not follow from a motion.
fn no_states(model: &Model) -> Result<(), Outcome> {
    let of = model.forces.iter().filter(|item| !item.states.is_empty());
    let names: Vec<&str> = of.map(|item| &item.name[..]).list();
    if names.is_empty() {
        return Ok(());
    }
    let message = format!("{}: its states do not follow from the motion", names.join(", "));
    Err(Outcome::new(ErrorClass::Model, message).hint("use dynamics, or leave out what has states"))
}

/// The record with reactions and efforts, which must be unique.
fn with_responses(
    record: Record,
    subject: &Subject<'_>,
    start: &StartState,
    stop: &dyn Fn() -> bool,
) -> RunResult {
    let run = record.motion.as_ref().expect("kinematics gives a motion");
    let model = record.driven.as_ref().map(|driven| Arc::clone(&driven.model));
    let prepared = Prepared::new(model.unwrap_or_else(|| subject.released(start)));
    let look = |_| if stop() { Flow::Stop } else { Flow::Continue };
    match prepared.accelerations(run.trajectory.states(), run.passing, look) {
        Ok(found) => Ok(Record { responses: Some(found), ..record }),
        Err(failure) => {
            let outcome = missing(failure.reason);
            Err(Box::new(Unfinished { outcome, record: Some(record) }))
        }
    }
}

/// A motion that is to be followed.
struct PlannedMotion<'a> {
    options: &'a Options,
    subject: &'a Subject<'a>,
    start: &'a StartState,
    /// Whether the mechanism is at rest at each value.
    rests: bool,
}

impl PlannedMotion<'_> {
    fn follow(&self, observer: Observer<'_>) -> RunResult {
        let Observer { look, .. } = observer;
        let Self { options, subject, start, .. } = *self;
        match options.over.as_ref().zip(options.range) {
            None => {
                let begin = start.state.t;
                if let Some(problem) = options.time_problem(Some(begin)) {
                    return Err(vec![problem].into());
                }
                self.through(&subject.released(start), start, &options.times(begin), look)
            }
            Some((over, [first, last])) => {
                let driven = subject.driven_by(start, over, self.rests)?;
                let at = start.at(State { t: driven.variable.start, ..start.state.clone() });
                match self.over(&driven.model, at, [first, last], look) {
                    Ok(record) => Ok(Record { driven: Some(driven), ..record }),
                    Err(mut failed) => {
                        failed.record =
                            failed.record.map(|it| Record { driven: Some(driven), ..it });
                        Err(failed)
                    }
                }
            }
        }
    }

    /// The motion over a range of the quantity that replaces the time in a model.
    fn over(
        &self,
        model: &Model,
        start: StartState,
        [first, last]: [f64; 2],
        look: &mut dyn FnMut(f64) -> Flow,
    ) -> RunResult {
        let begin = match first == start.state.t {
            true => start,
            false => self.through(model, &start, &[first], look)?.end,
        };
        let n = self.options.n;
        let step = (last - first) / (n - 1) as f64;
        let value = |k: usize| if k + 1 == n { last } else { first + step * k as f64 };
        let values: Vec<f64> = (0..n).map(value).list();
        self.through(model, &begin, &values, look)
    }

    /// The motion of a model at times, or at values of the quantity that replaces the time.
    fn through(
        &self,
        model: &Model,
        start: &StartState,
        times: &[f64],
        look: &mut dyn FnMut(f64) -> Flow,
    ) -> RunResult {
        let began = system_clock();
        let own = second_order::acting(model, start.state.t, &start.state.q);
        let model = own.as_ref().unwrap_or(model);
        let mut recorder = MotionRecorder::new(model, &start.state, self.rests);
        let outcome = kinematics(model, &start.state, times, |motion| {
            recorder.follow(motion);
            motion.points.last().map_or(Flow::Continue, |point| look(point.t))
        });
        let (motion, reason) = match outcome {
            Ok(motion) => (motion, None),
            Err(failure) => (failure.motion, Some(failure.reason)),
        };
        recorder.follow(&motion);
        let run = run(&motion, recorder, &start.released, system_clock() - began);
        let message = reason.as_ref().map(ToString::to_string);
        let message = message.unwrap_or_else(|| "the last value was reached".to_string());
        let record = Record::of_motion(run, start, message);
        match reason {
            None => Ok(record),
            Some(reason) => {
                Err(Box::new(Unfinished { outcome: reason.into(), record: Some(record) }))
            }
        }
    }
}

fn run(motion: &Motion, recorder: MotionRecorder<'_>, released: &[String], seconds: f64) -> Run {
    let (trajectory, dense) = (recorder.recorded.trajectory, recorder.recorded.dense);
    let (steps, rejected) = (motion.steps(), motion.rejected);
    Run {
        trajectory,
        phases: vec![0],
        settings: vec![Setting { released: released.to_vec(), ..Setting::default() }],
        dense: (!dense.t.is_empty()).then_some(dense),
        statistics: Statistics { steps, rejected, seconds, ..Statistics::default() },
        reached: motion.reached,
        passing: true,
        projection: Some(Projection::default()),
        ..Run::default()
    }
}

impl Options {
    /// The times of the outputs, both ends included.
    fn times(&self, begin: f64) -> Vec<f64> {
        let end = self.t_end.unwrap_or(begin);
        let Some(step) = self.output_step else {
            let step = (end - begin) / (POINTS - 1) as f64;
            let inner = (0..POINTS - 1).map(|k| begin + step * k as f64);
            return inner.chain([end]).list();
        };
        let count = ((end - begin) / step * (1.0 + ROUNDING)) as usize;
        let mut times: Vec<f64> = (0..=count).map(|k| begin + step * k as f64).list();
        match times.last_mut() {
            Some(last) if (end - *last).abs() <= ROUNDING * end.abs().max(last.abs()) => {}
            _ => times.push(end),
        }
        times
    }

    /// The problem of an end before the start, or of too many outputs.
    fn time_problem(&self, begin: Option<f64>) -> Option<Problem> {
        let (begin, end) = (begin?, self.t_end?);
        if end < begin {
            let message = format!("{end} s lies before {begin} s, where the motion starts");
            return Some(Problem::at(&["t_end"], message).hint("t_end is a time, not a duration"));
        }
        let step = self.output_step.filter(|step| end - begin > MOST_OUTPUTS as f64 * step)?;
        let message = format!("{step} s; must be at least 1e-6 of the time of the motion");
        Some(Problem::at(&["output_step"], message))
    }
}

impl Subject<'_> {
    /// The mechanism in which t is the value of a driver or of a position quantity.
    ///
    /// # Errors
    /// There is no such driver or quantity, or several drivers determine the motion already.
    pub fn driven_by(
        &self,
        start: &StartState,
        quantity: &str,
        rests: bool,
    ) -> Result<Driven, Vec<Problem>> {
        let definition = self.acting(start);
        let found = over(&definition, &self.released(start), &start.state, quantity);
        let Over { definition, quantity, unit, value } = found.map_err(|one| vec![one])?;
        let model = self.rebuilt(&definition)?;
        let variable = Variable { name: quantity, unit, start: value, rests };
        Ok(Driven { model, definition, variable })
    }
}

impl Subject<'_> {
    /// The only driver that acts.
    ///
    /// # Errors
    /// There is none, or there are several.
    pub fn only_driver(&self, start: &StartState) -> Result<String, Outcome> {
        let model = self.released(start);
        let drivers = model.constraints.iter().filter(|item| item.group == Group::Drivers);
        let names: Vec<&str> = drivers.map(|item| &item.name[..]).list();
        let reason = match names[..] {
            [only] => return Ok(only.to_string()),
            [] => "the model has no driver that acts".to_string(),
            _ => format!("the model has the drivers {}", names.join(", ")),
        };
        let Problem { message, hint, .. } = without_driver(&reason);
        Err(Outcome::new(ErrorClass::Model, format!("over: {message}"))
            .hint(hint.unwrap_or_default()))
    }
}

/// The problem of an analysis without `over` where no driver decides it.
pub(in crate::analyses) fn without_driver(reason: &str) -> Problem {
    Problem::at(&["over"], format!("missing; {reason}"))
        .hint("name a driver or a position quantity, as over = \"crank.angle\"")
}

impl From<Reason> for Outcome {
    fn from(reason: Reason) -> Self {
        let message = reason.to_string();
        match &reason {
            Reason::Free { .. } => {
                let problems = vec![Problem::at(&["drivers"], &message)];
                let outcome = Self { problems, ..Self::new(ErrorClass::Model, message) };
                outcome.hint("add a coordinate_driver for each, or use dynamics")
            }
            Reason::Bends(beam, driver) => {
                let value = match driver {
                    Some(driver) => format!("make the value of {driver} a parameter p in place of a law of t"),
                    None => "drive a coordinate to a parameter p".to_string(),
                };
                let hint = format!(
                    "{value}, and kp.equilibrium(model, state, over=\"p\", range=(first, last)) follows the shape; \
                     with masses in motion, use dynamics"
                );
                Self::new(ErrorClass::Model, message).name(beam).hint(&hint)
            }
            Reason::Open { t, name, .. } => Self::new(ErrorClass::Assembly, message)
                .name(name)
                .at(*t)
                .hint("kp.assemble(model, from_state=state) assembles the mechanism anew"),
            Reason::Beyond { t, name, .. } => {
                Self::new(ErrorClass::Assembly, message).name(name).at(*t).hint(
                    "start where the gap is not negative, or give a stiffness in place of restitution",
                )
            }
            Reason::Singular { t, name, .. } => Self::new(ErrorClass::Singularity, message)
                .name(name)
                .at(*t)
                .hint("start at another position, or drive another coordinate"),
            Reason::Limit(limit) => Self::new(ErrorClass::Singularity, message)
                .name(&limit.driver)
                .at(limit.t)
                .hint("end the motion before, or drive another coordinate"),
        }
    }
}
