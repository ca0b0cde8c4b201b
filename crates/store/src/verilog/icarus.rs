//! A translated module beside its source: both make the same random steps, the source in Icarus Verilog. So an error of
//! Yosys shows, which a proof that begins with its netlist cannot see.
//!
//! A bit that is `x` or `z` in the source is open, so any value of the translation is right. Registers that the source
//! leaves open at the start begin with the start values of the translation.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::disk;
use crate::verilog::open_values::OpenValues;
use crate::verilog::process::{self, Limits};
use nbc_base::budget::Limit;
use nbc_base::diag::io_words;
use nbc_base::source::{FileId, Simulated, VerilogDifference, VerilogError, VerilogModules};
use nbc_circuit::formats::buses::{Bus, buses};
use nbc_circuit::formats::{Design, verilog_design};
use nbc_circuit::{CancelFlag, RandomRun, RunStep};

/// The names in the folder: the source as it was written, which need not be what Yosys has read, and the bench.
const WRITTEN: &str = "written.v";
const BENCH: &str = "bench.v";
const PROGRAM: &str = "bench.vvp";
const STEPS: &str = "steps.txt";
const VALUES: &str = "values.txt";
const DUMP: &str = "values.vcd";

/// The most and the fewest steps, and the gates that are evaluated in all of them, roughly.
const MOST_STEPS: usize = 4_096;
const FEWEST_STEPS: usize = 256;
const MOST_GATES: usize = 50_000_000;

/// The time of a step: more than the delays that a source may have.
const STEP: u64 = 900_000;

/// How often registers that cannot be set are left out.
const ROUNDS: usize = 3;

/// Seconds for the simulator to read, and to run.
const READING: Limits = Limits { seconds: 20, megabytes: 2048 };
const RUNNING: Limits = Limits { seconds: 5, megabytes: 2048 };

/// The modules, simulated beside their source. The folder is that in which Yosys made them.
///
/// # Errors
/// The first difference of a module, or that nobody waits any more.
pub(super) fn simulated(
    folder: &Path,
    source: &str,
    mut modules: VerilogModules,
    cancel: &CancelFlag,
) -> Result<VerilogModules, VerilogError> {
    write(folder, WRITTEN, source)?;
    for module in modules.tops.clone() {
        let found = match verilog_design(&modules, &module, FileId(0), None) {
            Ok(design) => Icarus::new(folder, &module, &design, cancel).compare(&modules)?,
            // The error is told where the module is read.
            Err(_) => Simulated::NotComparable,
        };
        modules.simulated.insert(module, found);
    }
    Ok(modules)
}

/// The simulation of a module.
struct Icarus<'a> {
    folder: &'a Path,
    module: &'a str,
    design: &'a Design,
    cancel: &'a CancelFlag,
    inputs: Vec<Bus>,
    outputs: Vec<Bus>,
}

impl<'a> Icarus<'a> {
    fn new(folder: &'a Path, module: &'a str, design: &'a Design, cancel: &'a CancelFlag) -> Self {
        let logic = &design.logic;
        let ports = |ids: &[nbc_circuit::NetId]| {
            let names: Vec<String> = ids.iter().map(|&id| logic.net_name(id)).collect();
            buses(&names, &design.ascending)
        };
        let (inputs, outputs) =
            (ports(&logic.inputs()[..design.inputs()]), ports(&logic.outputs()[..design.outputs()]));
        Self { folder, module, design, cancel, inputs, outputs }
    }

