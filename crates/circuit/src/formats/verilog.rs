//! Structural Verilog: an `assign` a cell, an `always` block a register.
//!
//! The cells that stay as written (docs/timing.md, "What stays as written") are instances of modules, which other
//! tools do not dissolve. An attribute of the instance is the start value of a cell on a loop.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use crate::formats::names::{FileNames, cells_in_order, free, stand_ins, starts, visible};
use crate::formats::verilog_ports::{VerilogPorts, escaped, plain};
use crate::formats::{Design, Forcing, RegisterKind};
use crate::guarded::Guarded;
use crate::{NetId, Netlist, Node, RegisterNode};
use nbc_base::model::Function;

pub fn write(design: &Design) -> String {
    let mut writer = Writer::new(design);
    let mut text = writer.head();
    writer.declarations(&mut text);
    for id in cells_in_order(&design.netlist) {
        writer.cell(&mut text, id);
    }
    writer.outputs(&mut text);
    writer.registers(&mut text);
    text.push_str("endmodule\n");
    for (function, (module, pins)) in &writer.modules {
        text.push_str(&cell_module(*function, module, *pins));
    }
    text
}

struct Writer<'d> {
    design: &'d Design,
    /// The names of nets before they are escaped: a number appended to an escaped name would be outside of it.
    names: FileNames,
    ports: VerilogPorts,
    taken: BTreeSet<String>,
    title: String,
    starts: BTreeMap<NetId, bool>,
    guarded: Guarded,
    stand_ins: BTreeMap<NetId, NetId>,
    modules: BTreeMap<Function, (String, usize)>,
    /// A net that is 1, if such a one forces a register.
    always: Option<String>,
}

impl<'d> Writer<'d> {
    fn new(design: &'d Design) -> Self {
        let netlist = &design.netlist;
        let starts = starts(netlist);
        let ports = VerilogPorts::new(design, |driver| starts.contains_key(&driver));
        let kept: Vec<&str> = ports.names().into_iter().collect();
        let names = FileNames::new(design, &kept, false, legal);
        let title = if netlist.name.is_empty() { "circuit".to_owned() } else { plain(&legal(&netlist.name)) };
        let mut taken: BTreeSet<String> = kept.into_iter().map(str::to_owned).collect();
        taken.extend(netlist.ids().filter(|&id| !is_constant(netlist, id)).map(|id| names.net(id).to_owned()));
        let mut stand_ins = stand_ins(netlist);
        stand_ins.retain(|cell, _| starts.contains_key(cell));
        let guarded = Guarded::of(netlist);
        let forcing = netlist.registers().flat_map(|(id, _)| netlist.pins(id).split_off(2));
        let mut constants = forcing.filter(|&id| *netlist.node(id) == Node::Constant(true));
        let always = constants.next().map(|_| free(&mut taken, "always_1".to_owned()));
        let modules = BTreeMap::new();
        let mut writer = Self { design, names, ports, taken, title, starts, guarded, stand_ins, modules, always };
        writer.name_modules();
        writer
    }

    fn name_modules(&mut self) {
        let netlist = &self.design.netlist;
        let mut taken = BTreeSet::from([self.title.clone()]);
        for id in netlist.ids().filter(|&id| self.guarded.role(id).is_some()) {
            let function = netlist.cell(id).expect("only cells have roles").function;
            let module = || (free(&mut taken, format!("cell_{}", function.name())), netlist.pins(id).len());
            self.modules.entry(function).or_insert_with(module);
        }
    }

    fn name(&self, id: NetId) -> String {
        match self.design.netlist.node(id) {
            Node::Constant(value) => format!("1'b{}", u8::from(*value)),
            _ => {
                let id = *self.stand_ins.get(&id).unwrap_or(&id);
                self.ports.bit(id).unwrap_or_else(|| escaped(self.names.net(id)))
            }
        }
    }

