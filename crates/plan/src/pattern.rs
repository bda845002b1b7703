//! Schemas and axioms with their names interned, ready to be joined with facts.

use typelift_model::{ActionModel, ActionSchema, Axiom, HashSet, LiftedAtom, Literal, Parameter, Place, Symbol, Term};

use crate::Restrictions;
use crate::fact::{Facts, ObjectId};

/// An atom pattern with interned names.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    pub(crate) predicate: u32,
    pub(crate) args: Vec<Arg>,
}

/// What a pattern has in one place.
pub(crate) type Arg = Place<ObjectId>;

/// Two things that must be the same object, or different ones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Comparison {
    a: Arg,
    b: Arg,
    equal: bool,
}

/// A conjunction of literals.
#[derive(Debug, Clone, Default)]
pub(crate) struct Condition {
    pub(crate) positive: Vec<Pattern>,
    pub(crate) negative: Vec<Pattern>,
    pub(crate) comparisons: Vec<Comparison>,
}

/// What a schema or an axiom brings about.
pub(crate) struct CompiledEffect {
    /// For each parameter of its own, whether each object may take its place.
    pub(crate) fits: Vec<Vec<bool>>,
    pub(crate) condition: Condition,
    pub(crate) result: Pattern,
    pub(crate) adds: bool,
}

/// What is being grounded.
#[derive(Clone, Copy)]
pub(crate) enum Source<'a> {
    /// An action schema, by its index in the model.
    Action(usize, &'a ActionSchema),
    /// An axiom, by its index in the model.
    Axiom(usize),
}

/// A schema or an axiom with interned names.
pub(crate) struct Compiled<'a> {
    pub(crate) source: Source<'a>,
    pub(crate) condition: Condition,
    pub(crate) effects: Vec<CompiledEffect>,
    /// For each parameter, whether each object may take its place.
    pub(crate) fits: Vec<Vec<bool>>,
}

impl Comparison {
    /// Whether it can still hold under a binding.
    pub(crate) fn allows(&self, binding: &[Option<ObjectId>]) -> bool {
        match (self.a.object(binding), self.b.object(binding)) {
            (Some(a), Some(b)) => (a == b) == self.equal,
            _ => true,
        }
    }

    /// Whether it can still hold if `object` takes the place of an unbound parameter.
    pub(crate) fn allows_binding(&self, p: usize, object: ObjectId, binding: &[Option<ObjectId>]) -> bool {
        let own = |arg: Arg| if arg == Arg::Param(p) { Some(object) } else { arg.object(binding) };
        match (own(self.a), own(self.b)) {
            (Some(a), Some(b)) => (a == b) == self.equal,
            _ => true,
        }
    }
}

/// Names, as the compiled schemas of one task share them.
pub(crate) struct Compiler<'a, 'f> {
    pub(crate) model: &'a ActionModel,
    pub(crate) restrictions: &'a Restrictions,
    pub(crate) facts: &'f mut Facts,
}

impl<'a> Compiler<'a, '_> {
    /// A schema with names interned; `None` if it mentions a constant that the task does not have, or can never be used.
    pub(crate) fn action(&mut self, index: usize, schema: &'a ActionSchema) -> Option<Compiled<'a>> {
        let mut condition = self.condition(&schema.preconditions)?;
        condition.comparisons.extend(schema.distinct.iter().map(|&(a, b)| Comparison {
            a: Arg::Param(a as usize),
            b: Arg::Param(b as usize),
            equal: false,
        }));
        let mut effects = Vec::with_capacity(schema.effects.len());
        for effect in &schema.effects {
            effects.push(CompiledEffect {
                fits: self.fits(&effect.parameters, None),
                condition: self.condition(&effect.condition)?,
                result: self.pattern(&effect.literal.atom)?,
                adds: effect.literal.positive,
            });
        }
        let fits = self.fits(&schema.parameters, Some(&schema.call.name));
        let nothing = vec![None; schema.parameters.len()];
        let possible = condition.comparisons.iter().all(|comparison| comparison.allows(&nothing));
        possible.then_some(Compiled { source: Source::Action(index, schema), condition, effects, fits })
    }

    /// An axiom with names interned, as for [`action`](Self::action).
    pub(crate) fn axiom(&mut self, index: usize, axiom: &Axiom) -> Option<Compiled<'a>> {
        let condition = self.condition(&axiom.body)?;
        let result = self.pattern(&axiom.head)?;
        let effects = vec![CompiledEffect { fits: Vec::new(), condition: Condition::default(), result, adds: true }];
        let fits = self.fits(&axiom.parameters, None);
        let nothing = vec![None; axiom.parameters.len()];
        let possible = condition.comparisons.iter().all(|comparison| comparison.allows(&nothing));
        possible.then_some(Compiled { source: Source::Axiom(index), condition, effects, fits })
    }

    fn condition(&mut self, literals: &[Literal]) -> Option<Condition> {
        let mut condition = Condition::default();
        for literal in literals {
            let pattern = self.pattern(&literal.atom)?;
            if literal.atom.is_equality() {
                condition.comparisons.push(Comparison {
                    a: *pattern.args.first()?,
                    b: *pattern.args.get(1)?,
                    equal: literal.positive,
                });
            } else if literal.positive {
                condition.positive.push(pattern);
            } else {
                condition.negative.push(pattern);
            }
        }
        Some(condition)
    }

    fn pattern(&mut self, atom: &LiftedAtom) -> Option<Pattern> {
        let args = atom.args.iter().map(|term| match term {
            Term::Param(i) => Some(Arg::Param(*i as usize)),
            Term::Const(name) => self.facts.object_id(name).map(Arg::Object),
        });
        let args = args.collect::<Option<_>>()?;
        Some(Pattern { predicate: self.facts.predicate_id(&atom.predicate), args })
    }

    fn fits(&self, parameters: &[Parameter], call: Option<&Symbol>) -> Vec<Vec<bool>> {
        let fits = parameters.iter().map(|parameter| {
            let objects = self.facts.objects.iter();
            let allowed = |name: &Symbol| call.is_none_or(|call| self.restrictions.allows(name, call));
            objects.map(|(name, ty)| self.model.hierarchy.is_a(*ty, parameter.ty) && allowed(name)).collect()
        });
        fits.collect()
    }
}

/// The predicates that actions change or axioms derive; the facts of all others are as they are initially.
pub(crate) fn fluents(schemas: &[Compiled<'_>]) -> HashSet<u32> {
    schemas.iter().flat_map(|schema| &schema.effects).map(|effect| effect.result.predicate).collect()
}
