//! The message with which a worker returns a result.

use serde::{Deserialize, Serialize};

use crate::bits::{pack, unpack};
use crate::message::{MessageFault, TaskKey, decode, encode};
use nbc_base::model::{Character, Displacements, Fault, FaultKind, Transition};
use nbc_swarm::evolve::{CandidateOutcome, Scores};
use nbc_swarm::{Evaluated, Measurement, SwarmBits, TaskResult, Work};

/// The result of a task.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerMessage {
    pub key: TaskKey,
    pub result: TaskResult,
}

/// The encoded form of [`AnswerMessage`].
#[derive(Serialize, Deserialize)]
struct AnswerRecord {
    key: TaskKey,
    result: ResultRecord,
}

/// A [`TaskResult`].
#[derive(Serialize, Deserialize)]
enum ResultRecord {
    Evaluation { outcome: OutcomeRecord, env_steps: u64, left_out: u64 },
    Screening(Result<Option<(u32, f64)>, FaultRecord>),
    Measurement(Result<(Displacements, CharacterRecord), FaultRecord>),
    Swarm { cycles: u32, robots: u32, bits: Vec<u8>, fault: Option<(u32, FaultRecord)> },
}

#[derive(Serialize, Deserialize)]
enum OutcomeRecord {
    Measured { fitness: [f64; 2], displacement: Displacements },
    Surpassed,
    Inconsistent,
    Faulty(FaultRecord),
}

/// A [`Character`] without its radius, which is not measured.
#[derive(Serialize, Deserialize)]
struct CharacterRecord {
    clock: u32,
    switches: u32,
    rates: [f64; 2],
    margin: f64,
    topples: bool,
    settle: Vec<Transition>,
}

#[derive(Serialize, Deserialize)]
enum FaultRecord {
    Unstable { env_step: u32 },
    NonFinite { env_step: u32 },
}

impl AnswerMessage {
    /// The bytes of the message; `None` for work that was stopped, which has no result.
    pub fn encode(&self) -> Option<Vec<u8>> {
        let result = match &self.result {
            TaskResult::Evaluation(evaluated) => ResultRecord::of_evaluation(evaluated)?,
            TaskResult::Screening(Ok(found)) => ResultRecord::Screening(Ok(*found)),
            TaskResult::Screening(Err(fault)) => ResultRecord::Screening(Err(FaultRecord::of(*fault)?)),
            TaskResult::Measurement(Ok(Measurement { displacement, character, .. })) => {
                ResultRecord::Measurement(Ok((*displacement, CharacterRecord::of(character))))
            }
            TaskResult::Measurement(Err(fault)) => ResultRecord::Measurement(Err(FaultRecord::of(*fault)?)),
            TaskResult::Swarm(SwarmBits { cycles, fault }) => ResultRecord::Swarm {
                cycles: cycles.len() as u32,
                robots: cycles.first().map_or(0, Vec::len) as u32,
                bits: pack(cycles.iter().flatten().copied()),
                fault: match *fault {
                    Some((robot, fault)) => Some((robot as u32, FaultRecord::of(fault)?)),
                    None => None,
                },
            },
        };
        Some(encode(&AnswerRecord { key: self.key, result }))
    }

    /// Reads a message. It does not check whether the task can have this result.
    pub fn decode(bytes: &[u8]) -> Result<Self, MessageFault> {
        let AnswerRecord { key, result } = decode(bytes)?;
        let result = match result {
            ResultRecord::Evaluation { outcome, env_steps, left_out } => {
                TaskResult::Evaluation(Evaluated { outcome: outcome.outcome(), work: Work { env_steps, left_out } })
            }
            ResultRecord::Screening(screened) => TaskResult::Screening(screened.map_err(FaultRecord::fault)),
            ResultRecord::Measurement(measured) => {
                let measurement = |(displacement, record): (Displacements, CharacterRecord)| {
                    let character = record.character();
                    let behavior = displacement.behavior();
                    Measurement { displacement, behavior, character }
                };
                TaskResult::Measurement(measured.map(measurement).map_err(FaultRecord::fault))
            }
            ResultRecord::Swarm { cycles, robots, bits, fault } => {
                // Rows without bits would cost nothing on the way.
                let rows = if robots == 0 { 0 } else { cycles as usize };
                let cycles = unpack(&bits, rows, robots as usize).ok_or(MessageFault::Values)?;
                let fault = fault.map(|(robot, fault)| (robot as usize, fault.fault()));
                TaskResult::Swarm(SwarmBits { cycles, fault })
            }
        };
        Ok(Self { key, result })
    }
}

