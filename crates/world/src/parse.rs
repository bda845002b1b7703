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
//! predicate came from, and refuses a second source of one. Predicates of one name with different numbers of arguments are
//! different ones; the states have them under one name, unless the configuration, or what is [known](Parser::knowing) of a
//! model, tells them apart.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use thiserror::Error;
use typelift_model::{
    ArgumentTypes, Atom, GroundAtom, Hierarchy, MOST_PARAMETERS, ParseConfig, State, Symbol, TypeId, Unknown,
    check_name, name_with_arity, predicate_told_apart,
};

use crate::left_out::KeySets;
use crate::{Entity, LeftOut, MixedRelation, Relation, Scene, Snapshot, Value};

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

/// What adapters write in place of null.
const WORDS_FOR_NOTHING: [&str; 6] = ["", "None", "none", "null", "nil", "nothing"];

impl ParseErrorKind {
    /// What to do about it, if that is known whatever the scene is read from.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Name(_) => Some("A name is a word without white space and ( ) , ; \"."),
            Self::UnknownEntity { target, .. } if WORDS_FOR_NOTHING.contains(&target.as_str()) => {
                Some("Where a relation is to nothing, write null: a text is taken for the name of an entity.")
            }
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
    /// The predicates of the model that the states are for, with their numbers of arguments.
    known: BTreeMap<Symbol, usize>,
    /// Where each predicate met, of this name and so many arguments, comes from.
    sources: BTreeMap<(Symbol, usize), PredicateSource>,
    /// Rules of `config.ignore` that matched something.
    matched: BTreeSet<Symbol>,
    /// What entities had of what they could have.
    keys: KeySets,
}

impl Parser {
    /// A parser that has seen nothing yet.
    pub fn new(hierarchy: Hierarchy, config: ParseConfig) -> Self {
        let (known, sources, matched) = (BTreeMap::new(), BTreeMap::new(), BTreeSet::new());
        Self { hierarchy, config, known, sources, matched, keys: KeySets::default() }
    }

    /// The same for states that a model of these predicates is to be used in: a predicate that has the name of one of them,
    /// and another number of arguments, is none of them, and is called `name/2`.
    #[must_use]
    pub fn knowing(self, predicates: &ArgumentTypes) -> Self {
        let known = predicates.iter().map(|(name, types)| (name.clone(), types.len())).collect();
        Self { known, ..self }
    }

    /// The hierarchy that its states refer to.
    pub fn hierarchy(&self) -> &Hierarchy {
        &self.hierarchy
    }

    /// What it was told.
    pub fn config(&self) -> &ParseConfig {
        &self.config
    }

    /// The attribute or relation that each predicate met so far comes from; of a predicate of symbolic states, itself. Of
    /// several predicates of one name, that of the one with the most arguments.
    pub fn attributes(&self) -> BTreeMap<Symbol, Symbol> {
        self.sources.iter().map(|((predicate, _), source)| (predicate.clone(), source.name.clone())).collect()
    }

    /// What was to be ignored and was never met.
    pub fn unmatched_ignores(&self) -> impl Iterator<Item = &Symbol> {
        self.config.ignore.difference(&self.matched)
    }

    /// Attributes and relations that were there at times only, in the snapshots so far.
    pub fn left_out(&self) -> Vec<LeftOut> {
        self.keys.left_out()
    }

