//! Comma-separated values (RFC 4180, lines ending in a line feed).

/// A table; values with commas, quotes or line feeds are quoted.
pub(crate) fn csv(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let header = header.iter().map(|name| (*name).to_owned()).collect();
    let lines = std::iter::once(header).chain(rows);
    lines.map(|row: Vec<String>| row.iter().map(|v| quoted(v)).collect::<Vec<_>>().join(",") + "\n").collect()
}

fn quoted(value: &str) -> String {
    if value.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", value.replace('"', "\"\""))
    } else {
        value.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_needs_quotes_has_them() {
        let rows = [vec!["1".to_owned(), "a,b".to_owned()], vec!["2".to_owned(), "say \"x\"".to_owned()]];
        assert_eq!(csv(&["n", "text"], rows), "n,text\n1,\"a,b\"\n2,\"say \"\"x\"\"\"\n");
    }
}
