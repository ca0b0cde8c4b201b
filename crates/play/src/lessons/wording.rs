//! The mistakes of a lesson's author, and their messages.

use std::ops::Range;

use super::piece::Piece;
use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Suggestion, io_words};
use nbc_base::source::{FileId, Span};

pub(super) fn unreadable(path: &str, error: &std::io::Error) -> Diagnostic {
    let message = format!("cannot read `{path}`: {}", io_words(error));
    Diagnostic::without_place(Code::Unreadable, message)
}

pub(super) fn no_lessons(path: &str) -> Diagnostic {
    let message = format!("no lessons in `{path}`");
    Diagnostic::without_place(Code::Empty, message).with_help("a lesson is a file such as `01-first.md`")
}

pub(super) fn too_large(path: &str, what: &str, most: usize) -> Diagnostic {
    Diagnostic::without_place(Code::TooLarge, format!("`{path}` has more than {most} {what}"))
}

/// What is wrong in a lesson; `{}` in the message stands for the text at the place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mistake {
    code: Code,
    message: &'static str,
    label: &'static str,
    help: Option<&'static str>,
}

impl Mistake {
    const fn new(code: Code, message: &'static str, label: &'static str) -> Self {
        Self { code, message, label, help: None }
    }

    const fn help(self, help: &'static str) -> Self {
        Self { help: Some(help), ..self }
    }

    pub(super) fn at(self, piece: Piece<'_>) -> Mistaken {
        let place = piece.at..piece.at + piece.text.len();
        Mistaken { mistake: self, place, text: piece.text.to_owned(), known: None }
    }
}

pub(super) const FILE_NAME: Mistake = Mistake::new(Code::BadValue, "`{}` cannot be the name of a lesson", "")
    .help("name it with letters, digits, `-` and `_`, such as `01-first.md`");
pub(super) const NAME_TAKEN: Mistake =
    Mistake::new(Code::Duplicate, "two lessons are called `{}`", "").help("the number before the name does not count");
pub(super) const NO_TITLE: Mistake = Mistake::new(Code::MissingField, "missing title", "the lesson begins here")
    .help("begin with a line such as `# My lesson`");
pub(super) const SECOND_TITLE: Mistake =
    Mistake::new(Code::Duplicate, "a lesson has one title", "a second title").help("begin a step with `## Step`");
pub(super) const HEADING: Mistake = Mistake::new(Code::Unknown, "unknown heading `{}`", "expected `## Step`");
pub(super) const NO_STEPS: Mistake =
    Mistake::new(Code::Empty, "the lesson has no steps", "the lesson begins here").help("begin a step with `## Step`");
pub(super) const NO_TASK: Mistake =
    Mistake::new(Code::MissingField, "the step has no task", "of this step").help("write what to do below the heading");
pub(super) const NO_CHECK: Mistake =
    Mistake::new(Code::MissingField, "the step has no check", "of this step").help("for example `- check: keeps q=1`");
pub(super) const NO_FIELD: Mistake = Mistake::new(Code::Syntax, "`{}` is not a field", "expected `name: value`");
pub(super) const UNKNOWN_FIELD: Mistake = Mistake::new(Code::UnknownField, "unknown field `{}`", "unknown");
pub(super) const FIELD_TWICE: Mistake = Mistake::new(Code::Duplicate, "a second `{}`", "there is one already");
pub(super) const EMPTY_FIELD: Mistake = Mistake::new(Code::MissingField, "`{}` has no value", "");
pub(super) const TOO_MANY_HINTS: Mistake = Mistake::new(Code::OutOfRange, "more than 3 hints here", "one too many");
pub(super) const LANGUAGE: Mistake = Mistake::new(Code::Syntax, "a program is in a block of `nb`", "this block is not")
    .help("begin it with three backticks and `nb`");
pub(super) const OPEN_BLOCK: Mistake = Mistake::new(Code::Syntax, "the program does not end", "it begins here")
    .help("end it with a line of three backticks");
pub(super) const SECOND_PROGRAM: Mistake = Mistake::new(Code::Duplicate, "a second program", "it begins here");
pub(super) const UNKNOWN_WORD: Mistake = Mistake::new(Code::Unknown, "unknown word `{}`", "unknown");
pub(super) const UNKNOWN_GATE: Mistake = Mistake::new(Code::Unknown, "unknown gate `{}`", "unknown");
pub(super) const UNKNOWN_PORT: Mistake =
    Mistake::new(Code::Unknown, "no circuit of the program has a port `{}`", "unknown");
pub(super) const NO_PROGRAM: Mistake = Mistake::new(Code::Unknown, "there is no port `{}` without a program", "")
    .help("add a program before the first step");
pub(super) const PORT_TWICE: Mistake = Mistake::new(Code::Duplicate, "a second value of `{}`", "given already");
pub(super) const NO_VALUE: Mistake =
    Mistake::new(Code::Syntax, "expected a port and its value, found `{}`", "").help("for example `a=1`");
pub(super) const BAD_NUMBER: Mistake =
    Mistake::new(Code::Value, "expected a number, found `{}`", "").help("for example `5`, `0b101` or `0x1f`");
pub(super) const BAD_BEST: Mistake = Mistake::new(Code::Value, "expected a number of robots or gates, found `{}`", "")
    .help("for example `best: 4 robots`");
pub(super) const INCOMPLETE: Mistake =
    Mistake::new(Code::Syntax, "`{}` needs more words", "after this").help("docs/lessons.md has all checks");
pub(super) const TOO_MUCH: Mistake = Mistake::new(Code::Syntax, "unexpected `{}`", "nothing may follow here");
pub(super) const TYPING: Mistake = Mistake::new(Code::Syntax, "`do: type` and a program belong together", "")
    .help("the program of a step is what `do: type` types");

#[derive(Debug)]
pub(super) struct Mistaken {
    mistake: Mistake,
    place: Range<usize>,
    text: String,
    known: Option<Vec<String>>,
}

impl Mistaken {
    pub(super) fn known<S: ToString>(self, known: impl IntoIterator<Item = S>) -> Self {
        Self { known: Some(known.into_iter().map(|word| word.to_string()).collect()), ..self }
    }

    pub(super) fn called(self, text: &str) -> Self {
        Self { text: text.to_owned(), ..self }
    }

    pub(super) fn worded(&self, file: FileId) -> Diagnostic {
        let Self { mistake: Mistake { code, message, label, help }, place, text, known } = self;
        let span = Span::new(file, place.start, place.end);
        let found = Diagnostic::new(*code, message.replace("{}", text), span, *label);
        let found = if let Some(help) = help { found.with_help(*help) } else { found };
        let Some(known) = known else { return found };
        // The nearest known word, or all of them.
        match Suggestion::near(text, known.iter().map(String::as_str)) {
            Suggestion::None if known.len() <= 20 => found.with_help(format!("expected {}", alternatives(known, "or"))),
            near => found.with_suggestion(None, &near),
        }
    }
}
