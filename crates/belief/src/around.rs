//! How often what held around the deeds of an action, and what of it may be to blame for its failures. Evidence does not know that,
//! since it holds only what is over the things that took part; so it is counted here, from the first deed on.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift_model::Symbol;

use crate::CHANCE;
use crate::deed::Deed;
use crate::surroundings::Surrounding;

/// How often what held around the deeds that worked, for each action.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Surroundings(Vec<Tally>);

/// What held around the deeds of an action that worked.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct Tally {
    /// The action, by call, by what it adds, and by the place of each participant in the call.
    call: Symbol,
    adds: BTreeSet<Symbol>,
    places: Vec<Option<usize>>,
    /// How many worked.
    pub(crate) total: u64,
    /// Around how many of them each held, sorted.
    pub(crate) held: Vec<(Surrounding, u64)>,
}

impl Surroundings {
    /// Notes what held around a deed that worked.
    pub fn note(&mut self, deed: &Deed, held: BTreeSet<Surrounding>) {
        let at = self.0.iter().position(|tally| tally.is_of(deed)).unwrap_or_else(|| {
            let places = deed.participants.iter().map(|participant| participant.place).collect();
            let (call, adds) = (deed.call.clone(), deed.adds.clone());
            self.0.push(Tally { call, adds, places, total: 0, held: Vec::new() });
            self.0.len() - 1
        });
        let tally = &mut self.0[at];
        tally.total += 1;
        for surrounding in held {
            match tally.held.binary_search_by(|(known, _)| known.cmp(&surrounding)) {
                Ok(at) => tally.held[at].1 += 1,
                Err(at) => tally.held.insert(at, (surrounding, 1)),
            }
        }
    }

    /// What held around the deeds like this one that worked; none if none did.
    pub(crate) fn of(&self, deed: &Deed) -> Option<&Tally> {
        self.0.iter().find(|tally| tally.is_of(deed))
    }
}

impl Tally {
    fn is_of(&self, deed: &Deed) -> bool {
        let places = deed.participants.iter().map(|participant| participant.place);
        self.call == deed.call && self.adds == deed.adds && places.eq(self.places.iter().copied())
    }
}

/// The odds of all that held around a failure, or did not, and may be to blame: without any blame, and with all that worked to
/// speak for it.
const ANY: f64 = 0.1;
const MOST: f64 = 10.0;
/// How often what may be needed holds anyway, and what may not does not.
const AS_IT_IS: f64 = 0.8;

/// What held around where an action worked, and around its failures.
#[derive(Debug, Clone, Default)]
pub(crate) struct Around {
    worked: f64,
    held: BTreeMap<Surrounding, f64>,
    /// What may be to blame: what held around a failure, and what nearly always held where it worked.
    candidates: BTreeSet<Surrounding>,
}

impl Around {
    /// From what held around where it worked, and around each failure.
    pub(crate) fn new<'s>(tally: Option<&Tally>, failures: impl Iterator<Item = &'s BTreeSet<Surrounding>>) -> Self {
        let held = tally.into_iter().flat_map(|tally| &tally.held);
        let mut around = Self {
            worked: tally.map_or(0.0, |tally| tally.total as f64),
            held: held.map(|(surrounding, count)| (surrounding.clone(), *count as f64)).collect(),
            candidates: failures.flatten().cloned().collect(),
        };
        let mostly: Vec<Surrounding> = around.mostly().map(|(surrounding, _)| surrounding.clone()).collect();
        around.candidates.extend(mostly);
        around
    }

    /// What held nearly always where it worked.
    fn mostly(&self) -> impl Iterator<Item = (&Surrounding, f64)> {
        let counted = self.held.iter().map(|(surrounding, count)| (surrounding, *count));
        counted.filter(|(_, count)| 2.0 * count > self.worked)
    }

    /// What may be to blame where these held, each with its logarithmic odds, and whether it held.
    pub(crate) fn suspects<'s>(
        &'s self,
        here: &'s BTreeSet<Surrounding>,
    ) -> impl Iterator<Item = (&'s Surrounding, bool, f64)> {
        let odds = |against: f64| {
            let of_one = (ANY / self.candidates.len() as f64).ln();
            let spoken_for = ((against - self.worked) * AS_IT_IS.ln()).min(MOST.ln());
            of_one + spoken_for + against * CHANCE.ln()
        };
        let present = here.intersection(&self.candidates).map(move |surrounding| {
            let against = self.held.get(surrounding).copied().unwrap_or_default();
            (surrounding, true, odds(against))
        });
        let missing = self.mostly().filter(|(surrounding, _)| !here.contains(surrounding));
        present.chain(missing.map(move |(surrounding, count)| (surrounding, false, odds(self.worked - count))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_held_where_it_worked_is_suspected_more_with_all_that_worked() {
        let full = || Surrounding::Something { property: "full".into(), ty: "box".into() };
        let open = || Surrounding::Something { property: "open".into(), ty: "door".into() };
        let deed = Deed {
            instance: "here".into(),
            call: "cut".into(),
            adds: ["cut".into()].into(),
            participants: Vec::new(),
            held: BTreeSet::new(),
        };
        let odds = |worked: &[&[Surrounding]]| -> Vec<(Surrounding, bool, f64)> {
            let mut surroundings = Surroundings::default();
            worked.iter().for_each(|held| surroundings.note(&deed, held.iter().cloned().collect()));
            let here = BTreeSet::from([full()]);
            let around = Around::new(surroundings.of(&deed), [&here].into_iter());
            around.suspects(&here).map(|(one, held, odds)| (one.clone(), held, odds)).collect()
        };
        let never = odds(&[&[], &[]]);
        assert!(never[0].2 > odds(&[&[]])[0].2, "{never:?}");
        let (once, twice) = (odds(&[&[full()], &[]]), odds(&[&[full()], &[full()]]));
        assert!(once[0].2 < never[0].2 - 3.0 && twice[0].2 < once[0].2 - 3.0, "{once:?} {twice:?}");
        let always = odds(&[&[open()], &[open()]]);
        assert_eq!(
            always.iter().map(|(one, held, _)| (one, *held)).collect::<Vec<_>>(),
            [(&full(), true), (&open(), false)]
        );
    }
}
