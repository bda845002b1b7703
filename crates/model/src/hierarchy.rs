//! The entity hierarchy: types below one root (paper: 𝓗). The paper's is a tree; here a type may have several parents, as
//! in taxonomies such as WordNet's.
//!
//! In a tree two types have one lowest common ancestor. Where there are several, the one with the fewest leaves below it is
//! taken, ties by name: the most specific of them, as far as the hierarchy tells.

use std::collections::BTreeSet;
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

/// Why a set of child–parent pairs is no hierarchy.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum HierarchyError {
    /// A type that is known already was given a further parent: that would change what the others mean.
    #[error("type `{child}` is known below `{known}`, and cannot be put below `{parent}` as well")]
    OtherParent {
        /// The type.
        child: Symbol,
        /// A parent that it has.
        known: Symbol,
        /// The parent stated for it.
        parent: Symbol,
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
            Self::OtherParent { child, .. } => child.as_str(),
            Self::Cycle { path } => path.first().map_or(ROOT, Symbol::as_str),
            Self::RootHasParent { .. } => ROOT,
        }
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Node {
    name: Symbol,
    /// None of them is above another; the root has none.
    parents: Vec<TypeId>,
    depth: u32,
}

/// What is worked out beforehand where some type has several parents.
#[derive(Debug, PartialEq, Eq)]
struct Closure {
    /// Each type with everything above it, sorted.
    above: Vec<Vec<TypeId>>,
    /// The number of leaves below each, or 1 for a leaf.
    leaves: Vec<u32>,
}

/// Types below the root `object`. Immutable and cheap to clone; [`extended`](Self::extended) makes a larger one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hierarchy {
    nodes: Arc<Vec<Node>>,
    by_name: Arc<HashMap<Symbol, TypeId>>,
    /// `None` of a tree.
    closure: Option<Arc<Closure>>,
}

impl Default for Hierarchy {
    fn default() -> Self {
        let root = TypeId(0);
        let name = Symbol::new(ROOT);
        Self {
            nodes: Arc::new(vec![Node { name: name.clone(), parents: Vec::new(), depth: 0 }]),
            by_name: Arc::new(HashMap::from_iter([(name, root)])),
            closure: None,
        }
    }
}

/// The parents stated for types, in the order in which they were stated.
type Stated = HashMap<Symbol, Vec<Symbol>>;

impl Hierarchy {
    /// The hierarchy given by `(child, parent)` pairs. A parent that has no parent hangs below `object`. The same pair twice
    /// is harmless, and so is a parent that is above another one of the same type.
    ///
    /// # Errors
    /// [`HierarchyError`] for a cycle.
    pub fn from_edges<S: AsRef<str>>(edges: impl IntoIterator<Item = (S, S)>) -> Result<Self, HierarchyError> {
        Self::default().extended(edges)
    }

