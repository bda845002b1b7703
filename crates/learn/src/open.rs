//! How much is known of a step between states that do not say everything.
//!
//! An action changes what it is about: the entities that its call names, those of which something is known to have changed,
//! and whatever is connected with one of these by an atom that is known to hold, before or after, or by several. If an
//! atom about one of them is hidden, before or after, the step may have changed it unseen, and nothing is learned from it:
//! neither an effect, which may be a part of one, nor a failure, which may be none. What is hidden elsewhere does not
//! matter.
//!
//! A kind of atoms is listed *in full* if each of its atoms about one of these entities is listed as true or as false. A
//! kind that a step's states do not list at all may be one that there is not; the evidence decides about those, when all
//! of it is there.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    AtomKind, GroundAtom, Hierarchy, OpenObservations, Pattern, Slot, State, Symbol, Unexplained, Unknown, View,
};

/// How much two states show of what may have changed between them, given some of what it is about; `None` if all of it.
/// The kinds of atoms that they list are added to those of the evidence.
///
/// # Errors
/// [`Unexplained::PartlyObserved`] if some of it is hidden.
pub(crate) fn view<'a>(
    [before, after]: [&'a State; 2],
    about: impl Iterator<Item = &'a Symbol>,
    hierarchy: &Hierarchy,
    open: &mut OpenObservations,
) -> Result<Option<View>, Unexplained> {
    if before.unknown.is_nothing() && after.unknown.is_nothing() {
        return Ok(None);
    }
    let near = connected([before, after], about.collect());
    let mut listings: Vec<BTreeSet<&GroundAtom>> = Vec::new();
    for state in [before, after] {
        match &state.unknown {
            Unknown::AllBut(absent) => listings.push(state.atoms.iter().chain(absent).collect()),
            Unknown::Matching(patterns) => {
                if patterns.iter().any(|pattern| may_be_about(pattern, &near)) {
                    return Err(Unexplained::PartlyObserved);
                }
            }
        }
    }
    if listings.is_empty() {
        return Ok(None);
    }
    let ty = |object: &Symbol| before.objects.get(object).map(|ty| hierarchy.name(*ty));
    let mut known: BTreeMap<AtomKind, u64> = BTreeMap::new();
    for atom in listings.iter().flatten().copied().collect::<BTreeSet<_>>() {
        let Some(kind) = AtomKind::of_ground(&atom.without_arity(), ty) else { continue };
        let of_kind = known.entry(kind).or_default();
        if is_about(atom, &near) && listings.iter().all(|listed| listed.contains(atom)) {
            *of_kind += 1;
        }
    }
    open.kinds.extend(known.keys().cloned());
    let mut objects: BTreeMap<Symbol, u64> = BTreeMap::new();
    let mut far: BTreeMap<Symbol, u64> = BTreeMap::new();
    for (name, ty) in &before.objects {
        *objects.entry(hierarchy.name(*ty).clone()).or_default() += 1;
        if !near.contains(name) {
            *far.entry(hierarchy.name(*ty).clone()).or_default() += 1;
        }
    }
    let in_full = |(kind, known): (&AtomKind, &u64)| {
        let far = if kind.arity() == 0 { 0 } else { kind.number(&far) };
        *known == kind.number(&objects) - far
    };
    match known.iter().all(in_full) {
        true => Ok(Some(View { known: known.into_keys().collect(), objects })),
        false => Err(Unexplained::PartlyObserved),
    }
}

/// Whether a pattern means an atom about one of these, or about nothing. A `*` stands for any entity, whatever else the
/// pattern names: `held(g,*)` means `held(g,a)` too.
fn may_be_about(pattern: &Pattern<Symbol>, objects: &BTreeSet<&Symbol>) -> bool {
    let stands_for_one = |slot: &Slot<Symbol>| match slot {
        Slot::Any => true,
        Slot::Is(name) => objects.contains(name),
    };
    pattern.args.is_empty() || pattern.args.iter().any(stands_for_one)
}

/// Whether an atom is about one of these, or about nothing.
fn is_about(atom: &GroundAtom, objects: &BTreeSet<&Symbol>) -> bool {
    atom.args.is_empty() || atom.args.iter().any(|arg| objects.contains(arg))
}

/// These objects, and all that atoms connect with them in one of the states, directly or through others.
fn connected<'a>(states: [&'a State; 2], mut objects: BTreeSet<&'a Symbol>) -> BTreeSet<&'a Symbol> {
    let mut apart: Vec<&GroundAtom> = states.iter().flat_map(|state| &state.atoms).filter(|a| a.arity() > 1).collect();
    loop {
        let (joined, rest): (Vec<_>, Vec<_>) = apart.into_iter().partition(|atom| is_about(atom, &objects));
        if joined.is_empty() {
            return objects;
        }
        objects.extend(joined.into_iter().flat_map(|atom| &atom.args));
        apart = rest;
    }
}
