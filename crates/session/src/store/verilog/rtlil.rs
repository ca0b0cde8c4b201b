//! What Yosys writes beside the gates: its own text of modules (RTLIL), and its list of wires without drivers.

use std::collections::{BTreeMap, BTreeSet};

use nbc_base::source::{VERILOG_SOURCE, verilog_line};

/// The lines of what a text of Yosys (RTLIL) has.
#[derive(Debug, Default)]
pub(super) struct RtlilLines {
    /// The nets of some modules, by module and name.
    pub(super) nets: BTreeMap<(String, String), usize>,
    /// Those whose leftmost bit has the lowest number.
    pub(super) ascending: BTreeSet<(String, String)>,
    /// The cells of each kind.
    pub(super) cells: BTreeMap<String, BTreeSet<usize>>,
}

impl RtlilLines {
    /// The lines of the nets of these modules, and of all cells.
    pub(super) fn of(rtlil: &str, modules: &[String]) -> Self {
        let mut lines = Self::default();
        let (mut module, mut source) = ("", None);
        for line in rtlil.lines().map(str::trim_start) {
            if let Some(place) = line.strip_prefix("attribute \\src \"") {
                source = place.strip_prefix(VERILOG_SOURCE).and_then(verilog_line);
            } else if let Some(name) = line.strip_prefix("module \\") {
                (module, source) = (name, None);
            } else if let Some(wire) = line.strip_prefix("wire ") {
                let parts = wire.rsplit_once(" \\").map(|(about, name)| (about, Some(name)));
                let (about, name) = parts.unwrap_or_else(|| ("", wire.strip_prefix('\\')));
                if let Some(name) = name.filter(|_| about.split(' ').any(|word| word == "upto"))
                    && modules.iter().any(|known| known == module)
                {
                    lines.ascending.insert((module.to_owned(), name.to_owned()));
                }
                if let (Some(name), Some(line)) = (name, source.take())
                    && modules.iter().any(|known| known == module)
                {
                    lines.nets.insert((module.to_owned(), name.to_owned()), line);
                }
            } else if let Some(kind) = line.strip_prefix("cell ").and_then(|cell| cell.split(' ').next())
                && let Some(line) = source.take()
            {
                lines.cells.entry(kind.to_owned()).or_default().insert(line);
            }
        }
        lines
    }
}

/// The modules and names of the wires without drivers, each once, in the words of Yosys.
pub(super) fn undriven(said: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for line in said.lines() {
        let wire =
            line.strip_prefix("Warning: Wire ").and_then(|line| line.strip_suffix(" is used but has no driver."));
        let Some((module, net)) = wire.and_then(|wire| wire.split_once(".\\")) else { continue };
        let name = (module.trim_start_matches('\\').to_owned(), net.split(' ').next().unwrap_or(net).to_owned());
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// The modules that no other module contains, in a text of Yosys (RTLIL). A module without outputs does not count.
pub(super) fn tops(rtlil: &str) -> Vec<String> {
    let mut tops: Vec<&str> = Vec::new();
    let mut inside: BTreeSet<&str> = BTreeSet::new();
    for module in rtlil.split("\nmodule \\").skip(1) {
        let lines = || module.lines().map(str::trim_start);
        if lines().any(|line| line.starts_with("wire ") && line.contains(" output ")) {
            tops.extend(module.lines().next());
            inside.extend(lines().filter_map(|line| line.strip_prefix("cell \\")?.split(' ').next()));
        }
    }
    tops.into_iter().filter(|module| !inside.contains(module)).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nets_and_cells_have_the_lines_of_the_text() {
        let rtlil = "module \\m\n  attribute \\src \"source.v:3.8-3.9\"\n  wire width 2 input 1 \\a\n  wire \\b\n\
                     attribute \\src \"source.v:5.1-5.2\"\n  cell $pow $1\nend\n";
        let RtlilLines { nets, cells, .. } = RtlilLines::of(rtlil, &["m".to_owned()]);
        assert_eq!(nets.into_iter().collect::<Vec<_>>(), [(("m".to_owned(), "a".to_owned()), 3)]);
        assert_eq!(cells.into_iter().collect::<Vec<_>>(), [("$pow".to_owned(), BTreeSet::from([5]))]);
    }

    #[test]
    fn ranges_that_count_upwards_are_known() {
        let rtlil = "module \\m\n  wire width 4 upto input 1 \\a\n  wire width 4 upto offset -1 \\s\n  \
                     wire width 4 \\b\nend\nmodule \\n\n  wire width 4 upto \\c\nend\n";
        let names = ["a", "s"].map(|name| ("m".to_owned(), name.to_owned()));
        assert_eq!(RtlilLines::of(rtlil, &["m".to_owned()]).ascending, BTreeSet::from(names));
    }

    #[test]
    fn wires_without_drivers_are_named_once() {
        let said = "Warning: Wire m.\\w [2] is used but has no driver.\nWarning: Wire m.\\w [1] is used but has no \
                    driver.\nWarning: Wire m.$x is used but has no driver.\nFound and reported 3 problems.\n";
        assert_eq!(undriven(said), [("m".to_owned(), "w".to_owned())]);
    }

    #[test]
    fn modules_inside_others_are_not_offered() {
        let module = |name: &str, wire: &str, cell: &str| {
            format!("module \\{name}\n  wire {wire} \\q\n  cell {cell}\n  end\nend\n")
        };
        let modules = [
            module("add", "output 1", "$and $1"),
            module("alu", "width 4 output 3", "\\add \\u"),
            module("bench", "width 4", "\\b \\u"),
            module("b", "output 1", "$or $2"),
        ];
        assert_eq!(tops(&format!("autoidx 3\n{}", modules.concat())), ["alu", "b"]);
    }
}
