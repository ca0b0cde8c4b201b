//! Films, decoded frame by frame.

use std::cell::Cell;
use std::io::{self, Write};
use std::rc::Rc;

use nbc_base::model::{Body, CYCLE_STEPS, GroundProfile, Palette, Pattern, Schedule, Setting, Spell};
use nbc_session::report::{self, Color, FRAMES_PER_CYCLE, Film, Scheme, Stage};

use crate::support::traces::latch;

const WALKER: [&str; 5] = ["66666", "46666", "44444", "44404", "44005"];

fn schedule(cycles: u32) -> Schedule {
    Schedule { spells: vec![Spell::of(Pattern::PAIRS[1], cycles * 84)] }
}

fn film(body: &Body, cycles: u32) -> (Film, Stage) {
    let stage = Stage::of_trial(&Setting::default(), body, &schedule(cycles), CYCLE_STEPS / FRAMES_PER_CYCLE);
    let largest = body.width().max(body.height());
    (
        Film {
            title: "walker".to_owned(),
            lanes: vec!["01".to_owned()],
            scheme: Scheme::Paper,
            largest,
            stimuli: 2,
            ground: GroundProfile::default(),
        },
        stage,
    )
}

fn gif_bytes(body: &Body, cycles: u32) -> Vec<u8> {
    let (film, stage) = film(body, cycles);
    let mut bytes = Vec::new();
    report::write_gif(&film, stage, &mut bytes, &mut |_| ()).unwrap();
    bytes
}

/// The complete frames of a GIF as color indices, each drawn over the previous one, with the palette.
fn decode_gif(bytes: &[u8]) -> (Vec<Vec<u8>>, Vec<u8>) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    let mut decoder = options.read_info(bytes).unwrap();
    let palette = decoder.global_palette().unwrap().to_vec();
    let row = usize::from(decoder.width());
    let mut picture = vec![0; row * usize::from(decoder.height())];
    let mut pictures = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        for (y, line) in frame.buffer.chunks(usize::from(frame.width)).enumerate() {
            let start = (usize::from(frame.top) + y) * row + usize::from(frame.left);
            put_over(&mut picture[start..start + line.len()], line);
        }
        pictures.push(picture.clone());
    }
    (pictures, palette)
}

/// Draws pixels over the previous frame; the last color index is transparent.
fn put_over(picture: &mut [u8], line: &[u8]) {
    for (pixel, &new) in picture.iter_mut().zip(line) {
        *pixel = if new == 255 { *pixel } else { new };
    }
}

#[test]
fn a_gif_has_twelve_frames_a_cycle_and_the_robot_moves() {
    let body = Body::parse(&WALKER, &Palette::paper()).unwrap();
    let bytes = gif_bytes(&body, 2);
    let (pictures, palette) = decode_gif(&bytes);
    assert_eq!(pictures.len(), 2 * 12 + 1);
    let teal = Scheme::Paper.color(4);
    let number = palette.chunks(3).position(|rgb| rgb == [teal.r, teal.g, teal.b]).unwrap() as u8;
    let area = |picture: &Vec<u8>| picture.iter().filter(|&&pixel| pixel == number).count();
    assert!(pictures.iter().all(|picture| area(picture) > 800), "the muscles are in every frame");
    assert!(pictures.windows(2).all(|pair| pair[0] != pair[1]), "every frame differs from the one before");
    assert_eq!(gif_bytes(&body, 2), bytes, "the same film has the same bytes");
}

#[test]
fn an_apng_shows_the_same_film() {
    let body = Body::parse(&WALKER, &Palette::paper()).unwrap();
    let (film, stage) = film(&body, 1);
    let mut bytes = Vec::new();
    report::write_apng(&film, stage, &mut bytes, &mut |_| ()).unwrap();
    let (pictures, palette) = decode_gif(&gif_bytes(&body, 1));
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().unwrap();
    assert_eq!(reader.info().animation_control.unwrap().num_frames as usize, pictures.len());
    assert_eq!(Some(palette.as_slice()), reader.info().palette.as_deref());
    let row = reader.info().width as usize;
    let mut picture = vec![0; row * reader.info().height as usize];
    for (i, expected) in pictures.iter().enumerate() {
        let mut patch = vec![0; reader.output_buffer_size().unwrap()];
        let shape = reader.next_frame(&mut patch).unwrap();
        let place = *reader.info().frame_control().unwrap();
        assert_eq!((place.width, place.height, place.blend_op), (shape.width, shape.height, png::BlendOp::Over));
        for (y, line) in patch.chunks(shape.line_size).take(shape.height as usize).enumerate() {
            let start = (place.y_offset as usize + y) * row + place.x_offset as usize;
            put_over(&mut picture[start..start + line.len()], line);
        }
        assert!(picture == *expected, "frame {i} is that of the GIF");
    }
}

struct Counter(Rc<Cell<usize>>);

impl Write for Counter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.set(self.0.get() + bytes.len());
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn frames_are_written_as_they_are_made() {
    let body = Body::parse(&WALKER, &Palette::paper()).unwrap();
    for write in [report::write_gif, report::write_apng] {
        let (film, stage) = film(&body, 3);
        let written = Rc::new(Cell::new(0));
        let mut sizes = Vec::new();
        write(&film, stage, &mut Counter(written.clone()), &mut |_| sizes.push(written.get())).unwrap();
        assert_eq!(sizes.len(), 3 * 12 + 1);
        assert!(sizes.windows(2).all(|pair| pair[1] > pair[0]), "no frame is held back: {sizes:?}");
    }
}

