//! Pictures inside Markdown.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use nbc_session::report::Svg;

pub(super) fn image(title: &str, svg: &Svg) -> String {
    format!("![{title}](data:image/svg+xml;base64,{})\n", STANDARD.encode(svg.finish()))
}
