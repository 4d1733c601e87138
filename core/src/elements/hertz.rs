//! The law of compliant stops and contacts: N = max(0, E(δ) (1 + c δ̇)) with the depth δ (Hunt and Crossley 1975).
//!
//! The elastic part E is k δⁿ, with the potential k δⁿ⁺¹/(n + 1), or that of two [`Cylinders`]. The rest of N is the damping part. It dissipates energy in
//! both directions, and cancels the elastic part where 1 + c δ̇ < 0. With c in s/m and k in N/mⁿ, N is in N.
//!
//! For a restitution e, c follows from the speed v with which the contact began, which is then a state of the element:
//! c v = 3 (1 - e²)/4 (Lankarani and Nikravesh, *A Contact Force Model With Hysteresis Damping for Impact Analysis of
//! Multibody Systems*, J. Mech. Des. 112 (1990) 369) or c v = 8 (1 - e)/(5 e) (Flores, Machado, Silva and Martins, *On
//! the continuous contact force models for soft materials in multibody dynamics*, Multibody Syst. Dyn. 25 (2011) 357).
//! Without a known speed, v = 0, there is no damping.

use super::cylinders::Cylinders;
use super::force_trait::Situation;
use super::kinds::NormalLaw;
use crate::math::Real;

/// The number of switches of one contact.
pub(super) const SWITCHES: usize = 2;

/// The default of `rest_speed`.
const REST_SPEED: f64 = 1e-9;

/// The elastic part of N.
#[derive(Clone, Copy)]
pub(super) enum Elastic<S> {
    /// k δⁿ: k in N/mⁿ, and n.
    Power(S, S),
    /// The force between cylinders.
    Cylinders(Cylinders<S>),
}

/// The coefficients of the law.
#[derive(Clone, Copy)]
pub(super) struct Hertz<S> {
    /// The elastic part.
    pub elastic: Elastic<S>,
    /// c, s/m, or c v.
    pub damping: ContactDamping<S>,
}

/// The damping of the law.
#[derive(Clone, Copy)]
pub(super) enum ContactDamping<S> {
    /// c, s/m.
    Constant(S),
    /// c v.
    BySpeed(S),
}

impl<S: Real> ContactDamping<S> {
    /// c.
    fn factor(self, at: &Situation<'_, S>) -> S {
        match (self, at.z.last()) {
            (Self::Constant(c), _) => c,
            (Self::BySpeed(c), Some(speed)) => S::select(*speed, c / *speed, S::zero()),
            (Self::BySpeed(_), None) => S::zero(),
        }
    }
}

/// The fields of the law in an element.
pub struct Compliance<S> {
    /// The law.
    pub law: NormalLaw,
    /// k, N/mⁿ.
    pub stiffness: Option<S>,
    /// n.
    pub exponent: S,
    /// c, s/m.
    pub damping: S,
    /// Modulus of elasticity of cylinders, N/m².
    pub young: Option<S>,
    /// Their ratio of Poisson.
    pub poisson: Option<S>,
    /// Their width, m.
    pub width: Option<S>,
    /// e of a law that [keeps the speed](NormalLaw::keeps_speed), or of a rigid contact.
    pub restitution: Option<S>,
}

impl NormalLaw {
    /// Whether the damping depends on the speed with which the contact began.
    pub fn keeps_speed(self) -> bool {
        matches!(self, Self::LankaraniNikravesh | Self::Flores)
    }
}

impl<S: Real> Compliance<S> {
    /// The law, for cylinders with a sum of their signed radii.
    pub(super) fn law(&self, apart: S) -> Option<Hertz<S>> {
        let (young, poisson, width) = (self.young, self.poisson, self.width);
        let cylinders = young.zip(poisson).zip(width).map(|((young, poisson), width)| {
            Elastic::Cylinders(Cylinders::new([young, poisson, width], apart))
        });
        let power = self.stiffness.map(|k| Elastic::Power(k, self.exponent));
        Some(Hertz { elastic: cylinders.or(power)?, damping: self.damping() })
    }

    fn damping(&self) -> ContactDamping<S> {
        let (e, of) = (self.restitution, S::constant);
        match (self.law, e) {
            (NormalLaw::LankaraniNikravesh, Some(e)) => {
                ContactDamping::BySpeed(of(0.75) * (S::one() - e * e))
            }
            (NormalLaw::Flores, Some(e)) => ContactDamping::BySpeed(of(1.6) * (S::one() - e) / e),
            _ => ContactDamping::Constant(self.damping),
        }
    }
}

