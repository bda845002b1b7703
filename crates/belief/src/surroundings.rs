//! What held around who took part in a deed, and may be to blame: of what took no part, and of what they were linked with.
//!
//! Such a literal speaks of something that the call does not name: some toaster is full, the cup is in something that is
//! closed, both are in the same room.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{HashMap, Hierarchy, LiftedAtom, State, Symbol, Term};

/// Something that held around who took part. Participants are numbered as those of the deed, from 0.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Surrounding {
    /// Something of exactly this type, which took no part, had this property.
    Something {
        /// The predicate.
        property: Symbol,
        /// The name of the type.
        #[serde(rename = "type")]
        ty: Symbol,
    },
    /// What a participant was linked with had this property.
    Linked {
        /// The link.
        link: Link,
        /// The predicate.
        property: Symbol,
    },
    /// Two participants were linked with the same thing.
    Joined(Link, Link),
}

/// An atom of a participant and of something that took no part.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Link {
    /// The predicate.
    pub predicate: Symbol,
    /// The participant.
    pub of: u32,
    /// Whether the participant is its first argument, else the second.
    pub first: bool,
}

impl Link {
    /// The atom of these two.
    pub fn atom(&self, participant: Term, other: Term) -> LiftedAtom {
        let args = if self.first { vec![participant, other] } else { vec![other, participant] };
        LiftedAtom { predicate: self.predicate.clone(), args }
    }
}

impl Surrounding {
    /// All that held in a state around these objects, of predicates of which one at least `changes`. In time of the state's
    /// atoms, and of the square of what something is linked by.
    pub fn of(
        objects: &[Symbol],
        state: &State,
        hierarchy: &Hierarchy,
        changes: impl Fn(&Symbol) -> bool,
    ) -> BTreeSet<Self> {
        let place = |object: &Symbol| objects.iter().position(|other| other == object).map(|at| at as u32);
        let mut properties: HashMap<&Symbol, Vec<&Symbol>> = HashMap::default();
        let mut links: BTreeMap<&Symbol, BTreeSet<Link>> = BTreeMap::new();
        for atom in &state.atoms {
            match &atom.args[..] {
                [object] if place(object).is_none() => properties.entry(object).or_default().push(&atom.predicate),
                [one, other] => {
                    let predicate = atom.predicate.clone();
                    match (place(one), place(other)) {
                        (Some(of), None) => {
                            links.entry(other).or_default().insert(Link { predicate, of, first: true });
                        }
                        (None, Some(of)) => {
                            links.entry(one).or_default().insert(Link { predicate, of, first: false });
                        }
                        _ => {}
                    }
                }
                _ => {}
            }
        }
        let mut found = BTreeSet::new();
        for (object, properties) in &properties {
            let Some(ty) = state.objects.get(*object) else { continue };
            for property in properties.iter().filter(|property| changes(property)) {
                found.insert(Self::Something { property: (*property).clone(), ty: hierarchy.name(*ty).clone() });
            }
        }
        for (object, links) in &links {
            for link in links {
                for property in properties.get(*object).into_iter().flatten() {
                    if changes(&link.predicate) || changes(property) {
                        found.insert(Self::Linked { link: link.clone(), property: (*property).clone() });
                    }
                }
                let others = links.iter().filter(|other| link.of < other.of);
                for other in others.filter(|other| changes(&link.predicate) || changes(&other.predicate)) {
                    found.insert(Self::Joined(link.clone(), other.clone()));
                }
            }
        }
        found
    }

    /// The participants that it speaks of.
    pub fn participants(&self) -> BTreeSet<u32> {
        match self {
            Self::Something { .. } => BTreeSet::new(),
            Self::Linked { link, .. } => [link.of].into(),
            Self::Joined(one, other) => [one.of, other.of].into(),
        }
    }

    /// It in words, with these names of participants.
    pub fn in_words(&self, name: impl Fn(u32) -> String) -> String {
        let atom = |link: &Link| {
            let (one, other) = (name(link.of), "X".to_owned());
            let (one, other) = if link.first { (one, other) } else { (other, one) };
            format!("{}({one}, {other})", link.predicate)
        };
        match self {
            Self::Something { property, ty } => format!("{property}(X) of some {ty} X"),
            Self::Linked { link, property } => format!("{} and {property}(X) of some X", atom(link)),
            Self::Joined(one, other) => format!("{} and {} of some X", atom(one), atom(other)),
        }
    }
}

impl fmt::Display for Surrounding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.in_words(|participant| format!("#{}", participant + 1)))
    }
}

#[cfg(test)]
mod tests {
    use typelift_model::GroundAtom;

    use super::*;

    /// A cup in a cupboard that is closed, somebody in the same room as the cupboard, a toaster that is full.
    fn state(hierarchy: &Hierarchy) -> State {
        let id = |name: &str| hierarchy.id(name).expect("a type");
        let objects = [("anna", "person"), ("cup", "cup"), ("cupboard", "box"), ("toaster", "box"), ("hall", "room")];
        let atoms = [
            "in(cup, cupboard)",
            "closed(cupboard)",
            "full(toaster)",
            "in(anna, hall)",
            "in(cupboard, hall)",
            "big(hall)",
        ];
        State {
            objects: objects.map(|(name, ty)| (name.into(), id(ty))).into(),
            atoms: atoms.map(|atom| GroundAtom::parse(atom).expect("an atom")).into(),
            ..State::default()
        }
    }

    #[test]
    fn what_is_around_is_what_others_are_and_what_they_are_linked_with() {
        let edges = [("person", "object"), ("cup", "object"), ("box", "object"), ("room", "object")];
        let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
        let changes = |predicate: &Symbol| *predicate != "big";
        let around = |objects: &[&str]| -> Vec<String> {
            let objects: Vec<Symbol> = objects.iter().map(|name| (*name).into()).collect();
            let found = Surrounding::of(&objects, &state(&hierarchy), &hierarchy, changes);
            found.iter().map(|one| one.in_words(|at| objects[at as usize].to_string())).collect()
        };
        assert_eq!(
            around(&["anna", "cup"]),
            [
                "closed(X) of some box X",
                "full(X) of some box X",
                "in(anna, X) and big(X) of some X",
                "in(cup, X) and closed(X) of some X",
            ]
        );
        assert_eq!(
            around(&["anna", "cupboard"]),
            [
                "full(X) of some box X",
                "in(anna, X) and big(X) of some X",
                "in(cupboard, X) and big(X) of some X",
                "in(anna, X) and in(cupboard, X) of some X",
            ]
        );
    }
}
