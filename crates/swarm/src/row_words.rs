//! How a row of a test failed, in words.

use crate::{RowVerdict, WrongOutput};
use nbc_base::diag::counted;
use nbc_base::model::{Column, Value};

impl RowVerdict {
    /// `row 3: a=4'd9 b=0 | q=1, expected 0`, then the wrong robots and the nearest fix, a line each.
    pub fn describe(&self, inputs: &[Column], outputs: &[Column]) -> String {
        let given: Vec<String> =
            inputs.iter().zip(&self.inputs).map(|(port, value)| format!("{}={value}", port.name)).collect();
        let bar = if given.is_empty() { "" } else { " | " };
        let thread = self.thread.map_or(String::new(), |thread| format!(" in thread {}", thread + 1));
        let row = format!("row {}{thread}: {}{bar}", self.row, given.join(" "));
        if let Some(fault) = &self.fault {
            return format!("{row}{fault}");
        }
        let outputs = outputs.iter().zip(&self.expected).zip(&self.observed).zip(&self.steady);
        let wrong = outputs.filter_map(|(((port, expected), observed), &steady)| match steady {
            _ if expected.is_open() => None,
            false => Some(format!("{} keeps changing, expected {expected}", port.name)),
            true if differs(expected, observed) => Some(format!("{}={observed}, expected {expected}", port.name)),
            true => None,
        });
        let wrong: Vec<String> = wrong.collect();
        let given_up = self.given_up.map_or(String::new(), |most| {
            format!(" (repeated {most} {}, as often as its `until` permits)", if most == 1 { "time" } else { "times" })
        });
        let mut lines = vec![format!("{row}{}{given_up}", wrong.join("; "))];
        lines.extend(self.wrong_outputs.iter().map(|wrong| wrong_output(wrong, "output")));
        lines.extend(self.late.iter().map(|wrong| wrong_output(wrong, "had not settled yet and output")));
        lines.extend(nearest_fix(self));
        lines.join("\n")
    }
}

fn differs(expected: &Value, observed: &Value) -> bool {
    expected.bits.iter().zip(&observed.bits).any(|(expected, observed)| expected.is_some() && expected != observed)
}

fn wrong_output(wrong: &WrongOutput, did: &str) -> String {
    let WrongOutput { net, robot, cycle, .. } = wrong;
    let stimuli: Vec<String> = wrong.sensed.iter().map(|&bit| u8::from(bit).to_string()).collect();
    let (cycle, output) = (cycle + 1, u8::from(wrong.output));
    format!("cycle {cycle}: robot {robot} on net {net} {did} {output} on stimuli {}", stimuli.join(" "))
}

/// The most likely fix for a row: replace robots that were wrong although they had enough time; otherwise a longer
/// hold; otherwise another circuit.
fn nearest_fix(row: &RowVerdict) -> Option<String> {
    let fix = match row.wrong_outputs.first() {
        Some(WrongOutput { net, robot, .. }) => format!("a robot other than {robot} on net {net}, or a longer hold"),
        None if row.cycles < row.needed => {
            format!("hold the row for {}, as `hold: auto` does", counted(row.needed.unwrap_or_default(), "cycle"))
        }
        None if row.cycles.is_none() => return None,
        None => "every robot computed its gate, so correct the circuit or the test".to_owned(),
    };
    Some(format!("nearest fix: {fix}"))
}
