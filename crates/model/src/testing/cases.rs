//! How many random cases a law is tried with.

use proptest::test_runner::Config;

/// The number that proptest takes where no other is set.
const USUAL: u64 = 256;

/// So many cases usually. `PROPTEST_CASES` makes them more or less in proportion: with 2560, ten times the usual 256, each
/// law is tried with ten times as many. No file remembers what failed: a finding becomes a test.
pub fn cases(usually: u32) -> Config {
    let config = Config { failure_persistence: None, ..Config::default() };
    let cases = u64::from(usually) * u64::from(config.cases) / USUAL;
    Config { cases: u32::try_from(cases).unwrap_or(u32::MAX).max(1), ..config }
}
