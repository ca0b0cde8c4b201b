//! Tests whose rows depend on what the circuit does, performed at the level of logic: the environment answers the
//! circuit, and rows are repeated until an output has a value. In physics the rows are those that were found here.

use crate::contents::first_words;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{CircuitTest, MemoryArray, Program, Script, ScriptStep, TestRow};
use nbc_base::source::SourceWorld;
use nbc_circuit::elaborate::elaborate_environment;
use nbc_circuit::waves::{ClockRun, ClockStep};
use nbc_circuit::{Environment, Logic, MemoryAccess, Netlist};

/// Limit on how often a circuit and its environment answer each other within a row.
const MOST_ANSWERS: usize = 100;

#[derive(Clone, Debug)]
pub(super) struct Performance {
    script: Script,
    circuit: Performer,
    beside: Option<Beside>,
    /// The next step, and how often it was repeated.
    next: (usize, usize),
    pub(super) printed: String,
    watched: Option<EnvironmentRun>,
}

#[derive(Clone, Debug)]
enum Performer {
    /// One clock, and every step is a pulse.
    Clocked(Box<ClockRun>),
    Free(Box<Logic>),
}

#[derive(Clone, Debug)]
struct Beside {
    environment: Environment,
    name: String,
    memories: Vec<(String, usize)>,
    sees: Vec<Seen>,
    /// Pairs of an output bit, and the circuit's input bit that it drives.
    gives: Vec<(usize, usize)>,
    /// First output bit of the text.
    text: Option<usize>,
}

#[derive(Clone, Copy, Debug)]
enum Seen {
    Output(usize),
    Input(usize),
}

