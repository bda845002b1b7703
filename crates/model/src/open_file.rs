//! What was seen between open states, as the model's file has it.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::model_error::{at_most, inconsistent, type_id};
use crate::{
    AtomKind, Cluster, ClusterKey, Hierarchy, MOST_PARAMETERS, ModelFileError, NegativeKey, Observations,
    OpenObservations, View,
};

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct OpenFile {
    /// Every kind of atom that its open states list: types for arguments, `?0` for the same object as argument 0.
    kinds: BTreeSet<AtomKind>,
    views: Vec<ViewFile>,
}

/// Steps of which equally much is known.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct ViewFile {
    #[serde(flatten)]
    view: View,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    clusters: Vec<SeenOf<ClusterKey>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    negatives: Vec<SeenOf<NegativeKey>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct SeenOf<K> {
    #[serde(flatten)]
    key: K,
    #[serde(flatten)]
    cluster: Cluster,
}

impl<K: Ord + Clone> SeenOf<K> {
    fn list(clusters: &BTreeMap<K, Cluster>) -> Vec<Self> {
        clusters.iter().map(|(key, cluster)| Self { key: key.clone(), cluster: cluster.clone() }).collect()
    }

    fn read(list: Vec<Self>) -> Result<BTreeMap<K, Cluster>, ModelFileError> {
        unique(list.into_iter().map(|Self { key, cluster }| Ok((key, cluster))))
    }
}

impl OpenFile {
    pub(crate) fn of(open: &OpenObservations) -> Self {
        let view = |(view, seen): (&View, &Observations)| ViewFile {
            view: view.clone(),
            clusters: SeenOf::list(&seen.clusters),
            negatives: SeenOf::list(&seen.negatives),
        };
        Self { kinds: open.kinds.clone(), views: open.by_view.iter().map(view).collect() }
    }

    /// What it says, with kinds over types of this hierarchy.
    pub(crate) fn read(self, hierarchy: &Hierarchy) -> Result<OpenObservations, ModelFileError> {
        for kind in self.kinds.iter().chain(self.views.iter().flat_map(|view| &view.view.known)) {
            at_most(kind.arity(), MOST_PARAMETERS, "arguments", place)?;
            if !kind.is_sound() {
                return Err(inconsistent(place(), &format!("{kind} is no kind of atoms")));
            }
            kind.types().try_for_each(|ty| type_id(hierarchy, ty, place).map(|_| ()))?;
        }
        let seen = |ViewFile { view, clusters, negatives }| {
            let (clusters, negatives) = (SeenOf::read(clusters)?, SeenOf::read(negatives)?);
            Ok((view, Observations { clusters, negatives, ..Observations::default() }))
        };
        Ok(OpenObservations { kinds: self.kinds, by_view: unique(self.views.into_iter().map(seen))? })
    }
}

fn place() -> String {
    "\"evidence\" of open states".to_owned()
}

fn unique<K: Ord, V>(
    pairs: impl Iterator<Item = Result<(K, V), ModelFileError>>,
) -> Result<BTreeMap<K, V>, ModelFileError> {
    let mut map = BTreeMap::new();
    for pair in pairs {
        let (key, value) = pair?;
        if map.insert(key, value).is_some() {
            return Err(inconsistent(place(), "it is there twice"));
        }
    }
    Ok(map)
}
