//! The schemas of `docs/schema`, derived from the types that commands print.
//! `NBC_UPDATE_SCHEMAS=1 cargo test --bin nbc schemas` rewrites them; read the diff before you commit it.

use std::fs;
use std::iter;
use std::path::Path;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Value, json};

use crate::cli::documents::{DiagnosticList, RobotList};
use crate::cli::{bug_report, build, draw, evolve, explain, fmt, library, prove, simulate, test};
use nbc_session::report::{Elites, Listing, RunResult, Schema};
use nbc_session::store::RobotRecord;
use nbc_session::{LearningReport, Reach, RecognitionReport, SynthesisReport, Verified};

/// All but that of `nbc workers`, whose crate needs a C compiler. That schema is written by hand.
fn derived() -> Vec<(Schema, Value)> {
    let mut all = vec![
        of::<library::add::Answers>(Schema::Added),
        of::<bug_report::Report>(Schema::BugReport),
        of::<build::BuiltCircuit>(Schema::Build),
        of::<DiagnosticList>(Schema::Diagnostics),
        of::<draw::DrawnFile>(Schema::Drawn),
        of::<Elites>(Schema::Elites),
        of::<evolve::Results>(Schema::Evolve),
        of::<explain::Explanation>(Schema::Explain),
        of::<fmt::FormattedFiles>(Schema::Formatted),
        of::<LearningReport>(Schema::Learn),
        of::<RobotList<Listing>>(Schema::Library),
        of::<prove::ProofResults>(Schema::Prove),
        of::<RobotList<Reach>>(Schema::Radii),
        of::<RobotRecord>(Schema::Robot),
        of::<RobotList<RobotRecord>>(Schema::Robots),
        of::<test::worlds::WorldResults>(Schema::Robustness),
        of::<RunResult>(Schema::Run),
        of::<RecognitionReport>(Schema::See),
        of::<simulate::SimulatedPath>(Schema::Simulate),
        of::<SynthesisReport>(Schema::Synth),
        of::<test::TestResults>(Schema::Test),
        of::<RobotList<Verified>>(Schema::Verify),
    ];
    #[cfg(feature = "gpu")]
    all.extend([
        of::<crate::cli::bench::BenchFigures>(Schema::Bench),
        of::<crate::cli::gpu::devices::DeviceList>(Schema::Devices),
    ]);
    #[cfg(feature = "play")]
    all.extend([of::<crate::cli::play::ServedPage>(Schema::Play), of::<crate::cli::play::WrittenPage>(Schema::Player)]);
    all
}

fn of<T: JsonSchema>(schema: Schema) -> (Schema, Value) {
    let settings = SchemaSettings::draft2020_12().for_serialize().with_transform(RecursiveTransform(simplify));
    let mut root = settings.into_generator().into_root_schema_for::<T>().to_value();
    root["$id"] = schema.id().into();
    root["title"] = schema.title().into();
    root["properties"]["schema"] = json!({ "const": schema.id() });
    let required = root["required"].as_array().cloned().unwrap_or_default();
    root["required"] = iter::once("schema".into()).chain(required).collect();
    (schema, root)
}

/// Refuses other fields, leaves out the formats of numbers, and makes a description of a doc comment.
fn simplify(schema: &mut schemars::Schema) {
    schema.remove("format");
    schema.remove("unevaluatedProperties");
    if schema.get("properties").is_some() {
        schema.insert("additionalProperties".to_owned(), false.into());
    }
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ").replace("[`", "`").replace("`]", "`");
    }
}

#[test]
fn the_schemas_are_those_of_what_is_printed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/schema");
    for (schema, value) in derived() {
        let path = folder.join(format!("{}.json", schema.word()));
        let text = serde_json::to_string_pretty(&value).unwrap() + "\n";
        if std::env::var_os("NBC_UPDATE_SCHEMAS").is_some() {
            fs::write(&path, &text).unwrap();
        }
        let found = fs::read_to_string(&path).unwrap_or_default();
        assert!(found == text, "{} is not derived; NBC_UPDATE_SCHEMAS=1 rewrites it", path.display());
    }
}
