//! A plot with two axes, as SVG.

use std::fmt;

const WIDTH: f64 = 680.0;
const HEIGHT: f64 = 420.0;
/// Room for the axes' numbers and names, left, right, above, below.
const LEFT: f64 = 64.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 16.0;
const BOTTOM: f64 = 52.0;

/// Colours that people who see no red or no green can tell apart (Okabe and Ito 2008).
pub const BLACK: &str = "#222222";
pub const BLUE: &str = "#0072b2";
pub const VERMILION: &str = "#d55e00";
pub const GREEN: &str = "#009e73";
pub const GREY: &str = "#999999";

/// One axis: its name, its ends, where its numbers stand.
pub struct Axis {
    pub name: &'static str,
    pub from: f64,
    pub to: f64,
    pub every: f64,
}

/// How points are drawn.
#[derive(Clone, Copy)]
pub enum Mark {
    Line,
    Dashed,
    Discs,
    /// Small and pale: for clouds of points.
    Specks,
    /// From each point down to the axis.
    Drops,
}

/// Points that belong together.
pub struct Series {
    pub name: String,
    pub mark: Mark,
    pub colour: &'static str,
    pub points: Vec<[f64; 2]>,
}

impl Series {
    pub fn new(name: impl Into<String>, mark: Mark, colour: &'static str, points: Vec<[f64; 2]>) -> Series {
        Series { name: name.into(), mark, colour, points }
    }
}

/// Where the names of the series stand.
#[derive(Clone, Copy)]
pub enum Corner {
    UpperRight,
    LowerRight,
}

pub struct Plot {
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
    pub legend: Corner,
}

impl Plot {
    fn px(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let share = |v: f64, axis: &Axis| (v - axis.from) / (axis.to - axis.from);
        [
            LEFT + share(x, &self.x) * (WIDTH - LEFT - RIGHT),
            HEIGHT - BOTTOM - share(y, &self.y) * (HEIGHT - TOP - BOTTOM),
        ]
    }

    fn axes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (axis, upright) in [(&self.x, false), (&self.y, true)] {
            let count = ((axis.to - axis.from) / axis.every).round() as i32;
            for k in 0..=count {
                let value = axis.from + f64::from(k) * axis.every;
                let (a, b) = match upright {
                    false => ([value, self.y.from], [value, self.y.to]),
                    true => ([self.x.from, value], [self.x.to, value]),
                };
                let ([x1, y1], [x2, y2]) = (self.px(a), self.px(b));
                writeln!(f, r##"<path d="M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}" stroke="#e4e4e4"/>"##)?;
                let (x, y, anchor) = if upright { (x1 - 8.0, y1 + 5.0, "end") } else { (x1, y1 + 20.0, "middle") };
                let digits = if axis.every < 0.1 { 2 } else { usize::from(axis.every.fract() != 0.0) };
                writeln!(f, r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{value:.digits$}</text>"#)?;
            }
        }
        let ([left, bottom], [right, top]) = (self.px([self.x.from, self.y.from]), self.px([self.x.to, self.y.to]));
        writeln!(f, r##"<path d="M{left:.1} {top:.1}V{bottom:.1}H{right:.1}" stroke="#222222"/>"##)?;
        let (middle, name) = ((left + right) / 2.0, self.x.name);
        writeln!(f, r#"<text x="{middle:.1}" y="{:.1}" text-anchor="middle">{name}</text>"#, HEIGHT - 12.0)?;
        let (middle, name) = ((top + bottom) / 2.0, self.y.name);
        writeln!(f, r#"<text transform="translate(18 {middle:.1}) rotate(-90)" text-anchor="middle">{name}</text>"#)
    }

    fn series(&self, series: &Series, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let inside = |p: &&[f64; 2]| {
            let within = |v: f64, axis: &Axis| v >= axis.from && v <= axis.to;
            within(p[0], &self.x) && within(p[1], &self.y)
        };
        let colour = series.colour;
        let points = series.points.iter().filter(inside);
        match series.mark {
            Mark::Line | Mark::Dashed => {
                let way: Vec<String> = points.map(|&p| self.px(p)).map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
                let dash = if matches!(series.mark, Mark::Dashed) { r#" stroke-dasharray="7 5""# } else { "" };
                writeln!(f, r#"<path d="M{}" stroke="{colour}" stroke-width="2"{dash}/>"#, way.join("L"))
            }
            Mark::Discs | Mark::Specks => {
                let (radius, opacity) = if matches!(series.mark, Mark::Discs) { (4.5, 1.0) } else { (1.8, 0.45) };
                writeln!(f, r#"<g fill="{colour}" fill-opacity="{opacity}">"#)?;
                for &p in points {
                    let [x, y] = self.px(p);
                    writeln!(f, r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius}"/>"#)?;
                }
                writeln!(f, "</g>")
            }
            Mark::Drops => {
                for &p in points {
                    let ([x, y], [_, floor]) = (self.px(p), self.px([p[0], self.y.from]));
                    writeln!(f, r#"<path d="M{x:.1} {y:.1}V{floor:.1}" stroke="{colour}" stroke-dasharray="2 3"/>"#)?;
                    writeln!(f, r#"<circle cx="{x:.1}" cy="{y:.1}" r="6.5" stroke="{colour}" stroke-width="1.5"/>"#)?;
                }
                Ok(())
            }
        }
    }

    fn legend(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const LINE: f64 = 20.0;
        let longest = self.series.iter().map(|series| series.name.chars().count()).max().unwrap_or(0);
        let left = WIDTH - RIGHT - 44.0 - 7.0 * longest as f64;
        let top = match self.legend {
            Corner::UpperRight => TOP + 14.0,
            Corner::LowerRight => HEIGHT - BOTTOM - LINE * self.series.len() as f64,
        };
        for (n, series) in (0..).zip(&self.series) {
            let (y, colour) = (top + LINE * f64::from(n), series.colour);
            let (x, middle) = (left + 14.0, y - 5.0);
            match series.mark {
                Mark::Line | Mark::Dashed => {
                    let dash = if matches!(series.mark, Mark::Dashed) { r#" stroke-dasharray="7 5""# } else { "" };
                    let end = x + 14.0;
                    writeln!(
                        f,
                        r#"<path d="M{left:.1} {middle:.1}H{end:.1}" stroke="{colour}" stroke-width="2"{dash}/>"#
                    )?;
                }
                Mark::Discs => writeln!(f, r#"<circle cx="{x:.1}" cy="{middle:.1}" r="4.5" fill="{colour}"/>"#)?,
                Mark::Specks => writeln!(f, r#"<circle cx="{x:.1}" cy="{middle:.1}" r="2.5" fill="{colour}"/>"#)?,
                Mark::Drops => {
                    writeln!(
                        f,
                        r#"<circle cx="{x:.1}" cy="{middle:.1}" r="6.5" stroke="{colour}" stroke-width="1.5"/>"#
                    )?;
                }
            }
            writeln!(f, r#"<text x="{:.1}" y="{y:.1}">{}</text>"#, left + 36.0, series.name)?;
        }
        Ok(())
    }
}

impl fmt::Display for Plot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="13" fill="none">"##
        )?;
        writeln!(f, r#"<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>"#)?;
        writeln!(f, r##"<style>text {{ fill: #222222; stroke: none }}</style>"##)?;
        self.axes(f)?;
        self.series.iter().try_for_each(|series| self.series(series, f))?;
        self.legend(f)?;
        writeln!(f, "</svg>")
    }
}
