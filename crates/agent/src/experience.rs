//! What was tried, and what came of it: plain data, from which follows what to avoid.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use typelift_belief::{Deed, Run, Surrounding, Surroundings, Tried};
use typelift_model::{Hierarchy, State, Symbol, TypeId};
use typelift_plan::{Ban, Restrictions};

use crate::account::Avoided;
use crate::blame::Blame;
use crate::deed::{Failed, Success};
use crate::objection::Objection;
use crate::resort::CountedExclusions;
use crate::retries::Retries;
use crate::suspect::{Certainty, Conditions, Suspect};

/// Why something is avoided, and how often that was seen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remembered {
    /// The failures that led to it, in words, in order, each once.
    pub reasons: Vec<String>,
    /// How many failures led to it.
    pub count: u64,
}

/// What was tried in the tasks of a run.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Experience {
    /// How many tasks were begun.
    tasks: u64,
    /// How much was tried.
    deeds: u64,
    /// What worked, sorted.
    successes: Vec<Success>,
    /// What held around what worked.
    #[serde(default)]
    surroundings: Surroundings,
    /// What failed, in order.
    failures: Vec<Failed>,
    /// Whether it helped to try again what failed.
    #[serde(default)]
    pub(crate) retries: Retries,
}

impl Experience {
    /// Nothing experienced yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Begins a task: its number, from 1.
    pub fn begin_task(&mut self) -> u64 {
        self.tasks += 1;
        self.tasks
    }

    /// The number of the task that was begun last.
    pub(crate) fn task(&self) -> u64 {
        self.tasks
    }

    /// Notes that something worked, and what held around it.
    pub fn succeeded(&mut self, deed: Deed, around: BTreeSet<Surrounding>) {
        self.surroundings.note(&deed, around);
        self.deeds += 1;
        let when = self.deeds;
        match self.successes.binary_search_by(|success| success.deed.cmp(&deed)) {
            Ok(at) => {
                self.successes[at].count += 1;
                self.successes[at].when = when;
            }
            Err(at) => self.successes.insert(at, Success { deed, count: 1, when }),
        }
    }

    /// Notes that something failed.
    pub(crate) fn failed(&mut self, failed: Failed) {
        self.deeds += 1;
        self.failures.push(Failed { when: self.deeds, ..failed });
    }

    /// Of what people said before, what speaks against this object in this call, itself or its kind, no longer counts. Gives
    /// what it was.
    pub(crate) fn overrule(
        &mut self,
        call: &Symbol,
        object: &Symbol,
        ty: TypeId,
        instance: &Symbol,
        hierarchy: &Hierarchy,
    ) -> Vec<String> {
        let is_of = |name: &Symbol| hierarchy.id(name.as_str()).is_some_and(|kind| hierarchy.is_a(ty, kind));
        let speaks_against = |failed: &Failed| {
            let is_here = failed.deed.instance == *instance;
            failed.suspects().any(|suspect| match suspect {
                Suspect::Object(one) => is_here && one.object == *object,
                Suspect::Types(types) => types.types.values().any(is_of),
                Suspect::Condition(_) | Suspect::Around(_) => false,
            })
        };
        let is_overruled = |failed: &Failed| failed.rejected && failed.deed.call == *call && speaks_against(failed);
        self.drop_words(is_overruled)
    }

    /// Of what people said before, that one of these objects is wanted no longer counts. Gives what it was.
    pub(crate) fn overrule_wanted(&mut self, objects: &[Symbol], instance: &Symbol) -> Vec<String> {
        self.drop_words(|failed| match &failed.objection {
            Some(Objection::Instead { with, .. }) => failed.deed.instance == *instance && objects.contains(with),
            _ => false,
        })
    }

    fn drop_words(&mut self, is_dropped: impl Fn(&Failed) -> bool) -> Vec<String> {
        let (dropped, kept): (Vec<Failed>, Vec<Failed>) =
            std::mem::take(&mut self.failures).into_iter().partition(is_dropped);
        self.failures = kept;
        dropped.into_iter().map(|failed| failed.reason).collect()
    }

    /// Weighs anew what is to blame for each failure, with all that was tried until now.
    pub(crate) fn reconsider(&mut self, blame: &Blame<'_>) {
        let suspects = blame.of_each(&self.failures, &self.run(self.tasks), self.tasks);
        for (failed, suspects) in self.failures.iter_mut().zip(suspects) {
            failed.suspects = suspects;
        }
    }

