//! Reads Verilog files: first the tree of slang, then its netlist, then Yosys' own.
//!
//! Scripts have fixed names of files in them. A name that a user chose becomes part of a script only if it is a plain
//! word.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::verilog::compare::ModuleComparison;
use crate::verilog::messages::{self, SandboxFiles};
use crate::verilog::netlist::WordNetlist;
use crate::verilog::parameter::ParameterValue;
use crate::verilog::sandbox::{self, SECOND_SECONDS, SECONDS, Sandbox, SandboxRun, is_plain};
use crate::verilog::tree::{DesignTree, IncompleteEvents, Statements};
use crate::verilog::wording;
use nbc_base::source::{
    SecondReading, VerilogError, VerilogFiles, VerilogModule, VerilogModules, VerilogNote, VerilogPlace,
};
use nbc_circuit::CancelFlag;

/// How slang reads, with constructs that other tools accept. Keywords of SystemVerilog are names in a file of Verilog
/// that cannot be read with them (`AS_VERILOG`).
const SLANG: &str = "read_slang --threads 1 --single-unit -I . --allow-use-before-declare --relax-enum-conversions \
    --relax-string-conversions --allow-hierarchical-const --allow-merging-ansi-ports \
    --allow-bare-value-param-assigment --allow-genblk-reference --allow-dup-initial-drivers --ignore-timing \
    --ignore-assertions --diag-json slang.json";
const AS_VERILOG: &str = "--map-keyword-version 1364-2005+**/*.v";

/// What becomes of statements. Of several labels that match, the first counts, whatever attributes say.
const STATEMENTS: &str = "attrmap -remove parallel_case; proc -noopt";

/// How a module becomes gates and registers of one bit. An unknown constant or net is 0, unless only a closed latch
/// reads it.
const GATES: &str = "flatten; chformal -remove; delete t:$print t:$scopeinfo; opt_clean; \
    select -set data t:$dlatch %ci1:+[D] %ci1 t:$mux %i; opt_expr -mux_undef @data; opt_clean; \
    memory_collect; memory_map; setundef -undriven -zero; opt_dff -nodffe -nosdff; opt_expr; opt_clean; \
    wreduce; opt_expr; opt_clean; techmap -map power.v; opt_expr; techmap; opt_expr; opt_clean; \
    dfflegalize -cell $_DFF_P_ 01 -cell $_DFF_N_ 01 -cell $_DLATCH_P_ 01 -cell $_DLATCH_N_ 01 \
    -cell $_DFF_?P0_ r -cell $_DFF_?P1_ r -cell $_DLATCH_?P0_ r -cell $_DLATCH_?P1_ r \
    -cell $_DFFSR_?PP_ 0 -cell $_DLATCHSR_?PP_ 0; simplemap; opt_clean; setattr -unset src; write_blif -attr";

const WORDS: &str = "words.json";

/// Powers as products, which Yosys does not make of them.
const POWERS: &str = include_str!("power.v");

/// The module to read, and its parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TopModule {
    /// Its name, or the one that contains most.
    pub name: Option<String>,
    /// Values in the places of the defaults of its parameters.
    pub parameters: BTreeMap<String, ParameterValue>,
}

pub(crate) enum WantedModules<'a> {
    All,
    Top(&'a TopModule),
}

pub(crate) fn read(
    files: &VerilogFiles,
    wanted: &WantedModules<'_>,
    cancel: &CancelFlag,
) -> Result<VerilogModules, VerilogError> {
    let mut sandbox = Sandbox::new(cancel)?;
    let mut names = SandboxFiles::new();
    let mut sources = String::new();
    for (at, file) in files.files.iter().enumerate() {
        let name = format!("source{at}.{}", sandbox::extension(&file.path));
        sandbox.write(&name, &file.text)?;
        sources.push_str(&format!(" {name}"));
        names.insert(name, Arc::from(file.path.as_str()));
    }
    for (name, file) in &files.others {
        sandbox.write(name, &file.text)?;
        names.insert(name.clone(), Arc::from(file.path.as_str()));
    }
    sandbox.write("power.v", POWERS)?;
    Reading {
        sandbox: &mut sandbox,
        names,
        sources,
        slang: SLANG.to_owned(),
        tops: String::new(),
        parameters: String::new(),
        cancel,
    }
    .modules(wanted)
}

