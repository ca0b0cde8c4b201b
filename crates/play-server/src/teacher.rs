//! The teacher's page. Its address gives access to the members of the class and to the lessons only.

use axum::extract::Request;
use axum::http::{Method, StatusCode, header};
use axum::response::{IntoResponse, Response};

use serde::Serialize;

use crate::served::Served;
use nbc_play::{Class, course};

pub(super) fn answer(served: &Served, class: &Class, request: &Request) -> Response {
    if request.method() != Method::GET {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    match request.uri().path().split('/').nth(2) {
        Some("") => served.page.teacher.html.answer(request.headers()),
        Some("members") => json(&class.roll(served.now())),
        Some("lessons") => json(&course(served.site.shell.lessons())),
        Some(name) => served.page.teacher.part(name, request.headers()),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

fn json(value: &impl Serialize) -> Response {
    let text = serde_json::to_string(value).expect("messages are data");
    ([(header::CONTENT_TYPE, "application/json")], text).into_response()
}
