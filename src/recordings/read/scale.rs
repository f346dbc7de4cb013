//! Finds the scale of a file in metres and seconds, if need be from plausible walking speeds.

use super::census::Census;
use super::layout::TimeColumn;
use super::{LengthUnit, RecordingFormat, RecordingOptions};
use crate::math::{Rect, Vec2, sin_cos, vec2};

/// Common rates of cameras and simulations, 1/s.
const RATES: [f64; 30] = [
    1.0, 2.0, 2.5, 4.0, 5.0, 6.0, 7.5, 8.0, 10.0, 12.0, 12.5, 15.0, 16.0, 20.0, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0,
    59.94, 60.0, 72.0, 75.0, 90.0, 100.0, 120.0, 144.0, 200.0, 240.0,
];
/// Relative tolerance within which a rate found from velocities snaps to one of [`RATES`].
const RATE_SLACK: f64 = 0.06;
/// Rates that are tried if the file gives no indication, 1/s.
const GUESSES: [f64; 5] = [10.0, 12.5, 16.0, 25.0, 30.0];
/// Usual walking speed, metres per second.
const USUAL_M_S: f64 = 1.2;
/// Plausible bound of the upper quartile of speeds, m/s; a larger value indicates centimetres.
const FASTEST_M_S: f64 = 15.0;
/// Range of median speeds without a warning, metres per second.
const PLAUSIBLE_M_S: [f64; 2] = [0.02, 10.0];
/// Lowest plausible frame rate of a file without a stated rate, 1/s.
const SLOWEST_CAMERA: f64 = 8.0;
/// Rate of manual annotation in the ETH and UCY recordings, 1/s.
const ANNOTATED_HZ: f64 = 2.5;
/// Rate of the older Juelich recordings, whose files have no header, 1/s.
const OLD_JUELICH_HZ: f64 = 16.0;
/// Gap after which a person has left, seconds; `GAP_INTERVALS` usual intervals if longer.
const GAP_S: f64 = 1.0;
const GAP_INTERVALS: f64 = 2.5;
/// Upper bound of that gap, seconds.
const LONGEST_GAP_S: f64 = 120.0;
/// Longest time that a person is assumed to stand between two recorded steps, seconds.
const STAND_S: f64 = 10.0;
/// Range of frame rates for persons without common moments, 1/s.
const OWN_CLOCK_HZ: [f64; 2] = [10.0, 60.0];

/// Least share of the path walked along the heading, if angles are counter-clockwise from +x.
const LEAST_FORWARD: f64 = 0.5;
/// Moments are evenly spaced if nine of ten intervals differ by at most this share.
const EVEN: f64 = 0.02;

/// Properties stated by the file or implied by its format.
#[derive(Clone, Debug)]
pub(super) struct Stated {
    pub format: RecordingFormat,
    pub clock: TimeColumn,
    pub fps: Option<f64>,
    pub unit: Option<LengthUnit>,
    /// Length unit found from body heights.
    pub unit_of_heights: Option<LengthUnit>,
    /// Whether the columns have no names.
    pub bare: bool,
    /// Whether headings are angles, which some programs count from north or clockwise.
    pub angles: bool,
}

/// Conversion of the file's times to seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TimeScale {
    /// Frames per second.
    Frames(f64),
    /// Seconds per unit.
    Times(f64),
}

impl TimeScale {
    #[inline]
    pub fn seconds(self, count: f64) -> f64 {
        match self {
            TimeScale::Frames(fps) => count / fps,
            TimeScale::Times(seconds) => count * seconds,
        }
    }
}

/// Units of a file, and the choices that follow from its statistics.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    pub time: TimeScale,
    pub unit: LengthUnit,
    /// Frames per second of the motion; the usual rate if it varies.
    pub fps: f64,
    /// Whether persons have no common moments and are interpolated at `fps`.
    pub own_clock: bool,
    /// Gap after which a person has left, seconds.
    pub gap_s: f64,
    /// Longest time that a person is assumed to stand between two steps, seconds.
    pub stand_s: Option<f64>,
    /// Whether the file's velocities are used.
    pub velocities: bool,
    /// Whether the file's headings are used.
    pub headings: bool,
}

