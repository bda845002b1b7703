//! How long an environment may take.

use std::time::Duration;

/// How long an environment may take for each kind of request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Options {
    /// To start and to say who it is: 10 s.
    pub hello: Duration,
    /// To set up an initial state: 60 s.
    pub reset: Duration,
    /// To observe: 10 s.
    pub observe: Duration,
    /// To act, until the world has settled: 300 s.
    pub act: Duration,
    /// To answer that it ends, and to end: 2 s. After that it is killed.
    pub close: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            hello: Duration::from_secs(10),
            reset: Duration::from_secs(60),
            observe: Duration::from_secs(10),
            act: Duration::from_secs(300),
            close: Duration::from_secs(2),
        }
    }
}

impl Options {
    /// The time for a request, by the name of its operation.
    pub(crate) fn limit(&self, op: &str) -> Duration {
        match op {
            "hello" => self.hello,
            "reset" => self.reset,
            "observe" => self.observe,
            "act" => self.act,
            _ => self.close,
        }
    }
}
