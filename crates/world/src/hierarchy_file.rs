//! Hierarchy files: a PDDL `(:types …)` block, a whole domain, or JSON `{"child": "parent"}`, where several parents are a
//! list.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use thiserror::Error;
use typelift_model::{ArgumentTypes, Hierarchy, ROOT, Symbol, TypeId, check_name, did_you_mean, nearest};
use typelift_pddl::{
    Declarations, Document, ObjectDeclaration, PddlError, Span, TypeEdge, hierarchy_from_types,
    read_declared_predicates,
};

use crate::{FileError, json, read_text};

/// A parent that is declared nowhere, with a name like that of a type that is.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{parent}`, of which `{child}` is a kind, is declared nowhere")]
pub struct DoubtfulParent {
    /// The parent.
    pub parent: Symbol,
    /// The first type below it.
    pub child: Symbol,
    /// The declared type that was probably meant.
    pub near: Symbol,
    /// Where the child is declared.
    span: Span,
}

impl DoubtfulParent {
    /// What to do about it.
    pub fn hint(&self) -> String {
        format!("Did you mean `{}`?", self.near)
    }
}

/// The types that a file declares, with their places in it; of a domain its name, constants and predicates, too.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TypesFile {
    path: PathBuf,
    text: String,
    edges: Vec<TypeEdge>,
    domain: Option<Symbol>,
    constants: Vec<ObjectDeclaration>,
}

impl TypesFile {
    /// Reads the text of a hierarchy file; errors call it `name`.
    ///
    /// # Errors
    /// As for [`read_types`].
    pub fn from_text(name: &Path, text: String) -> Result<Self, FileError> {
        let located = |error: PddlError| FileError::from_pddl(name, &text, error);
        let mut domain = Declarations::default();
        let edges = match text.trim_start().chars().next() {
            None => return Err(FileError::new(name, "the file is empty")),
            Some('{') => json_types(name, &text)?,
            Some('(' | ';') => {
                let edges = typelift_pddl::read_types(&text).map_err(located)?;
                domain = domain_declarations(&text).map_err(located)?;
                edges
            }
            Some(_) => {
                let what = "this is neither PDDL types nor a JSON object of types";
                return Err(FileError::new(name, what).with_hint(EXAMPLE.to_owned()));
            }
        };
        for edge in &edges {
            for ty in [&edge.child, &edge.parent] {
                check_name(ty.as_str())
                    .map_err(|error| located(PddlError::new(&text, edge.span, error.to_string())))?;
            }
        }
        Ok(Self { path: name.to_owned(), text, edges, domain: domain.name, constants: domain.objects })
    }

    /// The name of the domain that the file is, if it is one, in lower case.
    pub fn domain(&self) -> Option<&Symbol> {
        self.domain.as_ref()
    }

    /// The constants of the domain that the file is, with their types in a hierarchy.
    ///
    /// # Errors
    /// [`FileError`] at a constant of a type that the hierarchy does not have.
    pub fn constants(&self, hierarchy: &Hierarchy) -> Result<BTreeMap<Symbol, TypeId>, FileError> {
        let typed = |constant: &ObjectDeclaration| {
            let mut types = hierarchy.types();
            let found = types.find(|&ty| hierarchy.name(ty).as_str().eq_ignore_ascii_case(constant.ty.as_str()));
            let ty = found.ok_or_else(|| {
                let message = format!("constant `{}`: unknown type `{}`", constant.name, constant.ty);
                let names = hierarchy.types().map(|ty| hierarchy.name(ty));
                let hint = did_you_mean(constant.ty.as_str(), names)
                    .unwrap_or_else(|| "Declare it in `(:types …)`.".to_owned());
                let error = PddlError::new(&self.text, constant.span, message).with_hint(hint);
                FileError::from_pddl(&self.path, &self.text, error)
            })?;
            Ok((constant.name.clone(), ty))
        };
        self.constants.iter().map(typed).collect()
    }

    /// The predicates of the domain that the file is, over the types of a hierarchy that has those of the file.
    ///
    /// # Errors
    /// [`FileError`] at a predicate that is not one, or is of a type that the hierarchy does not have.
    pub fn predicates(&self, hierarchy: &Hierarchy) -> Result<ArgumentTypes, FileError> {
        match self.domain {
            None => Ok(ArgumentTypes::new()),
            Some(_) => read_declared_predicates(&self.text, hierarchy)
                .map_err(|error| FileError::from_pddl(&self.path, &self.text, error)),
        }
    }

    /// Each type with each of its parents, in the order of the file.
    pub fn edges(&self) -> &[TypeEdge] {
        &self.edges
    }

