//! Kinds of options: the value of each kind, and how it is read and checked.

use super::reader::Reader;
use crate::elements::{Default, Shape};
use crate::math::{each, ShortArray};
use crate::model::Value as Written;

/// A kind of option.
pub trait OptionKind {
    /// The value in the struct of options.
    type Value;
    /// The values that are allowed in the file.
    fn shape() -> Shape;
    /// A default value as data.
    fn data(value: &Self::Value) -> Default;
    /// Reads a value that is given. None if it is faulty (the reader stores the report).
    fn read(reader: &mut Reader<'_>, key: &'static str, unit: &'static str) -> Option<Self::Value>;

    /// Reads an option that must be given.
    fn required(
        reader: &mut Reader<'_>,
        key: &'static str,
        unit: &'static str,
    ) -> Option<Self::Value> {
        match reader.get(key) {
            Some(_) => Self::read(reader, key, unit),
            None => reader.refuse(key, "missing"),
        }
    }

    /// Reads an option with a default.
    fn optional(
        reader: &mut Reader<'_>,
        key: &'static str,
        unit: &'static str,
        default: Self::Value,
    ) -> Option<Self::Value> {
        match reader.get(key) {
            Some(_) => Self::read(reader, key, unit),
            None => Some(default),
        }
    }
}

/// An optional value; None if it is absent.
impl<K: OptionKind> OptionKind for Option<K> {
    type Value = Option<K::Value>;

