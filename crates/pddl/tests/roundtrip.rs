//! What is printed reads as what it was printed from, in whatever case, and laid out anew.

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_model::{Atom, Hierarchy, Symbol, TypeId};
use typelift_pddl::{
    Action, Amount, Derived, Domain, Formula, PddlAtom, PddlEffect, PddlError, PddlTerm, Problem, Signature, Typed,
    format, read_domain, read_problem,
};

/// Decisions, made by numbers that proptest finds and shrinks; towards the first choice when they run out.
struct Choices {
    numbers: std::vec::IntoIter<u16>,
    types: Vec<Symbol>,
    hierarchy: Hierarchy,
}

fn symbols(prefix: &str, count: usize) -> Vec<Symbol> {
    (0..count).map(|i| Symbol::from(format!("{prefix}{i}"))).collect()
}

fn comments(wanted: bool) -> Vec<String> {
    if wanted { vec!["(why".to_owned(), "not".to_owned()] } else { Vec::new() }
}

impl Choices {
    fn below(&mut self, n: usize) -> usize {
        self.numbers.next().map_or(0, |number| number as usize % n.max(1))
    }

    fn one_of<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())].clone()
    }

    fn ids(&self, typed: &Typed) -> Vec<TypeId> {
        typed.types.iter().filter_map(|ty| self.hierarchy.id(ty.as_str())).collect()
    }

    fn several<T>(&mut self, most: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.below(most + 1)).map(|_| make(self)).collect()
    }

    fn typed(&mut self, name: Symbol, either: bool) -> Typed {
        let types = self.types.clone();
        let mut chosen = vec![self.one_of(&types)];
        if either && self.below(5) == 1 {
            chosen.push(self.one_of(&types));
        }
        Typed { name, types: chosen }
    }

    fn variables(&mut self, prefix: &str) -> Vec<Typed> {
        let names = symbols(prefix, self.below(3));
        names.into_iter().map(|name| self.typed(name, true)).collect()
    }

    /// An atom of one of these over terms that fit.
    fn atom(&mut self, of: &[Signature], scope: &Scope) -> Option<PddlAtom> {
        let signature = of.get(self.below(of.len()))?.clone();
        let mut args = Vec::new();
        for parameter in &signature.parameters {
            let wanted = self.ids(parameter);
            let is_a = |g: TypeId, w: TypeId| self.hierarchy.is_a(g, w);
            let fits = |typed: &Typed, exact: bool| {
                let given = self.ids(typed);
                given.iter().any(|&g| wanted.iter().any(|&w| is_a(g, w) || !exact && is_a(w, g)))
            };
            let variables =
                scope.variables.iter().filter(|v| fits(v, false)).map(|v| PddlTerm::Variable(v.name.clone()));
            let objects = scope.objects.iter().filter(|o| fits(o, true)).map(|o| PddlTerm::Object(o.name.clone()));
            let terms: Vec<PddlTerm> = variables.chain(objects).collect();
            args.push(terms.get(self.below(terms.len()))?.clone());
        }
        Some(Atom { predicate: signature.name, args })
    }

    fn formula(&mut self, predicates: &[Signature], scope: &Scope, depth: usize) -> Formula {
        let most = if depth == 0 { 3 } else { 9 };
        let inner = |choices: &mut Self| choices.formula(predicates, scope, depth - 1);
        let terms = scope.terms();
        match self.below(most) {
            0 => self.atom(predicates, scope).map_or(Formula::truth(), Formula::Atom),
            1 if !terms.is_empty() => Formula::Equal(self.one_of(&terms), self.one_of(&terms)),
            1 | 2 => Formula::Or(Vec::new()),
            3 => Formula::Not(Box::new(inner(self))),
            4 => Formula::And(self.several(3, inner)),
            5 => Formula::Or(self.several(3, inner)),
            6 => Formula::Imply(Box::new(inner(self)), Box::new(inner(self))),
            quantifier => {
                let variables = self.variables(&format!("q{}x", depth % 2));
                let body = Box::new(self.formula(predicates, &scope.with(&variables), depth - 1));
                if quantifier == 7 { Formula::Exists(variables, body) } else { Formula::Forall(variables, body) }
            }
        }
    }

    fn effect(&mut self, domain: &Domain, scope: &Scope, depth: usize) -> PddlEffect {
        let most = if depth == 0 { 2 } else { 5 };
        // The last predicate may be derived.
        let changed = domain.predicates.split_last().map_or(&[][..], |(_, changed)| changed);
        let choice = self.below(most);
        match choice {
            0 | 1 => match self.atom(changed, scope) {
                Some(atom) if choice == 0 => PddlEffect::Add(atom),
                Some(atom) => PddlEffect::Delete(atom),
                None => PddlEffect::And(Vec::new()),
            },
            2 => PddlEffect::And(self.several(3, |choices| choices.effect(domain, scope, depth - 1))),
            3 => {
                let variables = self.variables("e");
                let inner = self.effect(domain, &scope.with(&variables), depth - 1);
                PddlEffect::Forall(variables, Box::new(inner))
            }
            _ => {
                let condition = self.formula(&domain.predicates, scope, 1);
                PddlEffect::When(condition, Box::new(self.effect(domain, scope, depth - 1)))
            }
        }
    }

    fn action(&mut self, name: Symbol, domain: &Domain) -> Action {
        let parameters = self.variables("p");
        let scope = Scope { objects: domain.constants.clone(), variables: parameters.clone() };
        let precondition = self.formula(&domain.predicates, &scope, 3);
        let mut effect = self.effect(domain, &scope, 3);
        if self.below(2) == 1 {
            let functions = &domain.functions[1..];
            let amount = self.atom(functions, &scope).map_or(Amount::Number(7), Amount::Function);
            effect = PddlEffect::And(vec![effect, PddlEffect::Increase(amount)]);
        }
        Action { name, parameters, precondition, effect, comment: comments(self.below(2) == 1) }
    }

    fn signatures(&mut self, prefix: &str, count: usize) -> Vec<Signature> {
        let names = symbols(prefix, count);
        names.into_iter().map(|name| Signature { name, parameters: self.variables("x") }).collect()
    }

    fn domain(&mut self) -> Domain {
        let requirements = [":strips", ":adl", ":action-costs", ":derived-predicates"].map(Symbol::new);
        let count = 1 + self.below(4);
        let mut domain = Domain {
            name: Symbol::new("d"),
            requirements: requirements[..self.below(5)].to_vec(),
            types: self.hierarchy.edges().map(|(child, parent)| (child.clone(), parent.clone())).collect(),
            constants: Vec::new(),
            predicates: self.signatures("p", count),
            functions: vec![Signature { name: Symbol::new("total-cost"), parameters: Vec::new() }],
            comment: comments(self.below(2) == 1),
            ..Domain::default()
        };
        let functions = self.below(3);
        domain.functions.extend(self.signatures("f", functions));
        domain.constants = self.objects("c");
        if let Some(head) = domain.predicates.last().cloned().filter(|_| self.below(2) == 1) {
            let names = symbols("h", head.parameters.len());
            let variables = names.into_iter().zip(&head.parameters).map(|(name, p)| Typed { name, ..p.clone() });
            let head = Signature { parameters: variables.collect(), ..head };
            let scope = Scope { objects: domain.constants.clone(), variables: head.parameters.clone() };
            let condition = self.formula(&domain.predicates, &scope, 2);
            domain.derived.push(Derived { head, condition, comment: comments(self.below(2) == 1) });
        }
        for name in symbols("a", self.below(3)) {
            let action = self.action(name, &domain);
            domain.actions.push(action);
        }
        domain
    }

    fn objects(&mut self, prefix: &str) -> Vec<Typed> {
        let names = symbols(prefix, self.below(5));
        names.into_iter().map(|name| self.typed(name, false)).collect()
    }

    fn problem(&mut self, domain: &Domain) -> Problem {
        let objects = self.objects("o");
        let scope = Scope { objects: [&*domain.constants, &objects].concat(), variables: Vec::new() };
        let changed = &domain.predicates[..domain.predicates.len() - 1];
        let ground = |atom: PddlAtom| {
            let name = |term| match term {
                PddlTerm::Object(name) | PddlTerm::Variable(name) => name,
            };
            Atom { predicate: atom.predicate, args: atom.args.into_iter().map(name).collect() }
        };
        let mut init: Vec<Atom<Symbol>> =
            self.several(6, |choices| choices.atom(changed, &scope)).into_iter().flatten().map(ground).collect();
        init.sort();
        init.dedup();
        let valued = self.several(3, |choices| choices.atom(&domain.functions, &scope));
        let mut values: Vec<(Atom<Symbol>, u32)> = valued.into_iter().flatten().map(|atom| (ground(atom), 3)).collect();
        values.sort();
        values.dedup();
        Problem {
            name: Symbol::new("one"),
            domain: domain.name.clone(),
            requirements: Vec::new(),
            objects,
            init,
            values,
            goal: self.formula(&domain.predicates, &scope, 3),
            minimizes_cost: self.below(2) == 1,
            comment: comments(self.below(2) == 1),
        }
    }
}

