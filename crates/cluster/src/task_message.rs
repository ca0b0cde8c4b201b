//! The message with which a worker receives a task.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::bits::{pack, unpack};
use crate::message::{MessageFault, TaskKey, decode, encode};
use nbc_base::model::{
    Behavior, Body, CYCLE_STEPS, Displacements, GroundProfile, Image, ImageOrder, ImageSize, Niche, Palette, Pattern,
    PhysicsWorld, SampledWorlds, Schedule, SearchObjective, Spell, WorldFactors, WorldNoise,
};
use nbc_swarm::evolve::{Rivals, validate};
use nbc_swarm::{EvaluationProtocol, EvaluationTask, ImageSets, PlainMember, StimulusSource, SwarmTask, Task};

/// The most env steps of one simulation.
const MOST_STEPS: u64 = 100_000_000;
/// The most cycles of a swarm.
const MOST_CYCLES: usize = 100_000;
/// The longest clock of a gate, in cycles.
const MOST_CLOCK: u32 = 8;
/// The most tasks that a thread takes together. Evaluations end at different times, so it takes twice as many as there
/// are lanes to keep the lanes full.
pub const TOGETHER: u8 = 16;

/// A task to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskMessage {
    pub key: TaskKey,
    /// The number of tasks that a thread should take together: more keep its lanes full, fewer leave work for others.
    pub together: u8,
    pub task: Task,
}

/// The encoded form of [`TaskMessage`].
#[derive(Serialize, Deserialize)]
struct TaskRecord {
    key: TaskKey,
    together: u8,
    work: WorkRecord,
}

/// A [`Task`].
#[derive(Serialize, Deserialize)]
enum WorkRecord {
    Evaluation(EvaluationRecord),
    Screening { body: BodyRecord, behavior: BehaviorRecord, most: u32 },
    Measurement(BodyRecord),
    Swarm(SwarmRecord),
}

/// A world with all its fields: messages have no names that could be left out.
#[derive(Clone, Serialize, Deserialize)]
struct WorldRecord(WorldFactors, WorldNoise, GroundRecord);

/// Ground as heights, or as the rows of each column of a file that are voxels.
#[derive(Clone, Serialize, Deserialize)]
enum GroundRecord {
    Heights(Vec<u8>),
    Cells(Vec<u32>),
}

#[derive(Serialize, Deserialize)]
struct EvaluationRecord {
    objective: SearchObjective,
    behaviors: Vec<BehaviorRecord>,
    /// Stimuli as bits, and env steps.
    variable: Vec<(u32, u32)>,
    /// The image of each of them, or none at all.
    images: Vec<ImageRecord>,
    in_turn: bool,
    fixed_steps: u32,
    world: WorldRecord,
    others: Vec<WorldRecord>,
    body: BodyRecord,
    pareto: Option<u32>,
    /// Each set of rivals once: many behaviors lead to the same niches.
    fronts: Vec<Vec<[f64; 2]>>,
    /// The places of those that a body must beat, for each behavior.
    rivals: Vec<Vec<u16>>,
    /// The displacements of its parent.
    expected: Option<Vec<f64>>,
}

/// The rows and columns of an image, and its pixels.
#[derive(Serialize, Deserialize)]
struct ImageRecord(u16, u16, Vec<f64>);

/// The stimuli of a behavior, and the bits of its function.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct BehaviorRecord(u8, u8);

#[derive(Serialize, Deserialize)]
struct BodyRecord {
    /// The materials as in checkpoints.
    palette: String,
    width: u8,
    height: u8,
    codes: Vec<u8>,
}

#[derive(Serialize, Deserialize)]
struct SwarmRecord {
    /// Each body once.
    bodies: Vec<BodyRecord>,
    members: Vec<MemberRecord>,
    world: WorldRecord,
    window: u32,
    beat: u32,
    cycles: u32,
    /// The bits of the input ports, and those of each cycle.
    width: u32,
    inputs: Vec<u8>,
}

