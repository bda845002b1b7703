//! A drawing of the room for a terminal, 78 columns wide.
//!
//! Stations and walls are boxes, the floor is open. A box shows its name (a tool that can be used ends in `*`) and the
//! topmost item in it; `+2` stands for two more that lie in it or on its plate. Below it, in words, what does not fit.

use typelift_model::Symbol;

use crate::grid::{Cell, Direction, SIZE};
use crate::room::{Container, Item, Room, Toast};

/// The number of characters inside a box.
const WIDTH: usize = 10;

/// What is drawn for a cell.
enum Drawn {
    Floor,
    Agent { first: String, second: String },
    Wall,
    Station { first: String, second: String },
}

/// The room as text: a plan of its 7 × 7 cells, then what the agent does and the state of all that is not fresh.
/// Lines end with a line feed and are at most 78 characters long.
pub fn draw(room: &Room) -> String {
    let cells: Vec<Drawn> = Cell::all().map(|cell| drawn(room, cell)).collect();
    let mut lines = Vec::new();
    for row in 0..=SIZE {
        lines.push(rule(&cells, row));
        if row < SIZE {
            lines.push(text_line(&cells, row, false));
            lines.push(text_line(&cells, row, true));
        }
    }
    lines.push(String::new());
    lines.push(agent_line(room));
    lines.extend(content_lines(room));
    let wall = if cells.iter().any(|cell| matches!(cell, Drawn::Wall)) { "   ### wall" } else { "" };
    lines.push(format!("* can be used   +n more below or on the plate{wall}"));
    let trimmed = lines.iter().map(|line| line.trim_end());
    trimmed.flat_map(|line| [line, "\n"]).collect()
}

fn drawn(room: &Room, cell: Cell) -> Drawn {
    if room.agent.cell == cell {
        let arrow = match room.agent.facing {
            None => "",
            Some(Direction::Left) => " <",
            Some(Direction::Right) => " >",
            Some(Direction::Down) => " v",
            Some(Direction::Up) => " ^",
        };
        let first = format!("{}{arrow}", fitted(&room.agent.name, WIDTH - 2));
        let second = room.agent.holding.map_or_else(String::new, |item| pile(room, &[item]));
        return Drawn::Agent { first, second };
    }
    if let Some(station) = room.stations.iter().find(|s| s.cell == cell) {
        let mark = if station.ready { "*" } else { "" };
        let first = format!("{}{mark}", fitted(&station.name, WIDTH - mark.len()));
        return Drawn::Station { first, second: pile(room, &station.content) };
    }
    if cell.is_border() { Drawn::Wall } else { Drawn::Floor }
}

/// The topmost item and how many more there are.
fn pile(room: &Room, content: &[usize]) -> String {
    let Some(&top) = content.last() else { return String::new() };
    let more = content.len() - 1 + room.items[top].content.len();
    let more = if more > 0 { format!(" +{more}") } else { String::new() };
    format!("{}{more}", fitted(&room.items[top].name, WIDTH - more.len()))
}

/// A name of at most `width` characters: of a longer one the end of its stem is left out, not its number.
fn fitted(name: &Symbol, width: usize) -> String {
    let count = name.as_str().chars().count();
    if count <= width {
        return name.to_string();
    }
    let (stem, number) = name.as_str().rsplit_once('_').unwrap_or((name.as_str(), ""));
    let end =
        if number.is_empty() || number.chars().count() + 2 > width { "~".to_owned() } else { format!("~{number}") };
    let kept = width - end.chars().count();
    stem.chars().take(kept).chain(end.chars()).collect()
}

fn text_line(cells: &[Drawn], row: u8, second_line: bool) -> String {
    let mut line = String::new();
    for x in 0..SIZE {
        let cell = Cell { x, y: row };
        let left = x.checked_sub(1).map(|x| &cells[Cell { x, y: row }.index()]);
        line.push(if is_edge(left, Some(&cells[cell.index()])) { '│' } else { ' ' });
        let text = match (&cells[cell.index()], second_line) {
            (Drawn::Floor, _) => "",
            (Drawn::Wall, _) => "##########",
            (Drawn::Agent { first, .. } | Drawn::Station { first, .. }, false) => first,
            (Drawn::Agent { second, .. } | Drawn::Station { second, .. }, true) => second,
        };
        line.push_str(&format!("{text:<WIDTH$}"));
    }
    line.push('│');
    line
}

/// The line above a row, or below the last.
fn rule(cells: &[Drawn], row: u8) -> String {
    let at = |x: Option<u8>, y: Option<u8>| match (x, y) {
        (Some(x), Some(y)) if x < SIZE && y < SIZE => Some(&cells[Cell { x, y }.index()]),
        _ => None,
    };
    let above = row.checked_sub(1);
    let mut line = String::new();
    for x in 0..=SIZE {
        let left = x.checked_sub(1);
        let (nw, ne) = (at(left, above), at(Some(x), above));
        let (sw, se) = (at(left, Some(row)), at(Some(x), Some(row)));
        line.push(joint(is_edge(nw, ne), is_edge(sw, se), is_edge(nw, sw), is_edge(ne, se)));
        if x < SIZE {
            let dash = if is_edge(ne, se) { '─' } else { ' ' };
            line.extend(std::iter::repeat_n(dash, WIDTH));
        }
    }
    line
}

