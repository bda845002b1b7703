//! Why there is no plan.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionModel, ActionSchema, GroundAtom, HashMap, LiftedAtom, Symbol, Task, Term, TypeId};

use crate::Restrictions;
use crate::reach::Reachable;

/// What stands between an action and the atom that it could achieve.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Obstacle {
    /// An object has a type that the action does not take.
    Type {
        /// The object.
        object: Symbol,
        /// Its type.
        found: Symbol,
        /// The type that the action takes there.
        expected: Symbol,
    },
    /// There is no such object.
    Missing {
        /// The object's name.
        object: Symbol,
    },
    /// An object may not be used.
    Excluded {
        /// The object.
        object: Symbol,
    },
    /// No object of a type may be used.
    NoObject {
        /// The type.
        ty: Symbol,
    },
    /// Every ground action that would do was tried, and may not be tried again.
    Banned,
    /// A precondition cannot be reached; parameters that the atom leaves open are written by their type.
    Precondition(String),
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Type { object, found, expected } => write!(f, "{object} is of type {found}, not {expected}"),
            Self::Missing { object } => write!(f, "there is no {object}"),
            Self::Excluded { object } => write!(f, "{object} may not be used any more"),
            Self::NoObject { ty } => write!(f, "there is no {ty} that may be used"),
            Self::Banned => f.write_str("what fits it was tried and failed"),
            Self::Precondition(atom) => write!(f, "it needs {atom}, which cannot be reached"),
        }
    }
}

/// The action that comes nearest to achieving an atom.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Nearest {
    /// Its name.
    pub action: Symbol,
    /// What is missing; empty if only no choice of objects satisfies all preconditions at once.
    pub obstacles: Vec<Obstacle>,
}

/// A goal atom that cannot be reached even if nothing is ever deleted.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnreachableGoal {
    /// The atom.
    pub atom: GroundAtom,
    /// The nearest action; none if no action adds an atom of this predicate.
    pub nearest: Option<Nearest>,
    /// Whether its predicate is derived, so that no action adds it.
    pub derived: bool,
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Explanation {
    /// Some goal atoms cannot be reached at all.
    Unreachable(Vec<UnreachableGoal>),
    /// Two goal atoms exclude each other: whatever achieves the one deletes the other for good.
    Exclusive {
        /// The one.
        one: GroundAtom,
        /// The other.
        other: GroundAtom,
    },
    /// Another planner says so, and no more.
    ToldByPlanner,
    /// These atoms must not hold in the end, but do from the start, and no action deletes them.
    NeverDeleted(Vec<GroundAtom>),
    /// Each goal atom can be reached, but not all together; where the search came closest, these were missing.
    NotTogether {
        /// The missing goal atoms, and whether each must hold.
        missing: Vec<(GroundAtom, bool)>,
    },
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreachable(goals) => {
                for (i, goal) in goals.iter().enumerate() {
                    if i > 0 {
                        f.write_str("\n")?;
                    }
                    write!(f, "{} cannot be reached: ", goal.atom)?;
                    match &goal.nearest {
                        None if goal.derived => f.write_str("it follows from nothing that can be reached")?,
                        None => write!(f, "no action adds {}", goal.atom.predicate)?,
                        Some(nearest) if nearest.obstacles.is_empty() => {
                            write!(f, "no choice of objects satisfies all preconditions of {}", nearest.action)?;
                        }
                        Some(nearest) => {
                            let obstacles: Vec<String> = nearest.obstacles.iter().map(ToString::to_string).collect();
                            write!(f, "the nearest action is {}, but {}", nearest.action, obstacles.join(", and "))?;
                        }
                    }
                }
                Ok(())
            }
            Self::Exclusive { one, other } => {
                write!(f, "{one} and {other} cannot hold together: whatever achieves the one deletes the other")
            }
            Self::ToldByPlanner => f.write_str("the planner says that there is none"),
            Self::NeverDeleted(atoms) => {
                let lines: Vec<String> = atoms
                    .iter()
                    .map(|atom| format!("{atom} must not hold in the end, but no action deletes it"))
                    .collect();
                f.write_str(&lines.join("\n"))
            }
            Self::NotTogether { missing } => {
                let missing: Vec<String> = missing
                    .iter()
                    .map(|(atom, positive)| format!("{}{atom}", if *positive { "" } else { "not " }))
                    .collect();
                write!(
                    f,
                    "each goal can be reached alone, but not all together; at best this is missing: {}",
                    missing.join(" ")
                )
            }
        }
    }
}

