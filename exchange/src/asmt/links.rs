//! Writes the joints of an assembly into a case.

use super::joints::{flat, leaves, Flat, KNOWN};
use super::parts::{between, Frame, Marker};
use super::series::Reacting;
use super::tree::{short, Node};
use super::Assembly;
use crate::space::{axis, plus, Vector};
use serde_json::{json, Value};

/// A marker with its path.
pub(super) type End<'a> = (&'a str, Marker);

/// A joint that was read.
#[derive(Debug)]
pub(super) struct Linked {
    pub(super) name: String,
    pub(super) path: String,
    /// The paths of its markers.
    pub(super) markers: [String; 2],
    pub(super) flat: Flat,
    pub(super) i: Marker,
    pub(super) j: Marker,
    /// Whether the displacement of the joint is along the z axis of marker I.
    pub(super) along_axis: bool,
}

impl<'a> Assembly<'a> {
    /// The two markers of a joint, a motion or a force, with their paths.
    pub(super) fn markers(&self, node: &Node<'a>) -> Result<(End<'a>, End<'a>), String> {
        let one = |name: &str| {
            let path = node.value(name).ok_or_else(|| format!("{name} is missing"))?;
            let marker = self.parts.markers.get(path).copied();
            Ok::<_, String>((
                path,
                marker.ok_or_else(|| format!("{name}: there is no marker {}", short(path)))?,
            ))
        };
        Ok((one("MarkerI")?, one("MarkerJ")?))
    }

    /// A number of a joint.
    fn number(&self, node: &Node<'_>, name: &str) -> Result<Option<f64>, String> {
        match node.numbers(name).map_err(|(_, why)| why)?.as_deref() {
            None => Ok(None),
            Some(&[x]) => Ok(Some(x)),
            Some(_) => Err(format!("{name}: must be one number")),
        }
    }

    /// Adds a joint to the case. Returns the parts that it keeps from tilting against each other.
    pub(super) fn joint(
        &mut self,
        node: &Node<'a>,
        wanted: &str,
        path: &str,
    ) -> Result<Option<[usize; 2]>, String> {
        if !KNOWN.contains(&node.text) {
            return Err(leaves(node.text));
        }
        let (i, j) = self.markers(node)?;
        let offset = self.number(node, "offset")?.unwrap_or(0.0);
        if i.1.part == j.1.part {
            return Err("both markers are on the same part".into());
        }
        let (fi, fj) = (self.parts.placed(&i.1), self.parts.placed(&j.1));
        if let Some(angle) = self.number(node, "theIzJz")?.filter(|_| node.text == "AngleJoint") {
            let now = crate::space::dot(axis(&fi.turn, 2), axis(&fj.turn, 2));
            if (now - angle.cos()).abs() > 1e-6 {
                return Err("theIzJz: the parts do not have this angle at the start".into());
            }
        }
        let (kind, holds) = flat(node.text, &self.plane, offset, &fi, &fj)?;
        let tilt = holds.then_some([i.1.part, j.1.part]);
        let Some(entry) = self.entry(node, kind, &i, &j, &fi, &fj)? else { return Ok(tilt) };
        let entry_type = entry["type"].as_str().unwrap_or_default().to_string();
        let name = self.draft.name(wanted);
        self.draft.joints.insert(name.clone(), entry);
        self.rows += kind.rows();
        let reacts = kind != Flat::SameAngle && entry_type != "constraint";
        let at_markers = matches!(kind, Flat::Revolute | Flat::Slide { .. } | Flat::Weld);
        let torque = at_markers && !matches!(node.text, "PlanarJoint" | "LineInPlaneJoint");
        if reacts {
            let reacting =
                Reacting { name: name.clone(), path: path.into(), i: i.1, j: j.1, torque };
            self.reacting.push(reacting);
        }
        let along_axis = matches!(node.text, "TranslationalJoint" | "CylindricalJoint");
        let markers = [i.0.to_string(), j.0.to_string()];
        self.linked.push(Linked {
            name,
            path: path.into(),
            markers,
            flat: kind,
            i: i.1,
            j: j.1,
            along_axis,
        });
        Ok(tilt)
    }

