//! Ground actions, each kept once: of those with the same call, preconditions, effect and cost, the first.

use std::hash::{BuildHasher, Hash, Hasher};

use typelift_model::{ActionSchema, HashMap, Symbol};

use crate::op::Op;

/// Distinct ground actions.
pub(crate) struct Distinct<'a> {
    schemas: &'a [ActionSchema],
    ops: Vec<Op>,
    /// The last action with each hash.
    by_hash: HashMap<u64, usize>,
    /// For each action the one before it with the same hash.
    earlier: Vec<Option<usize>>,
}

impl<'a> Distinct<'a> {
    pub(crate) fn new(schemas: &'a [ActionSchema]) -> Self {
        Self { schemas, ops: Vec::new(), by_hash: HashMap::default(), earlier: Vec::new() }
    }

    /// Keeps an action unless there is the same one.
    pub(crate) fn insert(&mut self, op: Op) {
        let hash = self.hash(&op);
        let mut known = self.by_hash.get(&hash).copied();
        while let Some(index) = known {
            if self.is_same(&self.ops[index], &op) {
                return;
            }
            known = self.earlier[index];
        }
        self.earlier.push(self.by_hash.insert(hash, self.ops.len()));
        self.ops.push(op);
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

    /// The actions, in the order in which they came.
    pub(crate) fn into_ops(self) -> Vec<Op> {
        self.ops
    }
}
