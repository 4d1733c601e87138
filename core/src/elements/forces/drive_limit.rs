//! The limit of a driver: its effort along its coordinate c has at most the magnitude F.
//!
//! The lag of the drive is Φ = c - value(t), the opening of the driver. While the drive holds the lag, the equation
//! Φ = constant has the multiplier λ, and the effort is -λ. Where |λ| would exceed F, the effort is -F sign Φ̇, and the lag
//! changes; it is held again where Φ̇ becomes zero and F suffices. The limit acts in runs of forward dynamics only.
//! Elsewhere the driver holds its coordinate with any effort.
//!
//! The limit is a part of the driver: it has the name of the driver, and no file contains it.

use crate::elements::declare::{Element, Table};
use crate::elements::{
    acted, holding, Acted, Behaviour, BodyId, Constraint, Force, Group, Kind, Mode, Nature, Part,
    QuantityKind, ResultQuantity, Situation, Source, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Listed, Real, Vec2, Wrench};

/// The limit of a driver.
#[derive(Clone, Debug)]
pub struct DriveLimit<S = f64> {
    /// The driver, which has one equation and a [limit](Constraint::limit).
    pub driver: Box<Constraint<S>>,
    /// Its coordinate.
    pub coordinate: Acted<S>,
    /// Whether it acts in place of the driver.
    pub acts: bool,
}

impl Element for DriveLimit {
    type Over<S> = DriveLimit<S>;
    const NAME: &'static str = "driver (limit)";

    /// It has no fields, because no file contains it.
    fn table() -> Table {
        Table { name: Self::NAME, doc: String::new(), fields: Vec::new() }
    }

    fn read(_: &mut dyn Source) -> Option<DriveLimit<Tape>> {
        None
    }

    fn map<S, T>(e: &DriveLimit<S>, f: &mut dyn FnMut(&S) -> T) -> DriveLimit<T> {
        let driver = Box::new(e.driver.map(f));
        DriveLimit { driver, coordinate: acted::map(&e.coordinate, f), acts: e.acts }
    }

    fn scalars<S>(e: &DriveLimit<S>) -> Vec<usize> {
        let mut count = 0;
        acted::map(&e.coordinate, &mut |_: &S| count += 1);
        e.driver.scalars().into_iter().chain([count]).list()
    }
}

impl<S: Real> DriveLimit<S> {
    /// F; negative values count as 0.
    fn most(&self) -> S {
        let limit = self.driver.limit().copied().unwrap_or_else(S::zero);
        S::select(limit, limit, S::zero())
    }

    fn effort(&self, at: &Situation<'_, S>) -> S {
        match at.mode {
            mode if mode.holds() => -at.multiplier,
            Mode::Slides(sign) => -(S::constant(sign) * self.most()),
            _ => S::zero(),
        }
    }
}

impl Force for DriveLimit {
    const PARTS: &'static [Part] = &[Part { name: "drive", nature: Nature::Applied }];
    const GROUP: Group = Group::Drivers;
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &DriveLimit<S>) -> Vec<BodyId> {
        e.coordinate.of.bodies().into()
    }

    fn driver<S>(e: &DriveLimit<S>) -> Option<&Constraint<S>> {
        Some(&e.driver)
    }

    fn take_over<S>(e: &mut DriveLimit<S>, acts: bool) {
        e.acts = acts;
    }

    fn effort<S: Real>(e: &DriveLimit<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        (e.effort(at), Wrench::zero())
    }

    fn put_effort<S: Real>(
        e: &DriveLimit<S>,
        _: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        for (body, wrench) in e.coordinate.wrenches(effort).into_iter().enumerate() {
            out.put(0, body, wrench);
        }
    }

    fn action<S: Real>(e: &DriveLimit<S>, at: &Situation<'_, S>, out: impl Wrenches<S>) {
        Self::put_effort(e, at, e.effort(at), out);
    }

    fn result_quantities<S>(e: &DriveLimit<S>) -> &'static [ResultQuantity] {
        const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
            ResultQuantity { name, unit, negative: None }
        }
        const POWER: ResultQuantity = of("power", "W");
        match e.coordinate.of.kind() {
            QuantityKind::Length => const { &[of("effort", "N"), POWER, of("limit", "N")] },
            _ => const { &[of("effort", "N*m"), POWER, of("limit", "N*m")] },
        }
    }

    fn results<S: Real>(e: &DriveLimit<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let effort = e.effort(at);
        out.copy_from_slice(&[effort, effort * at.rate(&e.coordinate), e.most()]);
    }

    fn arms<S: Real>(e: &DriveLimit<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        let arm = |body: usize| at.body(body).pose.global(e.coordinate.of.attachment(body).s);
        Some([arm(0), arm(1)])
    }

    fn behaviour<S: Real>(e: &DriveLimit<S>) -> Option<Behaviour<S>> {
        e.acts.then_some(Behaviour::Sticks)
    }

    fn limit<S: Real>(e: &DriveLimit<S>, _: &Situation<'_, S>) -> (S, Wrench<S>) {
        (e.most(), Wrench::zero())
    }

    fn holding(e: &DriveLimit<Tape>, _: f64, value: f64) -> Option<Constraint<Tape>> {
        let law = e.driver.value()?.clone();
        Some(holding(e.coordinate.of.clone(), law.plus(value)))
    }

    fn fault(e: &DriveLimit) -> Option<(&'static str, String)> {
        let limit = e.driver.limit().filter(|limit| **limit < 0.0)?;
        Some(("limit", format!("{limit}; must not be negative")))
    }
}
