//! Which fields of a record have an effect, and with which others. A field that has none is refused, because nothing
//! that is declared may be ignored.

/// What a record is, or has: a field and its word, as `("objective", "gate")`; or a field that changes something, as
/// `("vary", "")`.
pub(crate) type Fact = (&'static str, &'static str);

/// Fields, and the facts of which one must hold for them to have an effect.
type Group = (&'static [&'static str], &'static [Fact]);

const ALWAYS: &[Fact] = &[];
const ACTUATOR: &[Fact] = &[("kind", "actuator")];
const SENSOR: &[Fact] = &[("kind", "sensor")];
/// The noise that is drawn.
const DRAWN: &[Fact] = &[("start", ""), ("missed", ""), ("dead", "")];
const HOLDS: &[Fact] = &[("registers", "master_slave"), ("registers", "mux")];
const WAVES: &[Fact] = &[("registers", "waves")];
const NETWORKS: &[Fact] = &[("genome", "cppn")];
const VOXELS: &[Fact] = &[("genome", "voxels")];
const DISTANCE: &[Fact] = &[("objective", "distance")];
const IMAGES: &[Fact] = &[("objective", "images")];
/// What stimuli are exchanged and inverted for.
const STIMULI: &[Fact] = &[("objective", "distance"), ("objective", "gate"), ("objective", "wave")];
const GATES: &[Fact] = &[("objective", "gate"), ("objective", "wave")];
const VARIED: &[Fact] = &[("vary", "")];

/// The fields of each kind of record.
const RULES: [(&str, &[Group]); 8] = [
    (
        "material",
        &[
            (&["kind"], ALWAYS),
            (&["drive", "period", "phase", "range"], ACTUATOR),
            (&["stimulus", "absent", "present"], SENSOR),
        ],
    ),
    (
        "world",
        &[
            (&["from", "friction", "gravity", "stiffness", "drag", "damping", "swelling"], ALWAYS),
            (&["start", "missed", "weak", "dead", "ground"], ALWAYS),
            (&["seed"], DRAWN),
        ],
    ),
    ("images", &[(&["stimulus", "from", "white", "label", "take"], ALWAYS)]),
    ("library", &[(&["from", "behaviors", "without"], ALWAYS)]),
    (
        "swarm",
        &[
            (&["circuit", "library", "registers", "world"], ALWAYS),
            (&["hold", "window"], HOLDS),
            (&["beat", "step"], WAVES),
        ],
    ),
    (
        "evolution",
        &[
            (&["from", "box", "materials", "genome", "variable", "descriptors", "batch", "newcomers"], ALWAYS),
            (&["generations", "seed", "as", "objective", "niche", "world"], ALWAYS),
            (&["symmetry"], STIMULI),
            (&["shown"], IMAGES),
            (&["mutation"], NETWORKS),
            (&["crossover", "start"], VOXELS),
            (&["fixed"], DISTANCE),
            (&["behaviors", "vary"], GATES),
            (&["worlds"], VARIED),
        ],
    ),
    (
        "mutation",
        &[(&["add_node", "remove_node", "add_link", "remove_link", "change_activation", "change_weight"], ALWAYS)],
    ),
    (
        "variation",
        &[
            (&["all", "friction", "gravity", "stiffness", "drag", "damping", "swelling"], ALWAYS),
            (&["start", "missed", "weak", "dead"], ALWAYS),
        ],
    ),
];

