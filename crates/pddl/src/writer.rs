//! Writes a model as a PDDL domain.
//!
//! Names go through the model's mapping to PDDL. An inequality is written only where the types of the two parameters
//! can share an object; elsewhere the types say it. The model keeps no types of predicates: an argument gets the
//! lowest type that covers its uses in the actions.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use typelift_model::{
    ActionModel, ActionSchema, Cost, Hierarchy, LiftedAtom, Literal, ModelPddlNames, NameCollision, PddlNames,
    Provenance, Symbol, Term, TypeId, describe_replacements,
};

/// The model as a PDDL domain called `name`; equal models give equal bytes.
///
/// # Errors
/// [`NameCollision`] if two names of one kind are the same name in PDDL.
pub fn write_domain(model: &ActionModel, name: &str) -> Result<String, NameCollision> {
    let constants = constants(model);
    let name = Symbol::new(name);
    let domain = PddlNames::fold("domain", [&name])?;
    let objects = PddlNames::fold("object", &constants)?;
    let writer = Writer { model, names: model.pddl_names()?, objects };
    let mut actions = String::new();
    for action in &model.actions {
        writer.write_action(&mut actions, action)?;
    }
    let mut out = format!("(define (domain {})\n", pddl(&domain, &name));
    line(&mut out, format_args!("  (:requirements {})", writer.requirements().join(" ")));
    writer.write_types(&mut out);
    if !constants.is_empty() {
        let listed: Vec<&str> = constants.iter().map(|name| pddl(&writer.objects, name)).collect();
        line(&mut out, format_args!("  (:constants {})", listed.join(" ")));
    }
    writer.write_predicates(&mut out);
    if writer.has_costs() {
        line(&mut out, format_args!("  (:functions (total-cost) - number)"));
    }
    out.push_str(&actions);
    out.push_str(")\n");
    Ok(out)
}

/// Writing to a string cannot fail.
fn line(out: &mut String, text: std::fmt::Arguments<'_>) {
    let _ = writeln!(out, "{text}");
}

/// The PDDL name of a name that was folded; a name that was not stands for itself.
fn pddl<'a>(names: &'a PddlNames, name: &'a Symbol) -> &'a str {
    names.pddl(name.as_str()).unwrap_or(name).as_str()
}

fn literals(action: &ActionSchema) -> impl Iterator<Item = &Literal> {
    let effects = action.effects.iter().flat_map(|e| e.condition.iter().chain([&e.literal]));
    action.preconditions.iter().chain(effects)
}

fn constants(model: &ActionModel) -> BTreeSet<Symbol> {
    let terms = model.actions.iter().flat_map(literals).flat_map(|l| &l.atom.args);
    terms.filter_map(|term| if let Term::Const(name) = term { Some(name.clone()) } else { None }).collect()
}

struct Writer<'a> {
    model: &'a ActionModel,
    names: ModelPddlNames,
    objects: PddlNames,
}

