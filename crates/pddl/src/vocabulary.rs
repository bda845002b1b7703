//! What was declared and may be mentioned: types, predicates, functions and objects, by their names in lower case.

use typelift_model::{HashMap, HashSet, Hierarchy, ROOT, Symbol, TypeId, did_you_mean};

use crate::names::lower;
use crate::{Domain, PddlError, Sexpr, Signature, Span, Typed};

/// A declared predicate or function.
#[derive(Debug)]
pub(crate) struct Declared {
    pub(crate) signature: Signature,
    /// The types of each argument.
    pub(crate) types: Vec<Vec<TypeId>>,
    /// Where it is declared, if that is in the text that is read.
    pub(crate) span: Option<Span>,
}

/// A declared object or constant.
#[derive(Debug)]
pub(crate) struct DeclaredObject {
    /// Its types: one.
    pub(crate) types: Vec<TypeId>,
    /// Where it is declared, if that is in the text that is read.
    pub(crate) span: Option<Span>,
}

/// What says which types, predicates and functions there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DeclaredIn {
    Domain,
    /// A model that was not made from a domain.
    Model,
}

impl DeclaredIn {
    /// What to do about a thing of this kind that is not declared.
    fn advice(self, kind: &str) -> String {
        match self {
            Self::Domain => format!("Declare it in `(:{kind}s …)` of the domain."),
            Self::Model => format!("The model has no such {kind}: it was learned without it."),
        }
    }
}

/// Predicates, or functions.
#[derive(Debug)]
pub(crate) struct Signatures {
    /// What they are called: `predicate`.
    pub(crate) kind: &'static str,
    declared_in: DeclaredIn,
    by_name: HashMap<Symbol, Declared>,
}

/// All that was declared.
#[derive(Debug)]
pub(crate) struct Vocabulary {
    pub(crate) hierarchy: Hierarchy,
    declared_in: DeclaredIn,
    /// The spelling of each type.
    types: HashMap<String, Symbol>,
    pub(crate) predicates: Signatures,
    pub(crate) functions: Signatures,
    pub(crate) objects: HashMap<Symbol, DeclaredObject>,
    /// The predicates that are derived.
    pub(crate) derived: HashSet<Symbol>,
}

impl Signatures {
    fn new(kind: &'static str, declared_in: DeclaredIn) -> Self {
        Self { kind, declared_in, by_name: HashMap::default() }
    }

    fn insert(&mut self, signature: &Signature, hierarchy: &Hierarchy, span: Option<Span>) {
        let types = signature.parameters.iter().map(|parameter| type_ids(hierarchy, parameter)).collect();
        self.by_name.insert(signature.name.clone(), Declared { signature: signature.clone(), types, span });
    }

    pub(crate) fn get(&self, name: &str) -> Option<&Declared> {
        self.by_name.get(&*lower(name))
    }

    /// The one that is named at `name`.
    pub(crate) fn find(&self, name: Sexpr<'_>) -> Result<&Declared, PddlError> {
        let text = name.text();
        self.get(text).ok_or_else(|| {
            let mut known: Vec<&Symbol> = self.by_name.keys().collect();
            known.sort();
            let error = name.error(format!("{} `{}` is not declared", self.kind, lower(text)));
            error.with_hint(did_you_mean(text, known).unwrap_or_else(|| self.declared_in.advice(self.kind)))
        })
    }
}

/// The types of a declared thing.
fn type_ids(hierarchy: &Hierarchy, typed: &Typed) -> Vec<TypeId> {
    typed.types.iter().map(|ty| hierarchy.id(ty.as_str()).unwrap_or(hierarchy.root())).collect()
}

impl Vocabulary {
    /// With these types alone.
    pub(crate) fn with_types(hierarchy: Hierarchy, declared_in: DeclaredIn) -> Self {
        let spelled = |id| {
            let name: &Symbol = hierarchy.name(id);
            (name.as_str().to_ascii_lowercase(), name.clone())
        };
        Self {
            types: hierarchy.types().map(spelled).collect(),
            hierarchy,
            declared_in,
            predicates: Signatures::new("predicate", declared_in),
            functions: Signatures::new("function", declared_in),
            objects: HashMap::default(),
            derived: HashSet::default(),
        }
    }

    /// That of a domain that was read before, or that states what a model declares.
    ///
    /// # Errors
    /// [`PddlError`] if its types form a cycle.
    pub(crate) fn of_domain(domain: &Domain, declared_in: DeclaredIn, text: &str) -> Result<Self, PddlError> {
        let edges = domain.types.iter().map(|(child, parent)| (child.as_str(), parent.as_str()));
        let hierarchy = Hierarchy::from_edges(edges).map_err(|error| {
            PddlError::new(text, Span::default(), format!("the types of the domain `{}`: {error}", domain.name))
        })?;
        let mut vocabulary = Self::with_types(hierarchy, declared_in);
        for signature in &domain.predicates {
            vocabulary.predicates.insert(signature, &vocabulary.hierarchy, None);
        }
        for signature in &domain.functions {
            vocabulary.functions.insert(signature, &vocabulary.hierarchy, None);
        }
        for constant in &domain.constants {
            vocabulary.add_object(constant, None);
        }
        vocabulary.derived = domain.derived.iter().map(|derived| derived.head.name.clone()).collect();
        Ok(vocabulary)
    }

