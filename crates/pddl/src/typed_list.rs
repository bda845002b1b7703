//! Typed lists: `a b - t c`, as types, objects, constants and parameters are written.

use crate::{Children, PddlError, Sexpr, Span};

/// One name of a typed list.
#[derive(Debug, Clone, Copy)]
pub struct TypedName<'d> {
    /// The name as it is written.
    pub name: &'d str,
    /// Where.
    pub span: Span,
    /// The type after the next `-`, if there is one: an atom, or a list as `(either a b)`.
    pub ty: Option<Sexpr<'d>>,
}

/// Reads a typed list up to its end.
///
/// # Errors
/// [`PddlError`] at a list among the names, a `-` without names before it or without a type after it.
pub fn read_typed_list(items: Children<'_>) -> Result<Vec<TypedName<'_>>, PddlError> {
    let mut names: Vec<TypedName<'_>> = Vec::new();
    let mut untyped = 0;
    let mut items = items;
    while let Some(item) = items.next() {
        match item.atom() {
            None => return Err(item.error("a name is expected here, not a list")),
            Some("-") => {
                let Some(ty) = items.next() else {
                    return Err(item.error("there is no type after this `-`"));
                };
                if untyped == names.len() {
                    return Err(item.error("there are no names before this `-`"));
                }
                for name in &mut names[untyped..] {
                    name.ty = Some(ty);
                }
                untyped = names.len();
            }
            Some(name) => names.push(TypedName { name, span: item.span(), ty: None }),
        }
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Document;

    fn read(text: &str) -> Result<Vec<String>, String> {
        let document = Document::read(text).map_err(|e| e.to_string())?;
        let root = document.only_root().map_err(|e| e.to_string())?;
        let names = read_typed_list(root.children()).map_err(|e| e.to_string())?;
        Ok(names.into_iter().map(|n| format!("{}:{}", n.name, n.ty.map_or("", Sexpr::text))).collect())
    }

    #[test]
    fn names_share_the_type_that_follows() {
        assert_eq!(
            read("(a b - t c - (either u v) d)"),
            Ok(["a:t", "b:t", "c:(either u v)", "d:"].map(str::to_owned).to_vec())
        );
    }

    #[test]
    fn misplaced_parts_are_refused() {
        assert_eq!(read("(a -)"), Err("line 1, column 4: there is no type after this `-`".to_owned()));
        assert_eq!(read("(- t)"), Err("line 1, column 2: there are no names before this `-`".to_owned()));
        assert_eq!(read("(a - t - u)"), Err("line 1, column 8: there are no names before this `-`".to_owned()));
        assert_eq!(read("(a (b) - t)"), Err("line 1, column 4: a name is expected here, not a list".to_owned()));
    }
}
