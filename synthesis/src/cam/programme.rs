//! The lift of a follower over the angle of its cam.

use super::law::{Law, Piece, Place, Unlawful, LAWS};
use super::words::{degrees, short};
use crate::conditions::Refused;
use std::f64::consts::{PI, TAU};

/// Numbers that differ by less, relative to the largest of them, are the same.
pub const SAME: f64 = 1e-9;
/// Jumps of speed and acceleration, relative to the largest lift, that are rounding errors.
const JUMPS: [f64; 2] = [1e-7, 1e-6];
/// Samples of a piece for its highest place, and least samples for its limits.
const HEIGHTS: usize = 65;
const SAMPLES: usize = 33;

/// What a segment does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Up.
    Rise,
    /// At rest.
    Dwell,
    /// Down.
    Return,
}

/// A segment: its angle, rad; the change of its lift, of a return to no lift `None`; and its law.
pub type Segment = (Way, f64, Option<f64>, Law);

/// The lift over a turn of the cam.
#[derive(Clone, Debug)]
pub struct Programme {
    /// From 0 to 2π.
    pub pieces: Vec<Piece>,
    /// Whether lifts are angles, rad, in place of lengths, m.
    pub angular: bool,
    /// The largest lift.
    pub size: f64,
    /// The smallest lift.
    pub least: f64,
    /// Angles at which the acceleration jumps, rad, and the jumps per rad².
    pub jumps: Vec<(f64, f64)>,
}

fn refused<T>(message: impl Into<String>, hint: impl Into<String>) -> Result<T, Refused> {
    Err(Refused::new(message.into(), hint))
}

impl Programme {
    /// The programme of segments.
    ///
    /// # Errors
    /// They do not make a turn, do not return, or the speed jumps.
    pub fn new(segments: &[Segment], angular: bool) -> Result<Self, Refused> {
        let mut pieces = Vec::new();
        let [mut angle, mut lift] = [0.0; 2];
        for (k, segment) in segments.iter().enumerate() {
            let at = placed(segment, k + 1, angle, lift)?;
            pieces.extend(segment.3.pieces(&at).or_else(|why| unlawful(&segment.3, k + 1, &why))?);
            [angle, lift] = [angle + at.length, lift + at.height];
        }
        closed(angle, lift, &pieces, unit(angular))?;
        // rounding: the last piece ends at 2π
        pieces.last_mut().expect("a turn").end = TAU;
        let heights = pieces.iter().flat_map(|of| spread(of, HEIGHTS).map(|x| of.at(x, 0)));
        let (least, size) = heights
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (f64::min(a, s), f64::max(b, s)));
        if size <= 0.0 {
            return refused("programme: the follower does not move", "add a rise and a return");
        }
        let jumps = jumps(&pieces, size, unit(angular))?;
        Ok(Self { pieces, angular, size, least, jumps })
    }

    /// The unit of the lift.
    pub fn unit(&self) -> &'static str {
        unit(self.angular)
    }

    /// The piece at an angle of any turn, and the angle within the turn.
    fn piece(&self, angle: f64) -> (&Piece, f64) {
        let turned = angle.rem_euclid(TAU);
        let after = self.pieces.partition_point(|piece| piece.start <= turned);
        (&self.pieces[after.max(1) - 1], turned)
    }

    /// The lift, or its derivative of an order by the angle, at any angle.
    pub fn at(&self, angle: f64, order: usize) -> f64 {
        let (piece, turned) = self.piece(angle);
        piece.at(turned, order)
    }

    /// The lift and three derivatives at any angle.
    pub fn rows(&self, angle: f64) -> [f64; 4] {
        let (piece, turned) = self.piece(angle);
        piece.rows(turned)
    }

    /// Angles of each piece, both of its ends among them, with the lift and three derivatives.
    pub fn sampled(&self, step: f64) -> Vec<(&Piece, f64, [f64; 4])> {
        let mut found = Vec::new();
        for piece in &self.pieces {
            let count = (((piece.end - piece.start) / step).ceil() as usize).max(SAMPLES);
            found.extend(spread(piece, count).map(|angle| (piece, angle, piece.rows(angle))));
        }
        found
    }
}

/// The step of angles between which limits are looked for, rad.
pub const STEP: f64 = PI / 360.0;

