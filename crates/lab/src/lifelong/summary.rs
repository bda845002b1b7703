//! The lives of an agent in a few numbers.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::blame::{Blame, blame};
use super::truth::Truth;
use super::{Agent, LifelongResult, TaskRecord, TrueCause};

/// Tasks at the beginning and at the end of a life that are looked at apart.
const WINDOW: usize = 50;

/// The lives of an agent.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AgentSummary {
    /// The agent.
    pub agent: Agent,
    /// Tasks of all its lives.
    pub tasks: usize,
    /// Those that it solved.
    pub solved: usize,
    /// Plans carried out a task.
    pub proposals: f64,
    /// Steps failed a task.
    pub failed: f64,
    /// The same in successive parts of a life, of [`LifelongResult::window`] tasks each.
    pub failed_over_time: Vec<f64>,
    /// The same without what the informed agent failed, if it lived the same lives.
    pub failed_beside_informed: Option<Vec<f64>>,
    /// Steps failed in all lives, by their true cause: in the first part, in the last part, and in all.
    pub causes: BTreeMap<&'static str, [usize; 3]>,
    /// Mistakes repeated: `life 3, task 17 (T1.3): USE(…)`.
    pub repeated: Vec<String>,
    /// Tasks that the paper's rule solved and this agent did not: `life 3, task 17 (T1.3)`.
    pub lost: Vec<String>,
}

impl LifelongResult {
    /// Tasks in each part of a life: 50, in a short life a quarter of it.
    pub fn window(&self) -> usize {
        WINDOW.min(self.options.tasks / 4).max(1)
    }

    /// Each agent in a few numbers.
    pub fn summaries(&self) -> Vec<AgentSummary> {
        self.options.agents.iter().map(|agent| self.summary_of(*agent)).collect()
    }

    fn summary_of(&self, agent: Agent) -> AgentSummary {
        let all = || self.lives(agent).flatten();
        let tasks = all().count();
        let a_task = |count: u64| count as f64 / tasks.max(1) as f64;
        let failed_over_time = self.failed_over_time(agent);
        let informed = self.options.agents.contains(&Agent::Informed).then(|| self.failed_over_time(Agent::Informed));
        let beside = |informed: Vec<f64>| failed_over_time.iter().zip(informed).map(|(own, its)| own - its).collect();
        AgentSummary {
            agent,
            tasks,
            solved: all().filter(|task| task.solved()).count(),
            proposals: a_task(all().map(|task| task.proposals).sum()),
            failed: a_task(all().map(|task| task.failed.len() as u64).sum()),
            failed_beside_informed: informed.map(beside),
            failed_over_time,
            causes: self.causes(agent),
            repeated: self.repeated(agent),
            lost: self.lost(agent),
        }
    }

    /// The tasks of each life of an agent.
    fn lives(&self, agent: Agent) -> impl Iterator<Item = &[TaskRecord]> {
        let own = self.records.iter().filter(move |(run, _)| run.agent == agent);
        own.map(|(_, record)| record.tasks.as_slice())
    }

    /// Steps failed a task in successive parts of a life, the mean of all.
    fn failed_over_time(&self, agent: Agent) -> Vec<f64> {
        let window = self.window();
        let part = |number: usize| {
            let tasks = || self.lives(agent).flat_map(|tasks| tasks.chunks(window).nth(number).unwrap_or_default());
            let failed: usize = tasks().map(|task| task.failed.len()).sum();
            failed as f64 / tasks().count().max(1) as f64
        };
        (0..self.options.tasks.div_ceil(window)).map(part).collect()
    }

    fn causes(&self, agent: Agent) -> BTreeMap<&'static str, [usize; 3]> {
        let (window, mut causes) = (self.window(), BTreeMap::new());
        for tasks in self.lives(agent) {
            for (number, task) in tasks.iter().enumerate() {
                for step in &task.failed {
                    let counts: &mut [usize; 3] = causes.entry(step.cause.kind()).or_default();
                    counts[0] += usize::from(number < window);
                    counts[1] += usize::from(number + window >= tasks.len());
                    counts[2] += 1;
                }
            }
        }
        causes
    }

    fn repeated(&self, agent: Agent) -> Vec<String> {
        let mut repeated = Vec::new();
        for (run, record) in self.records.iter().filter(|(run, _)| run.agent == agent) {
            for (number, task) in (1..).zip(&record.tasks) {
                let mistakes = task.failed.iter().filter(|step| step.is_repeated_mistake());
                repeated.extend(mistakes.map(|step| {
                    format!("life {}, task {number} ({}): {}: {}", run.seed, task.task, step.call, step.cause)
                }));
            }
        }
        repeated
    }

    fn lost(&self, agent: Agent) -> Vec<String> {
        let mut lost = Vec::new();
        for (run, record) in self.records.iter().filter(|(run, _)| run.agent == agent) {
            let paper = self.records.iter().find(|(other, _)| other.seed == run.seed && other.agent == Agent::Paper);
            let both = record.tasks.iter().zip(paper.into_iter().flat_map(|(_, paper)| &paper.tasks));
            let numbered = (1..).zip(both).filter(|(_, (own, paper))| paper.solved() && !own.solved());
            lost.extend(
                numbered.map(|(number, (own, _))| {
                    format!("life {}, task {number} ({}): {}", run.seed, own.task, own.ending)
                }),
            );
        }
        lost
    }

    /// What the agent with a memory blamed, beside what was to blame.
    pub fn blame(&self) -> Blame {
        blame(self.records.iter().filter(|(run, _)| run.agent == Agent::Memory).map(|(_, record)| record))
    }

    /// How true it was what was thought to work, at each time that was looked at, the calls of all lives together.
    pub fn truth(&self) -> Vec<Truth> {
        let mut times: BTreeMap<usize, Truth> = BTreeMap::new();
        for truth in self.records.values().flat_map(|record| &record.truth) {
            let sum = times.entry(truth.after).or_insert_with(|| Truth { after: truth.after, ..Truth::default() });
            sum.add(truth);
        }
        times.into_values().collect()
    }

    /// What was to be reached, with what was: by how much fewer steps the agent with a memory fails than the paper's rule, in
    /// the first and in the last part of a life, without what the informed agent fails.
    pub fn goals(&self) -> Vec<Goal> {
        let summaries = self.summaries();
        let of = |agent: Agent| summaries.iter().find(|summary| summary.agent == agent);
        let (Some(memory), Some(paper)) = (of(Agent::Memory), of(Agent::Paper)) else { return Vec::new() };
        let (Some(own), Some(its)) = (&memory.failed_beside_informed, &paper.failed_beside_informed) else {
            return Vec::new();
        };
        let ends = |parts: &[f64]| [parts.first(), parts.last()].map(|end| end.copied().unwrap_or_default());
        let window = self.window();
        let goal = |what: &str, factor: f64, own: f64, its: f64| Goal {
            what: format!("failed steps a task in the {what} {window}, beside those of the informed agent"),
            at_most: its / factor,
            reached: own,
        };
        let ([own_first, own_last], [its_first, its_last]) = (ends(own), ends(its));
        vec![
            goal("first", 3.0, own_first, its_first),
            goal("last", 20.0, own_last, its_last),
            Goal { what: "mistakes repeated".to_owned(), at_most: 0.0, reached: memory.repeated.len() as f64 },
            Goal {
                what: "tasks lost that the paper's rule solves".to_owned(),
                at_most: 0.0,
                reached: memory.lost.len() as f64,
            },
        ]
    }
}

