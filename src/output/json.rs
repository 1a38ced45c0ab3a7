//! JSON formatted to be read by people too: a list of numbers stays on one line where it fits, and
//! −0 is written as 0.

use serde_json::Value;

/// A list is broken over lines beyond this many characters.
const WIDTH: usize = 100;

/// `value` as text that ends with a newline.
pub fn text(value: &Value) -> String {
    let mut out = String::new();
    write(value, 0, &mut out);
    out.push('\n');
    out
}

fn write(value: &Value, indent: usize, out: &mut String) {
    let inner = "  ".repeat(indent + 1);
    match value {
        Value::Object(map) if !map.is_empty() => {
            for (i, (key, value)) in map.iter().enumerate() {
                out.push_str(if i == 0 { "{\n" } else { ",\n" });
                out.push_str(&format!("{inner}{}: ", Value::from(key.as_str())));
                write(value, indent + 1, out);
            }
            out.push_str(&format!("\n{}}}", "  ".repeat(indent)));
        }
        Value::Array(items) if items.iter().any(has_objects) => {
            for (i, item) in items.iter().enumerate() {
                out.push_str(if i == 0 { "[\n" } else { ",\n" });
                out.push_str(&inner);
                write(item, indent + 1, out);
            }
            out.push_str(&format!("\n{}]", "  ".repeat(indent)));
        }
        Value::Array(items) => {
            let mut line = out.len() - out.rfind('\n').map_or(0, |end| end + 1);
            out.push('[');
            for (i, item) in items.iter().enumerate() {
                let item = plain(item);
                if i > 0 {
                    out.push(',');
                    if line + item.len() + 2 > WIDTH {
                        out.push_str(&format!("\n{inner}"));
                        line = inner.len();
                    } else {
                        out.push(' ');
                    }
                }
                line += item.len() + 2;
                out.push_str(&item);
            }
            out.push(']');
        }
        value => out.push_str(&plain(value)),
    }
}

fn has_objects(value: &Value) -> bool {
    match value {
        Value::Object(_) => true,
        Value::Array(items) => items.iter().any(has_objects),
        _ => false,
    }
}

/// `value` on one line.
fn plain(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("[{}]", items.iter().map(plain).collect::<Vec<_>>().join(", ")),
        Value::Number(x) if x.as_f64() == Some(0.0) && x.is_f64() => "0.0".to_owned(),
        value => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::text;
    use serde_json::json;

    #[test]
    fn lists_run_on_and_zero_has_no_sign() {
        let pairs: Vec<(usize, f64)> = (0..30).map(|i| (i, -0.0)).collect();
        let value = json!({
            "a": -0.0, "b": [1, -0.0, [2, 3]], "c": pairs,
            "d": [{ "e": {} }, {}], "f": [], "g": null, "h": "x\ny",
        });
        let text = text(&value);
        assert!(!text.contains("-0") && text.lines().all(|line| line.len() <= 104), "{text}");
        assert!(text.contains("\"b\": [1, 0.0, [2, 3]],\n"), "{text}");
        assert!(text.lines().count() < 20, "{text}");
        let back: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(back, value);
    }
}
