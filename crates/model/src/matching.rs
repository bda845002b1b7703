//! Matching patterns with atoms: which objects the parameters stand for, if the two are to be the same.

use crate::{ActionModel, ActionSchema, Effect, GroundAtom, LiftedAtom, Symbol, Term};

/// What a pattern has in one place: an object, or a parameter by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place<O> {
    /// This object and no other.
    Object(O),
    /// Whatever the parameter stands for.
    Param(usize),
}

impl<O: Copy> Place<O> {
    /// The object here under a binding, if there is one yet.
    pub fn object(self, binding: &[Option<O>]) -> Option<O> {
        match self {
            Self::Object(object) => Some(object),
            Self::Param(p) => binding[p],
        }
    }
}

/// Binds the open parameters of a pattern so that it has these objects in its places: the parameters newly bound, or
/// `None` with the binding as it was.
///
/// `may_take` says whether an object may take an open parameter's place, under what is bound so far. Linear in the places.
///
/// # Panics
/// If the pattern has a parameter for which the binding has no place.
pub fn bind_places<O: Copy + Eq>(
    pattern: impl ExactSizeIterator<Item = Place<O>>,
    objects: impl ExactSizeIterator<Item = O>,
    binding: &mut [Option<O>],
    may_take: impl Fn(usize, O, &[Option<O>]) -> bool,
) -> Option<Vec<usize>> {
    if pattern.len() != objects.len() {
        return None;
    }
    let mut bound = Vec::new();
    for (place, object) in pattern.zip(objects) {
        let matches = match place {
            Place::Object(expected) => expected == object,
            Place::Param(p) => match binding[p] {
                Some(known) => known == object,
                None if may_take(p, object, binding) => {
                    binding[p] = Some(object);
                    bound.push(p);
                    true
                }
                None => false,
            },
        };
        if !matches {
            for p in bound {
                binding[p] = None;
            }
            return None;
        }
    }
    Some(bound)
}

impl LiftedAtom {
    /// Binds the open parameters so that this is a certain ground atom, as [`bind_places`] does.
    ///
    /// ```
    /// use typelift_model::{Atom, Symbol, Term};
    ///
    /// let lifted = Atom::new(Symbol::new("on"), vec![Term::Param(1), Term::Const(Symbol::new("table"))]);
    /// let ground = Atom::new(Symbol::new("on"), vec![Symbol::new("cup"), Symbol::new("table")]);
    /// let mut binding = [None, None];
    /// assert_eq!(lifted.bind(&ground, &mut binding, |_, _, _| true), Some(vec![1]));
    /// assert_eq!(binding, [None, Some(&Symbol::new("cup"))]);
    /// ```
    pub fn bind<'a>(
        &'a self,
        atom: &'a GroundAtom,
        binding: &mut [Option<&'a Symbol>],
        may_take: impl Fn(usize, &'a Symbol, &[Option<&'a Symbol>]) -> bool,
    ) -> Option<Vec<usize>> {
        if self.predicate != atom.predicate {
            return None;
        }
        let places = self.args.iter().map(|term| match term {
            Term::Const(name) => Place::Object(name),
            Term::Param(p) => Place::Param(*p as usize),
        });
        bind_places(places, atom.args.iter(), binding, may_take)
    }
}

impl ActionModel {
    /// The effects that may add an atom if types and preconditions allow it: the actions, in the model's order, each with
    /// the effect and the objects that the atom puts in the place of the action's parameters and then of the effect's own.
    pub fn adding<'a>(
        &'a self,
        atom: &'a GroundAtom,
    ) -> impl Iterator<Item = (&'a ActionSchema, &'a Effect, Vec<Option<&'a Symbol>>)> {
        self.changing(atom, true)
    }

    /// The effects that may delete an atom, in the same way.
    pub fn deleting<'a>(
        &'a self,
        atom: &'a GroundAtom,
    ) -> impl Iterator<Item = (&'a ActionSchema, &'a Effect, Vec<Option<&'a Symbol>>)> {
        self.changing(atom, false)
    }

    fn changing<'a>(
        &'a self,
        atom: &'a GroundAtom,
        adds: bool,
    ) -> impl Iterator<Item = (&'a ActionSchema, &'a Effect, Vec<Option<&'a Symbol>>)> {
        let effects = self.actions.iter().flat_map(|schema| schema.effects.iter().map(move |effect| (schema, effect)));
        effects.filter(move |(_, effect)| effect.literal.positive == adds).filter_map(|(schema, effect)| {
            let mut binding = vec![None; schema.parameters.len() + effect.parameters.len()];
            effect.literal.atom.bind(atom, &mut binding, |_, _, _| true)?;
            Some((schema, effect, binding))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_stands_for_one_object_and_what_does_not_match_binds_nothing() {
        let pattern = || [Place::Param(0), Place::Object('t'), Place::Param(0)].into_iter();
        let mut binding = [None];
        assert_eq!(bind_places(pattern(), ['a', 't', 'b'].into_iter(), &mut binding, |_, _, _| true), None);
        assert_eq!(bind_places(pattern(), ['a', 's', 'a'].into_iter(), &mut binding, |_, _, _| true), None);
        assert_eq!(bind_places(pattern(), ['a', 't'].into_iter(), &mut binding, |_, _, _| true), None);
        assert_eq!(
            bind_places(pattern(), ['a', 't', 'a'].into_iter(), &mut binding, |_, object, _| object != 'a'),
            None
        );
        assert_eq!(binding, [None]);
        assert_eq!(bind_places(pattern(), ['a', 't', 'a'].into_iter(), &mut binding, |_, _, _| true), Some(vec![0]));
        // What is bound already is matched, and stays.
        assert_eq!(bind_places(pattern(), ['a', 't', 'a'].into_iter(), &mut binding, |_, _, _| false), Some(vec![]));
        assert_eq!(bind_places(pattern(), ['b', 't', 'b'].into_iter(), &mut binding, |_, _, _| true), None);
        assert_eq!(binding, [Some('a')]);
    }
}