struct Reading<'a> {
    sandbox: &'a mut Sandbox<'a>,
    names: SandboxFiles,
    /// The files of the design, each after a space.
    sources: String,
    slang: String,
    /// Its options for one module, and for the parameters of modules that no other contains.
    tops: String,
    parameters: String,
    cancel: &'a CancelFlag,
}

impl Reading<'_> {
    fn modules(&mut self, wanted: &WantedModules<'_>) -> Result<VerilogModules, VerilogError> {
        if let WantedModules::Top(top) = wanted {
            let is_option = |(name, _): &(&String, &ParameterValue)| is_plain(name);
            self.parameters =
                top.parameters.iter().filter(is_option).map(|(name, value)| format!(" -G {name}={value}")).collect();
        }
        let (tree, mut notes) = match wanted {
            WantedModules::Top(TopModule { name: Some(name), .. }) => self.tree_of(name)?,
            _ => self.tree()?,
        };
        let (mut tops, left_out) = tree.tops();
        // A module may be used in a block only that is never made, as a mark that it has no default parameters.
        if tops.is_empty()
            && !matches!(wanted, WantedModules::Top(TopModule { name: Some(_), .. }))
            && let [only] = &self.modules_beside(&left_out)[..]
        {
            let parameters = match wanted {
                WantedModules::Top(top) => top.parameters.clone(),
                WantedModules::All => BTreeMap::new(),
            };
            return self.modules(&WantedModules::Top(&TopModule { name: Some(only.clone()), parameters }));
        }
        if let WantedModules::Top(top) = wanted {
            match &top.name {
                Some(name) => tops = vec![name.clone()],
                None if tops.len() > 1 && !top.parameters.is_empty() => {
                    return Err(VerilogError::SeveralModules { known: tops });
                }
                None => tops.truncate(1),
            }
            let known = tree.parameters(&tops);
            if let Some(parameter) = top.parameters.keys().find(|name| !known.contains(name)).cloned() {
                return Err(VerilogError::NoParameter { parameter, known });
            }
        }
        if tops.is_empty() {
            return Err(faults(wording::no_modules()));
        }
        if let Some(top) = tops.iter().find(|top| !is_plain(top)) {
            return Err(faults(wording::unusual_name(top)));
        }
        if let Some(empty) = tree.empty(&tops) {
            return Err(faults(wording::empty(&empty, self.declared(&empty))));
        }
        let statements = tree.statements(&tops);
        let mut words = self.netlists(&tops, "")?;
        let stale = |top: &String| -> String {
            let nets = words.stale(top).into_iter().filter(|net| net.split('.').all(is_plain));
            nets.map(|net| format!("delete {top}/w:{net}\n")).collect()
        };
        let stale: Vec<String> = tops.iter().map(stale).collect();
        // slang joins the calls of a function at its arguments, which would join what drives them.
        if stale.iter().any(|commands| !commands.is_empty()) {
            words = self.netlists(&tops, &stale.concat())?;
        }
        let others = left_out.iter().filter(|module| !tops.contains(module));
        notes.extend(others.map(|module| wording::left_out(module, self.declared(module))));
        for top in &tops {
            notes.extend(words.notes(top, &self.names, &statements.latches));
        }
        let (errors, warnings): (Vec<_>, Vec<_>) = notes.into_iter().partition(|note| note.is_error);
        if !errors.is_empty() {
            return Err(VerilogError::Faults(errors));
        }
        let mut notes = warnings;
        let mut modules = Vec::new();
        for (at, name) in tops.iter().enumerate() {
            let blif = self.sandbox.result(&format!("slang{at}.blif"));
            let blif = blif.ok_or_else(|| faults(wording::no_result("")))?;
            let nets = words.places(name, &self.names);
            notes.extend(self.of_statements(&statements, name, &nets));
            let module = VerilogModule {
                name: name.clone(),
                blif: with_ports_in_order(blif, &tree.ports(name)),
                nets,
                ascending: words.ascending(name),
                second: SecondReading::None,
            };
            modules.push(self.compared(module, words.declared(name, &self.names), &mut notes)?);
        }
        let early = statements.early.iter();
        notes.extend(early.map(|net| wording::read_early(net, modules[0].nets.get(net).cloned())));
        if statements.has_assertions {
            notes.push(wording::assertions());
        }
        let unknown = statements.labels.iter().map(|label| wording::unknown_label(label, self.first(label)));
        notes.extend(unknown);
        Ok(VerilogModules { version: words.version(), modules, notes })
    }

    fn tree(&mut self) -> Result<(DesignTree, Vec<VerilogNote>), VerilogError> {
        let tree = |reading: &Self| {
            let Self { slang, tops, parameters, sources, .. } = reading;
            let script = format!("{slang}{tops}{parameters} --ast-compilation-only --dump-ast{sources}");
            reading.slang(&script)
        };
        let first = match tree(self) {
            Err(VerilogError::Faults(faults)) if self.sources.contains(".v") => {
                self.slang = format!("{SLANG} {AS_VERILOG}");
                tree(self).map_err(|_| VerilogError::Faults(faults))
            }
            first => first,
        };
        let notes = first?;
        let tree = DesignTree::of(&self.sandbox.printed()).ok_or_else(|| faults(wording::too_deep()))?;
        Ok((tree, notes))
    }

    /// Runs a script of slang; its warnings.
    fn slang(&self, script: &str) -> Result<Vec<VerilogNote>, VerilogError> {
        self.sandbox.write("slang.json", "[]")?;
        let SandboxRun { is_good, is_late, messages } = self.sandbox.run(script, SECONDS)?;
        let notes = messages::notes(&self.sandbox.result("slang.json").unwrap_or_default(), &self.names);
        match is_good {
            true => Ok(notes),
            false if is_late => Err(faults(wording::too_long())),
            false if notes.iter().any(|note| note.is_error) => Err(VerilogError::Faults(notes)),
            false if messages.contains("No such command: read_slang") => Err(faults(wording::no_slang())),
            false => Err(faults(wording::no_result(&messages))),
        }
    }

    fn tree_of(&mut self, module: &str) -> Result<(DesignTree, Vec<VerilogNote>), VerilogError> {
        let all = (self.slang.clone(), self.tops.clone());
        if is_plain(module) {
            self.tops = format!(" --top {module}");
            match self.tree() {
                Err(VerilogError::Faults(notes)) if notes.iter().all(|note| note.place.is_none()) => {
                    if self.declared(module).is_some() {
                        return Err(faults(wording::no_top(module, self.declared(module))));
                    }
                }
                found => return found,
            }
        }
        (self.slang, self.tops) = all;
        let known = self.tree().map(|(tree, _)| tree.tops().0).unwrap_or_default();
        Err(VerilogError::NoModule { module: module.to_owned(), known })
    }

    fn netlists(&self, tops: &[String], commands: &str) -> Result<WordNetlist, VerilogError> {
        let options: String = tops.iter().map(|top| format!(" --top {top}")).collect();
        let hierarchy = if self.keeps_modules() { " --best-effort-hierarchy" } else { "" };
        let gates = |(at, top): (usize, &String)| {
            format!("design -load read\nhierarchy -top {top}\n{} slang{at}.blif\n", lines(GATES))
        };
        let script = format!(
            "{} --no-proc{hierarchy}{options}{}{}\n{}\n{commands}write_json {WORDS}\ndesign -save read\n{}",
            self.slang,
            self.parameters,
            self.sources,
            lines(STATEMENTS),
            tops.iter().enumerate().map(gates).collect::<String>()
        );
        self.slang(&script)?;
        let words = self.sandbox.result(WORDS).and_then(|words| serde_json::from_str(&words).ok());
        words.ok_or_else(|| faults(wording::no_result("no netlist")))
    }

    /// Whether a module is to stay one, for loops of cells with start values.
    fn keeps_modules(&self) -> bool {
        self.names.keys().filter_map(|name| self.sandbox.result(name)).any(|text| text.contains("keep_hierarchy"))
    }

    fn compared(
        &self,
        module: VerilogModule,
        place: Option<VerilogPlace>,
        notes: &mut Vec<VerilogNote>,
    ) -> Result<VerilogModule, VerilogError> {
        const BLIF: &str = "yosys.blif";
        self.sandbox.write(BLIF, "")?;
        let script = format!(
            "read_verilog -sv -defer{}\nhierarchy -check -top {}{}\n{}\n{} {BLIF}\n",
            self.sources,
            module.name,
            self.parameters.replace("-G ", "-chparam ").replace('=', " "),
            lines(STATEMENTS),
            lines(GATES)
        );
        if !self.sandbox.run(&script, SECOND_SECONDS)?.is_good {
            return Ok(module);
        }
        let other = VerilogModule { blif: self.sandbox.result(BLIF).unwrap_or_default(), ..module.clone() };
        let ModuleComparison { second, difference } = ModuleComparison::of(&module, &other, self.cancel);
        let is_sure = second == SecondReading::Different;
        let note = |difference| wording::read_differently(&module.name, is_sure, difference, place);
        notes.extend(difference.map(note));
        Ok(VerilogModule { second, ..module })
    }

    fn of_statements(
        &self,
        statements: &Statements,
        module: &str,
        nets: &BTreeMap<String, VerilogPlace>,
    ) -> Vec<VerilogNote> {
        let of_module = statements.incomplete.iter().filter(|found| found.module == module);
        let note = |found: &IncompleteEvents| {
            wording::incomplete_events(&found.target, &found.missing, nets.get(&found.target).cloned())
        };
        of_module.map(note).collect()
    }

    /// The modules that the files seem to declare beside these.
    fn modules_beside(&self, others: &[String]) -> Vec<String> {
        let texts = self.sources.split_whitespace().filter_map(|name| self.sandbox.result(name));
        let declared = |text: String| -> Vec<String> {
            let rest = text.lines().filter_map(|line| line.trim_start().strip_prefix("module "));
            rest.filter_map(|rest| Some(words(rest).next()?.to_owned())).collect()
        };
        texts.flat_map(declared).filter(|module| !others.contains(module)).collect()
    }

    fn first(&self, constant: &str) -> Option<VerilogPlace> {
        self.found(|line| line.replace('_', "").to_ascii_lowercase().contains(constant))
    }

    fn declared(&self, module: &str) -> Option<VerilogPlace> {
        self.found(|line| {
            line.trim_start().strip_prefix("module ").is_some_and(|rest| words(rest).next() == Some(module))
        })
    }

    fn found(&self, is_meant: impl Fn(&str) -> bool) -> Option<VerilogPlace> {
        self.names.iter().find_map(|(name, file)| {
            let line = self.sandbox.result(name)?.lines().position(&is_meant)? + 1;
            Some(VerilogPlace { file: file.clone(), line, columns: None })
        })
    }
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// A model whose ports are in the order of their declaration, which slang does not keep.
fn with_ports_in_order(blif: String, declared: &[String]) -> String {
    let place = |bit: &&str| {
        let port = bit.split('[').next().unwrap_or(bit);
        let found = |name: &str| declared.iter().position(|known| known == name);
        found(bit).or_else(|| found(port)).unwrap_or(declared.len())
    };
    let mut heads = 0;
    let line = |line: &str| {
        let (word, ports) = line.split_once(' ').unwrap_or((line, ""));
        if heads == 2 || !matches!(word, ".inputs" | ".outputs") {
            return format!("{line}\n");
        }
        heads += 1;
        let mut ports: Vec<&str> = ports.split_whitespace().collect();
        ports.sort_by_key(place);
        format!("{word} {}\n", ports.join(" "))
    };
    blif.lines().map(line).collect()
}

/// The commands of a script, each in a line.
fn lines(commands: &str) -> String {
    commands.replace("; ", "\n")
}

fn faults(note: VerilogNote) -> VerilogError {
    VerilogError::Faults(vec![note])
}
