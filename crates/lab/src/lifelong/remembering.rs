//! What is learned along a life: the evidence of each task is added to that of the demonstrations, and the model learned anew,
//! as a memory's is.

use std::sync::Arc;

use typelift::learn::{learn_evidence, observe_trace};
use typelift::model::{ActionModel, LearnedModel, Symbol};
use typelift::world::{Beginning, FileError, Parser, RecordSink, Recording, Scene, TraceAction, TraceHeader};

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

    /// Learns from what was done in a task, each beginning as a source of its own.
    ///
    /// # Errors
    /// In words, if what was recorded is no trace of this hierarchy.
    pub(super) fn learn(&mut self, kept: &Kept) -> Result<(), String> {
        let LearnedModel { model, parse, options, evidence, .. } = &mut self.learned;
        let mut parser = Parser::new(model.hierarchy.clone(), parse.clone());
        for recording in &kept.recordings {
            let name = Symbol::from(format!("{}.jsonl", recording.header.task));
            let trace = recording.trace(name.clone(), &mut parser).map_err(|error| error.to_string())?;
            let observed = observe_trace(&trace, &model.hierarchy);
            let source = [(trace.source_id(&model.hierarchy), name, observed)].into_iter().collect();
            evidence.merge(&source).map_err(|error| error.to_string())?;
        }
        let learned = learn_evidence(&model.hierarchy, parse, evidence.clone(), options);
        *self = Self::new(learned.map_err(|error| error.to_string())?.0);
        Ok(())
    }
}

/// Keeps what happens in a task.
#[derive(Debug)]
pub(super) struct Kept {
    header: TraceHeader,
    recordings: Vec<Recording>,
}

impl Kept {
    pub(super) fn new(header: TraceHeader) -> Self {
        Self { header, recordings: Vec::new() }
    }
}

impl RecordSink for Kept {
    fn begin(&mut self, beginning: &Beginning<'_>) -> Result<(), FileError> {
        let (header, first) = (self.header.clone(), beginning.first.clone());
        self.recordings.push(Recording { header, first, steps: Vec::new() });
        Ok(())
    }

    fn step(&mut self, action: &TraceAction, after: &Scene) -> Result<(), FileError> {
        if let Some(recording) = self.recordings.last_mut() {
            recording.steps.push((action.clone(), after.clone()));
        }
        Ok(())
    }
}
