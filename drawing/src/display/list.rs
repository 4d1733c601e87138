//! A display list under construction.

use super::items::{Frame, Item};
use super::placing::{place, View};
use super::text::{one_line, Role};
use crate::plane::{placed, At, Extent, Pose};
use crate::scene::{Scene, Symbol};
use serde::{Deserialize, Serialize};

/// Number of instants at which the positions of names are checked.
const SAMPLES: usize = 12;
/// Paths of points that are always closer than this fraction of the drawing are one place.
const SAME: f64 = 1e-3;

/// How bodies are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// Number of the first moving body.
    pub first: i64,
    /// Whether names are written beside the numbers.
    pub names: bool,
}

/// A name without a position yet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Name {
    /// The object to which the name belongs.
    pub of: String,
    /// The text.
    pub words: String,
    /// The kind of object that the text names.
    pub role: Role,
    /// The frame of the name, which is near its origin or half-way along it.
    pub frame: Frame,
}

impl Name {
    /// A name on one line.
    pub fn new(role: Role, words: &str, frame: Frame) -> Self {
        Self { of: words.to_string(), words: one_line(words), role, frame }
    }
}

/// A display list under construction.
pub struct List<'a> {
    /// The scene that is drawn.
    pub scene: &'a Scene,
    /// The scale and the edges for which names are laid out.
    pub view: &'a View,
    /// Poses of all bodies, ground first, at some instants.
    pub poses: Vec<Vec<Pose>>,
    /// Paths that are always closer than this distance are one place, m.
    pub near: f64,
    /// The items so far.
    pub items: Vec<Item>,
    /// The names so far.
    pub names: Vec<Name>,
    /// Boxes that names must not cover.
    pub boxes: &'a [[f64; 4]],
}

impl<'a> List<'a> {
    /// A list without items.
    pub fn new(
        scene: &'a Scene,
        poses: &[Vec<Pose>],
        view: &'a View,
        boxes: &'a [[f64; 4]],
    ) -> Self {
        let [left, bottom, right, top] = scene.bounds;
        let size = Extent { low: [left, bottom], high: [right, top] }.size();
        let near = SAME * if size > 0.0 { size } else { 1.0 };
        let poses = some(poses, scene.bodies.len());
        Self { scene, view, poses, near, items: Vec::new(), names: Vec::new(), boxes }
    }

    /// The positions of a point of a body at the instants, m.
    pub fn path(&self, body: usize, at: At) -> Vec<At> {
        let pose = |poses: &Vec<Pose>| poses.get(body).copied().unwrap_or_default();
        self.poses.iter().map(|poses| placed(pose(poses), at)).collect()
    }

    /// The positions of the points of a symbol at the instants.
    pub fn ends(&self, symbol: &Symbol) -> Vec<Vec<At>> {
        symbol.ends().map(|(body, at)| self.path(body, at)).collect()
    }

    /// The positions of the point of a symbol on body j at the instants.
    pub fn last_end(&self, symbol: &Symbol) -> Vec<At> {
        self.path(symbol.bodies[1], symbol.at_j())
    }

    /// The points of an item at the instants, points of print.
    pub fn placed(&self, item: &Item) -> Vec<Vec<At>> {
        self.poses.iter().map(|poses| place(item, poses, self.view)).collect()
    }

    /// Adds a name.
    pub fn name(&mut self, role: Role, words: &str, frame: Frame) {
        self.names.push(Name::new(role, words, frame));
    }
}

/// Some evenly spaced instants, including ground. Numbers that are not finite become zero.
fn some(poses: &[Vec<Pose>], bodies: usize) -> Vec<Vec<Pose>> {
    let last = poses.len().saturating_sub(1) as f64;
    let mut chosen: Vec<usize> = (0..SAMPLES)
        .map(|k| (last * k as f64 / (SAMPLES - 1) as f64).round_ties_even() as usize)
        .collect();
    chosen.dedup();
    let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
    let at = |k: usize| {
        let moving = poses.get(k).into_iter().flatten().map(|pose| pose.map(finite));
        let mut all: Vec<Pose> = std::iter::once([0.0; 3]).chain(moving).collect();
        all.resize(bodies.max(1), [0.0; 3]);
        all
    };
    chosen.into_iter().map(at).collect()
}
