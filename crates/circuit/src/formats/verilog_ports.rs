//! Names in Verilog, and the ports of a module: bits with all their numbers are one port.

use std::collections::{BTreeMap, BTreeSet};

use crate::NetId;
use crate::formats::buses::{Bus, bit_number, buses};
use crate::formats::design::Design;

pub(super) struct VerilogPorts {
    bits: BTreeMap<NetId, (String, i64)>,
    ascending: BTreeSet<String>,
}

impl VerilogPorts {
    /// A name used twice stays that of single bits, as does an output that a loop drives: Yosys would rename its cells.
    pub(super) fn new(design: &Design, is_loop: impl Fn(NetId) -> bool) -> Self {
        let logic = &design.netlist;
        let (inputs, outputs) = (design.ports(), logic.outputs());
        let names = |ids: &[NetId]| ids.iter().map(|&id| logic.net_name(id)).collect::<Vec<_>>();
        let found = [inputs, outputs].map(|ids| (ids, buses(&names(ids), &design.ascending)));
        let of = |at: usize| found[at].1.iter().map(|bus| bus.name.as_str()).collect::<BTreeSet<_>>();
        let (first, second) = (of(0), of(1));
        let mut bits = BTreeMap::new();
        for (ids, buses) in &found {
            let whole = names(ids);
            let is_port = |Bus { name, bits }: &Bus| {
                let is_alone = !(first.contains(name.as_str()) && second.contains(name.as_str()))
                    && buses.iter().filter(|other| other.name == *name).count() == 1;
                is_alone && bit_number(&whole[bits[0]]).is_some_and(|(base, _)| base == name) && is_visible(name)
            };
            let is_looped = |&id: &NetId| outputs.contains(&id) && is_loop(logic.pins(id)[0]);
            let is_apart = |bus: &Bus| bus.bits.iter().any(|&place| is_looped(&ids[place]));
            for bus in buses.iter().filter(|bus| is_port(bus) && !is_apart(bus)) {
                for &place in &bus.bits {
                    let (_, number) = bit_number(&whole[place]).expect("a bit of a bus has a number");
                    bits.insert(ids[place], (bus.name.clone(), number));
                }
            }
        }
        Self { bits, ascending: design.ascending.clone() }
    }

    pub(super) fn names(&self) -> BTreeSet<&str> {
        self.bits.values().map(|(name, _)| name.as_str()).collect()
    }

    pub(super) fn bit(&self, id: NetId) -> Option<String> {
        self.bits.get(&id).map(|(port, bit)| format!("{}[{bit}]", escaped(port)))
    }

    pub(super) fn declared(&self, word: &str, ids: &[NetId], name: impl Fn(NetId) -> String) -> Vec<String> {
        let mut done = BTreeSet::new();
        let mut declared = Vec::new();
        for &id in ids {
            match self.bits.get(&id) {
                None => declared.push(format!("{word} {}", name(id))),
                Some((port, _)) if done.insert(port) => {
                    let numbers = || self.bits.values().filter(|(known, _)| known == port).map(|(_, bit)| *bit);
                    let (low, high) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
                    let (left, right) = if self.ascending.contains(port) { (low, high) } else { (high, low) };
                    declared.push(format!("{word} [{left}:{right}] {}", escaped(port)));
                }
                Some(_) => {}
            }
        }
        declared
    }
}

fn is_visible(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_graphic())
}

pub(super) fn escaped(name: &str) -> String {
    if is_plain(name) { name.to_owned() } else { format!("\\{name} ") }
}

