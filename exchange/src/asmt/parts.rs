//! Parts and markers of an assembly, and their place in the plane.

use super::tree::{short, Node};
use crate::draft::{Draft, Table};
use crate::space::{
    axis, cross, dot, minus, plus, product, times, turned, unit, Plane, Rotation, Vector, UNTURNED,
};
use crate::unread::UnreadList;
use serde_json::json;
use std::collections::HashMap;

/// A frame in a part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) place: Vector,
    pub(super) turn: Rotation,
}

impl Frame {
    /// The frame `inner`, which is given in this one, in the frame around this one.
    pub(super) fn of(&self, inner: &Self) -> Self {
        let place = plus(self.place, turned(&self.turn, inner.place));
        Self { place, turn: product(&self.turn, &inner.turn) }
    }
}

/// A rigid part; the first of an assembly is the assembly itself, which does not move.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) line: usize,
    /// The name in the file, and in the case.
    pub(super) path: String,
    pub(super) name: String,
    pub(super) frame: Frame,
    velocity: Vector,
    omega: Vector,
    mass: f64,
    inertias: Vector,
    center: Frame,
    /// The axis of the part that becomes the x axis of the body.
    pub(super) along: Vector,
    /// The angle of that axis at the start.
    pub(super) angle: f64,
}

/// A marker: its part and its frame in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Marker {
    pub(super) part: usize,
    pub(super) frame: Frame,
}

/// All parts and markers of an assembly.
#[derive(Debug, Default)]
pub(super) struct Parts {
    pub(super) all: Vec<Part>,
    pub(super) markers: HashMap<String, Marker>,
}

type Fault = (usize, String);

/// Three numbers below a name.
fn vector(node: &Node<'_>, name: &str, absent: Vector) -> Result<Vector, Fault> {
    match node.numbers(name)?.as_deref() {
        None => Ok(absent),
        Some(&[x, y, z]) => Ok([x, y, z]),
        Some(other) => Err((node.line, format!("{name}: {} numbers; must be 3", other.len()))),
    }
}

/// Position and rotation of a node.
fn frame(node: &Node<'_>) -> Result<Frame, Fault> {
    let place = vector(node, "Position3D", [0.0; 3])?;
    let numbers = node.numbers("RotationMatrix")?;
    let turn = match numbers.as_deref() {
        None => UNTURNED,
        Some(&[a, b, c, d, e, f, g, h, i]) => [[a, b, c], [d, e, f], [g, h, i]],
        Some(other) => {
            return Err((node.line, format!("RotationMatrix: {} numbers; must be 9", other.len())))
        }
    };
    let turn = straight(turn).ok_or_else(|| {
        (node.line, "RotationMatrix: its rows are not perpendicular unit vectors".to_string())
    })?;
    Ok(Frame { place, turn })
}

/// The nearest rotation; files have matrices with an error of some 1e-6.
fn straight(turn: Rotation) -> Option<Rotation> {
    let x = unit(turn[0])?;
    let y = unit(minus(turn[1], times(dot(turn[1], x), x)))?;
    let exact = [x, y, cross(x, y)];
    let near = |k: usize| minus(turn[k], exact[k]).iter().all(|error| error.abs() < 1e-3);
    (0..3).all(near).then_some(exact)
}

impl Parts {
    /// Adds the assembly, which does not move, and its parts.
    pub(super) fn read(assembly: &Node<'_>, unread: &mut UnreadList) -> Self {
        let mut parts = Self::default();
        parts.add(assembly, "", unread);
        let path = parts.all.first().map(|part| part.path.clone()).unwrap_or_default();
        if let Some(of_assembly) = parts.all.first() {
            let turned = of_assembly.frame.turn != UNTURNED;
            if turned || of_assembly.frame.place != [0.0; 3] {
                unread.lost(
                    assembly.line,
                    "an assembly that is not placed at the origin is not supported",
                );
            }
        }
        for node in assembly.get("Parts").map(|list| &list.inside[..]).unwrap_or_default() {
            if node.text == "Part" {
                parts.add(node.take(), &path, unread);
            }
        }
        parts
    }

    fn add(&mut self, node: &Node<'_>, within: &str, unread: &mut UnreadList) {
        let part = match Part::read(node, within) {
            Ok(part) => part,
            Err((line, what)) => {
                node.take_all();
                return unread.lost(line, what);
            }
        };
        let (index, path) = (self.all.len(), part.path.clone());
        if self.markers.contains_key(&format!("{path}/MassMarker")) {
            unread.lost(node.line, format!("there is another part {}", short(&path)));
        }
        self.markers
            .insert(format!("{path}/MassMarker"), Marker { part: index, frame: part.center });
        self.all.push(part);
        for point in node.get("RefPoints").map(|list| &list.inside[..]).unwrap_or_default() {
            if point.text != "RefPoint" {
                continue;
            }
            let Some(base) = told(frame(point.take()), unread) else { continue };
            for marker in point.get("Markers").map(|list| &list.inside[..]).unwrap_or_default() {
                if marker.text != "Marker" {
                    continue;
                }
                let name = marker.take().value("Name").unwrap_or_default();
                let Some(frame) = told(frame(marker), unread) else { continue };
                let path = format!("{path}/{name}");
                if self.markers.contains_key(&path) {
                    unread.lost(point.line, format!("there is another marker {}", short(&path)));
                    continue;
                }
                self.markers.insert(path, Marker { part: index, frame: base.of(&frame) });
            }
        }
    }

    /// The frame of a marker at the start.
    pub(super) fn placed(&self, marker: &Marker) -> Frame {
        self.all[marker.part].frame.of(&marker.frame)
    }

