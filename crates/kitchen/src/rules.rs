//! What the actions do. An action whose condition fails changes nothing.
//!
//! | action  | condition                                                        | change |
//! |---------|------------------------------------------------------------------|--------|
//! | PICK x  | hand empty; x lies in a station, not on a plate; x is free       | x leaves the station and is held; a tool that is now empty gets NotUsable |
//! | PLACE c | x is held; c accepts x                                           | x is the topmost in c; hand empty; a tool gets Ready |
//! | USE t   | t is a tool, its status is Ready, there is something it can do   | the food changes; status NotUsable |
//!
//! A broken tool takes and gives as a healthy one does; using it changes nothing. So does one that is interlocked with
//! another in which something lies, and one that has a food in it that is an exception.

use typelift_model::GroundCall;

use crate::call::Deed;
use crate::kind::Process;
use crate::refusal::{NEEDS_MACHETE, NOT_BLENDABLE, NOT_FOOD, NOT_TOASTABLE, Refusal};
use crate::room::{Container, Item, Room, Toast};

impl Room {
    /// Performs an action, after walking to where it can be performed.
    ///
    /// # Errors
    /// [`Refusal`] if the action is not possible now; nothing has changed then.
    pub fn act(&mut self, call: &GroundCall) -> Result<(), Refusal> {
        let deed = self.understand(call)?;
        let station = self.station_for(deed)?;
        let (cell, facing) =
            self.way_to(station).ok_or_else(|| Refusal::Unreachable { target: self.stations[station].name.clone() })?;
        (self.agent.cell, self.agent.facing) = (cell, Some(facing));
        match deed {
            Deed::Pick { item } => self.do_pick(item, station),
            Deed::Place { item, container } => self.do_place(item, container),
            Deed::Use { tool } => self.do_use(tool),
        }
        Ok(())
    }

    /// The actions that are possible now, ordered.
    pub(crate) fn possible_calls(&self) -> Vec<GroundCall> {
        let call = |name: &str, container: Container, item: usize| GroundCall {
            name: name.into(),
            args: vec![self.agent.name.clone(), self.container_name(container).clone(), self.items[item].name.clone()],
        };
        let items = 0..self.items.len();
        let mut possible = Vec::new();
        let mut offer = |deed: Deed, call: GroundCall| {
            if self.station_for(deed).is_ok_and(|station| self.way_to(station).is_some()) {
                possible.push(call);
            }
        };
        for item in items.clone() {
            if let Some(container) = self.container_holding(item) {
                offer(Deed::Pick { item }, call("PICK", container, item));
            }
        }
        if let Some(item) = self.agent.holding {
            let plates = items.filter(|&item| !self.items[item].kind.is_food()).map(Container::Plate);
            for container in (0..self.stations.len()).map(Container::Station).chain(plates) {
                offer(Deed::Place { item, container }, call("PLACE", container, item));
            }
        }
        for (tool, station) in self.stations.iter().enumerate() {
            if let Some(&top) = station.content.last().filter(|_| station.kind.process().is_some()) {
                offer(Deed::Use { tool }, call("USE", Container::Station(tool), top));
            }
        }
        possible.sort_unstable();
        possible
    }

    /// Where an action can be performed.
    pub(crate) fn station_for(&self, deed: Deed) -> Result<usize, Refusal> {
        match deed {
            Deed::Pick { item } => self.may_pick(item),
            Deed::Place { item, container } => self.may_place(item, container),
            Deed::Use { tool } => self.may_use(tool),
        }
    }

    /// The station from which the item can be picked.
    fn may_pick(&self, item: usize) -> Result<usize, Refusal> {
        let name = || self.items[item].name.clone();
        if let Some(held) = self.agent.holding {
            return Err(Refusal::HandFull { held: self.items[held].name.clone() });
        }
        match self.container_holding(item) {
            Some(Container::Plate(plate)) => {
                Err(Refusal::OnPlate { item: name(), plate: self.items[plate].name.clone() })
            }
            Some(container @ Container::Station(station)) => match self.content(container).last() {
                Some(&top) if top != item => Err(Refusal::Covered {
                    item: name(),
                    container: self.stations[station].name.clone(),
                    above: self.items[top].name.clone(),
                }),
                _ => Ok(station),
            },
            // Only what is held lies nowhere, and nothing is held here.
            None => Err(Refusal::HandFull { held: name() }),
        }
    }