/// A name of letters, digits and `_`, for modules and instances: some readers know no other names of theirs.
pub(super) fn plain(name: &str) -> String {
    let letters: String = name.chars().map(|c: char| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if letters.starts_with(|c: char| c.is_ascii_digit()) { format!("_{letters}") } else { letters }
}

const RESERVED: &str = "\
    accept_on alias always always_comb always_ff always_latch and assert assign assume automatic before begin bind \
    bins binsof bit break buf bufif0 bufif1 byte case casex casez cell chandle checker class clocking cmos config \
    const constraint context continue cover covergroup coverpoint cross deassign default defparam design disable dist \
    do edge else end endcase endchecker endclass endclocking endconfig endfunction endgenerate endgroup endinterface \
    endmodule endpackage endprimitive endprogram endproperty endsequence endspecify endtable endtask enum event \
    eventually expect export extends extern final first_match for force foreach forever fork forkjoin function \
    generate genvar global highz0 highz1 if iff ifnone ignore_bins illegal_bins implements implies import incdir \
    include initial inout input inside instance int integer interconnect interface intersect join join_any join_none \
    large let liblist library local localparam logic longint macromodule matches medium modport module nand negedge \
    nettype new nexttime nmos nor noshowcancelled not notif0 notif1 null or output package packed parameter pmos \
    posedge primitive priority program property protected pull0 pull1 pulldown pullup pulsestyle_ondetect \
    pulsestyle_onevent pure rand randc randcase randsequence rcmos real realtime ref reg reject_on release repeat \
    restrict return rnmos rpmos rtran rtranif0 rtranif1 s_always s_eventually s_nexttime s_until s_until_with \
    scalared sequence shortint shortreal showcancelled signed small soft solve specify specparam static string strong \
    strong0 strong1 struct super supply0 supply1 sync_accept_on sync_reject_on table tagged task this throughout time \
    timeprecision timeunit tran tranif0 tranif1 tri tri0 tri1 triand trior trireg type typedef union unique unique0 \
    unsigned until until_with untyped use uwire var vectored virtual void wait wait_order wand weak weak0 weak1 while \
    wildcard wire with within wor xnor xor";

fn is_plain(name: &str) -> bool {
    name.starts_with(|c: char| !c.is_ascii_digit())
        && name.chars().all(|c: char| c.is_ascii_alphanumeric() || c == '_')
        && !RESERVED.split(' ').any(|word| word == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Netlist;

    fn check(inputs: &[&str], outputs: &[&str], expected: &[&str]) {
        let mut logic = Netlist::new("m");
        let nets: Vec<NetId> = inputs.iter().map(|&name| logic.add_input(name)).collect();
        outputs.iter().for_each(|&name| _ = logic.add_output(name, nets[0]));
        let design = Design { ascending: BTreeSet::from(["up".to_owned()]), ..Design::new(logic) };
        let (ports, logic) = (VerilogPorts::new(&design, |_| false), &design.netlist);
        let name = |id| escaped(&logic.net_name(id));
        let mut declared = ports.declared("input", logic.inputs(), name);
        declared.extend(ports.declared("output", logic.outputs(), name));
        assert_eq!(declared, expected);
    }

    #[test]
    fn bits_are_ports() {
        check(
            &["a[0]", "a[1]", "b", "c[0]"],
            &["q[3]", "q[2]"],
            &["input [1:0] a", "input b", "input [0:0] c", "output [3:2] q"],
        );
    }

    #[test]
    fn the_direction_and_the_numbers_are_those_of_the_file() {
        check(
            &["up[0]", "up[1]", "a[-1]", "a[0]"],
            &["up[7]"],
            &["input [0:1] up", "input [0:-1] a", "output \\up[7] "],
        );
        check(&["up[-1]", "up[0]", "up[1]"], &["q[0]"], &["input [-1:1] up", "output [0:0] q"]);
    }

    #[test]
    fn names_that_are_not_clear_stay_those_of_bits() {
        check(&["a[0]", "a[2]"], &["q[0]"], &["input \\a[0] ", "input \\a[2] ", "output [0:0] q"]);
        check(&["q[0]"], &["q[0]"], &["input \\q[0] ", "output \\q[0] "]);
        check(&["q[0]", "q"], &["r"], &["input \\q[0] ", "input q", "output r"]);
    }

    #[test]
    fn odd_names_are_escaped() {
        assert_eq!(escaped("a[3]"), "\\a[3] ");
        assert_eq!(escaped("and"), "\\and ");
        assert_eq!(escaped("q_1"), "q_1");
    }
}
