//! The records in the text of a link.

use crate::unread::UnreadList;
use std::collections::HashMap;

/// The digits of numbers; the first 62 are those of check sums.
const DIGITS: &str = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";
/// First characters of links of their own, and of links that are parts of another one.
const OWN: &str = "YAMG0123";
const PART: &str = "Namg4567";
/// Most joints, links and forces, as in PMKS+ itself.
const MOST_RECORDS: usize = 1000;
/// Entries that only change the drawing: joints, links and forces that are locked, holds, colours, centres, synthesis.
const MARKS: [char; 7] = ['J', 'L', 'F', 'H', 'K', 'C', 'S'];
/// Speed of a driven slide of which the text says nothing, lengths of the drawing per second.
const SLIDE_SPEED: f64 = 5.0;

#[derive(Debug, Default)]
pub(super) struct Joint<'a> {
    pub(super) id: &'a str,
    pub(super) name: &'a str,
    pub(super) at: [f64; 2],
    /// Direction of a slide that is on ground, rad.
    pub(super) angle: f64,
    /// Speed as an input, rad/s or m/s.
    pub(super) speed: f64,
    /// Mass of the block that slides.
    pub(super) mass: f64,
    /// The link along which it slides, and two joints of that link.
    pub(super) slot: Option<[&'a str; 3]>,
    pub(super) slides: bool,
    pub(super) input: bool,
    pub(super) ground: bool,
    pub(super) welded: bool,
    pub(super) sealed: bool,
}

#[derive(Debug)]
pub(super) struct Link<'a> {
    pub(super) id: &'a str,
    pub(super) name: &'a str,
    pub(super) own: bool,
    /// Whether it is the block of a slide, of older texts.
    pub(super) block: bool,
    pub(super) mass: f64,
    pub(super) inertia: f64,
    pub(super) center: [f64; 2],
    pub(super) joints: Vec<&'a str>,
    pub(super) parts: Vec<&'a str>,
}

#[derive(Debug)]
pub(super) struct Force<'a> {
    pub(super) name: &'a str,
    pub(super) link: &'a str,
    pub(super) at: [f64; 2],
    pub(super) force: [f64; 2],
    pub(super) local: bool,
}

/// The content of a text, in SI units.
#[derive(Debug, Default)]
pub(super) struct Drawing<'a> {
    pub(super) joints: Vec<Joint<'a>>,
    pub(super) links: Vec<Link<'a>>,
    pub(super) forces: Vec<Force<'a>>,
    pub(super) weightless: bool,
}

/// The text of a mechanism in a line: after the `?` of a link, or the line itself.
pub(super) fn payload(line: &str) -> Option<&str> {
    let stop = |c: char| c.is_whitespace() || "\"<>#".contains(c);
    let link = line.split_once("://").and_then(|(_, rest)| rest.split_once('?'));
    let text = link.map_or(line.trim(), |(_, rest)| rest.split(stop).next().unwrap_or(rest));
    let digits = |part: &str| !part.is_empty() && part.chars().all(|c| DIGITS.contains(c));
    let parts: Vec<&str> = text.splitn(6, '.').collect();
    let drawn = parts.len() == 6
        && parts[..4].iter().all(|part| part.split(',').all(digits))
        && parts[0].len() <= 3
        && parts[2].contains(',')
        && (3..=8).contains(&parts[3].len());
    let other = text.starts_with("pmks2:") || text.starts_with("j=") && line.contains("pmks");
    (drawn || other).then_some(text)
}

