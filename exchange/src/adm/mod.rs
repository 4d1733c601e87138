//! `.adm`: models of the solver of MSC Adams.
//!
//! | in the file | in the case |
//! |---|---|
//! | `UNITS` | lengths and masses become m and kg |
//! | `PART` with `MASS`, `CM`, `IP`, `QG`, `REULER`; the part `GROUND` | bodies, `ground` |
//! | `MARKER` with `QP`, `REULER` | points |
//! | `JOINT` `REVOLUTE`, `CYLINDRICAL`, `TRANSLATIONAL`, `FIXED`, `SPHERICAL`, `UNIVERSAL`, `PLANAR` | as in an assembly |
//! | `JPRIM` `ATPOINT`, `INLINE`, `INPLANE`, `ORIENTATION`, `PARALLEL_AXES`, `PERPENDICULAR` | as in an assembly |
//! | `MOTION` of a joint | `coordinate_driver` |
//! | `SFORCE` and `SPRINGDAMPER` between two points | `actuator` |
//! | `ACCGRAV` | `gravity` |
//!
//! The plane and the joints are those of the reader of assemblies: a model becomes an assembly, and the lines of the
//! assembly keep those of the model.

mod formulas;
mod known;
mod statements;
mod tables;

use crate::space::Rotation;
use crate::unread::UnreadList;
use crate::Read;
use formulas::{euler, function, replaced};
use statements::{short, Statement};
use std::collections::HashMap;
use tables::{FORCES, JOINTS, LEFT, LENGTHS, MASSES};

/// An assembly while it is written, with the line of the model for each of its lines.
struct Writer {
    text: String,
    lines: Vec<usize>,
    unread: UnreadList,
    length: f64,
    mass: f64,
    force: f64,
    /// Paths of markers and joints by their numbers.
    markers: HashMap<String, String>,
    joints: HashMap<String, String>,
}

/// Reads a text.
pub(crate) fn read(text: &str) -> Read {
    let mut all = statements::read(text);
    known::tell_apart(&mut all);
    let mut writer = Writer {
        text: String::new(),
        lines: Vec::new(),
        unread: UnreadList::default(),
        length: 1.0,
        mass: 1.0,
        force: 1.0,
        markers: HashMap::new(),
        joints: HashMap::new(),
    };
    if !all.iter().any(|statement| statement.kind == "PART") {
        writer.unread.lost(0, "there is no statement PART; this is not an .adm file");
        return Read::nothing(writer.unread);
    }
    for (line, what) in known::unknown(&all) {
        writer.unread.lost(line, what);
    }
    for statement in all.iter().filter(|statement| statement.kind == "UNITS") {
        writer.units(statement);
    }
    writer.assembly(&all);
    for statement in &all {
        writer.name_rest(statement);
    }
    let mut read = crate::asmt::read(&writer.text);
    for unread in read.unread {
        let line = writer.lines.get(unread.line.wrapping_sub(1)).copied().unwrap_or(0);
        if unread.harmless {
            writer.unread.left(line, unread.what);
        } else {
            writer.unread.lost(line, unread.what);
        }
    }
    read.unread = writer.unread.sorted();
    read
}

impl Writer {
    fn put(&mut self, line: usize, level: usize, text: &str) {
        self.text.extend(std::iter::repeat_n('\t', level));
        // one line, so that the lines of both files keep their relation
        self.text.extend(text.chars().map(|c| if c.is_control() { ' ' } else { c }));
        self.text.push('\n');
        self.lines.push(line);
    }

    fn pair(&mut self, line: usize, level: usize, key: &str, value: &str) {
        self.put(line, level, key);
        self.put(line, level + 1, value);
    }

