//! Reading many demonstrations against one hierarchy.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read};
use std::path::{Path, PathBuf};

use typelift_model::{Hierarchy, ParseConfig};

use crate::line_reader::LINE_LIMIT;
use crate::object_types::files_of;
use crate::trace_file::trace_from;
use crate::trajectory_file::trajectory_from;
use crate::{Dataset, FileError, Parser, Trace, TraceReader, TrajectoryContext};

/// Reads a trace or a trajectory, which of the two being told from its first character.
///
/// # Errors
/// [`FileError`] as for [`read_trace`](crate::read_trace) and [`read_trajectory`](crate::read_trajectory).
pub fn read_any_trace(path: &Path, context: &TrajectoryContext, parser: &mut Parser) -> Result<Trace, FileError> {
    let file = File::open(path).map_err(|e| FileError::from_io(path, &e))?;
    any_trace_from(path, file, context, parser)
}

/// Reads a trace or a trajectory from whatever can be read, such as bytes in memory; errors call it `path`.
///
/// # Errors
/// As for [`read_any_trace`].
pub fn any_trace_from(
    path: &Path,
    input: impl Read,
    context: &TrajectoryContext,
    parser: &mut Parser,
) -> Result<Trace, FileError> {
    let io = |e: std::io::Error| FileError::from_io(path, &e);
    let mut input = BufReader::new(input);
    // It is read once: it may be a pipe.
    let mut blank = Vec::new();
    let is_trajectory = loop {
        let bytes = input.fill_buf().map_err(io)?;
        if bytes.is_empty() {
            return Err(FileError::new(path, "the file is empty"));
        }
        let without_mark = bytes.strip_prefix("\u{FEFF}".as_bytes()).unwrap_or(bytes);
        match without_mark.iter().find(|b| !b.is_ascii_whitespace()) {
            Some(first) => break matches!(first, b'(' | b';'),
            None if blank.len() > LINE_LIMIT => break false,
            None => {
                blank.extend_from_slice(bytes);
                let read = bytes.len();
                input.consume(read);
            }
        }
    };
    let input = Cursor::new(blank).chain(input);
    if is_trajectory {
        trajectory_from(path, input, context, parser)
    } else {
        trace_from(path, TraceReader::new(path, input)?, parser)
    }
}

/// Reads demonstrations with one parser, so that a predicate means the same in all of them. Of a folder, those that
/// [`demonstrations_at`] lists are read.
///
/// # Errors
/// [`FileError`] as for [`read_any_trace`], and if there are no demonstrations.
pub fn read_dataset(
    paths: &[PathBuf],
    hierarchy: Hierarchy,
    parse: ParseConfig,
    context: &TrajectoryContext,
) -> Result<Dataset, FileError> {
    let mut parser = Parser::new(hierarchy, parse);
    let mut traces = Vec::new();
    for path in paths {
        for file in demonstrations_at(path)? {
            traces.push(read_any_trace(&file, context, &mut parser)?);
        }
    }
    dataset_of(&parser, traces)
}

/// The demonstrations that [`read_dataset`] reads for a path: itself, or, of a folder, the files that end in `.jsonl`,
/// `.trajectory` or `_traj`, sorted by name.
///
/// # Errors
/// [`FileError`] if it is a folder that cannot be read, or that holds none.
pub fn demonstrations_at(path: &Path) -> Result<Vec<PathBuf>, FileError> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let endings = [".jsonl", ".trajectory", "_traj"];
    let files = files_of(path, |name| endings.iter().any(|ending| name.ends_with(ending)))?;
    if files.is_empty() {
        let what = "there are no traces (.jsonl) or trajectories (.trajectory, _traj) in this folder";
        return Err(FileError::new(path, what));
    }
    Ok(files)
}

/// Reads demonstrations from whatever can be read, each with the name by which errors call it.
///
/// # Errors
/// As for [`read_dataset`].
pub fn dataset_from<R: Read>(
    inputs: impl IntoIterator<Item = (PathBuf, R)>,
    hierarchy: Hierarchy,
    parse: ParseConfig,
    context: &TrajectoryContext,
) -> Result<Dataset, FileError> {
    let mut parser = Parser::new(hierarchy, parse);
    let read = |(name, input): (PathBuf, R)| any_trace_from(&name, input, context, &mut parser);
    let traces = inputs.into_iter().map(read).collect::<Result<_, _>>()?;
    dataset_of(&parser, traces)
}

