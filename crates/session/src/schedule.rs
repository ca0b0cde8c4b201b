//! Schedules of a single robot as users write them: `00*10 01*56steps`, or `zeros*250steps` with sets of images.

use crate::wording::{self, ScheduleKind};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{CYCLE_STEPS, ImageSize, NamedImages, NamedSchedule, Pattern, Schedule, Spell};
use nbc_base::source::{SourceFile, Sources, Span};

/// In env steps.
const MAX_STEPS: u64 = 10_000_000;

type Entry<T> = (T, Span, u32);

/// Entries between blanks: a bit for each stimulus, `*`, and a number of cycles or env steps. Messages say `name`.
pub fn read_schedule(name: &str, text: &str, stimuli: usize) -> Result<Schedule, Diagnostics> {
    read(name, text, |file| parse(file, stimuli))
}

/// Each image of a set is shown for the time of its entry.
pub fn read_image_schedule(
    name: &str,
    text: &str,
    images: &[NamedImages],
    size: ImageSize,
) -> Result<NamedSchedule, Diagnostics> {
    let schedule = read(name, text, |file| parse_images(file, images, size))?;
    Ok(NamedSchedule { name: name.to_owned(), ..schedule })
}

fn read<T>(
    name: &str,
    text: &str,
    parse: impl FnOnce(&SourceFile) -> Result<T, Vec<Diagnostic>>,
) -> Result<T, Diagnostics> {
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    parse(sources.file(id)).map_err(|list| Diagnostics { list, sources })
}

fn parse(file: &SourceFile, stimuli: usize) -> Result<Schedule, Vec<Diagnostic>> {
    let kind = ScheduleKind::Pattern { stimuli };
    let entries = parse_entries(file, kind, |bits, at| parse_bits(bits, stimuli, at), |_| 1)?;
    Ok(Schedule { spells: entries.into_iter().map(|(pattern, _, steps)| Spell::of(pattern, steps)).collect() })
}

fn parse_images(file: &SourceFile, images: &[NamedImages], size: ImageSize) -> Result<NamedSchedule, Vec<Diagnostic>> {
    let find = |name: &str, at| find_set(name, images, size, at);
    let entries = parse_entries(file, ScheduleKind::Set, find, |set| set.images.len() as u64)?;
    let mut shown =
        NamedSchedule { name: String::new(), stimuli: Vec::new(), schedule: Schedule::default(), sets: Vec::new() };
    for (set, span, steps) in entries {
        shown.show(set, steps);
        if shown.sets.len() > NamedSchedule::MOST_SETS {
            return Err(vec![wording::too_many_sets(span)]);
        }
    }
    Ok(shown)
}

fn parse_entries<T>(
    file: &SourceFile,
    kind: ScheduleKind,
    what: impl Fn(&str, Span) -> Result<T, Diagnostic>,
    shown: impl Fn(&T) -> u64,
) -> Result<Vec<Entry<T>>, Vec<Diagnostic>> {
    let (mut entries, mut faults) = (Vec::new(), Vec::new());
    for span in words(file) {
        match parse_entry(file, span, kind, &what) {
            Ok(entry) => entries.push(entry),
            Err(fault) => faults.push(fault),
        }
    }
    let whole = Span::new(file.id, 0, file.text.len());
    if entries.is_empty() && faults.is_empty() {
        faults.push(kind.empty(whole));
    }
    let steps: u64 = entries.iter().map(|(entry, _, steps)| shown(entry) * u64::from(*steps)).sum();
    if steps > MAX_STEPS {
        faults.push(kind.too_long(steps, MAX_STEPS, whole));
    }
    if faults.is_empty() { Ok(entries) } else { Err(faults) }
}

fn words(file: &SourceFile) -> Vec<Span> {
    let start = |word: &str| word.as_ptr() as usize - file.text.as_ptr() as usize;
    file.text.split_whitespace().map(|word| Span::new(file.id, start(word), start(word) + word.len())).collect()
}

fn parse_entry<T>(
    file: &SourceFile,
    span: Span,
    kind: ScheduleKind,
    what: impl Fn(&str, Span) -> Result<T, Diagnostic>,
) -> Result<Entry<T>, Diagnostic> {
    let entry = &file.text[span.range()];
    let start = span.range().start;
    let Some((name, length)) = entry.split_once('*') else {
        return Err(kind.no_duration(entry, span));
    };
    let name_span = Span::new(file.id, start, start + name.len());
    let length_span = Span::new(file.id, start + name.len() + 1, span.range().end);
    Ok((what(name, name_span)?, name_span, parse_length(length, kind, length_span)?))
}

fn parse_bits(bits: &str, stimuli: usize, at: Span) -> Result<Pattern, Diagnostic> {
    let pattern = Pattern::try_from(bits.to_owned()).ok().filter(|_| bits.len() == stimuli);
    pattern.ok_or_else(|| wording::bad_pattern(bits, stimuli, at))
}

fn find_set<'a>(
    name: &str,
    images: &'a [NamedImages],
    size: ImageSize,
    at: Span,
) -> Result<&'a NamedImages, Diagnostic> {
    let Some(set) = images.iter().find(|set| set.name == name) else {
        return Err(wording::unknown_images(name, images.iter().map(|set| set.name.as_str()), at));
    };
    match set.images.iter().map(|image| image.size()).find(|found| *found != size) {
        Some(found) => Err(wording::image_size(name, found, size, at)),
        None => Ok(set),
    }
}

