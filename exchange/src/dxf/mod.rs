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
mod shape;
mod write;

use crate::draft::Draft;
use crate::unread::UnreadList;
use crate::Read;
use entities::{number, Entity};
use serde_json::json;
use shape::Corner;
pub use write::{write, Line, Sheet};

/// Mass per area of a plate, kg/m²: 5 mm of steel.
const DENSITY: f64 = 7850.0 * 0.005;
/// Mass per length of a body without an outline, kg/m.
const ROD: f64 = 1.0;

/// A layer with what lies on it, in metres.
#[derive(Debug, Default)]
struct Layer {
    name: String,
    outlines: Vec<Vec<Corner>>,
    points: Vec<[f64; 2]>,
    texts: Vec<([f64; 2], String)>,
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
    draw(layers, &mut draft);
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
        if let Err(line) = take(&entities[k..end], unit, &mut layers[place], unread) {
            unread.lost(line, format!("{}: not a number", entity.kind));
        }
        k = end;
    }
    layers
}

/// Adds an entity to its layer. The error is the line of a text that is not a number.
fn take(
    entities: &[Entity<'_>],
    unit: f64,
    layer: &mut Layer,
    unread: &mut UnreadList,
) -> Result<(), usize> {
    let entity = &entities[0];
    // a plane seen from behind has x to the left
    let (up, across) =
        (entity.number(230)?.unwrap_or(1.0), (entity.number(210)?, entity.number(220)?));
    let tilted = |x: Option<f64>| x.is_some_and(|x| x.abs() > 1e-9);
    if tilted(across.0) || tilted(across.1) {
        unread.lost(entity.line, format!("{}: it lies in another plane than xy", entity.kind));
        return Ok(());
    }
    let side = if up < 0.0 { -1.0 } else { 1.0 };
    let place = |entity: &Entity<'_>| -> Result<[f64; 2], usize> {
        Ok([
            side * unit * entity.number(10)?.unwrap_or(0.0),
            unit * entity.number(20)?.unwrap_or(0.0),
        ])
    };
    match entity.kind {
        "CIRCLE" | "POINT" => layer.points.push(place(entity)?),
        "TEXT" => {
            layer.texts.push((place(entity)?, entity.text(1).unwrap_or_default().to_string()))
        }
        "LWPOLYLINE" | "POLYLINE" if entity.flag(70, 1) => {
            let line = match entity.kind {
                "POLYLINE" => vertices(entities, side, unit)?,
                _ => light(entity, side, unit)?,
            };
            if line.len() < 2 || line.len() == 2 && line.iter().all(|corner| corner.bulge == 0.0) {
                unread.left(entity.line, "a closed line without an area is left out");
            } else {
                layer.outlines.push(line);
            }
        }
        "INSERT" => {
            let name: String = entity.text(2).unwrap_or_default().chars().take(40).collect();
            unread.lost(entity.line, format!("INSERT: the block {name} is not read; explode it"));
        }
        "VERTEX" | "SEQEND" => {
            unread.lost(entity.line, format!("{} without a POLYLINE", entity.kind))
        }
        other => {
            let kind: String = other.chars().take(40).collect();
            let kind = if kind.ends_with("POLYLINE") { "open polyline".into() } else { kind };
            unread.left(
                entity.line,
                format!("{kind} on layer {}: not a closed polyline, circle or point", layer.name),
            );
        }
    }
    Ok(())
}

/// The corners of a `POLYLINE`.
fn vertices(entities: &[Entity<'_>], side: f64, unit: f64) -> Result<Vec<Corner>, usize> {
    let all = entities.iter().filter(|entity| entity.kind == "VERTEX");
    all.map(|vertex| {
        let [x, y] = [vertex.number(10)?.unwrap_or(0.0), vertex.number(20)?.unwrap_or(0.0)];
        let bulge = side * vertex.number(42)?.unwrap_or(0.0);
        Ok(Corner { at: [side * unit * x, unit * y], bulge })
    })
    .collect()
}

/// The corners of an `LWPOLYLINE`.
fn light(entity: &Entity<'_>, side: f64, unit: f64) -> Result<Vec<Corner>, usize> {
    let mut line: Vec<Corner> = Vec::new();
    for pair in &entity.pairs {
        match pair.code {
            10 => line.push(Corner { at: [side * unit * number(pair)?, 0.0], bulge: 0.0 }),
            20 | 42 => {
                let value = number(pair)?;
                let last = line.last_mut().ok_or(pair.line)?;
                if pair.code == 20 {
                    last.at[1] = unit * value;
                } else {
                    last.bulge = side * value;
                }
            }
            _ => {}
        }
    }
    Ok(line)
}

/// Bodies from layers, and pins where points of several layers coincide.
fn draw(layers: Vec<Layer>, draft: &mut Draft) {
    let all = layers.iter().flat_map(|layer| &layer.points);
    let size = all.flat_map(|at| at.map(f64::abs)).fold(0.0, f64::max);
    let cell = |x: f64| (x / (1e-7 * size).max(1e-12)).round() as i64;
    let mut pins = std::collections::BTreeMap::<(i64, i64), Vec<(String, String)>>::new();
    for layer in layers {
        let ground = layer.name == "ground";
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
        for (k, at) in layer.points.iter().enumerate() {
            let near = |text: &&([f64; 2], String)| {
                (text.0[0] - at[0]).hypot(text.0[1] - at[1]) <= 1e-7 * size
                    && !text.1.trim().is_empty()
            };
            let name = layer
                .texts
                .iter()
                .find(near)
                .map_or_else(|| format!("P{}", k + 1), |text| text.1.clone());
            let point = draft.point(&body, &name, *at);
            let here = pins.entry((cell(at[0]), cell(at[1]))).or_default();
            if here.iter().all(|(other, _)| *other != body) {
                here.push((body.clone(), point));
            }
        }
        if !ground {
            for coordinate in ["x", "y", "angle"] {
                draft.guess.insert(format!("{body}.{coordinate}"), json!(0.0));
            }
        }
    }
    for (_, mut ends) in pins {
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
