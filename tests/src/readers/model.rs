//! Model files.

use typelift::learn::{Options, learn};
use typelift::model::{ActionModel, GroundAtom, LearnedModel, ModelFileError, Symbol, Task, Term, strict};

use super::domain::assert_kept;
use super::errors::assert_printable;
use super::planning::valid_plans;
use super::text_of;

/// What is read is written so that it reads the same, with the same bytes the second time. It can be planned with and
/// learned further.
pub fn model(bytes: &[u8]) {
    let text = text_of(bytes);
    let learned = match LearnedModel::from_json(&text) {
        Ok(learned) => learned,
        Err(error) => {
            if let ModelFileError::Json { line, column, message } = error {
                assert_printable(&message);
                assert!(line <= text.split('\n').count() && column <= text.len() + 1, "{line}:{column}");
            }
            return;
        }
    };
    learned.to_json().expect("what was read can be written");
    assert_kept(&learned);
    let LearnedModel { model, evidence, .. } = &learned;
    let strict = strict(model);
    assert_kept(&LearnedModel { model: strict.clone(), ..learned.clone() });
    // It may speak of a type that is not in the hierarchy.
    let _ = learn(&model.hierarchy, &evidence.total(), &Options::default());
    valid_plans(&strict, &small_task(model));
}

/// From two objects of each type and nothing that holds, to one thing that an action adds.
fn small_task(model: &ActionModel) -> Task {
    let mut task = Task::default();
    for ty in model.hierarchy.types().take(8) {
        for number in 1..=2 {
            task.init.objects.insert(Symbol::from(format!("{}_{number}", model.hierarchy.name(ty))), ty);
        }
    }
    task.init.objects.extend(model.constants.clone());
    let added = model.actions.iter().flat_map(|action| action.adds().map(move |atom| (action, atom))).next();
    if let Some((action, atom)) = added {
        let object = |term: &Term| match term {
            Term::Const(name) => name.clone(),
            Term::Param(p) => {
                let ty = action.parameters.get(*p as usize).map(|parameter| parameter.ty);
                Symbol::from(format!("{}_1", model.hierarchy.name(ty.unwrap_or(model.hierarchy.root()))))
            }
        };
        task.goal
            .required
            .push(GroundAtom { predicate: atom.predicate.clone(), args: atom.args.iter().map(object).collect() });
    }
    task
}
