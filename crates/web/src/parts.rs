//! Parts of a cycle, and what became of them, as bytes between the workers of a tab: a head in JSON, then numbers of
//! eight bytes, so that no bit changes.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use nbc_base::model::{Body, Fault, Palette, Pattern, Setting};
use nbc_sim::{Simulator, Snapshot, State};
use nbc_swarm::{CyclePart, PartStates};

/// The part of a cycle without the places of points.
#[derive(Serialize, Deserialize)]
struct PartHead {
    setting: Setting,
    palettes: Vec<Arc<Palette>>,
    /// Width, height, codes and the number of the palette.
    bodies: Vec<(usize, usize, Vec<u8>, usize)>,
    patterns: Vec<Pattern>,
    stops: Vec<u32>,
    starts: Vec<SnapshotHead>,
}

/// A snapshot without the places of points.
#[derive(Serialize, Deserialize)]
struct SnapshotHead {
    points: usize,
    clock: u32,
    fault: Option<Fault>,
}

/// Simulates a part of a cycle, both as bytes; `None` if these are not a part.
pub(crate) fn simulated(bytes: &[u8]) -> Option<Vec<u8>> {
    Some(write_states(&read_part(bytes)?.simulate(&Simulator::default())))
}

/// The bytes of a part.
pub(crate) fn write_part(part: &CyclePart) -> Vec<u8> {
    let mut palettes: Vec<Arc<Palette>> = Vec::new();
    let body = |body: &Body| {
        let at = palettes.iter().position(|known| known == body.palette()).unwrap_or_else(|| {
            palettes.push(body.palette().clone());
            palettes.len() - 1
        });
        (body.width(), body.height(), body.codes().to_vec(), at)
    };
    let bodies = part.bodies.iter().map(body).collect();
    let head = PartHead {
        setting: part.setting,
        palettes,
        bodies,
        patterns: part.patterns.clone(),
        stops: part.stops.clone(),
        starts: part.starts.iter().map(SnapshotHead::of).collect(),
    };
    joined(&head, &part.starts)
}

/// The part of these bytes, if they are one.
fn read_part(bytes: &[u8]) -> Option<CyclePart> {
    let (head, mut numbers) = parted::<PartHead>(bytes)?;
    let body = |(width, height, codes, palette): (usize, usize, Vec<u8>, usize)| {
        Body::from_codes(width, height, &codes, head.palettes.get(palette)?).ok()
    };
    Some(CyclePart {
        setting: head.setting,
        bodies: head.bodies.into_iter().map(body).collect::<Option<_>>()?,
        starts: head.starts.into_iter().map(|start| start.snapshot(&mut numbers)).collect::<Option<_>>()?,
        patterns: head.patterns,
        stops: head.stops,
    })
}

/// The bytes of states.
fn write_states(states: &PartStates) -> Vec<u8> {
    let heads: Vec<Vec<SnapshotHead>> =
        states.iter().map(|robots| robots.iter().map(SnapshotHead::of).collect()).collect();
    joined(&heads, states.iter().flatten())
}

/// The states of these bytes, if they are states.
pub(crate) fn read_states(bytes: &[u8]) -> Option<PartStates> {
    let (heads, mut numbers) = parted::<Vec<Vec<SnapshotHead>>>(bytes)?;
    let mut stop = |heads: Vec<SnapshotHead>| heads.into_iter().map(|head| head.snapshot(&mut numbers)).collect();
    heads.into_iter().map(&mut stop).collect()
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

fn joined<'a>(head: &impl Serialize, snapshots: impl IntoIterator<Item = &'a Snapshot>) -> Vec<u8> {
    let head = serde_json::to_vec(head).expect("plain data");
    let mut bytes = (head.len() as u64).to_le_bytes().to_vec();
    bytes.extend(head);
    for Snapshot { state: State { position, previous, velocity }, center, .. } in snapshots {
        let places = [center].into_iter().chain(position).chain(previous).chain(velocity);
        bytes.extend(places.flatten().flat_map(|number| number.to_le_bytes()));
    }
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

    #[test]
    fn a_part_as_bytes_has_the_same_states() {
        let setting = Setting::default();
        let bodies: Vec<Body> = (0..3).map(|shift| Body::patchwork(5, shift)).collect();
        let flock = Simulator::default().flock(&setting, &bodies);
        let mut starts: Vec<Snapshot> = (0..3).map(|robot| flock.snapshot(robot)).collect();
        starts[2].fault = Some(Fault { env_step: 7, kind: FaultKind::Unstable });
        let patterns = Pattern::PAIRS[..3].to_vec();
        let part = CyclePart { setting, bodies, starts, patterns, stops: vec![7, CYCLE_STEPS] };
        let bytes = write_part(&part);
        assert_eq!(read_part(&bytes).as_ref(), Some(&part));
        let states = part.simulate(&Simulator::default());
        assert_ne!(states[0], states[1]);
        assert_eq!(read_states(&simulated(&bytes).unwrap()), Some(states));
    }

    #[test]
    fn bytes_that_are_no_part_are_refused() {
        let whole = write_states(&vec![vec![]]);
        for bytes in [&[][..], &[1; 7], &[255; 40], &whole] {
            assert_eq!(simulated(bytes), None);
        }
        assert_eq!(read_states(&[255; 40]), None);
    }
}
