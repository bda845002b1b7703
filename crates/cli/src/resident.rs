//! How much memory the program holds, as the system tells: on Linux, macOS and Windows.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use typelift::model::MemoryProbe;

/// The last answer is repeated for so long, since the system takes a few microseconds for one.
const INTERVAL: Duration = Duration::from_millis(1);

/// Tells how many bytes of resident memory the program holds above those that it holds now, so that what came before does
/// not count; 0 where the system does not tell.
pub(crate) fn memory_held_from_now() -> MemoryProbe {
    let begun = Instant::now();
    let before = resident();
    // When the system is asked again, in microseconds from the beginning, and what it said.
    let (next, last) = (AtomicU64::new(0), AtomicU64::new(0));
    Arc::new(move || {
        let now = begun.elapsed().as_micros() as u64;
        if now >= next.load(Ordering::Relaxed) {
            next.store(now + INTERVAL.as_micros() as u64, Ordering::Relaxed);
            last.store(resident().saturating_sub(before), Ordering::Relaxed);
        }
        last.load(Ordering::Relaxed)
    })
}

fn resident() -> u64 {
    memory_stats::memory_stats().map_or(0, |stats| stats.physical_mem as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn what_came_before_does_not_count() {
        const MEGABYTE: usize = 1 << 20;
        let earlier = vec![1_u8; 64 * MEGABYTE];
        let probe = memory_held_from_now();
        assert!(probe() < 16 * MEGABYTE as u64, "{}", probe());
        let later = vec![1_u8; 32 * MEGABYTE];
        std::thread::sleep(2 * INTERVAL);
        let held = probe();
        assert!((24 * MEGABYTE as u64..48 * MEGABYTE as u64).contains(&held), "{held}");
        assert_eq!(earlier.iter().chain(&later).map(|byte| usize::from(*byte)).sum::<usize>(), 96 * MEGABYTE);
    }
}
