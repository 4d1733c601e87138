//! Steps of several integrations in parallel, one in each lane of the vector registers.
//!
//! All integrations use one method and systems of the same structure. Each has its own time, step and error. The sums
//! in a lane are computed in the same order as in a separate integration, so that the results are identical to the
//! last bit.
//!
//! Only ordinary trial steps are taken in lanes. If a lane needs more, for instance near a singular position, its
//! integration takes the step alone, from the same state.

use super::right_hand_side::all_finite;
use super::runge_kutta::{RungeKutta, TrialStages};
use super::stages::{combine, row, Block};
use super::tolerances::LaneTolerances;
use crate::math::{each, indexed, Lanes, Listed, Real, ShortArray};
use std::any::TypeId;
use std::marker::PhantomData;

const WIDTH: usize = Lanes::WIDTH;

/// A Boolean for each lane.
pub type Mask = [bool; WIDTH];

/// Systems y′ = f(t, y) of the same structure, one in each lane.
pub trait LaneOde {
    /// Number of components of y.
    fn components(&self) -> usize;

    /// dy = f(t, y) in each lane. Returns false if a lane needs more than the ordinary evaluation.
    fn rates(&mut self, t: Lanes, y: &[Lanes], dy: &mut [Lanes]) -> bool;

    /// Called after trial steps of `lanes` to the times `t`, near which f was evaluated last. Returns the lanes with
    /// an ordinary trial.
    fn on_trials(&mut self, t: [f64; WIDTH], lanes: Mask) -> Mask;

    /// Projects the accepted states of `lanes` onto their manifolds and leaves the other lanes unchanged. Returns for
    /// each lane whether the state changed, or None if it needs more than the ordinary iteration.
    fn project(&mut self, t: Lanes, y: &mut [Lanes], lanes: Mask) -> [Option<bool>; WIDTH];

    /// Called with the ends `t` of accepted steps of `lanes`, where f was evaluated last.
    fn on_accepted(&mut self, t: [f64; WIDTH], lanes: Mask);
}

/// The outcome of a trial step in a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// The step was accepted.
    Accepted,
    /// The step was rejected; the next trial is shorter.
    Rejected,
    /// Nothing was done. The stepper must take its step alone.
    Alone,
}

/// A stepper that can take ordinary steps in a lane. [`LaneSteps`] calls its methods.
pub trait SideBySide {
    /// The method of the stepper.
    #[doc(hidden)]
    fn method(&self) -> &'static dyn LaneMethod;

    /// Begins a trial: fills its lane and returns the times t and t_new. Returns None if the stepper must take the
    /// step alone.
    #[doc(hidden)]
    fn propose(&mut self, at: LaneStart<'_>) -> Option<[f64; 2]>;

    /// Returns whether the error norm allows the trial to be accepted. If not, the next trial is shorter.
    #[doc(hidden)]
    fn judge(&mut self, norm: f64, evaluations: usize) -> bool;

    /// Accepts the trial step.
    #[doc(hidden)]
    fn accept(&mut self, norm: f64, end: LaneEnd<'_>);
}

/// The lane of a trial. The stepper fills it with the state at the start, the derivative there, and the tolerances.
#[doc(hidden)]
pub struct LaneStart<'a> {
    pub lane: usize,
    pub y: &'a mut [Block],
    pub dy: &'a mut [Block],
    pub tolerances: &'a mut LaneTolerances,
}

/// The state at the end of a trial and its derivative, in one lane.
#[doc(hidden)]
pub struct LaneEnd<'a> {
    pub lane: usize,
    pub y: &'a [Block],
    pub dy: &'a [Block],
    pub projected: bool,
    pub evaluations: usize,
    /// The stages, and the state before the projection, if the steps keep them for interpolants.
    pub stages: Option<[&'a [Block]; 2]>,
}

/// An explicit method that works on lanes.
#[doc(hidden)]
pub trait LaneMethod: Sync {
    fn id(&self) -> TypeId;
    /// The number of stages including the derivative at the end, and whether the error estimate uses that derivative.
    fn stages(&self) -> (usize, bool);
    fn advance(&self, trial: &mut LaneTrial<'_>, k: &mut [Block], y_new: &mut [Block]) -> bool;
    fn norms(&self, h: Block, k: &[Block], y: [&[Block]; 2], by: &LaneTolerances) -> Block;
}

/// The method `P`, applied to lanes.
pub(super) struct OverLanes<P>(pub PhantomData<fn() -> P>);

impl<P: RungeKutta> LaneMethod for OverLanes<P> {
    #[inline]
    fn id(&self) -> TypeId {
        TypeId::of::<P>()
    }

    #[inline]
    fn stages(&self) -> (usize, bool) {
        (P::STAGES, P::LAST_IN_ERROR)
    }

    #[inline]
    fn advance(&self, trial: &mut LaneTrial<'_>, k: &mut [Block], y_new: &mut [Block]) -> bool {
        P::advance(trial, k, y_new).is_ok()
    }