    fn units(&mut self, statement: &Statement) {
        for (key, table) in
            [("LENGTH", &LENGTHS[..]), ("MASS", &MASSES[..]), ("FORCE", &FORCES[..])]
        {
            let Some(name) = statement.get(key) else { continue };
            let found = table.iter().find(|(known, _)| name.eq_ignore_ascii_case(known));
            match (found, key) {
                (Some((_, size)), "LENGTH") => self.length = *size,
                (Some((_, size)), "MASS") => self.mass = *size,
                (Some((_, size)), _) => self.force = *size,
                (None, _) => self.unread.lost(
                    statement.line,
                    format!("UNITS: {key} = {} is not supported", short(name)),
                ),
            }
        }
        let time = statement.get("TIME").unwrap_or("SECOND");
        if !time.eq_ignore_ascii_case("SECOND") {
            self.unread
                .lost(statement.line, format!("UNITS: TIME = {} is not supported", short(time)));
        }
    }

    /// The result; a fault is listed with its statement.
    fn told<T>(&mut self, statement: &Statement, found: Result<T, String>) -> Option<T> {
        let what = |why| format!("{}/{}: {why}", short(&statement.kind), short(&statement.id));
        found.map_err(|why| self.unread.lost(statement.line, what(why))).ok()
    }

    fn assembly(&mut self, all: &[Statement]) {
        let parts: Vec<&Statement> =
            all.iter().filter(|statement| statement.kind == "PART").collect();
        let by_id: HashMap<&str, &Statement> =
            parts.iter().map(|part| (part.id.as_str(), *part)).collect();
        let mut of_part = HashMap::<String, Vec<&Statement>>::new();
        let mut by_marker = HashMap::<&str, &Statement>::new();
        for marker in all.iter().filter(|one| one.kind == "MARKER") {
            by_marker.insert(&marker.id, marker);
            of_part.entry(marker.reference("PART").unwrap_or_default()).or_default().push(marker);
        }
        let markers = |id: &str| of_part.get(id).cloned().unwrap_or_default();
        let ground = parts.iter().find(|part| part.is("GROUND")).map(|part| part.id.clone());
        for marker in all.iter().filter(|statement| statement.kind == "MARKER") {
            let part = marker.reference("PART").unwrap_or_default();
            let within = match by_id.get(part.as_str()) {
                Some(_) if Some(&part) == ground.as_ref() => String::new(),
                Some(one) => format!("/{}", one.name),
                None => {
                    self.unread.lost(
                        marker.line,
                        format!("MARKER/{}: there is no part {}", marker.id, short(&part)),
                    );
                    continue;
                }
            };
            self.markers.insert(marker.id.clone(), format!("/Adams{within}/{}", marker.name));
        }
        self.put(0, 0, "Adams");
        self.put(0, 0, "Assembly");
        self.pair(0, 1, "Name", "Adams");
        self.points(1, &markers(ground.as_deref().unwrap_or_default()));
        self.put(0, 1, "Parts");
        for part in parts.iter().filter(|part| !part.is("GROUND")) {
            self.put(part.line, 2, "Part");
            let found = self.part(part, &by_marker);
            self.told(part, found);
            self.points(3, &markers(&part.id));
        }
        self.put(0, 1, "ConstraintSets");
        self.put(0, 2, "Joints");
        for joint in all.iter().filter(|one| matches!(one.kind.as_str(), "JOINT" | "JPRIM")) {
            let found = self.joint(joint);
            self.told(joint, found);
        }
        self.put(0, 2, "Motions");
        for motion in all.iter().filter(|one| one.kind == "MOTION") {
            let found = self.motion(motion);
            self.told(motion, found);
        }
        self.put(0, 1, "ForceTorques");
        for force in all.iter().filter(|one| matches!(one.kind.as_str(), "SFORCE" | "SPRINGDAMPER"))
        {
            let found = self.force(force);
            self.told(force, found);
        }
        self.gravity(all);
    }

    fn gravity(&mut self, all: &[Statement]) {
        for gravity in all.iter().filter(|one| one.kind == "ACCGRAV") {
            let g = ["IGRAV", "JGRAV", "KGRAV"].map(|key| gravity.number(key));
            let [Ok(x), Ok(y), Ok(z)] = g else {
                self.unread.lost(gravity.line, "ACCGRAV: not a number");
                continue;
            };
            let row = [x, y, z].map(|x| format!("{:?}", x.unwrap_or(0.0) * self.length)).join("\t");
            self.pair(gravity.line, 1, "ConstantGravity", &row);
        }
    }

