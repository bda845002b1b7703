//! What a model knows of states, and what a state says that was probably meant otherwise: a predicate that the model does not
//! have and nearly has, and a thing of which nothing is said that was said of every thing of its type.
//!
//! A state may well say what a model does not know, and list what it says nothing of. It is doubted only where the name that is nearly meant could stand there, and
//! does not stand there too.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::{
    ArgumentTypes, GroundAtom, Hierarchy, LiftedAtom, Observations, Slot, State, Symbol, Term, TypeId, Unknown, nearest,
};

/// Names shorter than this differ in one letter by nature: `in` and `on`.
const SHORTEST_SLIP: usize = 3;

/// What a relation to something, and to nothing, is called after its name.
const RELATION: [&str; 2] = ["holds", "None"];

/// What is familiar of states to whoever has learned this much.
#[derive(Debug, Clone, Default)]
pub struct Familiar {
    predicates: ArgumentTypes,
    /// For each type, the attributes and relations of which one predicate always held of its objects, and these predicates.
    always: BTreeMap<Symbol, BTreeMap<Symbol, BTreeSet<Symbol>>>,
}

/// What was probably meant otherwise in a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unfamiliar {
    /// The model does not know this predicate, and has one of nearly that name.
    Predicate {
        /// The predicate.
        predicate: Symbol,
        /// The first atom of it.
        atom: GroundAtom,
        /// The one that may have been meant.
        near: Symbol,
    },
    /// None of these predicates holds of an object, and one of them held of each object of its type that was learned from.
    Missing {
        /// The object.
        object: Symbol,
        /// Its type.
        ty: Symbol,
        /// How many more objects of the type this is so of.
        more: usize,
        /// The attribute or relation that they are made from.
        key: Symbol,
        /// The predicates.
        predicates: Vec<Symbol>,
        /// What is said of the object that the model does not know, and may be meant.
        instead: Option<Symbol>,
    },
}

impl fmt::Display for Unfamiliar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Predicate { predicate, atom, .. } => {
                write!(f, "in the state, {atom}: the model has no predicate `{predicate}`")
            }
            Self::Missing { object, ty, more, predicates, .. } => {
                let more = if *more == 0 { String::new() } else { format!(" (and {more} more of this type)") };
                let names: Vec<&str> = predicates.iter().map(Symbol::as_str).collect();
                write!(
                    f,
                    "in the state, nothing is said of {object}{more} that gives {}: of each {ty} that was learned from \
                     something was",
                    names.join(" or ")
                )
            }
        }
    }
}

impl Unfamiliar {
    /// What to do about it.
    pub fn hint(&self) -> String {
        match self {
            Self::Predicate { near, .. } => format!("Did you mean `{near}`?"),
            Self::Missing { instead: Some(instead), predicates, .. } => {
                let names: Vec<String> = predicates.iter().map(|name| format!("`{name}`")).collect();
                format!("The model does not know `{instead}`: is it meant to be {}?", names.join(" or "))
            }
            Self::Missing { key, predicates, .. } if is_relation(key, predicates) => {
                format!("Where the relation `{key}` is to nothing, write null, which gives `{key}_None`.")
            }
            Self::Missing { key, .. } => format!("Is `{key}` left out, or misspelled?"),
        }
    }
}

impl Familiar {
    /// What is familiar from these predicates of a model, and from what it was learned from.
    pub fn of(predicates: &ArgumentTypes, observations: &Observations) -> Self {
        let mut always: BTreeMap<Symbol, BTreeMap<Symbol, BTreeSet<Symbol>>> = BTreeMap::new();
        for (key, named) in grouped(observations) {
            let is_relation = is_relation(&key, &named);
            let types: BTreeSet<&Symbol> = named.iter().flat_map(|name| first_types(observations, name)).collect();
            for ty in types.into_iter().filter(|ty| is_relation || always_one(observations, ty, &named)) {
                always.entry(ty.clone()).or_default().insert(key.clone(), named.clone());
            }
        }
        Self { predicates: predicates.clone(), always }
    }

