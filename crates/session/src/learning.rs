//! Circuits that are learned from the rows of a file.

use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Column;
use nbc_base::source::SourceFile;
use nbc_circuit::formats::Design;
use nbc_circuit::rows::RowFormat;
use nbc_learn::{Examples, GateGraph, LearnOptions, LearnedCircuit, Learner, Literal};

use crate::wording::LearningError;

/// What a circuit is learned from.
#[derive(Clone, Debug)]
pub struct LearningRequest<'a> {
    /// The name of the circuit.
    pub circuit: &'a str,
    /// The file of rows.
    pub rows: &'a SourceFile,
    /// The outputs; by default those that the file says, or its last port.
    pub outputs: &'a [String],
    /// How it is learned.
    pub options: LearnOptions,
}

impl LearningRequest<'_> {
    /// The command that learns the same again.
    pub fn command(&self) -> String {
        let LearnOptions { gates, hold_out, group, seed } = self.options;
        let targets: String = self.outputs.iter().map(|port| format!(" --target {port}")).collect();
        let group = if group > 1 { format!(" --group {group}") } else { String::new() };
        let rows = self.rows.name.rsplit(['/', '\\']).next().unwrap_or_default();
        format!("nbc learn {rows}{targets} --gates {gates} --hold-out {hold_out}{group} --seed {seed}")
    }
}

/// A circuit that is being learned. Each portion is short; a door decides when it does the next one, and cancels by
/// dropping the value.
#[derive(Clone, Debug)]
pub struct Learning {
    circuit: String,
    inputs: Vec<Column>,
    outputs: Vec<Column>,
    learner: Learner,
}

/// A circuit that was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The circuit.
    pub design: Design,
    /// Its inputs.
    pub inputs: Vec<Column>,
    /// Its outputs.
    pub outputs: Vec<Column>,
    /// Its gates, how they were learned, and the rows.
    pub circuit: LearnedCircuit,
}

impl Learning {
    /// Reads rows, and begins to learn.
    pub fn new(request: &LearningRequest<'_>) -> Result<Self, Vec<Diagnostic>> {
        let LearningRequest { circuit, rows, outputs, options } = *request;
        let one = |fault: Diagnostic| vec![fault];
        if options.group == 0 {
            return Err(one(LearningError::NoGroup.into()));
        }
        if !(0.0..100.0).contains(&options.hold_out) {
            return Err(one(LearningError::HoldOut { percent: options.hold_out }.into()));
        }
        let format = RowFormat::of_path(&rows.name);
        let format = format.ok_or_else(|| one(LearningError::Format { file: rows.name.clone() }.into()))?;
        let file = format.read(rows)?;
        let (inputs, outputs) = file.ports(outputs).map_err(one)?;
        let [given, wanted] = [&inputs, &outputs].map(|ports| ports.iter().map(|port| port.width).sum::<usize>());
        let too_large = |_| one(LearningError::TooLarge { inputs: given, outputs: wanted }.into());
        Limit::LearnedBits.permit((given as u64).saturating_mul(wanted as u64)).map_err(too_large)?;
        let examples = Examples::of(&file.bind(circuit, &inputs, &outputs)?);
        let held_out = options.held_out(examples.rows);
        if held_out >= examples.rows {
            return Err(one(LearningError::NoTraining { rows: examples.rows, percent: options.hold_out }.into()));
        }
        let widths: Vec<usize> = outputs.iter().map(|port| port.width).collect();
        let learner = Learner::new(&examples, &widths, options);
        Ok(Self { circuit: circuit.to_owned(), inputs, outputs, learner })
    }

    /// A circuit with the ports of the one that is learned, to try where it is to be written.
    pub fn outline(&self) -> Design {
        let bits = |ports: &[Column]| ports.iter().flat_map(Column::bits).collect::<Vec<_>>();
        let outputs: Vec<_> = bits(&self.outputs).into_iter().map(|output| (output, Literal::FALSE)).collect();
        let inputs = bits(&self.inputs);
        Design::new(GateGraph::new(inputs.len()).netlist(&self.circuit, &inputs, &outputs), Vec::new())
    }

    /// How much is done, and how much there is.
    pub fn progress(&self) -> (u64, u64) {
        self.learner.progress()
    }

    /// Does the next portion. Returns false when all is done.
    pub fn advance(&mut self) -> bool {
        self.learner.advance()
    }

    /// The circuit.
    ///
    /// # Panics
    /// When there is more to do.
    pub fn finish(self) -> Learned {
        let Self { circuit: name, inputs, outputs, learner } = self;
        let circuit = learner.finish();
        let bits = |ports: &[Column]| ports.iter().flat_map(Column::bits).collect::<Vec<_>>();
        let named: Vec<_> = bits(&outputs).into_iter().zip(circuit.literals.iter().copied()).collect();
        let logic = circuit.graph.netlist(&name, &bits(&inputs), &named);
        Learned { design: Design::new(logic, Vec::new()), inputs, outputs, circuit }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::Sources;

    #[test]
    fn options_out_of_range_are_refused() {
        let mut sources = Sources::default();
        let file = sources.add("and.csv", "a,b,q\n0,0,0\n0,1,0\n1,0,0\n1,1,1\n");
        let begun = |options| {
            let request = LearningRequest { circuit: "f", rows: sources.file(file), outputs: &[], options };
            Learning::new(&request).map_err(|faults| faults[0].message.clone())
        };
        let options = LearnOptions { hold_out: 0.0, ..LearnOptions::default() };
        let refused = |options, message: &str| assert_eq!(begun(options).err().as_deref(), Some(message));
        refused(LearnOptions { group: 0, ..options }, "invalid group of 0 rows; expected at least 1");
        for hold_out in [f64::NAN, -1.0, 100.0] {
            let message = format!("invalid share {hold_out} % to hold out; expected a number from 0 to less than 100");
            refused(LearnOptions { hold_out, ..options }, &message);
        }
        let mut learning = begun(LearnOptions { group: usize::MAX, gates: usize::MAX, ..options }).unwrap();
        while learning.advance() {}
        let circuit = learning.finish().circuit;
        assert_eq!((circuit.ands(), circuit.accuracy(&circuit.training).right), (1, 4));
    }
}
