//! All commands and options as one page in Markdown, made from what `--help` prints.

use std::fmt::Write;

use clap::{Arg, Command};

const HEAD: &str = "\
# Commands and options

`nbc --help` lists the commands, and `--help` after a command has what is on this page: `nbc manual docs/commands.md`
makes it from there. [How do I …](how-do-i.md) has the commands by what you want to do.
";

const ELSEWHERE: [(&str, &str); 3] = [
    ("devices", "[Graphics cards](gpu.md#use)"),
    ("worker", "[Several machines](cluster.md)"),
    ("workers", "[Several machines](cluster.md#watch)"),
];

const OF_FEATURES: [&str; 5] = ["device", "nats", "creds", "tls_ca", "trust_workers"];

pub(super) fn page(program: &Command) -> String {
    let mut page = HEAD.to_owned();
    page += "\n## Every command\n\nThese options may follow any command.\n\n";
    page += &table(program.get_arguments().filter(|argument| argument.is_global_set()));
    for command in commands_of(program) {
        match ELSEWHERE.iter().find(|(name, _)| *name == command.get_name()) {
            Some((name, link)) => write_line(&mut page, format_args!("\n## nbc {name}\n\n{link} describes it.")),
            None => describe(command, "nbc", "##", &mut page),
        }
    }
    page
}

fn write_line(page: &mut String, line: std::fmt::Arguments<'_>) {
    let _ = writeln!(page, "{line}");
}

fn commands_of(command: &Command) -> impl Iterator<Item = &Command> {
    let is_elsewhere = |name: &str| ELSEWHERE.iter().any(|(known, _)| *known == name);
    let is_listed = move |inner: &&Command| !inner.is_hide_set() || is_elsewhere(inner.get_name());
    command.get_subcommands().filter(|inner| inner.get_name() != "help").filter(is_listed)
}

fn describe(command: &Command, outer: &str, level: &str, page: &mut String) {
    let name = format!("{outer} {}", command.get_name());
    let about = command.get_long_about().or(command.get_about()).map(ToString::to_string).unwrap_or_default();
    write_line(page, format_args!("\n{level} {name}\n\n{}", paragraphs(&about)));
    let usage = command.clone().render_usage().to_string();
    write_line(page, format_args!("\n    {}", usage.trim_start_matches("Usage:").trim()));
    let own = table(command.get_arguments().filter(|argument| !argument.is_global_set()));
    if own.lines().count() > 2 {
        write_line(page, format_args!("\n{}", own.trim_end()));
    }
    if let Some(after) = command.get_after_help() {
        after_help(&after.to_string(), page);
    }
    commands_of(command).for_each(|inner| describe(inner, &name, "###", page));
}

fn paragraphs(text: &str) -> String {
    let text = text.trim();
    let stop = if text.is_empty() || text.ends_with(['.', ':']) { "" } else { "." };
    let text = format!("{text}{stop}");
    let paragraphs = text.split('\n').filter(|paragraph| !paragraph.trim().is_empty());
    paragraphs.map(wrapped).collect::<Vec<_>>().join("\n\n")
}

fn wrapped(text: &str) -> String {
    const WIDTH: usize = 120;
    let (mut lines, mut line) = (Vec::new(), String::new());
    for word in text.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(std::mem::take(&mut line));
        }
        line += if line.is_empty() { "" } else { " " };
        line += word;
    }
    lines.push(line);
    lines.join("\n")
}

fn table<'a>(arguments: impl Iterator<Item = &'a Arg>) -> String {
    let mut text = "| option | meaning |\n|---|---|\n".to_owned();
    let is_usual = |argument: &&Arg| !matches!(argument.get_id().as_str(), "help" | "version");
    let is_shown = |argument: &&Arg| !argument.is_hide_set() || OF_FEATURES.contains(&argument.get_id().as_str());
    for argument in arguments.filter(is_usual).filter(is_shown) {
        write_line(&mut text, format_args!("| `{}` | {} |", spelling(argument), meaning(argument)));
    }
    text
}

fn spelling(argument: &Arg) -> String {
    let mut names: Vec<String> = argument.get_short().map(|short| format!("-{short}")).into_iter().collect();
    names.extend(argument.get_long().map(|long| format!("--{long}")));
    let takes_values = argument.get_action().takes_values();
    let values: Vec<&str> = argument.get_value_names().unwrap_or_default().iter().map(|name| name.as_str()).collect();
    let many = if argument.get_num_args().is_some_and(|range| range.max_values() > 1) { "..." } else { "" };
    let value = if takes_values { format!("<{}>{many}", values.join("> <")) } else { String::new() };
    format!("{} {value}", names.join(", ")).trim().to_owned()
}

fn meaning(argument: &Arg) -> String {
    let help = argument.get_long_help().or(argument.get_help()).map(ToString::to_string).unwrap_or_default();
    let mut text = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let values: Vec<String> = match argument.get_action().takes_values() {
        true => argument.get_possible_values().iter().filter(|value| !value.is_hide_set()).map(value_text).collect(),
        false => Vec::new(),
    };
    if !values.is_empty() {
        text += &format!(": {}", values.join(", "));
    }
    let defaults: Vec<String> =
        argument.get_default_values().iter().map(|value| format!("`{}`", value.to_string_lossy())).collect();
    if argument.get_action().takes_values() && !argument.is_hide_default_value_set() && !defaults.is_empty() {
        text += &format!("; by default {}", defaults.join(", "));
    }
    text.replace('|', "\\|")
}

fn value_text(value: &clap::builder::PossibleValue) -> String {
    let help = value.get_help().map(|help| lower(&help.to_string())).filter(|help| help != value.get_name());
    format!("`{}`{}", value.get_name(), help.map_or_else(String::new, |help| format!(" ({help})")))
}

fn lower(text: &str) -> String {
    let first = text.split(' ').next().unwrap_or_default();
    if first.chars().skip(1).any(char::is_uppercase) {
        return text.to_owned();
    }
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |letter| letter.to_lowercase().chain(letters).collect())
}

fn after_help(text: &str, page: &mut String) {
    let mut is_code = false;
    write_line(page, format_args!(""));
    for line in text.lines() {
        let code = line.strip_prefix("  ");
        if code.is_some() && !is_code {
            write_line(page, format_args!(""));
        }
        match code {
            Some(code) => write_line(page, format_args!("    {code}")),
            None if is_code && !line.is_empty() => write_line(page, format_args!("\n{}", wrapped(line))),
            None => write_line(page, format_args!("{}", wrapped(line))),
        }
        is_code = code.is_some();
    }
}
