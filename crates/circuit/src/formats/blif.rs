//! The reader of BLIF, the Berkeley logic interchange format, with its hierarchy.

use std::collections::BTreeMap;

use crate::formats::blif_text::forced_cell;
use crate::formats::draft::{Definition, Draft, DraftRegister, MOST_ERRORS, NetName};
use crate::formats::model_gate::{ModelCover, gate};
use crate::formats::wording::{blif as wording, text};
use crate::formats::{Design, Forcing, RegisterKind};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Function;
use nbc_base::source::{FileId, SourceFile, Span, VerilogModule};

pub use crate::formats::blif_text::write;

pub fn read(text: &str, file: FileId, clock: Option<&str>) -> Result<Design, Vec<Diagnostic>> {
    read_model(text, file, clock, None)
}

/// Reads a model by its name, or the first, and expands the models it instantiates.
pub fn read_model(
    text: &str,
    file: FileId,
    clock: Option<&str>,
    model: Option<&str>,
) -> Result<Design, Vec<Diagnostic>> {
    let mut models = Models { all: Vec::new(), by_name: BTreeMap::new(), errors: Vec::new() };
    models.read(text, file);
    if !models.errors.is_empty() {
        return Err(models.errors);
    }
    if models.all.is_empty() {
        return Err(vec![wording::no_model(Span::new(file, 0, 0))]);
    }
    let top = match model {
        None => 0,
        Some(name) => {
            *models.by_name.get(name).ok_or_else(|| vec![wording::missing_model(name, Span::new(file, 0, 0))])?
        }
    };
    let mut extents = vec![None; models.all.len()];
    models.extent(top, 0, &mut extents).map_err(|error| vec![error])?;
    let mut draft = Draft::titled(models.all[top].name);
    let mut flat = Flat { models: &models, draft: &mut draft, clock, path: Vec::new() };
    flat.instantiate(top, &Instance::default());
    draft.finish()
}

pub fn verilog_module(
    module: &VerilogModule,
    files: &[&SourceFile],
    clock: Option<&str>,
) -> Result<Design, Vec<Diagnostic>> {
    let design = verilog_design(module, files[0].id, clock);
    design.map_err(|faults| faults.into_iter().map(|fault| fault.moved_to_verilog(files, module)).collect())
}

/// The same with the errors at places of the translation, which is the text of `file`.
pub fn verilog_design(module: &VerilogModule, file: FileId, clock: Option<&str>) -> Result<Design, Vec<Diagnostic>> {
    let design = read_model(&module.blif, file, clock, Some(&module.name))?;
    Ok(Design { ascending: module.ascending.clone(), ..design })
}

/// Warnings about external don't-cares, which are not read: they permit more than the circuit does.
pub fn ignored(text: &str, file: FileId) -> Vec<Diagnostic> {
    let found = lines(text, file).filter(|words| words[0].0 == DONT_CARES);
    found.map(|words| wording::ignored_dont_cares(words[0].1)).collect()
}

/// The directive after which a network says where the outputs may be anything, up to the end of the model.
const DONT_CARES: &str = ".exdc";

type Words<'t> = Vec<(&'t str, Span)>;

