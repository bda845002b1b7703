//! The conversation: one request, one answer, each within its time.

use std::collections::BTreeSet;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use typelift_model::{GroundCall, Symbol};
use typelift_world::{
    Acted, Answer, LINE_LIMIT, PROTOCOL, Request, RequestBody, Reset, Scene, UnreadKey, World, WorldError,
    unread_keys_of_answer,
};

use crate::answer::{Unreadable, read_answer};
use crate::error::{BridgeError, Failure, shorten};
use crate::options::Options;
use crate::pipes::{Conversation, Heard};
use crate::process::Process;

/// How long a child whose pipes are closed may take to end by itself, so that its exit status can be told.
const LAST_WORDS: Duration = Duration::from_millis(500);

/// The time between two looks at whether a silent child has ended.
const GLANCE: Duration = Duration::from_millis(250);

/// How long a child that is asked to end has before it is killed, if it was not closed properly.
const GRACE: Duration = Duration::from_millis(300);

/// An environment in a child process. Dropping it ends the child and everything that the child started.
#[derive(Debug)]
pub struct Bridge {
    name: String,
    can_reset: bool,
    instance: Option<Symbol>,
    options: Options,
    process: Arc<Process>,
    conversation: Conversation,
    last_id: u64,
    /// Requests given up: their answers, should they come, are skipped.
    unanswered: BTreeSet<u64>,
    /// Why nothing can be asked any more.
    over: Option<String>,
    /// Keys of entities that nothing reads, each once.
    unread_keys: Vec<UnreadKey>,
}

/// Ends a bridge's child from another thread, for instance when the user interrupts. A call that waits for an answer
/// gets an error at once.
#[derive(Debug, Clone)]
pub struct Stopper(Arc<Process>);

impl Stopper {
    /// Ends the child and everything that it started.
    pub fn stop(&self) {
        self.0.stop(GRACE);
    }
}

impl Bridge {
    /// Starts a program and asks who it is. The command line is split into words as a shell would, but no shell runs
    /// it. Each line that the program writes to standard error is handed to `stderr`, in another thread, as
    /// `[name] line`.
    ///
    /// # Errors
    /// [`BridgeError`] if it cannot be started, or is not an environment.
    pub fn spawn(
        command_line: &str,
        options: Options,
        stderr: impl FnMut(&str) + Send + 'static,
    ) -> Result<Self, BridgeError> {
        Self::spawn_stoppable(command_line, options, stderr, |_| ())
    }

    /// The same, with a handle that can stop it before it has said what it is.
    ///
    /// # Errors
    /// [`BridgeError`] if it cannot be started, or is not an environment, or was stopped.
    pub fn spawn_stoppable(
        command_line: &str,
        options: Options,
        stderr: impl FnMut(&str) + Send + 'static,
        started: impl FnOnce(Stopper),
    ) -> Result<Self, BridgeError> {
        let wrong = |problem| {
            BridgeError::new(command_line, Failure::CommandLine { command: command_line.to_owned(), problem })
        };
        let words = shlex::split(command_line).ok_or_else(|| wrong("ends within a quotation"))?;
        let (program, args) = words.split_first().ok_or_else(|| wrong("names no program"))?;
        let not_started = |error: std::io::Error| {
            let (program, message, kind) = (program.clone(), error.to_string(), error.kind());
            let command = command_line.to_owned();
            BridgeError::new(command_line, Failure::NotStarted { program, message, kind, command })
        };
        let mut command = Command::new(program);
        command.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let (process, pipes) = Process::start(&mut command).map_err(not_started)?;
        let short_name = program.rsplit(['/', '\\']).next().unwrap_or(program);
        let conversation = Conversation::start(pipes, short_name, LINE_LIMIT, Box::new(stderr)).map_err(not_started)?;
        let mut bridge = Self {
            name: shorten(command_line),
            can_reset: false,
            instance: None,
            options,
            process: Arc::new(process),
            conversation,
            last_id: 0,
            unanswered: BTreeSet::new(),
            over: None,
            unread_keys: Vec::new(),
        };
        started(bridge.stopper());
        bridge.hello()?;
        Ok(bridge)
    }

    /// A handle with which another thread can end the child.
    pub fn stopper(&self) -> Stopper {
        Stopper(Arc::clone(&self.process))
    }

