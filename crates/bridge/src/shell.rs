//! Command lines that only a shell would understand: no shell reads those of environments and planners.

/// Commands that are a part of shells, and no programs.
const BUILTINS: [&str; 13] =
    ["alias", "cd", "conda", "eval", "exec", "export", "pushd", "set", "shopt", "source", "ulimit", "umask", "unset"];

/// What to do about a command line that could not be started, if it is one for a shell.
pub(crate) fn shell_hint(command_line: &str) -> Option<String> {
    let sign = sign_for_a_shell(command_line)?;
    Some(format!("No shell reads the command line, and `{sign}` is for a shell: write sh -c '…' around it all."))
}

/// The first word, or part of one, that means something to a shell only.
fn sign_for_a_shell(command_line: &str) -> Option<&str> {
    let words = || command_line.split_whitespace();
    let builtin = words().next().filter(|word| BUILTINS.contains(word) || *word == ".");
    let operator = |word: &&str| matches!(*word, "|" | "||" | "&" | "&&" | ";" | "<" | ">" | ">>" | "2>" | "2>&1");
    let expanded = |word: &&str| word.contains('$') || word.contains('`') || word.starts_with('~');
    let sequence = |word: &&str| word.ends_with(';') || word.contains("&&") || word.contains('|');
    builtin.or_else(|| words().find(|word| operator(word) || expanded(word) || sequence(word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_only_a_shell_understands() {
        for (command, sign) in [
            ("cd robot && python3 robot.py", Some("cd")),
            (". venv/bin/activate", Some(".")),
            ("robot | tee log", Some("|")),
            ("robot&&other", Some("robot&&other")),
            ("$HOME/robot", Some("$HOME/robot")),
            ("~/robot --fast", Some("~/robot")),
            ("robot 2> log", Some("2>")),
            ("./robot --name=a_b", None),
            ("python3 robot.py", None),
        ] {
            assert_eq!(sign_for_a_shell(command), sign, "{command}");
        }
    }
}