fn dataset_of(parser: &Parser, traces: Vec<Trace>) -> Result<Dataset, FileError> {
    if traces.is_empty() {
        return Err(FileError::new(Path::new(""), "no traces"));
    }
    Ok(Dataset::new(parser, traces))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ObjectTypes, hierarchy_from_text};

    const TRACE: &str = concat!(
        "{\"format\":\"trace/1\",\"task\":\"t\",\"goal\":[]}\n",
        "{\"state\":{\"objects\":{\"a\":\"block\"},\"atoms\":[\"free(a)\"]}}\n"
    );

    fn read(files: &[(&str, &str)], paths: &[&str]) -> Result<Dataset, String> {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            crate::write_file(&folder.path().join(name), text.as_bytes()).expect("written");
        }
        let list = folder.path().join("objects");
        crate::write_file(&list, b"(:objects a b - block)").expect("written");
        let context = ObjectTypes::from_file(&list).expect("types").into();
        let hierarchy = Hierarchy::from_edges([("block", "object")]).expect("a tree");
        let paths: Vec<PathBuf> = paths.iter().map(|path| folder.path().join(path)).collect();
        let shown = format!("{}/", folder.path().display());
        read_dataset(&paths, hierarchy, ParseConfig::default(), &context).map_err(|e| e.to_string().replace(&shown, ""))
    }

    #[test]
    fn folders_and_files_of_both_kinds() {
        let files = [("b.jsonl", TRACE), ("a.trajectory", "\n; SAM\n((:init (on a b)))"), ("notes.txt", "x")];
        let dataset = read(&files, &["", "b.jsonl"]).expect("a dataset");
        let names: Vec<&str> = dataset.traces.iter().filter_map(|t| Some(t.file.as_ref()?.as_str())).collect();
        assert_eq!(names, ["a.trajectory", "b.jsonl"]);
        let repeated: Vec<(&str, &str)> =
            dataset.repeated.iter().map(|again| (again.file.as_str(), again.first.as_str())).collect();
        assert_eq!(repeated, [("b.jsonl", "b.jsonl")]);
        assert!(dataset.attributes.keys().eq(["free", "on"]));
    }

    #[test]
    fn what_is_no_file_is_read_alike() {
        let mut types = ObjectTypes::default();
        types.add_text(Path::new("objects"), "(:objects a b - block)").expect("types");
        let dataset = |texts: &[(&str, &str)]| {
            let hierarchy = hierarchy_from_text(Path::new("types"), "(:types block)".to_owned()).expect("a tree");
            let inputs = texts.iter().map(|(name, text)| (PathBuf::from(name), text.as_bytes()));
            dataset_from(inputs, hierarchy, ParseConfig::default(), &types.clone().into())
        };
        let texts = [("a.trajectory", "\n; SAM\n((:init (on a b)))"), ("b.jsonl", TRACE)];
        let of_files = read(&texts, &[""]).expect("a dataset");
        let of_texts = dataset(&texts).expect("a dataset");
        assert_eq!(of_texts.traces, of_files.traces);
        let wrong = dataset(&[("what", "{}")]).expect_err("no header");
        assert_eq!(wrong.to_string(), "what:1: the first line is not a header");
        assert_eq!(dataset(&[]).expect_err("nothing").to_string(), "no traces");
    }

    #[test]
    fn a_predicate_means_the_same_in_all_files() {
        let lid = |attribute: &str| {
            let entity = format!("{{\"id\":\"a\",\"type\":\"block\",\"attributes\":{{{attribute}}}}}");
            format!("{{\"format\":\"trace/1\"}}\n{{\"state\":{{\"entities\":[{entity}]}}}}\n")
        };
        let (word, truth) = (lid("\"lid\":\"open\""), lid("\"lid_open\":true"));
        assert_eq!(
            read(&[("a.jsonl", &word), ("b.jsonl", &truth)], &[""]).expect_err("two meanings"),
            "b.jsonl:2: entity a: the predicate `lid_open` has two sources: a word of the attribute `lid` and the true or \
             false attribute `lid_open`"
        );
    }

    #[test]
    fn nothing_to_read_is_an_error() {
        assert_eq!(read(&[], &[]).expect_err("nothing"), "no traces");
        let error = read(&[], &[""]).expect_err("an empty folder");
        assert!(
            error.ends_with("there are no traces (.jsonl) or trajectories (.trajectory, _traj) in this folder"),
            "{error}"
        );
        assert_eq!(read(&[("a.jsonl", " \n")], &["a.jsonl"]).expect_err("blank"), "a.jsonl: the file is empty");
        assert_eq!(read(&[], &["a.jsonl"]).expect_err("missing"), "a.jsonl: there is no such file");
    }
}
