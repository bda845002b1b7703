//! `typelift lab hierarchy`.

use std::fs::create_dir_all;
use std::io::Write;

use typelift::world::FileError;
use typelift_lab::TypeHierarchy;

use super::options::ResultOptions;
use crate::columns::Columns;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::style::HEAD;

/// The hierarchy of types, and what each action's parameters were generalized to
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:
  typelift lab hierarchy -o H

Writes hierarchy.svg (parents against children, as in the paper), tree.svg,
hierarchy.csv, parameters.csv and hierarchy.json.")]
pub(super) struct LabHierarchy {
    #[command(flatten)]
    results: ResultOptions,
}

impl LabHierarchy {
    pub(super) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let folder = self.results.folder();
        create_dir_all(&folder).map_err(|error| FileError::from_write(&folder, &error))?;
        let result = TypeHierarchy::of_the_kitchen();
        let files = result.write(&folder)?;
        self.results.print(&result, |out| print(out, &result))?;
        if !quiet {
            anstream::eprintln!("wrote {} to {}", files.join(", "), folder.display());
        }
        Ok(Exit::Success)
    }
}

fn print(out: &mut dyn Write, result: &TypeHierarchy) -> Result<(), Failure> {
    let mut columns = Columns::default();
    columns.styled(["parameter", "", "generalized to", "from"].map(|text| (text.to_owned(), HEAD)));
    for row in result.parameters.iter().filter(|row| row.risen()) {
        let observed = row.observed.join(", ");
        columns.row([row.action.clone(), row.parameter.clone(), row.ty.clone(), observed]);
    }
    write!(out, "{}", columns.text(0))?;
    Ok(())
}
