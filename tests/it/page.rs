//! The HTML report: what is in it, and that it works in a real browser where there is one.

use std::path::{Path, PathBuf};
use std::process::Command;

use nbc::model::{Body, Character, Function, Provenance, Robot, Setting};
use nbc::report::{self, PageTest, Recording, Scheme, Stage};
use nbc::swarm::{Assembly, Demand, Member, SwarmTrace, TestVerdict, judge};
use serde_json::Value;

use crate::pictures::{latch, latch_netlist};

pub fn robot(name: &str, function: Function) -> Robot {
    let rows = ["66666", "46666", "44444", "44404", "44005"];
    Robot {
        name: name.to_owned(),
        behavior: function.into(),
        body: Body::parse(&rows, 8).unwrap(),
        displacement: [1.0; 4],
        character: Character {
            clock: 4,
            switches: 1000,
            error_rate: 0.0,
            glitch_rate: 0.0,
            margin: 0.1,
            topples: false,
            settle: Vec::new(),
        },
        provenance: Provenance {
            program: "nbc".to_owned(),
            version: "0.1.0".to_owned(),
            evolution: "gates".to_owned(),
            seed: 1,
            generation: 1,
            evaluations: 1,
        },
        genotype: None,
    }
}

fn verdict(trace: &SwarmTrace) -> TestVerdict {
    let rows = [false, true, true].map(|q| Demand { hold: 8, needed: 8, expected: vec![Some(q), None] });
    judge("holds </script><b> its bit", trace, &rows, &[4; 5])
}

fn assembly(trace: &SwarmTrace) -> Assembly {
    let member = |k: usize| Member {
        net: trace.robots[k].net.clone(),
        robot: robot(&trace.robots[k].robot, trace.robots[k].function),
        senses: trace.robots[k].senses,
        start: false,
    };
    Assembly {
        circuit: trace.circuit.clone(),
        inputs: trace.inputs.clone(),
        members: (0..5).map(member).collect(),
        outputs: trace.outputs.iter().cloned().zip(trace.shown.iter().copied()).collect(),
    }
}

fn page() -> String {
    let trace = latch(&[(false, true), (true, true), (true, false)], 8);
    let (assembly, verdict) = (assembly(&trace), verdict(&trace));
    let robots: Vec<&Robot> = assembly.members.iter().map(|member| &member.robot).collect();
    let stage = || Stage::of_swarm(&Setting::paper(), &assembly, &trace, 7);
    let test = || PageTest {
        verdict: &verdict,
        trace: &trace,
        assembly: &assembly,
        recording: Recording::of(stage(), 5),
        schematic: report::draw_schematic(&latch_netlist(), &robots, &[], Scheme::Paper),
        spacetime: report::draw_swarm(&trace),
    };
    report::draw_page("circuits/<latch>.nb", &[test(), test()], Scheme::Paper)
}

