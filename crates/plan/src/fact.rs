//! Facts and objects by number: what grounding and search work on instead of names.

use typelift_model::{GroundAtom, HashMap, Symbol, Task, TypeId};

/// A fact of one [`GroundTask`](crate::GroundTask).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FactId(u32);

impl FactId {
    pub(crate) fn new(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An object of the task, by its place in name order; only its [`Facts`] make them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct ObjectId(u32);

impl ObjectId {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// The tables of a task's objects, predicates and facts.
#[derive(Debug, Default)]
pub(crate) struct Facts {
    pub(crate) objects: Vec<(Symbol, TypeId)>,
    object_ids: HashMap<Symbol, ObjectId>,
    predicate_ids: HashMap<Symbol, u32>,
    predicates: Vec<Symbol>,
    keys: Vec<(u32, Box<[ObjectId]>)>,
    ids: HashMap<(u32, Box<[ObjectId]>), FactId>,
    reached: Vec<bool>,
}

impl Facts {
    pub(crate) fn new(task: &Task) -> Self {
        let objects: Vec<_> = task.init.objects.iter().map(|(name, ty)| (name.clone(), *ty)).collect();
        let object_ids = objects.iter().zip(0..).map(|((name, _), i)| (name.clone(), ObjectId(i))).collect();
        Self { objects, object_ids, ..Self::default() }
    }

    pub(crate) fn object_id(&self, name: &Symbol) -> Option<ObjectId> {
        self.object_ids.get(name).copied()
    }

    pub(crate) fn predicate_id(&mut self, name: &Symbol) -> u32 {
        if let Some(&id) = self.predicate_ids.get(name) {
            return id;
        }
        let id = self.predicates.len() as u32;
        self.predicates.push(name.clone());
        self.predicate_ids.insert(name.clone(), id);
        id
    }

    pub(crate) fn intern(&mut self, predicate: u32, args: Box<[ObjectId]>) -> FactId {
        let key = (predicate, args);
        if let Some(&id) = self.ids.get(&key) {
            return id;
        }
        let id = FactId::new(self.keys.len());
        self.keys.push(key.clone());
        self.ids.insert(key, id);
        self.reached.push(false);
        id
    }

    /// The number of a ground atom; `None` if it mentions an object that the task does not have.
    pub(crate) fn intern_atom(&mut self, atom: &GroundAtom) -> Option<FactId> {
        let args = atom.args.iter().map(|arg| self.object_id(arg)).collect::<Option<_>>()?;
        let predicate = self.predicate_id(&atom.predicate);
        Some(self.intern(predicate, args))
    }

    pub(crate) fn find(&self, atom: &GroundAtom) -> Option<FactId> {
        let predicate = *self.predicate_ids.get(&atom.predicate)?;
        let args = atom.args.iter().map(|arg| self.object_id(arg)).collect::<Option<_>>()?;
        self.ids.get(&(predicate, args)).copied()
    }

    pub(crate) fn find_by_ids(&self, predicate: u32, args: Box<[ObjectId]>) -> Option<FactId> {
        self.ids.get(&(predicate, args)).copied()
    }

    pub(crate) fn atom(&self, id: FactId) -> GroundAtom {
        let (predicate, args) = &self.keys[id.index()];
        GroundAtom {
            predicate: self.predicates[*predicate as usize].clone(),
            args: args.iter().map(|arg| self.name(*arg).clone()).collect(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.keys.len()
    }

    pub(crate) fn ids(&self) -> impl Iterator<Item = FactId> + use<> {
        (0..self.keys.len()).map(FactId::new)
    }

    pub(crate) fn is_reached(&self, id: FactId) -> bool {
        self.reached[id.index()]
    }

    pub(crate) fn reach(&mut self, id: FactId) {
        self.reached[id.index()] = true;
    }

    pub(crate) fn predicate(&self, id: FactId) -> u32 {
        self.keys[id.index()].0
    }

    pub(crate) fn args(&self, id: FactId) -> &[ObjectId] {
        &self.keys[id.index()].1
    }

    pub(crate) fn predicate_count(&self) -> usize {
        self.predicates.len()
    }

    pub(crate) fn object_ids(&self) -> impl Iterator<Item = ObjectId> + use<> {
        (0..self.objects.len() as u32).map(ObjectId)
    }

    pub(crate) fn name(&self, object: ObjectId) -> &Symbol {
        &self.objects[object.0 as usize].0
    }
}
