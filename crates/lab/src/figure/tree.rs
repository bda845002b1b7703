//! The hierarchy as an indented tree, with the actions' parameters at the types that they were generalized to.

use super::svg::{Anchor, Svg};

/// Pixels from line to line, and from a level to the next.
const LINE: f64 = 18.0;
const INDENT: f64 = 18.0;
/// The characters of a list before it is broken.
const WRAP: usize = 62;

/// A type in the tree.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Branch {
    /// Its name.
    pub name: String,
    /// Steps up to the topmost type, which has 0.
    pub depth: u32,
    /// Whether demonstrations show something of exactly this type.
    pub seen: bool,
    /// Parameters that were generalized to it, a line each.
    pub raised: Vec<String>,
    /// Parameters that have it as it was seen.
    pub kept: Vec<String>,
}

/// One line of the figure.
struct Row<'a> {
    branch: usize,
    class: &'a str,
    text: String,
}

/// The tree of branches in depth-first order.
pub fn tree(branches: &[Branch]) -> String {
    let rows = rows(branches);
    let longest = rows.iter().map(|row| indent(branches[row.branch].depth) + width_of(&row.text)).fold(400.0, f64::max);
    let height = 62.0 + LINE * rows.len() as f64;
    let mut svg = Svg::new(longest + 20.0, height, "The hierarchy of types, and what was generalized to each");
    svg.text("strong", (10.0, 18.0), Anchor::Start, "What the actions' parameters were generalized to");
    svg.text(
        "small mute",
        (10.0, 35.0),
        Anchor::Start,
        "* seen in the demonstrations; ▲ risen to this type, from those named;",
    );
    svg.text("small mute", (10.0, 49.0), Anchor::Start, "other parameters kept the type that was seen");
    let line_of = |branch: usize| rows.iter().position(|row| row.branch == branch).unwrap_or(0);
    let y_of = |line: usize| 70.0 + LINE * line as f64;
    for (index, branch) in branches.iter().enumerate() {
        let y = y_of(line_of(index)) - 4.0;
        let parent = branches[..index].iter().rposition(|above| above.depth < branch.depth);
        if let Some(parent) = parent {
            let x = indent(branches[parent].depth) + 5.0;
            let siblings = branches[index + 1..].iter().take_while(|later| later.depth > branches[parent].depth);
            if !siblings.into_iter().any(|later| later.depth == branch.depth) {
                svg.line("axis", (x, y_of(line_of(parent)) + 2.0), (x, y));
            }
            svg.line("axis", (x, y), (indent(branch.depth) - 3.0, y));
        }
    }
    for (line, row) in rows.iter().enumerate() {
        let first = line_of(row.branch) == line;
        let x = indent(branches[row.branch].depth) + if first { 0.0 } else { 20.0 };
        svg.text(row.class, (x, y_of(line)), Anchor::Start, &row.text);
        if row.text.starts_with('▲') {
            svg.rect("f1", (x - 8.0, y_of(line) - 10.0), 3.0, 13.0);
        }
    }
    svg.finish()
}

fn indent(depth: u32) -> f64 {
    10.0 + INDENT * f64::from(depth)
}

/// About the width of a line, in pixels.
fn width_of(text: &str) -> f64 {
    24.0 + text.chars().count() as f64 * 6.8
}

fn rows(branches: &[Branch]) -> Vec<Row<'static>> {
    let mut rows = Vec::new();
    for (index, branch) in branches.iter().enumerate() {
        let star = if branch.seen { "*" } else { "" };
        let class = if branch.raised.is_empty() { "" } else { "strong" };
        rows.push(Row { branch: index, class, text: format!("{}{star}", branch.name) });
        for text in &branch.raised {
            rows.push(Row { branch: index, class: "mono", text: format!("▲ {text}") });
        }
        for text in wrapped(&branch.kept) {
            rows.push(Row { branch: index, class: "mono mute", text });
        }
    }
    rows
}

/// The list in lines of at most [`WRAP`] characters, broken between its entries.
fn wrapped(list: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (index, entry) in list.iter().enumerate() {
        let entry = if index + 1 < list.len() { format!("{entry},") } else { entry.clone() };
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + entry.chars().count() <= WRAP => {
                line.push(' ');
                line.push_str(&entry);
            }
            _ => lines.push(entry),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_tree() {
        let branch = |name: &str, depth, seen| Branch { name: name.to_owned(), depth, seen, ..Branch::default() };
        let mut branches =
            [branch("thing", 0, false), branch("food", 1, false), branch("leek", 2, true), branch("tool", 1, true)];
        branches[1].raised = vec!["CUT-tool-food ?x1  from leek, pear".to_owned()];
        branches[3].kept = (0..6).map(|i| format!("CUT-tool-food-{i} ?x0")).collect();
        insta::assert_snapshot!(tree(&branches));
    }

    #[test]
    fn lists_are_broken_between_entries() {
        let list: Vec<String> = (0..8).map(|i| format!("entry number {i}")).collect();
        let lines = wrapped(&list);
        assert_eq!(lines.len(), 3, "{lines:?}");
        assert!(lines.iter().all(|line| line.chars().count() <= WRAP));
        assert_eq!(lines.join(" "), list.join(", "));
        assert!(wrapped(&[]).is_empty());
    }
}
