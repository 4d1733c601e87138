//! Mechanisms of PMKS+, the web program of Worcester Polytechnic Institute, in a link or a file `.pmks`.
//!
//! | in the text | in the case |
//! |---|---|
//! | joint on ground or of several links | `revolute` between the first of them, or ground, and each other one |
//! | joint of one link | point of that link |
//! | link; welded links | a body with mass, inertia and centre; a link with two joints on ground is part of ground |
//! | slide on ground or in a slot | block with `translational` on the guide, and `revolute` or `weld` to its links |
//! | input | `coordinate_driver`; a negative speed is clockwise |
//! | force | `force`, in the global frame or that of its link |
//! | inches, centimetres, metres | m, with lb, g, kg for masses |
//!
//! Gears, friction and loads on sections are named.

mod text;

use crate::draft::Draft;
use crate::unread::UnreadList;
use crate::Read;
use serde_json::{json, Value};
use std::collections::{HashMap, HashSet};
use text::{short, Drawing, Joint};

/// Acceleration of gravity in PMKS+, m/s².
const GRAVITY: f64 = 9.806_65;
/// Most welds of links that are welded themselves.
const DEEPEST: usize = 64;

/// Whether a text contains a mechanism of PMKS+ in its first lines.
pub(crate) fn begins(text: &str) -> bool {
    text.lines().take(20).any(|line| text::payload(line).is_some())
}

/// Reads a text.
pub(crate) fn read(text: &str) -> Read {
    let mut unread = UnreadList::default();
    let mut lines = text.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
    let found = lines.clone().find(|(line, _)| text::payload(line).is_some());
    let (line, place) = found.or_else(|| lines.next()).unwrap_or(("", 0));
    for (_, other) in lines.filter(|(other, k)| *k != place && text::payload(other).is_some()) {
        unread.lost(other, "a second mechanism is left out");
    }
    let own = text::payload(line).unwrap_or(line);
    // a link has escapes, and a file has none
    let own = if own.len() < line.trim().len() { text::unescaped(own) } else { own.into() };
    match text::drawing(&own, place, &mut unread) {
        Ok(drawing) => Mechanism::new(&drawing, place, unread).read(),
        Err(why) => {
            unread.lost(place, why);
            Read::nothing(unread)
        }
    }
}

/// A body: that of a link, or ground.
type Body = Option<usize>;

/// A mechanism while it is read.
struct Mechanism<'a> {
    drawing: &'a Drawing<'a>,
    line: usize,
    draft: Draft,
    unread: UnreadList,
    joints: HashMap<&'a str, &'a Joint<'a>>,
    /// The links of their own, each by its identifier and those of its parts.
    links: HashMap<&'a str, usize>,
    /// The name and the origin of the body of each link; ground if it has none.
    bodies: Vec<Option<(String, [f64; 2])>>,
    /// The bodies of each joint, and the pins of each slide with the masses of their blocks.
    owners: HashMap<&'a str, Vec<Body>>,
    pins: HashMap<&'a str, Vec<(&'a Joint<'a>, f64)>>,
    /// Durations of a turn of the inputs.
    turns: Vec<f64>,
}

impl<'a> Mechanism<'a> {
    fn new(drawing: &'a Drawing<'a>, line: usize, unread: UnreadList) -> Self {
        let mut draft = Draft::titled("PMKS+");
        draft.gravity = [0.0, if drawing.weightless { 0.0 } else { -GRAVITY }];
        Self {
            drawing,
            line,
            draft,
            unread,
            joints: HashMap::new(),
            links: HashMap::new(),
            bodies: Vec::new(),
            owners: HashMap::new(),
            pins: HashMap::new(),
            turns: Vec::new(),
        }
    }

    fn lost(&mut self, what: &str, name: &str, why: &str) {
        self.unread.lost(self.line, format!("{what} {}: {why}", short(name)));
    }

