//! Names that somebody may have meant.

use crate::Symbol;

/// Letters of the longest name that is compared with others: the time is the product of their lengths.
const LONGEST: usize = 100;

/// The name among `names` that differs least from `name`: in case only, or else in at most a third of its letters, or
/// in one of two; two neighbours that changed places are one difference. Of several, the first. None for a very long name.
pub fn nearest<'a>(name: &str, names: impl IntoIterator<Item = &'a Symbol>) -> Option<&'a Symbol> {
    let wanted = name.to_lowercase();
    let length = wanted.chars().count();
    let limit = (length / 3).max(usize::from(length > 1));
    if length > LONGEST {
        return None;
    }
    names
        .into_iter()
        .filter(|candidate| candidate.as_str() != name)
        .filter_map(|candidate| {
            let other = candidate.as_str().to_lowercase();
            let close = other.chars().count().abs_diff(length) <= limit;
            let distance = if close { strsim::osa_distance(&wanted, &other) } else { usize::MAX };
            (distance <= limit).then_some((distance, candidate))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// ``Did you mean `x`?``, if there is a name near enough.
pub fn did_you_mean<'a>(name: &str, names: impl IntoIterator<Item = &'a Symbol>) -> Option<String> {
    nearest(name, names).map(|near| format!("Did you mean `{near}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_near() {
        let names = ["lettuce", "tomato", "Plate"].map(Symbol::new);
        let near = |name| nearest(name, &names).map(Symbol::as_str);
        assert_eq!(near("letuce"), Some("lettuce"));
        assert_eq!(near("plate"), Some("Plate"));
        assert_eq!(near("fork"), None);
        assert_eq!(nearest("gaol", &["format", "goal"].map(Symbol::new)).map(Symbol::as_str), Some("goal"));
        assert_eq!(nearest("opne", &["close", "open"].map(Symbol::new)).map(Symbol::as_str), Some("open"));
        assert_eq!(near("tomato"), None);
        assert_eq!(near(""), None);
        assert_eq!(nearest("b", &["a", "B"].map(Symbol::new)).map(Symbol::as_str), Some("B"));
        assert_eq!(nearest("b", &["a", "c"].map(Symbol::new)), None);
    }

    #[test]
    fn very_long_names_are_not_compared() {
        let long = "a".repeat(1_000_000);
        assert_eq!(nearest(&format!("{long}b"), &[Symbol::from(format!("{long}c"))]), None);
    }
}
