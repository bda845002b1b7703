//! The hierarchy of what there is in a kitchen (paper: 𝓗). One table; the tree and its PDDL text are made from it.

use typelift_model::{Hierarchy, ParseConfig, ROOT, Symbol};

/// Each type that is no leaf, with the types directly below it; parents first.
const FAMILIES: [(&str, &[&str]); 13] = [
    (ROOT, &["entity"]),
    ("entity", &["agent", "thing"]),
    ("thing", &["station", "item"]),
    ("station", &["counter", "tool"]),
    ("tool", &["cuttingtool", "blendingtool", "toastingtool"]),
    ("cuttingtool", &["cutboard", "breadslicer", "machete"]),
    ("blendingtool", &["blender"]),
    ("toastingtool", &["toaster", "contactgrill"]),
    ("item", &["plate", "food"]),
    ("food", &["vegetable", "fruit", "bakery"]),
    ("vegetable", &["lettuce", "tomato", "onion", "carrot", "cucumber", "hokkaido"]),
    ("fruit", &["banana", "apple", "watermelon", "coconut"]),
    ("bakery", &["bread", "bagel"]),
];

/// The hierarchy of the kitchen's types.
pub fn hierarchy() -> Hierarchy {
    let edges = FAMILIES.iter().flat_map(|(parent, children)| children.iter().map(move |child| (*child, *parent)));
    Hierarchy::from_edges(edges).expect("the table of families is a tree, as a test shows")
}

/// The same hierarchy as a PDDL `(:types …)` block, every parent declared by an entry of its own.
pub fn types_pddl() -> String {
    let lines = FAMILIES.iter().map(|(parent, children)| format!("    {} - {parent}", children.join(" ")));
    format!("(:types\n{})\n", lines.collect::<Vec<_>>().join("\n"))
}

/// How a kitchen's snapshots are read as states. Its own need nothing; recordings of other simulators of this
/// kitchen also tell where things are, which way the agent looks and what it touches.
pub fn parse_config() -> ParseConfig {
    let ignore = ["location", "orientation", "interacts_with", "toggle", "walkable"];
    ParseConfig { ignore: ignore.into_iter().map(Symbol::new).collect(), ..ParseConfig::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kind::{AGENT, ItemKind, StationKind};

    #[test]
    fn the_leaves_are_what_can_be_in_a_room() {
        let hierarchy = hierarchy();
        let is_leaf = |t: &typelift_model::TypeId| hierarchy.children(*t).next().is_none();
        let mut leaves: Vec<&str> = hierarchy.types().filter(is_leaf).map(|t| hierarchy.name(t).as_str()).collect();
        let mut kinds = vec![AGENT];
        kinds.extend(StationKind::ALL.iter().map(|k| k.name()));
        kinds.extend(ItemKind::ALL.iter().map(|k| k.name()));
        leaves.sort_unstable();
        kinds.sort_unstable();
        assert_eq!(leaves, kinds);
        assert_eq!(leaves.len(), 21);
    }

    #[test]
    fn common_ancestors() {
        let hierarchy = hierarchy();
        let lca = |names: &[&str]| {
            let ids = names.iter().map(|n| hierarchy.id(n).expect(n));
            let lca = ids.reduce(|a, b| hierarchy.lca(a, b)).expect("not empty");
            hierarchy.name(lca).to_string()
        };
        assert_eq!(lca(&["lettuce", "banana", "tomato", "onion"]), "food");
        assert_eq!(lca(&["cutboard", "breadslicer"]), "cuttingtool");
        assert_eq!(lca(&["counter", "cutboard", "blender"]), "station");
        assert_eq!(lca(&["counter", "plate"]), "thing");
    }

    #[test]
    fn pddl_text() {
        let text = types_pddl();
        assert!(text.starts_with("(:types\n    entity - object\n    agent thing - entity\n"), "{text}");
        assert!(text.ends_with("    bread bagel - bakery)\n"), "{text}");
    }
}
