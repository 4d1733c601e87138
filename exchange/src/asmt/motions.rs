//! The prescribed motions, limits and forces of an assembly in the plane.

use super::joints::Flat;
use super::links::Linked;
use super::parts::{between, Marker};
use super::tree::{short, Node};
use super::Assembly;
use crate::draft::in_formula;
use crate::formula::{same, Formula, Words};
use crate::space::{axis, plus, times, Lie};
use serde_json::json;

/// A driver of the case and the motion whose effort it has.
#[derive(Debug)]
pub(super) struct Effort {
    pub(super) name: String,
    pub(super) path: String,
    pub(super) rotates: bool,
    pub(super) i: Marker,
}

/// The words of formulas: `time` counts from 0 on in the file, and from `start` on in the case.
struct Time {
    start: f64,
    /// Whether the formula may use the length of its force element.
    length: bool,
}

impl Words for Time {
    fn name(&self, name: &str) -> Option<Formula> {
        let t = || Formula::Name("t".into());
        match name {
            "pi" => Some(Formula::Name("pi".into())),
            "self" if self.length => Some(Formula::Name("self".into())),
            "time" if self.start == 0.0 => Some(t()),
            "time" => Some(Formula::Operation('+', vec![t(), Formula::Number(self.start)])),
            _ => None,
        }
    }

    fn call(&self, name: &str, arguments: Vec<Formula>) -> Option<Formula> {
        let of_self = self.length && arguments == [Formula::Name("self".into())];
        match name {
            "rIJ" if of_self => Some(Formula::Name("length".into())),
            "vrIJ" if of_self => Some(Formula::Name("rate".into())),
            _ => same(name, &arguments),
        }
    }
}

type Done = Result<(), String>;

