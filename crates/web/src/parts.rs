//! Parts of simulations and their results as bytes, between the workers of a tab.

use nbc_play::{CrewPart, CrewResult};
use nbc_sim::Simulator;

/// Does a part, both as bytes; `None` if these are not a part.
pub(crate) fn performed(bytes: &[u8]) -> Option<Vec<u8>> {
    let part: CrewPart = serde_json::from_slice(bytes).ok()?;
    Some(serde_json::to_vec(&part.perform(&Simulator::default())).expect("plain data"))
}

pub(crate) fn write_part(part: &CrewPart) -> Vec<u8> {
    serde_json::to_vec(part).expect("plain data")
}

pub(crate) fn read_result(bytes: &[u8]) -> Option<CrewResult> {
    serde_json::from_slice(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::{Body, CYCLE_STEPS, Fault, FaultKind, Pattern, Setting};
    use nbc_session::BodySearch;
    use nbc_sim::Snapshot;
    use nbc_swarm::CyclePart;

    #[test]
    fn a_part_as_bytes_has_the_same_result() {
        let setting = Setting::default();
        let bodies: Vec<Body> = (0..3).map(|shift| Body::patchwork(5, shift)).collect();
        let flock = Simulator::default().flock(&setting, &bodies);
        let mut starts: Vec<Snapshot> = (0..3).map(|robot| flock.snapshot(robot)).collect();
        starts[2].fault = Some(Fault { env_step: 7, kind: FaultKind::Unstable });
        starts[2].state.velocity[0] = [f64::INFINITY, -0.0];
        let patterns = Pattern::PAIRS[..3].to_vec();
        let cycle = CyclePart { setting, bodies, starts, patterns, stops: vec![7, CYCLE_STEPS] };
        let trials = BodySearch::new(None, [2, 2], 1, 3).ask(|_| true);
        for part in [CrewPart::Cycle(Box::new(cycle)), CrewPart::Bodies(Box::new(trials))] {
            let bytes = write_part(&part);
            assert_eq!(serde_json::from_slice::<CrewPart>(&bytes).unwrap(), part);
            let result = part.perform(&Simulator::default());
            match &result {
                CrewResult::Cycle(states) => assert_ne!(states[0], states[1]),
                CrewResult::Bodies(scores) => assert!(scores.iter().any(Option::is_some)),
            }
            assert_eq!(read_result(&performed(&bytes).unwrap()), Some(result));
        }
    }

    #[test]
    fn bytes_that_are_no_part_are_refused() {
        let result = serde_json::to_vec(&CrewResult::Cycle(vec![vec![]])).unwrap();
        for bytes in [&[][..], &[255; 40], &result] {
            assert_eq!(performed(bytes), None);
        }
        assert_eq!(read_result(&[255; 40]), None);
    }
}
