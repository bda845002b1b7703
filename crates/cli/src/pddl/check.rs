//! `typelift pddl check`.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use typelift::model::Symbol;
use typelift::pddl::{
    Definition, DefinitionKind, Document, Domain, PddlError, Problem, Sexpr, Trajectory, compile_domain,
    compile_problem, misfits, read_plan, read_problem, read_trajectory, required_by_domain, required_by_problem,
    undeclared_requirements,
};
use typelift::words::count;
use typelift::world::FileError;

use super::domains::Domains;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::warn_of_misfits;
use crate::style::{BAD, WARNING};

/// What a file is, as far as its beginning tells.
#[derive(Debug, Clone)]
enum Kind {
    Domain,
    /// With the name of the domain, if it is there.
    Problem(Option<String>),
    Trajectory,
    /// By its ending.
    Plan,
}

/// What is right about a file.
#[derive(Debug, Serialize)]
struct Content {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<Symbol>,
    /// How many of what, in the order in which they are told.
    #[serde(serialize_with = "as_object")]
    counts: Vec<(&'static str, u64)>,
    /// Requirements that are used but not declared.
    undeclared: Vec<&'static str>,
    /// Atoms over objects of other types than their predicates declare.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    misfits: Vec<String>,
}

/// What is printed of a file with `--json`.
#[derive(Debug, Serialize)]
struct Report {
    file: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<&'static str>,
    #[serde(flatten)]
    content: Option<Content>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Problematic>,
}

#[derive(Debug, Serialize)]
struct Problematic {
    message: String,
    line: Option<u32>,
    column: Option<u32>,
    hint: Option<String>,
    unsupported: bool,
}

impl Kind {
    fn name(&self) -> &'static str {
        match self {
            Self::Domain => DefinitionKind::Domain.name(),
            Self::Problem(_) => DefinitionKind::Problem.name(),
            Self::Trajectory => "trajectory",
            Self::Plan => "plan",
        }
    }
}