    /// Relations that were lists at times only, in the snapshots so far.
    pub fn mixed(&self) -> Vec<MixedRelation> {
        self.keys.mixed().collect()
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
            state.atoms.insert(self.symbolic(&state, atom, atom.args.iter())?);
        }
        state.unknown = match unknown {
            Unknown::Matching(patterns) => {
                let named = patterns.iter().map(|pattern| self.symbolic(&state, pattern, pattern.names()));
                Unknown::Matching(named.collect::<Result<_, _>>()?)
            }
            Unknown::AllBut(known) => {
                let named = known.iter().map(|atom| self.symbolic(&state, atom, atom.args.iter()));
                Unknown::AllBut(named.collect::<Result<_, _>>()?)
            }
        };
        if let Unknown::Matching(patterns) = &state.unknown
            && let Some(both) = patterns.iter().find_map(|p| state.atoms.iter().find(|atom| p.is_of(atom)))
        {
            return Err(ParseError { entity: None, kind: ParseErrorKind::TrueAndUnknown(both.clone()) });
        }
        Ok(state)
    }

    /// An atom, or a pattern, of a symbolic state, which is over these objects, under the name that its predicate gets.
    fn symbolic<'a, T: Clone + fmt::Display>(
        &mut self,
        state: &State,
        atom: &Atom<T>,
        mut objects: impl Iterator<Item = &'a Symbol>,
    ) -> Result<Atom<T>, ParseError> {
        if let Some(target) = objects.find(|name| !state.objects.contains_key(*name)) {
            let kind = ParseErrorKind::UnknownEntity { what: atom.to_string(), target: target.clone() };
            return Err(ParseError { entity: None, kind });
        }
        let predicate = self.note(None, SourceKind::Symbolic, &atom.predicate, &atom.predicate, atom.arity())?;
        Ok(Atom { predicate, args: atom.args.clone() })
    }

    fn parse_snapshot(&mut self, snapshot: &Snapshot) -> Result<State, ParseError> {
        let mut state = State::default();
        for entity in &snapshot.entities {
            self.add_object(&mut state, &entity.id, &entity.ty)?;
        }
        for entity in &snapshot.entities {
            let ty = state.objects[&entity.id];
            self.note_keys(ty, entity);
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

    fn note_keys(&mut self, ty: TypeId, entity: &Entity) {
        let mut keys = std::mem::take(&mut self.keys);
        keys.note(entity, |key| self.ignored(ty, key));
        self.keys = keys;
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
        let predicate = self.note(Some(entity), kind, name, &predicate, 1)?;
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
            let predicate = self.note(Some(entity), SourceKind::EmptyRelation, name, &predicate, 1)?;
            state.atoms.insert(GroundAtom { predicate, args: vec![entity.id.clone()] });
        }
        for target in relation.targets() {
            let predicate = Symbol::from(format!("{name}_holds"));
            let predicate = self.note(Some(entity), SourceKind::Relation, name, &predicate, 2)?;
            if !state.objects.contains_key(target) {
                let kind =
                    ParseErrorKind::UnknownEntity { what: format!("the relation `{name}`"), target: target.clone() };
                return Err(ParseError::at(&entity.id, kind));
            }
            state.atoms.insert(GroundAtom { predicate, args: vec![entity.id.clone(), target.clone()] });
        }
        Ok(())
    }

    /// The name that a predicate gets in the states.
    fn named(&self, predicate: &Symbol, arity: usize) -> Symbol {
        if self.known.get(predicate) == Some(&arity) {
            return predicate.clone();
        }
        let name = predicate_told_apart(&self.config.by_arity, predicate, arity);
        match self.known.get(&name) {
            Some(&of_model) if of_model != arity => name_with_arity(&name, arity),
            _ => name,
        }
    }

    /// Remembers where a predicate came from, and refuses a second source. Gives the name that it gets in the states.
    fn note(
        &mut self,
        entity: Option<&Entity>,
        kind: SourceKind,
        name: &Symbol,
        predicate: &Symbol,
        arity: usize,
    ) -> Result<Symbol, ParseError> {
        let error = |kind| ParseError { entity: entity.map(|e| e.id.clone()), kind };
        let named = self.named(predicate, arity);
        let Some(known) = self.sources.get(&(named.clone(), arity)) else {
            check_name(predicate.as_str()).map_err(|e| error(ParseErrorKind::Name(e.to_string())))?;
            // A model with such a predicate could not be read again.
            if arity > MOST_PARAMETERS {
                return Err(error(ParseErrorKind::TooManyArguments { predicate: predicate.clone(), arity }));
            }
            self.sources.insert((named.clone(), arity), PredicateSource { kind, name: name.clone() });
            return Ok(named);
        };
        let symbolic = kind == SourceKind::Symbolic || known.kind == SourceKind::Symbolic;
        if !symbolic && (known.kind, &known.name) != (kind, name) {
            let second = PredicateSource { kind, name: name.clone() };
            return Err(error(ParseErrorKind::TwoSources {
                predicate: predicate.clone(),
                first: known.describe(),
                second: second.describe(),
            }));
        }
        Ok(named)
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
        ] {
            assert_eq!(symbolic(atoms, unknown).expect_err(message), message);
        }
    }

    #[test]
    fn predicates_of_one_name_are_told_apart_where_the_model_does() {
        let text =
            r#"{"objects":{"a":"agent","p":"plate"},"atoms":["at(a)","at(a,p)","on/2(p,a)"],"unknown":["at(p,*)"]}"#;
        let names = |mut parser: Parser| {
            let state = parser.parse(&scene(text)).expect("a state");
            let unknown = GroundAtom::parse("at/2(p,p)").expect("an atom");
            let atoms: Vec<String> = state.atoms.iter().map(ToString::to_string).collect();
            (atoms.join(" "), state.is_unknown(&unknown))
        };
        assert_eq!(names(parser()), ("at(a) at(a,p) on(p,a)".to_owned(), false), "as observed");
        let by_arity = BTreeSet::from([Symbol::new("at")]);
        let split = Parser { config: ParseConfig { by_arity, ..ParseConfig::default() }, ..parser() };
        assert_eq!(names(split), ("at/1(a) at/2(a,p) on(p,a)".to_owned(), true));
        let object = parser().hierarchy().root();
        let of_model = |name: &str, arity| ArgumentTypes::from([(Symbol::new(name), vec![object; arity])]);
        let one = parser().knowing(&of_model("at", 1));
        assert_eq!(names(one), ("at(a) at/2(a,p) on(p,a)".to_owned(), true), "only at(a) is the model's");
        let literal = parser().knowing(&of_model("on/2", 2));
        assert_eq!(names(literal).0, "at(a) at(a,p) on/2(p,a)", "a domain may have such a name");
    }

    #[test]
    fn attributes_and_relations_of_one_name_are_told_apart_by_their_arguments() {
        let state = parser().parse(&scene(
            r#"{"entities":[{"id":"a","type":"agent","attributes":{"on_holds":true},"relations":{"on":"a"}}]}"#,
        ));
        let atoms: Vec<String> = state.expect("a state").atoms.iter().map(ToString::to_string).collect();
        assert_eq!(atoms, ["on_holds(a)", "on_holds(a,a)"]);
        let twice = parser().parse(&scene(
            r#"{"entities":[{"id":"a","type":"agent","attributes":{"on_None":true},"relations":{"on":null}}]}"#,
        ));
        assert!(matches!(twice.expect_err("one argument each").kind, ParseErrorKind::TwoSources { .. }));
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
