//! Relaxed reachability: which facts can become true, and which ground actions applicable, if nothing were ever
//! deleted.
//!
//! Semi-naive evaluation: each fact, when it is first reached, is joined with the facts reached before it through
//! the positive preconditions of every schema that mentions its predicate, always through the precondition with
//! the fewest candidate facts under the bindings so far. The full product of objects is never formed; only
//! parameters that no positive precondition mentions range over all objects of their type. Negative preconditions
//! are ignored, as deletes are, unless nothing ever changes what they speak of. An effect with a condition is reached
//! when the positive part of it is. Axioms are joined as actions are.

use typelift_model::{ActionModel, Budget, GroundAtom, HashMap, HashSet, Hierarchy, Stop, Symbol, Task, bind_places};

use crate::Restrictions;
use crate::fact::{FactId, Facts, ObjectId};
use crate::pattern::{Arg, Compiled, Compiler, Pattern, fluents};
use crate::poll::Poll;
use crate::scope::{EAGERLY, Scopes};

/// A ground action or axiom as reachability finds it.
#[derive(Debug, Clone)]
pub(crate) struct RawOp {
    /// The schema's or axiom's index in the model.
    pub(crate) schema: usize,
    pub(crate) objects: Box<[ObjectId]>,
    pub(crate) preconditions: Vec<FactId>,
    pub(crate) negative: Vec<FactId>,
    pub(crate) effects: Vec<RawEffect>,
}

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct RawEffect {
    pub(crate) condition: Vec<FactId>,
    pub(crate) negative_condition: Vec<FactId>,
    pub(crate) fact: FactId,
    pub(crate) adds: bool,
}

/// What can be reached from a task's initial state if nothing is ever deleted, with one model under some restrictions:
/// atoms, and inside also ground actions. Grounding, imagination and explanation start from it.
#[derive(Debug)]
pub struct Reachable {
    pub(crate) facts: Facts,
    pub(crate) ops: Vec<RawOp>,
    pub(crate) axioms: Vec<RawOp>,
    unreached_goals: Vec<GroundAtom>,
    undeleted_goals: Vec<GroundAtom>,
    computed: u64,
}

impl Reachable {
    /// Computes it.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub fn of(model: &ActionModel, task: &Task, restrictions: &Restrictions, budget: &Budget) -> Result<Self, Stop> {
        let (facts, ops, axioms) = reach(model, task, restrictions, budget)?;
        let mut this =
            Self { facts, ops, axioms, unreached_goals: Vec::new(), undeleted_goals: Vec::new(), computed: 1 };
        this.unreached_goals = task.goal.required.iter().filter(|atom| !this.reaches(atom)).cloned().collect();
        this.undeleted_goals = this.undeleted(model, task);
        Ok(this)
    }

    /// With some of a large task's objects, if all goals are reached with these; else with all. What is found with some is
    /// found with all.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub fn with_few_objects(
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let mut scopes = Scopes::of(model, task, restrictions, EAGERLY);
        let mut computed = 0;
        loop {
            let mut this = Self::of(model, &scopes.restrict(task), restrictions, budget)?;
            computed += 1;
            if scopes.is_whole() || this.unreached_goals.is_empty() && this.undeleted_goals.is_empty() {
                this.computed = computed;
                return Ok(this);
            }
            scopes.advance();
        }
    }

    /// GetUnreachableGoals: goal atoms that cannot be reached, in the goal's order.
    pub fn unreached_goals(&self) -> &[GroundAtom] {
        &self.unreached_goals
    }

    /// Atoms that hold, are not to hold in the end, and are deleted by nothing that is reached, in the goal's order.
    pub fn undeleted_goals(&self) -> &[GroundAtom] {
        &self.undeleted_goals
    }

    /// Works these out. What follows from others is no effect, and not judged.
    fn undeleted(&self, model: &ActionModel, task: &Task) -> Vec<GroundAtom> {
        let derived = model.derived_predicates();
        let deletes = |op: &RawOp, fact: FactId| {
            op.effects.iter().any(|effect| effect.fact == fact && !effect.adds)
                && !op.effects.iter().any(|effect| effect.fact == fact && effect.adds && effect.condition.is_empty())
        };
        let is_deleted =
            |atom: &GroundAtom| self.facts.find(atom).is_some_and(|fact| self.ops.iter().any(|op| deletes(op, fact)));
        let held = task.goal.forbidden.iter().filter(|atom| task.init.holds(atom));
        held.filter(|atom| !derived.contains(&atom.predicate) && !is_deleted(atom)).cloned().collect()
    }

    /// Whether an atom is reached.
    pub fn reaches(&self, atom: &GroundAtom) -> bool {
        self.facts.find(atom).is_some_and(|fact| self.facts.is_reached(fact))
    }

    /// The atoms reached, by predicate.
    pub fn atoms_by_predicate(&self) -> HashMap<Symbol, Vec<GroundAtom>> {
        let mut atoms: HashMap<Symbol, Vec<GroundAtom>> = HashMap::default();
        for fact in self.facts.ids().filter(|&fact| self.facts.is_reached(fact)) {
            let atom = self.facts.atom(fact);
            atoms.entry(atom.predicate.clone()).or_default().push(atom);
        }
        atoms
    }

    /// How often reachability was computed to get this.
    pub fn computed(&self) -> u64 {
        self.computed
    }

    /// Whether it was computed with this task's objects.
    pub(crate) fn has_objects_of(&self, task: &Task) -> bool {
        self.facts.objects.iter().map(|(name, _)| name).eq(task.init.objects.keys())
    }
}

