//! The run log of an experiment, `runs.jsonl`: a header that says what the runs are of, then a line for each finished
//! run, appended in one write as it finishes. Whatever ends the program, no finished run is lost.
//!
//! A line without its end is what a killed program leaves; it is dropped, and its run repeated. Anything else that
//! cannot be read is an error, since more of the file may be damaged. When everything is finished the lines
//! are put in order.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError, create_dir_all};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use typelift::model::json_message;
use typelift::world::{FileError, remove_left_behind, write_file};

/// The format of a run log.
pub const FORMAT: &str = "lab-runs/1";

/// The name of a run log in its folder.
pub const FILE_NAME: &str = "runs.jsonl";

const OTHERWISE: &str = "Write to another folder with -o, or begin again with --fresh.";

/// What the runs of a log are of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    format: String,
    typelift: String,
    experiment: String,
    settings: Value,
}

impl Header {
    /// The header of an experiment of this version. The settings are everything else that a result depends on.
    pub fn new(experiment: &str, settings: Value) -> Self {
        Self {
            format: FORMAT.to_owned(),
            typelift: env!("CARGO_PKG_VERSION").to_owned(),
            experiment: experiment.to_owned(),
            settings,
        }
    }

    /// Why runs under `found` are not runs under this header.
    fn difference(&self, found: &Self) -> Option<String> {
        if found.format != self.format {
            Some(format!("the format is `{}`, and should be `{}`", found.format, self.format))
        } else if found.typelift != self.typelift {
            Some(format!("these runs are of typelift {}, and this is {}", found.typelift, self.typelift))
        } else if found.experiment != self.experiment {
            Some(format!("these runs are of the experiment `{}`, not of `{}`", found.experiment, self.experiment))
        } else if found.settings != self.settings {
            Some(format!("these runs were made with other settings: {}", changes(&found.settings, &self.settings)))
        } else {
            None
        }
    }
}

/// The settings that differ: `max_proposals was 4, and is 12`.
fn changes(was: &Value, is: &Value) -> String {
    let keys = [was, is].into_iter().filter_map(Value::as_object).flat_map(|settings| settings.keys());
    let mut keys: Vec<&String> = keys.filter(|key| was.get(key) != is.get(key)).collect();
    keys.sort();
    keys.dedup();
    let text = |value: Option<&Value>| value.map_or("not given".to_owned(), Value::to_string);
    let change = |key: &String| format!("{key} was {}, and is {}", text(was.get(key)), text(is.get(key)));
    keys.into_iter().map(change).collect::<Vec<_>>().join("; ")
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line<K, R> {
    run: K,
    result: R,
}

/// A run log that is being written.
#[derive(Debug)]
pub struct RunLog<K, R> {
    path: PathBuf,
    file: File,
    header: Header,
    finished: BTreeMap<K, R>,
    torn: bool,
}

impl<K, R> RunLog<K, R>
where
    K: Ord + Serialize + DeserializeOwned,
    R: Serialize + DeserializeOwned,
{
    /// Opens the log of a folder, which is made if it is not there; with `fresh`, without what was there.
    ///
    /// # Errors
    /// [`FileError`] if the folder cannot be written to, if another process is writing to it, if the runs there are of
    /// another experiment, version or settings, or if a line cannot be read. Nothing is changed then.
    pub fn open(folder: &Path, header: Header, fresh: bool) -> Result<Self, FileError> {
        create_dir_all(folder).map_err(|error| FileError::from_write(folder, &error))?;
        let path = folder.join(FILE_NAME);
        let failed = |error: io::Error| FileError::from_write(&path, &error);
        let mut options = OpenOptions::new();
        let mut file = options.read(true).write(true).create(true).truncate(false).open(&path).map_err(failed)?;
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return Err(FileError::new(&path, "another process is writing here")
                .with_hint("Wait until that is done, or write to another folder.".to_owned()));
        }
        let mut bytes = Vec::new();
        if !fresh {
            file.read_to_end(&mut bytes).map_err(failed)?;
        }
        // What follows the last line's end was being written when the program was killed.
        let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        let torn = whole < bytes.len();
        let finished = read_lines(&path, &bytes[..whole], &header)?;
        file.set_len(whole as u64).and_then(|()| file.seek(SeekFrom::End(0))).map_err(failed)?;
        remove_left_behind(folder);
        let mut log = Self { path, file, header, finished, torn };
        if whole == 0 {
            log.write(&json_line(&log.header))?;
        }
        Ok(log)
    }

    /// Whether an unfinished line was dropped.
    pub fn torn(&self) -> bool {
        self.torn
    }

    /// What is finished.
    pub fn finished(&self) -> &BTreeMap<K, R> {
        &self.finished
    }

    /// Adds a finished run.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be written.
    pub fn append(&mut self, run: K, result: R) -> Result<(), FileError> {
        let line = Line { run, result };
        self.write(&json_line(&line))?;
        self.finished.insert(line.run, line.result);
        Ok(())
    }

    /// Puts the lines in the order of the runs, and gives them.
    ///
    /// # Errors
    /// [`FileError`] if they cannot be written; the log stays as it was then.
    pub fn close(self) -> Result<BTreeMap<K, R>, FileError> {
        let mut text = json_line(&self.header);
        for (run, result) in &self.finished {
            text += &json_line(&Line { run, result });
        }
        write_file(&self.path, text.as_bytes())?;
        Ok(self.finished)
    }

    fn write(&mut self, line: &str) -> Result<(), FileError> {
        self.file.write_all(line.as_bytes()).map_err(|error| FileError::from_write(&self.path, &error))
    }
}

