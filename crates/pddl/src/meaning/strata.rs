//! In which order derived predicates are derived.

use std::collections::BTreeMap;

use typelift_model::Symbol;

use crate::{CompileError, CompilePart, Derived, Domain};

/// The conditions of derived predicates, so grouped that none depends on the negation of one of its own or a later group.
pub(super) fn strata(domain: &Domain) -> Result<Vec<Vec<&Derived>>, CompileError> {
    let mut stratum: BTreeMap<&Symbol, usize> = domain.derived.iter().map(|derived| (&derived.head.name, 0)).collect();
    let most = stratum.len();
    let mut is_changed = true;
    while is_changed {
        is_changed = false;
        for derived in &domain.derived {
            let name = &derived.head.name;
            let mut least = stratum.get(name).copied().unwrap_or(0);
            let before = least;
            derived.condition.for_each_predicate(true, &mut |predicate, positive| {
                if let Some(needed) = stratum.get(predicate) {
                    least = least.max(needed + usize::from(!positive));
                }
            });
            if least >= most {
                // Without a circle, there are at least as many predicates as strata.
                let message = format!("`{name}` depends on its own negation");
                return Err(CompileError::new(&CompilePart::Derived(name.clone()), message));
            }
            is_changed |= least > before;
            stratum.insert(name, least);
        }
    }
    let mut groups = vec![Vec::new(); most];
    for derived in &domain.derived {
        groups[stratum[&derived.head.name]].push(derived);
    }
    Ok(groups)
}