    /// All that was tried, as it looks in a task, but for what a person rejected.
    pub(crate) fn run(&self, task: u64) -> Run<'_> {
        let failed = self.failures.iter().filter(|failed| !failed.rejected && failed.objection.is_none());
        let worked = self.successes.iter().map(Success::tried);
        let tried: Vec<Tried<'_>> = worked.chain(failed.map(|failed| failed.tried(task))).collect();
        Run::new(&tried, &self.surroundings)
    }

    /// What worked, sorted.
    pub fn successes(&self) -> &[Success] {
        &self.successes
    }

    /// What failed, in order.
    pub fn failures(&self) -> &[Failed] {
        &self.failures
    }

    /// What is to blame for the failures, as seen from an instance, with the reasons, sorted.
    pub fn suspects(&self, instance: &Symbol) -> Vec<(Suspect, Remembered)> {
        let found = self.failures.iter().flat_map(|failed| {
            let suspects = failed.suspects().cloned();
            let here = suspects.filter(|suspect| !suspect.belongs_to_instance() || failed.deed.instance == *instance);
            here.map(|suspect| (suspect, &failed.reason))
        });
        counted(found)
    }

    /// The ground actions that failed in an instance, with the reasons, sorted.
    pub fn bans(&self, instance: &Symbol) -> Vec<(Ban, Remembered)> {
        let here = self.failures.iter().filter(|failed| failed.deed.instance == *instance);
        counted(here.filter_map(|failed| Some((failed.banned(self.tasks)?.clone(), &failed.reason))))
    }

    /// What to avoid in the current task, in an instance: as a planner is told, and the conditions that keep actions
    /// from being used.
    pub fn avoided(&self, instance: &Symbol, state: &State, counted: CountedExclusions) -> (Restrictions, Conditions) {
        let mut restrictions = Restrictions::default();
        let mut conditions = Conditions::default();
        for failed in &self.failures {
            let (ban, suspects) = self.avoided_after(failed, instance, state, counted);
            restrictions.banned.extend(ban.cloned());
            if failed.task == self.tasks && failed.deed.instance == *instance {
                restrictions.calls.extend(failed.not_made.iter().cloned());
            }
            for suspect in suspects {
                match suspect {
                    Suspect::Object(exclusion) => {
                        restrictions.excluded.insert(exclusion);
                    }
                    Suspect::Types(exclusion) => {
                        restrictions.types.insert(exclusion);
                    }
                    Suspect::Condition(condition) => conditions.named.push(condition),
                    Suspect::Around(condition) => conditions.around.push(condition),
                }
            }
        }
        conditions.named.sort_unstable();
        conditions.named.dedup();
        conditions.around.sort_unstable();
        conditions.around.dedup();
        (restrictions, conditions)
    }

    /// The same with its reasons, what a person said first; each once.
    pub(crate) fn avoided_because(&self, instance: &Symbol, state: &State, counted: CountedExclusions) -> Vec<Avoided> {
        let mut found: Vec<Avoided> = Vec::new();
        for failed in &self.failures {
            let (ban, suspects) = self.avoided_after(failed, instance, state, counted);
            let avoided = Avoided { reason: failed.reason.clone(), by_person: failed.rejected, suspects };
            if (ban.is_some() || !avoided.suspects.is_empty()) && !found.contains(&avoided) {
                found.push(avoided);
            }
        }
        found.sort_by_key(|avoided| !avoided.by_person);
        found
    }

    /// What one failure has avoided: the ground action, and what is to blame.
    fn avoided_after<'f>(
        &self,
        failed: &'f Failed,
        instance: &Symbol,
        state: &State,
        counted: CountedExclusions,
    ) -> (Option<&'f Ban>, Vec<Suspect>) {
        let is_here = failed.deed.instance == *instance;
        let in_this_task = failed.task == self.tasks;
        let is_over = matches!(failed.objection, Some(Objection::Instead { .. })) && !in_this_task;
        let counts = |certainty: Certainty| match counted {
            _ if is_over => false,
            _ if failed.rejected || failed.objection.is_some() => true,
            CountedExclusions::All => true,
            CountedExclusions::Likely => certainty > Certainty::Guessed,
            CountedExclusions::OfThisTask => in_this_task,
            CountedExclusions::None | CountedExclusions::Elsewhere => false,
        };
        let suspects = failed.suspects.iter().filter(|suspected| counts(suspected.certainty));
        let mut suspects: Vec<Suspect> = suspects.map(|suspected| suspected.suspect.clone()).collect();
        suspects.retain(|suspect| is_here || !suspect.belongs_to_instance());
        // Where a literal is to blame, it may be tried again as soon as that is otherwise.
        let is_conditional = suspects.iter().any(Suspect::is_conditional);
        let mut ban = failed.banned_in(self.tasks, state).filter(|_| is_here && !is_conditional);
        let elsewhere = failed.elsewhere();
        if counted == CountedExclusions::Elsewhere && ban.is_some() && !elsewhere.is_empty() {
            ban = None;
            suspects.extend(elsewhere.into_iter().map(Suspect::Condition));
        }
        (ban, suspects)
    }
}

