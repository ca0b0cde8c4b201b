//! Lays pieces of text out: on one line where they fit, else broken at the outermost places that can be broken.

/// The greatest number of columns.
pub(super) const WIDTH: usize = 100;

/// A piece of text, or what to do between pieces.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Piece {
    /// Text without a line break.
    Text(String),
    /// A place where the group around may be broken: that text on one line, else a line break.
    Break(&'static str),
    /// A break after which the group's indent ends.
    EndBreak(&'static str),
    /// Spaces, only where the group around is broken.
    Pad(usize),
    /// The start of a group: broken as a whole or not at all.
    Open,
    /// The end of a group.
    Close,
}

/// The text of pieces that begin at a column, in lines indented by `indent` at least.
pub(super) fn layout(pieces: &[Piece], column: usize, indent: usize) -> String {
    let widths = flat_widths(pieces);
    let mut out = String::new();
    let mut column = column;
    let mut groups: Vec<Option<usize>> = Vec::new();
    for (at, piece) in pieces.iter().enumerate() {
        let broken = groups.last().copied().flatten();
        match piece {
            Piece::Text(text) => {
                out.push_str(text);
                column += text.chars().count();
            }
            Piece::Open => {
                let outer = groups.iter().rev().find_map(|group| *group).unwrap_or(indent);
                let inside_flat = matches!(groups.last(), Some(None));
                let fits = column + widths[at] <= WIDTH;
                groups.push((!fits && !inside_flat).then_some(outer + super::printer::INDENT));
            }
            Piece::Close => _ = groups.pop(),
            Piece::Pad(spaces) if broken.is_some() => {
                out.extend(std::iter::repeat_n(' ', *spaces));
                column += spaces;
            }
            Piece::Pad(_) => {}
            Piece::Break(flat) | Piece::EndBreak(flat) => match broken {
                None => {
                    out.push_str(flat);
                    column += flat.len();
                }
                Some(inner) => {
                    let end = matches!(piece, Piece::EndBreak(_));
                    column = if end { inner - super::printer::INDENT } else { inner };
                    out.push_str(if flat.starts_with(',') && !in_rows(pieces, at) { ",\n" } else { "\n" });
                    out.extend(std::iter::repeat_n(' ', column));
                }
            },
        }
    }
    out
}

/// Whether a broken comma stands between rows, which end with their lines.
fn in_rows(pieces: &[Piece], at: usize) -> bool {
    matches!(pieces.get(at + 1), Some(Piece::Text(text)) if text.ends_with(':'))
}

/// For each group the columns it takes on one line, with what follows it up to the next place to break.
fn flat_widths(pieces: &[Piece]) -> Vec<usize> {
    let mut widths = vec![0; pieces.len()];
    let mut after = 0;
    let mut ends: Vec<usize> = Vec::new();
    let mut total = 0;
    // From the end: what follows a group on its line belongs to its width.
    for (at, piece) in pieces.iter().enumerate().rev() {
        match piece {
            Piece::Text(text) => {
                let width = text.chars().count();
                total += width;
                after += width;
            }
            Piece::Break(flat) | Piece::EndBreak(flat) => {
                total += flat.len();
                after = 0;
            }
            Piece::Pad(_) => {}
            Piece::Close => ends.push(total - after),
            Piece::Open => {
                widths[at] = total - ends.pop().expect("groups open before they close");
            }
        }
    }
    widths
}
