//! Problems.

use typelift::model::{ActionModel, Task};
use typelift::pddl::{
    Domain, compile_problem, format, read_objects, read_problem, required_by_problem, undeclared_requirements,
};

use super::domain::{assert_kept, checked_domain};
use super::errors::assert_located;
use super::planning::{assert_written_holds, valid_plans};
use super::{last_part, sample, text_of};

/// What is read is printed and laid out so that it reads the same; it has a task, for which every plan that is found
/// holds, or an error that points at the text. The part before the problem is its domain.
pub fn problem(bytes: &[u8]) {
    let text = text_of(bytes);
    let (given, problem) = last_part(&text);
    let found = match given {
        Some([domain]) => problem_of(domain, problem),
        None => {
            let (domain, model) = sample::domain();
            checked_problem(problem, domain, model.clone())
        }
    };
    if let Some((model, task)) = found {
        for (plan, state) in valid_plans(&model, &task) {
            assert_written_holds(&model, &task, &plan, &state);
        }
    }
}

/// The same of a problem of this domain.
pub(super) fn problem_of(domain: &str, problem: &str) -> Option<(ActionModel, Task)> {
    let (domain, model) = checked_domain(domain)?;
    checked_problem(problem, &domain, model)
}

/// The task of a text and the model for it, if there are any.
pub(super) fn checked_problem(text: &str, domain: &Domain, mut model: ActionModel) -> Option<(ActionModel, Task)> {
    let problem = match read_problem(text, domain) {
        Ok(problem) => problem,
        Err(error) => {
            assert_located(&error, text);
            return None;
        }
    };
    let printed = problem.to_string();
    assert_eq!(read_problem(&printed, domain).as_ref(), Ok(&problem), "as printed:\n{printed}");
    let laid_out = format(text).expect("its parentheses match");
    assert_eq!(read_problem(&laid_out, domain).as_ref(), Ok(&problem), "as laid out:\n{laid_out}");
    let required = required_by_problem(&problem);
    assert!(undeclared_requirements(&required, &problem.requirements).len() <= required.len());
    read_objects(text).expect("the objects alone are read as well");
    match compile_problem(&problem, &mut model) {
        Ok(task) => {
            assert_kept(&model.clone().into());
            Some((model, task))
        }
        Err(error) => {
            let (domain, is_of_problem) = (domain.to_string(), error.part.is_of_problem());
            let text = if is_of_problem { text } else { &domain };
            assert_located(&error.locate(text), text);
            None
        }
    }
}
