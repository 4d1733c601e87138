//! The events of a phase: functions of the state whose changes of sign are located on the interpolant of each step.
//!
//! The time of an event that ends its phase must agree with the solution, not only with the interpolant. The step is
//! taken again up to the event, and the time is corrected until the function is zero at the end of a step.

use super::event_function::EventFunction;
use super::motion_ode::MotionOde;
use super::sampling;
use crate::analyses::conditions::Evaluator;
use crate::analyses::so_far::SoFar;
use crate::analyses::step_part::{self, StepPart};
use crate::integrate::{crossings, Bounds, Crossing, Direction, Step, StepPath, TooFast, Watch};
use crate::math::{Listed, Ordered, Real, ShortArray};
use crate::model::Model;
use std::collections::HashMap;

/// Largest number of times that a step is taken again to end at an event.
const AGAIN: usize = 6;
/// Largest distance between the end of a phase and the event, in floating-point spacings.
const CLOSE: f64 = 32.0;
/// Fraction of a step over which the slope of a function is computed.
const SLOPE: f64 = 1e-3;
/// Largest magnitude of a function at its event, as a fraction of the value at the start of the step.
const NEAR: f64 = 1e-6;

/// Relative change of a state by which the rounding errors of functions are estimated.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// An event of a phase.
#[derive(Clone, Copy)]
pub(super) struct Watched<'a> {
    pub name: &'a str,
    /// The depth below zero up to which a gap that opens again is not closed, because of the error of the steps.
    pub shallow: f64,
    /// The values of minima that are wanted in place of changes of sign.
    pub minima: Option<[f64; 2]>,
    pub function: EventFunction<'a>,
    pub direction: Direction,
    /// Whether the event ends the phase.
    pub ends: bool,
    /// Whether a mode with this function lasts at the start of the phase. The function then counts as positive there.
    pub lasts: bool,
    /// Whether the event is listed where its function changes sign. Events of modes are listed later, after the new
    /// modes are determined.
    pub listed: bool,
}

impl Watched<'_> {
    /// Whether a condition has another sign at the start of a phase than at the end of the one before, by more than
    /// rounding errors.
    fn jumps(&self, earlier: Option<&f64>, now: f64) -> bool {
        let opposite = |before: &f64| {
            let other = *before > 0.0 && now < 0.0 || *before < 0.0 && now > 0.0;
            other && now.abs() > NEAR * before.abs()
        };
        matches!(self.function, EventFunction::Condition(_)) && earlier.is_some_and(opposite)
    }
}

/// The events in a step, and how the phase continues.
pub(super) enum StepEvents {
    /// These events occur in the step, and the phase continues.
    Events(Vec<Crossing>),
    /// These events occur in the step, and the phase ends with it, even if no event is at its end.
    End(Vec<Crossing>),
    /// The step is taken again, to end at this time.
    Again(f64),
}

/// The functions of events during a step.
struct InStep<'l, 'a> {
    list: &'l mut EventList<'a>,
    model: &'l Model,
    step: &'l Step<'l>,
    /// Whether the phase ends with the step.
    ends_phase: bool,
    /// The distances of forces that were bounded. Several events of a contact have the same distance.
    known: HashMap<(usize, [u64; 2]), Option<Bounds>>,
    /// The whole step, in which all distances are bounded first.
    whole: StepPart<'l>,
}

impl Watch for InStep<'_, '_> {
    fn values(&mut self, t: f64, y: &[f64], some: &[usize], out: &mut [f64]) {
        let EventList { watched, evaluator, began, earlier, zero, sampled, before, at_end, .. } =
            &mut *self.list;
        let solves = some.iter().any(|index| watched[*index].function.needs_solution());
        evaluator.see(self.model, (t, y), (self.step, solves), |seen| {
            some.iter().for_each(|k| out[*k] = watched[*k].function.value(self.model, seen));
        });
        let exact = self.ends_phase && t == self.step.t;
        let jumps = *sampled && t == self.step.t_old;
        for index in some {
            let (event, out) = (&watched[*index], &mut out[*index]);
            let zero = zero.as_ref().filter(|_| !exact).map_or(0.0, |zero| zero[*index]);
            if out.abs() <= zero {
                *out = event.function.at_zero();
            }
            if t == began.0 && began.1.contains(index) {
                *out = 0.0;
            } else if t == began.0 && event.jumps(earlier.get(*index), *out) {
                *out = earlier[*index];
            }
            if jumps {
                *out = before[*index];
            }
            // the mode may end after a time that is short compared with the steps
            if (t == began.0 || jumps) && event.lasts {
                *out = out.max(f64::MIN_POSITIVE);
            }
        }
        if t == self.step.t {
            at_end.resize(out.len(), f64::NAN);
            some.iter().for_each(|index| at_end[*index] = out[*index]);
        }
    }

