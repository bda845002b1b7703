//! The time that this thread spent on a processor, so that whatever else the machine does counts little.

use std::time::Instant;

/// A stopwatch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stopwatch {
    begun: Instant,
    spent_before: Option<f64>,
}

impl Stopwatch {
    /// Begins now.
    pub(crate) fn start() -> Self {
        Self { begun: Instant::now(), spent_before: spent() }
    }

    /// Seconds since then on a processor; on the clock where the system does not tell.
    pub(crate) fn seconds(self) -> f64 {
        match spent().zip(self.spent_before) {
            Some((now, before)) => now - before,
            None => self.begun.elapsed().as_secs_f64(),
        }
    }
}

/// Seconds that this thread has run.
#[cfg(unix)]
fn spent() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

#[cfg(not(unix))]
fn spent() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn work_takes_time() {
        let watch = Stopwatch::start();
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_millis(30) {}
        let seconds = watch.seconds();
        assert!(seconds > 0.0 && seconds < begun.elapsed().as_secs_f64() + 0.02, "{seconds}");
    }

    #[cfg(unix)]
    #[test]
    fn sleep_takes_none() {
        let watch = Stopwatch::start();
        std::thread::sleep(Duration::from_millis(50));
        assert!(watch.seconds() < 0.04);
    }
}
