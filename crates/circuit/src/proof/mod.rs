//! Proof that a mapped netlist is equivalent to its source: exhaustively up to sixteen inputs, else gate by gate, else
//! by SAT.
//!
//! The source is taken as it was written, before any pass. Loops are cut open at the cells of their cores, which keep
//! their names in mapping; so a state's next-state function is compared cell by cell.

mod compare;
mod cuts;
mod method;
mod relation;
mod sat;
mod structural;

use std::collections::BTreeMap;

pub(crate) use compare::equal;
pub(crate) use cuts::core_names;
pub use method::Method;
pub(crate) use method::random_word;
pub(crate) use relation::Counterpart;
pub use sat::Comparison;
pub(crate) use sat::{Compared, SatSweep};

use crate::formats::{Design, Register};
use crate::passes::{self, Pass};
use crate::proof::relation::{Side, StateRelation};
use crate::{NetId, Netlist, ProofError};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    pub method: Method,
    pub cuts: Vec<String>,
}

pub fn prove(source: &Netlist, mapped: &Netlist) -> Result<Proof, ProofError> {
    prove_through(source, mapped, passes::ORDER)
}

/// As [`prove`]. These passes of the mapping only say which cell of a loop has become which.
fn prove_through(source: &Netlist, mapped: &Netlist, passes: &[Pass]) -> Result<Proof, ProofError> {
    same_ports(source, mapped)?;
    prove_states([source, mapped], [&[], &[]], Vec::new(), passes)
}

/// `counterparts` says what each register that was read is in the other design; if that is wrong, the proof fails.
pub(crate) fn prove_design(read: &Design, made: &Design, counterparts: Vec<Counterpart>) -> Result<Proof, ProofError> {
    let ports = |design: &Design| {
        let names = |ids: &[NetId]| ids.iter().map(|&id| design.logic.net_name(id)).collect::<Vec<_>>();
        (names(&design.logic.inputs()[..design.inputs()]), names(&design.logic.outputs()[..design.outputs()]))
    };
    let ((inputs, outputs), (others, other_outputs)) = (ports(read), ports(made));
    same_names(inputs.iter().chain(&outputs), others.iter().chain(&other_outputs))?;
    prove_states([&read.logic, &made.logic], [&read.registers, &made.registers], counterparts, passes::ORDER)
}

fn prove_states(
    [source, mapped]: [&Netlist; 2],
    registers: [&[Register]; 2],
    counterparts: Vec<Counterpart>,
    passes: &[Pass],
) -> Result<Proof, ProofError> {
    passes::check_drivers(source)?;
    let found = cuts::cuts(source, passes)?;
    let named: BTreeMap<_, _> = mapped.cells().filter_map(|(id, cell)| Some((cell.name.clone()?, id))).collect();
    let mut names: Vec<String> = Vec::new();
    let mut places: BTreeMap<&String, usize> = BTreeMap::new();
    let mut lost: BTreeMap<NetId, usize> = BTreeMap::new();
    let mut cuts = Vec::new();
    for cut in &found {
        let name = cut.name.as_ref().filter(|&name| named.contains_key(name));
        cuts.push(match (name, lost.get(&cut.merged)) {
            (Some(name), _) => Counterpart::Same(*places.entry(name).or_insert_with(|| {
                names.push(name.clone());
                registers[1].len() + names.len() - 1
            })),
            (None, Some(&first)) => Counterpart::Like(first),
            (None, None) => {
                lost.insert(cut.merged, registers[0].len() + cuts.len());
                Counterpart::Unused
            }
        });
    }
    let mapped_cuts = names.iter().map(|name| named[name]).collect();
    let reference = Side { logic: source, registers: registers[0], cuts: found.iter().map(|cut| cut.cell).collect() };
    let result = Side { logic: mapped, registers: registers[1], cuts: mapped_cuts };
    let method = StateRelation { reference, result, registers: counterparts, cuts }.prove()?;
    Ok(Proof { method, cuts: names })
}

fn same_ports(source: &Netlist, mapped: &Netlist) -> Result<(), ProofError> {
    for (one, two) in [(source.inputs(), mapped.inputs()), (source.outputs(), mapped.outputs())] {
        let [one, two] = [(source, one), (mapped, two)]
            .map(|(netlist, ids)| ids.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>());
        same_names(one.iter(), two.iter())?;
    }
    Ok(())
}

