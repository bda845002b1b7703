//! The kitchen as a program's side of the environment protocol, over any reader and writer.

use std::io::{self, BufRead, Write};

use serde::Deserialize;
use typelift_model::json_message;
use typelift_world::{Answer, PROTOCOL, Request, RequestBody, Reset, World, WorldError};

use crate::kitchen::Kitchen;

/// The longest line that is read, in bytes.
const LONGEST_LINE: usize = 64 << 20;

/// Answers the requests on `input` line by line until it ends or `close` is asked for. A line that is no request is
/// answered with an error and the conversation goes on; memory is bounded by the longest line allowed, 64 MB.
///
/// # Errors
/// If reading or writing fails.
pub fn serve(input: impl BufRead, output: impl Write) -> io::Result<()> {
    serve_lines(input, output, LONGEST_LINE)
}

fn serve_lines(mut input: impl BufRead, mut output: impl Write, longest: usize) -> io::Result<()> {
    let mut kitchen = Kitchen::new();
    loop {
        let (answer, closes) = match next_line(&mut input, longest)? {
            Line::End => return Ok(()),
            Line::TooLong => (failure(0, format!("the line is longer than {longest} bytes")), false),
            Line::Text(line) if line.trim_ascii().is_empty() => continue,
            Line::Text(line) => match read_request(&line) {
                Ok(request) => (answer(&mut kitchen, &request), request.body == RequestBody::Close),
                Err((id, error)) => (failure(id, error), false),
            },
        };
        serde_json::to_writer(&mut output, &answer)?;
        output.write_all(b"\n")?;
        output.flush()?;
        if closes {
            return Ok(());
        }
    }
}

enum Line {
    Text(Vec<u8>),
    TooLong,
    End,
}

/// The next line, without its end. Of a line that is too long nothing is kept.
fn next_line(input: &mut impl BufRead, longest: usize) -> io::Result<Line> {
    let mut line = Vec::new();
    let (mut too_long, mut started) = (false, false);
    loop {
        let chunk = match input.fill_buf() {
            Ok(chunk) => chunk,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        let at_end = chunk.is_empty();
        started |= !at_end;
        let end = chunk.iter().position(|&byte| byte == b'\n');
        let part = &chunk[..end.unwrap_or(chunk.len())];
        too_long |= line.len() + part.len() > longest;
        if too_long {
            line = Vec::new();
        } else {
            line.extend_from_slice(part);
        }
        let used = end.map_or(chunk.len(), |end| end + 1);
        input.consume(used);
        if end.is_some() || at_end {
            return Ok(match (started, too_long) {
                (false, _) => Line::End,
                (true, true) => Line::TooLong,
                (true, false) => Line::Text(line),
            });
        }
    }
}

/// The request on a line; of what is none the id, 0 if it cannot be made out, and what is wrong with it.
fn read_request(line: &[u8]) -> Result<Request, (u64, String)> {
    /// What is needed to answer at all.
    #[derive(Deserialize)]
    struct Envelope {
        id: u64,
    }
    serde_json::from_slice(line).map_err(|error| {
        let id = serde_json::from_slice::<Envelope>(line).map_or(0, |envelope| envelope.id);
        (id, format!("the line is not a request of {PROTOCOL}: {}", json_message(&error)))
    })
}

fn answer(kitchen: &mut Kitchen, request: &Request) -> Answer {
    let answer = try_answer(kitchen, &request.body).unwrap_or_else(|error| failure(0, error.to_string()));
    Answer { id: request.id, ..answer }
}

fn try_answer(kitchen: &mut Kitchen, body: &RequestBody) -> Result<Answer, WorldError> {
    let done = Answer { ok: true, ..Answer::default() };
    Ok(match body {
        RequestBody::Hello { protocol } if protocol != PROTOCOL => {
            failure(0, format!("this environment speaks {PROTOCOL}, not `{protocol}`"))
        }
        RequestBody::Hello { .. } => Answer { name: Some(kitchen.name()), reset: Some(kitchen.can_reset()), ..done },
        RequestBody::Reset { seed, scenario } => {
            let reset = Reset { seed: *seed, scenario: scenario.clone() };
            Answer { state: Some(kitchen.reset(&reset)?), ..done }
        }
        RequestBody::Observe => Answer { state: Some(kitchen.observe()?), ..done },
        RequestBody::Act { action } => {
            let acted = kitchen.act(action)?;
            Answer { state: Some(acted.scene), executed: Some(acted.executed), reason: acted.reason, ..done }
        }
        RequestBody::Close => {
            kitchen.close()?;
            done
        }
    })
}

fn failure(id: u64, error: String) -> Answer {
    Answer { id, ok: false, error: Some(error), ..Answer::default() }
}

#[cfg(test)]
mod tests {
    use std::io::BufReader;

    use super::*;

    #[test]
    fn a_line_that_is_too_long_is_skipped() {
        let close = r#"{"id":1,"op":"close"}"#;
        let input = format!("{}\n{}\n{close}", "x".repeat(1000), "y".repeat(close.len() + 1));
        for chunk in [1, 7, 4096] {
            let mut output = Vec::new();
            let reader = BufReader::with_capacity(chunk, input.as_bytes());
            serve_lines(reader, &mut output, close.len()).expect("memory cannot fail");
            let text = String::from_utf8(output).expect("JSON");
            let lines: Vec<&str> = text.lines().collect();
            let refused = r#"{"id":0,"ok":false,"error":"the line is longer than 21 bytes"}"#;
            assert_eq!(lines, [refused, refused, r#"{"id":1,"ok":true}"#]);
        }
    }

    #[test]
    fn a_line_of_the_longest_length_is_read() {
        let observe = r#"{"id":1,"op":"observe"}"#;
        let mut output = Vec::new();
        serve_lines(format!("{observe}\n\n").as_bytes(), &mut output, observe.len()).expect("memory cannot fail");
        assert!(String::from_utf8(output).expect("JSON").contains("reset comes first"));
    }

    #[test]
    fn a_closed_output_is_an_error() {
        let result = serve(&b"{\"id\":1,\"op\":\"observe\"}\n"[..], &mut [0_u8; 3][..]);
        assert!(result.is_err());
    }
}