impl ResultRecord {
    fn of_evaluation(evaluated: &Evaluated) -> Option<Self> {
        let outcome = match evaluated.outcome {
            CandidateOutcome::Measured(Scores { fitness, displacement, .. }) => {
                OutcomeRecord::Measured { fitness, displacement }
            }
            CandidateOutcome::Surpassed => OutcomeRecord::Surpassed,
            CandidateOutcome::Inconsistent => OutcomeRecord::Inconsistent,
            CandidateOutcome::Faulty(fault) => OutcomeRecord::Faulty(FaultRecord::of(fault)?),
        };
        let Work { env_steps, left_out } = evaluated.work;
        Some(Self::Evaluation { outcome, env_steps, left_out })
    }
}

impl OutcomeRecord {
    fn outcome(self) -> CandidateOutcome {
        match self {
            Self::Measured { fitness, displacement } => {
                CandidateOutcome::Measured(Scores { fitness, behavior: displacement.behavior(), displacement })
            }
            Self::Surpassed => CandidateOutcome::Surpassed,
            Self::Inconsistent => CandidateOutcome::Inconsistent,
            Self::Faulty(fault) => CandidateOutcome::Faulty(fault.fault()),
        }
    }
}

impl CharacterRecord {
    fn of(character: &Character) -> Self {
        let Character { clock, switches, error_rate, glitch_rate, margin, topples, .. } = *character;
        let (rates, settle) = ([error_rate, glitch_rate], character.settle.clone());
        Self { clock, switches, rates, margin, topples, settle }
    }

    fn character(self) -> Character {
        let Self { clock, switches, rates: [error_rate, glitch_rate], margin, topples, settle } = self;
        Character { clock, switches, error_rate, glitch_rate, margin, topples, settle, radius: None }
    }
}

impl FaultRecord {
    /// `None` if the simulation was stopped.
    fn of(Fault { env_step, kind }: Fault) -> Option<Self> {
        match kind {
            FaultKind::Unstable => Some(Self::Unstable { env_step }),
            FaultKind::NonFinite => Some(Self::NonFinite { env_step }),
            FaultKind::Stopped => None,
        }
    }

    fn fault(self) -> Fault {
        match self {
            Self::Unstable { env_step } => Fault { env_step, kind: FaultKind::Unstable },
            Self::NonFinite { env_step } => Fault { env_step, kind: FaultKind::NonFinite },
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::message::VERSION;
    use crate::task_message::tests::tasks;
    use nbc_sim::Simulator;
    use nbc_swarm::{Task, perform};

    #[test]
    fn an_answer_is_read_as_it_was_written() {
        let messages = tasks();
        let all: Vec<Task> = messages.iter().map(|message| message.task.clone()).collect();
        for (result, message) in perform(&Simulator::default(), &all, &|| ()).into_iter().zip(messages) {
            let answer = AnswerMessage { key: message.key, result };
            assert_eq!(AnswerMessage::decode(&answer.encode().unwrap()).unwrap(), answer);
        }
    }

    #[test]
    fn faults_are_read_as_they_were_written_and_stopped_work_is_no_answer() {
        let key = TaskKey { run: 1, generation: 2, index: 3 };
        for kind in [FaultKind::Unstable, FaultKind::NonFinite, FaultKind::Stopped] {
            let fault = Fault { env_step: 300, kind };
            let evaluated = Evaluated { outcome: CandidateOutcome::Faulty(fault), work: Work::default() };
            let screened = TaskResult::Screening(Err(fault));
            let bits = SwarmBits { cycles: vec![vec![true, false]; 3], fault: Some((1, fault)) };
            let measured = TaskResult::Measurement(Err(fault));
            for result in [TaskResult::Evaluation(evaluated), screened, measured, TaskResult::Swarm(bits)] {
                let answer = AnswerMessage { key, result };
                let again = answer.encode().map(|bytes| AnswerMessage::decode(&bytes).unwrap());
                assert_eq!(again, (kind != FaultKind::Stopped).then_some(answer));
            }
        }
    }

    proptest! {
        #[test]
        fn any_bytes_are_an_answer_or_a_fault(rest in prop::collection::vec(any::<u8>(), 0..300)) {
            if let Ok(answer) = AnswerMessage::decode(&[vec![VERSION], rest].concat()) {
                prop_assert!(answer.encode().is_some());
            }
        }
    }
}
