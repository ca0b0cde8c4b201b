//! The files that Verilog files may include, or load into memories.

use std::collections::BTreeSet;

use nbc_base::budget::Limit;
use nbc_base::source::{FileError, SourceFile, SourceWorld, VerilogFile, VerilogFiles};

/// Files with all files of a world that they name in quotes, if these are in or below their folders.
pub fn verilog_files(world: &(impl SourceWorld + ?Sized), files: &[&SourceFile]) -> VerilogFiles {
    let mut found = VerilogFiles::default();
    let (mut looked, mut bytes) = (BTreeSet::new(), 0);
    for SourceFile { name: path, text, .. } in files {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let mut waiting = vec![(String::new(), text.clone())];
        while let Some((inside, text)) = waiting.pop() {
            for name in text.split('"').filter(is_path_inside) {
                for used in [joined(&inside, name), name.to_owned()] {
                    let path = joined(folder, &used);
                    let is_new = Limit::VerilogFiles.permit(looked.len() as u64).is_ok()
                        && looked.insert(path.clone())
                        && !found.others.contains_key(&used);
                    let Some(text) = is_new.then(|| read_inside(world, folder, &path).ok()).flatten() else {
                        continue;
                    };
                    bytes += text.len() as u64;
                    if Limit::VerilogBytes.permit(bytes).is_ok() {
                        let parent = used.rsplit_once('/').map_or("", |(parent, _)| parent).to_owned();
                        waiting.push((parent, text.clone()));
                        found.others.insert(used, VerilogFile { path, text });
                    }
                }
            }
        }
        found.files.push(VerilogFile { path: path.clone(), text: text.clone() });
    }
    found
}

fn is_path_inside(name: &&str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || "._-+/".contains(c);
    let is_part = |part: &str| !part.is_empty() && part != "." && part != "..";
    name.len() < 256 && name.contains('.') && name.chars().all(is_letter) && name.split('/').all(is_part)
}

fn joined(folder: &str, name: &str) -> String {
    if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") }
}

/// A link must not lead out of the folder.
fn read_inside(world: &(impl SourceWorld + ?Sized), folder: &str, path: &str) -> Result<String, FileError> {
    let root = world.identity(if folder.is_empty() { "." } else { folder });
    let is_inside = match root.as_str() {
        "." => true,
        root => world.identity(path).strip_prefix(root).is_some_and(|inside| inside.starts_with(['/', '\\'])),
    };
    if is_inside { world.read(path) } else { Err(FileError::NotFound) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::{MemoryWorld, Sources};

    #[test]
    fn what_a_file_names_comes_with_it() {
        let mut world = MemoryWorld::default();
        let main = "`include \"parts/a.vh\"\n$readmemh(\"rom.hex\", m); $display(\"no.txt\"); `include \"../up.vh\"\n";
        for (path, text) in [
            ("in/main.v", main),
            ("in/parts/a.vh", "`include \"b.vh\"\n`include \"c.vh\"\n"),
            ("in/parts/b.vh", "b"),
            ("in/c.vh", "c"),
            ("in/rom.hex", "0"),
            ("up.vh", "secret"),
            ("in/more.vh", "not named"),
        ] {
            world.insert(path, text);
        }
        let mut sources = Sources::default();
        let file = sources.add("in/main.v", main);
        let found = verilog_files(&world, &[sources.file(file)]);
        let others: Vec<&str> = found.others.keys().map(String::as_str).collect();
        assert_eq!(others, ["c.vh", "parts/a.vh", "parts/b.vh", "rom.hex"]);
        assert_eq!(found.others["parts/b.vh"].path, "in/parts/b.vh");
    }

    #[test]
    fn paths_stay_inside() {
        for name in ["a.vh", "parts/a.vh", "x-1.2+y_z.mem"] {
            assert!(is_path_inside(&name), "{name}");
        }
        for name in ["", "a", "/etc/a.b", "../a.b", "a/../b.c", "a b.c", "a;b.c", "a\n.c", "C:\\a.b", "a//b.c"] {
            assert!(!is_path_inside(&name), "{name}");
        }
    }
}
