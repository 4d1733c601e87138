//! The least base circle of a cam within limits, and the remedies of an undercut profile.

use super::curves::Cam;
use super::follower::{End, Follower};
use super::words::{degrees, short};
use crate::conditions::Refused;
use crate::plane::abs;

/// Base radii that a search tries, on each side of the size of the cam, and the decades of their range.
const TRIES: usize = 121;
const DECADES: f64 = 4.0;
/// Halvings after which two base radii differ by rounding errors.
const HALVINGS: usize = 60;
/// The room that a remedy leaves, and steps by which it grows until nothing is undercut.
const ROOM: f64 = 1.001;
const STEPS: usize = 40;

/// What removes an undercut.
#[derive(Clone, Copy, Debug, Default)]
pub struct Remedies {
    /// A larger base radius, m.
    pub base: Option<f64>,
    /// A smaller roller, m, with the base radius that keeps its path.
    pub roller: Option<[f64; 2]>,
}

impl Remedies {
    /// As a text.
    pub fn told(&self) -> String {
        let base = self.base.map(|x| format!("take a base_radius of at least {} m", short(x, 4)));
        let roller = self.roller.map(|[roller, base]| {
            let (roller, base) = (short(roller, 4), short(base, 6));
            let told = "which keeps the path of its centre";
            format!("take a roller_radius of at most {roller} m, with base_radius {base} m, {told}")
        });
        let found: Vec<String> = base.into_iter().chain(roller).collect();
        match found.is_empty() {
            true => "lengthen the segments, or lessen the lift".into(),
            false => found.join("; or "),
        }
    }
}

impl Cam {
    /// The least base radius within limits, m; `None` if there is none.
    ///
    /// `steep` is the largest pressure angle, rad, and `sharp` the least convex radius of curvature of the profile, m.
    pub fn least_base(&self, steep: Option<f64>, sharp: f64) -> Option<f64> {
        let keeps = |base: f64| {
            let Ok(other) = self.with_base(base) else { return false };
            let radius = other.least_radius_of_curvature();
            radius.is_ok_and(|(radius, _)| radius >= sharp)
                && steep.is_none_or(|steep| {
                    other.largest_pressure_angle().is_ok_and(|(angle, _)| angle <= steep)
                })
        };
        let mut before = None;
        for base in self.bases() {
            if keeps(base) {
                return Some(before.map_or(base, |low| border(keeps, low, base)));
            }
            before = Some(base);
        }
        None
    }

    /// Refuse a cam with an undercut profile.
    pub(super) fn refuse_undercut(&self) -> Result<(), Refused> {
        let Some((first, last)) = self.undercut()?.first().copied() else { return Ok(()) };
        let [first, last] = [first, last].map(|angle| degrees(angle, 4));
        let told = format!("the profile is undercut between {first}° and {last}°");
        Err(Refused::new(told, self.remedies().told()))
    }

    /// What removes an undercut: a larger base circle, or a smaller roller.
    pub fn remedies(&self) -> Remedies {
        let clean = |other: &Self| other.undercut().is_ok_and(|bad| bad.is_empty());
        let first = self.least_base(None, 0.0).map(|base| base * ROOM);
        let bases = std::iter::successors(first, |base| Some(base * 1.1)).take(STEPS);
        let others = bases.map_while(|base| self.with_base(base).ok());
        let base = others.into_iter().find(clean).map(|other| up(other.follower.base));
        let prime = self.follower.prime();
        let rollers =
            std::iter::successors(Some(self.follower.roller), |roller| Some(roller * 0.9));
        let tries = if self.rolls() { STEPS } else { 0 };
        let others = rollers.skip(1).take(tries).map(|roller| {
            let follower = Follower { roller, base: prime - roller, ..self.follower.clone() };
            Self { follower, ..self.clone() }
        });
        let roller = others.into_iter().find(clean).map(|other| {
            let Follower { roller, base, .. } = other.follower;
            [rounded(roller, 4), rounded(base, 6)]
        });
        Remedies { base, roller }
    }

    fn with_base(&self, base: f64) -> Result<Self, Refused> {
        let follower = Follower { base, ..self.follower.clone() };
        follower.check(self.programme.size)?;
        Ok(Self { follower, ..self.clone() })
    }

    /// Base radii that a search tries, ascending.
    fn bases(&self) -> Vec<f64> {
        let of = &self.follower;
        let flat = of.kind == End::Flat;
        let Some(arm) = of.arm else {
            let least = if flat { 0.0 } else { (of.offset.abs() - of.roller).max(0.0) };
            let size = self.programme.size + of.roller + of.offset.abs();
            let (last, count) = ((2 * TRIES - 1) as f64, 2 * TRIES);
            let power = |k: usize| 10f64.powf(DECADES * (2.0 * k as f64 / last - 1.0));
            return (0..count).map(|k| least + size * power(k)).collect();
        };
        let far = abs(of.pivot);
        let (low, high) = if flat { (0.0, far) } else { ((far - arm).abs(), far + arm) };
        let shift = if flat { of.face } else { of.roller };
        let step = (high - low) / (TRIES + 1) as f64;
        let tries = (1..=TRIES).map(|k| low + k as f64 * step - shift);
        tries.filter(|base| *base > 0.0).collect()
    }
}

/// The least value that keeps limits, between one that does not and one that does.
fn border(keeps: impl Fn(f64) -> bool, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        if keeps(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// With some digits.
fn rounded(x: f64, digits: usize) -> f64 {
    short(x, digits).parse().unwrap_or(x)
}

/// With four digits, rounded up.
fn up(x: f64) -> f64 {
    let unit = 10f64.powf(x.log10().floor() - 3.0);
    rounded((x / unit).ceil() * unit, 4)
}
