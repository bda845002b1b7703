//! Parse (paper: s = Parse(x)): from a snapshot to the set of atoms that hold.
//!
//! | observed of entity e                | atom                |
//! |-------------------------------------|---------------------|
//! | attribute `a` = word `V`            | `a_V(e)`            |
//! | attribute `a` = true                | `a(e)`              |
//! | relation `r` to `f`                 | `r_holds(e, f)`     |
//! | relation `r` to at most one, to none| `r_None(e)`         |
//! | false, numbers, vectors, empty list | none                |
//!
//! Parsing is a function of the snapshot, the hierarchy and the configuration. A [`Parser`] also remembers what each
//! predicate name came from, and refuses a second source of one name.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use thiserror::Error;
use typelift_model::{
    Atom, GroundAtom, Hierarchy, MOST_PARAMETERS, ParseConfig, State, Symbol, TypeId, Unknown, check_name,
};

use crate::{Entity, Relation, Scene, Snapshot, Value};

/// What is wrong with a scene.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ParseErrorKind {
    /// A type that the hierarchy does not have.
    #[error("unknown type `{ty}`")]
    UnknownType {
        /// The type's name.
        ty: Symbol,
        /// A declared type that differs only in case, if there is one.
        similar: Option<Symbol>,
    },
    /// Two entities of one name.
    #[error("there are two entities of this name")]
    Duplicate,
    /// A relation to, or an atom over, an entity that is not there.
    #[error("{what} mentions `{target}`, which is not among the entities")]
    UnknownEntity {
        /// The relation or atom.
        what: String,
        /// The missing entity.
        target: Symbol,
    },
    /// Two attributes or relations would give one predicate.
    #[error("the predicate `{predicate}` has two sources: {first} and {second}")]
    TwoSources {
        /// The predicate.
        predicate: Symbol,
        /// The source met first.
        first: String,
        /// The other.
        second: String,
    },
    /// A predicate with two numbers of arguments.
    #[error("the predicate `{predicate}` is used with {first} and with {second} arguments")]
    TwoArities {
        /// The predicate.
        predicate: Symbol,
        /// The number met first.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A predicate with more arguments than one may have.
    #[error("the predicate `{predicate}` is used with {arity} arguments, and may have {MOST_PARAMETERS}")]
    TooManyArguments {
        /// The predicate.
        predicate: Symbol,
        /// How many it has here.
        arity: usize,
    },
    /// A name that cannot stand in an atom.
    #[error("{0}")]
    Name(String),
    /// An atom that is both true and unknown.
    #[error("{0} is listed both as true and as unknown")]
    TrueAndUnknown(GroundAtom),
}

impl ParseErrorKind {
    /// What to do about it, if that is known whatever the scene is read from.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Name(_) => Some("A name is a word without white space and ( ) , ; \"."),
            Self::UnknownEntity { .. } => Some("List that entity too; where a relation is to nothing, write null."),
            Self::Duplicate => Some("Give each entity a name of its own."),
            Self::TwoSources { .. } => Some("Rename one of the two, or ignore it."),
            _ => None,
        }
    }
}

/// Why a scene is not a state.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}{kind}", .entity.as_ref().map(|e| format!("entity {e}: ")).unwrap_or_default())]
pub struct ParseError {
    /// The entity concerned, if it is about one.
    pub entity: Option<Symbol>,
    /// What is wrong.
    pub kind: ParseErrorKind,
}

impl ParseError {
    fn at(entity: &Symbol, kind: ParseErrorKind) -> Self {
        Self { entity: Some(entity.clone()), kind }
    }
}

/// What a predicate's name was made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum SourceKind {
    TrueAttribute,
    WordAttribute,
    Relation,
    EmptyRelation,
    Symbolic,
}

#[derive(Debug, Clone)]
struct PredicateSource {
    kind: SourceKind,
    name: Symbol,
    arity: usize,
}

impl PredicateSource {
    fn describe(&self) -> String {
        match self.kind {
            SourceKind::TrueAttribute => format!("the true or false attribute `{}`", self.name),
            SourceKind::WordAttribute => format!("a word of the attribute `{}`", self.name),
            SourceKind::Relation => format!("the relation `{}`", self.name),
            SourceKind::EmptyRelation => format!("the relation `{}` to nothing", self.name),
            SourceKind::Symbolic => "an atom of a symbolic state".to_owned(),
        }
    }
}

