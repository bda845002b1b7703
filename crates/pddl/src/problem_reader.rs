//! Reads problems.

use typelift_model::{Atom, GroundAtom, HashMap, Symbol};

use crate::definition::refuse_other_blocks;
use crate::domain_reader::read_objects_block;
use crate::effect_reader::read_number;
use crate::formula_reader::{is_empty, parts};
use crate::names::lower;
use crate::requirements::read_requirements;
use crate::scope::Scope;
use crate::vocabulary::{DeclaredIn, Vocabulary};
use crate::{Definition, DefinitionKind, Document, Domain, Formula, PddlError, Problem, Sexpr, Span};

const BLOCKS: [&str; 7] = [":domain", ":requirements", ":objects", ":init", ":goal", ":metric", ":length"];

/// Reads a problem of a domain. Its blocks may stand in any order; `:length` is passed over.
///
/// # Errors
/// [`PddlError`] at what is wrong, or is right but not supported.
pub fn read_problem(text: &str, domain: &Domain) -> Result<Problem, PddlError> {
    problem_within(text, domain, DeclaredIn::Domain)
}

/// Reads a problem of which the domain, or what a model declares, says what it may mention. A domain without a name takes
/// problems of any.
pub(crate) fn problem_within(text: &str, domain: &Domain, declared_in: DeclaredIn) -> Result<Problem, PddlError> {
    let document = Document::read(text)?;
    let definition = Definition::only(&document, DefinitionKind::Problem)?;
    refuse_other_blocks(&definition, &BLOCKS)?;
    let name = definition.domain_name()?;
    if !name.is(domain.name.as_str()) && !domain.name.as_str().is_empty() {
        let message = format!("this problem belongs to the domain `{}`, not to `{}`", lower(name.text()), domain.name);
        return Err(name.error(message).with_hint("Read it with its own domain, or correct the name."));
    }
    let mut vocabulary = Vocabulary::of_domain(domain, declared_in, text)?;
    let requirements = read_requirements(definition.block(":requirements")?)?;
    let objects = read_objects_block(&mut vocabulary, definition.block(":objects")?, "object")?;
    let Some(init) = definition.block(":init")? else {
        let error = definition.error("this problem has no `:init`");
        return Err(error.with_hint("Write `(:init)` if nothing holds initially."));
    };
    let mut reader = InitReader { scope: Scope::of_problem(&vocabulary), init: Init::default() };
    for item in init.children().skip(1) {
        reader.add(item)?;
    }
    let Init { atoms, values, .. } = reader.init;
    Ok(Problem {
        name: Symbol::new(&lower(definition.name)),
        domain: Symbol::new(&lower(name.text())),
        requirements,
        objects,
        init: atoms,
        values,
        goal: read_goal(&vocabulary, &definition)?,
        minimizes_cost: read_metric(definition.block(":metric")?, domain)?,
        comment: Vec::new(),
    })
}

/// What holds initially, as far as it is read.
#[derive(Debug, Default)]
struct Init {
    atoms: Vec<GroundAtom>,
    values: Vec<(Atom<Symbol>, u32)>,
    /// Where each atom is said to hold.
    held: HashMap<GroundAtom, Span>,
    /// Where each atom is said not to hold.
    denied: HashMap<GroundAtom, Span>,
    valued: HashMap<GroundAtom, (u32, Span)>,
}

struct InitReader<'v> {
    scope: Scope<'v>,
    init: Init,
}

