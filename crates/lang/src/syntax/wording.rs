//! The messages about the text of a program: what does not follow the grammar, and habits from other languages.

use crate::syntax::split::KEYWORDS;
use nbc_base::diag::{Code, Diagnostic, Fix, Suggestion, suggest};
use nbc_base::source::Span;

const REPEAT: &str = "use `for` and circuits for parts that repeat";

const NAME_PARTS: &str = "name inner parts: `t = …`";

pub(crate) fn large_file(bytes: usize, most: u64, at: Span) -> Diagnostic {
    let message = format!("source file of {} MB is too large", bytes >> 20);
    Diagnostic::new(Code::Unreadable, message, at, format!("expected at most {} MB", most >> 20))
        .with_help(format!("split it into several files, or {REPEAT}"))
}

pub(crate) fn zero_byte(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Unreadable, "file is not text", at, "found a zero byte")
        .with_help("source files are UTF-8 text")
}

pub(crate) fn deep_declaration(depth: usize, most: u64, at: Span) -> Diagnostic {
    let label = format!("expected at most {most} levels in a declaration");
    Diagnostic::new(Code::Nesting, format!("brackets are nested {depth} levels deep"), at, label).with_help(NAME_PARTS)
}

pub(crate) fn deep_text(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Nesting, "text is nested too deeply", at, "at this point").with_help(NAME_PARTS)
}

pub(crate) fn long_declaration(words: usize, most: u64, at: Span) -> Diagnostic {
    let message = format!("declaration of {words} words and signs is too long");
    Diagnostic::new(Code::TooLarge, message, at, format!("expected at most {most}"))
        .with_help(format!("split it, or {REPEAT}"))
}

pub(crate) fn long_name(bytes: usize, most: u64, at: Span) -> Diagnostic {
    let message = format!("a name of {bytes} bytes is too long");
    Diagnostic::new(Code::TooLarge, message, at, format!("expected at most {most} in this declaration"))
}

pub(crate) fn not_an_instance(text: &str, at: Span) -> Diagnostic {
    let message = format!("`{text}` is not the name of a circuit");
    Diagnostic::new(Code::Syntax, message, at, "expected a name")
        .with_help("write parameters in brackets: `adder[8]` or `adder[n = 8]`")
}

pub(crate) fn unexpected(found: &str, expected: impl Into<String>, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, format!("unexpected `{found}`"), at, expected)
}

pub(crate) fn unexpected_declaration(found: &str, at: Span) -> Diagnostic {
    let error = unexpected(found, "expected a declaration", at);
    match Suggestion::near(found, KEYWORDS) {
        meant @ Suggestion::Near(_) => error.with_suggestion(at, &meant),
        _ => error.with_help(format!("declarations begin with {}", suggest::alternatives(&KEYWORDS, "or"))),
    }
}

pub(crate) fn end_of_line(expected: String, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, "unexpected end of line", at, expected)
}

pub(crate) fn end_of_declaration(expected: String, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, "unexpected end of declaration", at, expected)
}

pub(crate) fn unclosed_bracket(in_declaration: bool, at: Span) -> Diagnostic {
    let (end, help) = if in_declaration {
        ("declaration", "close it; a keyword in the first column begins a new declaration")
    } else {
        ("statement", "close it")
    };
    let label = format!("opened here, and still open at the end of the {end}");
    Diagnostic::new(Code::Syntax, "unclosed bracket", at, label).with_help(help)
}

pub(crate) fn ambiguous(operators: [&str; 2], readings: [String; 2], first: Span, at: Span) -> Diagnostic {
    let message = format!("`{}` and `{}` side by side can be read in two ways", operators[0], operators[1]);
    Diagnostic::new(Code::Ambiguous, message, at, "or this one first?")
        .with_label(first, "this one first?")
        .with_help(format!("write `{}` or `{}`", readings[0], readings[1]))
}

// ---- habits from other languages and common mistakes, whose meaning is known ----

