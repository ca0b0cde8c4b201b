//! Lessons that are read, and mistakes that are found.

use std::io;
use std::sync::Arc;

use super::*;
use nbc_base::source::MemoryWorld;
use nbc_circuit::Effort;
use nbc_session::CompileOptions;

fn nothing() -> SharedWorld {
    Arc::new(MemoryWorld::default())
}

fn lesson(text: &str) -> ReadLessons {
    let mut read = ReadLessons::default();
    read.add("01-first.md", text, Some(&nothing()));
    read
}

const GATE: &str = "\
# A gate

- best: 1 robot
- hint: One
  hint.

Some `code`
in a paragraph.

```nb
circuit invert(a) -> (q) {
    q = not a
}
```

## Step

Do it.

- check: keeps a=1 q=0
- check: robots <= 0x1f
- do: set a=1
";

#[test]
fn a_lesson_has_a_text_a_program_and_steps() {
    let ReadLessons { lessons, found } = lesson(GATE);
    assert_eq!(found.to_string(), "");
    let [lesson] = &lessons[..] else { panic!("one lesson") };
    assert_eq!((lesson.name.as_str(), lesson.title.as_str()), ("first", "A gate"));
    assert_eq!(lesson.text, ["Some `code` in a paragraph."]);
    assert_eq!(lesson.best.map(|best| best.number), Some(1));
    assert_eq!(lesson.hints, ["One hint."]);
    assert!(lesson.program.as_deref().unwrap().starts_with("circuit invert"));
    let [step] = &lesson.steps[..] else { panic!("one step") };
    assert_eq!((step.task.as_str(), step.checks.len()), ("Do it.", 2));
}

fn fails(line: &str, other: &str, expected: &str) {
    assert!(GATE.contains(line), "{line}");
    let ReadLessons { lessons, found } = lesson(&GATE.replace(line, other));
    let found = found.to_string();
    assert!(lessons.is_empty() && found.contains(expected), "expected {expected:?}, found:\n{found}");
}

#[test]
fn mistakes_have_a_line_and_the_nearest_name() {
    let check = |other: &str, expected: &str| fails("- check: keeps a=1 q=0", &format!("- check: {other}"), expected);
    check("keps a=1", "01-first.md:20:10: error[unknown]: unknown word `keps`\n  help: did you mean `keeps`?");
    check("keeps b=1", "no circuit of the program has a port `b`\n  help: expected `a` or `q`");
    check("keeps a", "expected a port and its value, found `a`");
    check("keeps a=x", "expected a number, found `x`");
    check("keeps a=1 a=0", "a second value of `a`");
    check("keeps", "`keeps` needs more words");
    check("designs nadn", "unknown gate `nadn`\n  help: did you mean `nand`?");
    check("designs except", "`designs` needs more words");
    check("robots < 5", "unknown word `<`");
    check("robots <= 5 6", "unexpected `6`");
    check("tests passed", "unknown word `passed`\n  help: did you mean `pass`?");
    check("outputs lit now", "unexpected `now`");
    check("has-shown a=1, b=1", "has a port `b`");
    check("without nott", "help: did you mean `not`?");
    fails("- check: keeps a=1 q=0", "- chekc: keeps", "unknown field `chekc`\n  help: did you mean `check`?");
    fails("- check: keeps a=1 q=0", "- check", "`check` is not a field");
    fails("- do: set a=1", "- do: sett a=1", "help: did you mean `set`?");
    fails("- do: set a=1", "- do: type", "`do: type` and a program belong together");
    fails("- do: set a=1", "- do: set a=1\n- hint: 1\n- hint: 2\n- hint: 3\n- hint: 4", "more than 3 hints here");
    fails("- best: 1 robot", "- best: few", "expected a number of robots or gates, found `few`");
    fails("- best: 1 robot", "- tab: swram", "help: did you mean `swarm`?");
    fails("- best: 1 robot", "- best: 1 robot\n- best: 2 robots", "a second `best`");
    fails("## Step\n", "## Stpe\n", "unknown heading `## Stpe`");
    fails("Do it.\n", "", "the step has no task");
    fails("# A gate\n", "", "missing title");
    fails("not a\n", "not b\n", "01-first.md:12:13: error[unknown]");
    fails("```nb", "```", "a program is in a block of `nb`");
    fails("```\n", "", "the program does not end");
    assert!(lesson("# Empty\n").found.to_string().contains("the lesson has no steps"));
    assert!(lesson("").found.to_string().contains("missing title"));
}