    fn head(&self) -> String {
        let logic = &self.design.netlist;
        let name = |id| self.name(id);
        let clocks = self.design.own_clocks().iter();
        let mut ports: Vec<String> = clocks.map(|&clock| format!("input {}", name(clock))).collect();
        ports.extend(self.ports.declared("input", self.design.ports(), name));
        ports.extend(self.ports.declared("output", logic.outputs(), name));
        format!("module {}({});\n", escaped(&self.title), ports.join(", "))
    }

    fn declarations(&self, text: &mut String) {
        let logic = &self.design.netlist;
        for (id, register) in logic.registers() {
            let _ = writeln!(text, "    reg {} = 1'b{};", self.name(id), u8::from(register.starts_at()));
        }
        // An event needs a net.
        for net in self.always.iter().map(|net| escaped(net)) {
            let _ = writeln!(text, "    wire {net} = 1'b1;");
        }
        for id in cells_in_order(logic).into_iter().filter(|id| !self.stand_ins.contains_key(id)) {
            let _ = writeln!(text, "    wire {};", self.name(id));
        }
    }

    fn cell(&mut self, text: &mut String, id: NetId) {
        let logic = &self.design.netlist;
        let function = logic.cell(id).expect("the order holds cells").function;
        let pins: Vec<String> = logic.pins(id).into_iter().map(|pin| self.name(pin)).collect();
        let net = self.name(id);
        if self.guarded.role(id).is_none() {
            let inputs: Vec<&str> = (0..function.inputs()).map(|at| &*pins[at.min(pins.len() - 1)]).collect();
            let _ = writeln!(text, "    assign {net} = {};", expression(function, &inputs));
            return;
        }
        let start =
            self.starts.get(&id).map_or(String::new(), |&start| format!("(* init = 1'b{} *) ", u8::from(start)));
        let module = &self.modules[&function].0;
        let instance = escaped(&free(&mut self.taken, plain(&format!("{}_cell", self.names.net(id)))));
        let ports: String = ["a", "b", "c"].iter().zip(&pins).map(|(port, pin)| format!(".{port}({pin}), ")).collect();
        let _ = writeln!(text, "    {start}{module} {instance}({ports}.y({net}));");
    }

    fn outputs(&self, text: &mut String) {
        let logic = &self.design.netlist;
        for &id in logic.outputs() {
            let driver = logic.pins(id)[0];
            if self.stand_ins.get(&driver) != Some(&id) {
                let _ = writeln!(text, "    assign {} = {};", self.name(id), self.name(driver));
            }
        }
    }

    fn registers(&self, text: &mut String) {
        let logic = &self.design.netlist;
        for (id, register) in logic.registers() {
            let pins = logic.pins(id);
            let [state, next, clock] = [id, pins[0], pins[1]].map(|net| self.name(net));
            let forcing = self.forcing(register, &pins[2..]);
            let (assign, change) = match register.kind {
                RegisterKind::Rising => ("<=", format!("posedge {clock}")),
                RegisterKind::Falling => ("<=", format!("negedge {clock}")),
                RegisterKind::High => ("=", format!("if ({clock}) ")),
                RegisterKind::Low => ("=", format!("if (!{clock}) ")),
            };
            let forced = |(net, value): &(String, u8)| format!("if ({net}) {state} {assign} 1'b{value}; else ");
            let forced: String = forcing.iter().map(forced).collect();
            let (events, open) = match register.kind {
                RegisterKind::Rising | RegisterKind::Falling => {
                    let edges = forcing.iter().map(|(net, _)| format!(", posedge {net}")).collect::<String>();
                    (format!("({change}{edges})"), String::new())
                }
                RegisterKind::High | RegisterKind::Low => ("*".to_owned(), change),
            };
            let _ = writeln!(text, "    always @{events} {forced}{open}{state} {assign} {next};");
        }
    }

