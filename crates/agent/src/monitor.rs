//! The effect check: what an action changed against what it was expected to change.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use typelift_model::{GroundAction, GroundAtom, State};
use typelift_world::Verdict;

/// What came of a step of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepResult {
    /// It was carried out, or tried; the states around it say what came of that.
    Tried(Verdict),
    /// A person rejected it before it was executed: no verdict of the world.
    Rejected,
}

impl StepResult {
    /// Every result.
    pub const ALL: [Self; 7] = [
        Self::Tried(Verdict::AsExpected),
        Self::Tried(Verdict::Nothing),
        Self::Tried(Verdict::Partly),
        Self::Tried(Verdict::Otherwise),
        Self::Tried(Verdict::Refused),
        Self::Tried(Verdict::TimedOut),
        Self::Rejected,
    ];

    /// A short phrase for it.
    pub fn phrase(self) -> &'static str {
        match self {
            Self::Tried(Verdict::AsExpected) => "as expected",
            Self::Tried(Verdict::Nothing) => "nothing changed",
            Self::Tried(Verdict::Partly) => "only part of the expected effect happened",
            Self::Tried(Verdict::Otherwise) => "something else happened",
            Self::Tried(Verdict::Refused) => "refused",
            Self::Tried(Verdict::TimedOut) => "timed out",
            Self::Rejected => "rejected",
        }
    }

    /// The word for it wherever a program reads it: the verdict's own, as traces have it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Tried(verdict) => verdict.word(),
            Self::Rejected => "rejected",
        }
    }
}

impl Serialize for StepResult {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for StepResult {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "StepResult".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let words: Vec<&str> = Self::ALL.iter().map(|result| result.word()).collect();
        schemars::json_schema!({ "description": "What came of a step.", "type": "string", "enum": words })
    }
}

impl<'de> Deserialize<'de> for StepResult {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        let mut results = Self::ALL.into_iter();
        results
            .find(|result| result.word() == word)
            .ok_or_else(|| de::Error::custom(format!("no result is called `{word}`")))
    }
}

/// Compares an executed action with the states around it.
///
/// Every atom of the expected effect must be in the observed change; additional changes are tolerated. Every effect
/// of a learned action was a change when it was observed, so `strict_effects` expects each to be a change now; for
/// given actions only what would change is expected. An atom that is unknown before or after counts neither way.
pub fn compare(action: &GroundAction, before: &State, after: &State, strict_effects: bool) -> Verdict {
    let wanted = |atom: &&GroundAtom, adds: bool| {
        let known = !before.is_unknown(atom) && !after.is_unknown(atom);
        known && (strict_effects || before.holds(atom) != adds)
    };
    let added = |atom: &GroundAtom| !before.holds(atom) && after.holds(atom);
    let deleted = |atom: &GroundAtom| before.holds(atom) && !after.holds(atom);
    let adds: Vec<bool> = action.adds.iter().filter(|a| wanted(a, true)).map(added).collect();
    let deletes: Vec<bool> = action.deletes.iter().filter(|a| wanted(a, false)).map(deleted).collect();
    let observed: Vec<bool> = adds.into_iter().chain(deletes).collect();
    if observed.iter().all(|&seen| seen) {
        Verdict::AsExpected
    } else if before.objects == after.objects && before.added(after).chain(before.deleted(after)).next().is_none() {
        Verdict::Nothing
    } else if observed.iter().any(|&seen| seen) {
        Verdict::Partly
    } else {
        Verdict::Otherwise
    }
}
