//! A follower and its dimensions.

use super::words::short;
use crate::conditions::Refused;
use crate::plane::{abs, angle, conjugate};
use kempe::math::Complex;
use std::f64::consts::{FRAC_PI_2, PI};

/// What touches the cam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// A roller.
    Roller,
    /// An edge.
    Knife,
    /// A flat face.
    Flat,
}

impl End {
    /// Names in the order of the kinds.
    pub const NAMES: [&'static str; 3] = ["roller", "knife", "flat"];

    /// The kind with a name.
    pub fn named(name: &str) -> Option<Self> {
        let all = [Self::Roller, Self::Knife, Self::Flat];
        all.into_iter().find(|one| one.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

const POSITIVE: &str = "must be > 0";

/// Whether a number is one, and more than zero.
pub(super) fn positive(x: f64) -> bool {
    x > 0.0 && x.is_finite()
}

/// Whether an argument is right, its name, its number with its unit, and what it must be.
pub(super) type Check<'a> = (bool, &'a str, Option<(f64, &'a str)>, &'a str);

/// Refuse the first argument that is wrong.
pub(super) fn refuse(checks: &[Check<'_>]) -> Result<(), Refused> {
    let Some((_, name, number, told)) = checks.iter().find(|(right, ..)| !right) else {
        return Ok(());
    };
    let Some((x, unit)) = number else {
        return Err(Refused::new([name, ": ", told].concat(), ""));
    };
    Err(Refused::new([name, ": ", &short(*x, 6), unit].concat(), *told))
}

/// A follower beside a cam that turns counter-clockwise.
#[derive(Clone, Debug)]
pub struct Follower {
    /// What touches the cam.
    pub kind: End,
    /// Radius of the base circle, m.
    pub base: f64,
    /// Radius of the roller, m; 0 for the others.
    pub roller: f64,
    /// Of the line of travel to the right of the shaft, m.
    pub offset: f64,
    /// Length of an oscillating follower, m.
    pub arm: Option<f64>,
    /// Pivot of an oscillating follower.
    pub pivot: Complex,
    /// Distance of a flat face from the pivot towards the cam, m.
    pub face: f64,
    /// Whether it is the follower of a conjugate cam, on the other side of the shaft.
    pub opposite: bool,
}

impl Follower {
    /// The distance of the pitch curve from the shaft at no lift, m.
    pub fn prime(&self) -> f64 {
        self.base + self.roller
    }

    /// 1 if a lift turns an oscillating follower counter-clockwise, -1 if clockwise.
    pub fn sense(&self) -> f64 {
        match (self.pivot.re >= 0.0) != self.opposite {
            true => -1.0,
            false => 1.0,
        }
    }

    /// At no lift: height of the roller's centre or face; angle from pivot-shaft to the arm.
    pub fn start(&self) -> f64 {
        let (far, prime) = (abs(self.pivot), self.prime());
        match (self.arm, self.kind) {
            (None, End::Flat) => self.base,
            (None, _) => (prime * prime - self.offset * self.offset).sqrt(),
            (Some(_), End::Flat) => ((self.base + self.face) / far).asin(),
            (Some(arm), _) => ((far * far + arm * arm - prime * prime) / (2.0 * far * arm)).acos(),
        }
    }

    /// The angle of an oscillating follower from its pivot to its end, rad.
    pub fn direction(&self, s: f64) -> f64 {
        angle(-self.pivot) + self.sense() * (self.start() + s)
    }

    /// Beside a cam that turns clockwise, as the mirror image.
    pub fn mirrored(self) -> Self {
        Self { offset: -self.offset, pivot: -conjugate(self.pivot), ..self }
    }

    /// Refuse dimensions that are none, or do not belong to the follower.
    pub(super) fn check_dimensions(&self, groove: bool) -> Result<(), Refused> {
        let (rolls, swings) = (self.kind == End::Roller, self.arm.is_some());
        let none = match self.kind {
            End::Flat => "a flat has no roller; choose follower='roller'",
            _ => "a knife has no roller; choose follower='roller'",
        };
        let [base, roller, far] = [self.base, self.roller, self.arm.unwrap_or(1.0)];
        let knife = "must be > 0, or choose follower='knife'";
        let pivot = "an oscillating follower has a pivot in place of an offset; leave it out";
        let face = "only an oscillating flat follower has it; leave it out";
        let facing = self.kind == End::Flat && swings;
        refuse(&[
            (positive(base), "base_radius", Some((base, " m")), POSITIVE),
            (!rolls || positive(roller), "roller_radius", Some((roller, " m")), knife),
            (rolls || roller == 0.0, "roller_radius", None, none),
            (!groove || rolls, "closure", None, "a groove needs follower='roller'"),
            (self.offset == 0.0 || !swings, "offset", None, pivot),
            (positive(far), "arm", Some((far, " m")), POSITIVE),
            (
                !swings || positive(abs(self.pivot)),
                "pivot",
                None,
                "must not be at the shaft, (0, 0)",
            ),
            (self.face == 0.0 || facing, "face", None, face),
        ])
    }

    /// Refuse dimensions that do not assemble within a lift.
    pub(super) fn check(&self, size: f64) -> Result<(), Refused> {
        let prime = self.prime();
        let base = short(self.base, 6);
        let Some(arm) = self.arm else {
            if self.kind == End::Flat || self.offset.abs() < prime {
                return Ok(());
            }
            let [offset, prime] = [self.offset, prime].map(|x| short(x, 6));
            let told = format!(
                "offset: {offset} m; the line of travel must meet the prime circle of radius {prime} m: take a smaller \
                 offset or a larger base"
            );
            return Err(Refused::new(told, ""));
        };
        let far = abs(self.pivot);
        let (low, high) = ((far - arm).abs(), far + arm);
        let told = if self.kind == End::Flat {
            let inside = self.base + self.face > 0.0 && self.base + self.face < far * (1.0 - 1e-9);
            let far = short(far, 6);
            let told = "with face it must lie between 0 and";
            (!inside).then(|| {
                format!("base_radius: {base} m; {told} {far} m, the distance of the pivot")
            })
        } else {
            let inside = prime > low && prime < high;
            let [prime, low, high] = [prime, low, high].map(|x| short(x, 6));
            (!inside).then(|| {
                format!(
                    "base_radius: {base} m; the roller's centre at the radius {prime} m is not within {low} m to {high} \
                     m, the reach of the arm: change arm or pivot"
                )
            })
        };
        let limit = if self.kind == End::Flat { FRAC_PI_2 } else { PI };
        match told {
            Some(told) => Err(Refused::new(told, "")),
            None if self.start() + size >= limit => {
                let told = format!(
                    "programme: a lift of {} rad turns the follower beyond the line of pivot and shaft",
                    short(size, 6)
                );
                Err(Refused::new(told, "lessen the lift, or move the pivot farther away"))
            }
            None => Ok(()),
        }
    }
}
