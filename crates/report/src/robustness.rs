//! Tests in many worlds as text and as a picture.

use std::fmt::Write;

use crate::Color;
use crate::chart::Panel;
use crate::element::{Paint, Point, Type};
use crate::svg::Svg;
use crate::verdict::in_world;
use nbc_base::diag::counted;
use nbc_base::model::{Hears, PhysicsWorld, WorldFactors, WorldNoise};
use nbc_swarm::{Proportion, RobotMargin, Robustness};

const MOST_FAILING: usize = 5;

pub fn describe_robustness(found: &Robustness) -> String {
    let swarm = found.swarm.as_ref().map_or(String::new(), |swarm| format!(" as {swarm}"));
    let title = if found.title.is_empty() { String::new() } else { format!(" \"{}\"", found.title) };
    let world = in_world(&found.world);
    let mut text = format!("{}{swarm}{title}{world}: {}\n", found.circuit, yield_of(found.passed));
    let _ = writeln!(text, "  worlds          {}", found.variation);
    for failing in found.fails_first.iter().take(MOST_FAILING) {
        let (robot, net, worlds) = (&failing.robot, &failing.net, counted(failing.worlds, "world"));
        let _ = writeln!(text, "  fails first     `{robot}` at `{net}`, in {worlds}");
    }
    if let Some(failure) = found.failures.first() {
        let (world, line) = (failure.world, failure.line);
        let first = match (&failure.fault, &failure.first) {
            (Some(fault), _) => fault.to_string(),
            (None, Some(first)) => margin(first),
            (None, None) => "no robot erred after its clock".to_owned(),
        };
        let _ = writeln!(text, "  for example     world {world}, line {line}: {first}");
        let _ = writeln!(text, "                  world w{world} {}", declaration(&failure.physics));
    }
    if let Some(least) = &found.least {
        let _ = writeln!(text, "  smallest margin {}, world {}", margin(&least.margin), least.world);
    }
    text
}

/// `187 of 200 worlds pass, yield 93.5 % (95 % interval 89.2 to 96.2 %)`
fn yield_of(passed: Proportion) -> String {
    let Proportion { successes, attempts } = passed;
    let [low, high] = passed.interval().map(|end| end * 100.0);
    let share = passed.share() * 100.0;
    let worlds = counted(attempts, "world");
    format!("{successes} of {worlds} pass, yield {share:.1} % (95 % interval {low:.1} to {high:.1} %)")
}

fn margin(margin: &RobotMargin) -> String {
    let RobotMargin { net, robot, cycle, margin } = margin;
    format!("{margin:.4} voxels a cycle, `{robot}` at `{net}` in cycle {cycle}")
}

fn declaration(world: &PhysicsWorld) -> String {
    let (factors, noise) = (world.factors, world.noise);
    let (paper, silent) = (WorldFactors::default(), WorldNoise::default());
    let fields = [
        ("friction", factors.friction, paper.friction),
        ("gravity", factors.gravity, paper.gravity),
        ("stiffness", factors.stiffness, paper.stiffness),
        ("drag", factors.drag, paper.drag),
        ("damping", factors.damping, paper.damping),
        ("swelling", factors.swelling, paper.swelling),
        ("start", noise.start, silent.start),
        ("missed", noise.missed, silent.missed),
        ("weak", noise.weak, silent.weak),
        ("dead", noise.dead, silent.dead),
        ("phase", noise.phase, silent.phase),
        ("drift", noise.drift, silent.drift),
    ];
    let changed = fields.into_iter().filter(|(_, value, own)| value != own);
    let mut words: Vec<String> = changed.map(|(name, value, _)| format!("{name}: {value}")).collect();
    let is_of_file = world.ground.is_of_file();
    if !world.ground.is_flat() && !is_of_file {
        words.push(format!("ground: {:?}", world.ground.heights()));
    }
    if world.hears == Hears::Always {
        words.push("hears: always".to_owned());
    }
    if [noise.start, noise.missed, noise.dead, noise.phase, noise.drift].iter().any(|amount| *amount > 0.0) {
        words.push(format!("seed: {}", noise.seed));
    }
    let record = if words.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", words.join(", ")) };
    if is_of_file { format!("{record}, and the ground of its file") } else { record }
}

#[derive(Clone, Debug)]
pub struct YieldCurve {
    pub label: String,
    pub points: Vec<(f64, Proportion)>,
}

