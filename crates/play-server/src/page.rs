//! The files of the page, which `web/` builds: those in the program, or those of a folder. Browsers cache scripts and
//! styles without limit, because their names contain a hash of their contents.

use std::borrow::Cow;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;
use tungstenite::http::{HeaderMap, HeaderValue, StatusCode, header};

use crate::http::{HttpAnswer, content, status};

const IMMUTABLE: HeaderValue = HeaderValue::from_static("private, max-age=31536000, immutable");

pub(super) struct Page {
    pub(super) own: Parts,
    pub(super) teacher: Parts,
}

pub(super) struct Parts {
    pub(super) html: PagePart,
    script: PagePart,
    style: PagePart,
}

pub(super) struct PagePart {
    name: String,
    kind: &'static str,
    text: Cow<'static, str>,
    packed: Vec<u8>,
}

impl Default for Page {
    fn default() -> Self {
        let own = Parts::new(
            ("app", include_str!("../page/index.html")),
            include_str!("../page/app.js").into(),
            include_str!("../page/app.css").into(),
        );
        let teacher = Parts::new(
            ("class", include_str!("../page/class.html")),
            include_str!("../page/class.js").into(),
            include_str!("../page/class.css").into(),
        );
        Self { own, teacher }
    }
}

impl Page {
    pub(super) fn of(folder: Option<&Path>) -> io::Result<Self> {
        let Some(folder) = folder else { return Ok(Self::default()) };
        let read = |name: &str| fs::read_to_string(folder.join(name));
        let own = Parts::new(("app", &read("index.html")?), read("app.js")?.into(), read("app.css")?.into());
        let teacher = ("class", &*read("class.html")?);
        Ok(Self { own, teacher: Parts::new(teacher, read("class.js")?.into(), read("class.css")?.into()) })
    }
}

impl Parts {
    /// The document names `STEM.js` and `STEM.css`.
    fn new((stem, html): (&str, &str), script: Cow<'static, str>, style: Cow<'static, str>) -> Self {
        let script = PagePart::new(hashed(stem, "js", &script), "text/javascript; charset=utf-8", script);
        let style = PagePart::new(hashed(stem, "css", &style), "text/css; charset=utf-8", style);
        let html = html.replace(&format!("\"{stem}.js\""), &format!("\"{}\"", script.name));
        let html = html.replace(&format!("\"{stem}.css\""), &format!("\"{}\"", style.name));
        Self { html: PagePart::new(String::new(), "text/html; charset=utf-8", html.into()), script, style }
    }

    pub(super) fn part(&self, name: &str, request: &HeaderMap) -> HttpAnswer {
        let part = [&self.script, &self.style].into_iter().find(|part| part.name == name);
        let Some(part) = part else { return status(StatusCode::NOT_FOUND) };
        let mut response = part.answer(request);
        response.headers_mut().insert(header::CACHE_CONTROL, IMMUTABLE);
        response
    }
}

impl PagePart {
    fn new(name: String, kind: &'static str, text: Cow<'static, str>) -> Self {
        let mut packing = GzEncoder::new(Vec::new(), Compression::default());
        packing.write_all(text.as_bytes()).expect("memory takes any bytes");
        Self { name, kind, packed: packing.finish().expect("memory takes any bytes"), text }
    }

    pub(super) fn answer(&self, request: &HeaderMap) -> HttpAnswer {
        let packs = accepts_gzip(request);
        let mut response = content(self.kind, if packs { &*self.packed } else { self.text.as_bytes() });
        let headers = response.headers_mut();
        headers.insert(header::VARY, HeaderValue::from_static("accept-encoding"));
        if packs {
            headers.insert(header::CONTENT_ENCODING, HeaderValue::from_static("gzip"));
        }
        response
    }
}

fn hashed(stem: &str, ending: &str, text: &str) -> String {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    format!("{stem}-{:016x}.{ending}", hasher.finish())
}

fn accepts_gzip(request: &HeaderMap) -> bool {
    let accepted = request.get(header::ACCEPT_ENCODING).and_then(|value| value.to_str().ok()).unwrap_or_default();
    accepted.split(',').map(|coding| coding.replace(' ', "")).any(|coding| {
        let (name, quality) = coding.split_once(";q=").unwrap_or((&coding, "1"));
        name == "gzip" && quality.parse::<f64>().is_ok_and(|quality| quality > 0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_text_has_another_name_and_the_document_names_it() {
        let page = |script: &'static str| Parts::new(("app", "<script src=\"app.js\">"), script.into(), "".into());
        let (one, two) = (page("a"), page("b"));
        assert_ne!(one.script.name, two.script.name);
        assert_eq!(one.html.text, format!("<script src=\"{}\">", one.script.name));
        assert_eq!(one.part("app.js", &HeaderMap::new()).status(), StatusCode::NOT_FOUND);
    }

    #[test]
    fn only_those_who_can_read_it_get_compressed_text() {
        let accepts =
            |text: &str| accepts_gzip(&[(header::ACCEPT_ENCODING, text.parse().unwrap())].into_iter().collect());
        assert!(accepts("br, gzip") && accepts("gzip;q=0.5") && accepts("gzip"));
        assert!(!accepts("br") && !accepts("gzip;q=0") && !accepts("") && !accepts_gzip(&HeaderMap::new()));
    }
}