    fn read(mut self) -> Read {
        for joint in &self.drawing.joints {
            if self.joints.insert(joint.id, joint).is_some() {
                self.lost("joint", joint.id, "there is another one");
            }
        }
        self.number_links();
        self.draw_bodies();
        self.blocks();
        let paired: HashSet<&str> = self.pins.values().flatten().map(|(pin, _)| pin.id).collect();
        for joint in &self.drawing.joints {
            match joint.slides {
                true => self.slide(joint),
                false if !paired.contains(joint.id) => self.pin(joint),
                false => {}
            }
        }
        self.forces();
        let turn = self.turns.iter().copied().reduce(f64::max);
        let entry = match turn {
            Some(t_end) => Some(json!({ "type": "kinematics", "t_end": t_end, "from": "start" })),
            None if self.draft.analyses.is_empty() => Some(json!({ "type": "mobility" })),
            None => None,
        };
        self.draft.analyses.extend(entry.map(|entry| ("motion".into(), entry)));
        Read { case: Some(self.draft.text()), unread: self.unread.sorted(), results: Vec::new() }
    }

    /// The link to which each identifier belongs: a welded part belongs to the whole.
    fn number_links(&mut self) {
        let links = &self.drawing.links;
        let mut wholes: HashMap<&str, &str> = HashMap::new();
        for link in links {
            for part in &link.parts {
                if wholes.insert(part, link.id).is_some() {
                    self.lost("link", part, "it is welded into two links");
                }
            }
        }
        let mut known = HashMap::new();
        for (k, link) in links.iter().enumerate() {
            if known.insert(link.id, k).is_some() {
                self.lost("link", link.id, "there is another one");
            }
        }
        for link in links {
            let mut whole = link.id;
            for _ in 0..DEEPEST {
                whole = wholes.get(whole).copied().unwrap_or(whole);
            }
            match known.get(whole).filter(|k| links[**k].own) {
                Some(k) => drop(self.links.insert(link.id, *k)),
                None => self.lost("link", link.id, "it belongs to no link that moves"),
            }
            for id in link.parts.iter().filter(|id| !known.contains_key(*id)) {
                self.lost("link", link.id, &format!("there is no link {}", short(id)));
            }
        }
    }

    /// A body for each link, with its frame at its first joint, unless two joints hold it on ground.
    fn draw_bodies(&mut self) {
        for (k, link) in self.drawing.links.iter().enumerate() {
            let whole = self.links.get(link.id).map(|k| &self.drawing.links[*k].joints);
            for id in &link.joints {
                if !self.joints.contains_key(id) || whole.is_some_and(|ids| !ids.contains(id)) {
                    self.lost("link", link.id, &format!("there is no joint {}", short(id)));
                }
            }
            self.bodies.push(None);
            let ends: Vec<&Joint> =
                link.joints.iter().filter_map(|id| self.joints.get(id).copied()).collect();
            let whole = link.own && !link.block && self.links.get(link.id) == Some(&k);
            let Some(first) = ends.first().filter(|_| whole) else {
                if link.own && !link.block {
                    self.lost("link", link.id, "it has no joints, or is a part of another one");
                }
                continue;
            };
            let held: Vec<[f64; 2]> =
                ends.iter().filter(|end| end.ground && !end.slides).map(|end| end.at).collect();
            let fixed = held.iter().any(|at| *at != held[0]);
            if !fixed {
                let center = [0, 1].map(|k| link.center[k] - first.at[k]);
                let entry = json!({ "mass": link.mass, "inertia": link.inertia, "center": center });
                self.bodies[k] = Some((self.body(link.name, first.at, entry), first.at));
            }
            for end in ends {
                let owners = self.owners.entry(end.id).or_default();
                let body = (!fixed).then_some(k);
                if !owners.contains(&body) {
                    owners.push(body);
                }
            }
        }
    }

