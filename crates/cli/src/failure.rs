//! What went wrong: a message, a hint, an exit code.

use std::fmt::Display;
use std::io;

use typelift::agent::{EpisodeError, ProposeError, RunError};
use typelift::model::{GoalError, GoalErrorKind, ModelFileError, NameCollision, Stop, Symbol, nearest, printable};
use typelift::pddl::ExportError;
use typelift::plan::ExternalFailure;
use typelift::world::{FileError, ParseErrorKind, WorldError};
use typelift_memory::{MemoryError, MemoryErrorKind};

use crate::exit::Exit;
use crate::style::{ERROR, HINT};

/// What to do about a model that contradicts itself.
pub(crate) const NOT_AS_WRITTEN: &str = "It is not as `typelift learn` wrote it: learn the model again.";

/// Why a command could not do its work.
#[derive(Debug)]
pub(crate) struct Failure {
    exit: Exit,
    message: String,
    hint: Option<String>,
}

impl Failure {
    pub(crate) fn new(exit: Exit, message: impl Display) -> Self {
        Self { exit, message: message.to_string(), hint: None }
    }

    pub(crate) fn bad_input(message: impl Display) -> Self {
        Self::new(Exit::BadInput, message)
    }

    #[must_use]
    pub(crate) fn with_hint(mut self, hint: impl Display) -> Self {
        self.hint = Some(hint.to_string());
        self
    }

    /// What may help.
    pub(crate) fn hint(&self) -> Option<&str> {
        self.hint.as_deref()
    }

    /// Prints it, unless standard output was merely closed.
    pub(crate) fn report(&self) -> Exit {
        if self.exit != Exit::Success {
            anstream::eprintln!("{ERROR}error{ERROR:#}: {}", printable_lines(&self.message));
            if let Some(hint) = &self.hint {
                anstream::eprintln!("{HINT}hint{HINT:#}: {}", printable_lines(hint));
            }
        }
        self.exit
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        let exit = if error.unsupported { Exit::Unsupported } else { Exit::BadInput };
        Self { exit, message: error.render().trim_end().to_owned(), hint: error.hint }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        let exit = if error.kind() == io::ErrorKind::BrokenPipe { Exit::Success } else { Exit::BadInput };
        Self::new(exit, format!("cannot write to standard output: {error}"))
    }
}

impl From<NameCollision> for Failure {
    fn from(error: NameCollision) -> Self {
        let or = if error.kind == "predicate" { ", or --ignore what one comes from" } else { "" };
        let hint = format!("PDDL knows lower case only, and few signs: rename one of the two{or}.");
        Self::bad_input(error).with_hint(hint)
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Name(collision) => collision.into(),
            ExportError::TooManyValues { .. } => Self::new(Exit::Unsupported, error),
            _ => Self::new(Exit::Unsupported, error).with_hint("--level adl needs none of this."),
        }
    }
}

impl From<Stop> for Failure {
    fn from(stop: Stop) -> Self {
        ProposeError::Stopped(stop).into()
    }
}

impl From<ModelFileError> for Failure {
    fn from(error: ModelFileError) -> Self {
        match error {
            ModelFileError::Collision(collision) => collision.into(),
            ModelFileError::Version { .. } => {
                Self::bad_input(error).with_hint("Learn the model again, or use the typelift that wrote it.")
            }
            ModelFileError::NotAModel { .. } => {
                Self::bad_input(error).with_hint("The model comes first; `typelift learn` writes one.")
            }
            ModelFileError::NoFormat => Self::bad_input(error).with_hint("`typelift learn` writes one."),
            _ => Self::bad_input(error).with_hint(NOT_AS_WRITTEN),
        }
    }
}

