//! The mistakes of a lesson's author, as data; `wording.rs` says them.

use super::piece::Piece;

/// What is wrong in a lesson file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum LessonMistake {
    /// The file's name cannot be that of a lesson.
    FileName,
    /// Another file has the same name without the number.
    NameTaken { name: String },
    /// There is no `# Title`.
    NoTitle,
    /// There is a second one.
    SecondTitle,
    /// A heading that is not `## Step`.
    Heading,
    /// No step.
    NoSteps,
    /// A step without a task.
    NoTask,
    /// A step without a check.
    NoCheck,
    /// A list entry that is not `name: value`.
    NoField,
    /// A field of another name.
    UnknownField { known: Vec<&'static str> },
    /// A field that may be there once.
    FieldTwice,
    /// A field without a value.
    EmptyField(&'static str),
    /// A fourth hint.
    TooManyHints { most: usize },
    /// A code block in another language than `nb`.
    Language,
    /// A code block that does not end.
    OpenBlock,
    /// A second program.
    SecondProgram,
    /// A word of another kind.
    UnknownWord { known: Vec<&'static str> },
    /// A gate of another name.
    UnknownGate { known: Vec<&'static str> },
    /// A port that no circuit of the program has.
    UnknownPort { known: Vec<String> },
    /// Ports where there is no program.
    NoProgram,
    /// A port that has two values.
    PortTwice,
    /// A word that is not `port=value`.
    NoValue,
    /// A word that is not a number.
    BadNumber,
    /// A goal that is not `N robots` or `N gates`.
    BadBest,
    /// Something is missing.
    Incomplete,
    /// Something too much.
    TooMuch,
    /// `do: type` without a program, or the other way round.
    Typing,
}

/// A mistake and its place in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Mistaken {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) text: String,
    pub(super) mistake: LessonMistake,
}

impl Mistaken {
    pub(super) fn new(piece: Piece<'_>, mistake: LessonMistake) -> Self {
        Self { start: piece.at, end: piece.at + piece.text.len(), text: piece.text.to_owned(), mistake }
    }
}
