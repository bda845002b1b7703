//! The hierarchy as a matrix, as the paper's figure has it: parents on the vertical axis, children on the horizontal
//! one, a dot where they are connected, its colour the child's depth, and a star at what demonstrations show.

use super::svg::{Anchor, Svg};

/// Width and height of a cell, in pixels.
const CELL: f64 = 17.0;
/// Room for the names of the parents, and of the children.
const NAMES: (f64, f64) = (104.0, 100.0);
/// The number of colours in the palette.
const COLOURS: u32 = 7;

/// A type below another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edge {
    /// The type above.
    pub parent: String,
    /// The type below.
    pub child: String,
    /// The child's steps up to the topmost type, from 1.
    pub depth: u32,
    /// Whether demonstrations show something of exactly the child's type.
    pub seen: bool,
}

/// The matrix of these edges; parents and children in the order in which they are met.
pub fn matrix(edges: &[Edge]) -> String {
    let mut parents: Vec<&str> = Vec::new();
    for edge in edges {
        if !parents.contains(&edge.parent.as_str()) {
            parents.push(&edge.parent);
        }
    }
    let (left, top) = (NAMES.0 + 12.0, 46.0);
    let (width, height) = (CELL * edges.len() as f64, CELL * parents.len() as f64);
    let total = (left + width + 14.0, top + height + NAMES.1 + 50.0);
    let mut svg = Svg::new(total.0.max(330.0), total.1, "The hierarchy of types: parents against children");
    svg.text("strong", (10.0, 18.0), Anchor::Start, "The hierarchy of types");
    svg.text("small mute", (10.0, 35.0), Anchor::Start, "parents");
    for (row, parent) in parents.iter().enumerate() {
        let y = top + CELL * (row as f64 + 0.5);
        svg.line("grid", (left, y), (left + width, y));
        svg.text("small", (left - 6.0, y + 4.0), Anchor::End, parent);
    }
    for (column, edge) in edges.iter().enumerate() {
        let x = left + CELL * (column as f64 + 0.5);
        svg.line("grid", (x, top), (x, top + height));
        let star = if edge.seen { "*" } else { "" };
        let name = format!("{}{star}", edge.child);
        let class = if edge.seen { "small strong" } else { "small" };
        svg.turned_text(class, (x + 4.0, top + height + 6.0), Anchor::End, -90.0, &name);
    }
    for (column, edge) in edges.iter().enumerate() {
        let row = parents.iter().position(|parent| *parent == edge.parent).unwrap_or(0);
        let centre = (left + CELL * (column as f64 + 0.5), top + CELL * (row as f64 + 0.5));
        svg.open(&format!("{} below {}, depth {}", edge.child, edge.parent, edge.depth));
        svg.circle(&format!("f{}", edge.depth.saturating_sub(1) % COLOURS), centre, 6.0);
        svg.close();
    }
    let below = top + height + NAMES.1;
    svg.text(
        "small mute",
        (left + width / 2.0, below + 8.0),
        Anchor::Middle,
        "children (* seen in the demonstrations)",
    );
    legend(&mut svg, edges, below + 32.0);
    svg.finish()
}

/// The colours of the depths.
fn legend(svg: &mut Svg, edges: &[Edge], y: f64) {
    svg.text("small mute", (10.0, y + 4.0), Anchor::Start, "depth");
    let deepest = edges.iter().map(|edge| edge.depth).max().unwrap_or(0);
    for depth in 1..=deepest {
        let x = 56.0 + 36.0 * f64::from(depth - 1);
        svg.circle(&format!("f{}", (depth - 1) % COLOURS), (x, y), 6.0);
        svg.text("small", (x + 10.0, y + 4.0), Anchor::Start, &depth.to_string());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(child: &str, parent: &str, depth: u32, seen: bool) -> Edge {
        Edge { parent: parent.to_owned(), child: child.to_owned(), depth, seen }
    }

    #[test]
    fn a_small_hierarchy() {
        let edges = [
            edge("tool", "thing", 1, false),
            edge("food", "thing", 1, false),
            edge("knife", "tool", 2, true),
            edge("fruit", "food", 2, false),
            edge("apple", "fruit", 3, true),
            edge("pear", "fruit", 3, false),
        ];
        insta::assert_snapshot!(matrix(&edges));
    }

    #[test]
    fn nothing_at_all() {
        assert!(matrix(&[]).ends_with("</svg>\n"));
    }
}