/// Reads scenes as states of one hierarchy.
#[derive(Debug, Clone)]
pub struct Parser {
    hierarchy: Hierarchy,
    config: ParseConfig,
    sources: BTreeMap<Symbol, PredicateSource>,
    /// Rules of `config.ignore` that matched something.
    matched: BTreeSet<Symbol>,
}

impl Parser {
    /// A parser that has seen nothing yet.
    pub fn new(hierarchy: Hierarchy, config: ParseConfig) -> Self {
        Self { hierarchy, config, sources: BTreeMap::new(), matched: BTreeSet::new() }
    }

    /// The hierarchy that its states refer to.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// What it was told.
    pub fn config(&self) -> &ParseConfig {
        &self.config
    }

    /// The attribute or relation that each predicate met so far comes from; of a predicate of symbolic states, itself.
    pub fn attributes(&self) -> BTreeMap<Symbol, Symbol> {
        self.sources.iter().map(|(predicate, source)| (predicate.clone(), source.name.clone())).collect()
    }

    /// What was to be ignored and was never met.
    pub fn unmatched_ignores(&self) -> impl Iterator<Item = &Symbol> {
        self.config.ignore.difference(&self.matched)
    }

    /// The state that a scene shows.
    ///
    /// # Errors
    /// [`ParseError`] with the entity concerned.
    pub fn parse(&mut self, scene: &Scene) -> Result<State, ParseError> {
        match scene {
            Scene::Snapshot(snapshot) => self.parse_snapshot(snapshot),
            Scene::Symbolic { objects, atoms, unknown } => {
                self.parse_symbolic(objects, atoms, Unknown::Matching(unknown.clone()))
            }
        }
    }

    /// The state of these objects and atoms, of which the others are known as far as `unknown` says.
    ///
    /// # Errors
    /// [`ParseError`] with the entity concerned.
    pub fn parse_symbolic(
        &mut self,
        objects: &BTreeMap<Symbol, Symbol>,
        atoms: &BTreeSet<GroundAtom>,
        unknown: Unknown<Symbol>,
    ) -> Result<State, ParseError> {
        let mut state = State::default();
        for (name, ty) in objects {
            self.add_object(&mut state, name, ty)?;
        }
        for atom in atoms {
            self.note_symbolic(&state, atom, atom.args.iter())?;
        }
        match &unknown {
            Unknown::Matching(patterns) => {
                for pattern in patterns {
                    self.note_symbolic(&state, pattern, pattern.names())?;
                    if let Some(both) = atoms.iter().find(|atom| pattern.is_of(atom)) {
                        return Err(ParseError { entity: None, kind: ParseErrorKind::TrueAndUnknown(both.clone()) });
                    }
                }
            }
            Unknown::AllBut(known) => {
                for atom in known {
                    self.note_symbolic(&state, atom, atom.args.iter())?;
                }
            }
        }
        state.atoms = atoms.clone();
        state.unknown = unknown;
        Ok(state)
    }

