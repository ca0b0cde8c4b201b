//! The tree of a design that slang prints: its modules, and statements that mean something else in hardware.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use serde_json::Value;

/// The most levels of a tree.
const MOST_DEPTH: i32 = 500;

pub(super) struct DesignTree(Value);

/// What a statement `always` with a list of events reads that is not in the list, and a net that it sets.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct IncompleteEvents {
    pub(super) module: String,
    pub(super) target: String,
    pub(super) missing: Vec<String>,
}

#[derive(Default)]
pub(super) struct Statements {
    pub(super) incomplete: Vec<IncompleteEvents>,
    /// Labels of `case` with unknown bits.
    pub(super) labels: BTreeSet<String>,
    /// The nets of statements `always_latch`.
    pub(super) latches: BTreeSet<String>,
    pub(super) has_assertions: bool,
    /// Nets that a statement without a clock reads before it sets them.
    pub(super) early: BTreeSet<String>,
    /// What functions read beside their arguments and variables, by their symbols.
    functions: BTreeMap<String, BTreeMap<String, String>>,
}

impl DesignTree {
    pub(super) fn of(text: &str) -> Option<Self> {
        let mut depth = 0;
        let nests = |c: char| {
            depth += i32::from(matches!(c, '{' | '[')) - i32::from(matches!(c, '}' | ']'));
            depth > MOST_DEPTH
        };
        if text.chars().any(nests) {
            return None;
        }
        let mut reader = serde_json::Deserializer::from_str(text);
        reader.disable_recursion_limit();
        Value::deserialize(&mut reader).ok().map(Self)
    }

    fn roots(&self) -> impl Iterator<Item = &Value> {
        members(&self.0).filter(|root| kind(root) == "Instance")
    }

    /// The modules that no other module with outputs contains, the one that contains most first, and those without
    /// outputs, which are left out.
    pub(super) fn tops(&self) -> (Vec<String>, Vec<String>) {
        let mut found: BTreeMap<String, usize> = BTreeMap::new();
        let mut left_out = Vec::new();
        let mut waiting: Vec<&Value> = self.roots().collect();
        let mut inside = BTreeSet::new();
        while let Some(instance) = waiting.pop() {
            let body = &instance["body"];
            let has_output = members(body).any(|port| port["direction"] == "Out" || port["direction"] == "InOut");
            if has_output {
                found.insert(name(body), instances(body, &mut inside));
            } else {
                left_out.push(name(body));
                waiting.extend(nested(body));
            }
        }
        let mut tops: Vec<(usize, String)> =
            found.into_iter().filter(|(top, _)| !inside.contains(top)).map(|(top, count)| (count, top)).collect();
        tops.sort_by(|one, two| two.0.cmp(&one.0).then_with(|| one.1.cmp(&two.1)));
        (tops.into_iter().map(|(_, top)| top).collect(), left_out)
    }

    pub(super) fn ports(&self, module: &str) -> Vec<String> {
        let mut waiting: Vec<&Value> = self.roots().collect();
        while let Some(instance) = waiting.pop() {
            let body = &instance["body"];
            if name(body) == module {
                return members(body).filter(|member| kind(member) == "Port").map(name).collect();
            }
            waiting.extend(nested(body));
        }
        Vec::new()
    }

    /// A module with outputs but without content, in these modules.
    pub(super) fn empty(&self, tops: &[String]) -> Option<String> {
        let is_declared = |member: &Value| {
            matches!(kind(member), "Port" | "Net" | "Variable" | "Parameter") && member.get("initializer").is_none()
        };
        let has_output = |body: &Value| members(body).any(|port| port["direction"] == "Out");
        let mut waiting: Vec<&Value> = self.roots().collect();
        while let Some(instance) = waiting.pop() {
            let body = &instance["body"];
            let is_left_out = members(body).all(|port| kind(port) != "Port") && !tops.contains(&name(body));
            if !is_left_out && has_output(body) && members(body).all(is_declared) {
                return Some(name(body));
            }
            waiting.extend(nested(body));
        }
        None
    }

    /// The parameters of these root modules that can be set.
    pub(super) fn parameters(&self, tops: &[String]) -> Vec<String> {
        let roots = self.roots().filter(|root| tops.contains(&name(&root["body"])));
        let bodies = roots.flat_map(|root| members(&root["body"]));
        let is_open = |member: &&Value| kind(member) == "Parameter" && member["isLocal"] != true;
        bodies.filter(is_open).map(name).collect()
    }

