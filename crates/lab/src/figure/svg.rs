//! A small writer of SVG: shapes with classes, numbers rounded to two decimals, text escaped.

use std::fmt::Write as _;

/// What the classes look like, light first; `N` of `fN` (filled) and `lN` (drawn) is a colour of Okabe and Ito's
/// palette. Plain colours rather than variables, so that programs other than browsers show the light figure.
pub(crate) const STYLE: &str = "\
.fig text{font-family:system-ui,'Segoe UI',Roboto,'DejaVu Sans',sans-serif;font-size:12px;fill:#1b1b1b}\
.fig .small{font-size:11px}.fig .strong{font-weight:600}.fig .mute{fill:#5c5c5c}\
.fig .mono{font-family:ui-monospace,'DejaVu Sans Mono',monospace;font-size:11px}\
.fig .paper{fill:#fff}.fig .axis{stroke:#5c5c5c;fill:none}.fig .grid{stroke:#dedede;fill:none}\
.fig .inkline{stroke:#1b1b1b;fill:none}.fig .onfill{fill:#000}\
.fig .f0{fill:#0072b2}.fig .f1{fill:#d55e00}.fig .f2{fill:#009e73}.fig .f3{fill:#cc79a7}\
.fig .f4{fill:#e69f00}.fig .f5{fill:#56b4e9}.fig .f6{fill:#f0e442}\
.fig .l0{stroke:#0072b2;fill:none}.fig .l1{stroke:#d55e00;fill:none}.fig .l2{stroke:#009e73;fill:none}\
.fig .l3{stroke:#cc79a7;fill:none}.fig .soft{fill-opacity:.35}\
@media screen and (prefers-color-scheme:dark){\
.fig text{fill:#ececec}.fig .mute{fill:#a9a9a9}.fig .paper{fill:#161616}.fig .axis{stroke:#a9a9a9}\
.fig .grid{stroke:#383838}.fig .inkline{stroke:#ececec}.fig .f0{fill:#4da3d9}.fig .l0{stroke:#4da3d9}\
.fig text.onfill{fill:#000}}";

/// Where a text is anchored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A figure being drawn. Lengths are pixels; y points down.
#[derive(Debug)]
pub(crate) struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

/// A number as it stands in the file: at most two decimals, none that say nothing, no `-0`.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text with what XML reserves escaped.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}

impl Svg {
    /// An empty figure; the title is what a screen reader says.
    pub(crate) fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), body: String::new() }
    }

    pub(crate) fn line(&mut self, class: &str, from: (f64, f64), to: (f64, f64)) {
        let [x1, y1, x2, y2] = [from.0, from.1, to.0, to.1].map(number);
        let _ = writeln!(self.body, r#"<line class="{class}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>"#);
    }

    /// A line of a width, drawn with dashes if `dash` says how.
    pub(crate) fn stroke(&mut self, class: &str, from: (f64, f64), to: (f64, f64), width: f64, dash: Option<&str>) {
        let [x1, y1, x2, y2, width] = [from.0, from.1, to.0, to.1, width].map(number);
        let dash = dash.map(|dash| format!(r#" stroke-dasharray="{dash}""#)).unwrap_or_default();
        let _ = writeln!(
            self.body,
            r#"<line class="{class}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" stroke-width="{width}"{dash}/>"#
        );
    }

    pub(crate) fn rect(&mut self, class: &str, corner: (f64, f64), width: f64, height: f64) {
        let [x, y, width, height] = [corner.0, corner.1, width, height].map(number);
        let _ = writeln!(self.body, r#"<rect class="{class}" x="{x}" y="{y}" width="{width}" height="{height}"/>"#);
    }

    pub(crate) fn circle(&mut self, class: &str, centre: (f64, f64), radius: f64) {
        let [x, y, r] = [centre.0, centre.1, radius].map(number);
        let _ = writeln!(self.body, r#"<circle class="{class}" cx="{x}" cy="{y}" r="{r}"/>"#);
    }

    pub(crate) fn polygon(&mut self, class: &str, points: &[(f64, f64)]) {
        let points: Vec<String> = points.iter().map(|&(x, y)| format!("{},{}", number(x), number(y))).collect();
        let _ = writeln!(self.body, r#"<polygon class="{class}" points="{}"/>"#, points.join(" "));
    }

    pub(crate) fn text(&mut self, class: &str, at: (f64, f64), anchor: Anchor, text: &str) {
        self.turned_text(class, at, anchor, 0.0, text);
    }

    /// Text turned by an angle in degrees around where it is anchored.
    pub(crate) fn turned_text(&mut self, class: &str, at: (f64, f64), anchor: Anchor, angle: f64, text: &str) {
        let [x, y] = [at.0, at.1].map(number);
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
            Anchor::End => r#" text-anchor="end""#,
        };
        let class = if class.is_empty() { String::new() } else { format!(r#" class="{class}""#) };
        let turn =
            if angle == 0.0 { String::new() } else { format!(r#" transform="rotate({} {x} {y})""#, number(angle)) };
        let _ = writeln!(self.body, r#"<text{class} x="{x}" y="{y}"{anchor}{turn}>{}</text>"#, escape(text));
    }

    /// What is said of what is drawn until [`close`](Self::close), where a pointer rests on it.
    pub(crate) fn open(&mut self, hint: &str) {
        let _ = writeln!(self.body, "<g><title>{}</title>", escape(hint));
    }

    pub(crate) fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// The figure as a file.
    pub(crate) fn finish(self) -> String {
        let [width, height] = [self.width, self.height].map(number);
        let title = escape(&self.title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fig\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">\n<title>{title}</title>\n\
             <style>{STYLE}</style>\n<rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n{}</svg>\n",
            self.body
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let all = [1.0, 0.5, 1.0 / 3.0, -0.001, 1e6, 100.0, 12.345_6, -2.5].map(number);
        assert_eq!(all, ["1", "0.5", "0.33", "0", "1000000", "100", "12.35", "-2.5"]);
    }

    #[test]
    fn text_is_escaped() {
        let mut svg = Svg::new(10.0, 5.0, "a < b & \"c\"");
        svg.text("", (1.0, 2.0), Anchor::End, "<x>");
        let text = svg.finish();
        assert!(text.contains("aria-label=\"a &lt; b &amp; &quot;c&quot;\""), "{text}");
        assert!(text.contains("<text x=\"1\" y=\"2\" text-anchor=\"end\">&lt;x&gt;</text>"), "{text}");
    }
}