    /// What was probably meant otherwise in this state, predicates first.
    pub fn doubts(&self, state: &State, hierarchy: &Hierarchy) -> Vec<Unfamiliar> {
        let mut said: BTreeMap<&Symbol, BTreeSet<&Symbol>> = BTreeMap::new();
        let mut unknown: BTreeMap<(&Symbol, usize), Vec<&GroundAtom>> = BTreeMap::new();
        for atom in &state.atoms {
            if let Some(first) = atom.args.first() {
                said.entry(first).or_default().insert(&atom.predicate);
            }
            if !self.predicates.contains_key(&atom.predicate) {
                unknown.entry((&atom.predicate, atom.arity())).or_default().push(atom);
            }
        }
        let mut found = Vec::new();
        for ((predicate, _), atoms) in &unknown {
            if let (Some(near), [first, ..]) = (self.meant(atoms, &said, state, hierarchy), atoms.as_slice()) {
                for atom in atoms {
                    atom.args.first().map(|object| said.entry(object).or_default().insert(near));
                }
                let (predicate, near) = ((*predicate).clone(), near.clone());
                found.push(Unfamiliar::Predicate { predicate, atom: (*first).clone(), near });
            }
        }
        found.extend(self.missing(&said, state, hierarchy));
        found
    }

    /// The predicate that may be meant by the one of these atoms: of nearly that name, for such objects, and not said of them.
    fn meant(
        &self,
        atoms: &[&GroundAtom],
        said: &BTreeMap<&Symbol, BTreeSet<&Symbol>>,
        state: &State,
        hierarchy: &Hierarchy,
    ) -> Option<&Symbol> {
        let fits = |atom: &&GroundAtom, types: &[TypeId]| {
            let is_a =
                |(object, ty): (&Symbol, &TypeId)| state.objects.get(object).is_some_and(|of| hierarchy.is_a(*of, *ty));
            atom.arity() == types.len() && atom.args.iter().zip(types).all(is_a)
        };
        let is_said = |atom: &&GroundAtom, name: &Symbol| match atom.args.first() {
            Some(object) => said.get(object).is_some_and(|said| said.contains(name)),
            None => state.atoms.iter().any(|other| other.predicate == *name),
        };
        let could_stand = |(name, types): &(&Symbol, &Vec<TypeId>)| {
            atoms.iter().all(|atom| fits(atom, types) && !is_said(atom, name))
        };
        let names = self.predicates.iter().filter(could_stand).map(|(name, _)| name).collect::<Vec<_>>();
        atoms.first().and_then(|atom| slip_of(&atom.predicate, &names))
    }

    fn missing(
        &self,
        said: &BTreeMap<&Symbol, BTreeSet<&Symbol>>,
        state: &State,
        hierarchy: &Hierarchy,
    ) -> Vec<Unfamiliar> {
        let mut found: Vec<Unfamiliar> = Vec::new();
        for (object, ty) in &state.objects {
            // What is merely there is no slip.
            let Some(of_object) = said.get(object) else { continue };
            let ty = hierarchy.name(*ty);
            for (key, predicates) in self.always.get(ty).into_iter().flatten() {
                if predicates.iter().any(|name| of_object.contains(name) || is_open(state, name, object)) {
                    continue;
                }
                let alike = found.iter_mut().find_map(|other| match other {
                    Unfamiliar::Missing { ty: of, key: other, more, .. } if of == ty && other == key => Some(more),
                    _ => None,
                });
                if let Some(more) = alike {
                    *more += 1;
                    continue;
                }
                let kind = is_relation(key, predicates);
                let could_be = |name: &&&Symbol| {
                    !self.predicates.contains_key(**name)
                        && name.as_str().rsplit_once('_').is_some_and(|(_, end)| RELATION.contains(&end) == kind)
                };
                let instead = of_object.iter().find(could_be).map(|name| (**name).clone());
                let predicates = predicates.iter().cloned().collect();
                let (object, ty, key) = (object.clone(), ty.clone(), key.clone());
                found.push(Unfamiliar::Missing { object, ty, more: 0, key, predicates, instead });
            }
        }
        found
    }
}

/// Predicates that are made from one attribute or relation, which has several values.
fn grouped(observations: &Observations) -> impl Iterator<Item = (Symbol, BTreeSet<Symbol>)> {
    let mut groups: BTreeMap<Symbol, BTreeSet<Symbol>> = BTreeMap::new();
    for (name, arity) in observations.predicates.keys() {
        if let Some((key, value)) = name.as_str().rsplit_once('_')
            && (*arity == 1 || *arity == 2 && value == RELATION[0])
        {
            groups.entry(Symbol::new(key)).or_default().insert(name.clone());
        }
    }
    groups.into_iter().filter(|(key, named)| {
        let holds = format!("{key}_{}", RELATION[0]);
        named.len() > 1 && (is_relation(key, named) || named.iter().all(|name| name.as_str() != holds))
    })
}

/// Whether these predicates are those of a relation to at most one thing.
fn is_relation<'a>(key: &Symbol, predicates: impl IntoIterator<Item = &'a Symbol>) -> bool {
    let names: BTreeSet<&str> = predicates.into_iter().map(Symbol::as_str).collect();
    names.len() == 2 && RELATION.iter().all(|end| names.contains(format!("{key}_{end}").as_str()))
}

