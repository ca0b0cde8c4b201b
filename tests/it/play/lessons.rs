//! The lessons that a page gets: those of the program, or those of an author.

use super::page::{Server, served};
use crate::support::*;

const LESSON: &str = "# Mine\n\n## Step\n\nStart it.\n\n- check: evolving\n- do: evolve\n";

#[test]
fn the_lessons_of_the_program_are_there_without_their_solutions() {
    let (_folder, server, _) = served(&[]);
    let answer = server.page().done(json!({ "do": "lessons" }));
    assert!(answer["findings"].as_array().unwrap().is_empty());
    let lessons = answer["lessons"].as_array().unwrap();
    let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("lessons")).unwrap();
    assert_eq!(lessons.len(), files.count());
    assert_eq!(lessons[0]["steps"][0]["checks"], json!([{ "is": "keeps", "values": { "a": 1, "q": 0 } }]));
    let xor = lessons.iter().find(|lesson| lesson["name"] == "xor").unwrap();
    assert_eq!(xor["best"], json!({ "number": 4, "of": "gates" }));
    assert!(!xor["program"].as_str().unwrap().contains("t = a nand b"));
}

#[test]
fn an_author_s_lessons_are_read_again_for_each_page_and_mistakes_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let course = folder.path().join("course");
    fs::create_dir(&course).unwrap();
    fs::write(course.join("1-mine.md"), LESSON).unwrap();
    let server = Server::start(folder.path(), &["--lessons", "course", "--lessons", "shipped"]);
    let mut page = server.page();
    let first = page.done(json!({ "do": "lessons" }));
    assert_eq!((&first["lessons"][0]["name"], &first["lessons"][1]["name"]), (&json!("mine"), &json!("gate")));
    fs::write(course.join("2-wrong.md"), LESSON.replace("evolving", "evolvign")).unwrap();
    let second = page.done(json!({ "do": "lessons" }));
    assert_eq!(first["lessons"], second["lessons"]);
    let finding = &second["findings"][0];
    assert_eq!((&finding["code"], &finding["labels"][0]["start"]["line"]), (&json!("unknown"), &json!(7)));
    assert_eq!(finding["help"], "did you mean `evolving`?");
}
