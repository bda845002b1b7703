//! The hierarchy of types with what demonstrations show of it, and where each action's parameters were generalized to.

use std::collections::BTreeSet;
use std::path::Path;

use serde::{Deserialize, Serialize};
use typelift::model::{ActionModel, Hierarchy, Symbol, TypeId};
use typelift::world::{FileError, write_file};

use crate::csv::Csv;
use crate::figure::{Branch, Edge, matrix, tree};
use crate::learned::kitchen_model;

/// The hierarchy and what was learned on it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TypeHierarchy {
    /// Every type in depth-first order, the topmost first. PDDL's `object` is left out.
    pub types: Vec<TypeRow>,
    /// Every parameter of every action.
    pub parameters: Vec<ParameterRow>,
}

/// A type.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TypeRow {
    /// Its name.
    pub name: String,
    /// The type above; nothing above the topmost.
    pub parent: Option<String>,
    /// Steps up to the topmost.
    pub depth: u32,
    /// Whether something of exactly this type took part in what was demonstrated.
    pub seen: bool,
}

/// A parameter of an action.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ParameterRow {
    /// The action.
    pub action: String,
    /// The parameter: `?x2`.
    pub parameter: String,
    /// Its type.
    #[serde(rename = "type")]
    pub ty: String,
    /// The types of what was observed in its place.
    pub observed: Vec<String>,
}

impl ParameterRow {
    /// Whether its type is above what was observed.
    pub fn risen(&self) -> bool {
        self.observed != [self.ty.as_str()]
    }
}

impl TypeHierarchy {
    /// The kitchen's, with what is learned from its eight demonstrations.
    pub fn of_the_kitchen() -> Self {
        Self::new(&kitchen_model(false))
    }

    /// That of a model.
    pub fn new(model: &ActionModel) -> Self {
        let hierarchy = &model.hierarchy;
        let support = model.actions.iter().flat_map(|action| action.provenance.support());
        let seen: BTreeSet<&str> = support.flat_map(|support| &support.cluster.types).map(Symbol::as_str).collect();
        let top = hierarchy.top();
        let row = |ty: TypeId| TypeRow {
            name: hierarchy.name(ty).to_string(),
            parent: hierarchy
                .parents(ty)
                .first()
                .filter(|_| ty != top)
                .map(|&parent| hierarchy.name(parent).to_string()),
            depth: hierarchy.depth(ty) - hierarchy.depth(top),
            seen: seen.contains(hierarchy.name(ty).as_str()),
        };
        Self { types: depth_first(hierarchy, top).into_iter().map(row).collect(), parameters: parameters(model) }
    }

    /// Parents against children, by depth, as the paper's figure has it.
    pub fn matrix(&self) -> String {
        let mut rows: Vec<&TypeRow> = self.types.iter().collect();
        rows.sort_by_key(|row| row.depth);
        let edge = |row: &TypeRow| {
            let (child, depth, seen) = (row.name.clone(), row.depth, row.seen);
            row.parent.clone().map(|parent| Edge { parent, child, depth, seen })
        };
        matrix(&rows.into_iter().filter_map(edge).collect::<Vec<_>>())
    }

    /// The tree with the parameters at their types.
    pub fn tree(&self) -> String {
        let branch = |row: &TypeRow| {
            let mine = || self.parameters.iter().filter(|parameter| parameter.ty == row.name);
            let name = |p: &ParameterRow| format!("{} {}", p.action, p.parameter);
            let risen = |p: &ParameterRow| format!("{}  from {}", name(p), p.observed.join(", "));
            Branch {
                name: row.name.clone(),
                depth: row.depth,
                seen: row.seen,
                raised: mine().filter(|p| p.risen()).map(risen).collect(),
                kept: self.kept(&mine().filter(|p| !p.risen()).collect::<Vec<_>>()),
            }
        };
        tree(&self.types.iter().map(branch).collect::<Vec<_>>())
    }

    /// The parameters that kept a type, unless one of every action did: then that is said.
    fn kept(&self, parameters: &[&ParameterRow]) -> Vec<String> {
        let actions: BTreeSet<&str> = self.parameters.iter().map(|p| p.action.as_str()).collect();
        let first = parameters.first().map_or("", |p| p.parameter.as_str());
        let alike = parameters.iter().all(|p| p.parameter == first);
        if alike && parameters.len() == actions.len() && parameters.len() > 1 {
            return vec![format!("{first} of all {} actions", actions.len())];
        }
        parameters.iter().map(|p| format!("{} {}", p.action, p.parameter)).collect()
    }

