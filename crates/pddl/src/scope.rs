//! What a name means where it stands: variables that are bound there, objects, and atoms over both.

use typelift_model::{Atom, GroundAtom, Hierarchy, Symbol, TypeId, did_you_mean};

use crate::names::{lower, new_variable};
use crate::vocabulary::{Declared, Signatures, Vocabulary};
use crate::{Children, PddlAtom, PddlError, PddlTerm, Sexpr, Span, Typed, read_typed_list};

/// What is declared, and the variables that are bound at a place.
#[derive(Debug)]
pub(crate) struct Scope<'v> {
    pub(crate) vocabulary: &'v Vocabulary,
    /// The inner ones later.
    variables: Vec<Variable>,
    /// Whether objects may stand anywhere, whatever their types.
    takes_any_object: bool,
}

#[derive(Debug)]
struct Variable {
    name: Symbol,
    types: Vec<TypeId>,
}

/// What the types of an argument say about where it may stand.
#[derive(Debug, Clone, Copy)]
enum Types<'a> {
    /// What a variable stands for may be of a type below these.
    Variable(&'a [TypeId]),
    /// An object is of its type, and of nothing below it.
    Object(&'a [TypeId]),
    /// It may stand anywhere.
    Anywhere,
}

impl<'a> Types<'a> {
    /// The types, if it is of none of those `wanted` and cannot be.
    fn misfit(self, wanted: &[TypeId], hierarchy: &Hierarchy) -> Option<&'a [TypeId]> {
        let (given, is_variable) = match self {
            Self::Variable(given) => (given, true),
            Self::Object(given) => (given, false),
            Self::Anywhere => return None,
        };
        let fits = |g, w| if is_variable { !hierarchy.disjoint(g, w) } else { hierarchy.is_a(g, w) };
        (!given.iter().any(|&g| wanted.iter().any(|&w| fits(g, w)))).then_some(given)
    }
}

impl<'v> Scope<'v> {
    /// Without variables.
    pub(crate) fn new(vocabulary: &'v Vocabulary) -> Self {
        Self { vocabulary, variables: Vec::new(), takes_any_object: false }
    }

    /// Without variables, in a problem: what holds there, or is to hold, may be about objects of other types than are
    /// declared for it, as for planners that do not look at types.
    pub(crate) fn of_problem(vocabulary: &'v Vocabulary) -> Self {
        Self { takes_any_object: true, ..Self::new(vocabulary) }
    }

    /// Binds the variables of a typed list, until as many [leave](Self::leave).
    ///
    /// # Errors
    /// [`PddlError`] if this is no such list, a type is not declared, or a variable stands there twice.
    pub(crate) fn enter(&mut self, list: Sexpr<'_>) -> Result<Vec<Typed>, PddlError> {
        if !list.is_list() {
            let error = list.error("a list of variables is expected here");
            return Err(error.with_hint("Write `()` if there are none."));
        }
        let (variables, spans) = read_variables(list, list.children(), self.vocabulary)?;
        refuse_twice(list.document_text(), &variables, &spans)?;
        self.bind(&variables);
        Ok(variables)
    }

    /// Binds these variables.
    fn bind(&mut self, variables: &[Typed]) {
        for variable in variables {
            let types = self.vocabulary.ids(variable);
            self.variables.push(Variable { name: variable.name.clone(), types });
        }
    }

    /// Unbinds the last variables.
    pub(crate) fn leave(&mut self, count: usize) {
        self.variables.truncate(self.variables.len().saturating_sub(count));
    }

    /// The atom of a declared predicate that is written here.
    pub(crate) fn atom(&self, item: Sexpr<'_>) -> Result<PddlAtom, PddlError> {
        self.applied(item, &self.vocabulary.predicates, Self::term)
    }

    /// The declared function with its arguments that is written here.
    pub(crate) fn function(&self, item: Sexpr<'_>) -> Result<PddlAtom, PddlError> {
        self.applied(item, &self.vocabulary.functions, Self::term)
    }

    /// As [`atom`](Self::atom), over objects alone.
    pub(crate) fn ground_atom(&self, item: Sexpr<'_>) -> Result<GroundAtom, PddlError> {
        self.applied(item, &self.vocabulary.predicates, Self::object)
    }

    /// As [`function`](Self::function), over objects alone.
    pub(crate) fn ground_function(&self, item: Sexpr<'_>) -> Result<GroundAtom, PddlError> {
        self.applied(item, &self.vocabulary.functions, Self::object)
    }

    fn applied<'s, T>(
        &'s self,
        item: Sexpr<'_>,
        known: &Signatures,
        read: impl Fn(&'s Self, Sexpr<'_>) -> Result<(T, Types<'s>), PddlError>,
    ) -> Result<Atom<T>, PddlError> {
        let mut parts = item.children();
        let Some(name) = parts.next().filter(|name| !name.is_list()) else {
            return Err(item.error(format!("a {} in parentheses is expected here", known.kind)));
        };
        let declared = known.find(name)?;
        let mut args = Vec::with_capacity(declared.types.len());
        for part in parts {
            let (arg, types) = read(self, part)?;
            if let Some(wanted) = declared.types.get(args.len())
                && let Some(given) = types.misfit(wanted, &self.vocabulary.hierarchy)
            {
                return Err(self.misfit(known.kind, part, given, declared, wanted));
            }
            args.push(arg);
            if args.len() > declared.types.len() {
                break;
            }
        }
        if args.len() == declared.types.len() {
            return Ok(Atom { predicate: declared.signature.name.clone(), args });
        }
        Err(wrong_arity(item, known.kind, declared, item.children().count() - 1))
    }

