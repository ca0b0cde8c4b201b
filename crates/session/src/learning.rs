//! Circuits that are learned from the rows of a file.

use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Column;
use nbc_base::source::SourceFile;
use nbc_circuit::formats::Design;
use nbc_circuit::rows::RowFormat;
use nbc_learn::{Examples, GateGraph, LearnOptions, LearnedCircuit, Learner, Literal};

use crate::wording;

/// What a circuit is learned from.
#[derive(Clone, Debug)]
pub struct LearningRequest<'a> {
    pub circuit: &'a str,
    pub rows: &'a SourceFile,
    /// By default those that the file names, or its last port.
    pub outputs: &'a [String],
    pub options: LearnOptions,
}

impl LearningRequest<'_> {
    pub fn command(&self) -> String {
        let LearnOptions { gates, hold_out, group, seed } = self.options;
        let targets: String = self.outputs.iter().map(|port| format!(" --target {port}")).collect();
        let group = if group > 1 { format!(" --group {group}") } else { String::new() };
        let rows = self.rows.name.rsplit(['/', '\\']).next().unwrap_or_default();
        format!("nbc learn {rows}{targets} --gates {gates} --hold-out {hold_out}{group} --seed {seed}")
    }
}

/// A circuit that is being learned, in short portions. It can be dropped between any two.
#[derive(Clone, Debug)]
pub struct Learning {
    circuit: String,
    inputs: Vec<Column>,
    outputs: Vec<Column>,
    learner: Learner,
}

#[derive(Clone, Debug)]
pub struct Learned {
    pub design: Design,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    pub circuit: LearnedCircuit,
}

impl Learning {
    pub fn new(request: &LearningRequest<'_>) -> Result<Self, Vec<Diagnostic>> {
        let LearningRequest { circuit, rows, outputs, options } = *request;
        if options.group == 0 {
            return Err(vec![wording::empty_group()]);
        }
        if !(0.0..100.0).contains(&options.hold_out) {
            return Err(vec![wording::bad_hold_out(options.hold_out)]);
        }
        let format = RowFormat::of_path(&rows.name).ok_or_else(|| vec![wording::no_row_format(&rows.name)])?;
        let file = format.read(rows)?;
        let (inputs, outputs) = file.ports(outputs).map_err(|fault| vec![fault])?;
        let [given, wanted] = [&inputs, &outputs].map(|ports| ports.iter().map(|port| port.width).sum::<usize>());
        Limit::LearnedBits
            .permit((given as u64).saturating_mul(wanted as u64))
            .map_err(|_| vec![wording::too_large_to_learn(given, wanted)])?;
        let examples = Examples::of(&file.bind(circuit, &inputs, &outputs)?);
        let held_out = options.held_out(examples.rows);
        if held_out >= examples.rows {
            return Err(vec![wording::no_training_rows(examples.rows, options.hold_out)]);
        }
        let learner = Learner::new(&examples, &outputs, options);
        Ok(Self { circuit: circuit.to_owned(), inputs, outputs, learner })
    }

    pub fn outline(&self) -> Design {
        let bits = |ports: &[Column]| ports.iter().flat_map(Column::bits).collect::<Vec<_>>();
        let outputs: Vec<_> = bits(&self.outputs).into_iter().map(|output| (output, Literal::FALSE)).collect();
        let inputs = bits(&self.inputs);
        Design::new(GateGraph::new(inputs.len()).netlist(&self.circuit, &inputs, &outputs))
    }

    /// Done and total.
    pub fn progress(&self) -> (u64, u64) {
        self.learner.progress()
    }

    /// Returns false when all is done.
    pub fn advance(&mut self) -> bool {
        self.learner.advance()
    }

    /// Panics before the last portion.
    pub fn finish(self) -> Learned {
        let Self { circuit: name, inputs, outputs, learner } = self;
        let circuit = learner.finish();
        let bits = |ports: &[Column]| ports.iter().flat_map(Column::bits).collect::<Vec<_>>();
        let named: Vec<_> = bits(&outputs).into_iter().zip(circuit.literals.iter().copied()).collect();
        let logic = circuit.graph.netlist(&name, &bits(&inputs), &named);
        Learned { design: Design::new(logic), inputs, outputs, circuit }
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
