//! Names. A symbol is an immutable, cheaply shared string, ordered by its text.

use std::borrow::Borrow;
use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::HashSet;

/// The name of an entity, a type, a predicate or an action, spelled as the user spelled it.
///
/// Comparison, hashing and order are those of the text, so results ordered by symbol do not depend on who was
/// met first. Cloning copies a pointer.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "Name", description = "A name."))]
#[serde(transparent)]
pub struct Symbol(Arc<str>);

impl Symbol {
    /// The symbol with this text.
    pub fn new(text: &str) -> Self {
        Self(Arc::from(text))
    }

    /// Its text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Debug for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Display for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

impl Default for Symbol {
    /// The empty text, which names nothing.
    fn default() -> Self {
        Self::new("")
    }
}

impl From<&str> for Symbol {
    fn from(text: &str) -> Self {
        Self::new(text)
    }
}

impl From<String> for Symbol {
    fn from(text: String) -> Self {
        Self(Arc::from(text))
    }
}

impl Borrow<str> for Symbol {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl PartialEq<str> for Symbol {
    fn eq(&self, other: &str) -> bool {
        &*self.0 == other
    }
}

impl PartialEq<&str> for Symbol {
    fn eq(&self, other: &&str) -> bool {
        &*self.0 == *other
    }
}

/// Shares the storage of equal names. A reader of large files makes one; results never depend on it.
#[derive(Debug, Default)]
pub struct SymbolPool {
    known: HashSet<Symbol>,
}

impl SymbolPool {
    /// An empty pool.
    pub fn new() -> Self {
        Self::default()
    }

    /// The symbol with this text, sharing storage with an equal one made before.
    pub fn symbol(&mut self, text: &str) -> Symbol {
        if let Some(known) = self.known.get(text) {
            return known.clone();
        }
        let symbol = Symbol::new(text);
        self.known.insert(symbol.clone());
        symbol
    }
}