fn unit(angular: bool) -> &'static str {
    if angular {
        "rad"
    } else {
        "m"
    }
}

/// Places from the start to the end of a piece.
fn spread(of: &Piece, count: usize) -> impl Iterator<Item = f64> {
    let (start, end, last) = (of.start, of.end, count - 1);
    let step = (end - start) / last as f64;
    (0..count).map(move |k| if k == last { end } else { k as f64 * step + start })
}

/// Where a segment is.
fn placed(segment: &Segment, number: usize, angle: f64, lift: f64) -> Result<Place, Refused> {
    let (way, length, given, _) = segment;
    if !(*length > 0.0 && *length <= TAU * (1.0 + SAME)) {
        let told = format!("programme[{number}] angle: {length:?}");
        return refused(told, "must be positive, at most 360 deg");
    }
    let mut height = given.unwrap_or(lift);
    if *way == Way::Dwell {
        height = 0.0;
    } else if height <= 0.0 || height.is_nan() {
        let told = format!("programme[{number}] lift: {}", short(height, 6));
        let begin = "there is no lift from which to return; begin with a rise";
        return refused(told, if given.is_none() { begin } else { "must be > 0" });
    }
    if *way == Way::Return {
        height = -if (height - lift).abs() <= SAME * lift { lift } else { height };
    }
    Ok(Place { angle, length: *length, lift, height })
}

/// Why a law is none.
fn unlawful(law: &Law, number: usize, why: &Unlawful) -> Result<Vec<Piece>, Refused> {
    let path = format!("programme[{number}]");
    let (told, hint) = match (why, law) {
        (Unlawful::Points, _) => (
            format!("{path} points: their angles must grow within the segment, and lie between its ends"),
            String::new(),
        ),
        (Unlawful::Unknown, Law::Named(name)) => (
            format!("{path} law: '{name}'"),
            format!("must be {}, or a polynomial or spline", LAWS.join(", ")),
        ),
        _ => (format!("{path} law: start and end of a spline: [speed, acceleration]"), String::new()),
    };
    refused(told, hint)
}

/// Refuse a programme that is no turn, or does not return.
fn closed(angle: f64, lift: f64, pieces: &[Piece], unit: &str) -> Result<(), Refused> {
    if pieces.is_empty() {
        return refused("programme: has no segments", "add a rise and a return");
    }
    if (angle - TAU).abs() > SAME * TAU {
        let missing = TAU - angle;
        let hint = match missing > 0.0 {
            true => format!("add ('dwell', '{} deg')", degrees(missing, 6)),
            false => "shorten a segment".into(),
        };
        let covered = degrees(angle, 6);
        return refused(format!("programme: its segments cover {covered}°, not 360°"), hint);
    }
    let top = pieces.iter().map(|of| of.at(of.end, 0).abs()).fold(0.0, f64::max);
    if lift.abs() > SAME * top {
        let far = short(lift.abs(), 6);
        let (side, hint) = match lift < 0.0 {
            true => ("below", "return less, or rise more"),
            false => ("above", "add ('return', angle, law)"),
        };
        let told = format!("programme: the follower ends {far} {unit} {side} its start");
        return refused(told, hint);
    }
    Ok(())
}

/// The jumps of the acceleration; a jump of the speed is refused.
fn jumps(pieces: &[Piece], size: f64, unit: &str) -> Result<Vec<(f64, f64)>, Refused> {
    let mut found = Vec::new();
    let before = pieces.last().into_iter().chain(pieces);
    for (before, after) in before.zip(pieces) {
        let [speed, acceleration] =
            [1, 2].map(|order| after.at(after.start, order) - before.at(before.end, order));
        if speed.abs() > JUMPS[0] * size {
            let (speed, at) = (short(speed, 6), degrees(after.start, 6));
            let told = format!("programme: the speed jumps by {speed} {unit}/rad at {at}°");
            let hint = "choose a law that begins and ends at rest, such as 'cycloidal', or a polynomial whose start and \
                        end have the speed of its neighbours";
            return refused(told, hint);
        }
        if acceleration.abs() > JUMPS[1] * size {
            found.push((after.start, acceleration));
        }
    }
    Ok(found)
}