/// Error: the frame rate is unknown.
#[derive(Debug)]
pub(super) struct UnknownRate;

impl Scale {
    pub fn find(
        census: &mut Census,
        stated: &Stated,
        options: &RecordingOptions,
        warnings: &mut Vec<String>,
    ) -> Result<Scale, UnknownRate> {
        let own = census.own_speeds.quantile(0.5);
        let unit = unit(census, stated, options, warnings);
        let time = match stated.clock {
            TimeColumn::Frames => TimeScale::Frames(rate(census, stated, options, unit, own, warnings)?),
            TimeColumn::Times(seconds) => {
                if options.fps.is_some() {
                    warnings.push("the recording has times, so the option `fps` is ignored".to_owned());
                }
                TimeScale::Times(seconds.unwrap_or_else(|| guessed_time_unit(census, unit, own, warnings)))
            }
        };
        let second = time.seconds(1.0);
        let velocities = own.is_some_and(|own| (own / second - 1.0).abs() < 0.3);
        if let Some(own) = own.filter(|_| !velocities) {
            let fits = match time {
                TimeScale::Frames(fps) => format!("at {fps} frames per second; {} would fit", tidy(1.0 / own)),
                TimeScale::Times(_) => "of its times".to_owned(),
            };
            warnings.push(format!("the recording's own velocities are not used: they do not fit its places {fits}"));
        }
        // Rates are rounded to common values.
        let interval = |raw: Option<f64>| raw.map(|raw| time.seconds(raw));
        let of_moments = interval(census.moment_intervals.quantile(0.5));
        let of_people = interval(census.intervals.quantile(0.5));
        let own_clock =
            census.steps || matches!((of_moments, of_people), (Some(moment), Some(person)) if person > 1.75 * moment);
        let fallback = match time {
            TimeScale::Frames(fps) => fps,
            TimeScale::Times(_) => OWN_CLOCK_HZ[0],
        };
        // All steps lead from one moment to the next, as in a simulation with a fixed time step.
        let common = !own_clock || census.steps && evenly_stepped(census);
        let fps = if !common {
            let [low, high] = OWN_CLOCK_HZ;
            of_people.map_or(low, |interval| (1.0 / interval).round().clamp(low, high))
        } else {
            of_moments.map_or(fallback, |interval| tidy(1.0 / interval))
        };
        let gap_s = (GAP_INTERVALS * of_people.unwrap_or(0.0)).clamp(GAP_S, LONGEST_GAP_S);
        warn_of_speeds(census, time, unit, warnings);
        let stand_s = census.steps.then_some(STAND_S.max(gap_s));
        let headings = !stated.angles || census.forward >= LEAST_FORWARD * census.faced;
        if !headings {
            let told = "the recording's headings are not used: they are not where people walk; read are angles \
                        counter-clockwise from +x";
            warnings.push(told.to_owned());
        }
        Ok(Scale { time, unit, fps, own_clock, gap_s, stand_s, velocities, headings })
    }
}

/// Whether every step leads to the next moment, and moments are evenly spaced.
fn evenly_stepped(census: &mut Census) -> bool {
    let [low, high] = [0.05, 0.95].map(|share| census.moment_intervals.quantile(share));
    let step = census.intervals.quantile(0.5);
    matches!((low, high, step), (Some(low), Some(high), Some(step))
        if high <= low * (1.0 + EVEN) && (step / low - 1.0).abs() <= EVEN)
}

/// Rounds a rate to remove noise of differences.
fn tidy(rate: f64) -> f64 {
    let whole = rate.round();
    if whole > 0.0 && (rate - whole).abs() < 0.004 * whole {
        return whole;
    }
    let short = (rate * 1000.0).round() / 1000.0;
    if short > 0.0 { short } else { rate }
}

