//! The kinds of pictures, and the argument `--as` that names one.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::cli::draw::picture::FilmFormat::{Apng, Gif};
use crate::cli::draw::picture::PictureKind;
use crate::cli::draw::picture::SubjectKind::{Library, Program, Robot, Run};
use crate::cli::draw::{film, program_pictures, robot_pictures, run_pictures, spacetime};

const FILM_OPTIONS: &[&str] = &["--frames", "--safe-colors", "--schedule"];

/// In the order of the help.
const KINDS: &[PictureKind] = &[
    PictureKind {
        extensions: &["png", "apng"],
        options: FILM_OPTIONS,
        robot: Some(|robot, request| film::of_robot(Apng, robot, request)),
        library: Some(|robots, request| film::of_library(Apng, robots, request)),
        program: Some(|request| film::of_program(Apng, request)),
        ..PictureKind::new("apng", "A film as animated PNG", Library)
    },
    PictureKind {
        run: Some(run_pictures::comparison),
        ..PictureKind::new("comparison", "The fitness of a run by group of behaviors, with statistics", Run)
    },
    PictureKind {
        run: Some(run_pictures::discovery),
        ..PictureKind::new("discovery", "The generation in which each seed of a run first found each behavior", Run)
    },
    PictureKind {
        extensions: &["dot", "gv"],
        program: Some(program_pictures::dot),
        ..PictureKind::new("dot", "The cells of a circuit, for Graphviz", Program)
    },
    PictureKind {
        extensions: &["gif"],
        options: FILM_OPTIONS,
        robot: Some(|robot, request| film::of_robot(Gif, robot, request)),
        library: Some(|robots, request| film::of_library(Gif, robots, request)),
        program: Some(|request| film::of_program(Gif, request)),
        ..PictureKind::new("gif", "A film as GIF", Library)
    },
    PictureKind {
        options: &["--axes"],
        run: Some(run_pictures::heatmap),
        ..PictureKind::new("heatmap", "The archive of a run", Run)
    },
    PictureKind {
        options: &["--at", "--safe-colors", "--schedule"],
        robot: Some(robot_pictures::pose),
        ..PictureKind::new("pose", "The deformed body of a robot at one moment", Robot)
    },
    PictureKind {
        run: Some(run_pictures::progress),
        ..PictureKind::new("progress", "The coverage, QD-score and champions of a run over its generations", Run)
    },
    PictureKind {
        extensions: &["html"],
        options: &["--safe-colors"],
        run: Some(run_pictures::page),
        program: Some(program_pictures::page),
        ..PictureKind::new("report", "A page with a player", Program)
    },
    PictureKind {
        extensions: &["svg", "png", "html"],
        options: &["--safe-colors"],
        program: Some(program_pictures::schematic),
        ..PictureKind::new("schematic", "The cells of a circuit with their robots", Program)
    },
    PictureKind {
        options: &["--robots", "--schedule"],
        robot: Some(spacetime::of_robot),
        library: Some(spacetime::of_library),
        run: Some(spacetime::of_run),
        program: Some(spacetime::of_program),
        ..PictureKind::new("spacetime", "Paths over time", Library)
    },
    PictureKind {
        options: &["--safe-colors"],
        robot: Some(robot_pictures::portrait),
        library: Some(robot_pictures::portraits),
        program: Some(robot_pictures::portraits_of_swarm),
        ..PictureKind::new("sprite", "Bodies with their materials", Library)
    },
    PictureKind {
        options: &["--safe-colors", "--schedule"],
        robot: Some(robot_pictures::strip),
        ..PictureKind::new("strip", "Snapshots of a robot's gait under each pattern", Robot)
    },
    PictureKind {
        extensions: &["vcd"],
        program: Some(program_pictures::vcd),
        ..PictureKind::new("vcd", "The waveforms of a swarm", Program)
    },
];

#[derive(Clone, Copy)]
pub(super) struct Kind(pub(super) &'static PictureKind);

pub(super) fn kinds() -> impl TypedValueParser<Value = Kind> {
    let value = |kind: &PictureKind| PossibleValue::new(kind.word).help(kind.about);
    PossibleValuesParser::new(KINDS.iter().map(value)).try_map(|word| {
        let kind = KINDS.iter().find(|kind| kind.word == word);
        kind.map(Kind).ok_or("not a kind of picture")
    })
}
