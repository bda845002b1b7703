//! Two goal atoms of which each undoes what the other needs.
//!
//! That is shown, not guessed: after whatever adds the one, nothing adds the other any more, even if from then on nothing were
//! deleted; and whatever adds the one is not possible while the other holds, or deletes it. So in the end not both hold.

use std::fmt::{self, Display};

use serde::{Deserialize, Serialize};
use typelift_model::{GroundAtom, HashMap, HashSet, Symbol};

use crate::fact::FactId;
use crate::fdr::MutexGroups;
use crate::ground::GroundTask;
use crate::op::Op;

/// The most ground actions that are looked at, each time one is.
const MOST_WORK: usize = 2_000_000;

/// Two goal atoms of which each undoes what the other needs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Conflict<A = GroundAtom> {
    /// The one.
    pub one: A,
    /// The other, which cannot be reached any more once the one was.
    pub other: A,
    /// What keeps it from being reached then; nothing if no action adds it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost: Option<Need<A>>,
    /// What the one takes: something that never holds together with the other, or the other itself, which is deleted.
    pub price: Need<A>,
}

/// What an action needs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Need<A = GroundAtom> {
    /// Its name, as plans have it.
    pub action: Symbol,
    /// The atom.
    pub atom: A,
}

impl<A> Conflict<A> {
    /// The same with its atoms said otherwise.
    pub fn map<B>(&self, say: impl Fn(&A) -> B) -> Conflict<B> {
        let need = |need: &Need<A>| Need { action: need.action.clone(), atom: say(&need.atom) };
        let (lost, price) = (self.lost.as_ref().map(need), need(&self.price));
        Conflict { one: say(&self.one), other: say(&self.other), lost, price }
    }
}

impl<A: Display + PartialEq> Display for Conflict<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { one, other, lost, price } = self;
        write!(f, "{one} and {other} undo each other: once {one} is reached, {other} cannot be any more, since ")?;
        match lost {
            Some(Need { action, atom }) => write!(f, "{action} needs {atom}")?,
            None => f.write_str("no action adds it")?,
        }
        let Need { action, atom } = price;
        match atom == other {
            true => write!(f, "; and {action}, which adds {one}, deletes {other}"),
            false => {
                write!(f, "; and {action}, which adds {one}, needs {atom}, which never holds together with {other}")
            }
        }
    }
}

/// Two goal atoms of which each undoes what the other needs, if there are such and it does not take long to find out: time
/// grows with the number of pairs of goals and that of ground actions.
pub(crate) fn conflict(task: &GroundTask, mutexes: &MutexGroups) -> Option<Conflict> {
    let goal: Vec<FactId> = task.goal().iter().copied().filter(|&fact| !task.derives(fact)).collect();
    let mut finder = Finder::of(task, mutexes);
    for &one in goal.iter().filter(|one| !task.init().contains(one)) {
        let achievers: Vec<Way<'_>> = finder.ways(one).collect();
        let is_excluded = |other: &FactId| *other != one && achievers.iter().all(|way| way.excludes(*other, mutexes));
        let others: Vec<FactId> = goal.iter().copied().filter(is_excluded).collect();
        if others.is_empty() {
            continue;
        }
        let after = finder.after(&achievers)?;
        for other in others {
            let Some(lost) = finder.lost(other, &after) else { continue };
            let price = achievers.first()?.price(other, task, mutexes)?;
            return Some(Conflict { one, other, lost, price }.map(|fact| task.atom(*fact)));
        }
    }
    None
}

struct Finder<'a> {
    task: &'a GroundTask,
    mutexes: &'a MutexGroups,
    /// The ground actions that are possible as far as is known.
    ops: Vec<&'a Op>,
    work: usize,
}

/// One way in which an action adds a fact.
struct Way<'a> {
    op: &'a Op,
    /// What the effect is conditional on.
    condition: &'a [FactId],
}

