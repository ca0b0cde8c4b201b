//! `nbc workers`.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::cluster::server::Server;
use crate::cluster::wire::Wire;
use crate::cluster::{bench, evolve, worker};

use crate::support::*;

#[test]
fn workers_and_searches_are_listed() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let _search = evolve(&bench, &server, &["--generations", "100000"]);
    let _worker = worker(&bench, &server, "steady");
    (0..10).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("steady")));
    let list = || {
        let ran = bench.ok(&["workers", "--nats", &server.url(), "--format", "json"]);
        validate("workers", &ran.out)
    };
    // On a busy machine the search may not have read the first report of the worker yet.
    let mut lists = std::iter::repeat_with(list).take(20);
    let found = lists.find(|found| found["searches"][0]["workers"] == 1).expect("the worker is counted");
    assert_eq!((&found["workers"][0]["name"], &found["workers"][0]["threads"]), (&"steady".into(), &1.into()));
    let search = &found["searches"][0];
    assert_eq!((&search["runs"], &search["workers"], &search["refused"]), (&4.into(), &1.into(), &0.into()));
    assert!(search["evaluations"].as_u64() >= Some(1) && search["waiting"].as_u64() >= Some(1), "{search}");
    let text = bench.run(&["workers", "--nats", &server.url()]).out;
    assert!(text.starts_with("search") && text.contains("\nsteady "), "{text}");
}

#[test]
fn a_watch_prints_a_line_of_json_again_and_again_until_a_signal_arrives() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut command = bench.command(&["workers", "--watch", "--nats", &server.url(), "--format", "json"]);
    let mut watch = command.stdout(Stdio::piped()).spawn().unwrap();
    let _limit = Limit::of(&watch);
    let mut lines = BufReader::new(watch.stdout.take().unwrap()).lines();
    for _ in 0..2 {
        let found = validate("workers", &lines.next().unwrap().unwrap());
        assert_eq!(found["workers"].as_array().unwrap().len(), 0);
    }
    tools::signal("INT", watch.id());
    assert_eq!(watch.wait().unwrap().code(), Some(0));
}
