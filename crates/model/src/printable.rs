//! Messages that repeat what a file says.

/// The text with a replacement character for each control character: a terminal would obey some of these.
pub fn printable(text: impl Into<String>) -> String {
    let text = text.into();
    if text.contains(char::is_control) {
        text.chars().map(|c| if c.is_control() { '\u{FFFD}' } else { c }).collect()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_for_a_terminal_to_obey() {
        assert_eq!(printable("\u{1B}[31mé\r\n\u{85}"), "\u{FFFD}[31mé\u{FFFD}\u{FFFD}\u{FFFD}");
    }
}
