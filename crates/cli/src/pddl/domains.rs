//! Finding the domain that a problem belongs to.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use typelift::pddl::{Definition, DefinitionKind, Document, Domain, compile_domain, read_domain};
use typelift::world::{FileError, read_text};

/// Domains, each read once, and the texts of what can be read only once.
#[derive(Debug, Default)]
pub(crate) struct Domains {
    /// What came out of pipes.
    kept: BTreeMap<PathBuf, String>,
    /// The domains that were named by the user, with their names in lower case.
    given: Vec<(PathBuf, String)>,
    read: BTreeMap<PathBuf, Result<Rc<Domain>, FileError>>,
    /// The domains of each folder that was searched.
    folders: BTreeMap<PathBuf, Vec<(PathBuf, String)>>,
}

impl Domains {
    /// Adds a domain that problems may belong to.
    pub(crate) fn give(&mut self, path: &Path, name: &str) {
        self.given.push((path.to_owned(), name.to_ascii_lowercase()));
    }

    /// The text of a file, as often as it is asked for, even if it is a pipe.
    pub(crate) fn text(&mut self, path: &Path) -> Result<String, FileError> {
        if let Some(text) = self.kept.get(path) {
            return Ok(text.clone());
        }
        let text = read_text(path)?;
        if !path.is_file() {
            self.kept.insert(path.to_owned(), text.clone());
        }
        Ok(text)
    }

    /// Reads a domain.
    pub(crate) fn read(&mut self, path: &Path) -> Result<Rc<Domain>, FileError> {
        if let Some(domain) = self.read.get(path) {
            return domain.clone();
        }
        let domain = self.text(path).and_then(|text| {
            let at_place = |error| FileError::from_pddl(path, &text, error);
            let domain = read_domain(&text).map_err(at_place)?;
            // What planning refuses is refused.
            compile_domain(&domain).map_err(|error| at_place(error.locate(&text)))?;
            Ok(Rc::new(domain))
        });
        self.read.insert(path.to_owned(), domain.clone());
        domain
    }

    /// The domain of a problem that says it belongs to `name`: one that was given, or else `domain.pddl` beside the
    /// problem, or else the only one of that name in its folder or in the folder above. Where none has that name, it is the
    /// only one that was given.
    pub(crate) fn of_problem(&mut self, problem: &Path, name: &str) -> Result<Rc<Domain>, FileError> {
        let path = self.find(problem, &name.to_ascii_lowercase())?;
        self.read(&path).map_err(|error| FileError {
            unsupported: error.unsupported,
            ..FileError::new(problem, format!("its domain cannot be read: {error}"))
        })
    }

    fn find(&mut self, problem: &Path, name: &str) -> Result<PathBuf, FileError> {
        let nearness = |domain: &Path| {
            let folder = domain.parent().filter(|folder| problem.starts_with(folder));
            folder.map(|folder| folder.components().count())
        };
        // Of several, the first of the nearest.
        let named = self.given.iter().rev().filter(|(_, given)| given == name);
        if let Some((path, _)) = named.max_by_key(|(path, _)| nearness(path)) {
            return Ok(path.clone());
        }
        let beside = problem.with_file_name("domain.pddl");
        if beside.is_file() {
            return Ok(beside);
        }
        let folder = problem.parent().unwrap_or(Path::new(""));
        for folder in [folder.to_owned(), folder_above(folder)] {
            let mut named = self.in_folder(&folder).iter().filter(|(_, other)| other == name);
            match (named.next(), named.next()) {
                (None, _) => {}
                (Some((path, _)), None) => return Ok(path.clone()),
                (Some((one, _)), Some((other, _))) => {
                    let what = format!(
                        "there are several domains `{name}`, such as {} and {}",
                        one.display(),
                        other.display()
                    );
                    return Err(FileError::new(problem, what).with_hint("Name the right one as well.".to_owned()));
                }
            }
        }
        // With a single domain, the name is what is wrong.
        if let [(path, _)] = self.given.as_slice() {
            return Ok(path.clone());
        }
        let error = FileError::new(problem, format!("its domain `{name}` is not there"));
        Err(error.with_hint("Name the domain's file as well.".to_owned()))
    }

    /// The domains in a folder, in the order of the files' names.
    fn in_folder(&mut self, folder: &Path) -> &[(PathBuf, String)] {
        self.folders.entry(folder.to_owned()).or_insert_with(|| {
            let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
            let entries = folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
            let mut files: Vec<PathBuf> =
                entries.filter(|path| path.extension().is_some_and(|ending| ending == "pddl")).collect();
            files.sort();
            let named = files.into_iter().filter_map(|path| declared_name(&path).map(|name| (path, name)));
            named.collect()
        })
    }
}

fn folder_above(folder: &Path) -> PathBuf {
    match folder.parent() {
        Some(above) if !folder.ends_with("..") => above.to_owned(),
        _ => folder.join(".."),
    }
}

/// The name of the domain in a file, in lower case, if there is one.
fn declared_name(path: &Path) -> Option<String> {
    let text = read_text(path).ok()?;
    let document = Document::read(&text).ok()?;
    let definition = Definition::only(&document, DefinitionKind::Domain).ok()?;
    Some(definition.name.to_ascii_lowercase())
}
