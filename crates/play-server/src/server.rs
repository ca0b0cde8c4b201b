//! The routes of the server: the page, its two web sockets, and its downloads.

use std::sync::Arc;

use axum::Router;
use axum::extract::ws::{WebSocket, WebSocketUpgrade};
use axum::extract::{Path, Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{any, get};

use crate::served::Served;
use crate::{language, live, teacher};
use nbc_base::budget::Limit;

/// The content security policy: a page may load and connect to this server only.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: \
                      blob:; connect-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'none'";

/// Sent while too many pages are open. It reloads itself, because a page that was just closed may still be counted.
const FULL: &str = "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
                    <meta http-equiv=\"refresh\" content=\"5\">\n<title>nbc is full</title>\n\
                    <h1>This server has no room for another page</h1>\n\
                    <p>Close a page of it that nobody uses. This one tries again every five seconds.</p>\n";

/// Every address begins with the token.
pub(super) fn router(served: Arc<Served>) -> Router {
    Router::new()
        .route("/{token}/", get(document))
        .route("/{token}/{name}", get(part))
        .route("/{token}/live", any(|State(served), upgrade| accept(served, upgrade, live::serve)))
        .route("/{token}/language", any(|State(served), upgrade| accept(served, upgrade, language::serve)))
        .route("/{token}/take/{number}/{name}", get(take))
        .layer(middleware::from_fn_with_state(served.clone(), guard))
        .with_state(served)
}

async fn document(State(served): State<Arc<Served>>, headers: HeaderMap) -> Response {
    if served.is_full() {
        return (StatusCode::SERVICE_UNAVAILABLE, Html(FULL)).into_response();
    }
    served.page.own.html.answer(&headers)
}

async fn part(
    State(served): State<Arc<Served>>,
    Path((_, name)): Path<(String, String)>,
    headers: HeaderMap,
) -> Response {
    served.page.own.part(&name, &headers)
}

/// Refuses requests without the token, or from another host or origin, and adds security headers to answers.
async fn guard(State(served): State<Arc<Served>>, request: Request, next: Next) -> Response {
    let token = request.uri().path().split('/').nth(1).unwrap_or_default();
    let (known, taught) = (served.knows(token), served.taught(token));
    // A target may name a host, too.
    let is_here = request.uri().authority().is_none_or(|host| served.is_own(host.as_str()));
    let mut response = match (known || taught.is_some(), is_here && served.trusts(request.headers())) {
        (true, true) => match taught {
            Some(class) => teacher::answer(&served, class, &request),
            None => next.run(request).await,
        },
        (false, _) => StatusCode::NOT_FOUND.into_response(),
        (true, false) => StatusCode::FORBIDDEN.into_response(),
    };
    let headers = [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
    ];
    for (name, value) in headers {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    // What may be kept says so itself.
    response.headers_mut().entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
    for name in ["cross-origin-opener-policy", "cross-origin-resource-policy"] {
        response.headers_mut().insert(name, HeaderValue::from_static("same-origin"));
    }
    response
}

async fn accept<F: Future<Output = ()> + Send + 'static>(
    served: Arc<Served>,
    upgrade: WebSocketUpgrade,
    serve: impl FnOnce(Arc<Served>, WebSocket) -> F + Send + 'static,
) -> Response {
    let Ok(place) = served.sockets.clone().try_acquire_owned() else {
        return StatusCode::SERVICE_UNAVAILABLE.into_response();
    };
    let most = Limit::PageMessage.most() as usize;
    upgrade.max_message_size(most).max_frame_size(most).on_upgrade(async move |socket| {
        serve(served, socket).await;
        drop(place);
    })
}

async fn take(State(served): State<Arc<Served>>, Path((_, number, name)): Path<(String, u64, String)>) -> Response {
    let Some(take) = served.threads.takes.fetch(number, &name) else { return StatusCode::NOT_FOUND.into_response() };
    let mut headers = HeaderMap::new();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(take.kind));
    headers.insert(header::CONTENT_DISPOSITION, HeaderValue::from_static("attachment"));
    (headers, take.bytes).into_response()
}
