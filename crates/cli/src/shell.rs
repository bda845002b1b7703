//! `typelift completions` and `typelift man`: what a shell and `man` want to know, from the command line's one definition.

use std::fs::create_dir_all;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::CommandFactory;
use clap_complete::Shell;
use typelift::world::FileError;

use crate::Arguments;
use crate::exit::Exit;
use crate::failure::Failure;

/// Print what a shell needs to complete commands and options
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift completions bash > /etc/bash_completion.d/typelift
  typelift completions zsh > ~/.zfunc/_typelift
  typelift completions fish > ~/.config/fish/completions/typelift.fish")]
pub(crate) struct Completions {
    /// The shell
    shell: Shell,
}

/// Print the manual page, or write one for each command
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift man | man -l -
  typelift man ~/.local/share/man/man1

With DIR, writes typelift.1, typelift-plan.1 and so on, a page a command.")]
pub(crate) struct Man {
    /// The folder to write to; made if it is not there
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
}

impl Completions {
    pub(crate) fn run(&self) -> Result<Exit, Failure> {
        let mut command = Arguments::command();
        let name = command.get_name().to_owned();
        // Into memory first: clap's crate panics if standard output is closed.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut command, name, &mut script);
        io::stdout().write_all(&script)?;
        Ok(Exit::Success)
    }
}

impl Man {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        match &self.folder {
            None => {
                let mut page = Vec::new();
                clap_mangen::Man::new(Arguments::command()).render(&mut page)?;
                io::stdout().write_all(&page)?;
            }
            Some(folder) => write_pages(folder, quiet)?,
        }
        Ok(Exit::Success)
    }
}

/// Writes a page for each command but the hidden ones.
fn write_pages(folder: &Path, quiet: bool) -> Result<(), Failure> {
    let written = create_dir_all(folder).and_then(|()| clap_mangen::generate_to(Arguments::command(), folder));
    written.map_err(|error| FileError::from_write(folder, &error))?;
    if !quiet {
        anstream::eprintln!("wrote the manual pages to {}", folder.display());
    }
    Ok(())
}