enum Statement<'t> {
    Names { signals: Words<'t>, cubes: Vec<Vec<u8>>, value: bool, start: Option<bool> },
    Latch(Words<'t>),
    Subcircuit { words: Words<'t>, start: Option<bool> },
}

impl Statement<'_> {
    fn size(&self) -> usize {
        const NET: usize = 100;
        match self {
            Self::Names { signals, cubes, .. } => NET * signals.len() + cubes.iter().map(Vec::len).sum::<usize>(),
            Self::Latch(words) | Self::Subcircuit { words, .. } => NET * words.len(),
        }
    }
}

struct Model<'t> {
    name: &'t str,
    inputs: Words<'t>,
    outputs: Words<'t>,
    clocks: Words<'t>,
    statements: Vec<(Statement<'t>, Span)>,
}

impl Model<'_> {
    fn gate(&self) -> Option<Function> {
        let [(output, _)] = self.outputs[..] else { return None };
        let covers = self.statements.iter().map(|(statement, _)| match statement {
            Statement::Names { signals, cubes, value, .. } => {
                let (&(output, _), pins) = signals.split_last()?;
                Some(ModelCover { pins: pins.iter().map(|&(pin, _)| pin).collect(), output, cubes, value: *value })
            }
            Statement::Latch(_) | Statement::Subcircuit { .. } => None,
        });
        let inputs: Vec<&str> = self.inputs.iter().map(|&(input, _)| input).collect();
        let is_small = matches!(inputs.len(), 1 | 2) && self.statements.len() <= MOST_GATE_STATEMENTS;
        if !is_small || inputs.contains(&output) {
            return None;
        }
        gate(&inputs, output, covers.collect::<Option<_>>()?)
    }
}

const MOST_GATE_STATEMENTS: usize = 16;

struct Models<'t> {
    all: Vec<Model<'t>>,
    by_name: BTreeMap<&'t str, usize>,
    errors: Vec<Diagnostic>,
}

const IGNORED: &str = "\
    .area .cname .default_input_arrival .default_input_drive .default_max_input_load .default_output_load \
    .default_output_required .delay .input_arrival .input_drive .input_required .max_input_load .output_load \
    .output_required .param .wire_load_slope .wire .wire_arrival";

fn is_long(name: &str) -> bool {
    Limit::FileNameBytes.permit(name.len() as u64).is_err()
}

#[derive(Clone, Copy, Debug, Default)]
struct Extent {
    depth: usize,
    statements: usize,
    bytes: usize,
}

impl<'t> Models<'t> {
    fn extent(&self, model: usize, depth: usize, known: &mut [Option<Extent>]) -> Result<Extent, Diagnostic> {
        // A model that contains itself is reported at the place of the instance.
        known[model] = Some(Extent::default());
        let mut extent = Extent::default();
        for (statement, span) in &self.all[model].statements {
            extent.statements = extent.statements.saturating_add(1);
            extent.bytes = extent.bytes.saturating_add(statement.size());
            let Statement::Subcircuit { words, .. } = statement else { continue };
            let Some(&inner) = self.by_name.get(words[0].0) else { continue };
            let nested = match known[inner] {
                Some(nested) => nested,
                None if Limit::Hierarchy.permit(depth as u64 + 1).is_ok() => self.extent(inner, depth + 1, known)?,
                None => Extent { depth: Limit::Hierarchy.most() as usize, ..Extent::default() },
            };
            // The name of an instance comes before those of its nets.
            let names = nested.statements.saturating_mul(words[0].0.len() + 10);
            extent.depth = extent.depth.max(nested.depth + 1);
            extent.statements = extent.statements.saturating_add(nested.statements);
            extent.bytes = extent.bytes.saturating_add(nested.bytes).saturating_add(names);
            if Limit::Hierarchy.permit(extent.depth as u64).is_err() {
                return Err(wording::model_depth(*span));
            }
            if Limit::ModelBytes.permit(extent.bytes as u64).is_err() {
                return Err(wording::model_size(*span));
            }
        }
        known[model] = Some(extent);
        Ok(extent)
    }

    fn fault(&mut self, error: Diagnostic) {
        if self.errors.len() < MOST_ERRORS {
            self.errors.push(error);
        }
    }

    fn read(&mut self, text: &'t str, file: FileId) {
        let mut is_outside = false;
        for words in lines(text, file) {
            let (first, _) = words[0];
            is_outside = first == DONT_CARES || is_outside && !matches!(first, ".end" | ".model");
            if is_outside {
                continue;
            }
            let row = !first.starts_with('.');
            if let Some(&(_, span)) = words.iter().find(|(word, _)| !row && is_long(word)) {
                return self.fault(text::long_name((span.end - span.start) as usize, span));
            }
            if first.starts_with('.') {
                self.directive(words);
            } else {
                self.cube(&words);
            }
        }
    }

