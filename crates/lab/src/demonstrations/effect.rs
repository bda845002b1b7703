//! Which demonstration matters most: how many tasks more are solved when it is added.

use crate::demonstrations::{DemonstrationsResult, SubsetRun};
use crate::variant::Variant;

/// What a demonstration adds, on average over the subsets that it can be added to.
#[derive(Debug, Clone, PartialEq)]
pub struct Gain {
    /// The demonstration's number, from 1.
    pub number: u8,
    /// What it shows.
    pub title: String,
    /// Pairs of a subset without it and the same with it.
    pub pairs: usize,
    /// Tasks that are solved with it and were not without, minus the other way round, on average.
    pub mean: f64,
}

impl DemonstrationsResult {
    /// What each demonstration adds for a variant, the most first.
    pub fn gains(&self, variant: Variant) -> Vec<Gain> {
        let mut gains: Vec<Gain> = (1_u8..)
            .zip(&self.titles)
            .map(|(number, title)| {
                let differences: Vec<f64> = self
                    .records
                    .iter()
                    .filter(|(run, _)| run.variant == variant && !run.shown.contains(number))
                    .filter_map(|(run, without)| {
                        let with = self.records.get(&SubsetRun { variant, shown: run.shown.with(number) })?;
                        Some(with.solved.len() as f64 - without.solved.len() as f64)
                    })
                    .collect();
                let pairs = differences.len();
                let mean = differences.iter().sum::<f64>() / pairs.max(1) as f64;
                Gain { number, title: title.clone(), pairs, mean }
            })
            .collect();
        gains.sort_by(|a, b| b.mean.total_cmp(&a.mean).then(a.number.cmp(&b.number)));
        gains
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::demonstrations::{DemonstrationsOptions, Subset, SubsetRecord};

    #[test]
    fn a_demonstration_gains_what_it_adds() {
        // Two tasks are solved wherever 3 was shown, one more where 5 was, and all with both.
        let (mut records, variant) = (BTreeMap::new(), Variant::Generalized);
        for shown in (2..=8).flat_map(Subset::of_size) {
            let count = 2 * usize::from(shown.contains(3)) + usize::from(shown.contains(5));
            let solved = (0..count).map(|n| (n.to_string(), 1)).collect();
            let record = SubsetRecord { actions: 1, expansions: 0, out_of_time: 0, solved };
            records.insert(SubsetRun { variant, shown }, record);
        }
        let titles = (1..=8).map(|number| format!("demonstration {number}")).collect();
        let result = DemonstrationsResult { options: DemonstrationsOptions::default(), tasks: 3, titles, records };
        let gains = result.gains(variant);
        let found: Vec<(u8, f64)> = gains.iter().map(|gain| (gain.number, gain.mean)).collect();
        assert_eq!(found[..3], [(3, 2.0), (5, 1.0), (1, 0.0)]);
        // Of the 127 nonempty subsets of the 7 others, the 7 single ones were not tested.
        assert_eq!(gains[0].pairs, 120);
        assert_eq!(result.smallest_complete(variant).iter().map(ToString::to_string).collect::<Vec<_>>(), ["3,5"]);
        assert_eq!(result.sizes(variant)[6].median(), 3.0);
        assert!(result.gains(Variant::Individual).iter().all(|gain| gain.pairs == 0));
    }
}
