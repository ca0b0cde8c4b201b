//! Lays out pieces of text: on one line if they fit, else broken at the outermost possible places.

/// In columns.
pub(super) const WIDTH: usize = 100;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum LayoutPiece {
    Text(String),
    /// This text if the surrounding group is on one line, else a line break.
    Break(&'static str),
    /// A break before a row of a table, without a comma at the end of a line.
    RowBreak(&'static str),
    /// Its group is broken after it.
    Comment {
        start: u32,
        /// With the space before it.
        text: String,
    },
    /// Breaks the surrounding groups even if they fit.
    Force,
    /// A break that also ends the group's indentation.
    EndBreak(&'static str),
    /// Spaces if the surrounding group is broken.
    Pad(usize),
    /// The start of a group, which is broken at all its breaks or at none.
    Open,
    Close,
}

pub(super) fn layout(pieces: &[LayoutPiece], column: usize, indent: usize) -> String {
    let widths = flat_widths(pieces);
    let mut out = String::new();
    let mut column = column;
    let mut groups: Vec<Option<usize>> = Vec::new();
    for (at, piece) in pieces.iter().enumerate() {
        let broken = groups.last().copied().flatten();
        match piece {
            LayoutPiece::Text(text) => {
                out.push_str(text);
                column += text.chars().count();
            }
            LayoutPiece::Comment { text, .. } => out.push_str(text),
            LayoutPiece::Force => {}
            LayoutPiece::Open => {
                let outer = groups.iter().rev().find_map(|group| *group).unwrap_or(indent);
                let inside_flat = matches!(groups.last(), Some(None));
                let fits = column + widths[at] <= WIDTH;
                groups.push((!fits && !inside_flat).then_some(outer + super::printer::INDENT));
            }
            LayoutPiece::Close => _ = groups.pop(),
            LayoutPiece::Pad(spaces) if broken.is_some() => {
                out.extend(std::iter::repeat_n(' ', *spaces));
                column += spaces;
            }
            LayoutPiece::Pad(_) => {}
            LayoutPiece::Break(flat) | LayoutPiece::RowBreak(flat) | LayoutPiece::EndBreak(flat) => match broken {
                None => {
                    out.push_str(flat);
                    column += flat.len();
                }
                Some(inner) => {
                    let end = matches!(piece, LayoutPiece::EndBreak(_));
                    column = if end { inner - super::printer::INDENT } else { inner };
                    let is_comma = matches!(piece, LayoutPiece::Break(flat) if flat.starts_with(','));
                    out.push_str(if is_comma { ",\n" } else { "\n" });
                    out.extend(std::iter::repeat_n(' ', column));
                }
            },
        }
    }
    out
}

/// The width of each group on one line, including the text after it up to the next possible break.
fn flat_widths(pieces: &[LayoutPiece]) -> Vec<usize> {
    let mut widths = vec![0; pieces.len()];
    let mut after = 0;
    let mut ends: Vec<usize> = Vec::new();
    let mut total = 0;
    // It runs from the end, because the text after a group on its line counts in its width.
    for (at, piece) in pieces.iter().enumerate().rev() {
        match piece {
            LayoutPiece::Text(text) => {
                let width = text.chars().count();
                total += width;
                after += width;
            }
            LayoutPiece::Break(flat) | LayoutPiece::RowBreak(flat) | LayoutPiece::EndBreak(flat) => {
                total += flat.len();
                after = 0;
            }
            // Too wide for all groups that it is in.
            LayoutPiece::Comment { .. } | LayoutPiece::Force => total += WIDTH + 1,
            LayoutPiece::Pad(_) => {}
            LayoutPiece::Close => ends.push(total - after),
            LayoutPiece::Open => {
                widths[at] = total - ends.pop().expect("groups open before they close");
            }
        }
    }
    widths
}
