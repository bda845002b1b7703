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
        causes.extend(self.objects_suspected(next.deed));
        Some(self.works(&causes))
    }

    /// The objects of a deed with which something failed, each with the odds that it is out of order now.
    fn objects_suspected(&self, deed: &Deed) -> BTreeMap<Cause, f64> {
        let is_of_deed = |cause: &Cause| match cause {
            Cause::Object { instance, object, .. } => {
                *instance == deed.instance && deed.participants.iter().any(|one| one.object == *object)
            }
            _ => false,
        };
        let mut suspected = BTreeMap::new();
        for (cause, odds) in self.objects_out_of_order().filter(|(cause, _)| is_of_deed(cause)) {
            let most = suspected.entry(cause.clone()).or_insert(odds);
            *most = odds.max(*most);
        }
        suspected
    }
}
