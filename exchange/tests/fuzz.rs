//! Damaged files: no panic, no hang, and what is added to a file is read or named.
//!
//! `KEMPE_FUZZ=10000 cargo test --release -p kempe-exchange --test fuzz` tries more of them.

use kempe_exchange::{read, Format, Read, FORMATS};
use std::time::Instant;

const SAMPLES: [(Format, &str); 5] = [
    (Format::Asmt, include_str!("samples/slider_crank.asmt")),
    (Format::Linkage, include_str!("samples/quick_return.linkage2")),
    (Format::Dxf, include_str!("samples/plates.dxf")),
    (Format::Adm, include_str!("samples/pendulum.adm")),
    (Format::Pmks, include_str!("samples/slotted_lever.pmks")),
];

/// Random numbers: a linear congruential generator with the constants of Knuth's MMIX.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % end.max(1)
    }

    fn text(&mut self) -> &'static str {
        const TEXTS: [&str; 16] = [
            "", "-1", "0", "1e308", "1e999", "nan", "(((((", "\t\t\t", "<a>", "</a>", "&x;",
            "\u{0}", "é€", "9", "\r", "t",
        ];
        TEXTS[self.below(TEXTS.len())]
    }

    /// A line or a part of it is removed, repeated, exchanged or replaced.
    fn damage(&mut self, text: &str) -> String {
        let mut lines: Vec<String> = text.lines().map(String::from).collect();
        for _ in 0..=self.below(4) {
            let (a, b) = (self.below(lines.len()), self.below(lines.len()));
            match self.below(7) {
                0 => drop(lines.remove(a)),
                1 => lines.insert(b, lines[a].clone()),
                2 => lines.swap(a, b),
                3 => lines[a] = self.text().to_string(),
                4 => lines.truncate(a + 1),
                5 => {
                    let part = self.text();
                    let places: Vec<usize> = lines[a].char_indices().map(|(k, _)| k).collect();
                    let at = places.get(self.below(places.len())).copied().unwrap_or(0);
                    lines[a].insert_str(at, part);
                }
                _ => {
                    let places: Vec<usize> = lines[a].char_indices().map(|(k, _)| k).collect();
                    let (from, to) = (self.below(places.len()), self.below(places.len()));
                    if let (Some(&from), Some(&to)) =
                        (places.get(from.min(to)), places.get(from.max(to)))
                    {
                        lines[a].replace_range(from..to, "");
                    }
                }
            }
            if lines.is_empty() {
                break;
            }
        }
        lines.join("\n")
    }
}

fn count() -> usize {
    std::env::var("KEMPE_FUZZ").ok().and_then(|n| n.parse().ok()).unwrap_or(1000)
}

/// The case is JSON, the texts are for people, and the results have one length.
fn sound(read: &Read, of: &str) {
    assert!(read.case.is_some() || !read.unread.is_empty(), "neither a case nor a reason:\n{of}");
    if let Some(case) = &read.case {
        let tree: serde_json::Value =
            serde_json::from_str(case).unwrap_or_else(|e| panic!("{e}:\n{of}"));
        assert_eq!(tree["kempe"], 1);
    }
    // the end of a text counts as a line
    let lines = of.lines().count() + 1;
    for unread in &read.unread {
        assert!(unread.line <= lines && !unread.what.is_empty(), "{unread}");
    }
    for (name, column) in &read.results {
        assert_eq!(column.len(), read.results[0].1.len(), "{name}");
        assert!(column.iter().all(|x| x.is_finite()), "{name}");
    }
}

#[test]
fn damaged_files_are_read_or_refused() {
    for (format, sample) in SAMPLES {
        let whole = read(sample, format);
        assert!(whole.unread.iter().all(|unread| unread.harmless), "{:?}", whole.unread);
        for seed in 0..count() {
            let text = Random(seed as u64).damage(sample);
            let start = Instant::now();
            for (_, other) in FORMATS {
                sound(&read(&text, other), &text);
            }
            assert!(start.elapsed().as_secs() < 5, "slow at {seed}");
        }
    }
}

