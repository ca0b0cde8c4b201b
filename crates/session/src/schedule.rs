//! Schedules of a single robot as users write them: `00*10 01*56steps`.

use crate::wording::ScheduleError;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{CYCLE_STEPS, Pattern, Schedule, Spell};
use nbc_base::source::{SourceFile, Sources, Span};

/// The most env steps of a schedule.
const MAX_STEPS: u64 = 10_000_000;

/// Reads a schedule: entries with blanks between them, each of a bit for each of so many stimuli, `*`, and a number of
/// cycles or env steps. Messages call the text `name`.
///
/// # Errors
/// A diagnostic for each entry that is wrong, at its place.
pub fn read_schedule(name: &str, text: &str, stimuli: usize) -> Result<Schedule, Diagnostics> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    parse(sources.file(id), stimuli).map_err(|list| Diagnostics { list, sources })
}

fn parse(file: &SourceFile, stimuli: usize) -> Result<Schedule, Vec<Diagnostic>> {
    let (mut spells, mut faults) = (Vec::new(), Vec::new());
    for span in words(file) {
        match parse_entry(file, span, stimuli) {
            Ok(spell) => spells.push(spell),
            Err(fault) => faults.push(fault),
        }
    }
    let whole = Span::new(file.id, 0, file.text.len());
    if spells.is_empty() && faults.is_empty() {
        faults.push(ScheduleError::Empty.at(whole, stimuli));
    }
    let steps: u64 = spells.iter().map(|spell| u64::from(spell.steps)).sum();
    if steps > MAX_STEPS {
        faults.push(ScheduleError::TooLong { steps, most: MAX_STEPS }.at(whole, stimuli));
    }
    if faults.is_empty() { Ok(Schedule { spells }) } else { Err(faults) }
}

/// The spans of the words of a text.
fn words(file: &SourceFile) -> Vec<Span> {
    let start = |word: &str| word.as_ptr() as usize - file.text.as_ptr() as usize;
    file.text.split_whitespace().map(|word| Span::new(file.id, start(word), start(word) + word.len())).collect()
}

fn parse_entry(file: &SourceFile, span: Span, stimuli: usize) -> Result<Spell, Diagnostic> {
    let entry = &file.text[span.range()];
    let start = span.range().start;
    let Some((bits, length)) = entry.split_once('*') else {
        return Err(ScheduleError::NoDuration { entry: entry.to_owned() }.at(span, stimuli));
    };
    let bits_span = Span::new(file.id, start, start + bits.len());
    let length_span = Span::new(file.id, start + bits.len() + 1, span.range().end);
    let pattern = parse_bits(bits, stimuli).map_err(|fault| fault.at(bits_span, stimuli))?;
    Ok(Spell::of(pattern, parse_length(length).map_err(|fault| fault.at(length_span, stimuli))?))
}

fn parse_bits(bits: &str, stimuli: usize) -> Result<Pattern, ScheduleError> {
    let pattern = Pattern::try_from(bits.to_owned()).ok().filter(|_| bits.len() == stimuli);
    pattern.ok_or_else(|| ScheduleError::Pattern { found: bits.to_owned() })
}

fn parse_length(length: &str) -> Result<u32, ScheduleError> {
    let found = length.to_owned();
    let (number, unit) = match length.find(|c: char| !c.is_ascii_digit()) {
        Some(at) => length.split_at(at),
        None => (length, "cycles"),
    };
    let steps_each = match unit {
        "cycle" | "cycles" => u64::from(CYCLE_STEPS),
        "step" | "steps" => 1,
        _ => return Err(ScheduleError::NotADuration { found }),
    };
    // A number that overflows is too long for a schedule.
    let count = number.parse::<u64>().unwrap_or(if number.is_empty() { 0 } else { u64::MAX });
    match count.saturating_mul(steps_each) {
        0 => Err(ScheduleError::NoTime { found }),
        steps @ 1..=MAX_STEPS => Ok(u32::try_from(steps).expect("the limit fits")),
        _ => Err(ScheduleError::LongEntry { found, most: MAX_STEPS }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::Sources;

    /// A fault's message and the text at its place.
    type FaultAtPlace = (String, String);

    fn read(text: &str) -> Result<Vec<(String, u32)>, Vec<FaultAtPlace>> {
        read_of(2, text)
    }

    fn read_of(stimuli: usize, text: &str) -> Result<Vec<(String, u32)>, Vec<FaultAtPlace>> {
        let mut sources = Sources::default();
        let id = sources.add("--schedule", text);
        let told = |spell: Spell| (spell.pattern.digits(stimuli), spell.steps);
        parse(sources.file(id), stimuli).map(|schedule| schedule.spells.into_iter().map(told).collect()).map_err(
            |faults| {
                faults.into_iter().map(|fault| (fault.message, sources.text(fault.labels[0].span).to_owned())).collect()
            },
        )
    }

    fn check(text: &str, expected: &[(&str, u32)]) {
        assert_eq!(read(text), Ok(expected.iter().map(|&(bits, steps)| (bits.to_owned(), steps)).collect()));
    }

    fn check_fault(text: &str, message: &str, place: &str) {
        let faults = read(text).unwrap_err();
        assert_eq!(faults, [(message.to_owned(), place.to_owned())]);
    }

    #[test]
    fn entries_are_cycles_or_env_steps() {
        check("00*10 01*56steps", &[("00", 840), ("01", 56)]);
        check("  11*1cycle\n10*2cycles ", &[("11", 84), ("10", 168)]);
    }

    #[test]
    fn patterns_have_a_digit_for_each_stimulus() {
        assert_eq!(read_of(3, "011*1 100*2steps"), Ok(vec![("011".to_owned(), 84), ("100".to_owned(), 2)]));
        let fault = ("invalid stimulus pattern `01`".to_owned(), "01".to_owned());
        assert_eq!(read_of(3, "011*1 01*1"), Err(vec![fault]));
        check_fault("011*1", "invalid stimulus pattern `011`", "011");
    }

    #[test]
    fn errors_have_places() {
        check_fault("00*10 02*10", "invalid stimulus pattern `02`", "02");
        check_fault("00*0", "the duration `0` is too short", "0");
        check_fault("00*0steps", "the duration `0steps` is too short", "0steps");
        check_fault("00", "missing duration after `00`", "00");
        check_fault("00*", "the duration `` is too short", "");
        check_fault("00*-1", "`-1` is not a duration", "-1");
        check_fault("00*10s", "`10s` is not a duration", "10s");
        check_fault("", "the schedule is empty", "");
        check_fault("0*1", "invalid stimulus pattern `0`", "0");
        check_fault("é*1", "invalid stimulus pattern `é`", "é");
        let long = "9".repeat(40);
        check_fault(&format!("00*{long}"), &format!("the duration `{long}` is too long"), &long);
    }

    #[test]
    fn every_error_is_reported() {
        assert_eq!(read("02*1 00*0").unwrap_err().len(), 2);
    }

    #[test]
    fn the_total_length_is_limited() {
        let text = "00*100000 ".repeat(2);
        assert_eq!(read(&text).unwrap_err()[0].0, "the schedule of 16800000 env steps is too long");
    }
}
