//! `typelift lab hierarchy`.

use std::fs::create_dir_all;
use std::io::Write;
use std::path::PathBuf;

use typelift::world::FileError;
use typelift_lab::TypeHierarchy;

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
pub(crate) struct LabHierarchy {
    /// The folder for the results; made if it is not there
    #[arg(long, short, value_name = "DIR", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    output: String,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl LabHierarchy {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let folder = PathBuf::from(&self.output);
        create_dir_all(&folder).map_err(|error| FileError::from_write(&folder, &error))?;
        let result = TypeHierarchy::of_the_kitchen();
        let files = result.write(&folder)?;
        let mut out = anstream::stdout().lock();
        if self.json {
            serde_json::to_writer_pretty(&mut out, &result).map_err(std::io::Error::from)?;
            writeln!(out)?;
        } else {
            let mut columns = Columns::default();
            columns.styled(["parameter", "", "generalized to", "from"].map(|text| (text.to_owned(), HEAD)));
            for row in result.parameters.iter().filter(|row| row.risen()) {
                let observed = row.observed.join(", ");
                columns.row([row.action.clone(), row.parameter.clone(), row.ty.clone(), observed]);
            }
            write!(out, "{}", columns.text(0))?;
        }
        if !quiet {
            anstream::eprintln!("wrote {} to {}", files.join(", "), folder.display());
        }
        Ok(Exit::Success)
    }
}
