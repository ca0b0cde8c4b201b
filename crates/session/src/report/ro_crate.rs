//! Evolution runs described as a research object: the metadata file of an RO-Crate.
//!
//! It follows RO-Crate 1.1 (<https://w3id.org/ro/crate/1.1>) and its profile for runs of a program, Process Run Crate
//! 0.5 (<https://w3id.org/ro/wfrun/process/0.5>).

use std::collections::BTreeSet;

use nbc_base::diag::counted;
use serde_json::{Value, json};

/// The name that the metadata file of an RO-Crate must have.
const RO_CRATE_FILE: &str = "ro-crate-metadata.json";

/// The format of the metadata file.
const RO_CRATE: &str = "https://w3id.org/ro/crate/1.1";

/// What is described: runs of a program.
const PROCESS: &str = "https://w3id.org/ro/wfrun/process/0.5";

/// A file of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CrateFile {
    /// Its path in the crate, with `/` between folders.
    pub path: String,
    /// What is in it.
    pub description: &'static str,
    /// Its media type.
    pub media: &'static str,
    /// Its size in bytes.
    pub size: u64,
    /// Its SHA-256 in hexadecimal digits.
    pub sha256: String,
}

/// One seed of an evolution run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CrateRun {
    /// Its folder in the crate; empty for the crate's own.
    pub folder: String,
    /// The name of its declaration.
    pub evolution: String,
    /// Its seed.
    pub seed: u64,
    /// Generations that are done.
    pub generations: u32,
    /// The version of the program that wrote it.
    pub version: String,
    /// When its checkpoint was last written, as `2026-11-25T17:51:46+00:00`.
    pub ended: String,
    /// Its files.
    pub files: Vec<CrateFile>,
}

/// The metadata of a folder of runs.
pub fn ro_crate(title: &str, license: Option<&str>, runs: &[CrateRun]) -> Value {
    let published = runs.iter().map(|run| run.ended.as_str()).max().unwrap_or_default();
    let seeds = counted(runs.len(), "seed");
    let mut root = json!({
        "@id": "./",
        "@type": "Dataset",
        "conformsTo": { "@id": PROCESS },
        "name": title,
        "description": format!("Evolution runs of soft robots as logic gates: {seeds}, with their archives"),
        "datePublished": published.split('T').next(),
        "hasPart": runs.iter().flat_map(CrateRun::parts).collect::<Vec<_>>(),
        "mentions": runs.iter().map(|run| json!({ "@id": run.action() })).collect::<Vec<_>>(),
    });
    let mut graph = vec![
        json!({
            "@id": RO_CRATE_FILE,
            "@type": "CreativeWork",
            "conformsTo": { "@id": RO_CRATE },
            "about": { "@id": "./" },
        }),
        json!({ "@id": PROCESS, "@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5" }),
    ];
    if let Some(license) = license {
        let id = format!("https://spdx.org/licenses/{license}");
        root["license"] = json!({ "@id": id });
        graph.push(json!({ "@id": id, "@type": "CreativeWork", "name": license }));
    }
    graph.insert(1, root);
    let versions: BTreeSet<&str> = runs.iter().map(|run| run.version.as_str()).collect();
    graph.extend(versions.into_iter().map(|version| {
        json!({
            "@id": program(version),
            "@type": "SoftwareApplication",
            "name": "nbc",
            "description": "Circuits made of soft robots",
            "softwareVersion": version,
        })
    }));
    graph.extend(runs.iter().flat_map(CrateRun::entities));
    json!({ "@context": format!("{RO_CRATE}/context"), "@graph": graph })
}

fn program(version: &str) -> String {
    format!("#nbc-{version}")
}

impl CrateRun {
    /// What identifies the run. Two folders may have runs of the same name and seed.
    fn action(&self) -> String {
        if self.folder.is_empty() { "#run".to_owned() } else { format!("#run/{}", self.folder) }
    }

    /// Its parts in the list of the crate: its folder, or its files if they are in the crate's own.
    fn parts(&self) -> Vec<Value> {
        if self.folder.is_empty() { self.file_ids() } else { vec![json!({ "@id": format!("{}/", self.folder) })] }
    }

    fn file_ids(&self) -> Vec<Value> {
        self.files.iter().map(|file| json!({ "@id": file.path })).collect()
    }

    /// The run, its settings, its folder and its files.
    fn entities(&self) -> Vec<Value> {
        let (action, Self { evolution, seed, generations, .. }) = (self.action(), self);
        let title = format!("{evolution}, seed {seed}, {}", counted(*generations as usize, "generation"));
        let setting = |name: &str, value: Value| {
            let id = format!("{action}/{name}");
            json!({ "@id": id, "@type": "PropertyValue", "name": name, "value": value })
        };
        let settings = [
            setting("evolution", json!(evolution)),
            setting("seed", json!(seed)),
            setting("generations", json!(generations)),
        ];
        let mut entities = vec![json!({
            "@id": action,
            "@type": "CreateAction",
            "name": title,
            "description": "An evolution of bodies by `nbc evolve`; a seed gives the same archive on every machine",
            "instrument": { "@id": program(&self.version) },
            "object": settings.iter().map(|setting| json!({ "@id": setting["@id"] })).collect::<Vec<_>>(),
            "result": self.file_ids(),
            "endTime": self.ended,
        })];
        entities.extend(settings);
        if !self.folder.is_empty() {
            entities.push(json!({
                "@id": format!("{}/", self.folder),
                "@type": "Dataset",
                "name": title,
                "hasPart": self.file_ids(),
            }));
        }
        entities.extend(self.files.iter().map(|file| {
            json!({
                "@id": file.path,
                "@type": "File",
                "name": format!("{} of {title}", file.description),
                "description": file.description,
                "encodingFormat": file.media,
                "contentSize": file.size.to_string(),
                "sha256": file.sha256,
            })
        }));
        entities
    }
}
