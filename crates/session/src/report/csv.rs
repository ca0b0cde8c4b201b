//! Tables for spreadsheets and programs: CSV as in RFC 4180, with a header.

/// A line of a table.
pub(super) fn line(cells: impl IntoIterator<Item = String>) -> String {
    cells.into_iter().collect::<Vec<_>>().join(",") + "\n"
}

/// A text as a cell, quoted if necessary.
pub(super) fn cell(text: &str) -> String {
    let plain = !text.contains([',', '"', '\n', '\r']);
    if plain { text.to_owned() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_in_cells_are_quoted() {
        let cells = ["plain", "a,b", "say \"x\"", "two\nlines", ""].map(cell);
        assert_eq!(line(cells), "plain,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\",\n");
    }
}
