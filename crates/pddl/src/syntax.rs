//! Domains and problems as PDDL states them: what the reader makes of a text, what the writer
//! prints, and what is compiled into a model and a task.
//!
//! Every name is in lower case, but for types, which keep the spelling of their first declaration. Variables are
//! written without their question mark. A value of these types that the reader returned is well-formed: what it
//! mentions is declared, with the right number of arguments, and nothing is nested deeper than [`MOST_NESTED`]. An
//! object that is an argument is of the right type; what a variable stands for can be.

use std::collections::BTreeSet;
use std::fmt;

use typelift_model::{Atom, Symbol};

/// How deep formulas and effects may be nested: whatever walks them may recurse.
pub const MOST_NESTED: usize = 250;

/// The function that the total cost is.
pub(crate) const TOTAL_COST: &str = "total-cost";

/// A variable, an object or a constant with its type.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Typed {
    /// Its name.
    pub name: Symbol,
    /// Its type; several for `(either …)`; never empty, `object` where none is stated.
    pub types: Vec<Symbol>,
}

/// A variable or an object.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PddlTerm {
    /// A variable, without its question mark.
    Variable(Symbol),
    /// A constant of the domain or an object of the problem.
    Object(Symbol),
}

impl fmt::Display for PddlTerm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variable(name) => write!(f, "?{name}"),
            Self::Object(name) => write!(f, "{name}"),
        }
    }
}

impl fmt::Debug for PddlTerm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// An atom over variables and objects.
pub type PddlAtom = Atom<PddlTerm>;

/// A condition: of an action, of an effect, of a derived predicate, or of the goal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Formula {
    /// An atom.
    Atom(PddlAtom),
    /// `(= a b)`.
    Equal(PddlTerm, PddlTerm),
    /// `(not f)`.
    Not(Box<Formula>),
    /// `(and f …)`; without parts it is true.
    And(Vec<Formula>),
    /// `(or f …)`; without parts it is false.
    Or(Vec<Formula>),
    /// `(imply f g)`.
    Imply(Box<Formula>, Box<Formula>),
    /// `(exists (variables) f)`.
    Exists(Vec<Typed>, Box<Formula>),
    /// `(forall (variables) f)`.
    Forall(Vec<Typed>, Box<Formula>),
}

impl Formula {
    /// What always holds: `(and)`.
    pub fn truth() -> Self {
        Self::And(Vec::new())
    }

    /// Calls `each` with every predicate and whether it stands there unnegated, if the formula itself does (`positive`) or
    /// not.
    pub(crate) fn for_each_predicate<'f>(&'f self, positive: bool, each: &mut impl FnMut(&'f Symbol, bool)) {
        match self {
            Self::Atom(atom) => each(&atom.predicate, positive),
            Self::Equal(..) => {}
            Self::Not(inner) => inner.for_each_predicate(!positive, each),
            Self::And(parts) | Self::Or(parts) => {
                parts.iter().for_each(|part| part.for_each_predicate(positive, each));
            }
            Self::Imply(premise, conclusion) => {
                premise.for_each_predicate(!positive, each);
                conclusion.for_each_predicate(positive, each);
            }
            Self::Exists(_, body) | Self::Forall(_, body) => body.for_each_predicate(positive, each),
        }
    }
}

/// What an action does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PddlEffect {
    /// `(and e …)`.
    And(Vec<PddlEffect>),
    /// An atom that holds afterwards.
    Add(PddlAtom),
    /// `(not atom)`: an atom that does not hold afterwards, unless it is also added.
    Delete(PddlAtom),
    /// `(forall (variables) e)`.
    Forall(Vec<Typed>, Box<PddlEffect>),
    /// `(when condition e)`.
    When(Formula, Box<PddlEffect>),
    /// `(increase (total-cost) amount)`; only outside of `forall` and `when`.
    Increase(Amount),
}

impl PddlEffect {
    /// The predicates that it may change.
    pub(crate) fn changed(&self) -> BTreeSet<&Symbol> {
        match self {
            Self::And(parts) => parts.iter().flat_map(Self::changed).collect(),
            Self::Add(atom) | Self::Delete(atom) => BTreeSet::from([&atom.predicate]),
            Self::Forall(_, body) | Self::When(_, body) => body.changed(),
            Self::Increase(_) => BTreeSet::new(),
        }
    }

    /// Calls `each` with every atom that it may add.
    pub(crate) fn for_each_added(&self, each: &mut impl FnMut(&PddlAtom)) {
        match self {
            Self::And(parts) => parts.iter().for_each(|part| part.for_each_added(each)),
            Self::Forall(_, body) | Self::When(_, body) => body.for_each_added(each),
            Self::Add(atom) => each(atom),
            Self::Delete(_) | Self::Increase(_) => {}
        }
    }

    /// Whether it says something of the total cost.
    pub(crate) fn increases(&self) -> bool {
        match self {
            Self::And(parts) => parts.iter().any(Self::increases),
            Self::Forall(_, body) | Self::When(_, body) => body.increases(),
            Self::Increase(_) => true,
            Self::Add(_) | Self::Delete(_) => false,
        }
    }
}

/// By how much an action increases the total cost.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Amount {
    /// A whole number.
    Number(u32),
    /// A function that never changes, such as `(distance ?from ?to)`.
    Function(PddlAtom),
}

/// A declared predicate or function: its name and its arguments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// The name.
    pub name: Symbol,
    /// The arguments; in predicates, one name may stand for several.
    pub parameters: Vec<Typed>,
}

/// `(:derived (predicate ?x …) condition)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Derived {
    /// The predicate and its variables, all different.
    pub head: Signature,
    /// When it holds.
    pub condition: Formula,
    /// Comments that are written before it, a line each; not read.
    pub comment: Vec<String>,
}

/// `(:action …)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Action {
    /// Its name.
    pub name: Symbol,
    /// Its parameters, all different.
    pub parameters: Vec<Typed>,
    /// When it can be used.
    pub precondition: Formula,
    /// What it does.
    pub effect: PddlEffect,
    /// Comments that are written before it, a line each; not read.
    pub comment: Vec<String>,
}

/// A domain.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Domain {
    /// Its name.
    pub name: Symbol,
    /// What it says it requires, with the colon: `:strips`.
    pub requirements: Vec<Symbol>,
    /// Each declared type with its parent, in the order of the text; without `object` itself.
    pub types: Vec<(Symbol, Symbol)>,
    /// The constants.
    pub constants: Vec<Typed>,
    /// The predicates, derived ones included.
    pub predicates: Vec<Signature>,
    /// The functions, `total-cost` included.
    pub functions: Vec<Signature>,
    /// The derived predicates' conditions.
    pub derived: Vec<Derived>,
    /// The actions.
    pub actions: Vec<Action>,
    /// Comments that are written at the top, a line each; not read.
    pub comment: Vec<String>,
}

/// A problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Its name.
    pub name: Symbol,
    /// The name of the domain that it says it belongs to.
    pub domain: Symbol,
    /// What it says it requires.
    pub requirements: Vec<Symbol>,
    /// The objects, without the domain's constants.
    pub objects: Vec<Typed>,
    /// The atoms that hold initially, in the order of the text.
    pub init: Vec<Atom<Symbol>>,
    /// The values of functions, `total-cost` included.
    pub values: Vec<(Atom<Symbol>, u32)>,
    /// The goal.
    pub goal: Formula,
    /// Whether the total cost is to be minimized; else the number of steps is.
    pub minimizes_cost: bool,
    /// Comments that are written at the top, a line each; not read.
    pub comment: Vec<String>,
}