    #[inline]
    fn norms(&self, h: Block, k: &[Block], y: [&[Block]; 2], by: &LaneTolerances) -> Block {
        let [a, b] = P::error_squares(k, y, by);
        indexed(|lane| P::error_norm(h[lane], [a[lane], b[lane]], by.components()))
    }
}

/// A trial step in each lane.
#[doc(hidden)]
pub struct LaneTrial<'a> {
    system: &'a mut dyn LaneOde,
    t: Lanes,
    t_new: Lanes,
    h: Lanes,
    y: &'a [Block],
    /// The argument of a stage.
    argument: &'a mut [Block],
    registers: &'a mut Registers,
}

/// Error: a trial is not ordinary in one of its lanes.
#[doc(hidden)]
pub struct NotOrdinary;

#[inline]
fn ordinary(holds: bool) -> Result<(), NotOrdinary> {
    match holds {
        true => Ok(()),
        false => Err(NotOrdinary),
    }
}

impl TrialStages for LaneTrial<'_> {
    type Stop = NotOrdinary;

    #[inline]
    fn width(&self) -> usize {
        self.y.len()
    }

    #[inline(always)]
    fn stage<const S: usize>(
        &mut self,
        c: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), NotOrdinary> {
        ordinary(combine(self.y, self.h, a, k, self.argument))?;
        let t = self.t + Lanes::constant(c) * self.h;
        ordinary(self.registers.rates(self.system, t, self.argument, out))
    }

    #[inline(always)]
    fn end<const S: usize>(
        &mut self,
        divisor: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), NotOrdinary> {
        ordinary(combine(self.y, self.h / Lanes::constant(divisor), a, k, out))
    }

    #[inline]
    fn rate_at_end(&mut self, y_new: &[Block], dy: &mut [Block]) -> Result<(), NotOrdinary> {
        ordinary(self.registers.rates(self.system, self.t_new, y_new, dy))?;
        self.finite(dy)
    }

    #[inline]
    fn finite(&self, stage: &[Block]) -> Result<(), NotOrdinary> {
        ordinary(all_finite(stage.as_flattened()))
    }
}

/// A state and its derivative, in vector registers.
#[derive(Default)]
struct Registers {
    y: Vec<Lanes>,
    dy: Vec<Lanes>,
}

impl Registers {
    #[inline]
    fn put(&mut self, y: &[Block]) {
        self.y.clear();
        y.iter().map(|y| Lanes::new(*y)).append_to(&mut self.y);
    }

    /// dy = f(t, y). Returns whether the evaluation is ordinary.
    #[inline(never)] // one copy for all stages
    fn rates(&mut self, system: &mut dyn LaneOde, t: Lanes, y: &[Block], dy: &mut [Block]) -> bool {
        self.put(y);
        self.dy.resize(y.len(), Lanes::zero());
        let ordinary = system.rates(t, &self.y, &mut self.dy);
        dy.iter_mut().zip(&self.dy).for_each(|(to, dy)| *to = dy.to_array());
        ordinary
    }
}

/// The steppers of the lanes. A lane may be empty.
pub type Steppers<'a, 's> = [Option<&'a mut (dyn SideBySide + 's)>; WIDTH];

/// The times of the trials, and the lanes that have a trial.
struct Times {
    t: Block,
    t_new: Block,
    lanes: Mask,
}

/// Takes steps of up to four integrations side by side.
#[derive(Default)]
pub struct LaneSteps {
    /// Whether the steps have interpolants.
    keeps_stages: bool,
    y: Vec<Block>,
    y_new: Vec<Block>,
    argument: Vec<Block>,
    k: Vec<Block>,
    /// The derivative at the end of the step.
    dy: Vec<Block>,
    tolerances: LaneTolerances,
    registers: Registers,
}

impl LaneSteps {
    /// Steps with or without the stages that interpolants need.
    pub fn new(keeps_stages: bool) -> Self {
        Self { keeps_stages, ..Self::default() }
    }

