//! The effect check: what an action changed against what it was expected to change.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use typelift_model::{ActionModel, GroundAction, GroundAtom, State};
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

    /// What came of a step, in words: where only part of the expected effect happened, with what of it is missing and
    /// what happened; where something else did, with what.
    pub fn in_words(self, missed: &[String], added: &[GroundAtom], deleted: &[GroundAtom]) -> String {
        let told = match self {
            Self::Tried(Verdict::Partly) => {
                vec![told("missing", missed), told("added", added), told("deleted", deleted)]
            }
            Self::Tried(Verdict::Otherwise) => vec![told("added", added), told("deleted", deleted)],
            _ => Vec::new(),
        };
        let told: Vec<String> = told.into_iter().flatten().collect();
        match told.is_empty() {
            true => self.phrase().to_owned(),
            false => format!("{} ({})", self.phrase(), told.join("; ")),
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

/// Atoms that are told of before it is said how many more there are.
const MOST_TOLD: usize = 6;

/// `added: on(a,b), lit(c)`; nothing if there is nothing.
fn told(what: &str, atoms: &[impl ToString]) -> Option<String> {
    let named: Vec<String> = atoms.iter().take(MOST_TOLD).map(ToString::to_string).collect();
    let more = match atoms.len() - named.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    (!named.is_empty()).then(|| format!("{what}: {}{more}", named.join(", ")))
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

/// What came of an action, and what of its expected effect did not happen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// What came of it.
    pub verdict: Verdict,
    /// The literals that did not come about: what was to hold, then what was to hold no longer.
    pub missed: Vec<String>,
}

/// Compares an executed action with the states around it.
///
/// Every atom of the expected effect must be in the observed change; additional changes are tolerated. Every effect
/// of a learned action was a change when it was observed, so `strict_effects` expects each to be a change now; for
/// given actions only what would change is expected. An atom that is unknown before or after counts neither way. Nor does
/// one that the model does not speak of count as a change: whatever it is, no action is about it.
pub fn compare(
    action: &GroundAction,
    before: &State,
    after: &State,
    strict_effects: bool,
    model: &ActionModel,
) -> Comparison {
    let wanted = |atom: &&GroundAtom, adds: bool| {
        let known = !before.is_unknown(atom) && !after.is_unknown(atom);
        known && (strict_effects || before.holds(atom) != adds)
    };
    let added = |atom: &GroundAtom| !before.holds(atom) && after.holds(atom);
    let deleted = |atom: &GroundAtom| before.holds(atom) && !after.holds(atom);
    let adds: Vec<&GroundAtom> = action.adds.iter().filter(|atom| wanted(atom, true)).collect();
    let deletes: Vec<&GroundAtom> = action.deletes.iter().filter(|atom| wanted(atom, false)).collect();
    let not_added = adds.iter().filter(|atom| !added(atom)).map(ToString::to_string);
    let not_deleted = deletes.iter().filter(|atom| !deleted(atom)).map(|atom| format!("not {atom}"));
    let missed: Vec<String> = not_added.chain(not_deleted).collect();
    let spoken_of = |atom: &GroundAtom| model.predicates.contains_key(&atom.predicate);
    let verdict = if missed.is_empty() {
        Verdict::AsExpected
    } else if before.objects == after.objects && !before.added(after).chain(before.deleted(after)).any(spoken_of) {
        Verdict::Nothing
    } else if missed.len() < adds.len() + deletes.len() {
        Verdict::Partly
    } else {
        Verdict::Otherwise
    };
    Comparison { verdict, missed }
}

#[cfg(test)]
mod tests {
    use typelift_model::{ActionSchema, Cost, Effect, Hierarchy, LiftedAtom, LiftedCall, Literal, Provenance, Symbol};

    use super::*;

    fn state(atoms: &[&str]) -> State {
        let atoms = atoms.iter().map(|text| GroundAtom::parse(text).expect("an atom")).collect();
        State { atoms, ..State::default() }
    }

    #[test]
    fn what_came_of_a_step_says_what_is_missing_or_what_happened_instead() {
        let atoms = |n: usize| (0..n).map(|i| GroundAtom::new("lit", vec![Symbol::from(format!("l{i}"))])).collect();
        let (few, many): (Vec<GroundAtom>, Vec<GroundAtom>) = (atoms(1), atoms(9));
        let missed = ["shut()".to_owned(), "not lit(l0)".to_owned()];
        let said = |verdict, added: &[GroundAtom], deleted: &[GroundAtom]| {
            StepResult::Tried(verdict).in_words(&missed, added, deleted)
        };
        assert_eq!(
            said(Verdict::Partly, &few, &few),
            "only part of the expected effect happened (missing: shut(), not lit(l0); added: lit(l0); deleted: lit(l0))"
        );
        assert_eq!(said(Verdict::Otherwise, &few, &[]), "something else happened (added: lit(l0))");
        assert_eq!(
            said(Verdict::Otherwise, &few, &many),
            "something else happened (added: lit(l0); deleted: lit(l0), lit(l1), lit(l2), lit(l3), lit(l4), lit(l5) and 3 more)"
        );
        assert_eq!(said(Verdict::Otherwise, &[], &[]), "something else happened", "an entity came or went");
        assert_eq!(said(Verdict::Nothing, &[], &[]), "nothing changed");
    }

    #[test]
    fn what_did_not_come_about_is_named() {
        let effect =
            |text, positive| Effect::always(Literal { atom: LiftedAtom::parse(text).expect("an atom"), positive });
        let schema = ActionSchema {
            name: Symbol::new("unload"),
            call: LiftedCall { name: Symbol::new("unload"), args: Vec::new() },
            parameters: Vec::new(),
            preconditions: Vec::new(),
            distinct: Vec::new(),
            effects: vec![effect("empty()", true), effect("lit()", true), effect("shut()", false)],
            cost: Cost::UNIT,
            strict: true,
            named_by_call: false,
            provenance: Provenance::Given,
        };
        let before = state(&["shut()"]);
        let action = schema.instantiate(&[], &before, &Hierarchy::default()).expect("it fits");
        let predicates = ["empty", "lit", "more", "shut"].map(|name| (Symbol::new(name), Vec::new()));
        let model = ActionModel { predicates: predicates.into(), ..ActionModel::default() };
        let cases: [(&[&str], Verdict, &[&str]); 5] = [
            (&["empty()", "lit()", "more()"], Verdict::AsExpected, &[]),
            (&["empty()", "shut()"], Verdict::Partly, &["lit()", "not shut()"]),
            (&["shut()"], Verdict::Nothing, &["empty()", "lit()", "not shut()"]),
            (&["shut()", "more()"], Verdict::Otherwise, &["empty()", "lit()", "not shut()"]),
            (&["shut()", "unheard_of()"], Verdict::Nothing, &["empty()", "lit()", "not shut()"]),
        ];
        for (after, verdict, missed) in cases {
            let found = compare(&action, &before, &state(after), true, &model);
            assert_eq!((found.verdict, found.missed), (verdict, missed.iter().map(ToString::to_string).collect()));
        }
    }
}
