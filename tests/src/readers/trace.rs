//! Traces.

use std::path::Path;

use typelift::model::ParseConfig;
use typelift::world::{Dataset, FileError, Parser, Recording, TraceReader, TrajectoryContext, read_any_trace};

use super::errors::assert_shown;
use super::learning::assert_learned;
use super::sample;
use super::scratch::in_file;

/// What is read is written so that it reads the same, and can be learned from.
pub fn trace(bytes: &[u8]) {
    if let Ok(read) = recording(bytes) {
        let mut written = Vec::new();
        read.write(&mut written).expect("written");
        assert_eq!(recording(&written), Ok(read), "{}", String::from_utf8_lossy(&written));
    }
    let mut parser = Parser::new(sample::hierarchy(), ParseConfig::default());
    match in_file(bytes, |path| read_any_trace(path, &TrajectoryContext::default(), &mut parser)) {
        Ok(trace) => assert_learned(&Dataset::new(&parser, vec![trace])),
        Err(error) => assert_shown(&error, bytes),
    }
}

/// The whole of a trace.
fn recording(bytes: &[u8]) -> Result<Recording, FileError> {
    TraceReader::new(Path::new("trace"), bytes)?.recording()
}
