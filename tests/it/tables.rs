//! Figures of the manual that follow from its own tables: sums, means and ratios, and what two pages say of one thing.

use std::collections::BTreeMap;

use crate::support::*;

fn read(page: &str) -> String {
    fs::read_to_string(root().join("docs").join(page)).unwrap()
}

/// The rows of the table whose first line begins so, without the signs of code.
fn rows(page: &str, head: &str) -> Vec<Vec<String>> {
    let text = read(page);
    let table = text.lines().skip_while(|line| !line.starts_with(head)).skip(2);
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().replace('`', "")).collect();
    let rows: Vec<Vec<String>> = table.take_while(|line| line.starts_with('|')).map(cells).collect();
    assert!(!rows.is_empty(), "{page} has no table {head}");
    rows
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or_else(|_| panic!("{cell} is no number"))
}

fn ratios(rows: &[Vec<String>], [over, under]: [usize; 2]) -> Vec<(f64, &str)> {
    let mut ratios: Vec<_> = rows.iter().map(|row| (number(&row[over]) / number(&row[under]), &row[0][..])).collect();
    ratios.sort_by(|a, b| b.0.total_cmp(&a.0));
    ratios
}

fn mean(ratios: &[(f64, &str)]) -> f64 {
    libm::exp(ratios.iter().map(|(ratio, _)| libm::log(*ratio)).sum::<f64>() / ratios.len() as f64)
}

fn expect(page: &str, sentence: &str) {
    assert!(squeezed(&read(page)).contains(&squeezed(sentence)), "docs/{page} should say: {sentence}");
}

const NORMAL: &str = "| circuit | a: nbc | a: ABC | a: opt |";

#[test]
fn the_ratios_to_abc_are_those_of_the_table() {
    let rows = rows("synthesis.md", NORMAL);
    let [a, b, c] = [[1, 2], [4, 5], [7, 8]].map(|columns| ratios(&rows, columns));
    let equal = rows.iter().filter(|row| row[7] == row[8]).count();
    expect(
        "synthesis.md",
        &format!(
            "The largest ratio to ABC's best is {:.3} in (a), {:.3} in (b) (`{}`; the next is {:.3}) and {:.3} in (c), \
             and the geometric mean is {:.3}, {:.3} and {:.3}. In (c), {equal} of the {} circuits",
            a[0].0,
            b[0].0,
            b[0].1,
            b[1].0,
            c[0].0,
            mean(&a),
            mean(&b),
            mean(&c),
            rows.len()
        ),
    );
}

#[test]
fn the_cells_that_three_senses_save_add_up_and_agree_with_the_compilers() {
    let rows = rows("three-senses.md", "| circuit | cells of two inputs |");
    let compiled = self::rows("synthesis.md", NORMAL);
    let compiled: BTreeMap<&str, &str> = compiled.iter().map(|row| (&row[0][..], &row[7][..])).collect();
    let mut sums = [0.0, 0.0];
    for row in &rows {
        let [two, three] = [number(&row[1]), number(&row[2])];
        assert_eq!(row[3], format!("{:.0} %", 100.0 * (1.0 - three / two)), "{}", row[0]);
        if row[0] == "all" {
            assert_eq!([two, three], sums);
        } else {
            sums = [sums[0] + two, sums[1] + three];
            assert_eq!(compiled[&row[0][..]], row[1], "{} in synthesis.md and in three-senses.md", row[0]);
        }
    }
    assert!(rows.len() > 20);
}
