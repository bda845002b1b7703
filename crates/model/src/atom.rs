//! Atoms, ground and lifted, and their text form `predicate(arg,arg)`.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use thiserror::Error;

use crate::{Symbol, printable};

/// The predicate of equality: `=(a,b)` holds if a and b are the same object. It stands in conditions only.
pub const EQUALS: &str = "=";

/// A predicate applied to arguments. [`GroundAtom`] and [`LiftedAtom`] are the two kinds in use.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Atom<T> {
    /// The predicate's name.
    pub predicate: Symbol,
    /// The arguments, in order.
    pub args: Vec<T>,
}

/// An atom over entities: `content_holds(plate_1,lettuce_1)`.
pub type GroundAtom = Atom<Symbol>;

/// An atom over parameters and constants: `content_holds(?1,?2)`.
pub type LiftedAtom = Atom<Term>;

/// An argument of a lifted atom.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Term {
    /// The parameter at this index of its action.
    Param(u32),
    /// A fixed object.
    Const(Symbol),
}

/// Why a text is not an atom. It names no place: who reads the file knows that.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum AtomTextError {
    /// The text does not have the form `predicate(arg,arg)`.
    #[error("`{}` is not an atom of the form predicate(entity,entity)", printable(text))]
    Form {
        /// The offending text.
        text: String,
    },
    /// A name is empty or holds a character that separates names.
    #[error("`{}` cannot be a name: {reason}", printable(name))]
    Name {
        /// The offending name.
        name: String,
        /// What is wrong with it.
        reason: &'static str,
    },
}

/// Checks that `name` can stand in an atom: not empty, no white space, none of `( ) , ; "`, no leading `?`.
///
/// # Errors
/// [`AtomTextError::Name`] otherwise.
pub fn check_name(name: &str) -> Result<(), AtomTextError> {
    let reason = if name.is_empty() {
        "it is empty"
    } else if name == EQUALS {
        "it means equality"
    } else if name.starts_with('?') {
        "it starts with `?`, which marks a parameter"
    } else if name.chars().any(|c| c.is_whitespace() || c.is_control()) {
        "it holds white space"
    } else if name.contains(['(', ')', ',', ';', '"']) {
        "it holds one of ( ) , ; \""
    } else {
        return Ok(());
    };
    Err(AtomTextError::Name { name: name.to_owned(), reason })
}

impl<T> Atom<T> {
    /// The atom `predicate(args…)`.
    pub fn new(predicate: impl Into<Symbol>, args: Vec<T>) -> Self {
        Self { predicate: predicate.into(), args }
    }

    /// The number of arguments.
    pub fn arity(&self) -> usize {
        self.args.len()
    }

    /// Whether it says that two things are the same.
    pub fn is_equality(&self) -> bool {
        self.predicate == EQUALS
    }

    /// The same predicate over other arguments.
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Atom<U> {
        Atom { predicate: self.predicate.clone(), args: self.args.iter().map(f).collect() }
    }
}

/// Splits `predicate(a,b)` into its names. White space around names is dropped; `p` and `p()` have no arguments.
pub(crate) fn split(text: &str) -> Result<(&str, Vec<&str>), AtomTextError> {
    let form = || AtomTextError::Form { text: text.to_owned() };
    let trimmed = text.trim();
    let Some((predicate, rest)) = trimmed.split_once('(') else {
        check_name(trimmed).map_err(|_| form())?;
        return Ok((trimmed, Vec::new()));
    };
    let inner = rest.strip_suffix(')').ok_or_else(form)?;
    let predicate = predicate.trim();
    if predicate != EQUALS {
        check_name(predicate).map_err(|_| form())?;
    }
    let args = if inner.trim().is_empty() { Vec::new() } else { inner.split(',').map(str::trim).collect() };
    Ok((predicate, args))
}

impl GroundAtom {
    /// Reads `predicate(entity,entity)`.
    ///
    /// # Errors
    /// [`AtomTextError`] if the text has another form.
    pub fn parse(text: &str) -> Result<Self, AtomTextError> {
        let (predicate, args) = split(text)?;
        check_name(predicate).map_err(|_| AtomTextError::Form { text: text.to_owned() })?;
        for arg in &args {
            check_name(arg).map_err(|_| AtomTextError::Form { text: text.to_owned() })?;
        }
        Ok(Self::new(predicate, args.into_iter().map(Symbol::new).collect()))
    }
}