    fn do_pick(&mut self, item: usize, station: usize) {
        let station = &mut self.stations[station];
        station.content.retain(|&other| other != item);
        if station.content.is_empty() {
            station.ready = false;
        }
        self.agent.holding = Some(item);
    }

    /// The station at which the held item can be put into the container.
    fn may_place(&self, item: usize, container: Container) -> Result<usize, Refusal> {
        let station = match container {
            Container::Station(station) => station,
            Container::Plate(plate) => self
                .station_under(plate)
                .ok_or_else(|| Refusal::PlateInHand { plate: self.items[plate].name.clone() })?,
        };
        if self.content(container).len() >= self.capacity(container) {
            return Err(Refusal::Full { container: self.container_name(container).clone() });
        }
        let objection = match container {
            Container::Plate(_) => Self::plate_objection(&self.items[item]),
            Container::Station(station) => self.station_objection(station, &self.items[item]),
        };
        match objection {
            None => Ok(station),
            Some(because) => Err(Refusal::NotAccepted {
                container: self.container_name(container).clone(),
                item: self.items[item].name.clone(),
                because,
            }),
        }
    }

    /// What stands against putting the item on a plate.
    fn plate_objection(item: &Item) -> Option<&'static str> {
        if !item.kind.is_food() {
            Some(NOT_FOOD)
        } else if !item.chopped && !item.mashed {
            Some("it is neither chopped nor mashed")
        } else {
            None
        }
    }

    /// What stands against putting the item into a station that is not full.
    fn station_objection(&self, station: usize, item: &Item) -> Option<&'static str> {
        let station = &self.stations[station];
        let process = station.kind.process()?;
        if !item.kind.is_food() {
            return Some(NOT_FOOD);
        }
        match process {
            Process::Cut if item.chopped => Some("it is already chopped"),
            Process::Cut if item.kind.has_hard_shell() && !station.kind.cuts_hard_shells() => Some(NEEDS_MACHETE),
            Process::Blend if !item.kind.can_be_blended() => Some(NOT_BLENDABLE),
            Process::Blend if item.mashed => Some("it is already mashed"),
            Process::Toast if !item.kind.can_be_toasted() => Some(NOT_TOASTABLE),
            Process::Toast if item.toast == Toast::Fresh => Some("it has to be cut first"),
            Process::Toast if item.toast == Toast::Toasted => Some("it is already toasted"),
            Process::Toast if station.content.iter().any(|&other| self.items[other].toast != Toast::Ready) => {
                Some("what is in there is already toasted")
            }
            _ => None,
        }
    }

    fn do_place(&mut self, item: usize, container: Container) {
        self.agent.holding = None;
        self.content_mut(container).push(item);
        if let Container::Station(station) = container {
            let station = &mut self.stations[station];
            station.ready = station.kind.process().is_some();
        }
    }

    /// The tool itself, if using it does something.
    fn may_use(&self, tool: usize) -> Result<usize, Refusal> {
        let station = &self.stations[tool];
        if !station.ready {
            return Err(Refusal::NotReady { tool: station.name.clone() });
        }
        let works = station.content.iter().any(|&item| self.is_processed(tool, &self.items[item]));
        if station.broken || self.interlock_of(tool).is_some() || !works {
            return Err(Refusal::NothingHappened { tool: station.name.clone() });
        }
        Ok(tool)
    }

    /// Whether a healthy tool changes the item.
    fn is_processed(&self, tool: usize, item: &Item) -> bool {
        self.would_be_processed(tool, item) && !self.is_exception(tool, item)
    }

    /// The same, if the item is no exception.
    pub(crate) fn would_be_processed(&self, tool: usize, item: &Item) -> bool {
        match self.stations[tool].kind.process() {
            Some(Process::Cut) => !item.chopped,
            Some(Process::Blend) => item.kind.can_be_blended() && !item.mashed && !item.chopped,
            Some(Process::Toast) => item.toast == Toast::Ready,
            None => false,
        }
    }

    fn do_use(&mut self, tool: usize) {
        self.stations[tool].ready = false;
        for index in self.stations[tool].content.clone() {
            if !self.is_processed(tool, &self.items[index]) {
                continue;
            }
            let item = &mut self.items[index];
            match self.stations[tool].kind.process() {
                Some(Process::Cut) => {
                    item.chopped = true;
                    if item.kind.can_be_toasted() && item.toast == Toast::Fresh {
                        item.toast = Toast::Ready;
                    }
                }
                Some(Process::Blend) => item.mashed = true,
                Some(Process::Toast) => item.toast = Toast::Toasted,
                None => {}
            }
        }
    }
}
