//! A source in its canonical form.

use nbc_base::diag::Diagnostics;
use nbc_base::source::{SourceWorld, Sources};
use nbc_lang::{check, syntax};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formatted {
    pub text: String,
    pub is_canonical: bool,
}

pub(super) fn format(world: &dyn SourceWorld, path: &str) -> Result<Formatted, Diagnostics> {
    let mut sources = Sources::default();
    let file = check::open(world, path, &mut sources)?;
    let parsed = syntax::parse(&sources, file);
    if !parsed.errors.is_empty() {
        return Err(Diagnostics { list: parsed.errors, sources });
    }
    let text = syntax::format(&sources, file, &parsed.tree);
    Ok(Formatted { is_canonical: text == sources.file(file).text, text })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::MemoryWorld;

    #[test]
    fn a_source_in_memory_is_formatted_once() {
        let mut world = MemoryWorld::default();
        world.insert("a.nb", "circuit f(a)->(q){q=not a}");
        let first = format(&world, "a.nb").unwrap();
        assert!(!first.is_canonical);
        world.insert("a.nb", first.text.clone());
        assert_eq!(format(&world, "a.nb").unwrap(), Formatted { is_canonical: true, ..first });
        world.insert("a.nb", "circuit f(");
        assert!(format(&world, "a.nb").is_err());
    }
}
