//! The rival in the measurements of the compiler: ten optimization flows of ABC, mapped to three libraries of cells.

use nbc_base::model::Function;
use nbc_circuit::Netlist;
use nbc_circuit::formats::{Design, blif};

use crate::support::*;

const RESYN2: &str =
    "balance; rewrite; refactor; balance; rewrite; rewrite -z; balance; refactor -z; rewrite -z; balance";
const COMPRESS2RS: &str = "balance -l; resub -K 6 -l; rewrite -l; resub -K 6 -N 2 -l; refactor -l; resub -K 8 -l; \
    balance -l; resub -K 8 -N 2 -l; rewrite -l; resub -K 10 -l; rewrite -z -l; resub -K 10 -N 2 -l; balance -l; \
    resub -K 12 -l; refactor -z -l; resub -K 12 -N 2 -l; rewrite -z -l; balance -l";

const FLOWS: [(&str, &str); 10] = [
    ("resyn2", "amap"),
    ("ifraig; dc2; dc2; dc2; dc2", AMAP),
    ("ifraig; compress2rs; compress2rs; compress2rs", AMAP),
    ("ifraig; compress2rs; compress2rs", "map -a"),
    ("ifraig; dc2; dc2; compress2rs", DCH),
    ("ifraig; compress2rs; dch; map -a; mfs2 -ae -M 500; strash; dc2; compress2rs", AMAP),
    ("ifraig; dc2; dc2; if -a -K 6; mfs2 -ae -W 4 -M 500 -C 1000; strash; compress2rs; compress2rs", AMAP),
    ("&get -n; &syn3; &syn3; &b; &syn4; &put; compress2rs", AMAP),
    ("ifraig; compress2rs; if -a -K 4; mfs2 -ae -W 4 -M 500 -C 1000; lutpack; strash; compress2rs", DCH),
    ("ifraig; &get -n; &deepsyn -T 6; &put; compress2rs", AMAP),
];
const AMAP: &str = "amap -F 10 -A 20";
const DCH: &str = "dch; amap -F 10 -A 20";

const LIBRARIES: [(&str, &[&str]); 3] = [
    ("a", &["not", "nand"]),
    ("b", &["not", "nand", "and"]),
    ("c", &["not", "nand", "and", "or", "nor", "xor", "xnor", "a_and_notb", "nota_and_b", "a_or_notb", "nota_or_b"]),
];

/// The fewest cells of ABC's flows with each library; `None` without ABC.
pub fn fewest_of_abc(design: &Design, folder: &Path) -> Option<[u32; 3]> {
    fs::write(folder.join("source.blif"), blif::write(design)).unwrap();
    for (name, cells) in LIBRARIES {
        fs::write(folder.join(format!("{name}.genlib")), genlib(cells)).unwrap();
    }
    let mut best = [u32::MAX; 3];
    for (optimize, map) in FLOWS {
        let areas = areas(&abc(folder, &script(optimize, map))?);
        // A flow that fails is no result; that of `print_stats` follows each mapping.
        if let Some(last) = areas.last_chunk::<3>() {
            (0..3).for_each(|i| best[i] = best[i].min(last[i]));
        }
    }
    Some(best)
}

fn script(optimize: &str, map: &str) -> String {
    let mut script = format!(
        "alias b balance; alias rs resub; alias rw rewrite; alias rwz rewrite -z; alias rf refactor; alias rfz \
         refactor -z; alias st strash; alias compress2rs \"{COMPRESS2RS}\"; alias resyn2 \"{RESYN2}\"; read_library \
         a.genlib; read_blif source.blif; strash; {optimize}; write_blif reduced.blif; "
    );
    for (name, _) in LIBRARIES {
        script.push_str(&format!("read_library {name}.genlib; read_blif reduced.blif; strash; {map}; print_stats; "));
    }
    script
}

fn genlib(cells: &[&str]) -> String {
    let mut text = String::from("GATE zero 0 O=CONST0;\nGATE one 0 O=CONST1;\n");
    for name in cells {
        let function = Function::parse(name).unwrap();
        let value = |a: bool, b: bool| function.output(a, b);
        let products: Vec<&str> = match function == Function::NOT {
            true => vec!["!a"],
            false => [("!a*!b", value(false, false)), ("!a*b", value(false, true)), ("a*!b", value(true, false))]
                .into_iter()
                .chain([("a*b", value(true, true))])
                .filter(|(_, shown)| *shown)
                .map(|(product, _)| product)
                .collect(),
        };
        text.push_str(&format!("GATE {name} 1 O={}; PIN * UNKNOWN 1 999 1 0 1 0\n", products.join("+")));
    }
    text
}

fn areas(printed: &str) -> Vec<u32> {
    let after = printed.split("area =").skip(1);
    after.filter_map(|rest| rest.trim_start().split(['.', ' ']).next()?.parse().ok()).collect()
}

#[test]
#[ignore = "many flows of ABC; .ci/full runs it"]
fn abc_finds_the_best_full_adder_of_all_cells() {
    let netlist = full_adder();
    let folder = tempfile::tempdir().unwrap();
    let Some([nands, _, all]) = fewest_of_abc(&Design::new(netlist), folder.path()) else {
        return;
    };
    assert_eq!(all, 5);
    assert!((9..=13).contains(&nands), "{nands}");
}

fn full_adder() -> Netlist {
    let mut netlist = Netlist::new("adder_1");
    let [a, b, c] = ["x0", "x1", "x2"].map(|name| netlist.add_input(name));
    let half = netlist.add_gate(Function::XOR, &[a, b]);
    let sum = netlist.add_gate(Function::XOR, &[half, c]);
    let [one, two] = [[a, b], [half, c]].map(|pins| netlist.add_gate(Function::AND, &pins));
    let carry = netlist.add_gate(Function::OR, &[one, two]);
    netlist.add_output("y0", sum);
    netlist.add_output("y1", carry);
    netlist
}