/// Something to be reached by the agent with a memory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Goal {
    /// What.
    pub what: String,
    /// The most that it may be.
    pub at_most: f64,
    /// What it is.
    pub reached: f64,
}

impl Goal {
    /// Whether it is reached.
    pub fn met(&self) -> bool {
        self.reached <= self.at_most
    }
}

impl AgentSummary {
    /// The failed steps by their true cause, in the order of [`TrueCause::KINDS`].
    pub fn causes_in_order(&self) -> Vec<(&'static str, [usize; 3])> {
        TrueCause::KINDS.iter().filter_map(|kind| Some((*kind, *self.causes.get(kind)?))).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use typelift_kitchen::{Exception, Fault, Interlock};

    use super::*;
    use crate::lifelong::{FailedStep, LifeRecord, LifeRun, LifelongOptions};

    /// A life of eight tasks in which so many steps failed in each; a task in which five did was not solved.
    fn lived(failed: [usize; 8]) -> LifeRecord {
        let exception = Exception { food: "onion".into(), tool: "cutboard".into() };
        let step = FailedStep {
            call: "USE(agent_1,cutboard_1,onion_1)".to_owned(),
            action: "USE-cutboard-food".to_owned(),
            cause: TrueCause::Fault(Fault::Exception(exception)),
            retry: false,
            p: None,
            better: None,
            explanations: Vec::new(),
        };
        let task = |failed: usize| TaskRecord {
            task: "T1.1".to_owned(),
            ending: if failed == 5 { "no plan" } else { "solved" }.to_owned(),
            proposals: 1,
            actions: 5,
            newly_broken: None,
            failed: vec![step.clone(); failed],
        };
        let interlock = Interlock { tools: Vec::new(), loaded: "toaster_1".into() };
        LifeRecord { exceptions: Vec::new(), interlock, tasks: failed.map(task).to_vec(), truth: Vec::new() }
    }

    fn result(lives: &[(Agent, [usize; 8])]) -> LifelongResult {
        let agents = lives.iter().map(|(agent, _)| *agent).collect();
        let options = LifelongOptions { agents, runs: 1, tasks: 8, ..LifelongOptions::default() };
        let records = lives.iter().map(|(agent, failed)| (LifeRun { seed: 0, agent: *agent }, lived(*failed)));
        LifelongResult { options, records: records.collect() }
    }

    #[test]
    fn what_nobody_could_know_is_no_mistake() {
        let result = result(&[
            (Agent::Memory, [4, 4, 1, 0, 0, 0, 2, 0]),
            (Agent::Paper, [7, 7, 0, 0, 0, 5, 8, 6]),
            (Agent::Informed, [2, 2, 0, 0, 0, 0, 2, 0]),
        ]);
        assert_eq!(result.window(), 2);
        let summaries = result.summaries();
        let memory = &summaries[0];
        assert_eq!((memory.solved, memory.tasks, memory.lost.len()), (8, 8, 0));
        assert_eq!(memory.failed_over_time, [4.0, 0.5, 0.0, 1.0]);
        assert_eq!(memory.failed_beside_informed, Some(vec![2.0, 0.5, 0.0, 0.0]));
        assert_eq!(memory.causes, BTreeMap::from([("an exception", [8, 2, 11])]));
        let goals: Vec<(f64, f64, bool)> =
            result.goals().iter().map(|goal| (goal.at_most, goal.reached, goal.met())).collect();
        assert_eq!(goals[..2], [(5.0 / 3.0, 2.0, false), (0.3, 0.0, true)]);
    }

    #[test]
    fn a_task_is_lost_that_the_papers_rule_solves() {
        let result = result(&[(Agent::Memory, [5, 0, 0, 0, 0, 5, 0, 0]), (Agent::Paper, [1, 0, 0, 0, 0, 5, 0, 0])]);
        assert_eq!(result.summaries()[0].lost, ["life 0, task 1 (T1.1): no plan"]);
        assert!(result.goals().is_empty(), "nobody was informed");
    }
}
