//! What was tried, and what came of it: plain data, from which follows what to avoid.

use serde::{Deserialize, Serialize};
use typelift_model::Symbol;
use typelift_plan::{Ban, Restrictions};

use crate::account::Avoided;
use crate::blame::{Condition, Suspect, suspects};
use crate::deed::{Deed, Failed, Success};
use crate::resort::CountedExclusions;

/// Why something is avoided, and how often that was seen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remembered {
    /// The failure that led to it, in words.
    pub reason: String,
    /// How many failures led to it.
    pub count: u64,
}

/// What was tried in the tasks of a run.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Experience {
    /// How many tasks were begun.
    tasks: u64,
    /// What worked, sorted.
    successes: Vec<Success>,
    /// What failed, in order.
    failures: Vec<Failed>,
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

    /// Notes that something worked.
    pub fn succeeded(&mut self, deed: Deed) {
        match self.successes.binary_search_by(|success| success.deed.cmp(&deed)) {
            Ok(at) => self.successes[at].count += 1,
            Err(at) => self.successes.insert(at, Success { deed, count: 1 }),
        }
    }

    /// Notes that something failed: what is to blame, as far as is known.
    pub fn failed(&mut self, failed: Failed) -> Vec<Suspect> {
        let suspects = suspects(&failed, &self.successes);
        self.failures.push(failed);
        suspects
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
            let suspects = suspects(failed, &self.successes).into_iter();
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
    pub fn avoided(&self, instance: &Symbol, counted: CountedExclusions) -> (Restrictions, Vec<Condition>) {
        let mut restrictions = Restrictions::default();
        let mut conditions = Vec::new();
        for failed in &self.failures {
            let (ban, suspects) = self.avoided_after(failed, instance, counted);
            restrictions.banned.extend(ban.cloned());
            for suspect in suspects {
                match suspect {
                    Suspect::Object(exclusion) => {
                        restrictions.excluded.insert(exclusion);
                    }
                    Suspect::Types(exclusion) => {
                        restrictions.types.insert(exclusion);
                    }
                    Suspect::Condition(condition) => conditions.push(condition),
                }
            }
        }
        conditions.sort_unstable();
        conditions.dedup();
        (restrictions, conditions)
    }

    /// The same with its reasons, what a person said first; each once.
    pub(crate) fn avoided_because(&self, instance: &Symbol, counted: CountedExclusions) -> Vec<Avoided> {
        let mut found: Vec<Avoided> = Vec::new();
        for failed in &self.failures {
            let (ban, suspects) = self.avoided_after(failed, instance, counted);
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
        counted: CountedExclusions,
    ) -> (Option<&'f Ban>, Vec<Suspect>) {
        let is_here = failed.deed.instance == *instance;
        let counts = failed.objection.is_some()
            || match counted {
                CountedExclusions::All => true,
                CountedExclusions::OfThisTask => failed.task == self.tasks,
                CountedExclusions::None => false,
            };
        let mut suspects = if counts { suspects(failed, &self.successes) } else { Vec::new() };
        suspects.retain(|suspect| is_here || !suspect.belongs_to_instance());
        (failed.banned(self.tasks).filter(|_| is_here), suspects)
    }
}

/// Each once, with the first reason and how often it is there, sorted.
fn counted<'a, T: Ord>(found: impl Iterator<Item = (T, &'a String)>) -> Vec<(T, Remembered)> {
    let mut map = std::collections::BTreeMap::new();
    for (key, reason) in found {
        map.entry(key).or_insert_with(|| Remembered { reason: reason.clone(), count: 0 }).count += 1;
    }
    map.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use typelift_model::GroundAtom;

    use crate::deed::Participant;
    use crate::objection::Objection;

    /// `use(agent_1, TOOL, FOOD)`, which is to bring about `makes`. A type is a name without its number.
    fn deed(instance: &str, makes: &str, tool: &str, food: &str) -> Deed {
        let participant = |(place, object): (usize, &str)| {
            let ty = object.split('_').next().unwrap_or_default();
            Participant { object: object.into(), ty: ty.into(), place: Some(place) }
        };
        let participants = ["agent_1", tool, food].into_iter().enumerate().map(participant).collect();
        Deed { instance: instance.into(), call: "use".into(), adds: [makes.into()].into(), participants }
    }

    fn failed(deed: Deed, in_goal: &[&str], objection: Option<Objection>) -> Failed {
        Failed {
            deed,
            task: 1,
            ban: None,
            actors: ["agent_1".into()].into(),
            in_goal: in_goal.iter().map(|&object| object.into()).collect(),
            objection,
            useless: false,
            rejected: false,
            reason: "it failed".to_owned(),
        }
    }

    fn blamed(failed: &Failed, worked: &[Deed]) -> Vec<String> {
        let mut experience = Experience::new();
        worked.iter().for_each(|deed| experience.succeeded(deed.clone()));
        suspects(failed, experience.successes()).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn objects_then_types_then_pairs() {
        let failure = failed(deed("here", "cut", "board_1", "nut_1"), &["nut_1"], None);
        let (soup, cut) = (deed("here", "soup", "board_1", "leek_1"), deed("here", "cut", "board_1", "leek_1"));
        let nut = deed("here", "cut", "board_1", "nut_2");
        assert_eq!(blamed(&failure, &[]), ["board_1 from use"]);
        assert_eq!(
            blamed(&failure, std::slice::from_ref(&soup)),
            ["any board from use for cut"],
            "it worked for something else"
        );
        assert_eq!(blamed(&failure, &[soup, cut.clone()]), ["any board with any nut from use for cut"]);
        assert!(blamed(&failure, &[cut, nut]).is_empty(), "nothing is left, and nothing is made up");
    }

    #[test]
    fn a_pair_that_the_call_does_not_name_is_avoided_by_its_object() {
        // The call names a switch; the machine and what is in it take part without being named.
        let pressed = |food: &str| {
            let mut deed = deed("here", "cut", "saw_1", food);
            deed.participants.iter_mut().skip(1).for_each(|participant| participant.place = None);
            deed
        };
        let failure = failed(pressed("sheet_1"), &["sheet_1"], None);
        assert_eq!(blamed(&failure, &[pressed("dowel_1")]), ["saw_1 from use"]);
        assert!(blamed(&failure, &[pressed("dowel_1"), pressed("sheet_2")]).is_empty(), "saws cut sheets");
    }

    #[test]
    fn an_object_is_known_in_its_instance_a_type_everywhere() {
        let failure = failed(deed("here", "cut", "board_1", "nut_1"), &["nut_1"], None);
        assert_eq!(blamed(&failure, &[deed("there", "cut", "board_1", "leek_1")]), ["board_1 from use"]);
        let here_and_there = [deed("here", "soup", "board_1", "leek_1"), deed("there", "cut", "board_9", "leek_1")];
        assert_eq!(blamed(&failure, &here_and_there), ["any board with any nut from use for cut"]);
    }

    #[test]
    fn what_worked_is_not_blamed_beside_what_never_did() {
        let failure = failed(deed("here", "cut", "board_1", "nut_1"), &[], None);
        assert_eq!(blamed(&failure, &[]), ["board_1 from use", "nut_1 from use"]);
        assert_eq!(blamed(&failure, &[deed("here", "cut", "board_1", "leek_1")]), ["nut_1 from use"]);
    }

    #[test]
    fn who_acts_and_what_the_goal_is_about_are_not_blamed_alone() {
        let failure = failed(deed("here", "cut", "board_1", "nut_1"), &["board_1", "nut_1"], None);
        assert!(blamed(&failure, &[]).is_empty());
    }

    #[test]
    fn a_person_names_the_suspect() {
        let said =
            |objection| blamed(&failed(deed("here", "cut", "board_1", "nut_1"), &["nut_1"], Some(objection)), &[]);
        let nut = || vec!["nut_1".into()];
        assert_eq!(said(Objection::Broken { objects: vec![] }), ["board_1 from use"]);
        assert_eq!(said(Objection::Broken { objects: nut() }), ["nut_1 from use"]);
        assert_eq!(said(Objection::WrongKind { objects: vec![] }), ["any board from use for cut"]);
        assert_eq!(said(Objection::WrongKind { objects: nut() }), ["any nut from use for cut"]);
        let atom = GroundAtom::new("wet", nut());
        assert_eq!(said(Objection::While { atom }), ["use while wet(nut_1)"]);
        assert!(said(Objection::NotNow).is_empty());
    }

    #[test]
    fn restrictions_are_of_the_instance_and_of_the_task() {
        let mut experience = Experience::new();
        experience.begin_task();
        experience.failed(failed(deed("here", "cut", "board_1", "nut_1"), &["nut_1"], None));
        let objection = Objection::WrongKind { objects: vec!["nut_1".into()] };
        experience.failed(failed(deed("here", "cut", "board_1", "nut_1"), &["nut_1"], Some(objection)));
        experience.begin_task();
        let counts = |instance: &str, counted| {
            let (restrictions, _) = experience.avoided(&instance.into(), counted);
            (restrictions.excluded.len(), restrictions.types.len())
        };
        assert_eq!(counts("here", CountedExclusions::All), (1, 1));
        assert_eq!(
            counts("there", CountedExclusions::All),
            (0, 1),
            "a thing stays where it is, a kind is the same everywhere"
        );
        assert_eq!(counts("here", CountedExclusions::OfThisTask), (0, 1), "what a person said is not lifted");
        assert_eq!(counts("here", CountedExclusions::None), (0, 1));
        let text = serde_json::to_string(&experience).expect("JSON");
        assert_eq!(serde_json::from_str::<Experience>(&text).expect("the same"), experience);
    }
}
