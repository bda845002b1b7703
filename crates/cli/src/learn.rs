//! `typelift learn`.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use typelift::learn::{self, Options, evidence_of, learn_evidence};
use typelift::model::{Evidence, LearnedModel, SourceId, Symbol, Unexplained, did_you_mean, name_with_arity};
use typelift::words::{TypeNote, count, dropped_by_merging, missing_actor, unbounded_parameters};
use typelift::world::{
    Dataset, FileError, LeftOut, MixedRelation, ObjectTypes, Parser, Repeated, TrajectoryContext, Unlisted,
    demonstrations_at, read_any_trace, write_file,
};
use typelift_memory::{Access, Memory, MemoryError, MemoryErrorKind};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::warn;
use crate::learn_actor;
use crate::learn_changes::{Changes, Flickering, colliding, flickering, without_effect};
use crate::learn_into::{self, add, beginning, forget};
use crate::learn_report::{Report, print_counts};
use crate::limits::{Clock, Limits};
use crate::overwriting::{Output, keep_inputs};
use crate::style::{HEAD, HINT, WARNING};
use crate::waiting::Waiting;
use crate::watchdog::within_shown;

/// What takes its time, as it is said on a terminal.
const LEARNING: &str = "learning";

/// Learn actions from demonstrations
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift learn demos/*.jsonl --types types.pddl -o model.json
  typelift learn demos --types types.pddl --ignore battery,robot.pose --dry-run
  typelift learn *.trajectory --types domain.pddl --problems P -o model.json
  typelift learn --into model.json more/*.jsonl
  typelift learn --into model.json --forget wrong.jsonl
  typelift learn more/*.jsonl --memory robot.memory

A trace is one demonstration: JSON Lines (trace/1), or a PDDL trajectory. Of a
folder, every file that ends in .jsonl, .trajectory or _traj is read.")]
pub(crate) struct Learn {
    /// Traces, trajectories, or folders of them
    #[arg(required_unless_present = "into", value_name = "TRACE")]
    traces: Vec<PathBuf>,
    /// The type hierarchy: PDDL (:types …), a PDDL domain, whose name and constants are taken too, or JSON {"child": "parent"}
    #[arg(long, value_name = "FILE")]
    types: Option<PathBuf>,
    /// Add to this model, as if all had been learned at once; its types and what it ignores hold
    #[arg(long, value_name = "MODEL", conflicts_with = "memory")]
    into: Option<PathBuf>,
    /// Add to this memory, in the same way; it is made if it is not there
    #[arg(long, value_name = "FILE", requires = "traces")]
    memory: Option<PathBuf>,
    /// Take a trace out of the model again: a file, its name, or the first digits of its id
    #[arg(long, value_name = "SOURCE", requires = "into")]
    forget: Vec<String>,
    /// Keep totals and the names of the traces only: nothing can be taken out any more
    #[arg(long, conflicts_with = "memory")]
    compact: bool,
    /// Where trajectories find the types of their objects: a folder of PDDL problems
    #[arg(long, value_name = "DIR", conflicts_with = "objects")]
    problems: Option<PathBuf>,
    /// Where trajectories find the types of their objects: JSON {"object": "type"}, or a PDDL (:objects …)
    #[arg(long, value_name = "FILE")]
    objects: Option<PathBuf>,
    /// In trajectories, what is not listed is false
    #[arg(long, conflicts_with = "open")]
    closed: bool,
    /// In trajectories, what is listed neither as true nor as false is unknown [default: if any state lists a (not …)]
    #[arg(long)]
    open: bool,
    /// Attributes and relations that give no atoms: NAME, or TYPE.NAME
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    ignore: Vec<String>,
    /// The type of the actor, `none` if there is none [default: what argument 0 of every action has in common]
    #[arg(long, value_name = "TYPE")]
    actor: Option<String>,
    /// Do not generalize: individual actions only
    #[arg(long)]
    individual: bool,
    /// Only list types, predicates and their support, and write nothing
    #[arg(long)]
    dry_run: bool,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    /// Write the model to this file [default: that of --into]
    #[arg(long, short, value_name = "MODEL", required_unless_present_any = ["dry_run", "into", "memory"])]
    output: Option<PathBuf>,
    #[command(flatten)]
    limits: Limits,
}

/// What was read, and what was learned from it.
struct Learned {
    dataset: Dataset,
    /// What its traces show.
    shown: Evidence,
    /// What is probably not meant in the types.
    type_warnings: Vec<FileError>,
    /// The traces that the model had already.
    known: Vec<SourceId>,
    model: LearnedModel,
    report: learn::Report,
    /// What follows from where types meet, and may not be meant.
    notes: Vec<TypeNote>,
    /// What changes in the traces.
    changes: Changes,
}

impl Learn {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let is_begun = self.into.is_some() || self.memory.as_ref().is_some_and(|memory| memory.exists());
        if self.types.is_none() && !is_begun {
            let hint = match &self.memory {
                Some(memory) => format!("There is no {} yet; once it is there, its types hold.", memory.display()),
                None => "Or say which model to add to, with --into MODEL: then its types hold.".to_owned(),
            };
            return Err(Failure::new(Exit::Usage, "no types: say --types FILE").with_hint(hint));
        }
        let output = self.output.as_ref().or(self.into.as_ref()).filter(|_| !self.dry_run);
        let memory = self.memory.as_ref().filter(|_| !self.dry_run);
        keep_inputs(output.into_iter().chain(memory).map(|path| Output::File(path)), self.inputs())?;
        keep_inputs(output.map(|path| Output::File(path)), &self.memory)?;
        let waiting = Waiting::new(quiet);
        let learn = || waiting.during(LEARNING, || self.learn(&waiting));
        let learned = within_shown(clock, self.limits, &waiting, learn)?;
        let Learned { model, report, notes, .. } = &learned;
        // First, so that the model is written even if standard output is closed.
        let text = model.to_json().map_err(|error| colliding(error, &learned.dataset))?;
        let added = memory.map(|memory| self.remember(memory, &learned)).transpose()?;
        let stays = self.output.is_none() && output.is_some_and(|path| is_written(path, &text));
        if let Some(path) = output.filter(|_| !stays) {
            write_file(path, text.as_bytes())?;
        }
        let mut out = anstream::stdout().lock();
        if self.json {
            writeln!(out, "{}", serde_json::to_string_pretty(&Report::of(model, report, notes)).unwrap_or_default())?;
        } else if self.dry_run {
            self.describe(&mut out, &learned)?;
        } else {
            print_counts(&mut out, model, report, notes)?;
        }
        out.flush()?;
        if !quiet {
            match output {
                Some(path) if stays => anstream::eprintln!("{} stays as it is: there is nothing new", path.display()),
                Some(path) => anstream::eprintln!("wrote {}", path.display()),
                None => {}
            }
            if let (Some(added), Some(memory)) = (added, memory) {
                anstream::eprintln!("added {} to {}", count(added as u64, "demonstration"), memory.display());
            }
            self.warn(&learned);
        }
        Ok(Exit::Success)
    }

    /// The files that are read, but for the model that is added to. What a folder does not tell now, it will not tell when
    /// it is read, and the error is told there.
    fn inputs(&self) -> Vec<PathBuf> {
        let traces = self.traces.iter().flat_map(|path| demonstrations_at(path).unwrap_or_default());
        let problems = self.problems.iter().flat_map(|folder| ObjectTypes::problems_at(folder).unwrap_or_default());
        let forgotten = self.forget.iter().map(PathBuf::from);
        traces.chain(problems).chain(forgotten).chain(self.types.clone()).chain(self.objects.clone()).collect()
    }

    /// The model that is added to.
    fn added_to(&self) -> Result<Option<LearnedModel>, Failure> {
        match (&self.into, &self.memory) {
            (Some(path), _) => learn_into::model_at(path).map(Some),
            (None, Some(memory)) => match Memory::open(memory, Access::Read) {
                Err(MemoryError { kind: MemoryErrorKind::Missing, .. }) => Ok(None),
                opened => Ok(Some(opened?.learned().clone())),
            },
            (None, None) => Ok(None),
        }
    }

    /// Adds what was shown to a memory: how many demonstrations it did not have.
    fn remember(&self, file: &Path, learned: &Learned) -> Result<usize, Failure> {
        let mut memory = Memory::open_or_create(file, &learned.model)?;
        let shown = LearnedModel { evidence: learned.shown.clone(), ..learned.model.clone() };
        let named = self.traces.first().map(|path| path.display().to_string()).unwrap_or_default();
        let more = if self.traces.len() > 1 { format!(" and {} more", self.traces.len() - 1) } else { String::new() };
        Ok(memory.add_demonstrations(&shown, &format!("{named}{more}"))?)
    }

    /// Reads the traces, and learns from them.
    fn learn(&self, waiting: &Waiting) -> Result<Learned, Failure> {
        let ignore = self.ignore.iter().filter(|name| !name.is_empty()).map(|name| Symbol::new(name)).collect();
        let mut types = match (&self.problems, &self.objects) {
            (Some(folder), _) => ObjectTypes::from_problems(folder)?,
            (None, Some(file)) => ObjectTypes::from_file(file)?,
            (None, None) => ObjectTypes::default(),
        };
        let unlisted = match (self.closed, self.open) {
            (true, _) => Unlisted::False,
            (_, true) => Unlisted::Unknown,
            _ => Unlisted::AsListed,
        };
        let (begun, type_warnings) = beginning(self.added_to()?, self.types.as_ref(), ignore)?;
        let LearnedModel { model, domain, declared_predicates, parse, options, mut evidence, .. } = begun;
        types.add_constants(model.constants.iter().map(|(name, ty)| (name, model.hierarchy.name(*ty))));
        let context = TrajectoryContext { types, unlisted };
        let constants = model.constants;
        let actor_before = model.actor.map(|ty| model.hierarchy.name(ty).clone());
        let dataset = match self.traces.as_slice() {
            [] => Dataset { hierarchy: model.hierarchy, parse, ..Dataset::default() },
            traces => read_traces(traces, Parser::new(model.hierarchy, parse), &context, waiting)?,
        };
        if let Some(into) = &self.into {
            forget(&mut evidence, into, &self.forget)?;
        }
        let shown = evidence_of(&dataset);
        let known = add(&mut evidence, self.into.as_ref().or(self.memory.as_ref()), &shown)?;
        if self.compact {
            evidence.compact();
        }
        let actor = learn_actor::declared(self.actor.as_deref());
        let now = Options { individual: self.individual, actor: actor.clone() };
        let options = learn_into::options(&options, now);
        let learned = learn_evidence(&dataset.hierarchy, &dataset.parse, evidence, &options);
        let (mut model, report) = learned.map_err(|error| {
            let types: Vec<Symbol> = dataset.hierarchy.types().map(|t| dataset.hierarchy.name(t).clone()).collect();
            learn_actor::unknown(&error, &types)
        })?;
        // Who acts may be missing because of what was left out; where all goes well, that is said with the other warnings.
        learn_actor::refuse_absent(actor.as_ref(), &model.model, &model.evidence.total())
            .inspect_err(|_| warn_of_left_out(&dataset.left_out))?;
        (model.domain, model.model.constants) = (domain, constants);
        model.declare(declared_predicates);
        let missing_actor = report.no_actor.as_ref().and_then(|why| missing_actor(why, actor_before.as_ref()));
        let dropped = dropped_by_merging(&model.model, &model.evidence.total());
        let notes = missing_actor.into_iter().chain(unbounded_parameters(&model.model)).chain(dropped).collect();
        let changes = Changes::of(&dataset, &model.parse.by_arity);
        Ok(Learned { dataset, shown, type_warnings, known, model, report, notes, changes })
    }

    /// `--dry-run`: what would be learned from.
    fn describe(&self, out: &mut impl Write, learned: &Learned) -> Result<(), Failure> {
        let Learned { dataset, model, report, notes, changes, .. } = learned;
        let mut types: BTreeMap<&Symbol, usize> = BTreeMap::new();
        for trace in &dataset.traces {
            for ty in trace.states.first().into_iter().flat_map(|state| state.objects.values()) {
                *types.entry(dataset.hierarchy.name(*ty)).or_default() += 1;
            }
        }
        writeln!(out, "{HEAD}types{HEAD:#} (entities, over all traces)")?;
        for (name, entities) in types {
            writeln!(out, "  {name:<24} {entities:>6}")?;
        }
        let transitions = changes.transitions;
        writeln!(
            out,
            "{HEAD}predicates{HEAD:#} (of {transitions} transitions: in how many one changed, one held before)"
        )?;
        for (predicate, types) in &model.model.predicates {
            let (changed, held) = changes.changed_and_held(predicate);
            let note = if changed == transitions { "  changes every time" } else { "" };
            writeln!(out, "  {:<24} {changed:>6} {held:>6}{note}", name_with_arity(predicate, types.len()).as_str())?;
        }
        let ignored: Vec<&str> = dataset.parse.ignore.iter().map(Symbol::as_str).collect();
        let ignored = if ignored.is_empty() { "nothing".to_owned() } else { ignored.join(", ") };
        writeln!(out, "{HEAD}ignored{HEAD:#} {ignored}")?;
        writeln!(out, "{HEAD}support{HEAD:#} (transitions of each individual action)")?;
        for (key, cluster) in &model.evidence.total().clusters {
            let types: Vec<&str> = key.types.iter().map(Symbol::as_str).collect();
            writeln!(out, "  {:<66} {:>6}", format!("{}({})", key.action, types.join(", ")), cluster.count)?;
        }
        print_counts(out, model, report, notes)
    }

    /// Warns of what is probably not meant in the files, of names to ignore that were never met, and of attributes that
    /// seem to flicker: most actions rest on a single observation, and there would be fewer without some predicate.
    fn warn(&self, learned: &Learned) {
        let Learned { dataset, type_warnings, known, model, report, .. } = learned;
        warn(type_warnings.iter());
        for Repeated { file, first, source } in &dataset.repeated {
            let source = source.short();
            anstream::eprintln!(
                "{WARNING}warning{WARNING:#}: {file} is the same trace as {first} ({source}); it counts once"
            );
        }
        let place = if self.memory.is_some() { "memory" } else { "model" };
        for id in known {
            let (name, id) = (model.evidence.sources().get(id).map_or("", |source| source.name.as_str()), id.short());
            anstream::eprintln!("{WARNING}warning{WARNING:#}: {name} ({id}) is in the {place} already; it counts once");
        }
        warn(dataset.traces.iter().flat_map(|trace| &trace.warnings));
        warn_of_left_out(&dataset.left_out);
        warn_of_mixed(&dataset.mixed);
        let actor = learn_actor::declared(self.actor.as_deref());
        learn_actor::warn_of_acted_on(actor.as_ref(), &model.model, &model.evidence.total());
        let unexplained = &model.evidence.total().unexplained;
        let hidden = [Unexplained::PartlyObserved, Unexplained::UnlistedKinds];
        if dataset.has_open_states() && hidden.iter().any(|reason| unexplained.contains_key(reason)) {
            anstream::eprintln!(
                "{HINT}hint{HINT:#}: in a trajectory that lists a (not …), what is listed neither way is unknown; --closed takes it for false"
            );
        }
        for rule in &dataset.unmatched_ignores {
            anstream::eprintln!("{WARNING}warning{WARNING:#}: --ignore {rule}: there is no such attribute or relation");
            // A rule may name a type before the attribute.
            let name = rule.as_str().rsplit_once('.').map_or(rule.as_str(), |(_, name)| name);
            let question = did_you_mean(name, dataset.attributes.values());
            if let Some(question) = question.filter(|_| !dataset.attributes.contains_key(rule)) {
                anstream::eprintln!("{HINT}hint{HINT:#}: {question}");
            }
            if let Some(source) = dataset.attributes.get(rule) {
                anstream::eprintln!("{HINT}hint{HINT:#}: {rule} is a predicate; it comes from {source}");
            }
        }
        if !self.ignore.is_empty() {
            for call in without_effect(&model.evidence.total()) {
                anstream::eprintln!(
                    "{WARNING}warning{WARNING:#}: no action is learned of {call}: it changed nothing but what is ignored, or nothing at all"
                );
            }
        }
        // Of the notes only that of the actor is about no parameter.
        if learned.notes.iter().any(|note| note.parameter.is_none()) {
            learn_actor::hint(report.no_actor.as_ref());
        }
        if report.individual == 0 {
            let why = match report.transitions {
                0 => "there is no action in these traces",
                _ => "no action in these traces changed anything that can be learned",
            };
            anstream::eprintln!("{WARNING}warning{WARNING:#}: nothing was learned: {why}");
        }
        let every_time = learned.changes.every_time();
        for predicate in &every_time {
            let source = dataset.attributes.get(*predicate).unwrap_or(predicate);
            anstream::eprintln!("{WARNING}warning{WARNING:#}: {predicate} changes every time, whatever the action");
            anstream::eprintln!(
                "{HINT}hint{HINT:#}: it makes one action look like several; if no action needs it, --ignore {source}"
            );
        }
        let (single, actions) = (report.single_support, report.generalized);
        let source = |predicate| dataset.attributes.get(predicate).unwrap_or(predicate);
        let total = model.evidence.total();
        let Some(Flickering { name, fewer, all, is_needed }) = flickering(&total, source) else { return };
        let is_told = every_time.into_iter().any(|predicate| *source(predicate) == name);
        if self.individual || single * 2 <= actions || is_told {
            return;
        }
        anstream::eprintln!(
            "{WARNING}warning{WARNING:#}: {single} of {actions} actions rest on a single observation, so little was generalized"
        );
        if is_needed {
            anstream::eprintln!(
                "{HINT}hint{HINT:#}: most is kept apart by `{name}`, which is all that some action changes: more demonstrations help, or saying it in fewer words"
            );
        } else {
            anstream::eprintln!(
                "{HINT}hint{HINT:#}: what changes by itself keeps alike actions apart; without `{name}` there would be {fewer} kinds of effect instead of {all}: if it flickers, give it hysteresis; if it does not matter, --ignore {name}"
            );
        }
    }
}

/// Reads the demonstrations, and says at which it is.
fn read_traces(
    paths: &[PathBuf],
    mut parser: Parser,
    context: &TrajectoryContext,
    waiting: &Waiting,
) -> Result<Dataset, FileError> {
    let files: Vec<Vec<PathBuf>> = paths.iter().map(|path| demonstrations_at(path)).collect::<Result<_, _>>()?;
    let files = files.concat();
    let read = |(file, number): (&PathBuf, usize)| {
        waiting.is_at(&format!("reading trace {number} of {}", files.len()));
        read_any_trace(file, context, &mut parser)
    };
    let traces = files.iter().zip(1..).map(read).collect::<Result<_, _>>()?;
    waiting.is_at(LEARNING);
    Ok(Dataset::new(&parser, traces))
}

/// Warns of attributes and relations that entities have at times only: the first of them, and how many there are.
fn warn_of_left_out(left_out: &[LeftOut]) {
    if let Some((first, others)) = left_out.split_first() {
        let more = if others.is_empty() { String::new() } else { format!("; {} more like it", others.len()) };
        anstream::eprintln!("{WARNING}warning{WARNING:#}: {first}{more}");
        anstream::eprintln!("{HINT}hint{HINT:#}: {}", first.hint());
    }
}

/// Warns of relations that are lists at times only.
fn warn_of_mixed(mixed: &[MixedRelation]) {
    if let Some((first, others)) = mixed.split_first() {
        let more = if others.is_empty() { String::new() } else { format!("; {} more like it", others.len()) };
        anstream::eprintln!("{WARNING}warning{WARNING:#}: {first}{more}");
        anstream::eprintln!("{HINT}hint{HINT:#}: {}", first.hint());
    }
}

/// Whether a file has this content already.
fn is_written(path: &Path, text: &str) -> bool {
    std::fs::read(path).is_ok_and(|written| written == text.as_bytes())
}