/// The runs below a header that is the right one.
fn read_lines<K, R>(path: &Path, bytes: &[u8], header: &Header) -> Result<BTreeMap<K, R>, FileError>
where
    K: Ord + DeserializeOwned,
    R: DeserializeOwned,
{
    let mut finished = BTreeMap::new();
    let mut lines = bytes.split_inclusive(|byte| *byte == b'\n').enumerate();
    let Some((_, first)) = lines.next() else {
        return Ok(finished);
    };
    let found: Header = serde_json::from_slice(first).map_err(|_| {
        FileError::at_line(path, 1, "this is not the header of a run log").with_hint(OTHERWISE.to_owned())
    })?;
    if let Some(difference) = header.difference(&found) {
        return Err(FileError::at_line(path, 1, difference).with_hint(OTHERWISE.to_owned()));
    }
    for (index, line) in lines {
        let damaged = |what: String| {
            FileError::at_line(path, index + 1, what).with_hint(
                "Somebody changed the file. Remove the line, and its run is repeated; or begin again with --fresh."
                    .to_owned(),
            )
        };
        let Line { run, result } = serde_json::from_slice(line)
            .map_err(|error| damaged(format!("this is not a run: {}", json_message(&error))))?;
        if finished.insert(run, result).is_some() {
            return Err(damaged("this run is here twice".to_owned()));
        }
    }
    Ok(finished)
}