    /// Takes one trial step of each stepper. A lane without a trial is reported as [`Taken::Alone`].
    pub fn step(
        &mut self,
        steppers: &mut Steppers<'_, '_>,
        system: &mut dyn LaneOde,
    ) -> [Taken; WIDTH] {
        let mut taken = [Taken::Alone; WIDTH];
        let Some(method) = steppers.iter().flatten().next().map(|first| first.method()) else {
            return taken;
        };
        let Some(times) = self.begin(method, steppers, system.components()) else { return taken };
        let Some(norms) = self.advance(method, &times, system) else { return taken };
        let plain = system.on_trials(times.t_new, times.lanes);
        let (stages, last_in_error) = method.stages();
        let evaluations = stages - if last_in_error { 1 } else { 2 };
        for lane in 0..WIDTH {
            if let (Some(stepper), true) = (&mut steppers[lane], plain[lane]) {
                let accepted = stepper.judge(norms[lane], evaluations);
                taken[lane] = if accepted { Taken::Accepted } else { Taken::Rejected };
            }
        }
        let accepted = taken.each(|taken| taken == Taken::Accepted);
        if !accepted.contains(&true) {
            return taken;
        }
        let projected = self.settle(last_in_error, &times, accepted, system);
        let settled: Mask = indexed(|lane| accepted[lane] && projected[lane].is_some());
        system.on_accepted(times.t_new, settled);
        for lane in (0..WIDTH).filter(|lane| accepted[*lane]) {
            match (&mut steppers[lane], projected[lane]) {
                (Some(stepper), Some(projected)) => {
                    let evaluations = evaluations + usize::from(projected || !last_in_error);
                    let Self { y_new: y, dy, k, argument, .. } = &*self;
                    let stages = self.keeps_stages.then_some([&k[..], &argument[..]]);
                    let end = LaneEnd { lane, y, dy, projected, evaluations, stages };
                    stepper.accept(norms[lane], end);
                }
                _ => taken[lane] = Taken::Alone,
            }
        }
        taken
    }

    /// Begins the trials of the steppers. Returns None if fewer than two steppers have one. Empty lanes repeat a
    /// trial.
    fn begin(
        &mut self,
        method: &dyn LaneMethod,
        steppers: &mut Steppers<'_, '_>,
        n: usize,
    ) -> Option<Times> {
        let empty = [0.0; WIDTH];
        for rows in [&mut self.y, &mut self.y_new, &mut self.argument, &mut self.dy] {
            rows.resize(n, empty);
        }
        self.k.resize(method.stages().0 * n, empty);
        let mut times = Times { t: empty, t_new: empty, lanes: [false; WIDTH] };
        let mut first = None;
        for (lane, stepper) in steppers.iter_mut().enumerate() {
            let Some(stepper) = stepper.as_mut().filter(|one| one.method().id() == method.id())
            else {
                continue;
            };
            let (y, dy) = (&mut self.y, &mut self.k[..n]);
            let start = LaneStart { lane, y, dy, tolerances: &mut self.tolerances };
            if let Some([t, t_new]) = stepper.propose(start) {
                (times.t[lane], times.t_new[lane], times.lanes[lane]) = (t, t_new, true);
                first = first.or(Some(lane));
            }
        }
        let first = first.filter(|_| times.lanes.iter().filter(|has| **has).count() > 1)?;
        for lane in (0..WIDTH).filter(|lane| !times.lanes[*lane]) {
            (times.t[lane], times.t_new[lane]) = (times.t[first], times.t_new[first]);
            self.tolerances.repeat(first, lane);
            let both = self.y.iter_mut().chain(&mut self.k[..n]);
            both.for_each(|block| block[lane] = block[first]);
        }
        Some(times)
    }

    /// Computes the stages and error norms of all trials. Returns None if a trial is not ordinary.
    fn advance(
        &mut self,
        method: &dyn LaneMethod,
        times: &Times,
        system: &mut dyn LaneOde,
    ) -> Option<Block> {
        let Self { y, y_new, argument, k, tolerances, registers, .. } = self;
        let [t, t_new] = each([times.t, times.t_new], Lanes::new);
        let h = t_new - t;
        let mut trial = LaneTrial { system, t, t_new, h, y, argument, registers };
        let advanced = method.advance(&mut trial, k, y_new);
        advanced.then(|| method.norms(h.to_array(), k, [y, y_new], tolerances))
    }

    /// Projects the accepted states and evaluates f there. Returns for each lane whether projection changed the
    /// state, or None if the stepper must take the step alone.
    fn settle(
        &mut self,
        last_in_error: bool,
        times: &Times,
        accepted: Mask,
        system: &mut dyn LaneOde,
    ) -> [Option<bool>; WIDTH] {
        let Self { y_new, k, dy, registers, argument, keeps_stages, .. } = self;
        let t = Lanes::new(times.t_new);
        if *keeps_stages {
            argument.copy_from_slice(y_new);
        }
        registers.put(y_new);
        let mut projected = system.project(t, &mut registers.y, accepted);
        y_new.iter_mut().zip(&registers.y).for_each(|(to, y)| *to = y.to_array());
        if !last_in_error || projected.contains(&Some(true)) {
            let ordinary = registers.rates(system, t, y_new, dy);
            if !ordinary || !all_finite(dy.as_flattened()) {
                projected = [None; WIDTH];
            }
        }
        if last_in_error {
            let n = dy.len();
            let last = row(k, n, k.len() / n.max(1) - 1);
            for lane in (0..WIDTH).filter(|lane| projected[*lane] == Some(false)) {
                dy.iter_mut().zip(last).for_each(|(dy, last)| dy[lane] = last[lane]);
            }
        }
        projected
    }
}
