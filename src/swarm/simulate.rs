//! A swarm in full physics: every robot in its own simulation, hearing in each cycle what the others did in the cycle before.

use crate::model::{Body, Column, Pattern, Setting};
use crate::sim::{Flock, Simulator};
use crate::swarm::{Assembly, CycleTrace, Member, RobotTrace, Signal, SwarmTrace};

/// Samples of a robot's path that a trace keeps of each cycle.
const SAMPLES_PER_CYCLE: u32 = 12;
/// Ground voxels of a swarm's world where no more are needed.
const LEAST_WORLD: usize = 1 << 15;

/// What a swarm is exposed to, and how its motion is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exposure {
    /// The input ports' bits in each cycle.
    pub inputs: Vec<Vec<bool>>,
    /// Env steps in a cycle.
    pub cycle_steps: u32,
    /// Cycles over which a displacement is taken; its sign is the output. The paper's is one.
    pub window: usize,
}

/// The world of a swarm's robots for so many cycles: the paper's, with more ground.
///
/// In the paper's 500 voxels a robot that holds its output comes to the end of the ground within some hundred cycles and falls off it. No
/// robot walks its own width in a cycle, so there is ground for that much both ways, by powers of two so that most tests of a circuit
/// have the same world.
pub fn setting(assembly: &Assembly, cycles: usize) -> Setting {
    let widest = assembly.members.iter().map(|member| member.robot.body.width()).max().unwrap_or(0);
    let world_width = (2 * cycles * widest).next_power_of_two().max(LEAST_WORLD);
    Setting { world_width, ..Setting::default() }
}

/// Cycles in which robots find their feet after their fresh start. Their motion means nothing before the last of them is over, so that
/// the others hear their start values until then: a latch would else forget what it begins with (docs/physics.md 14).
pub const START_CYCLES: usize = 2;

/// Simulates a swarm in its [`setting`] through an exposure, calling `observe` with the number of finished cycles after each.
///
/// At the end of each cycle a robot outputs 1 if its center of mass moved in +x over the last `window` cycles, else 0; that bit is
/// the stimulus of the robots it feeds during the next cycle (paper, section 4), from the end of [`START_CYCLES`] on.
///
/// # Panics
/// When a cycle's inputs are not as many as the assembly's, or the window is empty.
pub fn simulate(
    simulator: &Simulator,
    assembly: &Assembly,
    exposure: &Exposure,
    observe: &mut dyn FnMut(usize),
) -> SwarmTrace {
    assert!(exposure.window > 0, "an output is read over one cycle at least");
    let bodies: Vec<Body> = assembly.members.iter().map(|member| member.robot.body.clone()).collect();
    let mut flock = simulator.flock(&setting(assembly, exposure.inputs.len()), &bodies);
    let bits_in: usize = assembly.inputs.iter().map(|port| port.width).sum();
    let mut trace = begin(assembly, &*flock);
    let mut heard: Vec<bool> = assembly.members.iter().map(|member| member.start).collect();
    for inputs in &exposure.inputs {
        assert_eq!(inputs.len(), bits_in, "a bit for each bit of the input ports");
        let sensed: Vec<[bool; 2]> =
            assembly.members.iter().map(|member| member.senses.map(|signal| read(signal, inputs, &heard))).collect();
        advance_cycle(&mut *flock, &sensed, exposure.cycle_steps, &mut trace.robots);
        let bits: Vec<bool> = trace.robots.iter().map(|robot| moved_right(robot, exposure.window)).collect();
        let outputs = assembly.shown.iter().map(|&signal| read(signal, inputs, &bits)).collect();
        if trace.cycles.len() + 1 >= START_CYCLES {
            heard.clone_from(&bits);
        }
        trace.cycles.push(CycleTrace { inputs: inputs.clone(), sensed, bits, outputs });
        observe(trace.cycles.len());
    }
    for (i, robot) in trace.robots.iter_mut().enumerate() {
        robot.fault = flock.fault(i);
    }
    trace
}

fn read(signal: Signal, inputs: &[bool], bits: &[bool]) -> bool {
    match signal {
        Signal::Input(i) => inputs[i],
        Signal::Robot(i) => bits[i],
        Signal::Constant(value) => value,
    }
}

/// The trace before the first cycle.
fn begin(assembly: &Assembly, flock: &dyn Flock) -> SwarmTrace {
    let inputs: Vec<String> = assembly.inputs.iter().flat_map(Column::bits).collect();
    let net_name = |signal| match signal {
        Signal::Input(i) => inputs[i].clone(),
        Signal::Robot(i) => assembly.members[i].net.clone(),
        Signal::Constant(value) => u8::from(value).to_string(),
    };
    let robot = |(i, member): (usize, &Member)| RobotTrace {
        net: member.net.clone(),
        function: member.robot.function(),
        robot: member.robot.name.clone(),
        senses: member.senses,
        sensed_nets: member.senses.map(net_name),
        com_x: vec![flock.center(i)[0]],
        fault: None,
    };
    SwarmTrace {
        circuit: assembly.circuit.clone(),
        inputs: assembly.inputs.clone(),
        outputs: assembly.outputs.clone(),
        shown: assembly.shown.clone(),
        samples_per_cycle: SAMPLES_PER_CYCLE as usize,
        robots: assembly.members.iter().enumerate().map(robot).collect(),
        cycles: Vec::new(),
    }
}

/// One cycle of all robots under what they sense, in as many parts as the trace keeps samples.
fn advance_cycle(flock: &mut dyn Flock, sensed: &[[bool; 2]], cycle_steps: u32, robots: &mut [RobotTrace]) {
    let patterns: Vec<Pattern> = sensed.iter().map(|bits| Pattern::new(bits)).collect();
    let steps_until = |sample: u32| cycle_steps * sample / SAMPLES_PER_CYCLE;
    for sample in 0..SAMPLES_PER_CYCLE {
        flock.advance(&patterns, steps_until(sample + 1) - steps_until(sample));
        for (i, robot) in robots.iter_mut().enumerate() {
            robot.com_x.push(flock.center(i)[0]);
        }
    }
}

/// Whether a robot moved in +x over its last `window` cycles, or over all of them while there are fewer.
fn moved_right(robot: &RobotTrace, window: usize) -> bool {
    let last = robot.com_x.len() - 1;
    let before = last.saturating_sub(window * SAMPLES_PER_CYCLE as usize);
    robot.com_x[last] > robot.com_x[before]
}
