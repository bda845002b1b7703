//! `typelift memory`: what a memory knows, and what of it is taken back.

mod export;
mod log;

use std::io::Write;
use std::path::{Path, PathBuf};

use typelift::model::{SourceId, Symbol};
use typelift::words::count;
use typelift_memory::{Access, Memory, Merged, Rescued, What, check, merge, rescue};

use crate::exit::Exit;
use crate::failure::{Failure, printable_lines};
use crate::files::warn_unread;
use crate::learn_into::source_called;
use crate::show::overview;
use crate::style::BAD;
use export::export;
use log::{in_words, list};

/// Say what a memory knows, and take things back
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  typelift memory show robot.memory\n\n`typelift memory COMMAND --help` tells more.")]
pub(crate) struct MemoryCommand {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Show what was learned, as `show` does, and from how much
    #[command(after_help = "Example:\n  typelift memory show robot.memory")]
    Show {
        /// The memory
        file: PathBuf,
    },
    /// List all entries, one a line
    #[command(after_help = "Examples:
  typelift memory log robot.memory
  typelift memory log robot.memory --times")]
    Log {
        /// The memory
        file: PathBuf,
        /// Say when each was written, in UTC
        #[arg(long)]
        times: bool,
    },
    /// Write the episodes as traces, and what was learned as a model
    #[command(after_help = "Examples:
  typelift memory export robot.memory --traces T
  typelift memory export robot.memory -o model.json")]
    Export {
        /// The memory
        file: PathBuf,
        /// Write each episode as a trace to this folder
        #[arg(long, value_name = "FOLDER", required_unless_present = "output")]
        traces: Option<PathBuf>,
        /// Write the model to this file
        #[arg(long, short, value_name = "MODEL")]
        output: Option<PathBuf>,
    },
    /// Make one memory of several; what is in more than one of them is there once
    #[command(after_help = "Example:
  typelift memory merge kitchen.memory lab.memory -o both.memory

They must be of one hierarchy and one way of reading scenes. What is learned is
the same as from all that they saw, in whatever order they are named.")]
    Merge {
        /// The memories, which stay as they are
        #[arg(required = true, num_args = 2.., value_name = "FILE")]
        files: Vec<PathBuf>,
        /// The new memory
        #[arg(long, short, value_name = "FILE")]
        output: PathBuf,
    },
    /// Look whether everything is as it was written
    #[command(after_help = "Example:
  typelift memory check robot.memory

Exit codes: 0 all is well, 12 something is not, 31 nothing can be read.")]
    Check {
        /// The memory
        file: PathBuf,
    },
    /// Save what can be read of a damaged memory to a new one, and say what is lost
    #[command(after_help = "Example:
  typelift memory rescue robot.memory -o saved.memory

The damaged memory stays as it is. What was taken back where entries are lost is
known again.")]
    Rescue {
        /// The damaged memory
        file: PathBuf,
        /// The new memory
        #[arg(long, short, value_name = "FILE")]
        output: PathBuf,
    },
    /// Take demonstrations, episodes or words back: the model is as if they had never been
    #[command(after_help = "Examples:
  typelift memory forget robot.memory 3f9a01c2
  typelift memory forget robot.memory cut-a-lettuce.jsonl
  typelift memory forget robot.memory --word 12
  typelift memory forget robot.memory --object cutboard_1 --instance kitchen

`typelift memory log` lists the ids and, in front, the numbers of entries. The
entries stay in the file.")]
    Forget {
        /// The memory
        file: PathBuf,
        /// Each by a file with its content, its name, or the first digits of its id
        #[arg(required_unless_present_any = ["word", "object"], value_name = "SOURCE")]
        sources: Vec<String>,
        /// What a person said, by the number of its entry
        #[arg(long, value_name = "ENTRY")]
        word: Vec<i64>,
        /// Each episode in which something was done with this object, and each word about it
        #[arg(long, value_name = "OBJECT")]
        object: Vec<String>,
        /// The object of this instance of the world only
        #[arg(long, value_name = "NAME", requires = "object")]
        instance: Option<String>,
    },
}

impl MemoryCommand {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        match &self.command {
            Command::Show { file } => show(&read(file, quiet)?),
            Command::Log { file, times } => list(&read(file, quiet)?, *times),
            Command::Export { file, traces, output } => {
                export(&read(file, quiet)?, traces.as_deref(), output.as_deref(), quiet)
            }
            Command::Merge { files, output } => merge_into(files, output, quiet),
            Command::Check { file } => report(file),
            Command::Rescue { file, output } => save(file, output, quiet),
            Command::Forget { file, sources, word, object, instance } => {
                forget(file, sources, word, quiet)?;
                forget_objects(file, object, instance.as_deref(), quiet)
            }
        }
    }
}

