//! The geometry of a cam and its follower: envelopes in the plane, as complex numbers.
//!
//! The cam turns counter-clockwise about the origin; a cam that turns clockwise is the mirror image. At the angle φ of
//! the cam, z in the ground frame is z e^{-iφ} in the frame of the cam. Curves of roller and knife followers are those
//! of the roller's centre, the pitch curve; a flat face is a line with the support h along its normal e^{iν}, and its
//! envelope is (h + i dh/dν) e^{iν} with the radius of curvature h + d²h/dν².

use super::follower::{End, Follower};
use crate::conditions::Refused;
use crate::plane::{abs, angle, conjugate, cross, scaled, turn};
use kempe::math::Complex;
use std::f64::consts::FRAC_PI_2;

const I: Complex = Complex::new(0.0, 1.0);

/// A cam at an angle, in its frame.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// The centre of the roller, or the contact of a flat face.
    pub pitch: Complex,
    /// Unit normal out of the cam at the contact.
    pub normal: Complex,
    /// The contact.
    pub profile: Complex,
    /// Curvature of the pitch curve, positive where convex, 1/m; of a flat face 0.
    pub bend: f64,
    /// 1 - roller × bend, or the radius of curvature over the base radius of a flat face; the profile is undercut where
    /// it is not positive.
    pub room: f64,
    /// Radius of curvature of the profile, m, positive where convex.
    pub radius: f64,
    /// Angle from the velocity of the follower to the normal, rad.
    pub pressure: f64,
    /// Place of the contact along a flat face, from the line of travel to the right or from the pivot, m.
    pub contact: f64,
}

impl Touch {
    /// The place at a distance outside of the profile.
    pub fn beside(&self, distance: f64) -> Complex {
        self.profile + scaled(self.normal, distance)
    }

    /// With all places and directions changed.
    fn each(self, of: impl Fn(Complex) -> Complex) -> Self {
        let [pitch, normal, profile] = [self.pitch, self.normal, self.profile].map(of);
        Self { pitch, normal, profile, ..self }
    }

    /// The mirror image about the y axis.
    pub(super) fn mirrored(self, translating: bool) -> Self {
        let contact = if translating { -self.contact } else { self.contact };
        Self { contact, ..self.each(|z| -conjugate(z)) }
    }
}

/// The cam of a follower at an angle, with the lift and three derivatives there.
///
/// # Errors
/// A flat face turns as fast as the cam.
pub fn touch(of: &Follower, at: f64, rows: [f64; 4]) -> Result<Touch, Refused> {
    let made = if of.kind == End::Flat { flat } else { round };
    if of.opposite && of.arm.is_none() {
        // the picture turned by 180°
        let found = made(&Follower { offset: -of.offset, ..of.clone() }, at, rows)?;
        return Ok(found.each(|z| -z));
    }
    made(of, at, rows)
}

/// The envelope of a circle around the end of the follower.
fn round(of: &Follower, angle_of: f64, [s, first, second, _]: [f64; 4]) -> Result<Touch, Refused> {
    let (at, rate, bend, velocity) = match of.arm {
        None => {
            let at = Complex::new(of.offset, of.start() + s);
            (at, scaled(I, first), scaled(I, second), I)
        }
        Some(length) => {
            let (way, lever) = (turn(of.direction(s)), of.sense());
            let (arm, turned) = (scaled(way, length), scaled(I, lever));
            let rate = scaled(turned * arm, first);
            (
                of.pivot + arm,
                rate,
                scaled(turned * arm, second) - scaled(arm, first * first),
                turned * way,
            )
        }
    };
    let tangent = rate - I * at; // of the pitch curve in the frame of the cam, times e^{iφ}
    let change = bend - scaled(I * rate, 2.0) - at;
    let speed = abs(tangent);
    let out = scaled(I * tangent, 1.0 / speed);
    let curved = -cross(tangent, change) / (speed * speed * speed);
    let room = 1.0 - of.roller * curved;
    let back = turn(-angle_of);
    let (pitch, normal) = (at * back, out * back);
    Ok(Touch {
        pitch,
        normal,
        profile: pitch - scaled(normal, of.roller),
        bend: curved,
        room,
        radius: room / curved,
        pressure: angle(out * conjugate(velocity)),
        contact: 0.0,
    })
}

/// The envelope of a line.
fn flat(of: &Follower, angle_of: f64, [s, first, second, _]: [f64; 4]) -> Result<Touch, Refused> {
    let ([support, slope, bend], [rate, faster], facing) = match of.arm {
        None => ([of.base + s, first, second], [-1.0, 0.0], FRAC_PI_2),
        Some(_) => {
            let (far, lever) = (abs(of.pivot), of.sense());
            let (sine, cosine) = (of.start() + s).sin_cos();
            let bend = far * (cosine * second - sine * first * first);
            let rates = [lever * first - 1.0, lever * second];
            let facing = of.direction(s) + lever * FRAC_PI_2;
            ([far * sine - of.face, far * cosine * first, bend], rates, facing)
        }
    };
    if rate >= 0.0 {
        let told = "programme: the follower turns as fast as the cam, so that the face would touch everywhere";
        return Err(Refused::new(told.into(), "lessen the lift, or lengthen its segment"));
    }
    let moved = slope / rate;
    let radius = support + (bend - moved * faster) / (rate * rate);
    let out = turn(facing);
    let contact = Complex::new(support, moved) * out;
    let (velocity, place) = match of.arm {
        None => (I, contact.re - of.offset),
        Some(_) => {
            let arm = contact - of.pivot;
            let far = abs(arm);
            let along = (far * far - of.face * of.face).max(0.0).sqrt();
            (scaled(I * arm, of.sense() / far), along)
        }
    };
    let back = turn(-angle_of);
    let profile = contact * back;
    Ok(Touch {
        pitch: profile,
        normal: out * back,
        profile,
        bend: 0.0,
        room: radius / of.base,
        radius,
        pressure: angle(out * conjugate(velocity)),
        contact: place,
    })
}
