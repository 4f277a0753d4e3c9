//! [`objects`]: where the objects in a JSON document are, to change one after the other.

use serde_json::Value;

/// The pointers of all objects in a document, outer ones first.
pub fn objects(document: &Value) -> Vec<String> {
    let mut found = Vec::new();
    collect(document, "", &mut found);
    found
}

fn collect(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(fields) => {
            found.push(pointer.to_owned());
            for (name, value) in fields {
                collect(value, &format!("{pointer}/{name}"), found);
            }
        }
        Value::Array(values) => {
            for (index, value) in values.iter().enumerate() {
                collect(value, &format!("{pointer}/{index}"), found);
            }
        }
        _ => {}
    }
}
