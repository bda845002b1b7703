//! What a person said, as experience keeps it: for the memory of another run.

use thiserror::Error;
use typelift_model::{ActionModel, json_message};
use typelift_world::{Reply, Said};

use crate::deed::Failed;
use crate::episode::Episode;
use crate::experience::Experience;
use crate::objection::Objection;

/// Why what a person said is not understood any more.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("what a person said of {of} cannot be read: {why}")]
pub struct WordError {
    /// The step.
    pub of: String,
    /// What is wrong.
    pub why: String,
}

impl Episode {
    /// What was said, once it was answered: with the step that it is about, and what follows from it. None if it was not
    /// understood: an objection that is none to the step. `told` is how many failures there were before in this task.
    pub(crate) fn understood(&self, said: Said, told: usize) -> Option<Said> {
        if said.reply != Reply::No {
            return Some(said);
        }
        if self.account.failures.len() == told {
            return None;
        }
        let failed = self.experience.failures().last()?;
        let call = self.account.failures.last();
        Some(Said {
            call: call.map(|failure| failure.call.clone()),
            // Plain data with names as keys.
            experience: serde_json::to_value(failed).ok(),
            ..said
        })
    }
}

impl Experience {
    /// Takes in what a person said in an earlier run, in the order in which it was said: it counts as if it had been said in
    /// this one. What was meant for one task only is over.
    ///
    /// # Errors
    /// [`WordError`] if it is not as an agent kept it.
    pub fn hear(&mut self, said: &Said, model: &ActionModel) -> Result<(), WordError> {
        let Some(kept) = &said.experience else { return Ok(()) };
        let failed: Failed = serde_json::from_value(kept.clone()).map_err(|error| WordError {
            of: said.call.as_ref().map(ToString::to_string).unwrap_or_default(),
            why: json_message(&error),
        })?;
        match &failed.objection {
            Some(Objection::NotNow) => {}
            Some(Objection::Instead { with, .. }) => {
                let ty = failed.wanted.as_ref().and_then(|ty| model.hierarchy.id(ty.as_str()));
                if let Some(ty) = ty {
                    self.overrule(&failed.deed.call, with, ty, &failed.deed.instance, &model.hierarchy);
                }
            }
            _ => self.failed(Failed { task: 0, ..failed }),
        }
        Ok(())
    }
}
