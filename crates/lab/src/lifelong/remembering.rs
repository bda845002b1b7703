//! What is learned along a life: the evidence of each task is added to that of the demonstrations, and the model learned anew,
//! as a memory's is.

use std::sync::Arc;

use typelift::learn::{learn_evidence, observe_trace};
use typelift::model::{ActionModel, LearnedModel, Symbol};
use typelift::world::{Record, Trace};

/// A model that goes on learning.
#[derive(Debug, Clone)]
pub(super) struct Learner {
    pub(super) learned: LearnedModel,
    pub(super) model: Arc<ActionModel>,
}

impl Learner {
    pub(super) fn new(learned: LearnedModel) -> Self {
        let model = Arc::new(learned.model.clone());
        Self { learned, model }
    }

    /// Learns from what was done in a task, one step after the other.
    ///
    /// # Errors
    /// In words, if a type is unknown.
    pub(super) fn learn(&mut self, task: &str, records: Vec<Record>) -> Result<(), String> {
        let Some(first) = records.first() else { return Ok(()) };
        let name = Symbol::from(format!("{task}.jsonl"));
        let mut trace = Trace {
            file: Some(name.clone()),
            task: task.to_owned(),
            states: vec![first.before.clone()],
            ..Trace::default()
        };
        for record in records {
            trace.actions.push(record.action);
            trace.states.push(record.after);
        }
        let LearnedModel { model, parse, options, mut evidence, .. } = std::mem::take(&mut self.learned);
        let hierarchy = &model.hierarchy;
        let source = (trace.source_id(hierarchy), name, observe_trace(&trace, hierarchy));
        evidence.merge(&[source].into_iter().collect()).map_err(|error| error.to_string())?;
        let learned = learn_evidence(hierarchy, &parse, evidence, &options);
        *self = Self::new(learned.map_err(|error| error.to_string())?.0);
        Ok(())
    }
}
