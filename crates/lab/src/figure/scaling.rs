//! How something grows: a log-log plot with fitted power laws.
//!
//! A power law y = c·xᵃ is fitted by least squares on the logarithms of both; a is the exponent. A point at which a
//! measurement was cut is drawn at what was measured until then, hollow, and is no part of the fit.

use super::axis::{Frame, Scale, label};
use super::svg::{Anchor, Svg, number};

/// Width of a panel, height of its plot, and of each line of its legend, in pixels.
const PANEL: (f64, f64, f64) = (350.0, 210.0, 16.0);

/// A measurement. Both numbers are positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerPoint {
    /// The size.
    pub x: f64,
    /// What it took.
    pub y: f64,
    /// Whether it was cut: `y` is only a lower bound.
    pub cut: bool,
}

/// Measurements that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerSeries {
    /// What they are.
    pub name: String,
    /// By size.
    pub points: Vec<PowerPoint>,
}

/// One plot.
#[derive(Debug, Clone, PartialEq)]
pub struct LogLog {
    /// What stands above it.
    pub title: String,
    /// The horizontal axis, with its unit.
    pub horizontal: String,
    /// The vertical axis, with its unit.
    pub vertical: String,
    /// At most four are told apart.
    pub series: Vec<PowerSeries>,
}

/// A fitted power law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The exponent.
    pub exponent: f64,
    /// The factor before the power.
    pub factor: f64,
    /// The share of the variance of log y that it explains (R²); 1 if there is none.
    pub r_squared: f64,
}

/// The power law through the points that were not cut; `None` with fewer than two sizes.
pub fn fit_power_law(points: &[PowerPoint]) -> Option<Fit> {
    let whole = points.iter().filter(|p| !p.cut && p.x > 0.0 && p.y > 0.0);
    let logs: Vec<(f64, f64)> = whole.map(|p| (p.x.ln(), p.y.ln())).collect();
    let count = logs.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum = |of: &dyn Fn(f64, f64) -> f64| logs.iter().map(|p| of(p.0 - x, p.1 - y)).sum::<f64>();
    let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
    if logs.len() < 2 || xx < 1e-12 {
        return None;
    }
    let exponent = xy / xx;
    let r_squared = if yy < 1e-12 { 1.0 } else { xy * xy / (xx * yy) };
    Some(Fit { exponent, factor: (y - exponent * x).exp(), r_squared })
}

/// The plot as a figure.
pub fn log_log(plot: &LogLog) -> String {
    let legend = PANEL.2 * plot.series.len() as f64;
    let frame = Frame { left: 44.0, top: 50.0, right: PANEL.0 - 14.0, bottom: 50.0 + PANEL.1 };
    let title = format!("{}: {} against {}", plot.title, plot.vertical, plot.horizontal);
    let mut svg = Svg::new(PANEL.0, frame.bottom + 48.0 + legend, &title);
    svg.text("strong", (10.0, 18.0), Anchor::Start, &plot.title);
    let points = || plot.series.iter().flat_map(|series| &series.points);
    let horizontal = Scale::log(points().map(|p| p.x), (frame.left, frame.right));
    let vertical = Scale::log(points().map(|p| p.y), (frame.bottom, frame.top));
    frame.vertical(&mut svg, vertical, &plot.vertical);
    frame.horizontal(&mut svg, horizontal, &plot.horizontal);
    for (index, series) in plot.series.iter().enumerate() {
        let fit = fit_power_law(&series.points);
        if let Some(fit) = fit {
            draw_fit(&mut svg, fit, series, (horizontal, vertical), index);
        }
        for point in series.points.iter().filter(|p| p.x > 0.0 && p.y > 0.0) {
            let cut = if point.cut { ", cut there" } else { "" };
            svg.open(&format!("{}: {} at {}{cut}", series.name, label(point.y), label(point.x)));
            mark(&mut svg, index, (horizontal.at(point.x), vertical.at(point.y)), point.cut);
            svg.close();
        }
        let y = frame.bottom + 50.0 + PANEL.2 * index as f64;
        mark(&mut svg, index, (18.0, y - 4.0), false);
        svg.text("small", (28.0, y), Anchor::Start, &legend_line(series, fit));
    }
    svg.finish()
}

