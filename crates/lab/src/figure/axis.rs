//! Axes: a scale from values to pixels, ticks at round values, labels with units.

use super::svg::{Anchor, Svg, number};

/// A scale from values to pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
    log: bool,
}

impl Scale {
    /// Evenly from `values` to `pixels`.
    pub(crate) fn linear(values: (f64, f64), pixels: (f64, f64)) -> Self {
        Self { low: values.0, high: values.1, from: pixels.0, to: pixels.1, log: false }
    }

    /// Whole powers of ten around positive values.
    pub(crate) fn log(values: impl IntoIterator<Item = f64>, pixels: (f64, f64)) -> Self {
        let (low, high) = values
            .into_iter()
            .filter(|v| *v > 0.0)
            .map(f64::log10)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low.is_finite() { (low.floor(), high.ceil()) } else { (0.0, 1.0) };
        Self { low, high: high.max(low + 1.0), from: pixels.0, to: pixels.1, log: true }
    }

    /// Where a value lies; on a logarithmic scale it must be positive.
    pub(crate) fn at(self, value: f64) -> f64 {
        let value = if self.log { value.log10() } else { value };
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Values with a label, at most about six.
    pub(crate) fn ticks(self) -> Vec<f64> {
        if self.log {
            let step = ((self.high - self.low) / 6.0).ceil().max(1.0);
            let count = ((self.high - self.low) / step).floor() as i32;
            return (0..=count).map(|i| 10_f64.powf(self.low + f64::from(i) * step)).collect();
        }
        let rough = (self.high - self.low) / 5.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(|m| m * power).find(|s| *s >= rough * 0.999);
        let step = step.unwrap_or(power);
        let first = (self.low / step).ceil();
        let count = ((self.high - first * step) / step + 1e-9).floor() as i32;
        (0..=count).map(|i| (first + f64::from(i)) * step).collect()
    }

    /// The 2 to 9 of each power of ten.
    pub(crate) fn minor_ticks(self) -> Vec<f64> {
        let powers = if self.log { self.low as i32..self.high as i32 } else { 0..0 };
        powers.flat_map(|p| (2..10).map(move |m| f64::from(m) * 10_f64.powi(p))).collect()
    }
}

/// A value as a tick's label: plain up to 10,000 and down to 0.01, else with a prefix (µ, m, k, M, G).
pub(crate) fn label(value: f64) -> String {
    const PREFIXES: [(f64, &str); 6] = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ")];
    if value == 0.0 {
        return "0".to_owned();
    }
    if (0.01..1.0).contains(&value) {
        return number(value);
    }
    let (unit, prefix) = PREFIXES.into_iter().find(|(unit, _)| value >= unit * 0.999).unwrap_or((1e-6, "µ"));
    format!("{}{prefix}", number(value / unit))
}

/// The area that is drawn in, in pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Frame {
    /// A vertical axis with its grid; the title stands above it, where it needs no turning of the head.
    pub(crate) fn vertical(&self, svg: &mut Svg, scale: Scale, title: &str) {
        for tick in scale.ticks() {
            let y = scale.at(tick);
            svg.line("grid", (self.left, y), (self.right, y));
            svg.text("small", (self.left - 6.0, y + 4.0), Anchor::End, &label(tick));
        }
        svg.line("axis", (self.left, self.top), (self.left, self.bottom));
        for tick in scale.minor_ticks() {
            svg.line("axis", (self.left - 3.0, scale.at(tick)), (self.left, scale.at(tick)));
        }
        svg.text("small mute", (self.left - 34.0, self.top - 10.0), Anchor::Start, title);
    }

    /// A horizontal axis with its title below.
    pub(crate) fn horizontal(&self, svg: &mut Svg, scale: Scale, title: &str) {
        for tick in scale.ticks() {
            let x = scale.at(tick);
            svg.line("axis", (x, self.bottom), (x, self.bottom + 4.0));
            svg.text("small", (x, self.bottom + 16.0), Anchor::Middle, &label(tick));
        }
        for tick in scale.minor_ticks() {
            svg.line("axis", (scale.at(tick), self.bottom), (scale.at(tick), self.bottom + 2.0));
        }
        self.base(svg, title, self.bottom + 32.0);
    }

    /// The line at the bottom, with a title.
    pub(crate) fn base(&self, svg: &mut Svg, title: &str, title_y: f64) {
        svg.line("axis", (self.left, self.bottom), (self.right, self.bottom));
        svg.text("small mute", (f64::midpoint(self.left, self.right), title_y), Anchor::Middle, title);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(Scale::linear((0.0, 1.0), (0.0, 1.0)).ticks().len(), 6);
        assert_eq!(Scale::linear((0.0, 24.0), (0.0, 1.0)).ticks(), [0.0, 5.0, 10.0, 15.0, 20.0]);
        assert_eq!(Scale::linear((1.0, 20.0), (0.0, 1.0)).ticks(), [5.0, 10.0, 15.0, 20.0]);
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        let scale = Scale::log([32.0, 10_000.0], (0.0, 300.0));
        assert_eq!(scale.ticks(), [10.0, 100.0, 1000.0, 10_000.0]);
        assert!((scale.at(100.0) - 100.0).abs() < 1e-9);
        assert_eq!(scale.minor_ticks().len(), 24);
        let wide = Scale::log([1.0, 1e12], (0.0, 300.0)).ticks();
        assert_eq!(wide.len(), 7);
        assert_eq!(Scale::log([], (0.0, 1.0)).ticks(), [1.0, 10.0]);
    }

    #[test]
    fn labels() {
        let all = [0.0, 1e-5, 0.001, 0.05, 0.8, 1.0, 20.0, 1000.0, 1e6, 2.5e9].map(label);
        assert_eq!(all, ["0", "10µ", "1m", "0.05", "0.8", "1", "20", "1k", "1M", "2.5G"]);
    }
}
