//! DXF: outlines and points of links, one layer for each body.
//!
//! | in the file | in the case |
//! |---|---|
//! | layer | body; the layers `ground` and `0` are ground |
//! | closed polyline (`LWPOLYLINE`, `POLYLINE`), with arcs | outline, and with it mass and inertia of a plate |
//! | circle, point | point; a text on the layer that begins at its centre is its name |
//! | points of several layers at one place | `revolute` between the first of the layers and each other one |
//! | `$INSUNITS` | unit of lengths |
//!
//! Open lines and other entities of the drawing are listed; blocks are named.

mod entities;
mod places;
mod shape;
mod write;

use crate::draft::Draft;
use crate::unread::UnreadList;
use crate::Read;
use entities::{number, Entity, Fault};
use places::Places;
use serde_json::json;
use shape::Corner;
pub use write::{write, Line, Sheet};

/// Mass per area of a plate, kg/m²: 5 mm of steel.
const DENSITY: f64 = 7850.0 * 0.005;
/// Flags of a `POLYLINE` that is a mesh in space.
const MESH: i64 = 16 | 64;
/// Flag of a `VERTEX` that a curve does not pass.
const FRAME: i64 = 16;
/// Largest distance of points at one place, as a share of the largest coordinate.
const CLOSE: f64 = 1e-7;
/// Mass per length of a body without an outline, kg/m.
const ROD: f64 = 1.0;

/// A layer with what lies on it, in metres.
#[derive(Debug, Default)]
struct Layer {
    name: String,
    outlines: Vec<Vec<Corner>>,
    points: Vec<[f64; 2]>,
    texts: Vec<Text>,
}

/// A text with its place and its line.
#[derive(Debug)]
struct Text {
    at: [f64; 2],
    text: String,
    line: usize,
}

/// Reads a text.
pub(crate) fn read(text: &str) -> Read {
    let mut unread = UnreadList::default();
    if text.starts_with("AutoCAD Binary DXF") {
        unread.lost(1, "a binary DXF file; save it as an ASCII file");
        return Read::nothing(unread);
    }
    let (header, entities) = entities::read(text, &mut unread);
    if header.is_empty() && entities.is_empty() {
        unread.lost(0, "there is no section HEADER or ENTITIES; this is not a DXF file");
        return Read::nothing(unread);
    }
    let unit = match entities::unit(&header) {
        Ok(Some(unit)) => unit,
        Ok(None) => {
            unread.left(0, "$INSUNITS: the file has no unit; lengths are taken as millimetres");
            1e-3
        }
        Err((line, what)) => {
            unread.lost(line, what);
            1e-3
        }
    };
    let layers = layers(&entities, unit, &mut unread);
    let mut draft = Draft::titled("DXF");
    draw(layers, &mut draft, &mut unread);
    Read { case: Some(draft.text()), unread: unread.sorted(), results: Vec::new() }
}

