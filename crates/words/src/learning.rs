//! What learning could make nothing of, and where it went further than may have been meant.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use typelift_model::{ActedOn, ActionModel, LiftedAtom, NoActor, Observations, Support, Symbol, Unexplained};

use crate::action::{Written, individual_name, types_met};

/// Why nothing was learned from a transition.
pub fn why_unexplained(reason: Unexplained) -> &'static str {
    match reason {
        Unexplained::ObjectsChanged => "entities appeared or vanished",
        Unexplained::PartlyObserved => "what they may have changed is unknown in part",
        Unexplained::UnlistedKinds => "their states do not list a kind of atoms that others list",
        Unexplained::TooLarge => "too many entities take part",
        Unexplained::TooSymmetric => "too many entities changed alike to tell them apart",
        Unexplained::NotExecuted => "something changed, though the action was not executed",
        Unexplained::TimedOut => "the action was not finished in time",
    }
}

/// Something that follows from where types meet, and that whoever plans with the model should know.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TypeNote {
    /// It in a sentence.
    pub text: String,
    /// The action, or the name of the call, that it is about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub action: Option<Symbol>,
    /// The action's parameter that it is about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<Symbol>,
    /// The types that met.
    pub met: Vec<Symbol>,
}

/// Each parameter that anything at all may fill, since the types that were merged have nothing in common; in the order of
/// the model's actions. What a type of one's own above all others has below it is anything, as what the root has is. In time
/// of a look at the types and at what the actions rest on.
pub fn unbounded_parameters(model: &ActionModel) -> Vec<TypeNote> {
    let hierarchy = &model.hierarchy;
    let top = hierarchy.top();
    let mut notes = Vec::new();
    for action in &model.actions {
        for (index, parameter) in action.parameters.iter().enumerate() {
            let (met, all) = (types_met(action, index), hierarchy.name(parameter.ty));
            // Where something of that type itself was seen, nothing rose.
            if !hierarchy.is_a(top, parameter.ty) || met.len() < 2 || met.contains(all) {
                continue;
            }
            let (name, types) = (&parameter.name, joined(met.iter().copied(), "and"));
            notes.push(TypeNote {
                text: format!("{} takes anything as ?{name}: {types} have nothing in common but {all}", action.name),
                action: Some(action.name.clone()),
                parameter: Some(name.clone()),
                met: met.into_iter().cloned().collect(),
            });
        }
    }
    notes
}

/// What each generalized action no longer asks for though every one of the actions that it was merged from did: that two of its
/// parameters have to do with each other. Each of those said so in an atom of its own, so none is left in what all have in
/// common. In the order of the model's actions; in time of a look at the evidence of each.
pub fn dropped_by_merging(model: &ActionModel, evidence: &Observations) -> Vec<TypeNote> {
    let mut notes = Vec::new();
    for action in &model.actions {
        let support = action.provenance.support();
        if support.len() < 2 {
            continue;
        }
        let needs: BTreeSet<&LiftedAtom> = action.positive_preconditions().collect();
        let lost: Vec<(BTreeSet<LiftedAtom>, u64)> =
            support.iter().map(|one| lost(one, model, evidence, &needs)).collect();
        let parameters = action.parameters.len() as u32;
        let pairs = (0..parameters).flat_map(|one| (one + 1..parameters).map(move |other| (one, other)));
        let unrelated: Vec<(u32, u32)> = pairs
            .filter(|pair| !needs.iter().any(|atom| relates(atom, *pair)))
            .filter(|pair| lost.iter().all(|(atoms, _)| atoms.iter().any(|atom| relates(atom, *pair))))
            .collect();
        let mut seen: BTreeMap<LiftedAtom, u64> = BTreeMap::new();
        for (atoms, observations) in &lost {
            for atom in atoms.iter().filter(|atom| unrelated.iter().any(|pair| relates(atom, *pair))) {
                *seen.entry(atom.clone()).or_default() += observations;
            }
        }
        if seen.is_empty() {
            continue;
        }
        let written = Written { parameters: action.parameters.iter().collect() };
        let names: BTreeSet<Symbol> = support.iter().map(|one| Symbol::from(individual_name(one, model))).collect();
        let dropped =
            seen.iter().map(|(atom, times)| Symbol::from(format!("{} ({times} of {times})", written.atom(atom))));
        let dropped: Vec<Symbol> = dropped.collect();
        let text = format!("merging {} dropped {}", joined(&names, "and"), joined(&dropped, "and"));
        let met = unrelated
            .iter()
            .flat_map(|(one, other)| [types_met(action, *one as usize), types_met(action, *other as usize)]);
        let met: BTreeSet<Symbol> = met.flatten().cloned().collect();
        notes.push(TypeNote {
            text,
            action: Some(action.name.clone()),
            parameter: None,
            met: met.into_iter().collect(),
        });
    }
    notes
}

