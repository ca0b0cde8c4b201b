//! Passwords, credentials and TLS.

use std::process::Command;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use serde_json::{Map, Value, json};

use crate::cluster::keys::{Key, Owner};
use crate::cluster::server::Server;
use crate::cluster::wire::subject_of;
use crate::cluster::{Running, assert_same, bench};

use crate::support::*;

#[test]
fn servers_that_cannot_be_used_are_named_without_the_password() {
    let Some(server) = Server::start(&["--user", "me", "--pass", "right"]) else { return };
    let bench = bench();
    let wrong = server.url().replace("nats://", "nats://me:secret@");
    for arguments in [&["worker", "--nats"][..], &["workers", "--nats"], &["evolve", "small.nb", "--nats"]] {
        let ran = bench.run(&[arguments, &[&wrong]].concat());
        ran.expect_fault(&["cannot use the NATS server `nats://127.0.0.1:"]);
        assert!(!ran.err.contains("secret"), "{}", ran.err);
    }
    let right = server.url().replace("nats://", "nats://me:right@");
    let workers = bench.run(&["workers", "--nats", &right, "--format", "json"]);
    assert_eq!(validate("workers", &workers.out)["workers"].as_array().unwrap().len(), 0);
    let missing = bench.run(&["worker", "--nats", &right, "--creds", "none.creds"]);
    missing.expect_fault(&["cannot use the credentials in `none.creds`"]);
    bench.run(&["worker", "--nats", &right, "--name", "a.b"]).expect_fault(&["`a.b` cannot be the name of a worker"]);
}

fn token(issuer: &Key, subject: &str, name: &str, nats: Value) -> String {
    let encode = |value: &Value| URL_SAFE_NO_PAD.encode(value.to_string());
    let head = json!({ "typ": "JWT", "alg": "ed25519-nkey" });
    let issued = issuer.public();
    let claims = json!({ "jti": name, "iat": 1, "iss": issued, "sub": subject, "name": name, "nats": nats });
    let signed = format!("{}.{}", encode(&head), encode(&claims));
    let signature = URL_SAFE_NO_PAD.encode(issuer.sign(&signed));
    format!("{signed}.{signature}")
}

fn unlimited(names: &[&str]) -> Value {
    let everywhere = ["subs", "data", "payload", "imports", "exports", "conn", "leaf"];
    let mut limits: Map<String, Value> =
        everywhere.iter().chain(names).map(|name| ((*name).to_owned(), json!(-1))).collect();
    limits.insert("wildcards".to_owned(), json!(true));
    json!({ "type": "account", "version": 2, "limits": limits })
}

/// Writes `server.conf` for a server of one account, and `worker.creds` for a user with the rights of docs/cluster.md.
fn issue_credentials(folder: &Path) {
    let [operator, system, account, user] =
        [(Owner::Operator, "operator"), (Owner::Account, "system"), (Owner::Account, "account"), (Owner::User, "user")]
            .map(|(owner, name)| Key::new(folder, owner, name));
    let rights = json!({ "type": "operator", "version": 2, "system_account": system.public() });
    let issued = token(&operator, &operator.public(), "operator", rights);
    let watching = token(&operator, &system.public(), "system", unlimited(&[]));
    let jetstream = unlimited(&["mem_storage", "disk_storage", "streams", "consumer"]);
    let granted = token(&operator, &account.public(), "account", jetstream);
    let ours = subject_of(">");
    let rights = json!({
        "type": "user", "version": 2, "subs": -1, "data": -1, "payload": -1,
        "pub": { "allow": [&ours, "_INBOX.>", "$JS.API.>", "$JS.ACK.>"] },
        "sub": { "allow": [&ours, "_INBOX.>"] },
    });
    let user_token = token(&account, &user.public(), "user", rights);
    let accounts = format!("{}: {granted}\n{}: {watching}", account.public(), system.public());
    let config = format!("operator: {issued}\nresolver: MEMORY\nresolver_preload: {{ {accounts} }}\n");
    fs::write(folder.join("server.conf"), config).unwrap();
    let creds = format!(
        "-----BEGIN NATS USER JWT-----\n{user_token}\n------END NATS USER JWT------\n\n\
         -----BEGIN USER NKEY SEED-----\n{}\n------END USER NKEY SEED------\n",
        user.seed()
    );
    fs::write(folder.join("worker.creds"), creds).unwrap();
}

#[test]
fn credentials_with_few_rights_suffice_and_are_needed() {
    let bench = bench();
    let Some(_) = OPENSSL.find() else { return };
    issue_credentials(bench.path());
    let config = bench.path().join("server.conf").display().to_string();
    let Some(server) = Server::start(&["--config", &config]) else { return };
    let url = server.url();
    let access = ["--nats", &url, "--creds", "worker.creds"];
    bench.run(&["evolve", "small.nb", "--nats", &url]).expect_fault(&["cannot use the NATS server"]);
    let _worker = Running::start(&bench, &[&["worker", "--threads", "1"], &access[..]].concat());
    assert_same(&bench, &Running::start(&bench, &[&["evolve", "small.nb"], &access[..]].concat()).end());
}

fn issue_certificates(folder: &Path) {
    let page = text_of("docs/cluster.md");
    let indented = page.lines().filter_map(|line| line.strip_prefix("    "));
    let commands: Vec<&str> =
        indented.filter(|line| line.starts_with("openssl ") || line.starts_with("echo ")).collect();
    assert_eq!(commands.len(), 4, "{commands:?}");
    let script = commands.join("\n").replace("nats.example.org", "localhost");
    let made = Command::new("sh").args(["-ec", &script]).current_dir(folder).output_in_time();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
}

#[test]
fn a_server_with_tls_is_used_only_if_its_certificate_is_trusted() {
    let bench = bench();
    let Some(_) = OPENSSL.find() else { return };
    issue_certificates(bench.path());
    let path = |name: &str| bench.path().join(name).display().to_string();
    let options = ["--tls", "--tlscert", &path("server.pem"), "--tlskey", &path("server-key.pem")];
    let Some(server) = Server::start(&options) else { return };
    let url = server.url().replace("nats://127.0.0.1", "tls://localhost");
    bench.run(&["evolve", "small.nb", "--nats", &url]).expect_fault(&["cannot use the NATS server `tls://localhost:"]);
    let access = ["--nats", &url, "--tls-ca", "ca.pem"];
    let _worker = Running::start(&bench, &[&["worker", "--threads", "1"], &access[..]].concat());
    assert_same(&bench, &Running::start(&bench, &[&["evolve", "small.nb"], &access[..]].concat()).end());
}
