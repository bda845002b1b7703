//! The lines of a file, one at a time, none of them longer than a limit.

use std::io::{BufRead, Read};
use std::path::{Path, PathBuf};

use typelift_model::SourceId;

use crate::FileError;
use crate::source::SourceHasher;
use crate::text_file::not_utf8;

/// Bytes that a line may have: 64 MB.
pub const LINE_LIMIT: usize = 64 << 20;

#[derive(Debug)]
pub(crate) struct LineReader<R> {
    path: PathBuf,
    input: R,
    limit: usize,
    line: usize,
    buffer: Vec<u8>,
    read: SourceHasher,
}

/// A line without its end.
#[derive(Debug)]
pub(crate) struct Line<'a> {
    /// Its number, from 1.
    pub(crate) number: usize,
    pub(crate) text: &'a str,
    /// Whether a line feed followed; only the last line may lack it.
    pub(crate) complete: bool,
}

impl<R: BufRead> LineReader<R> {
    pub(crate) fn new(path: &Path, input: R, limit: usize) -> Self {
        Self { path: path.to_owned(), input, limit, line: 0, buffer: Vec::new(), read: SourceHasher::default() }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The number of the line read last.
    pub(crate) fn line(&self) -> usize {
        self.line
    }

    /// Which source the lines read so far are.
    pub(crate) fn source(&self) -> SourceId {
        self.read.clone().finish()
    }

    /// The next line. A line that is too long is refused when the limit is reached, not at its end.
    pub(crate) fn next_line(&mut self) -> Result<Option<Line<'_>>, FileError> {
        self.buffer.clear();
        let mut limited = (&mut self.input).take(self.limit as u64 + 1);
        let read = limited.read_until(b'\n', &mut self.buffer).map_err(|e| FileError::from_io(&self.path, &e))?;
        if read == 0 {
            return Ok(None);
        }
        self.line += 1;
        self.read.update(&self.buffer);
        let complete = self.buffer.last() == Some(&b'\n');
        if !complete && self.buffer.len() > self.limit {
            let what = format!("this line is longer than {}", shown_bytes(self.limit));
            let hint = "Leave out of the states what gives no atoms, such as images.".to_owned();
            return Err(FileError::at_line(&self.path, self.line, what).with_hint(hint));
        }
        if !complete
            && let Err(error) = str::from_utf8(&self.buffer)
            && error.error_len().is_none()
        {
            // What was cut off may end in the middle of a character.
            self.buffer.truncate(error.valid_up_to());
        }
        let text = str::from_utf8(&self.buffer).map_err(|e| not_utf8(&self.path, self.line, e.valid_up_to()))?;
        let text = if self.line == 1 { text.strip_prefix('\u{FEFF}').unwrap_or(text) } else { text };
        Ok(Some(Line { number: self.line, text: text.trim_end_matches(['\n', '\r']), complete }))
    }
}

fn shown_bytes(bytes: usize) -> String {
    if bytes >= 1 << 20 { format!("{} MB", bytes >> 20) } else { format!("{bytes} bytes") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8], limit: usize) -> Vec<Result<(usize, String, bool), String>> {
        let mut reader = LineReader::new(Path::new("f"), text, limit);
        let mut out = Vec::new();
        loop {
            match reader.next_line() {
                Ok(None) => return out,
                Ok(Some(line)) => out.push(Ok((line.number, line.text.to_owned(), line.complete))),
                Err(error) => {
                    out.push(Err(error.to_string()));
                    return out;
                }
            }
        }
    }

    #[test]
    fn ends_of_lines() {
        let expected = [(1, "a", true), (2, "", true), (3, "b", false)];
        let expected: Vec<_> = expected.map(|(n, t, c)| Ok((n, t.to_owned(), c))).to_vec();
        assert_eq!(lines(b"\xEF\xBB\xBFa\r\n\nb", 10), expected);
        assert!(lines(b"", 10).is_empty());
    }

    #[test]
    fn long_lines_and_other_encodings_are_refused() {
        assert_eq!(lines(b"1234\n", 4)[0], Ok((1, "1234".to_owned(), true)));
        assert_eq!(lines(b"ok\n12345\n", 4)[1], Err("f:2: this line is longer than 4 bytes".to_owned()));
        assert_eq!(
            lines(b"ok\na\xFFb", 9)[1],
            Err("f:2:2: this is not UTF-8 text from byte 2 of the line on".to_owned())
        );
    }

    #[test]
    fn the_limit_of_traces() {
        let endless = std::io::BufReader::new(std::io::repeat(b'x'));
        let error = LineReader::new(Path::new("f"), endless, LINE_LIMIT).next_line().expect_err("too long");
        assert_eq!(error.to_string(), "f:1: this line is longer than 64 MB");
    }
}
