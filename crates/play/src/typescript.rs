//! The types of the messages for the page: `web/src/protocol.ts` is made from the schemas of the requests and of the
//! server's messages. `NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play protocol` rewrites it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::slice;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::Value;

use crate::message::{ClassCourse, ClassRoll, ServerMessage};
use crate::request::Request;

const HEAD: &str = "\
// Generated from the messages of crates/play: NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play protocol
// docs/play-protocol.md describes them.
";

#[derive(Default)]
struct Declared {
    texts: BTreeMap<String, String>,
    /// Whether what may be left out may also be null, as in requests.
    is_read: bool,
}

impl Declared {
    fn add<T: JsonSchema>(&mut self, settings: SchemaSettings) {
        let schema = settings.into_generator().into_root_schema_for::<T>().to_value();
        self.declare(schema["title"].as_str().expect("a root has a name"), &schema);
        for (name, part) in schema["$defs"].as_object().into_iter().flatten() {
            self.declare(name, part);
        }
    }

    fn declare(&mut self, name: &str, schema: &Value) {
        let value = match schema.get("properties") {
            Some(_) if alternatives(schema).is_none() => format!("{{\n{}}}", self.fields(schema, "  ", ",\n")),
            _ => self.text(schema).replace(" | {", "\n  | {"),
        };
        let text = format!("{}export type {name} = {value};", comment(schema, ""));
        self.texts.entry(name.to_owned()).or_insert(text);
    }

    fn fields(&self, schema: &Value, before: &str, after: &str) -> String {
        let required = schema["required"].as_array().cloned().unwrap_or_default();
        let field = |(name, field): (&String, &Value)| {
            let is_required = required.iter().any(|one| one == name);
            let mut value = self.text(field);
            if !is_required && !self.is_read {
                value = value.replace(" | null", "");
            }
            let comment = if after.ends_with('\n') { comment(field, before) } else { String::new() };
            format!("{comment}{before}{name}{}: {value}{after}", if is_required { "" } else { "?" })
        };
        schema["properties"].as_object().into_iter().flatten().map(field).collect()
    }

    fn text(&self, schema: &Value) -> String {
        let mut parts = Vec::new();
        if schema.get("properties").is_some() {
            parts.push(format!("{{ {} }}", self.fields(schema, "", ", ").trim_end_matches(", ")));
        }
        if let Some(name) = schema["$ref"].as_str() {
            parts.push(name.rsplit('/').next().unwrap_or(name).to_owned());
        } else if let Some(value) = schema.get("const") {
            parts.push(value.to_string());
        } else if let Some(values) = schema["enum"].as_array() {
            parts.push(values.iter().map(Value::to_string).collect::<Vec<_>>().join(" | "));
        } else if let Some(all) = alternatives(schema) {
            let union = all.iter().map(|one| self.text(one)).collect::<Vec<_>>().join(" | ");
            parts.push(if parts.is_empty() { union } else { format!("({union})") });
        } else if parts.is_empty() {
            let kinds = schema["type"].as_array().map_or(slice::from_ref(&schema["type"]), Vec::as_slice);
            parts.push(kinds.iter().map(|kind| self.plain(schema, kind)).collect::<Vec<_>>().join(" | "));
        }
        parts.join(" & ")
    }

    fn plain(&self, schema: &Value, kind: &Value) -> String {
        match kind.as_str() {
            Some("integer" | "number") => "number".to_owned(),
            Some("array") => self.array(schema),
            Some("object") => match schema.get("additionalProperties").filter(|values| values.is_object()) {
                Some(values) => format!("{{ [key in string]: {} }}", self.text(values)),
                None => "Record<string, never>".to_owned(),
            },
            Some(kind) => kind.to_owned(),
            None => "unknown".to_owned(),
        }
    }

    fn array(&self, schema: &Value) -> String {
        let places = match schema["prefixItems"].as_array() {
            Some(places) => places.iter().map(|place| self.text(place)).collect::<Vec<_>>(),
            None => {
                let item = self.text(&schema["items"]);
                match schema["maxItems"].as_u64() {
                    Some(count) => vec![item; count as usize],
                    None => return format!("Array<{item}>"),
                }
            }
        };
        format!("[{}]", places.join(", "))
    }
}

fn alternatives(schema: &Value) -> Option<&Vec<Value>> {
    schema["oneOf"].as_array().or(schema["anyOf"].as_array())
}

fn comment(schema: &Value, indent: &str) -> String {
    let text = schema["description"].as_str().map(|text| text.replace('\n', " ").replace("[`", "`").replace("`]", "`"));
    text.map(|text| format!("{indent}/** {text} */\n")).unwrap_or_default()
}

#[test]
fn the_protocol_of_the_page_is_that_of_the_server() {
    let mut declared = Declared::default();
    declared.add::<ServerMessage>(SchemaSettings::draft2020_12().for_serialize());
    declared.add::<ClassCourse>(SchemaSettings::draft2020_12().for_serialize());
    declared.add::<ClassRoll>(SchemaSettings::draft2020_12().for_serialize());
    declared.is_read = true;
    declared.add::<Request>(SchemaSettings::draft2020_12().for_deserialize());
    let texts: Vec<String> = declared.texts.into_values().collect();
    let expected = format!("{HEAD}\n{}\n", texts.join("\n\n"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/src/protocol.ts");
    if std::env::var_os("NBC_UPDATE_PROTOCOL").is_some() {
        fs::write(&path, &expected).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap();
    assert!(found == expected, "web/src/protocol.ts is not as NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play writes it");
}