    fn bounds(&mut self, index: usize, path: &StepPath<'_>, span: [f64; 2]) -> Option<Bounds> {
        let own = (span != self.whole.span).then(|| StepPart::new(self.model, path, span, &[]));
        let part = own.as_ref().unwrap_or(&self.whole);
        let known = &mut self.known;
        let mut clearance = |force: usize| {
            let key = (force, span.each(f64::to_bits));
            *known.entry(key).or_insert_with(|| part.apart(force, None))
        };
        match self.list.watched[index].function {
            EventFunction::Condition(condition) => condition.bounds(part),
            EventFunction::Mode(of) => of.bounds(&mut clearance),
            EventFunction::Never => Some(Bounds::one()),
        }
    }

    fn converges(&self, index: usize) -> bool {
        matches!(self.list.watched[index].function, EventFunction::Mode(_))
    }

    fn shallow(&self, index: usize) -> f64 {
        self.list.watched[index].shallow
    }

    fn minima(&self, index: usize) -> Option<[f64; 2]> {
        self.list.watched[index].minima
    }
}

/// The events of a phase.
pub(super) struct EventList<'a> {
    watched: Vec<Watched<'a>>,
    evaluator: Evaluator,
    /// The events at which the phase began, and the time of the start. They do not occur again there.
    began: (f64, Vec<usize>),
    /// The values of the functions at the end of the phase before. Where a condition jumps, it has an event.
    earlier: Vec<f64>,
    /// The largest values that count as zero: rounding errors of functions that are zero at the start of the phase.
    zero: Option<Vec<f64>>,
    /// The event at which a step is to end: its time and index.
    awaited: Option<(f64, usize)>,
    tries: usize,
    /// The values of sampled laws up to the last accepted step, and whether others hold in the present one.
    held: Option<Vec<f64>>,
    sampled: bool,
    /// The values of the functions at the end of the last accepted step, and of the present one.
    before: Vec<f64>,
    at_end: Vec<f64>,
}

impl<'a> EventList<'a> {
    /// The events of a phase that begins at `t`. `fired` are the events that ended the previous phase; `so_far` is
    /// the run up to `t`, with the values of the functions there. Returns None if there are no events.
    pub fn new(
        ode: &MotionOde<'_>,
        watched: Vec<Watched<'a>>,
        t: f64,
        fired: &[usize],
        (mut so_far, earlier): (SoFar, Vec<f64>),
    ) -> Option<Self> {
        if watched.is_empty() {
            return None;
        }
        let solves = watched.iter().any(|event| event.function.needs_solution());
        for event in &watched {
            if let EventFunction::Condition(condition) = event.function {
                condition.watch(&mut so_far);
            }
        }
        let evaluator = Evaluator::new(ode.model, solves, &ode.workspace, so_far);
        let (began, zero, awaited) = ((t, fired.to_vec()), None, None);
        let (before, at_end) = (Vec::new(), Vec::new());
        let (tries, held, sampled) = (0, None, false);
        Some(Self {
            watched,
            evaluator,
            began,
            earlier,
            zero,
            awaited,
            tries,
            held,
            sampled,
            before,
            at_end,
        })
    }

    /// The run up to the last accepted step, and the values of the functions there.
    pub fn so_far(self) -> (SoFar, Vec<f64>) {
        (self.evaluator.so_far, self.before)
    }

