//! The fields of records: what they hold, and which others they need to have an effect. A field without effect is
//! refused, because nothing that is declared may be ignored. The checker and editors read this table.

use crate::check::uses::NameKind;

/// A field of the record and its word, `("objective", "gate")`, or a field that changes something, `("vary", "")`.
pub(crate) type Fact = (&'static str, &'static str);

#[derive(Clone, Copy, Debug)]
pub struct RecordField {
    pub name: &'static str,
    pub holds: Holds,
    /// The facts of which one must hold; none if the field always has an effect.
    needs: &'static [Fact],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    Value,
    Word(&'static [&'static str]),
    Name(NameKind),
    NameOr(NameKind, &'static [&'static str]),
    Function,
    Record(&'static str),
}

use Holds::{Function, Name, NameOr, Record, Value, Word};

const ALWAYS: &[Fact] = &[];
const ACTUATOR: &[Fact] = &[("kind", "actuator")];
const SENSOR: &[Fact] = &[("kind", "sensor")];
const DRAWN: &[Fact] = &[("start", ""), ("missed", ""), ("dead", ""), ("phase", ""), ("drift", "")];
const HOLDS: &[Fact] = &[("registers", "master_slave"), ("registers", "mux")];
const WAVES: &[Fact] = &[("registers", "waves")];
const NETWORKS: &[Fact] = &[("genome", "cppn")];
const VOXELS: &[Fact] = &[("genome", "voxels")];
const DISTANCE: &[Fact] = &[("objective", "distance")];
const IMAGES: &[Fact] = &[("objective", "images")];
const STIMULI: &[Fact] = &[("objective", "distance"), ("objective", "gate"), ("objective", "wave")];
const GATES: &[Fact] = &[("objective", "gate"), ("objective", "wave")];
const VARIED: &[Fact] = &[("vary", "")];

/// The kinds of records with their fields, in the order in which messages list them.
const RECORDS: [(&str, &[RecordField]); 8] = [
    (
        "material",
        &[
            field("kind", Word(&["actuator", "rigid", "sensor", "soft"]), ALWAYS),
            field("drive", Word(&["sine"]), ACTUATOR),
            field("period", Value, ACTUATOR),
            field("phase", Value, ACTUATOR),
            field("range", Value, ACTUATOR),
            field("stimulus", Name(NameKind::Stimulus), SENSOR),
            field("absent", Value, SENSOR),
            field("present", Value, SENSOR),
        ],
    ),
    (
        "world",
        &[
            field("from", Name(NameKind::World), ALWAYS),
            field("friction", Value, ALWAYS),
            field("gravity", Value, ALWAYS),
            field("stiffness", Value, ALWAYS),
            field("drag", Value, ALWAYS),
            field("damping", Value, ALWAYS),
            field("swelling", Value, ALWAYS),
            field("start", Value, ALWAYS),
            field("missed", Value, ALWAYS),
            field("weak", Value, ALWAYS),
            field("dead", Value, ALWAYS),
            field("phase", Value, ALWAYS),
            field("drift", Value, ALWAYS),
            field("seed", Value, DRAWN),
            field("hears", Word(&["always", "cycle"]), ALWAYS),
            field("ground", Value, ALWAYS),
        ],
    ),
    (
        "images",
        &[
            field("stimulus", Name(NameKind::Stimulus), ALWAYS),
            field("from", Value, ALWAYS),
            field("white", Value, ALWAYS),
            field("label", Value, ALWAYS),
            field("take", Value, ALWAYS),
        ],
    ),
    (
        "library",
        &[
            field("from", NameOr(NameKind::Evolution, &["shipped", "three"]), ALWAYS),
            field("behaviors", Function, ALWAYS),
            field("without", Value, ALWAYS),
        ],
    ),
    (
        "swarm",
        &[
            field("circuit", Name(NameKind::Circuit), ALWAYS),
            field("library", Name(NameKind::Library), ALWAYS),
            field("hold", Word(&["auto"]), HOLDS),
            field("window", Value, HOLDS),
            field("registers", Word(&["master_slave", "mux", "waves"]), ALWAYS),
            field("beat", Value, WAVES),
            field("step", Value, WAVES),
            field("world", Name(NameKind::World), ALWAYS),
        ],
    ),
    (
        "evolution",
        &[
            field("from", Name(NameKind::Evolution), ALWAYS),
            field("box", Value, ALWAYS),
            field("materials", Name(NameKind::Material), ALWAYS),
            field("genome", Word(&["cppn", "voxels"]), ALWAYS),
            field("crossover", Value, VOXELS),
            field("start", Name(NameKind::Library), VOXELS),
            field("variable", Name(NameKind::Schedule), ALWAYS),
            field("objective", Word(&["distance", "gate", "images", "wave"]), ALWAYS),
            field("shown", Word(&["apart", "in_turn"]), IMAGES),
            field("world", Name(NameKind::World), ALWAYS),
            field("mutation", Record("mutation"), NETWORKS),
            field("fixed", Value, DISTANCE),
            field("descriptors", Word(&["active in", "behavior", "class", "sensory in", "voxels in"]), ALWAYS),
            field("batch", Value, ALWAYS),
            field("newcomers", Value, ALWAYS),
            field("generations", Value, ALWAYS),
            field("seed", Value, ALWAYS),
            field("as", Word(&["code", "paper"]), ALWAYS),
            field("behaviors", Function, GATES),
            field("symmetry", Word(&["none", "npn"]), STIMULI),
            field("niche", Word(&["dominance", "pareto"]), ALWAYS),
            field("vary", Record("variation"), GATES),
            field("worlds", Value, VARIED),
        ],
    ),
    (
        "mutation",
        &[
            field("add_node", Value, ALWAYS),
            field("remove_node", Value, ALWAYS),
            field("add_link", Value, ALWAYS),
            field("remove_link", Value, ALWAYS),
            field("change_activation", Value, ALWAYS),
            field("change_weight", Value, ALWAYS),
        ],
    ),
    (
        "variation",
        &[
            field("all", Value, ALWAYS),
            field("friction", Value, ALWAYS),
            field("gravity", Value, ALWAYS),
            field("stiffness", Value, ALWAYS),
            field("drag", Value, ALWAYS),
            field("damping", Value, ALWAYS),
            field("swelling", Value, ALWAYS),
            field("start", Value, ALWAYS),
            field("missed", Value, ALWAYS),
            field("weak", Value, ALWAYS),
            field("dead", Value, ALWAYS),
            field("phase", Value, ALWAYS),
            field("drift", Value, ALWAYS),
        ],
    ),
];

