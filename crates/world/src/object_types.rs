//! The types of the objects of trajectories, which carry none themselves: from problem files, or from a list.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use typelift_model::Symbol;
use typelift_pddl::DefinitionKind;

use crate::{FileError, json, read_text};

type Types = BTreeMap<Symbol, Symbol>;

/// Types of objects, all names in lower case. The default has none.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ObjectTypes {
    folder: Option<PathBuf>,
    /// Of every trajectory: listed objects, constants of domains.
    shared: Types,
    /// Of one problem each, by the stem of its file's name; or why it could not be read, told when it is needed.
    problems: BTreeMap<String, Result<Types, FileError>>,
}

impl ObjectTypes {
    /// Reads a list: JSON `{"object": "type"}`, a PDDL problem, an `(:objects …)` block alone, or a domain with
    /// constants.
    ///
    /// # Errors
    /// [`FileError`] if it is none of these.
    pub fn from_file(path: &Path) -> Result<Self, FileError> {
        let mut types = Self::default();
        types.add_file(path)?;
        Ok(types)
    }

    /// Adds the objects of a file as [`from_file`](Self::from_file) reads it.
    ///
    /// # Errors
    /// [`FileError`] if it is no such file.
    pub fn add_file(&mut self, path: &Path) -> Result<(), FileError> {
        self.add_text(path, &read_text(path)?)
    }

    /// Adds the objects of a text as [`from_file`](Self::from_file) reads a file; errors call it `name`.
    ///
    /// # Errors
    /// [`FileError`] if it is none of what such a file may be.
    pub fn add_text(&mut self, name: &Path, text: &str) -> Result<(), FileError> {
        let objects = match text.trim_start().chars().next() {
            None => return Err(FileError::new(name, "the file is empty")),
            Some('{') => json_objects(name, text)?,
            Some('(' | ';') => pddl_objects(name, text)?.1,
            Some(_) => {
                return Err(FileError::new(name, "this is neither PDDL objects nor a JSON object of objects")
                    .with_hint(
                        "Write `(:objects a b - block)` or `{\"a\": \"block\", \"b\": \"block\"}`.".to_owned(),
                    ));
            }
        };
        self.shared.extend(objects);
        Ok(())
    }

    /// Adds constants, each with its type's name, unless their types are listed already.
    pub fn add_constants<'a>(&mut self, constants: impl IntoIterator<Item = (&'a Symbol, &'a Symbol)>) {
        let lower = |name: &Symbol| Symbol::from(name.as_str().to_ascii_lowercase());
        for (name, ty) in constants {
            self.shared.entry(lower(name)).or_insert_with(|| lower(ty));
        }
    }

    /// Reads every `.pddl` file of a folder: the objects of problems, and the constants of domains. A trajectory goes
    /// with the problem whose file has the same name but for the ending, a closing `_traj`, `_trajectory`, `_prob` or
    /// `_problem` apart, or with the only problem.
    ///
    /// # Errors
    /// [`FileError`] if the folder cannot be read or holds no problem. A problem that is malformed is an error of the
    /// trajectory that it goes with.
    pub fn from_problems(folder: &Path) -> Result<Self, FileError> {
        let mut types = Self { folder: Some(folder.to_owned()), ..Self::default() };
        for path in Self::problems_at(folder)? {
            match read_text(&path).and_then(|text| pddl_objects(&path, &text)) {
                Ok((Some(DefinitionKind::Domain), objects)) => types.shared.extend(objects),
                read => {
                    types.problems.insert(stem(&path), read.map(|(_, objects)| objects));
                }
            }
        }
        if types.problems.is_empty() {
            return Err(FileError::new(folder, "there is no problem file (.pddl) in this folder"));
        }
        Ok(types)
    }

    /// The files of a folder that [`from_problems`](Self::from_problems) reads, sorted by name.
    ///
    /// # Errors
    /// [`FileError`] if the folder cannot be read.
    pub fn problems_at(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
        files_of(folder, |name| name.ends_with(".pddl"))
    }

    /// The types of the objects of a trajectory.
    ///
    /// # Errors
    /// [`FileError`] if there are several problems and none goes with it, or the one that does is malformed.
    pub fn of_trajectory(&self, trajectory: &Path) -> Result<Types, FileError> {
        let name = stem(trajectory);
        let only = || self.problems.values().next().filter(|_| self.problems.len() == 1);
        let mut types = self.shared.clone();
        match self.problems.get(&name).or_else(only) {
            Some(problem) => types.extend(problem.clone()?),
            None if self.problems.is_empty() => {}
            None => {
                let folder = self.folder.as_deref().unwrap_or(Path::new("")).display();
                let what = format!("none of the {} problems in {folder} goes with this file", self.problems.len());
                let hint = format!("Name the problem `{name}.pddl`, as the trajectory.");
                return Err(FileError::new(trajectory, what).with_hint(hint));
            }
        }
        Ok(types)
    }
}