    fn directive(&mut self, words: Words<'t>) {
        let (first, span) = words[0];
        let rest = words[1..].to_vec();
        if first == ".model" {
            let name = rest.first().map_or("", |&(name, _)| name);
            if self.by_name.insert(name, self.all.len()).is_some() {
                self.fault(wording::model_twice(name, span));
            }
            let model = Model { name, inputs: vec![], outputs: vec![], clocks: vec![], statements: vec![] };
            self.all.push(model);
            return;
        }
        if first == ".end" || IGNORED.split(' ').any(|word| word == first) {
            return;
        }
        let Some(model) = self.all.last_mut() else {
            return self.fault(wording::before_model(first, span));
        };
        match first {
            ".inputs" => model.inputs.extend(rest),
            ".outputs" => model.outputs.extend(rest),
            ".clock" => model.clocks.extend(rest),
            ".names" if rest.is_empty() => self.fault(wording::incomplete(first, "expected the name of a net", span)),
            ".names" => {
                let names = Statement::Names { signals: rest, cubes: Vec::new(), value: true, start: None };
                model.statements.push((names, span));
            }
            ".attr" => self.attribute(&rest),
            ".latch" if rest.len() < 2 => {
                self.fault(wording::incomplete(first, "expected an input and an output", span))
            }
            ".latch" => model.statements.push((Statement::Latch(rest), span)),
            ".subckt" if rest.is_empty() => {
                self.fault(wording::incomplete(first, "expected the name of a model", span))
            }
            ".subckt" => {
                let instance = Statement::Subcircuit { words: rest, start: None };
                model.statements.push((instance, span));
            }
            ".gate" | ".mlatch" => self.fault(wording::library_cell(first, span)),
            _ => self.fault(wording::unknown_directive(first, span)),
        }
    }

    /// Only the start value of a net on a feedback loop matters.
    fn attribute(&mut self, words: &Words<'t>) {
        let &[("init", _), (value, span)] = &words[..] else { return };
        let statement = self.all.last_mut().and_then(|model| model.statements.last_mut());
        let Some((Statement::Names { start, .. } | Statement::Subcircuit { start, .. }, _)) = statement else { return };
        match value {
            "0" | "1" => *start = Some(value == "1"),
            _ => self.fault(wording::net_start(value, span)),
        }
    }

    fn cube(&mut self, words: &Words<'t>) {
        let span = words[0].1.to(words[words.len() - 1].1);
        let Some((Statement::Names { signals, cubes, value, .. }, _)) =
            self.all.last_mut().and_then(|model| model.statements.last_mut())
        else {
            return self.fault(wording::not_a_directive(words[0].0, span));
        };
        let wanted = signals.len() - 1;
        let (inputs, output) = match words[..] {
            [(output, _)] if wanted == 0 => ("", output),
            [(inputs, _), (output, _)] => (inputs, output),
            _ => return self.fault(wording::malformed_row(span)),
        };
        if inputs.len() != wanted || !inputs.bytes().all(|digit| b"01-".contains(&digit)) {
            return self.fault(wording::row_width(wanted, inputs, span));
        }
        let is = match output {
            "1" => true,
            "0" => false,
            _ => return self.fault(wording::row_output(output, span)),
        };
        if !cubes.is_empty() && *value != is {
            return self.fault(wording::mixed_rows(span));
        }
        *value = is;
        cubes.push(inputs.bytes().collect());
    }
}

