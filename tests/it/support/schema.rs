//! Checks of JSON against the schemas of `docs/schema`.

use crate::support::*;

/// Asserts that a text is JSON by the schema of that word, and returns it.
#[track_caller]
pub fn validate(word: &str, text: &str) -> Value {
    let found: Value = serde_json::from_str(text).unwrap_or_else(|error| panic!("{word}: {error}\n{text}"));
    let schema = schema(word);
    assert_eq!(found["schema"], schema["$id"], "the output says its schema");
    let faults = faults(&schema, &schema, &found);
    assert!(faults.is_empty(), "{word}:\n{}", faults.join("\n"));
    found
}

pub fn schema(word: &str) -> Value {
    serde_json::from_str(&text_of(format!("docs/schema/{word}.json"))).unwrap()
}

/// The faults of a value under the keywords that `docs/schema` uses; another keyword is a panic. The tests of Python
/// read the schemas with a complete validator.
pub fn faults(root: &Value, schema: &Value, value: &Value) -> Vec<String> {
    let Some(keywords) = schema.as_object() else {
        return if schema == &Value::Bool(false) { vec![format!("unexpected: {value}")] } else { Vec::new() };
    };
    let inner = |schema: &Value, value: &Value| faults(root, schema, value);
    let valid = |schemas: &Value| schemas.as_array().unwrap().iter().filter(|one| inner(one, value).is_empty()).count();
    let mut found = Vec::new();
    for (keyword, wanted) in keywords {
        let holds = match keyword.as_str() {
            "type" => wanted
                .as_array()
                .map_or_else(|| has_type(wanted, value), |all| all.iter().any(|one| has_type(one, value))),
            "const" => value == wanted,
            "enum" => wanted.as_array().unwrap().contains(value),
            "minimum" => value.as_f64().is_none_or(|number| number >= wanted.as_f64().unwrap()),
            "maximum" => value.as_f64().is_none_or(|number| number <= wanted.as_f64().unwrap()),
            "minItems" => value.as_array().is_none_or(|items| items.len() as u64 >= wanted.as_u64().unwrap()),
            "maxItems" => value.as_array().is_none_or(|items| items.len() as u64 <= wanted.as_u64().unwrap()),
            "pattern" => {
                let pattern = regex::Regex::new(wanted.as_str().unwrap()).unwrap();
                value.as_str().is_none_or(|text| pattern.is_match(text))
            }
            "required" => {
                let has = |name: &Value| value.get(name.as_str().unwrap()).is_some();
                !value.is_object() || wanted.as_array().unwrap().iter().all(has)
            }
            "anyOf" => valid(wanted) > 0,
            "oneOf" => valid(wanted) == 1,
            "$ref" => {
                let place = wanted.as_str().unwrap().strip_prefix('#').unwrap();
                found.extend(inner(root.pointer(place).expect("a definition"), value));
                true
            }
            "items" => {
                found.extend(value.as_array().into_iter().flatten().flat_map(|item| inner(wanted, item)));
                true
            }
            "properties" | "additionalProperties" => {
                let named = |name: &str| keywords.get("properties").and_then(|all| all.get(name));
                for (name, field) in value.as_object().into_iter().flatten() {
                    let schema = if keyword == "properties" {
                        named(name)
                    } else {
                        Some(wanted).filter(|_| named(name).is_none())
                    };
                    let inside = schema.map_or_else(Vec::new, |schema| inner(schema, field));
                    found.extend(inside.iter().map(|fault| format!("{name}: {fault}")));
                }
                true
            }
            "$defs" | "$id" | "$schema" | "description" | "title" => true,
            _ => panic!("the keyword `{keyword}` is not checked"),
        };
        if !holds {
            found.push(format!("{keyword} {wanted}: {value}"));
        }
    }
    found
}

fn has_type(name: &Value, value: &Value) -> bool {
    match name.as_str().unwrap() {
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("no type is called {other}"),
    }
}
