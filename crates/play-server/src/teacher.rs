//! The teacher's page: its own address, from which nothing but the members of the class and the lessons can be had.

use serde::Serialize;
use tungstenite::handshake::server::Request;
use tungstenite::http::StatusCode;

use crate::http::{HttpAnswer, content, status};
use crate::served::Served;
use nbc_play::{Class, course};

pub(super) fn answer(served: &Served, class: &Class, request: &Request) -> HttpAnswer {
    match request.uri().path().split('/').nth(2) {
        Some("") => served.page.teacher.html.answer(request.headers()),
        Some("members") => json(&class.roll(served.now())),
        Some("lessons") => json(&course(served.site.shell.lessons())),
        Some(name) => served.page.teacher.part(name, request.headers()),
        None => status(StatusCode::NOT_FOUND),
    }
}

fn json(value: &impl Serialize) -> HttpAnswer {
    content("application/json", serde_json::to_vec(value).expect("messages are data"))
}
