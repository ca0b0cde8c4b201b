//! Macros: their definitions, and their bodies with arguments in the place of parameters.

use crate::verilog::token::{Lexer, TokenPlace, VerilogToken, VerilogTokenKind};
use nbc_base::budget::{Limit, WorkBudget};
use nbc_base::source::VerilogFault;

/// A macro.
#[derive(Clone, Debug, Default)]
pub(super) struct Macro {
    /// The parameters with their defaults; `None` for a macro that has none, not even an empty list.
    pub(super) parameters: Option<Vec<MacroParameter>>,
    body: Vec<VerilogToken>,
}

#[derive(Clone, Debug)]
pub(super) struct MacroParameter {
    name: String,
    default: Option<Vec<VerilogToken>>,
}

impl Macro {
    /// The name and the macro in the rest of a line after `` `define ``.
    ///
    /// # Errors
    /// When it has no name, or its parameters are not names.
    pub(super) fn read(line: &str) -> Result<(String, Self), VerilogFault> {
        let expected = |expected| VerilogFault::Directive { word: "`define".to_owned(), expected };
        let mut lexer = Lexer::new(line, TokenPlace::default());
        let mut tokens = Vec::new();
        while let Some(token) = lexer.next()? {
            tokens.push(token);
        }
        let mut tokens = tokens.into_iter().peekable();
        let name = tokens.next().filter(|token| token.kind == VerilogTokenKind::Word).ok_or(expected("a name"))?;
        // Only a parenthesis right after the name begins parameters.
        let has_parameters = tokens.next_if(|next| next.is_sign("(") && !next.is_spaced).is_some();
        let parameters = has_parameters
            .then(|| arguments(|| Ok(tokens.next()), &name.text))
            .transpose()?
            .map(|lists| lists.into_iter().map(parameter).collect::<Option<Vec<_>>>().ok_or(expected("parameters")))
            .transpose()?;
        Ok((name.text, Self { parameters, body: tokens.collect() }))
    }

    /// The body with arguments in the place of the parameters, at the place of its use.
    ///
    /// # Errors
    /// When the number of arguments is wrong.
    pub(super) fn expand(
        &self,
        word: &str,
        arguments: &[Vec<VerilogToken>],
        place: TokenPlace,
        budget: &mut Budget,
    ) -> Result<Vec<VerilogToken>, VerilogFault> {
        let parameters = self.parameters.as_deref().unwrap_or_default();
        let wrong = || VerilogFault::Arguments { word: word.to_owned(), expected: parameters.len() };
        if arguments.len() > parameters.len() {
            return Err(wrong());
        }
        let mut tokens: Vec<VerilogToken> = Vec::new();
        // Whether the next operand is joined to the last one, and whether that was empty.
        let (mut is_joined, mut was_empty) = (false, true);
        for token in &self.body {
            if token.kind == VerilogTokenKind::Directive && token.text == JOIN {
                is_joined = true;
                continue;
            }
            let parameter =
                parameters.iter().position(|one| token.kind == VerilogTokenKind::Word && one.name == token.text);
            let meant = match parameter {
                Some(at) => {
                    let given = arguments.get(at).filter(|given| !given.is_empty() || parameters[at].default.is_none());
                    given.or(parameters[at].default.as_ref()).ok_or_else(wrong)?.as_slice()
                }
                None => std::slice::from_ref(token),
            };
            budget.spend(meant.iter().map(|token| token.text.len() + 1).sum())?;
            match (std::mem::take(&mut is_joined), meant.split_first()) {
                (true, None) => continue,
                (true, Some((next, others))) if !was_empty => {
                    let last = tokens.pop().expect("the operand before was not empty");
                    tokens.extend(joined(&last, &next.text)?);
                    tokens.extend(others.iter().map(|token| VerilogToken { place, ..token.clone() }));
                    continue;
                }
                _ => was_empty = meant.is_empty(),
            }
            let first = tokens.len();
            tokens.extend(meant.iter().map(|token| VerilogToken { place, ..token.clone() }));
            // No two words become one.
            if let Some(token) = tokens.get_mut(first).filter(|_| parameter.is_some() || first == 0) {
                token.is_spaced = true;
            }
        }
        Ok(tokens)
    }
}

/// What joins the tokens beside it in a macro.
const JOIN: &str = "``";

/// A token and a text after it as one token, if they can be one.
fn joined(token: &VerilogToken, text: &str) -> Result<Vec<VerilogToken>, VerilogFault> {
    let mut lexer = Lexer::new(format!("{}{text}", token.text), token.place);
    let mut tokens = Vec::new();
    while let Some(next) = lexer.next()? {
        tokens.push(VerilogToken { place: token.place, is_spaced: tokens.is_empty() && token.is_spaced, ..next });
    }
    Ok(tokens)
}

/// A parameter of a definition: a name, perhaps with `=` and a default.
fn parameter(tokens: Vec<VerilogToken>) -> Option<MacroParameter> {
    let mut tokens = tokens.into_iter();
    let name = tokens.next().filter(|token| token.kind == VerilogTokenKind::Word)?.text;
    match tokens.next() {
        None => Some(MacroParameter { name, default: None }),
        Some(sign) if sign.is_sign("=") => Some(MacroParameter { name, default: Some(tokens.collect()) }),
        Some(_) => None,
    }
}

/// The parts between commas up to the parenthesis that closes them; none in `()`.
///
/// # Errors
/// When no parenthesis closes them.
pub(super) fn arguments(
    mut next: impl FnMut() -> Result<Option<VerilogToken>, VerilogFault>,
    word: &str,
) -> Result<Vec<Vec<VerilogToken>>, VerilogFault> {
    let mut lists = vec![Vec::new()];
    let mut depth = 0;
    loop {
        let token = next()?;
        let open = || VerilogFault::Directive { word: word.to_owned(), expected: "a closing parenthesis" };
        let token = token.ok_or_else(open)?;
        let sign = if token.kind == VerilogTokenKind::Sign { token.text.as_str() } else { "" };
        match sign {
            ")" if depth == 0 => break,
            "," if depth == 0 => {
                lists.push(Vec::new());
                continue;
            }
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        lists.last_mut().expect("there is a list").push(token);
    }
    let is_empty = matches!(&lists[..], [only] if only.is_empty());
    Ok(if is_empty { Vec::new() } else { lists })
}

/// What macros and included files have become so far.
#[derive(Debug, Default)]
pub(super) struct Budget(WorkBudget);

impl Budget {
    /// Takes a file.
    ///
    /// # Errors
    /// When none is left.
    pub(super) fn include(&mut self) -> Result<(), VerilogFault> {
        let most = Limit::VerilogFiles.most();
        self.0.take(Limit::VerilogFiles, 1).map_err(|_| VerilogFault::TooManyFiles { most })
    }

    /// Takes bytes.
    ///
    /// # Errors
    /// When they are more than are left.
    pub(super) fn spend(&mut self, bytes: usize) -> Result<(), VerilogFault> {
        let megabytes = Limit::VerilogBytes.most() >> 20;
        self.0.take(Limit::VerilogBytes, bytes as u64).map_err(|_| VerilogFault::TooMuch { megabytes })
    }
}