fn lines(text: &str, file: FileId) -> impl Iterator<Item = Words<'_>> {
    let mut rest = text.split_inclusive('\n').scan(0, |start, line| {
        *start += line.len();
        Some((*start - line.len(), line))
    });
    std::iter::from_fn(move || {
        let mut words: Words<'_> = Vec::new();
        for (start, line) in rest.by_ref() {
            let line = line.split('#').next().unwrap_or("").trim_end();
            let (line, continued) = line.strip_suffix('\\').map_or((line, false), |line| (line, true));
            words.extend(line.split_whitespace().map(|word| {
                let at = start + (word.as_ptr() as usize - line.as_ptr() as usize);
                (word, Span::new(file, at, at + word.len()))
            }));
            if !continued && !words.is_empty() {
                return Some(words);
            }
        }
        (!words.is_empty()).then_some(words)
    })
}

#[derive(Default)]
struct Instance<'t> {
    prefix: String,
    ports: BTreeMap<&'t str, String>,
}

struct Flat<'m, 't> {
    models: &'m Models<'t>,
    draft: &'m mut Draft,
    clock: Option<&'m str>,
    path: Vec<usize>,
}

impl<'m, 't> Flat<'m, 't> {
    fn instantiate(&mut self, model: usize, inside: &Instance<'t>) {
        self.path.push(model);
        let models = self.models;
        let model = &models.all[model];
        if self.path.len() == 1 {
            self.draft.inputs = model.inputs.iter().map(|&(name, span)| (self.draft.name(name), span)).collect();
            self.draft.outputs = model.outputs.iter().map(|&(name, span)| (self.draft.name(name), span)).collect();
        }
        for (statement, span) in &model.statements {
            match statement {
                Statement::Names { signals, cubes, value, start } => {
                    let output = self.names(signals, cubes, *value, inside);
                    start.iter().for_each(|&start| self.draft.start(output, start));
                }
                Statement::Latch(words) => self.latch(model, words, *span, inside),
                Statement::Subcircuit { words, start } => self.subcircuit(words, *start, inside),
            }
        }
        self.path.pop();
    }

    fn net(&mut self, name: &str, inside: &Instance<'t>) -> u32 {
        match inside.ports.get(name) {
            Some(outside) => self.draft.name(outside),
            None if inside.prefix.is_empty() => self.draft.name(name),
            None => self.draft.name(&format!("{}{name}", inside.prefix)),
        }
    }

    fn names(&mut self, signals: &Words<'t>, cubes: &[Vec<u8>], value: bool, inside: &Instance<'t>) -> u32 {
        let mut nets: Vec<_> = signals.iter().map(|(name, _)| self.net(name, inside)).collect();
        let output = nets.pop().expect("`.names` has an output");
        let span = signals[0].1.to(signals[signals.len() - 1].1);
        self.draft.define(output, Definition::Cover { pins: nets, cubes: cubes.to_vec(), value }, span);
        output
    }

    fn latch(&mut self, model: &Model<'t>, words: &Words<'t>, span: Span, inside: &Instance<'t>) {
        let (next, output) = (self.net(words[0].0, inside), self.net(words[1].0, inside));
        let start = match words.last().filter(|_| words.len() % 2 == 1) {
            None | Some(("2" | "3", _)) => None,
            Some(("0", _)) => Some(false),
            Some(("1", _)) => Some(true),
            Some(&(word, span)) => {
                return self.draft.fault(wording::latch_start(word, span));
            }
        };
        let (kind, clock) = match (words.get(2), words.get(3)) {
            (Some(&(kind, span)), Some((clock, _))) => {
                let kind = match kind {
                    "re" => RegisterKind::Rising,
                    "fe" => RegisterKind::Falling,
                    "ah" => RegisterKind::High,
                    "al" => RegisterKind::Low,
                    _ => return self.draft.fault(wording::latch_kind(kind, span)),
                };
                let number = self.net(clock, inside);
                (kind, (*clock != "NIL").then_some(number))
            }
            _ => (RegisterKind::Rising, None),
        };
        let one_clock = match model.clocks[..] {
            [(clock, _)] => Some(clock),
            _ => None,
        };
        let clock = clock.or_else(|| one_clock.or(self.clock).map(|clock| self.draft.name(clock)));
        let clock = clock.unwrap_or_else(|| {
            let name = self.draft.text(output).to_owned();
            self.draft.fault(wording::no_clock(&name, words[0].0, span));
            output
        });
        let (forcing, nets) = (Forcing::Never, Vec::new());
        self.draft.registers.push(DraftRegister { kind, forcing, start, output, next, clock, nets, span });
    }