/// The data that the page's script reads.
fn data(page: &str) -> Value {
    let start = page.find("type=\"application/json\">").unwrap() + "type=\"application/json\">".len();
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

#[test]
fn the_page_holds_everything_and_fetches_nothing() {
    let page = page();
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    for outside in ["src=\"", "href=\"http", "url(", "@import", "fetch("] {
        assert!(!page.contains(outside), "the page says {outside:?}");
    }
    assert!(page.contains("pass: 2 of 2 tests passed"), "the verdict comes first");
    assert!(page.contains("circuits/&lt;latch&gt;.nb"));
    assert!(!page.contains("</script><b>"), "a title cannot break out");
    let data = data(&page);
    let test = &data["tests"][0];
    assert_eq!(test["robots"].as_array().unwrap().len(), 5);
    assert_eq!(test["cycles"].as_array().unwrap().len(), 24);
    assert_eq!(test["marks"], serde_json::json!([8, 16]));
    let frames = test["robots"][0]["frames"].as_str().unwrap().len() / 4 * 3 / 2;
    let points = test["robots"][0]["points"].as_u64().unwrap() as usize;
    assert_eq!(frames / (points * 2), 24 * 12 + 1);
}

#[test]
fn a_recording_has_room_for_what_fits() {
    assert_eq!(Recording::room(&[36; 5], 60), (7, 5));
    let (stride, robots) = Recording::room(&[36; 100], 300);
    assert!(stride > 7 && robots <= 100);
    assert_eq!(Recording::room(&[100_000_000], 1000).1, 0);
}

fn chromium() -> Option<PathBuf> {
    ["/usr/bin/chromium", "/usr/bin/chromium-browser"].into_iter().map(PathBuf::from).find(|path| path.exists())
}

/// Runs Chromium on a file without a window; gives what it printed.
fn browse(browser: &Path, folder: &Path, arguments: &[&str], file: &Path) -> String {
    let profile = format!("--user-data-dir={}", folder.join("profile").display());
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", &profile])
        .args(arguments)
        .arg(format!("file://{}", file.display()))
        .output()
        .unwrap();
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What a reader does, as a script put before and after the page's own.
const WATCH: &str = "<script>window.faults = []; addEventListener('error', e => faults.push(e.message));\
    addEventListener('securitypolicyviolation', e => faults.push('blocked ' + e.blockedURI)); console.error = m => faults.push(String(m));</script>";
const READER: &str = r#"<script>
const player = players[0], section = document.getElementById("test-0"), shot = () => section.querySelector(".stage").toDataURL();
const before = shot(); section.querySelector(".play").click();
const started = performance.now();
const wait = setInterval(() => {
  const moved = shot() !== before && player.time > 0; if (!moved && performance.now() - started < 20000) return; clearInterval(wait); section.querySelector(".play").click();
  const cell = section.querySelector('[data-id="cell-1"]'); cell.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter" }));
  const followed = player.chosen, panel = section.querySelector(".robot").textContent, focusable = cell.tabIndex;
  const slider = section.querySelector(".scrub"); slider.value = 6; slider.dispatchEvent(new Event("input"));
  const clock = section.querySelector(".clock").textContent, wide = document.documentElement.scrollWidth <= innerWidth;
  document.body.innerHTML = ""; const found = document.createElement("pre"); found.id = "found";
  found.textContent = JSON.stringify({ moved, followed, panel, focusable, clock, wide, faults }); document.body.append(found);
}, 100);
</script>"#;

#[test]
fn the_page_works_in_a_browser() {
    let Some(browser) = chromium() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = page();
    let watched =
        page.replace("<head>\n", &format!("<head>\n{WATCH}\n")).replace("</body>", &format!("{READER}\n</body>"));
    let file = folder.path().join("watched.html");
    std::fs::write(&file, watched).unwrap();
    for size in ["--window-size=1200,900", "--window-size=500,800"] {
        let dom = browse(
            &browser,
            folder.path(),
            &[size, "--virtual-time-budget=30000", "--run-all-compositor-stages-before-draw", "--dump-dom"],
            &file,
        );
        let start = dom
            .find("<pre id=\"found\">")
            .unwrap_or_else(|| panic!("the reader's script ended:\n{}", &dom[..dom.len().min(2000)]));
        let text = &dom[start + 16..start + dom[start..].find("</pre>").unwrap()];
        let found: Value =
            serde_json::from_str(&text.replace("&amp;", "&").replace("&gt;", ">").replace("&lt;", "<")).unwrap();
        assert_eq!(found["faults"], serde_json::json!([]), "{found}");
        assert_eq!(found["moved"], true, "the player moves");
        assert_eq!((&found["followed"], &found["focusable"]), (&1.into(), &0.into()), "a cell's robot is followed");
        assert!(found["panel"].as_str().unwrap().contains("nand_1"), "{found}");
        assert_eq!(found["clock"], "cycle 7 of 24");
        assert_eq!(found["wide"], true, "nothing sticks out of the page");
    }
}

#[test]
fn screenshots_are_kept() {
    let Some(browser) = chromium() else { return };
    let artefacts = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = artefacts.join("page.html");
    std::fs::write(&file, page()).unwrap();
    let picture = artefacts.join("page.png");
    let to = format!("--screenshot={}", picture.display());
    let folder = tempfile::tempdir().unwrap();
    browse(&browser, folder.path(), &["--window-size=1100,1500", "--virtual-time-budget=1000", &to], &file);
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&picture).unwrap()));
    let info = decoder.read_info().unwrap().info().clone();
    assert_eq!((info.width, info.height), (1100, 1500));
}
