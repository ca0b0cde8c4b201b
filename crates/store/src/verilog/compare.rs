//! Two readings of a module, compared for ever.

use nbc_base::source::{FileId, SecondReading, VerilogModule};
use nbc_circuit::formats::buses::{Bus, buses};
use nbc_circuit::formats::{Design, verilog_design};
use nbc_circuit::{CancelFlag, DesignRun, Likeness, NetId, likeness};

const MOST_STEPS: usize = 12;
const MOST_OUTPUTS: usize = 4;
const MOST_VALUES: usize = 12;

pub(super) struct ModuleComparison {
    pub(super) second: SecondReading,
    /// A run that ends with a difference, or a state with one, in words.
    pub(super) difference: Option<String>,
}

impl ModuleComparison {
    pub(super) fn of(first: &VerilogModule, second: &VerilogModule, cancel: &CancelFlag) -> Self {
        let read = |module| verilog_design(module, FileId(0), None);
        // An error is told where the module is read.
        let (Ok(one), Ok(two)) = (read(first), read(second)) else { return Self::plain(SecondReading::None) };
        match likeness(&one, &two, cancel) {
            Likeness::Proved => Self::plain(SecondReading::Alike),
            Likeness::Open(steps) => Self::plain(SecondReading::Equal(steps)),
            Likeness::NoSteps => Self::plain(SecondReading::NoSteps),
            Likeness::Port(port) => {
                let difference = Some(format!("only one of them has the port `{port}`"));
                Self { second: SecondReading::Different, difference }
            }
            Likeness::Different(runs) => {
                Self { second: SecondReading::Different, difference: Some(Told::of(&one).run(&runs)) }
            }
            Likeness::Doubtful { steps, inputs, state, outputs } => {
                let registers: Vec<String> = one.netlist.registers().map(|(id, _)| one.netlist.net_name(id)).collect();
                let told = Told::of(&one);
                let state = values(&buses(&registers, &one.ascending), &state);
                let (inputs, outputs) = (values(&told.inputs, &inputs), told.outputs(&outputs));
                let difference = format!("in the state {state}, which may never be reached, and {inputs}{outputs}");
                Self { second: SecondReading::Equal(steps), difference: Some(difference) }
            }
        }
    }

    fn plain(second: SecondReading) -> Self {
        Self { second, difference: None }
    }
}

struct Told {
    inputs: Vec<Bus>,
    outputs: Vec<Bus>,
}

impl Told {
    fn of(design: &Design) -> Self {
        let ports = |ids: &[NetId]| buses(&design.netlist.net_names(ids), &design.ascending);
        Self { inputs: ports(design.netlist.inputs()), outputs: ports(design.netlist.outputs()) }
    }

    /// The last steps of two runs, and what differs in the end.
    fn run(&self, [one, two]: &[DesignRun; 2]) -> String {
        let mut steps = Vec::new();
        for (at, now) in one.inputs.iter().enumerate() {
            let before = at.checked_sub(1).map(|at| &one.inputs[at]);
            let is_new = |bus: &&Bus| before.is_none_or(|before| digits(bus, before) != digits(bus, now));
            let changed: Vec<String> =
                self.inputs.iter().filter(is_new).map(|bus| format!("{} = {}", bus.name, digits(bus, now))).collect();
            steps.push(changed.join(", "));
        }
        let hidden = steps.len().saturating_sub(MOST_STEPS);
        let before = if hidden > 0 { format!("after {hidden} steps: ") } else { String::new() };
        let last = [one, two].map(|run| run.outputs.last().cloned().unwrap_or_default());
        format!("{before}{}{}", steps[hidden..].join("; then "), self.outputs(&last))
    }

    fn outputs(&self, [one, two]: &[Vec<bool>; 2]) -> String {
        let differing = self.outputs.iter().filter(|bus| digits(bus, one) != digits(bus, two)).take(MOST_OUTPUTS);
        let told = |bus: &Bus| {
            format!(": `{}` is {} for slang and {} for yosys", bus.name, digits(bus, one), digits(bus, two))
        };
        differing.map(told).collect()
    }
}

fn values(buses: &[Bus], values: &[bool]) -> String {
    let hidden = buses.len().saturating_sub(MOST_VALUES);
    let mut told: Vec<String> =
        buses.iter().take(MOST_VALUES).map(|bus| format!("{} = {}", bus.name, digits(bus, values))).collect();
    if hidden > 0 {
        told.push(format!("{hidden} more"));
    }
    told.join(", ")
}

fn digits(bus: &Bus, values: &[bool]) -> String {
    bus.bits.iter().rev().map(|&bit| if values[bit] { '1' } else { '0' }).collect()
}
