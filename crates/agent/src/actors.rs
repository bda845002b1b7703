//! Who acts in a step: whoever the model says does, or else seems to.
//!
//! What is demonstrated need not show a type that acts, as where a robot and a press both do. Yet to exclude the robot from
//! a call is to give up the call. So where the model has no actor, an object is taken for one that has no other of its type
//! beside it, that nothing shows to be acted on, and without whose like the call was never seen.

use std::collections::BTreeSet;

use typelift_model::{ActionModel, ActionSchema, State, Symbol, Term, TypeId};

/// Those of the objects of a step with this call that act.
pub(crate) fn actors<'a>(
    objects: impl Iterator<Item = &'a Symbol>,
    call: &Symbol,
    model: &ActionModel,
    state: &State,
) -> BTreeSet<Symbol> {
    let acts = |object: &&Symbol| match (state.objects.get(*object), model.actor) {
        (None, _) => false,
        (Some(ty), Some(_)) => model.is_actor(*ty),
        (Some(ty), None) => is_alone(object, *ty, state) && seems_to_act(*ty, call, model),
    };
    objects.filter(acts).cloned().collect()
}

fn is_alone(object: &Symbol, ty: TypeId, state: &State) -> bool {
    !state.objects.iter().any(|(other, its)| *its == ty && other != object)
}

/// Whether each action of this call has a part that things of this type were seen in, and no call names one but first.
fn seems_to_act(ty: TypeId, call: &Symbol, model: &ActionModel) -> bool {
    let takes = |schema: &ActionSchema, parameter: usize| {
        demonstrated(schema, parameter, model).iter().any(|seen| model.hierarchy.is_a(ty, *seen))
    };
    let has_part = |schema: &ActionSchema| (0..schema.parameters.len()).any(|parameter| takes(schema, parameter));
    let is_acted_on = |schema: &ActionSchema| {
        schema.call.args.iter().skip(1).any(|arg| match arg {
            Term::Param(parameter) => takes(schema, *parameter as usize),
            Term::Const(_) => false,
        })
    };
    let mut of_call = model.actions.iter().filter(|schema| schema.call.name == *call).peekable();
    of_call.peek().is_some() && of_call.all(has_part) && !model.actions.iter().any(is_acted_on)
}

/// The types that stood for a parameter; that of the parameter where nothing was demonstrated.
fn demonstrated(schema: &ActionSchema, parameter: usize, model: &ActionModel) -> Vec<TypeId> {
    let support = schema.provenance.support().iter();
    let seen = support.flat_map(|support| support.map.iter().zip(&support.cluster.types));
    let here = seen.filter(|(of, _)| **of as usize == parameter);
    let types: Vec<TypeId> = here.filter_map(|(_, ty)| model.hierarchy.id(ty.as_str())).collect();
    if types.is_empty() { schema.parameters.get(parameter).map(|p| p.ty).into_iter().collect() } else { types }
}

#[cfg(test)]
mod tests {
    use typelift_model::{Cost, Hierarchy, LiftedCall, Parameter, Provenance};

    use super::*;

    /// An action of a call: `?` stands before each parameter that the call names.
    fn schema(hierarchy: &Hierarchy, call: &str, parameters: &[&str]) -> ActionSchema {
        let named = (0..).zip(parameters).filter(|(_, ty)| ty.starts_with('?'));
        let parameter = |ty: &&str| {
            let ty = ty.trim_start_matches('?');
            Parameter { name: ty.into(), ty: hierarchy.id(ty).expect("declared") }
        };
        ActionSchema {
            name: format!("{call}-{}", parameters.concat().replace('?', "")).into(),
            call: LiftedCall { name: call.into(), args: named.map(|(place, _)| Term::Param(place)).collect() },
            parameters: parameters.iter().map(parameter).collect(),
            preconditions: Vec::new(),
            distinct: Vec::new(),
            effects: Vec::new(),
            cost: Cost::UNIT,
            strict: true,
            named_by_call: false,
            provenance: Provenance::Given,
        }
    }

    /// Who acts in a step of this call with all that is there; the type of a thing is its name without its number.
    fn acting(call: &str, objects: &[&str], actions: &[(&str, &[&str])]) -> Vec<String> {
        let types = ["robot", "press", "cup", "bowl", "button"].map(|ty| (ty, "object"));
        let hierarchy = Hierarchy::from_edges(types).expect("a hierarchy");
        let ty = |object: &&str| hierarchy.id(object.trim_end_matches(|c: char| c.is_ascii_digit())).expect("a type");
        let objects: Vec<(Symbol, TypeId)> = objects.iter().map(|object| (Symbol::new(object), ty(object))).collect();
        let state = State { objects: objects.iter().cloned().collect(), ..State::default() };
        let actions = actions.iter().map(|(call, parameters)| schema(&hierarchy, call, parameters)).collect();
        let model = ActionModel { hierarchy, actions, ..ActionModel::default() };
        actors(objects.iter().map(|(object, _)| object), &call.into(), &model, &state)
            .iter()
            .map(ToString::to_string)
            .collect()
    }

    /// Calls that name the cup alone: who picks it up, and what flattens it, takes part unnamed.
    const UNNAMED: [(&str, &[&str]); 3] =
        [("pick", &["?cup", "robot"]), ("pick", &["?bowl", "robot"]), ("flatten", &["?cup", "press"])];

    #[test]
    fn whom_no_call_of_its_kind_was_seen_without_acts() {
        assert_eq!(acting("pick", &["robot1", "cup1", "cup2"], &UNNAMED), ["robot1"]);
        assert_eq!(acting("flatten", &["press1", "cup1", "cup2"], &UNNAMED), ["press1"]);
    }

    #[test]
    fn who_is_named_first_acts_and_who_is_named_later_does_not() {
        let named: [(&str, &[&str]); 2] = [("pick", &["?robot", "?cup"]), ("flatten", &["?press", "?cup"])];
        assert_eq!(acting("pick", &["robot1", "cup1"], &named), ["robot1"]);
        let given: [(&str, &[&str]); 2] = [("pick", &["?robot", "?cup"]), ("call", &["?press", "?robot"])];
        assert!(acting("pick", &["robot1", "cup1"], &given).is_empty());
    }

    #[test]
    fn what_has_another_beside_it_or_is_missing_elsewhere_may_be_to_blame() {
        assert!(acting("pick", &["robot1", "robot2", "bowl1", "bowl2"], &UNNAMED).is_empty());
        assert!(!acting("pick", &["robot1", "bowl1"], &UNNAMED).contains(&"bowl1".to_owned()), "cups are picked, too");
    }
}