pub fn draw_yields(title: &str, change: &str, curves: &[YieldCurve]) -> Svg {
    let legend = 20.0 * curves.len() as f64;
    let mut svg = Svg::titled(640.0, 380.0 + legend, title);
    let most = curves.iter().flat_map(|curve| &curve.points).map(|point| point.0).fold(0.0, f64::max);
    let panel = Panel::new((64.0, 52.0), 550.0, 270.0, (0.0, most * 1.04), (0.0, 104.0));
    panel.x_axis(&mut svg, 8);
    panel.y_axis(&mut svg, 5, "yield in % of the worlds");
    panel.x_label(&mut svg, change);
    for (i, curve) in curves.iter().enumerate() {
        // Curves that agree lie beside each other.
        let aside = 3.0 * (i as f64 - (curves.len() as f64 - 1.0) / 2.0);
        svg.group(&format!("curve-{i}"), &curve.label, |svg| draw_curve(svg, &panel, curve, Color::series(i), aside));
        let y = 378.0 + 20.0 * i as f64;
        svg.line((64.0, y - 4.0), (94.0, y - 4.0), Paint::stroke(Color::series(i), 2.2));
        svg.text((102.0, y), &curve.label, Type::new(12.0));
    }
    panel.frame(&mut svg);
    svg
}

fn draw_curve(svg: &mut Svg, panel: &Panel, curve: &YieldCurve, color: Color, aside: f64) {
    let at = |x: f64, share: f64| -> Point {
        let (x, y) = panel.at((x, share * 100.0));
        (x + aside, y)
    };
    let points: Vec<Point> = curve.points.iter().map(|(x, passed)| at(*x, passed.share())).collect();
    svg.polyline(&points, Paint::stroke(color, 2.0));
    for ((x, passed), &point) in curve.points.iter().zip(&points) {
        let [low, high] = passed.interval();
        svg.line(at(*x, low), at(*x, high), Paint::stroke(color, 1.2));
        svg.circle(point, 3.2, Paint::fill(color));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_swarm::{FailingRobot, WorldFailure, WorldMargin};

    fn found() -> Robustness {
        let margin = |margin| RobotMargin { net: "q".to_owned(), robot: "nand_5x5".to_owned(), cycle: 31, margin };
        let factors = WorldFactors { friction: 0.9, ..WorldFactors::default() };
        let physics = PhysicsWorld { factors, ..PhysicsWorld::default() };
        Robustness {
            file: "a.nb".to_owned(),
            line: 3,
            circuit: "latch".to_owned(),
            title: "remembers".to_owned(),
            swarm: None,
            world: "paper".to_owned(),
            robots: 5,
            variation: "friction=10%".parse().unwrap(),
            scale: 1.0,
            passed: Proportion { successes: 19, attempts: 20 },
            fails_first: vec![FailingRobot { net: "q".to_owned(), robot: "nand_5x5".to_owned(), worlds: 1 }],
            least: Some(WorldMargin { world: 7, margin: margin(0.0123) }),
            failures: vec![WorldFailure {
                world: 4,
                physics,
                row: 2,
                line: 6,
                first: Some(margin(-0.02)),
                fault: None,
            }],
        }
    }

    #[test]
    fn the_text_has_the_yield_the_robots_and_the_margin() {
        let expected = "\
latch \"remembers\": 19 of 20 worlds pass, yield 95.0 % (95 % interval 76.4 to 99.1 %)
  worlds          friction 10 %
  fails first     `nand_5x5` at `q`, in 1 world
  for example     world 4, line 6: -0.0200 voxels a cycle, `nand_5x5` at `q` in cycle 31
                  world w4 { friction: 0.9 }
  smallest margin 0.0123 voxels a cycle, `nand_5x5` at `q` in cycle 31, world 7
";
        assert_eq!(describe_robustness(&found()), expected);
    }

    #[test]
    fn a_picture_has_a_curve_for_each_series() {
        let points = vec![(5.0, found().passed), (10.0, Proportion { successes: 3, attempts: 20 })];
        let curves = ["one", "two"].map(|label| YieldCurve { label: label.to_owned(), points: points.clone() });
        let text = draw_yields("Yields", "change", &curves).finish();
        assert_eq!(text.matches("<polyline").count(), 2);
        assert!(text.contains("curve-1") && text.contains("two"));
    }
}