/// The types of the objects that a predicate was met with in the first place.
fn first_types<'a>(observations: &'a Observations, name: &'a Symbol) -> impl Iterator<Item = &'a Symbol> {
    let met = observations.predicates.range((name.clone(), 1)..=(name.clone(), 2));
    met.filter_map(|(_, types)| types.first()).flatten()
}

/// Whether one of these predicates held of each object of this type that an action was about.
fn always_one(observations: &Observations, ty: &Symbol, predicates: &BTreeSet<Symbol>) -> bool {
    let mut was_met = false;
    for (key, cluster) in &observations.clusters {
        let places: Vec<u32> = (0..).zip(&key.types).filter(|(_, of)| *of == ty).map(|(place, _)| place).collect();
        if places.is_empty() {
            continue;
        }
        was_met = true;
        let (total, atoms) = cluster.states.counts();
        let held = |place: u32| -> u64 {
            let atom = |name: &Symbol| LiftedAtom { predicate: name.clone(), args: vec![Term::Param(place)] };
            predicates.iter().filter_map(|name| atoms.get(&atom(name))).sum()
        };
        if places.into_iter().any(|place| held(place) != total) {
            return false;
        }
    }
    was_met
}

/// Whether the state leaves open if this predicate holds of this object.
fn is_open(state: &State, name: &Symbol, object: &Symbol) -> bool {
    match &state.unknown {
        Unknown::AllBut(_) => true,
        Unknown::Matching(patterns) => patterns.iter().any(|pattern| {
            pattern.predicate == *name
                && pattern.args.first().is_none_or(|slot| match slot {
                    Slot::Any => true,
                    Slot::Is(of) => of == object,
                })
        }),
    }
}

/// The name among these of which this one is a slip: it differs in case, or in a few letters of what stands before its last
/// `_`, or after it.
fn slip_of<'a>(name: &Symbol, names: &[&'a Symbol]) -> Option<&'a Symbol> {
    let other_case = names.iter().find(|other| other.as_str().eq_ignore_ascii_case(name.as_str()));
    let Some((key, value)) = name.as_str().rsplit_once('_') else {
        return other_case.copied().or_else(|| near(name.as_str(), names.iter().map(|other| (other.as_str(), *other))));
    };
    let parts = || names.iter().filter_map(|other| Some((other.as_str().rsplit_once('_')?, *other)));
    let of_value = parts().filter(|((_, other), _)| *other == value).map(|((key, _), name)| (key, name));
    let of_key = parts().filter(|((other, _), _)| *other == key).map(|((_, value), name)| (value, name));
    other_case.copied().or_else(|| near(value, of_key)).or_else(|| near(key, of_value))
}

