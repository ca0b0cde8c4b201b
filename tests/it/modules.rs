//! The modules of all crates and what each of them imports, read from the text of the source.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{LazyLock, OnceLock};

use crate::support::*;

/// A path of modules and items, which begins with the crate.
type Item = Vec<String>;

/// A file of the source.
pub struct Module {
    pub path: PathBuf,
    pub name: Item,
    /// The text without unit tests; every line keeps its number.
    pub product: String,
    /// `product` without comments and the contents of literals.
    pub code: String,
}

fn sources() -> Vec<PathBuf> {
    let crates = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path().join("src"));
    std::iter::once(root().join("src")).chain(crates).collect()
}

/// All files of all crates, in order. They are read once for all tests.
pub fn modules() -> &'static [Module] {
    static MODULES: OnceLock<Vec<Module>> = OnceLock::new();
    MODULES.get_or_init(read_all)
}

fn read_all() -> Vec<Module> {
    let mut open = sources();
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(found.len() > 20, "the source was found");
    found.into_iter().map(Module::read).collect()
}

impl Module {
    fn read(path: PathBuf) -> Self {
        let product = without_tests(&fs::read_to_string(&path).unwrap());
        Self { name: module_name(&path), code: code_only(&product), product, path }
    }

    pub fn file(&self) -> String {
        self.path.strip_prefix(root()).unwrap().display().to_string()
    }
}

/// The name of a file's crate, and its path in the crate's folder of sources.
pub fn place(path: &Path) -> (String, PathBuf) {
    let inside = path.strip_prefix(root()).unwrap();
    match inside.strip_prefix("crates") {
        Ok(inside) => {
            let name = inside.iter().next().unwrap().to_string_lossy().into_owned();
            let file = inside.strip_prefix(&name).unwrap().strip_prefix("src").unwrap().to_owned();
            (format!("nbc_{}", name.replace('-', "_")), file)
        }
        Err(_) => ("nbc".to_owned(), inside.strip_prefix("src").unwrap().to_owned()),
    }
}

fn module_name(path: &Path) -> Item {
    let (name, file) = place(path);
    let inside = file.with_extension("");
    let mut name: Item =
        std::iter::once(name).chain(inside.iter().map(|part| part.to_string_lossy().into_owned())).collect();
    if matches!(name.last().unwrap().as_str(), "mod" | "lib") {
        name.pop();
    }
    name
}

/// The text with comments and the contents of literals replaced by blanks; every character keeps its place.
fn code_only(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        let after = |start: usize, end: &str| rest[start..].find(end).map_or(rest.len(), |at| start + at + end.len());
        let literal = match next {
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '/' if rest.starts_with("/*") => after(2, "*/"),
            'r' if rest.starts_with("r#\"") => after(3, "\"#"),
            '"' => closed(rest, '"'),
            // A lifetime has no second quote after one character.
            '\'' if rest[1..].starts_with('\\') || rest.chars().nth(2) == Some('\'') => closed(rest, '\''),
            _ => 0,
        };
        if literal == 0 {
            code.push(next);
        }
        code.extend(rest[..literal].chars().map(|c| if c == '\n' { c } else { ' ' }));
        rest = &rest[literal.max(next.len_utf8())..];
    }
    code
}

/// The length of the literal that begins with a quote, with both quotes.
fn closed(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}

/// The text without the items that are compiled for unit tests only; their lines become empty.
fn without_tests(text: &str) -> String {
    let text: Vec<char> = text.chars().collect();
    let code: Vec<char> = code_only(&text.iter().collect::<String>()).chars().collect();
    let marker: Vec<char> = "#[cfg(test)]".chars().collect();
    let mut kept = text.clone();
    let mut at = 0;
    while let Some(start) = (at..code.len()).find(|&start| code[start..].starts_with(&marker)) {
        at = item_end(&code, start + marker.len());
        kept[start..at].iter_mut().filter(|c| **c != '\n').for_each(|c| *c = ' ');
    }
    kept.into_iter().collect()
}

/// The end of the item that begins at `start`: its closing brace, or the semicolon of an item without a body.
fn item_end(code: &[char], start: usize) -> usize {
    let mut depth = 0;
    for (at, c) in code.iter().enumerate().skip(start) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 && matches!(c, '}' | ';') {
            return at + 1;
        }
    }
    code.len()
}

/// For each module, by index, the modules that it imports. An item that a folder re-exports belongs to its own file.
pub fn imports() -> &'static [BTreeSet<usize>] {
    static IMPORTS: LazyLock<Vec<BTreeSet<usize>>> = LazyLock::new(|| find_imports(modules()));
    &IMPORTS
}

