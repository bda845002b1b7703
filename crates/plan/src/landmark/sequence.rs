//! The paper's landmarks: in one sequence per goal object.
//!
//! A *goal object* is one with a unary goal atom; its sequence holds the landmarks, of all goal atoms that mention it,
//! which mention it and do not hold initially. An atom that mentions several goal objects joins the sequence of the
//! first. Any other goal atom gets a sequence of its own. Orders: A comes before B if it must: naturally (A is a landmark
//! of B), or since B would foreclose it (each achiever of A needs a fact that every achiever of B deletes and nothing adds
//! again). Else if it is reasonable: every achiever of B destroys something that A needs and that does not hold initially,
//! and not the other way round. Cycles and ties by the number of landmarks, then by name. Finally a landmark that is
//! needed again is inserted again: before each L, what all achievers of L need and every achiever of some landmark since
//! has destroyed.
//!
//! Why a reasonable order looks only at what does not hold initially: if initial facts counted too, loading a machine
//! would come before preparing what is loaded, and plans would get longer.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{Budget, GroundAtom, Stop, Symbol};

use super::LandmarkSets;
use crate::fact::FactId;
use crate::fdr::Fdr;
use crate::ground::GroundTask;
use crate::poll::Poll;
use crate::relaxation::{Negatives, Prop, Relaxation, RelaxedIndex};

/// Landmarks in the order in which they are to be passed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LandmarkSequence {
    /// The goal object, if the sequence belongs to one.
    pub object: Option<Symbol>,
    /// The facts, with repetitions.
    pub facts: Vec<FactId>,
}

/// The landmark sequences of a task whose goals are all reachable, by goal object, then by other goal atom.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub fn landmark_sequences(task: &GroundTask, budget: &Budget) -> Result<Vec<LandmarkSequence>, Stop> {
    sequences(task, &Fdr::new(task, budget)?, budget)
}

/// The same, where the finite-domain representation is there already.
pub(crate) fn sequences(task: &GroundTask, fdr: &Fdr, budget: &Budget) -> Result<Vec<LandmarkSequence>, Stop> {
    let mut poll = Poll::new(budget);
    let relaxation = Relaxation::new(fdr, Negatives::Ignored, &mut poll)?;
    let landmarks = LandmarkSets::of(fdr, &relaxation, &mut poll)?;
    let mut sequences = Vec::new();
    for (object, goals) in clusters(task) {
        let objects: BTreeSet<&Symbol> = match &object {
            Some(object) => BTreeSet::from([object]),
            None => goals.iter().flat_map(|goal| &goal.args).collect(),
        };
        let mut props: BTreeSet<Prop> = BTreeSet::new();
        for goal in &goals {
            let Some(place) = task.facts().find(goal).and_then(|fact| fdr.assignment(fact)) else { continue };
            let goal = fdr.number(place);
            let mentions = |prop: Prop| task.atom(fdr.fact(prop)).args.iter().any(|arg| objects.contains(arg));
            props.extend(landmarks.of_prop(goal).iter().filter(|&&prop| mentions(prop)));
            // Also if it cannot be reached.
            props.extend((!landmarks.initial[goal as usize]).then_some(goal));
        }
        let orders = Orders { task, landmarks: &landmarks };
        let ordered = orders.ordered(&props.into_iter().collect::<Vec<_>>(), &mut poll)?;
        let props = orders.with_repetitions(&ordered, &mut poll)?;
        sequences.push(LandmarkSequence { object, facts: props.into_iter().map(|prop| fdr.fact(prop)).collect() });
    }
    Ok(sequences)
}

/// The goal's atoms by goal object; atoms that mention none stand alone, after them.
fn clusters(task: &GroundTask) -> Vec<(Option<Symbol>, Vec<GroundAtom>)> {
    let objects = task.asked().required.iter().filter(|atom| atom.arity() == 1).map(|atom| &atom.args[0]);
    let mut clusters: BTreeMap<&Symbol, Vec<GroundAtom>> = objects.map(|object| (object, Vec::new())).collect();
    let mut alone = Vec::new();
    for atom in &task.asked().required {
        match atom.args.iter().find(|&arg| clusters.contains_key(arg)) {
            Some(object) => clusters.entry(object).or_default().push(atom.clone()),
            None => alone.push((None, vec![atom.clone()])),
        }
    }
    clusters.into_iter().map(|(object, atoms)| (Some(object.clone()), atoms)).chain(alone).collect()
}

