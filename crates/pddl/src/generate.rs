//! Small random domains with problems, for tests of laws.
//!
//! They are well-formed: what they mention is declared, and arguments are of the declared types. Derived predicates
//! depend on themselves, outside of quantifiers over all, and on those declared before them.

use typelift_model::{Atom, Hierarchy, Symbol, TypeId};

use crate::{Action, Amount, Derived, Domain, Formula, PddlAtom, PddlEffect, PddlTerm, Problem, Signature, Typed};

/// A source of choices. When it is used up, every choice is the first one, so that what is generated ends and shrinks.
#[derive(Debug, Clone)]
pub(crate) struct Tape {
    numbers: Vec<u16>,
    at: usize,
}

impl Tape {
    /// Choices by these numbers.
    pub(crate) fn new(numbers: Vec<u16>) -> Self {
        Self { numbers, at: 0 }
    }

    /// A number below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        let number = self.numbers.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        usize::from(number) % n.max(1)
    }

    fn pick<'t, T>(&mut self, from: &'t [T]) -> &'t T {
        &from[self.below(from.len())]
    }

    /// Whether the last of `n` was chosen.
    fn rarely(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }
}

fn symbols(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|name| Symbol::new(name)).collect()
}

/// What may be mentioned while a condition or an effect is made.
struct Generator<'t> {
    tape: &'t mut Tape,
    hierarchy: Hierarchy,
    types: Vec<Symbol>,
    objects: Vec<Typed>,
    /// The variables in scope; a later one hides an earlier one of the same name.
    scope: Vec<Typed>,
    predicates: Vec<Signature>,
}

/// A domain with a problem.
pub(crate) fn domain_and_problem(tape: &mut Tape) -> (Domain, Problem) {
    // With all of them, a boat is a place as well.
    let all =
        [("vehicle", "object"), ("truck", "vehicle"), ("place", "object"), ("boat", "vehicle"), ("boat", "place")];
    let declared = 1 + tape.below(all.len());
    let edges = &all[..declared];
    let types: Vec<(Symbol, Symbol)> = edges.iter().map(|(c, p)| (Symbol::new(c), Symbol::new(p))).collect();
    let hierarchy = Hierarchy::from_edges(edges.iter().copied()).unwrap_or_default();
    let mut names = symbols(&["object"]);
    names.extend(types.iter().map(|(child, _)| child.clone()));
    names.dedup();
    let (objects, scope, predicates) = (Vec::new(), Vec::new(), Vec::new());
    let mut generator = Generator { tape, hierarchy, types: names, objects, scope, predicates };
    let constants = generator.objects(&["depot", "home"], 0);
    generator.objects.clone_from(&constants);
    let base = generator.signatures(&["at", "on", "free", "linked"], 2);
    generator.predicates.clone_from(&base);
    let (derived, heads) = generator.derived();
    generator.predicates.extend(heads);
    let costs = generator.tape.rarely(2);
    let actions = generator.actions(&base, costs);
    let domain = Domain {
        name: Symbol::new("generated"),
        requirements: symbols(&[":adl", ":derived-predicates", ":action-costs"]),
        types,
        constants,
        predicates: generator.predicates.clone(),
        functions: functions(),
        derived,
        actions,
        comment: Vec::new(),
    };
    let problem = generator.problem(&base);
    (domain, problem)
}

fn functions() -> Vec<Signature> {
    let argument = Typed { name: Symbol::new("x"), types: symbols(&["object"]) };
    vec![
        Signature { name: Symbol::new("total-cost"), parameters: Vec::new() },
        Signature { name: Symbol::new("toll"), parameters: vec![argument] },
    ]
}

