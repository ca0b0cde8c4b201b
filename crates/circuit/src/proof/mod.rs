//! Proof that a mapped netlist is equivalent to its source: exhaustively up to sixteen inputs, else gate by gate, else
//! by SAT.
//!
//! The source is taken as it was written, before any pass. It is cut open at its registers, and its loops at the cells
//! of their cores. Both keep their names in mapping, so the logic between them is compared state by state.

mod compare;
mod cuts;
mod method;
mod relation;
mod sat;
mod structural;

use std::collections::BTreeMap;

pub(crate) use compare::equal;
pub(crate) use cuts::state_names;
pub use method::Method;
pub(crate) use method::random_word;
pub(crate) use relation::Counterpart;
pub use sat::Comparison;
pub(crate) use sat::{Compared, SatSweep};

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
    prove_states([source, mapped], Known::default(), passes)
}

/// `counterparts` says what each register that was read is in the other netlist; if that is wrong, the proof fails.
pub(crate) fn prove_registers(
    read: &Netlist,
    made: &Netlist,
    counterparts: BTreeMap<NetId, Counterpart>,
) -> Result<Proof, ProofError> {
    same_ports(read, made)?;
    let registers = made.registers().map(|(id, _)| id).collect();
    prove_states([read, made], Known { counterparts, registers }, passes::ORDER)
}

/// What is known of registers before their names are compared.
#[derive(Default)]
struct Known {
    counterparts: BTreeMap<NetId, Counterpart>,
    /// The registers of the result, as counterparts count them.
    registers: Vec<NetId>,
}

fn prove_states([source, mapped]: [&Netlist; 2], known: Known, passes: &[Pass]) -> Result<Proof, ProofError> {
    passes::check_drivers(source)?;
    passes::check_drivers(mapped)?;
    let mut found = cuts::cuts(source, passes)?;
    // Known registers are counted as those that know them do.
    let order: BTreeMap<NetId, usize> = known.counterparts.keys().enumerate().map(|(at, &net)| (net, at)).collect();
    found.sort_by_key(|cut| order.get(&cut.net).copied().unwrap_or(usize::MAX));
    let states = mapped.cells().map(|(id, cell)| (id, &cell.name));
    let states = states.chain(mapped.registers().map(|(id, register)| (id, &register.name)));
    let named: BTreeMap<&str, NetId> = states.filter_map(|(id, name)| Some((name.as_deref()?, id))).collect();
    let mut names: Vec<String> = Vec::new();
    let mut places: BTreeMap<NetId, usize> = (0..).zip(&known.registers).map(|(at, &net)| (net, at)).collect();
    let mut others = known.registers.clone();
    let mut lost: BTreeMap<NetId, usize> = BTreeMap::new();
    let mut counterparts = Vec::new();
    for (at, cut) in found.iter().enumerate() {
        if let Some(&counterpart) = known.counterparts.get(&cut.net) {
            counterparts.push(counterpart);
            continue;
        }
        let is_register = source.register(cut.net).is_some();
        let is_same = |&net: &NetId| mapped.register(net).is_some() == is_register;
        let same = cut.name.as_ref().and_then(|name| Some((name, named.get(name.as_str()).copied().filter(is_same)?)));
        counterparts.push(match (same, lost.get(&cut.merged)) {
            (Some((name, net)), _) => Counterpart::Same(*places.entry(net).or_insert_with(|| {
                names.push(name.clone());
                others.push(net);
                others.len() - 1
            })),
            (None, Some(&first)) => Counterpart::Like(first),
            (None, None) => {
                lost.insert(cut.merged, at);
                Counterpart::Unused
            }
        });
    }
    let reference = Side { logic: source, states: found.iter().map(|cut| cut.net).collect() };
    let result = Side { logic: mapped, states: others };
    let method = StateRelation { reference, result, counterparts }.prove()?;
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