    /// The strongest first, without nets that are always 0: Yosys does not read these as events.
    fn forcing(&self, register: &RegisterNode, nets: &[NetId]) -> Vec<(String, u8)> {
        let values = match register.forcing {
            Forcing::SetReset => vec![1, 0],
            Forcing::ToStart | Forcing::Never => vec![u8::from(register.starts_at())],
        };
        let mut forcing: Vec<(String, u8)> = Vec::new();
        for (&id, value) in nets.iter().zip(values).rev() {
            let net = match self.design.netlist.node(id) {
                Node::Constant(false) => continue,
                Node::Constant(true) => self.always.iter().map(|net| escaped(net)).collect(),
                _ => self.name(id),
            };
            if !forcing.iter().any(|(known, _)| *known == net) {
                forcing.push((net, value));
            }
        }
        forcing
    }
}

/// A name that no reader takes for that of a system function.
fn legal(name: &str) -> String {
    let name = visible(name, &[]);
    name.strip_prefix('$').map_or(name.clone(), |rest| format!("_{rest}"))
}

fn is_constant(netlist: &Netlist, id: NetId) -> bool {
    matches!(netlist.node(id), Node::Constant(_))
}

fn cell_module(function: Function, module: &str, pins: usize) -> String {
    let names = ["a", "b", "c"];
    let ports = names[..pins].iter().map(|name| format!("input {name}")).collect::<Vec<_>>().join(", ");
    let inputs: Vec<&str> = (0..function.inputs()).map(|input| names[input.min(pins - 1)]).collect();
    let logic = expression(function, &inputs);
    format!("\n(* keep_hierarchy *)\nmodule {module}({ports}, output y);\n    assign y = {logic};\nendmodule\n")
}

fn expression(function: Function, nets: &[&str]) -> String {
    let &[a, b] = nets else {
        let [low, high] = function.halves().map(|half| expression(half, &nets[1..]));
        return format!("{} ? {high} : {low}", nets[0]);
    };
    match function.bits() {
        0b0000 => "1'b0".to_owned(),
        0b1111 => "1'b1".to_owned(),
        0b0011 => format!("~{a}"),
        0b0101 => format!("~{b}"),
        0b1100 => a.to_owned(),
        0b1010 => b.to_owned(),
        0b0110 => format!("{a} ^ {b}"),
        0b1001 => format!("~({a} ^ {b})"),
        0b1000 => format!("{a} & {b}"),
        0b0111 => format!("~({a} & {b})"),
        0b1110 => format!("{a} | {b}"),
        0b0001 => format!("~({a} | {b})"),
        0b0100 => format!("{a} & ~{b}"),
        0b0010 => format!("~{a} & {b}"),
        0b1101 => format!("{a} | ~{b}"),
        _ => format!("~{a} | {b}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{full_adder, latch};
    use crate::passes::dissolve_wires;

    #[test]
    fn a_full_adder_is_readable() {
        let text = write(&Design::new(full_adder()));
        assert!(
            text.starts_with("module full_adder(input a, input b, input cin, output sum, output carry);\n"),
            "{text}"
        );
        assert!(text.contains(" ^ cin;"), "{text}");
    }

    #[test]
    fn the_number_of_a_shared_name_is_inside_its_escape() {
        let mut netlist = Netlist::new("one");
        let a = netlist.add_input("q[0]");
        netlist.add_output("q[0]", a);
        let text = write(&Design::new(netlist));
        assert!(text.starts_with("module one(input \\q[0] , output \\q[0]_1 );\n"), "{text}");
    }

    #[test]
    fn cells_of_a_loop_are_instances_with_start_values() {
        let mut logic = latch();
        dissolve_wires(&mut logic).unwrap();
        let text = write(&Design::new(logic));
        let instances: Vec<_> = text.lines().filter(|line| line.contains("init")).collect();
        assert_eq!(instances.len(), 2, "{text}");
        assert!(instances[0].starts_with("    (* init = 1'b0 *) cell_nand "), "{text}");
        assert!(instances[1].starts_with("    (* init = 1'b1 *) cell_nand "), "{text}");
        assert_eq!(text.matches("(* keep_hierarchy *)").count(), 1, "{text}");
        assert_eq!(text.matches("cell_nand ").count(), 4, "two cells and two guards:\n{text}");
    }
}
