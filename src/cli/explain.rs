//! `nbc explain`: the page of a diagnostic's code.

use clap::Args;
use serde::Serialize;

use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_base::diag::{Code, Severity};
use nbc_lang::check::PRELUDE;
use nbc_session::report::Schema;

/// Explain an error code, or print the declarations available to every program
#[derive(Args)]
#[command(after_help = "Examples:
  nbc explain width
  nbc explain
  nbc explain prelude > prelude.nb          the paper's materials, stimuli, schedules and evolution
  nbc explain standard                      the standard circuits")]
pub struct ExplainArguments {
    /// An error code, `prelude` or `standard`; without it, all codes are listed
    code: Option<String>,
}

/// Codes of diagnostics, or sources of the prelude.
#[derive(Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Explanation {
    #[serde(skip_serializing_if = "Option::is_none")]
    codes: Option<Vec<ExplainedCode>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    files: Option<[PreludeFile; 1]>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct ExplainedCode {
    code: Code,
    severity: Severity,
    meaning: &'static str,
    /// The page in Markdown, if one code was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    page: Option<&'static str>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct PreludeFile {
    name: &'static str,
    text: &'static str,
}

impl Explanation {
    fn of(codes: &[Code], page: Option<&'static str>) -> Self {
        let explained = |&code: &Code| ExplainedCode { code, severity: code.severity(), meaning: code.meaning(), page };
        Self { codes: Some(codes.iter().map(explained).collect()), ..Self::default() }
    }
}

impl ExplainArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let Some(word) = self.code else { return list(context) };
        if let Some((name, text)) = PRELUDE.iter().find(|(name, _)| name.strip_suffix(".nb") == Some(&word)) {
            match context.format {
                OutputFormat::Json => {
                    let files = Some([PreludeFile { name, text }]);
                    context.print_json(Schema::Explain, &Explanation { files, ..Explanation::default() })?;
                }
                OutputFormat::Text => context.print(text)?,
            }
            return Ok(Status::Done);
        }
        let Some(code) = Code::ALL.iter().find(|code| code.word() == word) else {
            return Err(wording::unknown_code(&word).into());
        };
        let page = nbc_session::error_page(*code);
        match context.format {
            OutputFormat::Json => context.print_json(Schema::Explain, &Explanation::of(&[*code], Some(page)))?,
            OutputFormat::Text => context.print(page)?,
        }
        Ok(Status::Done)
    }
}

fn list(context: &mut Context) -> Result<Status, Failure> {
    if context.format == OutputFormat::Json {
        context.print_json(Schema::Explain, &Explanation::of(Code::ALL, None))?;
        return Ok(Status::Done);
    }
    let width = Code::ALL.iter().map(|code| code.word().len()).max().unwrap_or(0);
    for code in Code::ALL {
        context.print(format_args!("{code:width$}  {}\n", code.meaning()))?;
    }
    Ok(Status::Done)
}
