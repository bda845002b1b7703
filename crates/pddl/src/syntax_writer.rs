//! Prints domains and problems; what is printed reads as the same domain or problem.

use std::fmt::{self, Display, Formatter, Write};

use typelift_model::{Atom, GroundAtom, ROOT, Symbol};

use crate::{Action, Amount, Derived, Domain, Formula, PddlAtom, PddlEffect, Problem, Signature, Typed};

/// How wide a line of names may be.
const WIDTH: usize = 100;

/// `a b - t`: the type that stands behind a name.
struct Types<'a>(&'a [Symbol]);

impl Display for Types<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            [one] => write!(f, " - {one}"),
            several => {
                f.write_str(" - (either")?;
                several.iter().try_for_each(|ty| write!(f, " {ty}"))?;
                f.write_char(')')
            }
        }
    }
}

fn is_typed(list: &[Typed]) -> bool {
    list.iter().any(|typed| typed.types != [ROOT])
}

/// `?x - block ?y - table`; if all are of type `object`, with types only if `typed` is set.
fn write_variables(f: &mut Formatter<'_>, variables: &[Typed], typed: bool) -> fmt::Result {
    let typed = typed || is_typed(variables);
    for (i, Typed { name, types }) in variables.iter().enumerate() {
        write!(f, "{}?{name}", if i == 0 { "" } else { " " })?;
        if typed {
            write!(f, "{}", Types(types))?;
        }
    }
    Ok(())
}

fn write_signature(f: &mut Formatter<'_>, signature: &Signature, typed: bool) -> fmt::Result {
    write!(f, "({}", signature.name)?;
    if !signature.parameters.is_empty() {
        f.write_char(' ')?;
        write_variables(f, &signature.parameters, typed)?;
    }
    f.write_char(')')
}

impl Display for Signature {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_signature(f, self, false)
    }
}

fn write_atom<T: Display>(f: &mut Formatter<'_>, atom: &Atom<T>) -> fmt::Result {
    write!(f, "({}", atom.predicate)?;
    atom.args.iter().try_for_each(|arg| write!(f, " {arg}"))?;
    f.write_char(')')
}

fn write_list<T: Display>(f: &mut Formatter<'_>, word: &str, parts: &[T]) -> fmt::Result {
    write!(f, "({word}")?;
    parts.iter().try_for_each(|part| write!(f, " {part}"))?;
    f.write_char(')')
}

fn write_quantified(f: &mut Formatter<'_>, word: &str, variables: &[Typed], body: &dyn Display) -> fmt::Result {
    write!(f, "({word} (")?;
    write_variables(f, variables, false)?;
    write!(f, ") {body})")
}

impl Display for Formula {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Atom(atom) => write_atom(f, atom),
            Self::Equal(left, right) => write!(f, "(= {left} {right})"),
            Self::Not(formula) => write!(f, "(not {formula})"),
            Self::And(parts) => write_list(f, "and", parts),
            Self::Or(parts) => write_list(f, "or", parts),
            Self::Imply(premise, conclusion) => write!(f, "(imply {premise} {conclusion})"),
            Self::Exists(variables, body) => write_quantified(f, "exists", variables, body),
            Self::Forall(variables, body) => write_quantified(f, "forall", variables, body),
        }
    }
}

/// An atom in parentheses.
struct Parenthesized<'a>(&'a PddlAtom);

impl Display for Parenthesized<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_atom(f, self.0)
    }
}

impl Display for PddlEffect {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::And(parts) => write_list(f, "and", parts),
            Self::Add(atom) => write_atom(f, atom),
            Self::Delete(atom) => write!(f, "(not {})", Parenthesized(atom)),
            Self::Forall(variables, effect) => write_quantified(f, "forall", variables, effect),
            Self::When(condition, effect) => write!(f, "(when {condition} {effect})"),
            Self::Increase(Amount::Number(number)) => write!(f, "(increase (total-cost) {number})"),
            Self::Increase(Amount::Function(function)) => {
                write!(f, "(increase (total-cost) {})", Parenthesized(function))
            }
        }
    }
}

/// A block of lines: on one line if there is one and `short` is set.
fn write_block(f: &mut Formatter<'_>, key: &str, lines: &[String], short: bool) -> fmt::Result {
    match lines {
        [] => Ok(()),
        [one] if short && one.len() + key.len() + 4 <= WIDTH => writeln!(f, "  ({key} {one})"),
        _ => writeln!(f, "  ({key}\n    {})", lines.join("\n    ")),
    }
}

/// Lines of names that share a type, `a b - t`, broken where they get too long.
fn typed_lines<'a>(entries: impl Iterator<Item = (&'a Symbol, String)>) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut names = String::new();
    let mut current = String::new();
    for (name, ty) in entries {
        if !names.is_empty() && ty != current {
            lines.push(format!("{names}{current}"));
            names.clear();
        } else if names.len() + name.as_str().len() >= WIDTH - 8 {
            lines.push(std::mem::take(&mut names));
        }
        if !names.is_empty() {
            names.push(' ');
        }
        names.push_str(name.as_str());
        current = ty;
    }
    if !names.is_empty() {
        lines.push(format!("{names}{current}"));
    }
    lines
}