/// The facts of which one must hold for a field to have an effect, none if it always has; `None` for an unknown field.
pub(crate) fn needs(record: &str, field: &str) -> Option<&'static [Fact]> {
    let (_, groups) = RULES.iter().find(|(known, _)| *known == record)?;
    groups.iter().find(|(fields, _)| fields.contains(&field)).map(|(_, facts)| *facts)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::check;
    use nbc_base::diag::{Code, Diagnostic};
    use nbc_base::model::Program;
    use nbc_base::source::{MemoryWorld, Sources};

    /// What the programs of this test refer to.
    const CONTEXT: &str = "\
circuit f(a, clk) -> (q) { q = register(a, clk) }
circuit g(a, clk) -> (q) { q = not register(a, clk) }
schedule slow(s1, s2) { 0 0 for 20 cycles 0 1 for 9 cycles 1 0 for 9 cycles 1 1 for 9 cycles }
library few { from: shipped, behaviors: [nand] }
world rough { friction: 2 }
evolution other { box: 3 x 3, seed: 9 }
stimulus spot[1][2], stripe[1][2]
material other_eye { kind: sensor, stimulus: stripe, absent: 0.6, present: 1.6 }
material eye { kind: sensor, stimulus: spot, absent: 0.6, present: 1.6 }
images left { stimulus: spot, from: \"spots.csv\", label: 0 }
images right { stimulus: spot, from: \"spots.csv\", label: 1 }
schedule spots(spot) { left for 9 steps right for 9 steps }
";

    /// A file of images that the programs name.
    const SPOTS: &str = "1,0,0\n0,1,1\n0,0.5,1\n";

    /// Two values of a field.
    fn values(record: &str, field: &str) -> [&'static str; 2] {
        match (record, field) {
            ("material", "kind") => ["rigid", "soft"],
            ("material", "drive") => ["sine", "sine"],
            ("material", "period") => ["84 steps", "42 steps"],
            ("material", "phase") => ["0 deg", "90 deg"],
            ("material", "range") => ["0.6..1.6", "0.8..1.4"],
            ("material", "stimulus") => ["s1", "s2"],
            ("images", "stimulus") => ["spot", "stripe"],
            ("images", "from") => ["\"spots.csv\"", "\"other.csv\""],
            ("images", "label") => ["0", "1"],
            ("images", "take") => ["1", "2..3"],
            ("material", "absent" | "present") => ["0.7", "0.8"],
            ("world", "from") => ["paper", "rough"],
            ("world", "seed") => ["2", "3"],
            ("world", "ground") => ["[0, 1]", "[0, 2]"],
            ("evolution", "from") => ["gates", "other"],
            ("library", "from") => ["shipped", "three"],
            (_, "behaviors") => ["[nand]", "[xor]"],
            ("library", "without") => ["[nand_5x5]", "[xor_5x5]"],
            ("swarm", "circuit") => ["f", "g"],
            ("swarm", "library") | ("evolution", "start") => ["shipped", "few"],
            ("swarm", "hold" | "window" | "beat" | "step") | ("evolution", "fixed") => ["3 cycles", "6 cycles"],
            ("swarm", "registers") => ["master_slave", "mux"],
            (_, "world") => ["paper", "rough"],
            ("evolution", "box") => ["4 x 4", "6 x 6"],
            ("evolution", "materials") => ["[bone, muscle]", "[flesh, muscle]"],
            ("evolution", "genome") => ["cppn", "voxels"],
            ("evolution", "variable") => ["sweep", "slow"],
            ("evolution", "descriptors") => ["[behavior]", "[class]"],
            ("evolution", "as") => ["paper", "code"],
            ("evolution", "objective") => ["distance", "gate"],
            ("evolution", "shown") => ["apart", "in_turn"],
            ("evolution", "symmetry") => ["none", "npn"],
            ("evolution", "niche") => ["dominance", "pareto(2)"],
            ("evolution", "mutation") => ["{ add_node: 2 }", "{ add_node: 3 }"],
            ("evolution", "vary") => ["{ all: 1% }", "{ all: 2% }"],
            ("evolution", "crossover") => ["10%", "20%"],
            ("world" | "mutation" | "variation", _) => ["0.5", "0.6"],
            _ => ["2", "3"],
        }
    }

    /// A program with a record that has a field of that value, with the other fields that it needs.
    fn program(record: &str, (field, value): (&str, &str), fact: Option<Fact>) -> (Program, Vec<Diagnostic>) {
        let fact = fact.filter(|(named, _)| *named != field).map(|(named, word)| match word {
            "" => format!("{named}: {}", values(record, named)[0]),
            word => format!("{named}: {word}"),
        });
        let needed = match (record, field, fact.as_deref()) {
            ("material", "kind", _) => &[][..],
            ("material", _, Some("kind: actuator")) => &["period: 84 steps", "range: 0.6..1.6"][..],
            ("material", _, Some("kind: sensor")) => &["stimulus: s1", "absent: 0.6", "present: 1.6"],
            ("images", ..) => &["stimulus: spot", "from: \"spots.csv\""],
            ("evolution", _, Some("objective: images")) => &["variable: spots", "materials: [muscle, eye]"],
            ("library", ..) => &["from: shipped"],
            ("swarm", ..) => &["circuit: f"],
            ("evolution", "worlds", _) => &["objective: gate"],
            _ => &[],
        };
        let others = needed.iter().copied().filter(|other| !other.starts_with(&format!("{field}:")));
        let fields: Vec<String> = others.map(str::to_owned).chain(fact).chain([format!("{field}: {value}")]).collect();
        let text = match record {
            "mutation" => format!("evolution x {{ mutation: {{ {} }} }}", fields.join(", ")),
            "variation" => format!("evolution x {{ objective: gate, vary: {{ {} }} }}", fields.join(", ")),
            _ => format!("{record} x {{ {} }}", fields.join(", ")),
        };
        let mut sources = Sources::default();
        let file = sources.add("a.nb", format!("{CONTEXT}{text}"));
        let mut world = MemoryWorld::default();
        world.insert("spots.csv", SPOTS);
        world.insert("other.csv", "1,1,0\n");
        let found = check::check(&world, &mut sources, file);
        (found.program, found.diagnostics)
    }

    /// All words of the choices that decide which fields have an effect.
    fn words(field: &str) -> BTreeSet<Fact> {
        let groups = RULES.iter().flat_map(|(_, groups)| *groups);
        groups.flat_map(|(_, facts)| *facts).copied().filter(|(named, _)| *named == field).collect()
    }

    #[test]
    fn each_field_has_an_effect_or_is_refused() {
        let fields = RULES.iter().flat_map(|(record, groups)| {
            let fields = groups.iter().flat_map(|(fields, needs)| fields.iter().map(|field| (*field, *needs)));
            fields.map(move |(field, needs)| (*record, field, needs))
        });
        for (record, field, needs) in fields {
            let [first, second] = values(record, field);
            let refused = |fact| {
                let (_, faults) = program(record, (field, first), fact);
                faults.iter().any(|fault| fault.code == Code::NoEffect)
            };
            let useful = |fact| {
                let [(one, faults), (other, more)] = [first, second].map(|value| program(record, (field, value), fact));
                assert_eq!([faults, more].concat(), [], "{field} of a {record} with {fact:?}");
                assert!(one != other || first == second, "{field} of a {record} changes nothing with {fact:?}");
            };
            match needs {
                [] => useful(None),
                _ => needs.iter().for_each(|&fact| useful(Some(fact))),
            }
            let choices: BTreeSet<&str> = needs.iter().map(|(named, _)| *named).collect();
            for fact in choices.iter().flat_map(|named| words(named)).filter(|(_, word)| !word.is_empty()) {
                assert_eq!(refused(Some(fact)), !needs.contains(&fact), "{field} of a {record} with {fact:?}");
            }
            if needs.iter().any(|(_, word)| word.is_empty()) {
                assert!(refused(None), "{field} of a {record} alone");
            }
        }
    }

    #[test]
    fn the_table_has_the_fields_that_records_know() {
        for (record, groups) in RULES {
            let (_, faults) = program(record, ("zzzz", "1"), Some(("kind", "sensor")).filter(|_| record == "material"));
            let help =
                faults.iter().find(|fault| fault.code == Code::UnknownField).and_then(|fault| fault.help.as_ref());
            let help = help.unwrap_or_else(|| panic!("{record}: {faults:?}"));
            let known: BTreeSet<&str> = help.split('`').skip(1).step_by(2).collect();
            let ruled =
                groups.iter().filter(|(_, needs)| *needs != ACTUATOR).flat_map(|(fields, _)| fields.iter().copied());
            assert_eq!(known, ruled.collect(), "{record}");
        }
    }
}
