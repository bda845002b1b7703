//! From a complete binding to a ground action or axiom, and the facts that it reaches.

use std::collections::BTreeSet;

use typelift_model::{ActionSchema, GroundAtom, GroundCall, Stop, Symbol};

use crate::Ban;
use crate::fact::{FactId, ObjectId};
use crate::pattern::{Compiled, CompiledEffect, Condition, Pattern, Source};
use crate::reach::{Join, Pending, RawEffect, RawOp};

impl Join<'_> {
    pub(crate) fn add_instance(&mut self, schema: &Compiled<'_>, binding: &[Option<ObjectId>]) -> Result<(), Stop> {
        let Some((preconditions, negative)) = self.ground_condition(&schema.condition, binding) else {
            return Ok(());
        };
        let mut effects = Vec::with_capacity(schema.effects.len());
        for effect in &schema.effects {
            let mut binding = binding.to_vec();
            let own = binding.len();
            binding.resize(own + effect.fits.len(), None);
            self.ground_effect(effect, own, 0, &mut binding, &mut effects)?;
        }
        effects.sort_unstable();
        effects.dedup();
        self.poll.check(effects.len())?;
        let objects: Box<[ObjectId]> = binding.iter().copied().flatten().collect();
        let (Source::Action(index, _) | Source::Axiom(index)) = schema.source;
        let op = RawOp { schema: index, objects, preconditions, negative, effects };
        if let Source::Action(_, schema) = schema.source
            && self.is_restricted(schema, &op)
        {
            return Ok(());
        }
        for effect in op.effects.iter().filter(|effect| effect.adds) {
            let missing: Vec<FactId> =
                effect.condition.iter().copied().filter(|&c| !self.facts.is_reached(c)).collect();
            if missing.is_empty() {
                self.reach_fact(effect.fact);
            } else {
                for &condition in &missing {
                    self.waiting.entry(condition).or_default().push(self.pending.len());
                }
                self.pending.push(Pending { missing: missing.len(), fact: effect.fact });
            }
        }
        match schema.source {
            Source::Action(..) => self.ops.push(op),
            Source::Axiom(_) => self.axioms.push(op),
        }
        self.poll.check(1)
    }

    /// The facts that must hold, and those that must not; `None` if they never can as they should.
    fn ground_condition(
        &mut self,
        condition: &Condition,
        binding: &[Option<ObjectId>],
    ) -> Option<(Vec<FactId>, Vec<FactId>)> {
        if !condition.comparisons.iter().all(|comparison| comparison.allows(binding)) {
            return None;
        }
        let mut all = |patterns: &[Pattern], wanted: bool| -> Option<Vec<FactId>> {
            let mut list = Vec::with_capacity(patterns.len());
            for pattern in patterns {
                if self.fluents.contains(&pattern.predicate) {
                    list.push(self.ground_pattern(pattern, binding));
                    continue;
                }
                // What nothing changes is as it is initially.
                let fact = self.initial_fact(pattern, binding);
                if fact.is_some() != wanted {
                    return None;
                }
                list.extend(fact);
            }
            Some(list)
        };
        let positive = all(&condition.positive, true)?;
        Some((positive, all(&condition.negative, false)?))
    }

    fn ground_pattern(&mut self, pattern: &Pattern, binding: &[Option<ObjectId>]) -> FactId {
        let args = pattern.args.iter().filter_map(|arg| arg.object(binding));
        self.facts.intern(pattern.predicate, args.collect())
    }

    /// The fact of a predicate that nothing changes, if it holds.
    fn initial_fact(&self, pattern: &Pattern, binding: &[Option<ObjectId>]) -> Option<FactId> {
        let args = pattern.args.iter().filter_map(|arg| arg.object(binding));
        self.facts.find_by_ids(pattern.predicate, args.collect()).filter(|&fact| self.facts.is_reached(fact))
    }

    /// Grounds an effect for every choice of objects for its own parameters, from the one at `next` on; `own` is the
    /// number of its action's parameters.
    fn ground_effect(
        &mut self,
        effect: &CompiledEffect,
        own: usize,
        next: usize,
        binding: &mut [Option<ObjectId>],
        into: &mut Vec<RawEffect>,
    ) -> Result<(), Stop> {
        if next == effect.fits.len() {
            if let Some((condition, negative_condition)) = self.ground_condition(&effect.condition, binding) {
                let fact = self.ground_pattern(&effect.result, binding);
                into.push(RawEffect { condition, negative_condition, fact, adds: effect.adds });
            }
            return Ok(());
        }
        self.poll.check(self.facts.objects.len())?;
        for object in self.facts.object_ids().filter(|object| effect.fits[next][object.index()]) {
            binding[own + next] = Some(object);
            if self.can_still_hold(&effect.condition, binding) {
                self.ground_effect(effect, own, next + 1, binding, into)?;
            }
        }
        binding[own + next] = None;
        Ok(())
    }

    /// Whether nothing that is bound already, and that nothing changes, contradicts a condition.
    fn can_still_hold(&self, condition: &Condition, binding: &[Option<ObjectId>]) -> bool {
        let is_decided = |pattern: &&Pattern| {
            !self.fluents.contains(&pattern.predicate) && pattern.args.iter().all(|arg| arg.object(binding).is_some())
        };
        let mut decided = condition.positive.iter().filter(is_decided);
        condition.comparisons.iter().all(|comparison| comparison.allows(binding))
            && decided.all(|pattern| self.initial_fact(pattern, binding).is_some())
    }

    fn is_restricted(&self, schema: &ActionSchema, op: &RawOp) -> bool {
        if !self.restrictions.types.is_empty() {
            let types: Vec<_> = op.objects.iter().map(|&object| Some(self.facts.objects[object.index()].1)).collect();
            if !self.restrictions.allows_types(schema, &types, self.hierarchy) {
                return true;
            }
        }
        if self.restrictions.banned.is_empty() && self.restrictions.calls.is_empty() {
            return false;
        }
        let objects: Vec<Symbol> = op.objects.iter().map(|&o| self.facts.name(o).clone()).collect();
        let args = || schema.call.args.iter().map(|term| term.object(&objects));
        let is_of = |call: &GroundCall| call.name == schema.call.name && args().eq(call.args.iter().cloned());
        let conditional = schema.effects.iter().any(|effect| !effect.is_unconditional());
        let is_banned = |ban: &Ban| {
            is_of(&ban.call) && if conditional { ban.action == schema.name } else { self.effect_is(op, ban) }
        };
        self.restrictions.calls.iter().any(is_of) || self.restrictions.banned.iter().any(is_banned)
    }

    /// Whether the unconditional effect of a ground action is the one that was banned.
    fn effect_is(&self, op: &RawOp, ban: &Ban) -> bool {
        let atoms = |adds: bool| -> BTreeSet<GroundAtom> {
            op.effects.iter().filter(|e| e.adds == adds).map(|e| self.facts.atom(e.fact)).collect()
        };
        let adds = atoms(true);
        adds.iter().eq(&ban.adds) && atoms(false).difference(&adds).eq(&ban.deletes)
    }
}
