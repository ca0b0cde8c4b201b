//! What the server answers: the page, its two web sockets, and its downloads. Every address begins with the token.

use std::sync::Arc;

use percent_encoding::percent_decode_str;
use tungstenite::handshake::server::{Request, create_response, write_response};
use tungstenite::http::{HeaderMap, HeaderValue, StatusCode, header};

use crate::connections::SharedStream;
use crate::http::{self, HttpAnswer, PATIENCE, content, status};
use crate::served::Served;
use crate::{language, live, teacher};

const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: \
                      blob:; connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'none'";

/// It reloads itself, because a page that was just closed may still be counted.
const FULL: &str = "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
                    <meta http-equiv=\"refresh\" content=\"5\">\n<title>nbc is full</title>\n\
                    <h1>This server has no room for another page</h1>\n\
                    <p>Close a page of it that nobody uses. This one tries again every five seconds.</p>\n";

pub(super) fn answer(served: &Arc<Served>, wire: SharedStream) {
    // Small messages are not delayed.
    let _ = wire.stream().set_nodelay(true);
    let (request, rest) = match http::read(&wire, PATIENCE) {
        Ok(read) => read,
        Err(Some(refusal)) => return http::write(wire, secured(status(refusal))),
        Err(None) => return,
    };
    let path = request.uri().path().split('/').skip(1).collect::<Vec<_>>();
    let (known, taught) = (served.knows(path[0]), served.taught(path[0]));
    // The request target may name a host, too.
    let is_here = request.uri().authority().is_none_or(|host| served.is_own(host.as_str()));
    let answer = match (known || taught.is_some(), is_here && served.trusts(request.headers())) {
        (true, true) => match (taught, &path[1..]) {
            (Some(class), _) => teacher::answer(served, class, &request),
            (None, ["live"]) => return socket(served, &request, wire, rest, live::serve),
            (None, ["language"]) => return socket(served, &request, wire, rest, language::serve),
            (None, path) => resource(served, path, request.headers()),
        },
        (false, _) => status(StatusCode::NOT_FOUND),
        (true, false) => status(StatusCode::FORBIDDEN),
    };
    http::write(wire, secured(answer));
}

fn resource(served: &Served, path: &[&str], headers: &HeaderMap) -> HttpAnswer {
    let found = match path {
        [""] if served.is_full() => {
            let mut full = content("text/html; charset=utf-8", FULL);
            *full.status_mut() = StatusCode::SERVICE_UNAVAILABLE;
            Some(full)
        }
        [""] => Some(served.page.own.html.answer(headers)),
        ["take", number, name] => take(served, number, name),
        [name] => Some(served.page.own.part(name, headers)),
        _ => None,
    };
    found.unwrap_or_else(|| status(StatusCode::NOT_FOUND))
}

fn take(served: &Served, number: &str, name: &str) -> Option<HttpAnswer> {
    let name = percent_decode_str(name).decode_utf8().ok()?;
    let take = served.threads.takes.fetch(number.parse().ok()?, &name)?;
    let mut answer = content(take.kind, take.bytes);
    answer.headers_mut().insert(header::CONTENT_DISPOSITION, HeaderValue::from_static("attachment"));
    Some(answer)
}

fn secured(mut answer: HttpAnswer) -> HttpAnswer {
    let headers = answer.headers_mut();
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    // What may be kept says so itself.
    headers.entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    for name in ["cross-origin-opener-policy", "cross-origin-resource-policy"] {
        headers.insert(name, HeaderValue::from_static("same-origin"));
    }
    answer
}

fn socket(
    served: &Arc<Served>,
    request: &Request,
    mut wire: SharedStream,
    rest: Vec<u8>,
    serve: impl FnOnce(&Arc<Served>, SharedStream, Vec<u8>),
) {
    let Ok(accepted) = create_response(request) else {
        return http::write(wire, secured(status(StatusCode::BAD_REQUEST)));
    };
    let opened = wire.clone();
    let is_served = served.with_place(|| {
        opened.becomes_socket();
        if write_response(&mut wire, &accepted).is_ok() {
            serve(served, wire.clone(), rest);
        }
    });
    if !is_served {
        http::write(opened, secured(status(StatusCode::SERVICE_UNAVAILABLE)));
    }
}
