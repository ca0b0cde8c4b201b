//! Plots of evolution: heat maps, progress, champions, comparisons.

use crate::support::*;
use nbc_base::model::{Axis, Behavior, Body, Count, Displacements, Trajectory};

use nbc_session::report::{self, ArchiveMap, Champions, Course};
use nbc_swarm::evolve::{Archive, Champion, Elite, NicheKey};
use roxmltree::{Document, Node};

fn group<'a>(document: &'a Document<'a>, id: &str) -> Node<'a, 'a> {
    document.descendants().find(|node| node.attribute("id") == Some(id)).unwrap_or_else(|| panic!("no group {id}"))
}

fn fills(node: Node<'_, '_>, tag: &str) -> Vec<String> {
    node.descendants().filter(|n| n.has_tag_name(tag)).map(|n| n.attribute("fill").unwrap().to_owned()).collect()
}

fn has_text(svg: &str, wanted: &str) -> bool {
    Document::parse(svg).unwrap().descendants().any(|node| node.has_tag_name("text") && node.text() == Some(wanted))
}

fn elite(rows: &[&str], behavior: &str, fitness: f64) -> Elite {
    Elite {
        fitness: [fitness, fitness],
        behavior: behavior.parse().unwrap(),
        displacement: Displacements::under(2, |_| 1.0),
        body: Body::parse(rows, &nbc_base::model::Palette::paper()).unwrap(),
        genotype: None,
        generation: 0,
        evaluations: 0,
    }
}

fn axes() -> Vec<Axis> {
    let count = |of| Axis::Count { of, bins: 4 };
    vec![count(Count::Voxels), count(Count::Active), count(Count::Sensory), Axis::Behavior]
}

#[test]
fn a_heat_map_colors_the_niches_that_are_filled() {
    let evolution = nbc_base::model::Evolution { descriptors: axes(), ..evolution() };
    let mut archive = Archive::new(&evolution);
    archive.add(elite(&["333", "300", "000"], "RRRL", 1.0));
    archive.add(elite(&["333", "333", "333"], "RRRL", 5.0));
    let svg = heatmap(&archive, 0, 1);
    let document = Document::parse(&svg).unwrap();
    let cells = |word: &str| fills(group(&document, &format!("map-{word}")), "rect");
    let colored = |word: &str| cells(word).into_iter().filter(|fill| fill != "#ffffff").collect::<Vec<_>>();
    assert_eq!(cells("RRRL").len(), 16);
    assert_eq!(colored("RRRL").len(), 2);
    assert!(colored("RRRL").contains(&report::heat(0.0).to_string()));
    assert!(colored("RRRL").contains(&report::heat(1.0).to_string()));
    assert_eq!(colored("LLLL").len(), 0);
    assert!(has_text(&svg, "active voxels (bin)") && has_text(&svg, "distance (voxels)"));
    let across = heatmap(&archive, 3, 1);
    let filled = fills(group(&Document::parse(&across).unwrap(), "map-"), "rect");
    assert_eq!(filled.len(), 16 * 4, "behaviors are an axis like any other");
    assert_eq!(filled.iter().filter(|fill| *fill != "#ffffff").count(), 2);
    heatmap(&Archive::new(&evolution), 0, 2);
}

fn heatmap(archive: &Archive, x: usize, y: usize) -> String {
    let best = |elites: &[Elite]| elites.iter().map(|elite| elite.fitness[0]).fold(0.0, f64::max);
    let niches: Vec<(&NicheKey, f64)> = archive.niches().map(|(key, elites)| (key, best(elites))).collect();
    let archive_map = ArchiveMap { unit: "distance (voxels)", axes: &axes(), stimuli: 2, niches: &niches };
    report::draw_heatmap("gates", &archive_map, x, y).finish()
}

fn evolution() -> nbc_base::model::Evolution {
    let paper = checked("").program.evolution("gates").unwrap().clone();
    nbc_base::model::Evolution { width: 3, height: 3, descriptors: axes(), generations: 1, ..paper }
}