fn same_names<'n>(
    mut one: impl Iterator<Item = &'n String>,
    mut two: impl Iterator<Item = &'n String>,
) -> Result<(), ProofError> {
    loop {
        match (one.next(), two.next()) {
            (None, None) => return Ok(()),
            (one, two) if one != two => return Err(ProofError::Port(one.or(two).cloned().unwrap_or_default())),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::CellLibrary;
    use crate::example::{full_adder, latch};
    use crate::map::map;
    use crate::passes::dissolve_wires;
    use crate::{Logic, Node};
    use nbc_base::model::Function;

    #[test]
    fn mapped_circuits_are_proved() {
        for cells in [vec![Function::NAND], vec![Function::XOR, Function::AND], Function::all().collect()] {
            let library = CellLibrary::uniform(cells);
            let proof = prove(&full_adder(), &map(&full_adder(), &library).unwrap()).unwrap();
            assert_eq!(proof, Proof { method: Method::Exhaustive { patterns: 8 }, cuts: vec![] });
            let proof = prove(&latch(), &map(&latch(), &library).unwrap()).unwrap();
            assert_eq!(proof.cuts, ["q", "nq"]);
        }
    }

    #[test]
    fn a_wrong_cell_is_found_with_a_counterexample() {
        let mut wrong = full_adder();
        let (id, _) = wrong.cells().find(|(_, cell)| cell.function == Function::OR).unwrap();
        if let Node::Cell(cell) = wrong.node_mut(id) {
            cell.function = Function::NOR;
        }
        let error = prove(&full_adder(), &wrong).unwrap_err();
        assert_eq!(error.to_string(), "`carry` differs at a=0 b=0 cin=0");
    }

    fn invert_a_cell(netlist: &mut Netlist) -> Result<(), crate::NetlistError> {
        let found = netlist.cells().map(|(id, _)| id).next();
        if let Some(cell) = found.and_then(|id| netlist.cell_mut(id)) {
            cell.function = cell.function.inverted();
        }
        Ok(())
    }

    #[test]
    fn a_wrong_pass_is_found_though_the_proof_knows_it() {
        let wrong = Pass { name: "wrong", about: "inverts a cell", run: invert_a_cell, merged: |_| Vec::new() };
        let passes: Vec<Pass> = passes::ORDER.iter().copied().chain([wrong]).collect();
        for source in [full_adder(), latch()] {
            let made = |passes: &[Pass]| {
                let mut made = source.clone();
                passes.iter().for_each(|pass| (pass.run)(&mut made).unwrap());
                made
            };
            assert!(prove_through(&source, &made(passes::ORDER), &passes).is_ok());
            let found = prove_through(&source, &made(&passes), &passes);
            assert!(matches!(found, Err(ProofError::Different { .. })), "{found:?}");
        }
    }

    fn started_otherwise(netlist: &Netlist, name: &str) -> Netlist {
        let mut other = netlist.clone();
        let (id, _) = netlist.cells().find(|(_, cell)| cell.name.as_deref() == Some(name)).unwrap();
        let start = Logic::new(netlist).value(id);
        other.cell_mut(id).unwrap().start = Some(!start);
        other
    }

    #[test]
    fn another_start_is_found_though_the_source_leaves_it_to_the_other_cell() {
        let mut source = latch();
        dissolve_wires(&mut source).unwrap();
        for without in ["", "q", "nq"] {
            let mut source = source.clone();
            let found = source.cells().find(|(_, cell)| cell.name.as_deref() == Some(without)).map(|(id, _)| id);
            if let Some(id) = found {
                source.cell_mut(id).unwrap().start = None;
            }
            let mapped = map(&source, &CellLibrary::uniform([Function::NAND])).unwrap();
            assert!(prove(&source, &mapped).is_ok());
            for name in ["q", "nq"] {
                let found = prove(&source, &started_otherwise(&mapped, name));
                assert!(matches!(found, Err(ProofError::Start(_))), "{name} without {without}: {found:?}");
            }
        }
    }

    #[test]
    fn a_loop_that_the_result_does_without_must_not_matter() {
        let mut source = latch();
        dissolve_wires(&mut source).unwrap();
        let stored = source.outputs()[0];
        let constant = source.add_constant(false);
        let mut shown = source.clone();
        for at in 0..2 {
            let output = source.outputs()[at];
            source.drive(output, 0, constant);
        }
        let mut without = source.clone();
        crate::passes::sweep(&mut without);
        assert!(without.cells().next().is_none(), "{without}");
        assert!(prove(&source, &without).is_ok());
        shown.drive(stored, 0, constant);
        assert!(matches!(prove(&shown, &without), Err(ProofError::Different { .. })));
    }

    #[test]
    fn a_wrong_loop_is_found() {
        let mut source = latch();
        passes::run(&mut source).unwrap();
        let mut wrong = source.clone();
        let (id, _) = wrong.cells().find(|(_, cell)| cell.name.as_deref() == Some("q")).unwrap();
        if let Node::Cell(cell) = wrong.node_mut(id) {
            cell.function = Function::AND;
        }
        assert!(prove(&source, &source).is_ok());
        assert!(matches!(prove(&source, &wrong), Err(ProofError::Different { output, .. }) if output == "q"));
        assert!(matches!(prove(&latch(), &full_adder()), Err(ProofError::Port(_))));
    }
}
