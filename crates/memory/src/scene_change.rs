//! A scene as what is different from the scene before.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift_model::GroundAtom;
use typelift_world::{Entity, Scene, Snapshot};

use crate::error::MemoryErrorKind;

/// What makes one scene of another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SceneChange {
    /// The entities that are different now. All are the same ones as before, in the same order.
    Entities(Vec<Entity>),
    /// The atoms that hold now and did not, and those that did and do not. The objects, and what is unknown, are the same.
    Atoms { added: BTreeSet<GroundAtom>, deleted: BTreeSet<GroundAtom> },
    /// All of it, where it is not as simple.
    Whole(Scene),
}

impl SceneChange {
    /// What makes `after` of `before`.
    pub(crate) fn between(before: &Scene, after: &Scene) -> Self {
        match (before, after) {
            (Scene::Snapshot(before), Scene::Snapshot(after)) if same_entities(before, after) => {
                let pairs = before.entities.iter().zip(&after.entities);
                Self::Entities(pairs.filter(|(old, new)| old != new).map(|(_, new)| new.clone()).collect())
            }
            (
                Scene::Symbolic { objects, atoms: before, unknown },
                Scene::Symbolic { objects: objects_after, atoms: after, unknown: unknown_after },
            ) if objects == objects_after && unknown == unknown_after => Self::Atoms {
                added: after.difference(before).cloned().collect(),
                deleted: before.difference(after).cloned().collect(),
            },
            _ => Self::Whole(after.clone()),
        }
    }

    /// The scene that it makes of another.
    pub(crate) fn of(self, before: Scene) -> Result<Scene, MemoryErrorKind> {
        let unlike = || MemoryErrorKind::Damaged("a scene does not fit the one before it".to_owned());
        match (self, before) {
            (Self::Whole(scene), _) => Ok(scene),
            (Self::Entities(changed), Scene::Snapshot(mut snapshot)) => {
                let mut changed: BTreeMap<_, _> = changed.into_iter().map(|e| (e.id.clone(), e)).collect();
                for entity in &mut snapshot.entities {
                    if let Some(new) = changed.remove(&entity.id) {
                        *entity = new;
                    }
                }
                if changed.is_empty() { Ok(Scene::Snapshot(snapshot)) } else { Err(unlike()) }
            }
            (Self::Atoms { added, deleted }, Scene::Symbolic { objects, mut atoms, unknown }) => {
                atoms.retain(|atom| !deleted.contains(atom));
                atoms.extend(added);
                Ok(Scene::Symbolic { objects, atoms, unknown })
            }
            _ => Err(unlike()),
        }
    }
}

/// Whether they are of the same entities in the same order, each once.
fn same_entities(before: &Snapshot, after: &Snapshot) -> bool {
    let ids: BTreeSet<_> = before.entities.iter().map(|entity| &entity.id).collect();
    let are_same = before.entities.iter().map(|e| &e.id).eq(after.entities.iter().map(|e| &e.id));
    are_same && ids.len() == before.entities.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(text: &str) -> Scene {
        serde_json::from_str(text).expect("a scene")
    }

    fn lamps(lamps: &[(&str, bool)]) -> Scene {
        let lamp = |(id, lit): &(&str, bool)| format!(r#"{{"id":"{id}","type":"lamp","attributes":{{"lit":{lit}}}}}"#);
        scene(&format!(r#"{{"entities":[{}]}}"#, lamps.iter().map(lamp).collect::<Vec<_>>().join(",")))
    }

    #[test]
    fn every_scene_comes_back() {
        let one = lamps(&[("a", false), ("b", false)]);
        let symbolic = |atoms: &str, unknown: &str| {
            scene(&format!(r#"{{"objects":{{"a":"lamp"}},"atoms":[{atoms}],"unknown":[{unknown}]}}"#))
        };
        let scenes = [
            one,
            lamps(&[("a", true), ("b", false)]),
            lamps(&[("b", false), ("a", true)]),
            lamps(&[("a", true)]),
            symbolic("", ""),
            symbolic(r#""lit(a)""#, ""),
            symbolic(r#""lit(a)""#, r#""hot(*)""#),
        ];
        for before in &scenes {
            for after in &scenes {
                let change = serde_json::to_string(&SceneChange::between(before, after)).expect("JSON");
                let change: SceneChange = serde_json::from_str(&change).expect("a change");
                assert_eq!(&change.of(before.clone()).expect("it fits"), after);
            }
        }
    }

    #[test]
    fn what_stayed_is_not_kept() {
        let change = SceneChange::between(&lamps(&[("a", false), ("b", false)]), &lamps(&[("a", true), ("b", false)]));
        let text = serde_json::to_string(&change).expect("JSON");
        assert_eq!(text, r#"{"entities":[{"id":"a","type":"lamp","attributes":{"lit":true},"relations":{}}]}"#);
    }

    #[test]
    fn a_change_of_another_scene_is_refused() {
        let change = SceneChange::between(&lamps(&[("a", false)]), &lamps(&[("a", true)]));
        let damaged = change.of(lamps(&[("b", false)])).expect_err("there is no a");
        assert_eq!(damaged.to_string(), "it is damaged: a scene does not fit the one before it");
    }
}