    fn entry(
        &mut self,
        node: &Node<'a>,
        kind: Flat,
        i: &(&str, Marker),
        j: &(&str, Marker),
        fi: &Frame,
        fj: &Frame,
    ) -> Result<Option<Value>, String> {
        let aside = match kind {
            Flat::Slide { aside, .. } | Flat::Slot { aside, .. } => aside,
            _ => [0.0; 3],
        };
        let [body_i, body_j] = [i, j].map(|(_, marker)| self.parts.all[marker.part].name.clone());
        let relative = self.parts.all[j.1.part].angle - self.parts.all[i.1.part].angle;
        if kind == Flat::SameAngle {
            let terms: serde_json::Map<String, Value> = [(body_i, -1), (body_j, 1)]
                .into_iter()
                .filter(|(body, _)| body != "ground")
                .map(|(body, factor)| (format!("{body}.angle"), json!(factor)))
                .collect();
            return Ok(Some(json!({ "type": "coupling", "terms": terms, "value": relative })));
        }
        if kind == Flat::Nothing {
            return Ok(None);
        }
        let pi = self.parts.point(&self.plane, &mut self.draft, &i.1, i.0, aside);
        let pj = self.parts.point(&self.plane, &mut self.draft, &j.1, j.0, [0.0; 3]);
        let angle_i = |direction: Vector| self.parts.angle(&self.plane, i.1.part, direction);
        let full = std::f64::consts::TAU;
        let mut entry = match kind {
            Flat::Slide { along_i, along_j, .. } => {
                let (ai, aj) = (angle_i(along_i), self.parts.angle(&self.plane, j.1.part, along_j));
                let aj = aj + full * ((ai - relative - aj) / full).round();
                json!({ "type": "translational", "axes": [ai, aj] })
            }
            Flat::Weld => {
                // the axis of the markers that is most in the plane
                let out = |k| self.plane.across_of(axis(&fi.turn, k)).abs();
                let k = (1..3).fold(0, |best, k| if out(k) < out(best) - 1e-6 { k } else { best });
                let angle_j = self.parts.angle(&self.plane, j.1.part, axis(&fj.turn, k));
                let angle = angle_i(axis(&fi.turn, k)) - angle_j;
                json!({ "type": "weld", "angle": angle + full * ((relative - angle) / full).round() })
            }
            Flat::Slot { along, .. } => json!({ "type": "pin_in_slot", "axis": angle_i(along) }),
            Flat::Distance => self.distance(node, fi, fj)?,
            Flat::Gear => self.gear(node, fi, fj, [i.1.part, j.1.part])?,
            Flat::Rack { sense } => self.rack(node, [i, j], [fi, fj], sense)?,
            _ => json!({ "type": "revolute" }),
        };
        if entry["type"] == "constraint" {
            return Ok(Some(entry));
        }
        let fields = entry.as_object_mut().expect("a joint is a table");
        fields.insert("i".into(), json!(pi));
        fields.insert("j".into(), json!(pj));
        Ok(Some(entry))
    }

    /// A rod between two pins: its length is that in space between two spheres, across the axes otherwise.
    fn distance(&self, node: &Node<'_>, fi: &Frame, fj: &Frame) -> Result<Value, String> {
        let height = self.plane.across_of(between(fi, fj));
        let height = if node.text == "SphSphJoint" { height } else { 0.0 };
        let length = self.number(node, "distanceIJ")?.map(|d| d * d - height * height);
        let length = length.filter(|square| *square > 0.0).ok_or("distanceIJ: must be positive")?;
        Ok(json!({ "type": "distance", "length": length.sqrt() }))
    }

