//! Reads a lesson: a title, fields, paragraphs and a program, and then steps (docs/lessons.md).

use super::checking::{check, one_of};
use super::piece::{Piece, lines};
use super::solving::deed;
use super::wording::{self, Mistake, Mistaken};
use crate::message::{LessonCheck, LessonEntry, LessonGoal, LessonMeasure, LessonStep, LessonTab, WrittenProgram};

pub(super) const HINTS: usize = 3;
const FENCE: &str = "```";
const PROGRAM: &str = "```nb";
const HIDDEN: &str = "```nb hidden";
const OF_LESSON: [&str; 4] = ["chapter", "tab", "best", "hint"];
const OF_STEP: [&str; 3] = ["check", "hint", "do"];

#[derive(Debug)]
pub(super) struct ReadLesson<'a> {
    pub(super) entry: LessonEntry,
    pub(super) program: Option<Piece<'a>>,
    pub(super) typed: Vec<Piece<'a>>,
    /// The hidden tests, each after the number of programs above it.
    pub(super) hidden: Vec<(usize, Piece<'a>)>,
    pub(super) ports: Vec<Piece<'a>>,
    pub(super) mistakes: Vec<Mistaken>,
}

enum Block<'a> {
    Title(Piece<'a>),
    Heading(Piece<'a>),
    Entry(Vec<Piece<'a>>),
    Paragraph(Vec<Piece<'a>>),
    /// The line at the start of a code block, the text in it, and whether it ends.
    Code(Piece<'a>, Piece<'a>, bool),
}

pub(super) fn read<'a>(name: &str, text: &'a str) -> ReadLesson<'a> {
    let entry = LessonEntry {
        name: name.to_owned(),
        title: String::new(),
        chapter: None,
        text: Vec::new(),
        program: None,
        written: None,
        tab: LessonTab::Swarm,
        hints: Vec::new(),
        best: None,
        steps: Vec::new(),
    };
    let lesson = ReadLesson {
        entry,
        program: None,
        typed: Vec::new(),
        hidden: Vec::new(),
        ports: Vec::new(),
        mistakes: Vec::new(),
    };
    let start = lines(text).into_iter().find(|line| !line.text.trim().is_empty()).unwrap_or(Piece { text, at: 0 });
    let mut reader = Reader { lesson, heading: None, types: None, typed: None, fields: Vec::new(), start };
    blocks(text).into_iter().for_each(|block| reader.block(block));
    reader.finished()
}

fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block<'_>> = Vec::new();
    // Whether the next line can belong to the block before it.
    let mut is_open = false;
    let mut rest = lines(text).into_iter();
    while let Some(line) = rest.next() {
        let trimmed = line.trim();
        if trimmed.text.is_empty() {
            is_open = false;
        } else if line.text.starts_with(FENCE) {
            let first = rest.as_slice().first().map_or(line.at + line.text.len(), |next| next.at);
            let end = rest.find(|line| line.text.trim_end() == FENCE);
            let last = end.map_or(text.len(), |end| end.at);
            blocks.push(Block::Code(trimmed, Piece { text: &text[first.min(last)..last], at: first }, end.is_some()));
            is_open = false;
        } else if line.text.starts_with('#') {
            let title = line.after("# ").map(Piece::trim);
            blocks.push(title.map_or(Block::Heading(trimmed), Block::Title));
            is_open = false;
        } else if let Some(entry) = line.after("- ") {
            blocks.push(Block::Entry(vec![entry.trim()]));
            is_open = true;
        } else {
            match blocks.last_mut() {
                Some(Block::Entry(lines)) if is_open && line.text.starts_with(' ') => lines.push(trimmed),
                Some(Block::Paragraph(lines)) if is_open => lines.push(trimmed),
                _ => blocks.push(Block::Paragraph(vec![trimmed])),
            }
            is_open = true;
        }
    }
    blocks
}

struct Reader<'a> {
    lesson: ReadLesson<'a>,
    heading: Option<Piece<'a>>,
    types: Option<Piece<'a>>,
    typed: Option<Piece<'a>>,
    fields: Vec<&'a str>,
    /// The first line, the place of what is missing.
    start: Piece<'a>,
}

impl<'a> Reader<'a> {
    fn mistake(&mut self, piece: Piece<'_>, mistake: Mistake) {
        self.lesson.mistakes.push(mistake.at(piece));
    }

    fn kept<T>(&mut self, read: Result<T, Mistaken>) -> Option<T> {
        read.map_err(|mistaken| self.lesson.mistakes.push(mistaken)).ok()
    }

    fn block(&mut self, block: Block<'a>) {
        match block {
            Block::Title(title) => {
                if self.lesson.entry.title.is_empty() && self.heading.is_none() {
                    self.lesson.entry.title = title.text.to_owned();
                } else {
                    self.mistake(title, wording::SECOND_TITLE);
                }
            }
            Block::Heading(heading) if heading.text == "## Step" => {
                self.end_step();
                self.heading = Some(heading);
                self.lesson.entry.steps.push(LessonStep::default());
            }
            Block::Heading(heading) => self.mistake(heading, wording::HEADING),
            Block::Entry(lines) => self.entry(&lines),
            Block::Paragraph(lines) => self.paragraph(&joined(&lines)),
            Block::Code(fence, text, ends) => self.code(fence, text, ends),
        }
    }

