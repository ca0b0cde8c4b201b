//! From a mapped netlist and a library to a swarm: a robot for each cell, and the sources of its stimuli.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::cells::choose;
use crate::noise::RobotNoise;
use nbc_base::model::{Body, Column, Library, PhysicsWorld, Robot, Setting};
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{Logic, NetId, Netlist, Node};
use nbc_sim::{Flock, Simulator};

/// The source of a stimulus or of an output port's bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum StimulusSource {
    /// A bit of the input ports, by its place among their bits.
    Input(usize),
    /// A member's output in the cycle before, by its place among the members.
    Robot(usize),
    Constant(bool),
}

impl StimulusSource {
    /// Its bit among the bits of the inputs and the outputs of the robots, which may be unknown ones.
    pub(crate) fn bit<T: Copy + From<bool>>(self, inputs: &[bool], outputs: &[T]) -> T {
        match self {
            Self::Input(i) => inputs[i].into(),
            Self::Robot(i) => outputs[i],
            Self::Constant(value) => value.into(),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// The net it drives.
    pub net: String,
    /// The names of the calls that it comes from, the outermost first.
    pub block: Vec<String>,
    pub robot: Robot,
    pub senses: Vec<StimulusSource>,
    pub start: bool,
    /// What it senses in the first cycles instead of each source; empty in swarms that are no wave machines.
    pub held: Vec<Vec<bool>>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    pub circuit: String,
    pub inputs: Vec<Column>,
    pub members: Vec<Member>,
    pub outputs: Vec<Column>,
    pub shown: Vec<StimulusSource>,
    /// Cycles for which robots sense the same; more than one only in wave machines.
    pub beat: u32,
    /// The world in which it is simulated; its members have the bodies that they have there.
    pub world: PhysicsWorld,
}

/// The fewest cycles in which robots settle into their shape after their fresh start, at the beginning of a cycle.
const LEAST_START: usize = 2;

/// The least ground of a swarm, in voxels.
const LEAST_GROUND: usize = 1 << 15;

impl Assembly {
    /// Cycles in which robots settle into their shape after their fresh start, and in which the slowest of them reacts
    /// once. Their motion is ignored until the last of them is over, and the others sense their start values until
    /// then; otherwise a latch would lose its start value (docs/physics.md 14).
    pub fn start_cycles(&self) -> usize {
        let clocks = self.members.iter().map(|member| member.robot.character.clock);
        start_cycles(clocks).max(LEAST_START + usize::from(self.world.lateness() > 0))
    }

    /// The same swarm in a world, in which its members may have weak or dead voxels.
    pub fn in_world(mut self, world: PhysicsWorld) -> Self {
        for (i, member) in self.members.iter_mut().enumerate() {
            member.robot.body = RobotNoise::new(&world.noise, i).worn(&member.robot.body);
        }
        Self { world, ..self }
    }

    /// Its ground and physics for this many cycles.
    ///
    /// In the paper's 500 voxels, a robot that holds its output reaches the end of the ground within some hundred
    /// cycles and falls off. No robot walks its own width in a cycle, so there is ground for that distance both ways,
    /// rounded to powers of two so that most tests of a circuit have the same ground.
    pub fn setting(&self, cycles: usize) -> Setting {
        let widest = self.members.iter().map(|member| member.robot.body.width()).max().unwrap_or(0);
        let world_width = (2 * cycles * widest).next_power_of_two().max(LEAST_GROUND);
        let ground = self.world.ground.on(world_width);
        Setting { world_width, factors: self.world.factors, ground, ..Setting::default() }
    }

    /// The name of the net that a source drives, such as `a[3]`; a constant's is its value.
    pub fn source_name(&self, source: StimulusSource) -> String {
        match source {
            StimulusSource::Input(i) => self.inputs.iter().flat_map(Column::bits).nth(i).unwrap_or_default(),
            StimulusSource::Robot(i) => self.members[i].net.clone(),
            StimulusSource::Constant(value) => u8::from(value).to_string(),
        }
    }

    pub fn flock(&self, simulator: &Simulator, cycles: usize) -> Box<dyn Flock> {
        let bodies: Vec<Body> = self.members.iter().map(|member| member.robot.body.clone()).collect();
        let setting = self.setting(cycles);
        let mut flock = simulator.flock(&setting, &bodies);
        if self.world.noise.start > 0.0 {
            for (i, body) in bodies.iter().enumerate() {
                let shift = RobotNoise::new(&self.world.noise, i).shift();
                let up = Setting { shift, ..setting }.start(body.width())[1] - setting.start(body.width())[1];
                flock.shift(i, [shift, up]);
            }
        }
        flock
    }
}

/// [`Assembly::start_cycles`] for these clocks.
pub(super) fn start_cycles(clocks: impl IntoIterator<Item = u32>) -> usize {
    clocks.into_iter().map(|clock| clock as usize).max().unwrap_or(0).max(LEAST_START)
}

/// Chooses a robot for each cell of a netlist of ports, constants and cells, and wires the robots as the cells are
/// wired.
///
/// A cell is assigned the first robot of the library that computes its function, or else one that computes it with its
/// inputs in another order, or else one of three stimuli that computes it while some of them are constant. A cell of
/// one input is connected to the stimulus that its robot depends on; the other stimulus stays absent. Robots without a
/// start value start as if the circuit had settled with all inputs 0. Otherwise both robots of a memory element would
/// be driven, and could keep switching each other forever.
/// Panics when the netlist still has wires, which `dissolve-wires` takes out, or was not mapped onto this library.
pub fn assemble(netlist: &Netlist, library: &Library) -> Assembly {
    let signals = number_signals(netlist);
    let before = Logic::new(netlist);
    let mut members = Vec::new();
    for (id, cell) in netlist.cells() {
        let pins: Vec<StimulusSource> = netlist.pins(id).into_iter().map(|net| signals[&net]).collect();
        let fit = choose(library, cell.function).expect("the netlist was mapped onto this library");
        let senses = fit.stimuli(&pins, StimulusSource::Constant);
        let blocks = netlist.blocks();
        let block = blocks.around(netlist.block(id)).into_iter().map(|block| blocks.name(block).to_owned()).collect();
        let (net, start, held) = (netlist.net_name(id), before.value(id), vec![Vec::new(); senses.len()]);
        members.push(Member { net, block, robot: fit.robot.clone(), senses, start, held });
    }
    Assembly {
        circuit: netlist.name.clone(),
        inputs: ports(netlist, netlist.inputs()),
        members,
        outputs: ports(netlist, netlist.outputs()),
        shown: netlist.outputs().iter().map(|&id| signals[&netlist.pins(id)[0]]).collect(),
        beat: 1,
        world: PhysicsWorld::default(),
    }
}

/// The swarm of a wave machine: as [`assemble`], with what the pins that read state sense at first.
pub fn assemble_waves(machine: &WaveMachine, library: &Library) -> Assembly {
    let mut assembly = assemble(&machine.netlist, library);
    assembly.beat = machine.beat;
    for ((id, cell), member) in machine.netlist.cells().zip(&mut assembly.members) {
        let pins = (0..).zip(machine.netlist.pins(id)).map(|(pin, _)| machine.held_bits(id, pin)).collect::<Vec<_>>();
        let fit = choose(library, cell.function).expect("the cell has a robot");
        member.held = fit.stimuli(&pins, |_| Vec::new());
    }
    assembly
}

fn ports(netlist: &Netlist, bits: &[NetId]) -> Vec<Column> {
    let names: Vec<String> = bits.iter().map(|&id| netlist.net_name(id)).collect();
    Column::group(&names)
}

/// The signal of each net: inputs and robots are numbered in the netlist's order.
fn number_signals(netlist: &Netlist) -> BTreeMap<NetId, StimulusSource> {
    let mut signals: BTreeMap<NetId, StimulusSource> =
        netlist.inputs().iter().enumerate().map(|(i, &id)| (id, StimulusSource::Input(i))).collect();
    let mut robots = 0;
    for id in netlist.ids() {
        match netlist.node(id) {
            Node::Constant(value) => {
                signals.insert(id, StimulusSource::Constant(*value));
            }
            Node::Cell(_) => {
                signals.insert(id, StimulusSource::Robot(robots));
                robots += 1;
            }
            Node::Input(_) | Node::Output(_) => {}
            Node::Wire { name, .. } => panic!("wire `{name}` should have been dissolved before assembly"),
            Node::Register(_) => panic!("the registers of `{}` should be cells before assembly", netlist.name),
        }
    }
    signals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PlainMember;
    use nbc_base::model::{Body, Function};

    fn robot(function: Function) -> Robot {
        let body = Body::parse(&["33"], &nbc_base::model::Palette::paper()).unwrap();
        let plain = PlainMember {
            body,
            clock: 1,
            senses: vec![StimulusSource::Constant(false); function.inputs()],
            start: false,
            held: vec![Vec::new(); function.inputs()],
        };
        Robot { name: function.name().to_owned(), behavior: function.into(), ..plain.nameless().robot }
    }

    #[test]
    fn a_cell_gets_the_first_robot_that_computes_it_with_its_inputs_in_any_order() {
        let input = StimulusSource::Input;
        let check = |function: Function, robots: &[Function], name: &str, senses: [StimulusSource; 2]| {
            let mut netlist = Netlist::new("one");
            let pins: Vec<_> = (0..function.arity()).map(|i| netlist.add_input(format!("i{i}"))).collect();
            let gate = netlist.add_gate(function, &pins);
            netlist.add_output("y", gate);
            let library = Library { robots: robots.iter().copied().map(robot).collect() };
            let assembly = assemble(&netlist, &library);
            assert_eq!(assembly.outputs, [Column::new("y", 1)]);
            assert_eq!(assembly.shown, [StimulusSource::Robot(0)]);
            assert_eq!((assembly.members[0].robot.name.as_str(), &assembly.members[0].senses[..]), (name, &senses[..]));
        };
        check(Function::NAND, &[Function::AND, Function::NAND], "nand", [input(0), input(1)]);
        check(Function::new(0b0100), &[Function::new(0b0010)], "nota_and_b", [input(1), input(0)]);
        // An inverter reads the stimulus that its robot depends on.
        check(Function::NOT, &[Function::NOT], "not", [input(0), StimulusSource::Constant(false)]);
        check(Function::NOT, &[Function::NOT_B], "notb", [StimulusSource::Constant(false), input(0)]);
    }
}
