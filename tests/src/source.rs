//! Rust source as the house rules look at it: tokens, without comments and without what is compiled for tests only;
//! and which modules of a crate it names.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{fs, iter};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The source files below a folder, in order.
///
/// # Panics
/// If a folder cannot be read.
pub fn source_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let files = paths.into_iter().flat_map(|path| if path.is_dir() { source_files(&path) } else { vec![path] });
    files.filter(|path| path.extension().is_some_and(|ending| ending == "rs")).collect()
}

/// The tokens of a source file, without comments and without items under `#[cfg(test)]`.
#[derive(Debug)]
pub struct Code {
    tokens: Vec<TokenTree>,
    /// Modules in files of their own that are compiled for tests only.
    test_modules: Vec<String>,
}

impl Code {
    /// Reads a file.
    ///
    /// # Panics
    /// If it cannot be read, or is not Rust.
    pub fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        text.parse().unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// The code as text: its tokens, with spaces only where two would become one.
    pub fn text(&self) -> String {
        let mut text = String::new();
        write(&mut text, self.tokens.iter().cloned());
        text
    }
}

impl std::str::FromStr for Code {
    type Err = proc_macro2::LexError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut test_modules = Vec::new();
        let tokens = without_tests(text.parse()?, &mut test_modules);
        Ok(Self { tokens, test_modules })
    }
}

fn is_punct(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign)
}

fn is_ident(token: &TokenTree, word: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == word)
}

fn group(token: &TokenTree, delimiter: Delimiter) -> Option<TokenStream> {
    match token {
        TokenTree::Group(group) if group.delimiter() == delimiter => Some(group.stream()),
        _ => None,
    }
}

fn without_tests(stream: TokenStream, test_modules: &mut Vec<String>) -> Vec<TokenTree> {
    let mut tokens = stream.into_iter().peekable();
    let mut kept = Vec::new();
    while let Some(token) = tokens.next() {
        let mut attribute = None;
        if is_punct(&token, '#') {
            let mut ahead = tokens.clone();
            let inner = ahead.next_if(|next| is_punct(next, '!')).is_some();
            attribute = ahead.next().and_then(|next| group(&next, Delimiter::Bracket)).map(|stream| stream.to_string());
            if attribute.as_ref().is_some_and(|text| text.starts_with("doc =")) {
                // A comment for the documentation.
                tokens = ahead;
                continue;
            }
            attribute = attribute.filter(|_| !inner);
        }
        match attribute.as_deref() {
            Some("cfg (test)") => {
                // The item ends with its body, or with a semicolon.
                let mut item: Vec<TokenTree> = Vec::new();
                while item.last().is_none_or(|last| !is_punct(last, ';') && group(last, Delimiter::Brace).is_none()) {
                    let Some(token) = tokens.next() else { break };
                    item.push(token);
                }
                if let [.., word, name, end] = item.as_slice()
                    && is_ident(word, "mod")
                    && is_punct(end, ';')
                {
                    test_modules.push(name.to_string());
                }
            }
            _ => match token {
                TokenTree::Group(group) => {
                    let content = without_tests(group.stream(), test_modules).into_iter().collect();
                    kept.push(proc_macro2::Group::new(group.delimiter(), content).into());
                }
                token => kept.push(token),
            },
        }
    }
    kept
}

fn write(text: &mut String, tokens: impl IntoIterator<Item = TokenTree>) {
    for token in tokens {
        let TokenTree::Group(group) = token else {
            let word = token.to_string();
            let joins = |c: char| c.is_alphanumeric() || c == '_';
            if text.ends_with(joins) && word.starts_with(joins) {
                text.push(' ');
            }
            text.push_str(&word);
            continue;
        };
        let (open, close) = match group.delimiter() {
            Delimiter::Parenthesis => ("(", ")"),
            Delimiter::Brace => ("{", "}"),
            Delimiter::Bracket => ("[", "]"),
            Delimiter::None => ("", ""),
        };
        text.push_str(open);
        write(text, group.stream());
        text.push_str(close);
    }
}

/// A path within a crate: `["search", "astar"]`.
type ModulePath = Vec<String>;

/// Which modules of a crate name which others of the same folder. A folder is one module to those beside it.
///
/// The modules of a folder are its files and folders. Its own file (`lib.rs`, `main.rs`, `mod.rs`) is none of them: it is
/// there to hold them together. A name that such a file gives on (`pub use astar::Astar`) stands for the module that it
/// is from.
#[derive(Debug)]
pub struct Imports {
    /// By folder: the folder's path in the crate, then importer and imported.
    pub folders: BTreeMap<String, BTreeSet<(String, String)>>,
    /// The modules of each folder.
    pub modules: BTreeMap<String, BTreeSet<String>>,
}

