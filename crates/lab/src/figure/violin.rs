//! Violins with a median bar, as in the paper's figure on the number of demonstrations.
//!
//! A violin is a density (Gaussian kernel of the stated [`BANDWIDTH`], cut at 0 and 1), mirrored; each is as wide as the
//! others where it is widest. Below it stands how many values it is made of.

use super::axis::{Frame, Scale};
use super::svg::{Anchor, Svg};
use crate::statistics::median;

/// The standard deviation of the kernel, as a fraction of all tasks: a little more than one task of 24.
pub const BANDWIDTH: f64 = 0.05;

/// Width and height of one panel, in pixels: a phone shows it without shrinking.
const PANEL: (f64, f64) = (350.0, 286.0);

/// The heights at which a density is computed: steps of 1/80.
const STEPS: u32 = 80;

/// The values of one violin.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// What stands below it.
    pub label: String,
    /// Fractions between 0 and 1, in any order.
    pub values: Vec<f64>,
}

/// One panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Violins {
    /// What stands above it.
    pub title: String,
    /// From left to right.
    pub columns: Vec<Column>,
}

/// One panel as a figure; `unit` names what is a fraction of what, as `fraction of 24 tasks solved`.
pub fn violin(panel: &Violins, horizontal: &str, vertical: &str) -> String {
    violins(std::slice::from_ref(panel), horizontal, vertical)
}

/// Several panels as one figure, two in a row.
pub fn violins(panels: &[Violins], horizontal: &str, vertical: &str) -> String {
    let columns = panels.len().clamp(1, 2);
    let rows = panels.len().div_ceil(columns).max(1);
    let titles: Vec<&str> = panels.iter().map(|panel| panel.title.as_str()).collect();
    let title = format!("{vertical} against {horizontal}: {}", titles.join("; "));
    let mut svg = Svg::new(PANEL.0 * columns as f64, PANEL.1 * rows as f64 + 32.0, &title);
    for (index, panel) in panels.iter().enumerate() {
        let corner = ((index % columns) as f64 * PANEL.0, (index / columns) as f64 * PANEL.1);
        draw(&mut svg, panel, corner, (horizontal, vertical), index % 4);
    }
    let note = format!("shade: density (Gaussian kernel, bandwidth {BANDWIDTH}),");
    let lines = [note.as_str(), "equally wide at the widest; bar: median; n: subsets"];
    for (y, line) in [6.0, 20.0].into_iter().zip(lines) {
        svg.text("small mute", (10.0, PANEL.1 * rows as f64 + y), Anchor::Start, line);
    }
    svg.finish()
}

fn draw(svg: &mut Svg, panel: &Violins, corner: (f64, f64), titles: (&str, &str), colour: usize) {
    let frame = Frame {
        left: corner.0 + 44.0,
        top: corner.1 + 50.0,
        right: corner.0 + PANEL.0 - 10.0,
        bottom: corner.1 + PANEL.1 - 56.0,
    };
    svg.text("strong", (corner.0 + 10.0, corner.1 + 18.0), Anchor::Start, &panel.title);
    let scale = Scale::linear((0.0, 1.0), (frame.bottom, frame.top));
    frame.vertical(svg, scale, titles.1);
    frame.base(svg, titles.0, frame.bottom + 46.0);
    let width = (frame.right - frame.left) / panel.columns.len().max(1) as f64;
    for (index, column) in panel.columns.iter().enumerate() {
        let middle = frame.left + width * (index as f64 + 0.5);
        svg.text("", (middle, frame.bottom + 16.0), Anchor::Middle, &column.label);
        let count = format!("n={}", column.values.len());
        svg.text("small mute", (middle, frame.bottom + 30.0), Anchor::Middle, &count);
        let Some(median) = median(column.values.iter().copied()) else { continue };
        svg.open(&format!("{}: median {median:.3} of {} values", column.label, column.values.len()));
        let outline = outline(&column.values, middle, width * 0.44, scale);
        svg.polygon(&format!("f{colour} soft"), &outline);
        let (y, half) = (scale.at(median), width * 0.36);
        svg.stroke(&format!("l{colour}"), (middle - half, y), (middle + half, y), 3.5, None);
        svg.close();
    }
}

/// The polygon: up the right side, down the left. Where the density is next to nothing, it is left out at the ends.
fn outline(values: &[f64], middle: f64, half: f64, scale: Scale) -> Vec<(f64, f64)> {
    let heights: Vec<f64> = (0..=STEPS).map(|i| f64::from(i) / f64::from(STEPS)).collect();
    let densities: Vec<f64> = heights.iter().map(|&y| density(values, y)).collect();
    let most = densities.iter().copied().fold(0.0, f64::max);
    let seen = |density: &f64| *density > most * 0.01;
    let (Some(first), Some(last)) = (densities.iter().position(seen), densities.iter().rposition(seen)) else {
        return Vec::new();
    };
    let side = |sign: f64| (first..=last).map(move |i| (i, sign));
    let place = |(i, sign): (usize, f64)| (middle + sign * half * densities[i] / most, scale.at(heights[i]));
    side(1.0).map(place).chain(side(-1.0).rev().map(place)).collect()
}

/// The density at `y`, up to a factor.
fn density(values: &[f64], y: f64) -> f64 {
    values.iter().map(|value| (-0.5 * ((y - value) / BANDWIDTH).powi(2)).exp()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(title: &str) -> Violins {
        let column = |label: &str, values: &[u32]| Column {
            label: label.to_owned(),
            values: values.iter().map(|v| f64::from(*v) / 24.0).collect(),
        };
        let columns = vec![
            column("2", &[2, 3, 5, 5, 6, 8]),
            column("3", &[3, 8, 8, 16, 24]),
            column("4", &[]),
            column("8", &[24]),
        ];
        Violins { title: title.to_owned(), columns }
    }

    #[test]
    fn outlines_stay_within_0_and_1_and_are_widest_at_the_values() {
        let scale = Scale::linear((0.0, 1.0), (100.0, 0.0));
        let points = outline(&[1.0, 1.0, 0.5], 50.0, 10.0, scale);
        assert!(points.iter().all(|&(x, y)| (40.0..=60.0).contains(&x) && (0.0..=100.0).contains(&y)));
        let widest = points.iter().copied().reduce(|a, b| if a.0 >= b.0 { a } else { b });
        assert_eq!(widest, Some((60.0, 0.0)));
        let mirrored: f64 = points.iter().map(|(x, _)| x - 50.0).sum();
        assert!(mirrored.abs() < 1e-9);
    }

    #[test]
    fn one_panel() {
        insta::assert_snapshot!(violin(
            &panel("generalized+imagined"),
            "demonstrations",
            "fraction of 24 tasks solved"
        ));
    }

    #[test]
    fn several_panels_and_no_data() {
        let four: Vec<Violins> = ["a", "b", "c", "d"].into_iter().map(panel).collect();
        let text = violins(&four, "demonstrations", "solved");
        assert!(text.contains("viewBox=\"0 0 700 604\""), "{text}");
        assert_eq!(text.matches("<polygon").count(), 12, "the column without values has no violin");
        assert!(violins(&[], "x", "y").ends_with("</svg>\n"));
    }
}