    /// A rack and pinion whose start satisfies its equation.
    fn rack(
        &mut self,
        node: &Node<'_>,
        ends: [&End<'_>; 2],
        [fi, fj]: [&Frame; 2],
        sense: f64,
    ) -> Result<Value, String> {
        let radius = self.number(node, "pitchRadius")?.ok_or("pitchRadius is missing")?;
        let (radius, along) = (sense * radius, axis(&fi.turn, 0));
        let [part_i, part_j] = ends.map(|end| end.1.part);
        let relative = self.parts.all[part_j].angle - self.parts.all[part_i].angle;
        let ([ux, uy], [dx, dy]) = (self.plane.flat(along), self.plane.flat(between(fi, fj)));
        let offset = ux * dx + uy * dy + radius * relative;
        let axis = self.parts.angle(&self.plane, part_i, along);
        if (ux * dy - uy * dx - radius).abs() > 1e-6 * radius.abs() {
            return Ok(self.rolling_by_formula(ends, axis, radius, offset));
        }
        Ok(json!({ "type": "rack", "radius": radius, "axis": axis, "offset": offset }))
    }

    /// A gear pair: radii of opposite signs are those of an internal pair.
    fn gear(
        &self,
        node: &Node<'_>,
        fi: &Frame,
        fj: &Frame,
        parts: [usize; 2],
    ) -> Result<Value, String> {
        let radius = |name: &str| {
            self.number(node, name)?.filter(|r| *r != 0.0).ok_or(format!("{name}: must not be 0"))
        };
        let (ri, rj) = (radius("radiusI")?, radius("radiusJ")?);
        let internal = (ri < 0.0) != (rj < 0.0);
        let apart = crate::space::dot(between(fi, fj), between(fi, fj)).sqrt();
        let apart = (apart * apart - self.plane.across_of(between(fi, fj)).powi(2)).max(0.0).sqrt();
        if (apart - (ri + rj).abs()).abs() > 1e-6 * (ri.abs() + rj.abs()) {
            return Err(format!(
                "the centres are {apart} apart; the radii fit a distance of {}",
                (ri + rj).abs()
            ));
        }
        let (ri, rj, sigma) = (ri.abs(), rj.abs(), if internal { -1.0 } else { 1.0 });
        let [dx, dy] = self.plane.flat(between(fi, fj));
        let [ai, aj] = parts.map(|part| self.parts.all[part].angle - dy.atan2(dx));
        let offset = ri * ai + sigma * rj * aj;
        Ok(json!({ "type": "gear", "radii": [ri, rj], "internal": internal, "offset": offset }))
    }

    /// Names the parts that can tilt out of the plane, and what else leaves it.
    pub(super) fn tilting(&mut self, holds: &[[usize; 2]]) {
        let mut root: Vec<usize> = (0..self.parts.all.len()).collect();
        fn find(root: &mut [usize], mut k: usize) -> usize {
            while root[k] != k {
                root[k] = root[root[k]];
                k = root[k];
            }
            k
        }
        for [a, b] in holds {
            let (a, b) = (find(&mut root, *a), find(&mut root, *b));
            root[a] = b;
        }
        for k in 1..root.len() {
            if find(&mut root, k) != find(&mut root, 0) {
                let part = &self.parts.all[k];
                let name = short(part.path.rsplit('/').next().unwrap_or_default());
                let why = "no joint keeps it from tilting out of the plane; kempe is planar";
                self.unread.lost(part.line, format!("part {name}: {why}"));
            }
        }
    }

    /// The plane in which most of the joints move their parts.
    pub(super) fn find_plane(&self, joints: &[&Node<'a>]) -> crate::space::Plane {
        let ends: Vec<(&str, Frame, Frame)> = joints
            .iter()
            .filter_map(|node| {
                let marker = |name: &str| {
                    let path =
                        node.inside.iter().find(|inner| inner.text == name)?.inside.first()?.text;
                    Some(self.parts.placed(self.parts.markers.get(path)?))
                };
                Some((node.text, marker("MarkerI")?, marker("MarkerJ")?))
            })
            .collect();
        let mut normals: Vec<Vector> = vec![[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]];
        for (_, i, _) in &ends {
            let z = axis(&i.turn, 2);
            let new = normals.iter().all(|n| crate::space::dot(*n, z).abs() < 1.0 - 1e-9);
            if new && normals.len() < 40 {
                normals.push(z);
            }
        }
        let planes = normals.into_iter().map(crate::space::Plane::across);
        let wrong = |plane: &crate::space::Plane| {
            ends.iter().filter(|(class, i, j)| flat(class, plane, 0.0, i, j).is_err()).count()
        };
        let flat_parts = |plane: &crate::space::Plane| {
            let moving = &self.parts.all[1..];
            moving
                .iter()
                .filter(|part| plane.across_of(part.omega()).abs() < part.turning() - 1e-9)
                .count()
        };
        planes
            .min_by_key(|plane| (wrong(plane), flat_parts(plane)))
            .expect("there are three planes at least")
    }

    /// The velocity of a part must lie in the plane.
    pub(super) fn leaving(&mut self) {
        for part in &self.parts.all[1..] {
            let tilt = plus(
                part.omega(),
                crate::space::times(-self.plane.across_of(part.omega()), self.plane.normal),
            );
            let tilt = crate::space::dot(tilt, tilt).sqrt();
            if tilt > 1e-6 * (1.0 + part.turning()) {
                let name = short(part.path.rsplit('/').next().unwrap_or_default());
                let why =
                    format!("Omega3D turns it out of the plane by {tilt:.3} rad/s at the start");
                self.unread.lost(part.line, format!("part {name}: {why}"));
            }
        }
    }
}