/// Sorts the entities by their layers.
fn layers(entities: &[Entity<'_>], unit: f64, unread: &mut UnreadList) -> Vec<Layer> {
    let mut layers: Vec<Layer> = Vec::new();
    let mut places = std::collections::HashMap::<String, usize>::new();
    let mut k = 0;
    while k < entities.len() {
        let entity = &entities[k];
        let mut end = k + 1;
        if entity.kind == "POLYLINE" {
            let rest = entities[end..].iter();
            end += rest.take_while(|next| matches!(next.kind, "VERTEX" | "SEQEND")).count();
        }
        let name = entity.layer();
        let name = if matches!(name, "0") || name.eq_ignore_ascii_case("ground") {
            "ground"
        } else {
            name
        };
        let place = *places.entry(name.to_string()).or_insert_with(|| {
            layers.push(Layer { name: name.to_string(), ..Layer::default() });
            layers.len() - 1
        });
        if let Err((line, why)) = take(&entities[k..end], unit, &mut layers[place], unread) {
            unread.lost(line, format!("{}: {why}", entity.kind));
        }
        k = end;
    }
    layers
}

/// Adds an entity to its layer.
fn take(
    entities: &[Entity<'_>],
    unit: f64,
    layer: &mut Layer,
    unread: &mut UnreadList,
) -> Result<(), Fault> {
    let entity = &entities[0];
    let number = |code| entity.number(code).map_err(|line| (line, "not a number"));
    // a plane seen from behind has x to the left
    let (up, across) = (number(230)?.unwrap_or(1.0), (number(210)?, number(220)?));
    let tilted = |x: Option<f64>| x.is_some_and(|x| x.abs() > 1e-9);
    if tilted(across.0) || tilted(across.1) {
        unread.lost(entity.line, format!("{}: it lies in another plane than xy", entity.kind));
        return Ok(());
    }
    let side = if up < 0.0 { -1.0 } else { 1.0 };
    let place = |entity: &Entity<'_>| -> Result<[f64; 2], Fault> {
        Ok([side * unit * entity.required(10)?, unit * entity.required(20)?])
    };
    match entity.kind {
        kind if entity.flag(67, 1) => {
            let what = format!("{} on layer {}: on a sheet", short(kind), layer.name);
            unread.left(entity.line, what);
        }
        "POLYLINE" if entity.flag(70, MESH) => {
            unread.left(entity.line, format!("mesh on layer {}: not a line", layer.name));
        }
        "CIRCLE" | "POINT" => layer.points.push(place(entity)?),
        "TEXT" => {
            let text = entity.text(1).unwrap_or_default().to_string();
            layer.texts.push(Text { at: place(entity)?, text, line: entity.line });
        }
        "LWPOLYLINE" | "POLYLINE" if entity.flag(70, 1) => {
            let line = match entity.kind {
                "POLYLINE" => vertices(entities, side, unit)?,
                _ => light(entity, side, unit)?,
            };
            if encloses(&line) {
                layer.outlines.push(line);
            } else {
                unread.left(entity.line, "a closed line without an area is left out");
            }
        }
        "INSERT" => {
            let name = short(entity.text(2).unwrap_or_default());
            unread.lost(entity.line, format!("INSERT: the block {name} is not read; explode it"));
        }
        "VERTEX" | "SEQEND" => {
            unread.lost(entity.line, format!("{} without a POLYLINE", entity.kind))
        }
        other => {
            let kind = short(other);
            let kind = if kind.ends_with("POLYLINE") { "open polyline".into() } else { kind };
            let why = "not a closed polyline, circle or point";
            unread.left(entity.line, format!("{kind} on layer {}: {why}", layer.name));
        }
    }
    Ok(())
}

/// Whether a closed line may have an area.
fn encloses(line: &[Corner]) -> bool {
    line.len() > 2 || line.len() == 2 && line.iter().any(|corner| corner.bulge != 0.0)
}

/// The beginning of a text, for messages.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

/// The corners of a `POLYLINE`.
fn vertices(entities: &[Entity<'_>], side: f64, unit: f64) -> Result<Vec<Corner>, Fault> {
    let all = entities.iter().filter(|entity| entity.kind == "VERTEX" && !entity.flag(70, FRAME));
    all.map(|vertex| {
        let [x, y] = [vertex.required(10)?, vertex.required(20)?];
        let bulge = vertex.number(42).map_err(|line| (line, "not a number"))?;
        let bulge = side * bulge.unwrap_or(0.0);
        Ok(Corner { at: [side * unit * x, unit * y], bulge })
    })
    .collect()
}

/// The corners of an `LWPOLYLINE`.
fn light(entity: &Entity<'_>, side: f64, unit: f64) -> Result<Vec<Corner>, Fault> {
    let mut line: Vec<Corner> = Vec::new();
    let value = |pair| number(pair).map_err(|line| (line, "not a number"));
    let rows = entity.pairs.iter().filter(|pair| pair.code == 20).count();
    for pair in &entity.pairs {
        match pair.code {
            10 => line.push(Corner { at: [side * unit * value(pair)?, 0.0], bulge: 0.0 }),
            20 | 42 => {
                let value = value(pair)?;
                let last = line.last_mut().ok_or((pair.line, "a coordinate is missing"))?;
                if pair.code == 20 {
                    last.at[1] = unit * value;
                } else {
                    last.bulge = side * value;
                }
            }
            _ => {}
        }
    }
    let count = entity.text(90).and_then(|text| text.parse::<usize>().ok());
    if rows != line.len() || count.is_some_and(|count| count != line.len()) {
        return Err((entity.line, "a coordinate is missing"));
    }
    Ok(line)
}

/// The names of the points of a layer: the texts at their places. Other texts are listed.
fn names(layer: &Layer, close: f64, unread: &mut UnreadList) -> Vec<Option<String>> {
    let (mut places, mut texts) = (Places::new(close), Vec::<(&Text, bool)>::new());
    let mut left = |text: &Text| {
        let what = "a text that is the name of no point is left out";
        unread.left(text.line, format!("TEXT on layer {}: {what}", layer.name));
    };
    for text in &layer.texts {
        match !text.text.trim().is_empty() && places.put(text.at).1 {
            true => texts.push((text, false)),
            false => left(text),
        }
    }
    let mut named = Vec::new();
    for at in &layer.points {
        let text = places.find(*at).map(|place| {
            texts[place].1 = true;
            texts[place].0.text.clone()
        });
        named.push(text);
    }
    texts.iter().filter(|(_, used)| !used).for_each(|(text, _)| left(text));
    named
}

/// Bodies from layers, and pins where points of several layers coincide.
fn draw(layers: Vec<Layer>, draft: &mut Draft, unread: &mut UnreadList) {
    let all = layers.iter().flat_map(|layer| &layer.points);
    let close = CLOSE * all.flat_map(|at| at.map(f64::abs)).fold(0.0, f64::max);
    let (mut places, mut pins) = (Places::new(close), Vec::<Vec<(String, String)>>::new());
    for layer in layers {
        let ground = layer.name == "ground";
        let names = names(&layer, close, unread);
        if !ground && layer.outlines.is_empty() && layer.points.is_empty() {
            continue;
        }
        let body = if ground { layer.name.clone() } else { draft.name(&layer.name) };
        let mut entry = if ground { json!({}) } else { mass(&layer) };
        match &layer.outlines[..] {
            [] => {}
            [line] if line.len() > 2 && line.iter().all(|corner| corner.bulge == 0.0) => {
                entry["outline"] = json!(line.iter().map(|corner| corner.at).collect::<Vec<_>>());
            }
            lines => {
                let path = lines.iter().map(|line| shape::path(line)).collect::<Vec<_>>().join(" ");
                entry["outline"] = json!({ "path": path });
            }
        }
        draft.bodies.insert(body.clone(), entry);
        for (k, (at, name)) in layer.points.iter().zip(names).enumerate() {
            let name = name.unwrap_or_else(|| format!("P{}", k + 1));
            let point = draft.point(&body, &name, *at);
            let (place, new) = places.put(*at);
            if new {
                pins.push(Vec::new());
            }
            // a body has one point at a place
            if pins[place].iter().all(|(other, _)| *other != body) {
                pins[place].push((body.clone(), point));
            }
        }
        if !ground {
            for coordinate in ["x", "y", "angle"] {
                draft.guess.insert(format!("{body}.{coordinate}"), json!(0.0));
            }
        }
    }
    for mut ends in pins {
        ends.sort_by_key(|(body, _)| body != "ground");
        for (_, point) in ends.iter().skip(1) {
            let wanted = point.rsplit('.').next().unwrap_or_default().to_string();
            let joint = draft.name(&wanted);
            draft.joints.insert(joint, json!({ "type": "revolute", "i": ends[0].1, "j": point }));
        }
    }
    draft.analyses.insert("mobility".into(), json!({ "type": "mobility" }));
}

/// Mass, centre and inertia: of a plate within the first outline, or of a rod around the points.
fn mass(layer: &Layer) -> serde_json::Value {
    if let Some(line) = layer.outlines.first() {
        let (area, center, second) = shape::area(line);
        if area > 0.0 && center.iter().all(|x| x.is_finite()) && second.is_finite() {
            return json!({ "mass": DENSITY * area, "inertia": DENSITY * second, "center": center });
        }
    }
    crate::draft::rod(&layer.points, ROD)
}