/// A depth and its rate.
#[derive(Clone, Copy)]
pub(super) struct Depth<S> {
    /// δ, > 0 in contact.
    pub value: S,
    /// δ̇.
    pub rate: S,
}

/// The parts of N.
#[derive(Clone, Copy)]
pub(super) struct Normal<S> {
    /// k δⁿ.
    pub elastic: S,
    /// N - k δⁿ.
    pub damping: S,
}

impl<S: Real> Normal<S> {
    /// N.
    pub fn sum(self) -> S {
        self.elastic + self.damping
    }
}

impl<S: Real> Hertz<S> {
    /// The parts of N. `first` is the index of the first switch of the contact. None if there is no contact in any
    /// lane.
    pub fn normal(
        &self,
        at: &Situation<'_, S>,
        first: usize,
        depth: Depth<S>,
    ) -> Option<Normal<S>> {
        if !touches(at, first, depth.value) {
            return None;
        }
        let elastic = at.choose(first, depth.value, self.elastic(depth.value), S::zero());
        let factor = self.damping.factor(at) * depth.rate;
        let damping = at.choose(first + 1, S::one() + factor, elastic * factor, -elastic);
        Some(Normal { elastic, damping })
    }

    /// The potential of the elastic part, J.
    pub fn potential(&self, at: &Situation<'_, S>, first: usize, depth: S) -> S {
        if !touches(at, first, depth) {
            return S::zero();
        }
        let energy = match self.elastic {
            Elastic::Power(_, exponent) => self.elastic(depth) * depth / (exponent + S::one()),
            Elastic::Cylinders(cylinders) => cylinders.potential(depth),
        };
        at.choose(first, depth, energy, S::zero())
    }

    /// The functions of the switches: onset and release, and the sign of 1 + c δ̇ while in contact.
    pub fn switches(&self, at: &Situation<'_, S>, depth: Depth<S>, out: &mut [S]) {
        let factor = S::one() + self.damping.factor(at) * depth.rate;
        out[0] = depth.value;
        out[1] = S::select(depth.value, factor, S::one());
    }

    /// c, s/m. None if it depends on the speed with which the contact began.
    pub fn constant_damping(&self) -> Option<S> {
        match self.damping {
            ContactDamping::Constant(c) => Some(c),
            ContactDamping::BySpeed(_) => None,
        }
    }

    /// k and n of the elastic part, for cylinders at a light load.
    pub fn power(&self) -> [S; 2] {
        match self.elastic {
            Elastic::Power(stiffness, exponent) => [stiffness, exponent],
            Elastic::Cylinders(cylinders) => cylinders.power(),
        }
    }

    /// The elastic part, continued to negative depths as an odd function, so that a step may extend beyond the release.
    fn elastic(&self, depth: S) -> S {
        match self.elastic {
            Elastic::Power(stiffness, exponent) => {
                let (squared, above) = (depth * depth, exponent - S::one());
                let bend = above * depth.abs().ln();
                // at first touch the law is stiff only if it is linear
                let touch = S::select(above, S::zero(), depth);
                stiffness * S::select(squared, depth * bend.exp(), touch)
            }
            Elastic::Cylinders(cylinders) => cylinders.force(depth),
        }
    }
}

/// Whether any lane is in contact; during a step, whether it was at the beginning of the step.
fn touches<S: Real>(at: &Situation<'_, S>, first: usize, depth: S) -> bool {
    match at.held.pieces.get(at.held.first + first) {
        Some(piece) if *piece != 0.0 => *piece > 0.0,
        _ => depth.in_lanes().iter().any(|depth| *depth > 0.0 || depth.is_nan()),
    }
}

