//! A page and its editor in one thread.

use std::sync::Arc;

use core::time::Duration;

use crate::language::LanguageQueue;
use crate::parts;
use nbc_lsp::LanguageService;
use nbc_play::{KeptFile, LocalLine, LocalShell, MemoryFolder, PageMessage, PlaySite, Visit};
use nbc_session::CompileOptions;

/// A visit of the live page and a language service with the same files. `now` is always the time since any moment, and
/// never goes back.
pub struct Tab {
    folder: MemoryFolder,
    shell: Arc<LocalShell>,
    line: Arc<LocalLine>,
    visit: Visit,
    queue: Arc<LanguageQueue>,
    service: LanguageService,
    /// Answers to texts that were not messages for the language service.
    refusals: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TabMessage {
    Page(PageMessage),
    Language(String),
    /// The page has written a file, which can now be kept.
    Written {
        path: String,
        text: String,
    },
    Kept(KeptFile),
    /// A part of a simulation for somebody else to do: its number and bytes.
    Part(usize, Vec<u8>),
}

impl Tab {
    pub fn new(first: Option<String>, now: Duration) -> Self {
        let (folder, shell, line) = (MemoryFolder::default(), Arc::<LocalShell>::default(), Arc::default());
        let site = PlaySite {
            folder: Arc::new(folder.clone()),
            // A page that opens a file of its own is a live page already, and has nothing to make others of.
            live_pages: first.is_none(),
            public_page: nbc_play::PUBLIC_PAGE.map(str::to_owned),
            file: first,
            making: CompileOptions::default(),
            class: None,
            shell: shell.clone(),
        };
        let visit = Visit::new(Arc::new(site), Arc::<LocalLine>::clone(&line), now);
        let queue = Arc::new(LanguageQueue::new(folder.clone()));
        let service = LanguageService::new(queue.clone());
        Self { folder, shell, line, visit, queue, service, refusals: Vec::new() }
    }

    /// Adds a file, or replaces it: one that was kept, or that another tab has written.
    pub fn insert(&self, path: &str, contents: impl AsRef<[u8]>) {
        self.folder.insert(path, contents);
    }

    pub fn remove(&self, path: &str) {
        self.folder.remove(path);
    }

    pub fn set_template(&self, text: &str) {
        self.shell.set_template(text);
    }

    /// Sets how many others simulate. What is not there when there are none will not come.
    pub fn set_crew(&self, size: usize) {
        self.shell.local_crew().set_size(size);
        self.shell.wake();
    }

    pub fn receive_part(&self, number: usize, result: &[u8]) {
        let result = parts::read_result(result).expect("what became of a part comes from the same program");
        self.shell.local_crew().receive(number, result);
        self.shell.wake();
    }

    pub fn receive(&mut self, text: &str, now: Duration) {
        self.visit.receive(text, now);
        // It may stop work that waits for others.
        self.shell.wake();
    }

    pub fn greet(&mut self) {
        self.service = LanguageService::new(self.queue.clone());
    }

    pub fn receive_language(&mut self, text: &str, now: Duration) {
        match nbc_lsp::parse(text.as_bytes()).and_then(nbc_lsp::message) {
            Ok(message) => _ = self.service.receive(message, now),
            Err(refusal) => self.refusals.push(refusal.to_string()),
        }
    }

    /// Does what is due, at most one cycle of the swarm and a portion of each kind of work. Returns the time until
    /// there is more to do. A message may come before.
    pub fn advance(&mut self, now: Duration) -> Duration {
        self.shell.advance();
        self.queue.advance();
        self.visit.advance(now);
        self.service.advance(now);
        if self.shell.has_work() || self.queue.has_work() {
            return Duration::ZERO;
        }
        let page = self.visit.due(now);
        self.service.due(now).map_or(page, |language| language.min(page))
    }

