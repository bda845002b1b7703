//! What was done in a run: by whom, where, and what came of it. Unlike evidence, which speaks of types, a deed names objects.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift_model::{ActionSchema, GroundCall, Hierarchy, LiftedAtom, State, Step, Symbol, Term};

use crate::surroundings::Surrounding;

/// An object that took part in an action.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Participant {
    /// Its name, which means something in its instance only.
    pub object: Symbol,
    /// Its type's name.
    #[serde(rename = "type")]
    pub ty: Symbol,
    /// Its place among the call's arguments, from 0; none if the call does not name it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<usize>,
}

/// Who took part in what, where.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Deed {
    /// The instance of the world.
    pub instance: Symbol,
    /// The call's name.
    pub call: Symbol,
    /// The predicates of what the action was to add.
    pub adds: BTreeSet<Symbol>,
    /// Who took part, in the order of the action's parameters.
    pub participants: Vec<Participant>,
    /// The atoms over them that held before; each by its place in that order.
    #[serde(default)]
    pub held: BTreeSet<LiftedAtom>,
}

impl Deed {
    /// What a step is, done by this action in this state of an instance.
    pub fn of(step: &Step, schema: &ActionSchema, state: &State, instance: &Symbol, hierarchy: &Hierarchy) -> Self {
        let participants = step.objects.iter().zip(&schema.parameters).enumerate();
        let participants = participants.map(|(index, (object, parameter))| Participant {
            object: object.clone(),
            // What vanished had a type that fits.
            ty: hierarchy.name(state.objects.get(object).copied().unwrap_or(parameter.ty)).clone(),
            place: schema.call.args.iter().position(|term| *term == Term::Param(index as u32)),
        });
        Self {
            instance: instance.clone(),
            call: step.call.name.clone(),
            adds: schema.adds().map(|atom| atom.predicate.clone()).collect(),
            participants: participants.collect(),
            held: held(&step.objects, state),
        }
    }

    /// What was done with this call in this state of an instance by what is known of it afterwards: these objects took part,
    /// and atoms of these predicates were to be added. The same as [`of`](Self::of) says, unless an object took two parts.
    pub fn recorded(
        call: &GroundCall,
        objects: &[Symbol],
        adds: BTreeSet<Symbol>,
        state: &State,
        instance: &Symbol,
        hierarchy: &Hierarchy,
    ) -> Self {
        let participants = objects.iter().map(|object| Participant {
            object: object.clone(),
            ty: hierarchy.name(state.objects.get(object).copied().unwrap_or(hierarchy.root())).clone(),
            place: call.args.iter().position(|arg| arg == object),
        });
        let (instance, call) = (instance.clone(), call.name.clone());
        Self { instance, call, adds, participants: participants.collect(), held: held(objects, state) }
    }

    /// Whether it was to do what this action does.
    pub fn is_of(&self, schema: &ActionSchema) -> bool {
        let adds: BTreeSet<&Symbol> = schema.adds().map(|atom| &atom.predicate).collect();
        let as_many = self.participants.len() == schema.parameters.len();
        as_many && self.call == schema.call.name && self.adds.iter().eq(adds)
    }

    /// The objects that the call names, by their places.
    pub fn named(&self) -> BTreeMap<usize, Symbol> {
        self.participants.iter().filter_map(|one| Some((one.place?, one.object.clone()))).collect()
    }

    /// For each participant the parameter of an action that does the same; where the action takes them in another order, as
    /// far as the call says it. None for an action that does something else.
    pub(crate) fn parameters(&self, schema: &ActionSchema) -> Option<Vec<Option<u32>>> {
        if !self.is_of(schema) {
            return None;
        }
        let place = |parameter: u32| schema.call.args.iter().position(|term| *term == Term::Param(parameter));
        if (0..).zip(&self.participants).all(|(parameter, participant)| participant.place == place(parameter)) {
            return Some((0..self.participants.len() as u32).map(Some).collect());
        }
        let of_place = |place: usize| match schema.call.args.get(place) {
            Some(Term::Param(parameter)) => Some(*parameter),
            _ => None,
        };
        Some(self.participants.iter().map(|participant| of_place(participant.place?)).collect())
    }
}

/// The atoms of a state over these objects alone, each by its place among them.
fn held(objects: &[Symbol], state: &State) -> BTreeSet<LiftedAtom> {
    let place = |name: &Symbol| objects.iter().position(|object| object == name).map(|at| Term::Param(at as u32));
    let lifted = state.atoms.iter().filter(|atom| !atom.args.is_empty()).filter_map(|atom| {
        let args = atom.args.iter().map(place).collect::<Option<Vec<Term>>>()?;
        Some(LiftedAtom { predicate: atom.predicate.clone(), args })
    });
    lifted.collect()
}

/// Something that was tried in a run, and whether it worked.
#[derive(Debug, Clone, Copy)]
pub struct Tried<'d> {
    /// What was done.
    pub deed: &'d Deed,
    /// Whether what the action says happened.
    pub worked: bool,
    /// How often, retries included.
    pub count: u64,
    /// Its place in the order in which all was tried, of the last time.
    pub when: u64,
    /// How many tasks ago.
    pub tasks_ago: u64,
    /// Who acted: never out of order.
    pub actors: &'d BTreeSet<Symbol>,
    /// Who the goal spoke of: rarely out of order.
    pub in_goal: &'d BTreeSet<Symbol>,
    /// What held around it, where it failed.
    pub around: &'d BTreeSet<Surrounding>,
}
