//! `.asmt`: assemblies of OndselSolver, the solver of the assemblies of FreeCAD.
//!
//! | in the file | in the case |
//! |---|---|
//! | assembly | `ground`; its name is the title |
//! | parts with mass, centre, moments of inertia | bodies; the moment of inertia about the normal of the plane |
//! | markers | points |
//! | revolute, cylindrical, spherical, universal and point-in-line joints across the plane | `revolute` |
//! | translational, cylindrical, planar and line-in-plane joints in the plane | `translational` |
//! | fixed | `weld` |
//! | point in plane, point in line in the plane | `pin_in_slot` |
//! | no rotation, parallel axes, perpendicular, angle | `coupling` of angles |
//! | revolute-revolute, revolute-cylindrical, cylindrical-spherical, spherical-spherical | `distance` |
//! | gear, rack and pinion | `gear`, `rack` |
//! | rotational and translational motions | `coordinate_driver` |
//! | general motions | `constraint` |
//! | limits of rotation and translation | `stop` with `restitution = 0` |
//! | in-line forces | `actuator` |
//! | `ConstantGravity`, `tstart`, `tend`, `hout` | `gravity`, the analysis |
//! | `TimeSeries` | results to compare with |
//!
//! Everything else is named. Joints whose axes do not fit one plane, and parts that no joint keeps in it, are spatial.

mod joints;
mod links;
mod motions;
mod parts;
mod series;
mod tree;

use crate::draft::Draft;
use crate::space::Plane;
use crate::unread::UnreadList;
use crate::Read;
use links::Linked;
use motions::Effort;
use parts::Parts;
use serde_json::json;
use series::Reacting;
use tree::{short, Node};

/// An assembly while it is read.
#[derive(Debug)]
struct Assembly<'a> {
    parts: Parts,
    plane: Plane,
    draft: Draft,
    unread: UnreadList,
    linked: Vec<Linked>,
    reacting: Vec<Reacting>,
    efforts: Vec<Effort>,
    /// The number of equations in the plane.
    rows: usize,
    t_start: f64,
    root: std::marker::PhantomData<&'a ()>,
}

/// Parts of a file that change neither motion nor forces.
const LEFT: [(&str, &str); 9] = [
    ("Notes", "notes"),
    ("FeatureOrder", "shapes for drawings"),
    ("AnimationParameters", "settings of the animation"),
    ("KinematicIJs", "quantities to show"),
    ("RefCurves", "curves"),
    ("RefSurfaces", "surfaces"),
    ("hmin", "settings of the solver"),
    ("hmax", "settings of the solver"),
    ("errorTol", "settings of the solver"),
];

/// Reads a text.
pub(crate) fn read(text: &str) -> Read {
    let mut unread = UnreadList::default();
    let (tree, lines) = match tree::read(text) {
        Ok(found) => found,
        Err((line, why)) => {
            unread.lost(line, why);
            return Read::nothing(unread);
        }
    };
    let Some(node) = tree.inside.iter().find(|node| node.text == "Assembly") else {
        unread.lost(0, "there is no line 'Assembly'; this is not an .asmt file");
        return Read::nothing(unread);
    };
    // the first line of a file names the program
    tree.inside.iter().filter(|other| other.line == 1).for_each(|first| {
        first.take();
    });
    node.take();
    let parts = Parts::read(node, &mut unread);
    if parts.all.is_empty() {
        return Read::nothing(unread);
    }
    let mut assembly = Assembly {
        parts,
        plane: Plane::across([0.0, 0.0, 1.0]),
        draft: Draft::default(),
        unread,
        linked: Vec::new(),
        reacting: Vec::new(),
        efforts: Vec::new(),
        rows: 0,
        t_start: 0.0,
        root: std::marker::PhantomData,
    };
    assembly.fill(node);
    let series = series::read(&lines, &mut assembly.unread);
    let Assembly { parts, plane, draft, reacting, efforts, t_start, mut unread, .. } = assembly;
    let results = series.columns(&plane, &parts, &reacting, &efforts, t_start);
    name_unused(&tree, &mut unread);
    Read { case: Some(draft.text()), unread: unread.sorted(), results }
}