impl From<MemoryError> for Failure {
    fn from(error: MemoryError) -> Self {
        let hint = match &error.kind {
            MemoryErrorKind::Missing => {
                Some("`typelift run MODEL TASK --memory FILE` makes one, and `typelift learn` with --memory.")
            }
            MemoryErrorKind::NotAMemory | MemoryErrorKind::Exists => Some("Name another file."),
            MemoryErrorKind::Version { .. } => Some("Use the typelift that wrote it."),
            MemoryErrorKind::Damaged(_) => Some(
                "`typelift memory check FILE` says what is wrong; `typelift memory rescue` saves what can be read.",
            ),
            MemoryErrorKind::Disagrees { .. } => {
                Some("A memory is of one hierarchy and one way of reading scenes: begin another one for this model.")
            }
            MemoryErrorKind::Compact { .. } => Some("Learn it anew from its traces, without `--compact`."),
            MemoryErrorKind::NotSaid(_) => Some("`typelift memory log FILE` lists the entries, each with its number."),
            kind => kind.hint(),
        };
        Self { hint: hint.map(str::to_owned), ..Self::bad_input(error) }
    }
}

impl From<ProposeError> for Failure {
    fn from(error: ProposeError) -> Self {
        match error {
            ProposeError::Stopped(stop) => Self::new(stop.into(), error),
            ProposeError::External(ExternalFailure::UnusablePlan { .. }) | ProposeError::ExternalPlan { .. } => {
                Self::new(Exit::InvalidPlan, error)
            }
            ProposeError::External(failure) => {
                let failed = Self::new(Exit::Planner, format!("the planner failed: {failure}"));
                match failure {
                    ExternalFailure::NotStarted { hint: Some(hint), .. } => failed.with_hint(hint),
                    _ => failed,
                }
            }
            ProposeError::Invalid { .. } => Self::new(Exit::Internal, format!("{error}; this is a defect of typelift")),
        }
    }
}

impl From<WorldError> for Failure {
    fn from(error: WorldError) -> Self {
        Self::new(Exit::Environment, format!("the environment failed: {error}"))
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::World(error) => error.into(),
            RunError::Record(error) => error.into(),
            RunError::State(error) => {
                let hint = match &error.kind {
                    ParseErrorKind::UnknownType { .. } => Some(
                        "The model does not know it: is it the right model? --types FILE adds types to a learned one.",
                    ),
                    ParseErrorKind::TwoSources { .. } => {
                        Some("Rename one of the two; or learn with --ignore, which leaves an attribute out.")
                    }
                    kind => kind.hint(),
                };
                let what = format!("the environment's state cannot be read: {error}");
                Self { hint: hint.map(str::to_owned), ..Self::new(Exit::Environment, what) }
            }
            RunError::Episode(EpisodeError::Propose(error)) => error.into(),
            RunError::Episode(EpisodeError::Goal(error)) => Self { hint: about_goal(&error), ..Self::bad_input(error) },
        }
    }
}

/// What to do about a goal that is none for a model.
pub(crate) fn about_goal(error: &GoalError) -> Option<String> {
    error.hint().or_else(|| match error.kind {
        GoalErrorKind::UnknownPredicate { .. } => {
            Some("`typelift show MODEL --predicates` lists what a goal may say.".to_owned())
        }
        _ => None,
    })
}

/// What files and programs say is repeated, but not obeyed.
pub(crate) fn printable_lines(text: &str) -> String {
    text.split('\n').map(printable).collect::<Vec<_>>().join("\n")
}

impl Failure {
    /// The same, with the file's name in front.
    #[must_use]
    pub(crate) fn in_file(mut self, path: &std::path::Path) -> Self {
        self.message = format!("{}: {}", path.display(), self.message);
        self
    }
}

/// The hint for a name that is none of these: the one that may have been meant, or else all of them.
pub(crate) fn or_one_of(name: &str, names: &[Symbol]) -> String {
    match nearest(name, names) {
        Some(near) => format!("Did you mean `{near}`?"),
        None if names.is_empty() => "There are none.".to_owned(),
        None => {
            let names: Vec<&str> = names.iter().map(Symbol::as_str).collect();
            format!("There are {}.", names.join(", "))
        }
    }
}
