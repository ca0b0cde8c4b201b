//! Escapes users' text before it reaches a terminal: characters that would control it or change the reading order are
//! shown as codes.

use std::borrow::Cow;

/// Whether a character has an effect other than its own glyph. Line breaks are excluded.
pub fn is_hidden(c: char) -> bool {
    let reorders = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let breaks = matches!(c, '\u{2028}' | '\u{2029}');
    let empty = matches!(c, '\u{200b}' | '\u{2060}' | '\u{feff}');
    c != '\n' && c.is_control() || reorders || breaks || empty
}

/// Text with its control characters, escape sequences and bidirectional controls written out, as in `\u{1b}`.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| if is_hidden(c) { c.escape_unicode().collect() } else { String::from(c) };
    Cow::Owned(text.chars().map(shown).collect())
}

/// `nats://me:secret@host,nats://other` becomes `nats://host,nats://other`. Passwords may contain `,` and `@`.
pub fn without_passwords(addresses: &str) -> String {
    let mut shown: Vec<String> = Vec::new();
    for part in addresses.split(',') {
        match shown.last_mut() {
            Some(address) if !part.contains("://") => *address += &format!(",{part}"),
            _ => shown.push(part.to_owned()),
        }
    }
    for address in &mut shown {
        if let Some((before, host)) = address.rsplit_once('@').filter(|(before, _)| before.contains(':')) {
            let scheme = before.split_once("://").map_or_else(String::new, |(scheme, _)| format!("{scheme}://"));
            *address = format!("{scheme}{host}");
        }
    }
    shown.join(",")
}

/// Like [`visible`], but the offset of every byte stays the same, for excerpts with places in them.
#[cfg(feature = "render")]
pub(super) fn visible_in_place(text: &str) -> Cow<'_, str> {
    if !text.contains(|c| is_hidden(c) && c != '\t') {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '\r' if characters.peek() == Some(&'\n') => shown.push(' '),
            '\r' => shown.push('\n'),
            _ if is_hidden(c) && c != '\t' => shown.push(['?', '·', '\u{fffd}'][c.len_utf8() - 1]),
            _ => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped() {
        assert_eq!(visible("gate \u{1b}[32mpass\u{7}\r\n"), "gate \\u{1b}[32mpass\\u{7}\\u{d}\n");
        assert_eq!(visible("\u{9b}2J \u{202e}ssap"), "\\u{9b}2J \\u{202e}ssap");
        assert!(matches!(visible("größe →\n"), Cow::Borrowed(_)));
    }

    #[test]
    fn passwords_of_addresses_are_not_shown() {
        for (addresses, shown) in [
            ("nats://me:secret@host:4222", "nats://host:4222"),
            ("--nats=nats://me:secret@host", "--nats=nats://host"),
            ("me:secret@host", "host"),
            ("nats://a:b@h,nats://c:d@i:1,j", "nats://h,nats://i:1,j"),
            ("nats://me:p@ss,w:/o r,d@host", "nats://host"),
            ("nats://token@host", "nats://host"),
            ("tls://host:4222", "tls://host:4222"),
            ("h:1,c:d@i", "i"),
            ("me@host", "me@host"),
        ] {
            assert_eq!(without_passwords(addresses), shown);
        }
    }

    #[cfg(feature = "render")]
    #[test]
    fn escaping_excerpts_keeps_byte_offsets() {
        let text = "a\u{1b}b\u{9b}c\u{202e}d\te\r\nf\rg";
        let shown = visible_in_place(text);
        assert_eq!(shown, "a?b·c\u{fffd}d\te \nf\ng");
        assert_eq!(shown.len(), text.len());
    }
}
