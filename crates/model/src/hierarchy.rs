//! The entity hierarchy: a rooted tree of types (paper: 𝓗).

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use thiserror::Error;

use crate::{HashMap, Symbol};

/// The name of the implicit root, as in PDDL.
pub const ROOT: &str = "object";

/// A type of one [`Hierarchy`]; only that hierarchy can name it.
///
/// Ids stay valid when a hierarchy is [extended](Hierarchy::extended); they mean nothing to an unrelated one.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TypeId(u32);

impl fmt::Debug for TypeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "type#{}", self.0)
    }
}

/// Why a set of child–parent pairs is not a tree.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum HierarchyError {
    /// A type was given two different parents.
    #[error("type `{child}` has two parents, `{first}` and `{second}`")]
    TwoParents {
        /// The type.
        child: Symbol,
        /// The parent stated first.
        first: Symbol,
        /// The parent stated later.
        second: Symbol,
    },
    /// A type is its own ancestor.
    #[error("the type hierarchy has a cycle: {}", .path.iter().map(Symbol::as_str).collect::<Vec<_>>().join(" - "))]
    Cycle {
        /// The types on the cycle, the first repeated at the end.
        path: Vec<Symbol>,
    },
    /// The root was given a parent.
    #[error("`object` is the root of every hierarchy and cannot have the parent `{parent}`")]
    RootHasParent {
        /// The parent stated for it.
        parent: Symbol,
    },
}

impl HierarchyError {
    /// The type that the error is about, for a reader that can point at its declaration.
    pub fn subject(&self) -> &str {
        match self {
            Self::TwoParents { child, .. } => child.as_str(),
            Self::Cycle { path } => path.first().map_or(ROOT, Symbol::as_str),
            Self::RootHasParent { .. } => ROOT,
        }
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Node {
    name: Symbol,
    parent: TypeId,
    depth: u32,
}

/// A tree of types below the root `object`. Immutable and cheap to clone; [`extended`](Self::extended) makes a larger
/// one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hierarchy {
    nodes: Arc<Vec<Node>>,
    by_name: Arc<HashMap<Symbol, TypeId>>,
}

impl Default for Hierarchy {
    fn default() -> Self {
        let root = TypeId(0);
        let name = Symbol::new(ROOT);
        Self {
            nodes: Arc::new(vec![Node { name: name.clone(), parent: root, depth: 0 }]),
            by_name: Arc::new(HashMap::from_iter([(name, root)])),
        }
    }
}

impl Hierarchy {
    /// The tree given by `(child, parent)` pairs. A parent that has no parent hangs below `object`; the same
    /// pair twice is harmless.
    ///
    /// # Errors
    /// [`HierarchyError`] for a second parent or a cycle.
    pub fn from_edges<S: AsRef<str>>(edges: impl IntoIterator<Item = (S, S)>) -> Result<Self, HierarchyError> {
        Self::default().extended(edges)
    }

    /// This tree with more types. Existing ids keep their meaning. A pair that is already there is harmless, one
    /// that contradicts it is an error; a known type that hangs directly below `object` may not be moved either.
    ///
    /// # Errors
    /// [`HierarchyError`] for a second parent or a cycle.
    pub fn extended<S: AsRef<str>>(&self, edges: impl IntoIterator<Item = (S, S)>) -> Result<Self, HierarchyError> {
        let mut parent_of: BTreeMap<Symbol, Symbol> = BTreeMap::new();
        let mut order: Vec<Symbol> = Vec::new();
        let mut mentioned: Vec<Symbol> = Vec::new();
        for (child, parent) in edges {
            let (child, parent) = (Symbol::new(child.as_ref()), Symbol::new(parent.as_ref()));
            if child == ROOT {
                if parent == ROOT {
                    continue;
                }
                return Err(HierarchyError::RootHasParent { parent });
            }
            let known = self
                .id(child.as_str())
                .map(|id| self.name(self.nodes[id.0 as usize].parent).clone())
                .or_else(|| parent_of.get(&child).cloned());
            match known {
                Some(first) if first != parent => {
                    return Err(HierarchyError::TwoParents { child, first, second: parent });
                }
                Some(_) => {}
                None => {
                    parent_of.insert(child.clone(), parent.clone());
                    order.push(child);
                }
            }
            mentioned.push(parent);
        }
        for parent in mentioned {
            if self.id(parent.as_str()).is_none() && !parent_of.contains_key(&parent) {
                parent_of.insert(parent.clone(), Symbol::new(ROOT));
                order.push(parent);
            }
        }
        let mut tree = self.clone();
        for child in order {
            tree.add_chain(&child, &parent_of)?;
        }
        Ok(tree)
    }

    /// Adds `start` and those of its ancestors that are not there yet, ancestors first.
    fn add_chain(&mut self, start: &Symbol, parent_of: &BTreeMap<Symbol, Symbol>) -> Result<(), HierarchyError> {
        let mut chain: Vec<Symbol> = Vec::new();
        let mut current = start.clone();
        while self.id(current.as_str()).is_none() {
            if let Some(at) = chain.iter().position(|seen| *seen == current) {
                let mut path = chain.split_off(at);
                path.push(current);
                return Err(HierarchyError::Cycle { path });
            }
            chain.push(current.clone());
            current = parent_of.get(&current).cloned().unwrap_or_else(|| Symbol::new(ROOT));
        }
        let mut parent = self.by_name[&current];
        for name in chain.into_iter().rev() {
            let id = TypeId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
            let depth = self.depth(parent) + 1;
            Arc::make_mut(&mut self.nodes).push(Node { name: name.clone(), parent, depth });
            Arc::make_mut(&mut self.by_name).insert(name, id);
            parent = id;
        }
        Ok(())
    }