    fn forced(&mut self, cell: &str, pins: &BTreeMap<&str, String>, start: Option<bool>, span: Span) -> bool {
        let Some(form) = forced_cell(cell) else { return false };
        let mut net = |port: &str| pins.get(port).map(|net| self.draft.name(net));
        let nets = (net("D"), net("Q"), form.ports.iter().map(|port| net(port)).collect::<Option<Vec<_>>>());
        let (Some(next), Some(output), Some(nets)) = nets else { return false };
        let Some(clock) = net(form.clock) else { return false };
        let (kind, forcing, start) = (form.kind, form.forcing, form.start.or(start));
        self.draft.registers.push(DraftRegister { kind, forcing, start, output, next, clock, nets, span });
        true
    }

    fn subcircuit(&mut self, words: &Words<'t>, start: Option<bool>, inside: &Instance<'t>) {
        let (name, span) = words[0];
        let Some(&model) = self.models.by_name.get(name) else {
            let parts = words[1..].iter().filter_map(|(word, _)| word.split_once('='));
            let pins = parts.map(|(port, net)| {
                let number = self.net(net, inside);
                (port, self.draft.text(number).to_owned())
            });
            let pins = pins.collect();
            if !self.forced(name, &pins, start, span) {
                self.draft.fault(wording::missing_model(name, span));
            }
            return;
        };
        if self.path.contains(&model) {
            return self.draft.fault(wording::recursive_model(name, span));
        }
        let prefix = format!("{}{name}@{}.", inside.prefix, span.start);
        let mut inner = Instance { prefix, ports: BTreeMap::new() };
        for &(word, at) in &words[1..] {
            let Some((formal, actual)) = word.split_once('=') else {
                return self.draft.fault(wording::not_a_connection(word, at));
            };
            let known = &self.models.all[model];
            let ports_of_model = known.inputs.iter().chain(&known.outputs).chain(&known.clocks);
            if !ports_of_model.map(|&(name, _)| name).any(|name| name == formal) {
                return self.draft.fault(wording::unknown_port(name, formal, at));
            }
            let number = self.net(actual, inside);
            if inner.ports.insert(formal, self.draft.text(number).to_owned()).is_some() {
                return self.draft.fault(wording::connected_twice(formal, at));
            }
        }
        let open = self.models.all[model].inputs.iter().find(|(port, _)| !inner.ports.contains_key(port));
        if let Some((port, _)) = open {
            return self.draft.fault(wording::unconnected(name, port, span));
        }
        match self.cell(model, &inner.ports, span) {
            Some(output) => start.iter().for_each(|&start| self.draft.start(output, start)),
            None => self.instantiate(model, &inner),
        }
    }

    /// One cell for an instance that computes a function of one or two inputs, however many gates its model has.
    fn cell(&mut self, model: usize, ports: &BTreeMap<&'t str, String>, span: Span) -> Option<NetName> {
        let model = &self.models.all[model];
        let function = model.gate()?;
        let (output, _) = model.outputs[0];
        let output = self.draft.name(ports.get(output)?);
        let pins: Vec<_> = model.inputs.iter().map(|(input, _)| self.draft.name(&ports[input])).collect();
        let digit = |value: bool| if value { b'1' } else { b'0' };
        let rows = (0..1 << pins.len()).map(|row| [row >> (pins.len() - 1) & 1 == 1, row & 1 == 1]);
        let on = rows.filter(|&[a, b]| function.output(a, b));
        let cubes = on.map(|row| row[..pins.len()].iter().map(|&value| digit(value)).collect()).collect();
        self.draft.define(output, Definition::Cover { pins, cubes, value: true }, span);
        Some(output)
    }
}
