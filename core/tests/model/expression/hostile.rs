//! Every text gives a quick answer and no panic.

use super::{error, Model};
use kempe::expression::{Expression, MAX_DEPTH, MAX_LENGTH, MAX_OPERANDS};
use std::time::{Duration, Instant};

#[test]
fn long_texts_are_refused_unread() {
    for text in ["1+", "(", "-", "2^", "sin(", "é", "\0", "`"] {
        let error = error(&text.repeat(100_000));
        assert!(error.message.contains("bytes; at most 4096"), "{}", error.message);
    }
}

#[test]
fn deep_texts_are_refused() {
    for text in ["(", "-", "+", "2^", "sin(", "2^-", "if(1<2,", "max(1,"] {
        let error = error(&text.repeat(MAX_LENGTH / text.len()));
        assert_eq!(error.message, "the expression is nested more than 64 levels deep");
    }
    let nested = |depth| format!("{}a{}", "(".repeat(depth), ")".repeat(depth));
    assert!(Expression::parse(&nested(MAX_DEPTH)).is_ok());
    assert!(Expression::parse(&nested(MAX_DEPTH + 1)).is_err());
}

#[test]
fn wide_texts_are_read() {
    let sum = ["a"; MAX_LENGTH / 2].join("+");
    let expression = Expression::parse(&sum).unwrap();
    assert_eq!(expression.to_string(), sum);
    assert_eq!(super::value(&sum), MAX_LENGTH as f64);
}

#[test]
fn open_operands_are_bounded() {
    let open = |count: usize| format!("{}a{}", "a+(".repeat(count - 1), ")".repeat(count - 1));
    for count in 1..=MAX_OPERANDS {
        assert_eq!(super::value(&open(count)), 2.0 * count as f64);
    }
    let message = error(&open(MAX_OPERANDS + 1)).message;
    assert_eq!(message, "the expression holds more than 32 operands open at this point");
}

#[test]
fn noise_gives_errors_and_never_panics() {
    let pieces = [
        "a", "t", "crank.x", "1", ".5", "1e9", "+", "-", "*", "/", "^", "(", ")", ",", "<", ">=",
        "if(", "sin(", "max(", "`", ".", " ", "\n", "\u{0}", "\u{1b}", "é", "𝛑", "\u{202e}", "e",
        "\u{301}", "deg", "kN", "°", "µm", "²", "=", "#", "\\", "\"", "'", "1e999", "_",
        "\u{feff}",
    ];
    let mut seed: u64 = 0x2545_f491_4f6c_dd1d;
    let start = Instant::now();
    for _ in 0..20_000 {
        let mut text = String::new();
        for _ in 0..1 + seed % 12 {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            text.push_str(pieces[(seed >> 16) as usize % pieces.len()]);
        }
        match Expression::parse(&text).and_then(|expression| {
            assert_eq!(Expression::parse(&expression.to_string()).as_ref(), Ok(&expression));
            expression.compile(&Model)
        }) {
            Ok(tape) => assert!(tape.symbols().len() <= text.len()),
            Err(error) => {
                assert!(text.get(error.span.clone()).is_some(), "{text:?}: {error:?}");
                let shown = format!("{}{}", error.message, error.hint.unwrap_or_default());
                assert!(!shown.contains(char::is_control), "{text:?}: {shown:?}");
            }
        }
    }
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}

#[test]
fn the_longest_names_are_looked_up_quickly() {
    let name = "x".repeat(MAX_LENGTH);
    let near: Vec<String> = (0..5).map(|k| format!("{}{k}", "x".repeat(MAX_LENGTH - 1))).collect();
    let start = Instant::now();
    let error = Expression::parse(&name).unwrap().compile(near.as_slice()).unwrap_err();
    assert_eq!(error.hint.as_deref(), Some("declare it in the parameters"));
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}