    fn hello(&mut self) -> Result<(), BridgeError> {
        let (sent, line) = self.ask(RequestBody::Hello { protocol: PROTOCOL.to_owned() })?;
        let fail = |failure| self.error(failure, Some(&sent), Some(&line.text));
        let protocol = serde_json::from_slice::<serde_json::Value>(&line.text).ok();
        let protocol = protocol.as_ref().and_then(|answer| answer.get("protocol")?.as_str());
        if let Some(other) = protocol.filter(|&protocol| protocol != PROTOCOL) {
            return Err(fail(Failure::Protocol(other.to_owned())));
        }
        let missing = |field| fail(Failure::Missing { op: "hello", field });
        let name = line.answer.name.as_ref().ok_or_else(|| missing("name"))?;
        self.can_reset = line.answer.reset.ok_or_else(|| missing("reset"))?;
        self.name.clone_from(name);
        self.instance = line.answer.instance;
        self.conversation.stderr.rename(name);
        Ok(())
    }

    fn error(&self, failure: Failure, sent: Option<&str>, came_back: Option<&[u8]>) -> BridgeError {
        BridgeError {
            sent: sent.map(shorten),
            came_back: came_back.map(|line| shorten(&String::from_utf8_lossy(line))),
            ..BridgeError::new(&self.name, failure)
        }
    }

    /// Sends a request and waits for its answer; also what was sent.
    fn ask(&mut self, body: RequestBody) -> Result<(String, Line), BridgeError> {
        if let Some(why) = &self.over {
            return Err(self.error(Failure::Over(why.clone()), None, None));
        }
        let op = body.op();
        let step = match &body {
            RequestBody::Act { action } => Some(action.to_string()),
            _ => None,
        };
        self.last_id += 1;
        let id = self.last_id;
        let sent = serde_json::to_string(&Request { id, body }).unwrap_or_default();
        let asked = Asked { op, sent, step };
        let start = Instant::now();
        let written = self.conversation.requests.as_ref().map(|to| to.send(format!("{}\n", asked.sent).into_bytes()));
        if !matches!(written, Some(Ok(()))) {
            return Err(self.lost(&asked, false));
        }
        self.unanswered.insert(id);
        loop {
            let text = self.hear(&asked, start)?;
            let read = read_answer(&text);
            let answers = match &read {
                Ok(answer) => Some(answer.id),
                Err(Unreadable::Malformed { id, .. }) => *id,
                Err(Unreadable::NotJson(_) | Unreadable::NoNumber(_)) => None,
            };
            let was_unanswered = answers.is_some_and(|id| self.unanswered.remove(&id));
            if was_unanswered && answers != Some(id) {
                continue; // It comes too late.
            }
            let failure = match read {
                Ok(answer) if answer.id != id => Failure::WrongId { op, expected: id, found: answer.id },
                Ok(answer) if answer.ok => return Ok((asked.sent, Line { answer, text })),
                Ok(answer) => {
                    let error = answer.error.unwrap_or_else(|| "it gave no reason".to_owned());
                    Failure::Refused { op, error }
                }
                Err(Unreadable::NotJson(what)) => Failure::NotJson { op, what },
                Err(Unreadable::NoNumber(what)) => Failure::NoNumber { op, what },
                Err(Unreadable::Malformed { what, .. }) => Failure::Malformed { op, what },
            };
            return Err(self.error(failure, Some(&asked.sent), Some(&text)));
        }
    }

    /// The next line that the child sends, if it comes within the time for what it is asked.
    fn hear(&mut self, asked: &Asked, start: Instant) -> Result<Vec<u8>, BridgeError> {
        let (op, sent) = (asked.op, asked.sent.as_str());
        let limit = self.options.limit(op);
        loop {
            let left = limit.saturating_sub(start.elapsed());
            // A process that it started may keep its output open when it has ended.
            let had_ended = self.process.wait(Duration::ZERO);
            return match self.conversation.heard.recv_timeout(left.min(GLANCE)) {
                Ok(Heard::Line(line)) => Ok(line),
                Ok(Heard::TooLong(beginning)) => {
                    let error = self.error(Failure::TooLong, Some(sent), Some(beginning.as_bytes()));
                    Err(self.end_with(error))
                }
                Ok(Heard::InputClosed) => Err(self.lost(asked, false)),
                Ok(Heard::OutputClosed) | Err(RecvTimeoutError::Disconnected) => Err(self.lost(asked, true)),
                Err(RecvTimeoutError::Timeout) if had_ended => Err(self.lost(asked, true)),
                Err(RecvTimeoutError::Timeout) if left > GLANCE => continue,
                Err(RecvTimeoutError::Timeout) => {
                    let error = self.error(Failure::TimedOut { op, limit }, Some(sent), None);
                    Err(BridgeError { stderr: self.conversation.stderr.last(), ..error })
                }
            };
        }
    }