/// The fault of the fields that select compliance or restitution.
pub(super) fn fault(
    stiffness: Option<f64>,
    [exponent, usual]: [f64; 2],
    damping: f64,
    [restitution, rest_speed]: [Option<f64>; 2],
) -> Option<(&'static str, String)> {
    let refuse = |field, message: &str| Some((field, message.to_string()));
    let alone = "not together with restitution; remove one of them";
    match (stiffness, restitution) {
        (None, None) => refuse("stiffness", "missing; give stiffness or restitution"),
        (Some(_), Some(_)) => {
            refuse("restitution", "not together with stiffness; remove one of them")
        }
        (Some(k), None) if k <= 0.0 => refuse("stiffness", "must be positive"),
        (Some(_), None) if exponent < 1.0 => refuse("exponent", "must be at least 1"),
        (Some(_), None) if damping < 0.0 => refuse("damping", "must not be negative"),
        (Some(_), None) if rest_speed.is_some_and(|speed| speed != REST_SPEED) => {
            refuse("rest_speed", "not together with stiffness; remove it")
        }
        (None, Some(_)) if rest_speed.is_some_and(|speed| speed < 0.0) => {
            refuse("rest_speed", "must not be negative")
        }
        (None, Some(_)) if damping != 0.0 => refuse("damping", alone),
        (None, Some(_)) if exponent != usual => refuse("exponent", alone),
        (None, Some(e)) if !(0.0..=1.0).contains(&e) => {
            refuse("restitution", "must be from 0 to 1")
        }
        _ => None,
    }
}

impl Compliance<f64> {
    /// The fault of the fields that select a law. `apart` is the sum of the signed radii of two circles.
    pub(super) fn fault(
        &self,
        apart: Option<f64>,
        rest_speed: f64,
    ) -> Option<(&'static str, String)> {
        if self.law == NormalLaw::Hertz {
            return self.fault_of_cylinders(apart, self.restitution);
        }
        let own = self.of_cylinders().into_iter().find(|of| of.1.is_some());
        let of_other = |(field, _)| {
            (field, "belongs to law = \"hertz\"; give this law, or remove the field".to_string())
        };
        let bounces = [self.restitution, Some(rest_speed)];
        let usual = || match self.law.keeps_speed() {
            true => self.fault_of_speed(rest_speed),
            false => fault(self.stiffness, [self.exponent, 1.5], self.damping, bounces),
        };
        own.map(of_other).or_else(usual)
    }

    /// The fault of a law whose damping follows from a restitution.
    fn fault_of_speed(&self, rest_speed: f64) -> Option<(&'static str, String)> {
        let refuse = |field, message: &str| Some((field, message.to_string()));
        let Some(e) = self.restitution else {
            return refuse("restitution", "missing; the damping of this law follows from it");
        };
        match self.law {
            _ if self.stiffness.is_none() => refuse("stiffness", "missing; this law needs it"),
            _ if self.damping != 0.0 => refuse(
                "damping",
                "follows from restitution; remove it, or give law = \"hunt_crossley\"",
            ),
            NormalLaw::Flores if e <= 0.0 || e > 1.0 => {
                refuse("restitution", "must be above 0 and at most 1")
            }
            _ if !(0.0..=1.0).contains(&e) => refuse("restitution", "must be from 0 to 1"),
            _ => fault(self.stiffness, [self.exponent, 1.5], 0.0, [None, Some(rest_speed)]),
        }
    }

    fn of_cylinders(&self) -> [(&'static str, Option<f64>); 3] {
        [("young", self.young), ("poisson", self.poisson), ("width", self.width)]
    }

    fn fault_of_cylinders(
        &self,
        apart: Option<f64>,
        restitution: Option<f64>,
    ) -> Option<(&'static str, String)> {
        let refuse = |field, message: &str| Some((field, message.to_string()));
        for (field, value) in self.of_cylinders() {
            match (field, value) {
                (_, None) => {
                    return refuse(field, "missing; law = \"hertz\" has young, poisson and width")
                }
                ("poisson", Some(x)) if !(0.0..=0.5).contains(&x) => {
                    return refuse(field, "must be from 0 to 0.5");
                }
                ("young" | "width", Some(x)) if x <= 0.0 => {
                    return refuse(field, "must be positive")
                }
                _ => {}
            }
        }
        let alone = "not together with law = \"hertz\"; remove it, or give law = \"hunt_crossley\"";
        match (self.stiffness, restitution) {
            (Some(_), _) => refuse("stiffness", alone),
            (_, Some(_)) => refuse("restitution", alone),
            _ if self.exponent != 1.5 => refuse("exponent", alone),
            _ if self.damping < 0.0 => refuse("damping", "must not be negative"),
            _ if apart.is_none_or(|apart| apart <= 0.0) => {
                let message = "hertz is the law of two cylinders: the curve must be a circle, and radius > 0, inside a \
                               circle below its radius; otherwise give law = \"hunt_crossley\" and stiffness";
                refuse("law", message)
            }
            _ => None,
        }
    }
}
