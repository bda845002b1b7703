//! How task files and the headers of traces write a goal: a list of texts, `on(cup_1,tray_1)` for an atom that must hold
//! in the end, `not on(cup_1,tray_1)` for one that must not. A predicate `not` is no exception: `not(a)` is an atom of it.

use std::fmt;

use serde::de::{self, DeserializeSeed, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeSeq, Serializer};
use typelift_model::{AtomTextError, Goal, GroundAtom, OtherNotation};

/// What stands before an atom that must not hold.
const NOT: &str = "not";

/// A goal, to be written.
#[derive(Debug, Clone, Copy)]
pub struct WrittenGoal<'a>(pub &'a Goal);

impl Serialize for WrittenGoal<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(goal) = self;
        let mut texts = serializer.serialize_seq(Some(goal.required.len() + goal.forbidden.len()))?;
        for (atom, positive) in goal.literals() {
            texts.serialize_element(&atom.as_goal(positive))?;
        }
        texts.end()
    }
}

/// Reads the list; an atom that must hold and must not is an error at its second place.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Goal, D::Error> {
    deserializer.deserialize_seq(Texts)
}

struct Texts;

impl<'de> Visitor<'de> for Texts {
    type Value = Goal;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequence")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut texts: A) -> Result<Goal, A::Error> {
        let mut goal = Goal::default();
        while texts.next_element_seed(Next(&mut goal))?.is_some() {}
        Ok(goal)
    }
}

/// Adds what is read next to a goal.
struct Next<'g>(&'g mut Goal);

impl<'de> DeserializeSeed<'de> for Next<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        let (atom, positive) =
            literal(&<String as de::Deserialize>::deserialize(deserializer)?).map_err(D::Error::custom)?;
        let Goal { required, forbidden } = self.0;
        let (wanted, opposite) = if positive { (required, forbidden) } else { (forbidden, required) };
        if opposite.contains(&atom) {
            return Err(D::Error::custom(format!(
                "the goal contradicts itself: it has `{atom}` and `{}`",
                atom.as_goal(false)
            )));
        }
        wanted.push(atom);
        Ok(())
    }
}

/// An atom, and whether it must hold.
fn literal(text: &str) -> Result<(GroundAtom, bool), AtomTextError> {
    // No name holds white space, so that what is an atom is no negated one.
    GroundAtom::parse(text).map(|atom| (atom, true)).or_else(|error| {
        let negated = text.trim_start().strip_prefix(NOT).filter(|rest| rest.starts_with(char::is_whitespace));
        negated.and_then(|rest| GroundAtom::parse(rest).ok()).map(|atom| (atom, false)).ok_or(error)
    })
}

/// How to write a goal of a task or header whose text was refused with this error, if the error is about one that may be
/// meant otherwise.
pub(crate) fn hint(error: &serde_json::Error, text: &str) -> Option<String> {
    #[derive(serde::Deserialize)]
    struct Goals {
        goal: Vec<String>,
    }
    #[derive(serde::Deserialize)]
    struct OneGoal {
        goal: String,
    }
    if let Ok(OneGoal { goal }) = serde_json::from_str(text) {
        let listed = serde_json::to_string(&[goal]).ok()?;
        return Some(format!("A goal is a list, even of one atom: write {listed}."));
    }
    let Ok(Goals { goal }) = serde_json::from_str(text) else { return as_text(text) };
    let (text, wrong) = goal.iter().find_map(|text| Some((text, literal(text).err()?)))?;
    let is_about_it = error.to_string().starts_with(&wrong.to_string());
    is_about_it.then(|| OtherNotation::of(text)).flatten().map(|other| other.hint())
}

/// How to write a goal that is an object, or a list of lists or objects: `{"on":["a","b"]}` and `["on","a","b"]` are `on(a,b)`.
fn as_text(text: &str) -> Option<String> {
    #[derive(serde::Deserialize)]
    struct AnyGoal {
        goal: serde_json::Value,
    }
    let AnyGoal { goal } = serde_json::from_str(text).ok()?;
    let atoms = match goal {
        serde_json::Value::Array(atoms) => atoms.iter().map(written).collect::<Option<Vec<_>>>()?,
        object => vec![written(&object)?],
    };
    let listed = serde_json::to_string(&atoms.concat()).ok()?;
    Some(format!("A goal is a list of texts: write {listed}."))
}

/// The atoms that a value stands for, if it is one that others write atoms with.
fn written(value: &serde_json::Value) -> Option<Vec<String>> {
    let atom = |predicate: &str, args: &[serde_json::Value]| {
        let args = args.iter().map(serde_json::Value::as_str).collect::<Option<Vec<_>>>()?;
        let text = format!("{predicate}({})", args.join(","));
        literal(&text).is_ok().then_some(text)
    };
    match value {
        serde_json::Value::String(text) => literal(text).is_ok().then(|| vec![text.clone()]),
        serde_json::Value::Array(words) => {
            let (predicate, args) = words.split_first()?;
            Some(vec![atom(predicate.as_str()?, args)?])
        }
        serde_json::Value::Object(pairs) => {
            let atoms = pairs.iter().map(|(predicate, args)| match args {
                serde_json::Value::Array(args) => atom(predicate, args),
                one => atom(predicate, std::slice::from_ref(one)),
            });
            atoms.collect()
        }
        _ => None,
    }
}

/// Nothing is asked for: what a header says that has no goal.
#[cfg(feature = "schema")]
impl Default for WrittenGoal<'_> {
    fn default() -> Self {
        static NOTHING: Goal = Goal { required: Vec::new(), forbidden: Vec::new() };
        Self(&NOTHING)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for WrittenGoal<'_> {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "GoalTexts".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "type": "array",
            "items": {
                "type": "string",
                "description": "predicate(arg,arg) must hold, not predicate(arg,arg) must not",
                "pattern": r"^(not\s+)?[^\s(),;]+(\([^()]*\))?$"
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read() {
        let read = |text: &str| literal(text).map(|(atom, positive)| (atom.to_string(), positive)).ok();
        let atom = |text: &str, positive| Some((text.to_owned(), positive));
        for (text, expected) in [
            ("on(a,b)", atom("on(a,b)", true)),
            ("not on(a,b)", atom("on(a,b)", false)),
            (" not \t on ( a , b ) ", atom("on(a,b)", false)),
            ("not dark", atom("dark()", false)),
            // A predicate may be called so.
            ("not", atom("not()", true)),
            ("not(a)", atom("not(a)", true)),
            ("not (a)", atom("not(a)", true)),
            ("not not(a)", atom("not(a)", false)),
            ("nothing(a)", atom("nothing(a)", true)),
            ("not not on(a)", None),
            ("Not on(a)", None),
            ("noton (a", None),
            ("not (on(a))", None),
            ("not ", atom("not()", true)),
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
    }
}