    fn compare(&self, modules: &VerilogModules) -> Result<Simulated, VerilogError> {
        let ports: Vec<Vec<usize>> = self.inputs.iter().map(|bus| bus.bits.clone()).collect();
        let gates = self.design.logic.cells().count().max(1);
        let steps = (MOST_GATES / gates).clamp(FEWEST_STEPS, MOST_STEPS);
        let Some(run) = RandomRun::of(self.design, &ports, steps, SEED) else { return Ok(Simulated::NotComparable) };
        let bits = |step: &RunStep| format!("{}\n", word(step.inputs.iter().rev().copied()));
        write(self.folder, STEPS, &run.steps[1..].iter().map(bits).collect::<String>())?;
        let settings = self.settings(&run);
        let Some(settings) = self.compiled(settings, &run, "")? else { return self.why_not() };
        let Some(values) = self.run()? else { return Ok(Simulated::NotRun) };
        let differing = values.iter().zip(&run.steps).any(|(line, step)| self.differs(line, step).is_some());
        if !differing {
            return Ok(match values.len() {
                0 => Simulated::NotRun,
                lines => Simulated::Equal { steps: lines - 1 },
            });
        }
        if run.is_rippled {
            return Ok(Simulated::NotComparable);
        }
        // Once more, with the values of all nets.
        let dump = format!("$dumpfile(\"{DUMP}\"); $dumpvars(0, dut);");
        if self.compiled(settings, &run, &dump)?.is_none() || self.run()?.is_none() {
            return Ok(Simulated::NotRun);
        }
        let dump = disk::read_text(&self.folder.join(DUMP), Limit::CircuitFileBytes.most());
        let Ok(dump) = dump else { return Ok(Simulated::NotRun) };
        let registers = self.design.registers.iter().map(|register| register.name.as_str());
        let open = OpenValues::of(&dump, &registers.collect(), values.len(), STEP);
        let mut equal = 0;
        for (at, (line, step)) in values.iter().zip(&run.steps).enumerate() {
            match self.differs(line, step) {
                _ if open.registers.is_some_and(|first| first <= at) => break,
                Some(_) if open.nets[at] || at > 0 && open.nets[at - 1] => {}
                Some(output) => {
                    return Err(VerilogError::Different(Box::new(self.difference(at, line, step, output, modules))));
                }
                None => equal += usize::from(at > 0),
            }
        }
        Ok(if equal == 0 { Simulated::NotComparable } else { Simulated::Equal { steps: equal } })
    }

    /// Why there is no simulation.
    fn why_not(&self) -> Result<Simulated, VerilogError> {
        match process::run(self.folder, &["iverilog", "-V"], READING, self.cancel) {
            Err(VerilogError::Cancelled) => Err(VerilogError::Cancelled),
            Err(VerilogError::NoYosys) => Ok(Simulated::NoSimulator),
            _ => Ok(Simulated::NotRun),
        }
    }

    /// Statements that give registers which are open their start values.
    fn settings(&self, run: &RandomRun) -> Vec<String> {
        let is_plain = |name: &str| {
            let is_letter = |c: char| c.is_ascii_alphanumeric() || "_.[]".contains(c);
            name.chars().all(is_letter) && !name.starts_with(|c: char| c.is_ascii_digit())
        };
        let held = self.design.registers.iter().zip(&run.held).filter(|(_, held)| **held);
        let plain = held.map(|(register, _)| register).filter(|register| is_plain(&register.name));
        let setting = |register: &nbc_circuit::formats::Register| {
            let (name, start) = (&register.name, u8::from(register.starts_at()));
            format!("if (dut.{name} === 1'bx) dut.{name} = 1'b{start};")
        };
        plain.map(setting).collect()
    }

    /// Compiles the bench; the settings that the simulator permits, or none if it cannot read the source.
    fn compiled(
        &self,
        mut settings: Vec<String>,
        run: &RandomRun,
        more: &str,
    ) -> Result<Option<Vec<String>>, VerilogError> {
        for round in 0..=ROUNDS {
            let (text, first) = self.bench(&settings, run, more);
            write(self.folder, BENCH, &text)?;
            let words = ["iverilog", "-g2012", "-s", "nbc_bench", "-o", PROGRAM, BENCH, WRITTEN];
            let said = match process::run(self.folder, &words, READING, self.cancel) {
                Ok(Ok(())) => return Ok(Some(settings)),
                Ok(Err(said)) => said,
                Err(VerilogError::Cancelled) => return Err(VerilogError::Cancelled),
                Err(_) => return Ok(None),
            };
            let line = |line: &str| line.strip_prefix(BENCH)?.strip_prefix(':')?.split(':').next()?.parse().ok();
            let lines: BTreeSet<usize> = said.lines().filter_map(line).collect();
            let before = settings.len();
            let mut at = first..;
            settings.retain(|_| at.next().is_some_and(|at| !lines.contains(&at)));
            if settings.len() == before {
                return Ok(None);
            }
            if round + 1 == ROUNDS {
                settings.clear();
            }
        }
        Ok(None)
    }