impl LiftedAtom {
    /// Reads `predicate(?0,constant)`.
    ///
    /// # Errors
    /// [`AtomTextError`] if the text has another form.
    pub fn parse(text: &str) -> Result<Self, AtomTextError> {
        let form = || AtomTextError::Form { text: text.to_owned() };
        let (predicate, args) = split(text)?;
        let args = args
            .into_iter()
            .map(|arg| match arg.strip_prefix('?') {
                Some(index) => index.parse().map(Term::Param).map_err(|_| form()),
                None => check_name(arg).map(|()| Term::Const(Symbol::new(arg))).map_err(|_| form()),
            })
            .collect::<Result<_, _>>()?;
        Ok(Self::new(predicate, args))
    }

    /// The parameters it mentions, in order, with repetitions.
    pub fn params(&self) -> impl Iterator<Item = u32> + '_ {
        self.args.iter().filter_map(|term| match term {
            Term::Param(index) => Some(*index),
            Term::Const(_) => None,
        })
    }

    /// The same atom with each parameter `i` replaced by `map[i]`.
    ///
    /// # Panics
    /// If a parameter is not in `map`.
    pub fn renamed(&self, map: &[u32]) -> Self {
        self.map(|term| match term {
            Term::Param(index) => Term::Param(map[*index as usize]),
            constant @ Term::Const(_) => constant.clone(),
        })
    }
}

impl Term {
    /// The object it stands for when the parameters are these objects.
    ///
    /// # Panics
    /// If it is a parameter beyond them.
    pub fn object(&self, objects: &[Symbol]) -> Symbol {
        match self {
            Self::Param(index) => objects[*index as usize].clone(),
            Self::Const(name) => name.clone(),
        }
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Param(index) => write!(f, "?{index}"),
            Self::Const(name) => write!(f, "{name}"),
        }
    }
}

impl fmt::Debug for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<T: fmt::Display> fmt::Display for Atom<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(", self.predicate)?;
        for (i, arg) in self.args.iter().enumerate() {
            if i > 0 {
                f.write_str(",")?;
            }
            write!(f, "{arg}")?;
        }
        f.write_str(")")
    }
}

impl<T: fmt::Display> fmt::Debug for Atom<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<T: fmt::Display> Serialize for Atom<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for GroundAtom {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::parse(&text).map_err(serde::de::Error::custom)
    }
}

impl<'de> Deserialize<'de> for LiftedAtom {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::parse(&text).map_err(serde::de::Error::custom)
    }
}

#[cfg(feature = "schema")]
impl<T> schemars::JsonSchema for Atom<T> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Atom".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "type": "string",
            "description": "predicate(arg,arg); a parameter is written ?0, ?1, …",
            "pattern": r"^[^\s(),;]+(\([^()]*\))?$"
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_round_trips() {
        for text in ["free(lettuce_1)", "content_holds(plate_1,lettuce_1)", "dark()"] {
            assert_eq!(GroundAtom::parse(text).map(|a| a.to_string()).as_deref(), Ok(text));
        }
        for text in ["content_holds(?1,?2)", "at(?0,kitchen)"] {
            assert_eq!(LiftedAtom::parse(text).map(|a| a.to_string()).as_deref(), Ok(text));
        }
        assert_eq!(GroundAtom::parse(" on ( a , b ) ").map(|a| a.to_string()).as_deref(), Ok("on(a,b)"));
        assert_eq!(GroundAtom::parse("dark").map(|a| a.to_string()).as_deref(), Ok("dark()"));
    }

    #[test]
    fn malformed_text_is_refused() {
        for text in ["", "on(a,b", "on(a,,b)", "on(a b)", "(a)", "on(a)b", "on(a)(b)", "two words(a)", "on(?x)"] {
            assert!(GroundAtom::parse(text).is_err(), "{text}");
        }
        assert!(LiftedAtom::parse("on(?x)").is_err());
    }
}
