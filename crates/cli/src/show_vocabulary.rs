//! `typelift show --predicates` and `--types`: the words that goals and states of a model are made of.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use typelift::model::{ActionModel, Hierarchy, Symbol, TypeId};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::style::HINT;

/// A predicate a line, as `holding_holds(agent, item)`, in the order of their names, with whether no action changes it.
pub(crate) fn list_predicates(
    out: &mut impl Write,
    model: &ActionModel,
    json: bool,
    quiet: bool,
) -> Result<Exit, Failure> {
    let effects = model.actions.iter().flat_map(|action| &action.effects);
    let changed: BTreeSet<&Symbol> = effects.map(|effect| &effect.literal.atom.predicate).collect();
    let derived: BTreeSet<&Symbol> = model.axioms.iter().map(|axiom| &axiom.head.predicate).collect();
    let is_fixed = |name: &Symbol| !changed.contains(name) && !derived.contains(name);
    let name = |ty: &TypeId| model.hierarchy.name(*ty).as_str();
    let named = |types: &[TypeId]| types.iter().map(name).collect::<Vec<_>>();
    if json {
        let listed = model
            .predicates
            .iter()
            .map(|(name, types)| serde_json::json!({"name": name, "types": named(types), "fixed": is_fixed(name)}));
        let listed: Vec<serde_json::Value> = listed.collect();
        writeln!(out, "{}", serde_json::to_string_pretty(&listed).unwrap_or_default())?;
        return Ok(Exit::Success);
    }
    for (predicate, types) in &model.predicates {
        let fixed = if is_fixed(predicate) { "  no action changes it" } else { "" };
        writeln!(out, "{predicate}({}){fixed}", named(types).join(", "))?;
    }
    out.flush()?;
    if !quiet {
        anstream::eprintln!(
            "{HINT}hint{HINT:#}: a goal is a list of these over entities; before one that must not hold stands `not`"
        );
    }
    Ok(Exit::Success)
}

/// A type a line, indented under the first of those that it is a kind of, with the others beside it.
pub(crate) fn list_types(out: &mut impl Write, hierarchy: &Hierarchy, json: bool) -> Result<Exit, Failure> {
    if json {
        let mut parents: BTreeMap<&Symbol, Vec<&Symbol>> =
            hierarchy.types().map(|ty| (hierarchy.name(ty), Vec::new())).collect();
        for (child, parent) in hierarchy.edges() {
            parents.entry(child).or_default().push(parent);
        }
        let listed = parents.iter().map(|(name, parents)| serde_json::json!({"name": name, "parents": parents}));
        let listed: Vec<serde_json::Value> = listed.collect();
        writeln!(out, "{}", serde_json::to_string_pretty(&listed).unwrap_or_default())?;
        return Ok(Exit::Success);
    }
    // What is still to be listed, and how deep it stands.
    let mut left = vec![(hierarchy.root(), 0)];
    while let Some((ty, depth)) = left.pop() {
        write!(out, "{}{}", "  ".repeat(depth), hierarchy.name(ty))?;
        let others: Vec<&str> =
            hierarchy.parents(ty).iter().skip(1).map(|&parent| hierarchy.name(parent).as_str()).collect();
        match others.as_slice() {
            [] => writeln!(out)?,
            others => writeln!(out, " (also a kind of {})", others.join(" and "))?,
        }
        let children = hierarchy.children(ty).filter(|&child| hierarchy.parents(child).first() == Some(&ty));
        let children: Vec<_> = children.map(|child| (child, depth + 1)).collect();
        left.extend(children.into_iter().rev());
    }
    Ok(Exit::Success)
}