/// `after` is the text after the comment.
pub(crate) fn foreign_comment(comment: &str, after: &str, at: Span) -> Diagnostic {
    let (sign, replacement) = match comment.strip_prefix('#') {
        Some(text) => ("#", Some(format!("//{text}"))),
        None => (
            "/*",
            comment.strip_prefix("/*").and_then(|rest| rest.strip_suffix("*/")).map(|inner| {
                let lines: Vec<_> =
                    inner.lines().map(|line| format!("// {}", line.trim()).trim_end().to_owned()).collect();
                let ends_line =
                    after.trim_start_matches([' ', '\t']).starts_with(['\n', '\r']) || after.trim().is_empty();
                lines.join("\n") + if ends_line { "" } else { "\n" }
            }),
        ),
    };
    unexpected(sign, "expected a comment that begins with `//`", at)
        .with_help("a comment runs from `//` to the end of its line")
        .with_fix(replacement.map(|text| Fix::replace(at, text)))
}

pub(crate) fn bare_outputs(outputs: &str, at: Span) -> Diagnostic {
    let first = outputs.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default();
    unexpected(first, "expected outputs in parentheses", at)
        .with_help(format!("write `-> ({outputs})`"))
        .with_fix(Fix::replace(at, format!("({outputs})")))
}

/// A keyword of another language before nets; `whole` covers both.
pub(crate) fn net_keyword(word: &str, nets: &str, whole: Span, at: Span) -> Diagnostic {
    unexpected(word, "expected `net`", at)
        .with_help(help_for_statement(word))
        .with_fix(Fix::replace(whole, format!("net {nets}")))
}

pub(crate) fn start_of_net(net: &str, at: Span) -> Diagnostic {
    unexpected("init", "expected `,` or a new line", at)
        .with_help(format!("write the start value where the net is driven: `{net} init 0 = …`"))
}

pub(crate) fn colon_in_loop(at: Span) -> Diagnostic {
    unexpected(":", "expected `..`", at)
        .with_help("write `for i in 0..8 { … }`; the end is not included")
        .with_fix(Fix::replace(at, ".."))
}

/// `if` with statements in braces, which `whole` covers, and the choices that it means if they are certain.
pub(crate) fn if_block(choices: &[String], whole: Span, at: Span) -> Diagnostic {
    let help = match choices {
        [choice] if choice.len() < 60 => format!("`if` chooses a value: `{choice}`"),
        _ => "`if` chooses a value, and needs an `else`: `q = if s then a else b`".to_owned(),
    };
    unexpected("if", "expected a statement", at)
        .with_help(help)
        .with_fix((!choices.is_empty()).then(|| Fix::replace(whole, choices.join("\n    "))))
}

pub(crate) fn missing_then(at: Span) -> Diagnostic {
    unexpected("{", "expected `then`", at).with_help("write `if s then a else b`").with_fix(Fix::insert(at, "then "))
}

pub(crate) fn foreign_letters(word: &str, at: Span) -> Diagnostic {
    let label = "expected the letters `a` to `z`, digits and `_`";
    Diagnostic::new(Code::Syntax, format!("`{word}` is not a valid name"), at, label)
        .with_help("write it with ASCII letters")
}

pub(crate) fn unclosed_quote(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, "unclosed string", at, "opened here").with_help("close it with `\"` on the same line")
}

/// `close` is the second quote.
pub(crate) fn single_quote(close: Option<Span>, at: Span) -> Diagnostic {
    let fix = close.map(|close| {
        let [mut first, second] = [at, close].map(|quote| Fix::replace(quote, "\""));
        first.edits.extend(second.edits);
        first
    });
    unexpected("'", "expected `\"`", at).with_help("write strings in double quotes").with_fix(fix)
}

pub(crate) fn reserved_word(word: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, format!("`{word}` is a reserved word"), at, "expected a name")
        .with_help(format!("choose another name, for example `{word}_1`"))
}

/// `index` covers the brackets, for which `slice` stands.
pub(crate) fn colon_in_slice(net: &str, slice: &str, index: Span, at: Span) -> Diagnostic {
    unexpected(":", "expected `..`", at)
        .with_help(format!("write `{net}{slice}`, the highest bit first"))
        .with_fix(Fix::replace(index, slice))
}