    fn points(&mut self, level: usize, markers: &[&Statement]) {
        self.put(0, level, "RefPoints");
        for marker in markers {
            let Some(frame) = self.frame(marker, "QP") else { continue };
            self.put(marker.line, level + 1, "RefPoint");
            self.put(marker.line, level + 2, "Markers");
            self.put(marker.line, level + 3, "Marker");
            self.pair(marker.line, level + 4, "Name", &marker.name);
            self.place(marker.line, level + 4, &frame);
        }
    }

    /// Position and rotation of a statement; a fault is listed.
    fn frame(&mut self, statement: &Statement, key: &str) -> Option<([f64; 3], Rotation)> {
        let three = |key: &str| match statement.numbers(key)?.as_deref() {
            None => Ok([0.0; 3]),
            Some(&[x, y, z]) => Ok([x, y, z]),
            Some(other) => Err(format!("{key}: {} numbers; must be 3", other.len())),
        };
        for other in ["ZP", "XP", "ZG", "XG"] {
            if statement.all(other).is_some() {
                self.unread.lost(
                    statement.line,
                    format!(
                        "{}/{}: {other} is not supported; use REULER",
                        statement.kind, statement.id
                    ),
                );
            }
        }
        let (place, angles) =
            (self.told(statement, three(key))?, self.told(statement, three("REULER"))?);
        Some((place.map(|x| x * self.length), euler(angles)))
    }

    fn place(&mut self, line: usize, level: usize, (at, turn): &([f64; 3], Rotation)) {
        self.pair(line, level, "Position3D", &at.map(|x| format!("{x:?}")).join("\t"));
        self.put(line, level, "RotationMatrix");
        for row in turn {
            self.put(line, level + 1, &row.map(|x| format!("{x:?}")).join("\t"));
        }
    }

    fn part(
        &mut self,
        part: &Statement,
        markers: &HashMap<&str, &Statement>,
    ) -> Result<(), String> {
        self.pair(part.line, 3, "Name", &part.name);
        if let Some(frame) = self.frame(part, "QG") {
            self.place(part.line, 3, &frame);
        }
        for key in ["VX", "VY", "VZ", "WX", "WY", "WZ"] {
            if part.number(key)?.is_some_and(|rate| rate != 0.0) {
                return Err(format!("{key}: initial rates are not supported; set them in [start]"));
            }
        }
        let Some(mass) = part.number("MASS")? else { return Ok(()) };
        let center = part.reference("CM");
        let marker = center.as_deref().and_then(|id| markers.get(id).copied());
        if part.get("IM").is_some_and(|_| part.reference("IM") != center) {
            return Err(
                "IM: moments of inertia in another frame than that of CM are not supported".into(),
            );
        }
        self.put(part.line, 3, "PrincipalMassMarker");
        if let Some(frame) = marker.and_then(|marker| self.frame(marker, "QP")) {
            self.place(part.line, 4, &frame);
        } else {
            return Err("CM: there is no such marker".into());
        }
        self.pair(part.line, 4, "Mass", &format!("{:?}", mass * self.mass));
        let inertias = part.numbers("IP")?.unwrap_or_default();
        if inertias.iter().skip(3).any(|product| *product != 0.0) {
            return Err("IP: products of inertia are not supported; turn the marker CM to the principal axes".into());
        }
        let scale = self.mass * self.length * self.length;
        let row: Vec<String> = (0..3)
            .map(|k| format!("{:?}", scale * inertias.get(k).copied().unwrap_or(0.0)))
            .collect();
        self.pair(part.line, 4, "MomentOfInertias", &row.join("\t"));
        Ok(())
    }

    /// The two markers of a statement. Angles and displacements are those of I from J here, and of J from I in assemblies.
    fn ends(&mut self, one: &Statement, level: usize) -> Result<(), String> {
        for (here, there) in [("MarkerI", "J"), ("MarkerJ", "I")] {
            let id = one.reference(there).ok_or_else(|| format!("{there} is missing"))?;
            let path = self
                .markers
                .get(&id)
                .ok_or_else(|| format!("{there}: there is no marker {}", short(&id)))?
                .clone();
            self.pair(one.line, level, here, &path);
        }
        Ok(())
    }

