//! The declaration of a set of options. One macro generates the struct with its defaults, its table and its reader.

use super::reader::Reader;
use crate::elements::Table;
use crate::math::Listed;
use crate::model::{Model, Problem, Value};

/// A set of options as data.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// Name of the class in Python.
    pub class: &'static str,
    /// The `type` in the file, and the options.
    pub table: Table,
    /// Options that exclude others, each with the options that must not be given with it.
    pub excludes: &'static [(&'static str, &'static [&'static str])],
    /// The numbers of the result of an analysis that sweeps read, with their units; otherwise empty.
    pub numbers: Vec<(&'static str, &'static str)>,
    /// Whether it is an analysis whose result is a motion.
    pub motion: bool,
}

impl Declaration {
    /// A declaration. Adds the exclusions to the docs of options that exclude others.
    pub fn new(
        class: &'static str,
        mut table: Table,
        excludes: &'static [(&'static str, &'static [&'static str])],
    ) -> Self {
        for (one, others) in excludes {
            for field in table.fields.iter_mut().filter(|field| field.name == *one) {
                field.doc += &format!(" Not together with {}.", others.join(" and "));
            }
        }
        Self { class, table, excludes, numbers: Vec::new(), motion: false }
    }
}

/// Alternative sets of options, of which an analysis uses one, such as the methods of integration.
#[derive(Clone, Debug)]
pub struct Family {
    /// The name in [`Shape::Options`](crate::elements::Shape::Options).
    pub name: &'static str,
    /// The sets to choose from.
    pub options: Vec<Declaration>,
}

/// A struct of options and its declaration.
pub trait Declared: Sized {
    /// The `type` in the file.
    const NAME: &'static str;
    /// The declaration as data.
    fn declaration() -> Declaration;
    /// Reads all options. None if an option was faulty (the reader stores the reports).
    fn read(reader: &mut Reader<'_>) -> Option<Self>;

    /// An option that is incompatible with the others, with a message.
    fn conflict(&self, _: &Model) -> Option<(&'static str, String)> {
        None
    }

    /// Reads the fields of an analysis of this type; `path` is its path in the file.
    ///
    /// # Errors
    /// Every faulty value, with its path.
    fn checked(
        model: &Model,
        fields: &[(String, Value)],
        path: &[String],
    ) -> Result<Self, Vec<Problem>> {
        let read = Reader::read(model, fields, path, Self::read)?;
        match read.conflict(model) {
            None => Ok(read),
            Some((key, message)) => {
                let path: Vec<&str> = path.iter().map(String::as_str).chain([key]).list();
                Err(vec![Problem::at(&path, message)])
            }
        }
    }
}

/// A value that is chosen from a family by `type`.
pub trait Member {
    /// The sets to choose from.
    fn family() -> Family;
}

/// Declares options: required options in parentheses, then options with defaults, then exclusions, and a function
/// that finds an option that is incompatible with the others.
macro_rules! options {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal, $class:literal
        ($($(#[doc = $what:literal])* $required:ident : $must:ty $([$($in:tt)*])?),*)
        {$($(#[doc = $about:literal])* $field:ident : $kind:ty $([$($unit:tt)*])? = $default:expr),* $(,)?}
        $(excludes { $($one:ident: $($other:ident),+;)+ })?
        $(conflict $conflict:expr;)?
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $Name {
            $($(#[doc = $what])* pub $required: <$must as $crate::analyses::options::OptionKind>::Value,)*
            $($(#[doc = $about])* pub $field: <$kind as $crate::analyses::options::OptionKind>::Value,)*
        }

        impl $Name {
            /// The options with the required values and all defaults.
            #[allow(clippy::new_without_default)] // where nothing is required
            pub fn new($($required: <$must as $crate::analyses::options::OptionKind>::Value),*) -> Self {
                Self { $($required,)* $($field: $default),* }
            }
        }

        impl $crate::analyses::options::Declared for $Name {
            const NAME: &'static str = $name;

            fn declaration() -> $crate::analyses::options::Declaration {
                #[allow(unused_imports)] // where there are no options
                use $crate::analyses::options::OptionKind;
                let doc = |lines: &[&str]| lines.concat().trim().to_string();
                let fields = $crate::elements::declared_fields(&[
                    $((
                        stringify!($required),
                        <$must as OptionKind>::shape(),
                        concat!($($(stringify!($in)),*)?),
                        None,
                        &[concat!($($what),*)],
                    ),)*
                    $((
                        stringify!($field),
                        <$kind as OptionKind>::shape(),
                        concat!($($(stringify!($unit)),*)?),
                        Some(<$kind as OptionKind>::data(&$default)),
                        &[concat!($($about),*)],
                    ),)*
                ]);
                $crate::analyses::options::Declaration::new(
                    $class,
                    $crate::elements::Table { name: $name, doc: doc(&[$($doc),*]), fields },
                    &[$($((stringify!($one), &[$(stringify!($other)),+]),)+)?],
                )
            }

            #[allow(unused_variables)] // where there are no options
            fn read(reader: &mut $crate::analyses::options::Reader<'_>) -> Option<Self> {
                // every option is read, so that all problems are reported at once
                #[allow(unreachable_patterns)] // where there are no options
                match (
                    $(<$must as $crate::analyses::options::OptionKind>::required(
                        reader, stringify!($required), concat!($($(stringify!($in)),*)?)),)*
                    $(<$kind as $crate::analyses::options::OptionKind>::optional(
                        reader, $crate::elements::plain(stringify!($field)),
                        concat!($($(stringify!($unit)),*)?), $default),)*
                ) {
                    ($(Some($required),)* $(Some($field),)*) => Some(Self { $($required,)* $($field),* }),
                    _ => None,
                }
            }

            $(fn conflict(
                &self,
                model: &$crate::model::Model,
            ) -> Option<(&'static str, String)> {
                let conflict: fn(&Self, &$crate::model::Model) -> Option<(&'static str, String)> =
                    $conflict;
                conflict(self, model)
            })?
        }
    };
}
pub(in crate::analyses) use options;

/// Declares the members of a family. Each member converts to the value by `From`. The first member is the default.
macro_rules! family {
    ($Value:ident, $name:literal, [$Default:ident $(, $Other:ident)* $(,)?]) => {
        impl Default for $Value {
            fn default() -> Self {
                $Default::new().into()
            }
        }

        impl $crate::analyses::options::Member for $Value {
            fn family() -> $crate::analyses::options::Family {
                use $crate::analyses::options::Declared;
                let options = vec![$Default::declaration() $(, $Other::declaration())*];
                $crate::analyses::options::Family { name: $name, options }
            }
        }

        impl $crate::analyses::options::OptionKind for $Value {
            type Value = Self;

            fn shape() -> $crate::elements::Shape {
                $crate::elements::Shape::Options($name)
            }

            fn data(_: &Self) -> $crate::elements::Default {
                use $crate::analyses::options::Declared;
                $crate::elements::Default::Type($Default::NAME)
            }

            fn read(
                reader: &mut $crate::analyses::options::Reader<'_>,
                key: &'static str,
                _: &'static str,
            ) -> Option<Self> {
                use $crate::analyses::options::Declared;
                reader.chosen(key, |reader, kind| match kind {
                    $Default::NAME => Some($Default::read(reader)?.into()),
                    $($Other::NAME => Some($Other::read(reader)?.into()),)*
                    _ => reader.refuse("type", format!("unknown {} '{kind}'", $name)),
                })
            }
        }
    };
}
pub(in crate::analyses) use family;
