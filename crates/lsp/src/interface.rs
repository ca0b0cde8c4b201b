//! The name, parameters and ports of a circuit as they are written in its declaration.

use std::ops::Range;

use crate::files::Files;
use nbc_base::model::{Circuit, Net};
use nbc_base::source::Span;

pub(super) struct Interface {
    pub(super) name: String,
    pub(super) parameters: Vec<String>,
    pub(super) inputs: Vec<WrittenPort>,
    outputs: Vec<WrittenPort>,
    pub(super) comment: String,
}

pub(super) struct WrittenPort {
    pub(super) name: String,
    /// With its width: `a[8]`.
    text: String,
}

impl Interface {
    pub(super) fn of(files: &Files<'_>, circuit: &Circuit) -> Self {
        let source = &files.checked.sources.file(circuit.span.file).text;
        let port = |net: &Net| WrittenPort { name: net.name.clone(), text: entry(source, net.span).to_owned() };
        let (inputs, rest) = circuit.nets.split_at(circuit.inputs);
        Self {
            name: circuit.name.clone(),
            parameters: circuit.parameters.iter().map(|parameter| parameter.name.clone()).collect(),
            inputs: inputs.iter().map(port).collect(),
            outputs: rest[..circuit.outputs].iter().map(port).collect(),
            comment: comment(source, circuit.span),
        }
    }

    pub(super) fn label(&self) -> String {
        let list = |ports: &[WrittenPort]| ports.iter().map(|port| port.text.as_str()).collect::<Vec<_>>().join(", ");
        format!("{}({}) -> ({})", self.head(), list(&self.inputs), list(&self.outputs))
    }

    pub(super) fn parameter_places(&self) -> Vec<Range<usize>> {
        places(self.name.len() + 1, self.parameters.iter().map(String::as_str))
    }

    pub(super) fn input_places(&self) -> Vec<Range<usize>> {
        places(self.head().len() + 1, self.inputs.iter().map(|port| port.text.as_str()))
    }

    fn head(&self) -> String {
        match &self.parameters[..] {
            [] => self.name.clone(),
            parameters => format!("{}[{}]", self.name, parameters.join(", ")),
        }
    }
}

fn places<'t>(start: usize, words: impl Iterator<Item = &'t str>) -> Vec<Range<usize>> {
    let place = |at: &mut usize, word: &str| {
        let start = *at;
        *at += word.len() + ", ".len();
        Some(start..start + word.len())
    };
    words.scan(start, place).collect()
}

pub(super) fn entry(text: &str, place: Span) -> &str {
    let rest = &text[place.end as usize..];
    let end = match rest.as_bytes().first() {
        Some(b'[') => rest.find(']').map_or(0, |end| end + 1),
        _ => 0,
    };
    &text[place.start as usize..place.end as usize + end]
}

pub(super) fn comment(text: &str, place: Span) -> String {
    let line = text[..place.start as usize].rfind('\n').map_or(0, |end| end + 1);
    let mut lines: Vec<&str> = text[..line]
        .lines()
        .rev()
        .map_while(|line| line.trim_start().strip_prefix("//"))
        .take_while(|line| !line.starts_with('!'))
        .map(|line| line.trim_start_matches('/').trim())
        .collect();
    lines.reverse();
    lines.join("\n")
}
