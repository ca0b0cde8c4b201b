//! A design as a circuit of a program: its nets have names of the language, and its netlist is the body.

use std::collections::BTreeMap;

use crate::formats::Design;
use crate::formats::nb_names::{NamedNet, NbNames, word};
use crate::{Loops, NetId, Node};
use nbc_base::model::{BitDriver, Block, Circuit, DrivenBit, Forcing, Function, Net, Size, SizeId, SizeKind};
use nbc_base::source::{FileId, Span};

/// Writes its names at the end of `text`, the text of `file`, where their places are.
pub fn circuit(design: &Design, file: FileId, text: &mut String) -> Circuit {
    let mut place = |before: &str, name: &str| {
        text.push_str(before);
        let start = text.len();
        text.push_str(name);
        Span::new(file, start, text.len())
    };
    let names = NbNames::new(design);
    let name = word(&design.netlist.name);
    let span = place("circuit ", &name);
    let (mut nets, mut sizes) = (Vec::new(), Vec::new());
    let inner = [&names.states, &names.nexts, &names.others].map(|nets| ("\n    net ", nets));
    let ports = [("(", &names.inputs), (") -> (", &names.outputs)];
    for (at, (mut before, named)) in ports.into_iter().chain(inner).enumerate() {
        for net in named {
            let declared = place(before, &net.declared());
            let span = Span { end: declared.start + net.name.len() as u32, ..declared };
            sizes.push(Size { kind: SizeKind::Literal(net.bits.len() as i128), span });
            let width = Some(SizeId(sizes.len() as u32 - 1));
            let (words, default, members, selects) = (None, None, None, None);
            nets.push(Net { name: net.name.clone(), span, width, words, default, members, selects, is_text: false });
            before = ", ";
        }
        if at == 1 {
            place(")", "");
        }
    }
    place("\n", "");
    let count = nets.len() as u32;
    Circuit {
        name,
        span,
        parameters: Vec::new(),
        nets,
        inputs: names.inputs.len(),
        outputs: names.outputs.len(),
        sizes,
        expressions: Vec::new(),
        tables: Vec::new(),
        body: Block { nets: 0..count, statements: Vec::new() },
        variables: 0,
        memories: Vec::new(),
        bits: bits(design, &names),
    }
}

fn bits(design: &Design, names: &NbNames) -> Vec<DrivenBit> {
    let netlist = &design.netlist;
    let nets = |nets: &[NamedNet]| nets.iter().flat_map(|net| net.bits.clone()).collect::<Vec<_>>();
    let inputs = nets(&names.inputs);
    let driven = [&names.outputs, &names.states, &names.nexts, &names.others].map(|named| nets(named)).concat();
    let numbers: BTreeMap<NetId, u32> = inputs.iter().chain(&driven).copied().zip(DrivenBit::CONSTANTS..).collect();
    let number = |id: NetId| match netlist.node(id) {
        Node::Constant(value) => u32::from(*value),
        _ => numbers[names.stand_ins.get(&id).unwrap_or(&id)],
    };
    let loops = Loops::of(netlist);
    let stands_for: BTreeMap<NetId, NetId> = names.stand_ins.iter().map(|(&id, &output)| (output, id)).collect();
    let bit = |&shown: &NetId| {
        let id = *stands_for.get(&shown).unwrap_or(&shown);
        let pins: Vec<u32> = netlist.pins(id).into_iter().map(number).collect();
        match netlist.node(id) {
            Node::Cell(cell) => {
                let start = cell.start.filter(|_| loops.contains(id));
                let [a, b] = [pins[0], *pins.last().unwrap_or(&0)];
                let driver = match cell.function {
                    Function::ZERO => BitDriver::Bit(0),
                    Function::ONE => BitDriver::Bit(1),
                    Function::BUF => BitDriver::Bit(a),
                    Function::BUF_B => BitDriver::Bit(b),
                    Function::NOT => BitDriver::Gate(Function::NOT, [a; 2]),
                    Function::NOT_B => BitDriver::Gate(Function::NOT, [b; 2]),
                    function => BitDriver::Gate(function, [a, b]),
                };
                DrivenBit { driver, start }
            }
            Node::Register(register) => {
                let pins = match register.forcing {
                    Forcing::Never => [pins[0], pins[1], 0, 0],
                    Forcing::ToStart => [pins[0], pins[1], 0, pins[2]],
                    Forcing::SetReset => [pins[0], pins[1], pins[2], pins[3]],
                };
                let driver = BitDriver::Register(register.kind, register.forcing, pins);
                DrivenBit { driver, start: Some(register.starts_at()) }
            }
            Node::Wire { start, .. } => DrivenBit { driver: BitDriver::Bit(pins[0]), start: *start },
            _ => DrivenBit { driver: BitDriver::Bit(pins[0]), start: None },
        }
    };
    driven.iter().map(bit).collect()
}