/// The facts, ground actions and ground axioms reachable from the task's initial state without deletes.
fn reach(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    budget: &Budget,
) -> Result<(Facts, Vec<RawOp>, Vec<RawOp>), Stop> {
    let mut facts = Facts::new(task);
    let mut compiler = Compiler { model, restrictions, facts: &mut facts };
    let mut schemas: Vec<Compiled<'_>> =
        model.actions.iter().enumerate().filter_map(|(i, schema)| compiler.action(i, schema)).collect();
    schemas.extend(model.axioms.iter().enumerate().filter_map(|(i, axiom)| compiler.axiom(i, axiom)));
    let triggers = triggers(&schemas, facts.predicate_count());
    let mut join = Join {
        hierarchy: &model.hierarchy,
        restrictions,
        facts,
        fluents: fluents(&schemas),
        ops: Vec::new(),
        axioms: Vec::new(),
        queue: Vec::new(),
        by_predicate: HashMap::default(),
        by_argument: HashMap::default(),
        waiting: HashMap::default(),
        pending: Vec::new(),
        trigger: None,
        poll: Poll::new(budget),
    };
    let derived = model.derived_predicates();
    for atom in task.init.atoms.iter().filter(|atom| !derived.contains(&atom.predicate)) {
        if let Some(fact) = join.facts.intern_atom(atom) {
            join.reach_fact(fact);
        }
    }
    for schema in schemas.iter().filter(|s| s.condition.positive.is_empty()) {
        join.extend(schema, &mut vec![None; schema.fits.len()], &mut Vec::new())?;
    }
    let mut next = 0;
    while next < join.queue.len() {
        let fact = join.queue[next];
        next += 1;
        join.index(fact);
        let predicate = join.facts.predicate(fact) as usize;
        // Facts of predicates that no precondition mentions trigger nothing.
        for &(s, k) in triggers.get(predicate).map_or(&[][..], Vec::as_slice) {
            let schema = &schemas[s];
            let mut binding = vec![None; schema.fits.len()];
            if join.bind(schema, &schema.condition.positive[k], fact, &mut binding).is_some() {
                let mut open: Vec<(usize, bool)> =
                    (0..schema.condition.positive.len()).filter(|&j| j != k).map(|j| (j, j < k)).collect();
                join.trigger = Some(fact);
                join.extend(schema, &mut binding, &mut open)?;
            }
        }
    }
    Ok((join.facts, join.ops, join.axioms))
}

/// For each predicate, the schemas whose conditions mention it, and where.
fn triggers(schemas: &[Compiled<'_>], predicates: usize) -> Vec<Vec<(usize, usize)>> {
    let mut triggers = vec![Vec::new(); predicates];
    for (s, schema) in schemas.iter().enumerate() {
        for (k, pattern) in schema.condition.positive.iter().enumerate() {
            triggers[pattern.predicate as usize].push((s, k));
        }
    }
    triggers
}

/// An effect whose condition is not reached yet.
pub(crate) struct Pending {
    pub(crate) missing: usize,
    pub(crate) fact: FactId,
}

pub(crate) struct Join<'a> {
    pub(crate) hierarchy: &'a Hierarchy,
    pub(crate) restrictions: &'a Restrictions,
    pub(crate) facts: Facts,
    /// The predicates that anything changes.
    pub(crate) fluents: HashSet<u32>,
    pub(crate) ops: Vec<RawOp>,
    pub(crate) axioms: Vec<RawOp>,
    /// Reached facts, in the order in which they were reached.
    pub(crate) queue: Vec<FactId>,
    pub(crate) by_predicate: HashMap<u32, Vec<FactId>>,
    pub(crate) by_argument: HashMap<(u32, usize, ObjectId), Vec<FactId>>,
    /// Which pending effects wait for a fact.
    pub(crate) waiting: HashMap<FactId, Vec<usize>>,
    pub(crate) pending: Vec<Pending>,
    /// The fact being joined: preconditions before the one it came through may not match it again.
    pub(crate) trigger: Option<FactId>,
    /// Counts joins and ground actions.
    pub(crate) poll: Poll<'a>,
}

