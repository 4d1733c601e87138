//! Files of other tools: a text becomes a case of kempe and a list of the parts that the case lacks.
//!
//! ```
//! let read = kempe_exchange::read("Assembly\n", kempe_exchange::Format::Asmt);
//! assert!(read.unread.is_empty());
//! assert!(read.case.unwrap().contains("\"kempe\": 1"));
//! ```
//!
//! The crate does not depend on the core: a case is a text in kempe's own format, and the core checks it as any other.
#![forbid(unsafe_code)]

mod adm;
mod asmt;
mod draft;
pub mod dxf;
mod formula;
mod linkage;
mod pmks;
mod space;
mod unread;

pub use unread::Unread;

/// The largest text that is read, in bytes.
pub const LARGEST: usize = 100_000_000;

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Assemblies of OndselSolver and FreeCAD.
    Asmt,
    /// Mechanisms of Linkage.
    Linkage,
    /// Drawings.
    Dxf,
    /// Models of the solver of MSC Adams.
    Adm,
    /// Mechanisms of PMKS+.
    Pmks,
}

/// All formats with their names, which are also the endings of their files.
pub const FORMATS: [(&str, Format); 5] = [
    ("asmt", Format::Asmt),
    ("linkage2", Format::Linkage),
    ("dxf", Format::Dxf),
    ("adm", Format::Adm),
    ("pmks", Format::Pmks),
];

impl Format {
    /// The format of this name or ending.
    pub fn named(name: &str) -> Option<Self> {
        let found = FORMATS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
        found.map(|(_, format)| *format)
    }

    /// The format whose files begin like this text.
    pub fn of(text: &str) -> Option<Self> {
        if text.trim_start().starts_with("<linkage2") {
            return Some(Self::Linkage);
        }
        let mut pairs = text.lines().map(str::trim);
        if pairs.next() == Some("0") && pairs.next() == Some("SECTION") {
            return Some(Self::Dxf);
        }
        if text.starts_with("ADAMS/View model name") {
            return Some(Self::Adm);
        }
        if pmks::begins(text) {
            return Some(Self::Pmks);
        }
        let mut lines = text.lines().take(3).map(str::trim_end);
        lines.any(|line| line == "Assembly").then_some(Self::Asmt)
    }
}

/// What a text contains.
#[derive(Debug, Default)]
pub struct Read {
    /// The case as JSON in kempe's format; `None` if the text is not of this format.
    pub case: Option<String>,
    /// What the case lacks, in the order of the file.
    pub unread: Vec<Unread>,
    /// Results that the file carries, by the name of their quantity in kempe; the first are the times `t`.
    pub results: Vec<(String, Vec<f64>)>,
}

impl Read {
    fn nothing(unread: unread::UnreadList) -> Self {
        Self { unread: unread.sorted(), ..Self::default() }
    }
}

impl Format {
    /// The largest model that is read, in bytes, and the part of a text that is the model.
    fn model(self, text: &str) -> (usize, &str) {
        match self {
            Self::Asmt => {
                // the results of an assembly may be much longer
                (8_000_000, text.split("\nTimeSeries").next().unwrap_or(text))
            }
            Self::Adm => (4_000_000, text),
            Self::Pmks => (1_000_000, text),
            Self::Linkage | Self::Dxf => (16_000_000, text),
        }
    }
}

/// Reads a text of a format. What cannot be read is in the list, never lost.
pub fn read(text: &str, format: Format) -> Read {
    let (largest, model) = format.model(text);
    for (size, limit, what) in [(text.len(), LARGEST, "file"), (model.len(), largest, "model")] {
        if size > limit {
            let mut unread = unread::UnreadList::default();
            let mega = |bytes: usize| bytes as f64 / 1e6;
            let what =
                format!("the {what} has {:.1} MB; at most {} are read", mega(size), mega(limit));
            unread.lost(0, what);
            return Read::nothing(unread);
        }
    }
    let text = text.strip_prefix('\u{FEFF}').unwrap_or(text);
    match format {
        Format::Asmt => asmt::read(text),
        Format::Linkage => linkage::read(text),
        Format::Dxf => dxf::read(text),
        Format::Adm => adm::read(text),
        Format::Pmks => pmks::read(text),
    }
}