    /// Parents that are declared nowhere themselves, as they need not be, and whose names are nearly those of types that
    /// are: probably slips.
    pub fn doubtful_parents(&self) -> Vec<DoubtfulParent> {
        let declared: BTreeSet<&Symbol> = self.edges.iter().map(|edge| &edge.child).collect();
        let mut told = BTreeSet::from([Symbol::new(ROOT)]);
        let undeclared = self.edges.iter().filter(|edge| !declared.contains(&edge.parent));
        let once = undeclared.filter(|edge| told.insert(edge.parent.clone()));
        let doubtful = once.filter_map(|TypeEdge { child, parent, span }| {
            let near = nearest(parent.as_str(), declared.iter().copied())?.clone();
            Some(DoubtfulParent { parent: parent.clone(), child: child.clone(), near, span: *span })
        });
        doubtful.collect()
    }

    /// What is probably not meant in it, with places.
    pub fn warnings(&self) -> Vec<FileError> {
        let located = |doubtful: DoubtfulParent| {
            let error = PddlError::new(&self.text, doubtful.span, doubtful.to_string());
            FileError::from_pddl(&self.path, &self.text, error.with_hint(doubtful.hint()))
        };
        self.doubtful_parents().into_iter().map(located).collect()
    }

    /// `base` with these types.
    ///
    /// # Errors
    /// [`FileError`] at the declarations that contradict each other or `base`.
    pub fn extend(&self, base: &Hierarchy) -> Result<Hierarchy, FileError> {
        hierarchy_from_types(base, &self.text, &self.edges)
            .map_err(|error| FileError::from_pddl(&self.path, &self.text, error))
    }
}

/// Reads a hierarchy file, which kind it is being told from its content.
///
/// # Errors
/// [`FileError`] if it is neither kind, or at the declarations of a cycle.
pub fn read_hierarchy(path: &Path) -> Result<Hierarchy, FileError> {
    hierarchy_from_text(path, read_text(path)?)
}

/// Reads the text of a hierarchy file; errors call it `name`.
///
/// # Errors
/// As for [`read_hierarchy`].
pub fn hierarchy_from_text(name: &Path, text: String) -> Result<Hierarchy, FileError> {
    TypesFile::from_text(name, text)?.extend(&Hierarchy::default())
}

/// Reads the types that a hierarchy file declares, to add them to a hierarchy.
///
/// # Errors
/// [`FileError`] if it is not a hierarchy file.
pub fn read_types(path: &Path) -> Result<TypesFile, FileError> {
    TypesFile::from_text(path, read_text(path)?)
}

/// The name and the constants of a domain; nothing of `(:types …)` alone.
fn domain_declarations(text: &str) -> Result<Declarations, PddlError> {
    match Document::read(text)?.only_root()?.has_head(":types") {
        true => Ok(Declarations::default()),
        false => typelift_pddl::read_objects(text),
    }
}

const EXAMPLE: &str = "Write `(:types rod leek - piece)` or `{\"rod\": \"piece\", \"leek\": \"piece\"}`.";

