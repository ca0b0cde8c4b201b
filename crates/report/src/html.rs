//! The common parts of all pages. A page is one file that loads nothing, follows the reader's theme, and contains its
//! data and scripts.
//!
//! Pages are written as text, not with a template crate such as `maud`: their markup is a few elements around drawings,
//! tables and scripts, and every text of a user passes [`escape`].

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use crate::svg::Svg;

const STYLE: &str = include_str!("../page/report.css");

pub struct Html<'a> {
    pub heading: &'a str,
    pub passed: bool,
    pub verdict: String,
    pub body: String,
    /// A script, and its data as JSON.
    pub script: Option<(&'static str, String)>,
}

impl Html<'_> {
    pub fn finish(self) -> String {
        let (heading, verdict, version) = (escape(self.heading), escape(&self.verdict), nbc_base::VERSION);
        let class = if self.passed { "pass" } else { "fail" };
        let script = self.script.map_or(String::new(), |(script, data)| {
            format!("<script id=\"data\" type=\"application/json\">{data}</script>\n<script>\n{script}\n</script>\n")
        });
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; \
             script-src 'unsafe-inline'; img-src data:\">\n\
             <title>{heading}: {verdict}</title>\n<link rel=\"icon\" \
             href=\"data:,\">\n<style>\n{STYLE}\n</style>\n</head>\n<body>\n<main>\n\
             <h1>{heading}</h1>\n<p class=\"verdict {class}\">{verdict}</p>\n{body}\
             <footer class=\"dim\"><p>made by nbc {version}</p></footer>\n</main>\n\
             {script}</body>\n</html>\n",
            body = self.body,
        )
    }
}

pub fn page_json(data: &impl Serialize) -> String {
    // No text of the user's can end the element.
    serde_json::to_string(data).expect("data of pages are data").replace('<', "\\u003c")
}

pub fn controls(speed: &str) -> String {
    let option = |value: &str| {
        let chosen = if value == speed { " selected" } else { "" };
        format!("<option{chosen}>{value}</option>")
    };
    let speeds: String = ["0.5", "1", "2", "4", "8"].map(option).concat();
    format!(
        "<div class=\"controls\"><button type=\"button\" class=\"play\">Play</button>\
         <input type=\"range\" class=\"scrub\" min=\"0\" step=\"0.05\" value=\"0\" aria-label=\"time in cycles\">\
         <label>cycles a second <select class=\"speed\">{speeds}</select></label><output \
         class=\"clock\"></output></div>\n"
    )
}

/// Identities are removed, because several drawings may use the same ones.
pub fn picture(svg: &Svg, label: &str) -> String {
    let svg = embedded(svg);
    format!(
        "<div class=\"scroll picture\" tabindex=\"0\" role=\"group\" aria-label=\"{}\">{svg}</div>\n",
        escape(label)
    )
}

pub fn embedded(svg: &Svg) -> String {
    svg.finish().replace("<g id=\"", "<g data-id=\"")
}

pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

pub fn base64(numbers: &[i16]) -> String {
    STANDARD.encode(numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;

    #[test]
    fn stimuli_have_the_colors_of_all_pictures() {
        for i in 0..3 {
            let color = format!("--s{}: {};", i + 1, Color::stimulus(i));
            assert!(STYLE.contains(&color), "{color}");
        }
    }

    #[test]
    fn numbers_have_their_lower_byte_first() {
        assert_eq!(base64(&[1, -2]), "AQD+/w==");
    }
}