    /// The declared predicate of the head of a derived one, and its variables, which are bound from here on.
    pub(crate) fn head(&mut self, item: Sexpr<'_>) -> Result<(&'v Declared, Vec<Typed>), PddlError> {
        let mut items = item.children();
        let Some(name) = items.next().filter(|name| !name.is_list()) else {
            return Err(item.error("a predicate with its variables is expected here"));
        };
        let predicates = &self.vocabulary.predicates;
        let declared = predicates.find(name)?;
        let (variables, spans) = read_variables(item, items, self.vocabulary)?;
        refuse_twice(item.document_text(), &variables, &spans)?;
        if variables.len() != declared.types.len() {
            return Err(wrong_arity(item, predicates.kind, declared, variables.len()));
        }
        self.bind(&variables);
        Ok((declared, variables))
    }

    fn misfit(
        &self,
        kind: &str,
        part: Sexpr<'_>,
        types: &[TypeId],
        declared: &Declared,
        wanted: &[TypeId],
    ) -> PddlError {
        let [given, wanted] = [types, wanted].map(|types| self.vocabulary.show_types(types));
        let name = &declared.signature.name;
        let message = format!("`{}` is of type `{given}`, {kind} `{name}` takes `{wanted}` here", lower(part.text()));
        let note = format!("Not every `{given}` is a `{wanted}`. ");
        with_declaration(part.document_text(), part.error(message), declared, &note)
    }

    fn term(&self, part: Sexpr<'_>) -> Result<(PddlTerm, Types<'_>), PddlError> {
        let Some(name) = part.text().strip_prefix('?').filter(|_| !part.is_list()) else {
            let (object, types) = self.object(part)?;
            return Ok((PddlTerm::Object(object), types));
        };
        let name = lower(name);
        match self.variables.iter().rev().find(|variable| variable.name == *name) {
            Some(variable) => Ok((PddlTerm::Variable(variable.name.clone()), Types::Variable(&variable.types))),
            None => {
                let near = did_you_mean(&name, self.variables.iter().map(|variable| &variable.name));
                let hint = near.map(|near| near.replacen('`', "`?", 1));
                let error = part.error(format!("variable `?{name}` is not declared"));
                Err(error.with_hint(
                    hint.unwrap_or_else(|| "Add it to the parameters, or to those of a quantifier.".to_owned()),
                ))
            }
        }
    }

    /// A variable or an object, with its types.
    pub(crate) fn any_term(&self, part: Sexpr<'_>) -> Result<PddlTerm, PddlError> {
        self.term(part).map(|(term, _)| term)
    }

    fn object(&self, part: Sexpr<'_>) -> Result<(Symbol, Types<'_>), PddlError> {
        let Some(name) = part.atom() else {
            return Err(part.error("a name is expected here, not a list"));
        };
        let name = lower(name);
        match self.vocabulary.objects.get_key_value(&*name) {
            Some((name, _)) if self.takes_any_object => Ok((name.clone(), Types::Anywhere)),
            Some((name, object)) => Ok((name.clone(), Types::Object(&object.types))),
            None if name.starts_with('?') => {
                Err(part.error(format!("variable `{name}` stands where only objects may")))
            }
            None => {
                let mut known: Vec<&Symbol> = self.vocabulary.objects.keys().collect();
                known.sort();
                let error = part.error(format!("object `{name}` is not declared"));
                let is_type = self.vocabulary.is_type(&name);
                Err(error.with_hint(match did_you_mean(&name, known).filter(|_| !is_type) {
                    Some(question) => question,
                    None if is_type => format!("`{name}` is a type: name an object of it."),
                    None => {
                        "Declare it in `(:objects …)` of the problem or in `(:constants …)` of the domain.".to_owned()
                    }
                }))
            }
        }
    }
}

fn wrong_arity(item: Sexpr<'_>, kind: &str, declared: &Declared, given: usize) -> PddlError {
    let takes = match declared.types.len() {
        1 => "1 argument".to_owned(),
        n => format!("{n} arguments"),
    };
    let error = item.error(format!("{kind} `{}` takes {takes}, here it has {given}", declared.signature.name));
    with_declaration(item.document_text(), error, declared, "")
}

/// The variables of a typed list, with their places.
pub(crate) fn read_variables<'d>(
    list: Sexpr<'d>,
    items: Children<'d>,
    vocabulary: &Vocabulary,
) -> Result<(Vec<Typed>, Vec<Span>), PddlError> {
    let text = list.document_text();
    let mut spans = Vec::new();
    let mut variables = Vec::new();
    for written in read_typed_list(items)? {
        let name = new_variable(text, written.name, written.span)?;
        variables.push(Typed { name, types: vocabulary.types_written(written.ty)? });
        spans.push(written.span);
    }
    Ok((variables, spans))
}

/// # Errors
/// [`PddlError`] at a variable that stands there twice.
fn refuse_twice(text: &str, variables: &[Typed], spans: &[Span]) -> Result<(), PddlError> {
    for (i, variable) in variables.iter().enumerate() {
        if let Some(first) = variables[..i].iter().position(|earlier| earlier.name == variable.name) {
            let error = PddlError::new(text, spans[i], format!("variable `?{}` is declared twice", variable.name));
            return Err(error.with_related(text, spans[first], "first declared here"));
        }
    }
    Ok(())
}

/// The error with the declaration that it is about.
fn with_declaration(text: &str, error: PddlError, declared: &Declared, note: &str) -> PddlError {
    let error = error.with_hint(format!("{note}It is declared as `{}`.", declared.signature));
    match declared.span {
        Some(span) => error.with_related(text, span, "declared here"),
        None => error,
    }
}
