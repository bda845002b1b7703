//! The laws of the readers, for valid texts, damaged ones and what is no text at all.

use std::fmt;
use std::fs;
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use typelift_model::testing::cases;
use typelift_tests::readers::{BETWEEN_PARTS, Edit, Laws, READERS, mutated};

/// The valid texts of a reader, by name.
fn seeds(reader: &str) -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/seeds").join(reader);
    let mut files: Vec<_> =
        fs::read_dir(&folder).expect("seeds").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files.iter().map(|path| (path.display().to_string(), fs::read_to_string(path).expect("text"))).collect()
}

/// Shown so that it can be copied into a test.
#[derive(Clone)]
struct Input(Vec<u8>);

impl fmt::Debug for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "b\"{}\"", self.0.escape_ascii())
    }
}

/// The laws of a reader for inputs of this kind.
fn hold(laws: Laws, usually: u32, inputs: impl Strategy<Value = Vec<u8>>) {
    let result = TestRunner::new(cases(usually)).run(&inputs.prop_map(Input), |Input(bytes)| {
        laws(&bytes);
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}

fn damaged(seeds: Vec<(String, String)>) -> impl Strategy<Value = Vec<u8>> {
    let edits = prop::collection::vec(any::<Edit>(), 1..6);
    (0..seeds.len(), edits).prop_map(move |(seed, edits)| mutated(&seeds[seed].1, &edits))
}

fn each_seed(reader: &str, laws: Laws) {
    for (name, text) in seeds(reader) {
        println!("{name}");
        laws(text.as_bytes());
        laws(text.replace('\n', "\r\n").as_bytes());
        laws(text.to_uppercase().as_bytes());
        laws(["\u{FEFF}".as_bytes(), text.as_bytes()].concat().as_slice());
    }
}

fn each_truncation(reader: &str, laws: Laws) {
    for (_, text) in seeds(reader) {
        for end in 0..text.len() {
            laws(&text.as_bytes()[..end]);
        }
    }
}

/// What readers of any kind are given by mistake.
fn oddities() -> Vec<Vec<u8>> {
    let deep = |open: &str, close: &str, depth: usize| [open.repeat(depth), close.repeat(depth)].concat().into_bytes();
    let mut oddities: Vec<Vec<u8>> =
        ["", "\u{FEFF}", "\0", "\0\0(\0)", "\r\n", "\r", ";", "; \r", "()", "{}", "[]", "0"]
            .map(|text| text.as_bytes().to_vec())
            .to_vec();
    oddities.extend([vec![0xFF; 100], vec![0xEF, 0xBB], b"(\xC3)".to_vec(), vec![0; 1000]]);
    for depth in [100, 250, 251, 1_000, 100_000] {
        oddities.extend([deep("(", ")", depth), deep("(", "", depth), deep("", ")", depth)]);
        oddities.extend([deep("[", "]", depth), deep("{\"a\":", "}", depth), deep("(not ", ")", depth)]);
    }
    oddities.push(BETWEEN_PARTS.repeat(3).into_bytes());
    oddities
}

macro_rules! readers {
    ($($name:ident)*) => {$(
        mod $name {
            use super::*;

            fn laws() -> Laws {
                let found = READERS.iter().find(|(name, _)| *name == stringify!($name));
                found.expect("a reader of this name").1
            }

            #[test]
            fn hold_for_valid_texts() {
                each_seed(stringify!($name), laws());
            }

            #[test]
            fn hold_for_texts_cut_off_anywhere() {
                each_truncation(stringify!($name), laws());
            }

            #[test]
            fn hold_for_oddities() {
                oddities().iter().for_each(|bytes| laws()(bytes));
            }

            #[test]
            fn hold_for_damaged_texts() {
                hold(laws(), 3_000, damaged(seeds(stringify!($name))));
            }

            #[test]
            fn hold_for_any_bytes() {
                let signs = "[()\\[\\]{}?:;,=\"\\- a-e\n\r\t\u{0}é\u{A0}]{0,60}";
                let bytes = prop_oneof![
                    signs.prop_map(String::into_bytes),
                    ".{0,60}".prop_map(String::into_bytes),
                    prop::collection::vec(any::<u8>(), 0..60),
                ];
                hold(laws(), 500, bytes);
            }
        }
    )*};
}

readers!(domain problem plan format types trajectory trace task model);

#[test]
fn every_reader_has_seeds() {
    for (reader, _) in READERS {
        assert!(!seeds(reader).is_empty(), "{reader}");
    }
}