    /// Adds the bodies, their places and rates to a draft.
    pub(super) fn draw(&mut self, plane: &Plane, draft: &mut Draft) {
        draft.bodies.insert("ground".into(), json!({}));
        let mut guess = Table::new();
        for (k, part) in self.all.iter_mut().enumerate() {
            if k == 0 {
                // the axes of ground are those of the plane
                part.name = "ground".into();
                continue;
            }
            part.lay(plane);
            part.name = draft.name(part.path.rsplit('/').next().unwrap_or_default());
            draft.bodies.insert(part.name.clone(), part.body(plane));
            let ([x, y], [vx, vy]) = (plane.flat(part.frame.place), plane.flat(part.velocity));
            let omega = plane.across_of(part.omega);
            let start = [
                ("x", x),
                ("y", y),
                ("angle", part.angle),
                ("vx", vx),
                ("vy", vy),
                ("omega", omega),
            ];
            for (coordinate, value) in start {
                guess.insert(format!("{}.{coordinate}", part.name), json!(value));
            }
        }
        draft.guess = guess;
    }

    /// The point of a marker in the plane, as `body.point`; `shift` moves it in the fixed frame.
    pub(super) fn point(
        &self,
        plane: &Plane,
        draft: &mut Draft,
        marker: &Marker,
        name: &str,
        shift: Vector,
    ) -> String {
        let part = &self.all[marker.part];
        let arm = plus(turned(&part.frame.turn, marker.frame.place), shift);
        let at = part.inside(plane, arm);
        draft.point(&part.name, name.rsplit('/').next().unwrap_or_default(), at)
    }

    /// Adds the points of all markers, also of those that nothing uses.
    pub(super) fn remaining(&self, plane: &Plane, draft: &mut Draft) {
        let mut paths: Vec<(&String, &Marker)> = self.markers.iter().collect();
        paths.sort_by_key(|(path, _)| path.as_str());
        for (path, marker) in paths.into_iter().filter(|(path, _)| !path.ends_with("/MassMarker")) {
            self.point(plane, draft, marker, path, [0.0; 3]);
        }
    }

    /// The angle of a direction, which is given in the fixed frame at the start, in the frame of the body.
    pub(super) fn angle(&self, plane: &Plane, part: usize, direction: Vector) -> f64 {
        let [x, y] = plane.flat(direction);
        let angle = y.atan2(x) - self.all[part].angle;
        angle.sin().atan2(angle.cos())
    }
}

/// The value; a fault is listed.
fn told<T>(found: Result<T, Fault>, unread: &mut UnreadList) -> Option<T> {
    found.map_err(|(line, what)| unread.lost(line, what)).ok()
}

impl Part {
    fn read(node: &Node<'_>, within: &str) -> Result<Self, Fault> {
        let path = format!("{within}/{}", node.value("Name").unwrap_or_default());
        let mut part = Self {
            line: node.line,
            path,
            name: String::new(),
            frame: frame(node)?,
            velocity: vector(node, "Velocity3D", [0.0; 3])?,
            omega: vector(node, "Omega3D", [0.0; 3])?,
            mass: 0.0,
            inertias: [0.0; 3],
            center: Frame { place: [0.0; 3], turn: UNTURNED },
            along: [1.0, 0.0, 0.0],
            angle: 0.0,
        };
        if let Some(mass) = node.get("PrincipalMassMarker") {
            // not needed
            let _ = (mass.value("Name"), mass.value("Density"));
            part.center = frame(mass)?;
            part.mass = match mass.numbers("Mass")?.as_deref() {
                Some(&[mass]) if mass >= 0.0 => mass,
                _ => return Err((mass.line, "Mass: must be a number that is not negative".into())),
            };
            part.inertias = vector(mass, "MomentOfInertias", [0.0; 3])?;
        }
        Ok(part)
    }

    /// Chooses the axis of the part that becomes the x axis of the body: the first that lies in the plane.
    fn lay(&mut self, plane: &Plane) {
        let out = |k: usize| plane.across_of(axis(&self.frame.turn, k)).abs();
        let best = (1..3).fold(0, |best, k| if out(k) < out(best) - 1e-6 { k } else { best });
        self.along = axis(&UNTURNED, best);
        let [x, y] = plane.flat(axis(&self.frame.turn, best));
        self.angle = y.atan2(x);
    }

    /// Whether the file gives the part a mass.
    pub(super) const fn has_mass(&self) -> bool {
        self.mass > 0.0
    }

    /// The angular velocity at the start.
    pub(super) const fn omega(&self) -> Vector {
        self.omega
    }

    /// The magnitude of the angular velocity at the start.
    pub(super) fn turning(&self) -> f64 {
        dot(self.omega, self.omega).sqrt()
    }

    /// A vector of the fixed frame in the frame of the body.
    fn inside(&self, plane: &Plane, arm: Vector) -> [f64; 2] {
        let ([x, y], (sin, cos)) = (plane.flat(arm), self.angle.sin_cos());
        [cos * x + sin * y, cos * y - sin * x]
    }

    fn body(&self, plane: &Plane) -> serde_json::Value {
        let turn = product(&self.frame.turn, &self.center.turn);
        let inertia: f64 =
            (0..3).map(|k| plane.across_of(axis(&turn, k)).powi(2) * self.inertias[k]).sum();
        let center = self.inside(plane, turned(&self.frame.turn, self.center.place));
        json!({ "mass": self.mass, "inertia": inertia, "center": center })
    }
}

/// The vector from one frame to another.
pub(super) fn between(from: &Frame, to: &Frame) -> Vector {
    minus(to.place, from.place)
}
