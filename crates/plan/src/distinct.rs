//! Ground actions, each kept once: of those with the same call, preconditions, effect and cost, the first.

use std::hash::{BuildHasher, Hash, Hasher};

use typelift_model::{ActionSchema, Budget, HashMap, Stop, Symbol};

use crate::ground::Op;
use crate::memory::held;

/// Distinct ground actions.
pub(crate) struct Distinct<'a> {
    schemas: &'a [ActionSchema],
    ops: Vec<Op>,
    /// The last action with each hash.
    by_hash: HashMap<u64, usize>,
    /// For each action the one before it with the same hash.
    earlier: Vec<Option<usize>>,
    /// The bytes they hold, roughly.
    bytes: u64,
}

impl<'a> Distinct<'a> {
    pub(crate) fn new(schemas: &'a [ActionSchema]) -> Self {
        Self { schemas, ops: Vec::new(), by_hash: HashMap::default(), earlier: Vec::new(), bytes: 0 }
    }

    /// Keeps an action unless there is the same one; `others` are bytes that are held besides.
    pub(crate) fn insert(&mut self, op: Op, others: u64, budget: &Budget) -> Result<(), Stop> {
        let hash = self.hash(&op);
        let mut known = self.by_hash.get(&hash).copied();
        while let Some(index) = known {
            if self.is_same(&self.ops[index], &op) {
                return Ok(());
            }
            known = self.earlier[index];
        }
        self.earlier.push(self.by_hash.insert(hash, self.ops.len()));
        // With its share of the two tables.
        self.bytes += op.bytes() + 48;
        self.ops.push(op);
        if budget.bytes.is_some_and(|limit| self.bytes + others > limit) { Err(Stop::Memory) } else { Ok(()) }
    }

    fn call<'b>(&'b self, op: &'b Op) -> (&'b Symbol, impl Iterator<Item = Symbol> + 'b) {
        let call = &self.schemas[op.schema].call;
        (&call.name, call.args.iter().map(|term| term.object(&op.objects)))
    }

    fn hash(&self, op: &Op) -> u64 {
        let mut hasher = rustc_hash::FxBuildHasher.build_hasher();
        let (name, args) = self.call(op);
        name.hash(&mut hasher);
        args.for_each(|object| object.hash(&mut hasher));
        (&op.preconditions, &op.negative, op.cost).hash(&mut hasher);
        (&op.adds, &op.deletes, &op.conditional).hash(&mut hasher);
        hasher.finish()
    }

    fn is_same(&self, a: &Op, b: &Op) -> bool {
        let ((a_name, a_args), (b_name, b_args)) = (self.call(a), self.call(b));
        a.cost == b.cost
            && (&a.preconditions, &a.negative) == (&b.preconditions, &b.negative)
            && (&a.adds, &a.deletes, &a.conditional) == (&b.adds, &b.deletes, &b.conditional)
            && a_name == b_name
            && a_args.eq(b_args)
    }

    /// The actions, in the order in which they came, and the bytes they hold.
    pub(crate) fn into_ops(self) -> (Vec<Op>, u64) {
        (self.ops, self.bytes)
    }
}

impl Op {
    /// Bytes it holds, roughly.
    fn bytes(&self) -> u64 {
        let facts = [&self.preconditions, &self.negative, &self.adds, &self.deletes];
        let conditions = self.conditional.iter().flat_map(|effect| [&effect.positive, &effect.negative]);
        let lists: usize = facts.into_iter().chain(conditions).map(|list| held(list)).sum();
        (std::mem::size_of::<Self>() + held(&self.objects) + held(&self.conditional) + lists) as u64
    }
}
