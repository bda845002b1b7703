//! What is read off for a call: how likely it works, by which action, and what speaks against it.

use serde::Serialize;
use typelift_model::{
    ActionModel, ActionSchema, GroundAtom, GroundCall, Hierarchy, LearnedModel, LiftedAtom, State, Symbol, Term, TypeId,
};

use crate::action::ActionBelief;
use crate::cause::{Cause, Culprit};
use crate::run::Run;
use crate::unmet::unmet;

/// A call whose fate is asked.
#[derive(Debug, Clone)]
pub struct Question<'q> {
    /// The call.
    pub call: &'q GroundCall,
    /// The type of each of its arguments; `None` for one that the hierarchy does not know.
    pub types: &'q [Option<TypeId>],
    /// Where it is used; without a state every literal counts as true, as an unknown one does, and one of an object that is
    /// not there.
    pub state: Option<&'q State>,
}

/// Something that speaks against a call.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Suspect {
    /// Of what kind it is.
    pub kind: Culprit,
    /// The type, the two types, or the literal; empty for chance.
    pub what: String,
    /// How much of what speaks against the call it is, from 0 to 1.
    pub share: f64,
}

/// What is believed of a call.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// How likely it works, from 0 to 1: that what the action predicts happens.
    pub p: f64,
    /// The action that predicts it; none where no action has such a call.
    pub action: Option<Symbol>,
    /// What speaks against it, the greatest share first.
    pub suspects: Vec<Suspect>,
    /// Why the model alone does not allow it, a phrase each: wrong types, or preconditions that do not hold in the state.
    pub unmet: Vec<String>,
}

/// What is believed of every action of a learned model.
#[derive(Debug, Clone)]
pub struct Belief<'m> {
    model: &'m ActionModel,
    actions: Vec<ActionBelief>,
}

impl<'m> Belief<'m> {
    /// What a model's evidence says of its actions.
    pub fn of(learned: &'m LearnedModel) -> Self {
        let (model, observed) = (&learned.model, learned.evidence.total());
        let actions = model.actions.iter().map(|schema| ActionBelief::new(schema, &observed, &Run::default(), model));
        Self { model, actions: actions.collect() }
    }

    /// How likely a call works: by the action of which that is likeliest, of several alike the first by name; by one that the
    /// model allows, if it allows any.
    pub fn judge(&self, question: &Question<'_>) -> Judgement {
        let schemas = self.model.actions.iter().zip(&self.actions);
        let judged = schemas.filter_map(|(schema, belief)| self.judge_by(schema, belief, question));
        let nothing = Judgement { p: 0.0, action: None, suspects: Vec::new(), unmet: Vec::new() };
        let rank = |judgement: &Judgement| (judgement.action.is_some(), judgement.unmet.is_empty(), judgement.p);
        judged.fold(nothing, |best, next| if rank(&next) > rank(&best) { next } else { best })
    }

    fn judge_by(&self, schema: &ActionSchema, belief: &ActionBelief, question: &Question<'_>) -> Option<Judgement> {
        let bound = bound(schema, question)?;
        let mut types = vec![None; schema.parameters.len()];
        for (parameter, argument) in bound.iter().enumerate().filter_map(|(p, argument)| Some((p, (*argument)?))) {
            types[parameter] = Some(question.types[argument]?);
        }
        let known = |atom: &LiftedAtom, holds: bool| {
            let (ground, state) = (ground(atom, &bound, question.call)?, question.state?);
            let is_there = |arg: &Symbol| state.objects.contains_key(arg) || self.model.constants.contains_key(arg);
            let tells = ground.args.iter().all(is_there) && !state.is_unknown(&ground);
            (tells && state.holds(&ground) == holds).then(|| atom.clone())
        };
        let missing = belief.literals().filter_map(|atom| known(atom, false));
        let present = belief.absent().filter_map(|atom| known(atom, true));
        let causes = belief.against(&self.model.hierarchy, &types, missing, present);
        let p = belief.works(&causes);
        let sum: f64 = causes.iter().map(|(_, odds)| odds).sum();
        let mut suspects: Vec<Suspect> = causes
            .into_iter()
            .filter(|(_, odds)| odds / sum >= LEAST_SHARE)
            .map(|(cause, odds)| self.suspect(&cause, odds / sum, &bound, question.call))
            .collect();
        suspects.sort_by(|a, b| b.share.total_cmp(&a.share).then_with(|| a.what.cmp(&b.what)));
        let unmet = unmet(schema, &bound, question.call, question.types, question.state, self.model);
        Some(Judgement { p, action: Some(schema.name.clone()), suspects, unmet })
    }

    fn suspect(&self, cause: &Cause, share: f64, bound: &[Option<usize>], call: &GroundCall) -> Suspect {
        let hierarchy: &Hierarchy = &self.model.hierarchy;
        let in_call = |atom| ground(atom, bound, call).map(|atom| atom.to_string()).unwrap_or_default();
        let what = match cause {
            Cause::Type(_, ty) => hierarchy.name(*ty).to_string(),
            Cause::Together(((_, one), (_, other))) => {
                format!("{} with {}", hierarchy.name(*one), hierarchy.name(*other))
            }
            Cause::Missing(atom) => in_call(atom),
            Cause::Present(atom) => format!("not {}", in_call(atom)),
            Cause::Object { object, .. } => object.to_string(),
            Cause::Around(surrounding, held) => {
                let name = |at: u32| {
                    bound[at as usize]
                        .map_or_else(|| format!("#{}", at + 1), |argument| call.args[argument].to_string())
                };
                format!("{}{}", if *held { "not " } else { "" }, surrounding.in_words(name))
            }
            Cause::Chance => String::new(),
        };
        Suspect { kind: cause.culprit(), what, share }
    }
}

/// Smaller shares are not told.
const LEAST_SHARE: f64 = 0.005;

/// For each parameter the argument that stands there, if the call names one; none if the action has another call.
fn bound(schema: &ActionSchema, question: &Question<'_>) -> Option<Vec<Option<usize>>> {
    if schema.call.name != question.call.name || schema.call.args.len() != question.call.args.len() {
        return None;
    }
    let mut bound: Vec<Option<usize>> = vec![None; schema.parameters.len()];
    for (at, term) in schema.call.args.iter().enumerate() {
        match term {
            Term::Const(name) if *name != question.call.args[at] => return None,
            Term::Const(_) => {}
            Term::Param(parameter) => match bound[*parameter as usize] {
                Some(known) if question.call.args[known] != question.call.args[at] => return None,
                Some(_) => {}
                None => bound[*parameter as usize] = Some(at),
            },
        }
    }
    Some(bound)
}

/// An atom over parameters as one over the call's objects; none if it speaks of what the call does not name.
fn ground(atom: &LiftedAtom, bound: &[Option<usize>], call: &GroundCall) -> Option<GroundAtom> {
    let object = |term: &Term| match term {
        Term::Const(name) => Some(name.clone()),
        Term::Param(parameter) => Some(call.args[bound[*parameter as usize]?].clone()),
    };
    let args = atom.args.iter().map(object).collect::<Option<Vec<_>>>()?;
    Some(GroundAtom { predicate: atom.predicate.clone(), args })
}
