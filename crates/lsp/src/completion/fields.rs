//! The fields of declarations and their possible values. `tests` compares them with the checker.

use std::iter;

use nbc_base::model::Variation;
use nbc_lang::check::NameKind;

/// The possible values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Holds {
    /// One of these words, or anything else that is not completed.
    Words(&'static [&'static str]),
    /// A name of this kind, or one of the words.
    Name(NameKind, &'static [&'static str]),
    /// A function or a behavior.
    Function,
}

/// The fields of a declaration with that keyword.
pub(super) fn of(keyword: &str) -> &'static [(&'static str, Holds)] {
    match keyword {
        "material" => &MATERIAL,
        "evolution" => &EVOLUTION,
        "images" => &IMAGES,
        "library" => &LIBRARY,
        "swarm" => &SWARM,
        "world" => &WORLD,
        _ => &[],
    }
}

/// The fields of the record that is the value of a field.
pub(super) fn inside(field: &str) -> Vec<&'static str> {
    match field {
        "mutation" => vec!["add_node", "remove_node", "add_link", "remove_link", "change_activation", "change_weight"],
        "vary" => iter::once(Variation::ALL).chain(Variation::NAMES).collect(),
        _ => Vec::new(),
    }
}

const MATERIAL: [(&str, Holds); 8] = [
    ("kind", Holds::Words(&["actuator", "rigid", "sensor", "soft"])),
    ("drive", Holds::Words(&["sine"])),
    ("period", Holds::Words(&[])),
    ("phase", Holds::Words(&[])),
    ("range", Holds::Words(&[])),
    ("stimulus", Holds::Name(NameKind::Stimulus, &[])),
    ("absent", Holds::Words(&[])),
    ("present", Holds::Words(&[])),
];

const EVOLUTION: [(&str, Holds); 23] = [
    ("from", Holds::Name(NameKind::Evolution, &[])),
    ("box", Holds::Words(&[])),
    ("materials", Holds::Name(NameKind::Material, &[])),
    ("genome", Holds::Words(&["cppn", "voxels"])),
    ("crossover", Holds::Words(&[])),
    ("start", Holds::Name(NameKind::Library, &[])),
    ("variable", Holds::Name(NameKind::Schedule, &[])),
    ("shown", Holds::Words(&["apart", "in_turn"])),
    ("fixed", Holds::Words(&[])),
    ("descriptors", Holds::Words(&["active in", "behavior", "class", "sensory in", "voxels in"])),
    ("batch", Holds::Words(&[])),
    ("newcomers", Holds::Words(&[])),
    ("generations", Holds::Words(&[])),
    ("seed", Holds::Words(&[])),
    ("mutation", Holds::Words(&[])),
    ("as", Holds::Words(&["code", "paper"])),
    ("objective", Holds::Words(&["distance", "gate", "images", "wave"])),
    ("behaviors", Holds::Function),
    ("symmetry", Holds::Words(&["none", "npn"])),
    ("niche", Holds::Words(&["dominance", "pareto"])),
    ("world", Holds::Name(NameKind::World, &[])),
    ("vary", Holds::Words(&[])),
    ("worlds", Holds::Words(&[])),
];

const IMAGES: [(&str, Holds); 5] = [
    ("stimulus", Holds::Name(NameKind::Stimulus, &[])),
    ("from", Holds::Words(&[])),
    ("white", Holds::Words(&[])),
    ("label", Holds::Words(&[])),
    ("take", Holds::Words(&[])),
];

const LIBRARY: [(&str, Holds); 3] = [
    ("from", Holds::Name(NameKind::Evolution, &["shipped", "three"])),
    ("behaviors", Holds::Function),
    ("without", Holds::Words(&[])),
];

const SWARM: [(&str, Holds); 8] = [
    ("circuit", Holds::Name(NameKind::Circuit, &[])),
    ("library", Holds::Name(NameKind::Library, &[])),
    ("hold", Holds::Words(&["auto"])),
    ("window", Holds::Words(&[])),
    ("registers", Holds::Words(&["master_slave", "mux", "waves"])),
    ("beat", Holds::Words(&[])),
    ("step", Holds::Words(&[])),
    ("world", Holds::Name(NameKind::World, &[])),
];

const WORLD: [(&str, Holds); 13] = [
    ("from", Holds::Name(NameKind::World, &[])),
    ("friction", Holds::Words(&[])),
    ("gravity", Holds::Words(&[])),
    ("stiffness", Holds::Words(&[])),
    ("drag", Holds::Words(&[])),
    ("damping", Holds::Words(&[])),
    ("swelling", Holds::Words(&[])),
    ("ground", Holds::Words(&[])),
    ("start", Holds::Words(&[])),
    ("missed", Holds::Words(&[])),
    ("weak", Holds::Words(&[])),
    ("dead", Holds::Words(&[])),
    ("seed", Holds::Words(&[])),
];

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::{MemoryWorld, Sources};
    use nbc_lang::check;

    fn messages(text: &str) -> String {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", text);
        let found = check::check(&MemoryWorld::default(), &mut sources, file).diagnostics;
        found.iter().map(|fault| format!("{} {}\n", fault.message, fault.help.as_deref().unwrap_or_default())).collect()
    }

    #[test]
    fn the_fields_are_those_of_the_checker() {
        let kinds = ["actuator", "sensor"].map(|kind| format!("material x {{ kind: {kind}, qqqqq: 1 }}"));
        let others =
            ["evolution", "images", "library", "swarm", "world"].map(|keyword| format!("{keyword} x {{ qqqqq: 1 }}"));
        let known: String = kinds.iter().chain(&others).map(|text| messages(text)).collect();
        for keyword in ["material", "evolution", "images", "library", "swarm", "world"] {
            let own = known.lines().filter(|line| line.starts_with(&format!("the {keyword} ")));
            let own: Vec<&str> =
                own.filter_map(|line| line.split_once("its fields are ")).map(|(_, list)| list).collect();
            let mut listed: Vec<&str> = own.iter().flat_map(|list| list.split('`').skip(1).step_by(2)).collect();
            let mut mine: Vec<&str> = of(keyword).iter().map(|(field, _)| *field).collect();
            listed.sort_unstable();
            listed.dedup();
            mine.sort_unstable();
            assert_eq!(mine, listed, "{keyword}: {known}");
        }
        let values = |field: &str, value: u32| {
            inside(field).iter().map(|name| format!("{name}: {value}")).collect::<Vec<_>>().join(", ")
        };
        let (mutation, vary) = (values("mutation", 1), values("vary", 0));
        let text = format!("evolution x {{ objective: gate, mutation: {{ {mutation} }}, vary: {{ {vary} }} }}");
        assert_eq!(messages(&text), "");
    }

    #[test]
    fn the_words_are_those_of_the_checker() {
        for (keyword, start) in
            [("material", ""), ("evolution", ""), ("images", ""), ("library", ""), ("swarm", ""), ("world", "")]
        {
            for (field, holds) in of(keyword) {
                let (Holds::Words(words) | Holds::Name(_, words)) = holds else { continue };
                for word in words.iter().filter(|word| !word.ends_with(" in") && **word != "pareto") {
                    let found = messages(&format!("{keyword} x {{ {start}{field}: {word} }}"));
                    assert!(!found.contains(&format!("`{word}`")), "{keyword} {field}: {found}");
                }
            }
        }
    }
}
