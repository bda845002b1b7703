//! What came of what was done.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use typelift_belief::{Deed, Surrounding, Tried};
use typelift_model::{ActionModel, Goal, GroundAtom, GroundCall, State, Symbol};
use typelift_plan::Ban;

use crate::actors::actors;
use crate::objection::Objection;
use crate::suspect::{Condition, Suspect, Suspected};

/// A deed that worked, and how often.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Success {
    /// What was done.
    pub deed: Deed,
    /// How often it worked.
    pub count: u64,
    /// Its place in the order of all deeds, the last time.
    pub when: u64,
}

/// Nobody, and nothing.
static NOBODY: BTreeSet<Symbol> = BTreeSet::new();
static NOTHING: BTreeSet<Surrounding> = BTreeSet::new();

impl Success {
    /// It as something that was tried.
    pub(crate) fn tried(&self) -> Tried<'_> {
        let Self { deed, count, when } = self;
        let (actors, in_goal, around) = (&NOBODY, &NOBODY, &NOTHING);
        Tried { deed, worked: true, count: *count, when: *when, tasks_ago: 0, actors, in_goal, around }
    }
}

/// A deed that failed, its retries too, or that a person rejected.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Failed {
    /// What was done.
    pub deed: Deed,
    /// How often it failed in a row.
    pub count: u64,
    /// Its place in the order of all deeds.
    pub when: u64,
    /// The number of the task, from 1.
    pub task: u64,
    /// The ground action, which is not to be tried again; none if something of it had vanished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ban: Option<Ban>,
    /// What held of who acted and of what did not take part, and can change: where not all of it holds, the ground action
    /// may yet work.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub around: BTreeSet<GroundAtom>,
    /// What held around who took part, whoever that is.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub surroundings: BTreeSet<Surrounding>,
    /// Who acted: never to blame.
    pub actors: BTreeSet<Symbol>,
    /// Who the goal speaks of: rarely to blame.
    pub in_goal: BTreeSet<Symbol>,
    /// The calls that are not made in this task, since a person wants another one instead.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub not_made: BTreeSet<GroundCall>,
    /// The type of the object that a person wants instead.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wanted: Option<Symbol>,
    /// What a person said against it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub objection: Option<Objection>,
    /// Whether an object that is to blame is useless for everything (the paper), or only for calls of this name.
    pub useless: bool,
    /// Whether a person rejected it.
    #[serde(default)]
    pub rejected: bool,
    /// The failure, in words.
    pub reason: String,
    /// What is to blame, as it looks with all that was tried until now.
    pub suspects: Vec<Suspected>,
}

impl Failed {
    /// That what was done once with this call in this state failed, where this was the goal; nothing is said yet of what was
    /// expected or is to blame, nor when it was.
    pub(crate) fn of(
        deed: Deed,
        call: &Symbol,
        model: &ActionModel,
        before: &State,
        goal: &Goal,
        reason: String,
    ) -> Self {
        let objects = || deed.participants.iter().map(|participant| &participant.object);
        let actors = actors(objects(), call, model, before);
        Self {
            count: 1,
            when: 0,
            task: 0,
            ban: None,
            around: around(&deed, &actors, model, before),
            surroundings: surroundings(&deed, model, before),
            actors,
            in_goal: objects().filter(|object| goal.mentions(object)).cloned().collect(),
            not_made: BTreeSet::new(),
            wanted: None,
            objection: None,
            useless: false,
            rejected: false,
            reason,
            suspects: Vec::new(),
            deed,
        }
    }

    /// It as something that was tried, as it looks in a task.
    pub(crate) fn tried(&self, task: u64) -> Tried<'_> {
        let Self { deed, count, when, actors, in_goal, surroundings: around, .. } = self;
        let tasks_ago = task.saturating_sub(self.task);
        Tried { deed, worked: false, count: *count, when: *when, tasks_ago, actors, in_goal, around }
    }

    /// What is to blame, however sure that is.
    pub(crate) fn suspects(&self) -> impl Iterator<Item = &Suspect> {
        self.suspects.iter().map(|suspected| &suspected.suspect)
    }

    /// The ground action, if it is not to be tried again in this task.
    pub(crate) fn banned(&self, task: u64) -> Option<&Ban> {
        match &self.objection {
            Some(Objection::While { .. }) => None,
            Some(Objection::NotNow | Objection::Instead { .. }) if self.task != task => None,
            _ => self.ban.as_ref(),
        }
    }

    /// The same, if it failed in an earlier task in other circumstances: then it may be tried in these.
    pub(crate) fn banned_in(&self, task: u64, state: &State) -> Option<&Ban> {
        let as_then = self.around.iter().all(|atom| state.holds(atom));
        self.banned(task).filter(|_| self.task == task || self.rejected || as_then)
    }

    /// That it does not work in these circumstances, instead of never.
    pub(crate) fn elsewhere(&self) -> Vec<Condition> {
        let args = self.deed.named();
        let condition = |atom: &GroundAtom| Condition {
            call: self.deed.call.clone(),
            adds: self.deed.adds.clone(),
            atom: atom.clone(),
            holds: false,
            args: args.clone(),
        };
        if self.rejected { Vec::new() } else { self.around.iter().map(condition).collect() }
    }
}

/// What holds around who took part.
pub(crate) fn surroundings(deed: &Deed, model: &ActionModel, state: &State) -> BTreeSet<Surrounding> {
    let changing = changing(model);
    let objects: Vec<Symbol> = deed.participants.iter().map(|participant| participant.object.clone()).collect();
    Surrounding::of(&objects, state, &model.hierarchy, |predicate| changing.contains(predicate))
}

/// The predicates that some action changes.
fn changing(model: &ActionModel) -> BTreeSet<&Symbol> {
    let effects = model.actions.iter().flat_map(|schema| &schema.effects);
    effects.map(|effect| &effect.literal.atom.predicate).collect()
}

/// What holds of who acts and of others than who took part, and can change.
fn around(deed: &Deed, acting: &BTreeSet<Symbol>, model: &ActionModel, state: &State) -> BTreeSet<GroundAtom> {
    let changing = changing(model);
    let took_part = |arg: &Symbol| deed.participants.iter().any(|participant| participant.object == *arg);
    let is_around = |atom: &&GroundAtom| {
        let of_actor = |arg: &Symbol| acting.contains(arg);
        changing.contains(&atom.predicate) && atom.args.iter().any(of_actor) && !atom.args.iter().all(took_part)
    };
    state.atoms.iter().filter(is_around).cloned().collect()
}
