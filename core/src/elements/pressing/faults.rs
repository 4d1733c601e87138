//! Fields of a contact with impossible values.

use super::Pressing;

impl Pressing<'_, f64> {
    /// A field of the law of the contact with an impossible value.
    pub(super) fn fault(&self) -> Option<(&'static str, String)> {
        let refuse = |field, message: &str| Some((field, message.to_string()));
        let most = self.r#static.unwrap_or(self.friction);
        let sticks = self.velocity.is_none() && most > 0.0;
        match self.velocity {
            _ if sticks && self.compliance.law.keeps_speed() => {
                let message = "friction that sticks needs law = \"hunt_crossley\" or \"hertz\"; or give velocity, such as 0.01";
                refuse("friction", message)
            }
            _ if self.wear < 0.0 => refuse("wear", "must not be negative"),
            _ if self.wear > 0.0 && self.restitution.is_some() => {
                let message = "the load of a contact with restitution is known after the motion only; give stiffness, or \
                               law = \"hertz\", in its place";
                refuse("wear", message)
            }
            _ if self.friction < 0.0 => refuse("friction", "must not be negative"),
            _ if most < self.friction => refuse("static", "must not be below friction"),
            None if most > 0.0 && !self.curve.is_closed_form() => {
                let message = "friction that sticks acts on lines and circles; on another curve give velocity, such as \
                               0.01, and stiffness";
                refuse("friction", message)
            }
            Some(velocity) if velocity <= 0.0 => refuse("velocity", "must be positive"),
            Some(_) if self.restitution.is_some() => {
                refuse("velocity", "not together with restitution; remove it")
            }
            Some(_) if self.r#static.is_some() => {
                refuse("static", "belongs to friction that sticks; remove velocity")
            }
            _ => None,
        }
    }

    /// A field of the normal force with an impossible value.
    pub(super) fn fault_of_law(&self) -> Option<(&'static str, String)> {
        let apart = Some(self.touch().pitch()).filter(|_| self.radius != 0.0);
        self.compliance.fault(apart, self.rest_speed)
    }
}
