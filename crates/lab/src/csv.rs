//! Comma-separated values as spreadsheets and plotting programs read them (RFC 4180, with plain line ends).

/// Rows below a head. What there is no value for is empty.
#[derive(Debug)]
pub struct Csv(String);

impl Csv {
    /// The head.
    pub fn new(columns: &[&str]) -> Self {
        let mut csv = Self(String::new());
        csv.row(columns.iter().map(|column| (*column).to_owned()));
        csv
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        let quoted = |cell: String| {
            if cell.contains(['"', ',', '\n']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell }
        };
        let cells: Vec<String> = cells.into_iter().map(quoted).collect();
        self.0 += &cells.join(",");
        self.0.push('\n');
    }

    /// The file.
    pub fn into_text(self) -> String {
        self.0
    }
}

/// A cell that may be empty.
pub(crate) fn optional(value: Option<impl ToString>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

/// Seconds to the microsecond.
pub(crate) fn seconds(value: Option<f64>) -> String {
    value.map(|value| format!("{value:.6}")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_needs_quotes_gets_them() {
        let mut csv = Csv::new(&["a", "b"]);
        csv.row(["x, y".to_owned(), "say \"z\"".to_owned()]);
        csv.row([optional(Some(1)), optional(None::<u8>)]);
        assert_eq!(csv.into_text(), "a,b\n\"x, y\",\"say \"\"z\"\"\"\n1,\n");
    }
}