impl Generator<'_> {
    fn types(&mut self, either: bool) -> Vec<Symbol> {
        let mut types = vec![self.tape.pick(&self.types).clone()];
        if either && self.tape.rarely(4) {
            let other = self.tape.pick(&self.types).clone();
            if !types.contains(&other) {
                types.push(other);
            }
        }
        types
    }

    /// Up to two more than `least` objects, by these names.
    fn objects(&mut self, names: &[&str], least: usize) -> Vec<Typed> {
        let number = (least + self.tape.below(3)).min(names.len());
        symbols(&names[..number]).into_iter().map(|name| Typed { name, types: self.types(false) }).collect()
    }

    /// Up to two more than `least` variables, all different.
    fn variables(&mut self, least: usize) -> Vec<Typed> {
        let number = least + self.tape.below(3 - least);
        let mut names = symbols(&["x", "y", "z"]);
        let first = self.tape.below(names.len());
        names.rotate_left(first);
        names.into_iter().take(number).map(|name| Typed { name, types: self.types(true) }).collect()
    }

    fn signatures(&mut self, names: &[&str], least: usize) -> Vec<Signature> {
        let number = least + self.tape.below(names.len() + 1 - least);
        symbols(&names[..number]).into_iter().map(|name| self.signature(name)).collect()
    }

    fn signature(&mut self, name: Symbol) -> Signature {
        Signature { name, parameters: self.variables(0) }
    }

    fn ids(&self, types: &[Symbol]) -> Vec<TypeId> {
        types.iter().filter_map(|ty| self.hierarchy.id(ty.as_str())).collect()
    }

    /// Whether whatever is of one of `types` is of one of those of the declaration.
    fn fits(&self, types: &[Symbol], declared: &Typed) -> bool {
        let declared = self.ids(&declared.types);
        self.ids(types).iter().all(|ty| declared.iter().any(|of| self.hierarchy.is_a(*ty, *of)))
    }

    /// The variables and objects that may be an argument.
    fn arguments(&self, declared: &Typed) -> Vec<PddlTerm> {
        let mut arguments = Vec::new();
        for (at, variable) in self.scope.iter().enumerate() {
            let hidden = self.scope[at + 1..].iter().any(|later| later.name == variable.name);
            if !hidden && self.fits(&variable.types, declared) {
                arguments.push(PddlTerm::Variable(variable.name.clone()));
            }
        }
        let objects = self.objects.iter().filter(|object| self.fits(&object.types, declared));
        arguments.extend(objects.map(|object| PddlTerm::Object(object.name.clone())));
        arguments
    }

    /// An atom of one of these predicates, if there are arguments for it.
    fn atom(&mut self, predicates: &[Signature]) -> Option<PddlAtom> {
        let Signature { name, parameters } = self.tape.pick(predicates).clone();
        let mut args = Vec::with_capacity(parameters.len());
        for parameter in &parameters {
            let fitting = self.arguments(parameter);
            if fitting.is_empty() {
                return None;
            }
            args.push(self.tape.pick(&fitting).clone());
        }
        Some(Atom { predicate: name, args })
    }

    fn formula(&mut self, depth: usize) -> Formula {
        let kinds = if depth == 0 { 4 } else { 14 };
        match self.tape.below(kinds) {
            2 => Formula::Not(Box::new(self.leaf())),
            3 => self.equality(),
            4 | 5 => Formula::And(self.formulas(depth - 1)),
            6 | 7 => Formula::Or(self.formulas(depth - 1)),
            8 => Formula::Not(Box::new(self.formula(depth - 1))),
            9 => Formula::Imply(Box::new(self.formula(depth - 1)), Box::new(self.formula(depth - 1))),
            10 | 11 => {
                let (variables, body) = self.quantified(|generator| generator.formula(depth - 1));
                Formula::Exists(variables, Box::new(body))
            }
            12 | 13 => {
                let (variables, body) = self.quantified(|generator| generator.formula(depth - 1));
                Formula::Forall(variables, Box::new(body))
            }
            _ => self.leaf(),
        }
    }

    fn leaf(&mut self) -> Formula {
        let predicates = self.predicates.clone();
        self.atom(&predicates).map_or_else(Formula::truth, Formula::Atom)
    }

    fn equality(&mut self) -> Formula {
        let any = Typed { name: Symbol::new("any"), types: symbols(&["object"]) };
        let arguments = self.arguments(&any);
        if arguments.is_empty() {
            return Formula::Or(Vec::new());
        }
        Formula::Equal(self.tape.pick(&arguments).clone(), self.tape.pick(&arguments).clone())
    }

    fn formulas(&mut self, depth: usize) -> Vec<Formula> {
        let number = 1 + self.tape.below(3);
        (0..number).map(|_| self.formula(depth)).collect()
    }

    fn quantified<T>(&mut self, body: impl FnOnce(&mut Self) -> T) -> (Vec<Typed>, T) {
        let variables = self.variables(1);
        let outside = self.scope.len();
        self.scope.extend(variables.iter().cloned());
        let body = body(self);
        self.scope.truncate(outside);
        (variables, body)
    }

    fn effect(&mut self, depth: usize, base: &[Signature]) -> PddlEffect {
        let kinds = if depth == 0 { 2 } else { 7 };
        match self.tape.below(kinds) {
            1 => self.atom(base).map_or(PddlEffect::And(Vec::new()), PddlEffect::Delete),
            2 | 3 => {
                let number = 1 + self.tape.below(3);
                PddlEffect::And((0..number).map(|_| self.effect(depth - 1, base)).collect())
            }
            4 => {
                let (variables, body) = self.quantified(|generator| generator.effect(depth - 1, base));
                PddlEffect::Forall(variables, Box::new(body))
            }
            5 | 6 => PddlEffect::When(self.formula(2), Box::new(self.effect(depth - 1, base))),
            _ => self.atom(base).map_or(PddlEffect::And(Vec::new()), PddlEffect::Add),
        }
    }

    fn derived(&mut self) -> (Vec<Derived>, Vec<Signature>) {
        let known = self.predicates.clone();
        let heads: Vec<Signature> = self.signatures(&["above", "safe"], 0);
        let mut derived = Vec::new();
        for head in &heads {
            self.scope.clone_from(&head.parameters);
            let mut condition = self.formula(3);
            if self.tape.rarely(2) {
                let itself = [head.clone()];
                let (variables, again) = self.quantified(|generator| {
                    let again = generator.atom(&itself).map_or_else(Formula::truth, Formula::Atom);
                    Formula::And(vec![again, generator.formula(1)])
                });
                condition = Formula::Or(vec![condition, Formula::Exists(variables, Box::new(again))]);
            }
            self.scope.clear();
            derived.push(Derived { head: head.clone(), condition, comment: Vec::new() });
            self.predicates.push(head.clone());
        }
        self.predicates = known;
        (derived, heads)
    }

    fn actions(&mut self, base: &[Signature], costs: bool) -> Vec<Action> {
        let number = 1 + self.tape.below(2);
        let mut actions = Vec::new();
        for name in symbols(&["go", "go-2"]).into_iter().take(number) {
            let parameters = self.variables(0);
            self.scope.clone_from(&parameters);
            let precondition = self.formula(3);
            let mut effect = self.effect(3, base);
            if costs {
                effect = PddlEffect::And(vec![effect, PddlEffect::Increase(self.amount())]);
            }
            self.scope.clear();
            actions.push(Action { name, parameters, precondition, effect, comment: Vec::new() });
        }
        actions
    }

    fn amount(&mut self) -> Amount {
        let toll = functions().pop().into_iter().collect::<Vec<_>>();
        match self.tape.below(2) {
            1 => self.atom(&toll).map_or(Amount::Number(7), Amount::Function),
            _ => Amount::Number(self.tape.below(9) as u32),
        }
    }

    fn problem(&mut self, base: &[Signature]) -> Problem {
        let objects = self.objects(&["a", "b", "c", "d"], 2);
        self.objects.extend(objects.iter().cloned());
        let atoms = self.ground_atoms(base);
        let number = if atoms.is_empty() { 0 } else { self.tape.below(8) };
        let mut init: Vec<Atom<Symbol>> = (0..number).map(|_| self.tape.pick(&atoms).clone()).collect();
        init.sort();
        init.dedup();
        let tolls = self.objects.clone().into_iter().map(|object| {
            let toll = Atom { predicate: Symbol::new("toll"), args: vec![object.name] };
            (toll, self.tape.below(20) as u32)
        });
        let mut values = vec![(Atom { predicate: Symbol::new("total-cost"), args: Vec::new() }, 0)];
        values.extend(tolls);
        Problem {
            name: Symbol::new("generated-1"),
            domain: Symbol::new("generated"),
            requirements: Vec::new(),
            objects,
            init,
            values,
            goal: self.formula(4),
            minimizes_cost: self.tape.rarely(2),
            comment: Vec::new(),
        }
    }

    /// Every atom of these predicates over the objects.
    fn ground_atoms(&self, predicates: &[Signature]) -> Vec<Atom<Symbol>> {
        predicates.iter().flat_map(|predicate| ground_atoms(predicate, &self.objects, &self.hierarchy)).collect()
    }
}

/// Every atom of a predicate over these objects, each of one type.
pub(crate) fn ground_atoms(predicate: &Signature, objects: &[Typed], hierarchy: &Hierarchy) -> Vec<Atom<Symbol>> {
    let id = |ty: &Symbol| hierarchy.id(ty.as_str());
    let fits = |object: &Typed, types: &[Symbol]| {
        let ty = object.types.first().and_then(id);
        types.iter().any(|of| ty.zip(id(of)).is_some_and(|(ty, of)| hierarchy.is_a(ty, of)))
    };
    let mut tuples: Vec<Vec<Symbol>> = vec![Vec::new()];
    for parameter in &predicate.parameters {
        let fitting: Vec<&Typed> = objects.iter().filter(|object| fits(object, &parameter.types)).collect();
        let with =
            |tuple: &Vec<Symbol>, object: &Typed| [tuple.as_slice(), std::slice::from_ref(&object.name)].concat();
        tuples = tuples.iter().flat_map(|tuple| fitting.iter().map(move |object| with(tuple, object))).collect();
    }
    tuples.into_iter().map(|args| Atom { predicate: predicate.name.clone(), args }).collect()
}
