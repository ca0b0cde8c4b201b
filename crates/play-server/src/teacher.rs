//! The teacher's page. Its address gives access to the members of the class and to the lessons only.

use serde::Serialize;
use tungstenite::handshake::server::Request;
use tungstenite::http::StatusCode;

use crate::http::{HttpAnswer, content, status};
use crate::served::Served;
use nbc_play::{Class, course};

pub(super) fn answer(served: &Served, class: &Class, request: &Request) -> HttpAnswer {
    match request.uri().path().split('/').nth(2) {
        Some("") => served.page.teacher(request.headers()),
        Some("members") => json(&class.roll(served.now())),
        Some("lessons") => json(&course(served.site.shell.lessons())),
        Some(name) => {
            let part = served.page.part_of_teacher(name, request.headers());
            part.unwrap_or_else(|| status(StatusCode::NOT_FOUND))
        }
        None => status(StatusCode::NOT_FOUND),
    }
}

fn json(value: &impl Serialize) -> HttpAnswer {
    content("application/json", serde_json::to_vec(value).expect("messages are data"))
}