impl InitReader<'_> {
    fn add(&mut self, item: Sexpr<'_>) -> Result<(), PddlError> {
        let head = item.head().map(lower);
        match head.as_deref() {
            Some("=") => self.add_value(item),
            Some("not") => {
                let [negated] = parts(item, "one atom")?;
                let atom = self.atom(negated)?;
                if let Some(first) = self.init.held.get(&atom) {
                    return Err(contradiction(item, &atom, *first));
                }
                self.init.denied.insert(atom, item.span());
                Ok(())
            }
            Some(word @ ("and" | "or" | "forall" | "exists" | "imply" | "when" | "oneof" | "unknown")) => {
                let error = item.error(format!("`{word}` cannot stand in `:init`"));
                Err(error.with_hint("List each atom that holds, without `and`."))
            }
            Some("at") if is_timed(item) => {
                Err(item.error("literals that hold from a time on are not supported").as_unsupported())
            }
            _ => {
                let atom = self.atom(item)?;
                if let Some(first) = self.init.denied.get(&atom) {
                    return Err(contradiction(item, &atom, *first));
                }
                if self.init.held.insert(atom.clone(), item.span()).is_none() {
                    self.init.atoms.push(atom);
                }
                Ok(())
            }
        }
    }

    fn atom(&self, item: Sexpr<'_>) -> Result<GroundAtom, PddlError> {
        if !item.is_list() {
            let error = item.error(format!("an atom `(predicate object …)` is expected here, not `{}`", item.text()));
            return Err(error.with_hint("Each atom stands in parentheses."));
        }
        let atom = self.scope.ground_atom(item)?;
        if self.scope.vocabulary.derived.contains(&atom.predicate) {
            let error = item.error(format!("`{}` is a derived predicate, it cannot stand in `:init`", atom.predicate));
            return Err(error.with_hint("List what it is derived from."));
        }
        Ok(atom)
    }

    fn add_value(&mut self, item: Sexpr<'_>) -> Result<(), PddlError> {
        let [function, number] = parts(item, "a function and a number")?;
        if number.is_list() || self.scope.vocabulary.objects.contains_key(&*lower(number.text())) {
            let error = number.error("values other than numbers are not supported");
            return Err(error.as_unsupported());
        }
        let function = self.scope.ground_function(function)?;
        let value = read_number(number)?;
        match self.init.valued.insert(function.clone(), (value, item.span())) {
            None => self.init.values.push((function, value)),
            Some((first, _)) if first == value => {}
            Some((first, span)) => {
                let error = item.error(format!("`{function}` has two values, {first} and {value}"));
                return Err(error.with_related(item.document_text(), span, "the first is here"));
            }
        }
        Ok(())
    }
}

fn is_timed(item: Sexpr<'_>) -> bool {
    let mut parts = item.children().skip(1);
    let time = parts.next().and_then(Sexpr::atom);
    time.is_some_and(|time| time.parse::<f64>().is_ok()) && parts.next().is_some_and(Sexpr::is_list)
}

fn contradiction(item: Sexpr<'_>, atom: &GroundAtom, first: Span) -> PddlError {
    let error = item.error(format!("`{atom}` is said both to hold and not to hold"));
    error.with_related(item.document_text(), first, "the other is here")
}

fn read_goal(vocabulary: &Vocabulary, definition: &Definition<'_>) -> Result<Formula, PddlError> {
    const HINT: &str = "Write `(:goal (and))` for a goal that always holds.";
    let Some(block) = definition.block(":goal")? else {
        return Err(definition.error("this problem has no `:goal`").with_hint(HINT));
    };
    let mut goals = block.children().skip(1);
    match (goals.next(), goals.next()) {
        (Some(goal), None) if is_empty(goal) => Err(goal.error("the goal is empty").with_hint(HINT)),
        (Some(goal), None) => Scope::of_problem(vocabulary).formula(goal, 0),
        (None, _) => Err(block.error("the goal is empty").with_hint(HINT)),
        (Some(_), Some(second)) => {
            Err(second.error("there is a second condition in this goal").with_hint("Join several with `(and …)`."))
        }
    }
}

/// Whether the total cost is minimized.
fn read_metric(block: Option<Sexpr<'_>>, domain: &Domain) -> Result<bool, PddlError> {
    let Some(block) = block else { return Ok(false) };
    let [direction, what] = parts(block, "`minimize` and `(total-cost)`")?;
    if direction.is("minimize") && what.has_head("total-cost") && what.children().count() == 1 {
        if !domain.functions.iter().any(|function| function.name == *"total-cost") {
            let error = what.error("function `total-cost` is not declared");
            return Err(error.with_hint("Declare it in `(:functions (total-cost))` of the domain."));
        }
        return Ok(true);
    }
    let error = block.error("metrics other than `minimize (total-cost)` are not supported");
    Err(error.as_unsupported())
}
