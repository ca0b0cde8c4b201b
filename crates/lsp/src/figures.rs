//! The figures of a circuit or a net for which it must be compiled: robots, times, the slowest path.

use nbc_base::diag::counted;
use nbc_base::model::Instance;
use nbc_base::source::Span;
use nbc_circuit::CancelFlag;
use nbc_session::{Checked, CompileOptions, Mapping};

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Subject {
    /// As the swarm of that name, or as the first that is declared for the circuit.
    Circuit(Instance, Option<String>),
    /// The part of the circuit that drives the net declared at this place.
    Net(Instance, Span),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Figures {
    Circuit(CircuitFigures),
    Net { cells: usize, robots: usize },
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CircuitFigures {
    swarm: Option<String>,
    robots: usize,
    /// Cycles after which every net is correct.
    hold: u32,
    /// The least period of each clock, in cycles.
    clocks: Vec<(String, u32)>,
    path: Vec<String>,
    pub(super) timing: String,
}

impl Subject {
    /// `None` if it cannot be made. The figures of a cancelled compilation must not be used.
    pub(super) fn compile(&self, checked: &Checked, cancel: &CancelFlag) -> Option<Figures> {
        match self {
            Self::Circuit(circuit, swarm) => {
                of_circuit(checked, circuit, options(checked, circuit, swarm.clone(), cancel))
            }
            Self::Net(circuit, net) => {
                let options = options(checked, circuit, None, cancel);
                let Mapping { source, netlist, .. } = checked.map_net(circuit, *net, &options).ok()?;
                Some(Figures::Net { cells: source.cells().count(), robots: netlist.cells().count() })
            }
        }
    }
}

fn options(checked: &Checked, circuit: &Instance, swarm: Option<String>, cancel: &CancelFlag) -> CompileOptions {
    let first = || checked.swarms(circuit).first().map(|swarm| swarm.name.clone());
    CompileOptions { swarm: swarm.or_else(first), cancel: cancel.clone(), ..CompileOptions::default() }
}

fn of_circuit(checked: &Checked, circuit: &Instance, options: CompileOptions) -> Option<Figures> {
    let compiled = checked.compile(circuit, &options).ok()?;
    let timing = compiled.swarm_timing();
    Some(Figures::Circuit(CircuitFigures {
        swarm: options.swarm,
        robots: compiled.assembly.members.len(),
        hold: timing.hold,
        clocks: timing.phases.clocks.iter().map(|clock| (clock.clock.clone(), clock.period)).collect(),
        path: timing.critical_path.iter().map(|step| step.net.clone()).collect(),
        timing: timing.describe(),
    }))
}

impl CircuitFigures {
    /// `12 robots, clock 8`: in cycles, the longest period of a clock, or the hold of a circuit without one.
    pub(super) fn summary(&self) -> String {
        let clock = self.clocks.iter().map(|(_, period)| *period).max().unwrap_or(self.hold);
        format!("{}, clock {clock}", self.robots())
    }

    pub(super) fn robots(&self) -> String {
        counted(self.robots, "robot")
    }

    fn describe(&self) -> String {
        let swarm = self.swarm.as_ref().map_or(String::new(), |swarm| format!(" as `{swarm}`"));
        let hold = counted(self.hold as usize, "cycle");
        let mut text = format!("**{}**{swarm}, settles within {hold}", self.robots());
        for (clock, period) in &self.clocks {
            text.push_str(&format!(", period of `{clock}` {}", counted(*period as usize, "cycle")));
        }
        if !self.path.is_empty() {
            let nets: Vec<String> = self.path.iter().map(|net| format!("`{net}`")).collect();
            text.push_str(&format!("\n\nSlowest path: {}", nets.join(" → ")));
        }
        text
    }
}

impl Figures {
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Circuit(figures) => figures.describe(),
            Self::Net { cells, robots } => {
                let (cells, robots) = (counted(*cells, "cell"), counted(*robots, "robot"));
                format!("Made alone, it takes {cells} as written and **{robots}**.")
            }
        }
    }
}
