//! Two memories, or more, as one: what each of them says, once.
//!
//! Each log keeps its order. Between them entries go by the times at which they were written, where clocks agree, and nothing
//! that is learned depends on that. What is in several of them, as in copies of one file that went on apart, is there once: an
//! entry with all that it says and when it was written, and an episode with all of its entries, or with those up to where one
//! copy of it ends.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use typelift_model::{LearnedModel, Symbol};

use crate::copying::{Numbers, renumbered, write};
use crate::error::{MemoryError, MemoryErrorKind};
use crate::format::{self, Access};
use crate::log::{Entry, Kind, Wanted, list};
use crate::memory::difference_between;

/// What became of entries of several logs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Merged {
    /// Entries of the new log.
    pub entries: usize,
    /// Entries that more than one log had.
    pub shared: usize,
}

/// A memory that is merged.
struct Part<'f> {
    file: &'f Path,
    basis: LearnedModel,
    entries: Vec<Entry>,
}

/// Makes a new memory of several, which stay as they are. In time and memory of all of them.
///
/// # Errors
/// [`MemoryError`] if one of them cannot be read, if they are not of one hierarchy and one way of reading scenes, with the
/// first difference, or if there is a file already.
pub fn merge(files: &[&Path], into: &Path) -> Result<Merged, MemoryError> {
    let parts = files.iter().map(|file| Part::read(file).map_err(|kind| kind.of(file)));
    let parts = parts.collect::<Result<Vec<_>, _>>()?;
    let basis = common_basis(&parts)?;
    let write_all = || {
        let mut shared = 0;
        let mut all = Vec::new();
        for Part { entries, .. } in parts {
            all = merged(&all, entries, &mut shared)?;
        }
        format::create_filled(into, &basis.to_json()?, |to| all.iter().try_for_each(|entry| write(to, entry)))?;
        Ok(Merged { entries: all.len(), shared })
    };
    write_all().map_err(|kind: MemoryErrorKind| kind.of(into))
}

impl<'f> Part<'f> {
    fn read(file: &'f Path) -> Result<Self, MemoryErrorKind> {
        let connection = format::open(file, Access::Read)?;
        let view = connection.unchecked_transaction()?;
        let basis = LearnedModel::from_json(&format::basis(&view)?)?;
        Ok(Self { file, basis, entries: list(&view, Wanted::All)? })
    }
}