fn unit(census: &mut Census, stated: &Stated, options: &RecordingOptions, warnings: &mut Vec<String>) -> LengthUnit {
    if let Some(unit) = options.unit.or(stated.unit) {
        return unit;
    }
    let (unit, why) = match stated.unit_of_heights {
        Some(unit) => (unit, "by the people's heights"),
        None => {
            let second = match stated.clock {
                TimeColumn::Frames => 1.0 / options.fps.or(stated.fps).unwrap_or(SLOWEST_CAMERA),
                TimeColumn::Times(seconds) => seconds.unwrap_or(1.0),
            };
            let speed = census.speed_quantile(0.75).unwrap_or(0.0) / second;
            let units = [LengthUnit::Metre, LengthUnit::Centimetre, LengthUnit::Millimetre];
            let plausible = units.into_iter().find(|unit| speed * unit.metres() <= FASTEST_M_S);
            (plausible.unwrap_or(LengthUnit::Metre), "by the people's speeds")
        }
    };
    if unit != LengthUnit::Metre {
        warnings.push(format!(
            "the file gives no unit of lengths: {} are assumed {why}; the option `unit` overrides it",
            unit.plural()
        ));
    }
    unit
}

fn rate(
    census: &mut Census,
    stated: &Stated,
    options: &RecordingOptions,
    unit: LengthUnit,
    own: Option<f64>,
    warnings: &mut Vec<String>,
) -> Result<f64, UnknownRate> {
    if let Some(fps) = options.fps.or(stated.fps) {
        return Ok(fps);
    }
    if let Some(own) = own {
        let rate = 1.0 / own;
        let known = RATES.into_iter().find(|known| (rate / known - 1.0).abs() < RATE_SLACK);
        let nearest = |best: f64, known: f64| if (rate - known).abs() < (rate - best).abs() { known } else { best };
        let fps = known.map_or(tidy(rate), |first| RATES.into_iter().fold(first, nearest));
        warnings.push(format!(
            "the file gives no rate: {fps} frames per second fit its own velocities; the option `fps` overrides it"
        ));
        return Ok(fps);
    }
    if stated.format == RecordingFormat::Obsmat {
        let step = census.moment_intervals.quantile(0.5).unwrap_or(1.0);
        let fps = ANNOTATED_HZ * step;
        warnings.push(format!(
            "the file gives no rate: {ANNOTATED_HZ} annotations per second are assumed, as ETH and UCY have, so {fps} \
             frames per second; the option `fps` overrides it"
        ));
        return Ok(fps);
    }
    let per_frame_m = census.median_speed().unwrap_or(0.0) * unit.metres();
    if per_frame_m <= 0.0 {
        return Err(UnknownRate);
    }
    let off = |fps: f64| (fps * per_frame_m / USUAL_M_S - 1.0).abs();
    let guess = GUESSES.into_iter().fold(GUESSES[0], |best, fps| if off(fps) < off(best) { fps } else { best });
    let old = stated.format == RecordingFormat::Juelich && stated.bare;
    let (fps, why) = if old && (0.1..2.5).contains(&(OLD_JUELICH_HZ * per_frame_m)) {
        (OLD_JUELICH_HZ, "as older Juelich recordings have")
    } else {
        (guess, "at which people walk most plausibly")
    };
    warnings.push(format!(
        "the file gives no rate: {fps} frames per second are assumed, {why}; the option `fps` overrides it"
    ));
    Ok(fps)
}

/// Guesses the number of seconds per unit of an unnamed time unit.
fn guessed_time_unit(census: &mut Census, unit: LengthUnit, own: Option<f64>, warnings: &mut Vec<String>) -> f64 {
    // Unix times in s, ms, us or ns, of the years 2001 to 2286.
    let since_1970 = [(1e9, 1.0), (1e12, 1e-3), (1e15, 1e-6), (1e18, 1e-9)];
    if let Some((_, seconds)) = since_1970.iter().find(|(start, _)| (1.0..10.0).contains(&(census.first_time / start)))
    {
        return *seconds;
    }
    if let Some(seconds) = own.and_then(|own| [1.0, 1e-3, 1e-6].into_iter().find(|s| (0.5..2.0).contains(&(own / s)))) {
        return seconds;
    }
    let interval = census.intervals.quantile(0.5).unwrap_or(0.0);
    let speed = census.speed_quantile(0.75).unwrap_or(0.0) * unit.metres();
    if interval >= 5.0 && interval == interval.round() && speed < 0.05 {
        warnings.push(
            "the file gives no unit of times: milliseconds are assumed by the people's speeds; name the column time_s \
             for seconds"
                .to_owned(),
        );
        return 1e-3;
    }
    1.0
}

