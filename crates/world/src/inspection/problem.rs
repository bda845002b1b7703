//! What can be wrong with what an environment shows.

use std::collections::BTreeSet;
use std::fmt;

use thiserror::Error;
use typelift_model::{GroundAtom, Symbol};

use crate::{DoubtfulParent, LeftOut, MixedRelation, ParseError};

/// Atoms that are listed; of more it is said how many there are.
const LISTED: usize = 3;

/// How a state differs from one that should be the same.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Change {
    /// Entities that only one of the two has.
    pub objects: BTreeSet<Symbol>,
    /// Atoms that only the second has.
    pub added: BTreeSet<GroundAtom>,
    /// Atoms that only the first has.
    pub deleted: BTreeSet<GroundAtom>,
}

impl Change {
    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        self.objects.is_empty() && self.added.is_empty() && self.deleted.is_empty()
    }

    /// The predicates of the atoms that differ.
    pub fn predicates(&self) -> impl Iterator<Item = &Symbol> {
        self.added.iter().chain(&self.deleted).map(|atom| &atom.predicate)
    }

    /// The atoms, each with a sign: `+on_holds(a,b)`, `-on_None(a)`.
    pub fn atoms(&self) -> Vec<String> {
        let added = self.added.iter().map(|atom| format!("+{atom}"));
        added.chain(self.deleted.iter().map(|atom| format!("-{atom}"))).collect()
    }
}

impl fmt::Display for Change {
    /// `+on_holds(a,b) -on_None(a) and 2 more`, or the entities that only one has: the atoms follow from that.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let differences: Vec<String> = match self.objects.is_empty() {
            false => self.objects.iter().map(ToString::to_string).collect(),
            true => self.atoms(),
        };
        f.write_str(&differences[..differences.len().min(LISTED)].join(" "))?;
        match differences.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}

/// Something that was found, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The request whose answer shows it: `reset`, `observe`, or an action. `state` if all states together do, `types` if the
    /// file of types does.
    pub place: String,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with what an environment shows.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Problem {
    /// A scene that is no state.
    #[error("this is no state: {0}")]
    NotAState(ParseError),
    /// A key of an entity that nothing reads.
    #[error("`{key}` of {entity} is not read")]
    UnreadKey {
        /// The key.
        key: Symbol,
        /// An entity that has it.
        entity: Symbol,
        /// The key that may have been meant.
        near: Symbol,
    },
    /// A type that the hierarchy does not have.
    #[error("the types do not have `{ty}`, the type of {entity}")]
    UnknownType {
        /// The type's name.
        ty: Symbol,
        /// An entity of it.
        entity: Symbol,
        /// The type that may have been meant.
        near: Option<Symbol>,
    },
    /// An entity that is now of this type and now of that.
    #[error("{entity} was a {before} before, and is a {now} now")]
    TypeChanges {
        /// The entity.
        entity: Symbol,
        /// Its type at first.
        before: Symbol,
        /// Its type later.
        now: Symbol,
    },
    /// The same seed gives different states.
    #[error("two resets with seed {seed} differ: {change}")]
    NotRepeatable {
        /// The seed.
        seed: u64,
        /// How the second differs from the first.
        change: Change,
    },
    /// The same seed gives the same atoms, but other numbers.
    #[error("two resets with seed {seed} differ in numbers only: {}", listed(.names))]
    NumbersNotRepeatable {
        /// The seed.
        seed: u64,
        /// The attributes that differ.
        names: BTreeSet<Symbol>,
    },
    /// The state goes on changing after the answer.
    #[error("what is observed right after the answer differs from it: {change}")]
    NotSettled {
        /// How what is observed differs from the answer.
        change: Change,
    },
    /// Something changes although nothing is done.
    #[error("nothing was done, and {} changed: {change}", listed(.names))]
    Flickers {
        /// The attributes and relations that change by themselves; of a symbolic state, the predicates.
        names: BTreeSet<Symbol>,
        /// One such change.
        change: Change,
    },
    /// An action makes entities appear or vanish.
    #[error("entities appeared or vanished: {}", listed(.objects))]
    EntitiesChange {
        /// These.
        objects: BTreeSet<Symbol>,
    },
    /// An action that was executed changes nothing that can be seen.
    #[error("it was executed, and no atom changed")]
    ChangesNothing,
    /// Every action changes it, also those that do not speak of it.
    #[error("all {actions} actions that were executed changed `{name}`{}, whatever they were", of(.entity.as_ref()))]
    ChangesEveryTime {
        /// The attribute or relation; of a symbolic state, the predicate.
        name: Symbol,
        /// The entity that has it.
        entity: Option<Symbol>,
        /// How many actions were executed.
        actions: usize,
    },
    /// An action that was not executed changes something.
    #[error("it was not executed, and yet something changed: {change}")]
    ChangesUnexecuted {
        /// What it changed.
        change: Change,
    },
    /// An action is to be tried with an entity that is not there.
    #[error("there is no entity `{entity}`")]
    NoSuchEntity {
        /// Its name.
        entity: Symbol,
        /// The entity that may have been meant.
        near: Option<Symbol>,
    },
    /// An action was executed with something that no state before it shows.
    #[error("it was executed, though no state before it shows `{entity}`")]
    MadeOnDemand {
        /// Its name.
        entity: Symbol,
    },
    /// A reset after the actions does not give what the one before them gave.
    #[error("a reset after the actions differs from the one before them: {change}")]
    NotUndone {
        /// How.
        change: Change,
    },
    /// An attribute or relation that is to be left out was never met.
    #[error("`{name}`, which is to be left out, was never met")]
    NothingIgnored {
        /// Its name.
        name: Symbol,
    },
    /// An attribute or relation that is there at times only.
    #[error("{0}")]
    LeftOut(LeftOut),
    /// A parent in the file of types that was probably not meant.
    #[error("{0}")]
    DoubtfulParent(DoubtfulParent),
    /// Two names that PDDL, and therefore a model, takes for one.
    #[error("`{one}` and `{other}` differ in case only")]
    DiffersInCase {
        /// The one.
        one: Symbol,
        /// The other.
        other: Symbol,
    },
    /// A relation that is now a list and now an id or null.
    #[error("{0}")]
    MixedRelation(MixedRelation),
    /// A relation that is a list, and never of more than one.
    #[error("the relation `{relation}` is a list, but never held more than one entity, and none of {empty}")]
    ListOfOne {
        /// The relation.
        relation: Symbol,
        /// An entity of which it is empty.
        empty: Symbol,
    },
    /// An attribute that has values of several kinds.
    #[error("the attribute `{attribute}` is now {}", .kinds.join(" and now "))]
    MixedAttribute {
        /// The attribute.
        attribute: Symbol,
        /// What it is, each with its article.
        kinds: Vec<&'static str>,
    },
    /// An attribute that is a number, of few values.
    #[error("the attribute `{attribute}` is a number, which gives no atom, and was only ever {}", .values.join(", "))]
    FewNumbers {
        /// The attribute.
        attribute: Symbol,
        /// Its values.
        values: Vec<String>,
    },
    /// An attribute that is a word, of very many values.
    #[error("the attribute `{attribute}` had {words} different words for {entities} {}, such as `{example}`", if *.entities == 1 { "entity" } else { "entities" })]
    ManyWords {
        /// The attribute.
        attribute: Symbol,
        /// How many words.
        words: usize,
        /// Of how many entities.
        entities: usize,
        /// One of the words.
        example: Symbol,
    },
    /// An attribute whose words are numbers.
    #[error("the attribute `{attribute}` is the word `{example}`, which is a number in quotation marks")]
    NumberAsWord {
        /// The attribute.
        attribute: Symbol,
        /// One of the words.
        example: Symbol,
    },
}