    /// The child can no longer be talked to: finds out whether it ended, and sees to it that it has.
    fn lost(&mut self, asked: &Asked, output: bool) -> BridgeError {
        let op = asked.op;
        let ended = self.process.wait(LAST_WORDS);
        let status = self.process.end(GRACE);
        let failure = match status {
            _ if self.process.is_stopped() => Failure::Over("it was stopped".to_owned()),
            _ if ended => Failure::Died { op, status },
            _ => Failure::Closed { op, output },
        };
        // There is no answer to hold against the request: the step says more than the line that tells of it.
        let error = self.error(failure, Some(asked.step.as_deref().unwrap_or(&asked.sent)), None);
        self.end_with(error)
    }

    /// Ends the child because of this error.
    fn end_with(&mut self, error: BridgeError) -> BridgeError {
        self.process.end(GRACE);
        self.conversation.requests = None;
        self.conversation.stderr.finish(GRACE);
        self.over = Some(match &*error.failure {
            Failure::Over(why) => why.clone(),
            failure => failure.to_string(),
        });
        BridgeError { stderr: self.conversation.stderr.last(), ..error }
    }

    /// Asks for a state.
    fn ask_for_state(&mut self, body: RequestBody) -> Result<(Scene, Answer), BridgeError> {
        let op = body.op();
        let (sent, Line { mut answer, text }) = self.ask(body)?;
        match answer.state.take() {
            Some(scene) => {
                // Entities are written alike in every state: what is answered to actions is not read twice.
                if op != "act" {
                    self.note_unread_keys(&text);
                }
                Ok((scene, answer))
            }
            None => Err(self.error(Failure::Missing { op, field: "state" }, Some(&sent), Some(&text))),
        }
    }

    fn note_unread_keys(&mut self, text: &[u8]) {
        let found = std::str::from_utf8(text).map(unread_keys_of_answer).unwrap_or_default();
        for key in found {
            if !self.unread_keys.iter().any(|known| known.key == key.key) {
                self.unread_keys.push(key);
            }
        }
    }

    fn end_properly(&mut self) -> Result<(), BridgeError> {
        if self.over.is_some() {
            return Ok(());
        }
        let start = Instant::now();
        let answered = self.ask(RequestBody::Close).map(|_| ());
        self.conversation.requests = None;
        if self.over.is_none() {
            self.process.wait(self.options.close.saturating_sub(start.elapsed()));
            self.process.end(Duration::ZERO);
            self.conversation.stderr.finish(GRACE);
            self.over = Some("it was closed".to_owned());
        }
        // A child that ends without a word when told to end does what was asked.
        match answered {
            Err(error) if matches!(*error.failure, Failure::Died { status: Some(s), .. } if s.success()) => Ok(()),
            answered => answered,
        }
    }
}

/// What is to be answered.
struct Asked {
    op: &'static str,
    sent: String,
    /// The step that is to be done, as people write it.
    step: Option<String>,
}

/// A line that is an answer.
struct Line {
    answer: Answer,
    text: Vec<u8>,
}

impl World for Bridge {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn can_reset(&self) -> bool {
        self.can_reset
    }

    fn instance(&self) -> Option<Symbol> {
        self.instance.clone()
    }

    fn unread_keys(&self) -> &[UnreadKey] {
        &self.unread_keys
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        if !self.can_reset {
            return Err(self.error(Failure::NoReset, None, None).into());
        }
        let body = RequestBody::Reset { seed: reset.seed, scenario: reset.scenario.clone() };
        let (scene, answer) = self.ask_for_state(body)?;
        if answer.instance.is_some() {
            self.instance = answer.instance;
        }
        Ok(scene)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        Ok(self.ask_for_state(RequestBody::Observe)?.0)
    }

    /// An answer that does not say whether the action was executed is taken to say so unless it gives a reason.
    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        let (scene, answer) = self.ask_for_state(RequestBody::Act { action: call.clone() })?;
        let executed = answer.executed.unwrap_or(answer.reason.is_none());
        Ok(Acted { scene, executed, reason: answer.reason })
    }

    /// Asks the child to end, and kills it if it has not ended in time; that alone is not an error.
    fn close(&mut self) -> Result<(), WorldError> {
        Ok(self.end_properly()?)
    }
}

impl Drop for Bridge {
    fn drop(&mut self) {
        // A child that reads the end of its input may end by itself.
        self.conversation.requests = None;
        self.process.end(GRACE);
        self.conversation.stderr.finish(GRACE);
    }
}
