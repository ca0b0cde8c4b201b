//! The invariants of ARCHITECTURE.md that can be checked in the text of the source.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use regex::Regex;

use crate::modules::{Module, circles, imports, modules, place};
use crate::support::root;

/// The folders that share a crate, with their layers; such a folder imports lower layers only. Between crates, the
/// manifests say who may import whom.
const LAYERS: &[(&str, u8)] = &[
    ("source", 0),
    ("diag", 1),
    ("model", 1),
    ("budget", 2),
    ("syntax", 2),
    ("check", 3),
    ("evolve", 2),
    ("swarm", 3),
];

/// The folder of a crate that a file belongs to; where a crate is one folder, the crate without `nbc_`.
fn folder(path: &Path) -> String {
    let (name, inside) = place(path);
    let first = inside.components().next().unwrap().as_os_str().to_string_lossy().into_owned();
    let shared = LAYERS.iter().any(|(folder, _)| *folder == first);
    if shared || name == "nbc" { first.trim_end_matches(".rs").to_owned() } else { name.replace("nbc_", "") }
}

fn layer(folder: &str) -> Option<u8> {
    LAYERS.iter().find(|(name, _)| *name == folder).map(|&(_, layer)| layer)
}

/// Fails with the rule when a line of product code outside the allowed places holds one of the words, unless the line
/// is marked `// lookups only`.
fn forbid(rule: &str, words: &[&str], allowed: impl Fn(&Path) -> bool) {
    let mut found = Vec::new();
    for module in modules() {
        let path = &module.path;
        if allowed(path) {
            continue;
        }
        for (number, line) in module.product.lines().enumerate() {
            let (code, remark) = line.split_once("//").unwrap_or((line, ""));
            if words.iter().any(|word| code.contains(word)) && remark.trim() != "lookups only" {
                found.push(format!("{}:{}: {}", path.display(), number + 1, line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "{rule}\n{}", found.join("\n"));
}

#[test]
fn a_folder_imports_lower_layers_only() {
    let modules = modules();
    let mut found = Vec::new();
    for (module, imported) in modules.iter().zip(imports()) {
        let Some(own) = layer(&folder(&module.path)) else { continue };
        for other in imported.iter().map(|&at| &modules[at]) {
            let same_crate = place(&module.path).0 == place(&other.path).0;
            let to = folder(&other.path);
            if same_crate && to != folder(&module.path) && layer(&to).is_some_and(|layer| layer >= own) {
                found.push(format!("{} imports {}", module.file(), other.file()));
            }
        }
    }
    assert!(found.is_empty(), "a folder imports lower layers only\n{}", found.join("\n"));
}

/// The files that the feature `disk` brings in.
const DISK: [&str; 10] = [
    "store/src/atomic.rs",
    "store/src/disk.rs",
    "store/src/disk_world.rs",
    "store/src/draft.rs",
    "store/src/folder.rs",
    "store/src/lock.rs",
    "store/src/results.rs",
    "store/src/source_files.rs",
    "store/src/temporary.rs",
    "store/src/verilog/sandbox.rs",
];

/// The program and the doors with crates of their own.
fn is_door(path: &Path) -> bool {
    matches!(place(path).0.as_str(), "nbc" | "nbc_lsp" | "nbc_play" | "nbc_play_server" | "nbc_cluster" | "nbc_web")
}

/// The file that calls the driver of a device and waits for it.
const DRIVER: &str = "backend/opencl/card.rs";

/// A test that writes the types of the page's messages.
const TYPES: &str = "play/src/typescript.rs";

/// What may touch the world outside. A visit of the page and a language service may not: they take messages and the
/// time from their shells.
fn is_shell(path: &Path) -> bool {
    let (name, file) = place(path);
    let is_service = name == "nbc_play" || name == "nbc_lsp" && !file.starts_with("stdio");
    let named = DISK.iter().chain([&DRIVER, &TYPES]).any(|name| path.ends_with(name));
    is_door(path) && !is_service || named
}

#[test]
fn the_core_touches_nothing_outside() {
    let rule = "no printing, clock, environment, file, thread, process or network in the core";
    let outside = ["println!", "eprintln!", "print!(", "Instant::now", "SystemTime", "thread_local!"];
    forbid(rule, &outside, is_shell);
    let modules = ["std::env", "std::fs", "std::net", "std::process", "std::thread", "std::time"];
    forbid(rule, &modules, is_shell);
}

#[test]
fn doors_repeat_no_step_of_a_session() {
    // What remembers results must know the tasks, and the messages of the cluster are tasks.
    let allowed = ["cli/library/measured.rs", "src/lib.rs"];
    let steps = [
        "EvaluationProtocol",
        "EvaluationTask",
        "Robustness::of",
        " Search::new",
        "(Search::new",
        "Search::resume",
        "Task::Measurement",
        "Task::Screening",
        "WorldSample",
        "assemble(",
        "candidates_of",
        "correspondence::",
        "elaborate(",
        "map_with",
        "reachable::",
        "safe_radius",
    ];
    let is_allowed = |path: &Path| {
        !is_door(path) || place(path).0 == "nbc_cluster" || allowed.iter().any(|name| path.ends_with(name))
    };
    forbid("a door calls the session, and repeats none of its steps", &steps, is_allowed);
    for file in fs::read_dir(root().join("python/src")).unwrap() {
        let path = file.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let found: Vec<_> = steps.iter().filter(|step| text.contains(**step)).collect();
        assert!(found.is_empty(), "{} repeats steps of the session: {found:?}", path.display());
    }
}

#[test]
fn each_verb_has_two_doors() {
    let doors = ["src/cli", "crates/lsp/src", "crates/play/src", "crates/cluster/src", "python/src"];
    let texts = doors.map(|door| {
        let product = modules().iter().filter(|module| module.path.starts_with(root().join(door)));
        let own: String = product.map(|module| module.product.as_str()).collect();
        let other = fs::read_dir(root().join(door)).unwrap().map(|file| file.unwrap().path());
        let python = other.filter(|path| door == "python/src" && path.is_file());
        own + &python.map(|path| fs::read_to_string(path).unwrap()).collect::<String>()
    });
    for (verb, calls) in [
        ("check", vec![".checked(", "session.open("]),
        ("compile", vec![".compile("]),
        ("test", vec![".test(", ".cases(", ".run_list("]),
        ("prove", vec![".prove("]),
        ("simulate", vec![".simulate(", ".run_list("]),
        ("evolve", vec!["EvolutionRun", "BodySearch"]),
        ("yields", vec!["Yields"]),
        ("harden", vec![".harden("]),
        ("synthesize", vec!["Synthesis::"]),
        ("measure", vec!["RobotRequest::"]),
        ("verify", vec!["Verified::of"]),
    ] {
        let calling = texts.iter().filter(|text| calls.iter().any(|call| text.contains(call))).count();
        assert!(calling >= 2, "`{verb}` has {calling} doors");
    }
}

#[test]
fn the_ways_through_pass_functions_that_exist() {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let section = text.split("## Ways through").nth(1).unwrap().split("\n## ").next().unwrap();
    let names: Vec<&str> = section.split('`').skip(1).step_by(2).collect();
    assert!(names.len() > 40, "{names:?}");
    let word = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let functions = modules().iter().map(|module| module.code.split("fn ").skip(1).map(word).collect());
    let functions: Vec<BTreeSet<String>> = functions.collect();
    for name in names {
        let (owner, function) = name.rsplit_once("::").map_or((None, name), |(owner, name)| (Some(owner), name));
        let is_of = |module: &Module| {
            let Some(owner) = owner else { return true };
            let own = Regex::new(&format!(r"\bimpl\b[^{{]*\b{owner}\b|\btrait {owner}\b")).unwrap();
            module.name.iter().rev().take(2).any(|name| name == owner) || own.is_match(&module.code)
        };
        let mut defining = modules().iter().zip(&functions).filter(|(_, own)| own.contains(function));
        let found = defining.any(|(module, _)| is_of(module));
        assert!(found, "ARCHITECTURE.md names `{name}`, which does not exist");
    }
}

#[test]
fn the_core_has_no_statics() {
    let mut found: Vec<String> = Vec::new();
    for module in modules() {
        let is_static = |line: &str| {
            let item = line.trim_start().trim_start_matches("pub(crate) ").trim_start_matches("pub(super) ");
            item.trim_start_matches("pub ").starts_with("static ")
        };
        if !is_shell(&module.path) && module.code.lines().any(is_static) {
            found.push(module.file());
        }
    }
    assert!(found.is_empty(), "two sessions share nothing that changes: no statics outside doors: {found:?}");
}

#[test]
fn the_papers_materials_are_a_default() {
    let rule = "a body has its own palette; the paper's stands where a file, a speed test or the designer names none";
    let defaults =
        ["model/palette.rs", "model/body.rs", "store/src/robot.rs", "store/src/shape.rs", "play/src/bodies.rs"];
    forbid(rule, &["Palette::paper", "Setting::paper"], |path| defaults.iter().any(|name| path.ends_with(name)));
}

#[test]
fn unsafe_code_is_in_three_files() {
    let allowed = ["lanes/kernel.rs", "opencl/card.rs", "web/src/exports.rs"];
    forbid("`unsafe` is in the file of vectors, that of devices and that of a script's calls", &["unsafe {"], |path| {
        allowed.iter().any(|name| path.ends_with(name))
    });
}

#[test]
fn nothing_iterates_over_hash_maps() {
    let rule = "a hash map's order differs from run to run: use an ordered map, or say `// lookups only` where it is \
        never iterated";
    forbid(rule, &["HashMap", "HashSet"], |_| false);
}

#[test]
fn each_outer_crate_has_one_home() {
    let in_folder = |name: &'static str| move |path: &Path| folder(path) == name;
    forbid("only diag/render.rs names miette", &["miette"], |path| path.ends_with("diag/render.rs"));
    forbid("only store/ names YAML", &["serde_yaml"], in_folder("store"));
    let threads = |path: &Path| is_door(path) || path.ends_with("lanes/threads.rs");
    forbid("only doors and one file of sim/ name rayon", &["rayon"], threads);
    forbid("only two files of sim/backend/opencl name the driver's crate", &["opencl3"], |path| {
        ["card.rs", "listing.rs"].iter().any(|name| path.ends_with(Path::new("opencl").join(name)))
    });
    let drawing = ["report/src/film.rs", "report/src/font.rs", "report/src/raster.rs"];
    let pixels = |path: &Path| drawing.iter().any(|name| path.ends_with(name));
    let painters = ["tiny_skia", "ttf_parser", "gif::"];
    forbid("only three files of report/ name what draws pixels", &painters, pixels);
    let reads_png = |path: &Path| path.ends_with("model/png_file.rs");
    let rule = "only what draws pixels and model/png_file.rs name png";
    forbid(rule, &["png::"], |path| pixels(path) || reads_png(path));
    let files = |path: &Path| folder(path) == "store" || is_door(path);
    forbid("only store/ and doors name what writes files", &["tempfile", "rustix", "crc32fast"], files);
}

#[test]
fn messages_are_written_in_wording_files() {
    let rule = "a stage writes its messages in its `wording` files, as functions that return diagnostics";
    let builders = [
        "::new(Code::",
        "::without_place(",
        ".with_help(",
        ".with_label(",
        ".with_related(",
        ".with_fix(",
        "Error for ",
    ];
    let is_wording = |path: &Path| {
        folder(path) == "diag" || path.iter().any(|part| matches!(part.to_str(), Some("wording" | "wording.rs")))
    };
    forbid(rule, &builders, is_wording);
}

/// The most lines of Rust in each room. Whoever needs more raises a figure here, and says why in the commit.
const ROOMS: [(&str, usize); 16] = [
    ("crates/base", 7_250),
    ("crates/circuit", 25_450),
    ("crates/cluster", 2_700),
    ("crates/lang", 12_850),
    ("crates/learn", 2_650),
    ("crates/lsp", 5_350),
    ("crates/play", 6_330),
    ("crates/play-server", 1_650),
    ("crates/report", 8_450),
    ("crates/session", 6_050),
    ("crates/sim", 6_900),
    ("crates/store", 4_300),
    ("crates/swarm", 8_100),
    ("crates/web", 650),
    ("src", 9_100),
    ("tests/it", 20_160),
];

#[test]
fn each_room_has_at_most_its_lines() {
    let mut found = Vec::new();
    for (room, most) in ROOMS {
        let (mut open, mut lines) = (vec![root().join(room)], 0);
        while let Some(path) = open.pop() {
            if path.is_dir() && !path.is_symlink() {
                open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                lines += fs::read_to_string(path).unwrap().lines().count();
            }
        }
        if lines > most {
            found.push(format!("{room} has {lines} lines, at most {most}"));
        }
    }
    assert!(found.is_empty(), "a room has at most its lines\n{}", found.join("\n"));
}

#[test]
fn every_module_has_a_description() {
    let silent: Vec<_> = modules().iter().filter(|module| !module.product.starts_with("//!")).collect();
    let silent: Vec<String> = silent.iter().map(|module| module.file()).collect();
    assert!(silent.is_empty(), "every module opens with a line that says what it is: {silent:?}");
}

#[test]
fn every_numbered_citation_of_the_model_exists() {
    let model = fs::read_to_string(root().join("docs/physics.md")).unwrap();
    for Module { path, product, .. } in modules() {
        for part in product.split("docs/physics.md ").skip(1) {
            let section: String = part.chars().take_while(char::is_ascii_digit).collect();
            assert!(model.contains(&format!("\n## {section}. ")), "{} cites section {section}", path.display());
        }
    }
}

#[test]
fn files_do_not_import_each_other_in_circles() {
    let modules = modules();
    let imports = imports();
    let arrows = |circle: &BTreeSet<usize>| {
        let arrow = |&from: &usize| {
            let to = imports[from].intersection(circle).map(|&to| modules[to].file()).collect::<Vec<_>>();
            format!("    {} imports {}", modules[from].file(), to.join(", "))
        };
        circle.iter().map(arrow).collect::<Vec<_>>().join("\n")
    };
    let found: Vec<String> = circles(imports).iter().map(arrows).collect();
    assert!(found.is_empty(), "files do not import each other in circles\n{}", found.join("\n\n"));
}

#[test]
fn a_public_type_name_has_one_meaning() {
    let definition = Regex::new(r"(?m)^\s*pub(?:\([^)]*\))?\s+(?:struct|enum|trait|type)\s+(\w+)").unwrap();
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    // It stands in the place of `vector.rs` on one target.
    for module in modules().iter().filter(|module| !module.path.ends_with("lanes/simd128.rs")) {
        for found in definition.captures_iter(&module.code) {
            places.entry(found[1].to_owned()).or_default().push(module.file());
        }
    }
    let twice: Vec<String> =
        places.iter().filter(|(_, files)| files.len() > 1).map(|(name, files)| format!("{name}: {files:?}")).collect();
    assert!(twice.is_empty(), "a public type name has one meaning in the crate\n{}", twice.join("\n"));
}

#[test]
fn lines_have_at_most_120_columns() {
    let mut open = ["src", "crates", "tests", "docs", "benches", "examples", "README.md", "ARCHITECTURE.md"]
        .map(|name| root().join(name))
        .to_vec();
    let mut wide = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_symlink() {
            continue;
        }
        if path.is_dir() {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
            continue;
        }
        let Some(extension @ ("rs" | "md")) = path.extension().and_then(|extension| extension.to_str()) else {
            continue;
        };
        for (number, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            // Rows of a Markdown table and output in a code block cannot be broken.
            let whole = extension == "md" && (line.starts_with('|') || line.starts_with("    "));
            if line.chars().count() > 120 && !whole {
                wide.push(format!("{}:{}", path.display(), number + 1));
            }
        }
    }
    assert!(wide.is_empty(), "lines of more than 120 columns\n{}", wide.join("\n"));
}

#[test]
fn scripts_of_pages_are_in_web() {
    let mut open = vec![root().join("crates")];
    let mut found = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() && !path.is_symlink() {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if matches!(path.extension().and_then(|name| name.to_str()), Some("css" | "html" | "js" | "ts")) {
            found.push(path);
        }
    }
    assert!(found.is_empty(), "scripts and styles of pages are in web/: {found:?}");
    let reports = root().join("crates/report/page");
    for script in ["evolution.js", "run.js", "sheets.js"] {
        let text = fs::read_to_string(reports.join(script)).unwrap();
        assert!(text.len() < 60_000, "{script} has {} bytes", text.len());
        assert!(!text.contains("localStorage"), "{script} remembers something");
    }
}
