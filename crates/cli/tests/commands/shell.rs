//! `completions` and `man`.

use crate::common::Folder;

#[test]
fn every_shell_learns_every_command() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.run(&format!("completions {shell}"));
        script.succeeds();
        for word in ["typelift", "learn", "validate", "growth", "not-strict"] {
            assert!(script.out.contains(word), "{shell}: {word}");
        }
        assert!(!script.out.contains("--plain"), "{shell}: a former name");
    }
}

#[test]
fn bash_takes_its_script() {
    let folder = Folder::new();
    folder.write("typelift.bash", folder.run("completions bash").out);
    let Ok(checked) = std::process::Command::new("bash").arg("-n").arg(folder.path("typelift.bash")).output() else {
        return; // There is no bash here.
    };
    assert!(checked.status.success() && checked.stderr.is_empty(), "{checked:?}");
}

#[test]
fn a_page_for_each_command() {
    let folder = Folder::new();
    let page = folder.run("man");
    page.succeeds();
    assert!(page.out.contains(".TH typelift 1") && page.out.contains("typelift\\-plan(1)"), "{page}");
    folder.run("man new/man1").succeeds();
    let pages = crate::common::names(&folder.path("new/man1"));
    for name in ["typelift.1", "typelift-plan.1", "typelift-pddl-check.1", "typelift-lab-table.1"] {
        assert!(pages.contains(&name.to_owned()), "{name}: {pages:?}");
    }
    assert!(!pages.iter().any(|page| page.contains("measure")), "hidden: {pages:?}");
    assert_eq!(folder.read("new/man1/typelift.1"), page.out);
    folder.write("file", "");
    folder.refuses(31, "man file");
}