/// How all of them read scenes, with every constant and predicate that one of them declares: whichever comes first.
fn common_basis(parts: &[Part<'_>]) -> Result<LearnedModel, MemoryError> {
    let text = |part: &&Part<'_>| part.basis.to_json().unwrap_or_default();
    let Some(first) = parts.iter().min_by_key(text) else { return Ok(LearnedModel::default()) };
    let mut basis = first.basis.clone();
    for Part { file, basis: other, .. } in parts {
        let disagrees = |difference: String| {
            let model = file.display().to_string();
            MemoryErrorKind::Disagrees { model, difference }.of(first.file)
        };
        let (one, two) = (first.file.display().to_string(), file.display().to_string());
        if let Some(difference) = difference_between(&basis, other, [&one, &two]) {
            return Err(disagrees(difference));
        }
        // Since the hierarchies agree, each has every type.
        let own = |name: &Symbol| basis.model.hierarchy.id(name.as_str());
        let name = |ty| other.model.hierarchy.name(ty);
        let constants: Vec<_> =
            other.model.constants.iter().filter_map(|(constant, ty)| Some((constant, own(name(*ty))?))).collect();
        let typed = |(predicate, types): (&Symbol, &Vec<_>)| {
            let types = types.iter().map(|ty| own(name(*ty))).collect::<Option<Vec<_>>>()?;
            Some((predicate.clone(), types))
        };
        let predicates: Vec<_> = other.declared_predicates.iter().filter_map(typed).collect();
        for (constant, ty) in constants {
            if *basis.model.constants.entry(constant.clone()).or_insert(ty) != ty {
                return Err(disagrees(format!("the constant `{constant}` is of another type")));
            }
        }
        let mut declared = basis.declared_predicates.clone();
        for (predicate, types) in predicates {
            if *declared.entry(predicate.clone()).or_insert_with(|| types.clone()) != types {
                return Err(disagrees(format!("the predicate `{predicate}` is declared with other types")));
            }
        }
        basis.declare(declared);
        basis.domain = [basis.domain.take(), other.domain.clone()].into_iter().flatten().min();
    }
    Ok(basis)
}

/// The entries of a log that another one does not have.
struct Own {
    entries: Vec<Entry>,
    /// Of each of its others the number in the other log.
    same: Numbers,
}

/// The entries of two logs as one log.
fn merged(one: &[Entry], other: Vec<Entry>, shared: &mut usize) -> Result<Vec<Entry>, MemoryErrorKind> {
    let own = own(one, other);
    *shared += own.same.len();
    let (mut of_one, mut of_other) = (Numbers::new(), Numbers::new());
    let order = in_turn(one, &own);
    for (next, (entry, is_of_one)) in (1..).zip(&order) {
        let numbers = if *is_of_one { &mut of_one } else { &mut of_other };
        numbers.insert(entry.number, next);
    }
    of_other.extend(own.same.iter().map(|(number, twin)| (*number, of_one[twin])));
    let mut all = Vec::new();
    let mut told = BTreeSet::new();
    for (entry, is_of_one) in order {
        let Some(entry) = renumbered(entry, if is_of_one { &of_one } else { &of_other })? else { continue };
        // That the same was taken back in both is one entry.
        if entry.kind != Kind::Forgotten || told.insert((entry.written.clone(), entry.content.clone())) {
            all.push(entry);
        }
    }
    Ok(all)
}

/// What a log has that the first does not. An episode that goes on where the first one's copy of it ends is there from then.
fn own(first: &[Entry], log: Vec<Entry>) -> Own {
    let known = units(first.iter().cloned());
    let mut own = Own { entries: Vec::new(), same: Numbers::new() };
    let mut taken = BTreeSet::new();
    for mut unit in units(log.into_iter()) {
        let is_twin = |(at, other): &(usize, &Vec<Entry>)| !taken.contains(at) && are_same(other, &unit);
        if let Some((at, twin)) = known.iter().enumerate().find(is_twin) {
            taken.insert(at);
            own.same.extend(unit.iter().zip(twin).map(|(entry, other)| (entry.number, other.number)));
            unit.drain(..twin.len().min(unit.len()));
        }
        own.entries.append(&mut unit);
    }
    own.entries.sort_by_key(|entry| entry.number);
    own
}

/// The entries of each episode together, and each other one alone.
fn units(entries: impl Iterator<Item = Entry>) -> Vec<Vec<Entry>> {
    let mut units: BTreeMap<i64, Vec<Entry>> = BTreeMap::new();
    for entry in entries {
        units.entry(entry.episode.unwrap_or(entry.number)).or_default().push(entry);
    }
    units.into_values().collect()
}

/// Whether they say the same, as far as the shorter one goes.
fn are_same(one: &[Entry], other: &[Entry]) -> bool {
    one.iter().zip(other).all(|(a, b)| a.kind == b.kind && a.written == b.written && a.content == b.content)
}

/// The entries of both, each with whether it is of the first: of the two that are next the one that was written first.
fn in_turn<'e>(first: &'e [Entry], own: &'e Own) -> Vec<(&'e Entry, bool)> {
    let (mut ones, mut others) = (first.iter().peekable(), own.entries.iter().peekable());
    let mut order = Vec::new();
    // What came before it in its own log comes before it here.
    let (mut same, mut before) = (own.same.iter().peekable(), 0);
    loop {
        let first_is_next = match (ones.peek(), others.peek()) {
            (None, None) => return order,
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (Some(one), Some(other)) => {
                while let Some((_, twin)) = same.next_if(|(number, _)| **number < other.number) {
                    before = before.max(*twin);
                }
                one.number <= before || (&one.written, &one.content) <= (&other.written, &other.content)
            }
        };
        let next = if first_is_next { ones.next() } else { others.next() };
        order.extend(next.map(|entry| (entry, first_is_next)));
    }
}
