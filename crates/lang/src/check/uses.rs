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
    /// A file that memories begin with.
    File,
    /// A port or another net.
    Net,
    /// A parameter of a circuit, the variable of a loop, or an integer with a name.
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
    /// The name in its declaration.
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

    /// The uses of a declaration in order, its own name included.
    pub fn of(&self, declared: Span) -> impl Iterator<Item = NameUse> + '_ {
        self.list.iter().copied().filter(move |found| found.declared == declared)
    }

    pub fn of_file(&self, file: FileId) -> impl Iterator<Item = NameUse> + '_ {
        self.list.iter().copied().filter(move |found| found.place.file == file)
    }
}

#[cfg(test)]
mod tests {
    use crate::check;
    use nbc_base::source::{MemoryWorld, Sources};

    /// The uses of the name at `at` of a source, as the text of their lines, the declaration first marked by `!`.
    fn uses(text: &str, at: &str) -> Vec<String> {
        let mut sources = Sources::default();
        let file = sources.add("a.nb", text);
        let analysis = check::check(&MemoryWorld::default(), &mut sources, file);
        let found = analysis.uses.at(file, text.find(at).unwrap()).expect("the name has a meaning");
        let line = |place: nbc_base::source::Span| {
            let source = sources.file(place.file);
            let mark = if place == found.declared { "!" } else { "" };
            format!("{mark}{}:{}", source.name, source.line_column(place.start as usize).line)
        };
        analysis.uses.of(found.declared).map(|found| line(found.place)).collect()
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
    fn circuits_are_used_in_calls_and_tests() {
        assert_eq!(uses(PROGRAM, "half"), ["!a.nb:1", "a.nb:11", "a.nb:16", "a.nb:21"]);
    }

    #[test]
    fn ports_are_used_in_bodies_and_tests() {
        assert_eq!(uses(PROGRAM, "b) ->"), ["!a.nb:1", "a.nb:2", "a.nb:3", "a.nb:17", "a.nb:22", "a.nb:23"]);
        assert_eq!(uses(PROGRAM, "c) {"), ["!a.nb:1", "a.nb:3", "a.nb:17", "a.nb:23"]);
    }

    #[test]
    fn parameters_and_variables_are_used_in_sizes() {
        assert_eq!(uses(PROGRAM, "n = 2](a"), ["!a.nb:6", "a.nb:6", "a.nb:7", "a.nb:8", "a.nb:14"]);
        assert_eq!(uses(PROGRAM, "i in"), ["!a.nb:8", "a.nb:9", "a.nb:9"]);
    }

    #[test]
    fn names_of_the_prelude_lead_to_it() {
        let found = uses(PROGRAM, "latch(");
        assert!(found.iter().any(|place| place.starts_with("!standard.nb:")), "{found:?}");
    }

    #[test]
    fn members_and_outputs_are_used_in_the_rows_of_tests_and_simulations() {
        let text = "\
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
        let calm = ["!a.nb:1", "a.nb:3", "a.nb:3", "a.nb:7", "a.nb:10", "a.nb:13"];
        assert_eq!(uses(text, "calm"), calm);
        assert_eq!(uses(text, "ready)"), ["!a.nb:2", "a.nb:4", "a.nb:11"]);
        assert_eq!(uses(text, "n: mood"), ["!a.nb:2", "a.nb:3", "a.nb:9", "a.nb:13"]);
    }

    #[test]
    fn fields_of_records_use_other_declarations() {
        let text = "\
material skin { kind: soft }
schedule short(s1, s2) { 0 0 for 1 cycles 0 1 for 1 cycles 1 0 for 1 cycles 1 1 for 1 cycles }
evolution walk { materials: [skin, bone], variable: short }
library mine { from: walk }
";
        for (name, lines) in [("skin", ["!a.nb:1", "a.nb:3"]), ("short", ["!a.nb:2", "a.nb:3"])] {
            assert_eq!(uses(text, name), lines);
        }
        assert_eq!(uses(text, "walk"), ["!a.nb:3", "a.nb:4"]);
    }
}
