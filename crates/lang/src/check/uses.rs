//! The uses of names, each with the declaration that it refers to, so that editors can lead from one to the other.

use nbc_base::source::{FileId, Span};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NameKind {
    Stimulus,
    Material,
    Schedule,
    Evolution,
    Images,
    Library,
    Swarm,
    World,
    Circuit,
    Enumeration,
    Member,
    File,
    Net,
    Number,
}

impl NameKind {
    pub fn word(self) -> &'static str {
        match self {
            Self::Stimulus => "stimulus",
            Self::Material => "material",
            Self::Schedule => "schedule",
            Self::Evolution => "evolution",
            Self::Images => "set of images",
            Self::Library => "library",
            Self::Swarm => "swarm",
            Self::World => "world",
            Self::Circuit => "circuit",
            Self::Enumeration => "enumeration",
            Self::Member => "member of an enumeration",
            Self::File => "file",
            Self::Net => "net",
            Self::Number => "number",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct NameUse {
    /// A declaration's name refers to itself.
    pub place: Span,
    pub declared: Span,
    pub kind: NameKind,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NameUses {
    /// In order of place.
    list: Vec<NameUse>,
}

impl NameUses {
    pub(crate) fn new(mut list: Vec<NameUse>) -> Self {
        list.sort_unstable();
        list.dedup();
        Self { list }
    }

    /// The name at a byte of a file, or the one that ends just before it.
    pub fn at(&self, file: FileId, offset: usize) -> Option<NameUse> {
        let end = self.list.partition_point(|found| (found.place.file, found.place.start as usize) <= (file, offset));
        let covers = |found: &&NameUse| found.place.file == file && offset <= found.place.end as usize;
        self.list[..end].last().filter(covers).copied()
    }

    pub fn of(&self, declared: Span) -> impl Iterator<Item = NameUse> + '_ {
        self.list.iter().copied().filter(move |found| found.declared == declared)
    }

    pub fn of_file(&self, file: FileId) -> impl Iterator<Item = NameUse> + '_ {
        self.list.iter().copied().filter(move |found| found.place.file == file)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;
    use nbc_base::source::{MemoryWorld, Sources};

    /// The lines of the uses of the name at `at` of a source; `!` marks that of the declaration.
    fn uses(text: &str, at: &str) -> String {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", text);
        let analysis = check::check(&MemoryWorld::default(), &mut sources, file);
        let found = analysis.uses.at(file, text.find(at).unwrap()).expect("the name has a meaning");
        let uses = analysis.uses.of(found.declared).map(|NameUse { place, declared, .. }| {
            let source = sources.file(place.file);
            let (mark, line) =
                (if place == declared { "!" } else { "" }, source.line_column(place.start as usize).line);
            if place.file == file { format!("{mark}{line}") } else { format!("{mark}{}", source.name) }
        });
        uses.collect::<Vec<_>>().join(" ")
    }

    const PROGRAM: &str = "\
circuit half(a, b) -> (s, c) {
    s = a xor b
    c = a and b
}

circuit chain[n = 2](a[n]) -> (q) {
    net t[n]
    for i in 0..n {
        t[i] = latch(a[i], a[0])
    }
    (q, _) = half(t[0], t[1])
}

swarm walkers { circuit: chain[n = 2] }

test half {
    a b | c
    1 1 | 1
}

test half for all inputs {
    s = not (a == b)
    c = a and b
}
";

    #[test]
    fn names_are_used_in_bodies_calls_sizes_rows_and_fields() {
        for (at, expected) in [
            ("half", "!1 11 16 21"),
            ("b) ->", "!1 2 3 17 22 23"),
            ("c) {", "!1 3 17 23"),
            ("n = 2](a", "!6 6 7 8 14"),
            ("i in", "!8 9 9"),
        ] {
            assert_eq!(uses(PROGRAM, at), expected, "{at}");
        }
        assert!(uses(PROGRAM, "latch(").contains("!standard.nb"), "a name of the prelude leads to it");
        let rows = "\
enum mood { calm, busy }
circuit turn(m: mood) -> (n: mood, ready) {
    n = if m == calm then busy else calm
    ready = m == busy
}
swarm turners { circuit: turn }
simulate turners with schedule (m) { calm for 4 cycles busy for 4 cycles }
test turn {
    m    | n
    calm | busy
    busy | -     until ready, at most 3 rows
    repeat 2 {
        calm | - until n = busy, at most 3 rows
    }
}
";
        for (at, expected) in [("calm", "!1 3 3 7 10 13"), ("ready)", "!2 4 11"), ("n: mood", "!2 3 9 13")] {
            assert_eq!(uses(rows, at), expected, "{at}");
        }
        let fields = "\
material skin { kind: soft }
schedule short(s1, s2) { 0 0 for 1 cycles 0 1 for 1 cycles 1 0 for 1 cycles 1 1 for 1 cycles }
evolution walk { materials: [skin, bone], variable: short }
library mine { from: walk }
";
        for (at, expected) in [("skin", "!1 3"), ("short", "!2 3"), ("walk", "!3 4")] {
            assert_eq!(uses(fields, at), expected, "{at}");
        }
    }
}
