//! The modules of a text that Yosys is to read. One without outputs, such as a test bench, is no circuit: it is left
//! out, unless a module that is read needs it.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::verilog::parameter::ParameterValue;
use crate::verilog::token::{VerilogToken, VerilogTokenKind};
use nbc_base::source::{VerilogError, VerilogName, VerilogPlace};

/// A module of a text.
#[derive(Debug)]
struct ListedModule {
    name: String,
    place: VerilogPlace,
    /// Its text, from the keyword to the end.
    text: Range<usize>,
    has_outputs: bool,
    /// The places of its parameters' defaults.
    parameters: BTreeMap<String, Range<usize>>,
    /// Its words, among them the modules that it contains.
    words: BTreeSet<String>,
    /// Why it cannot be read, if it is.
    fault: Option<VerilogError>,
}

/// The modules of a text, while its tokens are written.
#[derive(Debug, Default)]
pub(super) struct ModuleList {
    modules: Vec<ListedModule>,
    /// Whether the last module has not ended.
    is_open: bool,
    /// Tasks and functions of it that are open.
    tasks: usize,
    /// Whether names in front of `=` are parameters.
    is_parameter: bool,
    /// The word before.
    last: String,
    /// The parameter whose default has not ended, and the brackets that are open in it.
    default: Option<(String, usize)>,
    /// The nets of the left side of an assignment, if one is open, and the brackets that are open in it.
    targets: Option<(Vec<(String, VerilogPlace)>, usize)>,
    /// The places of assignments to nets, by module and name.
    assigned: BTreeMap<(String, String), Vec<VerilogPlace>>,
}

