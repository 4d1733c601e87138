//! JSON values in the notation of JSON, in little code: `serde_json::json!` compiles ten times as much.

use serde_json::{Map, Value};

/// A JSON value: an object, a list, or an expression that converts to a [`Value`].
macro_rules! json {
    ({ $($entries:tt)* }) => {{
        #[allow(unused_mut)] // of an empty object
        let mut map = serde_json::Map::new();
        $crate::case::json_literal::json!(@put map $($entries)*);
        serde_json::Value::Object(map)
    }};
    ([ $({ $($entries:tt)* }),+ ]) => {
        serde_json::Value::Array(vec![$($crate::case::json_literal::json!({ $($entries)* })),+])
    };
    ([ { $($entries:tt)* }, $item:expr ]) => {
        serde_json::Value::Array(vec![
            $crate::case::json_literal::json!({ $($entries)* }), $item.into(),
        ])
    };
    ([ $($item:expr),* $(,)? ]) => { serde_json::Value::Array(vec![$($item.into()),*]) };
    (@put $map:ident) => {};
    (@put $map:ident $key:literal : { $($value:tt)* } $(, $($rest:tt)*)?) => {
        $crate::case::json_literal::put(
            &mut $map, $key, $crate::case::json_literal::json!({ $($value)* }));
        $crate::case::json_literal::json!(@put $map $($($rest)*)?);
    };
    (@put $map:ident $key:literal : [ $($value:tt)* ] $(, $($rest:tt)*)?) => {
        $crate::case::json_literal::put(
            &mut $map, $key, $crate::case::json_literal::json!([ $($value)* ]));
        $crate::case::json_literal::json!(@put $map $($($rest)*)?);
    };
    (@put $map:ident $key:literal : $value:expr $(, $($rest:tt)*)?) => {
        $crate::case::json_literal::put(&mut $map, $key, $value.into());
        $crate::case::json_literal::json!(@put $map $($($rest)*)?);
    };
    ($value:expr) => { serde_json::Value::from($value) };
}
pub(super) use json;

#[inline(never)] // one copy for all entries
pub(super) fn put(map: &mut Map<String, Value>, key: &str, value: Value) {
    map.insert(key.to_string(), value);
}
