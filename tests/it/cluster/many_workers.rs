//! Many workers.

use crate::cluster::server::Server;
use crate::cluster::wire::{Wire, subject_of};
use crate::cluster::{Running, assert_same, bench, evolve};

#[test]
fn a_thousand_idle_workers_wait_and_work() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let _workers =
        Running::start(&bench, &["worker", "--nats", &server.url(), "--threads", "1000", "--name", "many_workers"]);
    wire.wait_for(|message| message.subject == subject_of("worker"));
    assert_same(&bench, &evolve(&bench, &server, &[]).end());
}
