//! AIGER files as models to be checked: what is 1 in a bad state, and what is 1 in every step. Files of before version
//! 1.9 have outputs in the place of bad states.

use crate::and_graph::AndLiteral;
use crate::formats::aiger::{AigerGraph, AigerLatch, AigerReader, And, Placed, sorted};
use crate::formats::wording::aiger as wording;
use crate::formats::wording::aiger::BadLiteral;
use crate::properties::{PropertyVerdict, SystemRegister, TransitionSystem};
use nbc_base::diag::Diagnostic;

#[derive(Clone, Debug)]
pub struct AigerModel {
    pub system: TransitionSystem,
    /// A name for each property: that of the file, or `b0`, `b1`, … (`o0`, `o1`, … for outputs).
    pub properties: Vec<String>,
    pub are_outputs: bool,
}

impl AigerModel {
    pub fn read(bytes: &[u8]) -> Result<Self, Diagnostic> {
        let mut reader = AigerReader::new(bytes);
        let header = reader.header()?;
        let graph = reader.graph(&header)?;
        let are_outputs = graph.bad.is_empty() && graph.constraints.is_empty();
        let wanted = if are_outputs { &graph.outputs } else { &graph.bad };
        if wanted.is_empty() {
            return Err(wording::no_properties(reader.place));
        }
        let letter = if are_outputs { 'o' } else { 'b' };
        let properties = (0..wanted.len()).map(|at| format!("{letter}{at}")).collect();
        let system = system(header.variables, &graph, wanted)?;
        let mut model = Self { system, properties, are_outputs };
        model.symbols(&mut reader, graph.outputs.len(), graph.constraints.len())?;
        Ok(model)
    }

    fn symbols(&mut self, reader: &mut AigerReader<'_>, outputs: usize, constraints: usize) -> Result<(), Diagnostic> {
        while let Some((kind, number, name)) = reader.symbol()? {
            let known = match kind {
                "i" => self.system.inputs.get_mut(number),
                "l" => self.system.registers.get_mut(number).map(|register| &mut register.name),
                "o" if self.are_outputs => self.properties.get_mut(number),
                "b" if !self.are_outputs => self.properties.get_mut(number),
                "o" if number < outputs => continue,
                "c" if number < constraints => continue,
                _ => None,
            };
            let Some(known) = known else {
                return Err(wording::unknown_symbol(&format!("{kind}{number} {name}"), reader.place));
            };
            name.clone_into(known);
        }
        Ok(())
    }

    /// What is known of a property, as a witness in AIGER's format: `1` and a run, `0`, or `2` for unknown.
    pub fn witness(&self, property: usize, verdict: &PropertyVerdict) -> String {
        let number = match verdict {
            PropertyVerdict::Refuted(_) => 1,
            PropertyVerdict::Proved(_) => 0,
            PropertyVerdict::Undecided { .. } => 2,
        };
        let mut text = format!("{number}\nb{property}\n");
        if let PropertyVerdict::Refuted(run) = verdict {
            for values in std::iter::once(&run.start).chain(&run.inputs) {
                text.extend(values.iter().map(|&value| if value { '1' } else { '0' }));
                text.push('\n');
            }
        }
        text + ".\n"
    }
}

