//! Acting with a memory: which of the files is what, when the memory is begun, and what the model is after each task.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use typelift::agent::{Experience, Recalled};
use typelift::model::{LearnedModel, Observations};
use typelift::words::count;
use typelift::world::is_pddl;
use typelift_memory::{Access, Memory, MemoryError, MemoryErrorKind, PastEpisode};

use crate::failure::Failure;
use crate::files::{ModelInput, add_types, warn_unread};

/// Whether a text is a task rather than a model. A memory is of learned models, so that what is PDDL is a problem.
pub(crate) fn is_task(text: &str) -> bool {
    #[derive(Deserialize)]
    struct File {
        format: String,
    }
    is_pddl(text) || serde_json::from_str::<File>(text).is_ok_and(|file| file.format.starts_with("task/"))
}

/// A memory that a run goes on from, and with what.
pub(crate) struct Remembered {
    file: PathBuf,
    /// None until it is begun, if it is not there.
    memory: Option<Memory>,
    /// A model whose evidence is to be added, and what it is called.
    model: Option<(Box<LearnedModel>, String)>,
}

impl Remembered {
    /// Opens a memory if it is there, to go on from it and, if it is given, from a model of the same kind. Nothing is written
    /// yet.
    pub(crate) fn open(
        file: &Path,
        model: Option<(&Path, ModelInput)>,
        types: Option<&PathBuf>,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let memory = match Memory::open(file, Access::Write) {
            Err(MemoryError { kind: MemoryErrorKind::Missing, .. }) if model.is_some() => None,
            opened => Some(opened?),
        };
        let model = match model {
            None => None,
            Some((path, ModelInput::Learned(model))) => Some((model, path.display().to_string())),
            Some((path, ModelInput::Given(_))) => {
                let what = format!("{}: this is a PDDL domain, in which nothing is learned", path.display());
                return Err(Failure::bad_input(what).with_hint("Leave out --memory."));
            }
        };
        if let Some(memory) = &memory {
            if let Some((model, name)) = &model {
                memory.agrees(model, name)?;
            } else if let Some(types) = types {
                let mut extended = memory.learned().clone();
                add_types(&mut extended, Some(types))?;
                memory.agrees(&extended, &format!("--types {}", types.display()))?;
            }
            if !quiet {
                warn_unread(memory);
            }
        }
        Ok(Self { file: file.to_owned(), memory, model })
    }

    /// The model to read tasks with, before anything is written.
    pub(crate) fn input(&self) -> ModelInput {
        match (&self.model, &self.memory) {
            (Some((model, _)), _) => ModelInput::Learned(model.clone()),
            (None, Some(memory)) => ModelInput::Learned(Box::new(memory.learned().clone())),
            (None, None) => ModelInput::Learned(Box::default()),
        }
    }

    /// Begins the memory if it is not there, and adds what the model was learned from.
    pub(crate) fn begin(self, quiet: bool) -> Result<Memory, Failure> {
        let is_new = self.memory.is_none();
        let mut memory = match (self.memory, &self.model) {
            (Some(memory), _) => memory,
            (None, Some((model, _))) => Memory::open_or_create(&self.file, model)?,
            (None, None) => Memory::open(&self.file, Access::Write)?,
        };
        if let Some((model, name)) = &self.model {
            let added = memory.add_model(model, name)?;
            if !quiet && (is_new || added > 0) {
                let (verb, file) = (if is_new { "began" } else { "went on with" }, self.file.display());
                anstream::eprintln!("{verb} {file} with {} of {name}", count(added as u64, "demonstration"));
            }
        }
        Ok(memory)
    }
}

/// How many tasks before this run are known as if they had been tried in it: which things took part in what. Of earlier ones
/// their types are known.
const RECALLED: usize = 50;

/// What was tried in the tasks before and said by people, and what else the model was learned from.
pub(crate) fn recall(memory: &Memory) -> Result<(Observations, Experience), Failure> {
    let (mut experience, mut evidence) = (Experience::new(), memory.learned().evidence.clone());
    for PastEpisode { source, instance, trace, goes_on } in memory.recent(RECALLED)? {
        // What never was compact is not compact now.
        let _ = evidence.take_out(source);
        let recalled = Recalled { trace: &trace, instance: &instance, goes_on };
        experience.recall(&recalled, &memory.learned().model);
    }
    hear(memory, &mut experience)?;
    Ok((evidence.total().into_owned(), experience))
}

/// Takes in what people said in the runs before.
fn hear(memory: &Memory, experience: &mut Experience) -> Result<(), Failure> {
    for (entry, said) in memory.words()? {
        experience.hear(&said, &memory.learned().model).map_err(|error| {
            let what = format!("{}: entry {entry}: {error}", memory.file().display());
            Failure::bad_input(what).with_hint(format!("`typelift memory forget --word {entry}` takes it back."))
        })?;
    }
    Ok(())
}