/// What always held before the transitions of an individual action and is no longer needed, over the generalized action's
/// parameters; and how many transitions these are.
fn lost(
    support: &Support,
    model: &ActionModel,
    evidence: &Observations,
    needs: &BTreeSet<&LiftedAtom>,
) -> (BTreeSet<LiftedAtom>, u64) {
    let always = evidence.clusters.get(&*support.cluster).map(|cluster| cluster.states.always()).unwrap_or_default();
    let known = always.iter().filter(|atom| model.predicates.contains_key(&atom.predicate));
    let renamed = known.map(|atom| atom.renamed(&support.map));
    (renamed.filter(|atom| !needs.contains(atom)).collect(), support.observations)
}

/// Whether an atom is about both of these parameters.
fn relates(atom: &LiftedAtom, (one, other): (u32, u32)) -> bool {
    atom.params().any(|parameter| parameter == one) && atom.params().any(|parameter| parameter == other)
}

/// Why there is no default actor, where that may come as a surprise: in itself, or since there was one `before`.
pub fn missing_actor(why: &NoActor, before: Option<&Symbol>) -> Option<TypeNote> {
    let begins = match before {
        Some(before) => format!("the default actor was {before}, and now there is none: "),
        None if why.is_unexpected() => "there is no default actor: ".to_owned(),
        None => return None,
    };
    let acts = |acting: &BTreeSet<Symbol>| format!("argument 0 of the actions is {}", joined(acting, "or"));
    let (action, met, because) = match why {
        NoActor::NothingLearned => (None, Vec::new(), "no action was learned".to_owned()),
        NoActor::NoArgument(call) => (Some(call), Vec::new(), format!("{call} has no argument")),
        NoActor::OneCall(call) => {
            (Some(call), Vec::new(), format!("every action is {call}, so nothing tells who acts"))
        }
        NoActor::ActedOn(place @ ActedOn { call, ty, .. }) => {
            (Some(call), vec![ty], format!("{ty} acts, but {} too", takes(place)))
        }
        NoActor::NothingInCommon { acting, root } if acting.contains(root) => {
            (None, acting.iter().collect(), format!("what acts is of type {root}, as everything is"))
        }
        NoActor::NothingInCommon { acting, root } => {
            (None, acting.iter().collect(), format!("{}, which have nothing in common but {root}", acts(acting)))
        }
        NoActor::NotAlone { acting, meet, other, is_covered } => {
            let meets = if acting.contains(meet) { String::new() } else { format!(", which meet in {meet}") };
            let is = if *is_covered { "is" } else { "may be" };
            let met = acting.iter().chain([&other.ty]).collect();
            (
                Some(&other.call),
                met,
                format!("{}{meets}; but {}, which {is} of type {meet}, too", acts(acting), takes(other)),
            )
        }
        NoActor::NotAlways { actor, call, other } => (
            Some(call),
            vec![actor, other],
            format!("{actor} acts in calls of every name, but {call} is done by {other} at times"),
        ),
        NoActor::ButFor { call, actor, is_without } => {
            let which = if *is_without { format!(", which never has a {actor} in it") } else { String::new() };
            (Some(call), vec![actor], format!("but for {call}{which}, {actor} would be who acts"))
        }
    };
    Some(TypeNote {
        text: begins + &because,
        action: action.cloned(),
        parameter: None,
        met: met.into_iter().cloned().collect(),
    })
}

fn takes(ActedOn { call, argument, ty }: &ActedOn) -> String {
    match argument {
        Some(argument) => format!("{call} takes {ty} as argument {argument}"),
        None => format!("{call} changes {ty}"),
    }
}

/// `cup, lid and tray`.
fn joined<'s>(names: impl IntoIterator<Item = &'s Symbol>, last: &str) -> String {
    let names: Vec<&str> = names.into_iter().map(Symbol::as_str).collect();
    match names.as_slice() {
        [] => String::new(),
        [name] => (*name).to_owned(),
        [first @ .., name] => format!("{} {last} {name}", first.join(", ")),
    }
}