/// For each unreachable goal atom, the action that comes nearest to it.
pub(crate) fn unreachable(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    reachable: &Reachable,
) -> Vec<UnreachableGoal> {
    let context = Context { model, task, restrictions, reached: reachable.atoms_by_predicate() };
    let nearest = |atom: &GroundAtom| {
        let adding = model.adding(atom).map(|(schema, binding)| context.obstacles(schema, &binding));
        adding.min_by_key(|nearest| nearest.obstacles.len())
    };
    reachable
        .unreached_goals()
        .iter()
        .map(|atom| UnreachableGoal {
            atom: atom.clone(),
            nearest: nearest(atom),
            derived: model.axioms.iter().any(|axiom| axiom.head.predicate == atom.predicate),
        })
        .collect()
}

struct Context<'a> {
    model: &'a ActionModel,
    task: &'a Task,
    restrictions: &'a Restrictions,
    /// The reachable atoms of each predicate.
    reached: HashMap<Symbol, Vec<GroundAtom>>,
}

impl Context<'_> {
    /// What keeps `schema` from adding an atom that puts these objects in the place of its parameters.
    fn obstacles(&self, schema: &ActionSchema, binding: &[Option<&Symbol>]) -> Nearest {
        let hierarchy = &self.model.hierarchy;
        let mut obstacles = Vec::new();
        for (index, (parameter, object)) in schema.parameters.iter().zip(binding).enumerate() {
            let Some(object) = object else {
                let usable = |(name, ty): (&Symbol, &TypeId)| {
                    hierarchy.is_a(*ty, parameter.ty)
                        && self.restrictions.allows(name, &schema.call.name)
                        && self.allows_type(schema, index, *ty)
                };
                if !self.task.init.objects.iter().any(usable) {
                    obstacles.push(Obstacle::NoObject { ty: hierarchy.name(parameter.ty).clone() });
                }
                continue;
            };
            let Some(&ty) = self.task.init.objects.get(*object) else {
                obstacles.push(Obstacle::Missing { object: (*object).clone() });
                continue;
            };
            if !hierarchy.is_a(ty, parameter.ty) {
                let (found, expected) = (hierarchy.name(ty).clone(), hierarchy.name(parameter.ty).clone());
                obstacles.push(Obstacle::Type { object: (*object).clone(), found, expected });
            } else if !self.restrictions.allows(object, &schema.call.name) || !self.allows_type(schema, index, ty) {
                obstacles.push(Obstacle::Excluded { object: (*object).clone() });
            }
        }
        if obstacles.is_empty() {
            let missing = schema.positive_preconditions().find(|pre| !self.reachable_somehow(schema, pre, binding));
            obstacles.extend(missing.map(|pre| Obstacle::Precondition(written(schema, pre, binding, self.model))));
        }
        let is_banned = || self.restrictions.banned.iter().any(|ban| ban.call.name == schema.call.name);
        let may_not_meet = || self.restrictions.types.iter().any(|exclusion| exclusion.concerns(schema));
        if obstacles.is_empty() && (is_banned() || may_not_meet()) {
            obstacles.push(Obstacle::Banned);
        }
        Nearest { action: schema.name.clone(), obstacles }
    }

    /// Whether an object of this type may be this parameter, whatever the others are.
    fn allows_type(&self, schema: &ActionSchema, index: usize, ty: TypeId) -> bool {
        let mut types = vec![None; schema.parameters.len()];
        types[index] = Some(ty);
        self.restrictions.allows_types(schema, &types, &self.model.hierarchy)
    }

    /// Whether some instance of a precondition under a partial binding is reachable.
    fn reachable_somehow(&self, schema: &ActionSchema, pre: &LiftedAtom, binding: &[Option<&Symbol>]) -> bool {
        let is_of_type = |p: usize, object: &Symbol, _: &_| {
            self.model.hierarchy.is_a(self.task.init.objects[object], schema.parameters[p].ty)
        };
        let mut binding = binding.to_vec();
        self.reached
            .get(&pre.predicate)
            .into_iter()
            .flatten()
            .any(|fact| pre.bind(fact, &mut binding, is_of_type).is_some())
    }
}

/// A lifted atom with bound parameters written as objects and others as `any TYPE`.
fn written(schema: &ActionSchema, atom: &LiftedAtom, binding: &[Option<&Symbol>], model: &ActionModel) -> String {
    atom.map(|term| match term {
        Term::Const(name) => name.to_string(),
        Term::Param(p) => match binding[*p as usize] {
            Some(object) => object.to_string(),
            None => format!("any {}", model.hierarchy.name(schema.parameters[*p as usize].ty)),
        },
    })
    .to_string()
}