struct Scope {
    objects: Vec<Typed>,
    variables: Vec<Typed>,
}

impl Scope {
    fn with(&self, inner: &[Typed]) -> Self {
        let hidden = |variable: &&Typed| !inner.iter().any(|other| other.name == variable.name);
        let outer = self.variables.iter().filter(hidden).cloned();
        Self { objects: self.objects.clone(), variables: outer.chain(inner.iter().cloned()).collect() }
    }

    fn terms(&self) -> Vec<PddlTerm> {
        let variables = self.variables.iter().map(|v| PddlTerm::Variable(v.name.clone()));
        variables.chain(self.objects.iter().map(|o| PddlTerm::Object(o.name.clone()))).collect()
    }
}

fn definitions() -> impl Strategy<Value = (Domain, Problem)> {
    prop::collection::vec(any::<u16>(), 0..250).prop_map(|numbers| {
        let mut choices = Choices {
            numbers: numbers.into_iter(),
            types: vec![Symbol::new("object")],
            hierarchy: Hierarchy::default(),
        };
        let mut edges: Vec<(Symbol, Symbol)> = Vec::new();
        for i in 0..choices.below(5) {
            let known = choices.types.clone();
            edges.push((Symbol::from(format!("Type{i}")), choices.one_of(&known)));
            choices.types.push(Symbol::from(format!("Type{i}")));
        }
        let edges = edges.iter().map(|(child, parent)| (child.as_str(), parent.as_str()));
        choices.hierarchy = Hierarchy::from_edges(edges).expect("a tree");
        let domain = choices.domain();
        let problem = choices.problem(&domain);
        (domain, problem)
    })
}

