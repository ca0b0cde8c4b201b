//! Pictures by their content: what is drawn and where, and that the same input gives the same bytes.

use std::collections::{BTreeMap, BTreeSet};

use crate::support::traces::{large, latch, latch_netlist};
use nbc_base::model::{Body, Fault, FaultKind, Function, Pattern, Schedule, Spell, Trajectory, Trial};
use nbc_circuit::Netlist;
use nbc_session::report::{self, Schematic, Scheme};
use nbc_swarm::{StimulusSource, SwarmTrace};

fn paper_rows() -> SwarmTrace {
    latch(&[(false, true), (true, true), (true, false), (false, false), (false, true)], 8)
}

fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).expect("a drawing is well-formed XML");
    document.descendants().filter(|n| n.has_tag_name("text")).map(|n| n.text().unwrap_or("").to_owned()).collect()
}

fn count(svg: &str, tag: &str, attribute: &str) -> usize {
    let document = roxmltree::Document::parse(svg).expect("a drawing is well-formed XML");
    document.descendants().filter(|node| node.has_tag_name(tag) && node.has_attribute(attribute)).count()
}

#[test]
fn the_swarm_diagram_has_a_panel_for_each_robot_and_each_output() {
    let svg = report::draw_swarm(&paper_rows()).finish();
    let texts = texts(&svg);
    for wanted in [
        "n1 = nand",
        "q = nand",
        "not_d = not",
        "output q",
        "output nq",
        "position (voxels)",
        "time (cycles)",
        "d",
        "e",
    ] {
        assert!(texts.iter().any(|text| text == wanted), "{wanted:?} is not among {texts:?}");
    }
    // Seven panels, each with a dotted line for each of the four changes of the inputs.
    assert_eq!(count(&svg, "line", "stroke-dasharray"), 7 * 4);
}

#[test]
fn a_signal_has_one_color_in_a_picture() {
    let svg = report::draw_swarm(&paper_rows()).finish();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let mut colors: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let is_swatch = |node: &roxmltree::Node<'_, '_>| {
        node.has_tag_name("rect") && node.attribute("width") == Some("8") && node.attribute("height") == Some("8")
    };
    for swatch in document.descendants().filter(is_swatch) {
        let name = swatch.next_sibling_element().and_then(|label| label.text()).expect("a swatch has its name");
        colors.entry(name).or_default().insert(swatch.attribute("fill").unwrap());
    }
    assert_eq!(colors.len(), 2 + 5, "two inputs and five robots: {colors:?}");
    assert!(colors.values().all(|fills| fills.len() == 1), "{colors:?}");
    assert_ne!(colors["d"], colors["e"]);
    assert!(colors["d"] != colors["q"] && colors["e"] != colors["q"], "an input looks like no robot's output");
}

#[test]
fn paths_follow_the_bits() {
    let svg = report::draw_swarm(&latch(&[(true, true)], 8)).finish();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let group = document
        .descendants()
        .find(|node| node.attribute("id").is_some_and(|id| id.starts_with("track-q = nand")))
        .unwrap();
    let path = group.children().rfind(|node| node.has_tag_name("polyline")).unwrap();
    let points: Vec<(f64, f64)> = path
        .attribute("points")
        .unwrap()
        .split(' ')
        .map(|pair| pair.split_once(',').unwrap())
        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
        .collect();
    assert_eq!(points.len(), 8 * 4 + 1);
    assert!(points.windows(2).all(|pair| pair[1].1 > pair[0].1), "time runs downwards");
    assert!(points.last().unwrap().0 > points[0].0, "a robot whose bit is 1 goes right");
}

#[test]
fn a_large_swarm_has_small_files_that_show_outputs_and_named_nets_first() {
    let trace = large();
    assert_eq!(trace.by_interest()[..6], [1, 4, 3, 0, 2, 5], "outputs, named nets, the others");
    let svg = report::draw_swarm(&trace).finish();
    assert!(svg.len() < 600_000, "{} bytes", svg.len());
    assert_eq!(svg.matches("id=\"track-").count(), 36 + 2);
    assert!(texts(&svg).iter().any(|text| text.contains("164 more are not shown")));
    let all: Vec<usize> = (0..200).collect();
    assert_eq!(report::draw_chosen(&trace, &all).finish().matches("id=\"track-").count(), 200);
    let waves = report::vcd(&trace);
    assert!(waves.len() < 4_000_000, "{} bytes", waves.len());
}

#[test]
fn the_same_trace_gives_the_same_bytes() {
    let [one, two] = [(); 2].map(|()| report::draw_swarm(&paper_rows()));
    assert_eq!(one.finish(), two.finish());
    assert_eq!(report::png(&one), report::png(&two));
}

