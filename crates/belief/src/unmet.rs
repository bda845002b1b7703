//! Why the model does not allow a call: what likelihood says nothing of, since a call that is likely to work may be one that
//! cannot be planned.

use std::collections::BTreeSet;

use typelift_model::{ActionModel, ActionSchema, GroundAtom, GroundCall, Literal, State, Symbol, Term, TypeId};

/// Choices of objects that are tried for what a call does not name; where there are more, the call counts as allowed.
const MOST_CHOICES: usize = 10_000;

/// What stands in the way of a call by this action, whose parameters stand for these arguments, a phrase each: objects of other
/// types, and, in a state, preconditions that are known not to hold, or that nothing there meets.
pub(crate) fn unmet(
    schema: &ActionSchema,
    bound: &[Option<usize>],
    call: &GroundCall,
    types: &[Option<TypeId>],
    state: Option<&State>,
    model: &ActionModel,
) -> Vec<String> {
    let hierarchy = &model.hierarchy;
    let wrong_type = |(parameter, argument): (usize, &Option<usize>)| {
        let argument = (*argument)?;
        let (ty, wanted) = (types[argument]?, schema.parameters[parameter].ty);
        (!hierarchy.is_a(ty, wanted)).then(|| {
            let (object, ty, wanted) = (&call.args[argument], hierarchy.name(ty), hierarchy.name(wanted));
            match object == ty {
                true => format!("{ty} is no {wanted}"),
                false => format!("{object} is of type {ty}, not {wanted}"),
            }
        })
    };
    let mut found: Vec<String> = bound.iter().enumerate().filter_map(wrong_type).collect();
    if let (true, Some(state)) = (found.is_empty(), state) {
        found = Here { schema, model, state }.unmet(bound, call);
    }
    found
}

/// An action in a state.
struct Here<'a> {
    schema: &'a ActionSchema,
    model: &'a ActionModel,
    state: &'a State,
}

impl Here<'_> {
    fn unmet(&self, bound: &[Option<usize>], call: &GroundCall) -> Vec<String> {
        let mut objects: Vec<Option<Symbol>> =
            bound.iter().map(|argument| argument.map(|argument| call.args[argument].clone())).collect();
        let failing = self.schema.preconditions.iter().filter(|literal| self.holds(literal, &objects) == Some(false));
        let failing: Vec<String> = failing.map(|literal| needed(literal, &objects)).collect();
        if !failing.is_empty() {
            return failing;
        }
        let open: Vec<usize> = (0..objects.len()).filter(|&parameter| objects[parameter].is_none()).collect();
        if self.has_choice(&open, &mut objects, &mut 0) {
            return Vec::new();
        }
        let named = |literal: &&Literal| {
            literal.atom.args.iter().any(|term| matches!(term, Term::Param(p) if open.contains(&(*p as usize))))
        };
        let needs: Vec<String> =
            self.schema.preconditions.iter().filter(named).map(|literal| self.written(literal, &objects)).collect();
        vec![format!("nothing there is such that {}", needs.join(" and "))]
    }

    /// Whether objects of the state can stand for the parameters that the call does not name.
    fn has_choice(&self, open: &[usize], objects: &mut Vec<Option<Symbol>>, tried: &mut usize) -> bool {
        let Some((&parameter, rest)) = open.split_first() else { return true };
        let hierarchy = &self.model.hierarchy;
        let wanted = self.schema.parameters[parameter].ty;
        let taken: BTreeSet<Symbol> = self.distinct_from(parameter, objects).collect();
        for (object, ty) in &self.state.objects {
            if !hierarchy.is_a(*ty, wanted) || taken.contains(object) {
                continue;
            }
            *tried += 1;
            objects[parameter] = Some(object.clone());
            let fits = self.schema.preconditions.iter().all(|literal| self.holds(literal, objects) != Some(false));
            if *tried > MOST_CHOICES || fits && self.has_choice(rest, objects, tried) {
                objects[parameter] = None;
                return true;
            }
        }
        objects[parameter] = None;
        false
    }

    /// The objects that this parameter must differ from.
    fn distinct_from<'o>(
        &'o self,
        parameter: usize,
        objects: &'o [Option<Symbol>],
    ) -> impl Iterator<Item = Symbol> + 'o {
        self.schema.distinct.iter().filter_map(move |&(a, b)| {
            let (a, b) = (a as usize, b as usize);
            let other = if a == parameter { b } else { a };
            (a == parameter || b == parameter).then(|| objects[other].clone()).flatten()
        })
    }

    /// Whether a literal holds, as far as its objects are chosen, are there, and it is known.
    fn holds(&self, literal: &Literal, objects: &[Option<Symbol>]) -> Option<bool> {
        let is_there = |name: &Symbol| self.state.objects.contains_key(name) || self.model.constants.contains_key(name);
        let object = |term: &Term| match term {
            Term::Const(name) => Some(name.clone()),
            Term::Param(parameter) => objects[*parameter as usize].clone(),
        };
        let args = literal.atom.args.iter().map(object).collect::<Option<Vec<_>>>()?;
        let atom = GroundAtom { predicate: literal.atom.predicate.clone(), args };
        let is_known = atom.args.iter().all(is_there) && !self.state.is_unknown(&atom);
        is_known.then(|| self.state.holds(&atom) == literal.positive)
    }

    /// A literal with `any cup` where nothing is chosen.
    fn written(&self, literal: &Literal, objects: &[Option<Symbol>]) -> String {
        let arg = |term: &Term| match term {
            Term::Const(name) => name.to_string(),
            Term::Param(parameter) => match &objects[*parameter as usize] {
                Some(object) => object.to_string(),
                None => format!("a {}", self.model.hierarchy.name(self.schema.parameters[*parameter as usize].ty)),
            },
        };
        let args: Vec<String> = literal.atom.args.iter().map(arg).collect();
        let not = if literal.positive { "" } else { "not " };
        format!("{not}{}({})", literal.atom.predicate, args.join(","))
    }
}

/// `lit(lamp_1) does not hold`, of a literal all of whose objects are chosen.
fn needed(literal: &Literal, objects: &[Option<Symbol>]) -> String {
    let atom = literal.atom.map(|term| match term {
        Term::Param(parameter) => Term::Const(objects[*parameter as usize].clone().unwrap_or_default()),
        Term::Const(name) => Term::Const(name.clone()),
    });
    match literal.positive {
        true => format!("{atom} does not hold"),
        false => format!("{atom} holds, and must not"),
    }
}