#[derive(Serialize, Deserialize)]
struct MemberRecord {
    /// Its place among the bodies.
    body: u32,
    clock: u32,
    senses: Vec<SourceRecord>,
    start: bool,
    /// For each stimulus, for how many cycles it is held, and its bits then.
    held: Vec<(u32, Vec<u8>)>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
enum SourceRecord {
    Input(u32),
    Robot(u32),
    Constant(bool),
}

impl TaskMessage {
    /// The bytes of the message.
    pub fn encode(&self) -> Vec<u8> {
        encode(&TaskRecord { key: self.key, together: self.together, work: WorkRecord::of(&self.task) })
    }

    /// Reads and checks.
    pub fn decode(bytes: &[u8]) -> Result<Self, MessageFault> {
        decode::<TaskRecord>(bytes)?.check().ok_or(MessageFault::Values)
    }
}

/// The bytes of a task without its envelope.
pub fn task_bytes(task: &Task) -> usize {
    encode(&WorkRecord::of(task)).len()
}

impl WorkRecord {
    fn of(task: &Task) -> Self {
        match task {
            Task::Evaluation(protocol, task) => Self::Evaluation(EvaluationRecord::of(protocol, task)),
            Task::Screening { body, behavior, most } => {
                let (body, behavior) = (BodyRecord::of(body), BehaviorRecord::of(*behavior));
                Self::Screening { body, behavior, most: *most }
            }
            Task::Measurement(body) => Self::Measurement(BodyRecord::of(body)),
            Task::Swarm(swarm) => Self::Swarm(SwarmRecord::of(swarm)),
        }
    }
}

impl TaskRecord {
    fn check(self) -> Option<TaskMessage> {
        let task = match self.work {
            WorkRecord::Evaluation(record) => record.check()?,
            WorkRecord::Screening { body, behavior, most } => {
                let (body, behavior) = (body.check()?, behavior.check()?);
                let fits = behavior.stimuli() == body.palette().inputs() && (1..=MOST_CLOCK).contains(&most);
                fits.then_some(Task::Screening { body, behavior, most })?
            }
            WorkRecord::Measurement(body) => Task::Measurement(body.check()?),
            WorkRecord::Swarm(record) => Task::Swarm(Box::new(record.check()?)),
        };
        let is_bounded = (1..=TOGETHER).contains(&self.together);
        is_bounded.then_some(TaskMessage { key: self.key, together: self.together, task })
    }
}

impl BehaviorRecord {
    fn of(behavior: Behavior) -> Self {
        Self(behavior.stimuli() as u8, behavior.function().bits())
    }

    fn check(self) -> Option<Behavior> {
        let Self(stimuli, bits) = self;
        matches!(stimuli, 2 | 3).then(|| Behavior::all(stimuli.into()).nth(bits.into()))?
    }
}

impl EvaluationRecord {
    fn of(protocol: &EvaluationProtocol, task: &EvaluationTask) -> Self {
        let spell = |spell: &Spell| {
            let bits = (0..Pattern::MAX_STIMULI).map(|i| u32::from(spell.pattern.has(i)) << i).sum();
            (bits, spell.steps)
        };
        let mut fronts: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut places: BTreeMap<Vec<[u64; 2]>, u16> = BTreeMap::new();
        let mut place = |front: &Vec<[f64; 2]>| {
            *places.entry(front.iter().map(|two| two.map(f64::to_bits)).collect()).or_insert_with(|| {
                fronts.push(front.clone());
                (fronts.len() - 1) as u16
            })
        };
        let rivals = task.rivals.behaviors();
        let rivals = rivals.iter().map(|niches| niches.iter().map(&mut place).collect()).collect();
        Self {
            objective: protocol.objective,
            behaviors: protocol.behaviors.iter().map(|&behavior| BehaviorRecord::of(behavior)).collect(),
            variable: protocol.variable.spells.iter().map(spell).collect(),
            images: protocol
                .variable
                .spells
                .iter()
                .filter_map(|spell| spell.image.as_deref())
                .map(ImageRecord::of)
                .collect(),
            in_turn: protocol.shown == ImageOrder::InTurn,
            fixed_steps: protocol.fixed_steps,
            world: protocol.world.into(),
            others: protocol.others.iter().copied().map(Into::into).collect(),
            body: BodyRecord::of(&task.body),
            pareto: match task.rivals.niche() {
                Niche::Dominance => None,
                Niche::Pareto(most) => Some(most as u32),
            },
            fronts,
            rivals,
            expected: task.expected.map(Vec::from),
        }
    }