/// The name of what is nearly called so. What differs in digits only is another of its kind.
fn near<'a, 'n>(part: &str, named: impl Iterator<Item = (&'n str, &'a Symbol)>) -> Option<&'a Symbol> {
    let without_digits = |text: &str| text.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
    if part.chars().count() < SHORTEST_SLIP {
        return None;
    }
    let named: Vec<(Symbol, &Symbol)> = named
        .filter(|(other, _)| without_digits(other) != without_digits(part))
        .map(|(other, name)| (Symbol::new(other), name))
        .collect();
    let nearest = nearest(part, named.iter().map(|(other, _)| other))?;
    named.iter().find(|(other, _)| other == nearest).map(|(_, name)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Witness;

    fn hierarchy() -> Hierarchy {
        Hierarchy::from_edges([("lock", "thing"), ("key", "thing"), ("guard", "thing")]).expect("a tree")
    }

    /// A guard holds keys, at most one; a key lies in a lock, or in none; a lock is Bolted or Loose.
    fn familiar() -> Familiar {
        let names = [
            ("bolt_Bolted", vec!["lock"]),
            ("bolt_Loose", vec!["lock"]),
            ("grip_holds", vec!["guard", "key"]),
            ("grip_None", vec!["guard"]),
            ("in_holds", vec!["key", "lock"]),
            ("alarm", vec![]),
            ("floor_10", vec!["lock"]),
        ];
        let mut observations = Observations::default();
        for (name, types) in &names {
            let types: Vec<Symbol> = types.iter().copied().map(Symbol::new).collect();
            observations.add_predicate(&Symbol::new(name), types.iter().map(Some));
        }
        for atom in ["bolt_Bolted(?0)", "bolt_Loose(?0)"] {
            let atom = LiftedAtom::parse(atom).expect("an atom");
            let key = crate::ClusterKey {
                action: Symbol::new("kick"),
                types: vec![Symbol::new("lock")],
                call: vec![0],
                adds: Vec::new(),
                deletes: vec![atom.clone()],
            };
            let witness = Witness { file: Symbol::new("a"), step: 1 };
            observations.clusters.entry(key).or_default().add(BTreeSet::from([atom]), witness);
        }
        let id = |ty: &&str| hierarchy().id(ty).expect("declared");
        let predicates =
            names.iter().map(|(name, types)| (Symbol::new(name), types.iter().map(id).collect::<Vec<TypeId>>()));
        Familiar::of(&predicates.collect(), &observations)
    }

    /// What is said of a state of one guard, one key, and one lock, with the hints.
    fn said(atoms: &str) -> Vec<String> {
        let objects = [("guard_1", "guard"), ("key_1", "key"), ("lock_1", "lock")];
        let id = |ty: &str| hierarchy().id(ty).expect("declared");
        let state = State {
            objects: objects.map(|(name, ty)| (Symbol::new(name), id(ty))).into(),
            atoms: atoms.split_whitespace().map(|atom| GroundAtom::parse(atom).expect(atom)).collect(),
            ..State::default()
        };
        let doubts = familiar().doubts(&state, &hierarchy());
        doubts.iter().map(|doubt| format!("{doubt} | {}", doubt.hint())).collect()
    }

    fn no_predicate(atom: &str, near: &str) -> Vec<String> {
        let (name, _) = atom.split_once('(').expect("an atom");
        vec![format!("in the state, {atom}: the model has no predicate `{name}` | Did you mean `{near}`?")]
    }

    #[test]
    fn what_is_nearly_a_predicate_is_doubted() {
        for (said_of_lock, said_of_guard, atom, near) in [
            ("bolt_Boltd(lock_1)", "grip_None(guard_1)", "bolt_Boltd(lock_1)", "bolt_Bolted"),
            ("bolt_loose(lock_1)", "grip_None(guard_1)", "bolt_loose(lock_1)", "bolt_Loose"),
            ("bollt_Loose(lock_1)", "grip_None(guard_1)", "bollt_Loose(lock_1)", "bolt_Loose"),
            ("bolt_Loose(lock_1)", "gripp_holds(guard_1,key_1)", "gripp_holds(guard_1,key_1)", "grip_holds"),
            ("bolt_Loose(lock_1)", "grip_hold(guard_1,key_1)", "grip_hold(guard_1,key_1)", "grip_holds"),
            ("bolt_Loose(lock_1)", "grip_none(guard_1)", "grip_none(guard_1)", "grip_None"),
            ("bolt_Loose(lock_1)", "grip_None(guard_1) alram()", "alram()", "alarm"),
        ] {
            assert_eq!(said(&format!("{said_of_lock} {said_of_guard}")), no_predicate(atom, near), "{atom}");
        }
    }

    #[test]
    fn what_was_said_of_each_and_is_not_said_is_doubted() {
        let nothing = |object: &str, ty: &str, gives: &str, hint: &str| {
            format!(
                "in the state, nothing is said of {object} that gives {gives}: of each {ty} that was learned from something \
                 was | {hint}"
            )
        };
        assert_eq!(
            said("bolt_Loose(lock_1) at_holds(guard_1,lock_1)"),
            [nothing(
                "guard_1",
                "guard",
                "grip_None or grip_holds",
                "The model does not know `at_holds`: is it meant to be `grip_None` or `grip_holds`?"
            )]
        );
        assert_eq!(
            said("bolt_Loose(lock_1) awake(guard_1)"),
            [nothing(
                "guard_1",
                "guard",
                "grip_None or grip_holds",
                "Where the relation `grip` is to nothing, write null, which gives `grip_None`."
            )]
        );
        assert_eq!(
            said("grip_None(guard_1) awake(lock_1)"),
            [nothing("lock_1", "lock", "bolt_Bolted or bolt_Loose", "Is `bolt` left out, or misspelled?")]
        );
    }

    #[test]
    fn what_is_merely_new_is_not_doubted() {
        let usual = "bolt_Loose(lock_1) grip_None(guard_1)";
        assert_eq!(said(""), [""; 0], "what is merely there");
        for new in [
            "on_holds(key_1,lock_1)",
            "colour_Red(lock_1)",
            "floor_11(lock_1)",
            "bolt_Bolte(lock_1) bolt_Bolted(lock_1)",
            "bolt_Boltd(key_1)",
            "armed()",
        ] {
            assert_eq!(said(&format!("{usual} {new}")), [""; 0], "{new}");
        }
    }
}