pub(crate) fn range_of_port(port: &str, width: &str, at: Span) -> Diagnostic {
    unexpected(":", "expected a number of bits", at)
        .with_help(format!("write the number of bits: `{port}[{width}]`"))
        .with_fix(Fix::replace(at, format!("[{width}]")))
}

/// `[7:0]` before a name; `both` covers the two.
pub(crate) fn width_before_name(name: &str, width: &str, both: Span, at: Span) -> Diagnostic {
    unexpected("[", "expected a name", at)
        .with_help(format!("write the width after the name: `{name}[{width}]`"))
        .with_fix(Fix::replace(both, format!("{name}[{width}]")))
}

/// `input` or `wire` before a port; `before` covers it with the space after it.
pub(crate) fn kind_of_port(kind: &str, before: Span, at: Span) -> Diagnostic {
    unexpected(kind, "expected the name of a port", at)
        .with_help("write only the name, and the width after it")
        .with_fix(Fix::remove(before, &format!("`{kind}`")))
}

/// A choice with `?` and `:`; `whole` covers it.
pub(crate) fn question_mark([condition, then, otherwise]: [&str; 3], whole: Span, at: Span) -> Diagnostic {
    let choice = format!("if {condition} then {then} else {otherwise}");
    unexpected("?", "expected an operator", at)
        .with_help(format!("write `{choice}`"))
        .with_fix(Fix::replace(whole, choice))
}

/// A constant whose width is a sum; `zero` covers it if all its bits are 0.
pub(crate) fn width_of_constant(width: &str, digits: &str, zero: Option<Span>, at: Span) -> Diagnostic {
    let error = unexpected("'", "expected a number or a name as the width of a constant", at);
    match zero {
        Some(whole) => error
            .with_help(format!("repeat a zero: `{{({width}){{0}}}}`"))
            .with_fix(Fix::replace(whole, format!("{{({width}){{0}}}}"))),
        None => error
            .with_help(format!("give the width a name, as in `circuit name[w = {width}](…)`, and write `w'd{digits}`")),
    }
}

pub(crate) fn nets_in_braces(nets: &str, bits: &[String], at: Span) -> Diagnostic {
    let bits = suggest::alternatives(bits, "and");
    unexpected("{", "expected a net, or nets in parentheses, before `=`", at).with_help(format!(
        "for a circuit's outputs, write `({nets}) = …`; for bits of a value, write `t = …`, then {bits}"
    ))
}

pub(crate) fn space_before_operands(name: &str, operands: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, "unexpected space before `(`", at, "expected no space here")
        .with_help(format!("write `{name}{operands}`"))
        .with_fix(Fix::remove(at, "the space"))
}

pub(crate) fn misspelled_operator(word: &str, operator: &str, at: Span) -> Diagnostic {
    unexpected(word, "expected an operator", at)
        .with_help(format!("did you mean `{operator}`?"))
        .with_fix(Fix::replace(at, operator))
}

pub(crate) fn missing_operator(found: &str, at: Span) -> Diagnostic {
    unexpected(found, "expected an operator or a new line", at)
}

/// A pattern with spaces; `whole` covers it.
pub(crate) fn space_in_pattern(found: &str, pattern: &str, whole: Span, at: Span) -> Diagnostic {
    unexpected(found, "expected `:`", at)
        .with_help(format!("write patterns without spaces: `{pattern}`"))
        .with_fix(Fix::replace(whole, pattern))
}

/// A `-` before an operand; `instead` is the place and the text of what to write, if that is certain.
pub(crate) fn sign(instead: Option<(Span, String)>, at: Span) -> Diagnostic {
    let text = instead.as_ref().map_or("(0 - a)", |(_, text)| text);
    unexpected("-", "values have no sign", at)
        .with_help(format!("write `{text}`: results wrap, so it is the two's complement"))
        .with_fix(instead.map(|(span, text)| Fix::replace(span, text)))
}