/// Whether a line is drawn between two neighbours; outside the room there is none.
fn is_edge(a: Option<&Drawn>, b: Option<&Drawn>) -> bool {
    let is_floor = |cell: &Drawn| matches!(cell, Drawn::Floor | Drawn::Agent { .. });
    match (a, b) {
        (None, None) => false,
        (Some(a), Some(b)) => !is_floor(a) || !is_floor(b),
        _ => true,
    }
}

fn joint(up: bool, down: bool, left: bool, right: bool) -> char {
    match (up, down, left, right) {
        (true, true, true, true) => '┼',
        (true, true, true, false) => '┤',
        (true, true, false, true) => '├',
        (true, false, true, true) => '┴',
        (false, true, true, true) => '┬',
        (true, false, true, false) => '┘',
        (true, false, false, true) => '└',
        (false, true, true, false) => '┐',
        (false, true, false, true) => '┌',
        (true, _, false, false) | (false, true, false, false) => '│',
        (false, false, true, _) | (false, false, false, true) => '─',
        (false, false, false, false) => ' ',
    }
}

fn agent_line(room: &Room) -> String {
    let faced = room.agent.facing.and_then(|direction| room.agent.cell.step(direction));
    let faced = room.stations.iter().find(|s| Some(s.cell) == faced);
    let faced = faced.map_or_else(String::new, |station| format!(", in front of {}", station.name));
    let held = room.agent.holding.map_or_else(|| "nothing".to_owned(), |item| described(room, item));
    wrapped(&format!("{} holds {held}{faced}", room.agent.name))
}

/// What lies in each station, where the plan does not say it all.
fn content_lines(room: &Room) -> Vec<String> {
    let mut lines = Vec::new();
    for (index, station) in room.stations.iter().enumerate() {
        let items: Vec<String> =
            room.content(Container::Station(index)).iter().rev().map(|&item| described(room, item)).collect();
        let is_told = room.content(Container::Station(index)).iter().all(|&item| is_plain(&room.items[item]));
        if items.len() > 1 || !is_told {
            lines.push(wrapped(&format!("{}: {}", station.name, items.join(", under it "))));
        }
    }
    let broken = room.stations.iter().filter(|s| s.broken);
    lines.extend(broken.map(|s| wrapped(&format!("{} is broken, which the agent cannot see", s.name))));
    let exceptions = room.quirks.exceptions.iter();
    lines.extend(exceptions.map(|(food, tool)| {
        wrapped(&format!("{} does nothing to {}, which the agent cannot see", tool.name(), food.name()))
    }));
    for (tools, loaded) in &room.quirks.interlocks {
        let tools: Vec<&str> = tools.iter().map(|tool| room.stations[*tool].name.as_str()).collect();
        let (tools, loaded) = (tools.join(", "), &room.stations[*loaded].name);
        lines.push(wrapped(&format!("{tools} do nothing while {loaded} is loaded, which the agent cannot see")));
    }
    lines
}

fn is_plain(item: &Item) -> bool {
    item.content.is_empty() && states(item).is_empty()
}

fn states(item: &Item) -> Vec<&'static str> {
    let toast = match item.toast {
        Toast::Fresh => None,
        Toast::Ready => Some("ready to be toasted"),
        Toast::Toasted => Some("toasted"),
    };
    [item.mashed.then_some("mashed"), item.chopped.then_some("chopped"), toast].into_iter().flatten().collect()
}

/// `bread_1 (chopped, toasted)`, `plate_1 with …`.
fn described(room: &Room, item: usize) -> String {
    let item = &room.items[item];
    let states = states(item);
    let states = if states.is_empty() { String::new() } else { format!(" ({})", states.join(", ")) };
    let on_it: Vec<String> = item.content.iter().rev().map(|&item| described(room, item)).collect();
    let on_it = if on_it.is_empty() { String::new() } else { format!(" with {}", on_it.join(", ")) };
    format!("{}{states}{on_it}", item.name)
}

/// Breaks a line at spaces before its 78th character; what follows is indented.
fn wrapped(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split(' ') {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > 78 {
            lines.push(std::mem::replace(&mut line, " ".to_owned()));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    #[test]
    fn lines_are_short_enough() {
        for seed in 0..50 {
            let room = Room::build(&Scenario::default(), seed).expect("a room");
            assert!(draw(&room).lines().all(|line| line.chars().count() <= 78));
        }
        let long: String = "words ".repeat(60);
        assert!(wrapped(&long).lines().all(|line| line.chars().count() <= 78));
    }

    #[test]
    fn long_names_keep_their_number() {
        let short = |name: &str| fitted(&Symbol::new(name), 10);
        assert_eq!(short("counter_12"), "counter_12");
        assert_eq!(short("contactgrill_1"), "contactg~1");
        assert_eq!(short("watermelon_12"), "waterme~12");
        assert_eq!(short("without-a-number"), "without-a~");
        assert_eq!(short("a_very-long-number"), "a~");
    }
}
