//! Networks that are cut, disks that are full, and subjects that are taken.

use std::process::{Command, Stdio};

use std::time::{Duration, Instant};

use crate::cluster::server::Server;
use crate::cluster::wire::{Wire, subject_of};
use crate::cluster::{assert_same, bench, evolve, worker};

use crate::support::*;

fn succeeds(line: &str) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    let started = Command::new(words[0]).args(&words[1..]).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    started.is_ok_and(|child| limits::end(child).status.success())
}

/// A small disk; unmounted when it is dropped.
struct SmallDisk<'a>(&'a Path);

impl<'a> SmallDisk<'a> {
    fn mount(folder: &'a Path) -> Option<Self> {
        if succeeds(&format!("mount -t tmpfs -o size=8m tmpfs {}", folder.display())) {
            return Some(Self(folder));
        }
        skip("`mount -t tmpfs` fails", "run it as root");
        None
    }
}

impl Drop for SmallDisk<'_> {
    fn drop(&mut self) {
        succeeds(&format!("umount {}", self.0.display()));
    }
}

#[test]
fn a_server_whose_disk_is_full_is_named_and_the_search_continues_when_there_is_room() {
    let folder = tempfile::tempdir().unwrap();
    let Some(disk) = SmallDisk::mount(folder.path()) else { return };
    let Some(mut server) = Server::start_in(tempfile::tempdir().unwrap(), disk.0.join("store"), &[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    let good = worker(&bench, &server, "good");
    (0..20).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("good")));
    let filler = disk.0.join("filler");
    fs::write(&filler, vec![1; 16 << 20]).unwrap_err();
    search.wait_for("the NATS server does not take tasks (");
    fs::remove_file(&filler).unwrap();
    server.restart();
    assert_same(&bench, &search.end());
    good.kill();
}

/// The server may then number its messages from an earlier number than its notes have, and give out none of them; the
/// search makes the queue again. It does not in every run, so the words of the search are not looked at.
#[test]
fn a_server_that_loses_its_messages_but_not_its_notes_is_given_the_tasks_again() {
    let Some(mut server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    let good = worker(&bench, &server, "good");
    (0..20).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("good")));
    server.restart_without_messages();
    assert_same(&bench, &search.end());
    good.kill();
}

#[test]
fn a_server_that_stops_reading_is_named_and_search_and_worker_go_on_when_it_reads() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    let good = worker(&bench, &server, "good");
    (0..20).for_each(|_| _ = wire.wait_for(|message| message.is_answer_of("good")));
    signal("STOP", server.child.id());
    let stopped = Instant::now();
    let silent = format!("the NATS server `{}` does not answer; trying again\n", server.url());
    search.wait_for(&silent);
    good.wait_for(&silent);
    assert!(stopped.elapsed() < Duration::from_secs(30), "{:?}", stopped.elapsed());
    signal("CONT", server.child.id());
    good.wait_for(&format!("the NATS server `{}` answers again\n", server.url()));
    assert_same(&bench, &search.end());
    good.kill();
}

/// As after some kills of the server: tasks wait and a worker asks, but the queue gives out none.
#[test]
fn a_queue_that_gives_out_no_task_is_made_again() {
    let Some(server) = Server::start(&[]) else { return };
    let bench = bench();
    let mut wire = Wire::open(&server);
    let search = evolve(&bench, &server, &[]);
    let task = wire.wait_for(|message| message.subject.starts_with(&subject_of("task.")));
    let token = task.subject.split('.').nth(3).unwrap();
    let (name, filter) = (format!("workers-{token}"), subject_of(&format!("task.{token}.>")));
    // A queue of the same name that gives out one task, which nobody does.
    let config = format!(
        r#"{{"stream_name":"nbc-tasks","config":{{"durable_name":"{name}","ack_policy":"explicit",
        "ack_wait":3600000000000,"filter_subject":"{filter}","max_ack_pending":1,"max_waiting":1000}}}}"#
    );
    wire.request(&format!("$JS.API.CONSUMER.DELETE.nbc-tasks.{name}"), "");
    wire.request(&format!("$JS.API.CONSUMER.DURABLE.CREATE.nbc-tasks.{name}"), &config);
    wire.publish(&format!("$JS.API.CONSUMER.MSG.NEXT.nbc-tasks.{name} {}", subject_of("reply.wire")), b"1");
    wire.wait_for(|message| message.reply.starts_with("$JS.ACK.nbc-tasks."));
    let good = worker(&bench, &server, "good");
    search.wait_for("tasks, though workers ask; it is made again\n");
    let ran = search.end();
    assert_same(&bench, &ran);
    assert!(ran.err.contains("the queue of the NATS server gives out none of "), "{}", ran.err);
    good.kill();
}

#[test]
fn a_queue_is_opened_as_soon_as_its_subjects_are_free() {
    let Some(server) = Server::start(&[]) else { return };
    let (bench, mut wire) = (bench(), Wire::open(&server));
    // What a program is told while another one makes the queue.
    let other = json!({ "name": "other", "subjects": [subject_of("task.>")] });
    wire.request("$JS.API.STREAM.CREATE.other", &other.to_string());
    wire.subscribe("$JS.API.STREAM.CREATE.>");
    let worker = worker(&bench, &server, "early");
    (0..2).for_each(|_| _ = wire.wait_for(|message| message.subject.ends_with(".nbc-tasks")));
    wire.request("$JS.API.STREAM.DELETE.other", "");
    worker.wait_for("worker `early`: 1 thread");
}
