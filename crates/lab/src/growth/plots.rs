//! The figures and tables of growth.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use typelift::world::{FileError, write_file};

use crate::csv::{Csv, optional};
use crate::figure::{LogLog, PowerPoint, PowerSeries, fit_power_law, log_log};

use super::measurement::{End, Measurement, Point, Series};
use super::planning::Allowance;

/// Everything measured, with what was fitted to it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GrowthResult {
    /// Whether only small sizes were measured.
    pub quick: bool,
    /// The seconds allowed for a point.
    pub seconds_allowed: f64,
    /// The bytes that a point was allowed to come to hold.
    pub bytes_allowed: u64,
    /// By series and size.
    pub points: Vec<Measured>,
    /// The power laws.
    pub fits: Vec<SeriesFit>,
}

/// A point with what was measured there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What grows, and how many there are of it.
    #[serde(flatten)]
    pub point: Point,
    /// What was measured.
    #[serde(flatten)]
    pub measurement: Measurement,
}

/// A power law fitted to one quantity of one series.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeriesFit {
    /// What grows.
    pub series: Series,
    /// What was measured.
    pub quantity: String,
    /// The exponent.
    pub exponent: f64,
    /// The share of the variance explained (R²).
    pub r_squared: f64,
    /// The points that it was fitted to.
    pub points: usize,
}

/// A quantity: its word, its axis, whether it goes on growing where a measurement was cut, and how it is read.
struct Quantity {
    name: &'static str,
    title: &'static str,
    axis: &'static str,
    of: fn(&Measurement) -> Option<f64>,
}

const MEBI: f64 = 1_048_576.0;

const SECONDS: Quantity =
    Quantity { name: "seconds", title: "time", axis: "seconds on a processor", of: |m| Some(m.seconds) };
const PEAK: Quantity = Quantity {
    name: "peak_bytes",
    title: "memory",
    axis: "MiB, peak of the process",
    of: |m| Some(m.peak_bytes? as f64 / MEBI),
};
const GROUND: Quantity = Quantity {
    name: "ground_actions",
    title: "ground actions",
    axis: "ground actions",
    of: |m| m.ground_actions.map(|n| n as f64),
};
const EXPANSIONS: Quantity = Quantity {
    name: "expansions",
    title: "expansions",
    axis: "nodes expanded",
    of: |m| m.expansions.map(|n| n as f64),
};
const MODEL: Quantity = Quantity {
    name: "model_bytes",
    title: "size of the model",
    axis: "MiB, the model's file",
    of: |m| Some(m.model_bytes? as f64 / MEBI),
};

const COLUMNS: [&str; 11] = [
    "series",
    "size",
    "end",
    "seconds",
    "peak_bytes",
    "ground_actions",
    "expansions",
    "steps",
    "actions",
    "individual_actions",
    "model_bytes",
];

/// A figure: its file, its heading, the series in it with their names, the horizontal axis, the quantity.
struct Plot(&'static str, &'static str, &'static [(Series, &'static str)], &'static str, Quantity);

const OBJECTS: &[(Series, &str)] =
    &[(Series::Storeroom, "larger storeroom"), (Series::Kitchens, "tools and plates grow too")];
const GOALS: &[(Series, &str)] = &[(Series::Goals, "96 objects")];
const TRANSITIONS: &[(Series, &str)] = &[(Series::Transitions, "random play")];

const PLOTS: [Plot; 10] = [
    Plot("growth_objects_time", "Planning", OBJECTS, "objects", SECONDS),
    Plot("growth_objects_ground", "Planning", OBJECTS, "objects", GROUND),
    Plot("growth_objects_memory", "Planning", OBJECTS, "objects", PEAK),
    Plot("growth_goals_time", "Planning", GOALS, "goal foods", SECONDS),
    Plot("growth_goals_expansions", "Planning", GOALS, "goal foods", EXPANSIONS),
    Plot("growth_goals_ground", "Planning", GOALS, "goal foods", GROUND),
    Plot("growth_goals_memory", "Planning", GOALS, "goal foods", PEAK),
    Plot("growth_transitions_time", "Learning", TRANSITIONS, "transitions", SECONDS),
    Plot("growth_transitions_memory", "Learning", TRANSITIONS, "transitions", PEAK),
    Plot("growth_transitions_model", "Learning", TRANSITIONS, "transitions", MODEL),
];

impl GrowthResult {
    /// What was measured, with the fits.
    pub fn new(quick: bool, allowance: Allowance, measured: BTreeMap<Point, Measurement>) -> Self {
        let points = measured.into_iter().map(|(point, measurement)| Measured { point, measurement }).collect();
        let (seconds_allowed, bytes_allowed) = (allowance.seconds, allowance.bytes);
        let mut result = Self { quick, seconds_allowed, bytes_allowed, points, fits: Vec::new() };
        let fits = PLOTS.iter().flat_map(|plot| plot.2.iter().map(move |(series, _)| (*series, &plot.4)));
        result.fits = fits.filter_map(|(series, quantity)| result.fit(series, quantity)).collect();
        result
    }

