//! The preprocessor: one text without directives, from a Verilog file and those that it includes.
//!
//! The preprocessor of Yosys reads any file and joins pieces to words. So Yosys gets no directives, and the checked
//! text is the text that Yosys sees.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use crate::verilog::conditions::Conditions;
use crate::verilog::macros::{Budget, Macro, arguments};
use crate::verilog::token::{Lexer, TokenPlace, VerilogToken, VerilogTokenKind};
use nbc_base::budget::Limit;
use nbc_base::source::{FileError, VerilogError, VerilogFault, VerilogFile, VerilogPlace};
use nbc_circuit::CancelFlag;

/// The macros that Yosys defines.
const DEFINED: [&str; 2] = ["SYNTHESIS", "YOSYS"];

/// Reads an included file: its path and its text.
pub(super) type Reader<'a> = &'a dyn Fn(&str) -> Result<String, FileError>;

/// The tokens of files, with macros expanded.
pub(super) struct Source<'a> {
    read: Reader<'a>,
    /// Ends the reading.
    cancel: &'a CancelFlag,
    /// The files that come after the first, last one first.
    later: Vec<VerilogFile<'a>>,
    /// The texts of included files.
    included: BTreeMap<String, Rc<str>>,
    /// The paths of the files, by the numbers in places.
    files: Vec<Arc<str>>,
    inputs: Vec<Input>,
    macros: BTreeMap<String, Macro>,
    conditions: Conditions,
    budget: Budget,
    /// Whether a hint for synthesizers excludes the tokens that follow.
    is_off: bool,
}

/// A source of tokens.
enum Input {
    File(Lexer),
    /// The body of a macro, last token first.
    Body(Vec<VerilogToken>, TokenPlace),
}

