//! Links of the manual and of the other pages: what they name is there.

use std::collections::BTreeSet;

use regex::Regex;

use crate::support::*;

const PLACES: [&str; 9] = ["", "docs", "docs/errors", "grammar", "web", "editors/vscode", "python", ".ci", "circuits"];

fn pages() -> Vec<PathBuf> {
    let files = PLACES.iter().flat_map(|place| fs::read_dir(root().join(place)).unwrap());
    let mut pages: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    // The list of the book names a page that is made for it.
    let is_page = |path: &PathBuf| {
        path.extension().is_some_and(|extension| extension == "md") && !path.ends_with("docs/SUMMARY.md")
    };
    pages.retain(is_page);
    pages.sort();
    pages
}

/// The names under which a page's headings can be linked to, as forges make them.
fn anchors(page: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(page).unwrap();
    let mut is_code = false;
    let mut found = BTreeSet::new();
    for line in text.lines() {
        is_code ^= line.starts_with("```");
        if let Some(heading) =
            line.trim_start_matches('#').strip_prefix(' ').filter(|_| line.starts_with('#') && !is_code)
        {
            let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
            found.insert(kept.collect::<String>().to_lowercase().replace(' ', "-"));
        }
    }
    found
}

#[test]
fn links_lead_to_what_is_there() {
    let link = Regex::new(r"\]\(([^)\s]+)\)").unwrap();
    let code = Regex::new("`[^`]*`").unwrap();
    let mut wrong = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        let here = page.parent().unwrap();
        let mut is_code = false;
        for (number, line) in text.lines().enumerate() {
            is_code ^= line.starts_with("```");
            for target in link.captures_iter(&code.replace_all(line, "")).map(|found| found.get(1).unwrap().as_str()) {
                if is_code || target.contains("://") || target.starts_with("mailto:") || line.starts_with("    ") {
                    continue;
                }
                let (path, anchor) =
                    target.split_once('#').map_or((target, None), |(path, anchor)| (path, Some(anchor)));
                let there = if path.is_empty() { page.clone() } else { here.join(path) };
                let is_there = there.exists()
                    && anchor.is_none_or(|anchor| {
                        there.extension().is_some_and(|e| e == "md") && anchors(&there).contains(anchor)
                    });
                if !is_there {
                    wrong.push(format!("{}:{}: {target}", page.strip_prefix(root()).unwrap().display(), number + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "links that lead nowhere:\n{}", wrong.join("\n"));
}

#[test]
fn sections_that_are_named_are_there() {
    let named = Regex::new(r#"(?s)docs/([a-z-]+\.md), \\?"([^"\\]+)\\?"|\]\(([a-z-]+\.md)\)\)?,\s+"([^"]+)""#).unwrap();
    let mut open: Vec<PathBuf> =
        ["src", "crates", "tests/it", "benches", "examples", "docs"].map(|folder| root().join(folder)).to_vec();
    let (mut wrong, mut count) = (Vec::new(), 0);
    while let Some(path) = open.pop() {
        if path.is_dir() && !path.is_symlink() && !path.ends_with("target") {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            continue;
        }
        if !path.extension().is_some_and(|extension| extension == "rs" || extension == "md") {
            continue;
        }
        for found in named.captures_iter(&fs::read_to_string(&path).unwrap()) {
            let [page, section] = [1, 2].map(|n| found.get(n).or(found.get(n + 2)).unwrap().as_str());
            let text = fs::read_to_string(root().join("docs").join(page)).unwrap_or_default();
            let is_there =
                text.lines().any(|line| line.starts_with('#') && line.trim_start_matches('#').trim() == section);
            count += 1;
            if !is_there {
                wrong.push(format!("{}: docs/{page} has no section {section}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty() && count > 10, "{count} sections are named\n{}", wrong.join("\n"));
}

#[test]
fn the_book_has_every_page() {
    let summary = text_of("docs/SUMMARY.md");
    let listed: BTreeSet<&str> =
        summary.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|to| to.0).collect();
    for page in fs::read_dir(root().join("docs")).unwrap().map(|page| page.unwrap().file_name().into_string().unwrap())
    {
        assert!(!page.ends_with(".md") || page == "SUMMARY.md" || listed.contains(&page[..]), "{page} is not listed");
    }
    for page in listed {
        assert!(page == "introduction.md" || root().join("docs").join(page).exists(), "{page} is listed");
    }
}

#[test]
fn the_paper_on_nbc_cites_what_its_bibliography_has() {
    let [paper, bibliography] =
        ["paper.md", "paper.bib"].map(|file| fs::read_to_string(root().join("docs/joss").join(file)).unwrap());
    let found = |pattern: &str, text: &str| -> BTreeSet<String> {
        Regex::new(pattern).unwrap().captures_iter(text).map(|found| found[1].to_owned()).collect()
    };
    let cited = found(r"@(\w+)", &paper);
    assert_eq!(cited, found(r"(?m)^@\w+\{(\w+),", &bibliography));
    // The journal's limits, in words.
    let words = paper.split_whitespace().count();
    assert!((250..=1750).contains(&words), "{words}");
    for section in
        ["Summary", "Statement of need", "State of the field", "Software design", "Research impact statement"]
    {
        assert!(paper.contains(&format!("\n# {section}\n")), "{section}");
    }
}
