//! Colours. They never carry meaning alone, and are left out where standard output is no terminal.

use anstyle::{AnsiColor, Style};
use typelift::words::{Description, Role, Text};

pub(crate) const HEAD: Style = Style::new().bold();
pub(crate) const DIM: Style = Style::new().dimmed();
pub(crate) const GOOD: Style = AnsiColor::Green.on_default();
pub(crate) const BAD: Style = AnsiColor::Red.on_default();
pub(crate) const IMAGINED: Style = AnsiColor::Magenta.on_default();
pub(crate) const ERROR: Style = AnsiColor::Red.on_default().bold();
pub(crate) const WARNING: Style = AnsiColor::Yellow.on_default().bold();
pub(crate) const HINT: Style = AnsiColor::Cyan.on_default().bold();

/// A text with its parts painted by their roles.
pub(crate) fn painted(text: &Text) -> String {
    let painted = text.0.iter().map(|span| {
        let style = match span.role {
            Role::Plain => return span.text.clone(),
            Role::Heading => HEAD,
            Role::Aside => DIM,
            Role::Good => GOOD,
            Role::Bad => BAD,
            Role::Imagined => IMAGINED,
            Role::Warning => WARNING,
        };
        format!("{style}{}{style:#}", span.text)
    });
    painted.collect()
}

/// A description: its name and origin, then its rows, at most 80 columns wide.
pub(crate) fn described(description: &Description) -> String {
    let mut text = format!("{HEAD}{}{HEAD:#}  {}\n", description.name, description.origin);
    for row in &description.rows {
        let body = wrapped(row.words.iter().map(String::as_str), 14, 80);
        text.push_str(&format!("  {DIM}{:<12}{DIM:#}{body}\n", row.label));
    }
    text
}

/// Words put into lines of at most `width` columns, each after `indent` spaces but the first.
pub(crate) fn wrapped<'a>(words: impl IntoIterator<Item = &'a str>, indent: usize, width: usize) -> String {
    let mut text = String::new();
    let mut column = indent;
    for word in words {
        if column > indent && column + 1 + word.len() > width {
            text.push('\n');
            text.push_str(&" ".repeat(indent));
            column = indent;
        } else if column > indent {
            text.push(' ');
            column += 1;
        }
        text.push_str(word);
        column += word.len();
    }
    text
}
