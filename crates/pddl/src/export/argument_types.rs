//! The types of the arguments of predicates and functions in a domain: the lowest that cover what the model says of them,
//! and every use in actions, axioms and task.

use std::collections::BTreeMap;

use typelift_model::{ActionModel, ArgumentTypes, GroundAtom, Symbol, Task, Term, TypeId, cover};

/// The objects that the model's actions and axioms mention, with their types: as the model declares them, else as the
/// task does, else the root.
pub(super) fn constants(model: &ActionModel, task: Option<&Task>) -> BTreeMap<Symbol, TypeId> {
    let mut constants = model.constants.clone();
    model.for_each_atom(&mut |atom, _, _| {
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

/// What a domain declares.
pub(super) struct Declared {
    /// The constants with their types.
    pub(super) constants: BTreeMap<Symbol, TypeId>,
    predicates: ArgumentTypes,
    functions: ArgumentTypes,
    root: TypeId,
}

impl Declared {
    pub(super) fn of(model: &ActionModel, task: Option<&Task>) -> Self {
        let hierarchy = &model.hierarchy;
        let constants = constants(model, task);
        let (mut predicates, mut functions) = (model.predicates.clone(), ArgumentTypes::new());
        model.for_each_atom(&mut |atom, parameters, is_function| {
            let ty = |term: &Term| match term {
                Term::Param(index) => parameters[*index as usize].ty,
                Term::Const(name) => constants[name],
            };
            let types = if is_function { &mut functions } else { &mut predicates };
            cover(types, hierarchy, &atom.predicate, atom.args.iter().map(ty));
        });
        if let Some(task) = task {
            let ty = |name: &Symbol| constants.get(name).or_else(|| task.init.objects.get(name)).copied();
            let types = |atom: &GroundAtom| -> Vec<TypeId> {
                atom.args.iter().map(|name| ty(name).unwrap_or(hierarchy.root())).collect()
            };
            for atom in task.init.atoms.iter().chain(task.goal.literals().map(|(atom, _)| atom)) {
                cover(&mut predicates, hierarchy, &atom.predicate, types(atom));
            }
            for function in task.values.keys() {
                cover(&mut functions, hierarchy, &function.predicate, types(function));
            }
        }
        Self { constants, predicates, functions, root: hierarchy.root() }
    }

    /// The type of a predicate's argument; the root if nothing tells.
    pub(super) fn of_predicate(&self, name: &Symbol, position: usize) -> TypeId {
        self.argument(&self.predicates, name, position)
    }

    /// The type of a function's argument.
    pub(super) fn of_function(&self, name: &Symbol, position: usize) -> TypeId {
        self.argument(&self.functions, name, position)
    }

    fn argument(&self, types: &ArgumentTypes, name: &Symbol, position: usize) -> TypeId {
        types.get(name).and_then(|types| types.get(position)).copied().unwrap_or(self.root)
    }
}
