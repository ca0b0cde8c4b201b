//! Parts of simulations, and what became of them, as bytes between the workers of a tab: a head in JSON, then numbers
//! of eight bytes, so that no bit changes.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use nbc_base::model::{Behavior, Body, Displacements, Evolution, Fault, Palette, Pattern, Setting};
use nbc_play::{CrewPart, CrewResult};
use nbc_session::BodyTrials;
use nbc_sim::{Simulator, Snapshot, State};
use nbc_swarm::CyclePart;
use nbc_swarm::evolve::Scores;

/// A part without numbers that must keep their bits.
#[derive(Serialize, Deserialize)]
enum PartHead {
    Cycle {
        setting: Box<Setting>,
        bodies: BodyHeads,
        patterns: Vec<Pattern>,
        stops: Vec<u32>,
        starts: Vec<SnapshotHead>,
    },
    Bodies {
        evolution: Box<Evolution>,
        bodies: BodyHeads,
    },
}

/// What became of a part, without such numbers.
#[derive(Serialize, Deserialize)]
enum ResultHead {
    Cycle(Vec<Vec<SnapshotHead>>),
    /// The behavior of each body, and how many displacements it has.
    Bodies(Vec<Option<(Behavior, usize)>>),
}

/// Bodies: width, height, codes and the number of the palette of each.
#[derive(Serialize, Deserialize)]
struct BodyHeads {
    palettes: Vec<Arc<Palette>>,
    bodies: Vec<(usize, usize, Vec<u8>, usize)>,
}

/// A snapshot without the places of points.
#[derive(Serialize, Deserialize)]
struct SnapshotHead {
    points: usize,
    clock: u32,
    fault: Option<Fault>,
}

/// Does a part, both as bytes; `None` if these are not a part.
pub(crate) fn performed(bytes: &[u8]) -> Option<Vec<u8>> {
    Some(write_result(&read_part(bytes)?.perform(&Simulator::default())))
}

/// The bytes of a part.
pub(crate) fn write_part(part: &CrewPart) -> Vec<u8> {
    match part {
        CrewPart::Cycle(part) => {
            let head = PartHead::Cycle {
                setting: Box::new(part.setting),
                bodies: BodyHeads::of(&part.bodies),
                patterns: part.patterns.clone(),
                stops: part.stops.clone(),
                starts: part.starts.iter().map(SnapshotHead::of).collect(),
            };
            joined(&head, part.starts.iter().flat_map(numbers))
        }
        CrewPart::Bodies(trials) => {
            let BodyTrials { evolution, bodies } = &**trials;
            let head = PartHead::Bodies { evolution: Box::new(evolution.clone()), bodies: BodyHeads::of(bodies) };
            joined(&head, [])
        }
    }
}

/// The part of these bytes, if they are one.
fn read_part(bytes: &[u8]) -> Option<CrewPart> {
    let (head, mut numbers) = parted::<PartHead>(bytes)?;
    Some(match head {
        PartHead::Cycle { setting, bodies, patterns, stops, starts } => {
            let starts = starts.into_iter().map(|start| start.snapshot(&mut numbers)).collect::<Option<_>>()?;
            CrewPart::Cycle(Box::new(CyclePart { setting: *setting, bodies: bodies.read()?, starts, patterns, stops }))
        }
        PartHead::Bodies { evolution, bodies } => {
            CrewPart::Bodies(Box::new(BodyTrials { evolution: *evolution, bodies: bodies.read()? }))
        }
    })
}

/// The bytes of what became of a part.
fn write_result(result: &CrewResult) -> Vec<u8> {
    match result {
        CrewResult::Cycle(states) => {
            let heads = states.iter().map(|robots| robots.iter().map(SnapshotHead::of).collect());
            joined(&ResultHead::Cycle(heads.collect()), states.iter().flatten().flat_map(numbers))
        }
        CrewResult::Bodies(found) => {
            let head = |scores: &Scores| (scores.behavior, scores.displacement.len());
            let heads = found.iter().map(|scores| scores.as_ref().map(head)).collect();
            let scores = found.iter().flatten();
            joined(&ResultHead::Bodies(heads), scores.flat_map(|one| one.fitness.iter().chain(&*one.displacement)))
        }
    }
}

/// What these bytes say of a part, if they do.
pub(crate) fn read_result(bytes: &[u8]) -> Option<CrewResult> {
    let (head, mut numbers) = parted::<ResultHead>(bytes)?;
    Some(match head {
        ResultHead::Cycle(heads) => {
            let mut stop =
                |heads: Vec<SnapshotHead>| heads.into_iter().map(|head| head.snapshot(&mut numbers)).collect();
            CrewResult::Cycle(heads.into_iter().map(&mut stop).collect::<Option<_>>()?)
        }
        ResultHead::Bodies(heads) => {
            let mut scores = |head: Option<(Behavior, usize)>| {
                let Some((behavior, count)) = head else { return Some(None) };
                let fitness = [numbers.next()?, numbers.next()?];
                let walked: Vec<f64> = numbers.by_ref().take(count).collect();
                Some(Some(Scores { fitness, behavior, displacement: Displacements::try_from(walked).ok()? }))
            };
            CrewResult::Bodies(heads.into_iter().map(&mut scores).collect::<Option<_>>()?)
        }
    })
}

