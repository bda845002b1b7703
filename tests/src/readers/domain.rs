//! Domains.

use typelift::model::{ActionModel, LearnedModel, ModelFileError};
use typelift::pddl::{
    Domain, compile_domain, format, read_domain, read_hierarchy, required_by_domain, undeclared_requirements,
};

use super::errors::assert_located;
use super::text_of;

/// What is read is printed and laid out so that it reads the same; it has a model, which survives its file, or an error
/// that points at the text.
pub fn domain(bytes: &[u8]) {
    let text = text_of(bytes);
    checked_domain(&text);
}

/// The domain of a text and its model, if there are any.
pub(super) fn checked_domain(text: &str) -> Option<(Domain, ActionModel)> {
    let domain = match read_domain(text) {
        Ok(domain) => domain,
        Err(error) => {
            assert_located(&error, text);
            return None;
        }
    };
    let printed = domain.to_string();
    assert_eq!(read_domain(&printed).as_ref(), Ok(&domain), "as printed:\n{printed}");
    let laid_out = format(text).expect("its parentheses match");
    assert_eq!(read_domain(&laid_out).as_ref(), Ok(&domain), "as laid out:\n{laid_out}");
    let laid_out = format(&printed).expect("its parentheses match");
    assert_eq!(read_domain(&laid_out).as_ref(), Ok(&domain), "as printed and laid out:\n{laid_out}");
    let required = required_by_domain(&domain);
    assert!(undeclared_requirements(&required, &domain.requirements).len() <= required.len());
    let hierarchy = read_hierarchy(text).expect("the types alone are read as well");
    match compile_domain(&domain) {
        Ok(model) => {
            assert_eq!(model.hierarchy, hierarchy);
            assert_kept(&model.clone().into());
            Some((domain, model))
        }
        Err(error) => {
            assert!(!error.part.is_of_problem(), "{error}");
            assert_located(&error.locate(text), text);
            assert_located(&error.locate(&printed), &printed);
            None
        }
    }
}

/// That a model survives its file, but for wordings and what is never used, which the file does not hold. The only reason not to write one is that
/// its names collide.
pub(super) fn assert_kept(model: &LearnedModel) {
    match model.to_json() {
        Ok(json) => {
            let mut read = LearnedModel::from_json(&json).unwrap_or_else(|error| panic!("{error}:\n{json}"));
            read.model.wordings.clone_from(&model.model.wordings);
            read.model.never_used.clone_from(&model.model.never_used);
            assert_eq!(read, *model);
            assert_eq!(read.to_json().ok(), Some(json));
        }
        Err(ModelFileError::Collision(_)) => {}
        Err(error) => panic!("{error}"),
    }
}