    /// Notes the predicate of an atom, or a pattern, of a symbolic state, which is over these objects.
    fn note_symbolic<'a, T: fmt::Display>(
        &mut self,
        state: &State,
        atom: &Atom<T>,
        mut objects: impl Iterator<Item = &'a Symbol>,
    ) -> Result<(), ParseError> {
        if let Some(target) = objects.find(|name| !state.objects.contains_key(*name)) {
            let kind = ParseErrorKind::UnknownEntity { what: atom.to_string(), target: target.clone() };
            return Err(ParseError { entity: None, kind });
        }
        self.note(None, SourceKind::Symbolic, &atom.predicate, &atom.predicate, atom.arity())
    }

    fn parse_snapshot(&mut self, snapshot: &Snapshot) -> Result<State, ParseError> {
        let mut state = State::default();
        for entity in &snapshot.entities {
            self.add_object(&mut state, &entity.id, &entity.ty)?;
        }
        for entity in &snapshot.entities {
            let ty = state.objects[&entity.id];
            for (name, value) in &entity.attributes {
                if !self.ignored(ty, name) {
                    self.parse_attribute(&mut state, entity, name, value)?;
                }
            }
            for (name, relation) in &entity.relations {
                if !self.ignored(ty, name) {
                    self.parse_relation(&mut state, entity, name, relation)?;
                }
            }
        }
        Ok(state)
    }

    fn add_object(&self, state: &mut State, name: &Symbol, ty: &Symbol) -> Result<(), ParseError> {
        check_name(name.as_str()).map_err(|e| {
            let kind = ParseErrorKind::Name(format!("the name of an entity: {e}"));
            ParseError { entity: None, kind }
        })?;
        let id = self.hierarchy.id(ty.as_str()).ok_or_else(|| {
            let names = self.hierarchy.types().map(|t| self.hierarchy.name(t));
            let similar = names.into_iter().find(|n| n.as_str().eq_ignore_ascii_case(ty.as_str())).cloned();
            ParseError::at(name, ParseErrorKind::UnknownType { ty: ty.clone(), similar })
        })?;
        match state.objects.insert(name.clone(), id) {
            Some(_) => Err(ParseError::at(name, ParseErrorKind::Duplicate)),
            None => Ok(()),
        }
    }

    fn ignored(&mut self, ty: TypeId, name: &Symbol) -> bool {
        let rule = self.config.ignore.iter().find(|rule| match rule.as_str().split_once('.') {
            None => *rule == name,
            Some((type_name, attribute)) => {
                *name == attribute && self.hierarchy.id(type_name).is_some_and(|t| self.hierarchy.is_a(ty, t))
            }
        });
        let Some(rule) = rule else { return false };
        if !self.matched.contains(rule) {
            self.matched.insert(rule.clone());
        }
        true
    }

    fn parse_attribute(
        &mut self,
        state: &mut State,
        entity: &Entity,
        name: &Symbol,
        value: &Value,
    ) -> Result<(), ParseError> {
        let (kind, predicate) = match value {
            Value::Bool(true) => (SourceKind::TrueAttribute, name.clone()),
            Value::Text(word) => (SourceKind::WordAttribute, Symbol::from(format!("{name}_{word}"))),
            Value::Bool(false) | Value::Number(_) | Value::Vector(_) => return Ok(()),
        };
        self.note(Some(entity), kind, name, &predicate, 1)?;
        state.atoms.insert(GroundAtom { predicate, args: vec![entity.id.clone()] });
        Ok(())
    }

    fn parse_relation(
        &mut self,
        state: &mut State,
        entity: &Entity,
        name: &Symbol,
        relation: &Relation,
    ) -> Result<(), ParseError> {
        if *relation == Relation::One(None) {
            let predicate = Symbol::from(format!("{name}_None"));
            self.note(Some(entity), SourceKind::EmptyRelation, name, &predicate, 1)?;
            state.atoms.insert(GroundAtom { predicate, args: vec![entity.id.clone()] });
        }
        for target in relation.targets() {
            let predicate = Symbol::from(format!("{name}_holds"));
            self.note(Some(entity), SourceKind::Relation, name, &predicate, 2)?;
            if !state.objects.contains_key(target) {
                let kind =
                    ParseErrorKind::UnknownEntity { what: format!("the relation `{name}`"), target: target.clone() };
                return Err(ParseError::at(&entity.id, kind));
            }
            state.atoms.insert(GroundAtom { predicate, args: vec![entity.id.clone(), target.clone()] });
        }
        Ok(())
    }

    /// Remembers where a predicate's name came from, and refuses a second source.
    fn note(
        &mut self,
        entity: Option<&Entity>,
        kind: SourceKind,
        name: &Symbol,
        predicate: &Symbol,
        arity: usize,
    ) -> Result<(), ParseError> {
        let error = |kind| ParseError { entity: entity.map(|e| e.id.clone()), kind };
        let Some(known) = self.sources.get(predicate) else {
            check_name(predicate.as_str()).map_err(|e| error(ParseErrorKind::Name(e.to_string())))?;
            // A model with such a predicate could not be read again.
            if arity > MOST_PARAMETERS {
                return Err(error(ParseErrorKind::TooManyArguments { predicate: predicate.clone(), arity }));
            }
            self.sources.insert(predicate.clone(), PredicateSource { kind, name: name.clone(), arity });
            return Ok(());
        };
        let symbolic = kind == SourceKind::Symbolic || known.kind == SourceKind::Symbolic;
        if symbolic && known.arity != arity {
            let (predicate, first) = (predicate.clone(), known.arity);
            return Err(error(ParseErrorKind::TwoArities { predicate, first, second: arity }));
        }
        if !symbolic && (known.kind, &known.name) != (kind, name) {
            let second = PredicateSource { kind, name: name.clone(), arity };
            return Err(error(ParseErrorKind::TwoSources {
                predicate: predicate.clone(),
                first: known.describe(),
                second: second.describe(),
            }));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parser() -> Parser {
        let hierarchy = Hierarchy::from_edges([("agent", "object"), ("plate", "item"), ("leek", "item")]);
        Parser::new(hierarchy.expect("a tree"), ParseConfig::default())
    }

    fn scene(json: &str) -> Scene {
        serde_json::from_str(json).expect("a scene")
    }

    #[test]
    fn each_row_of_the_table() {
        let state = parser()
            .parse(&scene(
                r#"{"entities":[
                {"id":"a","type":"agent","relations":{"holding":null}},
                {"id":"p","type":"plate","attributes":{"full":false,"clean":true,"at":[1,2],"mass":0.3},
                 "relations":{"content":["l"],"under":[]}},
                {"id":"l","type":"leek","attributes":{"cut":"Fresh"},"relations":{"on":"p"}}]}"#,
            ))
            .expect("a state");
        let atoms: Vec<String> = state.atoms.iter().map(ToString::to_string).collect();
        assert_eq!(atoms, ["clean(p)", "content_holds(p,l)", "cut_Fresh(l)", "holding_None(a)", "on_holds(l,p)"]);
    }

    #[test]
    fn ignoring_by_name_and_by_type() {
        let json = r#"{"entities":[{"id":"p","type":"plate","attributes":{"clean":true}},
                                   {"id":"l","type":"leek","attributes":{"clean":true}}]}"#;
        for (rule, left) in [("clean", 0), ("plate.clean", 1), ("item.clean", 0), ("agent.clean", 2)] {
            let mut parser = parser();
            parser.config.ignore.insert(Symbol::new(rule));
            assert_eq!(parser.parse(&scene(json)).expect("a state").atoms.len(), left, "{rule}");
        }
    }

    #[test]
    fn what_is_unknown_is_over_the_entities() {
        let symbolic = |atoms: &str, unknown: &str| {
            let objects = r#"{"a":"agent","p":"plate"}"#;
            let text = format!(r#"{{"objects":{objects},"atoms":[{atoms}],"unknown":[{unknown}]}}"#);
            parser().parse(&scene(&text)).map_err(|error| error.to_string())
        };
        let state = symbolic(r#""holding(a,p)""#, r#""holding(a,*)""#).expect("what is listed is known");
        let unknown = |atom| state.is_unknown(&GroundAtom::parse(atom).expect("an atom"));
        assert_eq!(["holding(a,p)", "holding(a,a)", "holding(p,a)"].map(unknown), [false, true, false]);
        for (atoms, unknown, message) in [
            ("", r#""holding(a,q)""#, "holding(a,q) mentions `q`, which is not among the entities"),
            ("", r#""holding(b,*)""#, "holding(b,*) mentions `b`, which is not among the entities"),
            (r#""clean(p)""#, r#""clean(p)""#, "clean(p) is listed both as true and as unknown"),
            (r#""clean(p)""#, r#""clean(*,*)""#, "the predicate `clean` is used with 1 and with 2 arguments"),
        ] {
            assert_eq!(symbolic(atoms, unknown).expect_err(message), message);
        }
    }

    #[test]
    fn a_predicate_has_no_more_arguments_than_a_model_may_have() {
        let scene_with = |arguments: usize| {
            let atom = format!("near({})", vec!["p"; arguments].join(","));
            scene(&format!(r#"{{"objects":{{"p":"plate"}},"atoms":["{atom}"]}}"#))
        };
        assert!(parser().parse(&scene_with(MOST_PARAMETERS)).is_ok());
        let error = parser().parse(&scene_with(MOST_PARAMETERS + 1)).expect_err("one too many");
        assert_eq!(error.to_string(), "the predicate `near` is used with 257 arguments, and may have 256");
    }

    #[test]
    fn bad_scenes_are_refused_with_the_entity() {
        let bad = [
            (r#"[{"id":"x","type":"fork"}]"#, "entity x: unknown type `fork`"),
            (r#"[{"id":"x","type":"leek"},{"id":"x","type":"leek"}]"#, "entity x: there are two entities of this name"),
            (
                r#"[{"id":"x","type":"plate","relations":{"content":["y"]}}]"#,
                "entity x: the relation `content` mentions `y`, which is not among the entities",
            ),
            (
                r#"[{"id":"x","type":"leek","attributes":{"cut":"done","cut_done":true}}]"#,
                "entity x: the predicate `cut_done` has two sources: a word of the attribute `cut` and the true or false attribute `cut_done`",
            ),
            (
                r#"[{"id":"x","type":"leek","attributes":{"ripe":"very much"}}]"#,
                "entity x: `ripe_very much` cannot be a name: it holds white space",
            ),
        ];
        for (entities, message) in bad {
            let error = parser().parse(&scene(&format!(r#"{{"entities":{entities}}}"#))).expect_err(entities);
            assert_eq!(error.to_string(), message);
        }
    }
}
