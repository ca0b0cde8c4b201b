//! The message with which a worker receives a task.

use serde::{Deserialize, Serialize};

use crate::message::{TaskKey, decode, encode};
use nbc_base::model::{Behavior, PhysicsWorld, SampledWorlds, SearchObjective};
use nbc_swarm::evolve::validate;
use nbc_swarm::{EvaluationProtocol, EvaluationTask, ImageSets, Task};

const MOST_STEPS: u64 = 100_000_000;
const MOST_CYCLES: usize = 100_000;
/// The longest clock of a gate, in cycles.
const MOST_CLOCK: u32 = 8;
/// The most tasks that a thread takes together. Evaluations end at different times, so it takes twice as many as there
/// are lanes to keep the lanes full.
pub const TOGETHER: u8 = 16;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskMessage {
    pub key: TaskKey,
    /// The number of tasks that a thread should take together: more keep its lanes full, fewer leave work for others.
    pub together: u8,
    pub task: Task,
}

impl TaskMessage {
    pub fn encode(&self) -> Vec<u8> {
        encode(self)
    }

    pub fn decode(bytes: &[u8]) -> Option<Self> {
        let message: Self = decode(bytes)?;
        let is_possible = match &message.task {
            Task::Evaluation(protocol, task) => can_be_evaluated(protocol, task),
            Task::Screening { body, behavior, most } => {
                behavior.stimuli() == body.palette().inputs() && (1..=MOST_CLOCK).contains(most)
            }
            Task::Measurement(_) => true,
            Task::Swarm(swarm) => (1..=MOST_CYCLES).contains(&swarm.cycles()) && swarm.assembly.world.is_possible(),
        };
        (is_possible && (1..=TOGETHER).contains(&message.together)).then_some(message)
    }
}

fn can_be_evaluated(protocol: &EvaluationProtocol, task: &EvaluationTask) -> bool {
    let EvaluationProtocol { objective, behaviors, variable, fixed_steps, world, others, .. } = protocol;
    let (spells, stimuli) = (&variable.spells, task.body.palette().inputs());
    let all = Behavior::all(stimuli).count();
    let steps: u64 = spells.iter().map(|spell| u64::from(spell.steps)).sum();
    let images = spells.iter().filter(|spell| spell.image.is_some()).count();
    let is_shown = match objective {
        SearchObjective::Images => {
            !spells.is_empty() && images == spells.len() && ImageSets::of(variable).can_be_told()
        }
        _ => images == 0,
    };
    is_shown
        && protocol.stimuli == stimuli
        && validate(&task.body).is_ok()
        && steps.max((*fixed_steps).into()) <= MOST_STEPS
        && others.len() <= SampledWorlds::MOST as usize
        && others.iter().chain([world]).all(PhysicsWorld::is_possible)
        && task.rivals.behaviors().len() == all
        && behaviors.len() <= all
        && behaviors.iter().all(|behavior| behavior.stimuli() == stimuli)
        && task.expected.is_none_or(|expected| expected.len() == 1 << stimuli)
}

#[cfg(test)]
pub(super) mod tests {
    use std::sync::OnceLock;

    use proptest::prelude::*;

    use super::*;
    use crate::message::{MOST_BYTES, VERSION};
    use std::sync::Arc;

    use nbc_base::model::{Body, Evolution, GroundProfile, Palette, Symmetry, WorldFactors};
    use nbc_base::source::MemoryWorld;
    use nbc_session::Session;
    use nbc_swarm::evolve::{Candidate, Search};
    use nbc_swarm::{PlainMember, StimulusSource, SwarmTask, evolve_generation};

    pub(crate) fn evolution() -> Evolution {
        let mut session = Session::new(MemoryWorld::default());
        session.update("a.nb", 1, "evolution paper { from: gates }");
        let checked = session.open("a.nb").unwrap();
        checked.program.evolution("paper").unwrap().clone()
    }

    fn world() -> PhysicsWorld {
        let factors = WorldFactors { friction: 0.9, ..WorldFactors::default() };
        let ground = GroundProfile::new(&[0, 2, 1]).unwrap();
        PhysicsWorld { factors, ground, ..PhysicsWorld::default() }
    }

    fn swarm() -> SwarmTask {
        let body = Body::parse(&["34", "43"], &Palette::paper()).unwrap();
        let member = |senses: [StimulusSource; 2], start| PlainMember {
            body: body.clone(),
            clock: 2,
            senses: senses.to_vec(),
            start,
            held: vec![vec![start; 3], Vec::new()],
        };
        let members = vec![
            member([StimulusSource::Input(0), StimulusSource::Robot(1)], true),
            member([StimulusSource::Robot(0), StimulusSource::Input(1)], false),
        ];
        let inputs = vec![vec![true, false], vec![false, true], vec![true, true]];
        SwarmTask::new(members, world(), inputs, 1)
    }

