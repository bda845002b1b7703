//! Reads domains.

use typelift_model::{ArgumentTypes, EQUALS, Hierarchy, MOST_PARAMETERS, Symbol, TypeId};

use crate::definition::refuse_other_blocks;
use crate::effect_reader::EffectReader;
use crate::formula_reader::{RESERVED, parts};
use crate::names::{declared_name, lower, new_name};
use crate::objects::one_type;
use crate::requirements::read_requirements;
use crate::scope::{Scope, read_variables};
use crate::types::types_of_block;
use crate::vocabulary::{DeclaredIn, Vocabulary};
use crate::{
    Action, Definition, DefinitionKind, Derived, Document, Domain, Formula, PddlEffect, PddlError, Sexpr, Signature,
    Span, Typed, hierarchy_from_types, read_typed_list,
};

const BLOCKS: [&str; 7] = [":requirements", ":types", ":constants", ":predicates", ":functions", ":derived", ":action"];

/// Reads a domain. Its blocks may stand in any order.
///
/// # Errors
/// [`PddlError`] at what is wrong, or is right but not supported.
pub fn read_domain(text: &str) -> Result<Domain, PddlError> {
    let document = Document::read(text)?;
    let definition = Definition::only(&document, DefinitionKind::Domain)?;
    refuse_other_blocks(&definition, &BLOCKS)?;
    let edges = definition.block(":types")?.map_or(Ok(Vec::new()), types_of_block)?;
    let hierarchy = hierarchy_from_types(&Hierarchy::default(), text, &edges)?;
    let mut types: Vec<(Symbol, Symbol)> = Vec::new();
    for edge in edges.into_iter().filter(|edge| edge.child != hierarchy.name(hierarchy.root()).as_str()) {
        let pair = (edge.child, edge.parent);
        if !types.contains(&pair) {
            types.push(pair);
        }
    }
    let mut vocabulary = Vocabulary::with_types(hierarchy, DeclaredIn::Domain);
    let mut domain = Domain {
        name: Symbol::new(&lower(definition.name)),
        requirements: read_requirements(definition.block(":requirements")?)?,
        types,
        constants: read_objects_block(&mut vocabulary, definition.block(":constants")?, "constant")?,
        predicates: read_predicates(&mut vocabulary, definition.block(":predicates")?)?,
        functions: read_functions(&mut vocabulary, definition.block(":functions")?)?,
        ..Domain::default()
    };
    for block in blocks(&definition, ":derived") {
        let [head, _] = parts(block, "a predicate with its variables and one condition")?;
        if let Some(name) = head.head() {
            vocabulary.derived.insert(Symbol::new(&lower(name)));
        }
    }
    domain.derived =
        blocks(&definition, ":derived").map(|block| read_derived(&vocabulary, block)).collect::<Result<_, _>>()?;
    let mut names: Vec<(Symbol, Span)> = Vec::new();
    for block in blocks(&definition, ":action") {
        let (action, span) = read_action(&vocabulary, block)?;
        if let Some((_, first)) = names.iter().find(|(name, _)| *name == action.name) {
            let error = PddlError::new(text, span, format!("action `{}` is declared twice", action.name));
            return Err(error.with_related(text, *first, "first declared here"));
        }
        names.push((action.name.clone(), span));
        domain.actions.push(action);
    }
    Ok(domain)
}

/// The predicates that a domain declares, each argument with the lowest type that covers what may stand there. Nothing else
/// of the domain is read but for its types, which are given.
///
/// # Errors
/// [`PddlError`] if it is no domain, or at what is wrong in its `:predicates`.
pub fn read_declared_predicates(text: &str, types: &Hierarchy) -> Result<ArgumentTypes, PddlError> {
    let document = Document::read(text)?;
    let definition = Definition::only(&document, DefinitionKind::Domain)?;
    let mut vocabulary = Vocabulary::with_types(types.clone(), DeclaredIn::Domain);
    let signatures = read_predicates(&mut vocabulary, definition.block(":predicates")?)?;
    let lowest = |parameter: &Typed| -> TypeId {
        vocabulary.ids(parameter).into_iter().reduce(|a, b| types.lca(a, b)).unwrap_or(types.root())
    };
    let typed = |signature: Signature| (signature.name, signature.parameters.iter().map(lowest).collect());
    Ok(signatures.into_iter().map(typed).collect())
}

fn blocks<'d>(definition: &Definition<'d>, key: &'static str) -> impl Iterator<Item = Sexpr<'d>> {
    definition.blocks().filter(move |block| block.has_head(key))
}

/// Reads the constants of a domain or the objects of a problem into the vocabulary; those that are new are returned.
pub(crate) fn read_objects_block(
    vocabulary: &mut Vocabulary,
    block: Option<Sexpr<'_>>,
    kind: &str,
) -> Result<Vec<Typed>, PddlError> {
    let Some(block) = block else { return Ok(Vec::new()) };
    let text = block.document_text();
    let mut items = block.children();
    items.next();
    let mut objects = Vec::new();
    for written in read_typed_list(items)? {
        written.ty.map(one_type).transpose()?;
        let name = new_name(text, written.name, written.span)?;
        let object = Typed { name, types: vocabulary.types_written(written.ty)? };
        if vocabulary.declare_object(text, kind, &object, written.span)? {
            objects.push(object);
        }
    }
    Ok(objects)
}

