//! The report of tests at the level of logic as one self-contained HTML page: the verdict and the truth tables.

use crate::html::{Html, escape};
use crate::verdict::describe_test;
use nbc_base::diag::counted;
use nbc_swarm::TestVerdict;

pub fn draw_logic_page(source: &str, verdicts: &[&TestVerdict]) -> String {
    let passed = verdicts.iter().filter(|verdict| verdict.passed).count();
    let all = verdicts.len();
    let word = if passed == all { "pass" } else { "FAIL" };
    Html {
        heading: source,
        passed: passed == all,
        verdict: format!("{word}: {passed} of {} passed", counted(all, "test")),
        body: verdicts.iter().map(|verdict| section(verdict)).collect(),
        script: None,
    }
    .finish()
}

fn section(verdict: &TestVerdict) -> String {
    let (circuit, title) = (escape(&verdict.circuit), escape(&verdict.title));
    format!("<section>\n<h2>{circuit} {title}</h2>\n<pre>{}</pre>\n</section>\n", escape(&describe_test(verdict)))
}
