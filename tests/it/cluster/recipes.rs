//! The recipes of docs/cluster.md, with stand-ins for what starts programs elsewhere.

use std::os::unix::fs::PermissionsExt;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use serde_yaml::Value;

use crate::cluster::server::Server;
use crate::cluster::wire::{Wire, subject_of};
use crate::cluster::{Running, assert_same, bench};

use crate::support::*;

const PROGRAM: &str = env!("CARGO_BIN_EXE_nbc");

/// The indented lines of a section, without their indent.
fn recipe(section: &str) -> String {
    let page = text_of("docs/cluster.md");
    let mut lines = page.lines().skip_while(|line| *line != format!("## {section}")).skip(1);
    let inside: Vec<&str> = lines.by_ref().take_while(|line| !line.starts_with("## ")).collect();
    let code: Vec<&str> = inside.into_iter().filter_map(|line| line.strip_prefix("    ")).collect();
    assert!(!code.is_empty(), "{section} has a recipe");
    code.join("\n") + "\n"
}

/// A folder with the declarations and the programs that recipes call. Workers that recipes start are killed at the end.
struct Site {
    bench: Bench,
    programs: PathBuf,
}

impl Site {
    fn new() -> Self {
        let bench = bench();
        let programs = bench.path().join("programs");
        fs::create_dir(&programs).unwrap();
        let site = Self { bench, programs };
        let log = site.bench.path().join("started");
        site.program("nbc", &format!("echo $$ >> {}\nexec {PROGRAM} \"$@\"", log.display()));
        site
    }

    fn program(&self, name: &str, script: &str) {
        let path = self.programs.join(name);
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    fn shell(&self, script: &str, variables: &[(&str, &str)]) -> Running {
        let path = format!("{}:{}", self.programs.display(), std::env::var("PATH").unwrap());
        let mut command = Command::new("sh");
        command.args(["-ec", script]).env("PATH", path).env("RAYON_NUM_THREADS", "1").envs(variables.iter().copied());
        Running::spawn(command.current_dir(self.bench.path()))
    }
}

impl Drop for Site {
    fn drop(&mut self) {
        for process in fs::read_to_string(self.bench.path().join("started")).unwrap_or_default().lines() {
            // Its number may belong to another process by now.
            if fs::read_link(format!("/proc/{process}/exe")).is_ok_and(|path| path == Path::new(PROGRAM)) {
                let _ = Command::new("sh").args(["-c", &format!("kill -9 {process}")]).status();
            }
        }
    }
}

fn lines(script: &str, start: &str) -> String {
    script.lines().filter(|line| line.starts_with(start)).collect::<Vec<_>>().join("\n")
}

fn here(script: &str, server: &Server) -> String {
    script.replace("4222", &server.port().to_string()).replace("library/paper.nb", "small.nb")
}

#[test]
fn one_machine() {
    let Some(server) = Server::start(&[]) else { return };
    let (site, script) = (Site::new(), here(&recipe("One machine"), &server));
    assert_eq!(lines(&script, "nats-server "), "nats-server --jetstream --store_dir /var/tmp/nats");
    let _worker = site.shell(&lines(&script, "nbc worker "), &[]);
    assert_same(&site.bench, &site.shell(&lines(&script, "nbc evolve "), &[]).end());
}

#[test]
fn three_machines_by_ssh() {
    let Some(server) = Server::start(&["--user", "nbc", "--pass", "secret"]) else { return };
    let (site, script) = (Site::new(), here(&recipe("Three machines by ssh"), &server));
    site.program("ssh", "mkdir $1\ncd $1\nexec sh -c \"$2\"");
    site.program("hostname", "echo 127.0.0.1");
    let (_, rest) = script.split_once("--pass \"$NBC_PASSWORD\"\n").expect("the server with a password");
    assert_same(&site.bench, &site.shell(rest, &[("NBC_PASSWORD", "secret")]).end());
    // A worker may start after the others have done the work.
    let started = Instant::now();
    for host in ["one", "two", "three"] {
        let log = site.bench.path().join(host).join("worker.log");
        while !fs::read_to_string(&log).unwrap().contains("physics") {
            assert!(started.elapsed() < PATIENCE, "the worker of {host} has not started");
            thread::sleep(Duration::from_millis(50));
        }
    }
}

#[test]
fn a_slurm_array() {
    let Some(server) = Server::start(&[]) else { return };
    let (site, script) = (Site::new(), recipe("A Slurm array"));
    let (script, submitted) = script.split_once("sbatch ").expect("the script, and how to submit it");
    assert!(submitted.contains("NBC_NATS="), "{submitted}");
    let mut wire = Wire::open(&server);
    let variables = [("NBC_NATS", &*server.url()), ("SLURM_CPUS_PER_TASK", "1")];
    let jobs = [site.shell(script, &variables), site.shell(script, &variables)];
    let search = Running::start(&site.bench, &["evolve", "small.nb", "--nats", &server.url()]);
    wire.wait_for(|message| message.subject.starts_with(&subject_of("answer.")));
    // Slurm ends the first job early.
    let [first, second] = jobs;
    first.signal("TERM");
    assert_eq!(first.end().status, 0);
    assert_same(&site.bench, &search.end());
    drop(second);
}

fn words(list: &Value) -> Vec<String> {
    let word = |word: &Value| word.as_str().expect("a word").to_owned();
    list.as_sequence().expect("a list").iter().map(word).collect()
}

#[test]
fn kubernetes() {
    let script = recipe("Kubernetes");
    let parts: Vec<Value> = script.split("---\n").map(|part| serde_yaml::from_str(part).unwrap()).collect();
    let kinds: Vec<&str> = parts.iter().map(|part| part["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["StatefulSet", "Service", "Deployment"]);
    let container = |part: &Value| part["spec"]["template"]["spec"]["containers"][0].clone();
    let options = words(&container(&parts[0])["args"]);
    assert_eq!(options, ["--jetstream", "--store_dir", "/data"], "as in the recipe for one machine");
    assert_eq!(container(&parts[0])["volumeMounts"][0]["mountPath"], "/data");
    let Some(server) = Server::start(&[]) else { return };
    let command = words(&container(&parts[2])["command"]);
    let address = format!("nats://{}:4222", parts[1]["metadata"]["name"].as_str().unwrap());
    assert!(command.contains(&address), "{command:?}");
    let here: Vec<String> = command.iter().skip(1).map(|word| word.replace(&address, &server.url())).collect();
    let bench = bench();
    let _worker = Running::start(&bench, &here.iter().map(String::as_str).collect::<Vec<_>>());
    assert_same(&bench, &Running::start(&bench, &["evolve", "small.nb", "--nats", &server.url()]).end());
}
