//! How likely something that is about to be done works, by what was tried in a run: unlike a [judgement](crate::Belief), which
//! speaks of types, it knows the objects.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionSchema, Hierarchy};

use crate::action::ActionBelief;
use crate::cause::Cause;
use crate::deed::Deed;
use crate::outcome::{around, of_deed};
use crate::surroundings::Surrounding;

impl ActionBelief {
    /// How likely a deed works that is about to be done, from 0 to 1; none if it is another action's. `held_around` is
    /// what holds around it. An object counts if
    /// something failed with it in that instance, and the less the longer ago that was.
    pub fn foretold(
        &self,
        schema: &ActionSchema,
        next: &Deed,
        held_around: &BTreeSet<Surrounding>,
        hierarchy: &Hierarchy,
    ) -> Option<f64> {
        let outcome = of_deed(schema, next, 1, true, hierarchy)?;
        let mut causes = self.against(
            hierarchy,
            &outcome.types,
            self.missing_in(&outcome),
            outcome.held.iter().filter(|atom| self.is_absent(atom)).cloned(),
        );
        causes.extend(self.objects_suspected(next));
        if let Some(held) = around(schema, next, held_around) {
            causes.extend(self.causes_around(&held, &BTreeMap::new()));
        }
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