#[test]
fn the_png_is_the_drawing_at_twice_its_size() {
    let svg = report::draw_swarm(&paper_rows());
    let mut decoder = png::Decoder::new(std::io::Cursor::new(report::png(&svg)));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(
        (f64::from(info.width), f64::from(info.height)),
        ((svg.width() * 2.0).ceil(), (svg.height() * 2.0).ceil())
    );
    let has = |color: [u8; 3]| pixels.chunks(3).any(|pixel| pixel == color);
    assert!(has([255, 255, 255]) && has([26, 26, 26]), "ink on paper");
}

#[test]
fn a_fault_is_shown_at_its_place() {
    let mut trace = paper_rows();
    trace.robots[1].fault = Some(Fault { env_step: 1, kind: FaultKind::Unstable });
    trace.robots[1].com_x.fill(250.0);
    assert!(texts(&report::draw_swarm(&trace).finish()).contains(&"unstable in cycle 1".to_owned()));
}

#[test]
fn an_empty_trace_is_still_drawn() {
    let mut trace = latch(&[], 8);
    report::png(&report::draw_swarm(&trace));
    trace.robots.clear();
    trace.shown = vec![StimulusSource::Constant(true), StimulusSource::Input(0)];
    report::png(&report::draw_swarm(&trace));
}

#[test]
fn one_robots_diagram_shows_its_schedule() {
    let spell = |pattern: usize, steps| Spell::of(Pattern::PAIRS[pattern], steps);
    let schedule = Schedule { spells: vec![spell(0, 840), spell(3, 840)] };
    let com_x: Vec<f64> = (0..=1680).map(|i| 250.0 + f64::from(i) * 0.01).collect();
    let body = Body::parse(&["3"], &nbc_base::model::Palette::paper()).unwrap();
    let trial = Trial { body, schedule };
    let svg = report::draw_robot("nand_1", &trial, &Trajectory { com_x, com_y: vec![], fault: None }).finish();
    let texts = texts(&svg);
    for wanted in ["nand_1 in space and time", "voxels walked: 00 +8.40, 11 +8.40", "stimulus 1", "stimulus 2", "20"] {
        assert!(texts.iter().any(|text| text == wanted), "{wanted:?} is not among {texts:?}");
    }
}

#[test]
fn the_schematic_has_a_box_for_each_cell_and_a_wire_for_each_pin() {
    let netlist = latch_netlist();
    let critical: Vec<_> = netlist.inputs()[..1].iter().copied().chain(netlist.cells().map(|(id, _)| id)).collect();
    let svg = Schematic::of(&netlist, &[], &critical, Scheme::Paper).top().finish();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let cells: Vec<&str> = document
        .descendants()
        .filter(|node| node.attribute("id").is_some_and(|id| id.starts_with("cell-")))
        .map(|node| node.first_element_child().and_then(|title| title.text()).unwrap())
        .collect();
    assert_eq!(
        cells,
        ["set = nand(d, e)", "not_d = not(d)", "reset = nand(not_d, e)", "q = nand(set, nq)", "nq = nand(reset, q)"]
    );
    let texts = texts(&svg);
    for wanted in ["d_latch", "d", "e", "q", "nq", "NAND", "NOT", "critical path"] {
        assert!(texts.iter().any(|text| text == wanted), "{wanted:?} is not among {texts:?}");
    }
    // Nine pins of cells and two of outputs; two nets pass through a layer, and one has a lane of its own.
    assert_eq!(count(&svg, "polyline", "points"), 11 + 2 + 1);
}

#[test]
fn unusual_netlists_are_drawn() {
    report::png(&Schematic::of(&Netlist::new("empty"), &[], &[], Scheme::Safe).top());
    let mut netlist = Netlist::new("through");
    let a = netlist.add_input("a_name_that_is_much_too_long");
    let one = netlist.add_constant(true);
    netlist.add_output("y", a);
    netlist.add_output("z", one);
    let gate = netlist.add_gate(Function::NAND, &[a, a]);
    netlist.drive(gate, 1, gate);
    report::png(&Schematic::of(&netlist, &[], &[], Scheme::Safe).top());
}

#[test]
fn a_sprite_has_a_square_for_each_voxel_in_its_materials_color() {
    let body = Body::parse(&["00345", "33333"], &nbc_base::model::Palette::paper()).unwrap();
    for scheme in [Scheme::Paper, Scheme::Safe] {
        let svg = report::draw_portrait("walker", &body, scheme).finish();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let of_color = |code| {
            let fill = scheme.color(code).to_string();
            document.descendants().filter(|n| n.has_tag_name("polygon") && n.attribute("fill") == Some(&fill)).count()
        };
        assert_eq!([3, 4, 5, 6].map(of_color), [6, 1, 1, 0]);
        assert_eq!(texts(&svg), ["walker", "3 muscle", "4 antimuscle", "5 s1_shrink"]);
    }
}