    /// The test bench, and the line of the first setting.
    fn bench(&self, settings: &[String], run: &RandomRun, more: &str) -> (String, usize) {
        let (inputs, outputs) = (self.design.inputs(), self.design.outputs());
        let connection = |net: &str, bus: &Bus| {
            let bits: Vec<String> = bus.bits.iter().rev().map(|bit| format!("{net}[{bit}]")).collect();
            format!(".\\{} ({{{}}})", bus.name, bits.join(", "))
        };
        let ports = self.inputs.iter().map(|bus| connection("in", bus));
        let ports = ports.chain(self.outputs.iter().map(|bus| connection("out", bus)));
        let digits = |bits: &[bool]| word(bits.iter().rev().copied().chain(bits.is_empty().then_some(false)));
        // Logic that only reads inputs begins when these change.
        let (first, plain) = (digits(&run.steps[0].inputs), digits(&run.plain));
        let (width, part) = (inputs.max(1), STEP / 3);
        let (last_in, last_out, steps) = (inputs.max(1) - 1, outputs.max(1) - 1, run.steps.len() - 1);
        let mut text = format!(
            "module nbc_bench;\n\
             reg [{last_in}:0] all [0:{}];\n\
             reg [{last_in}:0] in = {width}'b{first};\n\
             wire [{last_out}:0] out;\n\
             integer at, file;\n\
             \\{} dut({});\n\
             initial begin {more} $readmemb(\"{STEPS}\", all); file = $fopen(\"{VALUES}\");\n\
             #{part} in = in ^ {width}'b{plain}; #{part} in = in ^ {width}'b{plain}; #{part}\n",
            steps.max(1) - 1,
            self.module,
            ports.collect::<Vec<_>>().join(", "),
        );
        let line = text.lines().count() + 1;
        settings.iter().for_each(|setting| text.push_str(&format!("{setting}\n")));
        let _ = write!(
            text,
            "#{STEP} $fdisplay(file, \"%b\", out);\n\
             for (at = 0; at < {steps}; at = at + 1) begin in = all[at]; #{STEP} $fdisplay(file, \"%b\", out); end\n\
             $finish; end\nendmodule\n"
        );
        (text, line)
    }

    /// The lines that the bench wrote: the outputs at the start and after each step, as far as there was time.
    fn run(&self) -> Result<Option<Vec<String>>, VerilogError> {
        match process::run(self.folder, &["vvp", "-n", PROGRAM], RUNNING, self.cancel) {
            Ok(Ok(())) | Err(VerilogError::TooLong { .. }) => {}
            Err(VerilogError::Cancelled) => return Err(VerilogError::Cancelled),
            _ => return Ok(None),
        }
        let text = disk::read_text(&self.folder.join(VALUES), Limit::CircuitFileBytes.most());
        let is_whole = |line: &&str| line.len() == self.design.outputs().max(1);
        Ok(text.ok().map(|text| text.lines().take_while(is_whole).map(str::to_owned).collect()))
    }

    /// The first output of a step that differs where the source defines it.
    fn differs(&self, line: &str, step: &RunStep) -> Option<usize> {
        let is_other = |(bit, &value): (u8, &bool)| match bit {
            b'0' => value,
            b'1' => !value,
            _ => false,
        };
        line.bytes().rev().zip(&step.outputs).position(is_other)
    }

    fn difference(
        &self,
        at: usize,
        line: &str,
        step: &RunStep,
        output: usize,
        modules: &VerilogModules,
    ) -> VerilogDifference {
        let port = self.outputs.iter().find(|bus| bus.bits.contains(&output)).expect("a bit is of a port");
        let value = |bus: &Bus, values: &[bool]| word(bus.bits.iter().rev().map(|&bit| values[bit]));
        let bits: Vec<char> = line.chars().rev().collect();
        let net = modules.nets.get(&(self.module.to_owned(), port.name.clone()));
        VerilogDifference {
            module: self.module.to_owned(),
            step: at,
            output: port.name.clone(),
            source: port.bits.iter().rev().map(|&bit| bits[bit]).collect(),
            translation: value(port, &step.outputs),
            inputs: self.inputs.iter().map(|bus| (bus.name.clone(), value(bus, &step.inputs))).collect(),
            place: net.and_then(|line| modules.lines.get(line.checked_sub(1)?)).cloned(),
        }
    }
}

fn write(folder: &Path, name: &str, text: &str) -> Result<(), VerilogError> {
    fs::write(folder.join(name), text).map_err(|error| VerilogError::NoFolder(io_words(&error)))
}

/// The seed of the steps.
const SEED: u64 = 0x6e62_6369_7665_7269;

/// Bits as digits.
fn word(bits: impl Iterator<Item = bool>) -> String {
    bits.map(|bit| if bit { '1' } else { '0' }).collect()
}
