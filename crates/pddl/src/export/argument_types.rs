//! The types of the arguments of predicates and functions: the lowest that cover their uses.

use std::collections::BTreeMap;

use typelift_model::{ActionModel, Atom, Hierarchy, LiftedAtom, Parameter, Symbol, Task, Term, TypeId};

/// The objects that the model's actions and axioms mention, with their types: as the model declares them, else as the
/// task does, else the root.
pub(super) fn constants(model: &ActionModel, task: Option<&Task>) -> BTreeMap<Symbol, TypeId> {
    let mut constants = model.constants.clone();
    for_each_use(model, &mut |atom, _, _| {
        for term in &atom.args {
            if let Term::Const(name) = term
                && !constants.contains_key(name)
            {
                let ty = task.and_then(|task| task.init.objects.get(name)).copied();
                constants.insert(name.clone(), ty.unwrap_or(model.hierarchy.root()));
            }
        }
    });
    constants
}

/// Calls `each` with every lifted atom of the model, the placeholders that it is over, and whether it is a function.
fn for_each_use(model: &ActionModel, each: &mut impl FnMut(&LiftedAtom, &[Parameter], bool)) {
    for action in &model.actions {
        for literal in &action.preconditions {
            each(&literal.atom, &action.parameters, false);
        }
        for effect in &action.effects {
            let parameters = [&action.parameters[..], &effect.parameters].concat();
            for literal in effect.condition.iter().chain([&effect.literal]) {
                each(&literal.atom, &parameters, false);
            }
        }
        for function in &action.cost.functions {
            each(function, &action.parameters, true);
        }
    }
    for axiom in &model.axioms {
        for atom in axiom.body.iter().map(|literal| &literal.atom).chain([&axiom.head]) {
            each(atom, &axiom.parameters, false);
        }
    }
}

/// The lowest types that cover the arguments' uses.
pub(super) struct ArgumentTypes {
    /// The constants with their types.
    pub(super) constants: BTreeMap<Symbol, TypeId>,
    predicates: Covers,
    functions: Covers,
    root: TypeId,
}

type Covers = BTreeMap<(Symbol, usize), TypeId>;

impl ArgumentTypes {
    pub(super) fn of(model: &ActionModel, task: Option<&Task>) -> Self {
        let hierarchy = &model.hierarchy;
        let constants = constants(model, task);
        let (mut predicates, mut functions) = (Covers::new(), Covers::new());
        for_each_use(model, &mut |atom, parameters, is_function| {
            let ty = |term: &Term| match term {
                Term::Param(index) => parameters[*index as usize].ty,
                Term::Const(name) => constants[name],
            };
            cover(if is_function { &mut functions } else { &mut predicates }, hierarchy, atom, ty);
        });
        if let Some(task) = task {
            let ty = |name: &Symbol| constants.get(name).or_else(|| task.init.objects.get(name)).copied();
            let ty = |name: &Symbol| ty(name).unwrap_or(hierarchy.root());
            for atom in task.init.atoms.iter().chain(task.goal.literals().map(|(atom, _)| atom)) {
                cover(&mut predicates, hierarchy, atom, ty);
            }
            for function in task.values.keys() {
                cover(&mut functions, hierarchy, function, ty);
            }
        }
        Self { constants, predicates, functions, root: hierarchy.root() }
    }

    /// The type of a predicate's argument; the root if nothing uses it.
    pub(super) fn of_predicate(&self, name: &Symbol, position: usize) -> TypeId {
        self.predicates.get(&(name.clone(), position)).copied().unwrap_or(self.root)
    }

    /// The type of a function's argument.
    pub(super) fn of_function(&self, name: &Symbol, position: usize) -> TypeId {
        self.functions.get(&(name.clone(), position)).copied().unwrap_or(self.root)
    }
}

fn cover<T>(covers: &mut Covers, hierarchy: &Hierarchy, atom: &Atom<T>, ty: impl Fn(&T) -> TypeId) {
    for (position, term) in atom.args.iter().enumerate() {
        let ty = ty(term);
        let known = covers.entry((atom.predicate.clone(), position)).or_insert(ty);
        *known = hierarchy.lca(*known, ty);
    }
}
