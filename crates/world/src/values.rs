//! Reading the values of attributes and relations. What stands there decides what it is; there are many of them, so nothing
//! is tried and taken back.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use typelift_model::Symbol;

use crate::{Relation, Value};

const NO_VALUE: &str = "an attribute is true, false, a word, a number or a list of numbers";
const NO_RELATION: &str = "a relation is to an entity's name, null or a list of names";

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ValueVisitor)
    }
}

struct ValueVisitor;

impl<'de> Visitor<'de> for ValueVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("true, false, a word, a number or a list of numbers")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::Number(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Value::Number(value))
    }

    fn visit_str<E>(self, word: &str) -> Result<Value, E> {
        Ok(Value::Text(Symbol::new(word)))
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Err(E::custom(NO_VALUE))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Value, A::Error> {
        let mut numbers = Vec::new();
        while let Some(element) = access.next_element()? {
            let Value::Number(number) = element else { return Err(A::Error::custom(NO_VALUE)) };
            numbers.push(number);
        }
        Ok(Value::Vector(numbers))
    }

    fn visit_map<A: MapAccess<'de>>(self, access: A) -> Result<Value, A::Error> {
        pass_over(access)?;
        Err(A::Error::custom(NO_VALUE))
    }
}

impl<'de> Deserialize<'de> for Relation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RelationVisitor)
    }
}

struct RelationVisitor;

impl<'de> Visitor<'de> for RelationVisitor {
    type Value = Relation;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of an entity, null or a list of names")
    }

    fn visit_str<E>(self, name: &str) -> Result<Relation, E> {
        Ok(Relation::One(Some(Symbol::new(name))))
    }

    fn visit_unit<E>(self) -> Result<Relation, E> {
        Ok(Relation::One(None))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Relation, A::Error> {
        let mut names = Vec::new();
        while let Some(element) = access.next_element()? {
            let Relation::One(Some(name)) = element else { return Err(A::Error::custom(NO_RELATION)) };
            names.push(name);
        }
        Ok(Relation::Many(names))
    }

    fn visit_map<A: MapAccess<'de>>(self, access: A) -> Result<Relation, A::Error> {
        pass_over(access)?;
        Err(A::Error::custom(NO_RELATION))
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<Relation, E> {
        Err(E::custom(NO_RELATION))
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<Relation, E> {
        Err(E::custom(NO_RELATION))
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<Relation, E> {
        Err(E::custom(NO_RELATION))
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<Relation, E> {
        Err(E::custom(NO_RELATION))
    }
}

/// Reads an object to its end: what is wrong inside of it is told first.
fn pass_over<'de, A: MapAccess<'de>>(mut access: A) -> Result<(), A::Error> {
    while access.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(json: &str) -> Result<Value, String> {
        serde_json::from_str(json).map_err(|error| crate::json::message(&error))
    }

    fn relation(json: &str) -> Result<Relation, String> {
        serde_json::from_str(json).map_err(|error| crate::json::message(&error))
    }

    #[test]
    fn what_stands_there_decides() {
        assert_eq!(value("true"), Ok(Value::Bool(true)));
        assert_eq!(value("\"a \\u00e9\""), Ok(Value::Text(Symbol::new("a é"))));
        for (json, number) in
            [("3", 3.0), ("-3", -3.0), ("0.5", 0.5), ("18446744073709551615", 18_446_744_073_709_551_615.0)]
        {
            assert_eq!(value(json), Ok(Value::Number(number)));
        }
        assert_eq!(value("[1, -2, 0.5]"), Ok(Value::Vector(vec![1.0, -2.0, 0.5])));
        assert_eq!(value("[]"), Ok(Value::Vector(Vec::new())));
        assert_eq!(relation("null"), Ok(Relation::One(None)));
        assert_eq!(relation("\"a\""), Ok(Relation::One(Some(Symbol::new("a")))));
        assert_eq!(relation("[\"a\", \"b\"]"), Ok(Relation::Many(vec![Symbol::new("a"), Symbol::new("b")])));
    }

    #[test]
    fn what_is_neither_is_refused_in_words() {
        for json in ["null", "{}", "{\"x\": 1}", "[true]", "[\"a\"]", "[[1]]", "[null]"] {
            assert_eq!(value(json), Err(NO_VALUE.to_owned()), "{json}");
        }
        for json in ["true", "1", "-1", "0.5", "{}", "[null]", "[1]", "[[\"a\"]]"] {
            assert_eq!(relation(json), Err(NO_RELATION.to_owned()), "{json}");
        }
        assert!(value("[1,]").is_err_and(|message| message.contains("this is not JSON")));
        assert!(relation("{\"a\" 1}").is_err_and(|message| message.contains("this is not JSON")));
    }

    #[test]
    fn what_was_written_is_read_again() {
        for written in
            [Value::Bool(false), Value::Number(-0.25), Value::Text("hot".into()), Value::Vector(vec![1.5, 2.0])]
        {
            let json = serde_json::to_string(&written).expect("JSON");
            assert_eq!(value(&json), Ok(written));
        }
    }
}