/// Each once, with the reasons and how often it is there, sorted.
fn counted<'a, T: Ord>(found: impl Iterator<Item = (T, &'a String)>) -> Vec<(T, Remembered)> {
    let mut map = std::collections::BTreeMap::new();
    for (key, reason) in found {
        let remembered = map.entry(key).or_insert_with(|| Remembered { reasons: Vec::new(), count: 0 });
        if !remembered.reasons.contains(reason) {
            remembered.reasons.push(reason.clone());
        }
        remembered.count += 1;
    }
    map.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use typelift_plan::{Exclusion, TypeExclusion};

    use super::*;
    use crate::suspect::Suspected;

    /// A failure of `use` in an instance, which was blamed on a board and on nuts.
    fn failed(task: u64, objection: Option<Objection>) -> Failed {
        let (call, adds) = (Symbol::new("use"), ["cut".into()]);
        let types = BTreeMap::from([(2, "nut".into())]);
        Failed {
            deed: Deed {
                instance: "here".into(),
                call: call.clone(),
                adds: adds.clone().into(),
                participants: Vec::new(),
                held: BTreeSet::new(),
            },
            count: 1,
            when: 0,
            task,
            ban: None,
            around: BTreeSet::new(),
            surroundings: BTreeSet::new(),
            actors: ["agent_1".into()].into(),
            in_goal: ["nut_1".into()].into(),
            not_made: BTreeSet::new(),
            wanted: None,
            objection,
            useless: false,
            rejected: false,
            reason: "it failed".to_owned(),
            suspects: vec![
                Suspected {
                    suspect: Suspect::Object(Exclusion { object: "board_1".into(), call: Some(call.clone()) }),
                    certainty: Certainty::Guessed,
                },
                Suspected {
                    suspect: Suspect::Types(TypeExclusion { call, adds: adds.into(), types }),
                    certainty: Certainty::Likely,
                },
            ],
        }
    }

    #[test]
    fn restrictions_are_of_the_instance_and_of_the_task() {
        let mut experience = Experience::new();
        experience.begin_task();
        experience.failed(failed(1, None));
        experience.begin_task();
        let counts = |experience: &Experience, instance: &str, counted| {
            let (restrictions, _) = experience.avoided(&instance.into(), &State::default(), counted);
            (restrictions.excluded.len(), restrictions.types.len())
        };
        assert_eq!(counts(&experience, "here", CountedExclusions::All), (1, 1));
        assert_eq!(counts(&experience, "here", CountedExclusions::Likely), (0, 1));
        assert_eq!(
            counts(&experience, "there", CountedExclusions::All),
            (0, 1),
            "a thing stays where it is, a kind is the same everywhere"
        );
        assert_eq!(counts(&experience, "here", CountedExclusions::OfThisTask), (0, 0));
        experience.failed(failed(1, Some(Objection::NotNow)));
        assert_eq!(counts(&experience, "here", CountedExclusions::OfThisTask), (1, 1), "what a person said stays");
        assert_eq!(counts(&experience, "here", CountedExclusions::None), (1, 1));
        let text = serde_json::to_string(&experience).expect("JSON");
        assert_eq!(serde_json::from_str::<Experience>(&text).expect("the same"), experience);
    }
}