impl Assembly<'_> {
    fn formula(&self, node: &Node<'_>, name: &str, length: bool) -> Result<Formula, String> {
        let text = node.value(name).ok_or_else(|| format!("{name} is missing"))?;
        let words = Time { start: self.t_start, length };
        Formula::read(text, &words).map_err(|why| format!("{name} = {}: {why}", short(text)))
    }

    /// The joint that a motion or a limit names.
    fn joint_of(&self, node: &Node<'_>) -> Result<&Linked, String> {
        let path = node.value("MotionJoint").unwrap_or_default();
        let [i, j] = ["MarkerI", "MarkerJ"].map(|name| node.value(name).unwrap_or_default());
        let fits = |linked: &&Linked| match path {
            "" => linked.markers == [i.to_string(), j.to_string()],
            _ => linked.path == path,
        };
        let mut found = self.linked.iter().filter(fits);
        let (first, second) = (found.next(), found.next());
        if second.is_some() {
            return Err("MotionJoint: several joints have this name or these markers".into());
        }
        first.ok_or_else(|| {
            format!(
                "MotionJoint: there is no joint {} that was read",
                short(if path.is_empty() { i } else { path })
            )
        })
    }

    /// A prescribed rotation of a revolute joint, or displacement of a slide.
    pub(super) fn motion(&mut self, node: &Node<'_>, wanted: &str, path: &str) -> Done {
        let rotates = node.text == "RotationalMotion";
        let linked = self.joint_of(node)?;
        let law = self.formula(node, if rotates { "RotationZ" } else { "TranslationZ" }, false)?;
        let (i, name) = (linked.i, linked.name.clone());
        let (coordinate, value) =
            if rotates { self.turn(linked, law)? } else { self.shift(linked, law)? };
        let driver = self.draft.name(wanted);
        let entry = json!({ "type": "coordinate_driver", "coordinate": format!("{name}.{coordinate}"), "value": value });
        self.draft.drivers.insert(driver.clone(), entry);
        self.rows += 1;
        self.efforts.push(Effort { name: driver, path: path.into(), rotates, i });
        Ok(())
    }

    /// The angle of a revolute joint whose x axes have the angle of the law about the axis of I.
    fn turn(&self, linked: &Linked, law: Formula) -> Result<(&'static str, String), String> {
        if linked.flat != Flat::Revolute {
            return Err(
                "a rotation is prescribed for a joint that does not turn in the plane".into()
            );
        }
        let (sense, offset, now) = self.sense(linked)?;
        let law = if sense < 0.0 { Formula::Operation('-', vec![law]) } else { law };
        let full = std::f64::consts::TAU;
        let turns =
            law.value(0.0).map_or(0.0, |at_start| ((now - at_start - offset) / full).round());
        let offset = offset + full * turns;
        let zero = offset.abs() < 1e-13;
        let law =
            if zero { law } else { Formula::Operation('+', vec![law, Formula::Number(offset)]) };
        Ok(("angle", law.text()))
    }

    /// Sense of the axis of I, the angle of the joint where the x axes coincide, and its angle at the start.
    fn sense(&self, linked: &Linked) -> Result<(f64, f64, f64), String> {
        let (i, j) = (self.parts.placed(&linked.i), self.parts.placed(&linked.j));
        let Lie::Normal(sense) = self.plane.lie(axis(&i.turn, 2)) else {
            return Err("its joint has an axis that is not normal to the plane".into());
        };
        let of = |marker: &Marker, turn| self.parts.angle(&self.plane, marker.part, axis(turn, 0));
        let offset = of(&linked.i, &i.turn) - of(&linked.j, &j.turn);
        let now = self.parts.all[linked.j.part].angle - self.parts.all[linked.i.part].angle;
        Ok((sense, offset, now))
    }

    fn shift(&self, linked: &Linked, law: Formula) -> Result<(&'static str, String), String> {
        match linked.flat {
            Flat::Slide { .. } if linked.along_axis => Ok(("displacement", law.text())),
            _ => {
                Err("a displacement is prescribed for a joint that does not slide in the plane"
                    .into())
            }
        }
    }

    /// A limit of a joint is a stop at which the joint rests.
    pub(super) fn limit(&mut self, node: &Node<'_>, wanted: &str) -> Done {
        let rotates = node.text == "RotationLimit";
        let linked = self.joint_of(node)?;
        let law = self.formula(node, "Limit", false)?;
        node.value("Tol");
        let limit = law.value(0.0).filter(|_| law.value(1.0) == law.value(0.0));
        let limit = limit.ok_or("Limit: must be a number")?;
        let mut upper = match node.value("Type").unwrap_or_default() {
            "=<" | "<=" | "<" => true,
            "=>" | ">=" | ">" => false,
            other => return Err(format!("Type: '{}' is not =< or =>", short(other))),
        };
        let name = linked.name.clone();
        let (coordinate, limit) = if rotates {
            let (sense, offset, now) = self.sense(linked)?;
            upper ^= sense < 0.0;
            let full = std::f64::consts::TAU;
            let limit = sense * limit + offset;
            // the turn of the limit is that of the start
            ("angle", limit + full * ((now - limit) / full).round())
        } else {
            self.shift(linked, law)?;
            ("displacement", limit)
        };
        let side = if upper { "upper" } else { "lower" };
        let entry = json!({ "type": "stop", "coordinate": format!("{name}.{coordinate}"), side: limit, "restitution": 0 });
        let stop = self.draft.name(wanted);
        self.draft.forces.insert(stop, entry);
        Ok(())
    }

    /// A prescribed position and rotation of marker J in the frame of marker I.
    pub(super) fn general(&mut self, node: &Node<'_>, wanted: &str) -> Result<[usize; 2], String> {
        let (i, j) = self.markers(node)?;
        let laws = ["rIJI1", "rIJI2", "rIJI3"].map(|name| self.formula(node, name, false));
        let angles = ["angIJJ1", "angIJJ2", "angIJJ3"].map(|name| self.formula(node, name, false));
        // only one of the rotations is in the plane
        node.value("RotationOrder");
        let frame = self.parts.placed(&i.1);
        let mut sums = [Vec::new(), Vec::new()];
        for (k, law) in laws.into_iter().enumerate() {
            let (law, along) = (law?, axis(&frame.turn, k));
            let fixed = law
                .value(0.0)
                .filter(|now| [0.37, 1.1, 7.3].iter().all(|t| law.value(*t) == Some(*now)));
            if fixed.is_none() && self.plane.across_of(along).abs() > 1e-5 {
                return Err(format!("rIJI{} moves a part out of the plane", k + 1));
            }
            let angle = self.parts.angle(&self.plane, i.1.part, along);
            let [x, y] = self.plane.flat(along);
            for (sum, factor) in
                sums.iter_mut().zip([x.hypot(y) * angle.cos(), x.hypot(y) * angle.sin()])
            {
                if factor.abs() > 1e-12 && fixed != Some(0.0) {
                    let factor =
                        if (factor.abs() - 1.0).abs() < 1e-14 { factor.signum() } else { factor };
                    sum.push(Formula::Operation('*', vec![Formula::Number(factor), law.clone()]));
                }
            }
        }
        let mut turn = Formula::Number(0.0);
        for (k, law) in angles.into_iter().enumerate() {
            let law = law?;
            match self.plane.lie(axis(&frame.turn, k)) {
                Lie::Normal(sense) => {
                    turn = Formula::Operation('*', vec![Formula::Number(sense), law])
                }
                _ if law.value(0.0) == Some(0.0) && law.value(0.37) == Some(0.0) => {}
                _ => return Err(format!("angIJJ{} turns a part out of the plane", k + 1)),
            }
        }
        let residual = self.residual(&i, &j, sums, turn);
        let name = self.draft.name(wanted);
        let entry =
            json!({ "type": "constraint", "residual": residual, "units": ["m", "m", "rad"] });
        self.draft.joints.insert(name, entry);
        self.rows += 3;
        Ok([i.1.part, j.1.part])
    }

    /// The components of the vector from marker I to marker J in the frame of body I, and the relative angle, as formulas.
    fn relative(&mut self, [i, j]: [&(&str, Marker); 2]) -> ([String; 2], String) {
        let [pi, pj] = [i, j].map(|(path, marker)| {
            self.parts.point(&self.plane, &mut self.draft, marker, path, [0.0; 3])
        });
        let [body_i, body_j] = [i, j].map(|(_, marker)| self.parts.all[marker.part].name.clone());
        let place = |body: &str, point: &str, marker: &Marker, k: usize| match body {
            "ground" => format!("({})", self.plane.flat(self.parts.placed(marker).place)[k]),
            _ => in_formula(&format!("{point}.{}", ["x", "y"][k])),
        };
        let angle = |body: &str| {
            if body == "ground" {
                "0".into()
            } else {
                in_formula(&format!("{body}.angle"))
            }
        };
        let d = [0, 1].map(|k| {
            format!("({} - {})", place(&body_j, &pj, &j.1, k), place(&body_i, &pi, &i.1, k))
        });
        let [ai, aj] = [angle(&body_i), angle(&body_j)];
        let x = format!("{}*cos({ai}) + {}*sin({ai})", d[0], d[1]);
        let y = format!("{}*cos({ai}) - {}*sin({ai})", d[1], d[0]);
        ([x, y], format!("{aj} - {ai}"))
    }

    /// A pinion at another distance from the line than its radius: `u·d + radius (angle_j - angle_i) = offset`.
    pub(super) fn rolling_by_formula(
        &mut self,
        ends: [&(&str, Marker); 2],
        axis: f64,
        radius: f64,
        offset: f64,
    ) -> serde_json::Value {
        let ([x, y], angle) = self.relative(ends);
        let (sin, cos) = axis.sin_cos();
        let residual = format!("({cos})*({x}) + ({sin})*({y}) + ({radius})*({angle}) - ({offset})");
        json!({ "type": "constraint", "residual": [residual], "units": ["m"] })
    }

    /// The equations of a general motion.
    fn residual(
        &mut self,
        i: &(&str, Marker),
        j: &(&str, Marker),
        sums: [Vec<Formula>; 2],
        turn: Formula,
    ) -> [String; 3] {
        let ([x, y], angle) = self.relative([i, j]);
        let [px, py] =
            sums.map(|sum| sum.into_iter().reduce(|a, b| Formula::Operation('+', vec![a, b])));
        let text = |sum: Option<Formula>| sum.map_or("0".to_string(), |sum| sum.text());
        let relative = self.parts.all[j.1.part].angle - self.parts.all[i.1.part].angle;
        let at_start = turn.value(0.0).unwrap_or(0.0);
        [
            format!("{x} - ({})", text(px)),
            format!("{y} - ({})", text(py)),
            format!("{angle} - ({}) - ({})", turn.text(), relative - at_start),
        ]
    }

    /// A force along the line of two markers.
    pub(super) fn force(&mut self, node: &Node<'_>, wanted: &str) -> Done {
        if node.text != "InLineForceTorque" {
            return Err(format!("forces of class {} are not supported", short(node.text)));
        }
        let (i, j) = self.markers(node)?;
        let tension = self.formula(node, "tension", true)?;
        let twist = self.formula(node, "twist", true)?;
        if twist != Formula::Number(0.0) {
            return Err("twist: a torque about the line of two points leaves the plane".into());
        }
        let (fi, fj) = (self.parts.placed(&i.1), self.parts.placed(&j.1));
        let height = self.plane.across_of(between(&fi, &fj));
        if height.abs()
            > 1e-9
                * plus(between(&fi, &fj), times(-height, self.plane.normal))
                    .map(f64::abs)
                    .iter()
                    .sum::<f64>()
        {
            return Err("its two markers are at different heights above the plane".into());
        }
        let [pi, pj] = [i, j].map(|(path, marker)| {
            self.parts.point(&self.plane, &mut self.draft, &marker, path, [0.0; 3])
        });
        let push = Formula::Operation('-', vec![tension]).text();
        let name = self.draft.name(wanted);
        self.draft
            .forces
            .insert(name, json!({ "type": "actuator", "i": pi, "j": pj, "force": push }));
        Ok(())
    }
}
