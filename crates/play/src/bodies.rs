//! Robots and bodies for a page: the list of the library, measurements of a body, and robot files.

use crate::history::FRAMES;
use crate::jobs::{Job, JobEnd};
use crate::message::{EncodedGait, KeptRobot, PaletteEntry, ProbeReport, RequestResult, RobotCard, RobotCards};
use crate::page_files::PageFiles;
use crate::refusal::Refused;
use crate::request::KeepRequest;
use crate::site::SCHEME;
use nbc_base::model::{
    Behavior, Body, CYCLE_STEPS, Character, Displacements, Fault, Library, Material, Origin, Palette, Pattern,
    Provenance, Robot, Schedule, Setting,
};
use nbc_circuit::formats::is_word;
use nbc_session::report::{self, Listing, Looks, Stage, describe_material};
use nbc_session::store;
use nbc_session::{Checked, CompileOptions, Session};
use nbc_swarm::evolve;
use nbc_swarm::{Recorded, measure, sketch, walk};

const MOST_SIDE: usize = 20;
const MOST_CYCLES: u32 = 20;
const FOLDER: &str = "robots";

pub(super) fn robots(session: &Session, checked: Option<&Checked>) -> Result<RobotCards, Refused> {
    let painted = Palette::three();
    let mut all: Vec<(Robot, bool)> = session.shipped().robots.iter().map(|robot| (robot.clone(), true)).collect();
    if let Some(checked) = checked {
        for library in &checked.program.libraries {
            let Library { robots } = checked.robots(Some(&library.name), &CompileOptions::default())?;
            let new = |robot: &Robot| all.iter().all(|(known, _)| known != robot);
            let new: Vec<Robot> = robots.into_iter().filter(new).collect();
            all.extend(new.into_iter().map(|robot| (robot, library.from == Origin::Three)));
        }
    }
    // The materials to paint with come first, so that they look as in a body that is probed.
    let palettes = all.iter().map(|(robot, _)| robot.body.palette());
    let shown = Looks::of_palettes([&painted].into_iter().chain(palettes), SCHEME);
    let robots = all.iter().map(|(robot, shipped)| card(robot, *shipped, &shown, &painted)).collect();
    Ok(RobotCards { robots, looks: report::voxel_looks(&shown), palette: palette(&shown, &painted) })
}

fn card(robot: &Robot, shipped: bool, looks: &Looks, painted: &Palette) -> RobotCard {
    let recorded = stage(&robot.body, Pattern::PAIRS[0], 0).record(1).robots.swap_remove(0);
    RobotCard {
        listing: Listing::of(robot),
        about: report::describe_robot(robot),
        voxels: report::voxel_data(&recorded, &robot.body, looks),
        points: recorded.points,
        shipped,
        painted: robot.body.materials().all(|(code, material)| {
            painted.materials().get(usize::from(code) - 1).is_some_and(|known| known == material)
        }),
    }
}

fn palette(looks: &Looks, painted: &Palette) -> Vec<PaletteEntry> {
    let materials = (1..).zip(painted.materials());
    let one = |(code, material): (u8, &Material)| PaletteEntry {
        code: char::from_digit(code.into(), 36).expect("there are ten materials"),
        name: material.name.clone(),
        about: describe_material(material),
        look: looks.index(painted, code),
    };
    materials.map(one).collect()
}

/// Parses a body of the paper's materials, or of those with a third stimulus if it uses one of them.
pub(super) fn body(rows: &[String]) -> Result<Body, Refused> {
    let body = Body::parse(rows, &Palette::paper()).or_else(|_| Body::parse(rows, &Palette::three()));
    let body = body.map_err(|error| Refused::Body(error.to_string()))?;
    if body.width().max(body.height()) > MOST_SIDE {
        return Err(Refused::Body(format!("a body has at most {MOST_SIDE} rows and columns here")));
    }
    evolve::validate(&body).map_err(|error| Refused::Body(error.to_string()))?;
    Ok(body)
}

