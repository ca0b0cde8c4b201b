//! The editor's grammar: it tokenizes the gallery, and every word has the correct scope.

use regex::Regex;

use crate::support::*;

/// A rule of the grammar: a pattern, the scope of the whole match, and the scopes of its groups.
struct Rule {
    pattern: Regex,
    scope: Option<String>,
    captures: Vec<(usize, String)>,
}

fn read(path: &str) -> Value {
    let text = fs::read_to_string(root().join("editors/vscode").join(path)).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn rules() -> Vec<Rule> {
    let grammar = read("syntaxes/nb.tmLanguage.json");
    let rule = |include: &Value| {
        let name = include["include"].as_str().unwrap().trim_start_matches('#');
        let rule = &grammar["repository"][name];
        let captures = rule["captures"].as_object().into_iter().flatten();
        Rule {
            pattern: Regex::new(rule["match"].as_str().unwrap()).unwrap(),
            scope: rule["name"].as_str().map(str::to_owned),
            captures: captures
                .map(|(at, one)| (at.parse().unwrap(), one["name"].as_str().unwrap().to_owned()))
                .collect(),
        }
    };
    grammar["patterns"].as_array().unwrap().iter().map(rule).collect()
}

/// The words of a line with their scopes, as an editor finds them: at each position the leftmost match; of equal ones,
/// the first rule's.
fn tokens<'a>(rules: &[Rule], line: &'a str) -> Vec<(&'a str, String)> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < line.len() {
        let found = rules.iter().filter_map(|rule| Some((rule, rule.pattern.captures_at(line, at)?)));
        let Some((rule, captures)) = found.min_by_key(|(_, captures)| captures.get(0).unwrap().start()) else { break };
        let whole = captures.get(0).unwrap();
        assert!(line[at..whole.start()].trim().is_empty(), "{line:?}: nothing matches {:?}", &line[at..whole.start()]);
        tokens.extend(rule.scope.as_ref().map(|scope| (whole.as_str(), scope.clone())));
        for (group, scope) in &rule.captures {
            tokens.extend(captures.get(*group).map(|group| (group.as_str(), scope.clone())));
        }
        assert!(whole.end() > at, "{line:?}: a rule matches nothing");
        at = whole.end();
    }
    assert!(line[at..].trim().is_empty(), "{line:?}: nothing matches {:?}", &line[at..]);
    tokens
}

fn expected(word: &str) -> Option<&'static str> {
    Some(match word {
        "and" | "or" | "xor" | "nand" | "nor" | "xnor" | "not" => "keyword.operator.word",
        "if" | "then" | "else" | "for" | "in" | "init" | "net" | "table" | "use" => "keyword.control",
        "circuit" | "test" | "material" | "evolution" | "swarm" => "keyword.declaration",
        "cycles" | "steps" | "deg" => "keyword.other.unit",
        _ if word.starts_with("//") => "comment",
        _ if word.starts_with('"') => "string",
        _ if word.starts_with(|c: char| c.is_ascii_digit()) => "constant.numeric",
        _ => return None,
    })
}

#[test]
fn the_gallery_and_the_prelude_are_highlighted() {
    let rules = rules();
    let mut seen = 0;
    for path in programs("circuits").into_iter().chain(programs("library")) {
        for line in fs::read_to_string(&path).unwrap().lines() {
            for (word, scope) in tokens(&rules, line) {
                let rest = &line[word.as_ptr() as usize - line.as_ptr() as usize + word.len()..];
                let is_field = rest.trim_start().starts_with(':');
                if let Some(expected) = expected(word).map(|expected| match expected {
                    "keyword.declaration" if is_field => "variable.other.property",
                    _ => expected,
                }) {
                    assert!(scope.starts_with(expected), "{}: {line:?}: {word:?} is {scope}", path.display());
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 500, "{seen} words were looked at");
}

#[test]
fn the_extension_holds_together() {
    let manifest = read("package.json");
    let contributes = &manifest["contributes"];
    for (kind, field) in [("languages", "configuration"), ("grammars", "path"), ("snippets", "path")] {
        read(contributes[kind][0][field].as_str().unwrap());
    }
    assert_eq!(contributes["languages"][0]["extensions"][0], ".nb");
    assert_eq!(read("syntaxes/nb.tmLanguage.json")["scopeName"], contributes["grammars"][0]["scopeName"]);
}

#[test]
fn every_snippet_is_a_program_or_a_part_of_one() {
    let holes = Regex::new(r"\$\{\d+:([^}]*)\}|\$0").unwrap();
    for (name, snippet) in read("snippets/nb.json").as_object().unwrap() {
        let lines: Vec<_> = snippet["body"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect();
        // A placeholder is replaced by its own text.
        let text = holes.replace_all(&lines.join("\n"), "$1").into_owned();
        let program = match name.as_str() {
            "for" => format!("circuit f(a) -> (q) {{\n q = a\n {text}\n}}"),
            "table" => format!("circuit f(a, b) -> (q) {{\n q = {text}\n}}"),
            _ => text,
        };
        let mut sources = nbc_base::source::Sources::default();
        let file = sources.add(name.clone(), program.clone());
        assert_eq!(nbc_lang::syntax::parse(&sources, file).errors, [], "{program}");
    }
}
