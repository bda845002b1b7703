//! How likely something that is about to be done works, by what was tried in a run: unlike a [judgement](crate::Belief), which
//! speaks of types, it knows the objects.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionSchema, Hierarchy};

use crate::action::ActionBelief;
use crate::cause::Cause;
use crate::deed::{Deed, Tried};
use crate::outcome::tried;

impl ActionBelief {
    /// How likely a deed works that is about to be done, from 0 to 1; none if it is another action's. An object counts if
    /// something failed with it in that instance, and the less the longer ago that was. In time of what was tried.
    pub fn foretold(
        &self,
        schema: &ActionSchema,
        next: &Deed,
        run: &[Tried<'_>],
        hierarchy: &Hierarchy,
    ) -> Option<f64> {
        let nobody = BTreeSet::new();
        let next = Tried {
            deed: next,
            worked: true,
            count: 1,
            when: u64::MAX,
            tasks_ago: 0,
            actors: &nobody,
            in_goal: &nobody,
        };
        let outcome = tried(schema, &next, hierarchy, run)?;
        let mut causes = self.against(
            hierarchy,
            &outcome.types,
            self.missing_in(&outcome),
            outcome.held.iter().filter(|atom| self.is_absent(atom)).cloned(),
        );
        causes.extend(self.objects_suspected(schema, next.deed, run, hierarchy));
        Some(self.works(&causes))
    }

    /// The objects of a deed with which something failed, each with the odds that it is out of order now.
    fn objects_suspected(
        &self,
        schema: &ActionSchema,
        deed: &Deed,
        run: &[Tried<'_>],
        hierarchy: &Hierarchy,
    ) -> BTreeMap<Cause, f64> {
        let mut suspected = BTreeMap::new();
        let failures = run.iter().filter(|one| !one.worked && one.deed.instance == deed.instance);
        for (cause, odds) in failures.flat_map(|failure| self.blame(schema, failure, run, hierarchy)) {
            let is_of_deed = match &cause {
                Cause::Object { object, .. } => deed.participants.iter().any(|one| one.object == *object),
                _ => false,
            };
            if is_of_deed {
                let most = suspected.entry(cause).or_insert(odds);
                *most = odds.max(*most);
            }
        }
        suspected
    }
}
