//! With which objects a large task is planned: first with those that can matter for the goal, then with more and more of
//! them, in the end with all.
//!
//! In a room of 10,000 things a plan mentions a dozen. Level k = 1, 2, 4, … has the objects
//!
//! - that the goal or an action names,
//! - within k steps of those of the goal, a step leading from one object of an initial atom to another, but none through
//!   an object that shares atoms with very many others,
//! - that are the first k of their class, by name, with what is close beside each. Of one class are objects of one type of
//!   which the initial atoms and the values say the same but for the other objects' names; their types count.
//!
//! A level with more than a certain share of the objects is left out: it would cost nearly as much as all of them, and often
//! for nothing. A plan with fewer objects is a plan with all, since a ground action does not depend on which other objects
//! there are. Where it does, because a condition or an effect is about all objects, no levels are used. That no plan is found
//! with fewer objects says nothing.
//!
//! Up to 50 objects, or 1,000 for lazy searches, all are taken at once; so they are where a cheapest plan is wanted. That there
//! is no plan, no further one, none that is cheaper, and what is wrong with the goal, is only ever said of all objects.

use std::borrow::Cow;
use std::collections::{BTreeSet, VecDeque};

use typelift_model::{ActionModel, GroundAtom, HashMap, State, Symbol, Task};

use crate::Restrictions;
use crate::alike::{alike, constants};

/// When fewer objects are tried first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Thresholds {
    /// Tasks with at most so many objects are planned with all of them.
    few: usize,
    /// The largest share of the objects that a level may have, as a fraction.
    share: (usize, usize),
}

/// For the paper's search, which estimates every successor, so that each object costs much.
pub(crate) const EAGERLY: Thresholds = Thresholds { few: 50, share: (2, 3) };
/// For searches that estimate what they expand.
pub(crate) const LAZILY: Thresholds = Thresholds { few: 1_000, share: (1, 4) };
/// No step leads through an object with more neighbours than this.
const MANY_NEIGHBOURS: usize = 16;
/// An object with at most this many neighbours brings them with it.
const CLOSE_NEIGHBOURS: usize = 4;
/// How many states may be expanded with the objects of level 1 before there are more objects.
const EXPANSIONS: u64 = 2_000;

/// A number of an object, by its place in name order.
type Object = usize;

/// The levels that a task has left.
#[derive(Debug)]
pub(crate) struct Scopes {
    objects: Vec<Symbol>,
    /// The objects that share an initial atom with each.
    neighbours: Vec<Vec<Object>>,
    /// The objects of each class, in the order of names.
    classes: Vec<Vec<Object>>,
    /// The number of steps from the goal's objects, where they lead there; 0 for what an action names.
    distance: Vec<Option<usize>>,
    /// The largest share of the objects that a level may have, as a fraction.
    share: (usize, usize),
    /// The level, and whether each object is in it; `None` if it has all.
    current: Option<(usize, Vec<bool>)>,
}

impl Scopes {
    /// All objects at once.
    pub(crate) fn whole() -> Self {
        let (objects, neighbours, classes, distance) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { objects, neighbours, classes, distance, share: (1, 1), current: None }
    }

    /// The levels of a task, standing at the first.
    pub(crate) fn of(model: &ActionModel, task: &Task, restrictions: &Restrictions, thresholds: Thresholds) -> Self {
        if task.init.objects.len() <= thresholds.few || speaks_of_all(model) {
            return Self::whole();
        }
        let ids: HashMap<&Symbol, Object> = task.init.objects.keys().zip(0..).collect();
        let neighbours = neighbours(task, &ids);
        let near = task.goal.literals().flat_map(|(atom, _)| &atom.args).filter_map(|name| ids.get(name).copied());
        let mut distance = distances(near, &neighbours);
        for object in constants(model).into_iter().filter_map(|name| ids.get(name)) {
            distance[*object] = Some(0);
        }
        let classes = classes(task, restrictions, &ids);
        let objects = task.init.objects.keys().cloned().collect();
        let mut this = Self { objects, neighbours, classes, distance, share: thresholds.share, current: None };
        this.current = this.level(1);
        this
    }

    /// Goes on to the next level.
    pub(crate) fn advance(&mut self) {
        self.current = self.current.take().and_then(|(level, kept)| {
            let size = |kept: &[bool]| kept.iter().filter(|kept| **kept).count();
            let mut next = self.level(2 * level)?;
            // The same objects once more would find no more.
            while size(&next.1) == size(&kept) {
                next = self.level(2 * next.0)?;
            }
            Some(next)
        });
    }

