//! Whether an object was out of order where something failed: a cause that is known in its instance of the world only, and that
//! passes.

use typelift_model::Symbol;

use crate::CHANCE;
use crate::deed::{Deed, Tried};
use crate::run::{Run, Use};

/// The odds that an object is out of order; one that the goal speaks of; how much less where it worked before or since.
const BROKEN: f64 = 0.1;
const BROKEN_IN_GOAL: f64 = 0.03;
const WORKED_BESIDES: f64 = 0.3;
/// How much more it is suspected for each time that another action of the same call failed with it, and it did not work in
/// between.
const FAILED_BESIDES: f64 = 4.0;
/// After so many tasks an object is suspected half as much: things are mended.
const HALF_LIFE: f64 = 5.0;

/// How an object is suspected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OutOfOrder {
    /// The logarithmic odds that it was out of order then: rarely, and more rarely where it had worked before in a call of
    /// this name, or has since.
    pub(crate) then: f64,
    /// By how much these change until now: things are mended, and what has worked since is in order.
    pub(crate) since: f64,
    /// When it had worked last in a call of this name; 0 if it never had. What failed before that is another matter.
    pub(crate) worked: u64,
}

/// How an object of a failure is suspected. In time of what was tried with it.
pub(crate) fn out_of_order(failure: &Tried<'_>, object: &Symbol, run: &Run<'_>) -> OutOfOrder {
    let prior = if failure.in_goal.contains(object) { BROKEN_IN_GOAL } else { BROKEN };
    let is_other = |deed: &Deed| {
        let as_many = deed.participants.len() == failure.deed.participants.len();
        !(as_many && deed.adds == failure.deed.adds)
    };
    // When it had worked last before, and when it worked next; and when another action failed.
    let (mut before, mut after, mut others) = (0, u64::MAX, Vec::new());
    for Use { deed, worked, when } in run.uses(failure.deed, object) {
        match (worked, *when < failure.when) {
            (true, true) => before = before.max(*when),
            (true, false) => after = after.min(*when),
            (false, _) if is_other(deed) => others.push(*when),
            (false, _) => {}
        }
    }
    let failed_besides = others.into_iter().filter(|when| before < *when && *when < after).count() as f64;
    let (has_worked_before, has_worked_since) = (before > 0, after < u64::MAX);
    OutOfOrder {
        then: prior.ln()
            + failed_besides * FAILED_BESIDES.ln()
            + if has_worked_before || has_worked_since { WORKED_BESIDES.ln() } else { 0.0 },
        since: if has_worked_since { CHANCE.ln() } else { 0.0 }
            - failure.tasks_ago as f64 / HALF_LIFE * std::f64::consts::LN_2,
        worked: before,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::around::Surroundings;
    use crate::deed::Participant;

    /// `cut(knife_1, ITEM)`.
    fn cutting(item: &str, adds: &str) -> Deed {
        let participant = |(place, object): (usize, &str)| Participant {
            object: object.into(),
            ty: object.into(),
            place: Some(place),
        };
        Deed {
            instance: "here".into(),
            call: "cut".into(),
            adds: [adds.into()].into(),
            participants: ["knife_1", item].into_iter().enumerate().map(participant).collect(),
            held: BTreeSet::new(),
        }
    }

    #[test]
    fn what_failed_before_it_worked_is_another_matter() {
        let (nobody, nothing, none) = (BTreeSet::new(), BTreeSet::new(), Surroundings::default());
        let deeds = ["nut_1", "leek_1", "nut_2", "nut_3"].map(|item| cutting(item, "cut"));
        let sliced = cutting("nut_4", "sliced");
        let tried = |deed, when, worked| Tried {
            deed,
            worked,
            count: 1,
            when,
            tasks_ago: 0,
            actors: &nobody,
            in_goal: &nobody,
            around: &nothing,
        };
        let [nut, leek, second, third] = &deeds;
        let all = [tried(nut, 2, false), tried(leek, 3, true), tried(second, 4, false), tried(third, 5, false)];
        let knife = "knife_1".into();
        let of = |at: usize, all: &[Tried<'_>]| out_of_order(&all[at], &knife, &Run::new(all, &none));
        assert_eq!([0, 2, 3].map(|at| of(at, &all).worked), [0, 3, 3]);
        assert!(of(0, &all).since < 0.0, "it worked since");
        assert_eq!(of(2, &all).since, 0.0);
        // Another action that failed with it counts while it did not work in between.
        let before = [&[tried(&sliced, 1, false)], &all[..]].concat();
        assert!(of(1, &before).then > of(0, &all).then);
        assert_eq!(of(3, &before), of(2, &all));
    }
}
