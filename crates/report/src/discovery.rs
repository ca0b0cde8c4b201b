//! How soon each behavior was found: a dot for each seed in the generation that found it first.

use crate::Color;
use crate::chart::Panel;
use crate::element::{Anchor, Paint, Type};
use crate::progress::median;
use crate::svg::Svg;
use nbc_base::diag::counted;
use nbc_base::model::Behavior;

const TOP: f64 = 56.0;
const ROW: f64 = 22.0;
const SIDES: [f64; 2] = [130.0, 170.0];
const WIDTH: f64 = 520.0;

/// The generations in which seeds first found a behavior, one for each seed that did.
#[derive(Clone, Debug, PartialEq)]
pub struct Discovery {
    pub behavior: Behavior,
    pub generations: Vec<u32>,
}

/// `runs` is the number of seeds, `until` the last generation of any.
pub fn draw_discovery(title: &str, discoveries: &[Discovery], runs: usize, until: u32) -> Svg {
    let height = ROW * discoveries.len() as f64;
    let mut svg = Svg::titled(SIDES[0] + WIDTH + SIDES[1], TOP + height + 52.0, title);
    let (times, rows) = ((-0.05, place(until) + 0.05), (0.0, discoveries.len() as f64));
    let panel = Panel::new((SIDES[0], TOP), WIDTH, height, times, rows).downwards();
    draw_generations(&mut svg, &panel, until);
    for (row, discovery) in discoveries.iter().enumerate() {
        let word = discovery.behavior.to_string();
        svg.group(&format!("discovery-{word}"), &word, |svg| draw_row(svg, &panel, row, discovery, runs));
    }
    panel.x_label(&mut svg, "generation, a dot for each seed, a line at the median");
    panel.frame(&mut svg);
    svg
}

fn place(generation: u32) -> f64 {
    libm::log10(f64::from(generation.max(1)))
}

fn draw_generations(svg: &mut Svg, panel: &Panel, until: u32) {
    let powers = (0..).map(|power| 10u32.pow(power)).take_while(|power| *power <= until);
    for tick in powers.flat_map(|power| [1, 2, 5].map(|k| k * power)).filter(|tick| *tick <= until) {
        let (x, _) = panel.at((place(tick), 0.0));
        svg.line((x, panel.top), (x, panel.bottom), Paint::stroke(Color::PALE, 0.6));
        let set = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::Middle);
        svg.text((x, panel.bottom + 15.0), &tick.to_string(), set);
    }
}

fn draw_row(svg: &mut Svg, panel: &Panel, row: usize, discovery: &Discovery, runs: usize) {
    let Discovery { behavior, generations } = discovery;
    let y = panel.at((0.0, row as f64 + 0.5)).1;
    let (name, gray) = (Type::new(11.0).bold(), Type::new(10.0).colored(Color::GRAY));
    svg.text((14.0, y + 3.5), &behavior.to_string(), name);
    svg.text((62.0, y + 3.5), behavior.function().name(), gray);
    let color = [4, 5, 2, 0].map(Color::series)[behavior.function().arity()];
    for &generation in generations {
        svg.circle(panel.at((place(generation), row as f64 + 0.5)), 3.6, Paint::fill(color).with_opacity(0.6));
    }
    let mut text = format!("in {} of {}", generations.len(), counted(runs, "seed"));
    if !generations.is_empty() {
        let mut sorted: Vec<f64> = generations.iter().map(|&generation| generation.into()).collect();
        sorted.sort_by(f64::total_cmp);
        let median = median(&sorted);
        let (x, _) = panel.at((libm::log10(median.max(1.0)), 0.0));
        svg.line((x, y - 0.4 * ROW), (x, y + 0.4 * ROW), Paint::stroke(Color::BLACK, 2.0));
        text += &format!(", median {median}");
    }
    svg.text((panel.right + 10.0, y + 3.5), &text, gray);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_seed_is_a_dot_and_a_behavior_that_nobody_found_has_none() {
        let of = |word: &str, generations: &[u32]| Discovery {
            behavior: word.parse().unwrap(),
            generations: generations.to_vec(),
        };
        let found = [of("LRRL", &[3, 40]), of("RLLR", &[7]), of("LLLL", &[])];
        let text = draw_discovery("soon", &found, 2, 300).finish();
        let heights: Vec<&str> = text.split("cy=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert!(heights.len() == 3 && heights[0] == heights[1] && heights[1] != heights[2], "{heights:?}");
        assert!(text.contains("in 2 of 2 seeds, median 21.5") && text.contains("in 0 of 2 seeds"), "{text}");
        assert!(text.contains(">200<") && !text.contains(">500<"), "{text}");
    }
}