    /// Adds a body that starts at a place without an angle.
    fn body(&mut self, name: &str, at: [f64; 2], entry: Value) -> String {
        let name = self.draft.name(name);
        self.draft.bodies.insert(name.clone(), entry);
        for (coordinate, value) in [("x", at[0]), ("y", at[1]), ("angle", 0.0)] {
            self.draft.guess.insert(format!("{name}.{coordinate}"), json!(value));
        }
        name
    }

    /// The reference to a place on a body.
    fn point(&mut self, body: Body, name: &str, at: [f64; 2]) -> String {
        match body.and_then(|k| self.bodies[k].clone()) {
            Some((body, from)) => self.draft.point(&body, name, [at[0] - from[0], at[1] - from[1]]),
            None => self.draft.point("ground", name, at),
        }
    }

    fn join(&mut self, kind: &str, name: &str, i: &str, j: &str, axis: f64) -> String {
        let joint = self.draft.name(name);
        let mut entry = json!({ "type": kind, "i": i, "j": j });
        if kind == "translational" {
            entry["axes"] = json!([axis, axis]);
        }
        self.draft.joints.insert(joint.clone(), entry);
        joint
    }

    fn drive(&mut self, name: &str, coordinate: String, speed: f64) -> String {
        let driver = self.draft.name(&format!("drive_{name}"));
        let value = format!("{speed}*t");
        let entry =
            json!({ "type": "coordinate_driver", "coordinate": coordinate, "value": value });
        self.draft.drivers.insert(driver.clone(), entry);
        driver
    }

    /// A joint that turns, and its input.
    fn pin(&mut self, joint: &'a Joint<'a>) {
        let mut bodies: Vec<Body> = if joint.ground { vec![None] } else { Vec::new() };
        for body in self.owners.get(joint.id).into_iter().flatten() {
            if !bodies.contains(body) {
                bodies.push(*body);
            }
        }
        let points: Vec<String> =
            bodies.iter().map(|body| self.point(*body, joint.name, joint.at)).collect();
        if points.is_empty() {
            let what = format!("joint {}: it is on no link", short(joint.id));
            self.unread.left(self.line, what);
        }
        let mut angle = None;
        for point in points.iter().skip(1) {
            let name = self.join("revolute", joint.name, &points[0], point, 0.0);
            angle = Some(format!("{name}.angle"));
        }
        match angle.filter(|_| joint.input) {
            Some(angle) if points.len() == 2 => {
                self.drive(joint.name, angle, joint.speed);
                self.turns.extend(
                    (joint.speed != 0.0).then(|| std::f64::consts::TAU / joint.speed.abs()),
                );
            }
            None if !joint.input => {}
            _ => self.lost("joint", joint.id, "an input needs two bodies"),
        }
    }

    /// The pins of slides in older texts, which have a link between both.
    fn blocks(&mut self) {
        for link in self.drawing.links.iter().filter(|link| link.block) {
            let ends: Vec<&Joint> =
                link.joints.iter().filter_map(|id| self.joints.get(id).copied()).collect();
            match ends[..] {
                [a, b] if a.slides != b.slides => {
                    let (pin, slide) = if a.slides { (b, a) } else { (a, b) };
                    self.pins.entry(slide.id).or_default().push((pin, link.mass));
                    if pin.input {
                        self.lost("joint", pin.id, "an input turns the pin of a slide");
                    }
                }
                _ => self.lost("link", link.id, "a block needs a slide and a pin"),
            }
        }
    }

