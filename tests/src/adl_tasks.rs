//! Random domains and problems in the whole of ADL, as text: nested formulas, conditional effects for every object, derived
//! predicates that may depend on themselves, types below others and `either` of several, constants, costs.

use std::fmt::Write;

use typelift::model::SplitMix64;

/// Types as sets of the leaves `box`, `ball`, `place` itself, `dock` and `phase`, with their text.
const TYPES: [(u8, &str); 9] = [
    (0b0001, "box"),
    (0b0010, "ball"),
    (0b0011, "thing"),
    (0b1100, "place"),
    (0b1000, "dock"),
    (0b1101, "(either box place)"),
    (0b1010, "(either ball dock)"),
    (ANYTHING, "object"),
    (PHASE_LEAF, "phase"),
];
const ANYTHING: u8 = 0b1_1111;
const PHASE_LEAF: u8 = 0b1_0000;
const BOX: usize = 0;
const THING: usize = 2;
const PLACE: usize = 3;
const BOX_OR_PLACE: usize = 5;
const PHASE: usize = 8;

/// The objects, the constants first, and of which leaf they are.
const OBJECTS: [(&str, &str, u8); 6] = [
    ("hub", "place", 0b0100),
    ("crate", "box", 0b0001),
    ("quay", "dock", 0b1000),
    ("yard", "place", 0b0100),
    ("chest", "box", 0b0001),
    ("globe", "ball", 0b0010),
];
const CONSTANTS: usize = 2;
/// Which of them are always there.
const LEAST_OBJECTS: usize = 4;
/// Which of them are places.
const PLACES: [usize; 3] = [0, 2, 3];

/// What some tasks go through one after the other, so that their plans are long.
const PHASES: [&str; 12] =
    ["one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"];

/// A predicate and the types of its arguments, as places in [`TYPES`].
type Predicate = (&'static str, &'static [usize]);

const STATED: [Predicate; 9] = [
    ("at", &[THING, PLACE]),
    ("lit", &[]),
    ("clean", &[BOX_OR_PLACE]),
    ("done", &[THING]),
    ("open", &[PLACE]),
    ("packed", &[BOX]),
    ("now", &[PHASE]),
    ("road", &[PLACE, PLACE]),
    ("next", &[PHASE, PHASE]),
];
/// Actions change at random only the first of them.
const CHANGED: usize = STATED.len() - 3;

const DERIVED: [Predicate; 4] =
    [("linked", &[PLACE, PLACE]), ("ready", &[THING]), ("calm", &[]), ("near", &[THING, THING])];

/// Writes one domain with its problem.
#[derive(Debug)]
pub struct AdlTask {
    random: SplitMix64,
    objects: usize,
    phases: &'static [&'static str],
    predicates: Vec<Predicate>,
    /// The variables in scope, with their types.
    scope: Vec<(String, u8)>,
    has_costs: bool,
}

impl AdlTask {
    /// The task of a seed.
    pub fn new(seed: u64) -> Self {
        let mut random = SplitMix64::new(seed);
        let objects = LEAST_OBJECTS + random.below(1 + OBJECTS.len() - LEAST_OBJECTS);
        let has_costs = random.below(2) == 0;
        let phases = if random.below(4) == 0 { &PHASES[..] } else { &[] };
        Self { random, objects, phases, predicates: STATED.to_vec(), scope: Vec::new(), has_costs }
    }

    /// The domain; to be written first, and once.
    pub fn domain(&mut self) -> String {
        let mut text =
            "(define (domain generated)\n (:types thing place phase - object box ball - thing dock - place)\n"
                .to_owned();
        text.push_str(" (:constants hub - place crate - box)\n (:predicates");
        let derived = self.random.below(DERIVED.len() + 1);
        for (name, types) in STATED.iter().chain(&DERIVED[..derived]) {
            let _ = write!(text, " ({name}{})", declared(types, "x"));
        }
        text.push_str(")\n (:functions (total-cost) - number (toll ?x - object) - number)\n");
        for predicate in &DERIVED[..derived] {
            let rule = self.derived(*predicate);
            let _ = writeln!(text, " {rule}");
        }
        for name in ["move", "fix", "swap", "press"].iter().take(2 + self.random.below(3)) {
            let action = self.action(name);
            let _ = writeln!(text, " {action}");
        }
        if !self.phases.is_empty() {
            let _ = writeln!(text, " {}", self.pass());
        }
        text + ")"
    }

    /// The problem with this goal. Its objects and initial state are the same each time.
    pub fn problem(&self, init: &str, goal: &str) -> String {
        let objects = OBJECTS[CONSTANTS..self.objects].iter().map(|(name, ty, _)| format!(" {name} - {ty}"));
        let phases = self.phases.iter().map(|name| format!(" {name} - phase"));
        let objects: String = objects.chain(phases).collect();
        let metric = if self.has_costs { "(:metric minimize (total-cost))" } else { "" };
        format!(
            "(define (problem p) (:domain generated)\n (:objects{objects})\n (:init{init})\n (:goal {goal}) {metric})"
        )
    }

