//! Workers, searches and servers that are killed.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::cluster::server::Server;
use crate::cluster::wire::{Wire, subject_of};
use crate::cluster::{Running, assert_same, bench, evolve, worker};

#[test]
fn two_workers_that_are_both_killed_once_give_the_bytes_of_a_run_alone() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let (first, second) = (worker(&bench, &server, "first"), worker(&bench, &server, "second"));
    let search = evolve(&bench, &server, &[]);
    wire.wait_for(|message| message.is_answer_of("first"));
    first.kill();
    let third = worker(&bench, &server, "third");
    wire.wait_for(|message| message.is_answer_of("third"));
    second.kill();
    let fourth = worker(&bench, &server, "fourth");
    wire.wait_for(|message| message.is_answer_of("fourth"));
    let ran = search.end();
    assert!(ran.err.contains("keeps about 30 cores busy\n"), "{}", ran.err);
    assert_same(&bench, &ran);
    for left in [third, fourth] {
        left.signal("TERM");
        let ran = left.end();
        assert_eq!(ran.status, 0, "{}", ran.err);
        assert!(ran.err.contains(" evaluations\n"), "{}", ran.err);
    }
}

#[test]
fn workers_that_are_killed_twenty_times_at_random_lose_nothing() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let search = evolve(&bench, &server, &[]);
    for number in 0..20 {
        let name = format!("worker-{number}");
        let victim = worker(&bench, &server, &name);
        wire.wait_for(|message| {
            message.subject == subject_of("worker")
                && message.payload[1..].starts_with(format!("{{\"name\":\"{name}").as_bytes())
        });
        let answers = random.random_range(0..3);
        (0..answers).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of(&name)));
        victim.kill();
    }
    let _last = worker(&bench, &server, "last");
    assert_same(&bench, &search.end());
}

#[test]
fn a_server_that_is_killed_and_restarted_on_its_disk_loses_nothing() {
    the_server_fails(Server::restart);
}

#[test]
fn a_server_that_loses_its_disk_is_given_the_tasks_again() {
    the_server_fails(Server::restart_empty);
}

#[track_caller]
fn the_server_fails(fail: fn(&mut Server)) {
    let Some(mut server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let _worker = worker(&bench, &server, "steady");
    let search = evolve(&bench, &server, &[]);
    (0..20).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("steady")));
    fail(&mut server);
    assert_same(&bench, &search.end());
}

#[test]
fn a_search_that_is_killed_continues_while_workers_answer_the_dead_one() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let _worker = worker(&bench, &server, "steady");
    let search = evolve(&bench, &server, &[]);
    (0..100).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("steady")));
    search.kill();
    assert_same(&bench, &evolve(&bench, &server, &["--resume"]).end());
}

#[test]
fn an_interrupted_search_can_be_resumed_alone() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let _worker = worker(&bench, &server, "steady");
    let search = evolve(&bench, &server, &[]);
    (0..60).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("steady")));
    search.signal("TERM");
    let ran = search.end();
    assert_eq!(ran.status, 4, "{}", ran.err);
    assert!(ran.out.contains("interrupted; `--resume` continues the run"), "{}", ran.out);
    let resumed = Running::start(&bench, &["evolve", "small.nb", "--resume"]).end();
    assert_same(&bench, &resumed);
}
