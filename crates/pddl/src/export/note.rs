//! The comments: who wrote this, where each action comes from, and what names stand for.

use typelift_model::{ActionSchema, PddlNames, Provenance, Symbol, Term, describe_replacements};

use super::names::{ExportNames, pddl};
use super::{Level, Writer};

impl Writer<'_> {
    /// The comments at the top of the domain.
    pub(super) fn domain_notes(&self, notes: Vec<String>) -> Vec<String> {
        let level = match self.options.level {
            Level::Strips => "strips",
            Level::Adl => "adl",
        };
        let names = self.names;
        let mut lines = vec![format!("written by typelift, level {level}")];
        lines.extend(notes);
        lines.extend(respelled(&[&names.domain, &names.types, &names.predicates, &names.functions]));
        lines
    }

    /// The comments at the top of the problem.
    pub(super) fn problem_notes(&self) -> Vec<String> {
        let mut lines = vec!["written by typelift".to_owned()];
        lines.extend(respelled(&[&self.names.problem, &self.names.objects]));
        lines
    }

    /// The comments before an action: the answer to "why?", and what is executed if that is called otherwise.
    pub(super) fn action_notes(&self, action: &ActionSchema, variables: &[Symbol]) -> Vec<String> {
        let mut lines = vec![self.provenance(action)];
        let own = action.call.args.iter().map(|term| match term {
            Term::Param(index) => Some(*index as usize),
            Term::Const(_) => None,
        });
        let is_signature = own.eq((0..action.parameters.len()).map(Some))
            && pddl(&self.names.actions, &action.name).as_str() == action.call.name.as_str().to_ascii_lowercase();
        if !is_signature {
            let args = action.call.args.iter().map(|term| match term {
                Term::Param(index) => format!("?{}", variables[*index as usize]),
                Term::Const(name) => name.to_string(),
            });
            let args: Vec<String> = args.collect();
            lines.push(format!("executes {}({})", action.call.name, args.join(", ")));
        }
        lines
    }

    fn provenance(&self, action: &ActionSchema) -> String {
        let hierarchy = &self.model.hierarchy;
        let observations = match action.provenance.observations() {
            1 => "1 observation".to_owned(),
            n => format!("{n} observations"),
        };
        match &action.provenance {
            Provenance::Given => "given".to_owned(),
            Provenance::Demonstrated(_) => format!("demonstrated, from {observations}"),
            Provenance::Generalized(_) => format!("generalized from {observations}"),
            Provenance::Imagined { from, replaced, .. } => {
                format!("imagined: {}, from {from}", describe_replacements(replaced, hierarchy))
            }
            Provenance::Substituted { from, replaced, following, .. } => {
                let replaced = describe_replacements(replaced, hierarchy);
                format!("imagined: {replaced}, from {from}, following {following}")
            }
            Provenance::Loosened { from, .. } => format!("imagined: without what always held, from {from}"),
        }
    }
}

fn respelled(names: &[&PddlNames]) -> Vec<String> {
    let pairs = ExportNames::respelled(names);
    pairs.into_iter().map(|(name, pddl)| format!("{pddl} stands for {name}")).collect()
}
