//! Pieces of HTML.

use std::fmt::Write;

use crate::figure::escape;

/// A table; numbers stand right. Cells are text.
pub(super) fn table(class: &str, head: &[&str], numbers: &[usize], rows: &[Vec<String>]) -> String {
    let n = |column: usize| if numbers.contains(&column) { " class=\"n\"" } else { "" };
    let mut html = format!("<div class=\"wide\"><table class=\"{class}\"><thead><tr>");
    for (column, name) in head.iter().enumerate() {
        let _ = write!(html, "<th{}>{}</th>", n(column), escape(name).replace('+', "+<wbr>"));
    }
    html.push_str("</tr></thead><tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (column, cell) in row.iter().enumerate() {
            let _ = write!(html, "<td{}>{}</td>", n(column), escape(cell));
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>\n");
    html
}

/// A paragraph of text.
pub(super) fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// A figure within a page: its style is the page's.
pub(super) fn embedded(svg: &str) -> String {
    match (svg.find("<style>"), svg.find("</style>")) {
        (Some(from), Some(to)) => format!("{}{}", &svg[..from], svg[to + "</style>".len()..].trim_start()),
        _ => svg.to_owned(),
    }
}

/// Figures side by side where there is room.
pub(super) fn figures(svgs: impl IntoIterator<Item = String>) -> String {
    let inner: String = svgs.into_iter().map(|svg| format!("<div>{}</div>\n", embedded(&svg))).collect();
    format!("<div class=\"figures\">\n{inner}</div>\n")
}

/// A figure too wide for a phone.
pub(super) fn wide_figure(svg: &str) -> String {
    format!("<div class=\"wide\">{}</div>\n", embedded(svg))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_text() {
        let html = table("t", &["a", "b"], &[1], &[vec!["<x>".to_owned(), "1".to_owned()]]);
        assert!(html.contains("<td>&lt;x&gt;</td><td class=\"n\">1</td>"), "{html}");
    }

    #[test]
    fn a_figure_leaves_its_style_to_the_page() {
        assert_eq!(embedded("<svg><style>x</style>\n<g/></svg>"), "<svg><g/></svg>");
        assert_eq!(embedded("<svg/>"), "<svg/>");
    }
}
