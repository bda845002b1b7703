//! What a run may spend: expansions and proposals, so that results repeat, and seconds as a safety net.

use std::fmt;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use typelift::model::{Budget, Stop};

/// Asked now and then whether to stop.
pub type Stopper = Arc<dyn Fn() -> bool + Send + Sync>;

/// What a run may spend.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Expansions of one search.
    pub max_expansions: u64,
    /// Plans proposed.
    pub max_proposals: u64,
    /// Seconds, as a safety net: a run that it ends depends on the machine.
    pub seconds: f64,
}

impl Limits {
    /// The limits as a budget that begins now.
    pub fn budget(&self, stopper: &Stopper) -> Budget {
        // What cannot be a duration is longer than anybody waits.
        let limit = Duration::try_from_secs_f64(self.seconds).unwrap_or(Duration::MAX);
        let (begun, stopper) = (Instant::now(), Arc::clone(stopper));
        let stop = move || {
            if stopper() { Some(Stop::Cancelled) } else { (begun.elapsed() >= limit).then_some(Stop::Time) }
        };
        Budget { expansions: Some(self.max_expansions), memory: None, stop: Some(Arc::new(stop)) }
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { max_expansions, max_proposals, seconds } = self;
        write!(f, "at most {max_expansions} expansions a search, {max_proposals} proposals, {seconds} s")
    }
}
