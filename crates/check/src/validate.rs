//! Plans of a model as files state them: names and objects, without saying which case of an action is meant.
//!
//! A PDDL action with a disjunctive or existential precondition is several schemas of a model, whose parameters may
//! be more than the action's. A line of a plan can be executed if one of them can, with whatever objects for the other
//! parameters; all have the same effect.
//!
//! A learned action is named by its own name and all of its parameters instead, since one call may have several effects.

use typelift_model::{
    ActionModel, ActionSchema, GroundAction, GroundAtom, GroundCall, InstantiateError, Literal, Plan, State, Symbol,
    Task, Term,
};

use crate::{Invalid, advance};

/// What a valid plan comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Valid {
    /// The plan, with the case of each action that is used.
    pub plan: Plan,
    /// The final state.
    pub state: State,
}

/// A schema, objects for its parameters, and the ground action they make.
type Choice<'a> = (&'a ActionSchema, GroundAction);

/// Replays a plan from the task's initial state. Its lines name actions by the model's names, as
/// [`ActionSchema::signature`] says.
///
/// # Errors
/// The steps that could be taken, and [`Invalid`], which names the first that cannot be, or the first part of the goal
/// that is missed.
pub fn validate(model: &ActionModel, task: &Task, lines: &[GroundCall]) -> Result<Valid, (Plan, Invalid)> {
    let mut state = model.with_derived(&task.init);
    let mut plan = Plan::default();
    for (i, line) in lines.iter().enumerate() {
        let step = i + 1;
        let taken = choose(model, &state, step, line).and_then(|(schema, action)| {
            let no_cost = || InstantiateError::NoCost { action: schema.name.clone() };
            let cost = schema.cost.of(&action.objects, &task.values);
            let cost = cost.ok_or_else(|| Invalid::Objects { step, error: no_cost() })?;
            Ok((schema.step(action.objects.clone(), cost), action))
        });
        match taken {
            Ok((step, action)) => {
                advance(model, &action, &mut state);
                plan.steps.push(step);
            }
            Err(invalid) => return Err((plan, invalid)),
        }
    }
    match task.goal.literals().find(|&(atom, positive)| state.holds(atom) != positive) {
        Some((atom, positive)) => Err((plan, Invalid::Goal { part: model.in_words(atom, positive) })),
        None => Ok(Valid { plan, state }),
    }
}

/// The first case of the action that can be used.
fn choose<'a>(model: &'a ActionModel, state: &State, step: usize, line: &GroundCall) -> Result<Choice<'a>, Invalid> {
    let mut failures: Vec<Invalid> = Vec::new();
    for schema in model.actions.iter().filter(|schema| schema.signature().name == line.name) {
        match choose_objects(model, state, step, schema, line) {
            Ok(action) => return Ok((schema, action)),
            Err(invalid) => failures.push(invalid),
        }
    }
    // A case for other types of objects is no reason if there is one for these.
    let is_of_others = |invalid: &Invalid| matches!(invalid, Invalid::Objects { .. });
    if failures.iter().all(is_of_others) {
        failures.truncate(1);
    } else {
        failures.retain(|invalid| !is_of_others(invalid));
    }
    match failures.len() {
        0 => Err(Invalid::UnknownAction { step, action: line.name.clone() }),
        1 => Err(failures.remove(0)),
        _ => {
            let mut reasons: Vec<String> = failures.iter().map(reason).collect();
            reasons.sort();
            reasons.dedup();
            Err(Invalid::NoCase { step, action: line.name.clone(), reasons })
        }
    }
}

/// What is missing, without the step.
fn reason(invalid: &Invalid) -> String {
    match invalid {
        Invalid::Precondition { needs, .. } => needs.clone(),
        Invalid::NoCase { reasons, .. } => reasons.join("; "),
        other => other.to_string(),
    }
}

/// Objects for all parameters of a schema with which it can be used as the line says.
fn choose_objects(
    model: &ActionModel,
    state: &State,
    step: usize,
    schema: &ActionSchema,
    line: &GroundCall,
) -> Result<GroundAction, Invalid> {
    let signature = schema.signature();
    let (expected, found) = (signature.args.len(), line.args.len());
    if expected != found {
        let error = InstantiateError::Arity { action: line.name.clone(), expected, found };
        return Err(Invalid::Objects { step, error });
    }
    let mut binding: Vec<Option<Symbol>> = vec![None; schema.parameters.len()];
    for (term, object) in signature.args.iter().zip(&line.args) {
        let known = match term {
            Term::Const(name) => Some(name.clone()),
            Term::Param(p) => binding[*p as usize].replace(object.clone()),
        };
        if let Some(other) = known.filter(|other| other != object) {
            let reasons = vec![format!("{other} in the place of {object}")];
            return Err(Invalid::NoCase { step, action: line.name.clone(), reasons });
        }
    }
    check_objects(model, state, step, schema, line, &binding)?;
    let open: Vec<usize> = (0..binding.len()).filter(|&p| binding[p].is_none()).collect();
    if let Some(objects) = binding.iter().cloned().collect::<Option<Vec<Symbol>>>() {
        return usable(model, state, step, schema, &objects);
    }
    let choice = Search { model, state, schema, open: &open };
    match choice.complete(&mut binding, 0) {
        Some(objects) => usable(model, state, step, schema, &objects),
        None => {
            let unmet = choice.decided(&binding).find(|literal| !choice.holds(literal, &binding));
            let reason = match unmet {
                Some(literal) => choice.written(literal, &binding),
                None => {
                    let bound = |literal: &&Literal| literal.atom.params().all(|p| binding[p as usize].is_some());
                    let undecided = schema.preconditions.iter().filter(|literal| !bound(literal));
                    let together: Vec<String> = undecided.map(|literal| choice.written(literal, &binding)).collect();
                    together.join(" and ")
                }
            };
            Err(Invalid::NoCase { step, action: line.name.clone(), reasons: vec![reason] })
        }
    }
}

