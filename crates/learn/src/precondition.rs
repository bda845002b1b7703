//! ExtractPreconditions (Algorithm 1, line 3): the atoms that held before in every observation of a cluster.

use std::collections::BTreeSet;

use typelift_model::{Cluster, LiftedAtom};

/// The intersection of the cluster's lifted pre-states. Static atoms stay in; there are no negative ones.
pub(crate) fn extract_preconditions(cluster: &Cluster) -> BTreeSet<LiftedAtom> {
    cluster.states.always()
}