/// A line that means nothing must be named, wherever it stands.
#[test]
fn no_unknown_line_of_an_assembly_is_lost() {
    let (_, sample) = SAMPLES[0];
    let lines: Vec<&str> = sample.lines().collect();
    let series = lines.iter().position(|line| *line == "TimeSeries").unwrap();
    for at in 2..series {
        let tabs = lines[at].len() - lines[at].trim_start().len();
        let mut more = lines.clone();
        let line = format!("{}Xyzzy", "\t".repeat(tabs));
        more.insert(at, &line);
        let read = read(&more.join("\n"), Format::Asmt);
        let depth = |line: &&str| line.len() - line.trim_start_matches('\t').len();
        let within = |from: usize| {
            let below =
                more[from..].iter().take_while(|line| depth(line) > depth(&more[from - 1])).count();
            (from..=from + below).contains(&(at + 1))
        };
        let named =
            read.unread
                .iter()
                .any(|unread| if unread.harmless { within(unread.line) } else { true });
        assert!(named, "line {} is lost: {line}", at + 1);
    }
}

/// A text of PMKS+ without a hash, and with the right length.
fn stamped(body: &str) -> String {
    let digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    let length = body.encode_utf16().count() % 62;
    format!("{body}{}", &digits[length..=length])
}

/// Every value of a text of PMKS+ is read or named: with another one, the reader names it, or the case is another one.
#[test]
fn no_value_of_a_mechanism_of_pmks_is_lost() {
    let (_, sample) = SAMPLES[4];
    // without the entries: one of them replaces a value
    let body = &sample[..sample.find(".JA,PJB").unwrap()];
    let own = read(&stamped(body), Format::Pmks).case;
    let records: Vec<&str> = body.split('.').collect();
    for k in 0..records.len() {
        let values: Vec<&str> = records[k].split(',').collect();
        for at in 0..values.len() {
            for other in ["", "?", "1", "Z,Z"] {
                let mut more = values.clone();
                more[at] = other;
                let mut changed = records.clone();
                let record = more.join(",");
                changed[k] = &record;
                let text = stamped(&changed.join("."));
                let read = read(&text, Format::Pmks);
                sound(&read, &text);
                let named = read.unread.iter().any(|unread| !unread.harmless);
                // flags of the view, scale, speed of slides, time, choices for angles, and the selected part
                let idle = matches!((k, at, other), (0, _, "1") | (1, ..) | (2, 1, _) | (3, ..));
                // a name may be missing; only a slide on ground has an angle, and only an input has a speed
                let idle = idle || other.is_empty() && matches!(at, 1 | 2);
                let idle = idle || other == "1" && (4..9).contains(&k) && matches!(at, 4 | 8);
                // the colour of a link
                let idle = idle || records[k].starts_with('Y') && at == 6 && other != "Z,Z";
                let idle = idle || records[k] == "N_";
                let same = read.case == own && values[at] != other;
                assert!(named || idle || !same, "record {k}, value {at}: {other}\n{text}");
            }
        }
    }
}

/// Damage behind right check sums.
#[test]
fn damaged_mechanisms_of_pmks_are_read_or_refused() {
    let (_, sample) = SAMPLES[4];
    let body = &sample[..sample.rfind('*').unwrap() - 1];
    for seed in 0..count() {
        let mut random = Random(seed as u64);
        let damaged = random.damage(&body.replace('.', "\n").replace(',', "\t\n"));
        let text = stamped(&damaged.replace("\t\n", ",").replace('\n', "."));
        sound(&read(&text, Format::Pmks), &text);
    }
}

#[test]
fn deep_and_large_files_are_refused() {
    let deep: String = (0..100_000).map(|k| format!("{}x\n", "\t".repeat(k.min(200)))).collect();
    for (_, format) in FORMATS {
        sound(&read(&deep, format), &deep);
        let large = " ".repeat(kempe_exchange::LARGEST + 1);
        assert!(read(&large, format).unread[0].what.contains("100"));
    }
}
