//! The message with which a worker returns a result.

use serde::{Deserialize, Serialize};

use crate::message::{TaskKey, decode, encode};
use nbc_base::model::FaultKind;
use nbc_swarm::evolve::CandidateOutcome;
use nbc_swarm::{Evaluated, TaskResult};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnswerMessage {
    pub key: TaskKey,
    pub result: TaskResult,
}

impl AnswerMessage {
    /// The bytes of the message; `None` for work that was stopped, which has no result.
    pub fn encode(&self) -> Option<Vec<u8>> {
        (!is_stopped(&self.result)).then(|| encode(self))
    }

    /// The caller checks whether the task can have this result.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        decode(bytes).filter(|answer: &Self| !is_stopped(&answer.result))
    }
}

fn is_stopped(result: &TaskResult) -> bool {
    let fault = match result {
        TaskResult::Evaluation(Evaluated { outcome: CandidateOutcome::Faulty(fault), .. }) => Some(fault),
        TaskResult::Evaluation(_) => None,
        TaskResult::Screening(screened) => screened.as_ref().err(),
        TaskResult::Measurement(measured) => measured.as_ref().err(),
        TaskResult::Swarm(bits) => bits.fault.as_ref().map(|(_, fault)| fault),
    };
    fault.is_some_and(|fault| fault.kind == FaultKind::Stopped)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::message::VERSION;
    use crate::task_message::tests::tasks;
    use nbc_base::model::Fault;
    use nbc_sim::Simulator;
    use nbc_swarm::{SwarmBits, Task, Work, perform};

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
            let bits = SwarmBits { cycles: vec![vec![true, false]; 3], flips: Vec::new(), fault: Some((1, fault)) };
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
            if let Some(answer) = AnswerMessage::decode(&[vec![VERSION], rest].concat()) {
                prop_assert!(answer.encode().is_some());
            }
        }
    }
}
