//! Traces and netlists that are written by hand, for pictures and pages.

use nbc_base::model::{Column, Function, Pattern};
use nbc_circuit::{Cell, Netlist};
use nbc_swarm::{CycleTrace, Recording, RobotTrace, StimulusSource, SwarmTrace};

pub fn port(name: &str) -> Column {
    Column::new(name, 1)
}

/// A latch of five artificial robots: each walks half a voxel per cycle in the direction of its bit.
pub fn latch(rows: &[(bool, bool)], hold: usize) -> SwarmTrace {
    let names = ["n1", "q", "n3", "not_d", "nq"];
    let senses = [
        [StimulusSource::Input(0), StimulusSource::Input(1)],
        [StimulusSource::Robot(0), StimulusSource::Robot(4)],
        [StimulusSource::Robot(3), StimulusSource::Input(1)],
        [StimulusSource::Input(0), StimulusSource::Constant(false)],
        [StimulusSource::Robot(2), StimulusSource::Robot(1)],
    ];
    let functions = [Function::NAND, Function::NAND, Function::NAND, Function::NOT, Function::NAND];
    let mut bits = vec![false; 5];
    let mut paths = vec![vec![250.0]; 5];
    let mut cycles = Vec::new();
    for &(d, e) in rows.iter().flat_map(|row| std::iter::repeat_n(row, hold)) {
        let value = |signal: StimulusSource| match signal {
            StimulusSource::Input(i) => [d, e][i],
            StimulusSource::Robot(k) => bits[k],
            StimulusSource::Constant(value) => value,
        };
        let sensed: Vec<Pattern> = senses.iter().map(|pair| Pattern::new(&pair.map(value))).collect();
        bits = functions.iter().zip(&sensed).map(|(function, &sensed)| function.under(sensed)).collect();
        for (path, &bit) in paths.iter_mut().zip(&bits) {
            let last = path[path.len() - 1];
            path.extend((1..=4).map(|i| last + if bit { 0.125 } else { -0.125 } * f64::from(i)));
        }
        cycles.push(CycleTrace { inputs: vec![d, e], sensed, outputs: vec![bits[1], bits[4]], bits: bits.clone() });
    }
    let net = |signal: StimulusSource| match signal {
        StimulusSource::Input(i) => ["d", "e"][i].to_owned(),
        StimulusSource::Robot(k) => names[k].to_owned(),
        StimulusSource::Constant(value) => u8::from(value).to_string(),
    };
    let robots = (0..5).map(|k| RobotTrace {
        net: names[k].to_owned(),
        block: Vec::new(),
        function: functions[k],
        robot: format!("{}_1", functions[k]),
        senses: senses[k].to_vec(),
        sensed_nets: senses[k].map(net).to_vec(),
        com_x: paths[k].clone(),
        fault: None,
    });
    SwarmTrace {
        circuit: "d_latch".to_owned(),
        inputs: ["d", "e"].map(port).into(),
        outputs: ["q", "nq"].map(port).into(),
        shown: vec![StimulusSource::Robot(1), StimulusSource::Robot(4)],
        samples_per_cycle: 4,
        robots: robots.collect(),
        cycles,
        flips: Vec::new(),
        recording: Recording::default(),
    }
}

/// A made-up swarm of 200 robots over 1,000 cycles; all nets but the latch's are unnamed.
pub fn large() -> SwarmTrace {
    let mut trace = latch(&[(true, true), (false, true)], 500);
    for k in 5..200 {
        let robot = RobotTrace { net: format!("n{}", 1000 + k), ..trace.robots[k % 5].clone() };
        trace.robots.push(robot);
        for cycle in &mut trace.cycles {
            cycle.sensed.push(cycle.sensed[k % 5]);
            cycle.bits.push(cycle.bits[k % 5]);
        }
    }
    trace
}

pub fn latch_netlist() -> Netlist {
    let mut netlist = Netlist::new("d_latch");
    let [d, e] = ["d", "e"].map(|name| netlist.add_input(name));
    let named = |name: &str, function| Cell { function, name: Some(name.to_owned()), start: None, span: None };
    let set = netlist.add_cell(named("set", Function::NAND), &[d, e]);
    let not_d = netlist.add_cell(named("not_d", Function::NOT), &[d]);
    let reset = netlist.add_cell(named("reset", Function::NAND), &[not_d, e]);
    let q = netlist.add_cell(named("q", Function::NAND), &[set, set]);
    let nq = netlist.add_cell(named("nq", Function::NAND), &[reset, q]);
    netlist.drive(q, 1, nq);
    netlist.add_output("q", q);
    netlist.add_output("nq", nq);
    netlist
}
