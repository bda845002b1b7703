//! Names that somebody may have meant.

use crate::Symbol;

/// Letters of the longest name that is compared with others: the time is the product of their lengths.
const LONGEST: usize = 100;

/// The name among `names` that differs least from `name`: in case only, or else in at most a third of its letters, or
/// in one of two. Of several, the first. None for a very long name.
pub fn nearest<'a>(name: &str, names: impl IntoIterator<Item = &'a Symbol>) -> Option<&'a Symbol> {
    let wanted: Vec<char> = name.to_lowercase().chars().collect();
    let limit = (wanted.len() / 3).max(usize::from(wanted.len() > 1));
    if wanted.len() > LONGEST {
        return None;
    }
    names
        .into_iter()
        .filter(|candidate| candidate.as_str() != name)
        .filter_map(|candidate| {
            let letters: Vec<char> = candidate.as_str().to_lowercase().chars().collect();
            let close = letters.len().abs_diff(wanted.len()) <= limit;
            let distance = if close { edit_distance(&wanted, &letters) } else { usize::MAX };
            (distance <= limit).then_some((distance, candidate))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// ``Did you mean `x`?``, if there is a name near enough.
pub fn did_you_mean<'a>(name: &str, names: impl IntoIterator<Item = &'a Symbol>) -> Option<String> {
    nearest(name, names).map(|near| format!("Did you mean `{near}`?"))
}

/// The number of letters to insert, remove or replace (Levenshtein).
fn edit_distance(left: &[char], right: &[char]) -> usize {
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (i, a) in left.iter().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, b) in right.iter().enumerate() {
            let replaced = diagonal + usize::from(a != b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[right.len()]
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