/// A text with its escapes `%20` and the like resolved, except those of separators.
pub(super) fn unescaped(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('%') {
        bytes.extend(before.bytes());
        let code = after.get(..2).and_then(|hex| u8::from_str_radix(hex, 16).ok());
        let code = code.filter(|byte| !b";/?:@&=+$,#".contains(byte));
        bytes.push(code.unwrap_or(b'%'));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    bytes.extend(rest.bytes());
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A number of base 64; a zero in front makes it negative.
fn integer(text: &str) -> Option<f64> {
    let digit = |sum: f64, c| Some(sum * 64.0 + DIGITS.find(c)? as f64);
    let sum = text.chars().try_fold(0.0, digit)?;
    // larger integers are not exact
    let known = !text.is_empty() && sum < (1_u64 << 53) as f64;
    known.then_some(if text.starts_with('0') { 0.0 - sum } else { sum })
}

/// The flags in a number, one in each bit.
fn bits_of(number: f64) -> impl Fn(u32) -> bool {
    let bits = number.abs() as u64;
    move |k| bits >> k & 1 == 1
}

/// The text without its check sums, if they are right: a length, and in newer texts the hash FNV-1a.
fn checked(text: &str) -> Option<&str> {
    let hashed = text.rsplit_once('*').filter(|(_, digits)| digits.len() == 6);
    let body = hashed.map_or(text, |(body, _)| body);
    if let Some((_, digits)) = hashed {
        let step = |hash: u32, unit| (hash ^ u32::from(unit)).wrapping_mul(0x0100_0193);
        let hash = body.encode_utf16().fold(0x811c_9dc5, step);
        let digit = |sum: u32, c| sum.checked_mul(62)?.checked_add(DIGITS.find(c)? as u32);
        if digits.chars().try_fold(0, digit) != Some(hash) {
            return None;
        }
    }
    let last = body.chars().next_back()?;
    let body = body.strip_suffix(last)?;
    let length = body.encode_utf16().count() % 62;
    (DIGITS.find(last) == Some(length)).then_some(body)
}

/// Reads records. Their numbers are thousandths, or entries of their own at the end of the text.
struct Reader<'b> {
    exact: HashMap<String, f64>,
    /// SI units of length, mass, inertia and force.
    units: [f64; 4],
    /// Turns per minute, and lengths per second, of inputs without a speed of their own.
    speeds: [f64; 2],
    line: usize,
    unread: &'b mut UnreadList,
}

impl Reader<'_> {
    fn lost(&mut self, what: String) {
        self.unread.lost(self.line, what);
    }

    /// The flags of a record, of which there are `count`, and its identifier.
    fn head<'a>(&mut self, field: &'a str, count: u32) -> (impl Fn(u32) -> bool, &'a str) {
        let (first, id) = head(field, 1);
        let bits = integer(first).filter(|bits| *bits < f64::from(1 << count));
        if bits.is_none() {
            self.lost(format!("{}: its flags are not known", short(field)));
        }
        (bits_of(bits.unwrap_or_default()), id)
    }

    /// Value `k` of the record `key`, a kind and an identifier.
    fn number(&mut self, key: &str, k: usize, text: Option<&&str>) -> f64 {
        if let Some(value) = self.exact.remove(&format!("{key}~{k}")[..]) {
            return value;
        }
        let text = text.copied().unwrap_or_default();
        integer(text).map_or_else(
            || {
                self.lost(format!("{}: '{}' is not a number", short(key), short(text)));
                0.0
            },
            |thousandths| thousandths / 1000.0,
        )
    }

    fn joint<'a>(&mut self, record: &'a str) -> Joint<'a> {
        let fields: Vec<&str> = record.split(',').collect();
        let (is, id) = self.head(fields[0], 6);
        let key = format!("J{id}");
        let [x, y, angle] = [0, 1, 2].map(|k| self.number(&key, k, fields.get(k + 2)));
        // a value that is not written is zero
        let given = |k: usize| fields.get(k).filter(|text| !text.is_empty());
        let [speed, block] =
            [3, 4].map(|k| self.number(&key, k, Some(given(k + 5).unwrap_or(&"0"))));
        if (10..fields.len()).any(|k| given(k).is_some_and(|text| *text != "0")) {
            self.lost(format!("joint {}: its further values are not supported", short(id)));
        }
        let slot = match [5, 6, 7].map(given) {
            [None, None, None] => None,
            [Some(link), Some(a), Some(b)] if is(0) && a != b => Some([*link, *a, *b]),
            _ => {
                let what = "a slot needs a slide, a link and two joints of it";
                self.lost(format!("joint {}: {what}", short(id)));
                None
            }
        };
        let [length, mass, ..] = self.units;
        let speed = if speed == 0.0 { self.speeds[usize::from(is(0))] } else { speed };
        Joint {
            id,
            name: given(1).copied().unwrap_or(id),
            at: [x * length, y * length],
            angle,
            speed: speed * if is(0) { length } else { std::f64::consts::TAU / 60.0 },
            mass: block * mass,
            slot,
            slides: is(0),
            input: is(1),
            ground: is(2),
            welded: is(3),
            sealed: is(5),
        }
    }

    fn link<'a>(&mut self, record: &'a str) -> Option<Link<'a>> {
        let fields: Vec<&str> = record.split(',').collect();
        let (kind, id) = head(fields[0], 2);
        let own = kind.starts_with(|c| OWN.contains(c));
        let known = own || kind.starts_with(|c| PART.contains(c));
        if !known || !kind.ends_with(['R', 'P']) || fields.len() < 8 {
            self.lost(format!("link '{}': this record is not known", short(record)));
            return None;
        }
        let key = format!("L{id}");
        let [mass, inertia, x, y] = [0, 1, 2, 3].map(|k| self.number(&key, k, fields.get(k + 2)));
        if mass < 0.0 || inertia < 0.0 {
            self.lost(format!("link {}: its mass or inertia is negative", short(id)));
        }
        let mut lists = fields[7..].splitn(2, |field| field.is_empty());
        let mut list = || {
            let ids = lists.next().unwrap_or_default().iter().copied();
            ids.filter(|id| !id.is_empty()).collect()
        };
        Some(Link {
            id,
            name: if fields[1].is_empty() { id } else { fields[1] },
            own,
            block: kind.ends_with('P'),
            mass: mass.max(0.0) * self.units[1],
            inertia: inertia.max(0.0) * self.units[2],
            center: [x, y].map(|x| x * self.units[0]),
            joints: list(),
            parts: list(),
        })
    }

    fn force<'a>(&mut self, record: &'a str) -> Option<Force<'a>> {
        let fields: Vec<&str> = record.split(',').collect();
        let (is, id) = self.head(fields[0], 2);
        let name = fields.get(2).copied().filter(|name| !name.is_empty()).unwrap_or(id);
        let key = format!("F{id}");
        let [x, y, to_x, to_y, size] =
            [0, 1, 2, 3, 4].map(|k| self.number(&key, k, fields.get(k + 3)));
        let [dx, dy] = [to_x - x, to_y - y];
        let length = dx.hypot(dy);
        if fields.len() != 8 || size < 0.0 || length == 0.0 && size != 0.0 {
            self.lost(format!("force {}: it has no direction, or further values", short(name)));
            return None;
        }
        let size = if is(1) { size } else { -size } * self.units[3];
        Some(Force {
            name,
            link: fields[1],
            at: [x, y].map(|x| x * self.units[0]),
            force: [dx, dy].map(|x| if length == 0.0 { 0.0 } else { x / length * size }),
            local: is(0),
        })
    }
}

