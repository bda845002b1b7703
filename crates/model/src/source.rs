//! What something was observed in.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::Symbol;

/// Which trace something was observed in: the SHA-256 of the trace's bytes. The same trace under another name is the same
/// source.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct SourceId([u8; 32]);

/// A trace that something was learned from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The trace's file name, for people; of several, the first in the alphabet.
    pub name: Symbol,
    /// The number of its transitions.
    pub transitions: u64,
}

/// Why a text is not the id of a source.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{0}` is not a SHA-256: 64 hexadecimal digits")]
pub struct SourceIdError(String);

impl SourceId {
    /// The source whose bytes have this SHA-256.
    pub const fn new(sha256: [u8; 32]) -> Self {
        Self(sha256)
    }

    /// Its first eight digits: enough for people to tell sources apart.
    pub fn short(self) -> String {
        self.to_string()[..8].to_owned()
    }
}

impl fmt::Display for SourceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for SourceId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl FromStr for SourceId {
    type Err = SourceIdError;

    fn from_str(text: &str) -> Result<Self, SourceIdError> {
        let error = || SourceIdError(text.to_owned());
        if text.len() != 64 || !text.bytes().all(|digit| digit.is_ascii_hexdigit()) {
            return Err(error());
        }
        let mut sha256 = [0; 32];
        for (byte, at) in sha256.iter_mut().zip((0..).step_by(2)) {
            *byte = u8::from_str_radix(&text[at..at + 2], 16).map_err(|_| error())?;
        }
        Ok(Self(sha256))
    }
}

impl From<SourceId> for String {
    fn from(id: SourceId) -> Self {
        id.to_string()
    }
}

impl TryFrom<String> for SourceId {
    type Error = SourceIdError;

    fn try_from(text: String) -> Result<Self, SourceIdError> {
        text.parse()
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for SourceId {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "SourceId".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({"type": "string", "pattern": "^[0-9a-fA-F]{64}$", "description": "The SHA-256 of a trace's bytes."})
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_hexadecimal() {
        let text = "00ff10".to_owned() + &"ab".repeat(29);
        let id: SourceId = text.parse().expect("an id");
        assert_eq!((id.to_string(), id.short()), (text.clone(), "00ff10ab".to_owned()));
        for wrong in ["", "00ff", &text[1..], &text.replace("ff", "fg"), &text.replace("ff", "é")] {
            assert!(wrong.parse::<SourceId>().is_err(), "{wrong}");
        }
    }
}