    /// The root, `object`.
    pub fn root(&self) -> TypeId {
        TypeId(0)
    }

    /// The type of this name.
    pub fn id(&self, name: &str) -> Option<TypeId> {
        self.by_name.get(name).copied()
    }

    /// The name of a type of this hierarchy.
    ///
    /// # Panics
    /// If the id comes from a larger, unrelated hierarchy.
    pub fn name(&self, id: TypeId) -> &Symbol {
        &self.nodes[id.0 as usize].name
    }

    /// The parent, or `None` for the root.
    pub fn parent(&self, id: TypeId) -> Option<TypeId> {
        (id != self.root()).then(|| self.nodes[id.0 as usize].parent)
    }

    /// The number of steps up to the root; the root's is 0.
    pub fn depth(&self, id: TypeId) -> u32 {
        self.nodes[id.0 as usize].depth
    }

    /// Every type, ancestors before descendants.
    pub fn types(&self) -> impl Iterator<Item = TypeId> + '_ {
        (0..self.nodes.len()).map(|i| TypeId(i as u32))
    }

    /// The number of types, the root included; at least 1.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The types directly below `id`, in the order in which they were declared.
    pub fn children(&self, id: TypeId) -> impl Iterator<Item = TypeId> + '_ {
        self.types().filter(move |&child| self.parent(child) == Some(id))
    }

    /// Whether `id` is `ancestor` or lies below it. O(depth).
    pub fn is_a(&self, id: TypeId, ancestor: TypeId) -> bool {
        let depth = self.depth(ancestor);
        let mut current = id;
        while self.depth(current) > depth {
            current = self.nodes[current.0 as usize].parent;
        }
        current == ancestor
    }

    /// Whether neither type is an ancestor of the other.
    pub fn disjoint(&self, a: TypeId, b: TypeId) -> bool {
        !self.is_a(a, b) && !self.is_a(b, a)
    }

    /// The lowest common ancestor: the deepest type that covers both. O(depth).
    pub fn lca(&self, a: TypeId, b: TypeId) -> TypeId {
        let (mut a, mut b) = (a, b);
        while a != b {
            if self.depth(a) >= self.depth(b) {
                a = self.nodes[a.0 as usize].parent;
            } else {
                b = self.nodes[b.0 as usize].parent;
            }
        }
        a
    }

    /// The lowest type that covers every type but the root: the root itself unless it has a single child.
    pub fn top(&self) -> TypeId {
        self.types().skip(1).reduce(|a, b| self.lca(a, b)).unwrap_or(self.root())
    }

    /// `(child, parent)` for every type but the root, ancestors first.
    pub fn edges(&self) -> impl Iterator<Item = (&Symbol, &Symbol)> + '_ {
        self.nodes.iter().skip(1).map(|node| (&node.name, self.name(node.parent)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree() -> Hierarchy {
        Hierarchy::from_edges([("apple", "fruit"), ("banana", "fruit"), ("leek", "food"), ("fruit", "food")])
            .expect("a tree")
    }

    #[test]
    fn types_may_be_used_before_they_are_declared() {
        let h = tree();
        let id = |name| h.id(name).expect("declared");
        assert_eq!(h.lca(id("apple"), id("banana")), id("fruit"));
        assert_eq!(h.lca(id("apple"), id("leek")), id("food"));
        assert_eq!(h.lca(id("apple"), h.root()), h.root());
        assert_eq!(h.depth(id("apple")), 3);
        assert!(h.is_a(id("apple"), id("food")) && !h.is_a(id("food"), id("apple")));
        assert!(h.disjoint(id("apple"), id("leek")) && !h.disjoint(id("apple"), id("food")));
        assert_eq!(h.top(), id("food"));
    }

    #[test]
    fn two_parents_and_cycles_are_named() {
        let two = Hierarchy::from_edges([("a", "b"), ("a", "c")]).expect_err("two parents");
        assert_eq!(two.to_string(), "type `a` has two parents, `b` and `c`");
        let cycle = Hierarchy::from_edges([("a", "b"), ("b", "c"), ("c", "a")]).expect_err("a cycle");
        assert_eq!(cycle.to_string(), "the type hierarchy has a cycle: a - b - c - a");
        let own = Hierarchy::from_edges([("a", "a")]).expect_err("a cycle");
        assert_eq!(own.to_string(), "the type hierarchy has a cycle: a - a");
        assert!(Hierarchy::from_edges([("object", "thing")]).is_err());
        assert!(Hierarchy::from_edges([("a", "b"), ("a", "b")]).is_ok());
    }

    #[test]
    fn extension_keeps_ids_and_refuses_contradiction() {
        let h = tree();
        let larger = h.extended([("mango", "fruit"), ("fork", "tool")]).expect("extends");
        assert_eq!(larger.name(h.id("apple").expect("known")).as_str(), "apple");
        assert_eq!(
            larger.lca(larger.id("mango").expect("new"), h.id("apple").expect("known")),
            h.id("fruit").expect("known")
        );
        assert!(h.extended([("apple", "tool")]).is_err());
        assert!(h.extended([("food", "thing")]).is_err());
    }
}