    fn shape() -> Shape {
        K::shape()
    }
    fn data(value: &Self::Value) -> Default {
        value.as_ref().map_or(Default::Absent, K::data)
    }
    fn read(reader: &mut Reader<'_>, key: &'static str, unit: &'static str) -> Option<Self::Value> {
        K::read(reader, key, unit).map(Some)
    }
}

/// Bounds of a number.
pub trait Bounded {
    /// The condition on a number, after the words "must be".
    const MUST: &'static str;
    /// Whether a finite number is within the bounds.
    fn holds(x: f64) -> bool;
}

/// Kinds of numbers within bounds; the words follow "must be".
macro_rules! numbers {
    ($($(#[doc = $doc:literal])* $kind:ident: |$x:ident| $holds:expr, $must:literal;)+) => {$(
        $(#[doc = $doc])*
        #[allow(non_camel_case_types)] // a type in `options!`, written like a word
        pub enum $kind {}
        impl Bounded for $kind {
            const MUST: &'static str = $must;

            fn holds($x: f64) -> bool {
                $holds
            }
        }
        impl OptionKind for $kind {
            type Value = f64;

            fn shape() -> Shape {
                Shape::Number
            }
            fn data(value: &f64) -> Default {
                Default::Number(*value)
            }
            fn read(reader: &mut Reader<'_>, key: &'static str, unit: &'static str) -> Option<f64> {
                reader.number(key, unit, (Self::holds, Self::MUST))
            }
        }
    )+};
}

numbers! {
    /// Any number.
    number: |_x| true, "finite";
    /// A number above zero.
    positive: |x| x > 0.0, "> 0";
    /// A number from zero.
    not_negative: |x| x >= 0.0, ">= 0";
    /// The spectral radius of a method that damps.
    spectral_radius: |x| (0.0..1.0).contains(&x), "in [0, 1)";
    /// The parameter of Hilber, Hughes and Taylor.
    hht_alpha: |x| (-1.0 / 3.0..0.0).contains(&x), "in [-1/3, 0)";
}

/// Kinds that are read from a value as it is written.
macro_rules! plain {
    ($($(#[doc = $doc:literal])* $kind:ident: $Value:ty, $Shape:ident, $data:expr, $pattern:pat => $value:expr, $must:literal;)+) => {$(
        $(#[doc = $doc])*
        #[allow(non_camel_case_types)] // a type in `options!`, written like a word
        pub enum $kind {}
        impl OptionKind for $kind {
            type Value = $Value;

            fn shape() -> Shape {
                Shape::$Shape
            }
            fn data(value: &$Value) -> Default {
                let data: fn(&$Value) -> Default = $data;
                data(value)
            }
            fn read(reader: &mut Reader<'_>, key: &'static str, _: &'static str) -> Option<$Value> {
                match reader.get(key)? {
                    $pattern => Some($value),
                    _ => reader.refuse(key, concat!("must be ", $must)),
                }
            }
        }
    )+};
}

plain! {
    /// true or false.
    flag: bool, Flag, |value| Default::Flag(*value), Written::Flag(value) => *value, "true or false";
    /// A name.
    name: String, Name, |_| Default::Absent, Written::Text(value) => value.clone(), "a name";
}

/// A whole number from 1.
#[allow(non_camel_case_types)] // a type in `options!`, written like a word
pub enum count {}
impl Bounded for count {
    const MUST: &'static str = "a whole number from 1";

    fn holds(x: f64) -> bool {
        x >= 1.0 && x.fract() == 0.0
    }
}
impl OptionKind for count {
    type Value = usize;

    fn shape() -> Shape {
        Shape::Count
    }
    fn data(value: &usize) -> Default {
        Default::Number(*value as f64)
    }
    fn read(reader: &mut Reader<'_>, key: &'static str, unit: &'static str) -> Option<usize> {
        reader.number(key, unit, (Self::holds, Self::MUST)).map(|x| x as usize)
    }
}

/// A choice among words.
pub trait Words: Copy + PartialEq + 'static {
    /// The words.
    const WORDS: &'static [&'static str];
    /// The values, in the order of the words.
    const VALUES: &'static [Self];
}

impl<W: Words> OptionKind for W {
    type Value = W;

    fn shape() -> Shape {
        Shape::Word(W::WORDS)
    }
    fn data(value: &W) -> Default {
        let word = W::VALUES.iter().position(|known| known == value).map(|k| W::WORDS[k]);
        word.map_or(Default::Absent, Default::Body)
    }
    fn read(reader: &mut Reader<'_>, key: &'static str, _: &'static str) -> Option<W> {
        let Written::Text(word) = reader.get(key)? else {
            return reader.refuse(key, "must be a word");
        };
        match W::WORDS.iter().position(|known| known == word) {
            Some(k) => Some(W::VALUES[k]),
            None => reader.refuse(key, format!("unknown word '{word}'")),
        }
    }
}

/// Declares a kind of option without a default, by its reader.
macro_rules! kind {
    ($(#[doc = $doc:literal])* $kind:ident: $Value:ty, $Shape:ident, $read:expr) => {
        $(#[doc = $doc])*
        #[allow(non_camel_case_types)] // a type in `options!`, written like a word
        pub enum $kind {}
        impl $crate::analyses::options::OptionKind for $kind {
            type Value = $Value;

            fn shape() -> $crate::elements::Shape {
                $crate::elements::Shape::$Shape
            }
            fn data(_: &$Value) -> $crate::elements::Default {
                $crate::elements::Default::Absent
            }
            fn read(
                reader: &mut $crate::analyses::options::Reader<'_>,
                key: &'static str,
                _: &'static str,
            ) -> Option<$Value> {
                use $crate::analyses::options::Reader;
                let read: fn(&mut Reader<'_>, &'static str) -> Option<$Value> = $read;
                read(reader, key)
            }
        }
    };
}
pub(in crate::analyses) use kind;

kind! {
    /// Two values of what `over` names.
    interval: [f64; 2], Pair, |reader, key| match reader.get(key)? {
        Written::List(ends) if ends.len() == 2 => {
            let unit = reader.unit_of(reader.get("over"));
            let [first, last] = each([&ends[0], &ends[1]], |end| reader.value(key, end, &unit));
            Some([first?, last?])
        }
        _ => reader.refuse(key, "must be two numbers, [first, last]"),
    }
}

kind! {
    /// The first and the last value of ranges, of what `over` names.
    intervals: Vec<[f64; 2]>, Ranges, |reader, key| {
        let given = match reader.get(key)? {
            Written::List(given) => given,
            _ => return reader.refuse(key, "must be ranges, [[first, last], [first, last]]"),
        };
        let names = match reader.get("over") {
            Some(Written::List(names)) => names.as_slice(),
            _ => &[],
        };
        let one = |(k, range): (usize, &Written)| match range {
            Written::List(ends) if ends.len() == 2 => {
                let unit = reader.unit_of(names.get(k));
                let [first, last] = [&ends[0], &ends[1]].each(|end| reader.value(key, end, &unit));
                Some([first?, last?])
            }
            _ => reader.refuse(key, "must be ranges, [[first, last], [first, last]]"),
        };
        given.iter().enumerate().map(one).collect()
    }
}

/// Declares the words for the values of an enum.
macro_rules! words {
    ($Value:ident { $($word:literal => $value:expr),+ $(,)? }) => {
        impl $crate::analyses::options::Words for $Value {
            const WORDS: &'static [&'static str] = &[$($word),+];
            const VALUES: &'static [Self] = &[$($value),+];
        }
    };
}
pub(in crate::analyses) use words;
