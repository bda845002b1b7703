//! The JSON Schemas in `docs/schemas` are those of the types. With `UPDATE_SCHEMAS=1` they are rewritten.

use std::fs;
use std::path::Path;

#[test]
fn the_schemas_are_those_of_the_types() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/schemas");
    let update = std::env::var_os("UPDATE_SCHEMAS").is_some();
    let mut expected = Vec::new();
    for (name, schema) in typelift::schemas() {
        let file = format!("{name}.schema.json");
        let (path, text) = (folder.join(&file), format!("{schema:#}\n"));
        if update {
            fs::create_dir_all(&folder).expect("made");
            fs::write(&path, text).expect("written");
        } else {
            let found = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(found == text, "{file} is stale: UPDATE_SCHEMAS=1 cargo test -p typelift-cli --test schemas");
        }
        expected.push(file);
    }
    let entries = fs::read_dir(&folder).expect("the schemas");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    expected.sort();
    assert_eq!(names, expected);
}