    fn add_object(&mut self, object: &Typed, span: Option<Span>) {
        let types = type_ids(&self.hierarchy, object);
        self.objects.insert(object.name.clone(), DeclaredObject { types, span });
    }

    /// Adds what is declared at `span`.
    ///
    /// # Errors
    /// [`PddlError`] if there is one of this name already.
    pub(crate) fn declare_predicate(&mut self, text: &str, signature: &Signature, span: Span) -> Result<(), PddlError> {
        first_declaration(text, &self.predicates, signature, span)?;
        self.predicates.insert(signature, &self.hierarchy, Some(span));
        Ok(())
    }

    /// Adds what is declared at `span`.
    ///
    /// # Errors
    /// [`PddlError`] if there is one of this name already.
    pub(crate) fn declare_function(&mut self, text: &str, signature: &Signature, span: Span) -> Result<(), PddlError> {
        first_declaration(text, &self.functions, signature, span)?;
        self.functions.insert(signature, &self.hierarchy, Some(span));
        Ok(())
    }

    /// Adds what is declared at `span`; says whether it is new. A constant of the domain may be declared again in
    /// the problem, with the same type.
    ///
    /// # Errors
    /// [`PddlError`] if there is one of this name already.
    pub(crate) fn declare_object(
        &mut self,
        text: &str,
        kind: &str,
        object: &Typed,
        span: Span,
    ) -> Result<bool, PddlError> {
        let error = |message| PddlError::new(text, span, message);
        match self.objects.get(&object.name) {
            None => {
                self.add_object(object, Some(span));
                Ok(true)
            }
            Some(DeclaredObject { span: Some(first), .. }) => Err(error(format!(
                "{kind} `{}` is declared twice",
                object.name
            ))
            .with_related(text, *first, "first declared here")),
            Some(known) if known.types == type_ids(&self.hierarchy, object) => Ok(false),
            Some(known) => {
                let ty = self.show_types(&known.types);
                let message = format!("`{}` is a constant of the domain, of type `{ty}`", object.name);
                Err(error(message).with_hint("Take it out of the objects, or give it another name."))
            }
        }
    }

    /// Whether there is a type of this name.
    pub(crate) fn is_type(&self, name: &str) -> bool {
        self.types.contains_key(&*lower(name))
    }

    /// The type that is written here, in the spelling of its declaration.
    ///
    /// # Errors
    /// [`PddlError`] if there is no such type.
    pub(crate) fn type_named(&self, ty: Sexpr<'_>) -> Result<Symbol, PddlError> {
        let Some(name) = ty.atom() else {
            return Err(ty.error("the name of a type is expected here, not a list"));
        };
        self.types.get(&*lower(name)).cloned().ok_or_else(|| {
            let known = self.hierarchy.types().map(|id| self.hierarchy.name(id));
            let hint = did_you_mean(name, known).unwrap_or_else(|| self.declared_in.advice("type"));
            ty.error(format!("type `{name}` is not declared")).with_hint(hint)
        })
    }

    /// The types that are written behind a name: `object` if there are none, several for `(either …)`.
    ///
    /// # Errors
    /// [`PddlError`] at a type that is not declared, or at another list.
    pub(crate) fn types_written(&self, ty: Option<Sexpr<'_>>) -> Result<Vec<Symbol>, PddlError> {
        let Some(ty) = ty else { return Ok(vec![Symbol::new(ROOT)]) };
        if !ty.has_head("either") {
            return Ok(vec![self.type_named(ty)?]);
        }
        let types: Vec<Symbol> = ty.children().skip(1).map(|ty| self.type_named(ty)).collect::<Result<_, _>>()?;
        if types.is_empty() { Err(ty.error("there are no types in this `either`")) } else { Ok(types) }
    }

    pub(crate) fn ids(&self, typed: &Typed) -> Vec<TypeId> {
        type_ids(&self.hierarchy, typed)
    }

    /// `block`, or `(either block table)`.
    pub(crate) fn show_types(&self, types: &[TypeId]) -> String {
        let names: Vec<&str> = types.iter().map(|&id| self.hierarchy.name(id).as_str()).collect();
        match names.as_slice() {
            [one] => (*one).to_owned(),
            several => format!("(either {})", several.join(" ")),
        }
    }
}

fn first_declaration(text: &str, known: &Signatures, new: &Signature, span: Span) -> Result<(), PddlError> {
    let Some(first) = known.by_name.get(&new.name) else { return Ok(()) };
    let error = PddlError::new(text, span, format!("{} `{}` is declared twice", known.kind, new.name));
    Err(match first.span {
        Some(first) => error.with_related(text, first, "first declared here"),
        None => error,
    })
}
