//! Why a call changes nothing, as the room itself has it: more than a [`Refusal`] tells, which is what is heard in it.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{GroundCall, Symbol};

use crate::call::Deed;
use crate::quirk::{Exception, Interlock};
use crate::refusal::Refusal;
use crate::room::Room;

/// Why a call changes nothing.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(tag = "fault", rename_all = "snake_case")]
pub enum Fault {
    /// The tool is broken.
    Broken {
        /// Its name.
        tool: Symbol,
    },
    /// Something lies in another tool.
    Interlock(Interlock),
    /// The tool does nothing to this food.
    Exception(Exception),
    /// A rule that what is observed shows: the types, the attributes and relations of what takes part.
    Rule {
        /// The refusal, in words.
        refusal: String,
        /// Whether it is a matter of types alone: it would be so in every state.
        of_types: bool,
    },
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken { tool } => write!(f, "{tool} is broken"),
            Self::Interlock(interlock) => write!(f, "interlock: {interlock}"),
            Self::Exception(exception) => write!(f, "exception: {exception}"),
            Self::Rule { refusal, .. } => f.write_str(refusal),
        }
    }
}

impl Room {
    /// Why a call would change nothing now; `None` if it would change something. Of several reasons the first in the order
    /// of [`Fault`].
    pub fn fault(&self, call: &GroundCall) -> Option<Fault> {
        let rule = |refusal: &Refusal| Fault::Rule { refusal: refusal.to_string(), of_types: refusal.is_of_types() };
        let deed = match self.understand(call) {
            Ok(deed) => deed,
            Err(refusal) => return Some(rule(&refusal)),
        };
        let refusal = match self.station_for(deed) {
            Ok(station) if self.way_to(station).is_some() => return None,
            Ok(station) => Refusal::Unreachable { target: self.stations[station].name.clone() },
            Err(refusal) => refusal,
        };
        let hidden = match (deed, &refusal) {
            (Deed::Use { tool }, Refusal::NothingHappened { .. }) => self.hidden_fault(tool),
            _ => None,
        };
        Some(hidden.unwrap_or_else(|| rule(&refusal)))
    }

    /// What no state tells and keeps a tool from doing anything.
    fn hidden_fault(&self, tool: usize) -> Option<Fault> {
        let station = &self.stations[tool];
        if station.broken {
            return Some(Fault::Broken { tool: station.name.clone() });
        }
        if let Some((tools, loaded)) = self.interlock_of(tool) {
            let name = |station: &usize| self.stations[*station].name.clone();
            return Some(Fault::Interlock(Interlock { tools: tools.iter().map(name).collect(), loaded: name(loaded) }));
        }
        let mut items = station.content.iter().map(|&item| &self.items[item]);
        let item = items.find(|item| self.would_be_processed(tool, item) && self.is_exception(tool, item))?;
        let (food, tool) = (Symbol::new(item.kind.name()), Symbol::new(station.kind.name()));
        Some(Fault::Exception(Exception { food, tool }))
    }
}
