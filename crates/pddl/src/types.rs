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
/// [`PddlError`] if the text is neither of the two, or no type stands in an `(either …)`.
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
    let mut edges = Vec::with_capacity(declared.len());
    for declaration in &declared {
        let parents = declaration.ty.map_or(Ok(vec![(ROOT, declaration.span)]), parent_names)?;
        for (parent, span) in parents {
            check_new_name(text, parent, span)?;
            let (child, parent) = (spelled(declaration.name), spelled(parent));
            edges.push(TypeEdge { child, parent, span: declaration.span });
        }
    }
    Ok(edges)
}

/// The parents that are written behind a type: one, or all of `(either …)`.
fn parent_names<'d>(ty: Sexpr<'d>) -> Result<Vec<(&'d str, Span)>, PddlError> {
    let named = |ty: Sexpr<'d>| match ty.atom() {
        Some(name) => Ok((name, ty.span())),
        None => Err(ty.error("the name of a type is expected here, not a list")),
    };
    if !ty.has_head("either") {
        return Ok(vec![named(ty)?]);
    }
    let parents: Vec<_> = ty.children().skip(1).map(named).collect::<Result<_, _>>()?;
    if parents.is_empty() { Err(ty.error("there are no types in this `either`")) } else { Ok(parents) }
}

/// Reads the hierarchy of a `(:types …)` block or of a domain; without the block it is the root alone.
///
/// # Errors
/// [`PddlError`] as for [`read_types`], and at the declarations of a cycle.
pub fn read_hierarchy(text: &str) -> Result<Hierarchy, PddlError> {
    hierarchy_from_types(&Hierarchy::default(), text, &read_types(text)?)
}

/// `base` with the types declared in `text`.
///
/// # Errors
/// [`PddlError`] at the declarations of a cycle.
pub fn hierarchy_from_types(base: &Hierarchy, text: &str, edges: &[TypeEdge]) -> Result<Hierarchy, PddlError> {
    base.extended(edges.iter().map(|edge| (edge.child.as_str(), edge.parent.as_str())))
        .map_err(|error| locate_hierarchy_error(text, edges, &error))
}

/// Whether the declaration at a place shares its `- parent` with others.
fn stands_in_a_list(text: &str, edges: &[TypeEdge], span: Span, parent: &Symbol) -> bool {
    let goes_on = |other: &TypeEdge| {
        let between = text.get(span.end..other.span.start).or_else(|| text.get(other.span.end..span.start));
        other.span != span && other.parent == *parent && between.is_some_and(|text| !text.contains(" - "))
    };
    edges.iter().any(goes_on)
}

/// Finds the declarations that an error of the hierarchy is about.
pub fn locate_hierarchy_error(text: &str, edges: &[TypeEdge], error: &HierarchyError) -> PddlError {
    let find = |child: &str, parent: &str| {
        edges.iter().find(|edge| edge.child == *child && edge.parent == *parent).map(|edge| edge.span)
    };
    let at = |span: Option<Span>| PddlError::new(text, span.unwrap_or_default(), error.to_string());
    match error {
        HierarchyError::OtherParent { child, parent, .. } => at(find(child.as_str(), parent.as_str()))
            .with_hint("What a type means cannot be changed afterwards: take this declaration out."),
        HierarchyError::Cycle { path } => {
            let mut spans: Vec<Span> =
                path.windows(2).filter_map(|pair| find(pair[0].as_str(), pair[1].as_str())).collect();
            spans.sort_unstable_by_key(|span| span.start);
            let hint = match path.as_slice() {
                [own, _] if spans.first().is_some_and(|&span| stands_in_a_list(text, edges, span, own)) => {
                    format!(
                        "`- {own}` is the parent of all names before it in the list, `{own}` among them: write \
                             `{own} - object` first."
                    )
                }
                _ => "Take one of the declarations out.".to_owned(),
            };
            let located = at(spans.last().copied()).with_hint(hint);
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
    fn a_type_may_have_several_parents() {
        let both = ["b<object", "c<object", "a<b", "a<c"];
        assert_eq!(edges("(:types b c - object a - b A - c)"), both);
        assert_eq!(edges("(:types b c - object a - (either b c))"), both);
        assert_eq!(edges("(:types a - object surface - object a - surface)"), ["surface<object", "a<surface"]);
    }

    #[test]
    fn a_list_covers_the_names_before_the_last_too() {
        let text = "(:types base sub - base)";
        let error = refused(text);
        assert_eq!(error.to_string(), "line 1, column 9: the type hierarchy has a cycle: base - base");
        let hint = "`- base` is the parent of all names before it in the list, `base` among them: write `base - object` first.";
        assert_eq!(error.hint.as_deref(), Some(hint));
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
        for (text, message) in [
            (
                "(:types object - thing)",
                "line 1, column 9: `object` is the root of every hierarchy and cannot have the parent `thing`",
            ),
            ("(:types a - (either))", "line 1, column 13: there are no types in this `either`"),
            ("(:types a - (either b (c)))", "line 1, column 23: the name of a type is expected here, not a list"),
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
        let error = hierarchy_from_types(&base, text, &read_types(text).expect("edges")).expect_err("a further parent");
        assert_eq!(
            error.to_string(),
            "line 2, column 2: type `a` is known below `b`, and cannot be put below `c` as well"
        );
        assert_eq!(error.related, None);
    }
}
