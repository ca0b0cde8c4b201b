//! Checks of JSON against the schemas of `docs/schema`.

use crate::support::*;

/// Asserts that a text is JSON by the schema of that word, and returns it.
#[track_caller]
pub fn validate(word: &str, text: &str) -> Value {
    let found: Value = serde_json::from_str(text).unwrap_or_else(|error| panic!("{word}: {error}\n{text}"));
    let schema = schema(word);
    assert_eq!(found["schema"], schema["$id"], "the output says its schema");
    let validator = jsonschema::draft202012::new(&schema).expect("a schema");
    let faults: Vec<String> =
        validator.iter_errors(&found).map(|fault| format!("{}: {fault}", fault.instance_path())).collect();
    assert!(faults.is_empty(), "{word}:\n{}", faults.join("\n"));
    found
}

pub fn schema(word: &str) -> Value {
    serde_json::from_str(&text_of(format!("docs/schema/{word}.json"))).unwrap()
}
