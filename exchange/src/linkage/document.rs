//! Connectors and links of a `.linkage2` file.

use crate::unread::UnreadList;
use roxmltree::{Node, ParsingOptions};

/// Millimetres would be 25.4/96: lengths are in 1/96 inch.
pub(super) const UNIT: f64 = 0.0254 / 96.0;
/// The bit of the layer of the mechanism; the other layers are drawings.
const MECHANISM: u32 = 16;
/// Most elements and attributes of a file.
const MOST_NODES: u32 = 5_000_000;

/// Attributes that only change the drawing.
const DRAWN: [&str; 15] = [
    "selected",
    "draw",
    "drawcircle",
    "color",
    "usercolor",
    "measurementelement",
    "linesize",
    "solid",
    "shapetype",
    "locked",
    "showangles",
    "drawfasteners",
    "measurementlineoffset",
    "labelposition",
    "fill",
];

/// A point where links are joined.
#[derive(Debug, Default)]
pub(super) struct Connector {
    pub(super) line: usize,
    pub(super) id: i64,
    pub(super) name: String,
    pub(super) at: [f64; 2],
    pub(super) anchor: bool,
    /// Revolutions per minute, clockwise, if it is an input.
    pub(super) input: Option<f64>,
    /// The two connectors between which it slides.
    pub(super) slide: Option<[i64; 2]>,
    /// A link on which it is fastened.
    pub(super) on: Option<i64>,
}

/// A rigid link, or an actuator.
#[derive(Debug, Default)]
pub(super) struct Link {
    pub(super) line: usize,
    pub(super) id: i64,
    pub(super) name: String,
    pub(super) connectors: Vec<i64>,
    /// Stroke and cycles per minute.
    pub(super) actuator: Option<[f64; 2]>,
    /// A link to which it is fastened.
    pub(super) on: Option<i64>,
}

/// Two wheels: whether a chain connects them, and their links with their sizes.
#[derive(Debug)]
pub(super) struct Ratio {
    pub(super) line: usize,
    pub(super) chain: bool,
    pub(super) wheels: Vec<(i64, f64)>,
}

/// The content of a file.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub(super) connectors: Vec<Connector>,
    pub(super) links: Vec<Link>,
    pub(super) ratios: Vec<Ratio>,
}

/// Reads the elements with their lines and names what has no meaning.
struct Reader<'a> {
    starts: Vec<usize>,
    unread: &'a mut UnreadList,
}