impl Writer<'_> {
    fn hierarchy(&self) -> &Hierarchy {
        &self.model.hierarchy
    }

    fn type_name(&self, ty: TypeId) -> &str {
        pddl(&self.names.types, self.hierarchy().name(ty))
    }

    fn has_costs(&self) -> bool {
        self.model.actions.iter().any(|action| action.cost != Cost::UNIT)
    }

    /// The pairs of parameters that must differ and that the types do not keep apart.
    fn inequalities<'b>(&'b self, action: &'b ActionSchema) -> impl Iterator<Item = (usize, usize)> + 'b {
        let pairs = action.distinct.iter().map(|&(i, j)| (i as usize, j as usize));
        pairs.filter(|&(i, j)| !self.hierarchy().disjoint(action.parameters[i].ty, action.parameters[j].ty))
    }

    fn requirements(&self) -> Vec<&'static str> {
        let actions = &self.model.actions;
        let negated = |l: &Literal| !l.positive;
        let negative = actions
            .iter()
            .any(|a| a.preconditions.iter().any(negated) || a.effects.iter().any(|e| e.condition.iter().any(negated)));
        let unequal = actions.iter().any(|a| self.inequalities(a).next().is_some());
        let used = [
            (":strips", true),
            (":typing", self.hierarchy().len() > 1),
            // `(not (= …))` is a negative precondition too.
            (":negative-preconditions", negative || unequal),
            (":equality", unequal),
            (":conditional-effects", actions.iter().any(|a| a.effects.iter().any(|e| !e.condition.is_empty()))),
            (":action-costs", self.has_costs()),
        ];
        used.into_iter().filter(|(_, used)| *used).map(|(name, _)| name).collect()
    }

    fn write_types(&self, out: &mut String) {
        let hierarchy = self.hierarchy();
        let mut groups = Vec::new();
        for parent in hierarchy.types() {
            let children: Vec<&str> = hierarchy.children(parent).map(|child| self.type_name(child)).collect();
            if !children.is_empty() {
                groups.push(format!("\n    {} - {}", children.join(" "), self.type_name(parent)));
            }
        }
        if !groups.is_empty() {
            line(out, format_args!("  (:types{})", groups.concat()));
        }
    }

    fn write_predicates(&self, out: &mut String) {
        let types = self.argument_types();
        let mut list = String::new();
        for (name, &arity) in &self.model.predicates {
            let _ = write!(list, "\n    ({}", pddl(&self.names.predicates, name));
            for i in 0..arity {
                let ty = types.get(&(name, i)).copied().unwrap_or(self.hierarchy().root());
                let _ = write!(list, " ?a{i} - {}", self.type_name(ty));
            }
            list.push(')');
        }
        if !list.is_empty() {
            line(out, format_args!("  (:predicates{list})"));
        }
    }

    /// For each argument of each predicate the lowest type that covers its uses; constants may be of any type.
    fn argument_types(&self) -> BTreeMap<(&Symbol, usize), TypeId> {
        let hierarchy = self.hierarchy();
        let mut types = BTreeMap::new();
        for action in &self.model.actions {
            for literal in literals(action) {
                for (i, term) in literal.atom.args.iter().enumerate() {
                    let ty = match term {
                        Term::Param(index) => action.parameters[*index as usize].ty,
                        Term::Const(_) => hierarchy.root(),
                    };
                    let known = types.entry((&literal.atom.predicate, i)).or_insert(ty);
                    *known = hierarchy.lca(*known, ty);
                }
            }
        }
        types
    }

    fn write_action(&self, out: &mut String, action: &ActionSchema) -> Result<(), NameCollision> {
        let variables = PddlNames::fold("parameter", action.parameters.iter().map(|p| &p.name))?;
        let variable = |index: usize| format!("?{}", pddl(&variables, &action.parameters[index].name));
        let term = |term: &Term| match term {
            Term::Param(index) => variable(*index as usize),
            Term::Const(name) => pddl(&self.objects, name).to_owned(),
        };
        let atom = |atom: &LiftedAtom| {
            let parts = [pddl(&self.names.predicates, &atom.predicate).to_owned()];
            let parts: Vec<String> = parts.into_iter().chain(atom.args.iter().map(term)).collect();
            format!("({})", parts.join(" "))
        };
        let literal = |l: &Literal| if l.positive { atom(&l.atom) } else { format!("(not {})", atom(&l.atom)) };
        let parameters: Vec<String> = (0..action.parameters.len())
            .map(|i| format!("{} - {}", variable(i), self.type_name(action.parameters[i].ty)))
            .collect();
        let mut preconditions: Vec<String> = action.preconditions.iter().map(literal).collect();
        let unequal = |(i, j)| format!("(not (= {} {}))", variable(i), variable(j));
        preconditions.extend(self.inequalities(action).map(unequal));
        let mut effects = Vec::new();
        for effect in &action.effects {
            let then = literal(&effect.literal);
            let when: Vec<String> = effect.condition.iter().map(literal).collect();
            effects.push(match when.as_slice() {
                [] => then,
                [one] => format!("(when {one} {then})"),
                _ => format!("(when (and {}) {then})", when.join(" ")),
            });
        }
        if self.has_costs() {
            effects.push(format!("(increase (total-cost) {})", action.cost.fixed));
        }
        line(out, format_args!("\n  ; {}", self.provenance(action)));
        line(out, format_args!("  (:action {}", pddl(&self.names.actions, &action.name)));
        line(out, format_args!("    :parameters ({})", parameters.join(" ")));
        line(out, format_args!("    :precondition {}", conjunction(&preconditions)));
        line(out, format_args!("    :effect {})", conjunction(&effects)));
        Ok(())
    }

    /// The answer to "why?" in a line.
    fn provenance(&self, action: &ActionSchema) -> String {
        let observations = match self.model.observations(action) {
            1 => "1 observation".to_owned(),
            n => format!("{n} observations"),
        };
        let text = match &action.provenance {
            Provenance::Given => "given".to_owned(),
            Provenance::Demonstrated(_) => format!("demonstrated, from {observations}"),
            Provenance::Generalized(_) => format!("generalized from {observations}"),
            Provenance::Imagined { from, replaced, .. } => {
                format!("imagined: {}, from {from}", describe_replacements(replaced, self.hierarchy()))
            }
            Provenance::Substituted { from, replaced, following, .. } => {
                let replaced = describe_replacements(replaced, self.hierarchy());
                format!("imagined: {replaced}, from {from}, following {following}")
            }
        };
        // A line feed in a name must not end the comment.
        text.replace(['\n', '\r'], " ")
    }
}

fn conjunction(literals: &[String]) -> String {
    let lines: String = literals.iter().map(|literal| format!("\n      {literal}")).collect();
    format!("(and{lines})")
}

#[cfg(test)]
mod tests {
    use typelift_model::{Effect, GroundAtom, LiftedCall, Parameter, Replacement};

    use super::*;

    fn atom(text: &str) -> LiftedAtom {
        LiftedAtom::parse(text).expect(text)
    }