fn system(variables: usize, graph: &AigerGraph, wanted: &[Placed]) -> Result<TransitionSystem, Diagnostic> {
    let mut known: Vec<Option<AndLiteral>> = vec![None; variables + 1];
    known[0] = Some(0);
    let sources = graph.inputs.iter().copied().chain(graph.latches.iter().map(|latch| (latch.literal, latch.place)));
    for (at, (literal, place)) in sources.enumerate() {
        match known.get_mut(literal / 2).filter(|known| literal > 1 && literal & 1 == 0 && known.is_none()) {
            Some(known) => *known = Some(2 * (at + 1)),
            None => return Err(wording::literal(BadLiteral::NotAnInput, literal, place)),
        }
    }
    let mut is_source: Vec<bool> = known.iter().map(Option::is_some).collect();
    is_source[0] = false;
    let first = graph.inputs.len() + graph.latches.len() + 1;
    let mut ands = Vec::with_capacity(graph.ands.len());
    let value = |known: &[Option<AndLiteral>], (literal, place): Placed| match known.get(literal / 2) {
        Some(Some(own)) => Ok(own ^ (literal & 1)),
        Some(None) => Err(wording::literal(BadLiteral::Undriven, literal, place)),
        None => Err(wording::literal(BadLiteral::OverHeader, literal, place)),
    };
    for And { out, pins, place } in sorted(&graph.ands, &is_source)? {
        let [a, b] = pins.map(|pin| value(&known, (pin, place)));
        known[out / 2] = Some(2 * (first + ands.len()));
        ands.push([a?, b?]);
    }
    let all = |list: &[Placed]| list.iter().map(|&placed| value(&known, placed)).collect::<Result<Vec<_>, _>>();
    let register = |(at, latch): (usize, &AigerLatch)| {
        let next = value(&known, (latch.next, latch.place))?;
        Ok(SystemRegister { name: format!("l{at}"), start: latch.start, next })
    };
    Ok(TransitionSystem {
        inputs: (0..graph.inputs.len()).map(|at| format!("i{at}")).collect(),
        registers: graph.latches.iter().enumerate().map(register).collect::<Result<_, Diagnostic>>()?,
        bad: all(wanted)?,
        constraints: all(&graph.constraints)?,
        ands,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::properties::{PropertySearch, SearchBudget};
    use nbc_base::source::CancelFlag;

    /// A latch that turns over while an input is 1, and is bad when it is 1; an optional constraint holds the input.
    const TURNS: &str = "aag 4 1 1 0 2 1\n2\n4 9\n4\n6 4 2\n8 7 5\n";

    fn decide(text: &str) -> (AigerModel, PropertyVerdict) {
        let model = AigerModel::read(text.as_bytes()).unwrap();
        let search = PropertySearch::new(model.system.clone(), SearchBudget::default(), CancelFlag::default());
        let verdict = search.finish().remove(0);
        (model, verdict)
    }

    #[test]
    fn bad_states_and_constraints_are_read() {
        let (model, verdict) = decide("aag 3 1 1 0 1 1\n2\n4 6\n4\n6 3 5\nb0 never on\n");
        assert_eq!(model.properties, ["never on"]);
        assert_eq!(model.witness(0, &verdict), "1\nb0\n0\n0\n0\n.\n");
        let held = "aag 3 1 1 0 1 1 1\n2\n4 6\n4\n2\n6 3 5\ni0 hold\nl0 state\nc0 held\n";
        let (model, verdict) = decide(held);
        assert_eq!((&model.system.inputs[0][..], &model.system.registers[0].name[..]), ("hold", "state"));
        assert!(matches!(verdict, PropertyVerdict::Proved(_)), "{verdict:?}");
        assert_eq!(model.witness(0, &verdict), "0\nb0\n.\n");
    }

    #[test]
    fn outputs_of_old_files_are_bad_states() {
        let (model, verdict) = decide("aag 3 1 1 1 1\n2\n4 6\n4\n6 3 5\no0 on\n");
        assert!(model.are_outputs && model.properties == ["on"]);
        assert!(matches!(verdict, PropertyVerdict::Refuted(run) if run.inputs.len() == 2));
    }

    #[test]
    fn a_start_value_that_may_be_either_is_found() {
        let (model, verdict) = decide("aag 1 0 1 0 0 1\n2 2 2\n2\n");
        assert_eq!(model.witness(0, &verdict), "1\nb0\n1\n\n.\n");
    }

    #[test]
    fn what_is_no_property_of_finite_runs_is_refused() {
        let message = |text: &str| AigerModel::read(text.as_bytes()).unwrap_err().message;
        assert!(message("aag 1 1 0 0 0 0 0 1\n2\n1\n2\n").starts_with("justice properties are not supported"));
        assert!(message("aag 1 1 0 0 0 0 0 0 1\n2\n2\n").starts_with("fairness constraints are not supported"));
        assert!(message("aag 1 1 0 0 0\n2\n").starts_with("no properties"));
        let circuit = crate::formats::aiger::read(TURNS.as_bytes(), None).unwrap_err().message;
        assert!(circuit.contains("`nbc prove` reads them"), "{circuit}");
    }
}