fn draw_fit(svg: &mut Svg, fit: Fit, series: &PowerSeries, scales: (Scale, Scale), index: usize) {
    let whole = || series.points.iter().filter(|p| !p.cut).map(|p| p.x);
    let ends = [whole().fold(f64::INFINITY, f64::min), whole().fold(0.0, f64::max)];
    let [from, to] = ends.map(|x| (scales.0.at(x), scales.1.at(fit.factor * x.powf(fit.exponent))));
    svg.stroke(&format!("l{}", index % 4), from, to, 1.5, Some("5 3"));
}

/// `all tools: ∝ n^1.02 (R² 0.998), cut at 3.2k`.
fn legend_line(series: &PowerSeries, fit: Option<Fit>) -> String {
    let mut line = series.name.clone();
    if let Some(fit) = fit {
        line.push_str(&format!(": ∝ n^{} (R² {})", number(fit.exponent), number(fit.r_squared)));
    }
    if let Some(point) = series.points.iter().find(|p| p.cut) {
        line.push_str(&format!(", cut at {}", label(point.x)));
    }
    line
}

/// A mark whose shape tells the series too; hollow if the measurement was cut.
fn mark(svg: &mut Svg, index: usize, (x, y): (f64, f64), cut: bool) {
    let class = if cut { format!("l{}", index % 4) } else { format!("f{}", index % 4) };
    let shape: &[(f64, f64)] = match index % 4 {
        0 => return svg.circle(&class, (x, y), 4.0),
        1 => &[(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0)],
        2 => &[(0.0, -5.0), (5.0, 4.0), (-5.0, 4.0)],
        _ => &[(0.0, -5.5), (5.5, 0.0), (0.0, 5.5), (-5.5, 0.0)],
    };
    let points: Vec<(f64, f64)> = shape.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
    svg.polygon(&class, &points);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(law: impl Fn(f64) -> f64) -> Vec<PowerPoint> {
        [32.0, 100.0, 320.0, 1000.0].map(|x| PowerPoint { x, y: law(x), cut: false }).to_vec()
    }

    #[test]
    fn an_exact_power_law_is_found() {
        let fit = fit_power_law(&points(|x| 0.002 * x.powf(1.7))).expect("a fit");
        assert!((fit.exponent - 1.7).abs() < 1e-9 && (fit.factor - 0.002).abs() < 1e-9, "{fit:?}");
        assert!((fit.r_squared - 1.0).abs() < 1e-9);
    }

    #[test]
    fn cut_points_are_left_out_of_the_fit() {
        let mut all = points(|x| x * x);
        all.push(PowerPoint { x: 3200.0, y: 60.0, cut: true });
        let fit = fit_power_law(&all).expect("a fit");
        assert!((fit.exponent - 2.0).abs() < 1e-9);
        assert_eq!(fit_power_law(&all[..1]), None);
        let twice = [all[0], all[0]];
        assert_eq!(fit_power_law(&twice), None, "one size tells no exponent");
    }

    #[test]
    fn noise_lowers_r_squared() {
        let mut all = points(|x| x);
        all[1].y *= 8.0;
        assert!(fit_power_law(&all).expect("a fit").r_squared < 0.9);
    }

    #[test]
    fn a_plot() {
        let mut linear = points(|x| 1e-4 * x);
        linear.push(PowerPoint { x: 3200.0, y: 60.0, cut: true });
        let series = vec![
            PowerSeries { name: "one kitchen".to_owned(), points: linear },
            PowerSeries { name: "many kitchens".to_owned(), points: points(|x| 1e-6 * x * x) },
        ];
        let plot = LogLog {
            title: "Planning time".to_owned(),
            horizontal: "objects".to_owned(),
            vertical: "seconds".to_owned(),
            series,
        };
        insta::assert_snapshot!(log_log(&plot));
    }
}