    fn small_model() -> ActionModel {
        let hierarchy = Hierarchy::from_edges([
            ("agent", "object"),
            ("cutboard", "cuttingtool"),
            ("cuttingtool", "station"),
            ("counter", "station"),
        ])
        .expect("a tree");
        let ty = |name: &str| hierarchy.id(name).expect(name);
        let parameter = |(name, t): (&str, &str)| Parameter { name: Symbol::new(name), ty: ty(t) };
        let action = |name: &str, parameters: &[(&str, &str)], provenance| ActionSchema {
            name: Symbol::new(name),
            call: LiftedCall { name: Symbol::new("USE"), args: vec![Term::Param(0)] },
            parameters: parameters.iter().copied().map(parameter).collect(),
            preconditions: Vec::new(),
            distinct: ActionSchema::all_distinct(parameters.len()),
            effects: Vec::new(),
            cost: Cost::UNIT,
            provenance,
        };
        let replaced = vec![Replacement { parameter: 1, from: ty("cutboard"), to: ty("cuttingtool") }];
        let goal = GroundAtom::parse("status_Ready(x)").expect("an atom");
        let mut imagined = action(
            "USE-cuttingtool",
            &[("agent", "agent"), ("cuttingtool", "cuttingtool"), ("Station 2", "station")],
            Provenance::Imagined { from: Symbol::new("USE-cutboard"), replaced, goal, observations: 5 },
        );
        imagined.preconditions =
            vec![Literal::positive(atom("near(?1,?2)")), Literal::negative(atom("status_Ready(?1)"))];
        imagined.effects = vec![Effect::always(Literal::positive(atom("status_Ready(?1)")))];
        let mut given = action("wait", &[("who", "agent")], Provenance::Given);
        given.effects = vec![
            Effect::when(
                vec![Literal::positive(atom("tired(?0)")), Literal::positive(atom("at(?0,Home)"))],
                Literal::negative(atom("tired(?0)")),
            ),
            Effect::always(Literal::negative(atom("dark()"))),
        ];
        let predicates = [("near", 2), ("status_Ready", 1), ("tired", 1), ("dark", 0), ("at", 2), ("unused", 1)];
        ActionModel {
            predicates: predicates.map(|(name, arity)| (Symbol::new(name), arity)).into(),
            actions: vec![imagined, given],
            hierarchy,
            ..ActionModel::default()
        }
    }

    const SMALL_DOMAIN: &str = "\
(define (domain small_kitchen)
  (:requirements :strips :typing :negative-preconditions :equality :conditional-effects)
  (:types
    agent station - object
    cuttingtool counter - station
    cutboard - cuttingtool)
  (:constants home)
  (:predicates
    (at ?a0 - agent ?a1 - object)
    (dark)
    (near ?a0 - cuttingtool ?a1 - station)
    (status_ready ?a0 - cuttingtool)
    (tired ?a0 - agent)
    (unused ?a0 - object))

  ; imagined: cuttingtool for cutboard, from USE-cutboard
  (:action use-cuttingtool
    :parameters (?agent - agent ?cuttingtool - cuttingtool ?station_2 - station)
    :precondition (and
      (near ?cuttingtool ?station_2)
      (not (status_ready ?cuttingtool))
      (not (= ?cuttingtool ?station_2)))
    :effect (and
      (status_ready ?cuttingtool)))

  ; given
  (:action wait
    :parameters (?who - agent)
    :precondition (and)
    :effect (and
      (when (and (tired ?who) (at ?who home)) (not (tired ?who)))
      (not (dark))))
)
";

    #[test]
    fn a_small_domain() {
        assert_eq!(write_domain(&small_model(), "Small kitchen").as_deref(), Ok(SMALL_DOMAIN));
    }

    #[test]
    fn its_types_are_read_again() {
        let model = small_model();
        let text = write_domain(&model, "d").expect("no collision");
        let edges = |h: &Hierarchy| h.edges().map(|(c, p)| (c.clone(), p.clone())).collect::<BTreeSet<_>>();
        assert_eq!(edges(&crate::read_hierarchy(&text).expect("a hierarchy")), edges(&model.hierarchy));
        assert!(crate::Document::read(&text).and_then(|d| d.only_root().map(|_| ())).is_ok());
    }

    #[test]
    fn costs_are_declared_when_they_differ() {
        let mut model = small_model();
        model.actions[1].cost = 3.into();
        let text = write_domain(&model, "d").expect("no collision");
        for part in [":action-costs)", "(:functions (total-cost) - number)", "(increase (total-cost) 3)"] {
            assert!(text.contains(part), "{part}");
        }
    }

    #[test]
    fn an_empty_model_is_a_domain() {
        let text = write_domain(&ActionModel::default(), "empty").expect("no collision");
        assert_eq!(text, "(define (domain empty)\n  (:requirements :strips)\n)\n");
    }

    #[test]
    fn colliding_names_are_refused() {
        let mut model = small_model();
        model.predicates.insert(Symbol::new("NEAR"), 2);
        let error = write_domain(&model, "d").expect_err("a collision");
        assert_eq!(error.to_string(), "the predicate names `NEAR` and `near` are the same name in PDDL, `near`");
    }
}
