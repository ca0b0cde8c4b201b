//! A circuit as one HTML file that plays without a server and without a network: the robots walk as they were recorded
//! in the physics, and the page computes the circuit at the level of logic.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::history::FRAMES;
use crate::message::{ExportedRobot, ExportedRow, ExportedStride, ExportedSwarm, ExportedTest, ExportedWalk};
use crate::programs::describe;
use crate::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{
    Behavior, Body, CYCLE_STEPS, Direction, GroundProfile, Pattern, Schedule, Setting, Stimulation, TestRow,
};
use nbc_session::report::{self, Stage};
use nbc_session::{Checked, CompileOptions, Compiled, Session, TestOptions};
use nbc_swarm::{Level, Recorded};

const PAGE: &str = include_str!("../page/player.html");
const DATA: &str = "<script type=\"application/octet-stream\" id=\"data\">";
const TITLE: &str = "<title>nbc";

/// The most different bodies of a page: each adds some kilobytes.
const MOST_BODIES: usize = 256;
const MOST_ROWS: usize = 256;
/// Cycles of a recording, and those of them in which the robot takes its shape.
const CYCLES: usize = 16;
const SETTLING: usize = 5;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedPage {
    pub html: String,
    pub circuit: String,
    pub robots: usize,
}

/// The session must record poses for a live swarm.
pub fn export(session: &Session, checked: &Checked, compiled: &Compiled) -> Result<ExportedPage, Diagnostic> {
    let data = exported(session, checked, compiled)?;
    let text = serde_json::to_vec(&data).expect("a swarm can be written as JSON");
    let mut packing = ZlibEncoder::new(Vec::new(), Compression::best());
    packing.write_all(&text).expect("memory takes any bytes");
    let packed = STANDARD.encode(packing.finish().expect("memory takes any bytes"));
    // A circuit has a name without signs of HTML.
    let (circuit, robots) = (data.swarm.circuit, data.robots.len());
    let html = PAGE.replacen(TITLE, &format!("<title>{circuit} – nbc"), 1);
    Ok(ExportedPage { html: html.replacen(DATA, &format!("{DATA}{packed}"), 1), circuit, robots })
}

fn exported(session: &Session, checked: &Checked, compiled: &Compiled) -> Result<ExportedSwarm, Diagnostic> {
    let members = &compiled.assembly.members;
    let robots = members.len();
    if Limit::PageRobots.permit(robots as u64).is_err() {
        return Err(wording::too_many_robots(robots, Limit::PageRobots.most()));
    }
    let mut bodies: Vec<(&Body, Behavior)> = Vec::new();
    let mut place = |body, behavior| match bodies.iter().position(|known| *known == (body, behavior)) {
        Some(known) => known,
        None => {
            bodies.push((body, behavior));
            bodies.len() - 1
        }
    };
    let beat = compiled.assembly.beat;
    let is_wave = compiled.mapping.waves.is_some();
    let one = |member: &nbc_swarm::Member, walk| {
        let delay = (member.robot.character.clock + compiled.plan.window - 1).max(1);
        ExportedRobot {
            walk,
            start: member.start,
            // All robots of a wave machine answer within a beat.
            delay: if is_wave { delay.min(beat) } else { delay },
            held: member.held.iter().map(|bits| digits(bits.iter().copied().map(Some))).collect(),
        }
    };
    let robots: Vec<ExportedRobot> =
        members.iter().map(|member| one(member, place(&member.robot.body, member.robot.behavior))).collect();
    if bodies.len() > MOST_BODIES {
        return Err(wording::too_many_bodies(bodies.len(), MOST_BODIES));
    }
    let mut swarm = describe(1, checked, compiled, &session.swarm(compiled));
    // The walks are those on flat ground.
    swarm.ground.clear();
    Ok(ExportedSwarm {
        version: nbc_base::VERSION,
        file: checked.path.rsplit('/').next().unwrap_or_default().to_owned(),
        swarm: Box::new(swarm),
        beat,
        robots,
        walks: walks(&bodies, compiled),
        tests: tests(session, checked, compiled),
    })
}

fn walks(bodies: &[(&Body, Behavior)], compiled: &Compiled) -> Vec<ExportedWalk> {
    let factors = compiled.assembly.world.factors;
    let setting = Setting { factors, ground: GroundProfile::default(), ..Setting::default() };
    let mut walks: Vec<ExportedWalk> = bodies
        .iter()
        .map(|(_, behavior)| ExportedWalk { letters: behavior.to_string(), strides: Vec::new() })
        .collect();
    for stimuli in [2, 3] {
        let which: Vec<usize> = (0..bodies.len()).filter(|&body| bodies[body].1.stimuli() == stimuli).collect();
        let alike: Vec<Body> = which.iter().map(|&body| bodies[body].0.clone()).collect();
        if alike.is_empty() {
            continue;
        }
        for pattern in Pattern::all(stimuli) {
            let schedule = Schedule::constant(pattern, CYCLES as u32 * CYCLE_STEPS);
            let stage = Stage::of_trials(&setting, &alike, &schedule, CYCLE_STEPS / FRAMES);
            for (&body, recorded) in which.iter().zip(&stage.record(alike.len()).robots) {
                walks[body].strides.push(stride(recorded, bodies[body].1.direction(pattern)));
            }
        }
    }
    walks
}

