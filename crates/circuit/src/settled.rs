//! What the outputs of a netlist are once nothing changes, for many rows of inputs one after the other: a netlist
//! without loops is computed for 64 rows at a time.

use crate::network::{Network, View};
use crate::passes::dissolve_wires;
use crate::{Logic, Netlist};

#[derive(Clone, Debug)]
pub struct Settled(Way);

#[derive(Clone, Debug)]
enum Way {
    /// No row depends on those before it.
    Words {
        network: Network,
        values: Vec<u64>,
    },
    Steps(Box<Logic>),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettledRow {
    pub outputs: Vec<bool>,
    pub rests: Vec<bool>,
    pub is_settled: bool,
}

impl Settled {
    pub const ROWS: usize = u64::BITS as usize;

    pub fn new(netlist: &Netlist) -> Self {
        let mut plain = netlist.clone();
        let view = dissolve_wires(&mut plain).ok().and_then(|()| View::of(&plain, &[]).ok());
        Self(match view {
            Some(View { network, .. }) => Way::Words { network, values: Vec::new() },
            None => Way::Steps(Box::new(Logic::new(netlist))),
        })
    }

    /// Whether a row may depend on those before it.
    pub fn has_state(&self) -> bool {
        matches!(self.0, Way::Steps(_))
    }

    pub fn apply(&mut self, rows: &[&[bool]]) -> Vec<SettledRow> {
        match &mut self.0 {
            Way::Words { network, values } => {
                assert!(rows.len() <= Self::ROWS, "a bit of a word for each row");
                let mut inputs = vec![0; network.inputs];
                for (at, row) in rows.iter().enumerate() {
                    assert_eq!(row.len(), network.inputs, "a value for each input");
                    inputs.iter_mut().zip(*row).for_each(|(word, &bit)| *word |= u64::from(bit) << at);
                }
                network.simulate_into(&inputs, values);
                let row = |at: usize| {
                    let bit = |&signal: &u32| values[signal as usize] >> at & 1 == 1;
                    let rests = vec![true; network.outputs.len()];
                    SettledRow { outputs: network.outputs.iter().map(bit).collect(), rests, is_settled: true }
                };
                (0..rows.len()).map(row).collect()
            }
            Way::Steps(logic) => rows.iter().map(|row| steps(logic, row)).collect(),
        }
    }
}

fn steps(logic: &mut Logic, row: &[bool]) -> SettledRow {
    match logic.settle(row) {
        Ok(outputs) => SettledRow { rests: vec![true; outputs.len()], outputs, is_settled: true },
        Err(_) => {
            let rests = logic.steady_outputs();
            SettledRow { outputs: logic.outputs(), rests, is_settled: false }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{full_adder, latch};

    fn rows(inputs: usize) -> Vec<Vec<bool>> {
        (0..150u32).map(|row| (0..inputs).map(|bit| (row * 37 + 11) >> bit & 1 == 1).collect()).collect()
    }

    #[test]
    fn rows_at_a_time_are_rows_one_after_the_other() {
        let mut wired = full_adder();
        let wire = wired.add_wire("w", Some(true), None);
        let sum = wired.pins(wired.outputs()[0])[0];
        wired.drive(wire, 0, sum);
        wired.add_output("again", wire);
        for (netlist, in_words) in [(full_adder(), true), (wired, true), (latch(), false)] {
            let mut settled = Settled::new(&netlist);
            assert_eq!(matches!(settled.0, Way::Words { .. }), in_words);
            let (rows, mut logic) = (rows(netlist.inputs().len()), Logic::new(&netlist));
            let rows: Vec<&[bool]> = rows.iter().map(Vec::as_slice).collect();
            let found: Vec<SettledRow> = rows.chunks(Settled::ROWS).flat_map(|block| settled.apply(block)).collect();
            let expected: Vec<SettledRow> = rows.iter().map(|row| steps(&mut logic, row)).collect();
            assert_eq!(found, expected);
        }
    }
}