#[test]
fn a_swarm_walks_in_lanes_beside_its_stimuli() {
    let trace = latch(&[(false, true), (true, true)], 2);
    let assembly = crate::page::assembly(&trace);
    let lanes: Vec<String> = trace.robots.iter().map(|robot| robot.net.clone()).collect();
    let film = Film {
        title: "latch".to_owned(),
        lanes,
        scheme: Scheme::Paper,
        largest: 5,
        stimuli: 2,
        ground: GroundProfile::default(),
    };
    let stage = Stage::of_swarm(&assembly, &trace, CYCLE_STEPS);
    let mut bytes = Vec::new();
    report::write_gif(&film, stage, &mut bytes, &mut |_| ()).unwrap();
    let width = usize::from(gif::Decoder::new(bytes.as_slice()).unwrap().width());
    let (pictures, palette) = decode_gif(&bytes);
    assert_eq!(pictures.len(), 4 + 1);
    let number = |color: Color| palette.chunks(3).position(|rgb| rgb == [color.r, color.g, color.b]).unwrap() as u8;
    let count = |picture: &[u8], color: u8, columns: std::ops::Range<usize>| {
        picture.chunks(width).flat_map(|row| &row[columns.clone()]).filter(|&&pixel| pixel == color).count()
    };
    let [one, two, ground] = [Color::stimulus(0), Color::stimulus(1), Color::GROUND].map(number);
    for (picture, cycle) in pictures.iter().zip(&trace.cycles) {
        for (i, color) in [one, two].into_iter().enumerate() {
            // A frame of two pixels around twelve by twelve, which are filled while the stimulus is present.
            let present = cycle.sensed.iter().filter(|sensed| sensed.has(i)).count();
            assert_eq!(count(picture, color, 0..60), 5 * (16 * 16 - 12 * 12) + present * 12 * 12);
        }
        // Far from the robots, whose edges may have any color; ticks cover some columns.
        let column = (width - 20..width).map(|x| count(picture, ground, x..x + 1)).max().unwrap();
        assert_eq!(column, 5 * 9, "five lanes stand on ground nine pixels deep");
    }
}

#[test]
fn a_fault_stops_the_robot_and_not_the_film() {
    let body = Body::parse(&["57070", "73873", "00304", "00001", "00861"], &Palette::paper()).unwrap();
    let setting = Setting { world_width: 60, start_x: Some(28), ..Setting::default() };
    let schedule = Schedule { spells: vec![Spell::of(Pattern::PAIRS[3], 60), Spell::of(Pattern::PAIRS[0], 60)] };
    let moments: Vec<_> = Stage::of_trial(&setting, &body, &schedule, 7).collect();
    assert_eq!(moments.len(), 120 / 7 + 1);
    let broken = moments.iter().position(|moment| moment.faults[0]).unwrap();
    assert_eq!(broken, 72usize.div_ceil(7));
    assert_eq!(moments[broken].poses, moments.last().unwrap().poses);
    let (film, _) = film(&body, 1);
    report::write_gif(&film, Stage::of_trial(&setting, &body, &schedule, 7), &mut Vec::new(), &mut |_| ()).unwrap();
}

#[test]
fn an_empty_schedule_gives_one_frame() {
    let body = Body::parse(&["33"], &Palette::paper()).unwrap();
    let (film, _) = film(&body, 1);
    let stage = Stage::of_trial(&Setting::default(), &body, &Schedule::default(), CYCLE_STEPS / FRAMES_PER_CYCLE);
    let mut bytes = Vec::new();
    report::write_gif(&film, stage, &mut bytes, &mut |_| ()).unwrap();
    assert_eq!(decode_gif(&bytes).0.len(), 1);
}

#[test]
fn a_strip_has_a_row_for_each_pattern_with_ghosts() {
    let body = Body::parse(&WALKER, &Palette::paper()).unwrap();
    let spells = [0, 3].map(|i| Spell::of(Pattern::PAIRS[i], 2 * 84));
    let svg = report::draw_strip("walker", &body, &Schedule { spells: spells.to_vec() }, Scheme::Safe).finish();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let voxels = |ghost: bool| {
        let polygons = document.descendants().filter(|node| node.has_tag_name("polygon"));
        polygons.filter(|node| node.has_attribute("opacity") == ghost).count()
    };
    let filled = body.codes().iter().filter(|&&code| code > 0).count();
    assert_eq!(voxels(false), 2 * 7 * filled);
    assert_eq!(voxels(true), 2 * 2 * 7 * filled);
    let texts: Vec<_> =
        document.descendants().filter(|node| node.has_tag_name("text")).filter_map(|node| node.text()).collect();
    assert_eq!([texts[0], texts[2], texts[4]], ["walker", "00", "11"]);
    assert!(texts[3].starts_with('\u{2212}'), "a true minus, as on axes: {}", texts[3]);
    let walked = [texts[3], texts[5]].map(|text| text.replace('\u{2212}', "-").parse::<f64>().unwrap());
    assert!(walked[0] < -1.0 && walked[1] > 0.5, "voxels walked under each pattern: {walked:?}");
}
