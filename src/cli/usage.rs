//! What clap says: help, the version, and faults of the arguments.

use std::ffi::OsString;
use std::io::{self, Write};

use clap::error::ErrorKind;
use clap::{Arg, Command};

use crate::cli::wording;
use crate::cli::{Context, OutputFormat, Status};
use nbc_base::diag::{Diagnostic, is_hidden, render, visible, without_passwords};
use nbc_base::source::Sources;

/// Lets options take negative numbers, so that one out of range is refused as a number.
pub(super) fn with_negative_numbers(command: Command) -> Command {
    let allow = |argument: Arg| {
        let is_option = argument.get_long().is_some() && argument.get_action().takes_values();
        if is_option { argument.allow_negative_numbers(true) } else { argument }
    };
    command.mut_args(allow).mut_subcommands(with_negative_numbers)
}

/// Prints what clap says of the arguments; a fault also as JSON, if they ask for it.
pub(super) fn tell(told: &clap::Error, arguments: &[OsString], command: fn() -> Command) -> Status {
    let format = if asks_for_json(arguments) { OutputFormat::Json } else { OutputFormat::Text };
    let mut context = Context::bare(format, command);
    if told.kind() == ErrorKind::InvalidUtf8 {
        let argument = arguments.iter().find(|argument| argument.to_str().is_none()).cloned().unwrap_or_default();
        return context.report(wording::not_text(argument.display()).into());
    }
    let plain = told.render().to_string();
    if !told.use_stderr() {
        return print(told);
    }
    let text = without_passwords_of(arguments, &plain);
    context.print_diagnostics(&diagnostic(told.kind(), &text).into());
    if text == plain && !text.contains(|c| is_hidden(c) && c != '\t') {
        return print(told);
    }
    // The arguments contain control characters or a password, so the text is printed without colors.
    let _ = io::stderr().write_all(visible(&text).as_bytes());
    Status::BadInput
}

fn print(told: &clap::Error) -> Status {
    match told.print().and_then(|()| io::stdout().flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            // If standard error is closed too, the exit status still reports the failure.
            let fault = wording::unprintable(&error);
            let _ = io::stderr().write_all(render::text(&[fault], &Sources::default(), false).as_bytes());
            Status::BadInput
        }
        _ if told.use_stderr() => Status::BadInput,
        _ => Status::Done,
    }
}

/// Clap has refused the arguments, so they are read without it.
fn asks_for_json(arguments: &[OsString]) -> bool {
    let options = arguments.iter().take_while(|argument| *argument != "--");
    let options: Vec<&str> = options.map(|argument| argument.to_str().unwrap_or_default()).collect();
    options.contains(&"--format=json") || options.windows(2).any(|pair| pair == ["--format", "json"])
}

/// A text that may repeat arguments, without the passwords of the addresses among them.
fn without_passwords_of(arguments: &[OsString], text: &str) -> String {
    let mut text = text.to_owned();
    for argument in arguments.iter().filter_map(|argument| argument.to_str()) {
        let value = argument.split_once('=').map_or(argument, |(_, value)| value);
        for word in [argument, value].into_iter().filter(|word| word.contains('@')) {
            text = text.replace(word, &without_passwords(word));
        }
    }
    text
}

/// The first paragraph of clap's text is the message, the others are the help.
fn diagnostic(kind: ErrorKind, text: &str) -> Diagnostic {
    if matches!(kind, ErrorKind::MissingSubcommand | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand) {
        return wording::no_command();
    }
    let one_line = |paragraph: &str| paragraph.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut paragraphs = text.trim().split("\n\n").map(one_line);
    let message = paragraphs.next().unwrap_or_default();
    let message = message.strip_prefix("error: ").unwrap_or(&message).to_owned();
    wording::arguments(message, paragraphs.collect::<Vec<_>>().join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_is_asked_for_by_one_word_or_two() {
        let asks = |line: &str| asks_for_json(&line.split(' ').map(OsString::from).collect::<Vec<_>>());
        assert!(asks("nbc run --format json") && asks("nbc --format=json rum"));
        assert!(!asks("nbc run --format xml") && !asks("nbc run -- --format json") && !asks("nbc json --format"));
    }

    #[test]
    fn passwords_in_arguments_are_not_repeated() {
        let arguments = ["nbc", "worker", "--nats=nats://me:a b@host", "me:secret@other"].map(OsString::from);
        let text = "unexpected 'nats://me:a b@host' and 'me:secret@other'";
        assert_eq!(without_passwords_of(&arguments, text), "unexpected 'nats://host' and 'other'");
    }
}