#[test]
fn the_lessons_of_the_program_are_right() {
    let files = shipped().map(|(file, text)| (file, Ok(text))).collect();
    let own = LessonTexts::Folder(LessonFiles { folder: "lessons".to_owned(), files: Ok(files) });
    let read = load(vec![own], Some(&nothing()));
    assert_eq!(read.found.to_string(), "");
    assert_eq!(read.lessons, load(vec![LessonTexts::Shipped], Some(&nothing())).lessons);
    assert!(read.lessons.len() >= 20);
    for lesson in &read.lessons {
        for (step, number) in lesson.steps.iter().zip(1..) {
            let hints = if step.hints.is_empty() { &lesson.hints } else { &step.hints };
            assert_eq!(hints.len(), reading::HINTS, "hints of step {number} of {}", lesson.name);
        }
    }
}

#[test]
fn two_lessons_have_two_names_and_a_folder_has_lessons() {
    let found = |texts: &[&str]| {
        let file = |(at, text): (usize, &&str)| (format!("{at}-gate.md"), Ok((*text).to_owned()));
        let files = Ok(texts.iter().enumerate().map(file).collect());
        let folder = LessonTexts::Folder(LessonFiles { folder: "own".to_owned(), files });
        load(vec![folder], Some(&nothing())).found.to_string()
    };
    assert!(found(&[]).contains("no lessons in `own`"));
    assert_eq!(found(&[GATE]), "");
    assert!(found(&[GATE, GATE]).contains("two lessons are called `gate`"));
    assert!(found(&[&"x".repeat(LessonFiles::MOST_BYTES + 1)]).contains("has more than 65536 bytes"));
    let missing = LessonFiles { folder: "nowhere".to_owned(), files: Err(io::ErrorKind::NotFound.into()) };
    let found = load(vec![LessonTexts::Folder(missing)], None).found.to_string();
    assert!(found.contains("cannot read `nowhere`"), "{found}");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(200))]
    #[test]
    fn any_text_is_read_without_a_panic(
        lines in proptest::collection::vec(
            proptest::sample::select(vec![
                "# T", "## Step", "# ", "#", "- check: keeps a=1", "- check: has-shown a=1,,b", "- check: ", "- : x",
                "-", "- do: type", "```nb", "```", "é ", "  more", "", "- best: 9 gates",
                "circuit x(a) -> (q) { q = a }",
                "- check: robots", "- check: robots only", "- hint: é", "\r",
            ]),
            0..20,
        ),
        end in "\\PC{0,20}",
    ) {
        lesson(&format!("{}\n{end}", lines.join("\n")));
    }
}

fn robots(program: &str) -> usize {
    let mut session = Session::new(nothing());
    session.update("program.nb", 1, program);
    let checked = session.checked("program.nb");
    let circuit = checked.program.tests[0].circuit.clone();
    let swarm = checked.swarms(&circuit).first().map(|swarm| swarm.name.clone());
    let options = CompileOptions { swarm, effort: Effort::Normal, ..Default::default() };
    checked.compile(&circuit, &options).unwrap().assembly.members.len()
}

#[test]
fn solutions_are_as_small_as_the_best_known_circuit() {
    let mut measured = Vec::new();
    for (file, text) in shipped() {
        let read = reading::read(&file, &text);
        if let Some(best) = read.entry.best {
            let solution = robots(read.typed.last().unwrap().text);
            assert_eq!(solution, best.number as usize, "robots of the solution of {file}");
            measured.push((file, best.number, robots(read.program.unwrap().text)));
        }
    }
    let measured: Vec<_> = measured.iter().map(|(file, best, first)| format!("{file}: {best} of {first}")).collect();
    insta::assert_snapshot!(measured.join("\n"), @r"
    04-not.md: 1 of 0
    05-and.md: 2 of 1
    06-xor.md: 4 of 4
    09-full-adder.md: 5 of 2
    20-senses.md: 3 of 10
    21-waves.md: 2 of 18
    ");
}
