//! Proof that a mapped netlist is equivalent to its source: exhaustively up to sixteen inputs, else gate by gate, else
//! by SAT.
//!
//! Loops are cut open at the cells of their cores, which keep their names in mapping; so a state's next-state function
//! is compared cell by cell.

mod exhaustive;
mod method;
mod patterns;
mod sat;
mod structural;

use std::collections::{BTreeMap, BTreeSet};

pub use method::Method;
pub use patterns::random_word;
pub use sat::Comparison;
pub(crate) use sat::SatSweep;

use crate::loops::Loops;
use crate::network::{Network, View};
use crate::{NetId, Netlist, Node, ProofError, passes};

/// The most inputs, cuts included, for which every pattern is simulated.
pub(crate) const EXHAUSTIVE_INPUTS: usize = 16;

/// A netlist proved equal to its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The method that proved it.
    pub method: Method,
    /// The nets at which loops were cut open.
    pub cuts: Vec<String>,
}

/// Proves a mapped netlist equal to its source.
///
/// # Errors
/// The first difference that is found.
pub fn prove(source: &Netlist, mapped: &Netlist) -> Result<Proof, ProofError> {
    let mut source = source.clone();
    passes::run(&mut source)?;
    same_ports(&source, mapped)?;
    let names = core_names(&source, &Loops::memory(&source));
    let named: BTreeMap<_, _> = mapped.cells().filter_map(|(id, cell)| Some((cell.name.clone()?, id))).collect();
    let namesake = |name: &String| named.get(name).copied().ok_or_else(|| ProofError::MissingCut(name.clone()));
    let cuts: Vec<_> = names.keys().copied().collect();
    let mapped_cuts = names.values().map(namesake).collect::<Result<Vec<_>, _>>()?;
    let new_loop = |netlist: &Netlist, id| ProofError::NewLoop(netlist.net_name(id));
    let one = View::of(&source, &cuts).map_err(|id| new_loop(&source, id))?.network;
    let two = View::of(mapped, &mapped_cuts).map_err(|id| new_loop(mapped, id))?.network;
    let method = equal(&one, &two).map_err(|(output, values)| {
        let label = |ids: &[NetId]| ids.iter().map(|&id| source.net_name(id)).chain(names.values().cloned()).collect();
        let (inputs, outputs): (Vec<String>, Vec<String>) = (label(source.inputs()), label(source.outputs()));
        ProofError::Different { output: outputs[output].clone(), inputs: inputs.into_iter().zip(values).collect() }
    })?;
    Ok(Proof { method, cuts: names.into_values().collect() })
}

/// Compares two networks of the same inputs and outputs; fails with an output and the inputs at which it differs.
///
/// # Errors
/// The output and the pattern.
pub fn equal(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
    assert!(one.inputs == two.inputs && one.outputs.len() == two.outputs.len(), "networks of the same ports");
    match one.inputs <= EXHAUSTIVE_INPUTS {
        true => exhaustive::equal(one, two),
        false if structural::equal(one, two) => Ok(Method::Structural),
        false => sat::equal(one, two),
    }
}

fn same_ports(source: &Netlist, mapped: &Netlist) -> Result<(), ProofError> {
    for (one, two) in [(source.inputs(), mapped.inputs()), (source.outputs(), mapped.outputs())] {
        for i in 0..one.len().max(two.len()) {
            let name = |netlist: &Netlist, ids: &[NetId]| ids.get(i).map(|&id| netlist.net_name(id));
            let (one, two) = (name(source, one), name(mapped, two));
            if one != two {
                return Err(ProofError::Port(one.or(two).expect("one of them has this port")));
            }
        }
    }
    Ok(())
}

/// A unique name for each cell of a loop core: that of its net, with a number if two cells share one.
pub(crate) fn core_names(netlist: &Netlist, loops: &Loops) -> BTreeMap<NetId, String> {
    let mut taken = BTreeSet::new();
    let cells = netlist.ids().filter(|&id| loops.contains(id) && matches!(netlist.node(id), Node::Cell(_)));
    cells
        .map(|id| {
            let name = netlist.net_name(id);
            let numbered = (2..).map(|i| format!("{name}_{i}"));
            let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
            let free = free.expect("there are more numbers than cells");
            taken.insert(free.clone());
            (id, free)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::CellLibrary;
    use crate::example::{full_adder, latch};
    use crate::map::map;
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