impl Imports {
    /// The imports within a crate, by its folder of source files.
    pub fn of(src: &Path) -> Self {
        let files: Vec<(ModulePath, Code)> =
            source_files(src).iter().map(|file| (module_path(src, file), Code::read(file))).collect();
        let tests: BTreeSet<ModulePath> = files
            .iter()
            .flat_map(|(path, code)| {
                code.test_modules.iter().map(|name| [path.as_slice(), std::slice::from_ref(name)].concat())
            })
            .collect();
        let files: BTreeMap<ModulePath, Code> = files.into_iter().filter(|(path, _)| !tests.contains(path)).collect();
        let given_on = files.iter().map(|(path, code)| (path.clone(), names_of(code, path))).collect();
        let mut imports = Self { folders: BTreeMap::new(), modules: BTreeMap::new() };
        for path in files.keys().filter(|path| !path.is_empty()) {
            let (name, folder) = path.split_last().expect("a name");
            imports.modules.entry(folder.join("/")).or_default().insert(name.clone());
        }
        for (path, code) in &files {
            for named in paths(&code.tokens, path) {
                imports.add(path, &resolved(named, &files, &given_on));
            }
        }
        imports
    }

    /// Adds that one module names another, where their paths part.
    fn add(&mut self, importer: &[String], imported: &[String]) {
        let common = iter::zip(importer, imported).take_while(|(a, b)| a == b).count();
        if let (Some(from), Some(to)) = (importer.get(common), imported.get(common)) {
            let folder = importer[..common].join("/");
            if self.modules.get(&folder).is_some_and(|modules| modules.contains(to)) {
                self.folders.entry(folder).or_default().insert((from.clone(), to.clone()));
            }
        }
    }

    /// The pairs of modules of a folder that lie on a circle of imports.
    pub fn circles(&self, folder: &str) -> BTreeSet<(String, String)> {
        let Some(pairs) = self.folders.get(folder) else { return BTreeSet::new() };
        let reaches = |from: &String, to: &String| {
            let (mut seen, mut open) = (BTreeSet::from([from]), vec![from]);
            while let Some(module) = open.pop() {
                if module == to {
                    return true;
                }
                let next = pairs.iter().filter(|(importer, _)| importer == module).map(|(_, imported)| imported);
                open.extend(next.filter(|imported| seen.insert(imported)));
            }
            false
        };
        pairs.iter().filter(|(importer, imported)| reaches(imported, importer)).cloned().collect()
    }
}

fn module_path(src: &Path, file: &Path) -> ModulePath {
    let inside = file.strip_prefix(src).expect("a file of the crate").with_extension("");
    let mut path: ModulePath = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if path.last().is_some_and(|last| ["lib", "main", "mod"].contains(&last.as_str())) {
        path.pop();
    }
    path
}

/// The names that a module gives on from its children: each with the child.
fn names_of(code: &Code, path: &ModulePath) -> BTreeMap<String, ModulePath> {
    let mut names = BTreeMap::new();
    let mut tokens = code.tokens.iter().peekable();
    while let Some(token) = tokens.next() {
        if is_ident(token, "use") {
            let statement: Vec<TokenTree> =
                tokens.by_ref().take_while(|token| !is_punct(token, ';')).cloned().collect();
            let mut found = Vec::new();
            branches(&statement, &Vec::new(), &mut found);
            for mut branch in found {
                if branch.first().is_some_and(|first| first == "self") {
                    branch.remove(0);
                }
                if let Some(name) = branch.last().cloned()
                    && branch.len() > 1
                    && !["crate", "super"].contains(&branch[0].as_str())
                {
                    names.insert(name, [path.as_slice(), &branch].concat());
                }
            }
        }
    }
    names
}

/// Every path that begins with `crate` or `super`, from the crate's root.
fn paths(tokens: &[TokenTree], module: &ModulePath) -> Vec<ModulePath> {
    let mut found = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        if let TokenTree::Group(group) = token {
            found.extend(paths(&group.stream().into_iter().collect::<Vec<_>>(), module));
        }
        // `super::super` is one path.
        let inside = index >= 2 && is_punct(&tokens[index - 1], ':') && is_punct(&tokens[index - 2], ':');
        if !inside && (is_ident(token, "crate") || is_ident(token, "super")) {
            let mut named = Vec::new();
            branches(&tokens[index..], &Vec::new(), &mut named);
            found.extend(named.into_iter().map(|path| from_root(&path, module)));
        }
    }
    found
}