    fn joint(&mut self, joint: &Statement) -> Result<(), String> {
        let known = JOINTS.iter().find(|(word, _)| joint.is(word));
        let Some((_, class)) = known else {
            return Err(format!(
                "joints of type {} are not supported",
                short(&joint.words.join(" "))
            ));
        };
        self.put(joint.line, 3, class);
        self.pair(joint.line, 4, "Name", &joint.name);
        if joint.kind == "JOINT" {
            self.joints.insert(joint.id.clone(), format!("/Adams/{}", joint.name));
        }
        self.ends(joint, 4)
    }

    fn motion(&mut self, motion: &Statement) -> Result<(), String> {
        let id = motion.reference("JOINT").ok_or("only motions of a JOINT are supported")?;
        let joint = self
            .joints
            .get(&id)
            .ok_or_else(|| format!("there is no joint {}", short(&id)))?
            .clone();
        let law = function(motion)?;
        let (class, key, law) = if motion.is("TRANSLATION") {
            ("TranslationalMotion", "TranslationZ", format!("{:?}*({law})", self.length))
        } else if motion.is("ROTATION") {
            ("RotationalMotion", "RotationZ", law)
        } else {
            return Err("it is neither ROTATION nor TRANSLATION".into());
        };
        if ["VELOCITY", "ACCELERATION"].iter().any(|word| motion.is(word)) {
            return Err(
                "motions that prescribe a velocity or an acceleration are not supported".into()
            );
        }
        self.put(motion.line, 3, class);
        self.pair(motion.line, 4, "Name", &motion.name);
        self.pair(motion.line, 4, "MotionJoint", &joint);
        self.pair(motion.line, 4, key, &law);
        Ok(())
    }

    fn force(&mut self, force: &Statement) -> Result<(), String> {
        let (length, rate) =
            (format!("(rIJ(self)/{:?})", self.length), format!("(vrIJ(self)/{:?})", self.length));
        let push = if force.kind == "SPRINGDAMPER"
            && force.words.iter().any(|word| word.starts_with("TRANS"))
        {
            let number = |key: &str| Ok::<_, String>(force.number(key)?.unwrap_or(0.0));
            let (k, c, free, f) = (number("K")?, number("C")?, number("LENGTH")?, number("FORCE")?);
            format!("({f:?}) - ({c:?})*{rate} - ({k:?})*({length} - ({free:?}))")
        } else if force.kind == "SFORCE" && force.is("TRANSLATIONAL") {
            let law = function(force)?;
            let pair = [force.reference("I"), force.reference("J")].map(Option::unwrap_or_default);
            replaced(&replaced(&law, "dm", &pair, &length), "vr", &pair, &rate)
        } else {
            return Err("only forces along the line of two markers are supported".into());
        };
        self.put(force.line, 2, "InLineForceTorque");
        self.pair(force.line, 3, "Name", &force.name);
        self.ends(force, 3)?;
        self.pair(force.line, 3, "tension", &format!("-{:?}*({push})", self.force));
        self.pair(force.line, 3, "twist", "0");
        Ok(())
    }

    /// Names the statements that have no meaning here.
    fn name_rest(&mut self, statement: &Statement) {
        let kind = statement.kind.as_str();
        let read = [
            "UNITS",
            "PART",
            "MARKER",
            "JOINT",
            "JPRIM",
            "MOTION",
            "SFORCE",
            "SPRINGDAMPER",
            "ACCGRAV",
            "END",
        ];
        if LEFT.contains(&kind) {
            self.unread
                .left(statement.line, format!("{kind}/{} is left out", short(&statement.id)));
        } else if !read.contains(&kind) {
            self.unread.lost(
                statement.line,
                format!(
                    "{}/{}: this statement is not supported",
                    short(kind),
                    short(&statement.id)
                ),
            );
        }
    }
}
