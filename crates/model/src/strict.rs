//! Strict applicability, as a rewrite of the model.
//!
//! Every effect that was observed was a change. So an add effect that was never observed as already true is taken
//! to need its atom false before: this says "the plate is empty" where positive preconditions cannot. Atoms that a
//! learned action deletes are among its preconditions anyway. This goes beyond the paper, whose preconditions are
//! positive only.

use crate::{ActionModel, Literal};

/// The model with, for each unconditional add effect of each action that [is strict](crate::ActionSchema::strict), the
/// negation of its atom among the preconditions. Other actions, as given ones, stay as they are.
pub fn strict(model: &ActionModel) -> ActionModel {
    let mut model = model.clone();
    for action in model.actions.iter_mut().filter(|action| action.strict) {
        let mut preconditions = action.preconditions.clone();
        for effect in action.effects.iter().filter(|e| e.literal.positive && e.is_unconditional()) {
            let already_true = preconditions.iter().any(|l| l.positive && l.atom == effect.literal.atom);
            if !already_true {
                preconditions.push(Literal::negative(effect.literal.atom.clone()));
            }
        }
        preconditions.sort_unstable();
        preconditions.dedup();
        action.preconditions = preconditions;
    }
    model
}
