//! The display list of a scene.
//!
//! Symbols follow from the marks that the elements declare. Names are laid out once for the whole motion, and names
//! of coincident objects form one text.

use super::items::Item;
use super::layout::lay_out;
use super::list::{List, Name, Numbers};
use super::placing::View;
use super::{dimensions, gravity, mechanism, names, numbered};
use crate::plane::Pose;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// The content of a display list.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Request {
    /// Bodies, the symbols of all elements, supports, and points without a symbol.
    pub mechanism: bool,
    /// Further items, drawn on top of the mechanism.
    pub items: Vec<Item>,
    /// A dimension line for each bar, and between two pins on ground.
    pub dimensions: bool,
    /// An arrow in the corner with the most free space.
    pub gravity: bool,
    /// A number in a circle on each body.
    pub numbers: Option<Numbers>,
    /// The names of joints and contacts, one text for each place, and of free points.
    pub joints: bool,
    /// The names of forces and drivers beside their symbols.
    pub elements: bool,
    /// Further names.
    pub names: Vec<Name>,
    /// Boxes that names must not cover, points of print: smallest x and y, largest x and y.
    pub taken: Vec<[f64; 4]>,
}

impl Request {
    /// The mechanism with the numbers and names of the page.
    pub fn labelled() -> Self {
        let numbers = Some(Numbers { first: 1, names: false });
        Self { mechanism: true, numbers, joints: true, elements: true, ..Self::default() }
    }
}

/// The display list of a scene, in the order of painting.
///
/// `poses` are the poses of the moving bodies at one or more instants of a motion. Names are laid out for all
/// instants. Their positions do not depend on the order of the instants, but dimensions are taken at the first
/// instant.
pub fn display(scene: &Scene, poses: &[Vec<Pose>], view: &View, request: &Request) -> Vec<Item> {
    let mut made = List::new(scene, poses, view, &request.taken);
    if request.mechanism {
        mechanism::draw(&mut made);
    }
    made.items.extend(request.items.iter().cloned());
    if request.dimensions {
        dimensions::add(&mut made);
    }
    if request.gravity {
        gravity::add(&mut made);
    }
    if let Some(numbers) = request.numbers {
        numbered::add(&mut made, numbers);
    }
    if request.joints {
        names::add_joints(&mut made);
    }
    if request.elements {
        names::add_elements(&mut made);
    }
    made.names.extend(request.names.iter().cloned());
    lay_out(&mut made);
    let mut items = made.items;
    items.sort_by_key(|item| item.layer);
    items
}