impl Join<'_> {
    pub(crate) fn reach_fact(&mut self, fact: FactId) {
        let mut stack = vec![fact];
        while let Some(fact) = stack.pop() {
            if self.facts.is_reached(fact) {
                continue;
            }
            self.facts.reach(fact);
            self.queue.push(fact);
            for waiting in self.waiting.remove(&fact).unwrap_or_default() {
                let pending = &mut self.pending[waiting];
                pending.missing -= 1;
                if pending.missing == 0 {
                    stack.push(pending.fact);
                }
            }
        }
    }

    fn index(&mut self, fact: FactId) {
        let (predicate, args) = (self.facts.predicate(fact), self.facts.args(fact));
        self.by_predicate.entry(predicate).or_default().push(fact);
        for (position, object) in args.iter().enumerate() {
            self.by_argument.entry((predicate, position, *object)).or_default().push(fact);
        }
    }

    /// Matches a pattern with a fact under a binding; the parameters newly bound, or `None` with the binding
    /// unchanged.
    fn bind(
        &self,
        schema: &Compiled<'_>,
        pattern: &Pattern,
        fact: FactId,
        binding: &mut [Option<ObjectId>],
    ) -> Option<Vec<usize>> {
        let (places, objects) = (pattern.args.iter().copied(), self.facts.args(fact).iter().copied());
        bind_places(places, objects, binding, |p, object, binding| self.may_take(schema, p, object, binding))
    }

    fn may_take(
        &self,
        schema: &Compiled<'_>,
        parameter: usize,
        object: ObjectId,
        binding: &[Option<ObjectId>],
    ) -> bool {
        schema.fits[parameter][object.index()]
            && schema.condition.comparisons.iter().all(|c| c.allows_binding(parameter, object, binding))
    }

    /// The shortest list of facts that holds every match of a pattern.
    fn candidates(&self, pattern: &Pattern, binding: &[Option<ObjectId>]) -> &[FactId] {
        let mut best = self.by_predicate.get(&pattern.predicate).map_or(&[][..], Vec::as_slice);
        for (position, arg) in pattern.args.iter().enumerate() {
            let object = match *arg {
                Arg::Object(object) => Some(object),
                Arg::Param(p) => binding[p],
            };
            if let Some(object) = object {
                let list = self.by_argument.get(&(pattern.predicate, position, object));
                let list = list.map_or(&[][..], Vec::as_slice);
                if list.len() < best.len() {
                    best = list;
                }
            }
        }
        best
    }

    /// Completes a binding in every way through the open preconditions (each with whether it must not match the
    /// trigger), then through parameters that none mentions.
    fn extend(
        &mut self,
        schema: &Compiled<'_>,
        binding: &mut Vec<Option<ObjectId>>,
        open: &mut Vec<(usize, bool)>,
    ) -> Result<(), Stop> {
        let best =
            (0..open.len()).min_by_key(|&i| self.candidates(&schema.condition.positive[open[i].0], binding).len());
        let Some(best) = best else { return self.complete(schema, binding) };
        let (k, older) = open.swap_remove(best);
        let pattern = &schema.condition.positive[k];
        let candidates = self.candidates(pattern, binding).to_vec();
        self.poll.check(1 + candidates.len())?;
        for fact in candidates {
            if older && self.trigger == Some(fact) {
                continue;
            }
            if let Some(bound) = self.bind(schema, pattern, fact, binding) {
                self.extend(schema, binding, open)?;
                for p in bound {
                    binding[p] = None;
                }
            }
        }
        open.push((k, older));
        let last = open.len() - 1;
        open.swap(best, last);
        Ok(())
    }

    fn complete(&mut self, schema: &Compiled<'_>, binding: &mut Vec<Option<ObjectId>>) -> Result<(), Stop> {
        let Some(free) = binding.iter().position(Option::is_none) else { return self.add_instance(schema, binding) };
        self.poll.check(self.facts.objects.len())?;
        for object in self.facts.object_ids() {
            if self.may_take(schema, free, object, binding) {
                binding[free] = Some(object);
                self.complete(schema, binding)?;
                binding[free] = None;
            }
        }
        Ok(())
    }
}