    pub fn tasks() -> &'static [TaskMessage] {
        static TASKS: OnceLock<Vec<TaskMessage>> = OnceLock::new();
        TASKS.get_or_init(make_tasks)
    }

    fn make_tasks() -> Vec<TaskMessage> {
        let mut search = Search::new(&Evolution { symmetry: Symmetry::Npn, ..evolution() }, 1);
        evolve_generation(&mut search);
        let of = EvaluationProtocol::of(search.evolution());
        let protocol = EvaluationProtocol { world: world(), others: vec![PhysicsWorld::default(), world()], ..of };
        let protocol = Arc::new(protocol);
        let evaluation =
            |candidate: Candidate| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&search, &candidate));
        let mut all: Vec<Task> = search.ask().into_iter().map(evaluation).collect();
        let body = Body::parse(&["34", "43"], &Palette::paper()).unwrap();
        all.push(Task::Screening { body: body.clone(), behavior: "RRRL".parse().unwrap(), most: 1 });
        all.push(Task::Measurement(body));
        all.push(Task::Swarm(Box::new(swarm())));
        let key = |index| TaskKey { run: 2, generation: 1, index };
        (0..).zip(all).map(|(index, task)| TaskMessage { key: key(index), together: 8, task }).collect()
    }

    #[test]
    fn a_task_is_read_as_it_was_written() {
        for task in tasks() {
            let bytes = task.encode();
            assert!(bytes.len() < MOST_BYTES / 40, "{} bytes", bytes.len());
            assert_eq!(&TaskMessage::decode(&bytes).unwrap(), task);
        }
    }

    #[test]
    fn images_travel_and_one_set_of_them_is_a_fault() {
        let mut world = MemoryWorld::default();
        world.insert("a.csv", "0,1,0\n1,0.5,1\n");
        let text = "stimulus spot[1][2]
material eye { kind: sensor, stimulus: spot, absent: 0.6, present: 1.6 }
images zeros { stimulus: spot, from: \"a.csv\", label: 0 }
images ones { stimulus: spot, from: \"a.csv\", label: 1 }
schedule both(spot) { zeros for 9 steps ones for 8 steps }
evolution see { objective: images, variable: both, materials: [muscle, eye], genome: voxels, shown: in_turn }";
        world.insert("a.nb", text);
        let checked = Session::new(world).open("a.nb").unwrap();
        let search = Search::new(checked.program.evolution("see").unwrap(), 1);
        let protocol = EvaluationProtocol::of(search.evolution());
        let candidate = &search.ask()[0];
        let written = |protocol: &EvaluationProtocol| {
            let task = Task::Evaluation(Arc::new(protocol.clone()), EvaluationTask::of(&search, candidate));
            TaskMessage { key: TaskKey { run: 2, generation: 1, index: 0 }, together: 8, task }
        };
        let message = written(&protocol);
        assert_eq!(TaskMessage::decode(&message.encode()), Some(message));
        let changed = |change: fn(&mut EvaluationProtocol)| {
            let mut changed = protocol.clone();
            change(&mut changed);
            assert_eq!(TaskMessage::decode(&written(&changed).encode()), None);
        };
        changed(|protocol| protocol.variable.spells.truncate(1));
        changed(|protocol| protocol.variable.spells[1].image = None);
        changed(|protocol| protocol.objective = SearchObjective::Distance);
    }

    #[test]
    fn a_swarm_whose_robots_sense_what_is_not_there_is_a_fault() {
        let missing = [StimulusSource::Input(2), StimulusSource::Robot(2)].map(|source| vec![source; 2]);
        for senses in missing.into_iter().chain([vec![StimulusSource::Input(0)]]) {
            let mut task = swarm();
            task.assembly.members[0].senses = senses;
            let key = TaskKey { run: 0, generation: 0, index: 0 };
            let message = TaskMessage { key, together: 1, task: Task::Swarm(Box::new(task)) };
            assert_eq!(TaskMessage::decode(&message.encode()), None);
        }
    }

    proptest! {
        #[test]
        fn any_bytes_are_a_task_or_a_fault(rest in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = TaskMessage::decode(&[vec![VERSION], rest].concat());
        }

        #[test]
        fn a_changed_task_can_be_simulated_or_is_a_fault(
            place in any::<prop::sample::Index>(),
            changes in prop::collection::vec((any::<usize>(), any::<u8>()), 1..4),
        ) {
            let mut bytes = place.get(tasks()).encode();
            for (at, byte) in changes {
                let length = bytes.len();
                bytes[at % length] = byte;
            }
            if let Some(message) = TaskMessage::decode(&bytes) {
                if let Task::Evaluation(protocol, task) = &message.task {
                    prop_assert!(protocol.world.is_possible());
                    prop_assert_eq!(validate(&task.body), Ok(()));
                }
                prop_assert_eq!(TaskMessage::decode(&message.encode()).map(|again| again.key), Some(message.key));
            }
        }
    }
}