/// Without comments, which are not read.
fn bare((mut domain, mut problem): (Domain, Problem)) -> (Domain, Problem) {
    domain.comment.clear();
    problem.comment.clear();
    domain.actions.iter_mut().for_each(|action| action.comment.clear());
    domain.derived.iter_mut().for_each(|derived| derived.comment.clear());
    (domain, problem)
}

fn read(domain: &str, problem: &str) -> (Domain, Problem) {
    let shown = |error: PddlError, text: &str| format!("{}{:?}\n{text}", error.render("it", text), error.hint);
    let domain = read_domain(domain).unwrap_or_else(|error| panic!("{}", shown(error, domain)));
    let problem = read_problem(problem, &domain).unwrap_or_else(|error| panic!("{}", shown(error, problem)));
    (domain, problem)
}

/// In upper case, but for the types.
fn shouted(text: &str) -> String {
    let ends = |c: char| c.is_whitespace() || matches!(c, '(' | ')');
    let word = |word: &str| if word.starts_with("Type") { word.to_owned() } else { word.to_uppercase() };
    text.split_inclusive(ends).map(word_with_end(ends, word)).collect()
}

fn word_with_end(ends: fn(char) -> bool, change: impl Fn(&str) -> String) -> impl Fn(&str) -> String {
    move |piece| {
        let word = piece.trim_end_matches(ends);
        change(word) + &piece[word.len()..]
    }
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn what_is_printed_reads_the_same(definitions in definitions()) {
        let (domain, problem) = (definitions.0.to_string(), definitions.1.to_string());
        let definitions = bare(definitions);
        prop_assert_eq!(&read(&domain, &problem), &definitions);
        prop_assert_eq!(&read(&shouted(&domain), &shouted(&problem)), &definitions);
        let laid_out = |text: &str| format(text).expect("balanced");
        prop_assert_eq!(&read(&laid_out(&domain), &laid_out(&problem)), &definitions);
    }
}

#[test]
fn the_generator_reaches_everything() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut all = String::new();
    for _ in 0..300 {
        let (domain, problem) = definitions().new_tree(&mut runner).expect("a value").current();
        all += &format!("{domain}{problem}");
    }
    let words = [
        "(either",
        "(imply",
        "(exists",
        "(forall",
        "(when",
        "(or",
        "(not",
        "(=",
        "(:derived",
        "(increase (total-cost) 7",
        "(increase (total-cost) (f",
        "(:constants",
        "(:objects",
        "(:metric",
        "(= (f",
        "; (why",
        "?q0x",
        "c0",
        "o1",
    ];
    for word in words {
        assert!(all.contains(word), "no {word}");
    }
}
