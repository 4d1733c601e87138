//! Writes DXF files of the release 12, which every program reads.

use std::collections::{HashMap, HashSet};
use std::fmt::Write;

/// Layer, whether it is closed, corners in metres, and the bulge after each corner.
pub type Line = (String, bool, Vec<[f64; 2]>, Vec<f64>);

/// A drawing: its unit, and polylines, circles and texts on layers.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Metres per unit of the drawing: 0.001, 0.01, 1, 0.0254 or 0.3048.
    pub unit: f64,
    /// The polylines.
    pub lines: Vec<Line>,
    /// Layer, centre and radius in metres.
    pub circles: Vec<(String, [f64; 2], f64)>,
    /// Layer, place and height in metres, and the text.
    pub texts: Vec<(String, [f64; 2], f64, String)>,
}

/// Codes of `$INSUNITS`.
const UNITS: [(f64, u8); 5] = [(1e-3, 4), (1e-2, 5), (1.0, 6), (0.0254, 1), (0.3048, 2)];
/// Characters that names of layers must not contain.
const NOT_IN_LAYERS: [char; 13] =
    ['<', '>', '/', '\\', '"', ':', ';', '?', '*', '|', ',', '=', '`'];

/// The text of a drawing; `None` if the unit has no code.
pub fn write(sheet: &Sheet) -> Option<String> {
    let code = UNITS.iter().find(|(unit, _)| (unit / sheet.unit - 1.0).abs() < 1e-9)?.1;
    let (layers, named) = layers(sheet);
    let named = |layer: &String| &named[layer.as_str()];
    let mut out = format!(
        "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n{code}\n0\nENDSEC\n"
    );
    out += "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n";
    _ = writeln!(out, "70\n{}", layers.len());
    for (k, name) in layers.iter().enumerate() {
        _ = writeln!(out, "0\nLAYER\n2\n{name}\n70\n0\n62\n{}\n6\nCONTINUOUS", k % 7 + 1);
    }
    out += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    let length = |x: f64| format!("{:?}", x / sheet.unit);
    for (layer, closed, corners, bulges) in &sheet.lines {
        let layer = named(layer);
        _ = writeln!(
            out,
            "0\nPOLYLINE\n8\n{layer}\n66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n{}",
            u8::from(*closed)
        );
        for (k, [x, y]) in corners.iter().enumerate() {
            _ = writeln!(
                out,
                "0\nVERTEX\n8\n{layer}\n10\n{}\n20\n{}\n30\n0.0",
                length(*x),
                length(*y)
            );
            if let Some(bulge) = bulges.get(k).filter(|bulge| **bulge != 0.0) {
                _ = writeln!(out, "42\n{bulge:?}");
            }
        }
        _ = writeln!(out, "0\nSEQEND\n8\n{layer}");
    }
    for (layer, [x, y], radius) in &sheet.circles {
        let layer = named(layer);
        let (x, y, radius) = (length(*x), length(*y), length(*radius));
        _ = writeln!(out, "0\nCIRCLE\n8\n{layer}\n10\n{x}\n20\n{y}\n30\n0.0\n40\n{radius}");
    }
    for (layer, [x, y], height, text) in &sheet.texts {
        let layer = named(layer);
        let (x, y, height, text) = (length(*x), length(*y), length(*height), one_line(text, &[]));
        _ = writeln!(
            out,
            "0\nTEXT\n8\n{layer}\n10\n{x}\n20\n{y}\n30\n0.0\n40\n{height}\n1\n{text}"
        );
    }
    out += "0\nENDSEC\n0\nEOF\n";
    Some(out)
}

/// The layers of a drawing, and the name of each in the file. Names there differ by more than the case of letters, and
/// the layers of ground keep their names to themselves.
fn layers(sheet: &Sheet) -> (Vec<String>, HashMap<&str, String>) {
    let lines = sheet.lines.iter().map(|line| &line.0);
    let circles = sheet.circles.iter().map(|circle| &circle.0);
    let all = lines.chain(circles).chain(sheet.texts.iter().map(|text| &text.0));
    let (mut order, mut named) = (Vec::new(), HashMap::new());
    let mut taken = HashSet::from(["0".to_string(), "ground".to_string()]);
    for layer in all {
        if named.contains_key(layer.as_str()) {
            continue;
        }
        let base = one_line(layer, &NOT_IN_LAYERS);
        let (mut name, mut k) = (base.clone(), 1);
        while layer != "ground" && !taken.insert(name.to_lowercase()) {
            k += 1;
            name = format!("{base}_{k}");
        }
        order.push(name.clone());
        named.insert(layer.as_str(), name);
    }
    (order, named)
}

/// A text on one line, with `_` in place of what it must not contain.
fn one_line(text: &str, forbidden: &[char]) -> String {
    let kept = |c: char| if c.is_control() || forbidden.contains(&c) { '_' } else { c };
    let text: String = text.trim().chars().map(kept).collect();
    if text.is_empty() {
        "_".into()
    } else {
        text
    }
}