/// A predicate or function with its arguments: `(on ?x ?y - block)`.
fn read_signature(vocabulary: &Vocabulary, item: Sexpr<'_>, kind: &str) -> Result<Signature, PddlError> {
    let mut items = item.children();
    let Some(name) = items.next() else {
        let error = item.error(format!("a {kind} in parentheses is expected here"));
        return Err(error.with_hint(format!("Write `({kind} ?x …)`.")));
    };
    let parameters = read_variables(item, items, vocabulary)?.0;
    if parameters.len() > MOST_PARAMETERS {
        let error = item.error(format!("a {kind} with more than {MOST_PARAMETERS} arguments is not supported"));
        return Err(error.as_unsupported());
    }
    Ok(Signature { name: declared_name(name)?, parameters })
}

fn read_predicates(vocabulary: &mut Vocabulary, block: Option<Sexpr<'_>>) -> Result<Vec<Signature>, PddlError> {
    let mut predicates = Vec::new();
    for item in block.into_iter().flat_map(|block| block.children().skip(1)) {
        // Some domains declare what is there anyway.
        if item.has_head(EQUALS) && item.children().count() > 2 {
            continue;
        }
        let signature = read_signature(vocabulary, item, "predicate")?;
        if RESERVED.contains(&signature.name.as_str()) {
            return Err(item.error(format!("`{}` is a word of PDDL, not the name of a predicate", signature.name)));
        }
        vocabulary.declare_predicate(item.document_text(), &signature, item.span())?;
        predicates.push(signature);
    }
    Ok(predicates)
}

fn read_functions(vocabulary: &mut Vocabulary, block: Option<Sexpr<'_>>) -> Result<Vec<Signature>, PddlError> {
    let mut functions = Vec::new();
    let mut items = block.into_iter().flat_map(|block| block.children().skip(1));
    while let Some(item) = items.next() {
        if item.is("-") {
            match items.next() {
                Some(ty) if ty.is("number") => {}
                Some(ty) => {
                    let error = ty.error("functions whose value is not a number are not supported");
                    return Err(error.as_unsupported());
                }
                None => return Err(item.error("there is no type after this `-`")),
            }
            continue;
        }
        let signature = read_signature(vocabulary, item, "function")?;
        vocabulary.declare_function(item.document_text(), &signature, item.span())?;
        functions.push(signature);
    }
    Ok(functions)
}

fn read_derived(vocabulary: &Vocabulary, block: Sexpr<'_>) -> Result<Derived, PddlError> {
    let [head, condition] = parts(block, "a predicate with its variables and one condition")?;
    let mut scope = Scope::new(vocabulary);
    let (declared, parameters) = scope.head(head)?;
    let head = Signature { name: declared.signature.name.clone(), parameters };
    Ok(Derived { head, condition: scope.condition(condition, 0)?, comment: Vec::new() })
}

/// An action, and where its name stands.
fn read_action(vocabulary: &Vocabulary, block: Sexpr<'_>) -> Result<(Action, Span), PddlError> {
    let mut items = block.children();
    items.next();
    let Some(name) = items.next() else {
        return Err(block.error("this action has no name"));
    };
    let mut action = Action {
        name: declared_name(name)?,
        parameters: Vec::new(),
        precondition: Formula::truth(),
        effect: PddlEffect::And(Vec::new()),
        comment: Vec::new(),
    };
    let [parameters, precondition, effect] = read_fields(items)?;
    let mut scope = Scope::new(vocabulary);
    if let Some(parameters) = parameters {
        action.parameters = scope.enter(parameters)?;
    }
    if let Some(precondition) = precondition {
        action.precondition = scope.condition(precondition, 0)?;
    }
    if let Some(effect) = effect {
        action.effect = EffectReader::new(&mut scope).read(effect)?;
    }
    Ok((action, name.span()))
}

/// The values of `:parameters`, `:precondition` and `:effect`, as far as they are there.
fn read_fields<'d>(mut items: impl Iterator<Item = Sexpr<'d>>) -> Result<[Option<Sexpr<'d>>; 3], PddlError> {
    const FIELDS: [&str; 3] = [":parameters", ":precondition", ":effect"];
    let mut keys: [Option<Sexpr<'d>>; 3] = [None; 3];
    let mut values = [None; 3];
    while let Some(key) = items.next() {
        let Some(field) = FIELDS.iter().position(|field| key.is(field)) else {
            return Err(match key.atom().map(lower).as_deref() {
                Some(word @ (":vars" | ":duration" | ":condition" | ":expansion" | ":maintain" | ":observe")) => {
                    key.error(format!("`{word}` of an action is not supported")).as_unsupported()
                }
                _ => key.error("`:parameters`, `:precondition` or `:effect` is expected here"),
            });
        };
        if let Some(first) = keys[field].replace(key) {
            let error = key.error(format!("there is a second `{}`", FIELDS[field]));
            return Err(error.with_related(key.document_text(), first.span(), "the first is here"));
        }
        let Some(value) = items.next() else {
            return Err(key.error(format!("nothing follows after `{}`", FIELDS[field])));
        };
        values[field] = Some(value);
    }
    Ok(values)
}
