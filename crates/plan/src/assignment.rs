//! Variables and their values.

/// The value of each variable.
pub(crate) type Values = [u32];

/// A variable's value: the fact that it stands for holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Assignment {
    pub(crate) variable: u32,
    pub(crate) value: u32,
}

impl Assignment {
    pub(crate) fn holds(self, values: &Values) -> bool {
        values[self.variable as usize] == self.value
    }
}

/// What a fact is in a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// It holds in every state.
    Always,
    /// It holds in none.
    Never,
    /// It is this variable's value.
    At(Assignment),
}