const fn field(name: &'static str, holds: Holds, needs: &'static [Fact]) -> RecordField {
    RecordField { name, holds, needs }
}

pub fn record_fields(kind: &str) -> &'static [RecordField] {
    RECORDS.iter().find(|(known, _)| *known == kind).map_or(&[], |(_, fields)| fields)
}

impl RecordField {
    pub(crate) fn lacks(&self, facts: &[Fact]) -> Option<&'static [Fact]> {
        (!self.needs.is_empty() && !self.needs.iter().any(|fact| facts.contains(fact))).then_some(self.needs)
    }

    pub(crate) fn is_listed(&self, facts: &[Fact]) -> bool {
        self.needs.iter().all(|(field, _)| *field != "kind") || self.lacks(facts).is_none()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::check;
    use nbc_base::diag::{Code, Diagnostic};
    use nbc_base::model::Program;
    use nbc_base::source::{MemoryWorld, Sources};

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

    const SPOTS: &str = "1,0,0\n0,1,1\n0,0.5,1\n";

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
            ("world", "hears") => ["cycle", "always"],
            ("world" | "variation", "drift") => ["1%", "2%"],
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

    fn words(field: &str) -> BTreeSet<Fact> {
        let fields = RECORDS.iter().flat_map(|(_, fields)| *fields);
        fields.flat_map(|known| known.needs).copied().filter(|(named, _)| *named == field).collect()
    }

    #[test]
    fn each_field_has_an_effect_or_is_refused() {
        let fields = RECORDS.iter().flat_map(|(record, fields)| fields.iter().map(|field| (*record, *field)));
        for (record, RecordField { name: field, needs, .. }) in fields {
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
    fn the_words_of_a_field_are_known() {
        for (record, fields) in RECORDS {
            for field in fields {
                let (Word(words) | NameOr(_, words)) = field.holds else { continue };
                for word in words.iter().filter(|word| !word.ends_with(" in") && **word != "pareto") {
                    let (_, faults) = program(record, (field.name, word), None);
                    let quoted = format!("`{word}`");
                    assert!(!faults.iter().any(|fault| fault.message.contains(&quoted)), "{record}: {faults:?}");
                }
            }
        }
    }
}
