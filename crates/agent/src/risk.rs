//! How risky steps are, as costs: of two plans the one that is likelier to work is the cheaper one.
//!
//! A step costs 1000, and 1000·R·(−ln p) more, where p is how likely it works and R how many steps of a detour are worth
//! making it certain. What speaks against a step is taken apart: the type in a place, two types together, an object. So
//! each is a function of one object or two, whose values the task gives. They weigh in a second, short search, which may better a
//! plan and never lose one; another planner's plans are taken as they are.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionModel, ActionSchema, Cost, GroundAtom, LiftedAtom, Plan, Symbol, Task, Term, TypeId};

/// What a step costs, in thousandths.
const STEP: u32 = 1000;

/// So many values are stated for an action at most.
const VALUES: usize = 100_000;

/// What is risky at a place.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum RiskOf {
    /// Every object of exactly this type.
    Type(Symbol),
    /// This object.
    Object(Symbol),
}

/// What a step costs besides, where something is at a parameter of its action, or two things are at two.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct Risk {
    /// The learned action; what was imagined of it is as risky.
    pub(crate) action: Symbol,
    /// The parameters, from 0, and what stands there.
    pub(crate) at: Vec<(u32, RiskOf)>,
    /// The cost, in thousandths of a step.
    pub(crate) cost: u32,
}

impl Risk {
    /// That something whose odds to be at fault are these costs so much, if one step is worth being `weight` times as
    /// likely, in powers of e; none if that is less than a thousandth.
    pub(crate) fn of(action: &Symbol, at: Vec<(u32, RiskOf)>, odds: f64, weight: u32) -> Option<Self> {
        // −ln p, where p = 1 / (1 + odds).
        let cost = (f64::from(STEP) * f64::from(weight) * odds.ln_1p()).round() as u32;
        (cost > 0).then(|| Self { action: action.clone(), at, cost })
    }
}

/// The model and the task with risks as costs.
pub(crate) fn weighed(model: &ActionModel, task: &Task, risks: &[Risk]) -> (ActionModel, Task) {
    let (mut model, mut task) = (model.clone(), task.clone());
    for value in task.values.values_mut() {
        *value = value.saturating_mul(STEP);
    }
    let mut of_action: BTreeMap<&Symbol, BTreeMap<Vec<u32>, Vec<&Risk>>> = BTreeMap::new();
    for risk in risks {
        let places = risk.at.iter().map(|(parameter, _)| *parameter).collect();
        of_action.entry(&risk.action).or_default().entry(places).or_default().push(risk);
    }
    let hierarchy = model.hierarchy.clone();
    for (number, schema) in model.actions.iter_mut().enumerate() {
        schema.cost.fixed = schema.cost.fixed.saturating_mul(STEP);
        let Some(by_places) = of_action.get(learned_as(schema)) else { continue };
        for (places, risks) in by_places {
            let fits = |place: &u32| -> Option<Vec<(&Symbol, TypeId)>> {
                let ty = schema.parameters.get(*place as usize)?.ty;
                let objects = task.init.objects.iter().filter(|(_, own)| hierarchy.is_a(**own, ty));
                Some(objects.map(|(object, own)| (object, *own)).collect())
            };
            let Some(choices) = places.iter().map(fits).collect::<Option<Vec<_>>>() else { continue };
            if choices.iter().map(Vec::len).product::<usize>() > VALUES {
                continue;
            }
            let costs = costs(risks, &choices, |ty| hierarchy.name(ty));
            if costs.iter().all(|(_, cost)| *cost == 0) {
                continue;
            }
            let name = places.iter().fold(format!("risk-{number}"), |name, place| format!("{name}-{place}"));
            let predicate = Symbol::from(name);
            let values =
                costs.into_iter().map(|(args, cost)| (GroundAtom { predicate: predicate.clone(), args }, cost));
            let values: Vec<(GroundAtom, u32)> = values.collect();
            task.values.extend(values);
            schema
                .cost
                .functions
                .push(LiftedAtom { predicate, args: places.iter().copied().map(Term::Param).collect() });
        }
    }
    (model, task)
}

/// The name of the learned action that an action is, or was imagined from.
fn learned_as(schema: &ActionSchema) -> &Symbol {
    schema.provenance.imagined().map_or(&schema.name, |(from, _, _)| from)
}

/// What each choice of objects for some parameters costs.
fn costs<'h>(
    risks: &[&Risk],
    choices: &[Vec<(&Symbol, TypeId)>],
    name: impl Fn(TypeId) -> &'h Symbol,
) -> Vec<(Vec<Symbol>, u32)> {
    let mut chosen: Vec<Vec<(&Symbol, TypeId)>> = vec![Vec::new()];
    for choice in choices {
        let longer = |begun: &Vec<(_, _)>| choice.iter().map(|one| [begun.as_slice(), &[*one]].concat()).collect();
        chosen = chosen.iter().flat_map(|begun| -> Vec<Vec<(&Symbol, TypeId)>> { longer(begun) }).collect();
    }
    let is = |of: &RiskOf, (object, ty): (&Symbol, TypeId)| match of {
        RiskOf::Type(named) => name(ty) == named,
        RiskOf::Object(named) => object == named,
    };
    let cost = |objects: &[(&Symbol, TypeId)]| {
        let speaks = |risk: &&&Risk| risk.at.iter().zip(objects).all(|((_, of), object)| is(of, *object));
        risks.iter().filter(speaks).fold(0_u32, |sum, risk| sum.saturating_add(risk.cost))
    };
    chosen
        .iter()
        .map(|objects| (objects.iter().map(|(object, _)| (*object).clone()).collect(), cost(objects)))
        .collect()
}