    fn check(self) -> Option<Task> {
        let steps = self.variable.iter().map(|&(_, steps)| u64::from(steps)).sum::<u64>();
        let body = self.body.check()?;
        validate(&body).ok()?;
        let stimuli = body.palette().inputs();
        let is_bounded =
            steps.max(self.fixed_steps.into()) <= MOST_STEPS && self.others.len() <= SampledWorlds::MOST as usize;
        let world = self.world.check()?;
        let others: Vec<PhysicsWorld> = self.others.into_iter().map(WorldRecord::check).collect::<Option<_>>()?;
        if !is_bounded
            || self.rivals.len() != Behavior::all(stimuli).count()
            || self.behaviors.len() > Behavior::all(stimuli).count()
        {
            return None;
        }
        let images = self.images.into_iter().map(ImageRecord::check).collect::<Option<Vec<_>>>()?;
        let is_shown = self.objective == SearchObjective::Images;
        if images.len() != if is_shown { self.variable.len() } else { 0 } || is_shown && images.is_empty() {
            return None;
        }
        let images = images.into_iter().map(Some).chain(std::iter::repeat(None));
        let spell = |((bits, steps), image): ((u32, u32), Option<Image>)| {
            let present: Vec<bool> = (0..Pattern::MAX_STIMULI).map(|i| bits >> i & 1 == 1).collect();
            Spell { image: image.map(Arc::new), ..Spell::of(Pattern::new(&present), steps) }
        };
        let niche = self.pareto.map_or(Niche::Dominance, |most| Niche::Pareto(most as usize));
        let variable = Schedule { spells: self.variable.into_iter().zip(images).map(spell).collect() };
        if is_shown && !ImageSets::of(&variable).can_be_told() {
            return None;
        }
        let shown = if self.in_turn { ImageOrder::InTurn } else { ImageOrder::Apart };
        let Self { objective, behaviors, fixed_steps, .. } = self;
        let behavior = |record: BehaviorRecord| record.check().filter(|behavior| behavior.stimuli() == stimuli);
        let behaviors: Vec<Behavior> = behaviors.into_iter().map(behavior).collect::<Option<_>>()?;
        let protocol =
            EvaluationProtocol { stimuli, objective, behaviors, variable, shown, fixed_steps, world, others };
        let front = |place: &u16| self.fronts.get(usize::from(*place)).cloned();
        let rivals = self.rivals.iter().map(|places| places.iter().map(front).collect());
        let rivals = Rivals::new(niche, rivals.collect::<Option<_>>()?);
        let expected = self.expected.map(Displacements::try_from).transpose().ok()?;
        if expected.is_some_and(|expected| expected.len() != 1 << stimuli) {
            return None;
        }
        let task = EvaluationTask { body, rivals, expected };
        Some(Task::Evaluation(Arc::new(protocol), task))
    }
}

impl BodyRecord {
    fn of(body: &Body) -> Self {
        Self {
            palette: serde_json::to_string(body.palette().as_ref()).expect("materials can be written as JSON"),
            width: body.width() as u8,
            height: body.height() as u8,
            codes: body.codes().to_vec(),
        }
    }

    fn check(self) -> Option<Body> {
        let (width, height) = (usize::from(self.width), usize::from(self.height));
        if width * height != self.codes.len() || self.codes.is_empty() {
            return None;
        }
        let palette: Arc<Palette> = Arc::new(serde_json::from_str(&self.palette).ok()?);
        Body::from_codes(width, height, &self.codes, &palette).ok()
    }
}

impl ImageRecord {
    fn of(image: &Image) -> Self {
        let [rows, columns] = <[usize; 2]>::from(image.size()).map(|side| side as u16);
        Self(rows, columns, image.pixels().to_vec())
    }

