//! `.linkage2`: mechanisms of Linkage by David Rector.
//!
//! | in the file | in the case |
//! |---|---|
//! | anchor | point of ground |
//! | link | body with the mass of a rod of 1 kg/m, since files have no masses; a link of anchors alone is part of ground |
//! | connector of several links | `revolute` between the first of them, or ground, and each other one |
//! | input with `rpm` | `coordinate_driver`; a positive rpm is clockwise |
//! | slider between two connectors | `pin_in_slot` on the link of both |
//! | connector or link that is fastened to a link | point of that link; `weld` |
//! | actuator with `throw` and `cpm` | `distance` whose length grows or shrinks once |
//! | gears, chain | `gear` with radii from the distance of the centres; `belt` |
//! | lengths in 1/96 inch | m |
//!
//! Curved slides, oscillating inputs and links that are fastened to a connector are named.

mod document;

use crate::draft::{rod, Draft};
use crate::unread::UnreadList;
use crate::Read;
use document::{Connector, Document, Link};
use serde_json::json;
use std::collections::{HashMap, HashSet};

/// A mechanism while it is read: the body of each link, and the bodies of each connector.
struct Mechanism<'a> {
    document: &'a Document,
    draft: Draft,
    unread: UnreadList,
    bodies: Vec<Option<String>>,
    /// The place of each connector, and of each link, by its identifier.
    places: HashMap<i64, usize>,
    links: HashMap<i64, usize>,
    /// The links of each connector, without actuators.
    owners: Vec<Vec<usize>>,
    /// Times after which the motion repeats or ends.
    times: Vec<f64>,
}

/// Reads a text.
pub(crate) fn read(text: &str) -> Read {
    let mut unread = UnreadList::default();
    let Some(document) = document::read(text, &mut unread) else { return Read::nothing(unread) };
    let mut mechanism = Mechanism::new(&document, unread);
    mechanism.draw_bodies();
    for place in 0..document.connectors.len() {
        mechanism.pins(place);
        mechanism.slide(place);
    }
    for link in &document.links {
        mechanism.actuator(link);
        mechanism.fasten(link);
    }
    for ratio in &document.ratios {
        mechanism.wheels(ratio);
    }
    mechanism.finish()
}

/// Mass of a link per length, kg/m. The files have no masses; positions and rates do not depend on them.
const DENSITY: f64 = 1.0;
impl<'a> Mechanism<'a> {
    fn new(document: &'a Document, mut unread: UnreadList) -> Self {
        let draft = Draft::titled("Linkage");
        let by_id =
            |ids: Vec<i64>| ids.into_iter().enumerate().rev().map(|(k, id)| (id, k)).collect();
        let places: HashMap<i64, usize> = by_id(document.connectors.iter().map(|c| c.id).collect());
        let links: HashMap<i64, usize> = by_id(document.links.iter().map(|link| link.id).collect());
        for (what, lines) in [
            ("connector", document.connectors.iter().map(|c| (c.id, c.line)).collect::<Vec<_>>()),
            ("link", document.links.iter().map(|link| (link.id, link.line)).collect()),
        ] {
            let mut known = HashSet::new();
            for (id, line) in lines.into_iter().filter(|(id, _)| !known.insert(*id)) {
                unread.lost(line, format!("there is another {what} {id}"));
            }
        }
        let mut owners = vec![Vec::new(); document.connectors.len()];
        for (k, link) in
            document.links.iter().enumerate().filter(|(_, link)| link.actuator.is_none())
        {
            for place in link.connectors.iter().filter_map(|id| places.get(id)) {
                owners[*place].push(k);
            }
        }
        for (place, connector) in document.connectors.iter().enumerate() {
            owners[place].extend(connector.on.and_then(|id| links.get(&id)));
            owners[place].dedup();
        }
        Self {
            document,
            draft,
            unread,
            bodies: Vec::new(),
            places,
            links,
            owners,
            times: Vec::new(),
        }
    }

