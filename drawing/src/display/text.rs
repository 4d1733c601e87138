//! The styles and the sizes of texts.

use serde::{Deserialize, Serialize};

/// Longest name in a drawing, in characters.
const LONGEST: usize = 24;
/// Height of a line of text, relative to the font size.
const LINE: f64 = 1.25;
/// Widths of the ASCII characters from the space on, in DejaVu Sans, in 1/2048 of the size. Italics have equal
/// widths.
#[rustfmt::skip]
const PLAIN: [u16; 95] = [
    651, 821, 942, 1716, 1303, 1946, 1597, 563, 799, 799, 1024, 1716, 651, 739, 651, 690, 1303, 1303, 1303, 1303, 1303,
    1303, 1303, 1303, 1303, 1303, 690, 690, 1716, 1716, 1716, 1087, 2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587,
    1540, 604, 604, 1343, 1141, 1767, 1532, 1612, 1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403, 799,
    690, 799, 1716, 1024, 1024, 1255, 1300, 1126, 1300, 1260, 721, 1300, 1298, 569, 569, 1186, 569, 1995, 1298, 1253,
    1300, 1300, 842, 1067, 803, 1298, 1212, 1675, 1212, 1212, 1075, 1303, 690, 1303, 1716,
];
/// Widths of these characters in bold.
#[rustfmt::skip]
const BOLD: [u16; 95] = [
    713, 934, 1067, 1716, 1425, 2052, 1786, 627, 936, 936, 1071, 1716, 778, 850, 778, 748, 1425, 1425, 1425, 1425, 1425,
    1425, 1425, 1425, 1425, 1425, 819, 819, 1716, 1716, 1716, 1188, 2048, 1585, 1561, 1503, 1700, 1399, 1399, 1681,
    1714, 762, 762, 1587, 1305, 2038, 1714, 1741, 1501, 1741, 1577, 1475, 1397, 1663, 1585, 2259, 1579, 1483, 1485, 936,
    748, 936, 1716, 1024, 1024, 1382, 1466, 1214, 1466, 1389, 891, 1466, 1458, 702, 702, 1362, 702, 2134, 1458, 1407,
    1466, 1466, 1010, 1219, 979, 1458, 1335, 1892, 1321, 1335, 1192, 1458, 748, 1458, 1716,
];
/// Width of other characters, and of wide East Asian characters and pictographs.
const OTHER: u16 = 1303;
const WIDE: u16 = 2048;

/// The kind of object that a text names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)]
pub enum Role {
    Joint,
    Point,
    Element,
    Driver,
    Body,
    Number,
    Measure,
}

/// The style of a text.
pub struct Look {
    /// Size, points of print.
    pub size: f64,
    /// Whether the text is bold.
    pub bold: bool,
    /// Whether the text is in italics.
    pub slanted: bool,
    /// A name in the palette.
    pub colour: &'static str,
}

impl Role {
    /// The style of texts with this role.
    pub fn look(self) -> Look {
        let (size, bold, slanted, colour) = match self {
            Self::Joint => (9.0, true, false, "ink"),
            Self::Point => (9.0, false, false, "ink"),
            Self::Element => (8.0, false, true, "force"),
            Self::Driver => (8.0, false, true, "drive"),
            Self::Body | Self::Number => (8.0, false, false, "ink"),
            Self::Measure => (8.0, false, false, "quiet"),
        };
        Look { size, bold, slanted, colour }
    }
}

/// Width of a text in DejaVu Sans, in the unit of its size. Other usual fonts are narrower.
pub fn width(words: &str, size: f64, bold: bool) -> f64 {
    let table = if bold { &BOLD } else { &PLAIN };
    let of = |c: char| match u32::from(c) {
        code @ 32..=126 => table[code as usize - 32],
        0x300..=0x36f | 0x200b..=0x200f | 0xfe00..=0xfe0f => 0, // marks on letters, joiners
        0x2013 => 1024,
        0x2014 | 0x2026 => WIDE,
        0xb7 => table[0],
        0xb2 | 0xb3 | 0xb9 | 0x2070..=0x209f => 821,
        0x1100..=0x11ff | 0x2e80..=0xd7ff | 0xf900..=0xfaff | 0xff00..=0xff60 | 0x1f000.. => WIDE,
        _ => OTHER,
    };
    words.chars().map(|c| f64::from(of(c))).sum::<f64>() * size / 2048.0
}

/// Width and height of a text of a role.
pub fn size_of(words: &str, role: Role) -> [f64; 2] {
    let look = role.look();
    [width(words, look.size, look.bold), LINE * look.size]
}

/// A name on one line. Its middle is omitted if it is too long.
pub fn one_line(name: &str) -> String {
    let text = name.split_whitespace().collect::<Vec<_>>().join(" ");
    let letters: Vec<char> = text.chars().collect();
    if letters.len() <= LONGEST {
        return text;
    }
    let half = (LONGEST - 1) / 2;
    let (first, last) = (&letters[..half], &letters[letters.len() - half..]);
    first.iter().chain(&['…']).chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::{one_line, width};

    #[test]
    fn a_long_name_keeps_its_ends() {
        assert_eq!(one_line("  a \n b "), "a b");
        assert_eq!(one_line("abcdefghijklmnopqrstuvwxyz"), "abcdefghijk…pqrstuvwxyz");
    }

    #[test]
    fn widths_are_those_of_the_font() {
        assert_eq!(width("Ai", 2048.0, false), 1401.0 + 569.0);
        assert_eq!(width("~ ", 1024.0, true), (1716.0 + 713.0) / 2.0);
        assert!(width("桁", 9.0, false) > width("W", 9.0, false));
    }
}