fn parse_length(length: &str, kind: ScheduleKind, at: Span) -> Result<u32, Diagnostic> {
    let (number, unit) = match length.find(|c: char| !c.is_ascii_digit()) {
        Some(at) => length.split_at(at),
        None => (length, "cycles"),
    };
    let steps_each = match unit {
        "cycle" | "cycles" => u64::from(CYCLE_STEPS),
        "step" | "steps" => 1,
        _ => return Err(kind.not_a_duration(length, at)),
    };
    // A number that overflows is too long for a schedule.
    let count = number.parse::<u64>().unwrap_or(if number.is_empty() { 0 } else { u64::MAX });
    match count.saturating_mul(steps_each) {
        0 => Err(kind.no_time(length, at)),
        steps @ 1..=MAX_STEPS => Ok(u32::try_from(steps).expect("the limit fits")),
        _ => Err(kind.long_entry(length, MAX_STEPS, at)),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use nbc_base::model::Image;

    type Messages = Vec<(String, String)>;

    fn read(stimuli: usize, text: &str) -> Result<Vec<(String, u32)>, Messages> {
        let shown = |spell: Spell| (spell.pattern.digits(stimuli), spell.steps);
        match read_schedule("--schedule", text, stimuli) {
            Ok(schedule) => Ok(schedule.spells.into_iter().map(shown).collect()),
            Err(Diagnostics { list, sources }) => Err(list
                .into_iter()
                .map(|fault| (fault.message, sources.text(fault.labels[0].span).to_owned()))
                .collect()),
        }
    }

    #[test]
    fn entries_are_cycles_or_env_steps_and_have_a_digit_for_each_stimulus() {
        for (stimuli, text, expected) in [
            (2, "00*10 01*56steps", [("00", 840), ("01", 56)]),
            (2, "  11*1cycle\n10*2cycles ", [("11", 84), ("10", 168)]),
            (3, "011*1 100*2steps", [("011", 84), ("100", 2)]),
        ] {
            assert_eq!(read(stimuli, text), Ok(expected.map(|(bits, steps)| (bits.to_owned(), steps)).to_vec()));
        }
    }

    #[test]
    fn errors_have_places() {
        let long = "9".repeat(40);
        for (stimuli, text, message, place) in [
            (3, "011*1 01*1", "invalid stimulus pattern `01`", "01"),
            (2, "011*1", "invalid stimulus pattern `011`", "011"),
            (2, "00*10 02*10", "invalid stimulus pattern `02`", "02"),
            (2, "0*1", "invalid stimulus pattern `0`", "0"),
            (2, "é*1", "invalid stimulus pattern `é`", "é"),
            (2, "00*0", "the duration `0` is too short", "0"),
            (2, "00*0steps", "the duration `0steps` is too short", "0steps"),
            (2, "00*", "the duration `` is too short", ""),
            (2, "00", "missing duration after `00`", "00"),
            (2, "00*-1", "`-1` is not a duration", "-1"),
            (2, "00*10s", "`10s` is not a duration", "10s"),
            (2, "", "the schedule is empty", ""),
            (2, &format!("00*{long}"), &format!("the duration `{long}` is too long"), &long),
        ] {
            assert_eq!(read(stimuli, text), Err(vec![(message.to_owned(), place.to_owned())]));
        }
        assert_eq!(read(2, "02*1 00*0").unwrap_err().len(), 2, "every error is reported");
        let total = read(2, &"00*100000 ".repeat(2)).unwrap_err();
        assert_eq!(total[0].0, "the schedule of 16800000 env steps is too long");
    }

    #[test]
    fn entries_of_images_show_whole_sets_and_number_them() {
        let size = ImageSize::new(1, 2);
        let image = |values: [f64; 2]| Arc::new(Image::new(size, values.to_vec()).unwrap());
        let images = [image([0.0, 1.0]), image([1.0, 0.0]), image([0.5, 0.5])];
        let set = |name: &str, images: &[Arc<Image>]| NamedImages {
            name: name.to_owned(),
            stimulus: 0,
            images: images.to_vec(),
        };
        let sets = [set("ends", &images[..2]), set("middle", &images[2..])];
        let read = |text: &str, size| read_image_schedule("--schedule", text, &sets, size);
        let found = read("middle*3steps ends*1", size).unwrap();
        let spell = |number, image: &Arc<Image>, steps| Spell {
            image: Some(image.clone()),
            ..Spell::of(Schedule::of_set(number), steps)
        };
        let expected = [spell(0, &images[2], 3), spell(1, &images[0], 84), spell(1, &images[1], 84)];
        assert_eq!((found.schedule.spells, found.sets), (expected.to_vec(), vec!["middle".into(), "ends".into()]));
        let check = |text: &str, size, expected: &str| {
            let faults = read(text, size).unwrap_err();
            assert_eq!(faults.list.into_iter().map(|fault| fault.message).collect::<Vec<_>>(), [expected]);
        };
        check("end*1", size, "no set of images is called `end`");
        check("00*1", size, "no set of images is called `00`");
        check("ends*0", size, "the duration `0` is too short");
        check("ends*1", ImageSize::new(2, 1), "the images `ends` have 1 x 2 pixels");
        // Two images of six million env steps each.
        check("ends*6000000steps", size, "the schedule of 12000000 env steps is too long");
        let five: Vec<NamedImages> = (0..5).map(|i| set(&format!("s{i}"), &images[..1])).collect();
        let faults = read_image_schedule("", "s0*1 s1*1 s2*1 s3*1 s4*1", &five, size).unwrap_err();
        assert_eq!(faults.list[0].message, "the schedule shows too many sets of images");
    }
}
