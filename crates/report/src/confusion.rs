//! Which values are taken for which: a table, as text and as a picture.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::Color;
use crate::element::{Anchor, Paint, Type};
use crate::svg::Svg;
use crate::table::{Align, TextTable};

const MOST_VALUES: usize = 16;

const CELL: f64 = 40.0;
const LEFT: f64 = 74.0;
const TOP: f64 = 96.0;

/// For each value of an output, how often each value came in its place.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Confusion {
    pub output: String,
    /// Whether the rows are those held out, and not those of the training.
    pub held_out: bool,
    pub values: Vec<u64>,
    /// A row for each wanted value, with a number for each value found.
    pub counts: Vec<Vec<usize>>,
}

impl Confusion {
    /// Counts pairs of the wanted and the found value; `None` without pairs, or with more than 16 values.
    pub fn of(output: &str, held_out: bool, pairs: &[(u64, u64)]) -> Option<Self> {
        let values: BTreeSet<u64> = pairs.iter().flat_map(|&(wanted, found)| [wanted, found]).collect();
        if !(1..=MOST_VALUES).contains(&values.len()) {
            return None;
        }
        let values: Vec<u64> = values.into_iter().collect();
        let place = |value: u64| values.binary_search(&value).expect("all values are listed");
        let mut counts = vec![vec![0; values.len()]; values.len()];
        pairs.iter().for_each(|&(wanted, found)| counts[place(wanted)][place(found)] += 1);
        Some(Self { output: output.to_owned(), held_out, values, counts })
    }

    pub fn text(&self) -> String {
        let names: Vec<String> = self.values.iter().map(u64::to_string).collect();
        let columns: Vec<(&str, Align)> = [(self.output.as_str(), Align::Right)]
            .into_iter()
            .chain(names.iter().map(|name| (name.as_str(), Align::Right)))
            .collect();
        let mut table = TextTable::new(&columns);
        for (value, counts) in self.values.iter().zip(&self.counts) {
            let cell = |count: &usize| if *count == 0 { ".".to_owned() } else { count.to_string() };
            table.push([value.to_string()].into_iter().chain(counts.iter().map(cell)).collect());
        }
        format!("the {}, by the value wanted (left) and the value found (top):\n{table}", self.rows())
    }

    /// Right answers are on the diagonal, in blue. A cell is darker the larger its share of its row.
    pub fn draw(&self, title: &str) -> Svg {
        let count = self.values.len() as f64;
        let rows: usize = self.counts.iter().flatten().sum();
        let right: usize = (0..self.values.len()).map(|at| self.counts[at][at]).sum();
        let share = right as f64 / rows as f64 * 100.0;
        let subtitle = format!("{right} of {rows} {} ({share:.1} %)", self.rows());
        let longest = (title.chars().count() as f64 * 9.5).max(subtitle.chars().count() as f64 * 7.0);
        let width = (LEFT + count * CELL).max(14.0 + longest) + 24.0;
        let mut svg = Svg::titled(width, TOP + count * CELL + 24.0, title);
        svg.text((14.0, 48.0), &subtitle, Type::new(12.0));
        let middle = Type::new(12.0).anchored(Anchor::Middle);
        svg.text((LEFT + count * CELL / 2.0, TOP - 26.0), &format!("{} found", self.output), middle);
        svg.text((20.0, TOP + count * CELL / 2.0), "wanted", middle.upwards());
        for (row, (value, counts)) in self.values.iter().zip(&self.counts).enumerate() {
            let top = TOP + row as f64 * CELL;
            let column = LEFT + row as f64 * CELL + CELL / 2.0;
            svg.text((LEFT - 10.0, top + CELL / 2.0 + 4.0), &value.to_string(), Type::new(12.0).anchored(Anchor::End));
            svg.text((column, TOP - 8.0), &value.to_string(), middle);
            let wanted = counts.iter().sum::<usize>().max(1) as f64;
            for (at, &count) in counts.iter().enumerate() {
                let color = if at == row { Color::SERIES[0] } else { Color::FAULT };
                let share = count as f64 / wanted;
                let corner = (LEFT + at as f64 * CELL, top);
                let fill = Color::WHITE.mix(color, share.sqrt());
                svg.rect(corner, CELL, CELL, Paint::fill(fill).with_stroke(Color::PALE, 0.7));
                if count > 0 {
                    let ink = if share > 0.3 { Color::WHITE } else { Color::BLACK };
                    let place = (corner.0 + CELL / 2.0, top + CELL / 2.0 + 4.0);
                    svg.text(place, &count.to_string(), middle.colored(ink));
                }
            }
        }
        svg
    }

    fn rows(&self) -> &'static str {
        if self.held_out { "rows that were held out" } else { "training rows" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_counted_by_the_value_wanted() {
        let confusion = Confusion::of("digit", true, &[(3, 3), (3, 3), (3, 8), (8, 8)]).unwrap();
        assert_eq!(confusion.values, [3, 8]);
        assert_eq!(confusion.counts, [[2, 1], [0, 1]]);
        let text = "the rows that were held out, by the value wanted (left) and the value found (top):\n";
        assert!(confusion.text().starts_with(text));
        let drawn = confusion.draw("read").finish();
        assert!(drawn.contains("3 of 4 rows that were held out (75.0 %)"), "{drawn}");
        assert_eq!(drawn.matches("<text").count(), 2 + 2 + 4 + 3, "{drawn}");
    }

    #[test]
    fn there_is_no_table_of_many_values_or_of_none() {
        let many: Vec<(u64, u64)> = (0..17).map(|value| (value, value)).collect();
        assert!(Confusion::of("q", false, &many).is_none());
        assert!(Confusion::of("q", false, &many[1..]).is_some());
        assert!(Confusion::of("q", false, &[]).is_none());
    }
}
