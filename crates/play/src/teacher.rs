//! The teacher's page: its own address, from which nothing but the members of the class and the lessons can be had.

use axum::extract::Request;
use axum::http::{Method, StatusCode, header};
use axum::response::{IntoResponse, Response};

use serde::Serialize;

use crate::class::Class;
use crate::lessons;
use crate::message::{ClassCourse, ClassLesson, LessonEntry};
use crate::served::Served;

/// Answers a request to the address of the teacher's page.
pub(super) fn answer(served: &Served, class: &Class, request: &Request) -> Response {
    if request.method() != Method::GET {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    match request.uri().path().split('/').nth(2) {
        Some("") => served.page.teacher(request.headers()),
        Some("members") => json(&class.roll()),
        Some("lessons") => json(&course(served)),
        Some(name) => {
            let part = served.page.part_of_teacher(name, request.headers());
            part.unwrap_or_else(|| StatusCode::NOT_FOUND.into_response())
        }
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

fn json(value: &impl Serialize) -> Response {
    let text = serde_json::to_string(value).expect("messages are data");
    ([(header::CONTENT_TYPE, "application/json")], text).into_response()
}

/// The lessons, with their tasks.
fn course(served: &Served) -> ClassCourse {
    // The programs are not checked: this must not take long.
    let lessons = lessons::load(&served.lessons, None).lessons;
    let lesson = |lesson: LessonEntry| ClassLesson {
        name: lesson.name,
        title: lesson.title,
        steps: lesson.steps.into_iter().map(|step| step.task).collect(),
    };
    ClassCourse { lessons: lessons.into_iter().map(lesson).collect() }
}