impl Reader<'_> {
    fn line(&self, node: &Node<'_, '_>) -> usize {
        self.starts.partition_point(|start| *start <= node.range().start)
    }

    fn number(&mut self, node: &Node<'_, '_>, name: &str) -> f64 {
        let Some(text) = node.attribute(name).filter(|text| !text.trim().is_empty()) else {
            return 0.0;
        };
        let number = text.trim().parse::<f64>().ok().filter(|x| x.is_finite() && x.abs() < 1e12);
        number.unwrap_or_else(|| {
            let short: String = text.chars().take(40).collect();
            self.unread.lost(self.line(node), format!("{name} = \"{short}\" is not a number"));
            0.0
        })
    }

    fn id(&mut self, node: &Node<'_, '_>, name: &str) -> Option<i64> {
        node.attribute(name)?;
        Some(self.number(node, name) as i64)
    }

    /// Names the attributes that are neither read nor drawn.
    fn rest(&mut self, node: &Node<'_, '_>, read: &[&str]) {
        for attribute in node.attributes() {
            let name = attribute.name();
            let idle = matches!(attribute.value(), "" | "false" | "0" | "0.000000");
            if !read.contains(&name) && !DRAWN.contains(&name) && !idle {
                let short: String = name.chars().take(40).collect();
                let what = format!(
                    "{} {}: the attribute {short} is not supported",
                    node.tag_name().name(),
                    node.attribute("id").unwrap_or("")
                );
                self.unread.lost(self.line(node), what);
            }
        }
    }

    /// Whether an element belongs to the mechanism; a drawing is named.
    fn moves(&mut self, node: &Node<'_, '_>) -> bool {
        let layer = self.number(node, "layer") as u32;
        if layer == 0 || layer & MECHANISM != 0 {
            return true;
        }
        self.unread.left(self.line(node), "an element of a drawing layer is left out");
        false
    }

    fn connector(&mut self, node: &Node<'_, '_>) -> Connector {
        let read = [
            "id",
            "name",
            "layer",
            "x",
            "y",
            "anchor",
            "input",
            "rpm",
            "slider",
            "fastenlink",
            "fasten",
            "alwaysmanual",
        ];
        self.rest(node, &read);
        let is = |name: &str| node.attribute(name) == Some("true");
        let line = self.line(node);
        let id = self.id(node, "id").unwrap_or(-1);
        let at = [self.number(node, "x"), self.number(node, "y")].map(|x| x * UNIT);
        let input = is("input").then(|| self.number(node, "rpm"));
        let limits: Vec<i64> = node
            .children()
            .filter(|child| child.has_tag_name("slidelimit"))
            .filter_map(|child| self.id(&child, "id"))
            .collect();
        for child in
            node.children().filter(|child| child.is_element() && !child.has_tag_name("slidelimit"))
        {
            self.unknown(&child);
        }
        let slide = match limits[..] {
            [a, b] => Some([a, b]),
            _ => None,
        };
        if is("slider") && slide.is_none() {
            self.unread.lost(line, format!("connector {id}: a slider needs two limits"));
        }
        if is("alwaysmanual") {
            self.unread
                .left(line, format!("connector {id}: moved by hand there, and by its rpm here"));
        }
        let on =
            self.id(node, "fastenlink").or_else(|| self.id(node, "fasten").filter(|id| *id > 0));
        let name = node.attribute("name").filter(|name| !name.is_empty());
        let name = name.map_or_else(|| format!("P{id}"), String::from);
        Connector {
            line,
            id,
            name,
            at,
            anchor: is("anchor"),
            input,
            slide: slide.filter(|_| is("slider")),
            on,
        }
    }

    fn link(&mut self, node: &Node<'_, '_>) -> Link {
        let read = [
            "id",
            "name",
            "layer",
            "actuator",
            "throw",
            "cpm",
            "gear",
            "fastenlink",
            "alwaysmanual",
        ];
        self.rest(node, &read);
        let (line, id) = (self.line(node), self.id(node, "id").unwrap_or(-1));
        let actuator = (node.attribute("actuator") == Some("true"))
            .then(|| [self.number(node, "throw") * UNIT, self.number(node, "cpm")]);
        let mut connectors = Vec::new();
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "connector" => connectors.extend(self.id(&child, "id")),
                _ => self.unknown(&child),
            }
        }
        let name = node.attribute("name").filter(|name| !name.is_empty());
        let name = name.map_or_else(|| format!("link{id}"), String::from);
        Link { line, id, name, connectors, actuator, on: self.id(node, "fastenlink") }
    }

    fn ratio(&mut self, node: &Node<'_, '_>) -> Ratio {
        self.rest(node, &["type"]);
        for child in node.children().filter(Node::is_element) {
            match child.has_tag_name("link") {
                true => self.rest(&child, &["id", "size"]),
                false => self.unknown(&child),
            }
        }
        let kind = node.attribute("type").unwrap_or_default();
        if !matches!(kind, "gears" | "chain") {
            let short: String = kind.chars().take(40).collect();
            self.unread
                .lost(self.line(node), format!("ratio: the type '{short}' is not supported"));
        }
        let wheels = node.children().filter(|child| child.has_tag_name("link"));
        let wheels =
            wheels.map(|child| (self.id(&child, "id").unwrap_or(-1), self.number(&child, "size")));
        let wheels = wheels.collect();
        Ratio { line: self.line(node), chain: node.attribute("type") != Some("gears"), wheels }
    }

    fn unknown(&mut self, node: &Node<'_, '_>) {
        let name: String = node.tag_name().name().chars().take(40).collect();
        self.unread.lost(self.line(node), format!("an element <{name}> is not supported"));
    }
}

/// Reads a text. `None` if it is not a file of this format; the list then says why.
pub(super) fn read(text: &str, unread: &mut UnreadList) -> Option<Document> {
    // document types, and with them entities, are refused
    let options =
        ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let xml = match roxmltree::Document::parse_with_options(text, options) {
        Ok(xml) => xml,
        Err(error) => {
            unread.lost(error.pos().row as usize, format!("not a file of Linkage: {error}"));
            return None;
        }
    };
    let root = xml.root_element();
    if !root.has_tag_name("linkage2") {
        unread.lost(1, "not a file of Linkage: the first element must be <linkage2>");
        return None;
    }
    let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(k, _)| k + 1)).collect();
    let mut reader = Reader { starts, unread };
    let mut document = Document::default();
    for node in root.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "program" => {
                let factor = reader.number(&node, "scalefactor");
                if factor != 0.0 && factor != 1.0 {
                    let what = format!("program: a scalefactor of {factor} is not supported");
                    reader.unread.lost(reader.line(&node), what);
                }
            }
            "selected" => {}
            "background" if node.text().is_none_or(|text| text.trim().is_empty()) => {}
            "background" => {
                reader.unread.left(reader.line(&node), "background: the picture is left out")
            }
            "connector" if reader.moves(&node) => document.connectors.push(reader.connector(&node)),
            "Link" | "element" if reader.moves(&node) => document.links.push(reader.link(&node)),
            "connector" | "Link" | "element" => {}
            "ratios" => {
                for child in node.children().filter(Node::is_element) {
                    match child.tag_name().name() {
                        "ratio" => document.ratios.push(reader.ratio(&child)),
                        _ => reader.unknown(&child),
                    }
                }
            }
            _ => reader.unknown(&node),
        }
    }
    Some(document)
}