#[test]
fn progress_shows_every_seed_the_median_and_the_band() {
    let run = |high: f64| (0..10).map(|i| (f64::from(i), high * f64::from(i))).collect();
    let course = Course::of("coverage", "niches", vec![run(1.0), run(3.0), run(2.0)]);
    let svg = report::draw_progress("gates", "generation", &[course]).finish();
    let document = Document::parse(&svg).unwrap();
    let plot = group(&document, "course-0");
    let lines: Vec<&str> =
        plot.descendants().filter(|n| n.has_tag_name("polyline")).map(|n| n.attribute("points").unwrap()).collect();
    assert_eq!(lines.len(), 3 + 1);
    assert_eq!(lines[3], lines[2], "the median of three is the middle one");
    assert_eq!(plot.descendants().filter(|n| n.has_tag_name("polygon")).count(), 1);
    // The median ends with the shortest run.
    let short = (0..4).map(|i| (f64::from(i), f64::from(i))).collect();
    let course = Course::of("coverage", "niches", vec![run(1.0), run(3.0), short]);
    let svg = report::draw_progress("gates", "generation", &[course]).finish();
    let document = Document::parse(&svg).unwrap();
    let mut lines = group(&document, "course-0").descendants().filter(|n| n.has_tag_name("polyline"));
    assert_eq!(lines.next_back().unwrap().attribute("points").unwrap().split(' ').count(), 4);
    report::png(&report::draw_progress("none", "generation", &[Course::of("", "", vec![vec![]])]));
}

#[test]
fn courses_of_one_unit_have_one_scale() {
    let course = |unit, high| Course::of("", unit, vec![vec![(0.0, 0.0), (1.0, high)]]);
    let courses = [course("QD-score", 10.0), course("QD-score", 40.0), course("niches", 10.0)];
    let svg = report::draw_progress("searches", "bodies", &courses).finish();
    let document = Document::parse(&svg).unwrap();
    // How high the line rises, in pixels.
    let rise = |i: usize| {
        let line = group(&document, &format!("course-{i}")).descendants().find(|n| n.has_tag_name("polyline")).unwrap();
        let places = line.attribute("points").unwrap().split(' ').map(|pair| pair.split_once(',').unwrap().1);
        let heights: Vec<f64> = places.map(|height| height.parse().unwrap()).collect();
        heights[0] - heights[1]
    };
    assert!((rise(1) / rise(0) - 4.0).abs() < 0.01 && (rise(2) - rise(1)).abs() < 0.01);
}

#[test]
fn the_comparison_has_a_dot_for_each_run_and_gaps_where_groups_differ() {
    // Ten runs: robots that depend on no stimulus walk farthest; those that depend on one and on two walk equally far.
    let run = |i: u32| {
        let champion = |word: &str, distance: f64| Champion {
            behavior: word.parse().unwrap(),
            fitness: [distance + 0.01 * f64::from(i), 0.0],
            niches: 1,
        };
        vec![
            champion("RRRR", 9.0),
            champion("LLRR", 5.0),
            champion("RRRL", 5.0 + if i.is_multiple_of(2) { -0.5 } else { 0.5 }),
        ]
    };
    let runs = (1..).zip((0..10).map(run)).collect();
    let groups = report::behavior_groups(&runs);
    let comparisons = report::compare_groups(&groups);
    let svg = report::draw_comparison("groups", "distance (voxels)", &groups, &comparisons).finish();
    let document = Document::parse(&svg).unwrap();
    let middle = |name: &str| {
        let label = group(&document, &format!("group-{name}"))
            .descendants()
            .find(|n| n.text() == Some(name) && n.has_tag_name("text"))
            .unwrap();
        label.attribute("x").unwrap().parse::<f64>().unwrap()
    };
    assert_eq!(fills(group(&document, "group-XXXX"), "circle").len(), 10);
    assert_eq!(fills(group(&document, "group-XYYX"), "circle").len(), 0);
    let (first, second) = (middle("XXYY") - middle("XXXX"), middle("XXXY") - middle("XYXY"));
    assert!((first - 1.5 * second).abs() < 0.1, "{first} is wider than {second}");
    let pairs = |text: &str| svg.matches(&format!(">{text}</text>")).count();
    assert_eq!((pairs("1.00***"), pairs("3.2e\u{2212}5"), pairs("0.50")), (2, 2, 1));
}

#[test]
fn champions_are_drawn_in_body_lengths() {
    let com_x: Vec<f64> = (0..=3360).map(|i| 248.0 + f64::from(i) / 336.0).collect();
    let path = Trajectory { com_x, com_y: Vec::new(), fault: None };
    let behavior: Behavior = "RRRL".parse().unwrap();
    let champions = [Champions { behavior, paths: vec![(path.clone(), 5), (path, 5)] }];
    let svg = report::draw_champions("champions", &champions, &[10.0, 20.0, 30.0]).finish();
    let document = Document::parse(&svg).unwrap();
    let panel = group(&document, "champions-RRRL");
    assert_eq!(panel.descendants().filter(|n| n.has_tag_name("polyline")).count(), 2);
    assert_eq!(panel.descendants().filter(|n| n.has_attribute("stroke-dasharray")).count(), 3);
    // Ten voxels of a body of five columns are two lengths.
    assert!(has_text(&svg, "body lengths (2.0)") && has_text(&svg, "nand"));
}
