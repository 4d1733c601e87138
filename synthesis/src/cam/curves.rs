//! A cam with its follower: geometry over its angle.

use super::follower::{positive, refuse, End, Follower};
use super::programme::{Programme, STEP};
use super::shape::{touch, Touch};
use super::words::short;
use crate::conditions::Refused;
use kempe::math::Complex;

/// The least steps of the angle, beside ends of pieces, where derivatives jump, and the growth of the steps with the
/// distance from these. Larger steps in dwells are worse: the parameter of a spline through points is their chord length.
const FINE: f64 = 3e-5;
const GROWTH: f64 = 0.25;

/// What holds the follower on the cam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closure {
    /// A spring or the weight.
    Force,
    /// A second wall.
    Groove,
    /// A second cam on the shaft.
    Conjugate,
}

impl Closure {
    /// Names in the order of the kinds.
    pub const NAMES: [&'static str; 3] = ["force", "groove", "conjugate"];

    /// The kind with a name.
    pub fn named(name: &str) -> Option<Self> {
        let all = [Self::Force, Self::Groove, Self::Conjugate];
        all.into_iter().find(|one| Self::NAMES[*one as usize] == name)
    }
}

/// What moves and presses the follower.
#[derive(Clone, Copy, Debug)]
pub struct Drive {
    /// Speed of the cam, rad/s, > 0.
    pub speed: f64,
    /// Mass of the follower, kg; an oscillating one is a uniform bar.
    pub mass: f64,
    /// Stiffness and force, or torque, of a spring at no lift; N/m and N, or N·m/rad and N·m.
    pub spring: [f64; 2],
    /// Downwards, m/s².
    pub gravity: f64,
}

/// A cam with its follower.
#[derive(Clone, Debug)]
pub struct Cam {
    /// The lift over the angle of the cam.
    pub programme: Programme,
    /// The follower beside a cam that turns counter-clockwise; of one that turns clockwise, the mirror image.
    pub follower: Follower,
    /// Whether the cam turns clockwise.
    pub clockwise: bool,
    /// What holds the follower on the cam.
    pub closure: Closure,
    /// What moves and presses the follower.
    pub drive: Drive,
}

/// A name and a closed curve.
pub type Layer = (&'static str, Vec<Complex>);

impl Cam {
    /// Refuse dimensions that are none, or do not assemble.
    ///
    /// # Errors
    /// The dimension at fault.
    pub fn check(&self) -> Result<(), Refused> {
        let Drive { speed, mass, spring, .. } = self.drive;
        self.follower.check_dimensions(self.closure == Closure::Groove)?;
        self.follower.check(self.programme.size)?;
        let turns = "must be > 0; direction='cw' turns the other way";
        let pushes = "the stiffness must not be negative";
        refuse(&[
            (positive(speed), "speed", Some((speed, " rad/s")), turns),
            (mass >= 0.0, "mass", Some((mass, " kg")), "must not be negative"),
            (spring[0] >= 0.0, "spring", Some((spring[0], "")), pushes),
        ])?;
        self.at(0.0, false).map(|_| ())
    }

    /// Angles of the cam from 0 to below 2π: dense where derivatives jump.
    pub fn angles(&self) -> Vec<f64> {
        let mut made = Vec::new();
        for piece in &self.programme.pieces {
            let half = (piece.end - piece.start) / 2.0;
            let (mut steps, mut place) = (vec![0.0], 0.0);
            while place < half {
                place += f64::min(FINE + GROWTH * place, STEP);
                steps.push(place);
            }
            let side: Vec<f64> = steps.iter().map(|step| step * half / place).collect();
            made.extend(side[..side.len() - 1].iter().map(|x| piece.start + x));
            made.extend(side[1..].iter().rev().map(|x| piece.end - x));
        }
        made.sort_by(f64::total_cmp);
        made.dedup();
        made
    }

    /// The cam, or its conjugate, at any angle.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn at(&self, angle: f64, second: bool) -> Result<Touch, Refused> {
        self.touch(angle, self.programme.rows(angle), second)
    }

    /// The cam, or its conjugate, at an angle with a lift and its derivatives.
    pub(super) fn touch(&self, angle: f64, rows: [f64; 4], second: bool) -> Result<Touch, Refused> {
        let found = if second {
            let [s, first, next, third] = rows;
            let of = Follower { opposite: true, ..self.follower.clone() };
            touch(&of, angle, [self.programme.size - s, -first, -next, -third])?
        } else {
            touch(&self.follower, angle, rows)?
        };
        let translating = self.follower.arm.is_none();
        Ok(if self.clockwise { found.mirrored(translating) } else { found })
    }

    /// The cam, or its conjugate, at angles.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn over(&self, angles: &[f64], second: bool) -> Result<Vec<Touch>, Refused> {
        angles.iter().map(|angle| self.at(*angle, second)).collect()
    }