impl Problem {
    /// Whether the other one, found elsewhere, is nothing new: it is the same, or states that cannot be read, or that do not
    /// come to rest, for the same cause.
    pub(super) fn has_cause_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::NotAState(one), Self::NotAState(other)) => {
                one.entity == other.entity && std::mem::discriminant(&one.kind) == std::mem::discriminant(&other.kind)
            }
            (Self::NotSettled { change: one }, Self::NotSettled { change: other }) => {
                let predicates = |change: &Change| change.predicates().cloned().collect::<BTreeSet<_>>();
                one.objects == other.objects && predicates(one) == predicates(other)
            }
            _ => self == other,
        }
    }

    /// The word for it that a program reads.
    pub fn word(&self) -> &'static str {
        match self {
            Self::NotAState(_) => "not_a_state",
            Self::UnreadKey { .. } => "unread_key",
            Self::UnknownType { .. } => "unknown_type",
            Self::TypeChanges { .. } => "type_changes",
            Self::NotRepeatable { .. } => "not_repeatable",
            Self::NumbersNotRepeatable { .. } => "numbers_not_repeatable",
            Self::NotSettled { .. } => "not_settled",
            Self::Flickers { .. } => "flickers",
            Self::EntitiesChange { .. } => "entities_change",
            Self::ChangesNothing => "changes_nothing",
            Self::ChangesEveryTime { .. } => "changes_every_time",
            Self::ChangesUnexecuted { .. } => "changes_unexecuted",
            Self::NoSuchEntity { .. } => "no_such_entity",
            Self::MadeOnDemand { .. } => "made_on_demand",
            Self::NotUndone { .. } => "not_undone",
            Self::NothingIgnored { .. } => "nothing_ignored",
            Self::LeftOut(_) => "left_out",
            Self::DoubtfulParent(_) => "doubtful_parent",
            Self::DiffersInCase { .. } => "differs_in_case",
            Self::MixedRelation(_) => "mixed_relation",
            Self::ListOfOne { .. } => "list_of_one",
            Self::MixedAttribute { .. } => "mixed_attribute",
            Self::FewNumbers { .. } => "few_numbers",
            Self::ManyWords { .. } => "many_words",
            Self::NumberAsWord { .. } => "number_as_word",
        }
    }

    /// Whether it hurts in any case. The others may be meant.
    pub fn is_certain(&self) -> bool {
        !matches!(
            self,
            Self::NumbersNotRepeatable { .. }
                | Self::ChangesNothing
                | Self::ChangesEveryTime { .. }
                | Self::NoSuchEntity { .. }
                | Self::NothingIgnored { .. }
                | Self::LeftOut(_)
                | Self::DoubtfulParent(_)
                | Self::ListOfOne { .. }
                | Self::FewNumbers { .. }
                | Self::ManyWords { .. }
                | Self::NumberAsWord { .. }
        )
    }

    /// What to do about it.
    pub fn hint(&self) -> String {
        match self {
            Self::NotAState(_) => "Learning refuses such a state. Mend it, and check again: there may be more.".to_owned(),
            Self::UnreadKey { near, .. } => format!("Did you mean `{near}`?"),
            Self::UnknownType { near: Some(near), .. } => format!("Did you mean `{near}`?"),
            Self::UnknownType { ty, .. } => format!("Declare `{ty}` in the types file, under what it is a kind of."),
            Self::TypeChanges { .. } => {
                "An entity keeps its type; what changes about it is an attribute.".to_owned()
            }
            Self::NotRepeatable { change, .. } if !change.objects.is_empty() => {
                "The same seed must give the same entities: name them in a fixed order, and draw all chance from the \
                 seed."
                    .to_owned()
            }
            Self::NotRepeatable { .. } => "Draw all chance from the seed that `reset` is given. Otherwise a task cannot be \
                                           planned from its state, nor tried again with --restart."
                .to_owned(),
            Self::NumbersNotRepeatable { .. } => "Numbers give no atoms, but what an action does may depend on them. Draw all \
                                                  chance from the seed that `reset` is given."
                .to_owned(),
            Self::NotSettled { .. } => {
                "Answer only when the world has come to rest, with the state after that.".to_owned()
            }
            Self::Flickers { change, .. } if !change.objects.is_empty() => {
                "Report what is out of sight where it was seen last.".to_owned()
            }
            Self::Flickers { .. } => "Each such change makes one action look like several. Give it two thresholds \
                                      (hysteresis), or leave it out, with --ignore for example."
                .to_owned(),
            Self::EntitiesChange { .. } => "Nothing is learned from such a step. Report every entity from the start, a pool of \
                                            ids of those that are made on demand, and say with an attribute whether it is \
                                            there."
                .to_owned(),
            Self::ChangesNothing => "Learning takes this for a failure. What an action changes must be a relation, a word, \
                                     or true or false."
                .to_owned(),
            Self::ChangesEveryTime { name, .. } => format!(
                "What changes whatever the action, such as a clock, makes one action look like several. If no action needs \
                 it, leave it out, with --ignore {name} for example."
            ),
            Self::ChangesUnexecuted { .. } => "Learning takes it for a failure, and does not learn the change: say \
                                               \"executed\":true where the action was carried out."
                .to_owned(),
            Self::NoSuchEntity { near: Some(near), .. } => format!("Did you mean `{near}`?"),
            Self::NoSuchEntity { .. } => "Try it with one that the state shows.".to_owned(),
            Self::MadeOnDemand { .. } => crate::ON_DEMAND.to_owned(),
            Self::NotUndone { .. } => "A reset sets everything up anew, whatever was done before: else no task begins as it is \
                                       written, and --restart goes on from where it was."
                .to_owned(),
            Self::NothingIgnored { .. } => "Is it spelt as the states spell it?".to_owned(),
            Self::LeftOut(left_out) => left_out.hint(),
            Self::DoubtfulParent(parent) => parent.hint(),
            Self::DiffersInCase { .. } => {
                "Spell it alike everywhere: names that differ in case only are refused in a model.".to_owned()
            }
            Self::MixedRelation(mixed) => mixed.hint(),
            Self::ListOfOne { relation, .. } => format!(
                "If there is at most one, write an id or null: only null gives an atom, `{relation}_None`, that an action \
                 can need."
            ),
            Self::MixedAttribute { .. } => "Keep to one kind: a word, or true or false, or a number.".to_owned(),
            Self::FewNumbers { .. } => "If an action needs or changes it, make it a word, or true or false.".to_owned(),
            Self::ManyWords { .. } => "Each word is a predicate of its own, and what is learned with one says nothing about \
                                       another. Use few words, a number, or a relation."
                .to_owned(),
            Self::NumberAsWord { .. } => {
                "Without the quotation marks it is a number, which gives no atom; with them each value is a predicate of \
                 its own."
                    .to_owned()
            }
        }
    }
}

fn listed(names: &BTreeSet<Symbol>) -> String {
    match names.len() {
        0 => "entities".to_owned(),
        _ => names.iter().map(Symbol::as_str).collect::<Vec<_>>().join(", "),
    }
}

fn of(entity: Option<&Symbol>) -> String {
    entity.map(|entity| format!(" of {entity}")).unwrap_or_default()
}
