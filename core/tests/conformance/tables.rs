//! The declarations of elements, bodies and analyses.

use kempe::analyses::{declarations, option_families};
use kempe::elements::{catalogue, Shape, Table};
use kempe::expression::unit::Unit;
use kempe::model::{body_tables, shape_tables};
use std::collections::HashSet;

fn tables() -> Vec<Table> {
    let options = option_families().iter().flat_map(|f| &f.options);
    let options = declarations().iter().chain(options).map(|declared| declared.table.clone());
    let elements = catalogue().into_iter().map(|(_, table)| table);
    elements.chain(body_tables()).chain(shape_tables()).chain(options).collect()
}

#[test]
fn everything_is_documented() {
    for table in tables() {
        assert!(table.doc.len() > 10 && table.doc.ends_with('.'), "{}: {}", table.name, table.doc);
        for field in &table.fields {
            let place = format!("{}.{}: {}", table.name, field.name, field.doc);
            assert!(field.doc.len() > 3 && field.doc.ends_with('.'), "{place}");
        }
    }
}

#[test]
fn names_are_unique_and_not_reserved() {
    let mut types = HashSet::new();
    for table in tables() {
        assert!(types.insert(table.name), "{} twice", table.name);
        let mut fields = HashSet::new();
        for field in &table.fields {
            assert!(fields.insert(field.name), "{}.{} twice", table.name, field.name);
            assert_ne!(field.name, "type", "{}", table.name);
        }
    }
}

#[test]
fn quantities_have_units_that_exist_and_references_have_none() {
    for table in tables() {
        for field in &table.fields {
            let place = format!("{}.{} [{}]", table.name, field.name, field.unit);
            match field.shape {
                Shape::Number
                | Shape::Law
                | Shape::Pair
                | Shape::Triple
                | Shape::LawPair
                | Shape::Laws
                | Shape::Points
                | Shape::Ranges
                | Shape::Section
                | Shape::Terms
                | Shape::Corners => {
                    for unit in
                        field.unit.split(['|', ',']).filter(|u| !u.is_empty() && *u != "any")
                    {
                        assert!(Unit::parse(unit).is_ok(), "{place}");
                    }
                }
                _ => assert_eq!(field.unit, "", "{place}"),
            }
        }
    }
    let counts = ["teeth", "command"];
    for (_, table) in catalogue() {
        for field in table.fields.iter().filter(|f| matches!(f.shape, Shape::Law | Shape::Pair)) {
            let counts = counts.contains(&field.name);
            assert_eq!(field.unit.is_empty(), counts, "{}.{}", table.name, field.name);
        }
    }
}
