//! What `learn` begins with: nothing but types, or a model that demonstrations are added to or taken out of.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use typelift::learn::Options;
use typelift::model::{
    ArgumentTypes, Evidence, Hierarchy, LearnedModel, MergeError, ParseConfig, SourceId, Symbol, TypeId,
};
use typelift::world::{FileError, read_types, source_of_file};
use typelift_memory::looks_like_memory;

use crate::failure::Failure;
use crate::files::{ModelInput, read_model_input};

/// Digits that tell a source.
const FEWEST_DIGITS: usize = 4;

/// What the file given as `--types` declares.
struct Given<'p> {
    path: &'p Path,
    hierarchy: Hierarchy,
    domain: Option<Symbol>,
    constants: BTreeMap<Symbol, TypeId>,
    predicates: ArgumentTypes,
    /// What is probably not meant in it.
    warnings: Vec<FileError>,
}

impl<'p> Given<'p> {
    fn read(path: &'p Path) -> Result<Self, FileError> {
        let file = read_types(path)?;
        let hierarchy = file.extend(&Hierarchy::default())?;
        let constants = file.constants(&hierarchy)?;
        let predicates = file.predicates(&hierarchy)?;
        Ok(Self { path, domain: file.domain().cloned(), hierarchy, constants, predicates, warnings: file.warnings() })
    }
}

/// A model without anything that it was learned from, or the one that is added to; and what to warn of in the types.
pub(crate) fn beginning(
    added_to: Option<LearnedModel>,
    types: Option<&PathBuf>,
    ignore: BTreeSet<Symbol>,
) -> Result<(LearnedModel, Vec<FileError>), Failure> {
    let mut types = types.map(|path| Given::read(path)).transpose()?;
    let warnings = types.as_mut().map(|given| std::mem::take(&mut given.warnings)).unwrap_or_default();
    let Some(mut learned) = added_to else {
        let mut none =
            LearnedModel { parse: ParseConfig { ignore, ..ParseConfig::default() }, ..LearnedModel::default() };
        if let Some(Given { hierarchy, domain, constants, predicates, .. }) = types {
            (none.model.hierarchy, none.domain, none.model.constants) = (hierarchy, domain, constants);
            none.declared_predicates = predicates;
        }
        return Ok((none, warnings));
    };
    if let Some(Given { path: given, hierarchy, domain, constants, predicates, .. }) = types {
        let agreed = learned.agrees(&hierarchy, &learned.parse);
        agreed.map_err(|error| {
            let hint = "Leave out --types: those of the model hold. Or learn from all traces anew.";
            Failure::bad_input(format!("--types {}: {error}", given.display())).with_hint(hint)
        })?;
        // Since the hierarchies agree, the model has each of these types.
        let own = |ty: TypeId| learned.model.hierarchy.id(hierarchy.name(ty).as_str());
        let constants: Vec<_> = constants.into_iter().filter_map(|(name, ty)| Some((name, own(ty)?))).collect();
        let typed = |(name, types): (Symbol, Vec<TypeId>)| {
            Some((name, types.into_iter().map(own).collect::<Option<Vec<_>>>()?))
        };
        let predicates: Vec<_> = predicates.into_iter().filter_map(typed).collect();
        for (name, ty) in constants {
            learned.model.constants.entry(name).or_insert(ty);
        }
        for (name, types) in predicates {
            learned.declared_predicates.entry(name).or_insert(types);
        }
        learned.domain = learned.domain.take().or(domain);
    }
    if !ignore.is_empty() {
        let agreed = learned.agrees(&learned.model.hierarchy, &ParseConfig { ignore, ..ParseConfig::default() });
        agreed.map_err(|error| {
            let hint = "Leave out --ignore: what the model ignores is ignored. Or learn from all traces anew.";
            Failure::bad_input(format!("--ignore: {error}")).with_hint(hint)
        })?;
    }
    Ok((learned, warnings))
}

