//! A display list in the making.

use super::items::{Frame, Item};
use super::placing::{place, View};
use super::text::{one_line, Role};
use crate::plane::{placed, At, Extent, Pose};
use crate::scene::{Scene, Symbol};
use serde::{Deserialize, Serialize};

/// Instants at which names are kept clear of everything.
const SAMPLES: usize = 12;
/// Places no farther apart than this share of the drawing at any instant are one place.
const SAME: f64 = 1e-3;

/// How bodies are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// Number of the first moving body.
    pub first: i64,
    /// Whether names are written beside the numbers.
    pub names: bool,
}

/// A name without a place yet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Name {
    /// What it belongs to.
    pub of: String,
    /// The text.
    pub words: String,
    /// What it names.
    pub role: Role,
    /// It is near the origin of this frame, or half-way along it.
    pub frame: Frame,
}

impl Name {
    /// A name on one line.
    pub fn new(role: Role, words: &str, frame: Frame) -> Self {
        Self { of: words.to_string(), words: one_line(words), role, frame }
    }
}

/// A display list in the making.
pub struct List<'a> {
    /// What is drawn.
    pub scene: &'a Scene,
    /// For which scale and edges names are laid out.
    pub view: &'a View,
    /// Of all bodies, ground first, at some instants.
    pub poses: Vec<Vec<Pose>>,
    /// Paths that are always so near are one place, m.
    pub near: f64,
    /// So far.
    pub items: Vec<Item>,
    /// So far.
    pub names: Vec<Name>,
    /// Boxes that names must not cover.
    pub boxes: &'a [[f64; 4]],
}

impl<'a> List<'a> {
    /// Nothing so far.
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

    /// Where a point of a body is at the instants, m.
    pub fn path(&self, body: usize, at: At) -> Vec<At> {
        let pose = |poses: &Vec<Pose>| poses.get(body).copied().unwrap_or_default();
        self.poses.iter().map(|poses| placed(pose(poses), at)).collect()
    }

    /// Where the points of a symbol are at the instants.
    pub fn ends(&self, symbol: &Symbol) -> Vec<Vec<At>> {
        symbol.ends().map(|(body, at)| self.path(body, at)).collect()
    }

    /// Where the point of a symbol on body j is at the instants.
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

/// Some instants, evenly spread, with ground. What is not finite is zero.
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
