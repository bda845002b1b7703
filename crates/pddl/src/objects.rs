//! Declared objects: those of a problem, the constants of a domain, or an `(:objects …)` block alone.

use std::collections::BTreeMap;

use typelift_model::{ROOT, Symbol};

use crate::{Definition, DefinitionKind, Document, PddlError, Sexpr, Span, read_typed_list};

/// One declared object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ObjectDeclaration {
    /// Its name, in lower case.
    pub name: Symbol,
    /// Its type's name, in lower case; `object` if none is stated.
    pub ty: Symbol,
    /// Where its name stands.
    pub span: Span,
}

/// The objects that a file declares.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Declarations {
    /// What the file defines; `None` for a block alone.
    pub kind: Option<DefinitionKind>,
    /// The name of what it defines, in lower case.
    pub name: Option<Symbol>,
    /// The objects, in the order of the text; names are unique.
    pub objects: Vec<ObjectDeclaration>,
}

/// Reads the `:objects` of a problem, the `:constants` of a domain, or such a block alone. A file without the block
/// declares none.
///
/// # Errors
/// [`PddlError`] if the text is none of these, an object is declared twice, or a type is `(either …)`.
pub fn read_objects(text: &str) -> Result<Declarations, PddlError> {
    let document = Document::read(text)?;
    let root = document.only_root()?;
    let (kind, name, block) = if root.has_head(":objects") || root.has_head(":constants") {
        (None, None, Some(root))
    } else {
        let Some(definition) = Definition::read(root)? else {
            return Err(root.error("neither a problem nor an `(:objects …)` block"));
        };
        let key = match definition.kind {
            DefinitionKind::Domain => ":constants",
            DefinitionKind::Problem => ":objects",
        };
        (Some(definition.kind), Some(Symbol::from(definition.name.to_ascii_lowercase())), definition.block(key)?)
    };
    let Some(block) = block else { return Ok(Declarations { kind, name, objects: Vec::new() }) };
    let mut items = block.children();
    items.next();
    let mut objects = Vec::new();
    let mut first: BTreeMap<Symbol, Span> = BTreeMap::new();
    for declaration in read_typed_list(items)? {
        let name = Symbol::from(declaration.name.to_ascii_lowercase());
        let ty = match declaration.ty {
            None => ROOT,
            Some(ty) => one_type(ty)?,
        };
        if let Some(known) = first.insert(name.clone(), declaration.span) {
            let error = PddlError::new(text, declaration.span, format!("object `{name}` is declared twice"));
            return Err(error.with_related(text, known, "first declared here"));
        }
        objects.push(ObjectDeclaration { name, ty: Symbol::from(ty.to_ascii_lowercase()), span: declaration.span });
    }
    Ok(Declarations { kind, name, objects })
}

/// The type of an object as it is written.
///
/// # Errors
/// [`PddlError`] at a list.
pub(crate) fn one_type(ty: Sexpr<'_>) -> Result<&str, PddlError> {
    ty.atom().ok_or_else(|| {
        let error = ty.error("an object has one type, not `either` of several");
        error.with_hint("Give the object one type.").as_unsupported()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn objects(text: &str) -> Vec<String> {
        let declarations = read_objects(text).expect(text);
        declarations.objects.iter().map(|o| format!("{}:{}", o.name, o.ty)).collect()
    }

    #[test]
    fn problems_domains_and_blocks() {
        let problem = "(define (problem p) (:domain d)\n(:objects A b - Block c) (:init (on a b)))";
        assert_eq!(objects(problem), ["a:block", "b:block", "c:object"]);
        assert_eq!(read_objects(problem).expect("a problem").kind, Some(DefinitionKind::Problem));
        assert_eq!(objects("(define (domain d) (:constants home - place))"), ["home:place"]);
        assert_eq!(objects("(:objects x - t)"), ["x:t"]);
        assert_eq!(objects("(define (problem p) (:domain d))"), [""; 0]);
    }

    #[test]
    fn what_is_refused() {
        let twice = "(:objects a - t\n b A - u)";
        let error = read_objects(twice).expect_err("twice");
        assert_eq!(
            error.render("p.pddl", twice),
            "p.pddl:2:4: object `a` is declared twice\n  |\n1 | (:objects a - t\n  |           - first declared here\n\
             2 |  b A - u)\n  |    ^\n"
        );
        let either = read_objects("(:objects a - (either t u))").expect_err("either");
        assert_eq!(either.to_string(), "line 1, column 15: an object has one type, not `either` of several");
        let other = read_objects("(:types a)").expect_err("types");
        assert_eq!(other.to_string(), "line 1, column 1: neither a problem nor an `(:objects …)` block");
    }
}