impl Way<'_> {
    fn needs(&self) -> impl Iterator<Item = FactId> + '_ {
        self.op.preconditions.iter().chain(self.condition).copied()
    }

    /// Whether a fact does not hold after it: it is deleted, or cannot hold before, and is not added.
    fn excludes(&self, fact: FactId, mutexes: &MutexGroups) -> bool {
        let adds = self.op.adds.contains(&fact) || self.op.conditional.iter().any(|effect| effect.fact == fact);
        !adds && (self.op.deletes.contains(&fact) || self.needs().any(|need| mutexes.exclude(need, fact)))
    }

    /// What it needs that excludes a fact; the fact itself if it deletes it.
    fn price(&self, fact: FactId, task: &GroundTask, mutexes: &MutexGroups) -> Option<Need<FactId>> {
        let excluding = self.needs().find(|&need| mutexes.exclude(need, fact));
        let atom = excluding.or_else(|| self.op.deletes.contains(&fact).then_some(fact))?;
        Some(Need { action: task.name_in_plans(self.op), atom })
    }
}

impl<'a> Finder<'a> {
    fn of(task: &'a GroundTask, mutexes: &'a MutexGroups) -> Self {
        let ops = task.ops().map(|(_, op)| op).filter(|op| mutexes.excluded_pair(&op.preconditions).is_none());
        Self { task, mutexes, ops: ops.collect(), work: 0 }
    }

    /// The ways in which a fact is added.
    fn ways(&self, fact: FactId) -> impl Iterator<Item = Way<'a>> + use<'a> {
        let ways = move |op: &'a Op| {
            let always = op.adds.contains(&fact).then_some(Way { op, condition: &[] });
            let adding = op.conditional.iter().filter(move |effect| effect.adds && effect.fact == fact);
            always.into_iter().chain(adding.map(move |effect| Way { op, condition: &effect.positive }))
        };
        self.ops.clone().into_iter().flat_map(ways)
    }

    /// The facts that may hold at some time after one of these, and the actions that may then be done, were nothing deleted
    /// from then on. None if that takes too long.
    fn after(&mut self, ways: &[Way<'_>]) -> Option<HashSet<FactId>> {
        let mut held: HashSet<FactId> = HashSet::default();
        for way in ways {
            let mut groups: HashMap<u32, FactId> = HashMap::default();
            let deleted = |fact: &FactId| way.op.deletes.contains(fact);
            let kept = way.needs().filter(|fact| !deleted(fact));
            for fact in kept.chain(way.op.adds.iter().copied()) {
                groups.extend(self.mutexes.groups_of(fact).iter().map(|&group| (group, fact)));
            }
            let is_excluded = |fact: FactId| {
                let taken = |group| groups.get(group).is_some_and(|&other| other != fact);
                self.mutexes.groups_of(fact).iter().any(taken)
            };
            held.extend(self.task.reached_facts().filter(|fact| !deleted(fact) && !is_excluded(*fact)));
            held.extend(&way.op.adds);
            held.extend(way.op.conditional.iter().filter(|effect| effect.adds).map(|effect| effect.fact));
        }
        loop {
            let before = held.len();
            for op in &self.ops {
                if op.preconditions.iter().all(|need| held.contains(need)) {
                    held.extend(&op.adds);
                    let adding = op.conditional.iter().filter(|effect| effect.adds);
                    let added: Vec<FactId> = adding
                        .filter(|effect| effect.positive.iter().all(|need| held.contains(need)))
                        .map(|effect| effect.fact)
                        .collect();
                    held.extend(added);
                }
            }
            self.work += self.ops.len();
            if self.work > MOST_WORK {
                return None;
            }
            if held.len() == before {
                return Some(held);
            }
        }
    }

    /// What keeps a fact from being added where these facts may hold, if something does: what the way needs that needs the
    /// fewest of what cannot; nothing if there is no way at all.
    fn lost(&self, fact: FactId, held: &HashSet<FactId>) -> Option<Option<Need<FactId>>> {
        let missing = |way: &Way<'_>| way.needs().filter(|need| !held.contains(need)).collect::<Vec<_>>();
        let ways: Vec<(Vec<FactId>, Way<'_>)> = self.ways(fact).map(|way| (missing(&way), way)).collect();
        let Some((missing, way)) = ways.iter().min_by_key(|(missing, _)| missing.len()) else { return Some(None) };
        let &atom = missing.first()?;
        Some(Some(Need { action: self.task.name_in_plans(way.op), atom }))
    }
}
