//! The experiment as files: `demonstrations.csv` (a row a subset, of which the violins in `violins.svg` are made),
//! `sizes.csv`, `gains.csv`, and the same as JSON and for people.

use std::fmt::Write;
use std::path::Path;

use serde_json::{Value, json};
use typelift::world::{FileError, write_file};

use crate::csv::Csv;
use crate::demonstrations::{DemonstrationsResult, Size, Subset};
use crate::figure::{Column, Violins, violins};
use crate::published::published;
use crate::variant::Variant;

impl DemonstrationsResult {
    /// A row a subset.
    fn csv(&self) -> String {
        let mut csv =
            Csv::new(&["variant", "demonstrations", "shown", "actions", "solved", "tasks", "fraction", "expansions"]);
        for (run, record) in &self.records {
            csv.row([
                run.variant.to_string(),
                run.shown.len().to_string(),
                run.shown.to_string(),
                record.actions.to_string(),
                record.solved.len().to_string(),
                self.tasks.to_string(),
                format!("{:.4}", self.fraction(record.solved.len() as f64)),
                record.expansions.to_string(),
            ]);
        }
        csv.into_text()
    }

    /// A row a size.
    fn sizes_csv(&self) -> String {
        let mut csv = Csv::new(&[
            "variant",
            "demonstrations",
            "subsets",
            "solved_min",
            "solved_median",
            "solved_max",
            "complete",
        ]);
        for variant in &self.options.variants {
            for size in self.sizes(*variant) {
                let [min, max] = ends(&size);
                csv.row([
                    variant.to_string(),
                    size.size.to_string(),
                    size.solved.len().to_string(),
                    min.to_string(),
                    size.median().to_string(),
                    max.to_string(),
                    self.complete(&size).to_string(),
                ]);
            }
        }
        csv.into_text()
    }

    fn gains_csv(&self) -> String {
        let mut csv = Csv::new(&["variant", "demonstration", "shows", "pairs", "mean_gain"]);
        for variant in &self.options.variants {
            for gain in self.gains(*variant) {
                let mean = format!("{:.4}", gain.mean);
                csv.row([variant.to_string(), gain.number.to_string(), gain.title, gain.pairs.to_string(), mean]);
            }
        }
        csv.into_text()
    }

    /// How many subsets of a size solve every task.
    pub fn complete(&self, size: &Size) -> usize {
        size.solved.iter().filter(|solved| **solved == self.tasks).count()
    }

    fn fraction(&self, solved: f64) -> f64 {
        solved / self.tasks.max(1) as f64
    }

    /// The experiment as JSON: the same as the file `demonstrations.json`.
    pub fn json(&self) -> Value {
        let variants: Vec<Value> = self.options.variants.iter().map(|variant| self.variant_json(*variant)).collect();
        json!({
            "format": "lab-demonstrations/1",
            "typelift": env!("CARGO_PKG_VERSION"),
            "seed": self.options.seed,
            "limits": self.options.limits,
            "tasks": self.tasks,
            "demonstrations": self.titles,
            "variants": variants,
        })
    }

    fn variant_json(&self, variant: Variant) -> Value {
        let sizes: Vec<Value> = self
            .sizes(variant)
            .iter()
            .map(|size| {
                let [min, max] = ends(size);
                json!({
                    "demonstrations": size.size,
                    "subsets": size.solved.len(),
                    "solved": size.solved,
                    "solved": size.solved,
                    "solved_min": min,
                    "solved_median": size.median(),
                    "solved_max": max,
                    "complete": self.complete(size),
                })
            })
            .collect();
        let gains = self.gains(variant).into_iter();
        let gains: Vec<Value> = gains
            .map(|gain| json!({"demonstration": gain.number, "shows": gain.title, "pairs": gain.pairs, "mean": gain.mean}))
            .collect();
        let smallest: Vec<&Subset> = self.smallest_complete(variant);
        json!({"variant": variant, "sizes": sizes, "smallest_complete": smallest, "gains": gains})
    }

    fn markdown(&self) -> String {
        let limits = self.options.limits;
        let mut text = format!(
            "# The number of demonstrations\n\nA model from every subset of the demonstrations, tested on {} tasks; \
             seed {}, {limits}.\n\n",
            self.tasks, self.options.seed
        );
        for (number, title) in (1..).zip(&self.titles) {
            let _ = writeln!(text, "{number}. {title}");
        }
        for variant in &self.options.variants {
            let _ = writeln!(
                text,
                "\n## {variant}\n\n| demonstrations | subsets | solved, least | median | most | subsets that solve all |\n|---|---|---|---|---|---|"
            );
            for size in self.sizes(*variant) {
                let [min, max] = ends(&size);
                let (count, complete) = (size.solved.len(), self.complete(&size));
                let _ = writeln!(text, "| {} | {count} | {min} | {} | {max} | {complete} |", size.size, size.median());
            }
            let smallest: Vec<String> = self.smallest_complete(*variant).iter().map(ToString::to_string).collect();
            let smallest = if smallest.is_empty() { "none".to_owned() } else { smallest.join("; ") };
            let _ = writeln!(
                text,
                "\nSmallest subsets that solve everything: {smallest}.\n\n| added demonstration | tasks gained, mean |\n|---|---|"
            );
            for gain in self.gains(*variant) {
                let _ = writeln!(text, "| {} {} | {:+.2} |", gain.number, gain.title, gain.mean);
            }
        }
        let paper = published().demonstrations;
        let [from, to] = paper.jump;
        let _ = writeln!(
            text,
            "\nThe paper's text says of generalized+imagined: a big jump from {from} to {to} demonstrations, and with {} some \
             subsets already solve every task.",
            paper.complete_from
        );
        text
    }

    /// A violin for each number of demonstrations, a panel for each variant.
    pub fn violins(&self) -> String {
        let panel = |variant: &Variant| {
            let column = |size: Size| Column {
                label: size.size.to_string(),
                values: size.solved.iter().map(|solved| self.fraction(*solved as f64)).collect(),
            };
            Violins { title: variant.to_string(), columns: self.sizes(*variant).into_iter().map(column).collect() }
        };
        let panels: Vec<Violins> = self.options.variants.iter().map(panel).collect();
        violins(&panels, "demonstrations", &format!("fraction of {} tasks solved", self.tasks))
    }

    pub(super) fn write(&self, folder: &Path) -> Result<(), FileError> {
        write_file(&folder.join("demonstrations.csv"), self.csv().as_bytes())?;
        write_file(&folder.join("sizes.csv"), self.sizes_csv().as_bytes())?;
        write_file(&folder.join("gains.csv"), self.gains_csv().as_bytes())?;
        write_file(&folder.join("violins.svg"), self.violins().as_bytes())?;
        write_file(&folder.join("demonstrations.json"), format!("{:#}\n", self.json()).as_bytes())?;
        write_file(&folder.join("demonstrations.md"), self.markdown().as_bytes())
    }
}

/// The least and the most tasks solved.
pub(super) fn ends(size: &Size) -> [usize; 2] {
    [size.solved.first(), size.solved.last()].map(|end| end.copied().unwrap_or_default())
}
