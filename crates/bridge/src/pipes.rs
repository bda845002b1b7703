//! The threads that read and write a child's pipes, so that neither a silent nor a deaf child holds anybody up.
//!
//! The threads end when their pipe does. None of them is waited for without limit: a process that left the group may
//! keep a pipe open.

use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::sync::mpsc::{self, Receiver, Sender, SyncSender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crate::error::shorten;
use crate::process::Pipes;

/// Lines of standard error that are kept for error messages.
const KEPT: usize = 8;

/// Bytes of a line of standard error after which it is broken.
const PIECE: u64 = 16 << 10;

/// What is heard of a child.
#[derive(Debug)]
pub(crate) enum Heard {
    /// A line of its output.
    Line(Vec<u8>),
    /// A line that is too long: its beginning. Nothing more is read.
    TooLong(String),
    /// Its output is closed.
    OutputClosed,
    /// Its input is closed.
    InputClosed,
}

/// Somebody who is told each line of a child's standard error.
pub(crate) type Sink = Box<dyn FnMut(&str) + Send>;

/// The ends of the threads that a conversation uses.
#[derive(Debug)]
pub(crate) struct Conversation {
    /// Where requests go; `None` closes the child's input.
    pub(crate) requests: Option<Sender<Vec<u8>>>,
    pub(crate) heard: Receiver<Heard>,
    pub(crate) stderr: Stderr,
}

impl Conversation {
    /// Starts the threads. Lines of standard error are handed to `sink` with `[name]` before them.
    pub(crate) fn start(pipes: Pipes, name: &str, line_limit: usize, sink: Sink) -> io::Result<Self> {
        let Pipes { stdin, stdout, stderr } = pipes;
        let (requests, to_write) = mpsc::channel();
        // A rendezvous: a child that talks without being asked fills its pipe, not our memory.
        let (tell, heard) = mpsc::sync_channel(0);
        let tell_too = tell.clone();
        let thread = |name: &str| thread::Builder::new().name(format!("environment {name}"));
        thread("input").spawn(move || write(stdin, &to_write, &tell_too))?;
        thread("output").spawn(move || read(BufReader::new(stdout), line_limit, &tell))?;
        let shared = Arc::new(Mutex::new(LastLines { name: name.to_owned(), last: VecDeque::new() }));
        let (ending, ended) = mpsc::channel();
        let theirs = Arc::clone(&shared);
        thread("errors").spawn(move || pass_on(BufReader::new(stderr), &theirs, sink, ending))?;
        Ok(Self { requests: Some(requests), heard, stderr: Stderr { shared, ended } })
    }
}

/// Writes requests until there are no more; if that fails, the child does not read any more.
fn write(mut stdin: impl Write, requests: &Receiver<Vec<u8>>, tell: &SyncSender<Heard>) {
    for request in requests {
        if stdin.write_all(&request).and_then(|()| stdin.flush()).is_err() {
            // The receiver is gone if the bridge is.
            let _ = tell.send(Heard::InputClosed);
            return;
        }
    }
}

/// Reads lines until there are no more.
fn read(mut stdout: impl BufRead, limit: usize, tell: &SyncSender<Heard>) {
    loop {
        let mut line = Vec::new();
        let read = (&mut stdout).take(limit as u64 + 1).read_until(b'\n', &mut line);
        let heard = match read {
            Ok(0) | Err(_) => Heard::OutputClosed,
            Ok(_) if line.len() > limit && line.last() != Some(&b'\n') => {
                line.truncate(1 << 10);
                Heard::TooLong(shorten(&String::from_utf8_lossy(&line)))
            }
            Ok(_) if line.trim_ascii().is_empty() => continue,
            Ok(_) => Heard::Line(line),
        };
        let last = !matches!(heard, Heard::Line(_));
        if tell.send(heard).is_err() || last {
            return;
        }
    }
}

/// The last lines that a child wrote to standard error.
#[derive(Debug)]
struct LastLines {
    /// What the child is called.
    name: String,
    last: VecDeque<String>,
}

fn lock(lines: &Mutex<LastLines>) -> MutexGuard<'_, LastLines> {
    lines.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Passes on lines of standard error, and keeps the last ones. `_ending` is dropped at the end.
fn pass_on(mut stderr: impl BufRead, lines: &Mutex<LastLines>, mut sink: Sink, _ending: Sender<()>) {
    loop {
        let mut line = Vec::new();
        match (&mut stderr).take(PIECE).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return,
            Ok(_) => {}
        }
        let text = String::from_utf8_lossy(&line);
        let text = text.trim_end_matches(['\n', '\r']);
        let shown = {
            let mut lines = lock(lines);
            if lines.last.len() == KEPT {
                lines.last.pop_front();
            }
            lines.last.push_back(shorten(text));
            format!("[{}] {text}", lines.name)
        };
        sink(&shown);
    }
}

/// What a child writes to standard error.
#[derive(Debug)]
pub(crate) struct Stderr {
    shared: Arc<Mutex<LastLines>>,
    ended: Receiver<()>,
}

impl Stderr {
    /// Puts this name before lines from now on.
    pub(crate) fn rename(&self, name: &str) {
        name.clone_into(&mut lock(&self.shared).name);
    }

    /// Waits until all of it was passed on, at most so long.
    pub(crate) fn finish(&self, limit: Duration) {
        let _ = self.ended.recv_timeout(limit);
    }

    /// The last lines.
    pub(crate) fn last(&self) -> Vec<String> {
        lock(&self.shared).last.iter().filter(|line| !line.is_empty()).cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(output: &'static [u8], limit: usize) -> Vec<String> {
        let (tell, heard) = mpsc::sync_channel(0);
        thread::spawn(move || read(output, limit, &tell));
        let text = |line: Vec<u8>| String::from_utf8_lossy(&line).into_owned();
        heard
            .iter()
            .map(|heard| match heard {
                Heard::Line(line) => text(line),
                other => format!("{other:?}"),
            })
            .collect()
    }

    #[test]
    fn lines_and_their_limit() {
        assert_eq!(heard(b"a\n\n  \r\nb", 4), ["a\n", "b", "OutputClosed"]);
        assert_eq!(heard(b"1234\n12345\n1\n", 4), ["1234\n", "TooLong(\"12345\")"]);
    }

    #[test]
    fn lines_of_standard_error() {
        let last = Mutex::new(LastLines { name: "shop".to_owned(), last: VecDeque::new() });
        let (lines, passed_on) = mpsc::channel();
        let (ending, ended) = mpsc::channel();
        let sink = Box::new(move |line: &str| lines.send(line.to_owned()).expect("received"));
        pass_on(&b"one\r\n\ntwo\xff\n"[..], &last, sink, ending);
        assert_eq!(passed_on.iter().collect::<Vec<_>>(), ["[shop] one", "[shop] ", "[shop] two\u{fffd}"]);
        assert!(ended.recv().is_err());
        assert_eq!(lock(&last).last, ["one", "", "two\u{fffd}"]);
    }
}