    pub(super) fn statements(&self, tops: &[String]) -> Statements {
        let mut found = Statements::default();
        for root in self.roots() {
            found.collect_functions(root);
            found.collect(&root["body"], &name(&root["body"]), "", tops);
        }
        found
    }
}

impl Statements {
    fn collect(&mut self, node: &Value, module: &str, path: &str, tops: &[String]) {
        match node {
            Value::Array(nodes) => nodes.iter().for_each(|node| self.collect(node, module, path, tops)),
            Value::Object(fields) => {
                let mut inner = path.to_owned();
                match kind(node) {
                    "Instance" if tops.contains(&name(&node["body"])) => {
                        let top = name(&node["body"]);
                        return self.collect(&node["body"]["members"], &top, "", tops);
                    }
                    "Instance" | "GenerateBlock" if !name(node).is_empty() => inner = format!("{path}{}.", name(node)),
                    "ProceduralBlock" => self.block(node, module, path),
                    "ImmediateAssertion" | "ConcurrentAssertion" => self.has_assertions = true,
                    "Case" => self.case(node),
                    _ => {}
                }
                fields.values().for_each(|field| self.collect(field, module, &inner, tops));
            }
            _ => {}
        }
    }

    fn collect_functions(&mut self, node: &Value) {
        let nodes: Vec<&Value> = match node {
            Value::Array(nodes) => nodes.iter().collect(),
            Value::Object(fields) => fields.values().collect(),
            _ => return,
        };
        if kind(node) == "Subroutine" {
            let mut uses = Uses::default();
            uses.statement(&node["body"]);
            let own: BTreeSet<String> = members(node).map(declared).collect();
            uses.read.retain(|symbol, _| !own.contains(symbol));
            self.functions.insert(declared(node), uses.read);
        }
        nodes.into_iter().for_each(|node| self.collect_functions(node));
    }

    fn case(&mut self, case: &Value) {
        let wild: &[char] = match case["condition"].as_str() {
            Some("Normal") => &['x', 'z'],
            Some("WildcardJustZ") => &['x'],
            _ => return,
        };
        let items = case["items"].as_array().into_iter().flatten();
        let labels = items.flat_map(|item| item["expressions"].as_array().into_iter().flatten());
        let labels = labels.filter_map(|label| label["constant"].as_str());
        // The digits stand behind their base.
        let is_unknown = |label: &&str| label.split_once('\'').is_some_and(|(_, digits)| digits.contains(wild));
        self.labels.extend(labels.filter(is_unknown).map(str::to_owned));
    }

    fn block(&mut self, block: &Value, module: &str, path: &str) {
        let mut use_ = Uses::default();
        let body = &block["body"];
        if block["procedureKind"] == "AlwaysLatch" {
            use_.statement(body);
            self.latches.extend(use_.written.iter().map(|(_, name)| format!("{path}{name}")));
            return;
        }
        let is_always = block["procedureKind"] == "Always" && kind(body) == "Timed";
        if !is_always && block["procedureKind"] != "AlwaysComb" {
            return;
        }
        use_.statement(if is_always { &body["stmt"] } else { body });
        let timing = &body["timing"];
        let events: Vec<&Value> = match kind(timing) {
            "SignalEvent" => vec![timing],
            "EventList" => timing["events"].as_array().into_iter().flatten().collect(),
            _ => Vec::new(),
        };
        if events.iter().any(|event| event["edge"] != "None") {
            return;
        }
        let is_early = |(symbol, _): &&(String, String)| use_.early.contains_key(symbol);
        self.early.extend(use_.written.iter().filter(is_early).map(|(_, name)| format!("{path}{name}")));
        // A bit of a vector is not the vector.
        let mut listed: BTreeMap<String, String> = events.iter().filter_map(|event| symbol(&event["expr"])).collect();
        if !is_always || kind(timing) == "ImplicitEvent" {
            listed.clone_from(&use_.read);
        }
        // `always_comb` knows what functions read.
        let called = use_.called.iter().filter(|_| is_always).filter_map(|function| self.functions.get(function));
        use_.read.extend(called.flatten().map(|(symbol, name)| (symbol.clone(), name.clone())));
        let is_written = |symbol: &String| use_.written.iter().any(|(written, _)| written == symbol);
        let is_missing = |(symbol, _): &(&String, &String)| !listed.contains_key(*symbol) && !is_written(symbol);
        let missing: Vec<String> = use_.read.iter().filter(is_missing).map(|(_, name)| name.clone()).collect();
        let target = use_.written.first().filter(|_| !missing.is_empty());
        let target = target.map(|(_, target)| format!("{path}{target}"));
        self.incomplete.extend(target.map(|target| IncompleteEvents { module: module.to_owned(), target, missing }));
    }
}