/// The paths that begin here: one, or with braces as many as there are in them.
fn branches(tokens: &[TokenTree], before: &ModulePath, found: &mut Vec<ModulePath>) {
    let mut path = before.clone();
    let mut rest = tokens;
    loop {
        match rest {
            [TokenTree::Ident(name), ..] => {
                path.push(name.to_string());
                rest = &rest[1..];
            }
            [TokenTree::Group(group), ..] if group.delimiter() == Delimiter::Brace => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                for part in inner.split(|token| is_punct(token, ',')).filter(|part| !part.is_empty()) {
                    branches(part, &path, found);
                }
                return;
            }
            _ => {}
        }
        match rest {
            [a, b, ..] if is_punct(a, ':') && is_punct(b, ':') => rest = &rest[2..],
            _ => break,
        }
    }
    found.push(path);
}

fn from_root(path: &[String], module: &ModulePath) -> ModulePath {
    let mut base = module.clone();
    let mut rest = path;
    while let [first, after @ ..] = rest {
        match first.as_str() {
            "crate" => base.clear(),
            "super" => drop(base.pop()),
            "self" => {}
            _ => break,
        }
        rest = after;
    }
    base.extend_from_slice(rest);
    base
}

/// Where a path leads if the names in it that modules give on are followed.
fn resolved(
    path: ModulePath,
    files: &BTreeMap<ModulePath, Code>,
    given_on: &BTreeMap<ModulePath, BTreeMap<String, ModulePath>>,
) -> ModulePath {
    for length in 0..path.len() {
        let (module, rest) = path.split_at(length);
        if files.contains_key(&path[..=length]) {
            continue;
        }
        if let Some(target) = given_on.get(module).and_then(|names| names.get(&rest[0])) {
            let longer = [target.as_slice(), &rest[1..]].concat();
            return if longer == path { path } else { resolved(longer, files, given_on) };
        }
        break;
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> Code {
        text.parse().expect("Rust")
    }

    #[test]
    fn comments_and_tests_are_left_out_and_nothing_else() {
        let text = r##"
            //! About it.
            #[cfg(test)]
            mod law;
            /// Documented, "quoted".
            fn shown() { println!("a // b"); } // PICK
            #[cfg(test)]
            #[allow(dead_code)]
            fn only_tested() -> u32 { 3 }
            #[cfg(test)]
            mod tests { fn hidden() { let _ = '"'; } }
            static mut LAST: &str = "}";
        "##;
        let code = code(text);
        assert_eq!(code.text(), r#"fn shown(){println!("a // b");}static mut LAST:&str="}";"#);
        assert_eq!(code.test_modules, ["law"]);
    }

    #[test]
    fn paths_are_found_wherever_they_stand() {
        let code = code(
            "use super::{Space, other::{self, Thing}}; use crate::a::B as C; use std::fmt;
             fn f() { crate::deep::g(super::super::x()); }",
        );
        let found: Vec<String> = paths(&code.tokens, &vec!["search".into(), "astar".into()])
            .into_iter()
            .map(|path| path.join("::"))
            .collect();
        assert_eq!(found, ["search::Space", "search::other::self", "search::other::Thing", "a::B", "deep::g", "x"]);
    }

    #[test]
    fn circles_are_found_through_names_that_are_given_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            fs::write(path, text).expect("written");
        };
        write("lib.rs", "mod a; mod b; mod c; #[cfg(test)] mod law; pub use b::Thing;");
        write("a.rs", "use crate::Thing; #[cfg(test)] mod tests { use crate::c::X; }");
        write("b/mod.rs", "mod one; mod two; pub use one::Thing; use two::Other;");
        write("b/one.rs", "use super::Other; fn f() { crate::c::g() }");
        write("b/two.rs", "");
        write("c.rs", "use crate::b;");
        write("law.rs", "use crate::a;");
        let imports = Imports::of(folder.path());
        let pairs = |pairs: &[(&str, &str)]| -> BTreeSet<(String, String)> {
            pairs.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect()
        };
        assert_eq!(imports.folders[""], pairs(&[("a", "b"), ("b", "c"), ("c", "b")]));
        assert_eq!(imports.folders["b"], pairs(&[("one", "two")]));
        assert_eq!(imports.circles(""), pairs(&[("b", "c"), ("c", "b")]));
        assert!(imports.circles("b").is_empty());
        assert_eq!(imports.modules[""].len(), 3);
    }
}
