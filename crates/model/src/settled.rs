//! Which steps between open states count.
//!
//! A step counts if nothing that it may have changed is hidden. What could be hidden is known only when everything that was
//! observed is there: an atom that no state of a trace lists may still be one that the action changes, as another trace shows.
//! So each step is kept with its [`View`](crate::View), and what was observed is settled when it is learned from.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::{AtomKind, Cluster, LiftedAtom, Observations, OpenObservations, Symbol, Unexplained};

impl Observations {
    /// What is learned from: steps between open states are as those between closed ones if their views show all kinds of
    /// atoms that are met anywhere, and [not explained](Unexplained::UnlistedKinds) if not. In time of its size, or none if
    /// all states were closed.
    pub fn settled(&self) -> Cow<'_, Self> {
        if self.open.is_empty() {
            return Cow::Borrowed(self);
        }
        let kinds = self.kinds();
        let mut settled = Self { open: OpenObservations::default(), ..self.clone() };
        for (view, seen) in &self.open.by_view {
            if view.shows_all(&kinds) {
                settled.merge(seen);
                continue;
            }
            for cluster in seen.clusters.values().chain(seen.negatives.values()) {
                settled.add_all_unexplained(Unexplained::UnlistedKinds, cluster.count, &cluster.witnesses);
            }
        }
        Cow::Owned(settled)
    }

    /// Every kind of atom that open states list, or that is met in a cluster.
    fn kinds(&self) -> BTreeSet<AtomKind> {
        let mut kinds = self.open.kinds.clone();
        let mut add = |types: &[Symbol], atoms: &mut dyn Iterator<Item = &LiftedAtom>| {
            kinds.extend(atoms.filter_map(|atom| AtomKind::of_lifted(atom, types)));
        };
        for (key, cluster) in &self.clusters {
            add(&key.types, &mut key.adds.iter().chain(&key.deletes).chain(cluster.states.atoms()));
        }
        for (key, Cluster { states, .. }) in &self.negatives {
            add(&key.types, &mut states.atoms());
        }
        kinds
    }
}