    fn check(self) -> Option<Image> {
        Image::new(ImageSize::new(self.0.into(), self.1.into()), self.2).ok()
    }
}

impl From<PhysicsWorld> for WorldRecord {
    fn from(PhysicsWorld { factors, noise, ground }: PhysicsWorld) -> Self {
        let ground = match ground.is_of_file() {
            true => GroundRecord::Cells(ground.columns().to_vec()),
            false => GroundRecord::Heights(ground.heights()),
        };
        Self(factors, noise, ground)
    }
}

impl WorldRecord {
    fn check(self) -> Option<PhysicsWorld> {
        let Self(factors, noise, ground) = self;
        let ground = match ground {
            GroundRecord::Heights(heights) if heights.is_empty() => GroundProfile::default(),
            GroundRecord::Heights(heights) => GroundProfile::new(&heights)?,
            GroundRecord::Cells(columns) => GroundProfile::of_cells(&columns)?,
        };
        Some(PhysicsWorld { factors, noise, ground }).filter(PhysicsWorld::is_possible)
    }
}

impl SwarmRecord {
    fn of(task: &SwarmTask) -> Self {
        let mut bodies: Vec<&Body> = Vec::new();
        let mut members = Vec::new();
        for member in &task.assembly.members {
            let body = &member.robot.body;
            let known = bodies.iter().position(|other| *other == body);
            let place = known.unwrap_or_else(|| {
                bodies.push(body);
                bodies.len() - 1
            });
            members.push(MemberRecord {
                body: place as u32,
                clock: member.robot.character.clock,
                senses: member.senses.iter().map(|&source| SourceRecord::of(source)).collect(),
                start: member.start,
                held: member.held.iter().map(|bits| (bits.len() as u32, pack(bits.iter().copied()))).collect(),
            });
        }
        let inputs = &task.conditions.inputs;
        Self {
            bodies: bodies.into_iter().map(BodyRecord::of).collect(),
            members,
            world: task.assembly.world.into(),
            window: task.conditions.window as u32,
            beat: task.assembly.beat,
            cycles: inputs.len() as u32,
            width: inputs.first().map_or(0, Vec::len) as u32,
            inputs: pack(inputs.iter().flatten().copied()),
        }
    }

    fn check(self) -> Option<SwarmTask> {
        let (cycles, width, robots) = (self.cycles as usize, self.width as usize, self.members.len());
        let steps = cycles as u64 * u64::from(CYCLE_STEPS);
        if !(1..=MOST_CYCLES).contains(&cycles) || steps > MOST_STEPS || [self.window, self.beat].contains(&0) {
            return None;
        }
        let bodies = self.bodies.into_iter().map(BodyRecord::check).collect::<Option<Vec<Body>>>()?;
        let inputs = unpack(&self.inputs, cycles, width)?;
        let member = |record: MemberRecord| {
            let body = bodies.get(record.body as usize)?.clone();
            let senses = record.senses.into_iter().map(|source| source.check(width, robots));
            let senses = senses.collect::<Option<Vec<StimulusSource>>>()?;
            let bits = |(held, bits): (u32, Vec<u8>)| unpack(&bits, 1, held as usize).map(|mut rows| rows.remove(0));
            let held = record.held.into_iter().map(bits).collect::<Option<Vec<_>>>()?;
            let fits = matches!(senses.len(), 2 | 3) && held.len() == senses.len();
            fits.then_some(PlainMember { body, clock: record.clock, senses, start: record.start, held })
        };
        let members = self.members.into_iter().map(member).collect::<Option<Vec<_>>>()?;
        let mut task = SwarmTask::new(members, self.world.check()?, inputs, self.window as usize);
        task.assembly.beat = self.beat;
        Some(task)
    }
}

impl SourceRecord {
    fn of(source: StimulusSource) -> Self {
        match source {
            StimulusSource::Input(place) => Self::Input(place as u32),
            StimulusSource::Robot(place) => Self::Robot(place as u32),
            StimulusSource::Constant(bit) => Self::Constant(bit),
        }
    }

