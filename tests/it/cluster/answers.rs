//! Answers that are wrong, late, repeated, garbage or too long.

use std::collections::BTreeMap;

use crate::cluster::server::Server;
use crate::cluster::wire::{Seen, VERSION, Wire, foreign_note, message, subject_of};
use crate::cluster::{SMALL_STEPS, assert_same, bench, evolve, worker};
use crate::support::*;

/// The subject for an answer of a worker to the search that a task belongs to.
fn answer_subject(task: &Seen, worker: &str) -> String {
    let search = task.subject.split('.').nth(4).unwrap();
    subject_of(&format!("answer.{search}.{worker}"))
}

/// An answer to a task that could be right, but is not: the simulation of the body becomes unstable in env step 1.
fn unstable(task: &Seen) -> Vec<u8> {
    let key: Vec<u64> = task.subject.split('.').skip(5).map(|number| number.parse().unwrap()).collect();
    let outcome = json!({ "Faulty": { "env_step": 1, "kind": "unstable" } });
    answered(&key, &evaluated(&outcome, SMALL_STEPS))
}

fn answered(key: &[u64], result: &Value) -> Vec<u8> {
    let key = json!({ "run": key[0], "generation": key[1], "index": key[2] });
    message(&json!({ "key": key, "result": result }))
}

fn evaluated(outcome: &Value, env_steps: u64) -> Value {
    json!({ "Evaluation": { "outcome": outcome, "work": { "env_steps": env_steps, "left_out": 0 } } })
}

/// An answer to the first task that has too few env steps.
fn impossible() -> Vec<u8> {
    answered(&[0; 3], &evaluated(&json!("Surpassed"), 3))
}

fn is_task(message: &Seen, run: u32, generation: u32) -> bool {
    message.subject.starts_with(&subject_of("task.")) && message.subject.contains(&format!(".{run}.{generation}."))
}

#[test]
fn garbage_repeated_late_and_oversized_answers_change_nothing() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    let task = wire.wait_for(|message| is_task(message, 0, 0));
    let answer = |worker: &str| answer_subject(&task, worker);
    wire.publish(&answer("garbage"), &[VERSION, 255, 255, 255]);
    wire.publish(&answer("empty"), &[]);
    wire.publish(&answer("oversized"), &vec![VERSION; 1_000_001]);
    // A screening that found nothing, for a task that is an evaluation.
    wire.publish(&answer("confused"), &answered(&[0; 3], &json!({ "Screening": { "Ok": null } })));
    wire.publish(&answer("impossible"), &impossible());
    wire.publish(&subject_of("worker"), &foreign_note("foreign"));
    let good = worker(&bench, &server, "good");
    // Every answer is sent again at once, and the first is sent again much later.
    let first = wire.wait_for(|message| message.is_answer_of("good"));
    for _ in 0..60 {
        let again = wire.wait_for(|message| message.is_answer_of("good"));
        wire.publish(&answer("echo"), &again.payload);
        wire.publish(&answer("late"), &first.payload);
    }
    let ran = search.end();
    assert_same(&bench, &ran);
    for (worker, count) in [("garbage", 1), ("empty", 2), ("oversized", 3)] {
        let line = format!("dropped a message in the name of `{worker}` that is not an answer, {count} so far");
        assert!(ran.err.contains(&line), "{line}\n{}", ran.err);
    }
    for line in [
        "dropped a result in the name of `impossible`: its result cannot be right (1 of 3)",
        "dropped a result in the name of `confused`: its result cannot be right (1 of 3)",
        "refused worker `foreign`: its physics is 0000000000000007 (version 9.9.9), expected ",
    ] {
        assert!(ran.err.contains(line), "{line}\n{}", ran.err);
    }
    assert!(!ran.err.contains("`good`") && !ran.err.contains("`echo`") && !ran.err.contains("`late`"), "{}", ran.err);
    good.kill();
}

#[test]
fn junk_in_the_name_of_a_worker_is_dropped_and_the_worker_stays() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    let task = wire.wait_for(|message| is_task(message, 0, 0));
    let subject = answer_subject(&task, "good");
    for junk in [&[][..], &[VERSION, 255, 255, 255], b"hello", &[0; 300]] {
        wire.publish(&subject, junk);
    }
    // Answers that can be read, but are wrong, one of them with a reply to somebody else.
    wire.publish(&subject, &impossible());
    wire.publish(&format!("{subject} {}", subject_of("reply.wire")), &unstable(&task));
    let good = worker(&bench, &server, "good");
    // More junk between the answers of the worker, each from another connection.
    for number in 0..20 {
        wire.wait_for(|message| message.is_first_answer_of("good"));
        wire.publish(&format!("{subject} junk.{number}"), b"junk");
    }
    let ran = search.end();
    assert_same(&bench, &ran);
    assert!(ran.err.contains("in the name of `good` that is not an answer, 16 so far"), "{}", ran.err);
    good.signal("TERM");
    let left = good.end();
    assert!(
        left.status != 2 && !left.err.contains("reject") && !left.err.contains("its messages cannot be read"),
        "{}",
        left.err
    );
}