    /// The cam, and its conjugate if there is one.
    pub(super) fn sides(&self) -> &'static [bool] {
        match self.closure {
            Closure::Conjugate => &[false, true],
            _ => &[false],
        }
    }

    /// The profiles that are cut: `cam`, and the outer wall of a groove or the conjugate cam.
    ///
    /// # Errors
    /// A profile is undercut.
    pub fn walls(&self, angles: &[f64]) -> Result<Vec<Layer>, Refused> {
        self.refuse_undercut()?;
        let first = self.over(angles, false)?;
        let mut found = vec![("cam", curve(&first, |of| of.profile))];
        match self.closure {
            Closure::Force => (),
            Closure::Groove => {
                let wide = 2.0 * self.follower.roller;
                found.push(("outer", curve(&first, |of| of.beside(wide))));
            }
            Closure::Conjugate => {
                found.push(("conjugate", curve(&self.over(angles, true)?, |of| of.profile)));
            }
        }
        Ok(found)
    }

    /// Paths of the centre of a cutter at angles: outside of the profiles, or inside a groove.
    ///
    /// # Errors
    /// A profile is undercut, or the cutter does not fit.
    pub fn cutter(&self, angles: &[f64], radius: f64) -> Result<Vec<Layer>, Refused> {
        let refused = |told: String, hint: &str| {
            let told = format!("cutter_radius: {} m; {told}", short(radius, 6));
            Err(Refused::new(told, hint))
        };
        if !positive(radius) {
            return refused("must be > 0".into(), "");
        }
        self.refuse_undercut()?;
        let (roller, first) = (self.follower.roller, self.over(angles, false)?);
        let mut found = vec![("cutter", curve(&first, |of| of.beside(radius)))];
        if self.closure == Closure::Groove {
            if radius > roller * (1.0 + 1e-12) {
                let most = short(roller, 6);
                let told = format!("the groove is as wide as the roller: at most {most} m");
                return refused(told, "");
            }
            if radius < roller {
                let far = 2.0 * roller - radius;
                found.push(("cutter_outer", curve(&first, |of| of.beside(far))));
            }
            return Ok(found);
        }
        let grid = self.angles();
        for second in self.sides() {
            let radii = self.over(&grid, *second)?.into_iter().map(|of| -of.radius);
            let hollow = radii.filter(|hollow| *hollow > 0.0).fold(f64::INFINITY, f64::min);
            if radius >= hollow {
                let hollow = short(hollow, 6);
                let told =
                    format!("the profile has a hollow of radius {hollow} m: take a smaller cutter");
                return refused(told, "");
            }
        }
        if self.closure == Closure::Conjugate {
            let second = self.over(angles, true)?;
            found.push(("cutter_conjugate", curve(&second, |of| of.beside(radius))));
        }
        Ok(found)
    }

    /// Radius of the bore for the shaft in drawings, m.
    pub fn bore(&self) -> f64 {
        self.follower.base / 5.0
    }

    /// Whether it is a roller on a pitch curve.
    pub(super) fn rolls(&self) -> bool {
        self.follower.kind == End::Roller
    }
}

/// A place at each angle.
pub(super) fn curve(of: &[Touch], place: impl Fn(&Touch) -> Complex) -> Vec<Complex> {
    of.iter().map(place).collect()
}