/// The files of a folder whose names are wanted, sorted.
pub(crate) fn files_of(folder: &Path, wanted: impl Fn(&str) -> bool) -> Result<Vec<PathBuf>, FileError> {
    let io = |e: std::io::Error| FileError::from_io(folder, &e);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        if path.is_file() && path.file_name().is_some_and(|name| wanted(&name.to_string_lossy())) {
            files.push(path);
        }
    }
    files.sort_unstable();
    Ok(files)
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let endings = ["_traj", "_trajectory", "_prob", "_problem"];
    endings.iter().find_map(|ending| stem.strip_suffix(ending)).unwrap_or(&stem).to_owned()
}

fn pddl_objects(path: &Path, text: &str) -> Result<(Option<DefinitionKind>, Types), FileError> {
    let declarations = typelift_pddl::read_objects(text).map_err(|error| FileError::from_pddl(path, text, error))?;
    Ok((declarations.kind, declarations.objects.into_iter().map(|o| (o.name, o.ty)).collect()))
}

fn json_objects(path: &Path, text: &str) -> Result<Types, FileError> {
    #[derive(serde::Deserialize)]
    #[serde(transparent)]
    struct Objects(#[serde(deserialize_with = "json::distinct_map")] Types);
    let Objects(objects) = serde_json::from_str(text).map_err(|error| FileError::from_json(path, 1, text, &error))?;
    let lower = |name: &Symbol| Symbol::from(name.as_str().to_ascii_lowercase());
    let mut types = Types::new();
    for (name, ty) in &objects {
        if types.insert(lower(name), lower(ty)).is_some_and(|known| known != lower(ty)) {
            let what = format!("object `{}` is listed with two types", lower(name));
            return Err(FileError::new(path, what));
        }
    }
    Ok(types)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            crate::write_file(&folder.path().join(name), text.as_bytes()).expect("written");
        }
        folder
    }

    fn shown(types: &Types) -> Vec<String> {
        types.iter().map(|(name, ty)| format!("{name}:{ty}")).collect()
    }

    #[test]
    fn problems_go_with_trajectories_of_their_name() {
        let folder = folder(&[
            ("1_bw_prob.pddl", "(define (problem p) (:objects A - Block))"),
            ("2.pddl", "(define (problem p) (:objects b - block))"),
            ("domain.pddl", "(define (domain d) (:constants home - place))"),
            ("notes.txt", "("),
            ("4.pddl", ""),
        ]);
        let types = ObjectTypes::from_problems(folder.path()).expect("problems");
        let of = |name| types.of_trajectory(Path::new(name));
        assert_eq!(shown(&of("x/1_bw_traj").expect("types")), ["a:block", "home:place"]);
        assert_eq!(shown(&of("2.trajectory").expect("types")), ["b:block", "home:place"]);
        assert!(of("4.trajectory").expect_err("empty").what.starts_with("there is nothing in this text"));
        let error = of("3.trajectory").expect_err("no problem");
        let shown = folder.path().display();
        assert_eq!(error.to_string(), format!("3.trajectory: none of the 3 problems in {shown} goes with this file"));
        assert_eq!(error.hint.as_deref(), Some("Name the problem `3.pddl`, as the trajectory."));
    }

    #[test]
    fn a_single_problem_goes_with_all() {
        let folder = folder(&[("p.pddl", "(define (problem p) (:objects a - block))")]);
        let types = ObjectTypes::from_problems(folder.path()).expect("problems");
        assert_eq!(shown(&types.of_trajectory(Path::new("x.trajectory")).expect("types")), ["a:block"]);
    }

    #[test]
    fn lists() {
        let folder = folder(&[
            ("a.json", r#"{"A": "Block", "b": "block"}"#),
            ("b.pddl", "(:objects a b - block)"),
            ("twice.json", r#"{"a": "block", "A": "place"}"#),
            ("same.json", "{\"a\": \"block\",\n \"a\": \"place\"}"),
            ("other.txt", "a block"),
        ]);
        let read = |name: &str| ObjectTypes::from_file(&folder.path().join(name));
        let failed = |name: &str| read(name).expect_err(name);
        for name in ["a.json", "b.pddl"] {
            let types = read(name).expect(name).of_trajectory(Path::new("x")).expect("types");
            assert_eq!(shown(&types), ["a:block", "b:block"]);
        }
        assert_eq!(failed("twice.json").what, "object `a` is listed with two types");
        assert_eq!((failed("same.json").what, failed("same.json").line), ("`a` stands here twice".to_owned(), Some(2)));
        assert_eq!(failed("other.txt").what, "this is neither PDDL objects nor a JSON object of objects");
        assert_eq!(failed("none.json").what, "there is no such file");
    }

    #[test]
    fn a_folder_without_problems_is_refused() {
        let folder = folder(&[("domain.pddl", "(define (domain d))")]);
        let error = ObjectTypes::from_problems(folder.path()).expect_err("no problem");
        assert_eq!(error.what, "there is no problem file (.pddl) in this folder");
    }
}