/// The learned model of a file.
pub(crate) fn model_at(path: &Path) -> Result<LearnedModel, Failure> {
    if looks_like_memory(path) {
        let failure = Failure::bad_input(format!("{}: this is a memory, not a model", path.display()));
        return Err(failure.with_hint("--memory FILE adds to a memory; `typelift memory forget` takes things back."));
    }
    match read_model_input(path, None, true)? {
        ModelInput::Learned(learned) => Ok(*learned),
        ModelInput::Given(_) => {
            Err(Failure::bad_input(format!("{}: this is a PDDL domain, not a learned model", path.display())))
        }
    }
}

/// What learning is asked for: as before, but for what is said now.
pub(crate) fn options(before: &Options, now: Options) -> Options {
    Options { individual: before.individual || now.individual, actor: now.actor.or_else(|| before.actor.clone()) }
}

/// Sources that are named in a hint.
const MOST_SOURCES: usize = 10;

/// Takes sources out: each by a file with its content, by its name, or by the first digits of its id.
pub(crate) fn forget(evidence: &mut Evidence, into: &Path, sources: &[String]) -> Result<(), Failure> {
    for text in sources {
        if evidence.sources().is_empty() && evidence.is_compact() {
            let error = format!("--forget {text}: {} does not say what it was learned from", into.display());
            return Err(Failure::bad_input(error).with_hint("Learn it anew from its traces."));
        }
        let id = source_called(evidence, text, "--forget ")?;
        evidence.take_out(id).map_err(|error| {
            let hint = "Learn it anew from its traces, without `--compact`.";
            Failure::bad_input(format!("--forget {text}: {}: {error}", into.display())).with_hint(hint)
        })?;
    }
    Ok(())
}

/// The source that a person means: by a file with its content, its name, or the first digits of its id. `option` stands before
/// the text where it is not understood.
pub(crate) fn source_called(evidence: &Evidence, text: &str, option: &str) -> Result<SourceId, Failure> {
    let path = Path::new(text);
    if path.is_file() {
        let id = source_of_file(path)?;
        if evidence.sources().contains_key(&id) {
            return Ok(id);
        }
    }
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let digits = text.to_ascii_lowercase();
    let called = |(id, is_called): (&SourceId, &Symbol)| {
        *is_called == *name || digits.len() >= FEWEST_DIGITS && id.to_string().starts_with(&digits)
    };
    let known = evidence.sources().iter().map(|(id, source)| (id, &source.name));
    let found: Vec<(&SourceId, &Symbol)> = known.clone().filter(|source| called(*source)).collect();
    let listed = |sources: &mut dyn Iterator<Item = (&SourceId, &Symbol)>| {
        let first: Vec<String> =
            sources.take(MOST_SOURCES).map(|(id, name)| format!("{name} ({})", id.short())).collect();
        match sources.count() {
            0 => first.join(", "),
            more => format!("{} and {more} more", first.join(", ")),
        }
    };
    match found.as_slice() {
        [(id, _)] => Ok(**id),
        [] => Err(Failure::bad_input(format!("{option}{text}: nothing was learned from it"))
            .with_hint(format!("It was learned from {}.", listed(&mut known.clone())))),
        several => Err(Failure::bad_input(format!("{option}{text}: this may be any of several"))
            .with_hint(format!("Say which by its id: {}.", listed(&mut several.iter().copied())))),
    }
}

/// Adds what demonstrations show. Gives the sources that were there already.
pub(crate) fn add(evidence: &mut Evidence, into: Option<&PathBuf>, shown: &Evidence) -> Result<Vec<SourceId>, Failure> {
    evidence.merge(shown).map_err(|error| {
        let hint = match &error {
            MergeError::Shared(_) => "Leave them out, or learn anew without `--compact`.",
            MergeError::ReadDifferently { .. } => {
                "Give the same --problems, --objects, --closed or --open, or take it out with --forget first."
            }
            MergeError::UnknownSources => "Learn it anew from its traces.",
        };
        let place = into.map(|path| format!("{}: ", path.display())).unwrap_or_default();
        Failure::bad_input(format!("{place}{error}")).with_hint(hint)
    })
}
