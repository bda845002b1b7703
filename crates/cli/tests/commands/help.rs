//! Every command explains itself within 80 columns.

use crate::common::Folder;

#[test]
fn every_command_has_help() {
    let commands = [
        "",
        "demo",
        "learn",
        "show",
        "diff",
        "plan",
        "export",
        "run",
        "memory",
        "memory show",
        "memory log",
        "memory export",
        "memory merge",
        "memory check",
        "memory rescue",
        "memory forget",
        "check-env",
        "validate",
        "pddl",
        "pddl check",
        "pddl format",
        "kitchen",
        "kitchen export",
        "kitchen serve",
        "kitchen replay",
        "kitchen draw",
        "lab",
        "lab table",
        "lab demonstrations",
        "lab faults",
        "lab hierarchy",
        "lab growth",
        "lab lifelong",
        "lab report",
        "completions",
        "man",
    ];
    let folder = Folder::new();
    for command in commands {
        let help = folder.run(&format!("{command} --help"));
        help.succeeds();
        assert_eq!(help.err, "", "{command}");
        assert!(help.out.contains("typelift "), "{command}: no example");
        for line in help.out.lines() {
            assert!(line.chars().count() <= 80, "{command}: {line}");
        }
        let name = format!("help {command}").trim_end().replace(' ', "-");
        insta::assert_snapshot!(name, help.out);
    }
}

#[test]
fn help_may_come_first() {
    let folder = Folder::new();
    for command in ["", "plan", "lab table"] {
        let asked = folder.run(&format!("help {command}"));
        asked.succeeds();
        assert_eq!(asked.out, folder.run(&format!("{command} --help")).out, "{command}");
    }
}

#[test]
fn the_version() {
    let version = Folder::new().run("--version");
    version.succeeds();
    assert_eq!(version.out, format!("typelift {}\n", env!("CARGO_PKG_VERSION")));
}
