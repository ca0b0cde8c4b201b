//! Tables for spreadsheets and programs: CSV as in RFC 4180, with a header.

pub(super) fn line(cells: impl IntoIterator<Item = String>) -> String {
    cells.into_iter().collect::<Vec<_>>().join(",") + "\n"
}

/// A text as a cell, quoted if necessary. A spreadsheet computes a text that begins like a formula, so such a text gets
/// an apostrophe in front, which spreadsheets read as "this is text".
pub(super) fn cell(text: &str) -> String {
    let is_formula =
        text.trim_start().starts_with(['=', '+', '-', '@', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}']);
    let guard = if is_formula || text.starts_with(['\t', '\r', '\n']) { "'" } else { "" };
    let plain = !text.contains([',', '"', '\n', '\r']);
    if plain { format!("{guard}{text}") } else { format!("\"{guard}{}\"", text.replace('"', "\"\"")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_in_cells_are_quoted() {
        let cells = ["plain", "a,b", "say \"x\"", "two\nlines", ""].map(cell);
        assert_eq!(line(cells), "plain,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\",\n");
    }

    #[test]
    fn texts_that_a_spreadsheet_would_compute_are_guarded() {
        let cells = ["=1+1", "+1", "-x", "@SUM(A1)", " =1", "\tx", "=\"a\",2", "\u{ff1d}1", "a=1", "1-2"].map(cell);
        let guarded = "'=1+1,'+1,'-x,'@SUM(A1),' =1,'\tx,\"'=\"\"a\"\",2\",'\u{ff1d}1,a=1,1-2\n";
        assert_eq!(line(cells), guarded);
    }
}