    /// Whether this level has all objects.
    pub(crate) fn is_whole(&self) -> bool {
        self.current.is_none()
    }

    /// How many states may be expanded at this level for a plan, if there is a next.
    pub(crate) fn expansions(&self) -> Option<u64> {
        self.current.as_ref().map(|(level, _)| EXPANSIONS * *level as u64)
    }

    /// The task with the objects of this level alone.
    pub(crate) fn restrict<'t>(&self, task: &'t Task) -> Cow<'t, Task> {
        let Some((_, kept)) = &self.current else { return Cow::Borrowed(task) };
        let kept: BTreeSet<&Symbol> =
            self.objects.iter().zip(kept).filter(|(_, kept)| **kept).map(|(o, _)| o).collect();
        let known = |atom: &&GroundAtom| atom.args.iter().all(|object| kept.contains(object));
        let init = State {
            objects: kept.iter().map(|&object| (object.clone(), task.init.objects[object])).collect(),
            atoms: task.init.atoms.iter().filter(known).cloned().collect(),
            unknown: task.init.unknown.clone(),
        };
        let values = task.values.iter().filter(|(atom, _)| known(atom)).map(|(atom, value)| (atom.clone(), *value));
        Cow::Owned(Task { init, goal: task.goal.clone(), values: values.collect() })
    }

    /// A level, unless it has so many objects that it may as well have all.
    fn level(&self, level: usize) -> Option<(usize, Vec<bool>)> {
        let mut kept: Vec<bool> =
            self.distance.iter().map(|distance| distance.is_some_and(|steps| steps <= level)).collect();
        for object in self.classes.iter().flat_map(|class| class.iter().take(level)) {
            kept[*object] = true;
            if self.neighbours[*object].len() <= CLOSE_NEIGHBOURS {
                for &neighbour in &self.neighbours[*object] {
                    kept[neighbour] = true;
                }
            }
        }
        let size = kept.iter().filter(|kept| **kept).count();
        (size * self.share.1 <= kept.len() * self.share.0).then_some((level, kept))
    }
}

/// Whether something holds or happens for all objects, so that fewer of them would be another task.
fn speaks_of_all(model: &ActionModel) -> bool {
    let mut effects = model.actions.iter().flat_map(|action| &action.effects);
    !model.axioms.is_empty() || effects.any(|effect| !effect.parameters.is_empty())
}

fn neighbours(task: &Task, ids: &HashMap<&Symbol, Object>) -> Vec<Vec<Object>> {
    let mut neighbours: Vec<Vec<Object>> = vec![Vec::new(); ids.len()];
    for atom in &task.init.atoms {
        let args: Vec<Object> = atom.args.iter().filter_map(|name| ids.get(name).copied()).collect();
        for &one in &args {
            neighbours[one].extend(args.iter().filter(|&&other| other != one));
        }
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}

/// The number of steps to each object.
fn distances(from: impl Iterator<Item = Object>, neighbours: &[Vec<Object>]) -> Vec<Option<usize>> {
    let mut distance = vec![None; neighbours.len()];
    let mut queue: VecDeque<(Object, usize)> = from.map(|object| (object, 0)).collect();
    while let Some((object, steps)) = queue.pop_front() {
        if distance[object].is_some() {
            continue;
        }
        distance[object] = Some(steps);
        if neighbours[object].len() <= MANY_NEIGHBOURS {
            queue.extend(neighbours[object].iter().map(|&neighbour| (neighbour, steps + 1)));
        }
    }
    distance
}

/// Objects of which the task says the same. Objects with exclusions are a class of their own.
fn classes(task: &Task, restrictions: &Restrictions, ids: &HashMap<&Symbol, Object>) -> Vec<Vec<Object>> {
    let distrusted: BTreeSet<&Symbol> = restrictions.excluded.iter().map(|exclusion| &exclusion.object).collect();
    let objects = task.init.objects.iter().map(|(name, ty)| (name, (*ty, distrusted.contains(name))));
    let initial = task.init.atoms.iter().map(|atom| (None, atom));
    let values = task.values.iter().map(|(atom, value)| (Some(*value), atom));
    let classes = alike(objects, initial.chain(values), |other| task.init.objects.get(other).copied());
    classes.iter().map(|class| class.iter().map(|name| ids[name]).collect()).collect()
}