/// `{"actions": 4, "initial_atoms": 0}`.
fn as_object<S: serde::Serializer>(counts: &[(&'static str, u64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(counts.iter().map(|(what, n)| (format!("{}s", what.replace(' ', "_")), n)))
}

pub(super) fn check(files: &[PathBuf], json: bool, quiet: bool) -> Result<Exit, Failure> {
    let mut domains = Domains::default();
    let kinds: Vec<Result<Kind, FileError>> = files.iter().map(|file| kind_of(file, &mut domains)).collect();
    let mut out = anstream::stdout().lock();
    let (mut wrong, mut unsupported) = (false, false);
    for (file, kind) in files.iter().zip(kinds) {
        let name = kind.as_ref().ok().map(Kind::name);
        let content = kind.and_then(|kind| content_of(file, kind, &mut domains));
        if let Err(error) = &content {
            wrong |= !error.unsupported;
            unsupported |= error.unsupported;
        }
        if json {
            let line = serde_json::to_string(&report(file, name, content)).unwrap_or_default();
            writeln!(out, "{line}")?;
            continue;
        }
        let shown = file.display();
        match content {
            Ok(content) => {
                writeln!(out, "{shown}: {}{}", name.unwrap_or_default(), summary(&content))?;
                if !quiet {
                    warn_of_misfits(file, &content.misfits);
                }
                if !content.undeclared.is_empty() && !quiet {
                    let names = content.undeclared.join(" ");
                    anstream::eprintln!("{WARNING}warning{WARNING:#}: {shown}: used, but not required: {names}");
                }
            }
            Err(error) => {
                let what = if error.unsupported { "not supported" } else { "wrong" };
                writeln!(out, "{shown}: {BAD}{what}{BAD:#}")?;
                Failure::from(error).report();
            }
        }
    }
    Ok(match (wrong, unsupported) {
        (true, _) => Exit::BadInput,
        (false, true) => Exit::Unsupported,
        (false, false) => Exit::Success,
    })
}

/// Looks at how a file begins; a domain is given to the problems.
fn kind_of(file: &Path, domains: &mut Domains) -> Result<Kind, FileError> {
    let text = domains.text(file)?;
    if file.extension().is_some_and(|ending| ending == "plan") {
        return Ok(Kind::Plan);
    }
    let mut kind = || -> Result<Kind, PddlError> {
        let document = Document::read(&text)?;
        let root = document.only_root()?;
        if root.has_head(":trajectory") || root.children().next().is_some_and(Sexpr::is_list) {
            return Ok(Kind::Trajectory);
        }
        let Some(definition) = Definition::read(root)? else {
            let error = root.error("this is neither a domain nor a problem");
            return Err(error.with_hint("They begin with `(define (domain NAME)` or `(define (problem NAME)`."));
        };
        Ok(match definition.kind {
            DefinitionKind::Domain => {
                domains.give(file, definition.name);
                Kind::Domain
            }
            DefinitionKind::Problem => Kind::Problem(definition.domain_name().ok().map(|name| name.text().to_owned())),
        })
    };
    kind().map_err(|error| FileError::from_pddl(file, &text, error))
}

fn content_of(file: &Path, kind: Kind, domains: &mut Domains) -> Result<Content, FileError> {
    match kind {
        Kind::Domain => domains.read(file).map(|domain| domain_content(&domain)),
        Kind::Problem(name) => {
            let domain = name.map(|name| domains.of_problem(file, &name)).transpose()?.unwrap_or_default();
            let text = domains.text(file)?;
            let at_place = |error| FileError::from_pddl(file, &text, error);
            let problem = read_problem(&text, &domain).map_err(at_place)?;
            let compiled = compile_domain(&domain).and_then(|mut model| compile_problem(&problem, &mut model));
            compiled.map_err(|error| at_place(error.locate(&text)))?;
            Ok(problem_content(&problem, &domain))
        }
        Kind::Trajectory => {
            let text = domains.text(file)?;
            let trajectory = read_trajectory(&text).map_err(|error| FileError::from_pddl(file, &text, error))?;
            Ok(trajectory_content(&trajectory))
        }
        Kind::Plan => {
            let text = domains.text(file)?;
            let plan = read_plan(&text).map_err(|error| FileError::from_pddl(file, &text, error))?;
            Ok(content(None, vec![("action", plan.len())], Vec::new()))
        }
    }
}

fn domain_content(domain: &Domain) -> Content {
    // A type stands there once for each of its parents.
    let types: BTreeSet<&Symbol> = domain.types.iter().map(|(child, _)| child).collect();
    let counts = vec![
        ("action", domain.actions.len()),
        ("predicate", domain.predicates.len()),
        ("type", types.len()),
        ("constant", domain.constants.len()),
        ("function", domain.functions.len()),
        ("derivation", domain.derived.len()),
    ];
    let undeclared = undeclared_requirements(&required_by_domain(domain), &domain.requirements);
    content(Some(&domain.name), counts, undeclared)
}

fn problem_content(problem: &Problem, domain: &Domain) -> Content {
    let counts = vec![("object", problem.objects.len()), ("initial atom", problem.init.len())];
    let declared = [&*domain.requirements, &problem.requirements].concat();
    // What the domain lacks is said of the domain.
    let lacking = undeclared_requirements(&required_by_domain(domain), &domain.requirements);
    let mut undeclared = undeclared_requirements(&required_by_problem(problem), &declared);
    undeclared.retain(|name| !lacking.contains(name));
    let misfits = misfits(problem, domain).iter().map(ToString::to_string).collect();
    Content { misfits, ..content(Some(&problem.name), counts, undeclared) }
}

fn trajectory_content(trajectory: &Trajectory) -> Content {
    let counts = vec![("state", trajectory.states.len()), ("action", trajectory.actions.len())];
    content(None, counts, Vec::new())
}

fn content(name: Option<&Symbol>, counts: Vec<(&'static str, usize)>, undeclared: Vec<&'static str>) -> Content {
    let counts = counts.into_iter().map(|(what, n)| (what, n as u64)).collect();
    Content { name: name.cloned(), counts, undeclared, misfits: Vec::new() }
}

/// ` blocks, 4 actions, 5 predicates, 0 types`; of what comes after, what there is.
fn summary(content: &Content) -> String {
    let name = content.name.iter().map(|name| format!(" {name}"));
    let told = content.counts.iter().enumerate().filter(|(i, (_, n))| *i < 3 || *n > 0);
    let counts = told.map(|(_, (what, n))| format!(", {}", count(*n, what)));
    name.chain(counts).collect()
}

fn report(file: &Path, kind: Option<&'static str>, content: Result<Content, FileError>) -> Report {
    let file = file.display().to_string();
    match content {
        Ok(content) => Report { file, kind, content: Some(content), error: None },
        Err(FileError { what, line, column, hint, unsupported, .. }) => Report {
            file,
            kind,
            content: None,
            error: Some(Problematic { message: what, line, column, hint, unsupported }),
        },
    }
}