    /// The types as CSV.
    pub fn types_csv(&self) -> String {
        let mut csv = Csv::new(&["type", "parent", "depth", "seen"]);
        for row in &self.types {
            let parent = row.parent.clone().unwrap_or_default();
            csv.row([row.name.clone(), parent, row.depth.to_string(), row.seen.to_string()]);
        }
        csv.into_text()
    }

    /// The parameters as CSV.
    pub fn parameters_csv(&self) -> String {
        let mut csv = Csv::new(&["action", "parameter", "type", "observed", "risen"]);
        for p in &self.parameters {
            let (observed, risen) = (p.observed.join(" "), p.risen().to_string());
            csv.row([p.action.clone(), p.parameter.clone(), p.ty.clone(), observed, risen]);
        }
        csv.into_text()
    }

    /// Writes everything to a folder that is there; the files' names come back.
    ///
    /// # Errors
    /// [`FileError`] if a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<Vec<&'static str>, FileError> {
        let files = [
            ("hierarchy.csv", self.types_csv()),
            ("parameters.csv", self.parameters_csv()),
            ("hierarchy.svg", self.matrix()),
            ("tree.svg", self.tree()),
            ("hierarchy.json", crate::json::pretty(self)),
        ];
        for (name, text) in &files {
            write_file(&folder.join(name), text.as_bytes())?;
        }
        Ok(files.map(|(name, _)| name).to_vec())
    }
}

/// The type, then what is below it.
fn depth_first(hierarchy: &Hierarchy, ty: TypeId) -> Vec<TypeId> {
    let below = hierarchy.children(ty).flat_map(|child| depth_first(hierarchy, child));
    std::iter::once(ty).chain(below).collect()
}

fn parameters(model: &ActionModel) -> Vec<ParameterRow> {
    let mut rows = Vec::new();
    for action in &model.actions {
        for (index, parameter) in (0..).zip(&action.parameters) {
            let in_its_place = action.provenance.support().iter().flat_map(|support| {
                let types = support.cluster.types.iter().zip(&support.map);
                types.filter(move |&(_, &to)| to == index).map(|(ty, _)| ty.to_string())
            });
            let observed: BTreeSet<String> = in_its_place.collect();
            rows.push(ParameterRow {
                action: action.name.to_string(),
                parameter: format!("?{}", parameter.name),
                ty: model.hierarchy.name(parameter.ty).to_string(),
                observed: observed.into_iter().collect(),
            });
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cutting_rose_to_food() {
        let result = TypeHierarchy::of_the_kitchen();
        assert_eq!((result.types.len(), result.types[0].name.as_str()), (33, "entity"));
        let seen: Vec<&str> = result.types.iter().filter(|row| row.seen).map(|row| row.name.as_str()).collect();
        let expected = "agent counter cutboard blender toaster plate lettuce tomato onion carrot banana bread";
        assert_eq!(seen.join(" "), expected);
        let cut = |name: &str| {
            let of = |p: &&ParameterRow| p.action == "USE-cutboard-food" && p.parameter == name;
            result.parameters.iter().find(of).cloned().expect(name)
        };
        let food = cut("?x2");
        assert_eq!((food.ty.as_str(), food.risen()), ("food", true));
        assert_eq!(food.observed, ["banana", "lettuce", "onion", "tomato"]);
        assert!(!cut("?x1").risen());
        let actions: BTreeSet<&str> = result.parameters.iter().map(|p| p.action.as_str()).collect();
        assert_eq!(actions.len(), 13);
    }

    #[test]
    fn the_picture_of_the_kitchens_hierarchy() {
        insta::assert_snapshot!(TypeHierarchy::of_the_kitchen().matrix());
    }

    #[test]
    fn the_tree_of_the_kitchens_hierarchy() {
        insta::assert_snapshot!(TypeHierarchy::of_the_kitchen().tree());
    }

    #[test]
    fn files() {
        let folder = tempfile::tempdir().expect("a folder");
        let result = TypeHierarchy::of_the_kitchen();
        for name in result.write(folder.path()).expect("written") {
            assert!(folder.path().join(name).is_file(), "{name}");
        }
        let text = std::fs::read_to_string(folder.path().join("hierarchy.json")).expect("read");
        assert_eq!(serde_json::from_str::<TypeHierarchy>(&text).expect("JSON"), result);
        let missing = folder.path().join("missing");
        assert!(result.write(&missing).expect_err("no folder").to_string().contains("no such folder"));
        assert!(result.types_csv().starts_with("type,parent,depth,seen\nentity,,0,false\nagent,entity,1,true\n"));
        assert!(result.parameters_csv().contains("USE-cutboard-food,?x2,food,banana lettuce onion tomato,true\n"));
    }
}