    fn check(self, width: usize, robots: usize) -> Option<StimulusSource> {
        match self {
            Self::Input(place) => ((place as usize) < width).then_some(StimulusSource::Input(place as usize)),
            Self::Robot(place) => ((place as usize) < robots).then_some(StimulusSource::Robot(place as usize)),
            Self::Constant(bit) => Some(StimulusSource::Constant(bit)),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::sync::OnceLock;

    use proptest::prelude::*;

    use super::*;
    use crate::message::{MOST_BYTES, VERSION};
    use nbc_base::model::{Evolution, Symmetry, WorldFactors};
    use nbc_base::source::MemoryWorld;
    use nbc_session::Session;
    use nbc_swarm::evolve::{Candidate, Search};
    use nbc_swarm::evolve_generation;

    /// The evolution of the prelude, which is the paper's.
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

    #[test]
    fn ground_travels() {
        let ground = [
            GroundProfile::default(),
            GroundProfile::new(&[0, 2, 1]).unwrap(),
            GroundProfile::of_cells(&[1, 0b101, 0]).unwrap(),
        ];
        for ground in ground {
            let world = PhysicsWorld { ground, ..world() };
            assert_eq!(WorldRecord::from(world).check(), Some(world));
        }
        let WorldRecord(factors, noise, _) = world().into();
        for wrong in
            [GroundRecord::Heights(vec![11]), GroundRecord::Cells(Vec::new()), GroundRecord::Cells(vec![1; 129])]
        {
            assert_eq!(WorldRecord(factors, noise, wrong).check(), None);
        }
    }

    /// A swarm of two robots that sense each other and two inputs.
    fn swarm() -> Task {
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
        Task::Swarm(Box::new(SwarmTask::new(members, world(), inputs, 1)))
    }

    /// A task of each kind; the evaluations are those of a generation with a filled archive.
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
        all.push(swarm());
        let key = |index| TaskKey { run: 2, generation: 1, index };
        (0..).zip(all).map(|(index, task)| TaskMessage { key: key(index), together: 8, task }).collect()
    }

    #[test]
    fn a_task_is_read_as_it_was_written() {
        for task in tasks() {
            let bytes = task.encode();
            assert!(bytes.len() < MOST_BYTES / 16, "{} bytes", bytes.len());
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
        assert_eq!(TaskMessage::decode(&message.encode()), Ok(message));
        let changed = |change: fn(&mut EvaluationProtocol)| {
            let mut changed = protocol.clone();
            change(&mut changed);
            assert_eq!(TaskMessage::decode(&written(&changed).encode()), Err(MessageFault::Values));
        };
        changed(|protocol| protocol.variable.spells.truncate(1));
        changed(|protocol| protocol.variable.spells[1].image = None);
        changed(|protocol| protocol.objective = SearchObjective::Distance);
    }

    #[test]
    fn a_swarm_whose_robots_sense_what_is_not_there_is_a_fault() {
        let missing = [SourceRecord::Input(2), SourceRecord::Robot(2)].map(|source| vec![source; 2]);
        for senses in missing.into_iter().chain([vec![SourceRecord::Input(0)]]) {
            let Task::Swarm(task) = swarm() else { unreachable!() };
            let mut record = SwarmRecord::of(&task);
            record.members[0].senses = senses;
            assert_eq!(record.check(), None);
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
            if let Ok(message) = TaskMessage::decode(&bytes) {
                if let Task::Evaluation(protocol, task) = &message.task {
                    prop_assert!(protocol.world.is_possible());
                    prop_assert_eq!(validate(&task.body), Ok(()));
                }
                prop_assert_eq!(TaskMessage::decode(&message.encode()).map(|again| again.key), Ok(message.key));
            }
        }
    }
}