    /// The guide of a slide: its body, a place on its line, and its direction.
    fn guide(
        &self,
        joint: &Joint<'a>,
        ground: bool,
    ) -> Result<(Body, [f64; 2], f64), &'static str> {
        let Some([link, a, b]) = joint.slot else {
            return if ground { Ok((None, joint.at, joint.angle)) } else { Err("it has no guide") };
        };
        if ground {
            return Err("it has two guides");
        }
        let k = *self.links.get(link).ok_or("there is no link for its slot")?;
        let [Some(a), Some(b)] = [a, b].map(|id| {
            let on = self.drawing.links[k].joints.contains(&id);
            self.joints.get(id).filter(|_| on)
        }) else {
            return Err("the joints of its slot are not on its link");
        };
        let [dx, dy] = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
        if dx == 0.0 && dy == 0.0 {
            return Err("its slot has no direction");
        }
        // texts are rounded: the line of the slot is exact, and the slide is brought to it
        let along = (joint.at[0] - a.at[0]) * dx + (joint.at[1] - a.at[1]) * dy;
        let along = along / (dx * dx + dy * dy);
        let foot = [a.at[0] + along * dx, a.at[1] + along * dy];
        Ok((self.bodies[k].is_some().then_some(k), foot, dy.atan2(dx)))
    }

    /// A slide: a block on its guide, and the links that ride on it.
    fn slide(&mut self, joint: &'a Joint<'a>) {
        let pins = self.pins.remove(joint.id).unwrap_or_default();
        let name = pins.first().map_or(joint.name, |(pin, _)| pin.name);
        let held = joint.slot.is_none() && pins.iter().any(|(pin, _)| pin.ground);
        let (guide, at, angle) = match self.guide(joint, joint.ground || held) {
            Ok(guide) => guide,
            Err(why) => return self.lost("joint", joint.id, why),
        };
        let ids = pins.iter().map(|(pin, _)| pin.id).chain([joint.id]);
        let owners = ids.flat_map(|id| self.owners.get(id).cloned().unwrap_or_default());
        let mut riders: Vec<Body> = owners.filter(|body| *body != guide).collect();
        riders.sort_unstable();
        riders.dedup();
        if riders.is_empty() {
            if joint.input {
                self.lost("joint", joint.id, "an input needs two bodies");
            }
            let what = format!("joint {}: nothing slides on its guide", short(joint.id));
            return self.unread.left(self.line, what);
        }
        let mass = joint.mass + pins.iter().map(|(_, mass)| mass).sum::<f64>();
        let block = json!({ "mass": mass, "inertia": 0.0 });
        let block = self.body(&format!("{name}_block"), at, block);
        let (i, j) = (self.point(guide, name, at), self.draft.point(&block, name, [0.0; 2]));
        let slide = self.join("translational", &format!("{name}_slide"), &i, &j, angle);
        let fixed = if pins.is_empty() { joint.welded } else { pins.iter().any(|(p, _)| p.welded) };
        for body in riders {
            let point = self.point(body, name, joint.at);
            self.join(if fixed { "weld" } else { "revolute" }, name, &j, &point, 0.0);
        }
        if joint.sealed {
            let what = format!("joint {}: the cylinder has no ends here", short(joint.id));
            self.unread.left(self.line, what);
        }
        if joint.input {
            let driver = self.drive(name, format!("{slide}.displacement"), joint.speed);
            let range = self.draft.name(&format!("range_{name}"));
            self.draft
                .analyses
                .insert(range, json!({ "type": "limits", "over": driver, "from": "start" }));
        }
    }

    fn forces(&mut self) {
        for force in &self.drawing.forces {
            let link = self.links.get(force.link).copied();
            let Some(k) = link.filter(|k| !self.drawing.links[*k].block) else {
                self.lost("force", force.name, "it acts on no link that moves");
                continue;
            };
            if self.bodies[k].is_none() {
                let what = format!("force {}: it acts on ground", short(force.name));
                self.unread.left(self.line, what);
                continue;
            }
            let point = self.point(Some(k), force.name, force.at);
            let frame = if force.local { "j" } else { "global" };
            let entry =
                json!({ "type": "force", "j": point, "force": force.force, "frame": frame });
            let name = self.draft.name(force.name);
            self.draft.forces.insert(name, entry);
        }
    }
}
