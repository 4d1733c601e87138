//! Limits of a cam: pressure angle, radius of curvature, undercut and lift-off.

use super::curves::{curve, Cam, Closure};
use super::follower::End;
use super::law::Piece;
use super::programme::STEP;
use super::shape::Touch;
use crate::conditions::Refused;
use kempe::math::Complex;
use std::f64::consts::PI;

/// Width of the interval within which the least value is found, rad: its square is a rounding error.
const NARROW: f64 = 1e-10;
/// How much nearer than the radius of the roller a profile is to its pitch curve if both cross, relative to it.
const CROSSED: f64 = 1e-6;
/// Step of the angle for the lift-off, rad.
const FINE: f64 = PI / 14_400.0;

impl Cam {
    /// The largest magnitude of the pressure angle, rad, of both cams if there are two.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn largest_pressure_angle(&self) -> Result<(f64, f64), Refused> {
        let mut found = (f64::INFINITY, 0.0);
        for second in self.sides() {
            found = lesser(found, self.least(&|of| -of.pressure.abs(), *second)?);
        }
        Ok((-found.0, found.1))
    }

    /// The least radius of curvature, m, where the roller or face needs one, and its angle; ≤ 0 if undercut.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn least_radius_of_curvature(&self) -> Result<(f64, f64), Refused> {
        let mut found = (f64::INFINITY, 0.0);
        for second in self.sides() {
            // the radius where the pitch curve is convex; of faces, everywhere
            let flat = self.follower.kind == End::Flat;
            let convex = move |of: &Touch| match flat || of.bend > 0.0 || of.room <= 0.0 {
                true => of.radius,
                false => f64::INFINITY,
            };
            found = lesser(found, self.least(&convex, *second)?);
        }
        if self.closure == Closure::Groove {
            let roller = self.follower.roller;
            let hollow = |of: &Touch| match of.bend < 0.0 {
                true => -1.0 / of.bend - roller,
                false => f64::INFINITY,
            };
            found = lesser(found, self.least(&hollow, false)?);
        }
        Ok(found)
    }

    /// The least value over a turn and its angle, also between and on both sides of the ends of pieces.
    fn least(&self, of: &dyn Fn(&Touch) -> f64, second: bool) -> Result<(f64, f64), Refused> {
        let samples = self.programme.sampled(STEP);
        let mut best = (f64::INFINITY, 0);
        for (k, (_, angle, rows)) in samples.iter().enumerate() {
            let value = of(&self.touch(*angle, *rows, second)?);
            if value < best.0 {
                best = (value, k);
            }
        }
        let (piece, angle, _) = &samples[best.1];
        let beside = |k: usize| samples.get(k).filter(|one| std::ptr::eq(one.0, *piece));
        let low = beside(best.1.wrapping_sub(1)).map_or(*angle, |one| one.1);
        let high = beside(best.1 + 1).map_or(*angle, |one| one.1);
        let value = |angle: f64| {
            let found = self.touch(angle, Piece::rows(piece, angle), second);
            found.map_or(f64::INFINITY, |touch| of(&touch))
        };
        Ok(lesser((best.0, *angle), least_between(value, low, high)))
    }

    /// Intervals of the angle, rad, in which a profile is undercut. There the roller, or the face, does not touch the curve
    /// that it envelops: the profile cannot be made, or does not move the follower as asked.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn undercut(&self) -> Result<Vec<(f64, f64)>, Refused> {
        let (angles, roller) = (self.angles(), self.follower.roller);
        let mut bad = vec![false; angles.len()];
        let mut least = (f64::INFINITY, 0);
        for second in self.sides() {
            let all = self.over(&angles, *second)?;
            let pitch = curve(&all, |of| of.pitch);
            let crossed = |at: Complex| {
                let near = roller * (1.0 - CROSSED);
                let square = |z: Complex| z.re * z.re + z.im * z.im;
                self.rolls() && pitch.iter().any(|center| square(*center - at) < near * near)
            };
            let groove = self.closure == Closure::Groove;
            for (k, of) in all.iter().enumerate() {
                if of.room < least.0 && !second {
                    least = (of.room, k);
                }
                let hollow =
                    groove && (1.0 + roller * of.bend <= 0.0 || crossed(of.beside(2.0 * roller)));
                bad[k] |= of.room <= 0.0 || of.room.is_nan() || hollow || crossed(of.profile);
            }
        }
        if !bad.contains(&true) && self.least_radius_of_curvature()?.0 <= 0.0 {
            bad[least.1] = true; // between two angles
        }
        Ok(intervals(&angles, &bad))
    }

    /// Speed at which the follower leaves the cam, rad/s: where the normal force falls to zero.
    ///
    /// Infinite with a groove or a conjugate cam, and where nothing decelerates the follower; 0 if it is not pressed onto
    /// the cam even at rest.
    pub fn lift_off_speed(&self) -> f64 {
        if self.closure != Closure::Force {
            return f64::INFINITY;
        }
        let inertia = self.drive.mass * self.follower.arm.map_or(1.0, |arm| arm * arm / 3.0);
        let mut square = f64::INFINITY;
        for (_, _, [s, _, slowed, _]) in self.programme.sampled(FINE) {
            let press = self.pressing(s);
            if press <= 0.0 {
                return 0.0;
            }
            if slowed < 0.0 && inertia > 0.0 {
                square = square.min(press / (-slowed * inertia));
            }
        }
        square.sqrt()
    }

    /// Force, or torque about the pivot, of spring and weight towards the cam at rest.
    fn pressing(&self, s: f64) -> f64 {
        let ([stiffness, force], of) = (self.drive.spring, &self.follower);
        let lever = of.arm.map_or(1.0, |arm| of.sense() * arm / 2.0 * of.direction(s).cos());
        stiffness * s + force + self.drive.mass * self.drive.gravity * lever
    }
}

/// The lesser of two values with their angles.
fn lesser(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    if b.0 < a.0 {
        b
    } else {
        a
    }
}

/// The least value between two places by the golden section, and its place.
fn least_between(of: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    let golden = (5.0f64.sqrt() - 1.0) / 2.0;
    let at = |x: f64| (of(x), x);
    let (mut a, mut b) = (at(high - golden * (high - low)), at(low + golden * (high - low)));
    while high - low > NARROW {
        if a.0 < b.0 {
            (high, b) = (b.1, a);
            a = at(high - golden * (high - low));
        } else {
            (low, a) = (a.1, b);
            b = at(low + golden * (high - low));
        }
    }
    lesser(a, b)
}

/// The intervals of angles that are bad.
fn intervals(angles: &[f64], bad: &[bool]) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64)> = Vec::new();
    let mut within = false;
    for (angle, bad) in angles.iter().zip(bad) {
        match found.last_mut() {
            Some(last) if within && *bad => last.1 = *angle,
            _ if *bad => found.push((*angle, *angle)),
            _ => (),
        }
        within = *bad;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{intervals, least_between};

    #[test]
    fn the_least_value_of_a_parabola_is_at_its_vertex() {
        let (value, at) = least_between(|x| (x - 0.3) * (x - 0.3) + 2.0, 0.0, 1.0);
        assert!((value - 2.0).abs() < 1e-15 && (at - 0.3).abs() < 1e-7);
    }

    #[test]
    fn neighbours_that_are_bad_are_one_interval() {
        let bad = [true, true, false, true, false];
        assert_eq!(intervals(&[0.0, 1.0, 2.0, 3.0, 4.0], &bad), [(0.0, 1.0), (3.0, 3.0)]);
    }
}
