//! What is wrong or doubtful about a cam, with remedies.

use super::curves::Cam;
use super::follower::End;
use super::words::{degrees, short};
use crate::conditions::Refused;
use std::f64::consts::PI;

/// Recommended largest pressure angles of translating and oscillating followers, rad (Norton).
const STEEP: [f64; 2] = [PI / 6.0, 35.0 * PI / 180.0];

impl Cam {
    /// The recommended largest pressure angle, rad.
    pub fn recommended_pressure_angle(&self) -> f64 {
        STEEP[usize::from(self.programme.angular)]
    }

    /// Undercut, steep pressure angles, jumps of the acceleration, lift below the base circle.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn remarks(&self) -> Result<Vec<String>, Refused> {
        let mut found = Vec::new();
        let undercut = self.undercut()?;
        if !undercut.is_empty() {
            let part = |(a, b): &(f64, f64)| format!("{}° to {}°", degrees(*a, 4), degrees(*b, 4));
            let parts: Vec<String> = undercut.iter().map(part).collect();
            let remedies = self.remedies().told();
            found.push(format!("the profile is undercut from {}: {remedies}", parts.join(", ")));
        }
        let (largest, steep) =
            (self.largest_pressure_angle()?.0, self.recommended_pressure_angle());
        if largest > steep {
            let [largest, steep] = [largest, steep].map(|angle| degrees(angle, 3));
            found.push(format!(
                "pressure angle up to {largest}°, recommended at most {steep}°: take a larger base radius, see \
                 least_base_radius"
            ));
        }
        found.extend(self.doubts()?);
        Ok(found)
    }

    /// The remarks without those on undercut and pressure angle.
    ///
    /// # Errors
    /// A flat face turns as fast as the cam.
    pub fn doubts(&self) -> Result<Vec<String>, Refused> {
        let (of, unit) = (&self.follower, self.programme.unit());
        let mut found = Vec::new();
        if of.roller > of.base {
            let [roller, base] = [of.roller, of.base].map(|x| short(x, 6));
            found.push(format!(
                "the roller of {roller} m is larger than the base circle of {base} m: take a smaller roller_radius or a \
                 larger base_radius"
            ));
        }
        if let (End::Flat, Some(arm)) = (of.kind, of.arm) {
            let touched = self.over(&self.angles(), false)?;
            let far = touched.iter().map(|one| one.contact).fold(0.0, f64::max);
            if far > arm {
                let (far, arm) = (short(far, 4), short(arm, 6));
                let told = format!("the face touches up to {far} m from the pivot, beyond its arm");
                found.push(format!("{told} of {arm} m: lengthen the arm"));
            }
        }
        for (angle, jump) in &self.programme.jumps {
            let (jump, at) = (short(*jump, 4), degrees(*angle, 4));
            let hint = "a law such as 'cycloidal' or 'poly345' has no jump";
            found.push(format!("the acceleration jumps by {jump} {unit}/rad² at {at}°: {hint}"));
        }
        if self.programme.least < -super::programme::SAME * self.programme.size {
            let least = short(self.programme.least, 4);
            let hint = "change the speeds at the ends of a segment";
            found.push(format!("the lift falls to {least} {unit}, below the base circle: {hint}"));
        }
        Ok(found)
    }
}
