//! All that was tried in a run, laid out for belief: what was alike is counted once, and what befell each object that failed is at
//! hand.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{HashMap, HashSet, LiftedAtom, Symbol};

use crate::around::{Surroundings, Tally};
use crate::deed::{Deed, Tried};

/// All that was tried in a run.
#[derive(Debug, Clone, Default)]
pub struct Run<'d> {
    /// What worked, each kind once, with how often it did.
    worked: BTreeMap<Kind<'d>, (&'d Deed, u64)>,
    failed: Vec<Tried<'d>>,
    /// What befell the objects of failures, by where they stood.
    uses: HashMap<Place<'d>, Vec<Use<'d>>>,
    surroundings: Option<&'d Surroundings>,
}

/// What deeds have in common that differ in their objects and their instance alone.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Kind<'d> {
    call: &'d Symbol,
    adds: &'d BTreeSet<Symbol>,
    participants: Vec<(&'d Symbol, Option<usize>)>,
    held: &'d BTreeSet<LiftedAtom>,
}

/// A place in a call, and the object there.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Place<'d> {
    instance: &'d Symbol,
    call: &'d Symbol,
    object: &'d Symbol,
    place: usize,
}

/// What befell an object.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Use<'d> {
    pub(crate) deed: &'d Deed,
    pub(crate) worked: bool,
    pub(crate) when: u64,
}

impl<'d> Run<'d> {
    /// From all that was tried, in any order, and what held around what worked. In time of what was tried, but for a logarithm.
    pub fn new(tried: &[Tried<'d>], surroundings: &'d Surroundings) -> Self {
        let mut run = Self { surroundings: Some(surroundings), ..Self::default() };
        let failed = tried.iter().filter(|one| !one.worked);
        let of_failures: HashSet<&Symbol> =
            failed.flat_map(|one| one.deed.participants.iter().map(|participant| &participant.object)).collect();
        for one in tried {
            let Tried { deed, worked, count, when, .. } = *one;
            for participant in &deed.participants {
                let Some(place) = participant.place.filter(|_| of_failures.contains(&participant.object)) else {
                    continue;
                };
                let place = Place { instance: &deed.instance, call: &deed.call, object: &participant.object, place };
                run.uses.entry(place).or_default().push(Use { deed, worked, when });
            }
            if worked {
                run.worked.entry(Kind::of(deed)).or_insert((deed, 0)).1 += count;
            } else {
                run.failed.push(*one);
            }
        }
        run
    }

    /// One deed of each kind that worked, with how often that kind did.
    pub(crate) fn worked(&self) -> impl Iterator<Item = (&'d Deed, u64)> {
        self.worked.values().copied()
    }

    /// What failed.
    pub fn failed(&self) -> &[Tried<'d>] {
        &self.failed
    }

    /// What held around the deeds like this one that worked; none if none did.
    pub(crate) fn around(&self, deed: &Deed) -> Option<&Tally> {
        self.surroundings?.of(deed)
    }

    /// What befell an object of a failure where it stood in this deed, in all calls of that name in its instance; nothing if
    /// the call did not name it.
    pub(crate) fn uses(&self, deed: &'d Deed, object: &Symbol) -> &[Use<'d>] {
        let participant = deed.participants.iter().find(|participant| participant.object == *object);
        let place = participant.and_then(|participant| {
            let (object, place) = (&participant.object, participant.place?);
            Some(Place { instance: &deed.instance, call: &deed.call, object, place })
        });
        place.and_then(|place| self.uses.get(&place)).map_or(&[], Vec::as_slice)
    }
}

impl<'d> Kind<'d> {
    fn of(deed: &'d Deed) -> Self {
        let participants = deed.participants.iter().map(|participant| (&participant.ty, participant.place));
        Self { call: &deed.call, adds: &deed.adds, participants: participants.collect(), held: &deed.held }
    }
}