impl<'a> Source<'a> {
    /// The tokens of some files, one after the other.
    pub(super) fn new(files: &[VerilogFile<'a>], read: Reader<'a>, cancel: &'a CancelFlag) -> Self {
        let mut source = Self {
            read,
            cancel,
            later: files.iter().rev().copied().collect(),
            included: BTreeMap::new(),
            files: Vec::new(),
            inputs: Vec::new(),
            macros: DEFINED.iter().map(|&name| (name.to_owned(), Macro::default())).collect(),
            conditions: Conditions::default(),
            budget: Budget::default(),
            is_off: false,
        };
        source.enter_next();
        source
    }

    /// A place as others name it.
    pub(super) fn place(&self, place: TokenPlace) -> VerilogPlace {
        VerilogPlace { file: self.files[place.file as usize].clone(), line: place.line as usize }
    }

    /// The next token that Yosys is to see.
    ///
    /// # Errors
    /// When a directive is wrong, or a file cannot be included.
    pub(super) fn next(&mut self) -> Result<Option<VerilogToken>, VerilogError> {
        let mut after_directive = false;
        loop {
            if self.cancel.is_raised() {
                return Err(VerilogError::Cancelled);
            }
            let Some(mut token) = self.raw()? else {
                if self.conditions.is_open() {
                    return Err(self.fault(self.here(), VerilogFault::OpenCondition));
                }
                if self.enter_next() {
                    continue;
                }
                return Ok(None);
            };
            match token.kind {
                VerilogTokenKind::Directive => {
                    after_directive = true;
                    if let Some(token) = self.directive(token)? {
                        return Ok(Some(token));
                    }
                }
                VerilogTokenKind::Hint if token.text.contains("translate") => self.is_off = token.text.contains("_off"),
                _ if self.is_off || !self.conditions.hold() => {}
                _ => {
                    token.is_spaced |= after_directive;
                    return Ok(Some(token));
                }
            }
        }
    }

    /// Follows a directive, or expands a macro; a token if Yosys is to see it.
    fn directive(&mut self, token: VerilogToken) -> Result<Option<VerilogToken>, VerilogError> {
        let place = token.place;
        let is_read = !self.is_off && self.conditions.hold();
        match token.text.as_str() {
            "`ifdef" | "`ifndef" | "`elsif" => {
                let name = self.word(&token)?;
                let holds = self.macros.contains_key(&name) != (token.text == "`ifndef");
                match token.text.as_str() {
                    "`elsif" => self.conditions.otherwise(holds).ok_or_else(|| self.unmatched(&token))?,
                    _ => self.conditions.begin(holds),
                }
            }
            "`else" => self.conditions.otherwise(true).ok_or_else(|| self.unmatched(&token))?,
            "`endif" => self.conditions.end().ok_or_else(|| self.unmatched(&token))?,
            "`define" => {
                let line = self.rest_of_line(&token)?;
                if is_read {
                    let (name, defined) = Macro::read(&line).map_err(|fault| self.fault(place, fault))?;
                    self.macros.insert(name, defined);
                }
            }
            _ if !is_read => {}
            "`undef" => {
                let name = self.word(&token)?;
                self.macros.remove(&name);
            }
            "`include" => self.include(&token)?,
            // Times mean nothing to a circuit, and cells are modules.
            "`timescale" => _ = self.rest_of_line(&token)?,
            "`celldefine" | "`endcelldefine" => {}
            "`default_nettype" | "`resetall" => return Ok(Some(VerilogToken { is_spaced: true, ..token })),
            _ => self.expand(&token)?,
        }
        Ok(None)
    }

    fn include(&mut self, token: &VerilogToken) -> Result<(), VerilogError> {
        let quoted = self.next()?.filter(|next| next.kind == VerilogTokenKind::Quoted);
        let expected = || VerilogFault::Directive { word: token.text.clone(), expected: "a path in quotes" };
        let quoted = quoted.ok_or_else(|| self.fault(token.place, expected()))?;
        let path = quoted.text.trim_matches('"').to_owned();
        if Limit::VerilogNesting.permit(self.inputs.len() as u64 + 1).is_err() {
            return Err(self.fault(token.place, VerilogFault::TooDeep));
        }
        let whole = beside(&self.files[token.place.file as usize], &path);
        self.budget.include().map_err(|fault| self.fault(token.place, fault))?;
        let text = match self.included.get(&whole) {
            Some(text) => text.clone(),
            None => {
                let text = (self.read)(&whole);
                let text =
                    text.map_err(|error| VerilogError::Include { place: self.place(token.place), path, error })?;
                self.included.entry(whole.clone()).or_insert(text.into()).clone()
            }
        };
        self.budget.spend(text.len() + 1).map_err(|fault| self.fault(token.place, fault))?;
        self.enter(whole, text);
        Ok(())
    }

    fn enter(&mut self, path: String, text: Rc<str>) {
        let file = self.files.len() as u32;
        self.files.push(path.into());
        self.inputs.push(Input::File(Lexer::new(text, TokenPlace { file, line: 1 })));
    }

    /// Goes on with the next file, if there is one.
    fn enter_next(&mut self) -> bool {
        let Some(file) = self.later.pop() else { return false };
        self.inputs.clear();
        self.enter(file.path.to_owned(), file.text.into());
        true
    }

    fn expand(&mut self, token: &VerilogToken) -> Result<(), VerilogError> {
        let (word, place) = (&token.text, token.place);
        let undefined = || VerilogFault::Undefined { word: word.clone() };
        let known = self.macros.get(&word[1..]).cloned().ok_or_else(|| self.fault(place, undefined()))?;
        if Limit::VerilogNesting.permit(self.inputs.len() as u64 + 1).is_err() {
            return Err(self.fault(place, VerilogFault::TooDeep));
        }
        let given = if known.parameters.is_some() { self.arguments(token)? } else { Vec::new() };
        let tokens = known.expand(word, &given, place, &mut self.budget);
        let mut tokens = tokens.map_err(|fault| self.fault(place, fault))?;
        tokens.reverse();
        self.inputs.push(Input::Body(tokens, place));
        Ok(())
    }

    fn arguments(&mut self, token: &VerilogToken) -> Result<Vec<Vec<VerilogToken>>, VerilogError> {
        let open = VerilogFault::Directive { word: token.text.clone(), expected: "arguments in parentheses" };
        if !self.raw()?.is_some_and(|next| next.is_sign("(")) {
            return Err(self.fault(token.place, open));
        }
        let mut broken = None;
        let lists = arguments(
            || {
                self.raw().or_else(|error| {
                    broken = Some(error);
                    Ok(None)
                })
            },
            &token.text,
        );
        match broken {
            Some(error) => Err(error),
            None => lists.map_err(|fault| self.fault(token.place, fault)),
        }
    }

    /// The next token as written. What comes after a macro does not touch it.
    fn raw(&mut self) -> Result<Option<VerilogToken>, VerilogError> {
        let mut after_body = false;
        while let Some(input) = self.inputs.last_mut() {
            let token = match input {
                Input::File(lexer) => lexer.next(),
                Input::Body(tokens, _) => Ok(tokens.pop()),
            };
            match token {
                Ok(Some(token)) => return Ok(Some(VerilogToken { is_spaced: token.is_spaced || after_body, ..token })),
                Ok(None) if self.inputs.len() == 1 => return Ok(None),
                Ok(None) => after_body = self.inputs.pop().is_some(),
                Err(fault) => return Err(self.fault(self.here(), fault)),
            }
        }
        Ok(None)
    }

    /// The name after a directive.
    fn word(&mut self, token: &VerilogToken) -> Result<String, VerilogError> {
        let next = self.raw()?.filter(|next| next.kind == VerilogTokenKind::Word);
        let expected = || VerilogFault::Directive { word: token.text.clone(), expected: "a name" };
        Ok(next.ok_or_else(|| self.fault(token.place, expected()))?.text)
    }

    fn rest_of_line(&mut self, token: &VerilogToken) -> Result<String, VerilogError> {
        let line = match self.inputs.last_mut() {
            Some(Input::File(lexer)) => lexer.rest_of_line(),
            _ => Err(VerilogFault::Directive { word: token.text.clone(), expected: "a line outside of macros" }),
        };
        line.map_err(|fault| self.fault(token.place, fault))
    }

    /// The place that was reached.
    fn here(&self) -> TokenPlace {
        match self.inputs.last() {
            Some(Input::File(lexer)) => lexer.place(),
            Some(Input::Body(_, place)) => *place,
            None => TokenPlace::default(),
        }
    }

    fn unmatched(&self, token: &VerilogToken) -> VerilogError {
        self.fault(token.place, VerilogFault::NoCondition { word: token.text.clone() })
    }

    fn fault(&self, place: TokenPlace, fault: VerilogFault) -> VerilogError {
        VerilogError::Unclear { place: self.place(place), fault }
    }
}

/// The path of a file that another includes.
fn beside(file: &str, path: &str) -> String {
    match file.rsplit_once('/') {
        Some((folder, _)) if !path.starts_with('/') => format!("{folder}/{path}"),
        _ => path.to_owned(),
    }
}