fn read(file: &Path, quiet: bool) -> Result<Memory, Failure> {
    let memory = Memory::open(file, Access::Read)?;
    if !quiet {
        warn_unread(&memory);
    }
    Ok(memory)
}

fn show(memory: &Memory) -> Result<Exit, Failure> {
    let (mut demonstrations, mut episodes, mut steps, mut words, mut taken_back) = (0, 0, 0, 0, 0);
    for entry in memory.entries()? {
        match entry.what {
            What::Evidence { sources, .. } => demonstrations += sources as u64,
            What::Begun { .. } => episodes += 1,
            What::Stepped(_) => steps += 1,
            What::Forgotten { .. } => taken_back += 1,
            What::Said { .. } => words += 1,
            What::Ended { .. } | What::Proposed { .. } => {}
        }
    }
    let mut out = anstream::stdout().lock();
    let taken_back = if taken_back == 0 { String::new() } else { format!("; {taken_back} taken back") };
    let words = if words == 0 { String::new() } else { format!(", {} of a person", count(words, "word")) };
    let seen = [count(demonstrations, "demonstration"), count(episodes, "episode"), count(steps, "step")];
    writeln!(out, "{}{words}{taken_back}", seen.join(", "))?;
    // That a plan was agreed to says nothing of another one.
    for (entry, said) in memory.words()?.iter().filter(|(_, said)| said.experience.is_some()) {
        writeln!(out, "a person said {}  (entry {entry})", printable_lines(&in_words(said)))?;
    }
    overview(&mut out, memory.learned())?;
    Ok(Exit::Success)
}

fn merge_into(files: &[PathBuf], output: &Path, quiet: bool) -> Result<Exit, Failure> {
    let files: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    let Merged { entries, shared } = merge(&files, output)?;
    // What is learned is kept in it.
    let memory = Memory::open(output, Access::Write)?;
    if !quiet {
        warn_unread(&memory);
        let twice = if shared == 0 { String::new() } else { format!(", {shared} of them in more than one") };
        anstream::eprintln!("wrote {} with {}{twice}", output.display(), entries_said(entries as u64));
    }
    Ok(Exit::Success)
}

fn entries_said(number: u64) -> String {
    if number == 1 { "1 entry".to_owned() } else { format!("{number} entries") }
}

fn save(file: &Path, output: &Path, quiet: bool) -> Result<Exit, Failure> {
    let Rescued { entries, lost } = rescue(file, output)?;
    let mut out = anstream::stdout().lock();
    for what in &lost {
        writeln!(out, "{BAD}lost{BAD:#}: {what}")?;
    }
    if lost.is_empty() {
        writeln!(out, "nothing is lost")?;
    }
    // What is learned is kept in it.
    let memory = Memory::open(output, Access::Write)?;
    if !quiet {
        warn_unread(&memory);
        anstream::eprintln!("wrote {} with {}", output.display(), entries_said(entries as u64));
    }
    Ok(Exit::Success)
}

fn report(file: &Path) -> Result<Exit, Failure> {
    let found = check(file)?;
    let mut out = anstream::stdout().lock();
    for problem in &found.problems {
        writeln!(out, "{BAD}wrong{BAD:#}: {problem}")?;
    }
    writeln!(out, "{} can be read", entries_said(found.entries))?;
    Ok(if found.problems.is_empty() { Exit::Success } else { Exit::NotAchieved })
}

fn forget_objects(file: &Path, objects: &[String], instance: Option<&str>, quiet: bool) -> Result<Exit, Failure> {
    let instance = instance.map(Symbol::new);
    for object in objects {
        let found = Memory::open(file, Access::Write)?.forget_object(&Symbol::new(object), instance.as_ref())?;
        if !quiet {
            let (episodes, words) = (count(found.episodes as u64, "episode"), count(found.words as u64, "word"));
            anstream::eprintln!("took back {object}: {episodes}, {words}");
        }
    }
    Ok(Exit::Success)
}

fn forget(file: &Path, sources: &[String], words: &[i64], quiet: bool) -> Result<Exit, Failure> {
    let mut memory = Memory::open(file, Access::Write)?;
    let evidence = &memory.learned().evidence;
    let called = |text: &String| source_called(evidence, text, "");
    let ids = sources.iter().map(called).collect::<Result<Vec<SourceId>, _>>()?;
    for id in ids {
        let name = memory.learned().evidence.sources().get(&id).map(|source| source.name.clone());
        memory.forget(id)?;
        if !quiet {
            anstream::eprintln!("took back {} ({})", name.unwrap_or_default(), id.short());
        }
    }
    for word in words {
        memory.take_back(*word)?;
        if !quiet {
            anstream::eprintln!("took back entry {word}");
        }
    }
    Ok(Exit::Success)
}