/// How risky a plan is: what it costs more than its steps do without risks, in thousandths of a step.
pub(crate) fn risk_of(plan: &Plan, unweighed: &Plan) -> u64 {
    plan.cost().saturating_sub(u64::from(STEP) * unweighed.cost())
}

/// The plan with what its steps cost in another model and task of the same actions and objects.
pub(crate) fn repriced(plan: &Plan, model: &ActionModel, values: &BTreeMap<GroundAtom, u32>) -> Plan {
    let mut plan = plan.clone();
    for step in &mut plan.steps {
        let cost = model.action(step.action.as_str()).and_then(|schema| schema.cost.of(&step.objects, values));
        step.cost = cost.unwrap_or(Cost::UNIT.fixed);
    }
    plan
}

#[cfg(test)]
mod tests {
    use typelift_model::{
        Budget, Effect, GroundAtom, Hierarchy, LiftedCall, Literal, Parameter, Provenance, State, Step,
    };
    use typelift_plan::Restrictions;

    use super::*;
    use crate::Options;
    use crate::propose::attempt;

    /// `cut(TOOL, FOOD)` cuts; `get(FOOD)` has the same done elsewhere, in three steps.
    fn model() -> ActionModel {
        let edges = [("tool", "object"), ("food", "object"), ("board", "tool"), ("knife", "tool")];
        let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
        let action = |name: &str, types: &[&str], needs: &str, adds: &str| {
            let parameter = |ty: &&str| Parameter { name: (*ty).into(), ty: hierarchy.id(ty).expect("a type") };
            let food = Term::Param(types.len() as u32 - 1);
            let literal =
                |predicate: &str| Literal { atom: LiftedAtom::new(predicate, vec![food.clone()]), positive: true };
            ActionSchema {
                name: name.into(),
                call: LiftedCall { name: name.into(), args: (0..types.len() as u32).map(Term::Param).collect() },
                parameters: types.iter().map(parameter).collect(),
                preconditions: vec![literal(needs)],
                distinct: Vec::new(),
                effects: vec![Effect::always(literal(adds))],
                cost: Cost::UNIT,
                strict: true,
                named_by_call: false,
                provenance: Provenance::Given,
            }
        };
        let actions = vec![
            action("cut", &["tool", "food"], "whole", "cut"),
            action("send", &["food"], "whole", "sent"),
            action("wait", &["food"], "sent", "done"),
            action("unpack", &["food"], "done", "cut"),
        ];
        ActionModel { actions, hierarchy, ..ActionModel::default() }
    }

    fn risk(of: RiskOf, odds: f64, weight: u32) -> Risk {
        Risk::of(&"cut".into(), vec![(0, of)], odds, weight).expect("it is risky")
    }

    /// The calls of the plan that cuts a leek, with a knife and two boards.
    fn plan(risks: &[Risk]) -> Vec<String> {
        let model = model();
        let things = [("board_1", "board"), ("board_2", "board"), ("knife_1", "knife"), ("leek_1", "food")];
        let objects = things.map(|(name, ty)| (name.into(), model.hierarchy.id(ty).expect("a type")));
        let atoms = [GroundAtom::parse("whole(leek_1)").expect("an atom")];
        let init = State { objects: objects.into(), atoms: atoms.into(), ..State::default() };
        let task = Task::new(init, vec![GroundAtom::parse("cut(leek_1)").expect("an atom")]);
        let (none, options) = (Restrictions::default(), Options::default());
        let proposal = attempt(&model, &task, &none, &options, &[], risks, &Budget::unlimited()).expect("an answer");
        let typelift_plan::Outcome::Solved(plan) = proposal.outcome else { panic!("there is a plan") };
        assert!(plan.steps.iter().all(|step| step.cost == 1), "a step costs what it did");
        plan.steps.iter().map(|Step { call, .. }| call.to_string()).collect()
    }

    #[test]
    fn what_is_less_risky_is_planned() {
        let (board, knife) = (RiskOf::Type("board".into()), RiskOf::Type("knife".into()));
        let first = RiskOf::Object("board_1".into());
        assert_eq!(plan(&[]), ["cut(board_1, leek_1)"]);
        assert_eq!(plan(&[risk(first.clone(), 0.2, 10)]), ["cut(board_2, leek_1)"], "another thing of its kind");
        let kind = [risk(board.clone(), 0.2, 10), risk(first, 0.2, 10)];
        assert_eq!(plan(&kind), ["cut(knife_1, leek_1)"], "a thing of another kind");
        let both = |odds, weight| [risk(board.clone(), odds, weight), risk(knife.clone(), odds, weight)];
        let detour = ["send(leek_1)", "wait(leek_1)", "unpack(leek_1)"];
        assert_eq!(plan(&both(1.0, 10)), detour, "seven steps' worth of risk are worth two");
        assert_eq!(plan(&both(0.1, 10)).len(), 1, "one step's worth is not");
        assert_eq!(plan(&both(1.0, 1)).len(), 1, "nor is it to who cares little");
        assert_eq!(Risk::of(&"cut".into(), Vec::new(), 1.0, 0), None, "nor to who does not care");
    }
}