    fn paragraph(&mut self, text: &str) {
        match self.lesson.entry.steps.last_mut() {
            None => self.lesson.entry.text.push(text.to_owned()),
            Some(step) if step.task.is_empty() => step.task = text.to_owned(),
            Some(step) => step.task = format!("{} {text}", step.task),
        }
    }

    fn code(&mut self, fence: Piece<'a>, text: Piece<'a>, ends: bool) {
        let step = self.lesson.entry.steps.last_mut().filter(|_| fence.text == HIDDEN);
        if fence.text != PROGRAM && step.is_none() {
            return self.mistake(fence, wording::LANGUAGE);
        }
        if !ends {
            return self.mistake(fence, wording::OPEN_BLOCK);
        }
        if let Some(step) = step {
            step.checks.push(LessonCheck::Passes { test: text.text.to_owned() });
            let programs = usize::from(self.lesson.program.is_some()) + self.lesson.typed.len();
            self.lesson.hidden.push((programs, text));
        } else if self.heading.is_some() {
            if self.typed.replace(fence).is_some() {
                self.mistake(fence, wording::SECOND_PROGRAM);
            }
            self.lesson.typed.push(text);
        } else if self.lesson.program.is_some() {
            self.mistake(fence, wording::SECOND_PROGRAM);
        } else {
            self.lesson.program = Some(text);
            self.lesson.entry.program = Some(text.text.to_owned());
            self.lesson.entry.written = Some(WrittenProgram::of(text.text));
        }
    }

    fn entry(&mut self, lines: &[Piece<'a>]) {
        let first = lines[0];
        let Some((name, value)) = first.split_once(':') else { return self.mistake(first, wording::NO_FIELD) };
        let (name, value) = (name.trim(), value.trim());
        let known: &[&str] = if self.heading.is_some() { &OF_STEP } else { &OF_LESSON };
        let Some(&field) = known.iter().find(|known| **known == name.text) else {
            return self.lesson.mistakes.push(wording::UNKNOWN_FIELD.at(name).known(known.iter().copied()));
        };
        let text = joined(&[&[value], &lines[1..]].concat());
        if text.is_empty() {
            return self.mistake(name, wording::EMPTY_FIELD);
        }
        if field == "hint" {
            return self.hint(name, text);
        }
        if let Some(&more) = lines.get(1) {
            return self.mistake(more, wording::TOO_MUCH);
        }
        match field {
            "check" => self.check(value),
            "do" => self.deed(value),
            _ if self.fields.contains(&field) => self.mistake(name, wording::FIELD_TWICE),
            "chapter" => {
                self.fields.push("chapter");
                self.lesson.entry.chapter = Some(text);
            }
            "tab" => {
                self.fields.push("tab");
                let tab = one_of(value, &["swarm", "tests", "robots"]);
                self.lesson.entry.tab = match self.kept(tab).as_deref() {
                    Some("tests") => LessonTab::Tests,
                    Some("robots") => LessonTab::Robots,
                    _ => LessonTab::Swarm,
                };
            }
            _ => {
                self.fields.push("best");
                self.lesson.entry.best = goal(value.text);
                if self.lesson.entry.best.is_none() {
                    self.mistake(value, wording::BAD_BEST);
                }
            }
        }
    }

    fn hint(&mut self, name: Piece<'a>, text: String) {
        let lesson = &mut self.lesson.entry;
        let hints = lesson.steps.last_mut().map_or(&mut lesson.hints, |step| &mut step.hints);
        hints.push(text);
        if hints.len() > HINTS {
            self.mistake(name, wording::TOO_MANY_HINTS);
        }
    }

    fn check(&mut self, value: Piece<'a>) {
        let read = check(value, &mut self.lesson.ports);
        // A wrong check counts as one, so that the step is not also reported as one without a check.
        let read = self.kept(read).unwrap_or(LessonCheck::Evolving);
        if let Some(step) = self.lesson.entry.steps.last_mut() {
            step.checks.push(read);
        }
    }

    fn deed(&mut self, value: Piece<'a>) {
        if value.text == "type" {
            self.types = Some(value);
        }
        let read = deed(value, &mut self.lesson.ports);
        self.kept(read);
    }

    fn end_step(&mut self) {
        if let (Some(alone), None) | (None, Some(alone)) = (self.types.take(), self.typed.take()) {
            self.mistake(alone, wording::TYPING);
        }
        if let (Some(heading), Some(step)) = (self.heading, self.lesson.entry.steps.last()) {
            let (has_task, has_check) = (!step.task.is_empty(), !step.checks.is_empty());
            if !has_task {
                self.mistake(heading, wording::NO_TASK);
            }
            if !has_check {
                self.mistake(heading, wording::NO_CHECK);
            }
        }
    }

    fn finished(mut self) -> ReadLesson<'a> {
        self.end_step();
        if self.lesson.entry.title.is_empty() {
            self.mistake(self.start, wording::NO_TITLE);
        }
        if self.lesson.entry.steps.is_empty() {
            self.mistake(self.start, wording::NO_STEPS);
        }
        self.lesson
    }
}

fn goal(text: &str) -> Option<LessonGoal> {
    let (number, of) = text.split_once(' ')?;
    let of = match of.trim() {
        "robots" | "robot" => LessonMeasure::Robots,
        "gates" | "gate" => LessonMeasure::Gates,
        _ => return None,
    };
    let number = number.parse().ok().filter(|&number| number > 0)?;
    Some(LessonGoal { number, of })
}

fn joined(lines: &[Piece<'_>]) -> String {
    lines.iter().map(|line| line.text).collect::<Vec<_>>().join(" ").trim().to_owned()
}