fn object_lines(objects: &[Typed], typed: bool) -> Vec<String> {
    let typed = typed || is_typed(objects);
    let ty = |object: &Typed| if typed { Types(&object.types).to_string() } else { String::new() };
    typed_lines(objects.iter().map(|object| (&object.name, ty(object))))
}

fn write_comment(f: &mut Formatter<'_>, indent: &str, comment: &[String]) -> fmt::Result {
    for line in comment {
        // A line feed must not end the comment.
        let line = format!("{indent}; {}", line.replace(['\n', '\r'], " "));
        writeln!(f, "{}", line.trim_end())?;
    }
    Ok(())
}

/// A list that begins with `and` with its parts a line each, anything else on one line.
fn write_conjunction<T: Display>(f: &mut Formatter<'_>, whole: &T, parts: Option<&[T]>, indent: &str) -> fmt::Result {
    match parts {
        None | Some([]) => write!(f, "{whole}"),
        Some(parts) => {
            f.write_str("(and")?;
            parts.iter().try_for_each(|part| write!(f, "\n{indent}{part}"))?;
            f.write_char(')')
        }
    }
}

fn write_condition(f: &mut Formatter<'_>, condition: &Formula, indent: &str) -> fmt::Result {
    let parts = if let Formula::And(parts) = condition { Some(parts.as_slice()) } else { None };
    write_conjunction(f, condition, parts, indent)
}

fn write_action(f: &mut Formatter<'_>, action: &Action, typed: bool) -> fmt::Result {
    f.write_char('\n')?;
    write_comment(f, "  ", &action.comment)?;
    write!(f, "  (:action {}\n    :parameters (", action.name)?;
    write_variables(f, &action.parameters, typed)?;
    f.write_str(")\n    :precondition ")?;
    write_condition(f, &action.precondition, "      ")?;
    f.write_str("\n    :effect ")?;
    let parts = if let PddlEffect::And(parts) = &action.effect { Some(parts.as_slice()) } else { None };
    write_conjunction(f, &action.effect, parts, "      ")?;
    f.write_str(")\n")
}

fn write_derived(f: &mut Formatter<'_>, derived: &Derived, typed: bool) -> fmt::Result {
    f.write_char('\n')?;
    write_comment(f, "  ", &derived.comment)?;
    f.write_str("  (:derived ")?;
    write_signature(f, &derived.head, typed)?;
    f.write_str("\n    ")?;
    write_condition(f, &derived.condition, "      ")?;
    f.write_str(")\n")
}

/// Signatures as the lines of a block.
struct Line<'a>(&'a Signature, bool);

impl Display for Line<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_signature(f, self.0, self.1)
    }
}

fn write_requirements(f: &mut Formatter<'_>, requirements: &[Symbol]) -> fmt::Result {
    if requirements.is_empty() {
        return Ok(());
    }
    f.write_str("  ")?;
    write_list(f, ":requirements", requirements)?;
    f.write_char('\n')
}

impl Display for Domain {
    /// As a file: types in the order in which they are declared, those that follow each other below one parent on a
    /// line; a predicate, a literal of a conjunction a line each.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let typed = !self.types.is_empty();
        write_comment(f, "", &self.comment)?;
        writeln!(f, "(define (domain {})", self.name)?;
        write_requirements(f, &self.requirements)?;
        let types = typed_lines(self.types.iter().map(|(child, parent)| (child, format!(" - {parent}"))));
        write_block(f, ":types", &types, false)?;
        write_block(f, ":constants", &object_lines(&self.constants, typed), true)?;
        let predicates: Vec<String> = self.predicates.iter().map(|p| Line(p, typed).to_string()).collect();
        write_block(f, ":predicates", &predicates, false)?;
        let functions: Vec<String> = self.functions.iter().map(|p| format!("{} - number", Line(p, typed))).collect();
        write_block(f, ":functions", &functions, true)?;
        self.derived.iter().try_for_each(|derived| write_derived(f, derived, typed))?;
        self.actions.iter().try_for_each(|action| write_action(f, action, typed))?;
        f.write_str(")\n")
    }
}

/// A ground atom in parentheses.
struct Fact<'a>(&'a GroundAtom);

impl Display for Fact<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_atom(f, self.0)
    }
}

impl Display for Problem {
    /// As a file: objects of one type that follow each other on a line, an atom or a literal of the goal a line each.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_comment(f, "", &self.comment)?;
        writeln!(f, "(define (problem {})\n  (:domain {})", self.name, self.domain)?;
        write_requirements(f, &self.requirements)?;
        write_block(f, ":objects", &object_lines(&self.objects, false), true)?;
        f.write_str("  (:init")?;
        self.init.iter().try_for_each(|atom| write!(f, "\n    {}", Fact(atom)))?;
        self.values.iter().try_for_each(|(function, value)| write!(f, "\n    (= {} {value})", Fact(function)))?;
        f.write_str(")\n  (:goal ")?;
        write_condition(f, &self.goal, "    ")?;
        f.write_str(")\n")?;
        if self.minimizes_cost {
            f.write_str("  (:metric minimize (total-cost))\n")?;
        }
        f.write_str(")\n")
    }
}