    /// An initial state.
    pub fn init(&mut self) -> String {
        let mut text = String::new();
        for number in 0..PLACES.len() {
            if self.random.below(8) > 0 {
                let _ = write!(text, " (road {} {})", place(number), place((number + 1) % PLACES.len()));
            }
        }
        for (name, ..) in OBJECTS[..self.objects].iter().filter(|(_, _, leaf)| leaf & TYPES[THING].0 != 0) {
            let _ = write!(text, " (at {name} {})", place(self.random.below(PLACES.len())));
        }
        for pair in self.phases.windows(2) {
            let _ = write!(text, " (next {} {})", pair[0], pair[1]);
        }
        text.extend(self.phases.first().map(|first| format!(" (now {first})")));
        for _ in 0..self.random.below(8) {
            let predicate = STATED[self.random.below(CHANGED)];
            if let Some(atom) = self.atom_of(predicate) {
                let _ = write!(text, " {atom}");
            }
        }
        let names = OBJECTS[..self.objects].iter().map(|(name, ..)| name).chain(self.phases);
        for (i, name) in names.enumerate() {
            let _ = write!(text, " (= (toll {name}) {})", (i * 3 + 1) % 7);
        }
        text + ["", " (= (total-cost) 0)", " (= (total-cost) 5)"][self.random.below(3)]
    }

    /// A formula, nested so deep at most.
    pub fn formula(&mut self, depth: usize) -> String {
        let kinds = if depth == 0 { 5 } else { 14 };
        match self.random.below(kinds) {
            0..=2 => self.atom(),
            3 => format!("(not {})", self.atom()),
            4 => self.equality(),
            5 | 6 => format!("(and {} {})", self.formula(depth - 1), self.formula(depth - 1)),
            7 | 8 => format!("(or {} {})", self.formula(depth - 1), self.formula(depth - 1)),
            9 => format!("(not {})", self.formula(depth - 1)),
            10 => format!("(imply {} {})", self.formula(depth - 1), self.formula(depth - 1)),
            kind => {
                let word = if kind == 11 { "exists" } else { "forall" };
                self.quantified(word, |this| this.formula(depth - 1))
            }
        }
    }

    /// A quantifier over a variable, whose name may hide another.
    fn quantified(&mut self, word: &str, body: impl FnOnce(&mut Self) -> String) -> String {
        let name = ["a", "b", "c"][self.random.below(3)].to_owned();
        let (mask, ty) = TYPES[self.random.below(TYPES.len())];
        self.scope.push((name.clone(), mask));
        let body = body(self);
        self.scope.pop();
        format!("({word} (?{name} - {ty}) {body})")
    }

    /// What may be an argument of one of these types.
    fn terms(&self, types: u8) -> Vec<String> {
        let visible = self
            .scope
            .iter()
            .enumerate()
            .filter(|(at, (name, _))| !self.scope[at + 1..].iter().any(|(later, _)| later == name));
        let variables = visible.filter(|(_, (_, mask))| mask & !types == 0).map(|(_, (name, _))| format!("?{name}"));
        let objects = OBJECTS[..self.objects].iter().filter(|(_, _, leaf)| leaf & types != 0);
        let phases = self.phases.iter().filter(|_| self.objects > CONSTANTS && types & PHASE_LEAF != 0);
        let names = objects.map(|(name, ..)| name).chain(phases).map(|name| (*name).to_owned());
        // Variables are mentioned more often.
        variables.flat_map(|name| vec![name; 4]).chain(names).collect()
    }

    fn term(&mut self, types: u8) -> Option<String> {
        // A domain knows its constants only; objects of the problem are mentioned in problems.
        let terms = self.terms(types);
        (!terms.is_empty()).then(|| terms[self.random.below(terms.len())].clone())
    }

    fn atom_of(&mut self, (name, types): Predicate) -> Option<String> {
        let args: Option<Vec<String>> =
            types.iter().map(|ty| self.term(TYPES[*ty].0).map(|term| format!(" {term}"))).collect();
        Some(format!("({name}{})", args?.concat()))
    }

    fn atom(&mut self) -> String {
        let predicate = self.predicates[self.random.below(self.predicates.len())];
        self.atom_of(predicate).unwrap_or_else(|| "(lit)".to_owned())
    }

    fn equality(&mut self) -> String {
        match (self.term(ANYTHING), self.term(ANYTHING)) {
            (Some(a), Some(b)) => format!("(= {a} {b})"),
            _ => "(and)".to_owned(),
        }
    }