    /// This hierarchy with more types. Existing ids keep their meaning. A pair that is already there is harmless; a known
    /// type gets no further parent, unless it is below that one anyway.
    ///
    /// # Errors
    /// [`HierarchyError`] for another parent of a known type, or a cycle.
    pub fn extended<S: AsRef<str>>(&self, edges: impl IntoIterator<Item = (S, S)>) -> Result<Self, HierarchyError> {
        let mut stated = Stated::default();
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
            match self.id(child.as_str()) {
                Some(known)
                    if !self.id(parent.as_str()).is_some_and(|parent| parent != known && self.is_a(known, parent)) =>
                {
                    let known = self.name(self.parents(known)[0]).clone();
                    return Err(HierarchyError::OtherParent { child, known, parent });
                }
                Some(_) => {}
                None => {
                    let parents = stated.entry(child.clone()).or_insert_with(|| {
                        order.push(child);
                        Vec::new()
                    });
                    if !parents.contains(&parent) {
                        parents.push(parent.clone());
                    }
                }
            }
            mentioned.push(parent);
        }
        for parent in mentioned {
            if self.id(parent.as_str()).is_none() && !stated.contains_key(&parent) {
                stated.insert(parent.clone(), vec![Symbol::new(ROOT)]);
                order.push(parent);
            }
        }
        let mut larger = self.clone();
        for child in order {
            larger.add(&child, &stated)?;
        }
        let is_tree = larger.nodes.iter().all(|node| node.parents.len() <= 1);
        larger.closure = (!is_tree).then(|| Arc::new(Closure::of(&larger)));
        Ok(larger)
    }

    /// Adds a type and those of its ancestors that are not there yet, ancestors first.
    fn add(&mut self, start: &Symbol, stated: &Stated) -> Result<(), HierarchyError> {
        // The types from `start` upward whose parents are being added, each with the number of parents that are there.
        let mut path: Vec<(Symbol, usize)> = Vec::new();
        if self.id(start.as_str()).is_none() {
            path.push((start.clone(), 0));
        }
        while let Some((name, done)) = path.last_mut() {
            let parents = stated.get(name).map(Vec::as_slice).unwrap_or_default();
            let Some(parent) = parents.get(*done).cloned() else {
                let name = name.clone();
                self.push(name, parents);
                path.pop();
                continue;
            };
            *done += 1;
            if self.id(parent.as_str()).is_some() {
                continue;
            }
            if let Some(at) = path.iter().position(|(open, _)| *open == parent) {
                let mut cycle: Vec<Symbol> = path.split_off(at).into_iter().map(|(name, _)| name).collect();
                cycle.push(parent);
                return Err(HierarchyError::Cycle { path: cycle });
            }
            path.push((parent, 0));
        }
        Ok(())
    }

    /// Adds a type whose parents are there. A parent that is above another is left out.
    fn push(&mut self, name: Symbol, parents: &[Symbol]) {
        let parents: Vec<TypeId> = parents.iter().map(|parent| self.by_name[parent]).collect();
        let above: Vec<BTreeSet<TypeId>> = match parents.as_slice() {
            [_] => Vec::new(),
            several => several.iter().map(|&parent| ancestors(&self.nodes, parent)).collect(),
        };
        let is_implied = |parent: &TypeId| {
            above.iter().zip(&parents).any(|(above, other)| other != parent && above.contains(parent))
        };
        let parents: Vec<TypeId> = parents.iter().filter(|parent| !is_implied(parent)).copied().collect();
        let depth = 1 + parents.iter().map(|&parent| self.depth(parent)).max().unwrap_or_default();
        let id = TypeId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        Arc::make_mut(&mut self.nodes).push(Node { name: name.clone(), parents, depth });
        Arc::make_mut(&mut self.by_name).insert(name, id);
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

    /// The types directly above: one in a tree, none of the root. None of them is above another.
    pub fn parents(&self, id: TypeId) -> &[TypeId] {
        &self.nodes[id.0 as usize].parents
    }

    /// Whether no type has several parents.
    pub fn is_tree(&self) -> bool {
        self.closure.is_none()
    }

    /// The largest number of steps up to the root; the root's is 0.
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
        self.types().filter(move |&child| self.parents(child).contains(&id))
    }

    /// Whether `id` is `ancestor` or lies below it. O(depth) in a tree, else O(log of the number of its ancestors).
    pub fn is_a(&self, id: TypeId, ancestor: TypeId) -> bool {
        match &self.closure {
            Some(closure) => closure.above[id.0 as usize].binary_search(&ancestor).is_ok(),
            None => {
                let depth = self.depth(ancestor);
                self.chain(id).find(|&above| self.depth(above) <= depth) == Some(ancestor)
            }
        }
    }

    /// In a tree, a type and what is above it, upward.
    fn chain(&self, id: TypeId) -> impl Iterator<Item = TypeId> + '_ {
        std::iter::successors(Some(id), |&id| self.parents(id).first().copied())
    }

    /// Whether nothing is of both types. In a tree: neither is above the other. O(depth) in a tree, else O(number of types).
    pub fn disjoint(&self, a: TypeId, b: TypeId) -> bool {
        match &self.closure {
            Some(_) => !self.types().any(|ty| self.is_a(ty, a) && self.is_a(ty, b)),
            None => !self.is_a(a, b) && !self.is_a(b, a),
        }
    }

    /// The lowest common ancestor: the deepest type that covers both. Where there are [several](Self::lowest_common), the
    /// one with the fewest leaves below it, ties by name. O(depth) in a tree.
    pub fn lca(&self, a: TypeId, b: TypeId) -> TypeId {
        let (mut above_a, mut above_b) = (a, b);
        if let Some(closure) = &self.closure {
            let rank = |&ty: &TypeId| (closure.leaves[ty.0 as usize], self.name(ty));
            return self.lowest_common(a, b).into_iter().min_by_key(rank).unwrap_or(self.root());
        }
        let parent = |ty: TypeId| self.parents(ty).first().copied().unwrap_or(self.root());
        while above_a != above_b {
            if self.depth(above_a) >= self.depth(above_b) {
                above_a = parent(above_a);
            } else {
                above_b = parent(above_b);
            }
        }
        above_a
    }

    /// The types that cover both and are not above another such type, in the order of the types: one in a tree.
    pub fn lowest_common(&self, a: TypeId, b: TypeId) -> Vec<TypeId> {
        let Some(closure) = &self.closure else { return vec![self.lca(a, b)] };
        let above = |ty: TypeId| &closure.above[ty.0 as usize];
        let common: Vec<TypeId> = above(a).iter().copied().filter(|&ty| self.is_a(b, ty)).collect();
        let is_lowest = |&ty: &TypeId| !common.iter().any(|&other| other != ty && self.is_a(other, ty));
        common.iter().copied().filter(is_lowest).collect()
    }

    /// The lowest type that covers every type but the root: the root itself unless it has a single child.
    pub fn top(&self) -> TypeId {
        self.types().skip(1).reduce(|a, b| self.lca(a, b)).unwrap_or(self.root())
    }

    /// `(child, parent)` for every parent of every type but the root, ancestors first.
    pub fn edges(&self) -> impl Iterator<Item = (&Symbol, &Symbol)> + '_ {
        self.nodes.iter().flat_map(|node| node.parents.iter().map(|&parent| (&node.name, self.name(parent))))
    }
}

