//! The meaning of keywords and fields, from the manual of the language.

use nbc_lang::syntax::tree::RecordKeyword;

const MANUAL: &str = include_str!("../../language.md");

const KEYWORDS: [(&str, &[&str]); 18] = [
    ("Circuits", &["circuit"]),
    ("Constants and buses", &["net"]),
    ("Enumerations", &["enum"]),
    ("Environments", &["environment", "file"]),
    ("Evolutions", &["bins", "evolution"]),
    ("Expressions", &["and", "else", "if", "nand", "nor", "not", "or", "then", "xnor", "xor"]),
    ("Files", &["use"]),
    ("Images", &["images"]),
    ("Libraries, swarms and simulations", &["library", "simulate", "swarm", "with"]),
    ("Memory", &["init"]),
    ("Parameters and `for`", &["for", "in", "let", "log2"]),
    ("Properties", &["always", "assume", "never", "prove", "within"]),
    ("Schedules", &["schedule"]),
    ("Stimuli and materials", &["material", "stimulus"]),
    ("Tests", &["against", "all", "ever", "from", "inputs", "repeat", "test", "until"]),
    ("Truth tables", &["match", "table"]),
    ("Units", &["cycles", "deg", "ms", "s", "steps"]),
    ("Worlds", &["world"]),
];

pub(super) fn keyword(word: &str) -> Option<String> {
    let (heading, _) = KEYWORDS.iter().find(|(_, keywords)| keywords.contains(&word))?;
    meaning(heading, word, None)
}

pub(super) fn field(of: RecordKeyword, word: &str) -> Option<String> {
    let heading = match of {
        RecordKeyword::Material => "Stimuli and materials",
        RecordKeyword::Evolution => "Evolutions",
        RecordKeyword::Images => "Images",
        RecordKeyword::World => "Worlds",
        RecordKeyword::Library | RecordKeyword::Swarm => "Libraries, swarms and simulations",
    };
    let is_there = section(heading)?.contains(&format!("`{word}`"));
    if is_there { meaning(heading, word, row(heading, word)) } else { keyword(word) }
}

fn row(heading: &str, word: &str) -> Option<String> {
    let blocks = blocks(section(heading)?);
    blocks.iter().filter(|block| block.starts_with('|')).find_map(|block| {
        let row = block.lines().skip(2).find(|row| row.split('|').nth(1).is_some_and(|cell| names(cell, word)))?;
        Some(block.lines().take(2).chain([row]).collect::<Vec<_>>().join("\n"))
    })
}

fn names(text: &str, word: &str) -> bool {
    text.split(&format!("`{word}")).skip(1).any(|rest| !rest.starts_with(is_word))
}

/// `row`, or the paragraph that names the word, or the first one; then the first example with the word.
fn meaning(heading: &str, word: &str, row: Option<String>) -> Option<String> {
    let blocks = blocks(section(heading)?);
    let mut prose = blocks.iter().filter(|block| !block.starts_with('|') && !block.starts_with("```"));
    let paragraph = prose.clone().find(|block| names(block, word)).or(prose.next());
    let text = row.or_else(|| paragraph.map(|block| block.to_string()))?;
    let whole = self::blocks(MANUAL);
    let has_word = |block: &&&str| block.starts_with("```nb") && block.split(|c| !is_word(c)).any(|part| part == word);
    let example = blocks.iter().find(has_word).or_else(|| whole.iter().find(has_word));
    let example = example.map_or(String::new(), |block| format!("\n{block}\n"));
    Some(format!("{}\n{example}", without_links(&text)))
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Without the sections inside it.
fn section(heading: &str) -> Option<&'static str> {
    let start = MANUAL.find(&format!("# {heading}\n"))?;
    let body = &MANUAL[start..];
    let body = &body[body.find('\n')?..];
    Some(body.find("\n#").map_or(body, |end| &body[..end]))
}

fn blocks(section: &str) -> Vec<&str> {
    let mut blocks = Vec::new();
    let mut rest = section.trim();
    while !rest.is_empty() {
        let end = match rest.strip_prefix("```") {
            Some(inner) => inner.find("\n```").map(|end| end + "```".len() + "\n```".len()),
            None => rest.find("\n\n"),
        };
        let end = end.unwrap_or(rest.len());
        blocks.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    blocks
}

/// Pages of the manual cannot be opened from an editor.
fn without_links(text: &str) -> String {
    let mut parts = text.split("](");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once(')').filter(|(target, _)| target.ends_with(".md")) {
            Some((_, rest)) => {
                let open = plain.rfind('[').unwrap_or(plain.len());
                plain.replace_range(open..(open + 1).min(plain.len()), "");
                plain.push_str(rest);
            }
            // A call of a circuit with parameters is no link.
            None => plain.push_str(&format!("]({part}")),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_lang::syntax;

    #[test]
    fn every_keyword_has_its_meaning_and_an_example() {
        for word in KEYWORDS.iter().flat_map(|(_, keywords)| *keywords) {
            let text = keyword(word).unwrap_or_else(|| panic!("{word}"));
            let is_unit = ["bins", "cycles", "deg", "ms", "s", "steps"].contains(word);
            assert!(is_unit || text.contains("```nb"), "{word}: {text}");
        }
        assert!(syntax::KEYWORDS.iter().all(|word| keyword(word).is_some()));
    }

    #[test]
    fn a_field_is_explained_by_its_row_or_paragraph() {
        let period = field(RecordKeyword::Material, "period").unwrap();
        assert!(period.starts_with("| field | used by | meaning |\n|---|---|---|\n| `period` | actuator | a time |\n"));
        assert!(field(RecordKeyword::Swarm, "window").unwrap().contains("`window` is the number of cycles"));
        assert_eq!(field(RecordKeyword::Swarm, "nonsense"), None);
    }

    #[test]
    fn links_become_their_text() {
        assert_eq!(without_links("see ([physics](physics.md), 11) `a[3]`"), "see (physics, 11) `a[3]`");
        assert_eq!(without_links("`register[start = 5](d, clk)`"), "`register[start = 5](d, clk)`");
    }
}