/// The objects of a line exist and have the types of their places.
fn check_objects(
    model: &ActionModel,
    state: &State,
    step: usize,
    schema: &ActionSchema,
    line: &GroundCall,
    binding: &Binding,
) -> Result<(), Invalid> {
    for (parameter, object) in schema.parameters.iter().zip(binding) {
        let Some(object) = object else { continue };
        let error = match state.objects.get(object) {
            None => InstantiateError::UnknownObject { object: object.clone() },
            Some(ty) if !model.hierarchy.is_a(*ty, parameter.ty) => InstantiateError::Type {
                action: line.name.clone(),
                object: object.clone(),
                expected: model.hierarchy.name(parameter.ty).clone(),
                found: model.hierarchy.name(*ty).clone(),
            },
            Some(_) => continue,
        };
        return Err(Invalid::Objects { step, error });
    }
    Ok(())
}

fn usable(
    model: &ActionModel,
    state: &State,
    step: usize,
    schema: &ActionSchema,
    objects: &[Symbol],
) -> Result<GroundAction, Invalid> {
    let action =
        schema.instantiate(objects, state, &model.hierarchy).map_err(|error| Invalid::Objects { step, error })?;
    let unmet = action.unmet(state).next().cloned();
    match unmet {
        Some((atom, positive)) => {
            let action = schema.signature().name;
            Err(Invalid::Precondition { step, action, needs: model.in_words(&atom, positive) })
        }
        None => Ok(action),
    }
}

/// Looks for objects for the parameters that a plan does not name.
struct Search<'a> {
    model: &'a ActionModel,
    state: &'a State,
    schema: &'a ActionSchema,
    open: &'a [usize],
}

type Binding = [Option<Symbol>];

impl Search<'_> {
    /// The first completion of the binding, from the open parameter at `next` on, that satisfies the precondition.
    fn complete(&self, binding: &mut Vec<Option<Symbol>>, next: usize) -> Option<Vec<Symbol>> {
        if !self.decided(binding).all(|literal| self.holds(literal, binding)) {
            return None;
        }
        let Some(&parameter) = self.open.get(next) else { return binding.iter().cloned().collect() };
        for (object, ty) in &self.state.objects {
            if !self.model.hierarchy.is_a(*ty, self.schema.parameters[parameter].ty) {
                continue;
            }
            binding[parameter] = Some(object.clone());
            let differ = |&(a, b): &(u32, u32)| {
                let (a, b) = (&binding[a as usize], &binding[b as usize]);
                a.is_none() || a != b
            };
            if self.schema.distinct.iter().all(differ)
                && let Some(objects) = self.complete(binding, next + 1)
            {
                return Some(objects);
            }
        }
        binding[parameter] = None;
        None
    }

    /// The preconditions whose parameters are all bound.
    fn decided<'b>(&'b self, binding: &'b Binding) -> impl Iterator<Item = &'b Literal> {
        let bound = |literal: &&Literal| literal.atom.params().all(|p| binding[p as usize].is_some());
        self.schema.preconditions.iter().filter(bound)
    }

    fn holds(&self, literal: &Literal, binding: &Binding) -> bool {
        self.state.holds(&ground(literal, binding)) == literal.positive
    }

    fn written(&self, literal: &Literal, binding: &Binding) -> String {
        let atom = literal.atom.map(|term| match term {
            Term::Const(name) => name.to_string(),
            Term::Param(p) => match &binding[*p as usize] {
                Some(object) => object.to_string(),
                None => format!("?{}", self.schema.parameters[*p as usize].name),
            },
        });
        self.model.in_words(&atom, literal.positive)
    }
}

/// The atom of a literal whose parameters are bound.
fn ground(literal: &Literal, binding: &Binding) -> GroundAtom {
    literal.atom.map(|term| match term {
        Term::Const(name) => name.clone(),
        Term::Param(p) => binding[*p as usize].clone().unwrap_or_default(),
    })
}
