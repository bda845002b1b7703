//! Schemas with their names interned, ready to be joined with facts.

use typelift_model::{ActionModel, ActionSchema, LiftedAtom, Term};

use crate::Restrictions;
use crate::fact::{Facts, ObjectId};

/// An atom pattern with interned names.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    pub(crate) predicate: u32,
    pub(crate) args: Vec<Arg>,
}

#[derive(Debug, Clone, Copy)]
pub(crate) enum Arg {
    Param(usize),
    Object(ObjectId),
}

/// A schema with interned names.
pub(crate) struct Compiled<'a> {
    pub(crate) index: usize,
    pub(crate) schema: &'a ActionSchema,
    pub(crate) preconditions: Vec<Pattern>,
    pub(crate) negative: Vec<Pattern>,
    pub(crate) effects: Vec<(Vec<Pattern>, Vec<Pattern>, Pattern, bool)>,
    /// For each parameter, whether each object may take its place.
    pub(crate) fits: Vec<Vec<bool>>,
}

/// A schema with names interned; `None` if it mentions a constant that the task does not have.
pub(crate) fn compile<'a>(
    index: usize,
    schema: &'a ActionSchema,
    model: &ActionModel,
    restrictions: &Restrictions,
    facts: &mut Facts,
) -> Option<Compiled<'a>> {
    fn pattern(atom: &LiftedAtom, facts: &mut Facts) -> Option<Pattern> {
        let args = atom.args.iter().map(|term| match term {
            Term::Param(i) => Some(Arg::Param(*i as usize)),
            Term::Const(name) => facts.object_id(name).map(Arg::Object),
        });
        let args = args.collect::<Option<_>>()?;
        Some(Pattern { predicate: facts.predicate_id(&atom.predicate), args })
    }
    let (mut preconditions, mut negative) = (Vec::new(), Vec::new());
    for literal in &schema.preconditions {
        let list = if literal.positive { &mut preconditions } else { &mut negative };
        list.push(pattern(&literal.atom, facts)?);
    }
    let mut effects = Vec::with_capacity(schema.effects.len());
    for effect in &schema.effects {
        let (mut condition, mut negative_condition) = (Vec::new(), Vec::new());
        for literal in &effect.condition {
            let list = if literal.positive { &mut condition } else { &mut negative_condition };
            list.push(pattern(&literal.atom, facts)?);
        }
        effects.push((condition, negative_condition, pattern(&effect.literal.atom, facts)?, effect.literal.positive));
    }
    let fits = schema.parameters.iter().map(|parameter| {
        let objects = facts.objects.iter();
        objects
            .map(|(name, ty)| model.hierarchy.is_a(*ty, parameter.ty) && restrictions.allows(name, &schema.call.name))
            .collect()
    });
    let fits = fits.collect();
    Some(Compiled { index, schema, preconditions, negative, effects, fits })
}
