//! The messages of mistakes in lesson files.

use super::mistake::{LessonMistake, Mistaken};
use nbc_base::diag::suggest::alternatives;
use nbc_base::diag::{Code, Diagnostic, Suggestion, counted, io_words};
use nbc_base::source::{FileId, Span};

/// A folder or file of lessons that cannot be read.
pub(super) fn unreadable(path: &str, error: &std::io::Error) -> Diagnostic {
    let message = format!("cannot read `{path}`: {}", io_words(error));
    Diagnostic::without_place(Code::Unreadable, message)
}

/// A folder without lessons.
pub(super) fn no_lessons(path: &str) -> Diagnostic {
    let message = format!("no lessons in `{path}`");
    Diagnostic::without_place(Code::Empty, message).with_help("a lesson is a file such as `01-first.md`")
}

/// More lessons than a page shows, or a file that is too large.
pub(super) fn too_large(path: &str, what: &str, most: usize) -> Diagnostic {
    Diagnostic::without_place(Code::TooLarge, format!("`{path}` has more than {most} {what}"))
}

/// A mistake as a diagnostic about its place.
pub(super) fn worded(file: FileId, mistaken: &Mistaken) -> Diagnostic {
    let Mistaken { start, end, text, mistake } = mistaken;
    let at = |code, message: String, label: &str| Diagnostic::new(code, message, Span::new(file, *start, *end), label);
    match mistake {
        LessonMistake::FileName => at(Code::BadValue, format!("`{text}` cannot be the name of a lesson"), "")
            .with_help("name it with letters, digits, `-` and `_`, such as `01-first.md`"),
        LessonMistake::NameTaken { name } => at(Code::Duplicate, format!("two lessons are called `{name}`"), "")
            .with_help("the number before the name does not count"),
        LessonMistake::NoTitle => at(Code::MissingField, "missing title".to_owned(), "the lesson begins here")
            .with_help("begin with a line such as `# My lesson`"),
        LessonMistake::SecondTitle => at(Code::Duplicate, "a lesson has one title".to_owned(), "a second title")
            .with_help("begin a step with `## Step`"),
        LessonMistake::Heading => at(Code::Unknown, format!("unknown heading `{text}`"), "expected `## Step`"),
        LessonMistake::NoSteps => at(Code::Empty, "the lesson has no steps".to_owned(), "the lesson begins here")
            .with_help("begin a step with `## Step`"),
        LessonMistake::NoTask => at(Code::MissingField, "the step has no task".to_owned(), "of this step")
            .with_help("write what to do below the heading"),
        LessonMistake::NoCheck => at(Code::MissingField, "the step has no check".to_owned(), "of this step")
            .with_help("for example `- check: keeps q=1`"),
        LessonMistake::NoField => at(Code::Syntax, format!("`{text}` is not a field"), "expected `name: value`"),
        LessonMistake::UnknownField { known } => {
            let message = format!("unknown field `{text}`");
            suggested(at(Code::UnknownField, message, "unknown"), text, known.iter().copied())
        }
        LessonMistake::FieldTwice => at(Code::Duplicate, format!("a second `{text}`"), "there is one already"),
        LessonMistake::EmptyField(name) => at(Code::MissingField, format!("`{name}` has no value"), ""),
        LessonMistake::TooManyHints { most } => {
            at(Code::OutOfRange, format!("more than {} here", counted(*most, "hint")), "one too many")
        }
        LessonMistake::Language => at(Code::Syntax, "a program is in a block of `nb`".to_owned(), "this block is not")
            .with_help("begin it with three backticks and `nb`"),
        LessonMistake::OpenBlock => at(Code::Syntax, "the program does not end".to_owned(), "it begins here")
            .with_help("end it with a line of three backticks"),
        LessonMistake::SecondProgram => at(Code::Duplicate, "a second program".to_owned(), "it begins here"),
        LessonMistake::UnknownWord { known } => {
            suggested(at(Code::Unknown, format!("unknown word `{text}`"), "unknown"), text, known.iter().copied())
        }
        LessonMistake::UnknownGate { known } => {
            suggested(at(Code::Unknown, format!("unknown gate `{text}`"), "unknown"), text, known.iter().copied())
        }
        LessonMistake::UnknownPort { known } => {
            let found = at(Code::Unknown, format!("no circuit of the program has a port `{text}`"), "unknown");
            suggested(found, text, known.iter().map(String::as_str))
        }
        LessonMistake::NoProgram => at(Code::Unknown, format!("there is no port `{text}` without a program"), "")
            .with_help("add a program before the first step"),
        LessonMistake::PortTwice => at(Code::Duplicate, format!("a second value of `{text}`"), "given already"),
        LessonMistake::NoValue => at(Code::Syntax, format!("expected a port and its value, found `{text}`"), "")
            .with_help("for example `a=1`"),
        LessonMistake::BadNumber => at(Code::Value, format!("expected a number, found `{text}`"), "")
            .with_help("for example `5`, `0b101` or `0x1f`"),
        LessonMistake::BadBest => at(Code::Value, format!("expected a number of robots or gates, found `{text}`"), "")
            .with_help("for example `best: 4 robots`"),
        LessonMistake::Incomplete => at(Code::Syntax, format!("`{text}` needs more words"), "after this")
            .with_help("docs/lessons.md has all checks"),
        LessonMistake::TooMuch => at(Code::Syntax, format!("unexpected `{text}`"), "nothing may follow here"),
        LessonMistake::Typing => at(Code::Syntax, "`do: type` and a program belong together".to_owned(), "")
            .with_help("the program of a step is what `do: type` types"),
    }
}

/// The same with the nearest known word, or all of them.
fn suggested<'a>(found: Diagnostic, word: &str, known: impl Iterator<Item = &'a str>) -> Diagnostic {
    let known: Vec<_> = known.collect();
    match Suggestion::near(word, known.iter().copied()) {
        Suggestion::None if known.len() <= 20 => found.with_help(format!("expected {}", alternatives(&known, "or"))),
        near => found.with_suggestion(None, &near),
    }
}