impl BodyHeads {
    fn of(bodies: &[Body]) -> Self {
        let mut palettes: Vec<Arc<Palette>> = Vec::new();
        let body = |body: &Body| {
            let at = palettes.iter().position(|known| known == body.palette()).unwrap_or_else(|| {
                palettes.push(body.palette().clone());
                palettes.len() - 1
            });
            (body.width(), body.height(), body.codes().to_vec(), at)
        };
        let bodies = bodies.iter().map(body).collect();
        Self { palettes, bodies }
    }

    fn read(self) -> Option<Vec<Body>> {
        let body = |(width, height, codes, palette): (usize, usize, Vec<u8>, usize)| {
            Body::from_codes(width, height, &codes, self.palettes.get(palette)?).ok()
        };
        self.bodies.into_iter().map(body).collect()
    }
}

impl SnapshotHead {
    fn of(snapshot: &Snapshot) -> Self {
        Self { points: snapshot.state.position.len(), clock: snapshot.clock, fault: snapshot.fault }
    }

    fn snapshot(self, numbers: &mut impl Iterator<Item = f64>) -> Option<Snapshot> {
        let mut place = || Some([numbers.next()?, numbers.next()?]);
        let center = place()?;
        let mut places = || (0..self.points).map(|_| place()).collect::<Option<Vec<_>>>();
        let state = State { position: places()?, previous: places()?, velocity: places()? };
        Some(Snapshot { state, center, clock: self.clock, fault: self.fault })
    }
}

/// The places and velocities of a snapshot.
fn numbers(Snapshot { state, center, .. }: &Snapshot) -> impl Iterator<Item = &f64> {
    let State { position, previous, velocity } = state;
    [center].into_iter().chain(position).chain(previous).chain(velocity).flatten()
}

fn joined<'a>(head: &impl Serialize, numbers: impl IntoIterator<Item = &'a f64>) -> Vec<u8> {
    let head = serde_json::to_vec(head).expect("plain data");
    let mut bytes = (head.len() as u64).to_le_bytes().to_vec();
    bytes.extend(head);
    bytes.extend(numbers.into_iter().flat_map(|number| number.to_le_bytes()));
    bytes
}

fn parted<T: serde::de::DeserializeOwned>(bytes: &[u8]) -> Option<(T, impl Iterator<Item = f64>)> {
    let (length, rest) = bytes.split_first_chunk::<8>()?;
    let (head, numbers) = rest.split_at_checked(u64::from_le_bytes(*length) as usize)?;
    let numbers = numbers.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes));
    Some((serde_json::from_slice(head).ok()?, numbers))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::{CYCLE_STEPS, FaultKind};
    use nbc_session::BodySearch;

    #[test]
    fn a_part_as_bytes_has_the_same_states() {
        let setting = Setting::default();
        let bodies: Vec<Body> = (0..3).map(|shift| Body::patchwork(5, shift)).collect();
        let flock = Simulator::default().flock(&setting, &bodies);
        let mut starts: Vec<Snapshot> = (0..3).map(|robot| flock.snapshot(robot)).collect();
        starts[2].fault = Some(Fault { env_step: 7, kind: FaultKind::Unstable });
        let patterns = Pattern::PAIRS[..3].to_vec();
        let part =
            CrewPart::Cycle(Box::new(CyclePart { setting, bodies, starts, patterns, stops: vec![7, CYCLE_STEPS] }));
        let bytes = write_part(&part);
        assert_eq!(read_part(&bytes).as_ref(), Some(&part));
        let result = part.perform(&Simulator::default());
        let states = result.clone().states();
        assert_ne!(states[0], states[1]);
        assert_eq!(read_result(&performed(&bytes).unwrap()), Some(result));
    }

    #[test]
    fn bodies_as_bytes_have_the_same_scores() {
        let part = CrewPart::Bodies(Box::new(BodySearch::new(None, [2, 2], 1, 3).ask(|_| true)));
        let bytes = write_part(&part);
        assert_eq!(read_part(&bytes).as_ref(), Some(&part));
        let result = part.perform(&Simulator::default());
        assert!(result.clone().scores().iter().any(Option::is_some));
        assert_eq!(read_result(&performed(&bytes).unwrap()), Some(result));
    }

    #[test]
    fn bytes_that_are_no_part_are_refused() {
        let whole = write_result(&CrewResult::Cycle(vec![vec![]]));
        for bytes in [&[][..], &[1; 7], &[255; 40], &whole] {
            assert_eq!(performed(bytes), None);
        }
        assert_eq!(read_result(&[255; 40]), None);
    }
}