impl<'a> Assembly<'a> {
    fn fill(&mut self, node: &'a Node<'a>) {
        self.draft.title = self.parts.all[0].path.trim_start_matches('/').into();
        self.draft.redundant = true;
        let sets = node.get("ConstraintSets");
        let list = |name: &str| -> &'a [Node<'a>] {
            sets.and_then(|sets| sets.get(name)).map(|list| &list.inside[..]).unwrap_or_default()
        };
        let (joints, motions, limits) = (list("Joints"), list("Motions"), list("Limits"));
        list("GeneralConstraintSets");
        let all: Vec<&Node<'a>> = joints.iter().collect();
        self.plane = self.find_plane(&all);
        self.parts.draw(&self.plane, &mut self.draft);
        self.times(node);
        let mut holds = Vec::new();
        for joint in joints {
            let path = self.path(joint);
            let found = self.joint(joint, name_of(&path), &path);
            holds.extend(self.told(joint, &path, found).flatten());
        }
        for motion in motions {
            let path = self.path(motion);
            let found = match motion.text {
                "RotationalMotion" | "TranslationalMotion" => {
                    self.motion(motion, name_of(&path), &path)
                }
                "GeneralMotion" => {
                    self.general(motion, name_of(&path)).map(|pair| holds.push(pair))
                }
                other => Err(format!("motions of class {} are not supported", short(other))),
            };
            self.told(motion, &path, found);
        }
        for limit in limits {
            let path = self.path(limit);
            let found = self.limit(limit, name_of(&path));
            self.told(limit, &path, found);
        }
        for force in node.get("ForceTorques").map(|list| &list.inside[..]).unwrap_or_default() {
            let path = self.path(force);
            let found = self.force(force, name_of(&path));
            self.told(force, &path, found);
        }
        self.parts.remaining(&self.plane, &mut self.draft);
        self.tilting(&holds);
        self.leaving();
        self.analysis();
    }

    /// The path of a joint, motion or force.
    fn path(&self, node: &Node<'a>) -> String {
        let name = node.value("Name").filter(|name| !name.is_empty()).unwrap_or(node.text);
        format!("{}/{name}", self.parts.all[0].path)
    }

    /// The result; a fault is listed with the line and the name, and all of the node counts as named.
    fn told<T>(&mut self, node: &Node<'_>, path: &str, found: Result<T, String>) -> Option<T> {
        if found.is_ok() {
            node.take();
        } else {
            node.take_all();
        }
        let what = |why: String| format!("{} {}: {why}", short(node.text), short(name_of(path)));
        found.map_err(|why| self.unread.lost(node.line, what(why))).ok()
    }

    fn times(&mut self, node: &Node<'_>) {
        match node.numbers("ConstantGravity") {
            Ok(Some(g)) if g.len() == 3 => {
                let g = [g[0], g[1], g[2]];
                self.draft.gravity = self.plane.flat(g);
                if self.plane.across_of(g).abs() > 1e-9 * g.iter().map(|x| x.abs()).sum::<f64>() {
                    self.unread.left(node.line, "ConstantGravity: the part across the plane only loads the joints across it");
                }
            }
            Ok(None) => {}
            Ok(Some(_)) => self.unread.lost(node.line, "ConstantGravity: must be 3 numbers"),
            Err((line, why)) => self.unread.lost(line, why),
        }
        let Some(times) = node.get("SimulationParameters") else { return };
        let mut number = |name: &str, absent: f64| match times.numbers(name) {
            Ok(None) => absent,
            Ok(Some(found)) if found.len() == 1 => found[0],
            Ok(Some(_)) => {
                self.unread.lost(times.line, format!("{name}: must be one number"));
                absent
            }
            Err((line, why)) => {
                self.unread.lost(line, why);
                absent
            }
        };
        self.t_start = number("tstart", 0.0);
        let (end, step) = (number("tend", 1.0), number("hout", 0.0));
        let t_end = if end > self.t_start { end - self.t_start } else { 1.0 };
        let step = if step > 0.0 && step < t_end { step } else { t_end / 100.0 };
        self.draft.analyses.insert("motion".into(), json!({ "t_end": t_end, "output_step": step }));
    }

    /// The motions determine the movement if they leave no freedom.
    fn analysis(&mut self) {
        let driven = self.rows >= 3 * (self.parts.all.len() - 1) && !self.efforts.is_empty();
        // without masses there are no forces to compute
        let massless = self.parts.all[1..].iter().all(|part| !part.has_mass());
        let kind = match (driven, massless) {
            (true, false) => "inverse_dynamics",
            (true, true) => "kinematics",
            (false, _) => "dynamics",
        };
        let entry = self.draft.analyses.entry("motion").or_insert_with(|| json!({ "t_end": 1.0 }));
        entry.as_object_mut().expect("an analysis is a table").insert("type".into(), json!(kind));
    }
}

/// The last part of a path.
fn name_of(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or_default()
}

/// Names what nothing has read.
fn name_unused(tree: &Node<'_>, unread: &mut UnreadList) {
    for node in tree.unused() {
        let known = LEFT.iter().find(|(name, _)| *name == node.text);
        match known {
            Some(_) if node.inside.is_empty() => {}
            Some((name, what)) => unread.left(node.line, format!("{name}: {what} are left out")),
            None => unread.lost(node.line, format!("'{}' has no meaning here", short(node.text))),
        }
    }
}
