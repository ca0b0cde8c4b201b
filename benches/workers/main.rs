//! Many workers, and what they cost: `cargo bench --features cluster --bench workers` takes five minutes, and with
//! `-- coordinator` two.

// Files of the tests have more than this needs.
#![allow(dead_code, unused_imports)]

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use fake_workers::FakeWorkers;
use running::Running;
use server::Server;
use support::bench::Bench;
use wire::Wire;

mod fake_workers;
#[path = "../../tests/it/cluster/running.rs"]
mod running;
#[path = "../../tests/it/cluster/server.rs"]
mod server;
#[path = "../../tests/it/support/mod.rs"]
mod support;
#[path = "../../tests/it/cluster/wire.rs"]
mod wire;

/// The names by which these files know each other in the tests.
mod cluster {
    pub(crate) use super::{server, wire};
}

fn main() {
    if std::env::args().any(|argument| argument == "coordinator") {
        measure_the_coordinator();
    } else {
        measure_the_overhead();
    }
}

fn worker(bench: &Bench, server: &Server, name: &str) -> Running {
    Running::start(bench, &["worker", "--nats", &server.url(), "--threads", "1", "--name", name])
}

/// What a search with many workers costs: two minutes.
fn measure_the_coordinator() {
    const SECONDS: u64 = 20;
    let text = "evolution many_workers { from: gates, generations: 100000, seed: 1..130 }\n";
    println!("workers  evaluations/s  CPU us of the search  CPU us of the server");
    for workers in [250, 500, 1000, 2000] {
        let Some(server) = Server::start(&[]) else { return };
        let bench = Bench::new();
        bench.file("many_workers.nb", text);
        let mut wire = Wire::open(&server);
        let arguments =
            ["evolve", "many_workers.nb", "--trust-workers", "--checkpoint-every", "3600", "--nats", &server.url()];
        let search = Running::start(&bench, &arguments);
        let task = wire.wait_for(|message| message.subject.starts_with("nbc.v2.task."));
        drop(wire);
        let token = task.subject.split('.').nth(3).unwrap();
        let connections: Vec<Arc<FakeWorkers>> =
            (0..4).map(|number| FakeWorkers::start(&server, number, workers / 4, token)).collect();
        let answered = || connections.iter().map(|some| some.answered()).sum::<u64>();
        let numbers = || (answered(), cpu_seconds(search.child.id()), cpu_seconds(server.child.id()), Instant::now());
        thread::sleep(Duration::from_secs(3));
        let before = numbers();
        thread::sleep(Duration::from_secs(SECONDS));
        let after = numbers();
        let made = (after.0 - before.0) as f64;
        let each = |seconds: f64| 1e6 * seconds / made;
        let rate = made / (after.3 - before.3).as_secs_f64();
        println!("{workers:7}  {rate:13.0}  {:20.0}  {:20.0}", each(after.1 - before.1), each(after.2 - before.2));
    }
}

/// The CPU time of a process so far, in seconds.
fn cpu_seconds(process: u32) -> f64 {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap();
    let (_, fields) = stat.rsplit_once(") ").unwrap();
    let ticks: f64 = fields.split(' ').skip(11).take(2).map(|field| field.parse::<f64>().unwrap()).sum();
    ticks / 100.0
}

/// What a worker costs that works for one search: five minutes.
fn measure_the_overhead() {
    let text = "evolution cost { from: gates, newcomers: 0, generations: 8, seed: 1..6 }\n";
    let make = || {
        let bench = Bench::new();
        bench.file("cost.nb", text);
        bench
    };
    let evaluations = f64::from(16 * 8 * 6);
    println!("where        seconds  evaluations/s  CPU ms each: worker  search  server  worker idle");
    let alone = make();
    let (started, before) = (Instant::now(), children_seconds());
    assert_eq!(Running::start(&alone, &["evolve", "cost.nb"]).end().status, 0);
    let (seconds, cost) = (started.elapsed().as_secs_f64(), 1e3 * (children_seconds() - before) / evaluations);
    println!("alone        {seconds:7.1}  {:13.1}  {cost:19.2}", evaluations / seconds);
    for count in [1, 2] {
        let Some(server) = Server::start(&[]) else { return };
        let bench = make();
        let workers: Vec<Running> = (0..count).map(|number| worker(&bench, &server, &format!("w{number}"))).collect();
        let mut wire = Wire::open(&server);
        (0..count).for_each(|_| _ = wire.wait_for(|message| message.subject == "nbc.v2.worker"));
        drop(wire);
        let cpu = || workers.iter().map(|worker| cpu_seconds(worker.child.id())).sum::<f64>();
        let wanted = || workers.iter().map(|worker| wanted_seconds(worker.child.id())).sum::<f64>();
        let (started, wanted_before) = (Instant::now(), wanted());
        let before = (cpu(), cpu_seconds(server.child.id()), children_seconds());
        let ran = Running::start(&bench, &["evolve", "cost.nb", "--nats", &server.url()]).end();
        assert_eq!(ran.status, 0, "{}", ran.err);
        let (seconds, each) = (started.elapsed().as_secs_f64(), |seconds: f64| 1e3 * seconds / evaluations);
        let idle = 100.0 * (1.0 - (wanted() - wanted_before) / seconds / f64::from(count));
        let (made, served) = (each(cpu() - before.0), each(cpu_seconds(server.child.id()) - before.1));
        let searched = each(children_seconds() - before.2);
        let rate = evaluations / seconds;
        println!(
            "{count} worker(s)  {seconds:7.1}  {rate:13.1}  {made:19.2}  {searched:6.2}  {served:6.2}  {idle:9.1} %"
        );
    }
}

/// The time for which the busiest thread of a process has run or waited for a core, in seconds: what it would have run
/// on a machine without other work.
fn wanted_seconds(process: u32) -> f64 {
    let tasks = std::fs::read_dir(format!("/proc/{process}/task")).unwrap().map(Result::unwrap);
    let times = |task: std::fs::DirEntry| -> (f64, f64) {
        let text = std::fs::read_to_string(task.path().join("schedstat")).unwrap_or_default();
        let mut numbers = text.split(' ').map_while(|number| number.trim().parse::<f64>().ok());
        (numbers.next().unwrap_or(0.0), numbers.next().unwrap_or(0.0))
    };
    let (ran, waited) = tasks.map(times).max_by(|a, b| a.0.total_cmp(&b.0)).expect("a thread");
    (ran + waited) / 1e9
}

/// The CPU time of all programs that have ended, in seconds.
fn children_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
    let (_, fields) = stat.rsplit_once(") ").unwrap();
    let ticks: f64 = fields.split(' ').skip(13).take(2).map(|field| field.parse::<f64>().unwrap()).sum();
    ticks / 100.0
}
