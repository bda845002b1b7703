//! When a proposal is given up: raising a type too far is no longer an analogy but a guess at random.
//!
//! The paper states no bound. Without one, an action can be imagined in which a plate is a tool, or a thing that only ever
//! is moved moves itself: nothing stops a parameter from rising to a type that covers everything.
//!
//! Only the arguments of the call are compared by default. Comparing all parameters is too strict: what lies under the thing
//! that is put down may well be of the same kind. And two arguments that meet in a narrow type were like roles to begin with: a
//! key that was put next to a ball says that items are put next to items. So a rise that covers another argument's type counts
//! only near the top, where types have little more in common than that they are there.

use typelift_model::{Hierarchy, Term, TypeId};

use crate::Context;
use crate::create::Proposal;
use crate::given_up::{Because, GivenUp};

/// Which proposals are given up. But for [`Off`](Self::Off), all also give up those in which the type of who acts rises
/// beyond the model's actor.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Guard {
    /// Those in which a call's argument rises so far that the action would no longer tell its roles apart: to a
    /// [topmost](Self::TopTypes) type that covers the type of another argument, from which it was disjoint. A child of the
    /// top type will do where both types are its own children.
    #[default]
    Roles,
    /// Those in which a call's argument rises to any type that covers the type of another argument, from which it was
    /// disjoint. Stricter: it also tells siblings apart.
    CallArguments,
    /// The same for any two parameters. Stricter still: it also gives up what an effect alone mentions.
    Parameters,
    /// Those in which a parameter rises to the type that covers all types, or to one of its children.
    TopTypes,
    /// None.
    Off,
}

/// Why the guard gives up this proposal, if it does.
pub(crate) fn gives_up(guard: Guard, context: &Context<'_>, proposal: &Proposal<'_>) -> Option<GivenUp> {
    let hierarchy = &context.model.hierarchy;
    let called = |i: usize| proposal.schema.call.args.contains(&Term::Param(i as u32));
    let refused = match guard {
        Guard::Off => return None,
        Guard::TopTypes => {
            raised(proposal).find(|rise| is_topmost(rise.to, hierarchy)).map(|rise| (rise, Because::Topmost))
        }
        Guard::Parameters => covering(context, proposal, |_| true, |_, _| true),
        Guard::CallArguments => covering(context, proposal, called, |_, _| true),
        Guard::Roles => {
            covering(context, proposal, called, |rise, other| !are_like_roles(rise.from, other, rise.to, hierarchy))
        }
    };
    let (rise, because) = refused.or_else(|| acting_instead(context, proposal))?;
    Some(GivenUp {
        action: proposal.schema.name.clone(),
        parameter: proposal.schema.parameters[rise.parameter].name.clone(),
        from: hierarchy.name(rise.from).clone(),
        to: hierarchy.name(rise.to).clone(),
        because,
    })
}

/// A parameter whose type rose.
struct Rise {
    parameter: usize,
    from: TypeId,
    to: TypeId,
}

fn raised(proposal: &Proposal<'_>) -> impl Iterator<Item = Rise> {
    let parameters = proposal.schema.parameters.iter().zip(&proposal.types).enumerate();
    let rises = parameters.map(|(i, (parameter, to))| Rise { parameter: i, from: parameter.ty, to: *to });
    rises.filter(|rise| rise.from != rise.to)
}

/// Whether a type covers all types, or is a child of the one that does.
fn is_topmost(ty: TypeId, hierarchy: &Hierarchy) -> bool {
    let top = hierarchy.top();
    ty == top || ty == hierarchy.root() || hierarchy.parents(ty).contains(&top)
}

/// Whether two types have so much in common where they meet that what was shown of the one goes for the other.
fn are_like_roles(one: TypeId, other: TypeId, meeting: TypeId, hierarchy: &Hierarchy) -> bool {
    if !is_topmost(meeting, hierarchy) {
        return true;
    }
    let is_proper = meeting != hierarchy.top() && meeting != hierarchy.root();
    is_proper && [one, other].iter().all(|ty| hierarchy.parents(*ty).contains(&meeting))
}

/// The first rise of a parameter that counts to a type which covers that of another one that counts, if these two matter.
fn covering(
    context: &Context<'_>,
    proposal: &Proposal<'_>,
    counts: impl Fn(usize) -> bool,
    matter: impl Fn(&Rise, TypeId) -> bool,
) -> Option<(Rise, Because)> {
    let hierarchy = &context.model.hierarchy;
    let others = || proposal.schema.parameters.iter().enumerate().filter(|(j, _)| counts(*j));
    raised(proposal).filter(|rise| counts(rise.parameter)).find_map(|rise| {
        let covered = others().find(|(j, other)| {
            *j != rise.parameter
                && hierarchy.is_a(other.ty, rise.to)
                && hierarchy.disjoint(other.ty, rise.from)
                && matter(&rise, other.ty)
        })?;
        let covered = hierarchy.name(covered.1.ty).clone();
        Some((rise, Because::Covers(covered)))
    })
}

/// The rise of who acts to a type beyond the model's actor: what was never seen to act would do so.
fn acting_instead(context: &Context<'_>, proposal: &Proposal<'_>) -> Option<(Rise, Because)> {
    let model = context.model;
    let parameters = &proposal.schema.parameters;
    let named = proposal.schema.call.args.iter().filter_map(|term| match term {
        Term::Param(parameter) => Some(*parameter as usize),
        Term::Const(_) => None,
    });
    let acts = named.chain(0..parameters.len()).find(|&p| model.is_actor(parameters[p].ty))?;
    let rise = raised(proposal).find(|rise| rise.parameter == acts && !model.is_actor(rise.to))?;
    let instead = proposal.binding[acts].and_then(|object| context.task.init.objects.get(object));
    let instead = model.hierarchy.name(*instead.unwrap_or(&rise.to)).clone();
    Some((rise, Because::ActsInstead(instead)))
}
