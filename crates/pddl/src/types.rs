//! Type hierarchies: a `(:types …)` block alone, or that of a domain.

use std::collections::BTreeMap;

use typelift_model::{Hierarchy, HierarchyError, ROOT, Symbol};

use crate::names::check_new_name;
use crate::{Definition, DefinitionKind, Document, PddlError, Sexpr, Span, read_typed_list};

/// One declared type with its parent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TypeEdge {
    /// The type.
    pub child: Symbol,
    /// The type it lies below; `object` if none is stated.
    pub parent: Symbol,
    /// Where the child's name stands in the declaration.
    pub span: Span,
}

/// Reads the declared types of a `(:types …)` block or of a domain, in the order of the text. A domain without the
/// block declares none.
///
/// Spellings of one name that differ in case are one type, spelled as where it is first declared.
///
/// # Errors
/// [`PddlError`] if the text is neither of the two, or a parent is `(either …)`.
pub fn read_types(text: &str) -> Result<Vec<TypeEdge>, PddlError> {
    let document = Document::read(text)?;
    let root = document.only_root()?;
    let block = if root.has_head(":types") {
        Some(root)
    } else {
        match Definition::read(root)? {
            Some(domain) if domain.kind == DefinitionKind::Domain => domain.block(":types")?,
            Some(_) => return Err(root.error("this is a problem; types are declared in a domain")),
            None => return Err(root.error("neither a `(:types …)` block nor a domain")),
        }
    };
    block.map_or(Ok(Vec::new()), types_of_block)
}

/// The types that a `(:types …)` block declares, as [`read_types`] reads them.
pub(crate) fn types_of_block(block: Sexpr<'_>) -> Result<Vec<TypeEdge>, PddlError> {
    let mut items = block.children();
    items.next();
    let declared = read_typed_list(items)?;
    let mut spelling: BTreeMap<String, Symbol> = BTreeMap::from([(ROOT.to_owned(), Symbol::new(ROOT))]);
    let mut spelled = |name: &str| -> Symbol {
        spelling.entry(name.to_ascii_lowercase()).or_insert_with(|| Symbol::new(name)).clone()
    };
    let text = block.document_text();
    for name in &declared {
        check_new_name(text, name.name, name.span)?;
        spelled(name.name);
    }
    declared
        .iter()
        .map(|declaration| {
            let parent = declaration.ty.map_or(Ok(ROOT), parent_name)?;
            check_new_name(text, parent, declaration.ty.map_or(declaration.span, Sexpr::span))?;
            Ok(TypeEdge { child: spelled(declaration.name), parent: spelled(parent), span: declaration.span })
        })
        .collect()
}

fn parent_name(ty: Sexpr<'_>) -> Result<&str, PddlError> {
    ty.atom().ok_or_else(|| {
        if ty.has_head("either") {
            let error = ty.error("a type cannot lie below `either` of several types");
            error.with_hint("Give the type one parent; types form a tree.").as_unsupported()
        } else {
            ty.error("the name of a type is expected here, not a list")
        }
    })
}

/// Reads the hierarchy of a `(:types …)` block or of a domain; without the block it is the root alone.
///
/// # Errors
/// [`PddlError`] as for [`read_types`], and at the declarations that do not form a tree.
pub fn read_hierarchy(text: &str) -> Result<Hierarchy, PddlError> {
    hierarchy_from_types(&Hierarchy::default(), text, &read_types(text)?)
}

/// `base` with the types declared in `text`.
///
/// # Errors
/// [`PddlError`] at the declarations that do not form a tree.
pub fn hierarchy_from_types(base: &Hierarchy, text: &str, edges: &[TypeEdge]) -> Result<Hierarchy, PddlError> {
    base.extended(edges.iter().map(|edge| (edge.child.as_str(), edge.parent.as_str())))
        .map_err(|error| locate_hierarchy_error(text, edges, &error))
}

