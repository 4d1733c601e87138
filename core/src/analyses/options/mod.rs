//! Options of analyses. Each set is declared once by `options!`, which generates the struct with its defaults, the
//! table for the schema, Python and the docs, and the reader with its checks.
//!
//! | file | concept |
//! |---|---|
//! | `declare` | the macros `options!` and `family!`, and a declaration as data |
//! | `kinds` | kinds of options: bounds, words, and how each is read |
//! | `reader` | values from a file or from Python, with problems by path |

mod declare;
mod kinds;
mod reader;

pub(super) use declare::{family, options};
pub use declare::{Declaration, Declared, Family, Member};
pub(super) use kinds::{
    count, flag, hht_alpha, interval, intervals, kind, name, not_negative, number, positive,
    spectral_radius, words,
};
pub use kinds::{Bounded, OptionKind, Words};
pub use reader::Reader;