/// A text for a message.
pub(super) fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

/// The first characters of a field, and the identifier after them.
fn head(field: &str, count: usize) -> (&str, &str) {
    let at = field.char_indices().nth(count).map_or(field.len(), |(at, _)| at);
    field.split_at(at)
}

/// SI units of length, mass, inertia and force, by the choice of inches, centimetres or metres.
fn units(choice: u8) -> Option<[f64; 4]> {
    const POUND: f64 = 0.453_592_37;
    match choice {
        b'0' => Some([0.0254, POUND, POUND * 0.0254 * 0.0254, POUND * 9.806_65]),
        b'1' => Some([0.01, 1e-3, 1e-4, 1.0]),
        b'2' => Some([1.0; 4]),
        _ => None,
    }
}

/// Why a text is not read, if it is not, and otherwise the text without its check sums.
fn body(text: &str) -> Result<&str, &'static str> {
    if text.starts_with("pmks2:") || text.starts_with("j=") {
        return Err("this version of the format of PMKS+ is not supported");
    }
    payload(text).ok_or("not a mechanism of PMKS+")?;
    checked(text).ok_or("the check sum is wrong: a part of the text is missing or changed")
}

/// Reads a text. What is wrong with it as a whole is the error.
pub(super) fn drawing<'a>(
    text: &'a str,
    line: usize,
    unread: &mut UnreadList,
) -> Result<Drawing<'a>, &'static str> {
    let parts: Vec<&'a str> = body(text)?.split('.').collect();
    let [first, decimals, integers, choices] = [0, 1, 2, 3].map(|k| parts[k]);
    let is = bits_of(integer(first).unwrap_or_default());
    let units = units(choices.as_bytes()[0]).ok_or("the unit of lengths is not known")?;
    let mut sections = parts[4..].splitn(4, |part| part.is_empty());
    let mut section = || sections.next().map(<[&str]>::to_vec);
    let (Some(joints), Some(links), Some(forces)) = (section(), section(), section()) else {
        return Err("the joints, the links or the forces are missing");
    };
    if [&joints, &links, &forces].iter().any(|records| records.len() > MOST_RECORDS) {
        return Err("it has more than 1000 joints, links or forces");
    }
    // first the selected part, then entries with a letter for their kind
    let entries = section().unwrap_or_default().get(1..).unwrap_or_default().join(".");
    let mut reader =
        Reader { exact: HashMap::new(), units, speeds: [0.0, SLIDE_SPEED], line, unread };
    if (9..18).any(&is) {
        reader.lost("a setting is not known".into());
    }
    let mut left = false;
    for entry in entries.split(',').filter(|entry| !entry.is_empty()) {
        let exact = entry.strip_prefix('P').and_then(|rest| rest.rsplit_once('~'));
        let exact = exact.and_then(|(key, value)| Some((key, value.parse::<f64>().ok()?)));
        match exact.filter(|(_, value)| value.abs() < 1e12) {
            Some((key, value)) => drop(reader.exact.insert(key.into(), value)),
            None if entry.starts_with(MARKS) => left = true,
            None => reader.lost(format!("the entry '{}' is not supported", short(entry))),
        }
    }
    if left {
        reader.unread.left(line, "locks, colours and plans of the drawing are left out");
    }
    // the place of the animation and the sizes of marks change nothing
    for key in ["D~0", "D~2", "D~3", "I~1"] {
        reader.exact.remove(key);
    }
    let turns = integers.split(',').next().and_then(integer).unwrap_or_default();
    let turns = reader.exact.remove("I~0").unwrap_or(turns);
    let slide = reader.number("D", 1, Some(decimals.split(',').nth(1).as_ref().unwrap_or(&"0")));
    let sense = if is(0) { -1.0 } else { 1.0 };
    reader.speeds = [turns, if slide == 0.0 { SLIDE_SPEED } else { slide }].map(|x| x * sense);
    let drawing = Drawing {
        joints: joints.into_iter().map(|record| reader.joint(record)).collect(),
        links: links.into_iter().filter_map(|record| reader.link(record)).collect(),
        forces: forces.into_iter().filter_map(|record| reader.force(record)).collect(),
        weightless: is(8),
    };
    let mut unknown: Vec<String> = reader.exact.keys().map(|key| short(key)).collect();
    unknown.sort();
    for key in unknown {
        reader.lost(format!("there is no value '{key}' to correct"));
    }
    Ok(drawing)
}