pub(super) struct PerformedRow {
    pub(super) row: TestRow,
    pub(super) outputs: Vec<bool>,
    /// The last row of its step, where outputs are expected.
    pub(super) is_last: bool,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnvironmentRun {
    pub name: String,
    pub has_text: bool,
    /// Before the first row.
    pub memories: Vec<MemoryContents>,
    pub rows: Vec<EnvironmentRow>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MemoryContents {
    pub name: String,
    pub width: usize,
    pub words: Vec<u128>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnvironmentRow {
    pub printed: Option<char>,
    /// For each memory, the addresses that are read in the row, and the words that are stored as it begins.
    pub accesses: Vec<MemoryAccess>,
}

pub(super) fn environment(
    world: &dyn SourceWorld,
    program: &Program,
    test: &CircuitTest,
    script: &Script,
    files: &[(String, String)],
) -> Result<(), Vec<Diagnostic>> {
    Beside::new(world, program, test, script, files).map(drop)
}

impl Performance {
    pub(super) fn new(
        world: &dyn SourceWorld,
        program: &Program,
        test: &CircuitTest,
        script: &Script,
        netlist: &Netlist,
        files: &[(String, String)],
    ) -> Result<Self, Vec<Diagnostic>> {
        let is_pulse = |step: &ScriptStep| step.rows.len() == 2;
        let clocked = script.steps.iter().all(is_pulse).then(|| ClockStep::of(netlist).ok()).flatten();
        let pulsed = |step: &ClockStep| {
            step.clock.is_none_or(|clock| step.rises && script.steps.iter().all(|one| one.rows[1].inputs[clock]))
        };
        let circuit = match clocked.filter(pulsed) {
            Some(step) => Performer::Clocked(Box::new(ClockRun::new(step))),
            None => Performer::Free(Box::new(Logic::new(netlist))),
        };
        let beside = match script.environment {
            Some(_) => Some(Beside::new(world, program, test, script, files)?),
            None => None,
        };
        Ok(Self { script: script.clone(), circuit, beside, next: (0, 0), printed: String::new(), watched: None })
    }

    pub(super) fn watch(mut self, rows: usize) -> Result<Option<EnvironmentRun>, Diagnostic> {
        self.watched = self.beside.as_ref().map(Beside::at_start);
        let is_long = |run: &Option<EnvironmentRun>| run.as_ref().is_none_or(|run| run.rows.len() >= rows);
        while !is_long(&self.watched) && self.step()?.is_some() {}
        Ok(self.watched)
    }

    /// Done and total; a step that is repeated is one.
    pub(super) fn progress(&self) -> (usize, usize) {
        (self.next.0, self.script.steps.len())
    }

    /// The rows of the next step or repetition; `None` after the last.
    pub(super) fn step(&mut self) -> Result<Option<Vec<PerformedRow>>, Diagnostic> {
        let (at, times) = self.next;
        let Some(step) = self.script.steps.get(at) else { return Ok(None) };
        let (rows, until) = (step.rows.clone(), step.until.clone());
        let mut performed = Vec::with_capacity(rows.len());
        let last = rows.len() - 1;
        for (half, row) in rows.into_iter().enumerate() {
            let done = if half == 0 { self.settle(row)? } else { self.edge(row, &performed[0]) };
            performed.push(PerformedRow { is_last: half == last, ..done });
        }
        let end = performed.last_mut().expect("a step has a row");
        self.next = match until {
            None => (at + 1, 0),
            Some(until) => {
                let shown = &end.outputs[until.first..until.first + until.bits.len()];
                let is_met = until.bits.iter().zip(shown).all(|(bit, shown)| bit.is_none_or(|bit| bit == *shown));
                let ends = is_met || times + 1 == until.most;
                end.is_last = ends;
                if ends && !is_met {
                    // The row fails: the output never had its value.
                    end.row.given_up = Some(until.most);
                    end.row.expected[until.first..until.first + until.bits.len()].clone_from_slice(&until.bits);
                }
                if ends { (at + 1, 0) } else { (at, times + 1) }
            }
        };
        Ok(Some(performed))
    }

    fn settle(&mut self, mut row: TestRow) -> Result<PerformedRow, Diagnostic> {
        for _ in 0..MOST_ANSWERS {
            if let Some(beside) = &self.beside {
                beside.give(&mut row.inputs);
            }
            let outputs = self.circuit.apply(&row.inputs);
            let Some(beside) = &mut self.beside else { return Ok(PerformedRow { row, outputs, is_last: true }) };
            beside.see(&row.inputs, &outputs).map_err(|fault| wording::bad_environment(&fault, row.span))?;
            if beside.agrees(&row.inputs) {
                let rows = self.watched.iter_mut().map(|run| &mut run.rows);
                rows.for_each(|rows| rows.push(EnvironmentRow { printed: None, accesses: beside.reads() }));
                return Ok(PerformedRow { row, outputs, is_last: true });
            }
        }
        Err(wording::never_agree(row.span))
    }

    /// The second half of a pulse, in which the environment's outputs stay as before the edge.
    fn edge(&mut self, mut row: TestRow, before: &PerformedRow) -> PerformedRow {
        let (mut printed, mut taken) = (None, Vec::new());
        if let Some(beside) = &mut self.beside {
            for &(_, input) in &beside.gives {
                row.inputs[input] = before.row.inputs[input];
            }
            (printed, taken) = (beside.printed(), beside.environment.accesses());
            self.printed.extend(printed);
            beside.environment.advance();
        }
        let outputs = self.circuit.edge(&row.inputs);
        if let Some(beside) = &mut self.beside {
            // A circle is reported before the next edge, where the same words are read again.
            _ = beside.see(&row.inputs, &outputs);
            if let Some(run) = &mut self.watched {
                let mut accesses = beside.reads();
                accesses.iter_mut().zip(taken.drain(..)).for_each(|(now, taken)| now.writes = taken.writes);
                run.rows.push(EnvironmentRow { printed, accesses });
            }
        }
        PerformedRow { row, outputs, is_last: true }
    }
}

impl Performer {
    fn apply(&mut self, inputs: &[bool]) -> Vec<bool> {
        match self {
            Self::Clocked(run) => {
                let words: Vec<u64> = inputs.iter().map(|&bit| if bit { !0 } else { 0 }).collect();
                run.apply(&words);
                Self::shown(run)
            }
            // Outputs that never rest are what they are.
            Self::Free(logic) => logic.settle(inputs).unwrap_or_else(|_| logic.outputs()),
        }
    }

    fn edge(&mut self, inputs: &[bool]) -> Vec<bool> {
        match self {
            Self::Clocked(run) => {
                run.advance();
                Self::shown(run)
            }
            Self::Free(_) => self.apply(inputs),
        }
    }

    fn shown(run: &ClockRun) -> Vec<bool> {
        (0..run.step().outputs.len()).map(|port| run.output(port) & 1 == 1).collect()
    }
}

impl Beside {
    fn new(
        world: &dyn SourceWorld,
        program: &Program,
        test: &CircuitTest,
        script: &Script,
        files: &[(String, String)],
    ) -> Result<Self, Vec<Diagnostic>> {
        let place = script.environment.expect("a script with an environment");
        let (netlist, ports) = elaborate_environment(program, place)?;
        let circuit = &program.circuits[place.0 as usize];
        let contents: Result<Vec<Vec<u128>>, Diagnostic> = circuit
            .memories
            .iter()
            .zip(&ports)
            .map(|(memory, ports)| first_words(world, program, memory, ports, files))
            .collect();
        let contents = contents.map_err(|fault| vec![fault])?;
        let fault = |fault| vec![wording::bad_environment(&fault, circuit.span)];
        let name = |memory: &MemoryArray| circuit.nets[memory.net.0 as usize].name.clone();
        let memories = circuit.memories.iter().map(name).zip(ports.iter().map(|ports| ports.width)).collect();
        let environment = Environment::new(&netlist, ports, contents).map_err(fault)?;
        let [own_inputs, own_outputs] = [netlist.inputs(), netlist.outputs()]
            .map(|ids| ids.iter().map(|&id| netlist.net_name(id)).collect::<Vec<String>>());
        let (inputs, outputs) = (test.input_bits(), test.output_bits());
        let find = |names: &[String], name: &str| names.iter().position(|known| known == name);
        let sees = own_inputs
            .iter()
            .filter_map(|name| find(&outputs, name).map(Seen::Output).or_else(|| find(&inputs, name).map(Seen::Input)));
        let gives = own_outputs.iter().enumerate().filter_map(|(at, name)| Some((at, find(&inputs, name)?)));
        let ports = circuit.inputs..circuit.inputs + circuit.outputs;
        let text = ports.map(|slot| &circuit.nets[slot]).find(|net| net.is_text);
        let text = text.and_then(|net| find(&own_outputs, &format!("{}[8]", net.name)));
        let (sees, gives, name) = (sees.collect(), gives.collect(), circuit.name.clone());
        Ok(Self { environment, name, memories, sees, gives, text })
    }

    fn at_start(&self) -> EnvironmentRun {
        let contents = self.memories.iter().zip(self.environment.words());
        let contents = contents.map(|((name, width), words)| MemoryContents {
            name: name.clone(),
            width: *width,
            words: words.clone(),
        });
        let (name, has_text) = (self.name.clone(), self.text.is_some());
        EnvironmentRun { name, has_text, memories: contents.collect(), rows: Vec::new() }
    }

    /// Without the words that will be stored at the edge of the clock.
    fn reads(&self) -> Vec<MemoryAccess> {
        let accesses = self.environment.accesses().into_iter();
        accesses.map(|access| MemoryAccess { writes: Vec::new(), ..access }).collect()
    }

    fn give(&self, inputs: &mut [bool]) {
        let outputs: Vec<bool> = self.environment.outputs().collect();
        for &(own, input) in &self.gives {
            inputs[input] = outputs[own];
        }
    }

    fn agrees(&self, inputs: &[bool]) -> bool {
        let outputs: Vec<bool> = self.environment.outputs().collect();
        self.gives.iter().all(|&(own, input)| inputs[input] == outputs[own])
    }

    fn see(&mut self, inputs: &[bool], outputs: &[bool]) -> Result<(), nbc_circuit::EnvironmentFault> {
        let bit = |seen: &Seen| match *seen {
            Seen::Output(at) => outputs[at],
            Seen::Input(at) => inputs[at],
        };
        let seen: Vec<bool> = self.sees.iter().map(bit).collect();
        self.environment.apply(&seen)
    }

    fn printed(&self) -> Option<char> {
        let first = self.text?;
        let outputs: Vec<bool> = self.environment.outputs().skip(first).take(9).collect();
        let (&writes, bits) = outputs.split_first()?;
        let code = bits.iter().fold(0u8, |code, &bit| code << 1 | u8::from(bit));
        writes.then_some(char::from(code))
    }
}
