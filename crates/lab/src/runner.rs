//! Carries out the runs of an experiment: in parallel, skipping what is finished, and logging each as it finishes.
//! What comes out is ordered by the runs, not by when they finished.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::ThreadPoolBuilder;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::error::LabError;
use crate::limits::Stopper;
use crate::run_log::{Header, RunLog};

/// An experiment: runs that do not depend on each other.
pub trait Experiment: Sync {
    /// Its name.
    const NAME: &'static str;
    /// What tells a run from the others.
    type Run: Ord + Clone + Display + Serialize + DeserializeOwned + Send + Sync;
    /// What comes of a run.
    type Record: Clone + Serialize + DeserializeOwned + Send;

    /// Everything but the run and the version of typelift that a record depends on.
    fn settings(&self) -> Value;

    /// The runs.
    fn runs(&self) -> Vec<Self::Run>;

    /// How long a run takes compared with others, roughly. The longest are begun first.
    fn weight(&self, _run: &Self::Run) -> u64 {
        1
    }

    /// Carries out one; `None` if it was stopped.
    ///
    /// # Errors
    /// [`LabError::Run`] for a defect.
    fn run(&self, run: &Self::Run, stopper: &Stopper) -> Result<Option<Self::Record>, LabError>;
}

/// Is told how far it is.
pub trait Progress: Sync {
    /// So many runs, of this weight together, are to be carried out; so many others were finished before.
    fn begun(&self, runs: usize, weight: u64, finished: usize) {
        let _ = (runs, weight, finished);
    }

    /// A run was begun.
    fn started(&self, run: &str) {
        let _ = run;
    }

    /// A run was finished, or stopped.
    fn ended(&self, run: &str, weight: u64) {
        let _ = (run, weight);
    }

    /// Something worth knowing.
    fn note(&self, text: &str) {
        let _ = text;
    }
}

/// Reports nothing.
impl Progress for () {}

/// Where and how runs are carried out.
#[derive(Clone)]
pub struct RunnerOptions<'a> {
    /// The folder of the run log and of the results.
    pub folder: &'a Path,
    /// Begin again: forget what is finished.
    pub fresh: bool,
    /// Runs at once.
    pub jobs: usize,
    /// Asked now and then whether to stop.
    pub stopper: Stopper,
    /// Is told how far it is.
    pub progress: &'a dyn Progress,
}

impl std::fmt::Debug for RunnerOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { folder, fresh, jobs, .. } = self;
        f.debug_struct("RunnerOptions")
            .field("folder", folder)
            .field("fresh", fresh)
            .field("jobs", jobs)
            .finish_non_exhaustive()
    }
}

/// The records of all runs of an experiment, from the run log or carried out now.
///
/// # Errors
/// [`LabError`] if the log is not this experiment's or cannot be written, if somebody stopped it, or for a defect. What
/// was finished before is in the log.
pub fn carry_out<E: Experiment>(
    experiment: &E,
    runner: &RunnerOptions<'_>,
) -> Result<BTreeMap<E::Run, E::Record>, LabError> {
    let header = Header::new(E::NAME, experiment.settings());
    let log: RunLog<E::Run, E::Record> = RunLog::open(runner.folder, header, runner.fresh)?;
    if log.torn() {
        runner.progress.note("the last line of the run log was not finished; its run is repeated");
    }
    let asked = experiment.runs();
    let mut missing: Vec<(u64, &E::Run)> =
        asked.iter().filter(|run| !log.finished().contains_key(run)).map(|run| (experiment.weight(run), run)).collect();
    missing.sort_by_key(|(weight, _)| std::cmp::Reverse(*weight));
    let weight = missing.iter().map(|(weight, _)| weight).sum();
    runner.progress.begun(missing.len(), weight, asked.len() - missing.len());
    let shared = Shared { experiment, runner, log: Mutex::new(log), failure: Mutex::new(None) };
    let threads = ThreadPoolBuilder::new().num_threads(runner.jobs);
    let pool = threads.build().map_err(|error| LabError::Threads(error.to_string()))?;
    pool.scope_fifo(|scope| {
        for (weight, run) in missing {
            let shared = &shared;
            scope.spawn_fifo(move |_| shared.carry_out(run, weight));
        }
    });
    shared.results(&asked)
}

/// What the threads share.
struct Shared<'a, E: Experiment> {
    experiment: &'a E,
    runner: &'a RunnerOptions<'a>,
    log: Mutex<RunLog<E::Run, E::Record>>,
    failure: Mutex<Option<LabError>>,
}

