//! The JSON of messages, however it is carried.

use lsp_server::{ErrorCode, Message};
use serde_json::{Value, json};

const NO_MESSAGE: &str = "expected a request, a notification or a response";

pub fn message(value: Value) -> Result<Message, Value> {
    let id = value.get("id").filter(|id| id.is_number() || id.is_string()).cloned().unwrap_or_default();
    match Some(value).filter(Value::is_object).and_then(|value| serde_json::from_value(value).ok()) {
        // A notification has no number. One that seems to have one is a request with a number that is not possible.
        Some(message) if id.is_null() || !matches!(message, Message::Notification(_)) => Ok(message),
        _ => Err(refusal(&id, ErrorCode::InvalidRequest, NO_MESSAGE)),
    }
}

/// The id is null if the text has none.
pub fn refusal(id: &Value, code: ErrorCode, reason: &str) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "error": { "code": code as i32, "message": reason } })
}

pub fn parse(text: &[u8]) -> Result<Value, Value> {
    serde_json::from_slice(text)
        .map_err(|error| refusal(&Value::Null, ErrorCode::ParseError, &format!("the message is not JSON: {error}")))
}

pub fn written(message: &Message) -> String {
    let mut value = serde_json::to_value(message).expect("messages are data");
    value["jsonrpc"] = json!("2.0");
    value.to_string()
}
