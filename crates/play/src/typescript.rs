//! The types of the messages for the page: `web/src/protocol.ts` is made from those of the requests and of the
//! server's messages. `NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play protocol` rewrites it.

use std::any::TypeId;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use ts_rs::{Config, TS, TypeVisitor};

use crate::message::{ClassCourse, ClassRoll, ServerMessage};
use crate::request::Request;

const HEAD: &str = "\
// Generated from the messages of crates/play: NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play protocol
// docs/play-protocol.md describes them.
";

struct Declared {
    config: Config,
    seen: BTreeSet<TypeId>,
    texts: BTreeMap<String, String>,
}

impl TypeVisitor for Declared {
    fn visit<T: TS + 'static + ?Sized>(&mut self) {
        if !self.seen.insert(TypeId::of::<T>()) {
            return;
        }
        // Only types of our own have a file to be written to.
        if T::output_path().is_some() {
            let docs = T::docs().unwrap_or_default();
            let text = lines(&format!("{docs}export {}", T::decl(&self.config)));
            self.texts.insert(T::ident(&self.config), text);
        }
        T::visit_dependencies(self);
    }
}

fn lines(declaration: &str) -> String {
    let is_union = declaration.contains("} |") || declaration.contains("} &");
    let (mut text, mut indent, mut is_comment, mut brackets) = (String::new(), "", false, 0);
    let mut words = declaration.split_whitespace().filter(|word| *word != "*").peekable();
    while let Some(word) = words.next() {
        let count = |some: [char; 2]| word.matches(some).count() as i32;
        match word {
            "/**" => is_comment = true,
            "{" if !is_union && !is_comment => indent = "  ",
            "};" if !is_union => text.truncate(text.trim_end().len() + 1),
            "|" if words.peek().is_some_and(|next| next.starts_with('{')) => {
                text.truncate(text.trim_end().len());
                text += "\n  ";
            }
            _ if !is_comment => brackets += count(['[', '<']) - count([']', '>']),
            _ => {}
        }
        text += word;
        let is_field = word == "{" || word.ends_with(',') && brackets == 0;
        if word == "*/" || is_field && !is_comment && !is_union {
            text.push('\n');
            text += indent;
        } else {
            text.push(' ');
        }
        is_comment &= word != "*/";
    }
    text.trim_end().to_owned()
}

#[test]
fn the_protocol_of_the_page_is_that_of_the_server() {
    let config = Config::new().with_large_int("number").with_array_tuple_limit(5);
    let mut declared = Declared { config, seen: BTreeSet::new(), texts: BTreeMap::new() };
    declared.visit::<Request>();
    declared.visit::<ServerMessage>();
    declared.visit::<ClassCourse>();
    declared.visit::<ClassRoll>();
    let texts: Vec<String> = declared.texts.into_values().collect();
    let expected = format!("{HEAD}\n{}\n", texts.join("\n\n"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web/src/protocol.ts");
    if std::env::var_os("NBC_UPDATE_PROTOCOL").is_some() {
        fs::write(&path, &expected).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap();
    assert!(found == expected, "web/src/protocol.ts is not as NBC_UPDATE_PROTOCOL=1 cargo test -p nbc-play writes it");
}