    /// Whether an event is listed where its function changes sign.
    pub fn lists(&self, index: usize) -> bool {
        self.watched[index].listed
    }

    /// The name of an event.
    pub fn name(&self, index: usize) -> &'a str {
        self.watched[index].name
    }

    /// The events in a step of a phase that ends at `t_end` at the latest. The interpolant is prepared.
    ///
    /// # Errors
    /// [`TooFast`] with the index of an event.
    pub fn look(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        t_end: f64,
    ) -> Result<StepEvents, TooFast> {
        if self.zero.is_none() {
            self.zero = Some(self.rounding(model, step));
        }
        let held = sampling::held(model, step.y_old);
        self.sampled = self.held.as_ref().is_some_and(|before| *before != held)
            && self.before.len() == self.watched.len();
        let arrived = self.awaited.filter(|(t, _)| *t == step.t);
        let found = self.scan(model, step, arrived.is_some() || step.t == t_end)?;
        let spacing = CLOSE * f64::EPSILON * step.t.abs().max(step.t_old.abs());
        let together = |a: f64, b: f64| (a - b).abs() <= spacing;
        let ending = found.iter().find(|crossing| self.watched[crossing.index].ends).copied();
        let end = match (ending, arrived) {
            (Some(event), _) => Some((event.t, event.index)),
            (None, Some((_, index))) => self.later(model, step, index, t_end).map(|t| (t, index)),
            (None, None) => None,
        };
        let Some((t, index)) = end else {
            self.evaluator.advance(model, step);
            self.held = Some(held);
            std::mem::swap(&mut self.before, &mut self.at_end);
            // the phase ends where the event was expected, and the next one continues
            return Ok(if arrived.is_some() {
                StepEvents::End(found)
            } else {
                StepEvents::Events(found)
            });
        };
        let done = together(t, step.t) || self.tries >= AGAIN && arrived.is_some();
        if !done {
            self.tries += 1;
            self.awaited = Some((t, index));
            return Ok(StepEvents::Again(t));
        }
        (self.awaited, self.tries) = (None, 0);
        self.evaluator.advance(model, step);
        self.note_end(model, step);
        let mut found: Vec<Crossing> = found;
        if found.iter().all(|crossing| crossing.index != index) {
            let rising = self.watched[index].direction != Direction::Falling;
            found.push(Crossing { index, t: step.t, rising });
        }
        found.extend(self.just_after(model, step, (index, &found)));
        // events at the end have its time, in their order
        for crossing in &mut found {
            if crossing.index == index && crossing.t == t || together(crossing.t, step.t) {
                crossing.t = step.t;
            }
        }
        let sign = (step.t - step.t_old).signum();
        found.order_by(|a, b| (sign * a.t).total_cmp(&(sign * b.t)).then(a.index.cmp(&b.index)));
        Ok(StepEvents::End(found))
    }

    /// Keeps the values of the functions at the end of a phase.
    fn note_end(&mut self, model: &Model, step: &Step<'_>) {
        let how = (step, self.watched.iter().any(|event| event.function.needs_solution()));
        let Self { watched, evaluator, before, .. } = self;
        *before = evaluator.see(model, (step.t, step.y), how, |seen| {
            watched.iter().map(|event| event.function.value(model, seen)).list()
        });
    }

    /// Other conditions that change at the end of a step up to rounding errors, or not later than the one that ends
    /// the phase, such as one that two events have.
    fn just_after(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        (ending, found): (usize, &[Crossing]),
    ) -> Vec<Crossing> {
        let spacing = CLOSE * f64::EPSILON * step.t.abs().max(step.t_old.abs());
        let last = self.late(model, step, ending).map_or(spacing, |(late, _)| late.max(spacing));
        let others = (0..self.watched.len()).filter(|k| found.iter().all(|own| own.index != *k));
        let change = |index: usize| {
            let (late, rising) = self.late(model, step, index)?;
            (late <= last).then_some(Crossing { index, t: step.t, rising })
        };
        others.filter_map(change).collect()
    }

    /// The time from the end of a step to the change of a condition, if it is close to it, and whether it rises.
    fn late(&mut self, model: &Model, step: &Step<'_>, index: usize) -> Option<(f64, bool)> {
        let Watched { function, direction, .. } = self.watched[index];
        let EventFunction::Condition(_) = function else { return None };
        let ([old, before, at], h) = self.beside(model, step, function);
        let rising = direction.counts(old, -old)?;
        let late = at * h.abs() / (before - at);
        let near = late >= 0.0 && at * old >= 0.0 && at.abs() <= NEAR * old.abs();
        near.then_some((late, rising))
    }

    /// The values of a function at the start of a step, shortly before its end, and there; and the time between the
    /// last two.
    fn beside(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        function: EventFunction<'_>,
    ) -> ([f64; 3], f64) {
        let h = SLOPE * (step.t - step.t_old);
        let mut beside = step.y.to_vec();
        step.interpolate(step.t - h, &mut beside);
        let states = [(step.t_old, step.y_old), (step.t - h, &beside), (step.t, step.y)];
        let how = (step, function.needs_solution());
        let value =
            |state| self.evaluator.see(model, state, how, |seen| function.value(model, seen));
        (states.each(value), h)
    }

    /// The rounding errors at the start of the phase of those functions of conditions that are zero there.
    fn rounding(&mut self, model: &Model, step: &Step<'_>) -> Vec<f64> {
        let Self { watched, evaluator, .. } = self;
        let mut changed = |by: [f64; 2]| {
            let parts = step.y_old.iter().enumerate();
            let y: Vec<f64> = parts.map(|(k, y)| y * (1.0 + ROUNDING * by[k % 2])).list();
            let t = step.t_old * (1.0 + ROUNDING * by[0]);
            evaluator.see(model, (t, &y), (step, true), |seen| {
                let values = watched.iter().map(|event| match event.function {
                    EventFunction::Condition(condition) => condition.value(model, seen).abs(),
                    _ => f64::NAN,
                });
                values.list()
            })
        };
        let mut zero: Vec<f64> = changed([0.0, 0.0]);
        if zero.contains(&0.0) {
            let [one, other] = [changed([1.0, 1.0]), changed([1.0, -1.0])];
            for (zero, (one, other)) in zero.iter_mut().zip(one.into_iter().zip(other)) {
                *zero = if *zero == 0.0 { 2.0 * one.max(other).max(0.0) } else { 0.0 };
            }
        } else {
            zero.fill(0.0);
        }
        zero
    }

    /// The events in a step. At the end of a phase values count as they are, because the next one begins with them.
    fn scan(
        &mut self,
        model: &Model,
        step: &Step<'_>,
        ends_phase: bool,
    ) -> Result<Vec<Crossing>, TooFast> {
        let directions: Vec<Direction> = self.watched.iter().map(|of| of.direction).list();
        let ends: Vec<bool> = self.watched.iter().map(|of| of.ends).list();
        let parts = step_part::parts(model, step);
        let path = StepPath::new(step);
        let whole = StepPart::new(model, &path, [step.t_old, step.t], &[]);
        let known = HashMap::new();
        let mut seen = InStep { list: self, model, step, ends_phase, known, whole };
        crossings(&path, parts, &directions, &mut seen, &|index| ends[index])
    }

    /// The time of an event that is expected at the end of a step but lies slightly later. Returns None if there is
    /// no event because the interpolant was inaccurate.
    fn later(&mut self, model: &Model, step: &Step<'_>, index: usize, t_end: f64) -> Option<f64> {
        let function = self.watched[index].function;
        let ([mut old, before, at], h) = self.beside(model, step, function);
        if step.t_old == self.began.0 && matches!(function, EventFunction::Mode(_)) {
            old = old.max(f64::MIN_POSITIVE); // the mode has just begun
        }
        let by = -at * h / (at - before);
        // only a small correction: the function crosses zero here
        let small = by.is_finite() && by * h > 0.0 && by.abs() < h.abs();
        if !small && at * old > 0.0 && at.abs() > NEAR * old.abs() {
            return None;
        }
        let t = step.t + if small { by } else { 0.0 };
        Some(if (t - t_end) * h > 0.0 { t_end } else { t })
    }
}
