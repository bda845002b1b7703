//! The reversible mapping between the model's names and PDDL's, which do not tell upper from lower case.

use std::collections::BTreeMap;

use thiserror::Error;

use crate::Symbol;

/// Two names that PDDL cannot tell apart.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the {kind} names `{first}` and `{second}` are the same name in PDDL, `{pddl}`")]
pub struct NameCollision {
    /// What the names name: `type`, `predicate`, `action` or `object`.
    pub kind: &'static str,
    /// The one.
    pub first: Symbol,
    /// The other.
    pub second: Symbol,
    /// The PDDL name of both.
    pub pddl: Symbol,
}

/// A mapping of the names of one kind to PDDL names and back.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PddlNames {
    to_pddl: BTreeMap<Symbol, Symbol>,
    from_pddl: BTreeMap<Symbol, Symbol>,
}

impl PddlNames {
    /// Folds each name: ASCII letters in lower case, other ASCII characters than letters, digits, `-` and `_` replaced
    /// by `_`, a character beyond ASCII by its code point as `_u1f375`, and `n_` put before a name that does not start
    /// with a letter, or that PDDL keeps for itself.
    ///
    /// # Errors
    /// [`NameCollision`] if two different names fold to one.
    pub fn fold<'a>(kind: &'static str, names: impl IntoIterator<Item = &'a Symbol>) -> Result<Self, NameCollision> {
        let mut mapping = Self::default();
        for name in names {
            let mut pddl = folded(name.as_str());
            if is_reserved(kind, pddl.as_str()) {
                pddl = Symbol::from(format!("n_{pddl}"));
            }
            match mapping.from_pddl.get(&pddl) {
                Some(first) if first != name => {
                    return Err(NameCollision { kind, first: first.clone(), second: name.clone(), pddl });
                }
                _ => {
                    mapping.from_pddl.insert(pddl.clone(), name.clone());
                    mapping.to_pddl.insert(name.clone(), pddl);
                }
            }
        }
        Ok(mapping)
    }

    /// The PDDL name of a name of the model.
    pub fn pddl(&self, name: &str) -> Option<&Symbol> {
        self.to_pddl.get(name)
    }

    /// The model's name for a PDDL name, in whatever case that is written.
    pub fn name(&self, pddl: &str) -> Option<&Symbol> {
        self.from_pddl.get(pddl.to_ascii_lowercase().as_str())
    }

    /// Every pair `(name, PDDL name)`, sorted by name.
    pub fn iter(&self) -> impl Iterator<Item = (&Symbol, &Symbol)> {
        self.to_pddl.iter()
    }
}

/// Whether a name of this kind means something else in PDDL.
fn is_reserved(kind: &str, name: &str) -> bool {
    match kind {
        "predicate" => ["and", "or", "not", "imply", "exists", "forall", "when", "increase"].contains(&name),
        "type" => ["either", "number"].contains(&name),
        _ => false,
    }
}

/// A name as PDDL has it, as [`PddlNames::fold`] says.
pub(crate) fn folded(name: &str) -> Symbol {
    let mut text = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            '-' | '_' | '0'..='9' | 'a'..='z' | 'A'..='Z' => text.push(c.to_ascii_lowercase()),
            _ if c.is_ascii() => text.push('_'),
            _ => text.push_str(&format!("_u{:x}", u32::from(c))),
        }
    }
    if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        text.insert_str(0, "n_");
    }
    Symbol::from(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folding_is_reversible_or_refused() {
        let names = ["status_Ready", "free", "3rd", "état", "打开", "关闭"].map(Symbol::new);
        let mapping = PddlNames::fold("predicate", &names).expect("no collision");
        for name in &names {
            let pddl = mapping.pddl(name.as_str()).expect("mapped");
            assert_eq!(mapping.name(&pddl.as_str().to_uppercase()), Some(name));
        }
        assert_eq!(mapping.pddl("état").map(Symbol::as_str), Some("n__ue9tat"));
        let reserved = PddlNames::fold("predicate", &["Not", "number"].map(Symbol::new)).expect("no collision");
        assert_eq!(reserved.pddl("Not").map(Symbol::as_str), Some("n_not"));
        assert_eq!(reserved.name("n_not").map(Symbol::as_str), Some("Not"));
        assert_eq!(reserved.pddl("number").map(Symbol::as_str), Some("number"), "only a type may not be called that");
        let clash = PddlNames::fold("predicate", &["Ready", "ready"].map(Symbol::new)).expect_err("they collide");
        assert_eq!(clash.to_string(), "the predicate names `Ready` and `ready` are the same name in PDDL, `ready`");
    }
}