fn json_line(value: &impl Serialize) -> String {
    // Runs and results are structs, numbers and text, which always become JSON.
    let mut line = serde_json::to_string(value).unwrap_or_default();
    line.push('\n');
    line
}

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::json;

    use super::*;

    type Log = RunLog<u32, String>;

    fn header() -> Header {
        Header::new("counting", json!({"most": 3}))
    }

    fn error(folder: &Path, header: Header) -> String {
        let before = fs::read(folder.join(FILE_NAME)).expect("a log");
        let error = Log::open(folder, header, false).expect_err("it is refused");
        assert_eq!(fs::read(folder.join(FILE_NAME)).expect("a log"), before, "nothing is changed");
        assert!(error.hint.is_some());
        format!("{}{}", error.line.map(|line| format!("{line}: ")).unwrap_or_default(), error.what)
    }

    fn with_two_runs(folder: &Path) {
        let mut log = Log::open(folder, header(), false).expect("a log");
        for run in [2, 1] {
            log.append(run, format!("run {run}")).expect("written");
        }
    }

    #[test]
    fn what_was_finished_is_there_again_and_in_order() {
        let folder = tempfile::tempdir().expect("a folder");
        with_two_runs(folder.path());
        let log = Log::open(folder.path(), header(), false).expect("a log");
        assert!(!log.torn());
        let finished = log.close().expect("written");
        assert_eq!(finished.into_iter().collect::<Vec<_>>(), [(1, "run 1".to_owned()), (2, "run 2".to_owned())]);
        let text = fs::read_to_string(folder.path().join(FILE_NAME)).expect("a log");
        assert_eq!(
            text.lines().skip(1).collect::<Vec<_>>(),
            [r#"{"run":1,"result":"run 1"}"#, r#"{"run":2,"result":"run 2"}"#]
        );
        assert!(Log::open(folder.path(), header(), true).expect("a log").finished().is_empty());
    }

    #[test]
    fn wherever_a_log_is_cut_off_whole_lines_are_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        with_two_runs(folder.path());
        let path = folder.path().join(FILE_NAME);
        let whole = fs::read(&path).expect("a log");
        fs::write(folder.path().join(".table.csv.17-0.tmp"), "half").expect("written");
        for cut in 0..=whole.len() {
            fs::write(&path, &whole[..cut]).expect("written");
            let ends = whole[..cut].iter().filter(|byte| **byte == b'\n').count();
            let mut log = Log::open(folder.path(), header(), false).expect("a log");
            assert_eq!(log.finished().len(), ends.saturating_sub(1), "cut at {cut}");
            assert_eq!(log.torn(), cut > 0 && whole[cut - 1] != b'\n', "cut at {cut}");
            for run in [1, 2] {
                if !log.finished().contains_key(&run) {
                    log.append(run, format!("run {run}")).expect("written");
                }
            }
            assert_eq!(log.close().expect("written").len(), 2);
            assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing is left behind");
        }
    }

    #[test]
    fn what_is_not_ours_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        with_two_runs(folder.path());
        let other = Header { typelift: "0.0.9".to_owned(), ..header() };
        let version = env!("CARGO_PKG_VERSION");
        assert_eq!(error(folder.path(), other), format!("1: these runs are of typelift {version}, and this is 0.0.9"));
        let other = Header::new("dreaming", json!({"most": 3}));
        assert_eq!(error(folder.path(), other), "1: these runs are of the experiment `counting`, not of `dreaming`");
        let other = Header::new("counting", json!({"most": 4, "least": 1}));
        assert_eq!(
            error(folder.path(), other),
            "1: these runs were made with other settings: least was not given, and is 1; most was 3, and is 4"
        );
        let path = folder.path().join(FILE_NAME);
        let good = fs::read_to_string(&path).expect("a log");
        for (damaged, message) in [
            (good.replace("\"run\":2", "\"run\":"), "2: this is not a run: this is not JSON: expected value"),
            (good.replace("\"run\":1", "\"run\":2"), "3: this run is here twice"),
            (format!("{good}\0\0\n"), "4: this is not a run: this is not JSON: expected value"),
            ("{}\n".to_owned(), "1: this is not the header of a run log"),
        ] {
            fs::write(&path, damaged).expect("written");
            assert_eq!(error(folder.path(), header()), message);
        }
    }

    #[test]
    fn two_cannot_write_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let _first = Log::open(folder.path(), header(), false).expect("a log");
        // What is locked cannot even be read on Windows.
        let second = Log::open(folder.path(), header(), false).expect_err("it is refused");
        assert_eq!(second.what, "another process is writing here");
    }
}
