//! How large a model may become.

/// Bounds of the compiler. The first two change what a model looks like, not what it means; beyond the others there is an
/// error.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// The cases that a condition may have before its disjunctions become derived predicates.
    pub(super) cases: usize,
    /// The literals that a quantified part of a goal may have when it is written out; a larger one stays quantified.
    pub(super) written_out: u64,
    /// The literals that a goal may have when it is written out.
    pub(super) goal: u64,
    /// The ways in which alternative types of the variables of one condition may be combined.
    pub(super) combinations: usize,
    /// The schemas that may come from one action.
    pub(super) schemas: usize,
    /// The effects that a schema may have.
    pub(super) effects: usize,
    /// The literals that may be gone through in all cases of all conditions, and what is added for each case.
    pub(super) literals: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            cases: 64,
            written_out: 100_000,
            goal: 1_000_000,
            combinations: 1_000,
            schemas: 1_000,
            effects: 100_000,
            literals: 3_000_000,
        }
    }
}