fn json_types(path: &Path, text: &str) -> Result<Vec<TypeEdge>, FileError> {
    // The reader of JSON keeps no places, so it only checks the form. The strings of the text are, in turn, a key and its
    // parents.
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Types(#[serde(deserialize_with = "json::pairs")] Vec<(Symbol, Parents)>);
    let Types(types) = serde_json::from_str(text)
        .map_err(|error| FileError::from_json(path, 1, text, &error).with_hint(EXAMPLE.to_owned()))?;
    let mut spans = string_spans(text).into_iter();
    let mut edges: Vec<TypeEdge> = Vec::with_capacity(types.len());
    for (child, Parents(parents)) in types {
        let span = spans.next().unwrap_or_default();
        if edges.iter().any(|known| known.child == child) {
            let error = PddlError::new(text, span, format!("the key `{child}` stands here twice"));
            let hint = format!("Several parents are a list: `{{\"{child}\": [\"tool\", \"weapon\"]}}`.");
            return Err(FileError::from_pddl(path, text, error.with_hint(hint)));
        }
        spans.by_ref().take(parents.len()).for_each(drop);
        edges.extend(parents.into_iter().map(|parent| TypeEdge { child: child.clone(), parent, span }));
    }
    Ok(edges)
}

/// The parents of a type: a string, or a list of strings.
struct Parents(Vec<Symbol>);

impl<'de> Deserialize<'de> for Parents {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneOrMore;
        impl<'de> Visitor<'de> for OneOrMore {
            type Value = Parents;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a string, or a list of strings")
            }

            fn visit_str<E: de::Error>(self, parent: &str) -> Result<Parents, E> {
                Ok(Parents(vec![Symbol::new(parent)]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Parents, A::Error> {
                let mut parents = Vec::new();
                while let Some(parent) = list.next_element()? {
                    parents.push(parent);
                }
                if parents.is_empty() {
                    Err(de::Error::invalid_length(0, &"a parent at least"))
                } else {
                    Ok(Parents(parents))
                }
            }
        }
        deserializer.deserialize_any(OneOrMore)
    }
}

/// The bytes between the quotes of each string of a JSON text.
fn string_spans(text: &str) -> Vec<Span> {
    let bytes = text.as_bytes();
    let mut spans = Vec::new();
    let mut start = None;
    let mut at = 0;
    while at < bytes.len() {
        match (bytes[at], start) {
            (b'\\', Some(_)) => at += 1,
            (b'"', None) => start = Some(at + 1),
            (b'"', Some(from)) => {
                spans.push(Span { start: from, end: at });
                start = None;
            }
            _ => {}
        }
        at += 1;
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Hierarchy, FileError> {
        hierarchy_from_text(Path::new("types"), text.to_owned())
    }

    fn edges(text: &str) -> Vec<String> {
        read(text).expect(text).edges().map(|(child, parent)| format!("{child}<{parent}")).collect()
    }

    #[test]
    fn the_kind_is_told_from_the_content() {
        let expected = ["piece<object", "rod<piece"];
        assert_eq!(edges("(:types rod - piece)"), expected);
        assert_eq!(edges("; types\n(define (domain d) (:types rod - piece))"), expected);
        assert_eq!(edges("\n {\"rod\": \"piece\"}"), expected);
        assert_eq!(edges(r#"{"a\\": "b", "c": "a\\"}"#), ["b<object", "a\\<b", "c<a\\"]);
    }

    #[test]
    fn several_parents_are_a_list() {
        assert_eq!(
            edges(r#"{"knife": ["tool", "weapon"], "saw": "tool"}"#),
            ["tool<object", "weapon<object", "knife<tool", "knife<weapon", "saw<tool"]
        );
        let error = read("{\n  \"a\": \"b\",\n  \"a\": \"c\"\n}").expect_err("a key twice");
        assert_eq!(error.to_string(), "types:3:4: the key `a` stands here twice");
        assert_eq!(
            read(r#"{"a": ["b", "c"], "b": "a"}"#).expect_err("a cycle").to_string(),
            "types:1:20: the type hierarchy has a cycle: a - b - a"
        );
        assert!(read(r#"{"a": []}"#).is_err());
    }

    #[test]
    fn a_parent_that_is_nearly_a_declared_type_is_doubted() {
        let warnings = |text: &str| {
            let file = TypesFile::from_text(Path::new("types"), text.to_owned()).expect(text);
            file.warnings().iter().map(|w| (w.to_string(), w.hint.clone().unwrap_or_default())).collect::<Vec<_>>()
        };
        assert_eq!(
            warnings("(:types drum - load oil acid - dum)"),
            [(
                "types:1:21: `dum`, of which `oil` is a kind, is declared nowhere".to_owned(),
                "Did you mean `drum`?".to_owned()
            )]
        );
        assert_eq!(warnings(r#"{"drum": "load", "oil": "dum"}"#).len(), 1);
        assert_eq!(warnings("(:types drum - load dum - load oil - dum)"), [], "it is declared");
        assert_eq!(warnings("(:types truck - vehicle box - object)"), [], "nothing is like it");
    }

    #[test]
    fn what_is_refused() {
        for (text, message) in [
            ("", "types: the file is empty"),
            ("rod - piece", "types: this is neither PDDL types nor a JSON object of types"),
            ("{\"a\": \"b\",\n\"b\": \"a\"}", "types:2:2: the type hierarchy has a cycle: a - b - a"),
            ("{\"a\": 1}", "types:1:7: in `a`: expected a string, or a list of strings, found the number 1"),
            ("{\"a\": \"b\"", "types:1:9: the JSON text ends too early"),
            ("{\"a\": \"two words\"}", "types:1:3: `two words` cannot be a name: it holds white space"),
            (r#"{"a\"\\": "b"}"#, "types:1:3: `a\"\\` cannot be a name: it holds one of ( ) , ; \""),
            ("{\"\": \"a\"}", "types:1:3: `` cannot be a name: it is empty"),
            ("(:types a,b - c)", "types:1:9: `a,b` cannot be a name: it holds one of ( ) , ; \""),
            ("(:types a", "types:1:1: this `(` is never closed"),
            (
                "{\"object\": \"b\"}",
                "types:1:3: `object` is the root of every hierarchy and cannot have the parent `b`",
            ),
        ] {
            assert_eq!(read(text).expect_err(text).to_string(), message);
        }
    }
}
