//! Holds JSON values against the JSON Schemas in `docs/schemas`. It knows the keywords that these use, and panics at any
//! other, so that none is passed over.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value};

/// A schema of `docs/schemas`.
#[derive(Debug, Clone)]
pub struct Schema(Value);

impl Schema {
    /// The schema of this name.
    ///
    /// # Panics
    /// If there is none.
    pub fn named(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../docs/schemas/{name}.schema.json"));
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self(serde_json::from_str(&text).expect("JSON"))
    }

    /// That a value is as the schema says. Beyond the standard, an object whose properties are listed has no others.
    ///
    /// # Errors
    /// The first place where it is not, and what is expected there.
    pub fn check(&self, value: &Value) -> Result<(), String> {
        self.fits(&self.0, value, "", false)
    }

    /// `open` where the properties that are listed are not all.
    fn fits(&self, schema: &Value, value: &Value, at: &str, open: bool) -> Result<(), String> {
        let keywords = match schema {
            Value::Bool(true) => return Ok(()),
            Value::Object(keywords) => keywords,
            _ => return Err(format!("{at}: nothing is expected there, not {value}")),
        };
        let has = |keyword: &&str| keywords.contains_key(*keyword);
        let open = open || has(&"properties") && ["$ref", "oneOf", "anyOf"].iter().any(has);
        for (keyword, said) in keywords {
            let fits = match keyword.as_str() {
                "$ref" => {
                    let target = said.as_str().and_then(|pointer| self.0.pointer(pointer.trim_start_matches('#')));
                    self.fits(target.expect("what it refers to"), value, at, open)?;
                    true
                }
                "anyOf" => list(said).iter().any(|one| self.fits(one, value, at, open).is_ok()),
                "oneOf" => list(said).iter().filter(|one| self.fits(one, value, at, open).is_ok()).count() == 1,
                "type" => match said {
                    Value::Array(types) => types.iter().any(|ty| is_of_type(value, ty)),
                    ty => is_of_type(value, ty),
                },
                "const" => value == said,
                "enum" => list(said).contains(value),
                "minimum" => value.as_f64().is_none_or(|value| Some(value) >= said.as_f64()),
                "required" => value.as_object().is_none_or(|o| list(said).iter().all(|key| has_key(o, key))),
                "properties" => {
                    self.fit_properties(keywords, value, at, open)?;
                    true
                }
                "patternProperties" | "additionalProperties" if !keywords.contains_key("properties") => {
                    self.fit_properties(keywords, value, at, open)?;
                    true
                }
                "items" | "prefixItems" => {
                    self.fit_items(keywords, value, at)?;
                    true
                }
                "minItems" => value.as_array().is_none_or(|items| items.len() as u64 >= said.as_u64().unwrap_or(0)),
                "maxItems" => value.as_array().is_none_or(|items| items.len() as u64 <= said.as_u64().unwrap_or(0)),
                "uniqueItems" => list(value).iter().enumerate().all(|(i, one)| !list(value)[..i].contains(one)),
                "pattern" => value.as_str().zip(said.as_str()).is_none_or(|(text, pattern)| matches(pattern, text)),
                // For people.
                "format" | "description" | "title" | "default" | "$schema" | "$defs" => true,
                "patternProperties" | "additionalProperties" => true,
                other => panic!("`{other}` is not known here"),
            };
            if !fits {
                return Err(format!("{at}: {keyword} {said} does not fit {value}"));
            }
        }
        Ok(())
    }

    fn fit_properties(&self, schema: &Map<String, Value>, value: &Value, at: &str, open: bool) -> Result<(), String> {
        let (Some(object), none) = (value.as_object(), Map::new()) else { return Ok(()) };
        let listed = schema.get("properties").and_then(Value::as_object).unwrap_or(&none);
        let patterns = schema.get("patternProperties").and_then(Value::as_object).unwrap_or(&none);
        for (key, value) in object {
            let matching = patterns.iter().find(|(pattern, _)| matches(pattern, key)).map(|(_, schema)| schema);
            match listed.get(key).or(matching).or_else(|| schema.get("additionalProperties")) {
                Some(schema) => self.fits(schema, value, &format!("{at}/{key}"), false)?,
                None if open => {}
                None => return Err(format!("{at}: nothing is said of {key}")),
            }
        }
        Ok(())
    }

    fn fit_items(&self, schema: &Map<String, Value>, value: &Value, at: &str) -> Result<(), String> {
        let first = schema.get("prefixItems").map_or(&[][..], list);
        for (i, item) in list(value).iter().enumerate() {
            if let Some(schema) = first.get(i).or_else(|| schema.get("items")) {
                self.fits(schema, item, &format!("{at}/{i}"), false)?;
            }
        }
        Ok(())
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

const ATOM: &str = r"^[^\s(),;]+(\([^()]*\))?$";

/// Whether a text matches one of the patterns that there are.
fn matches(pattern: &str, text: &str) -> bool {
    match pattern {
        r"^\d+$" => !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()),
        r"^(not\s+)?[^\s(),;]+(\([^()]*\))?$" => {
            let negated = text.strip_prefix("not").filter(|rest| rest.starts_with(char::is_whitespace));
            matches(ATOM, negated.map_or(text, str::trim_start))
        }
        ATOM => {
            let (name, args) = text.split_once('(').unwrap_or((text, ")"));
            let is_part = |c: char| c.is_whitespace() || "(),;".contains(c);
            let args = args.strip_suffix(')');
            !name.is_empty() && !name.contains(is_part) && args.is_some_and(|args| !args.contains(['(', ')']))
        }
        r"^[0-9a-fA-F]{64}$" => text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit()),
        other => panic!("the pattern {other} is not known here"),
    }
}

fn has_key(object: &Map<String, Value>, key: &Value) -> bool {
    key.as_str().is_some_and(|key| object.contains_key(key))
}

fn is_of_type(value: &Value, ty: &Value) -> bool {
    match ty.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("boolean") => value.is_boolean(),
        Some("null") => value.is_null(),
        Some("integer") => value.is_i64() || value.is_u64(),
        Some("number") => value.is_number(),
        _ => panic!("{ty} is not known here"),
    }
}