/// In which order landmarks are passed.
struct Orders<'a> {
    task: &'a GroundTask,
    landmarks: &'a LandmarkSets<'a>,
}

impl Orders<'_> {
    fn every_achiever(&self, prop: Prop, test: impl Fn(RelaxedIndex) -> bool) -> bool {
        self.landmarks.achievers(prop).iter().all(|&relaxed| test(relaxed))
    }

    fn preconditions(&self, relaxed: RelaxedIndex) -> Vec<Prop> {
        self.landmarks.relaxation.preconditions.get(relaxed as usize).to_vec()
    }

    fn deletes(&self, relaxed: RelaxedIndex) -> Vec<Prop> {
        self.landmarks.deletes(relaxed).iter().map(|&place| self.landmarks.task.number(place)).collect()
    }

    /// Whether every achiever of `b` destroys something that `a` needs.
    fn destroyed_by_achieving(&self, a: Prop, b: Prop) -> bool {
        self.every_achiever(b, |relaxed| self.deletes(relaxed).iter().any(|&prop| self.landmarks.is_before(prop, a)))
    }

    /// What every achiever of a proposition has in a list, sorted.
    fn common(&self, prop: Prop, list: impl Fn(RelaxedIndex) -> Vec<Prop>) -> Vec<Prop> {
        let mut achievers = self.landmarks.achievers(prop).iter().map(|&relaxed| list(relaxed));
        let Some(first) = achievers.next() else { return Vec::new() };
        achievers.fold(first, |mut common, other| {
            common.retain(|prop| other.binary_search(prop).is_ok());
            common
        })
    }

    /// Whether `a` cannot be achieved any more once `lost` is lost: each achiever of `a` needs some of it.
    fn foreclosed(&self, a: Prop, lost: &[Prop]) -> bool {
        let needs = |relaxed| self.preconditions(relaxed).iter().any(|prop| lost.binary_search(prop).is_ok());
        !lost.is_empty() && self.every_achiever(a, needs)
    }

    fn ordered(&self, props: &[Prop], poll: &mut Poll<'_>) -> Result<Vec<Prop>, Stop> {
        let atom = |prop: Prop| self.task.atom(self.landmarks.task.fact(prop));
        let mut sorted: Vec<(usize, GroundAtom, Prop)> =
            props.iter().map(|&prop| (self.landmarks.of_prop(prop).len(), atom(prop), prop)).collect();
        sorted.sort_unstable();
        let props: Vec<Prop> = sorted.into_iter().map(|(_, _, prop)| prop).collect();
        // What achieving each fact deletes and nothing ever adds again.
        let lost: Vec<Vec<Prop>> = props
            .iter()
            .map(|&prop| {
                let mut deleted = self.common(prop, |relaxed| self.deletes(relaxed));
                deleted.retain(|&prop| self.landmarks.achievers(prop).is_empty());
                deleted
            })
            .collect();
        // Two that foreclose each other have to be achieved at once: neither comes before the other.
        let must = |a: usize, b: usize| {
            self.landmarks.is_before(props[a], props[b])
                || self.foreclosed(props[a], &lost[b]) && !self.foreclosed(props[b], &lost[a])
        };
        let before = |a: usize, b: usize| {
            must(a, b)
                || !must(b, a)
                    && self.destroyed_by_achieving(props[a], props[b])
                    && !self.destroyed_by_achieving(props[b], props[a])
        };
        let n = props.len();
        let mut waits_for = vec![0_usize; n];
        let mut followers: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))).filter(|(a, b)| a != b) {
            poll.check(1 + self.landmarks.achievers(props[a]).len() + self.landmarks.achievers(props[b]).len())?;
            if before(a, b) {
                waits_for[b] += 1;
                followers[a].push(b);
            }
        }
        let mut left: Vec<usize> = (0..n).collect();
        let mut ordered = Vec::with_capacity(n);
        while !left.is_empty() {
            let next = left.remove(left.iter().position(|&place| waits_for[place] == 0).unwrap_or(0));
            for &follower in &followers[next] {
                waits_for[follower] -= 1;
            }
            ordered.push(props[next]);
        }
        Ok(ordered)
    }

    fn with_repetitions(&self, ordered: &[Prop], poll: &mut Poll<'_>) -> Result<Vec<Prop>, Stop> {
        let mut sequence: Vec<Prop> = Vec::with_capacity(ordered.len());
        // Whether each landmark was destroyed, by what every achiever of a later one deletes, since its last place.
        let mut destroyed = vec![false; ordered.len()];
        for (i, &landmark) in ordered.iter().enumerate() {
            poll.check(1 + i * self.landmarks.achievers(landmark).len())?;
            let needed = self.common(landmark, |relaxed| self.preconditions(relaxed));
            let mut insert = |place: usize, prop: Prop, destroyed: &mut Vec<bool>| {
                let deleted = self.common(prop, |relaxed| self.deletes(relaxed));
                for (j, earlier) in ordered[..i].iter().enumerate() {
                    destroyed[j] |= *earlier != prop && deleted.binary_search(earlier).is_ok();
                }
                destroyed[place] = false;
                sequence.push(prop);
            };
            for (j, &earlier) in ordered[..i].iter().enumerate() {
                if destroyed[j] && needed.binary_search(&earlier).is_ok() {
                    insert(j, earlier, &mut destroyed);
                }
            }
            insert(i, landmark, &mut destroyed);
        }
        Ok(sequence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worked::Worked;

    /// The landmarks of the egg, in their order.
    fn of_the_egg(text: &str) -> Vec<String> {
        let worked = Worked::new(text);
        let sequences = sequences(&worked.ground, &worked.fdr, &Budget::unlimited()).expect("no limits");
        let [LandmarkSequence { facts, .. }] = &sequences[..] else { panic!("one goal object: {sequences:?}") };
        facts.iter().map(|&fact| worked.ground.atom(fact).to_string()).collect()
    }

    #[test]
    fn what_is_needed_again_is_there_again() {
        // Boiling puts the egg down, and serving needs it in the hand.
        let landmarks = of_the_egg(
            "init: lying(egg)
             goal: served(egg)
             take(?0): lying(?0) -> held(?0) !lying(?0)
             boil(?0): held(?0) -> boiled(?0) lying(?0) !held(?0)
             serve(?0): held(?0) boiled(?0) -> served(?0) !held(?0)",
        );
        assert_eq!(landmarks, ["held(egg)", "boiled(egg)", "held(egg)", "served(egg)"]);
    }

    #[test]
    fn what_puts_the_egg_down_comes_last() {
        // Both need it in the hand, and boiling puts it down: so it is washed first, although b comes before w.
        let landmarks = of_the_egg(
            "init: lying(egg)
             goal: boiled(egg) washed(egg)
             take(?0): lying(?0) -> held(?0) !lying(?0)
             boil(?0): held(?0) -> boiled(?0) lying(?0) !held(?0)
             wash(?0): held(?0) -> washed(?0)",
        );
        assert_eq!(landmarks, ["held(egg)", "washed(egg)", "boiled(egg)"]);
    }

    #[test]
    fn what_would_be_foreclosed_comes_first() {
        // A fried egg is never raw again, and only a raw one can be painted: it is painted first, although f comes before p.
        let landmarks = of_the_egg(
            "init: raw(egg)
             goal: fried(egg) painted(egg)
             fry(?0): raw(?0) -> fried(?0) !raw(?0)
             paint(?0): raw(?0) -> painted(?0)",
        );
        assert_eq!(landmarks, ["painted(egg)", "fried(egg)"]);
    }
}
