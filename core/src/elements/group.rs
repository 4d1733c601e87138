//! The sections of elements in a model file.

/// The section of an element in a model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// `[joints.…]`
    Joints,
    /// `[drivers.…]`
    Drivers,
    /// `[forces.…]`
    Forces,
}

impl Group {
    /// The section's name in the file.
    pub fn section(self) -> &'static str {
        ["joints", "drivers", "forces"][self as usize]
    }
    /// The name of one entry of the section.
    pub fn singular(self) -> &'static str {
        ["joint", "driver", "force"][self as usize]
    }
}
