//! Trajectories.

use typelift::model::{Hierarchy, ParseConfig};
use typelift::pddl::{Trajectory, format, read_trajectory};
use typelift::world::{Dataset, ObjectTypes, Parser, read_any_trace};

use super::errors::{assert_located, assert_shown};
use super::learning::assert_learned;
use super::scratch::in_file;
use super::types::checked_hierarchy;
use super::{last_part, sample, text_of};

/// What is read reads the same when it is laid out, and can be learned from. The parts before the trajectory are types
/// and a list of objects.
pub fn trajectory(bytes: &[u8]) {
    let text = text_of(bytes);
    let (given, trajectory) = last_part(&text);
    match read_trajectory(trajectory) {
        Ok(read) => {
            assert_eq!(read.states.len(), read.actions.len() + 1);
            let laid_out =
                read_trajectory(&format(trajectory).expect("its parentheses match")).expect("it reads as before");
            let calls = |read: &Trajectory| read.actions.iter().map(|a| a.call.clone()).collect::<Vec<_>>();
            assert_eq!(calls(&laid_out), calls(&read));
        }
        Err(error) => assert_located(&error, trajectory),
    }
    let Some((hierarchy, objects)) = given.map_or_else(|| Some((sample::hierarchy(), sample::objects())), types_of)
    else {
        return;
    };
    let mut parser = Parser::new(hierarchy, ParseConfig::default());
    match in_file(trajectory.as_bytes(), |path| read_any_trace(path, &objects.clone().into(), &mut parser)) {
        Ok(trace) => assert_learned(&Dataset::new(&parser, vec![trace])),
        Err(error) => assert_shown(&error, trajectory.as_bytes()),
    }
}

/// The types and the objects that are given, if they can be read.
fn types_of([types, objects]: [&str; 2]) -> Option<(Hierarchy, ObjectTypes)> {
    let hierarchy = checked_hierarchy(types.as_bytes())?;
    match in_file(objects.as_bytes(), ObjectTypes::from_file) {
        Ok(objects) => Some((hierarchy, objects)),
        Err(error) => {
            assert_shown(&error, objects.as_bytes());
            None
        }
    }
}