impl<E: Experiment> Shared<'_, E> {
    fn carry_out(&self, run: &E::Run, weight: u64) {
        if (self.runner.stopper)() || locked(&self.failure).is_some() {
            return;
        }
        let name = run.to_string();
        self.runner.progress.started(&name);
        let logged = self
            .experiment
            .run(run, &self.runner.stopper)
            .and_then(|record| record.map_or(Ok(()), |record| Ok(locked(&self.log).append(run.clone(), record)?)));
        if let Err(error) = logged {
            locked(&self.failure).get_or_insert(error);
        }
        self.runner.progress.ended(&name, weight);
    }

    fn results(self, asked: &[E::Run]) -> Result<BTreeMap<E::Run, E::Record>, LabError> {
        let failure = self.failure.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(error) = failure {
            return Err(error);
        }
        let log = self.log.into_inner().unwrap_or_else(PoisonError::into_inner);
        let finished = asked.iter().filter(|run| log.finished().contains_key(run)).count();
        if finished < asked.len() {
            return Err(LabError::Stopped { finished, total: asked.len() });
        }
        let records = log.close()?;
        Ok(asked.iter().filter_map(|run| Some((run.clone(), records.get(run)?.clone()))).collect())
    }
}

/// Nothing is left half done under these locks, so it does not matter whether somebody panicked.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use serde_json::json;

    use super::*;
    use crate::run_log::FILE_NAME;

    /// Squares numbers, and counts how often it was asked to; `bad` is one that cannot be squared.
    #[derive(Default)]
    struct Squares {
        carried_out: AtomicUsize,
        bad: Option<u64>,
    }

    impl Experiment for Squares {
        const NAME: &'static str = "squares";
        type Run = u64;
        type Record = u64;

        fn settings(&self) -> Value {
            json!({})
        }

        fn runs(&self) -> Vec<u64> {
            (0..20).collect()
        }

        fn weight(&self, run: &u64) -> u64 {
            *run
        }

        fn run(&self, run: &u64, stopper: &Stopper) -> Result<Option<u64>, LabError> {
            if self.bad == Some(*run) {
                return Err(LabError::Run { run: run.to_string(), message: "no".to_owned() });
            }
            self.carried_out.fetch_add(1, Ordering::SeqCst);
            Ok((!stopper()).then_some(run * run))
        }
    }

    fn runner(folder: &Path, stopper: Stopper) -> RunnerOptions<'_> {
        RunnerOptions { folder, fresh: false, jobs: 3, stopper, progress: &() }
    }

    #[test]
    fn finished_runs_are_not_repeated_and_the_log_is_the_same() {
        let folder = tempfile::tempdir().expect("a folder");
        let (undisturbed, stopped) = (folder.path().join("a"), folder.path().join("b"));
        let never: Stopper = Arc::new(|| false);
        let expected: BTreeMap<u64, u64> = (0..20).map(|n| (n, n * n)).collect();
        assert_eq!(carry_out(&Squares::default(), &runner(&undisturbed, never.clone())).expect("done"), expected);

        // Stopped again and again, after a few questions.
        let mut carried_out = 0;
        let mut attempts = 0;
        let results = loop {
            attempts += 1;
            let asked = AtomicUsize::new(0);
            let stopper: Stopper = Arc::new(move || asked.fetch_add(1, Ordering::SeqCst) > 8);
            let squares = Squares::default();
            match carry_out(&squares, &runner(&stopped, stopper)) {
                Ok(results) => break results,
                Err(LabError::Stopped { finished, total }) => assert!(finished > carried_out && total == 20),
                Err(error) => panic!("{error}"),
            }
            carried_out += 1;
        };
        assert!(attempts > 2, "{attempts}");
        assert_eq!(results, expected);
        let [a, b] = [&undisturbed, &stopped].map(|folder| fs::read(folder.join(FILE_NAME)).expect("a log"));
        assert_eq!(a, b);

        let again = Squares::default();
        carry_out(&again, &runner(&stopped, never)).expect("done");
        assert_eq!(again.carried_out.into_inner(), 0);
    }

    #[test]
    fn a_defect_ends_it_and_loses_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let never: Stopper = Arc::new(|| false);
        let bad = Squares { bad: Some(0), ..Squares::default() };
        let error = carry_out(&bad, &runner(folder.path(), never.clone())).expect_err("a defect");
        assert_eq!(error.to_string(), "0: no");
        let repaired = Squares::default();
        carry_out(&repaired, &runner(folder.path(), never)).expect("done");
        assert_eq!(repaired.carried_out.into_inner(), 1, "only what had failed");
    }
}
