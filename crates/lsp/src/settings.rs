//! The settings of a user.

use serde_json::Value;

/// Given as initialization options or as the configuration `nbc`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Settings {
    pub(super) pictures: bool,
    pub(super) code_lenses: bool,
    pub(super) inlay_hints: HintSettings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct HintSettings {
    pub(super) widths: bool,
    pub(super) parameters: bool,
    pub(super) robots: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { pictures: true, code_lenses: true, inlay_hints: HintSettings::default() }
    }
}

impl Default for HintSettings {
    fn default() -> Self {
        Self { widths: true, parameters: true, robots: true }
    }
}

/// Clients that show Markdown as plain text, where a picture would be pages of digits.
const WITHOUT_PICTURES: [&str; 5] = ["neovim", "vim", "helix", "emacs", "kate"];

impl Settings {
    pub(super) fn of_client(parameters: &Value) -> Self {
        let client = parameters.pointer("/clientInfo/name").and_then(Value::as_str).map(str::to_ascii_lowercase);
        let pictures = client.is_some_and(|client| !WITHOUT_PICTURES.iter().any(|name| client.contains(name)));
        let default = Self { pictures, ..Self::default() };
        default.with(parameters.get("initializationOptions").unwrap_or(&Value::Null))
    }

    /// Missing settings stay as they are, and unknown ones are ignored.
    pub(super) fn with(self, change: &Value) -> Self {
        let known = |path: &str, before: bool| change.pointer(path).and_then(Value::as_bool).unwrap_or(before);
        let hints = self.inlay_hints;
        Self {
            pictures: known("/pictures", self.pictures),
            code_lenses: known("/codeLenses", self.code_lenses),
            inlay_hints: HintSettings {
                widths: known("/inlayHints/widths", hints.widths),
                parameters: known("/inlayHints/parameters", hints.parameters),
                robots: known("/inlayHints/robots", hints.robots),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_change_leaves_what_it_does_not_name() {
        let first = Settings::default().with(&json!({ "inlayHints": { "widths": false }, "codeLenses": "yes" }));
        assert_eq!(first.inlay_hints, HintSettings { widths: false, ..HintSettings::default() });
        let second = first.with(&json!({ "codeLenses": false }));
        assert_eq!(second, Settings { code_lenses: false, ..first });
    }

    #[test]
    fn clients_of_a_terminal_have_no_pictures_unless_they_ask() {
        let client = |name: &str, options: Value| {
            let parameters = json!({ "clientInfo": { "name": name }, "initializationOptions": options });
            Settings::of_client(&parameters).pictures
        };
        assert!(client("Visual Studio Code", Value::Null));
        assert!(!client("Neovim", Value::Null));
        assert!(client("Neovim", json!({ "pictures": true })));
        assert!(!Settings::of_client(&json!({})).pictures, "it may be one of them");
    }
}
