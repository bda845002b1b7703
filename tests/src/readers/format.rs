//! The formatter.

use typelift::pddl::{Document, format as lay_out, read_domain, read_trajectory};

use super::errors::assert_located;
use super::text_of;

/// Laying out keeps words, parentheses and comments, and changes nothing the second time; only a text whose parentheses
/// do not match is refused.
pub fn format(bytes: &[u8]) {
    let text = text_of(bytes);
    let document = match Document::read(&text) {
        Ok(document) => document,
        Err(error) => {
            assert_eq!(lay_out(&text), Err(error.clone()));
            return assert_located(&error, &text);
        }
    };
    let laid_out = lay_out(&text).expect("its parentheses match");
    assert_eq!(lay_out(&laid_out).as_ref(), Ok(&laid_out));
    let again = Document::read(&laid_out).expect("they still match");
    assert_eq!(words(&again), words(&document));
    assert_eq!(comments(&laid_out), comments(&text));
    let before = read_domain(&text).map_err(|error| error.message);
    assert_eq!(read_domain(&laid_out).map_err(|error| error.message), before);
    assert_eq!(read_trajectory(&laid_out).is_ok(), read_trajectory(&text).is_ok());
}

/// The words and parentheses of a text.
fn words<'d>(document: &'d Document<'_>) -> Vec<&'d str> {
    let mut words = Vec::new();
    let mut open = vec![document.roots()];
    while let Some(parts) = open.last_mut() {
        match parts.next() {
            Some(part) if part.is_list() => {
                words.push("(");
                open.push(part.children());
            }
            Some(part) => words.push(part.text()),
            None => {
                words.push(")");
                open.pop();
            }
        }
    }
    words
}

/// What follows the first `;` of each line that has one.
fn comments(text: &str) -> Vec<&str> {
    text.split('\n').filter_map(|line| Some(line.split_once(';')?.1.trim_end())).collect()
}
