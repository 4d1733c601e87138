//! The catalogue of a case with the equations of joints and drivers, as JSON.

use crate::formulas::declared;
use kempe::elements::Group;

/// The allowed content of a case by section, with the equations of joints and drivers.
pub fn all() -> String {
    let mut sections = kempe::case::catalogue();
    for group in [Group::Joints, Group::Drivers] {
        for element in sections[group.section()].as_array_mut().into_iter().flatten() {
            let name = element["name"].as_str().unwrap_or_default().to_string();
            let formulas = declared(group, &name);
            if !formulas.is_null() {
                element["formulas"] = formulas; // joints that act as forces have none
            }
        }
    }
    sections.to_string()
}