fn stage(body: &Body, pattern: Pattern, cycles: u32) -> Stage {
    let schedule = Schedule::constant(pattern, cycles * CYCLE_STEPS);
    Stage::of_trial(&Setting::default(), body, &schedule, CYCLE_STEPS / FRAMES)
}

pub(super) fn probe(rows: &[String], cycles: u32, is_whole: bool, job: &Job) -> JobEnd {
    let body = body(rows)?;
    let cycles = cycles.clamp(1, MOST_CYCLES);
    let gait = |pattern| stage(&body, pattern, cycles).record(1).robots.swap_remove(0);
    let gaits: Vec<Recorded> = Pattern::all(body.palette().inputs()).map(gait).collect();
    job.check()?;
    let (displacement, behavior, sketched) = measured(&body, is_whole, job)?;
    let shown = Looks::of([&body], SCHEME);
    let gait = |gait: &Recorded| EncodedGait { frames: FRAMES, cycles, poses: report::base64(&gait.frames) };
    Ok(Some(RequestResult::Probe(ProbeReport {
        gaits: gaits.iter().map(gait).collect(),
        letters: behavior.to_string(),
        function: behavior.function().name(),
        displacement: displacement.to_vec(),
        character: sketched.map(Box::new),
        points: gaits[0].points,
        voxels: report::voxel_data(&gaits[0], &body, &shown),
        looks: report::voxel_looks(&shown),
    })))
}

/// If `is_whole`, this also measures a rough character, which takes longer.
fn measured(body: &Body, is_whole: bool, job: &Job) -> Result<(Displacements, Behavior, Option<Character>), Refused> {
    let stopped = |fault: Fault| job.check().err().unwrap_or_else(|| Refused::fault(fault));
    let simulator = job.simulator();
    let displacement = walk(&simulator, std::slice::from_ref(body)).remove(0).map_err(stopped)?;
    let behavior = displacement.behavior();
    let character = is_whole.then(|| sketch(&simulator, body, behavior)).transpose().map_err(stopped)?;
    Ok((displacement, behavior, character))
}

/// Measures a body and writes its robot file into a folder beside the program that is to use it. Where a class shares
/// the folder, no robot is replaced.
pub(super) fn keep(request: &KeepRequest, files: &PageFiles, is_shared: bool, job: &Job) -> JobEnd {
    if !is_word(&request.name) {
        return Err(Refused::Name(request.name.clone()));
    }
    let body = body(&request.body)?;
    let (beside, _) = request.path.as_deref().unwrap_or_default().rsplit_once('/').unwrap_or_default();
    let folder = if beside.is_empty() { FOLDER.to_owned() } else { format!("{beside}/{FOLDER}") };
    let place = |name: &str| format!("{folder}/{name}.yaml");
    let path = place(&request.name);
    if files.has(&path) && (is_shared || request.replace != Some(true)) {
        let free = (2..).map(|number| format!("{}_{number}", request.name)).find(|name| !files.has(&place(name)));
        let free = free.expect("there are more numbers than files");
        return Err(Refused::RobotExists { path, free, is_replaceable: !is_shared });
    }
    // Fail early: measuring the body takes long.
    files.may_write(&folder)?;
    let text = robot_file(&request.name, body, job)?;
    files.make_folder(&folder)?;
    files.write(&path, &text)?;
    Ok(Some(RequestResult::Keep(KeptRobot { path, declaration: format!("library own {{ from: \"{FOLDER}\" }}") })))
}

fn robot_file(name: &str, body: Body, job: &Job) -> Result<String, Refused> {
    let stopped = |fault: Fault| job.check().err().unwrap_or_else(|| Refused::fault(fault));
    let measured = measure(&job.simulator(), &body).map_err(stopped)?;
    let robot = Robot {
        name: name.to_owned(),
        behavior: measured.behavior,
        body,
        displacement: measured.displacement,
        character: measured.character,
        provenance: Provenance::unevolved("play"),
        genotype: None,
    };
    Ok(store::print_robot(&robot))
}