/// `before` is the entry before the missing comma.
pub(crate) fn missing_comma(before: Option<(&str, Span)>, found: &str, close: char, at: Span) -> Diagnostic {
    let error = unexpected(found, format!("expected `,` or `{close}`"), at);
    let Some((word, Span { end, .. })) = before else { return error };
    error.with_help(format!("write `{word}, {found}`")).with_fix(Fix::insert(Span { start: end, end, ..at }, ","))
}

/// `module` or `fn` for `circuit`, if the rest is as it should be.
pub(crate) fn circuit_keyword(word: &str, at: Span) -> Diagnostic {
    unexpected(word, "expected `circuit`", at).with_help("write `circuit`").with_fix(Fix::replace(at, "circuit"))
}

pub(crate) fn foreign_circuit(word: &str, at: Span) -> Diagnostic {
    unexpected(word, "expected `circuit`", at).with_help("write `circuit name(inputs) -> (outputs) { … }`")
}

pub(crate) fn statement_end(sign: &str, at: Span) -> Diagnostic {
    unexpected(sign, "expected a statement", at)
        .with_help(format!("a statement ends with its line; leave out the `{sign}`"))
        .with_fix((sign == ";").then(|| Fix::remove(at, "the `;`")))
}

/// `assign` or `wire` before a statement; `whole` covers it with the space after it.
pub(crate) fn statement_keyword(word: &str, whole: Span, at: Span) -> Diagnostic {
    unexpected(word, "expected a statement", at)
        .with_help(help_for_statement(word))
        .with_fix(Fix::remove(whole, &format!("`{word}`")))
}

pub(crate) fn drive_sign(sign: &str, at: Span) -> Diagnostic {
    unexpected(sign, "expected `=`", at).with_help("drive a net with `=`").with_fix(Fix::replace(at, "="))
}

pub(crate) fn field_sign(field: &str, at: Span) -> Diagnostic {
    unexpected("=", "expected `:`", at).with_help(format!("write `{field}: …`")).with_fix(Fix::replace(at, ":"))
}

pub(crate) fn not_sign(sign: &str, at: Span) -> Diagnostic {
    unexpected(sign, "expected `not`", at).with_help("write `not`").with_fix(Fix::replace(at, "not "))
}

/// `&` for `and`, and the like; `text` is the operator with the spaces that it needs.
pub(crate) fn operator_sign(sign: &str, operator: &str, text: String, at: Span) -> Diagnostic {
    unexpected(sign, format!("expected `{operator}`"), at)
        .with_help(format!("write `{operator}`"))
        .with_fix(Fix::replace(at, text))
}

pub(crate) fn base_of_computed(base: char, at: Span) -> Diagnostic {
    unexpected(&base.to_string(), "expected `d` before a computed value", at).with_help("write `'d(…)`")
}

pub(crate) fn parameters_of_net(at: Span) -> Diagnostic {
    let help = "a bit is `a[3]`, a slice is `a[7..4]`; the parameters of a circuit stand before its operands: \
                `add[8](a, b)`";
    Diagnostic::new(Code::Syntax, "unexpected parameters", at, "expected a bit or a slice").with_help(help)
}

pub(crate) fn slice_of_circuit(at: Span) -> Diagnostic {
    unexpected("..", "expected parameters", at).with_help("separate parameters with commas: `register[4, 0](d, clk)`")
}

pub(crate) fn value_for_parameter(at: Span) -> Diagnostic {
    let help = "parameters are integers that are known when the circuit is built; a value of nets is an operand, in \
                parentheses";
    unexpected("[", "expected an integer", at).with_help(help)
}

fn help_for_statement(word: &str) -> &'static str {
    match word {
        "wire" | "logic" | "signal" => {
            "driving a net declares it: `t = a and b`; to declare its width, write `net t[8]`"
        }
        "reg" => "for state, write a feedback loop, `q init 0 = …`, or use a register, `q = register(d, clk)`",
        _ => "write `name = expression`",
    }
}