impl ModuleList {
    /// Takes the next token, which begins and ends at these bytes of the text.
    pub(super) fn see(
        &mut self,
        token: &VerilogToken,
        bytes: Range<usize>,
        place: impl Fn(&VerilogToken) -> VerilogPlace,
    ) {
        let word = token.text.as_str();
        if token.kind == VerilogTokenKind::Word && !self.is_open && matches!(word, "module" | "macromodule") {
            self.is_open = true;
            (self.tasks, self.is_parameter, self.default, self.targets) = (0, false, None, None);
            self.modules.push(ListedModule {
                name: String::new(),
                place: place(token),
                text: bytes,
                has_outputs: false,
                parameters: BTreeMap::new(),
                words: BTreeSet::new(),
                fault: None,
            });
            return;
        }
        let Some(module) = self.modules.last_mut().filter(|_| self.is_open) else { return };
        module.text.end = bytes.end;
        let sign = if token.kind == VerilogTokenKind::Sign { word } else { "" };
        if let Some((parameter, depth)) = &mut self.default {
            match sign {
                "(" | "[" | "{" => *depth += 1,
                ")" | "," | ";" if *depth == 0 => {
                    module.parameters.entry(std::mem::take(parameter)).and_modify(|text| text.end = bytes.start);
                    self.default = None;
                }
                ")" | "]" | "}" => *depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        if let Some((targets, depth)) = &mut self.targets {
            match sign {
                "[" => *depth += 1,
                "]" => *depth = depth.saturating_sub(1),
                "=" => {
                    for (name, place) in self.targets.take().into_iter().flat_map(|(targets, _)| targets) {
                        self.assigned.entry((module.name.clone(), name)).or_default().push(place);
                    }
                }
                _ if *depth == 0 && matches!(token.kind, VerilogTokenKind::Word | VerilogTokenKind::Escaped) => {
                    targets.push((word.trim_start_matches('\\').to_owned(), place(token)));
                }
                _ => {}
            }
        }
        match token.kind {
            VerilogTokenKind::Word => match word {
                "endmodule" => self.is_open = false,
                "task" | "function" => self.tasks += 1,
                "endtask" | "endfunction" => self.tasks = self.tasks.saturating_sub(1),
                "output" => module.has_outputs |= self.tasks == 0,
                "assign" => self.targets = Some((Vec::new(), 0)),
                _ => {}
            },
            VerilogTokenKind::Sign if word == "=" && self.is_parameter && self.default.is_none() => {
                module.parameters.insert(self.last.clone(), bytes.end..bytes.end);
                self.default = Some((self.last.clone(), 0));
            }
            VerilogTokenKind::Sign if word == ";" => self.is_parameter = false,
            VerilogTokenKind::Sign if word == "#" && module.words.is_empty() => self.is_parameter = true,
            _ => {}
        }
        if matches!(token.kind, VerilogTokenKind::Word | VerilogTokenKind::Escaped) {
            let name = word.trim_start_matches('\\');
            if module.name.is_empty() && !matches!(name, "automatic" | "static") {
                module.name = name.to_owned();
            } else {
                module.words.insert(name.to_owned());
            }
            self.is_parameter = match word {
                "parameter" => true,
                "localparam" | "input" | "output" | "inout" => false,
                _ => self.is_parameter,
            };
            self.last = name.to_owned();
        }
    }

    /// Notes a fault of the module that is open. Returns it if there is none.
    pub(super) fn fault(&mut self, fault: VerilogError) -> Result<(), VerilogError> {
        match self.modules.last_mut().filter(|_| self.is_open) {
            Some(module) => {
                module.fault.get_or_insert(fault);
                Ok(())
            }
            None => Err(fault),
        }
    }

    /// Blanks the modules that are left out, and returns their names.
    ///
    /// # Errors
    /// The fault of a module that is read, or a wanted module that is not there.
    pub(super) fn leave_out(self, top: Option<&str>, text: &mut String) -> Result<Vec<VerilogName>, VerilogError> {
        if let Some(top) = top
            && !self.modules.iter().any(|module| module.name == top)
        {
            let known = self.modules.into_iter().map(|module| module.name).collect();
            return Err(VerilogError::NoModule { module: top.to_owned(), known });
        }
        let is_read = self.read(top);
        let mut left_out = Vec::new();
        for (module, is_read) in self.modules.into_iter().zip(is_read) {
            if is_read {
                module.fault.map_or(Ok(()), Err)?;
            } else {
                blank(text, module.text);
                left_out.push(VerilogName { name: module.name, place: Some(module.place) });
            }
        }
        Ok(left_out)
    }

    /// The modules with outputs that no other of them names.
    pub(super) fn tops(&self) -> Vec<String> {
        let with_outputs = || self.modules.iter().filter(|module| module.has_outputs);
        let is_inside = |name: &String| with_outputs().any(|module| module.words.contains(name));
        with_outputs().filter(|module| !is_inside(&module.name)).map(|module| module.name.clone()).collect()
    }

    /// The parameters of a module.
    pub(super) fn parameters(&self, module: &str) -> Vec<String> {
        let found = self.modules.iter().find(|known| known.name == module);
        found.map_or_else(Vec::new, |module| module.parameters.keys().cloned().collect())
    }

    /// Values in the places of the defaults of a module's parameters.
    ///
    /// # Errors
    /// When it has no such parameter.
    pub(super) fn values(
        &self,
        module: &str,
        values: &BTreeMap<String, ParameterValue>,
    ) -> Result<Vec<(Range<usize>, String)>, VerilogError> {
        // A module that is missing is another fault.
        let Some(found) = self.modules.iter().find(|known| known.name == module) else { return Ok(Vec::new()) };
        let unknown = |parameter: &String| VerilogError::NoParameter {
            parameter: parameter.clone(),
            known: self.parameters(module),
        };
        let place = |parameter: &String| found.parameters.get(parameter).cloned().ok_or_else(|| unknown(parameter));
        values.iter().map(|(parameter, value)| Ok((place(parameter)?, value.to_string()))).collect()
    }

    /// The places of assignments to nets, by module and name.
    pub(super) fn take_assigned(&mut self) -> BTreeMap<(String, String), Vec<VerilogPlace>> {
        std::mem::take(&mut self.assigned)
    }

    /// Whether each module is read: it has outputs, is wanted, or such a module names it. If there is none with
    /// outputs, all are.
    fn read(&self, top: Option<&str>) -> Vec<bool> {
        if !self.modules.iter().any(|module| module.has_outputs) {
            return vec![true; self.modules.len()];
        }
        let mut is_read: Vec<bool> =
            self.modules.iter().map(|module| module.has_outputs || Some(module.name.as_str()) == top).collect();
        loop {
            let is_named = |name: &String| {
                self.modules.iter().zip(&is_read).any(|(module, is_read)| *is_read && module.words.contains(name))
            };
            let found = (0..is_read.len()).find(|&at| !is_read[at] && is_named(&self.modules[at].name));
            match found {
                Some(at) => is_read[at] = true,
                None => return is_read,
            }
        }
    }
}

/// Replaces a module, and the attributes before it, by spaces. Lines stay where they are.
fn blank(text: &mut String, module: Range<usize>) {
    let mut start = module.start;
    while text[..start].trim_end().ends_with("*)")
        && let Some(open) = text[..start].rfind("(*")
    {
        start = open;
    }
    let spaces: String = text[start..module.end].chars().map(|c| if c == '\n' { c } else { ' ' }).collect();
    text.replace_range(start..module.end, &spaces);
}
