//! Typing: after any edits, a session finds what it finds in the same text at first sight.

use nbc_base::source::MemoryWorld;
use nbc_session::Session;
use proptest::prelude::*;
use proptest::sample::{Index, select};

use crate::support::*;

const INSERTED: [&str; 27] = [
    "",
    "",
    "a",
    " ",
    "\n",
    "é",
    "// c\n",
    "/* ",
    "*/",
    "#",
    ";",
    "\n;\n",
    "{",
    "}",
    "(",
    "\"",
    "use \"b.nb\"\n",
    "circuit g(a) -> (q) { q = not a }\n",
    "circuit f(a, b) -> (q) { q = h(a) }\n",
    "\n\ntest f { a b | q\n 0 1 | 1 }\n",
    "\nlet n = 3\n",
    "\nmaterial m { period: 42 steps }\n",
    "\nswarm s { circuit: f, registers: mux }\n",
    "\n\nstimulus light\n",
    "\nenum mood { a, calm }\n",
    "\ncircuit p[n = 2](c[n]) -> (r) { r = f(b: c[n - 1], a: calm) }\n",
    "= nand(a, b)",
];

fn session() -> Session {
    let mut world = MemoryWorld::default();
    world.insert("b.nb", "circuit h(a) -> (q) { q = not unknown(a) }\n\ncircuit f(a) -> (q) { q = a }\n");
    Session::new(world)
}

/// All that is known of the text.
fn seen(session: &mut Session, revision: u64, text: &str) -> String {
    session.update("a.nb", revision, text);
    format!("{:?}", session.checked("a.nb"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_changed_text_is_checked_like_a_new_one(
        first in any::<Index>(),
        edits in prop::collection::vec((any::<Index>(), 0..30_usize, select(INSERTED.to_vec())), 1..10),
    ) {
        let small = |path: &PathBuf| fs::metadata(path).is_ok_and(|data| data.len() < 3000);
        let files = programs("tests/ui").into_iter().chain(programs("circuits"));
        let files: Vec<PathBuf> = files.filter(small).collect();
        let mut text = fs::read_to_string(first.get(&files)).unwrap_or_default();
        let mut typing = session();
        seen(&mut typing, 0, &text);
        for (revision, (place, length, new)) in (1..).zip(edits) {
            let mut bounds: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
            bounds.push(text.len());
            let start = place.index(bounds.len());
            let end = (start + length).min(bounds.len() - 1);
            text.replace_range(bounds[start]..bounds[end], new);
            prop_assert_eq!(seen(&mut typing, revision, &text), seen(&mut session(), revision, &text));
        }
    }
}
