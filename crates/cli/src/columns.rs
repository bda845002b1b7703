//! Text in aligned columns.

use anstyle::Style;

/// Rows of cells; each column is as wide as its widest cell.
#[derive(Debug, Default)]
pub(crate) struct Columns {
    rows: Vec<Vec<(String, Style)>>,
    right: Vec<usize>,
}

impl Columns {
    /// With these columns, counted from 0, aligned to the right.
    pub(crate) fn with_right(right: &[usize]) -> Self {
        Self { rows: Vec::new(), right: right.to_vec() }
    }

    /// Adds a row.
    pub(crate) fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.styled(cells.into_iter().map(|cell| (cell.into(), Style::new())));
    }

    /// Adds a row, each cell in a style.
    pub(crate) fn styled(&mut self, cells: impl IntoIterator<Item = (String, Style)>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The text: each row after `indent` spaces, two spaces between columns, none at the end of a line.
    pub(crate) fn text(&self, indent: usize) -> String {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or_default();
        let width =
            |column| self.rows.iter().filter_map(move |row| Some(row.get::<usize>(column)?.0.chars().count())).max();
        let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or_default()).collect();
        let mut text = String::new();
        for row in &self.rows {
            let mut line = " ".repeat(indent);
            let mut gap = 0;
            for (column, (cell, style)) in row.iter().enumerate() {
                let padding = widths[column] - cell.chars().count();
                let (before, after) = if self.right.contains(&column) { (padding, 0) } else { (0, padding) };
                if !cell.is_empty() {
                    line += &" ".repeat(gap + before);
                    line += &format!("{style}{cell}{style:#}");
                    gap = 0;
                }
                gap += after + 2 + if cell.is_empty() { before } else { 0 };
            }
            text += line.trim_end();
            text.push('\n');
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_and_lines_end_with_text() {
        let mut columns = Columns::with_right(&[1]);
        columns.row(["a", "number", "c"]);
        columns.row(["long", "1", ""]);
        columns.row(["", "±2", "x"]);
        assert_eq!(columns.text(1), " a     number  c\n long       1\n           ±2  x\n");
    }
}
