//! Problems in a few lines of text.

use std::collections::BTreeSet;

use super::Tiny;
use crate::{
    ActionModel, ActionSchema, Effect, GroundAtom, Hierarchy, LiftedAtom, LiftedCall, Literal, Parameter, Provenance,
    State, Symbol, Task, Term,
};

impl Tiny {
    /// Reads a problem without types, a line a thing:
    ///
    /// ```
    /// # use typelift_model::testing::Tiny;
    /// let shopping = Tiny::written(
    ///     "init: at(home)
    ///      goal: bread !hungry
    ///      go(?0,?1): at(?0) -> at(?1) !at(?0)
    ///      buy cost 3: at(shop) -> bread
    ///      eat: bread -> !hungry late=>tired",
    /// );
    /// assert_eq!(shopping.model.actions.len(), 3);
    /// assert_eq!(shopping.task.init.objects.len(), 2); // home and shop
    /// ```
    ///
    /// `!` negates, and what stands before `=>`, joined by `&`, is an effect's condition. Parameters are `?0`, `?1`, …; an
    /// action costs 1 if nothing is said.
    ///
    /// # Panics
    /// If the text has another form.
    pub fn written(text: &str) -> Self {
        let (mut model, mut task) =
            (ActionModel { hierarchy: Hierarchy::default(), ..Default::default() }, Task::default());
        for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
            let (head, rest) = line.split_once(": ").unwrap_or_else(|| panic!("nothing before a colon: {line}"));
            match head {
                "init" => task.init.atoms = rest.split_whitespace().map(ground).collect(),
                "goal" => {
                    for literal in rest.split_whitespace() {
                        match literal.strip_prefix('!') {
                            Some(atom) => task.goal.forbidden.push(ground(atom)),
                            None => task.goal.required.push(ground(literal)),
                        }
                    }
                }
                _ => model.actions.push(action(head, rest, &model.hierarchy)),
            }
        }
        model.actions.sort_by(|a, b| a.name.cmp(&b.name));
        task.init.objects = objects(&model, &task).into_iter().map(|object| (object, model.hierarchy.root())).collect();
        Self { model, task }
    }

    /// The state of a problem in which these atoms hold and no others.
    ///
    /// # Panics
    /// If the text is not a list of atoms.
    pub fn state(&self, atoms: &str) -> State {
        State { atoms: atoms.split_whitespace().map(ground).collect(), ..self.task.init.clone() }
    }
}

fn ground(text: &str) -> GroundAtom {
    GroundAtom::parse(text).unwrap_or_else(|e| panic!("{e}"))
}

fn literal(text: &str) -> Literal {
    let atom = |text| LiftedAtom::parse(text).unwrap_or_else(|e| panic!("{e}"));
    text.strip_prefix('!').map_or_else(|| Literal::positive(atom(text)), |rest| Literal::negative(atom(rest)))
}

fn effect(text: &str) -> Effect {
    match text.split_once("=>") {
        Some((condition, then)) => Effect::when(condition.split('&').map(literal).collect(), literal(then)),
        None => Effect::always(literal(text)),
    }
}

/// `name cost 2`, and `preconditions -> effects`.
fn action(head: &str, body: &str, hierarchy: &Hierarchy) -> ActionSchema {
    let (name, cost) = head.split_once(" cost ").unwrap_or((head, "1"));
    let name = Symbol::new(name.split('(').next().unwrap_or(name));
    let (before, after) = body.split_once("->").unwrap_or_else(|| panic!("no arrow: {body}"));
    let mut preconditions: Vec<Literal> = before.split_whitespace().map(literal).collect();
    let mut effects: Vec<Effect> = after.split_whitespace().map(effect).collect();
    preconditions.sort_unstable();
    effects.sort_unstable();
    let conditions = effects.iter().flat_map(|effect| effect.condition.iter().chain([&effect.literal]));
    let terms = preconditions.iter().chain(conditions).flat_map(|literal| &literal.atom.args);
    let params = terms.filter_map(|term| if let Term::Param(number) = term { Some(*number) } else { None });
    let count = params.max().map_or(0, |last| last + 1);
    let parameter = |number| Parameter { name: Symbol::from(format!("x{number}")), ty: hierarchy.root() };
    ActionSchema {
        call: LiftedCall { name: name.clone(), args: (0..count).map(Term::Param).collect() },
        name,
        parameters: (0..count).map(parameter).collect(),
        preconditions,
        distinct: Vec::new(),
        effects,
        cost: cost.parse::<u32>().unwrap_or_else(|e| panic!("{cost}: {e}")).into(),
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    }
}

/// All that is named anywhere.
fn objects(model: &ActionModel, task: &Task) -> BTreeSet<Symbol> {
    let of_actions = model.actions.iter().flat_map(|action| {
        let conditions = action.effects.iter().flat_map(|effect| effect.condition.iter().chain([&effect.literal]));
        action.preconditions.iter().chain(conditions).flat_map(|literal| &literal.atom.args)
    });
    let constants = of_actions.filter_map(|term| if let Term::Const(name) = term { Some(name) } else { None });
    let of_task = task.init.atoms.iter().chain(task.goal.literals().map(|(atom, _)| atom));
    of_task.flat_map(|atom| &atom.args).chain(constants).cloned().collect()
}