fn find_imports(modules: &[Module]) -> Vec<BTreeSet<usize>> {
    let index: BTreeMap<&Item, usize> = modules.iter().enumerate().map(|(at, module)| (&module.name, at)).collect();
    let mut exported: BTreeMap<Item, Item> = BTreeMap::new();
    let mut named: Vec<Vec<Item>> = Vec::new();
    for module in modules {
        let (public, private, others) = uses(&module.code);
        let resolve = |items: Vec<Item>| items.into_iter().filter_map(|item| absolute(&item, &module.name, &index));
        for item in resolve(public) {
            exported.insert([module.name.clone(), vec![item.last().unwrap().clone()]].concat(), item);
        }
        named.push(resolve(private).chain(resolve(paths(&others))).collect());
    }
    let home = |item: &Item| {
        let mut item = item.clone();
        // A re-exported item may be re-exported again; a circle of these would not compile.
        let is_exported = |path: &[String]| exported.contains_key(path) && !index.contains_key(&path.to_vec());
        while let Some(at) = (1..=item.len()).rev().find(|&at| is_exported(&item[..at])) {
            item = [exported[&item[..at]].clone(), item[at..].to_vec()].concat();
        }
        (0..=item.len()).rev().find_map(|at| index.get(&item[..at].to_vec()).copied())
    };
    let imported = |(at, items): (usize, &Vec<Item>)| {
        items.iter().filter_map(home).filter(|&other| other != at).collect::<BTreeSet<_>>()
    };
    named.iter().enumerate().map(imported).collect()
}

/// What a file uses, in public and in private declarations, and the code without these.
fn uses(code: &str) -> (Vec<Item>, Vec<Item>, String) {
    let (mut public, mut private, mut others) = (Vec::new(), Vec::new(), String::new());
    let mut rest = code;
    while !rest.is_empty() {
        let line = rest.split_inclusive('\n').next().unwrap();
        let item = line.trim_start();
        let visible = item.strip_prefix("pub").map(|item| item.trim_start_matches(|c| c != ' ').trim_start());
        if !visible.unwrap_or(item).starts_with("use ") {
            others.push_str(line);
            rest = &rest[line.len()..];
            continue;
        }
        let (declaration, after) = rest.split_once(';').expect("a semicolon ends what is used");
        let (_, tree) = declaration.split_once("use ").unwrap();
        // In a module within the file, `super` is the file.
        let tree = if line.starts_with(' ') { tree.replacen("super", "self", 1) } else { tree.to_owned() };
        expand(&tree, &[], if visible.is_some() { &mut public } else { &mut private });
        rest = after;
    }
    (public, private, others)
}

fn expand(tree: &str, before: &[String], items: &mut Vec<Item>) {
    let names =
        |path: &str| path.split("::").map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect();
    let join = |path: &str| -> Item { [before.to_vec(), names(path)].concat() };
    let tree = tree.trim();
    let Some((path, rest)) = tree.split_once('{') else {
        let (path, _) = tree.split_once(" as ").unwrap_or((tree, ""));
        items.push(join(path));
        return;
    };
    let (before, mut depth, mut start) = (join(path), 0, 0);
    let list = rest.trim_end().strip_suffix('}').expect("a brace for each brace");
    for (at, c) in list.char_indices().chain([(list.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                if !list[start..at].trim().is_empty() {
                    expand(&list[start..at], &before, items);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}

fn paths(code: &str) -> Vec<Item> {
    let code = code.replace("pub(in ", "pub(::");
    let words =
        code.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':').map(|word| word.trim_end_matches(':'));
    let paths = words.filter(|word| !word.starts_with(':') && word.contains("::"));
    paths.map(|path| path.split("::").map(str::to_owned).collect()).collect()
}

/// A path that begins with its crate, if it names something of these crates.
fn absolute(item: &[String], module: &[String], index: &BTreeMap<&Item, usize>) -> Option<Item> {
    let supers = item.iter().take_while(|name| *name == "super").count();
    match item[0].as_str() {
        "crate" => Some([&module[..1], &item[1..]].concat()),
        name if name.starts_with("nbc_") => Some(item.to_vec()),
        "self" => Some([module, &item[1..]].concat()),
        "super" => Some([&module[..module.len().checked_sub(supers)?], &item[supers..]].concat()),
        first => {
            let child = [module, &[first.to_owned()]].concat();
            index.contains_key(&child).then(|| [module, item].concat())
        }
    }
}

/// The modules that import each other, directly or through others.
pub fn circles(imports: &[BTreeSet<usize>]) -> Vec<BTreeSet<usize>> {
    let reach = |from: usize| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(at) = open.pop() {
            open.extend(imports[at].iter().filter(|&&next| seen.insert(next)));
        }
        seen
    };
    let reached: Vec<BTreeSet<usize>> = (0..imports.len()).map(reach).collect();
    let circle = |at: usize| reached[at].iter().copied().filter(|&other| reached[other].contains(&at)).collect();
    let circles: BTreeSet<BTreeSet<usize>> =
        (0..imports.len()).map(circle).filter(|c: &BTreeSet<usize>| !c.is_empty()).collect();
    circles.into_iter().collect()
}

#[test]
fn tests_and_literals_are_not_product_code() {
    let text = "fn a() { let b = \"{ // c\"; }\n#[cfg(test)]\nmod tests { fn d() { '}'; } }\nfn e() {} // f\n";
    let product = without_tests(text);
    assert_eq!(product.lines().count(), text.lines().count());
    assert!(product.contains("fn e() {} // f") && !product.contains("fn d"), "{product}");
    assert_eq!(code_only("a \"b\" // c\n'd' 'e: f"), format!("a{}\n    'e: f", " ".repeat(9)));
}

#[test]
fn a_circle_is_found_through_other_modules() {
    let imports = [vec![1], vec![2], vec![1, 3], vec![]].map(BTreeSet::from_iter);
    assert_eq!(circles(&imports), [BTreeSet::from([1, 2])]);
}