/// The variables that statements read and write, by their symbols.
#[derive(Default)]
struct Uses {
    read: BTreeMap<String, String>,
    /// In the order of the statements.
    written: Vec<(String, String)>,
    /// The functions that are called.
    called: Vec<String>,
    /// What was read before it was written.
    early: BTreeMap<String, String>,
}

impl Uses {
    /// Anything: statements and what they contain.
    fn statement(&mut self, node: &Value) {
        match node {
            Value::Array(nodes) => nodes.iter().for_each(|node| self.statement(node)),
            Value::Object(_) if kind(node) == "Assignment" => {
                self.target(&node["left"]);
                self.value(&node["right"]);
                if node.get("op").is_some() {
                    self.value(&node["left"]);
                }
            }
            Value::Object(_) if kind(node) == "NamedValue" => self.value(node),
            Value::Object(_) if kind(node) == "VariableDeclaration" => self.written.extend(symbol(node)),
            // Fields are in the order of their names.
            Value::Object(_) if kind(node) == "ForLoop" => {
                let variables = node["loopVars"].as_array().into_iter().flatten();
                self.written.extend(variables.map(|variable| (declared(variable), name(variable))));
                let parts = ["initializers", "stopExpr", "body", "steps"];
                parts.iter().for_each(|part| self.statement(&node[part]));
            }
            Value::Object(fields) if !fields.contains_key("constant") => {
                self.called.extend(node["subroutine"].as_str().map(str::to_owned));
                fields.values().for_each(|field| self.statement(field));
            }
            _ => {}
        }
    }

    fn value(&mut self, node: &Value) {
        if kind(node) == "NamedValue" && node.get("constant").is_none() {
            let found = symbol(node);
            self.early.extend(found.clone().filter(|found| !self.written.contains(found)));
            self.read.extend(found);
        } else if kind(node) != "NamedValue" {
            self.statement(node);
        }
    }

    /// What is written: only its selectors are read.
    fn target(&mut self, node: &Value) {
        match kind(node) {
            "NamedValue" | "HierarchicalValue" => self.written.extend(symbol(node)),
            "ElementSelect" | "RangeSelect" | "MemberAccess" => {
                self.target(&node["value"]);
                ["selector", "left", "right"].iter().for_each(|part| self.value(&node[part]));
            }
            "Concatenation" => {
                node["operands"].as_array().into_iter().flatten().for_each(|operand| self.target(operand));
            }
            "Conversion" => self.target(&node["operand"]),
            _ => {}
        }
    }
}

fn kind(node: &Value) -> &str {
    node["kind"].as_str().unwrap_or_default()
}

fn name(node: &Value) -> String {
    node["name"].as_str().unwrap_or_default().to_owned()
}

fn declared(node: &Value) -> String {
    format!("{} {}", node["addr"], name(node))
}

fn members(node: &Value) -> impl Iterator<Item = &Value> {
    node["members"].as_array().into_iter().flatten()
}

/// The instances in a module, those in its generated blocks included.
fn nested(body: &Value) -> Vec<&Value> {
    let mut found = Vec::new();
    for member in members(body) {
        match kind(member) {
            "Instance" => found.push(member),
            "GenerateBlock" | "GenerateBlockArray" | "InstanceArray" => found.extend(nested(member)),
            _ => {}
        }
    }
    found
}

/// The number of instances below a module, whose names are added to `inside`.
fn instances(body: &Value, inside: &mut BTreeSet<String>) -> usize {
    let mut count = 0;
    for instance in nested(body) {
        inside.insert(name(&instance["body"]));
        count += 1 + instances(&instance["body"], inside);
    }
    count
}

/// A symbol such as `16531784 a`, with its name.
fn symbol(node: &Value) -> Option<(String, String)> {
    let symbol = node["symbol"].as_str()?;
    Some((symbol.to_owned(), symbol.split_once(' ')?.1.to_owned()))
}
