//! When a proposal is given up: raising a type too far is no longer an analogy but a guess at random.
//!
//! The paper states no bound. Without one, an action can be imagined in which a plate is a tool: nothing stops a
//! parameter from rising to a type that covers everything.
//!
//! Only the arguments of the call are compared by default. Comparing all parameters is too strict: what lies under the thing
//! that is put down may well be of the same kind.

use typelift_model::{Term, TypeId};

use crate::Context;
use crate::create::Proposal;

/// Which proposals are given up.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Guard {
    /// Those in which a call's argument rises to a type that covers the type of another argument, from which it was
    /// disjoint: the action would no longer tell its roles apart.
    #[default]
    CallArguments,
    /// Those in which any parameter rises to a type that covers the type of another parameter, from which it was
    /// disjoint. Stricter: it also gives up what an effect alone mentions.
    Parameters,
    /// Those in which a parameter rises to the type that covers all types, or to one of its children.
    TopTypes,
    /// None.
    Off,
}

/// Whether the guard gives up this proposal.
pub(crate) fn gives_up(guard: Guard, context: &Context<'_>, proposal: &Proposal<'_>) -> bool {
    match guard {
        Guard::Off => false,
        Guard::TopTypes => {
            let hierarchy = &context.model.hierarchy;
            let top = hierarchy.top();
            let is_top = |ty: TypeId| ty == top || ty == hierarchy.root() || hierarchy.parents(ty).contains(&top);
            raised(proposal).any(|(_, _, to)| is_top(to))
        }
        Guard::Parameters => covers_another(context, proposal, |_| true),
        Guard::CallArguments => {
            let called = |i: usize| proposal.schema.call.args.contains(&Term::Param(i as u32));
            covers_another(context, proposal, called)
        }
    }
}

/// The parameters that rose: index, old type, new type.
fn raised(proposal: &Proposal<'_>) -> impl Iterator<Item = (usize, TypeId, TypeId)> {
    let parameters = proposal.schema.parameters.iter().zip(&proposal.types).enumerate();
    parameters.map(|(i, (parameter, to))| (i, parameter.ty, *to)).filter(|(_, from, to)| from != to)
}

fn covers_another(context: &Context<'_>, proposal: &Proposal<'_>, counts: impl Fn(usize) -> bool) -> bool {
    let hierarchy = &context.model.hierarchy;
    raised(proposal).filter(|(i, _, _)| counts(*i)).any(|(i, from, to)| {
        proposal
            .schema
            .parameters
            .iter()
            .enumerate()
            .any(|(j, other)| i != j && counts(j) && hierarchy.is_a(other.ty, to) && hierarchy.disjoint(other.ty, from))
    })
}