/// The recorded cycle that closes best to a loop, among those in which the robot walks in its direction.
fn stride(recorded: &Recorded, direction: Direction) -> ExportedStride {
    let (size, frames) = (2 * recorded.points, FRAMES as usize);
    let pose = |frame: usize| &recorded.frames[frame * size..(frame + 1) * size];
    let middle = |pose: &[i16]| mean(pose.iter().step_by(2));
    let shift = |cycle: usize| middle(pose((cycle + 1) * frames)) - middle(pose(cycle * frames));
    // The change of the shape from the start of the cycle to its end.
    let change = |cycle: usize, k: usize| {
        let moved = if k.is_multiple_of(2) { shift(cycle) } else { 0.0 };
        f64::from(pose((cycle + 1) * frames)[k]) - f64::from(pose(cycle * frames)[k]) - moved
    };
    let gap = |cycle: usize| (0..size).map(|k| change(cycle, k).abs()).sum::<f64>();
    let whole = recorded.frames.len() / size.max(1) / frames;
    let wanted = |cycle: &usize| Direction::of(shift(*cycle)) == direction;
    let all = SETTLING..whole.clamp(SETTLING + 1, CYCLES);
    let best = all.clone().filter(wanted).min_by(|&a, &b| gap(a).total_cmp(&gap(b)));
    let cycle = best.unwrap_or(all.start);
    let left = pose(cycle * frames).iter().step_by(2).min().copied().unwrap_or(0);
    let mut poses = Vec::with_capacity(size * frames);
    for frame in 1..=frames {
        let part = frame as f64 / frames as f64;
        for (k, &at) in pose(cycle * frames + frame).iter().enumerate() {
            let moved = if k.is_multiple_of(2) { shift(cycle) * part + f64::from(left) } else { 0.0 };
            // What is left over of the change is spread over the cycle, so that the end is the start.
            poses.push((f64::from(at) - moved - change(cycle, k) * part).round() as i16);
        }
    }
    ExportedStride { shift: (shift(cycle) / 100.0 * 1e4).round() / 1e4, poses: report::base64(&poses) }
}

fn mean<'a>(numbers: impl Iterator<Item = &'a i16>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), &number| (sum + f64::from(number), count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

/// Left out are the steps of a wave machine, which are read at other times, and scripts, which depend on what the
/// circuit does.
fn tests(session: &Session, checked: &Checked, compiled: &Compiled) -> Vec<ExportedTest> {
    if compiled.mapping.waves.is_some() {
        return Vec::new();
    }
    let own = checked.program.tests.iter().filter(|test| test.circuit == compiled.plan.circuit);
    let rows = own.filter(|test| !matches!(test.stimulation, Stimulation::Script(_))).filter_map(|test| {
        let options = TestOptions { level: Some(Level::Logic), compile: CompileOptions::default() };
        let cases = session.cases(checked, test, &options).ok()?;
        let rows: Vec<ExportedRow> = cases.first()?.rows().iter().map(row).collect();
        (!rows.is_empty() && rows.len() <= MOST_ROWS).then(|| ExportedTest { title: test.title.clone(), rows })
    });
    rows.collect()
}

fn row(row: &TestRow) -> ExportedRow {
    let (inputs, expected) = (digits(row.inputs.iter().copied().map(Some)), digits(row.expected.iter().copied()));
    ExportedRow { inputs, expected }
}

fn digits(bits: impl Iterator<Item = Option<bool>>) -> String {
    bits.map(|bit| bit.map_or('-', |bit| if bit { '1' } else { '0' })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::MemoryWorld;
    use nbc_session::Choice;
    use nbc_swarm::Room;

    const LATCH: &str = include_str!("../circuits/latch.nb");

    fn with_latch<T>(work: impl FnOnce(&Session, &Checked, &Compiled) -> T) -> T {
        let mut session = Session::new(MemoryWorld::default()).with_poses(Room::LIVE);
        session.update("a/latch.nb", 1, LATCH);
        let checked = session.open("a/latch.nb").unwrap();
        let circuit = checked.circuit(&Choice::default()).unwrap();
        let compiled = session.compile(&checked, &circuit, &CompileOptions::default()).unwrap();
        work(&session, &checked, &compiled)
    }

    #[test]
    fn a_page_has_the_swarm_its_walks_and_its_tests() {
        let data = with_latch(|session, checked, compiled| exported(session, checked, compiled).unwrap());
        assert_eq!((data.file.as_str(), data.beat, data.robots.len()), ("latch.nb", 1, 5));
        assert!(data.walks.len() < 5, "robots with the same body share a walk");
        assert_eq!(data.tests[0].rows[1], ExportedRow { inputs: "11".into(), expected: "1-".into() });
        assert_eq!(data.robots.iter().filter(|robot| robot.start).count(), 4, "q begins with 0");
    }

    #[test]
    fn the_robots_walk_as_their_letters_say_and_close_their_loops() {
        let data = with_latch(|session, checked, compiled| exported(session, checked, compiled).unwrap());
        for walk in &data.walks {
            assert_eq!(walk.strides.len(), walk.letters.len());
            for (stride, letter) in walk.strides.iter().zip(walk.letters.chars()) {
                assert_eq!(stride.shift > 0.0, letter == 'R', "{} {}", walk.letters, stride.shift);
            }
        }
    }

    #[test]
    fn the_page_is_whole_and_says_what_is_in_it() {
        let page = with_latch(|session, checked, compiled| export(session, checked, compiled).unwrap());
        assert_eq!((page.circuit.as_str(), page.robots), ("d_latch", 5));
        assert!(page.html.contains("<title>d_latch – nbc") && !page.html.contains(&format!("{DATA}<")));
        assert!(page.html.len() < 500_000, "{} bytes", page.html.len());
    }
}