    /// The next message. A frame is left until there is room for it, and replaced by newer ones meanwhile.
    pub fn next(&mut self, has_room: bool) -> Option<TabMessage> {
        if let Some((number, part)) = self.shell.local_crew().next_part() {
            return Some(TabMessage::Part(number, parts::write_part(&part)));
        }
        if let Some(file) = self.shell.take_kept() {
            return Some(TabMessage::Kept(file));
        }
        if let Some((path, text)) = self.folder.take_written() {
            return Some(TabMessage::Written { path, text });
        }
        if let Some(message) = self.line.next(has_room) {
            return Some(TabMessage::Page(message));
        }
        let answer = self.service.next_message().map(|message| nbc_lsp::written(&message));
        answer.or_else(|| self.refusals.pop()).map(TabMessage::Language)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    const LATCH: &str = include_str!("../circuits/latch.nb");

    fn said(tab: &mut Tab) -> Vec<TabMessage> {
        let mut now = Duration::ZERO;
        while tab.advance(now).is_zero() {
            now += Duration::from_millis(1);
        }
        std::iter::from_fn(|| tab.next(true)).collect()
    }

    #[test]
    fn a_page_and_its_editor_see_the_same_files() {
        let mut tab = Tab::new(None, Duration::ZERO);
        let save = json!({ "id": 1, "do": "save", "path": "a.nb", "text": LATCH, "stamp": null });
        tab.receive(&save.to_string(), Duration::ZERO);
        let written = TabMessage::Written { path: "a.nb".to_owned(), text: LATCH.to_owned() };
        assert!(said(&mut tab).contains(&written));
        for (id, method, params) in [
            (Some(1), "initialize", json!({ "capabilities": {}, "rootUri": "file:///" })),
            (
                None,
                "textDocument/didOpen",
                json!({ "textDocument": {
                "uri": "file:///b.nb", "languageId": "nb", "version": 1,
                "text": "use \"a.nb\"\ncircuit two(a, b) -> (q) { (q, _) = d_latch(a, b) }\n",
            } }),
            ),
        ] {
            let mut message = json!({ "jsonrpc": "2.0", "method": method, "params": params });
            id.into_iter().for_each(|id: i32| message["id"] = json!(id));
            tab.receive_language(&message.to_string(), Duration::ZERO);
        }
        let texts: Vec<Value> = said(&mut tab)
            .into_iter()
            .map(|message| match message {
                TabMessage::Language(text) => serde_json::from_str(&text).unwrap(),
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(texts[0]["id"], 1);
        let published = texts.iter().find(|text| text["method"] == "textDocument/publishDiagnostics").unwrap();
        assert_eq!(published["params"]["diagnostics"], json!([]), "the file of the page is found");
    }

    #[test]
    fn a_text_that_is_not_a_message_is_refused() {
        let mut tab = Tab::new(None, Duration::ZERO);
        for text in ["nonsense", "[]"] {
            tab.receive_language(text, Duration::ZERO);
            let Some(TabMessage::Language(answer)) = tab.next(true) else { panic!("{text}") };
            assert!(answer.contains("\"error\""), "{answer}");
        }
    }

    /// The frames of eight robots up to their third cycle, with so many others who simulate.
    fn frames(crew: usize) -> Vec<Vec<u8>> {
        let mut tab = Tab::new(None, Duration::ZERO);
        let text = "circuit each(a[8]) -> (q[8]) { q = not a }\n";
        tab.set_crew(crew);
        let (mut given, mut frames, mut now) = (0, Vec::new(), Duration::ZERO);
        for request in [
            json!({ "id": 1, "do": "program", "path": "each.nb", "text": text }),
            json!({ "id": 2, "do": "compile", "path": "each.nb", "circuit": "each", "swarm": null }),
            json!({ "id": 3, "do": "step", "cycles": 3 }),
        ] {
            tab.receive(&request.to_string(), now);
            for _ in 0..20 {
                now += Duration::from_millis(20);
                tab.advance(now);
                while let Some(message) = tab.next(true) {
                    match message {
                        TabMessage::Part(number, part) => {
                            given += 1;
                            tab.receive_part(number, &parts::performed(&part).unwrap());
                        }
                        TabMessage::Page(PageMessage::Frame(frame)) => frames.push(frame),
                        _ => {}
                    }
                }
            }
        }
        assert_eq!(given, 3 * crew.min(1), "a part of each cycle");
        frames
    }

    #[test]
    fn a_swarm_does_the_same_with_others() {
        let (alone, together) = (frames(0), frames(2));
        assert!(alone.len() >= 4);
        assert_eq!(alone.last(), together.last());
    }

    /// The texts for the page, and the number of parts that others did, when these bring what they have done last
    /// first.
    fn answers(crew: usize, requests: &[Value]) -> (Vec<Value>, usize) {
        let mut tab = Tab::new(None, Duration::ZERO);
        tab.set_crew(crew);
        let (mut done, mut texts) = (0, Vec::new());
        for request in requests {
            tab.receive(&request.to_string(), Duration::ZERO);
            loop {
                while tab.advance(Duration::ZERO).is_zero() {}
                let mut parts = Vec::new();
                while let Some(message) = tab.next(true) {
                    match message {
                        TabMessage::Part(number, part) => parts.push((number, part)),
                        TabMessage::Page(PageMessage::Text(text)) => texts.push(serde_json::from_str(&text).unwrap()),
                        _ => {}
                    }
                }
                if parts.is_empty() {
                    break;
                }
                done += parts.len();
                for (number, part) in parts.into_iter().rev() {
                    tab.receive_part(number, &parts::performed(&part).unwrap());
                }
            }
        }
        (texts, done)
    }

    #[test]
    fn a_test_in_physics_has_the_same_verdict_with_others() {
        // Only a swarm that is simulated whole shows what the row with a hold of one cycle asks for.
        let rows = "    0 | 255\n    255 | 0\n    15 | 0 for 1 cycle\n";
        let text = format!("circuit each(a[8]) -> (q[8]) {{ q = not a }}\ntest each {{\n    a | q\n{rows}}}\n");
        let requests = [
            json!({ "id": 1, "do": "program", "path": "each.nb", "text": text }),
            json!({ "id": 2, "do": "test", "path": "each.nb", "test": 0, "level": "physics" }),
        ];
        let (alone, none) = answers(0, &requests);
        let (together, parts) = answers(3, &requests);
        assert_eq!(none, 0);
        let cycles = alone.iter().filter_map(|text| text["progress"][1].as_u64()).max().unwrap();
        assert_eq!(parts as u64, cycles, "eight robots are two parts in each cycle, of which one is done here");
        assert_eq!(alone, together);
        assert_eq!(alone.last().unwrap()["ok"]["results"][0]["rows"].as_array().unwrap().len(), 3, "{alone:?}");
    }

    #[test]
    fn an_evolution_finds_the_same_with_others() {
        let evolve = json!({ "id": 1, "do": "evolve", "body": null, "box": [2, 2], "generations": 2, "seed": 1 });
        let (alone, none) = answers(0, std::slice::from_ref(&evolve));
        let (together, parts) = answers(3, &[evolve]);
        assert_eq!(none, 0);
        assert!((2..=6).contains(&parts), "{parts} parts of two generations");
        assert_eq!(alone, together);
    }

    #[test]
    fn work_goes_on_alone_when_the_others_are_gone() {
        let mut tab = Tab::new(None, Duration::ZERO);
        tab.set_crew(2);
        let evolve = json!({ "id": 1, "do": "evolve", "body": null, "box": [2, 2], "generations": 1, "seed": 1 });
        tab.receive(&evolve.to_string(), Duration::ZERO);
        while tab.advance(Duration::ZERO).is_zero() {}
        let is_done = |message: &TabMessage| match message {
            TabMessage::Page(PageMessage::Text(text)) => text.contains("\"ok\""),
            _ => false,
        };
        assert!(!std::iter::from_fn(|| tab.next(true)).any(|message| is_done(&message)), "it waits for the others");
        tab.set_crew(0);
        while tab.advance(Duration::ZERO).is_zero() {}
        assert!(std::iter::from_fn(|| tab.next(true)).any(|message| is_done(&message)));
    }

    #[test]
    fn a_frame_waits_for_room() {
        let mut tab = Tab::new(None, Duration::ZERO);
        tab.insert("latch.nb", LATCH);
        for request in [
            json!({ "id": 1, "do": "program", "path": "latch.nb", "text": LATCH }),
            json!({ "id": 2, "do": "compile", "path": "latch.nb", "circuit": "d_latch", "swarm": null }),
        ] {
            tab.receive(&request.to_string(), Duration::ZERO);
            while tab.advance(Duration::ZERO).is_zero() {}
        }
        let is_frame = |message: &TabMessage| matches!(message, TabMessage::Page(PageMessage::Frame(_)));
        assert!(!std::iter::from_fn(|| tab.next(false)).any(|message| is_frame(&message)));
        assert!(tab.next(true).is_some_and(|message| is_frame(&message)));
    }
}