    /// The rule of a derived predicate, which may then be mentioned by what comes later.
    fn derived(&mut self, predicate: Predicate) -> String {
        let (name, types) = predicate;
        let objects = std::mem::replace(&mut self.objects, CONSTANTS);
        self.scope = types.iter().enumerate().map(|(i, ty)| (format!("x{i}"), TYPES[*ty].0)).collect();
        let mut condition = self.formula(2);
        if self.random.below(2) == 0 {
            let again = self.quantified("exists", |this| {
                let itself = this.atom_of(predicate).unwrap_or_else(|| "(lit)".to_owned());
                format!("(and {itself} {})", this.formula(0))
            });
            condition = format!("(or {condition} {again})");
        }
        self.scope.clear();
        self.objects = objects;
        self.predicates.push(predicate);
        format!("(:derived ({name}{}) {condition})", declared(types, "x"))
    }

    fn action(&mut self, name: &str) -> String {
        let objects = std::mem::replace(&mut self.objects, CONSTANTS);
        let is_move = name == "move" && self.random.below(4) > 0;
        let types = match is_move {
            true => vec![THING, PLACE, PLACE],
            false => {
                let number = [0, 1, 1, 2][self.random.below(4)];
                (0..number).map(|_| [BOX, THING, PLACE, self.random.below(TYPES.len())][self.random.below(4)]).collect()
            }
        };
        self.scope = types.iter().enumerate().map(|(i, ty)| (format!("v{i}"), TYPES[*ty].0)).collect();
        let depth = if is_move { self.random.below(3) } else { self.random.below(4) };
        let mut precondition = self.precondition(depth);
        let mut effects: Vec<String> = (0..1 + self.random.below(3)).map(|_| self.effect(2)).collect();
        if is_move {
            precondition = format!("(and (at ?v0 ?v1) (road ?v1 ?v2) {precondition})");
            effects.truncate(self.random.below(2));
            effects.extend(["(not (at ?v0 ?v1))".to_owned(), "(at ?v0 ?v2)".to_owned()]);
        }
        if self.has_costs {
            effects.push(self.cost());
        }
        self.scope.clear();
        self.objects = objects;
        let (parameters, effect) = (declared(&types, "v"), effects.join(" "));
        format!("(:action {name} :parameters ({parameters})\n  :precondition {precondition}\n  :effect (and {effect}))")
    }

    /// The action that goes on to the next phase, which may ask and do more.
    fn pass(&mut self) -> String {
        let objects = std::mem::replace(&mut self.objects, CONSTANTS);
        self.scope = vec![("v0".to_owned(), PHASE_LEAF), ("v1".to_owned(), PHASE_LEAF)];
        let depth = self.random.below(3);
        let precondition = self.precondition(depth);
        let more = if self.random.below(2) == 0 { self.effect(2) } else { String::new() };
        let cost = if self.has_costs { self.cost() } else { String::new() };
        self.scope.clear();
        self.objects = objects;
        format!(
            "(:action pass :parameters (?v0 ?v1 - phase)\n  :precondition (and (now ?v0) (next ?v0 ?v1) {precondition})\n  \
             :effect (and (not (now ?v0)) (now ?v1) {more} {cost}))"
        )
    }

    fn precondition(&mut self, depth: usize) -> String {
        match depth {
            0 => "(and)".to_owned(),
            1 => self.formula(0),
            2 => format!("(and {} {})", self.formula(0), self.formula(2)),
            _ => self.formula(3),
        }
    }

    fn cost(&mut self) -> String {
        let term = self.term(ANYTHING);
        match (self.random.below(3), term) {
            (0, Some(term)) => format!("(increase (total-cost) (toll {term}))"),
            (number, _) => format!("(increase (total-cost) {})", number * 2),
        }
    }

    fn effect(&mut self, depth: usize) -> String {
        let changed = STATED[self.random.below(CHANGED)];
        let atom = self.atom_of(changed).unwrap_or_else(|| "(lit)".to_owned());
        match self.random.below(if depth == 0 { 5 } else { 8 }) {
            0..=2 => atom,
            3 | 4 => format!("(not {atom})"),
            5 => format!("(when {} {})", self.formula(1), self.effect(depth - 1)),
            6 => self.quantified("forall", |this| this.effect(depth - 1)),
            _ => self.quantified("forall", |this| format!("(when {} {})", this.formula(1), this.effect(depth - 1))),
        }
    }
}

/// ` ?x0 - T …`
fn declared(types: &[usize], name: &str) -> String {
    types.iter().enumerate().map(|(i, ty)| format!(" ?{name}{i} - {}", TYPES[*ty].1)).collect()
}

fn place(number: usize) -> &'static str {
    OBJECTS[PLACES[number]].0
}
