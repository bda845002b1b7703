//! How likely a call works, and what speaks against it: a pure function of what was observed.
//!
//! A call works if the type in each of its places is accepted there, what has to hold before holds, and no two of its types
//! get in each other's way; and there is chance. So a failure is a clause: one of these is to blame. What else was observed
//! speaks for or against each: a type that worked elsewhere in that place, a literal that a success did without. The blame of
//! a failure is shared among what is left, in proportion to its odds, and counts in turn as that much evidence; a fixed
//! number of rounds, so that the same observations always give the same belief.
//!
//! With successes alone it is Algorithm 1: what the generalized type covers is accepted. From the first failure on, the types
//! of each place have a signed belief over the hierarchy. A type that has nothing in common, below the top, with all that
//! worked in a place is next to impossible there in both cases: the hierarchy keeps them apart, until one works.
//!
//! | file | what it holds |
//! |---|---|
//! | `types` | which types a place accepts |
//! | `cause` | what can be to blame |
//! | `deed` | what was tried in a run, by which objects |
//! | `run` | all that was tried, with what was alike counted once |
//! | `outcome` | what was observed of an action: what worked, and what did not |
//! | `suspicion` | literals and pairs of types, with the odds that they matter |
//! | `surroundings` | what held around who took part, of what else there is |
//! | `around` | how often it did, and which of it may be to blame |
//! | `object` | objects, with the odds that they are out of order |
//! | `action` | all of it for one action: sharing the blame |
//! | `judgement` | what is read off for a call |
//! | `foresight` | what is read off for something that is about to be done, with objects that failed |

#![deny(missing_docs)]

mod action;
mod around;
mod cause;
mod deed;
mod foresight;
mod judgement;
mod object;
mod outcome;
mod run;
mod surroundings;
mod suspicion;
mod types;
mod unmet;

pub use action::ActionBelief;
pub use around::Surroundings;
pub use cause::{Cause, Culprit, Pair};
pub use deed::{Deed, Participant, Tried};
pub use judgement::{Belief, Judgement, Question, Suspect};
pub use run::Run;
pub use surroundings::{Link, Surrounding};

/// How often something happens that nothing explains.
pub const CHANCE: f64 = 0.02;

/// However often the same is seen to fail, it may be chance: it counts as evidence so often at most.
pub(crate) const MOST_ALIKE: f64 = 3.0;

/// The odds of what has these logarithmic odds, which stay finite.
pub(crate) fn odds(logarithm: f64) -> f64 {
    logarithm.clamp(-MOST_CERTAIN, MOST_CERTAIN).exp()
}

/// Nothing is more certain, as logarithmic odds.
const MOST_CERTAIN: f64 = 60.0;
