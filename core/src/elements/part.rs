//! The named parts of a force.

/// The entry of the energy balance for the work of a part of a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// The potential energy of the element.
    Conservative,
    /// Dissipated energy.
    Dissipative,
    /// Work from outside.
    Applied,
    /// An exchange between the bodies and the states of the element. The [own powers](super::Force::own_powers) of the
    /// element are counted instead.
    Exchanged,
}

impl Nature {
    /// The nature of a part with a law of time or state, which has no potential.
    #[inline]
    pub fn under_law(self) -> Self {
        match self {
            Self::Conservative => Self::Applied,
            other => other,
        }
    }
}

/// A named part of a force, such as `stiffness`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Name: `sol["spring"].stiffness_torque(…)`.
    pub name: &'static str,
    /// The entry of its work in the energy balance while the parameters are constant.
    pub nature: Nature,
}