    fn connector(&self, id: i64) -> Option<&'a Connector> {
        self.places.get(&id).map(|place| &self.document.connectors[*place])
    }

    /// A body for each link that is not part of ground, with its frame at its first connector.
    fn draw_bodies(&mut self) {
        for link in &self.document.links {
            let ends: Vec<&Connector> =
                link.connectors.iter().filter_map(|id| self.connector(*id)).collect();
            for id in link.connectors.iter().filter(|id| !self.places.contains_key(id)) {
                self.unread.lost(link.line, format!("{}: there is no connector {id}", link.name));
            }
            let anchored = ends.iter().filter(|end| end.anchor && end.slide.is_none()).count();
            let (Some(first), None) = (ends.first(), link.actuator) else {
                self.bodies.push(None);
                continue;
            };
            // a link of one connector is a dot in the drawing, unless something turns it
            let dot = ends.len() == 1 && first.input.is_none() && !self.is_wheel(link);
            if anchored == ends.len() && anchored > 1 || dot && first.anchor {
                self.bodies.push(Some("ground".into()));
                continue;
            }
            if dot {
                self.bodies.push(None);
                continue;
            }
            let name = self.draft.name(&link.name);
            let points: Vec<[f64; 2]> =
                ends.iter().map(|end| [end.at[0] - first.at[0], end.at[1] - first.at[1]]).collect();
            self.draft.bodies.insert(name.clone(), rod(&points, DENSITY));
            for (coordinate, value) in [("x", first.at[0]), ("y", first.at[1]), ("angle", 0.0)] {
                self.draft.guess.insert(format!("{name}.{coordinate}"), json!(value));
            }
            self.bodies.push(Some(name));
        }
    }

    /// Whether a link of one connector turns: it is a gear or fastened.
    fn is_wheel(&self, link: &Link) -> bool {
        let in_ratio = |id: i64| {
            self.document.ratios.iter().any(|r| r.wheels.iter().any(|(wheel, _)| *wheel == id))
        };
        link.on.is_some() || in_ratio(link.id)
    }

    /// The reference to a connector on a body.
    fn point(&mut self, body: &str, link: Option<usize>, connector: &Connector) -> String {
        let first = link.and_then(|k| {
            let ids = &self.document.links[k].connectors;
            ids.iter().find_map(|id| self.connector(*id))
        });
        let origin =
            if body == "ground" { [0.0, 0.0] } else { first.map_or([0.0, 0.0], |first| first.at) };
        self.draft.point(
            body,
            &connector.name,
            [connector.at[0] - origin[0], connector.at[1] - origin[1]],
        )
    }

    /// The bodies of a connector with their points; ground is first.
    fn ends(&mut self, place: usize) -> Vec<(String, String)> {
        let connector = &self.document.connectors[place];
        let mut bodies: Vec<(String, Option<usize>)> = Vec::new();
        if connector.anchor {
            bodies.push(("ground".into(), None));
        }
        for k in self.owners[place].clone() {
            if let Some(body) =
                self.bodies[k].clone().filter(|body| bodies.iter().all(|(other, _)| other != body))
            {
                bodies.push((body, Some(k)));
            }
        }
        bodies.sort_by_key(|(body, _)| body != "ground");
        let point = |(body, link): (String, Option<usize>)| {
            (body.clone(), self.point(&body, link, connector))
        };
        bodies.into_iter().map(point).collect()
    }

    /// Pins between the links of a connector, and its input. A slider that is an anchor is a pin of ground in the slot.
    fn pins(&mut self, place: usize) {
        let connector = &self.document.connectors[place];
        let ends = self.ends(place);
        for (body, point) in ends.iter().skip(1) {
            let joint = self.draft.name(&connector.name);
            let entry = json!({ "type": "revolute", "i": ends[0].1, "j": point });
            self.draft.joints.insert(joint.clone(), entry);
            let Some(rpm) = connector.input.filter(|_| connector.anchor) else { continue };
            let driver = self.draft.name(&format!("drive_{body}"));
            let rate = -rpm * std::f64::consts::TAU / 60.0;
            let entry = json!({ "type": "coordinate_driver", "coordinate": format!("{joint}.angle"), "value": format!("{rate}*t") });
            self.draft.drivers.insert(driver, entry);
            self.times.extend((rpm != 0.0).then(|| 60.0 / rpm.abs()));
        }
        if connector.input.is_some() && (!connector.anchor || ends.len() < 2) {
            self.unread.lost(
                connector.line,
                format!("{}: an input needs an anchor and a link", connector.name),
            );
        }
        if ends.is_empty() && !self.in_actuator(connector.id) {
            self.unread.left(
                connector.line,
                format!("{}: a connector without links is left out", connector.name),
            );
        }
    }

    fn in_actuator(&self, id: i64) -> bool {
        self.document
            .links
            .iter()
            .any(|link| link.actuator.is_some() && link.connectors.contains(&id))
    }

    /// The pin of a slider in the slot between its limits.
    fn slide(&mut self, place: usize) {
        let connector = &self.document.connectors[place];
        let Some(limits) = connector.slide else { return };
        let [Some(a), Some(b)] = limits.map(|id| self.places.get(&id).copied()) else {
            return self.unread.lost(
                connector.line,
                format!("{}: a limit of the slide is missing", connector.name),
            );
        };
        let (first, second) = (&self.document.connectors[a], &self.document.connectors[b]);
        let shared = self.owners[a].iter().find(|k| self.owners[b].contains(k)).copied();
        let carrier = match shared.and_then(|k| self.bodies[k].clone()) {
            Some(body) => Some((body, shared)),
            None if first.anchor && second.anchor => Some(("ground".to_string(), None)),
            None => None,
        };
        let (Some((body, link)), Some((_, pin))) = (carrier, self.ends(place).into_iter().next())
        else {
            let what = format!("{}: its two limits are on different links", connector.name);
            return self.unread.lost(connector.line, what);
        };
        let start = self.point(&body, link, first);
        let axis = (second.at[1] - first.at[1]).atan2(second.at[0] - first.at[0]);
        let joint = self.draft.name(&format!("{}_slide", connector.name));
        let entry = json!({ "type": "pin_in_slot", "i": start, "j": pin, "axis": axis });
        self.draft.joints.insert(joint, entry);
    }

    /// A link whose length changes.
    fn actuator(&mut self, link: &Link) {
        let Some([stroke, cpm]) = link.actuator else { return };
        let ends: Vec<usize> =
            link.connectors.iter().filter_map(|id| self.places.get(id).copied()).collect();
        let &[a, b] = &ends[..] else {
            return self
                .unread
                .lost(link.line, format!("{}: an actuator needs two connectors", link.name));
        };
        let points = [a, b].map(|place| self.ends(place).into_iter().next());
        let [Some((_, i)), Some((_, j))] = points else {
            return self
                .unread
                .lost(link.line, format!("{}: an end of the actuator is on no link", link.name));
        };
        let (from, to) = (self.document.connectors[a].at, self.document.connectors[b].at);
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let rate = stroke * cpm / 30.0;
        let joint = self.draft.name(&link.name);
        let entry = json!({ "type": "distance", "i": i, "j": j, "length": format!("{length} + ({rate})*t") });
        self.draft.joints.insert(joint, entry);
        self.times.extend((cpm != 0.0).then(|| 30.0 / cpm.abs()));
        self.unread
            .left(link.line, format!("{}: the actuator moves once and does not return", link.name));
    }

    /// A link that is fastened to another one.
    fn fasten(&mut self, link: &Link) {
        let Some(other) = link.on else { return };
        let find = |id: i64| self.links.get(&id).and_then(|k| Some((*k, self.bodies[*k].clone()?)));
        let this = self.document.links.iter().position(|one| std::ptr::eq(one, link));
        let this = this.and_then(|k| Some((k, self.bodies[k].clone()?)));
        let (Some((k, i)), Some((own, j))) = (find(other), this) else {
            return self.unread.lost(link.line, format!("{}: there is no link {other}", link.name));
        };
        let Some(connector) = link.connectors.iter().find_map(|id| self.connector(*id)) else {
            return;
        };
        if i == j {
            return;
        }
        let (i, j) = (self.point(&i, Some(k), connector), self.point(&j, Some(own), connector));
        let joint = self.draft.name(&format!("{}_fastened", link.name));
        self.draft.joints.insert(joint, json!({ "type": "weld", "i": i, "j": j }));
    }

    /// Two gears, or two wheels with a chain.
    fn wheels(&mut self, ratio: &document::Ratio) {
        let found: Vec<_> = ratio
            .wheels
            .iter()
            .filter(|(_, size)| *size > 0.0)
            .filter_map(|(id, size)| {
                let k = *self.links.get(id)?;
                let center =
                    self.document.links[k].connectors.first().and_then(|id| self.connector(*id))?;
                Some((k, self.bodies[k].clone()?, center, *size))
            })
            .collect();
        let [(ki, i, ci, si), (kj, j, cj, sj)] = &found[..] else {
            return self.unread.lost(ratio.line, "ratio: it needs two links with sizes");
        };
        let [dx, dy] = [cj.at[0] - ci.at[0], cj.at[1] - ci.at[1]];
        let (distance, sigma) = (dx.hypot(dy), if ratio.chain { -1.0 } else { 1.0 });
        let radii = [si, sj].map(|size| distance * size / (si + sj));
        let offset = -(radii[0] + sigma * radii[1]) * dy.atan2(dx);
        let points = [self.point(i, Some(*ki), ci), self.point(j, Some(*kj), cj)];
        let kind = if ratio.chain { "belt" } else { "gear" };
        let joint = self.draft.name(&format!("{kind}_{i}_{j}"));
        let entry = json!({ "type": kind, "i": points[0], "j": points[1], "radii": radii, "offset": offset });
        self.draft.joints.insert(joint, entry);
    }

    fn finish(mut self) -> Read {
        let time = self.times.iter().copied().reduce(f64::min);
        let longest = self.times.iter().copied().reduce(f64::max);
        let ends = self.document.links.iter().any(|link| link.actuator.is_some());
        let entry = match if ends { time } else { longest } {
            Some(t_end) => json!({ "type": "kinematics", "t_end": t_end }),
            None => json!({ "type": "mobility" }),
        };
        self.draft.analyses.insert("motion".into(), entry);
        Read { case: Some(self.draft.text()), unread: self.unread.sorted(), results: Vec::new() }
    }
}
