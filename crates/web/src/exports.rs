//! The functions that a script calls, for one tab. A script passes text as bytes in room that it has asked for, which
//! is given back by the function that takes it, and reads the parts of the present message where they are.
#![expect(unsafe_code, reason = "the memory of a script's texts, and the names of exported functions")]

use std::cell::RefCell;

use core::time::Duration;

use crate::parts;
use crate::tab::{Tab, TabMessage};
use nbc_play::PageMessage;

#[derive(Default)]
struct State {
    tab: Option<Tab>,
    /// The parts of the present message.
    parts: [Vec<u8>; 3],
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
}

fn with_tab<T>(call: impl FnOnce(&mut Tab) -> T) -> T {
    STATE.with_borrow_mut(|state| call(state.tab.as_mut().expect("`begin` was called")))
}

/// A time of the script's clock, in milliseconds.
fn time(milliseconds: f64) -> Duration {
    Duration::try_from_secs_f64(milliseconds / 1000.0).unwrap_or_default()
}

/// The bytes in room of [`room`].
fn bytes(place: *mut u8, length: usize) -> Box<[u8]> {
    // SAFETY: a script passes what `room` has returned for this length, once.
    unsafe { Box::from_raw(core::ptr::slice_from_raw_parts_mut(place, length)) }
}

fn text(place: *mut u8, length: usize) -> String {
    String::from_utf8_lossy(&bytes(place, length)).into_owned()
}

#[cfg(target_family = "wasm")]
mod page {
    #[link(wasm_import_module = "page")]
    unsafe extern "C" {
        /// Shows the message of a panic.
        pub(super) safe fn fail(place: *const u8, length: usize);
    }
}

/// Begins a tab without files, whose page opens a file first unless its path is empty.
#[unsafe(no_mangle)]
extern "C" fn begin(first: *mut u8, length: usize, now: f64) {
    let first = Some(text(first, length)).filter(|first| !first.is_empty());
    #[cfg(target_family = "wasm")]
    std::panic::set_hook(Box::new(|about| {
        let message = about.to_string();
        page::fail(message.as_ptr(), message.len());
    }));
    STATE.with_borrow_mut(|state| state.tab = Some(Tab::new(first, time(now))));
}

/// Room for a text of `length` bytes.
#[unsafe(no_mangle)]
extern "C" fn room(length: usize) -> *mut u8 {
    Box::into_raw(vec![0_u8; length].into_boxed_slice()).cast()
}

#[unsafe(no_mangle)]
extern "C" fn insert(path: *mut u8, path_length: usize, place: *mut u8, length: usize) {
    let (path, contents) = (text(path, path_length), bytes(place, length));
    with_tab(|tab| tab.insert(&path, &contents));
}

#[unsafe(no_mangle)]
extern "C" fn remove(path: *mut u8, length: usize) {
    let path = text(path, length);
    with_tab(|tab| tab.remove(&path));
}

#[unsafe(no_mangle)]
extern "C" fn template(place: *mut u8, length: usize) {
    let text = text(place, length);
    with_tab(|tab| tab.set_template(&text));
}

#[unsafe(no_mangle)]
extern "C" fn crew(size: usize) {
    with_tab(|tab| tab.set_crew(size));
}

#[unsafe(no_mangle)]
extern "C" fn receive_part(number: usize, place: *mut u8, length: usize) {
    let result = bytes(place, length);
    with_tab(|tab| tab.receive_part(number, &result));
}

/// Does a part of a simulation for another tab. What became of it is then the first part of the present message.
#[unsafe(no_mangle)]
extern "C" fn simulate(place: *mut u8, length: usize) {
    let result = parts::performed(&bytes(place, length)).expect("a part comes from the same program");
    STATE.with_borrow_mut(|state| state.parts[0] = result);
}

#[unsafe(no_mangle)]
extern "C" fn receive(place: *mut u8, length: usize, now: f64) {
    let text = text(place, length);
    with_tab(|tab| tab.receive(&text, time(now)));
}

#[unsafe(no_mangle)]
extern "C" fn greet() {
    with_tab(Tab::greet);
}

#[unsafe(no_mangle)]
extern "C" fn receive_language(place: *mut u8, length: usize, now: f64) {
    let text = text(place, length);
    with_tab(|tab| tab.receive_language(&text, time(now)));
}

/// [`Tab::advance`]; milliseconds until there is more to do.
#[unsafe(no_mangle)]
extern "C" fn advance(now: f64) -> f64 {
    with_tab(|tab| tab.advance(time(now)).as_secs_f64() * 1000.0)
}

/// [`Tab::next`]: makes the next message the present one. Returns its kind: 0 for none, 1 for a text and 2 for a frame
/// for the page, 3 for a text of the language service, 4 for a file that was written (path, text), 5 for one to fetch
/// (address, media type, bytes), 6 for a part of a simulation (number, bytes).
#[unsafe(no_mangle)]
extern "C" fn next(has_room: bool) -> u32 {
    let message = with_tab(|tab| tab.next(has_room));
    let (kind, parts) = match message {
        None => (0, [Vec::new(), Vec::new(), Vec::new()]),
        Some(TabMessage::Page(PageMessage::Text(text))) => (1, [text.into_bytes(), Vec::new(), Vec::new()]),
        Some(TabMessage::Page(PageMessage::Frame(frame))) => (2, [frame, Vec::new(), Vec::new()]),
        Some(TabMessage::Language(text)) => (3, [text.into_bytes(), Vec::new(), Vec::new()]),
        Some(TabMessage::Written { path, text }) => (4, [path.into_bytes(), text.into_bytes(), Vec::new()]),
        Some(TabMessage::Part(number, part)) => (6, [number.to_string().into_bytes(), part, Vec::new()]),
        Some(TabMessage::Kept(file)) => (5, [file.address.into_bytes(), file.media_type.into(), file.bytes]),
    };
    STATE.with_borrow_mut(|state| state.parts = parts);
    kind
}

/// Where a part of the present message is.
#[unsafe(no_mangle)]
extern "C" fn part(number: usize) -> *const u8 {
    STATE.with_borrow(|state| state.parts[number].as_ptr())
}

/// The number of bytes of a part of the present message.
#[unsafe(no_mangle)]
extern "C" fn part_length(number: usize) -> usize {
    STATE.with_borrow(|state| state.parts[number].len())
}
