//! Materials and schedules over time.

use crate::files::Files;
use crate::hover::picture::image;
use nbc_session::report;

pub(super) fn material(files: &Files<'_>, name: &str, pictures: bool) -> Option<String> {
    let material = files.checked.program.materials.iter().find(|material| material.name == name)?;
    let curve = report::draw_response(material).filter(|_| pictures);
    let picture = curve.map_or(String::new(), |svg| format!("\n\n{}", image(name, &svg)));
    Some(format!("{}{picture}", report::describe_material(material)))
}

pub(super) fn schedule(files: &Files<'_>, name: &str, pictures: bool) -> Option<String> {
    let program = &files.checked.program;
    let found = program.schedule(name).filter(|found| pictures && found.sets.is_empty())?;
    let stimuli: Vec<_> = found.stimuli.iter().map(|&at| (at, program.stimuli[at].as_str())).collect();
    Some(image(name, &report::draw_schedule(name, &found.schedule, &stimuli)))
}
