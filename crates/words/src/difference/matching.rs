//! Which action of one model is which of another, and what its parameters are called there.

use typelift_model::{ActionModel, ActionSchema, Parameter, Term};

use super::{ActionText, ListDifference};

/// Parameters that a call does not name and that are tried in every order; the others keep theirs.
const MOST_RENAMED: usize = 6;

/// Two actions that are taken for one.
pub(super) struct Pair {
    /// Its place in the first model.
    pub(super) first: usize,
    /// Its place in the second.
    pub(super) second: usize,
    /// Which parameter of the first each parameter of the second is.
    pub(super) renaming: Vec<usize>,
    /// How much differs then.
    differs: usize,
}

/// The actions that both models have, in the order of the first, each at most once: those that differ least first.
pub(super) fn matching(first: &ActionModel, second: &ActionModel, fold: &impl Fn(String) -> String) -> Vec<Pair> {
    let mut candidates = Vec::new();
    for (i, a) in first.actions.iter().enumerate() {
        let said_of_a = ActionText::of(a, first, &a.parameters, fold);
        for (j, b) in second.actions.iter().enumerate().filter(|(_, b)| is_of_one_skill(a, b, fold)) {
            let best = renamings(a, b, fold).into_iter().filter_map(|renaming| {
                let names: Vec<Parameter> = renaming.iter().map(|&of_a| a.parameters[of_a].clone()).collect();
                let differs = differences(&said_of_a, &ActionText::of(b, second, &names, fold))?;
                Some(Pair { first: i, second: j, renaming, differs })
            });
            candidates.extend(best.min_by_key(|pair| pair.differs));
        }
    }
    candidates.sort_by_key(|pair| (pair.differs, pair.first, pair.second));
    let mut pairs: Vec<Pair> = Vec::new();
    for candidate in candidates {
        if !pairs.iter().any(|pair| pair.first == candidate.first || pair.second == candidate.second) {
            pairs.push(candidate);
        }
    }
    pairs.sort_by_key(|pair| pair.first);
    pairs
}

/// Whether the two may be one action: their calls, or they themselves, have the same name. An export in PDDL calls an action
/// as the model names it.
fn is_of_one_skill(a: &ActionSchema, b: &ActionSchema, fold: &impl Fn(String) -> String) -> bool {
    let fold = |name: &dyn ToString| fold(name.to_string());
    let same = fold(&a.call.name) == fold(&b.call.name) || fold(&a.name) == fold(&b.name);
    same && a.parameters.len() == b.parameters.len()
}

/// How much differs; nothing if they have effects, and none in common: such actions are different ones of one skill.
fn differences(a: &ActionText, b: &ActionText) -> Option<usize> {
    let common = a.adds.intersection(&b.adds).count() + a.deletes.intersection(&b.deletes).count();
    let effects = a.adds.len() + a.deletes.len() + b.adds.len() + b.deletes.len();
    let lists = [
        (&a.parameters, &b.parameters),
        (&a.needs, &b.needs),
        (&a.adds, &b.adds),
        (&a.deletes, &b.deletes),
        (&a.costs, &b.costs),
    ];
    let differs = lists.into_iter().map(|(a, b)| ListDifference::of(a, b).len()).sum();
    (common > 0 || effects == 0).then_some(differs)
}

/// The ways to take parameters of `b` for those of `a` that agree on what the calls name.
fn renamings(a: &ActionSchema, b: &ActionSchema, fold: &impl Fn(String) -> String) -> Vec<Vec<usize>> {
    let n = a.parameters.len();
    let mut fixed: Vec<Option<usize>> = vec![None; n];
    let one_call = fold(a.call.name.to_string()) == fold(b.call.name.to_string());
    if one_call && a.call.args.len() == b.call.args.len() {
        for (of_a, of_b) in a.call.args.iter().zip(&b.call.args) {
            if let (Term::Param(of_a), Term::Param(of_b)) = (of_a, of_b) {
                fixed[*of_b as usize] = Some(*of_a as usize);
            }
        }
    }
    let mut free: Vec<usize> = (0..n).filter(|of_a| !fixed.contains(&Some(*of_a))).collect();
    // One of `a` that two of `b` are fixed to leaves more open than there are.
    let open: Vec<usize> = (0..n).filter(|&of_b| fixed[of_b].is_none()).collect();
    free.truncate(open.len());
    let fill = |order: &[usize]| {
        let mut renaming: Vec<usize> = fixed.iter().map(|of_a| of_a.unwrap_or_default()).collect();
        for (&of_b, &of_a) in open.iter().zip(order) {
            renaming[of_b] = of_a;
        }
        renaming
    };
    if free.len() > MOST_RENAMED { vec![fill(&free)] } else { orders(&free).iter().map(|order| fill(order)).collect() }
}

/// Every order of these.
fn orders(items: &[usize]) -> Vec<Vec<usize>> {
    if items.is_empty() {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for (i, &item) in items.iter().enumerate() {
        let others: Vec<usize> = [&items[..i], &items[i + 1..]].concat();
        all.extend(orders(&others).into_iter().map(|mut order| {
            order.insert(0, item);
            order
        }));
    }
    all
}