impl Closure {
    fn of(hierarchy: &Hierarchy) -> Self {
        let nodes = &hierarchy.nodes;
        let above: Vec<Vec<TypeId>> = hierarchy.types().map(|ty| ancestors(nodes, ty).into_iter().collect()).collect();
        let mut is_leaf = vec![true; nodes.len()];
        for parent in nodes.iter().flat_map(|node| &node.parents) {
            is_leaf[parent.0 as usize] = false;
        }
        let mut leaves = vec![0; nodes.len()];
        for (above, _) in above.iter().zip(&is_leaf).filter(|(_, is_leaf)| **is_leaf) {
            for ty in above {
                leaves[ty.0 as usize] += 1;
            }
        }
        Self { above, leaves }
    }
}

/// A type and everything above it.
fn ancestors(nodes: &[Node], of: TypeId) -> BTreeSet<TypeId> {
    let (mut above, mut open) = (BTreeSet::from([of]), vec![of]);
    while let Some(ty) = open.pop() {
        open.extend(nodes[ty.0 as usize].parents.iter().filter(|&&parent| above.insert(parent)));
    }
    above
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
    fn cycles_are_named() {
        let cycle = Hierarchy::from_edges([("a", "b"), ("b", "c"), ("c", "a")]).expect_err("a cycle");
        assert_eq!(cycle.to_string(), "the type hierarchy has a cycle: a - b - c - a");
        let own = Hierarchy::from_edges([("a", "a")]).expect_err("a cycle");
        assert_eq!(own.to_string(), "the type hierarchy has a cycle: a - a");
        let second = Hierarchy::from_edges([("a", "b"), ("a", "c"), ("c", "a")]).expect_err("a cycle");
        assert_eq!(second.to_string(), "the type hierarchy has a cycle: a - c - a");
        assert!(Hierarchy::from_edges([("object", "thing")]).is_err());
        assert!(Hierarchy::from_edges([("a", "b"), ("a", "b")]).is_ok());
    }

    #[test]
    fn a_parent_above_another_says_nothing() {
        let storage = [("area", "object"), ("surface", "object"), ("area", "surface"), ("area", "object")];
        let h = Hierarchy::from_edges(storage).expect("a tree");
        let area = h.id("area").expect("declared");
        assert_eq!(h.parents(area), [h.id("surface").expect("declared")]);
        assert!(h.is_tree());
    }

    #[test]
    fn of_several_lowest_common_ancestors_the_smallest_is_taken() {
        let h = Hierarchy::from_edges([
            ("knife", "tool"),
            ("knife", "sharp"),
            ("saw", "tool"),
            ("saw", "sharp"),
            ("hammer", "tool"),
            ("tin", "thing"),
            ("tool", "thing"),
        ])
        .expect("no cycle");
        let id = |name| h.id(name).expect("declared");
        assert!(!h.is_tree());
        assert_eq!(h.lowest_common(id("knife"), id("saw")), [id("tool"), id("sharp")]);
        assert_eq!(h.lca(id("knife"), id("saw")), id("sharp"), "two leaves, not three");
        assert_eq!(h.lca(id("knife"), id("hammer")), id("tool"));
        assert_eq!(h.lca(id("sharp"), id("hammer")), h.root());
        assert!(!h.disjoint(id("tool"), id("sharp")), "a knife is both");
        assert!(h.disjoint(id("hammer"), id("sharp")));
        assert_eq!((h.depth(id("knife")), h.depth(id("sharp"))), (3, 1));
        let same_size = Hierarchy::from_edges([("x", "b"), ("x", "a"), ("y", "b"), ("y", "a")]).expect("no cycle");
        let id = |name| same_size.id(name).expect("declared");
        assert_eq!(same_size.lca(id("x"), id("y")), id("a"), "ties by name");
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
        let message = |edge| h.extended([edge]).expect_err("it means something already").to_string();
        assert_eq!(
            message(("apple", "tool")),
            "type `apple` is known below `fruit`, and cannot be put below `tool` as well"
        );
        assert_eq!(
            message(("food", "thing")),
            "type `food` is known below `object`, and cannot be put below `thing` as well"
        );
        assert!(h.extended([("apple", "food")]).is_ok(), "it is below that one anyway");
    }
}