    fn fit(&self, series: Series, quantity: &Quantity) -> Option<SeriesFit> {
        let points = self.power_points(series, quantity);
        let fit = fit_power_law(&points)?;
        Some(SeriesFit {
            series,
            quantity: quantity.name.to_owned(),
            exponent: fit.exponent,
            r_squared: fit.r_squared,
            points: points.iter().filter(|p| !p.cut).count(),
        })
    }

    fn power_points(&self, series: Series, quantity: &Quantity) -> Vec<PowerPoint> {
        let mine = self.points.iter().filter(|measured| measured.point.series == series);
        let place = |measured: &Measured| {
            let y = (quantity.of)(&measured.measurement)?;
            Some(PowerPoint { x: measured.point.size as f64, y, cut: measured.measurement.end != End::Finished })
        };
        mine.filter_map(place).collect()
    }

    /// The figures: a name without ending, and the SVG.
    pub fn figures(&self) -> Vec<(String, String)> {
        let figure = |Plot(name, heading, series, horizontal, quantity): &Plot| {
            let series = series.iter().map(|&(series, name)| PowerSeries {
                name: name.to_owned(),
                points: self.power_points(series, quantity),
            });
            let plot = LogLog {
                title: format!("{heading}: {}", quantity.title),
                horizontal: (*horizontal).to_owned(),
                vertical: quantity.axis.to_owned(),
                series: series.collect(),
            };
            ((*name).to_owned(), log_log(&plot))
        };
        PLOTS.iter().map(figure).collect()
    }

    /// Everything measured as CSV.
    pub fn csv(&self) -> String {
        let mut csv = Csv::new(&COLUMNS);
        for Measured { point, measurement: m } in &self.points {
            let first = [
                point.series.name().to_owned(),
                point.size.to_string(),
                m.end.word().to_owned(),
                format!("{:.6}", m.seconds),
            ];
            let planned = [m.peak_bytes, m.ground_actions, m.expansions, m.steps];
            let learned = [m.actions, m.individual_actions, m.model_bytes];
            csv.row(first.into_iter().chain(planned.into_iter().chain(learned).map(optional)));
        }
        csv.into_text()
    }

    /// The fits as CSV.
    pub fn fits_csv(&self) -> String {
        let mut csv = Csv::new(&["series", "quantity", "exponent", "r_squared", "points"]);
        for fit in &self.fits {
            let [exponent, r_squared] = [fit.exponent, fit.r_squared].map(|n| format!("{n:.3}"));
            csv.row([fit.series.name().to_owned(), fit.quantity.clone(), exponent, r_squared, fit.points.to_string()]);
        }
        csv.into_text()
    }

    /// Writes everything to a folder that is there; the files' names come back.
    ///
    /// # Errors
    /// [`FileError`] if a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<Vec<String>, FileError> {
        let mut files = vec![("growth.csv".to_owned(), self.csv()), ("growth_fits.csv".to_owned(), self.fits_csv())];
        files.extend(self.figures().into_iter().map(|(name, svg)| (format!("{name}.svg"), svg)));
        files.push(("growth.json".to_owned(), crate::json::pretty(self)));
        for (name, text) in &files {
            write_file(&folder.join(name), text.as_bytes())?;
        }
        Ok(files.into_iter().map(|(name, _)| name).collect())
    }
}

#[cfg(test)]
mod tests {
    use typelift::model::Stop;

    use super::*;

    fn result() -> GrowthResult {
        let mut measured = BTreeMap::new();
        for size in [32, 100, 320, 1000] {
            let end = if size == 1000 { End::Stopped(Stop::Time) } else { End::Finished };
            let seconds = if size == 1000 { 60.0 } else { 1e-6 * (size * size) as f64 };
            let mut measurement = Measurement::new(end, seconds);
            measurement.peak_bytes = Some(size << 20);
            measurement.ground_actions = (end == End::Finished).then_some(3 * size);
            measured.insert(Point { series: Series::Storeroom, size }, measurement);
        }
        GrowthResult::new(false, Allowance { seconds: 60.0, bytes: 1 }, measured)
    }

    #[test]
    fn exponents() {
        let fits: BTreeMap<String, SeriesFit> = result().fits.into_iter().map(|f| (f.quantity.clone(), f)).collect();
        for (quantity, exponent) in [("seconds", 2.0), ("ground_actions", 1.0), ("peak_bytes", 1.0)] {
            let fit = &fits[quantity];
            assert!((fit.exponent - exponent).abs() < 1e-9 && fit.points == 3, "{fit:?}");
        }
        assert_eq!(fits.len(), 3, "nothing is fitted to what was not measured");
    }

    #[test]
    fn files_and_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = result().write(folder.path()).expect("written");
        assert_eq!(files.len(), 13);
        let text = std::fs::read_to_string(folder.path().join("growth.json")).expect("read");
        assert_eq!(serde_json::from_str::<GrowthResult>(&text).expect("JSON"), result());
        let figure = std::fs::read_to_string(folder.path().join("growth_objects_time.svg")).expect("read");
        assert!(figure.contains("larger storeroom: ∝ n^2 (R² 1), cut at 1k"), "{figure}");
        assert!(result().csv().contains("storeroom,1000,out_of_time,60.000000,1048576000,,,,,,\n"));
    }
}
