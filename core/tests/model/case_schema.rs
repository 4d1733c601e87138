//! The schema agrees with the reader.

use kempe::case::{self, Format};
use kempe::elements::catalogue;
use kempe::model::Value;

fn get<'v>(value: &'v Value, path: &[&str]) -> Option<&'v Value> {
    path.iter().try_fold(value, |value, key| match value {
        Value::Table(entries) => entries.iter().find(|(k, _)| k == key).map(|(_, v)| v),
        Value::List(items) => items.get(key.parse::<usize>().ok()?),
        _ => None,
    })
}

fn schema() -> Value {
    case::parse_tree(&case::schema(), Format::Json).expect("the schema is JSON")
}

/// Whether a value fits a schema, for the words that the schema uses.
fn fits(root: &Value, schema: &Value, value: &Value) -> bool {
    let Value::Table(words) = schema else { return *schema == Value::Flag(true) };
    words.iter().all(|(word, rule)| match (word.as_str(), rule) {
        ("$ref", Value::Text(path)) => {
            let keys: Vec<&str> = path.trim_start_matches("#/").split('/').collect();
            fits(root, get(root, &keys).expect("the reference leads somewhere"), value)
        }
        ("allOf", Value::List(all)) => all.iter().all(|s| fits(root, s, value)),
        ("anyOf", Value::List(all)) => all.iter().any(|s| fits(root, s, value)),
        ("if", condition) => {
            let branch = if fits(root, condition, value) { "then" } else { "else" };
            get(schema, &[branch]).is_none_or(|rule| fits(root, rule, value))
        }
        ("not", rule) => !fits(root, rule, value),
        ("const", rule) => rule == value,
        ("enum", Value::List(all)) => all.contains(value),
        ("type", Value::Text(kind)) => is(kind, value),
        ("type", Value::List(kinds)) => {
            kinds.iter().any(|kind| matches!(kind, Value::Text(kind) if is(kind, value)))
        }
        ("items", rule) => match value {
            Value::List(items) => items.iter().all(|item| fits(root, rule, item)),
            _ => true,
        },
        ("uniqueItems", _) => !matches!(value, Value::List(two) if two[..1] == two[1..]),
        ("minItems", Value::Number(n)) => !matches!(value, Value::List(v) if (v.len() as f64) < *n),
        ("maxItems", Value::Number(n)) => !matches!(value, Value::List(v) if v.len() as f64 > *n),
        ("minimum", Value::Number(n)) => !matches!(value, Value::Number(x) if x < n),
        ("description" | "title" | "default" | "$schema" | "$defs", _) => true,
        ("pattern" | "maxLength" | "then" | "else", _) => true,
        (word, rule) => match value {
            Value::Table(entries) => fits_keys(root, schema, (word, rule), entries),
            _ => true,
        },
    })
}

/// The same for a word about keys.
fn fits_keys(
    root: &Value,
    schema: &Value,
    (word, rule): (&str, &Value),
    entries: &[(String, Value)],
) -> bool {
    let own = |key: &str| get(schema, &["properties", key]);
    let dotted = |key: &str| get(schema, &["patternProperties"]).is_some() && key.contains('.');
    let given = |key: &str| entries.iter().any(|(known, _)| known == key);
    match (word, rule) {
        ("required", Value::List(keys)) => {
            keys.iter().all(|key| matches!(key, Value::Text(key) if given(key)))
        }
        ("dependentSchemas", Value::Table(rules)) => rules
            .iter()
            .all(|(key, rule)| !given(key) || fits(root, rule, &Value::Table(entries.to_vec()))),
        ("properties", _) => {
            entries.iter().all(|(key, v)| own(key).is_none_or(|rule| fits(root, rule, v)))
        }
        ("patternProperties", rules) => {
            let rule = get(rules, &["[.]"]).expect("keys with a dot");
            entries.iter().all(|(key, v)| !key.contains('.') || fits(root, rule, v))
        }
        ("propertyNames", rule) => {
            entries.iter().all(|(key, _)| fits(root, rule, &Value::from(key.as_str())))
        }
        ("additionalProperties", rule) => entries
            .iter()
            .filter(|(key, _)| own(key).is_none() && !dotted(key))
            .all(|(_, v)| fits(root, rule, v)),
        (word, _) => panic!("the test has no case for '{word}'"),
    }
}

fn is(kind: &str, value: &Value) -> bool {
    match (kind, value) {
        ("object", Value::Table(_)) | ("array", Value::List(_)) => true,
        ("string", Value::Text(_)) | ("boolean", Value::Flag(_)) | ("number", Value::Number(_)) => {
            true
        }
        ("integer", Value::Number(x)) => x.fract() == 0.0,
        _ => false,
    }
}

fn valid(toml: &str) -> bool {
    let tree = case::parse_tree(toml, Format::Toml).expect("the syntax is right");
    fits(&schema(), &schema(), &tree)
}

#[test]
fn the_flagship_fits_and_its_mistakes_do_not() {
    let flagship = include_str!("../../../examples/four_bar.toml");
    assert!(valid(flagship));
    for (right, mistake) in [
        ("kempe = 1 ", "kempe = 2 "),
        ("mass = 3", "mas = 3"),
        ("mass = 3", "mass = true"),
        ("j = \"crank.A\"", ""),
        ("type = \"revolute\"", "type = \"revolut\""),
        ("ends = [\"A\", \"B\"]", "ends = [\"A\"]"),
        ("t_end = 15", ""),
        ("type = \"rk45\"", "type = \"rk54\""),
        ("alpha = 10", "alfa = 10"),
        ("points = { A = [0, 0]", "points = { A = 3"),
    ] {
        let broken = flagship.replacen(right, mistake, 1);
        assert_ne!(broken, flagship);
        assert!(!valid(&broken), "{mistake}");
        assert!(case::read(&broken, Format::Toml).is_err(), "{mistake}");
    }
}

#[test]
fn every_element_and_field_has_its_description_and_unit() {
    let schema = schema();
    for (group, table) in catalogue() {
        let path = ["properties", group.section(), "additionalProperties", "then", "allOf"];
        let Some(Value::List(choices)) = get(&schema, &path) else { panic!("no {}", path[1]) };
        let name = Value::from(table.name);
        let of_type = |c: &&Value| get(c, &["if", "properties", "type", "const"]) == Some(&name);
        let choice = choices.iter().find(of_type).expect("each type has its schema");
        let choice = get(choice, &["then"]).expect("with its fields");
        assert_eq!(get(choice, &["description"]), Some(&Value::Text(table.doc.clone())));
        for field in table.fields {
            let described = get(choice, &["properties", field.name, "description"]);
            let Some(Value::Text(words)) = described else { panic!("{} is absent", field.name) };
            assert!(words.starts_with(&field.doc) && words.contains(&field.unit));
        }
    }
}
