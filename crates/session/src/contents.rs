//! The first contents of memories: words from the files that a program declares.

use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{MemoryArray, Program};
use nbc_base::source::{SourceWorld, without_mark};
use nbc_circuit::elaborate::MemoryPorts;

pub(super) fn declared_file(program: &Program, name: &str) -> Result<(), Diagnostic> {
    let Some(place) = program.files.iter().position(|file| file.name == name) else {
        return Err(wording::unknown_file(name, program.files.iter().map(|file| file.name.as_str())));
    };
    let mut memories = program.circuits.iter().flat_map(|circuit| &circuit.memories);
    if memories.any(|memory| memory.contents == Some(place)) { Ok(()) } else { Err(wording::unused_file(name)) }
}

pub(super) fn first_words(
    world: &dyn SourceWorld,
    program: &Program,
    memory: &MemoryArray,
    ports: &MemoryPorts,
    files: &[(String, String)],
) -> Result<Vec<u128>, Diagnostic> {
    let Some(declared) = memory.contents.and_then(|place| program.files.get(place)) else { return Ok(Vec::new()) };
    let chosen = files.iter().find(|(name, _)| *name == declared.name).map(|(_, path)| path.as_str());
    let path = chosen.unwrap_or(&declared.path);
    let bytes = world.read_bytes(path).map_err(|error| {
        let fault = Diagnostic::unreadable_in(world, path, &error);
        if chosen.is_some() { fault } else { wording::of_declared_file(fault, declared.span) }
    })?;
    let fault = match words(path, &bytes, ports) {
        Ok(Words::All(words)) => return Ok(words),
        Ok(Words::TooMany(found)) => wording::too_many_words(path, found, ports.words),
        Err(line) => wording::no_word(path, line),
    };
    Err(if chosen.is_some() { fault } else { wording::of_words(fault, declared.span) })
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Words {
    All(Vec<u128>),
    TooMany(usize),
}

/// The words of a file by its ending: `.bin` has bytes, the lowest of a word first; `.csv` numbers between commas and
/// ends of lines; any other, such as `.hex`, hexadecimal digits between blanks, with `@` before the place of the next
/// word. The error is the number of a line.
fn words(path: &str, bytes: &[u8], memory: &MemoryPorts) -> Result<Words, usize> {
    let width = memory.width;
    if path.ends_with(".bin") {
        let word = |bytes: &[u8]| bytes.iter().rev().fold(0u128, |word, &byte| word << 8 | u128::from(byte));
        let chunks = bytes.chunks(width.div_ceil(8).min(16));
        let found = chunks.len();
        return Ok(if found > memory.words { Words::TooMany(found) } else { Words::All(chunks.map(word).collect()) });
    }
    let text = String::from_utf8_lossy(bytes);
    let text = without_mark(&text);
    let is_table = path.ends_with(".csv");
    let mut words: Vec<u128> = Vec::new();
    let (mut place, mut found) = (0, 0);
    for (line, text) in text.lines().enumerate() {
        let text = text.split("//").next().unwrap_or_default().split('#').next().unwrap_or_default();
        let parts = text.split(|c: char| c.is_whitespace() || (is_table && c == ',')).filter(|part| !part.is_empty());
        for part in parts {
            if let Some(at) = part.strip_prefix('@') {
                place = usize::from_str_radix(at, 16).ok().filter(|at| *at < 1 << 30).ok_or(line + 1)?;
                continue;
            }
            let digits = part.replace('_', "");
            let value = match digits.strip_prefix("0x") {
                Some(digits) => u128::from_str_radix(digits, 16),
                None => u128::from_str_radix(&digits, if is_table { 10 } else { 16 }),
            };
            let value = value.ok().filter(|value| width >= 128 || value >> width == 0).ok_or(line + 1)?;
            if place < memory.words {
                words.resize(words.len().max(place + 1), 0);
                words[place] = value;
            }
            place += 1;
            found = found.max(place);
        }
    }
    Ok(if found > memory.words { Words::TooMany(found) } else { Words::All(words) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(path: &str, bytes: &[u8], width: usize) -> Result<Words, usize> {
        super::words(path, bytes, &MemoryPorts { memory: 0, words: 5, width, reads: Vec::new(), writes: Vec::new() })
    }

    #[test]
    fn files_have_words_by_their_endings() {
        let all = |words: &[u128]| Ok(Words::All(words.to_vec()));
        assert_eq!(words("a.hex", b"0000_00ff 12 // x\n@4 7\n", 32), all(&[255, 18, 0, 0, 7]));
        assert_eq!(words("a.csv", b"1, 2\n0x10,4\n", 8), all(&[1, 2, 16, 4]));
        assert_eq!(words("a.bin", &[1, 2, 3, 4, 5], 16), all(&[0x201, 0x403, 5]));
        assert_eq!(words("a.hex", b"12\n100\n", 8), Err(2));
        assert_eq!(words("a.hex", b"zz\n", 8), Err(1));
    }

    #[test]
    fn words_beyond_the_memory_are_counted_and_not_kept() {
        assert_eq!(words("a.hex", b"@3fffffff 7\n", 8), Ok(Words::TooMany(1 << 30)));
        assert_eq!(words("a.csv", b"1,2,3,4,5,6\n", 8), Ok(Words::TooMany(6)));
        assert_eq!(words("a.bin", &[0; 6], 8), Ok(Words::TooMany(6)));
    }
}