/// Finds the declarations that an error of the hierarchy is about.
pub fn locate_hierarchy_error(text: &str, edges: &[TypeEdge], error: &HierarchyError) -> PddlError {
    let find = |child: &str, parent: &str| {
        edges.iter().find(|edge| edge.child == *child && edge.parent == *parent).map(|edge| edge.span)
    };
    let at = |span: Option<Span>| {
        let error = PddlError::new(text, span.unwrap_or_default(), error.to_string());
        error.with_hint("Types form a tree: take one of the declarations out.")
    };
    match error {
        HierarchyError::TwoParents { child, first, second } => {
            let located = at(find(child.as_str(), second.as_str()));
            match find(child.as_str(), first.as_str()) {
                Some(span) => located.with_related(text, span, format!("first declared below `{first}` here")),
                None => located,
            }
        }
        HierarchyError::Cycle { path } => {
            let mut spans: Vec<Span> =
                path.windows(2).filter_map(|pair| find(pair[0].as_str(), pair[1].as_str())).collect();
            spans.sort_unstable_by_key(|span| span.start);
            let located = at(spans.last().copied());
            match spans.as_slice() {
                [first, .., _] => located.with_related(text, *first, "the cycle begins here"),
                _ => located,
            }
        }
        HierarchyError::RootHasParent { parent } => {
            at(find(ROOT, parent.as_str())).with_hint("Take this declaration out.")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(text: &str) -> Vec<String> {
        let hierarchy = read_hierarchy(text).expect(text);
        hierarchy.edges().map(|(child, parent)| format!("{child}<{parent}")).collect()
    }

    fn refused(text: &str) -> PddlError {
        read_hierarchy(text).expect_err(text)
    }

    #[test]
    fn every_way_to_declare() {
        assert_eq!(
            edges("(:types apple banana - fruit fruit - food)"),
            ["food<object", "fruit<food", "apple<fruit", "banana<fruit"]
        );
        assert_eq!(edges("(:TYPES a - OBJECT b)"), ["a<object", "b<object"]);
        assert_eq!(edges("(:types object a - object)"), ["a<object"]);
        assert_eq!(edges("(:types Apple - FRUIT Fruit - object)"), ["Fruit<object", "Apple<Fruit"]);
        assert_eq!(edges("(:types)"), [""; 0]);
        assert_eq!(
            edges("(define (domain d) (:requirements :typing)\n (:types\n\ta - b ; why not\n))"),
            ["b<object", "a<b"]
        );
        assert_eq!(edges("(define (domain d) (:predicates (p)))"), [""; 0]);
    }

    #[test]
    fn two_parents_show_both_declarations() {
        let text = "(:types\n  a - b\n  c\n  A - c)";
        assert_eq!(
            refused(text).render("t.pddl", text),
            "t.pddl:4:3: type `a` has two parents, `b` and `c`\n  |\n2 |   a - b\n  |   - first declared below `b` here\n\
             4 |   A - c)\n  |   ^\n"
        );
    }

    #[test]
    fn a_cycle_shows_declarations_on_it() {
        let text = "(:types\n  x - object\n  a - b\n  b - c\n  c - a)";
        assert_eq!(
            refused(text).render("t.pddl", text),
            "t.pddl:5:3: the type hierarchy has a cycle: a - b - c - a\n  |\n3 |   a - b\n  |   - the cycle begins here\n\
             5 |   c - a)\n  |   ^\n"
        );
        assert_eq!(refused("(:types a - a)").to_string(), "line 1, column 9: the type hierarchy has a cycle: a - a");
    }

    #[test]
    fn what_else_is_refused() {
        let either = refused("(:types a - (either b c))");
        assert_eq!(either.to_string(), "line 1, column 13: a type cannot lie below `either` of several types");
        assert!(either.unsupported && either.hint.is_some());
        for (text, message) in [
            (
                "(:types object - thing)",
                "line 1, column 9: `object` is the root of every hierarchy and cannot have the parent `thing`",
            ),
            ("(:types a - (b))", "line 1, column 13: the name of a type is expected here, not a list"),
            ("(:types a,b - c)", "line 1, column 9: `a,b` cannot be a name: it holds one of ( ) , ; \""),
            ("(:types a - b\u{A0})", "line 1, column 13: `b\u{A0}` cannot be a name: it holds white space"),
            ("(:types a - -)", "line 1, column 13: `-` cannot be a name: it stands before a type"),
            ("(:predicates (p))", "line 1, column 1: neither a `(:types …)` block nor a domain"),
            ("(define (problem p))", "line 1, column 1: this is a problem; types are declared in a domain"),
            ("(define)", "line 1, column 1: there is no `(domain NAME)` or `(problem NAME)` after `define`"),
            ("(define (world w))", "line 1, column 9: `(domain NAME)` or `(problem NAME)` is expected here"),
            ("(define (domain a b))", "line 1, column 9: exactly one name is expected here"),
            ("(define (domain d)\n(:types a)\n(:types b))", "line 3, column 1: there is a second `:types` block"),
            ("types", "line 1, column 1: neither a `(:types …)` block nor a domain"),
        ] {
            assert_eq!(refused(text).to_string(), message);
        }
    }

    #[test]
    fn extending_points_at_the_new_declaration() {
        let base = read_hierarchy("(:types a - b)").expect("a tree");
        let text = "(:types new - b\n a - c)";
        let error = hierarchy_from_types(&base, text, &read_types(text).expect("edges")).expect_err("two parents");
        assert_eq!(error.to_string(), "line 2, column 2: type `a` has two parents, `b` and `c`");
        assert_eq!(error.related, None);
    }
}
