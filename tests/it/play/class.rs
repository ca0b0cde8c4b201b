//! A class: learners join it, and the teacher's page shows where they are.

use super::page::{Server, served};
use crate::support::*;

fn members(server: &Server) -> Vec<Value> {
    let path = format!("/{}/members", server.teacher.as_deref().unwrap());
    let (head, body) = server.get(&path, &format!("Host: {}\r\n", server.host()));
    assert!(head.starts_with("HTTP/1.1 200") && head.contains("application/json"), "{head}");
    serde_json::from_slice::<Value>(&body).unwrap()["members"].as_array().unwrap().clone()
}

#[test]
fn a_learner_is_in_the_class_until_the_page_leaves() {
    let (_folder, server, mut page) = served(&["--class"]);
    assert_eq!(page.done(json!({ "do": "hello" }))["class"], true);
    let place = json!({ "lesson": "gate", "done": 1, "size": null });
    let progress = json!({ "do": "progress", "place": place, "finished": 2 });
    assert!(page.ask(progress.clone()).unwrap_err()["message"].as_str().unwrap().contains("in no class"));
    page.done(json!({ "do": "join", "name": "<b>Ada</b>" }));
    page.done(progress);
    let found = members(&server);
    assert_eq!((found.len(), &found[0]["name"], &found[0]["place"]), (1, &json!("<b>Ada</b>"), &place));
    assert_eq!(found[0]["finished"], 2);
    let mut twin = server.page();
    let refused = twin.ask(json!({ "do": "join", "name": "<B>ada</b>" })).unwrap_err();
    assert_eq!(refused["help"], "choose another name");
    let refused = twin.ask(json!({ "do": "join", "name": "a\nb" })).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("24 letters"));
    page.done(json!({ "do": "join", "name": "Ada" }));
    assert_eq!(members(&server)[0]["name"], "Ada");
    page.done(json!({ "do": "leave" }));
    assert!(members(&server).is_empty());
    let key = twin.done(json!({ "do": "join", "name": "Ben" }))["key"].clone();
    drop(twin);
    let start = std::time::Instant::now();
    while !members(&server).is_empty() {
        assert!(start.elapsed().as_secs() < 30, "a page that is closed is still in the class");
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    let refused = page.ask(json!({ "do": "join", "name": "ben" })).unwrap_err();
    assert_eq!(refused["message"], "somebody else is called ben", "Ben is away, and his files are his");
    assert_eq!(page.done(json!({ "do": "join", "name": "ben", "key": key }))["key"], key);
}

#[test]
fn learners_save_files_of_their_own_in_the_shared_folder() {
    let folder = Bench::with("latch.nb", "// of all\n");
    let server = Server::start(folder.path(), &["--class"]);
    let mut page = server.page();
    let stamp = page.done(json!({ "do": "read", "path": "latch.nb" }))["stamp"].clone();
    let save = |path: &str, stamp: &Value| json!({ "do": "save", "path": path, "text": "// mine\n", "stamp": stamp });
    let refused = page.ask(save("latch.nb", &stamp)).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("join it with a name"), "{refused}");
    page.done(json!({ "do": "join", "name": "Ada L." }));
    for path in ["latch.nb", "latch.Ben.nb", "new.nb"] {
        let refused = page.ask(save(path, &stamp)).unwrap_err();
        let own = path.replace(".nb", ".Ada_L_.nb");
        assert_eq!((&refused["code"], &refused["instead"]), (&json!("not-own"), &json!(own)));
    }
    let saved = page.done(save("latch.Ada_L_.nb", &Value::Null));
    page.done(save("latch.Ada_L_.nb", &saved["stamp"]));
    let names = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(names.count(), 2);
    assert_eq!(folder.read("latch.nb"), "// of all\n");
}

#[test]
fn the_teacher_s_address_leads_to_the_class_only_and_to_nobody_else() {
    let (_folder, server, _) = served(&["--class"]);
    let teacher = server.teacher.clone().unwrap();
    assert!(teacher.len() == 32 && teacher != server.token());
    let own = format!("Host: {}\r\n", server.host());
    let status = |path: &str, headers: &str| server.get(path, headers).0.split(' ').nth(1).unwrap().to_owned();
    for path in ["", "members", "lessons"] {
        assert_eq!(status(&format!("/{teacher}/{path}"), &own), "200", "{path}");
        assert_eq!(status(&format!("/{teacher}/{path}"), "Host: evil.example\r\n"), "403", "{path}");
        let foreign = format!("{own}Origin: http://evil.example\r\n");
        assert_eq!(status(&format!("/{teacher}/{path}"), &foreign), "403", "{path}");
    }
    for path in ["live", "language", "take/1/a.vcd", "nothing"] {
        assert_eq!(status(&format!("/{teacher}/{path}"), &own), "404", "{path}");
    }
    assert_eq!(status(&format!("/{}/members", server.token()), &own), "404");
    assert_eq!(status(&format!("/{}/members", "0".repeat(32)), &own), "404");
    let (_, body) = server.get(&format!("/{teacher}/lessons"), &own);
    let lessons = serde_json::from_slice::<Value>(&body).unwrap()["lessons"].clone();
    assert_eq!(lessons[0]["name"], "gate");
}

#[test]
fn there_is_no_class_unless_it_was_asked_for() {
    let (_folder, server, mut page) = served(&["--pages", "1"]);
    assert_eq!(page.done(json!({ "do": "hello" }))["class"], false);
    let refused = page.ask(json!({ "do": "join", "name": "Ada" })).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("no class"));
    // There is room for one page, which has two sockets.
    let origin = format!("http://{}", server.host());
    let _language = server.socket("language", &origin).unwrap();
    assert_eq!(server.socket("live", &origin).err(), Some(503));
    assert!(server.fetch("").0.starts_with("HTTP/1.1 503"));
}