#[test]
fn a_forged_message_in_the_name_of_a_worker_does_not_remove_it() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let good = worker(&bench, &server, "good");
    let search = evolve(&bench, &server, &[]);
    let is_first_answer = |message: &Seen| message.is_first_answer_of("good");
    (0..20).for_each(|_| _ = wire.wait_for(is_first_answer));
    // A wrong result of a task, which claims to come from the connection of the worker.
    let answer = wire.wait_for(is_first_answer);
    let task = wire.wait_for(|message| message.subject.starts_with(&subject_of("task.")));
    let (connection, _) = answer.reply.rsplit_once('.').expect("the worker waits for a reply");
    wire.publish(&format!("{} {connection}.forged", answer_subject(&task, "good")), &unstable(&task));
    // A report of other physics, and a reply that says that a result is wrong.
    wire.publish(&subject_of("worker"), &foreign_note("good"));
    let answer = wire.wait_for(|message| message.is_answer_of("good"));
    wire.publish(&answer.reply, &message(&json!("Wrong")));
    let ran = search.end();
    assert_same(&bench, &ran);
    assert!(
        ran.err.contains("dropped a result in the name of `good`: ") && ran.err.contains("(1 of 3)"),
        "{}",
        ran.err
    );
    assert!(!ran.err.contains("refused worker"), "{}", ran.err);
    good.signal("TERM");
    let left = good.end();
    assert_eq!(left.status, 0, "{}", left.err);
}

#[test]
fn a_worker_whose_first_answer_is_wrong_is_refused_and_its_answers_are_not_used() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    for _ in 0..9 {
        let task = wire.wait_for(|message| is_task(message, 1, 0));
        wire.publish(&answer_subject(&task, "liar"), &unstable(&task));
    }
    let _good = worker(&bench, &server, "good");
    let ran = search.end();
    assert_same(&bench, &ran);
    let line = "refused worker `liar`: its result differs from that of this machine";
    assert!(ran.err.contains(line) && !ran.err.contains("`good`"), "{}", ran.err);
}

#[test]
fn a_worker_that_is_wrong_after_its_results_were_used_ends_the_search_with_a_checkpoint() {
    let Some(server) = Server::start(&[]) else { return };
    let mut wire = Wire::open(&server);
    // The right answers of the first two generations of the first run.
    let first = bench();
    let (search, good) = (evolve(&first, &server, &["--seed", "1"]), worker(&first, &server, "good"));
    let mut right = BTreeMap::new();
    loop {
        let answer = wire.wait_for(|message| message.is_first_answer_of("good"));
        let key = &serde_json::from_slice::<Value>(&answer.payload[1..]).unwrap()["key"];
        let [generation, index] = ["generation", "index"].map(|field| key[field].as_u64().unwrap());
        if generation == 2 {
            break;
        }
        right.insert((generation, index), answer.payload);
    }
    drop((search, good));
    // A worker gives those of the first generation, and is wrong in the second, where another contradicts.
    let second = bench();
    let search = evolve(&second, &server, &["--seed", "1"]);
    let task = wire.wait_for(|message| is_task(message, 0, 0));
    for answer in right.range((0, 0)..(1, 0)).map(|(_, answer)| answer) {
        wire.publish(&answer_subject(&task, "turncoat"), answer);
    }
    let answer = |task: &Seen| &right[&(1, task.subject.rsplit('.').next().unwrap().parse().unwrap())];
    for _ in 0..3 {
        let task = wire.wait_for(|message| is_task(message, 0, 1));
        wire.publish(&answer_subject(&task, "turncoat"), &unstable(&task));
        wire.publish(&answer_subject(&task, "honest"), answer(&task));
    }
    let ran = search.end();
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(ran.err.contains("worker `turncoat` sent a wrong result, and earlier ones of it were used"), "{}", ran.err);
    assert!(second.has("out/small/seed-1/checkpoint.nbc"));
}
