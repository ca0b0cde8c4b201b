//! The accuracies of bodies, by the evolutions that made them.

use crate::Color;
use crate::chart::Panel;
use crate::comparison::draw_values;
use crate::svg::Svg;

const TOP: f64 = 52.0;
const HEIGHT: f64 = 220.0;
const PITCH: f64 = 100.0;

/// Draws the shares, from 0 to 1, of each evolution side by side: a dot for each body, a cross at the mean.
pub fn draw_accuracies(title: &str, groups: &[(&str, Vec<f64>)]) -> Svg {
    let percent: Vec<Vec<f64>> =
        groups.iter().map(|(_, shares)| shares.iter().map(|share| 100.0 * share).collect()).collect();
    let least = percent.iter().flatten().copied().fold(100.0, f64::min);
    let width = (groups.len() as f64 * PITCH).max(200.0);
    let mut svg = Svg::titled(width + 84.0, TOP + HEIGHT + 46.0, title);
    let low = (10.0 * libm::floor(least / 10.0)).min(90.0);
    let panel = Panel::new((64.0, TOP), width, HEIGHT, (-0.5, groups.len() as f64 - 0.5), (low, 101.0));
    panel.y_axis(&mut svg, 5, "told apart, %");
    panel.frame(&mut svg);
    for (place, ((name, _), values)) in groups.iter().zip(&percent).enumerate() {
        let color = Color::series(place);
        svg.group(&format!("evolution-{name}"), name, |svg| {
            draw_values(svg, &panel, place as f64, (name, "body"), values, color);
        });
    }
    svg
}