fn warn_of_speeds(census: &mut Census, time: TimeScale, unit: LengthUnit, warnings: &mut Vec<String>) {
    let Some(raw) = census.median_speed() else { return };
    let speed = raw * unit.metres() / time.seconds(1.0);
    let [slow, fast] = PLAUSIBLE_M_S;
    if (slow..=fast).contains(&speed) {
        return;
    }
    let options = match time {
        TimeScale::Frames(fps) => {
            format!("the option `unit` overrides {}, the option `fps` {fps} frames per second", unit.plural())
        }
        TimeScale::Times(_) => format!("the option `unit` overrides {}", unit.plural()),
    };
    warnings.push(format!(
        "half of all people are {} than {speed:.3} m/s: {options}",
        if speed < slow { "slower" } else { "faster" }
    ));
}

/// Converts positions to metres, rotates and translates them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Alignment {
    unit: LengthUnit,
    rotation: Option<Vec2>,
    origin: Vec2,
    shift: Vec2,
}

impl Alignment {
    pub fn new(unit: LengthUnit, options: &RecordingOptions) -> Alignment {
        let [origin, shift] = [options.origin, options.shift].map(|[x, y]| vec2(x, y));
        Alignment { unit, rotation: rotation(options.rotation_deg), origin, shift }
    }

    /// Converts the bounding box of rotated raw positions to metres.
    pub fn bounds(&self, turned: Rect) -> Rect {
        let fixed = self.rotation.map_or(Vec2::ZERO, |by| self.origin - self.origin.rotated(by)) + self.shift;
        let Rect { min, max } = turned;
        Rect { min: self.unit.in_metres(min) + fixed, max: self.unit.in_metres(max) + fixed }
    }

    #[inline]
    pub fn place(&self, raw: Vec2) -> Vec2 {
        let p = self.unit.in_metres(raw);
        let turned = match self.rotation {
            Some(by) => (p - self.origin).rotated(by) + self.origin,
            None => p,
        };
        turned + self.shift
    }

    pub fn velocity(&self, raw: Vec2) -> Vec2 {
        self.direction(self.unit.in_metres(raw))
    }

    pub fn direction(&self, raw: Vec2) -> Vec2 {
        self.rotation.map_or(raw, |by| raw.rotated(by))
    }
}

/// Returns cosine and sine of a rotation; `None` for 0 degrees.
pub(super) fn rotation(degrees: f64) -> Option<Vec2> {
    let degrees = degrees.rem_euclid(360.0);
    // Multiples of 90 degrees are exact.
    match degrees {
        0.0 => None,
        90.0 => Some(vec2(0.0, 1.0)),
        180.0 => Some(vec2(-1.0, 0.0)),
        270.0 => Some(vec2(0.0, -1.0)),
        _ => {
            let (sin, cos) = sin_cos(degrees.to_radians());
            Some(vec2(cos, sin))
        }
    }
}

impl LengthUnit {
    /// Converts to metres; divides where that rounds only once.
    fn in_metres(self, raw: Vec2) -> Vec2 {
        match self {
            LengthUnit::Metre => raw,
            LengthUnit::Centimetre => raw / 100.0,
            LengthUnit::Millimetre => raw / 1000.0,
            LengthUnit::Foot => raw * 0.3048,
        }
    }

    /// Plural of the unit's name, for messages.
    pub fn plural(self) -> &'static str {
        match self {
            LengthUnit::Metre => "metres",
            LengthUnit::Centimetre => "centimetres",
            LengthUnit::Millimetre => "millimetres",
            LengthUnit::Foot => "feet",
        }
    }
}
