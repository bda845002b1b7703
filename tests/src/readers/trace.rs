//! Traces.

use std::path::Path;

use typelift::model::ParseConfig;
use typelift::world::{
    Dataset, FileError, Parser, Scene, TraceAction, TraceHeader, TraceItem, TraceReader, TrajectoryContext,
    read_any_trace, write_trace,
};

use super::errors::assert_shown;
use super::learning::assert_learned;
use super::sample;
use super::scratch::in_file;

/// What is read is written so that it reads the same, and can be learned from.
pub fn trace(bytes: &[u8]) {
    if let Ok((header, scenes, actions)) = items(bytes) {
        let mut written = Vec::new();
        write_trace(&mut written, &header, &scenes, &actions).expect("states and actions come in turn");
        assert_eq!(items(&written), Ok((header, scenes, actions)), "{}", String::from_utf8_lossy(&written));
    }
    let mut parser = Parser::new(sample::hierarchy(), ParseConfig::default());
    match in_file(bytes, |path| read_any_trace(path, &TrajectoryContext::default(), &mut parser)) {
        Ok(trace) => assert_learned(&Dataset::new(&parser, vec![trace])),
        Err(error) => assert_shown(&error, bytes),
    }
}

type Items = (TraceHeader, Vec<Scene>, Vec<TraceAction>);

/// All lines of a trace.
fn items(bytes: &[u8]) -> Result<Items, FileError> {
    let mut reader = TraceReader::new(Path::new("trace"), bytes)?;
    let (mut scenes, mut actions) = (Vec::new(), Vec::new());
    for item in &mut reader {
        match item? {
            TraceItem::State(scene) => scenes.push(scene),
            TraceItem::Action(action) => actions.push(action),
        }
    }
    Ok((reader.header().clone(), scenes, actions))
}
